/* impact_followed.c - several contacts in one blow that is followed in its impulses (contact_course.h): what the laws of Poisson
 * and Stronge need.  Where all of them have stiffnesses, these say how they share it (contact_springs.h).
 *
 * Compression and restitution of rigid contacts leave open how fast one contact is compressed beside another, and with it how
 * they share the blow.  Here all go at one pace: velocities of approach fall in proportion to what they are, velocities of
 * separation grow in proportion to what restitution asks for, unless other contacts move the pair apart faster.  No stiffness
 * enters, no order and no mirror.  What rests is held while it is pressed.  Blows that this decides are counted
 * (PM_COUNT_SHARED_BLOWS).
 *
 * An impact without collision is the course of one contact alone (impact_course.c): friction draws it together while it slips.
 * Motions that come to that place do so where its acceleration vanishes, too: no step leads there (Genot and Brogliato), and
 * there it is struck with the friction that just draws it. */
#include <math.h>
#include <string.h>

#include "elements/contact.h"
#include "equations/active_set.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "events/event.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact.h"
#include "impact/impact_parts.h"
#include "numerics/tolerances.h"
#include "numerics/tolerances_impact.h"
#include "state/frame.h"
#include "state/workspace.h"

int pm_impact_is_followed(const pm_model *m, const pm_contact_system *x)
{
    for (int i = 0; i < x->problem.n; i++)
        if (pm_contact_law(m, pm_contact_of_slot(m, x->slot[i])) != PM_LAW_NEWTON) return 1;
    return 0;
}

int pm_impact_check_followed(pm_workspace *w, const pm_contact_system *x)
{
    for (int i = 0; i < x->problem.n; i++) {
        const int contact = pm_contact_of_slot(w->model, x->slot[i]);
        if (w->numbers.massless)
            return pm_fail(&w->result, PM_UNSUPPORTED, PM_TABLE_CONTACT, contact, NAN, NAN);
        if (PM_CONTACT_ROW(w->model, contact)[PM_CONTACT_TANGENTIAL] != PM_NONE)
            return pm_fail(&w->result, PM_BLOW_SEVERAL, PM_TABLE_CONTACT, contact, x->problem.n, 1);
    }
    return PM_OK;
}

static const pm_constraint *direction(const pm_contact_system *x, int i)
{
    return i % 2 == 0 ? &x->normal[i / 2] : &x->tangent[i / 2];
}

/* The exponent of contacts that all have a stiffness; 0: nothing is known of how they share the blow. */
static double exponent_of(const pm_workspace *w, const pm_contact_system *x)
{
    for (int i = 0; i < x->problem.n; i++)
        if (!(pm_contact_stiffness(&w->frame, pm_contact_of_slot(w->model, x->slot[i])) > 0)) return 0;
    return w->numbers.value[PM_SETTING(w->model, PM_SETTING_EXPONENT)];
}

/* What rests is compressed and released as what is struck where stiffnesses say how, at the speeds of the blow; by the pace it
 * is only held. */
static double restitution_of(const pm_workspace *w, const pm_blow *b, const pm_contact_course *c, int slot,
                             double normal)
{
    const int contact = pm_contact_of_slot(w->model, slot);
    const int struck = b->share[slot] == PM_STRUCK || b->share[slot] == PM_DROPPED;
    if (w->event->spent[contact]) return 0;
    if (struck && normal < 0) return pm_last_bounce_restitution(w, contact, normal);
    return c->exponent > 0 ? pm_last_bounce_restitution(w, contact, -b->approach) : 0;
}

void pm_impact_pose_course(pm_workspace *w, pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    pm_contact_course *c = &b->course;
    const int n = 2 * x->problem.n;
    c->n = x->problem.n;
    c->no_slip = pm_contact_speed(&w->frame);
    c->exponent = exponent_of(w, x);
    c->springs.tolerance = PM_SPRINGS_TOLERANCE * (w->numbers.coarse > 1 ? PM_COARSER : 1);
    memcpy(c->response, x->problem.response, (size_t)n * n * sizeof *c->response);
    for (int i = 0; i < n; i++)
        c->velocity[i] = pm_constraint_times(&w->frame, direction(x, i), x->free) - direction(x, i)->rate;
    for (int i = 0; i < c->n; i++) {
        const int contact = pm_contact_of_slot(w->model, x->slot[i]);
        c->contact[i] = (pm_contact_course_contact){
            .friction = x->problem.contact[i],
            .law = pm_contact_law(w->model, contact),
            .restitution = restitution_of(w, b, c, x->slot[i], c->velocity[2 * i]),
            .stiffness = pm_contact_stiffness(&w->frame, contact),
            .is_spent = w->event->spent[contact],
        };
    }
}

static void add_impulse(const pm_workspace *w, pm_contact_system *x, const pm_constraint *along,
                        double impulse)
{
    for (int p = 0; p < pm_constraint_bodies(along); p++)
        for (int k = 0; k < 3 && along->body[p] != w->model->nbody; k++)
            x->force[3 * along->body[p] + k] += impulse * along->j[3 * p + k];
}

int pm_impact_apply(pm_workspace *w, pm_blow *b)
{
    pm_contact_system *x = &b->system;
    const int n = 2 * x->problem.n;
    const double *impulse = b->course.impulse;
    memset(x->force, 0, (size_t)w->model->nq * sizeof *x->force);
    for (int i = 0; i < n; i++) add_impulse(w, x, direction(x, i), impulse[i]);
    for (int k = 0; k < b->course.m; k++) add_impulse(w, x, &b->loaded.along[k], impulse[n + k]);
    for (int i = 0; i < w->active.n; i++) w->saddle.wanted[i] = -pm_impact_trial_rate(w, i);
    const int status = pm_saddle_respond(w, x->force, b->after);
    for (int i = 0; i < w->model->nq && !status; i++) b->after[i] += w->state.v[i];
    return status;
}

void pm_impact_record_followed(pm_workspace *w, pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    const double *impulse = b->course.impulse;
    pm_impact_end_record(w);
    for (int k = 0; k < b->course.m; k++)
        w->impulses.friction[b->loaded.friction[k]] = impulse[2 * x->problem.n + k];
    b->followed = 1;
    for (int i = 0; i < x->problem.n; i++) {
        const int slot = x->slot[i], pushes = impulse[2 * i] > 0;
        const int struck = b->share[slot] == PM_STRUCK || b->share[slot] == PM_DROPPED;
        b->share[slot] = struck ? (pushes ? PM_STRUCK : PM_DROPPED) : pushes ? PM_JOINED : PM_OUT;
        pm_impact_end_record_contact(w, slot, &x->normal[i], &x->tangent[i], impulse + 2 * i);
    }
}

/* Its stiffest contact is told, and how much stiffer it is than the least. */
static int fail_endless(pm_workspace *w, const pm_contact_system *x, const pm_contact_course *c)
{
    int most = 0;
    double least = INFINITY;
    for (int i = 0; i < c->n; i++) {
        least = fmin(least, c->contact[i].stiffness);
        if (c->contact[i].stiffness > c->contact[most].stiffness) most = i;
    }
    return pm_fail(&w->result, PM_BLOWS_ENDLESS, PM_TABLE_CONTACT,
                   pm_contact_of_slot(w->model, x->slot[most]), c->contact[most].stiffness / least,
                   PM_SPRINGS_STEPS);
}

int pm_impact_follow_several(pm_workspace *w, pm_blow *b)
{
    pm_contact_system *x = &b->system;
    pm_contact_course *c = &b->course;
    int status = pm_impact_check_followed(w, x);
    if (status) return status;
    pm_impact_pose_course(w, b);
    c->m = 0;
    const int n = pm_contact_course_follow(c);
    if (n == 0 && c->exponent > 0) return fail_endless(w, x, c);
    if (n != 1) return pm_impact_fail(w, x, n, c->differs == PM_NONE ? 0 : c->differs);
    if ((status = pm_impact_apply(w, b))) return status;
    pm_impact_record_followed(w, b);
    if (c->exponent > 0) b->several = 0; /* the scene says how they share: no order is open */
    return PM_OK;
}

/* ---- impacts without collision ---- */
/* One contact that slips, as if it were struck alone with no velocity of approach. */
static pm_impact_course course_of(const pm_workspace *w, const pm_contact_system *x, const double *velocity,
                                  int i)
{
    const int n = 2 * x->problem.n, contact = pm_contact_of_slot(w->model, x->slot[i]);
    const double *own = x->problem.response + 2 * i * (n + 1);
    return (pm_impact_course){
        .a = own[0],
        .b = own[1],
        .c = own[n + 1],
        .slip = velocity[2 * i + 1],
        .mu_static = x->problem.contact[i].hold,
        .mu_kinetic = x->problem.contact[i].rub,
        .restitution = pm_contact_restitution(&w->frame, contact),
        .no_slip = pm_contact_speed(&w->frame),
        .law = pm_contact_law(w->model, contact),
    };
}

/* The friction with which it would just be drawn. */
static double critical(const pm_impact_course *x) { return x->b != 0 ? x->a / fabs(x->b) : INFINITY; }

/* A contact that slips so that its friction draws it, or would with a little more of it. */
static int is_near(const pm_workspace *w, const pm_contact_system *x, int i)
{
    const int contact = pm_contact_of_slot(w->model, x->slot[i]);
    if (!pm_contact_modes_slides(w->blow->resting[x->slot[i]])) return 0;
    if (pm_contact_friction(w->model, contact) != PM_FRICTION_COULOMB) return 0;
    const pm_impact_course one = course_of(w, x, w->blow->course.velocity, i);
    return one.slip * one.b > 0 && one.mu_kinetic >= (1 - PM_JAMMED) * critical(&one);
}

int pm_impact_jammed(pm_workspace *w)
{
    pm_blow *b = w->blow;
    pm_contact_system *x = &b->system;
    const pm_where where = w->result.where;
    int slot = PM_NONE;
    memset(b->share, PM_OUT, (size_t)w->model->nslot);
    for (int i = 0; i < w->model->nslot; i++) {
        b->resting[i] = b->trial[i] = w->state.slot[i].mode;
        if (b->trial[i] == PM_CAPTURED) b->share[i] = PM_JOINED;
    }
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_impact_list(w, b);
    if (!status) pm_impact_pose_course(w, b);
    for (int i = 0; i < x->problem.n && !status && slot == PM_NONE; i++)
        if (is_near(w, x, i)) slot = x->slot[i];
    for (int i = 0; i < w->model->nslot; i++) w->state.slot[i].mode = b->resting[i];
    w->result.where = where;
    pm_frame_look_state(&w->frame, &w->state);
    return pm_active_set_build(w) ? PM_NONE : slot;
}

int pm_impact_others_part(const pm_workspace *w, const pm_blow *b, int slot)
{
    const pm_contact_system *x = &b->system;
    for (int i = 0; i < x->problem.n; i++) {
        const double rate = pm_constraint_times(&w->frame, &x->normal[i], b->after) - x->normal[i].rate;
        if (x->slot[i] != slot && rate < -pm_contact_speed(&w->frame)) return 0;
    }
    return 1;
}

static int has_course(const pm_workspace *w, int contact)
{
    return !w->numbers.massless && PM_CONTACT_ROW(w->model, contact)[PM_CONTACT_TANGENTIAL] == PM_NONE;
}

int pm_impact_follow_shock(pm_workspace *w, pm_blow *b)
{
    pm_contact_system *x = &b->system;
    pm_contact_course *c = &b->course;
    const int contact = pm_contact_of_slot(w->model, b->shock);
    pm_impact_course_end end;
    int i = 0, status = pm_impact_list(w, b);
    if (status) return status;
    pm_impact_pose_course(w, b);
    c->m = 0;
    while (x->slot[i] != b->shock) i++;
    pm_impact_course one = course_of(w, x, c->velocity, i);
    if (w->instant.jams && is_near(w, x, i))
        one.mu_static = one.mu_kinetic = fmax(one.mu_kinetic, critical(&one));
    const int draws =
        has_course(w, contact) && pm_impact_course_draws(&one) && pm_impact_course_follow(&one, &end);
    memset(c->impulse, 0, 2 * (size_t)c->n * sizeof *c->impulse);
    c->limited = b->several = 0;
    if (draws) {
        c->impulse[2 * i] = end.impulse;
        c->impulse[2 * i + 1] = end.ratio * end.impulse;
        if ((status = pm_impact_apply(w, b))) return status;
    }
    if (!draws || !pm_impact_others_part(w, b, b->shock))
        return pm_fail(&w->result, PM_PAINLEVE, PM_TABLE_CONTACT, contact, x->problem.contact[i].rub, c->n);
    pm_impact_record_followed(w, b);
    return PM_OK;
}

/* ---- what it leaves ---- */
void pm_impact_followed_close(pm_workspace *w, const pm_blow *b)
{
    const pm_contact_system *x = &b->system;
    if (!b->followed) return;
    for (int i = 0; i < 2 * x->problem.n; i++)
        pm_ledger_contact(w, direction(x, i), b->course.impulse[i], b->before);
    for (int k = 0; k < b->course.m; k++)
        pm_ledger_contact(w, &b->loaded.along[k], b->course.impulse[2 * x->problem.n + k], b->before);
    w->result.count[PM_COUNT_SHARED_BLOWS] += pm_contact_course_is_shared(&b->course);
    w->result.count[PM_COUNT_LIMITED_BLOWS] += b->course.limited;
}

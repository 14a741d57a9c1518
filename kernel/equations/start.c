/* start.c - the start of a case: drawn, assembled (start_positions.c), set in motion, and looked at.
 *
 * Velocities meet the constraints of joints and of contacts that rest (rough ones hold their tangents too), then what is
 * written.  A constraint that depends on the others must agree with them (else a conflict that names it); directions that
 * stay open are an error for fastened bodies, unless nothing is written of any that are fastened to each other (those
 * rest), and zero for a body on its own. */
#include "equations/start.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/drive.h"
#include "elements/joint.h"
#include "elements/measure.h"
#include "elements/turning_plane.h"
#include "equations/active_set.h"
#include "equations/case.h"
#include "equations/least_change.h"
#include "numerics/islands.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "scene/build.h"
#include "state/frame.h"
#include "state/workspace.h"

/* ---- velocities ---- */
static int any_velocity_written(const pm_model *model, const pm_numbers *numbers)
{
    if (pm_model_is_driven(model)) return 1;
    for (int i = 0; i < model->rows[PM_TABLE_START]; i++)
        if (pm_start_level(model, i) == PM_START_VELOCITY && pm_start_value(model, numbers, i) != 0) return 1;
    return 0;
}

/* Which bodies hang together; the ground joins nobody. */
typedef struct pm_start_bodies {
    int *island;             /* [nbody] islands.h: held to each other, or one written velocity is of both */
    unsigned char *fastened; /* [nbody + 1] */
    unsigned char *written;  /* [nbody] a velocity that is not zero */
} pm_start_bodies;

static void join(const pm_model *model, const pm_start_bodies *x, int a, int b)
{
    if (a != model->nbody && b != model->nbody) pm_islands_join(x->island, a, b);
}

static void fasten(const pm_model *model, const pm_start_bodies *x, const pm_constraint *c)
{
    for (int p = 0; p < pm_constraint_bodies(c); p++) x->fastened[c->body[p]] = 1;
    for (int p = 1; p < pm_constraint_bodies(c); p++) join(model, x, c->body[p - 1], c->body[p]);
}

static void note_written(const pm_model *model, const pm_start_bodies *x, const double *row, double value)
{
    int first = PM_NONE;
    for (int k = 0; k < model->nq; k++) {
        if (row[k] == 0) continue;
        if (first == PM_NONE) first = k / 3;
        join(model, x, first, k / 3);
        if (value != 0) x->written[k / 3] = 1;
    }
}

/* Nothing is written of this body, nor of any that hangs together with it. */
static int left_alone(const pm_model *model, const pm_start_bodies *x, int body)
{
    for (int i = 0; i < model->nbody; i++)
        if (x->written[i] && pm_islands_root(x->island, i) == pm_islands_root(x->island, body)) return 0;
    return 1;
}

static void hold_joints(pm_workspace *w, pm_least_change *s, double *dense, const pm_start_bodies *islands)
{
    const int solved = pm_least_change_block(w, s, PM_START_VELOCITY);
    double miss;
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < n; k++) {
            pm_constraint_kind(c[k].kind)->evaluate(&w->frame, &c[k]);
            fasten(w->model, islands, &c[k]);
            if (solved) continue;
            pm_least_change_take_constraint(w, s, &c[k], c[k].rate, dense, &miss);
        }
    }
}

/* Contacts that touch at the start and never slip, and taut cords, count as joints: the normal, too, unless the start
 * breaks it. */
static void hold_contacts(pm_workspace *w, pm_least_change *s, double *dense, const pm_start_bodies *islands)
{
    double miss;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        pm_constraint c[2];
        const int cord = pm_contact_is_cord(w->model, i);
        if (!cord && pm_contact_friction(w->model, i) != PM_FRICTION_ROUGH) continue;
        if (!pm_contact_touches(&w->frame, &w->state, i, &member)) continue;
        pm_contact_constraint_both(&w->frame, i, w->model->contact_slot[i], member, &c[0], &c[1]);
        for (int k = 0; k < (cord ? 1 : 2); k++) {
            pm_constraint_kind(c[k].kind)->evaluate(&w->frame, &c[k]);
            pm_least_change_take_constraint(w, s, &c[k], c[k].rate, dense, &miss);
            fasten(w->model, islands, &c[k]);
        }
    }
}

/* Of a start value with a gradient, the size that the speeds found so far let it have: what is zero among them is rounded as they
 * are. */
static double size_of(const pm_workspace *w, const double *x, const double *gradient)
{
    const double lever = w->numbers.size;
    double speed = 0, slope = 0;
    for (int k = 0; k < w->model->nq; k++) {
        const double arm = k % 3 == 2 ? lever : 1;
        speed = pm_max(fabs(x[k]) * arm, speed);
        slope = pm_max(fabs(gradient[k]) / arm, slope);
    }
    return slope * speed;
}

static int take_written(pm_workspace *w, pm_least_change *s, double *dense, const pm_start_bodies *islands)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_START]; i++) {
        if (pm_start_level(w->model, i) != PM_START_VELOCITY) continue;
        const double value = pm_start_value(w->model, &w->numbers, i);
        double miss;
        pm_measure_start_gradient(w, pm_start_measure(w->model, i), PM_START_VELOCITY, dense);
        note_written(w->model, islands, dense, value);
        const double size = size_of(w, s->x, dense);
        if (pm_least_change_take(&w->active, &w->saddle, s, dense, value, &miss) ||
            fabs(miss) <= PM_START_AGREES * fmax(size, fabs(value)))
            continue;
        pm_fail(&w->result, PM_START_CONFLICT, PM_TABLE_START, i, value, value - miss);
        return PM_START_CONFLICT;
    }
    return PM_OK;
}

/* Every body's own directions must be settled now; of a body on its own, or left alone, the open ones are set to zero. */
static int settle_rest(pm_workspace *w, pm_least_change *s, double *dense, const pm_start_bodies *islands)
{
    const pm_model *m = w->model;
    int n_free = 0;
    for (int i = 0; i < m->nq; i++) n_free += w->numbers.inverse_mass[i] > 0;
    if (s->block + s->n >= n_free) return PM_OK; /* all is settled */
    for (int i = 0; i < m->nbody; i++)
        for (int k = 2; k >= 0; k--) { /* the spin first, then the velocity of G */
            double miss;
            if (w->numbers.inverse_mass[3 * i + k] == 0) continue;
            memset(dense, 0, (size_t)m->nq * sizeof *dense);
            dense[3 * i + k] = 1;
            const int n = s->n;
            if (!islands->fastened[i] || left_alone(w->model, islands, i)) {
                pm_least_change_take(&w->active, &w->saddle, s, dense, 0, &miss);
                continue;
            }
            pm_orthonormal_rest rest;
            if (pm_least_change_add(&w->active, &w->saddle, s, dense, &rest) > n &&
                rest.left > PM_START_OPEN_PART)
                return pm_fail(&w->result, PM_START_OPEN, PM_TABLE_BODY, i, k, rest.left);
        }
    return PM_OK;
}

/* Solves for the velocities; contacts that rest and never slip hold like joints if `with_contacts`. */
static int solve_velocities(pm_workspace *w, int with_contacts)
{
    const pm_model *m = w->model;
    double *x = w->scratch, *dense = x + m->nq;
    pm_start_bodies islands = {(int *)(void *)(dense + 2 * m->nq), NULL, NULL};
    islands.fastened = (unsigned char *)(islands.island + m->nbody);
    islands.written = islands.fastened + m->nbody + 1;
    pm_least_change s = {.x = x, .across = dense + m->nq};
    memset(x, 0, (size_t)m->nq * sizeof *x);
    pm_islands_begin(islands.island, m->nbody);
    memset(islands.fastened, 0, 2 * (size_t)m->nbody + 1);
    hold_joints(w, &s, dense, &islands);
    if (with_contacts) hold_contacts(w, &s, dense, &islands);
    int status = take_written(w, &s, dense, &islands);
    if (!status) status = settle_rest(w, &s, dense, &islands);
    pm_active_set_clear(&w->active, w->model);
    memcpy(w->state.v, x, (size_t)m->nq * sizeof *x);
    return status;
}

/* A rough contact that touches, neither approaches nor parts, and yet slips: that cannot be. */
static int rough_contact_slips(pm_workspace *w)
{
    pm_frame_look_state(&w->frame, &w->state);
    pm_case_speed(w->model, &w->numbers, w->state.v);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        double rate;
        if (pm_contact_friction(w->model, i) != PM_FRICTION_ROUGH) continue;
        if (!pm_contact_touches(&w->frame, &w->state, i, &member)) continue;
        pm_contact_member_gap(&w->frame, i, member, &rate);
        if (fabs(rate) > PM_START_AGREES * w->numbers.speed) continue;
        if (fabs(pm_contact_member_slip(&w->frame, i, member)) > PM_START_AGREES * w->numbers.speed) return 1;
    }
    return 0;
}

/* Sets w->state.v.  What is written may break a resting contact: that is no contradiction but a blow, or a parting, at
 * t = 0. */
static int set_velocities(pm_workspace *w)
{
    if (!any_velocity_written(w->model, &w->numbers)) return PM_OK; /* at rest */
    const int status = solve_velocities(w, 1);
    if (status != PM_START_CONFLICT) return status;
    const pm_where where = w->result.where;
    if (solve_velocities(w, 0) == PM_OK && !rough_contact_slips(w)) return PM_OK;
    w->result.where = where;
    return status;
}

/* ---- the start ---- */
/* Elements that some event adds are not there yet. */
static void leave_out_added(const pm_model *m, pm_state *s)
{
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++) {
        const int32_t *e = PM_ACTION_ROW(m, i);
        if (e[PM_ACTION_EVENT] == PM_NONE)
            s->absent[pm_model_element(m, e[PM_ACTION_TABLE], e[PM_ACTION_A])] = 1;
    }
}

/* What is prescribed at the start is a number, and a length is greater than 0. */
static int check_prescribed(pm_workspace *w)
{
    if (!pm_model_is_driven(w->model)) return PM_OK;
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        const int is_length = PM_JOINT_ROW(w->model, i)[PM_JOINT_KIND] == PM_JOINT_LENGTH;
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < n; k++) {
            if (c[k].drive == PM_NONE || c[k].prescribes != PM_PRESCRIBES_PLACE) continue;
            const double place = pm_drive_of(&w->frame, &c[k]).place;
            if (!isfinite(place) || (is_length && !(place > 0)))
                return pm_fail(&w->result, PM_BAD_VALUE, PM_TABLE_JOINT, i, place, is_length ? 0 : INFINITY);
        }
    }
    return PM_OK;
}

static void draw(pm_workspace *w)
{
    const pm_model *m = w->model;
    memset(w->state.q, 0, w->state.bytes);
    w->state.t = 0;
    for (int i = 0; i < m->nbody; i++)
        for (int k = 0; k < 3; k++)
            w->state.q[3 * i + k] = w->numbers.value[PM_BODY_ROW(m, i)[PM_BODY_X + k]];
    for (int i = 0; i < m->nbody; i++)
        if (!PM_BODY_ROW(m, i)[PM_BODY_ROTATES]) w->state.q[3 * i + 2] = 0;
    leave_out_added(m, &w->state);
}

/* No contact may overlap at the start. */
static int check_overlap(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        const double gap = pm_contact_gap(&w->frame, &w->state, i, &member);
        if (gap >= -pm_contact_length(&w->frame) || !pm_contact_touches(&w->frame, &w->state, i, &member))
            continue;
        return pm_fail_member(&w->result, PM_PENETRATION, PM_TABLE_CONTACT, i, member, gap,
                              -pm_contact_length(&w->frame));
    }
    return PM_OK;
}

int pm_start(pm_workspace *w, pm_start_report *report)
{
    *report = (pm_start_report){0};
    pm_active_set_clear(&w->active, w->model);
    draw(w);
    pm_frame_look_state(&w->frame, &w->state);
    int status = check_prescribed(w);
    if (!status) status = pm_start_assemble(w, report);
    if (!status) status = pm_start_check_couplings(w);
    if (status) return status;
    pm_active_set_anchor_start(&w->frame, &w->state, &w->state);
    if ((status = set_velocities(w)) || (status = check_overlap(w))) return status;
    pm_frame_look_state(&w->frame, &w->state);
    pm_case_speed(w->model, &w->numbers, w->state.v);
    if ((status = pm_turning_plane_start(w))) return status;
    pm_state_copy(&w->start, &w->state);
    return PM_OK;
}

/* Bodies that are struck: their velocities before and after a blow, and the laws of impulsive motion recomputed from them. */
#ifndef STRUCK_H
#define STRUCK_H

#include "check.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "impact/impact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define MOST 32
#define CLOSE 1e-11

typedef struct blow {
    int jumped;
    double before[MOST], after[MOST];
} blow;

static inline void look(pm_workspace *w, const double *v)
{
    pm_frame_look(&w->frame, 0, w->state.q, v, w->state.z, w->state.memory);
}

static inline double kinetic(pm_workspace *w, const double *v)
{
    look(w, v);
    return pm_frame_kinetic(&w->frame, PM_NONE);
}

/* Gives the assembled scene the velocities v at an instant; contact i rests before if bit i of `resting` is set. */
static inline blow strike(scene *s, const double *v, unsigned resting)
{
    pm_workspace *w = s->w;
    blow x = {.jumped = 0};
    double fastest = 0;
    for (int i = 0; i < w->model->nslot; i++)
        if (!(resting >> i & 1)) w->state.slot[i].mode = PM_OPEN;
    for (int i = 0; i < w->model->nq; i++) {
        w->state.v[i] = x.before[i] = v[i];
        fastest = fmax(fastest, fabs(v[i]));
    }
    w->numbers.speed = fastest;
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_impact(w, &x.jumped);
    EQUAL(status, PM_OK);
    memcpy(x.after, w->state.v, (size_t)w->model->nq * sizeof *v);
    return x;
}

/* M (v' - v) = sum of the impulses, each at its point along its direction: no Jacobian. */
static inline void momentum_balance(scene *s, const blow *x)
{
    pm_workspace *w = s->w;
    const pm_model *m = w->model;
    double sum[MOST] = {0};
    look(w, x->after);
    for (int pass = 0; pass < 2; pass++) {
        const int n = pass ? m->nslot : m->rows[PM_TABLE_JOINT];
        for (int i = 0; i < n; i++) {
            pm_constraint row[PM_JOINT_CONSTRAINTS];
            const int rows = pass ? 2 : pm_joint_constraints(&w->frame, &w->state, i, row);
            if (pass)
                pm_contact_constraint_both(&w->frame, pm_contact_of_slot(m, i), i, w->state.slot[i].member,
                                           &row[0], &row[1]);
            for (int k = 0; k < rows; k++) {
                const double size =
                    pass ? w->impulses.slot[2 * i + k] : w->impulses.joint[m->joint_constraint[i] + k];
                pm_line_of_action a;
                pm_constraint_kind(row[k].kind)->act(&w->frame, &row[k], &a);
                for (int p = 0; p < 2; p++) {
                    const int body = row[k].body[p];
                    if (body == m->nbody) continue;
                    const double *pose = w->frame.pose + 5 * body, sign = p ? -size : size;
                    sum[3 * body] += sign * a.direction[0];
                    sum[3 * body + 1] += sign * a.direction[1];
                    sum[3 * body + 2] += size * a.couple[p] + sign * ((a.at[0] - pose[0]) * a.direction[1] -
                                                                      (a.at[1] - pose[1]) * a.direction[0]);
                }
            }
        }
    }
    for (int i = 0; i < m->nq; i++)
        if (w->numbers.inverse_mass[i] > 0)
            NEAR(sum[i] * w->numbers.inverse_mass[i], x->after[i] - x->before[i], CLOSE);
}

static inline double normal_rate(pm_workspace *w, int slot, const double *v)
{
    double rate;
    look(w, v);
    pm_contact_member_gap(&w->frame, pm_contact_of_slot(w->model, slot), w->state.slot[slot].member, &rate);
    return rate;
}

static inline double slip_rate(pm_workspace *w, int slot, const double *v)
{
    look(w, v);
    return pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, slot), w->state.slot[slot].member);
}

/* A blow that would have gained energy keeps all of it: it lies between two that obey the laws, and obeys their bounds. */
static inline int is_between(scene *s, const blow *x)
{
    const double before = kinetic(s->w, x->before);
    return kinetic(s->w, x->after) > before * (1 - 1e-12) && s->w->impulses.energy_lost < 1e-12 * before;
}

static inline void contact_laws(scene *s, const blow *x, int slot, int rested)
{
    pm_workspace *w = s->w;
    const int contact = pm_contact_of_slot(w->model, slot), friction = pm_contact_friction(w->model, contact);
    const double u = normal_rate(w, slot, x->before), after = normal_rate(w, slot, x->after);
    const double slip_before = slip_rate(w, slot, x->before), slip = slip_rate(w, slot, x->after);
    const double p = w->impulses.slot[2 * slot], f = w->impulses.slot[2 * slot + 1],
                 mu = pm_contact_static(&w->frame, contact);
    CHECK(p >= -CLOSE);
    CHECK(after >= -CLOSE);
    const int between = is_between(s, x);
    if (p > CLOSE && !between)
        NEAR(after, rested ? 0 : -pm_contact_restitution(&w->frame, contact) * u, CLOSE); /* (17.19) */
    if (p <= CLOSE) NEAR(f, 0, CLOSE); /* no normal impulse, no friction */
    if (friction == PM_FRICTION_SMOOTH) EQUAL(f, 0);
    if (friction == PM_FRICTION_ROUGH && p > CLOSE) NEAR(slip, 0, CLOSE);
    const int several = w->model->nslot > 1 && w->impulses.slot[0] > CLOSE && w->impulses.slot[2] > CLOSE;
    if (friction != PM_FRICTION_COULOMB) return;
    CHECK(fabs(f) <= mu * p + CLOSE);
    if (fabs(slip) > CLOSE && p > CLOSE && !between && (several || slip * slip_before >= 0)) {
        NEAR(fabs(f), mu * p, CLOSE); /* one alone whose slip has reversed: tests/kernel/impact_course.c */
        CHECK(f * slip <= CLOSE);
    }
}

static inline void laws(scene *s, const blow *x, unsigned resting)
{
    pm_workspace *w = s->w;
    CHECK(kinetic(w, x->after) <= kinetic(w, x->before) * (1 + 1e-13));
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint row[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, row);
        look(w, x->after);
        for (int k = 0; k < n; k++) NEAR(pm_constraint_rate(&w->frame, &row[k]), 0, CLOSE);
    }
    for (int i = 0; i < w->model->nslot; i++) CHECK(normal_rate(w, i, x->after) >= -CLOSE);
    if (x->jumped != 1) return; /* a sequence: the impulses kept are those of its last blow */
    NEAR(w->impulses.energy_lost, kinetic(w, x->before) - kinetic(w, x->after), CLOSE);
    momentum_balance(s, x);
    for (int i = 0; i < w->model->nslot; i++) contact_laws(s, x, i, resting >> i & 1);
}

/* ---- one rod, one corner ---- */
static inline scene *rod(double angle, double e, int friction, double mu, int ends)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.3, 0, 0.6 * fabs(sin(angle)), angle), line = scene_floor(s, 0);
    for (int i = 0; i < ends; i++) {
        const int end = scene_circle(s, scene_point(s, b, i ? 0.6 : -0.6, 0), 0);
        scene_contact(s, PM_CONTACT_LINE, end, line, 0, e, friction, mu);
    }
    scene_until_time(s, 1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    CHECK(scene_begin(s) == PM_OK);
    return s;
}

#endif

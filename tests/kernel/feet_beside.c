/* Feet beside others of the same body: one that hardly stands open where the bounces of another end rests with it; one that touches
 * and parts takes part in a blow that is not unique without it; one that stands open by a hair holds where it is not unique without. */
#include "check.h"
#include "elements/contact.h"
#include "equations/active_set.h"
#include "events/event.h"
#include "events/last_bounce.h"
#include "impact/contact_modes.h"
#include "impact/impact.h"
#include "numerics/tolerances_impact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/route.h"

#define HIGHER 1.0 /* m, where it starts */

enum { A, B, C };

typedef struct gutter {
    double wide, high, one, other, e, mu;
} gutter;

/* A box in a gutter.  Its foot A touches the wall `one`, and foot B is open by a hair; C leans on the other wall, across from B: as
 * the box turns about C, B moves along its wall. */
static scene *in_gutter(const gutter *x, double hair, double place[3][2])
{
    const double angle = x->one + hair / x->wide, c = cos(angle), d = sin(angle);
    const double mark[3][2] = {
        {-0.5 * x->wide, -0.5 * x->high}, {0.5 * x->wide, -0.5 * x->high}, {0.5 * x->wide, 0.5 * x->high}};
    const double n[2][2] = {{-sin(x->one), cos(x->one)}, {-sin(x->other), cos(x->other)}};
    double gap[2];
    for (int i = 0; i < 3; i++) {
        place[i][0] = c * mark[i][0] - d * mark[i][1];
        place[i][1] = d * mark[i][0] + c * mark[i][1];
    }
    for (int k = 0; k < 2; k++) gap[k] = -n[k][0] * place[2 * k][0] - n[k][1] * place[2 * k][1];
    const double det = n[0][0] * n[1][1] - n[0][1] * n[1][0],
                 at[2] = {(gap[0] * n[1][1] - gap[1] * n[0][1]) / det,
                          (gap[1] * n[0][0] - gap[0] * n[1][0]) / det};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) place[i][k] += at[k];
    scene *s = scene_create();
    const int box =
        scene_body(s, 1, (x->wide * x->wide + x->high * x->high) / 12, at[0], at[1] + HIGHER, angle);
    for (int i = 0; i < 3; i++)
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, box, mark[i][0], mark[i][1]), 0),
                      scene_floor(s, i < C ? x->one : x->other), 0, x->e, PM_FRICTION_COULOMB, x->mu);
    scene_until_time(s, 1);
    return s;
}

/* A is struck, slowly after others; C sticks.  `part` of the height of bounces that are left out is open at B. */
static void foot_beside(double part)
{
    const gutter x = {check_random(0.1, 0.5),
                      check_random(0.05, 0.5),
                      -check_random(0.8, 1.2),
                      check_random(0.6, 0.9),
                      0.5,
                      0.9};
    double place[3][2], hair = 0;
    int jumped = 0;
    for (int round = 0; round < 2; round++) { /* the first tells the height */
        scene *s = in_gutter(&x, hair, place);
        EQUAL(scene_begin(s), PM_OK);
        pm_workspace *w = s->w;
        w->phase.route = &pm_route_path;
        for (int i = 0; i < w->model->nslot; i++) w->state.slot[i].mode = i == C ? PM_STICK : PM_OPEN;
        w->event->series[A].known = w->event->series[B].known = 3;
        for (int k = 0; k < 2; k++) hair = part * pm_last_bounce_height(w, B);
        const double turns = 1e-5 * w->numbers.speed / x.wide;
        w->state.q[1] -= HIGHER;
        w->state.v[0] = -turns * (w->state.q[1] - place[C][1]);
        w->state.v[1] = turns * (w->state.q[0] - place[C][0]);
        w->state.v[2] = turns;
        pm_frame_look_state(&w->frame, &w->state);
        if (round > 0) {
            EQUAL(pm_impact(w, &jumped), PM_OK);
            EQUAL(jumped, 1);
            CHECK(w->state.slot[A].mode != PM_OPEN && w->state.slot[C].mode != PM_OPEN);
            EQUAL(w->state.slot[B].mode != PM_OPEN, part < 1);
        }
        scene_free(s);
    }
}

/* Velocities with these rates of the feet off their walls. */
static void set_rates(pm_workspace *w, const gutter *x, double place[3][2], const double rate[3])
{
    const double n[2] = {-sin(x->one), cos(x->one)}, t[2] = {cos(x->one), sin(x->one)},
                 c[2] = {-sin(x->other), cos(x->other)}, turns = (rate[B] - rate[A]) / x->wide;
    const double high[2] = {place[C][0] - place[B][0], place[C][1] - place[B][1]},
                 arm[2] = {w->state.q[0] - place[B][0], w->state.q[1] - place[B][1]};
    const double across = rate[B] * (n[0] * c[0] + n[1] * c[1]) + turns * (high[0] * c[1] - high[1] * c[0]),
                 along = (rate[C] - across) / (t[0] * c[0] + t[1] * c[1]); /* of B */
    w->state.v[0] = rate[B] * n[0] + along * t[0] - turns * arm[1];
    w->state.v[1] = rate[B] * n[1] + along * t[1] + turns * arm[0];
    w->state.v[2] = turns;
}

/* A and C strike while B parts.  Friction may wedge the box between A and C in several ways; most of them drive B into its wall, and
 * with it there is one.  Nothing approaches after the blow, and no energy is gained. */
static int parting_foot_takes_part(void)
{
    const gutter x = {check_random(0.1, 0.5), check_random(0.05, 0.5),          -check_random(0.8, 1.2),
                      check_random(0.6, 0.9), fmax(0, check_random(-0.3, 0.3)), check_random(0.6, 1.5)};
    const double rate[3] = {-check_random(0.1, 1), check_random(0.01, 0.3), -check_random(0.1, 1)};
    double place[3][2];
    int jumped;
    scene *s = in_gutter(&x, 0, place);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    w->state.q[1] -= HIGHER;
    set_rates(w, &x, place, rate);
    for (int i = 0; i < w->model->nslot; i++) w->state.slot[i].mode = PM_OPEN;
    pm_frame_look_state(&w->frame, &w->state);
    const double before = pm_frame_kinetic(&w->frame, PM_NONE);
    const int status = pm_impact(w, &jumped);
    for (int i = 0; i < 3 && !status; i++) {
        double after;
        pm_contact_member_gap(&w->frame, i, 0, &after);
        CHECK(after > -1e-9);
    }
    if (!status) CHECK(pm_frame_kinetic(&w->frame, PM_NONE) <= before * (1 + 1e-12));
    scene_free(s);
    return status;
}

/* m/s^2, of a foot off its wall as the body starts to move. */
static double rise(const pm_workspace *w, const gutter *x, const double place[2], int foot)
{
    const double angle = foot < C ? x->one : x->other, *a = w->frame.a;
    return -sin(angle) * (a[0] - a[2] * (place[1] - w->state.q[1])) +
           cos(angle) * (a[1] + a[2] * (place[0] - w->state.q[0]));
}

static void lie_on_two(pm_workspace *w)
{
    memset(w->state.v, 0, 3 * sizeof(double));
    memset(w->instant.slot_released, 0, (size_t)w->model->nslot);
    for (int i = 0; i < 3; i++) w->state.slot[i].mode = i == B ? PM_OPEN : PM_STICK;
    pm_frame_look_state(&w->frame, &w->state);
    for (int i = 0; i < 3; i++) pm_active_set_anchor(&w->frame, &w->state, i);
}

/* It lies still on A and C, which friction may hold, or not; B is open by `part` of what stays near.  Where several motions are
 * allowed without B, and B is near, there is one with it that drives no foot into its wall.  1 if it stays at rest then. */
static int still_foot_beside(double part)
{
    const gutter x = {
        check_random(0.3, 0.5), check_random(0.05, 0.1), -check_random(0.6, 0.9), check_random(0.9, 1.3), 0.5,
        check_random(0.8, 1.2)};
    double place[3][2];
    int still = 0;
    scene *s = in_gutter(&x, 0, place);
    EQUAL(scene_begin(s), PM_OK);
    const double hair = part * PM_NEAR_BESIDE * s->w->numbers.size;
    scene_free(s);
    s = in_gutter(&x, hair, place);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    w->state.q[1] -= HIGHER;
    lie_on_two(w);
    const int several = pm_contact_modes_settle(w) == PM_NOT_UNIQUE;
    lie_on_two(w);
    const int status = several ? pm_contact_modes_settle_beside(w) : PM_OK;
    if (several && (part > 1 || status)) {
        EQUAL(status, PM_NOT_UNIQUE);
        EQUAL(w->state.slot[B].mode, PM_OPEN);
        EQUAL(w->result.where.table, PM_TABLE_CONTACT);
    } else if (several) {
        for (int i = 0; i < 3; i++) CHECK(rise(w, &x, place[i], i) > -1e-6);
        still = fabs(w->frame.a[0]) + fabs(w->frame.a[1]) + x.wide * fabs(w->frame.a[2]) < 1e-6;
    }
    scene_free(s);
    return still;
}

/* Likewise, but B is in the air, and another body stands a hair above a floor: it changes nothing of what is open, and stays off the
 * floor.  1 where several motions are allowed. */
static int closed_in_vain(void)
{
    const gutter x = {
        check_random(0.3, 0.5), check_random(0.05, 0.1), -check_random(0.6, 0.9), check_random(0.9, 1.3), 0.5,
        check_random(0.8, 1.2)};
    double place[3][2], near = 1e-8;
    int several = 0;
    for (int round = 0; round < 2; round++) { /* the first tells what is near */
        scene *s = in_gutter(&x, check_random(1.1, 5) * near, place);
        const int other = scene_body(s, 1, 1, 2, HIGHER, 0);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, other, 0, 0), 0), scene_floor(s, 0),
                      0, 0.5, PM_FRICTION_COULOMB, 0.5);
        EQUAL(scene_begin(s), PM_OK);
        pm_workspace *w = s->w;
        near = PM_NEAR_BESIDE * w->numbers.size;
        w->state.q[1] -= HIGHER;
        w->state.q[4] = check_random(0.1, 0.9) * near;
        lie_on_two(w);
        several = round > 0 && pm_contact_modes_settle_beside(w) == PM_NOT_UNIQUE;
        EQUAL(w->state.slot[3].mode, PM_OPEN);
        scene_free(s);
    }
    return several;
}

int main(void)
{
    int several = 0, held = 0, vain = 0;
    for (int i = 0; i < 1000; i++) vain += closed_in_vain();
    CHECK(vain > 500);
    for (int i = 0; i < 1000; i++) held += still_foot_beside(check_random(0.1, 0.9));
    CHECK(held > 500);
    for (int i = 0; i < 1000; i++) EQUAL(still_foot_beside(check_random(1.1, 5)), 0);
    for (int i = 0; i < 100; i++) foot_beside(check_random(0.2, 0.9));
    for (int i = 0; i < 100; i++) foot_beside(check_random(1.2, 5));
    for (int i = 0; i < 10000; i++) several += parting_foot_takes_part() == PM_NOT_UNIQUE;
    CHECK(several < 25); /* 46 without the foot that parts */
    return check_failures();
}

/* A body comes to rest where the bounces of one foot end: a foot that hardly stands open, and stays so, rests with it. */
#include "check.h"
#include "elements/contact.h"
#include "events/event.h"
#include "events/last_bounce.h"
#include "impact/impact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/route.h"

#define HIGHER 1.0 /* m, where it starts */

enum { A, B, C };

typedef struct gutter {
    double wide, high, one, other;
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
                      scene_floor(s, i < C ? x->one : x->other), 0, 0.5, PM_FRICTION_COULOMB, 0.9);
    scene_until_time(s, 1);
    return s;
}

/* A is struck, slowly after others; C sticks.  `part` of the height of bounces that are left out is open at B. */
static void foot_beside(double part)
{
    const gutter x = {check_random(0.1, 0.5), check_random(0.05, 0.5), -check_random(0.8, 1.2),
                      check_random(0.6, 0.9)};
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

int main(void)
{
    for (int i = 0; i < 100; i++) foot_beside(check_random(0.2, 0.9));
    for (int i = 0; i < 100; i++) foot_beside(check_random(1.2, 5));
    return check_failures();
}

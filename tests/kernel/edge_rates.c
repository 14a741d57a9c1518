/* The gap beside an edge that ends closes at a rate of its own where the mark is beside an end or behind the face. */
#include "check.h"
#include "elements/contact.h"
#include "elements/edge.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define G 9.81

/* By differences, of a circle and an edge that both move and turn. */
static void rates(double radius)
{
    scene *s = scene_create();
    const int slab = scene_body(s, 1, 0.1, 0, 0, 0.4), b = scene_body(s, 1, 0.1, 0.5, 2, 0);
    scene_segment(s, scene_circle(s, scene_point(s, b, 0.2, 0.1), radius),
                  scene_line(s, scene_point(s, slab, 0.1, -0.3), 0.7), -0.5, 1.5, 0, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    pm_workspace *w = s->w;
    const double h = 1e-6;
    for (int n = 0; n < 1000; n++) {
        double *q = w->state.q, *v = w->state.v, gap[3], rate[3];
        for (int i = 0; i < 6; i++) {
            q[i] = check_random(-1.5, 1.5);
            v[i] = check_random(-1, 1);
        }
        for (int k = 0; k < 3; k++) {
            int member;
            for (int i = 0; i < 6 && k > 0; i++) q[i] += h * v[i];
            pm_frame_look_state(&w->frame, &w->state);
            gap[k] = pm_edge_gap(&w->frame, 0, &member);
            rate[k] = pm_edge_gap_rate(&w->frame, 0);
        }
        if (fabs(rate[2] - rate[0]) < 1e-3) NEAR((gap[2] - gap[0]) / (2 * h), rate[1], 1e-6); /* no corner */
    }
    scene_free(s);
}

/* A body on a vertical guide falls past an end of an edge of the ground, close beside it and behind its face: nothing comes near,
 * and no step is short for it. */
static void falls_behind_an_edge(void)
{
    const double beside = exp(check_random(log(1e-8), log(1e-4))), depth = check_random(0.1, 1),
                 high = check_random(0.01, 0.05);
    const int side = check_random(-1, 1) > 0 ? 1 : -1;
    scene *s = scene_create();
    const int b = scene_body(s, check_random(0.5, 5), 0, side * beside, -high, 0),
              p = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER, p,
                scene_line(s, scene_point(s, PM_GROUND, side * beside, 0), 0.5 * acos(-1.)), 0);
    scene_segment(s, scene_circle(s, p, 0), scene_floor(s, 0), side > 0 ? -1 : 0, side > 0 ? 0 : 1, 0,
                  PM_FRICTION_SMOOTH, 0);
    const int y = scene_part(s, PM_MEASURE_POSITION, p, PM_PART_Y);
    const int fallen = scene_when(s, PM_TRIGGER_FALL, scene_minus(s, y, -depth));
    scene_until(s, fallen, 1);
    const int speed = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_Y));
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_PATH;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[speed], -sqrt(2 * G * (depth - high)), 1e-9);
    CHECK(s->count[PM_COUNT_STEPS] < 500);
    scene_free(s);
}

int main(void)
{
    rates(0);
    rates(0.2);
    for (int i = 0; i < 20; i++) falls_behind_an_edge();
    return check_failures();
}

/* Turning, mirroring and rescaling a scene (length, mass, time) turns, mirrors and rescales its answers. */
#include "check.h"
#include "scene.h"
#include "state/workspace.h"

typedef struct view {
    double turn, mirror, length, mass, time;
} view;

enum { ANSWERS = 9 };

/* (x, y) of the plain scene as seen. */
static void seen(const view *w, double x, double y, double scale, double out[2])
{
    const double mx = w->mirror * x * scale, my = y * scale;
    out[0] = cos(w->turn) * mx - sin(w->turn) * my;
    out[1] = sin(w->turn) * mx + cos(w->turn) * my;
}
static double seen_angle(const view *w, double angle)
{
    return w->turn + (w->mirror > 0 ? angle : 2 * acos(0.) - angle);
}
/* A line keeps its free side: its direction turns round in the mirror. */
static double seen_line(const view *w, double angle) { return w->turn + (w->mirror > 0 ? angle : -angle); }

static int body(scene *s, const view *w, double mass, double inertia, double x, double y, double angle)
{
    double p[2];
    seen(w, x, y, w->length, p);
    return scene_body(s, mass * w->mass, inertia * w->mass * w->length * w->length, p[0], p[1],
                      seen_angle(w, angle));
}
static int mark(scene *s, const view *w, int b, double x, double y)
{
    return scene_point(s, b, x * w->length, w->mirror * y * w->length);
}
static int ground(scene *s, const view *w, double x, double y)
{
    double p[2];
    seen(w, x, y, w->length, p);
    return scene_point(s, PM_GROUND, p[0], p[1]);
}

/* Two rods in a chain with a spring, a damper and a follower force; the tip meets a rough wall and slides on it. */
static void answers(const view *w, double out[ANSWERS])
{
    scene *s = scene_create();
    const double force = w->mass * w->length / (w->time * w->time);
    const int a = body(s, w, 1.2, 0.1, 0.5, 0, 0), b = body(s, w, 0.7, 0.04, 1, -0.4, -acos(0.));
    const int tip = mark(s, w, b, 0.4, 0);
    scene_joint(s, PM_JOINT_PIN, mark(s, w, a, -0.5, 0), ground(s, w, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, mark(s, w, b, -0.4, 0), mark(s, w, a, 0.5, 0), 0);
    scene_force(s, PM_FORCE_SPRING, mark(s, w, a, 0.1, 0.1), ground(s, w, 0.2, 0.9), 20 * force / w->length,
                0.5 * w->length);
    scene_force(s, PM_FORCE_DAMPER, tip, ground(s, w, 2, 0), 0.3 * force / w->length * w->time, 0);
    scene_applied(s, tip, b, SCENE_PROGRAM(s, scene_k(s, 0.3 * force)),
                  SCENE_PROGRAM(s, scene_k(s, w->mirror * 0.5 * force)));
    const int wall = scene_line(s, ground(s, w, 0.4, 0), seen_line(w, -1.45));
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, tip, 0.05 * w->length), wall, 0, 0.4,
                                PM_FRICTION_COULOMB, 0.3);
    double g[2];
    seen(w, 0, -9.81, w->length / (w->time * w->time), g);
    scene_set(s, PM_SETTING_GRAVITY_X, g[0]);
    scene_set(s, PM_SETTING_GRAVITY_Y, g[1]);
    scene_start_omega(s, a, -0.5 * w->mirror / w->time);
    scene_start_omega(s, b, -2 * w->mirror / w->time);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, c);
    const int at = scene_ask_event(s, scene_read(s, scene_time(s)), strike, 1, 0);
    const int spin = scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, b)), strike, 1, 0);
    const int blow = scene_ask_event(
        s, scene_read(s, scene_part(s, PM_MEASURE_CONTACT_IMPULSE, c, PM_PART_NORM)), strike, 1, 0);
    scene_until_time(s, 0.8 * w->time);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_X));
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, tip, PM_PART_Y));
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    const int kinetic = scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE));
    const int reaction = scene_ask_extreme(
        s, PM_ASK_MAX, scene_read(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM)), PM_NONE);
    const int strikes = scene_ask_count(s, strike);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double px = s->out[x] / w->length, py = s->out[y] / w->length;
    out[0] = s->out[at] / w->time;
    out[1] = s->out[spin] * w->time * w->mirror;
    out[2] = s->out[blow] / (force * w->time);
    out[3] = w->mirror * (cos(w->turn) * px + sin(w->turn) * py);
    out[4] = -sin(w->turn) * px + cos(w->turn) * py;
    out[5] = s->out[omega] * w->time * w->mirror;
    out[6] = s->out[kinetic] / (force * w->length);
    out[7] = s->out[reaction] / force;
    out[8] = s->out[strikes];
    scene_free(s);
}

int main(void)
{
    static const view plain = {0, 1, 1, 1, 1};
    static const view other[] = {
        {1.1, 1, 1, 1, 1},
        {-2.5, 1, 1, 1, 1},
        {0, -1, 1, 1, 1},
        {0.7, -1, 1, 1, 1},
        {0, 1, 1000, 1, 1},
        {0, 1, 1e-3, 1, 1},
        {0, 1, 1, 1e6, 1},
        {0, 1, 1, 1e-6, 1},
        {0, 1, 1, 1, 60},
        {0, 1, 1, 1, 1e-3},
        {2.2, -1, 0.3048, 14.59, 0.1},
    };
    double expected[ANSWERS], got[ANSWERS];
    answers(&plain, expected);
    CHECK(expected[8] >= 1 && expected[2] > 0);
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        answers(&other[i], got);
        for (int k = 0; k < ANSWERS; k++) NEAR(got[k], expected[k], 1e-8 * (1 + fabs(expected[k])));
    }
    return check_failures();
}

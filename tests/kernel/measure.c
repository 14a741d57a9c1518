/* Measures of a state against their definitions: moving frames, other points, momenta, poles, forces and energies. */
#include "elements/measure.h"

#include "check.h"
#include "equations/saddle.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

/* A body and a cart with known places and speeds, free. */
static const double place[2][3] = {{0.3, -0.4, 0.8}, {-1.1, 0.6, -2.2}},
                    speed[2][3] = {{1.5, -0.7, 2.1}, {0.4, 0.9, -1.3}};
#define MASS 2.5
#define INERTIA 0.35

typedef struct free_bodies {
    scene *s;
    int p, o;
} free_bodies;

static free_bodies two(void)
{
    free_bodies x = {.s = scene_create()};
    for (int i = 0; i < 2; i++) scene_body(x.s, MASS + i, INERTIA + i, place[i][0], place[i][1], place[i][2]);
    x.p = scene_point(x.s, 0, 0.2, 0.1);
    x.o = scene_point(x.s, PM_GROUND, 0.7, 0.9);
    return x;
}

static double value_of(free_bodies *x, int measure)
{
    double value = NAN;
    if (CHECK(scene_begin(x->s) == PM_OK)) {
        pm_workspace *w = x->s->w;
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < 3; k++) w->state.v[3 * i + k] = speed[i][k];
        pm_frame_look_state(&w->frame, &w->state);
        CHECK(pm_saddle_accelerate(w) == PM_OK);
        value = pm_measure(w, measure);
    }
    return value;
}

static double scalar(int kind, int a, int column, int option)
{
    free_bodies x = two();
    const double value =
        value_of(&x, column < 0 ? scene_measure(x.s, kind, a)
                                : scene_measure_with(x.s, kind, a, PM_PART_NONE, column, option));
    scene_free(x.s);
    return value;
}

/* Both parts of a vector at point 0 (of body 0). */
static void vector(int kind, int a, int in, double out[2])
{
    for (int k = 0; k < 2; k++) {
        free_bodies x = two();
        out[k] = value_of(&x, scene_measure_with(x.s, kind, a, PM_PART_X + k, PM_MEASURE_IN, in));
        scene_free(x.s);
    }
}

static void points(void)
{
    const double c = cos(0.8), d = sin(0.8), r[2] = {0.2 * c - 0.1 * d, 0.2 * d + 0.1 * c};
    const double p[2] = {0.3 + r[0], -0.4 + r[1]}, v[2] = {1.5 - 2.1 * r[1], -0.7 + 2.1 * r[0]};
    double out[2];
    vector(PM_MEASURE_POSITION, 0, PM_NONE, out);
    for (int k = 0; k < 2; k++) NEAR(out[k], p[k], 1e-15);
    vector(PM_MEASURE_VELOCITY, 0, PM_NONE, out);
    for (int k = 0; k < 2; k++) NEAR(out[k], v[k], 1e-15);
    vector(PM_MEASURE_ACCELERATION, 0, PM_NONE, out);
    NEAR(out[0], -2.1 * 2.1 * r[0], 1e-14);
    NEAR(out[1], -9.81 - 2.1 * 2.1 * r[1], 1e-14);
    vector(PM_MEASURE_POLE, 0, PM_NONE, out);
    NEAR(out[0], 0.3 + 0.7 / 2.1, 1e-15);
    NEAR(out[1], -0.4 + 1.5 / 2.1, 1e-15);
    /* seen from body 1: differences of where it is in that body's axes */
    double then[2][2];
    for (int side = 0; side < 2; side++) {
        const double dt = side ? 1e-6 : -1e-6, a = place[1][2] + dt * speed[1][2];
        const double x = p[0] + dt * v[0] - place[1][0] - dt * speed[1][0],
                     y = p[1] + dt * v[1] - place[1][1] - dt * speed[1][1];
        then[side][0] = cos(a) * x + sin(a) * y;
        then[side][1] = -sin(a) * x + cos(a) * y;
    }
    vector(PM_MEASURE_POSITION, 0, 1, out);
    for (int k = 0; k < 2; k++) NEAR(out[k], 0.5 * (then[0][k] + then[1][k]), 1e-11);
    vector(PM_MEASURE_VELOCITY, 0, 1, out);
    for (int k = 0; k < 2; k++) NEAR(out[k], (then[1][k] - then[0][k]) / 2e-6, 1e-9);
}

static void bodies(void)
{
    NEAR(scalar(PM_MEASURE_ANGLE, 0, PM_MEASURE_IN, 1), 3.0, 1e-15);
    NEAR(scalar(PM_MEASURE_OMEGA, 0, PM_MEASURE_IN, 1), 3.4, 1e-15);
    NEAR(scalar(PM_MEASURE_OMEGA, 0, -1, 0), 2.1, 0);
    NEAR(scalar(PM_MEASURE_ALPHA, 0, -1, 0), 0, 1e-15);
    NEAR(scalar(PM_MEASURE_MASS, PM_NONE, -1, 0), 2 * MASS + 1, 0);
    NEAR(scalar(PM_MEASURE_WEIGHT, 1, -1, 0), 9.81 * (MASS + 1), 1e-14);
    NEAR(scalar(PM_MEASURE_INERTIA, 0, PM_MEASURE_ABOUT, 1), INERTIA + MASS * (0.16 + 1.69),
         1e-14); /* point 1: (0.7, 0.9) */
    const double t0 = 0.5 * (MASS * (2.25 + 0.49) + INERTIA * 4.41),
                 t1 = 0.5 * ((MASS + 1) * (0.16 + 0.81) + (INERTIA + 1) * 1.69);
    NEAR(scalar(PM_MEASURE_KINETIC, 0, -1, 0), t0, 1e-14);
    NEAR(scalar(PM_MEASURE_KINETIC, PM_NONE, -1, 0), t0 + t1, 1e-14);
    NEAR(scalar(PM_MEASURE_POTENTIAL, PM_NONE, -1, 0), 9.81 * (-0.4 * MASS + 0.6 * (MASS + 1)), 1e-14);
    NEAR(scalar(PM_MEASURE_TOTAL, PM_NONE, -1, 0), t0 + t1 + 9.81 * (-0.4 * MASS + 0.6 * (MASS + 1)), 1e-13);
    NEAR(scalar(PM_MEASURE_ANGULAR_MOMENTUM, 0, -1, 0), INERTIA * 2.1, 1e-15);
    const double h0 = INERTIA * 2.1 + MASS * (0.3 * -0.7 + 0.4 * 1.5),
                 h1 = -(INERTIA + 1) * 1.3 + (MASS + 1) * (-1.1 * 0.9 - 0.6 * 0.4);
    NEAR(scalar(PM_MEASURE_ANGULAR_MOMENTUM, PM_NONE, -1, 0), h0 + h1, 1e-14);
    NEAR(scalar(PM_MEASURE_ANGULAR_MOMENTUM, 0, PM_MEASURE_ABOUT, 1),
         INERTIA * 2.1 + MASS * (-0.4 * -0.7 + 1.3 * 1.5), 1e-14);
    double out[2];
    vector(PM_MEASURE_MOMENTUM, PM_NONE, PM_NONE, out);
    NEAR(out[0], MASS * 1.5 + (MASS + 1) * 0.4, 1e-14);
    NEAR(out[1], -MASS * 0.7 + (MASS + 1) * 0.9, 1e-14);
}

static void parts(void)
{
    free_bodies x = two();
    const int g = scene_point(x.s, 0, 0, 0);
    NEAR(value_of(&x, scene_part(x.s, PM_MEASURE_VELOCITY, g, PM_PART_NORM)), hypot(1.5, 0.7), 1e-15);
    NEAR(value_of(&x, scene_part(x.s, PM_MEASURE_VELOCITY, g, PM_PART_ANGLE)), atan2(-0.7, 1.5), 1e-15);
    const int along = scene_measure_with(x.s, PM_MEASURE_VELOCITY, g, PM_PART_ALONG, PM_MEASURE_VALUE,
                                         scene_value(x.s, 0.6));
    NEAR(value_of(&x, along), 1.5 * cos(0.6) - 0.7 * sin(0.6), 1e-15);
    scene_free(x.s);
}

/* A wheel at rest on a slope, held by a rope: reactions are known, on either partner. */
static void reactions(void)
{
    const double angle = 0.4, r = 0.3, m = 2, g = 9.81;
    scene *s = scene_create();
    const int b = scene_body(s, m, 0.5 * m * r * r, -r * sin(angle), r * cos(angle), 0),
              c = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, c, r), scene_floor(s, angle), 0);
    scene_joint(s, PM_JOINT_LINK, c,
                scene_point(s, PM_GROUND, 2 * cos(angle) - r * sin(angle), 2 * sin(angle) + r * cos(angle)),
                2);
    const int normal = scene_measure(s, PM_MEASURE_JOINT_NORMAL, 0),
              friction = scene_measure(s, PM_MEASURE_JOINT_FRICTION, 0);
    const int needed = scene_measure(s, PM_MEASURE_JOINT_FRICTION_NEEDED, 0);
    const int rope = scene_part(s, PM_MEASURE_JOINT_FORCE, 1, PM_PART_X);
    const int on_ground =
        scene_measure_with(s, PM_MEASURE_JOINT_FORCE, 1, PM_PART_X, PM_MEASURE_ON, PM_GROUND);
    if (CHECK(scene_begin(s) == PM_OK)) {
        NEAR(pm_measure(s->w, normal), m * g * cos(angle), 1e-13);
        NEAR(pm_measure(s->w, friction), 0, 1e-13);
        NEAR(pm_measure(s->w, needed), 0, 1e-13);
        NEAR(pm_measure(s->w, rope), m * g * sin(angle) * cos(angle), 1e-13);
        NEAR(pm_measure(s->w, on_ground), -m * g * sin(angle) * cos(angle), 1e-13);
    }
    scene_free(s);
}

/* Work, power and energy of a spring and a damper over a run: what the spring gives is what is kept or lost. */
static void work(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1.5, 0, 1.3, 0, 0), p = scene_point(s, b, 0, 0),
              o = scene_point(s, PM_GROUND, 0, 0);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int spring = scene_force(s, PM_FORCE_SPRING, p, o, 40, 1),
              damper = scene_force(s, PM_FORCE_DAMPER, p, o, 0.8, 0);
    scene_joint(s, PM_JOINT_SLIDER, p, scene_floor(s, 0), 0);
    scene_until_time(s, 0.7);
    const int kept = scene_ask_measure(s, scene_measure(s, PM_MEASURE_KINETIC, PM_NONE));
    const int of_spring = scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, spring));
    const int of_damper = scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_WORK, damper));
    const int stretch = scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_STRETCH, spring));
    const int energy = scene_ask_measure(s, scene_measure(s, PM_MEASURE_FORCE_ENERGY, spring));
    const int pull = scene_ask_measure(s, scene_part(s, PM_MEASURE_FORCE_FORCE, spring, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double decay = 0.8 / 3, beat = sqrt(40 / 1.5 - decay * decay), t = 0.7;
    const double x = 0.3 * exp(-decay * t) * (cos(beat * t) + decay / beat * sin(beat * t));
    NEAR(s->out[stretch], x, 1e-10);
    NEAR(s->out[energy], 20 * x * x, 1e-9);
    NEAR(s->out[pull], -40 * x, 1e-9);
    NEAR(s->out[of_spring], 20 * (0.09 - x * x), 1e-9);
    NEAR(s->out[of_spring] + s->out[of_damper], s->out[kept], 1e-9);
    CHECK(s->out[of_damper] < 0);
    scene_free(s);
}

/* Springs that only pull or only push. */
static void one_way_springs(void)
{
    for (int only = PM_SPRING_BOTH; only <= PM_SPRING_PUSH; only++)
        for (int side = -1; side <= 1; side += 2) {
            scene *s = scene_create();
            const int p = scene_point(s, scene_body(s, 1, 0, 1 + 0.2 * side, 0, 0), 0, 0);
            const int f = scene_force(s, PM_FORCE_SPRING, p, scene_point(s, PM_GROUND, 0, 0), 10, 1);
            s->cell[PM_TABLE_FORCE][PM_FORCE_OPTION] = only;
            const int pull = scene_part(s, PM_MEASURE_FORCE_FORCE, f, PM_PART_X);
            const int works = only == PM_SPRING_BOTH || (only == PM_SPRING_PULL) == (side > 0);
            if (CHECK(scene_begin(s) == PM_OK)) NEAR(pm_measure(s->w, pull), works ? -2 * side : 0, 1e-14);
            scene_free(s);
        }
}

int main(void)
{
    points();
    bodies();
    parts();
    reactions();
    work();
    one_way_springs();
    return check_failures();
}

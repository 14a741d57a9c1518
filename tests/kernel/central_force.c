/* Forces that read a distance: orbits about a centre against Kepler's equation, with the law in three forms; energy and angular
 * momentum of other powers; flights that meet a soft disc late, or pass it.  Steps are as many as the motion needs. */
#include "check.h"
#include "scene.h"

#define CASES 60
#define OP(name) scene_op(PM_OP_##name)
#define X scene_m(p->place[0])
#define Y scene_m(p->place[1])
#define K(x) scene_k(p->s, x)

typedef struct particle {
    scene *s;
    int point, place[2], speed[2], out[4]; /* of place and velocity at the end */
} particle;

static particle particle_at(double x, double y, double vx, double vy)
{
    particle p = {.s = scene_create()};
    scene_set(p.s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(p.s, PM_SETTING_MAX_STEPS) = 2000;
    p.point = scene_point(p.s, scene_body(p.s, 1, 0, x, y, 0), 0, 0);
    for (int i = 0; i < 2; i++) {
        p.place[i] = scene_part(p.s, PM_MEASURE_POSITION, p.point, PM_PART_X + i);
        p.speed[i] = scene_part(p.s, PM_MEASURE_VELOCITY, p.point, PM_PART_X + i);
        p.out[i] = scene_ask_measure(p.s, p.place[i]);
        p.out[2 + i] = scene_ask_measure(p.s, p.speed[i]);
    }
    scene_start_velocity(p.s, p.point, vx, vy);
    return p;
}

/* Runs to t; what is left of the particle is p->s->out[]. */
static void run(particle *p, double t, int most_steps)
{
    scene_until_time(p->s, t);
    EQUAL(scene_run(p->s, NULL), PM_OK);
    if (!CHECK(p->s->count[PM_COUNT_STEPS] <= most_steps))
        fprintf(stderr, "%d steps, not %d\n", (int)p->s->count[PM_COUNT_STEPS], most_steps);
}

static double out(const particle *p, int i) { return p->s->out[p->out[i]]; }

/* ---- laws ---- */
/* f / r^power towards the origin, along the line to it. */
static void draw(particle *p, double f, double power)
{
    const int origin = scene_point(p->s, PM_GROUND, 0, 0);
    scene_line_force(p->s, p->point, origin,
                     SCENE_PROGRAM(p->s, K(f), X, Y, OP(HYPOT), K(power), OP(POW), OP(DIV)));
}

/* f / (x^2 + y^2) */
static void draw_by_squares(particle *p, double f)
{
    const int origin = scene_point(p->s, PM_GROUND, 0, 0);
    scene_line_force(p->s, p->point, origin,
                     SCENE_PROGRAM(p->s, K(f), X, K(2), OP(POW), Y, K(2), OP(POW), OP(ADD), OP(DIV)));
}

/* -f (x, y) / r^3 */
static void draw_by_parts(particle *p, double f)
{
    int part[2];
    for (int i = 0; i < 2; i++)
        part[i] = SCENE_PROGRAM(p->s, K(-f), scene_m(p->place[i]), OP(MUL), X, Y, OP(HYPOT), K(3), OP(POW),
                                OP(DIV));
    scene_applied(p->s, p->point, PM_GROUND, part[0], part[1]);
}

/* ---- orbits ---- */
/* E - e sin E = mean */
static double eccentric_anomaly(double mean, double e)
{
    double low = mean - 1, high = mean + 1;
    for (int i = 0; i < 100; i++) {
        const double middle = 0.5 * (low + high);
        if (middle - e * sin(middle) < mean)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Of half axis 1, from the far end on, by the force f / r^2. */
static void orbit(double e, int law)
{
    const double f = check_random(1, 40), t = check_random(5, 12) / sqrt(f);
    const double pi = 4 * atan(1), at = eccentric_anomaly(pi + sqrt(f) * t, e);
    particle p = particle_at(1 + e, 0, 0, sqrt(f * (1 - e) / (1 + e)));
    if (law == 0) draw(&p, f, 2);
    if (law == 1) draw_by_squares(&p, f);
    if (law == 2) draw_by_parts(&p, f);
    run(&p, t, 5 + (int)(14.5 * sqrt(f / (1 - e)) * t)); /* 13.3 for a radian of a circle */
    NEAR(out(&p, 0), e - cos(at), 1e-9 / (1 - e));
    NEAR(out(&p, 1), -sqrt(1 - e * e) * sin(at), 1e-9 / (1 - e));
    scene_free(p.s);
}

/* Any power, drawn or pushed off: energy and angular momentum stay. */
static void other_power(void)
{
    const double power = check_random(1.2, 2.8), f = check_random(-6, 6), x = check_random(0.5, 2),
                 v[2] = {check_random(-0.5, 0.5), check_random(1, 3)};
    particle p = particle_at(x, 0, v[0], v[1]);
    draw(&p, f, power);
    run(&p, 2, 1100);
    const double r = hypot(out(&p, 0), out(&p, 1)), potential = -f / (power - 1);
    const double before = 0.5 * (v[0] * v[0] + v[1] * v[1]) + potential * pow(x, 1 - power);
    const double after =
        0.5 * (out(&p, 2) * out(&p, 2) + out(&p, 3) * out(&p, 3)) + potential * pow(r, 1 - power);
    NEAR(after, before, 1e-8 * (1 + fabs(potential)));
    NEAR(out(&p, 0) * out(&p, 3) - out(&p, 1) * out(&p, 2), x * v[1], 1e-9);
    scene_free(p.s);
}

/* ---- a soft disc ---- */
/* 1 where the particle is within a distance of the origin. */
static int inside(particle *p, double radius)
{
    const int event = SCENE_ROW(p->s, PM_TABLE_EVENT, 0, PM_EFFECT_SWITCH),
              deep = SCENE_PROGRAM(p->s, K(radius), X, Y, OP(HYPOT), OP(SUB));
    scene_trigger(p->s, PM_TRIGGER_RISE, event, deep, PM_NONE);
    scene_trigger(p->s, PM_TRIGGER_FALL, event, deep, PM_NONE);
    return scene_measure(p->s, PM_MEASURE_EVENT_SIDE, event);
}

/* Flies 10 m to it at 1 m/s, with the offset y; off it goes at the same speed, with the same moment, or passes by. */
static void soft_disc(double radius, double y)
{
    const double stiffness = 1e5;
    particle p = particle_at(-10, y, 1, 0), *x = &p;
    const int side = inside(x, radius);
    int part[2];
    for (int i = 0; i < 2; i++)
        part[i] = SCENE_PROGRAM(x->s, scene_k(x->s, stiffness), scene_m(side), OP(MUL), scene_k(x->s, radius),
                                scene_m(x->place[0]), scene_m(x->place[1]), OP(HYPOT), OP(SUB), OP(MUL),
                                scene_m(x->place[i]), OP(MUL), scene_m(x->place[0]), scene_m(x->place[1]),
                                OP(HYPOT), OP(DIV));
    scene_applied(x->s, x->point, PM_GROUND, part[0], part[1]);
    run(x, 15, 90);
    NEAR(hypot(out(x, 2), out(x, 3)), 1, 1e-9);
    NEAR(out(x, 0) * out(x, 3) - out(x, 1) * out(x, 2), -y, 1e-8);
    if (fabs(y) >= radius) {
        NEAR(out(x, 0), 5, 1e-12); /* no force, not even by rounding */
        EQUAL(out(x, 3), 0);
    }
    scene_free(x->s);
}

int main(void)
{
    for (int i = 0; i < CASES; i++) {
        orbit(i < 3 ? 0 : i < 9 ? pow(10, check_random(-6, -1)) : check_random(0, 0.95), i % 3);
        other_power();
        const double radius = check_random(0.05, 0.3);
        soft_disc(radius, check_random(-1, 1) * (i % 4 ? radius : 1));
    }
    return check_failures();
}

/* time_course.c - forces that act for a short time on a free particle, beside their integrals: rectangles, bells and half sines
 * of a width from a millionth of the run to a tenth of it, anywhere, on both routes in time; kicks at all but the same time. */
#include "check.h"
#include "pulses.h"

#define END 1.0   /* s */
#define CASES 100 /* pulses of each shape and route */
#define MISS 1e-6 /* of the impulse: no error of a method that has seen all of it */
#define WAVE 40.0 /* rad/s: something to follow beside the pulse */

enum { RECTANGLE, BELL, HALF_SINE, SHAPES };

/* What a pulse gives to 1 kg up to the end, m/s. */
static double integral(const pulse *p)
{
    const double low = (0 - p->middle) / p->width, high = (END - p->middle) / p->width;
    const double from = fmax(low, -0.5), to = fmin(high, 0.5);
    switch (p->shape) {
    case RECTANGLE: return p->impulse * (to - from);
    case BELL: return p->impulse * 0.5 * sqrt(pi()) * (erf(high) - erf(low));
    default: return p->impulse * (sin(pi() * to) - sin(pi() * from)) / pi();
    }
}

/* A force that is one pulse; across it a wave, so that steps are not as long as the run. */
static scene *pushed(const pulse *p, int route, int *out)
{
    static int (*const program[SHAPES])(scene *, int, const pulse *) = {pulse_rectangle, pulse_bell,
                                                                        pulse_half_sine};
    scene *s = scene_create();
    const int t = scene_time(s), point = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
    const int wave = SCENE_PROGRAM(s, scene_m(t), scene_k(s, WAVE), scene_op(PM_OP_MUL), scene_op(PM_OP_SIN));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_applied(s, point, PM_GROUND, program[p->shape](s, t, p), wave);
    *out = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_X));
    scene_until_time(s, END);
    return s;
}

static int is_seen(const pulse *p, int route)
{
    int out;
    scene *s = pushed(p, route, &out);
    const int status = scene_run(s, NULL);
    const int seen = status == PM_OK && fabs(s->out[out] - integral(p)) <= MISS * p->impulse;
    if (!seen)
        fprintf(stderr, "route %d, shape %d, %.9g N s at %.9g s, %.6g s wide: status %d, %.9g, not %.9g\n",
                route, p->shape, p->impulse, p->middle, p->width, status, s->out[out], integral(p));
    scene_free(s);
    return seen;
}

static void check_pulses(int route)
{
    int missed[SHAPES] = {0};
    for (int k = 0; k < SHAPES * CASES; k++) {
        const pulse p = {k % SHAPES, check_random(0.1, 1), check_random(0, END),
                         pow(10, check_random(-6, -1))};
        missed[p.shape] += !is_seen(&p, route);
    }
    EQUAL(missed[RECTANGLE], 0);
    EQUAL(missed[BELL], 0);
    EQUAL(missed[HALF_SINE], 0);
}

/* Its middle is one of nine samples of the run, by chance: these alone say that the force is constant. */
static void a_pulse_with_a_sample_in_it(int route)
{
    for (int i = 1; i < 8; i++) {
        const pulse p = {BELL, 0.5, END * i / 8 + 1e-7, 2e-6};
        CHECK(is_seen(&p, route));
    }
}

/* Two kicks, the second so little later that no step fits between them: both are given, whatever the route. */
static void kicks_next_to_each_other(int route)
{
    for (int k = 0; k < 4; k++) {
        const double first = 0.5 * END, later = first * (1 + k * 2.2e-16);
        scene *s = scene_create();
        const int t = scene_time(s), point = scene_point(s, scene_body(s, 1, 0, 0, 0, 0), 0, 0);
        const int wave =
            SCENE_PROGRAM(s, scene_m(t), scene_k(s, WAVE), scene_op(PM_OP_MUL), scene_op(PM_OP_SIN));
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        scene_applied(s, point, PM_GROUND, SCENE_PROGRAM(s, scene_k(s, 0)), wave);
        for (int i = 0; i < 2; i++)
            SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_IMPULSE,
                      scene_when(s, PM_TRIGGER_RISE, scene_minus(s, t, i ? later : first)), PM_NONE, point,
                      SCENE_PROGRAM(s, scene_k(s, 1 + i)), SCENE_PROGRAM(s, scene_k(s, 0)));
        const int out = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, point, PM_PART_X));
        scene_until_time(s, END);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[out], 3, 1e-12);
        scene_free(s);
    }
}

int main(void)
{
    static const int route[] = {PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 2; i++) {
        check_pulses(route[i]);
        a_pulse_with_a_sample_in_it(route[i]);
        kicks_next_to_each_other(route[i]);
    }
    return check_failures();
}

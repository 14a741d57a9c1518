/* Enclosures: random programs of the time over random stretches hold every value, rate and bend that is found in them, and
 * a switch that changes is open; a pulse, however narrow, is in the enclosure of its stretch. */
#include "expression/enclosure.h"

#include "check.h"
#include "expression/program.h"
#include "scene.h"

static int pick(int n) { return (int)check_random(0, n); }

static const int unary[] = {PM_OP_NEG,  PM_OP_SIN,  PM_OP_COS,   PM_OP_TAN,  PM_OP_ASIN,
                            PM_OP_ACOS, PM_OP_ATAN, PM_OP_TANH,  PM_OP_SQRT, PM_OP_ABS,
                            PM_OP_EXP,  PM_OP_LOG,  PM_OP_FLOOR, PM_OP_NOT,  PM_OP_PIECEWISE};
static const int binary[] = {PM_OP_ADD, PM_OP_SUB, PM_OP_MUL, PM_OP_DIV, PM_OP_POW,   PM_OP_LT,   PM_OP_GE,
                             PM_OP_AND, PM_OP_OR,  PM_OP_MIN, PM_OP_MAX, PM_OP_HYPOT, PM_OP_ATAN2};

/* A random expression of that depth: its code from code[n] on; how long it is then. */
static int write(scene *s, int time, int depth, scene_code *code, int n)
{
    const int kind = depth == 0 ? pick(3) : 2 + pick(8);
    if (depth == 0) {
        code[n++] = kind == 0 ? scene_k(s, check_random(-3, 3)) : scene_m(time);
    } else if (kind < 5) {
        n = write(s, time, depth - 1, code, n);
        const int op = unary[pick(15)];
        if (op == PM_OP_EXP) { /* of more than 150 it is taken as that of 150 */
            code[n++] = scene_k(s, 150);
            code[n++] = scene_op(PM_OP_MIN);
        }
        code[n++] = scene_op(op);
    } else if (kind < 9) {
        n = write(s, time, depth - 1, code, n);
        n = write(s, time, pick(depth), code, n);
        code[n++] = scene_op(binary[pick(13)]);
    } else {
        for (int k = 0; k < 3; k++) n = write(s, time, pick(depth), code, n);
        code[n++] = scene_op(PM_OP_SELECT);
    }
    return n;
}

static double value_at(const scene *s, int program, double t, double derivative[2])
{
    return pm_program_of_time(s->model, program, NULL, s->w->numbers.value, t, derivative);
}

/* Points of a stretch without open switches lie in its enclosure; how many were looked at. */
static int look(const scene *s, int program, double from, double to)
{
    const pm_enclosure e = pm_enclosure_of_time(s->model, program, NULL, s->w->numbers.value, from, to);
    double last = NAN, before = NAN;
    if (e.open) return 0;
    for (int k = 0; k < 20; k++) {
        const double t = check_random(from, to);
        double derivative[2];
        const double x = value_at(s, program, t, derivative), small = 1e-12 * (1 + fabs(x)),
                     rate = derivative[0], bend = derivative[1];
        if (!(fabs(x) < 1e60 && fabs(rate) < 1e60)) return 0; /* see PM_EXPONENT_MOST */
        CHECK(x >= e.jet.value.lo - small && x <= e.jet.value.hi + small);
        CHECK(rate >= e.jet.rate.lo - 1e-9 * (1 + fabs(rate)) &&
              rate <= e.jet.rate.hi + 1e-9 * (1 + fabs(rate)));
        CHECK(!isfinite(bend) || (bend >= e.jet.bend.lo - 1e-9 * (1 + fabs(bend)) &&
                                  bend <= e.jet.bend.hi + 1e-9 * (1 + fabs(bend))));
        if (k % 2) {
            const double off = fabs(rate - last), most = pm_interval_size(e.jet.bend) * (to - from);
            CHECK(off <= most + 1e-9 * (1 + fabs(rate)));
            CHECK(fabs(x - before) <= pm_interval_size(e.jet.rate) * (to - from) + 1e-9 * (1 + fabs(x)));
        }
        last = rate;
        before = x;
    }
    return 20;
}

/* Cubic pieces that may jump at their knots, and any of what may be beyond them. */
static void random_table(scene *s)
{
    double knot[6], coefficient[5 * 4];
    for (int i = 0; i < 6; i++) knot[i] = (i ? knot[i - 1] : -3) + check_random(0.1, 1.5);
    for (int i = 0; i < 5 * 4; i++) coefficient[i] = check_random(-2, 2);
    scene_piecewise(s, 6, knot, 3, coefficient, pick(PM_BEYOND_KINDS));
}

static void random_programs(void)
{
    int looked = 0;
    for (int i = 0; i < 20000; i++) {
        scene *s = scene_create();
        scene_code code[400];
        random_table(s);
        const int time = scene_time(s), n = write(s, time, 1 + pick(4), code, 0);
        const int program = scene_program(s, n, code);
        if (CHECK(scene_open(s) == PM_OK))
            for (int k = 0; k < 5; k++) {
                const double from = check_random(-4, 4), length = pow(10, check_random(-6, 1));
                looked += look(s, program, from, from + length);
            }
        scene_free(s);
    }
    CHECK(looked > 400000);
}

/* exp(-((t - 50) / w)^2) */
static void a_narrow_pulse(void)
{
    for (double width = 1; width > 1e-9; width *= 0.1) {
        scene *s = scene_create();
        const int time = scene_time(s);
        const int program = SCENE_PROGRAM(s, scene_m(time), scene_k(s, 50), scene_op(PM_OP_SUB),
                                          scene_k(s, width), scene_op(PM_OP_DIV), scene_k(s, 2),
                                          scene_op(PM_OP_POW), scene_op(PM_OP_NEG), scene_op(PM_OP_EXP));
        if (CHECK(scene_open(s) == PM_OK)) {
            const pm_enclosure e = pm_enclosure_of_time(s->model, program, NULL, s->w->numbers.value, 0, 97);
            CHECK(e.open == 0 && e.jet.value.hi >= 1 && e.jet.value.hi < 1.001);
            CHECK(-e.jet.bend.lo >= 2 / (width * width));
        }
        scene_free(s);
    }
}

/* t > 3 is decided beside 3, open around it, and changes there. */
static void a_switch(void)
{
    scene *s = scene_create();
    const int time = scene_time(s);
    const int program = SCENE_PROGRAM(s, scene_m(time), scene_k(s, 3), scene_op(PM_OP_GT));
    if (CHECK(scene_open(s) == PM_OK)) {
        const double *value = s->w->numbers.value, after = nextafter(3, 4);
        CHECK(pm_enclosure_of_time(s->model, program, NULL, value, 0, 3).open == 0);
        CHECK(pm_enclosure_of_time(s->model, program, NULL, value, after, 4).open == 0);
        const pm_enclosure e = pm_enclosure_of_time(s->model, program, NULL, value, 3, after);
        CHECK(e.open == 1 && e.changes == 1);
    }
    scene_free(s);
}

int main(void)
{
    random_programs();
    a_narrow_pulse();
    a_switch();
    return check_failures();
}

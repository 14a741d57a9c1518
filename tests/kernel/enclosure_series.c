/* Bends of programs along a step by series of high order: of random programs of random motions they hold every bend that is
 * found at a place; bells however narrow are in them; on a circle they come near where intervals do not. */
#include "check.h"
#include "expression/enclosure.h"
#include "scene.h"
#include "state/workspace.h"

#define CASES 12000
#define PARTS 6
#define PLACES 12

static const int unary[] = {PM_OP_NEG,  PM_OP_SIN,  PM_OP_COS,  PM_OP_TAN, PM_OP_ASIN, PM_OP_ACOS,
                            PM_OP_ATAN, PM_OP_TANH, PM_OP_SQRT, PM_OP_ABS, PM_OP_EXP,  PM_OP_LOG};
static const int binary[] = {PM_OP_ADD, PM_OP_SUB, PM_OP_MUL,   PM_OP_DIV,  PM_OP_POW,
                             PM_OP_MIN, PM_OP_MAX, PM_OP_HYPOT, PM_OP_ATAN2};

/* A particle, and what is known of it along a step. */
typedef struct motion {
    scene *s;
    int place[2], row[16]; /* measures of its place; where the series of each is */
    pm_chebyshev_series series[2];
    pm_measure_series along;
} motion;

static motion *motion_create(void)
{
    motion *x = calloc(1, sizeof *x);
    if (!x) abort();
    x->s = scene_create();
    const int point = scene_point(x->s, scene_body(x->s, 1, 0, 1, 0, 0), 0, 0);
    for (int i = 0; i < 2; i++) {
        x->place[i] = scene_part(x->s, PM_MEASURE_POSITION, point, PM_PART_X + i);
        x->row[x->place[i]] = i;
    }
    x->along = (pm_measure_series){x->series, x->row};
    return x;
}

static void motion_free(motion *x)
{
    scene_free(x->s);
    free(x);
}

static void move(motion *x, int i, double (*place)(double s, const double *by), const double *by)
{
    const pm_chebyshev_nodes *nodes = &pm_chebyshev_nodes_9;
    double sample[PM_NODES_MOST];
    for (int k = 0; k < nodes->n; k++) sample[k] = place(nodes->at[k], by);
    pm_chebyshev_series_of(&x->series[i], nodes, sample);
}

static double cubic(double s, const double *by) { return by[0] + s * (by[1] + s * (by[2] + s * by[3])); }
static double cosine(double s, const double *by) { return by[0] * cos(by[1] * s + by[2]); }

static pm_interval bends(const motion *x, int program, double from, double to)
{
    return pm_enclosure_bends_along(x->s->model, program, x->s->w->numbers.folded, &x->along, from, to);
}

static pm_jet jet(const motion *x, int program, double from, double to)
{
    return pm_enclosure_along(x->s->model, program, x->s->w->numbers.folded, &x->along, from, to).jet;
}

/* ---- random programs ---- */
static int write(motion *x, int depth, scene_code *code, int n)
{
    const int kind = depth == 0 ? (int)check_random(0, 3) : 3 + (int)check_random(0, 5);
    if (kind == 0) code[n++] = scene_k(x->s, check_random(-3, 3));
    if (kind == 1 || kind == 2) code[n++] = scene_m(x->place[kind - 1]);
    if (kind >= 3) n = write(x, depth - 1, code, n);
    if (kind == 3 || kind == 4) code[n++] = scene_op(unary[(int)check_random(0, 12)]);
    if (kind == 5) {
        code[n++] = scene_k(x->s, (int)check_random(-4, 5));
        code[n++] = scene_op(PM_OP_POW);
    }
    if (kind > 5) {
        n = write(x, (int)check_random(0, depth), code, n);
        code[n++] = scene_op(binary[(int)check_random(0, 9)]);
    }
    return n;
}

/* Whether they are bounded; no bend that is found lies outside. */
static int look(const motion *x, int program, double from, double to)
{
    const pm_interval all = bends(x, program, from, to);
    if (!isfinite(all.lo) || !isfinite(all.hi)) return 0;
    for (int k = 0; k < PLACES; k++) {
        const double s = check_random(from, to);
        const pm_interval here = jet(x, program, s, s).bend;
        if (!isfinite(here.lo) || !isfinite(here.hi)) continue;
        const double rounding = 1e-9 * (1 + pm_interval_size(here)) + pm_interval_width(here);
        if (!CHECK(here.hi >= all.lo - rounding && here.lo <= all.hi + rounding))
            fprintf(stderr, "at %.17g: %g .. %g, not in %g .. %g\n", s, here.lo, here.hi, all.lo, all.hi);
    }
    return 1;
}

static void random_programs(void)
{
    int bounded = 0;
    for (int i = 0; i < CASES; i++) {
        motion *x = motion_create();
        scene_code code[200];
        double by[2][4];
        const int program = scene_program(x->s, write(x, 1 + i % 4, code, 0), code);
        for (int k = 0; k < 8; k++) by[k / 4][k % 4] = check_random(-2, 2);
        move(x, 0, cubic, by[0]);
        move(x, 1, cubic, by[1]);
        if (EQUAL(scene_begin(x->s), PM_OK))
            for (int k = 0; k < PARTS; k++) {
                const double length = pow(10, check_random(-3, 0)), from = check_random(0, 1 - length);
                bounded += look(x, program, from, from + length);
            }
        motion_free(x);
    }
    CHECK(bounded > CASES * PARTS / 3);
}

/* ---- known ones ---- */
/* exp(-((x - a) / w)^2) of x that goes on evenly: the bend at its top. */
static void a_bell(double a, double w)
{
    motion *x = motion_create();
    const int program = SCENE_PROGRAM(x->s, scene_m(x->place[0]), scene_k(x->s, a), scene_op(PM_OP_SUB),
                                      scene_k(x->s, w), scene_op(PM_OP_DIV), scene_k(x->s, 2),
                                      scene_op(PM_OP_POW), scene_op(PM_OP_NEG), scene_op(PM_OP_EXP));
    move(x, 0, cubic, (const double[4]){0, 1});
    EQUAL(scene_begin(x->s), PM_OK);
    const pm_interval wide = bends(x, program, 0, 1), near = bends(x, program, a - 1e-3 * w, a + 1e-3 * w);
    CHECK(wide.lo <= -2 / (w * w));
    NEAR(near.lo * w * w, -2, 1e-4);
    NEAR(near.hi * w * w, -2, 1e-4);
    motion_free(x);
}

/* On a circle about a pole the force stays the same: 1 / (x^2 + y^2), its bends are nothing, and so is their bound. */
static void a_circle(double angle)
{
    motion *x = motion_create();
    const double phase = check_random(0, 6.3), turned = phase - 2 * atan(1);
    const int program =
        SCENE_PROGRAM(x->s, scene_k(x->s, 1), scene_m(x->place[0]), scene_m(x->place[1]),
                      scene_op(PM_OP_HYPOT), scene_k(x->s, 2), scene_op(PM_OP_POW), scene_op(PM_OP_DIV));
    move(x, 0, cosine, (const double[3]){1, angle, phase});
    move(x, 1, cosine, (const double[3]){1, angle, turned});
    EQUAL(scene_begin(x->s), PM_OK);
    NEAR(pm_interval_size(bends(x, program, 0, 1)), 0, 1e-7);
    CHECK(pm_interval_size(jet(x, program, 0, 1).bend) > 0.1 * angle * angle * angle);
    motion_free(x);
}

/* atan2(y, -1) leaps where y passes 0: nothing is known of it there, and much beside it. */
static void an_angle(double at)
{
    motion *x = motion_create();
    const int program = SCENE_PROGRAM(x->s, scene_m(x->place[1]), scene_k(x->s, -1), scene_op(PM_OP_ATAN2));
    move(x, 1, cubic, (const double[4]){-at, 1});
    EQUAL(scene_begin(x->s), PM_OK);
    CHECK(!isfinite(pm_interval_size(bends(x, program, 0, 1))));
    NEAR(pm_interval_size(bends(x, program, 0.5 * at, 0.9 * at)), 0, 1);
    motion_free(x);
}

int main(void)
{
    random_programs();
    for (int i = 0; i < 100; i++) {
        a_bell(check_random(0.1, 0.9), pow(10, check_random(-6, -1)));
        an_angle(check_random(0.1, 0.9));
        a_circle(check_random(0.02, 0.08));
    }
    return check_failures();
}

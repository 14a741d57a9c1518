/* Extremes of sums and products of no more than two coordinates, which have no law to be bounded by (wave_kinds.h): what the
 * nodes of a step show is all there is.  u is the angle of a wheel that turns evenly, less c, for many c. */
#include "wheel.h"

#define PLACES 40
#define SUMS 6000
#define END 2.6 /* rad: u stays within half a turn */

static const int routes[] = {PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_UNIFORM};

/* squares of how far from their middle two tops have parted */
#define PARTED 5
static const double parted[PARTED] = {1e-4, 1e-3, 1e-2, 0.03, 0.1};

#define K(number) scene_k(w.s, number)
#define ADD scene_op(PM_OP_ADD)
#define SUB scene_op(PM_OP_SUB)
#define MUL scene_op(PM_OP_MUL)
#define PLACE_COS scene_v(w.c), scene_op(PM_OP_COS)
#define PLACE_SIN scene_v(w.c), scene_op(PM_OP_SIN)
#define COSINE scene_m(w.x), PLACE_COS, MUL, scene_m(w.y), PLACE_SIN, MUL, ADD
#define SINE scene_m(w.y), PLACE_COS, MUL, scene_m(w.x), PLACE_SIN, MUL, SUB

/* cos u - cos 2 u / (4 cos q): two tops at u = +-q, which have hardly parted; q = 0: a flat one. */
static void parted_tops(int route, double q, double from, double to, double end, double accuracy,
                        double bound)
{
    wheel w = wheel_turning(route, end);
    const double b = 0.25 / cos(q);
    scene_set(w.s, PM_SETTING_ACCURACY, accuracy);
    scene_ask_extreme(w.s, PM_ASK_MAX,
                      SCENE_PROGRAM(w.s, COSINE, COSINE, COSINE, MUL, K(2 * b), MUL, SUB, K(b), ADD),
                      PM_NONE);
    wheel_expect(w, PLACES, from, to, 0.5 * cos(q) + b, bound);
}

/* a sin u - sin 2 u / 2, with a = cos 2 q / cos q: a top at u = -q and a dip at q; where the top is, too. */
static void top_and_dip(int route, double q, double end, int place)
{
    wheel w = wheel_turning(route, end);
    const double a = cos(2 * q) / cos(q);
    const int program = SCENE_PROGRAM(w.s, SINE, K(a), MUL, SINE, COSINE, MUL, SUB);
    const int u = SCENE_PROGRAM(w.s, scene_m(w.turned), scene_v(w.c), SUB);
    scene_ask_extreme(w.s, place ? PM_ASK_AT_MAX : PM_ASK_MAX, place ? u : program,
                      place ? program : PM_NONE);
    wheel_expect(w, PLACES, end - 1.9 * q, end + 0.9 * q, place ? -q : sin(q) * (cos(q) - a),
                 place ? 1e-7 : 1e-11);
}

/* cos^2 u, which few nodes of long steps do not resolve. */
static void square(int route, double accuracy, double bound)
{
    wheel w = wheel_turning(route, END);
    scene_set(w.s, PM_SETTING_ACCURACY, accuracy);
    scene_ask_extreme(w.s, PM_ASK_MAX, SCENE_PROGRAM(w.s, COSINE, COSINE, MUL), PM_NONE);
    wheel_expect(w, PLACES, 0.3, 2.3, 1, bound);
}

/* ---- random sums ---- */
/* a cos(x - p) + b cos(x - q) cos(x - r) of the angle x */
typedef struct sum {
    double a, b, p, q, r;
} sum;

static double value(const sum *f, double x)
{
    return f->a * cos(x - f->p) + f->b * cos(x - f->q) * cos(x - f->r);
}

static double slope(const sum *f, double x)
{
    return -f->a * sin(x - f->p) - f->b * sin(2 * x - f->q - f->r);
}

/* Its greatest value from 0 to `end`: the slope has no more than four zeros in a turn. */
static double greatest(const sum *f, double end)
{
    const int pieces = 400;
    double most = fmax(value(f, 0), value(f, end));
    for (int i = 0; i < pieces; i++) {
        double rises = end * i / pieces, falls = end * (i + 1) / pieces;
        if (!(slope(f, rises) > 0 && slope(f, falls) <= 0)) continue;
        for (int k = 0; k < 60; k++) {
            const double x = 0.5 * (rises + falls);
            *(slope(f, x) > 0 ? &rises : &falls) = x;
        }
        most = fmax(value(f, rises), most);
    }
    return most;
}

#define WAVE(place) scene_m(w.x), K(cos(place)), MUL, scene_m(w.y), K(sin(place)), MUL, ADD

/* What the nodes of the path leave out of an extreme, looks beside it make up for. */
static void random_sum(void)
{
    const sum f = {check_random(-1, 1), check_random(-1, 1), check_random(0, 6.3), check_random(0, 6.3),
                   check_random(0, 6.3)};
    const double end = check_random(0.5, 6);
    wheel w = wheel_turning(PM_ROUTE_PATH, end);
    scene_ask_extreme(w.s, PM_ASK_MAX,
                      SCENE_PROGRAM(w.s, WAVE(f.p), K(f.a), MUL, WAVE(f.q), WAVE(f.r), MUL, K(f.b), MUL, ADD),
                      PM_NONE);
    scene_set(w.s, PM_SETTING_ACCURACY, 1e-10);
    wheel_expect(w, 1, 0, 0, greatest(&f, end), 5e-12);
}

static void try_route(int route)
{
    for (int k = 0; k < PARTED; k++) {
        const double q = sqrt(parted[k]), near = 0.95 * q + 0.01;
        parted_tops(route, q, 1.5 - near, 1.5 + near, END, 1e-11, 1e-11);
        for (double end = END; end > 2.2; end -= 0.1) {
            parted_tops(route, q, end - near, end, end, 1e-11, 1e-11);
            top_and_dip(route, q, end, 0);
            if (k > 0) top_and_dip(route, q, end, 1);
        }
    }
    parted_tops(route, 0, 1.4, 1.6, END, 1e-11, 1e-11);
    for (double accuracy = 1e-11; accuracy < 1e-2; accuracy *= 10)
        square(route, accuracy, route == PM_ROUTE_PATH ? accuracy : 1e-11);
    for (double accuracy = 1e-11; accuracy < 1e-2; accuracy *= 10)
        parted_tops(route, 0.1, 0.5, 2.5, END, accuracy, route == PM_ROUTE_PATH ? accuracy : 1e-11);
}

int main(void)
{
    for (size_t i = 0; i < sizeof routes / sizeof *routes; i++) try_route(routes[i]);
    for (int i = 0; i < SUMS; i++) random_sum();
    for (int i = 0; i < SUMS / 10; i++) { /* right before the end, from 1e-4 apart on */
        const double q = pow(10, check_random(-4, -0.3));
        top_and_dip(routes[i % 3], q, check_random(3 * q, END), 0);
    }
    return check_failures();
}

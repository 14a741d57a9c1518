/* Products of coordinates, which wave along a step though nothing in their programs does: random ones of degree 3 to 8 in the
 * coordinates of a point of a wheel that turns evenly.  What is asked of them is compared with what fine pieces of the way
 * tell. */
#include "wheel.h"

#ifndef CASES
#define CASES 60 /* of each route; of ida, which takes long, a quarter */
#endif
#define END 3.0     /* rad */
#define PIECES 4000 /* of the way, in which the closed form is monotonic or turns once */
#define FACTORS 8
#define TERMS 3
#define TOUCHES 1e-8
#define EXTREMES 16
#define CODE 400

/* offset + cos(angle - place) */
typedef struct factor {
    double offset, place;
} factor;

/* The sum of all terms, above the level; flat: 1 - (1 - its product)^2 of each. */
typedef struct product {
    int terms, degree[TERMS], flat;
    double level, height[TERMS];
    factor factor[TERMS][FACTORS];
} product;

static int one_of(int n) { return (int)check_random(0, n); }

static product random_product(void)
{
    product p = {.terms = 1 + one_of(TERMS), .flat = one_of(3) == 0};
    for (int i = 0; i < p.terms; i++) {
        const int same = one_of(2); /* a power */
        p.degree[i] = p.flat ? 2 + one_of(3) : 3 + one_of(FACTORS - 2);
        p.height[i] = check_random(-1, 1);
        for (int k = 0; k < p.degree[i]; k++) {
            const int alone = one_of(3) > 0;
            p.factor[i][k] = (factor){alone ? 0 : check_random(-1.5, 1.5), check_random(0, 6.3)};
            if (same) p.factor[i][k] = p.factor[i][0];
        }
    }
    return p;
}

static long double value(const product *p, long double angle)
{
    long double sum = -p->level;
    for (int i = 0; i < p->terms; i++) {
        long double all = 1;
        for (int k = 0; k < p->degree[i]; k++)
            all *= p->factor[i][k].offset + cosl(angle - p->factor[i][k].place);
        sum += p->height[i] * (p->flat ? 1 - (1 - all) * (1 - all) : all);
    }
    return sum;
}

/* ---- the closed form ---- */
/* The place between a and b where sign times the value is greatest. */
static long double top(const product *p, double sign, long double a, long double b)
{
    const long double part = 0.381966011250105152L;
    for (int i = 0; i < 60; i++) {
        const long double l = a + part * (b - a), r = b - part * (b - a);
        if (sign * value(p, l) < sign * value(p, r))
            a = l;
        else
            b = r;
    }
    return 0.5L * (a + b);
}

typedef struct truth {
    double most, place, second, sharp; /* greatest value; the next best top; bend at the first */
    double sum;                        /* integral */
    double off, last;                  /* how near an extreme or an end comes to zero; the last value */
    double extreme[EXTREMES];
    int crossings, extremes;
} truth;

static void meet(truth *t, long double value)
{
    t->crossings += (double)value * t->last < 0;
    t->last = (double)value;
}

static void take_extreme(truth *t, double x, long double at, int is_top)
{
    t->off = fmin(fabs(x), t->off);
    if (t->extremes < EXTREMES) t->extreme[t->extremes++] = x;
    if (!is_top) return;
    t->second = fmax(t->second, fmin(x, t->most));
    if (x > t->most) t->most = x, t->place = (double)at;
}

/* Beside the place `at`, where the value is `here`, and at it, in their order. */
static void take_place(truth *t, const product *p, long double at, const long double value_of[3])
{
    const long double h = (long double)END / PIECES, here = value_of[1];
    const int up = here > value_of[0] && here >= value_of[2],
              down = here < value_of[0] && here <= value_of[2];
    if (!up && !down) {
        meet(t, here);
        return;
    }
    const long double place = top(p, up ? 1 : -1, fmaxl(at - h, 0), fminl(at + h, END)), x = value(p, place);
    take_extreme(t, (double)x, place, up);
    meet(t, place < at ? x : here);
    meet(t, place < at ? here : x);
}

static truth truth_of(const product *p)
{
    truth t = {.most = -INFINITY, .second = -INFINITY, .off = INFINITY};
    const long double h = (long double)END / PIECES;
    long double near[3] = {value(p, -h), value(p, 0), 0}, sum = 0;
    for (int i = 0; i <= PIECES; i++) {
        near[2] = value(p, h * (i + 1));
        sum += (i == 0 || i == PIECES ? 1 : i % 2 ? 4 : 2) * near[1];
        if (i == 0 || i == PIECES) take_extreme(&t, (double)near[1], h * i, 1);
        take_place(&t, p, h * i, near);
        near[0] = near[1];
        near[1] = near[2];
    }
    const long double d = 1e-3L, beside = value(p, t.place + d) + value(p, t.place - d);
    t.sum = (double)(sum * h / 3);
    t.sharp = (double)fabsl((beside - 2 * value(p, t.place)) / (d * d));
    return t;
}

/* ---- the scene ---- */
static int factor_code(scene *s, const factor *f, const int measure[2], scene_code *code)
{
    const scene_code one[] = {scene_m(measure[0]), scene_k(s, cos(f->place)), scene_op(PM_OP_MUL),
                              scene_m(measure[1]), scene_k(s, sin(f->place)), scene_op(PM_OP_MUL),
                              scene_op(PM_OP_ADD), scene_k(s, f->offset),     scene_op(PM_OP_ADD)};
    const int n = f->offset == 0 ? 7 : 9; /* no more than is needed */
    memcpy(code, one, (size_t)n * sizeof *code);
    return n;
}

static int product_code(scene *s, const product *p, int term, const int measure[2], scene_code *code)
{
    int n = 0;
    if (p->flat) code[n++] = scene_k(s, 1);
    for (int k = 0; k < p->degree[term]; k++) {
        n += factor_code(s, &p->factor[term][k], measure, code + n);
        if (k > 0) code[n++] = scene_op(PM_OP_MUL);
    }
    if (p->flat) code[n++] = scene_op(PM_OP_SUB);
    return n;
}

static int program_of(scene *s, const product *p, const int measure[2])
{
    scene_code code[CODE];
    int n = 0;
    code[n++] = scene_k(s, -p->level);
    for (int i = 0; i < p->terms; i++) {
        if (p->flat) code[n++] = scene_k(s, 1);
        n += product_code(s, p, i, measure, code + n);
        if (p->flat) {
            n += product_code(s, p, i, measure, code + n);
            code[n++] = scene_op(PM_OP_MUL);
            code[n++] = scene_op(PM_OP_SUB);
        }
        code[n++] = scene_k(s, p->height[i]);
        code[n++] = scene_op(PM_OP_MUL);
        code[n++] = scene_op(PM_OP_ADD);
    }
    return scene_program(s, n, code);
}

enum { MOST, PLACE, COUNT, SUM, ASKED };

static void ask(scene *s, int asked, int turned, int program)
{
    switch (asked) {
    case MOST: scene_ask_extreme(s, PM_ASK_MAX, program, PM_NONE); return;
    case PLACE: scene_ask_extreme(s, PM_ASK_AT_MAX, scene_read(s, turned), program); return;
    case COUNT: scene_ask_count(s, scene_when(s, PM_TRIGGER_CROSS, program)); return;
    default: scene_ask(s, PM_ASK_INTEGRAL, program, PM_NONE, 1, 0, PM_NONE, PM_NONE, 1); return;
    }
}

/* It is asked alone: what is asked beside it may bring finer samples. */
static double answer(int route, const product *p, int asked)
{
    const wheel x = wheel_turning(route, END);
    const double nothing = 0;
    ask(x.s, asked, x.turned, program_of(x.s, p, (const int[2]){x.x, x.y}));
    EQUAL(scene_run(x.s, &nothing), PM_OK);
    const double out = x.s->out[0];
    scene_free(x.s);
    return out;
}

/* How often it goes through a level that it hardly goes beyond. */
static void try_level(int route, product *p, const truth *t)
{
    const double beyond = pow(10, check_random(-7, -2));
    p->level = t->extreme[one_of(t->extremes)] + (one_of(2) ? beyond : -beyond);
    const truth beside = truth_of(p);
    if (beside.off > TOUCHES) EQUAL(answer(route, p, COUNT), beside.crossings);
}

static void try_product(int route)
{
    product p = random_product();
    const truth t = truth_of(&p);
    const double good = route == PM_ROUTE_IDA ? 1e-7 : 1e-9;
    NEAR(answer(route, &p, MOST), t.most, good);
    if (route != PM_ROUTE_PATH) NEAR(answer(route, &p, SUM), t.sum, good);
    if (t.most - t.second > good && t.sharp > 0.1) NEAR(answer(route, &p, PLACE), t.place, 1e-5);
    try_level(route, &p, &t);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_UNIFORM, PM_ROUTE_PATH, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (size_t r = 0; r < sizeof routes / sizeof *routes; r++)
        for (int i = 0; i < (routes[r] == PM_ROUTE_IDA ? CASES / 4 : CASES); i++) try_product(routes[r]);
    return check_failures();
}

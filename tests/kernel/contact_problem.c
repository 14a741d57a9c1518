/* Random contact problems of boxes, rods and stacks: what is found obeys the laws, Lemke's method finds the motion that trying
 * all modes finds, a mirrored problem has the mirrored motion, and what theory leaves open is told. */
#include "impact/contact_problem.h"

#include <string.h>

#include "check.h"
#include "numerics/dense.h"
#include "planemotion.h"
#include "state/state.h"

#define MOST 8
#define BODIES 4
#define PROBLEMS 20000

typedef struct problem {
    int n;
    double jacobian[2 * MOST][3 * BODIES], inverse[3 * BODIES], velocity[3 * BODIES];
    double restitution[MOST];
} problem;

/* A mark of a body at (x, y) from its centre on a floor or wall of slope `angle`; other: the body it belongs to, or -1. */
static void add_contact(problem *x, int body, int other, const double r[2], const double s[2], double angle)
{
    const double way[2][2] = {{-sin(angle), cos(angle)}, {cos(angle), sin(angle)}};
    for (int k = 0; k < 2; k++) {
        double *j = x->jacobian[2 * x->n + k];
        memset(j, 0, sizeof x->jacobian[0]);
        const double *d = way[k];
        j[3 * body] = d[0];
        j[3 * body + 1] = d[1];
        j[3 * body + 2] = r[0] * d[1] - r[1] * d[0];
        if (other < 0) continue;
        j[3 * other] = -d[0];
        j[3 * other + 1] = -d[1];
        j[3 * other + 2] = -(s[0] * d[1] - s[1] * d[0]);
    }
    x->n++;
}

static void random_bodies(problem *x, double mass_ratio)
{
    memset(x, 0, sizeof *x);
    for (int i = 0; i < BODIES; i++) {
        const double mass = exp(check_random(-log(mass_ratio), log(mass_ratio)));
        x->inverse[3 * i] = x->inverse[3 * i + 1] = 1 / mass;
        x->inverse[3 * i + 2] = 1 / (mass * check_random(0.02, 0.3));
        for (int k = 0; k < 3; k++) x->velocity[3 * i + k] = check_random(-1, 1);
    }
}

/* A box on a floor with two or three feet, one against a wall, or a stack. */
static void random_problem(problem *x, int family)
{
    random_bodies(x, family == 3 ? 1e4 : 10);
    const double a = check_random(0.1, 1), b = check_random(0.1, 1), slope = check_random(-0.5, 0.5);
    const double feet[3][2] = {{-a, -b}, {a, -b}, {check_random(-a, a), -b}};
    if (family < 3) {
        for (int i = 0; i < 2 + (family == 1); i++) add_contact(x, 0, -1, feet[i], feet[i], slope);
        const double side[2] = {a, check_random(-b, b)};
        if (family == 2) add_contact(x, 0, -1, side, side, slope + M_PI_2);
    } else {
        for (int i = 0; i < (family == 3 ? 2 : BODIES); i++)
            for (int k = 0; k < 2; k++) {
                const double top[2] = {feet[k][0], b};
                add_contact(x, i, i - 1, feet[k], top, slope);
            }
    }
}

static void pose(const problem *x, double friction, double restitution, pm_contact_problem *p)
{
    p->n = x->n;
    for (int i = 0; i < 2 * x->n; i++) {
        double u = 0;
        for (int k = 0; k < 3 * BODIES; k++) u += x->jacobian[i][k] * x->velocity[k];
        if (i % 2 == 0) u += restitution * fmin(u, 0);
        p->contact[i / 2].bias[i % 2] = u;
        for (int j = 0; j < 2 * x->n; j++) {
            double sum = 0;
            for (int k = 0; k < 3 * BODIES; k++) sum += x->jacobian[i][k] * x->inverse[k] * x->jacobian[j][k];
            p->response[i * 2 * x->n + j] = sum;
        }
    }
    for (int i = 0; i < x->n; i++) {
        pm_contact_problem_contact *c = &p->contact[i];
        c->friction = PM_FRICTION_COULOMB;
        c->hold = c->rub = friction;
        c->slips = 0;
        c->prefers = PM_NONE;
    }
}

/* Greatest breach of the laws by loads and rates, which are computed again from the loads. */
static double breach(const pm_contact_problem *p)
{
    double worst = 0, largest = 0, fastest = 0;
    for (int i = 0; i < 2 * p->n; i++) {
        largest = fmax(largest, fabs(p->load[i]) * sqrt(p->response[i * 2 * p->n + i]));
        fastest = fmax(fastest, fabs(p->contact[i / 2].bias[i % 2]) / sqrt(p->response[i * 2 * p->n + i]));
    }
    const double size = fmax(largest, fastest);
    for (int i = 0; i < p->n; i++) {
        const double mu = p->contact[i].rub, load = p->load[2 * i], friction = p->load[2 * i + 1];
        const double n = sqrt(p->response[2 * i * 2 * p->n + 2 * i]),
                     t = sqrt(p->response[(2 * i + 1) * (2 * p->n + 1)]);
        double a[2];
        for (int k = 0; k < 2; k++) {
            a[k] = p->contact[i].bias[k];
            for (int j = 0; j < 2 * p->n; j++) a[k] += p->response[(2 * i + k) * 2 * p->n + j] * p->load[j];
        }
        worst = fmax(worst, -load * n);
        worst = fmax(worst, -a[0] / n);
        worst = fmax(worst, fmin(fabs(load) * n, fabs(a[0]) / n));
        worst = fmax(worst, (fabs(friction) - mu * load) * t);
        worst = fmax(worst, fmin(fabs(a[1]) / t, fabs(friction + copysign(mu, a[1]) * load) * t));
    }
    return size > 0 ? worst / size : 0;
}

typedef struct tally {
    int none, one, several, failed, unswept, other;
    double worst;
} tally;

static double difference(int n, const double *a, const double *b)
{
    double most = 0, size = 1e-300;
    for (int i = 0; i < n; i++) {
        most = fmax(most, fabs(a[i] - b[i]));
        size = fmax(size, fmax(fabs(a[i]), fabs(b[i])));
    }
    return most / fmax(size, 1);
}

/* Whether Lemke's method alone, or sweeps alone, find a motion; it is `rate` where that is the one of n. */
static int agrees(pm_contact_problem *p, int n, int tries, int sweeps, const double *rate, tally *t)
{
    p->tries = tries;
    p->sweeps = sweeps;
    const int found = pm_contact_problem_solve(p);
    if (found) t->worst = fmax(t->worst, breach(p));
    t->other += found > 0 && n == 1 && difference(2 * p->n, rate, p->rate) > 1e-6;
    t->other += found > 0 && n == 0;
    return found > 0;
}

/* All modes are tried, then Lemke's method alone, then sweeps alone. */
static void one_problem(const problem *x, double friction, double restitution, pm_contact_problem *p,
                        tally *t)
{
    double rate[2 * MOST];
    pose(x, friction, restitution, p);
    p->counted = p->tried = MOST;
    const int n = pm_contact_problem_solve(p);
    if (n > 0) t->worst = fmax(t->worst, breach(p));
    memcpy(rate, p->rate, sizeof rate);
    t->none += n == 0;
    t->one += n == 1;
    t->several += n == 2;
    p->counted = p->tried = 0;
    t->failed += !agrees(p, n, 8, 0, rate, t) && n > 0;
    t->unswept += !agrees(p, n, 0, 4000, rate, t) && n > 0;
}

static void laws(pm_contact_problem *p, int family, double friction, double restitution)
{
    tally t = {0};
    const int problems = family == 3 ? PROBLEMS / 20 : family == 4 ? 20 : PROBLEMS;
    for (int i = 0; i < problems; i++) {
        problem x;
        random_problem(&x, family);
        one_problem(&x, friction, restitution, p, &t);
    }
    NEAR(t.worst, 0, 1e-8);
    if (restitution == 0)
        EQUAL(t.failed, 0);
    else
        CHECK(t.failed <= problems / 100); /* jammed between floor and wall: all modes are tried then */
    CHECK(t.unswept <= problems / (problems < PROBLEMS ? 4 : 25)); /* stacks jam: sweeps converge slowly */
    EQUAL(t.other, 0);
    if (restitution == 0) EQUAL(t.none, 0); /* a plastic blow always has a solution */
    if (friction == 0)
        EQUAL(t.several, 0); /* without friction the motion is the least of a convex function */
}

/* A box lies flat on a wall, but for an angle; its upper corner above the lower one, on another wall: flat, that one cannot slip.
 * Pressed into the gutter by (-9, -4, 0) without what else it lies on. */
static void corner_over_corner(pm_contact_problem *p, double angle, int turned)
{
    const double c = cos(angle), s = sin(angle), walls[2] = {0, -1.738};
    problem x;
    memset(&x, 0, sizeof x);
    x.inverse[0] = x.inverse[1] = 1;
    x.inverse[2] = 12 / (0.3 * 0.3 + 0.056 * 0.056);
    x.velocity[0] = -8.968;
    x.velocity[1] = -3.976;
    for (int i = 0; i < 2; i++) {
        const int k = turned ? 1 - i : i;
        const double y = k ? 0.028 : -0.028, r[2] = {-0.15 * c - y * s, -0.15 * s + y * c};
        add_contact(&x, 0, -1, r, r, walls[k]);
    }
    pose(&x, 0.05, 0, p);
}

/* Next to the place where contacts lock one motion obeys the laws to rounding, and is the motion: that the corner which hardly
 * slips rubs against its slip tells it, on either side of that place.  There itself each is one. */
static void next_to_a_lock(pm_contact_problem *p)
{
    double slow[2];
    p->counted = 4;
    p->tried = 7;
    for (int turned = 0; turned < 2; turned++)
        for (int side = 0; side < 2; side++)
            for (double angle = 1e-6; angle > 1e-11; angle /= 10) {
                corner_over_corner(p, side ? -angle : angle, turned);
                EQUAL(pm_contact_problem_solve(p), 1);
                const int over = turned ? 0 : 1;
                CHECK(p->load[2 * over] > 0);
                CHECK(p->load[2 * over + 1] * p->rate[2 * over + 1] < 0);
                EQUAL(p->mode[over], p->rate[2 * over + 1] > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD);
                NEAR(fabs(p->load[2 * over + 1]), 0.05 * p->load[2 * over], 1e-9);
                if (angle > 1e-7 && !turned) slow[side] = p->rate[2 * (1 - over) + 1];
                NEAR(p->rate[2 * (1 - over) + 1], slow[side], 1e-4);
            }
    CHECK(fabs(slow[0] - slow[1]) > 1e-3);
    corner_over_corner(p, 0, 0);
    EQUAL(pm_contact_problem_solve(p), 2);
}

/* Likewise, but the lower corner slips, the upper one may stick, and the box turns: the lower one leaves its wall by `leaves`.  A load
 * there would not turn the box about the upper one, but for rounding, which makes it as large as it likes. */
static void lower_corner_leaves(pm_contact_problem *p, double leaves)
{
    const double wide = check_random(0.05, 0.4), high = check_random(0.05, 0.4),
                 one = -check_random(0.8, 1.2), other = check_random(0.8, 1.2), c = cos(one), s = sin(one);
    problem x;
    memset(&x, 0, sizeof x);
    x.inverse[0] = x.inverse[1] = 1;
    x.inverse[2] = 12 / (wide * wide + high * high);
    x.velocity[1] = -9.81;
    for (int i = 0; i < 2; i++) {
        const double y = (i - 0.5) * high, r[2] = {0.5 * wide * c - y * s, 0.5 * wide * s + y * c};
        add_contact(&x, 0, -1, r, r, i ? other : one);
    }
    pose(&x, 0.9, 0, p);
    p->contact[0].bias[0] += leaves;
    p->contact[0].slips = check_random(-1, 1) > 0 ? 1 : -1;
}

/* Where the upper one alone pushes, and friction can hold it, that is the only motion: 1 more of *alone; 1 where several are told (the
 * loads of some are so large for other reasons). */
static int has_others(pm_contact_problem *p, int *alone)
{
    p->counted = 4;
    p->tried = 7;
    lower_corner_leaves(p, pow(10, -check_random(4, 7)));
    const int n = pm_contact_problem_solve(p);
    if (!(p->load[2] > 0 && p->load[0] == 0 && p->rate[0] < 1e-3 && p->mode[1] == PM_STICK)) return 0;
    ++*alone;
    CHECK(p->rate[0] > 0);
    EQUAL(p->mode[0], PM_OPEN);
    return n != 1;
}

/* A body that one foot could hold is pressed on another one, whose normal goes by the first to 1e-4: it stops, with both, or turns
 * about the first.  That it stops is one motion on the edge of two slips, which the equations tell no better than to 1e-12. */
static void stops_on_the_edge_of_a_slip(pm_contact_problem *p)
{
    const double at[2][2] = {{0.34133452909113265, 0.03509728748897534},
                             {0.016953540036066736, 0.35983665122867353}};
    const double angle[2] = {7.448865905811973, 10.210207085583885},
                 mu[2] = {1.0627828682193312, 0.8956012197166076};
    p->counted = 4;
    p->tried = 7;
    for (int k = 0; k < 300; k++) {
        problem x = {.velocity = {1.2240314991074075, 0.26061553336782933, -3.5288967957561086}};
        x.inverse[0] = x.inverse[1] = 1 / 5.07976064855147;
        x.inverse[2] = 1 / 0.13994356309927589;
        for (int i = 0; i < 2; i++) {
            const int of = (i + k) % 2;
            add_contact(&x, 0, -1, at[of], at[of], angle[of]);
        }
        for (int i = 0; i < 4; i++)
            for (int q = 0; q < 3; q++) x.jacobian[i][q] *= 1 + check_random(-4e-16, 4e-16);
        pose(&x, 1, 0, p);
        for (int i = 0; i < 2; i++) p->contact[i].hold = p->contact[i].rub = mu[(i + k) % 2];
        EQUAL(pm_contact_problem_solve(p), 2);
    }
}

/* The class of it: a body turns about foot 1, slowly, and so slides on foot 0, whose normal goes by foot 1 to `near`.  Where friction at
 * foot 0 can stop it, by loads that foot 1 can hold, that is a motion, too. */
typedef struct stopped {
    problem x;
    double mu[2];
    int held; /* by far */
} stopped;

static stopped random_stop(double near)
{
    stopped s = {.mu = {check_random(0.2, 1.2), check_random(0.2, 1.2)}};
    double at[2][2], angle[2], load[3];
    for (int i = 0; i < 4; i++) at[i / 2][i % 2] = check_random(-0.4, 0.4);
    const double d[2] = {at[0][0] - at[1][0], at[0][1] - at[1][1]}, far = hypot(d[0], d[1]);
    angle[0] = atan2(d[1], d[0]) - M_PI_2 + asin(fmin(1, near / far)) + (check_random(-1, 1) > 0 ? M_PI : 0);
    angle[1] = check_random(-M_PI, M_PI);
    problem *x = &s.x;
    x->inverse[0] = x->inverse[1] = check_random(0.2, 2);
    x->inverse[2] = x->inverse[0] / check_random(0.01, 0.1);
    for (int i = 0; i < 2; i++) add_contact(x, 0, -1, at[i], at[i], angle[i]);
    const double(*j)[3 * BODIES] = (const double(*)[3 * BODIES]) x->jacobian;
    double omega = pow(10, -check_random(1, 4));
    const double turn[3] = {at[1][1], -at[1][0], 1};
    if (turn[0] * j[0][0] + turn[1] * j[0][1] + j[0][2] < 0) omega = -omega; /* it parts from foot 0 */
    const double press = check_random(0.5, 2), rubs = check_random(-0.5, 0.5) * s.mu[1] * press;
    double slip = 0, rows[9];
    for (int k = 0; k < 3; k++) {
        x->velocity[k] = omega * turn[k] - x->inverse[k] * (press * j[2][k] + rubs * j[3][k]);
        slip += omega * turn[k] * j[1][k];
    }
    for (int k = 0; k < 3; k++) {
        rows[3 * k] = j[0][k] - copysign(s.mu[0], slip) * j[1][k];
        rows[3 * k + 1] = j[2][k];
        rows[3 * k + 2] = j[3][k];
        load[k] = -x->velocity[k] / x->inverse[k];
    }
    int pivot[3];
    s.held = !pm_dense_lu_factor(3, rows, pivot);
    pm_dense_lu_solve(3, rows, pivot, load);
    s.held = s.held && load[0] > 1e-3 && load[1] > 0.1 && fabs(load[2]) < 0.9 * s.mu[1] * load[1];
    return s;
}

static problem in_reversed_order(const problem *x)
{
    problem r = *x;
    memcpy(r.jacobian, x->jacobian + 2, 2 * sizeof x->jacobian[0]);
    memcpy(r.jacobian + 2, x->jacobian, 2 * sizeof x->jacobian[0]);
    return r;
}

/* Either order of the contacts tells both motions. */
static void stop_or_turn(pm_contact_problem *p)
{
    int held = 0;
    p->counted = 4;
    p->tried = 7;
    for (int i = 0; i < 10000; i++) {
        const stopped s = random_stop(pow(10, -check_random(2, 5.3)));
        if (!s.held) continue;
        held++;
        for (int k = 0; k < 2; k++) {
            const problem x = k ? in_reversed_order(&s.x) : s.x;
            pose(&x, 1, 0, p);
            for (int c = 0; c < 2; c++) p->contact[c].hold = p->contact[c].rub = s.mu[(c + k) % 2];
            EQUAL(pm_contact_problem_solve(p), 2);
        }
    }
    CHECK(held > 1000);
}

int main(void)
{
    pm_arena arena = {0};
    pm_contact_problem p;
    memset(&p, 0, sizeof p);
    if (pm_contact_problem_create(&p, &arena, MOST)) return 1;
    for (int family = 0; family < 4; family++)
        for (int k = 0; k < 3; k++)
            for (int e = 0; e < 2; e++) laws(&p, family, k == 0 ? 0 : k == 1 ? 0.3 : 1.2, 0.6 * e);
    next_to_a_lock(&p);
    stops_on_the_edge_of_a_slip(&p);
    stop_or_turn(&p);
    int alone = 0, several = 0;
    for (int i = 0; i < 3000; i++) several += has_others(&p, &alone);
    CHECK(alone > 500 && several <= alone / 200);
    pm_arena_free(&arena);
    return check_failures();
}

/* The course of a blow at several contacts of random bodies: against small steps with an iterated solver, against one contact alone, mirrored and permuted, by its energies and cones; what symmetry demands. */
#include "impact/contact_course.h"
#include "check.h"
#include "course_problem.h"
#include "impact/impact_course.h"
#include "state/arena.h"
#include <string.h>

#define CLOSE 1e-9
#define PROBLEMS 4000
#define STEPS 1000   /* of each phase of the stepped course */
#define STEPPED 0.03 /* m/s, of some m/s: what these steps allow */
#define SWEEPS 40

/* A box on two feet or three, in a wedge; or one on another that stands on the floor. */
static problem random_problem(int family, int law)
{
    problem x = {0};
    const double a = check_random(0.3, 1), b = check_random(0.3, 1);
    for (int k = 0; k < 2; k++) {
        x.inverse[3 * k] = x.inverse[3 * k + 1] = check_random(0.5, 2);
        x.inverse[3 * k + 2] = x.inverse[3 * k] * 3 / (a * a + b * b);
        for (int i = 0; i < 3; i++) x.velocity[3 * k + i] = check_random(-1, 1);
        x.velocity[3 * k + 1] -= 1.5;
    }
    add_contact(&x, -a, -b, family == 2 ? -0.6 : 0, law);
    add_contact(&x, a, -b, family == 2 ? 0.7 : 0, law);
    if (family == 1) add_contact(&x, check_random(-a, a), -b, 0, law);
    for (int i = 1; i < x.n && family == 1; i++)
        x.mu[i] = x.mu[0]; /* or how they share the load decides the motion */
    for (int i = 0; family == 3 && i < 2; i++) {
        double *normal = x.jacobian[2 * x.n], *tangent = x.jacobian[2 * x.n + 1];
        const double at = (i ? 1 : -1) * check_random(0.1, 0.9) * a;
        add_contact(&x, at, b, 0, law);
        for (int k = 0; k < 3; k++) normal[k] = -normal[k], tangent[k] = -tangent[k];
        normal[4] = tangent[3] = 1, normal[5] = at, tangent[5] = b;
    }
    return x;
}

static double kinetic(const problem *x, const double *v)
{
    double sum = 0;
    for (int q = 0; q < 6; q++) sum += 0.5 * v[q] * v[q] / x->inverse[q];
    return sum;
}

/* ---- small steps ---- */
typedef struct stepped {
    double u[2 * MOST], load[MOST], work[MOST], left[MOST][2], before[MOST];
    int rebounds[MOST];
} stepped;

/* One step: sweeps over the contacts, each with its least impulse that keeps the pace, and friction against the slip. */
static void step(const problem *x, stepped *s, const double *least, double ds)
{
    const int n = 2 * x->n;
    double p[2 * MOST] = {0}, after[2 * MOST];
    memcpy(after, s->u, sizeof after);
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int i = 0; i < n; i++) {
            const double own = course.response[i * n + i], room = x->mu[i / 2] * p[i & ~1];
            const double wanted = i % 2                              ? 0
                                  : s->u[i] > 0 && least[i / 2] == 0 ? 0
                                                                     : s->u[i] + least[i / 2] * ds;
            double q = p[i] - (after[i] - wanted) / own;
            if (i % 2)
                q = fmax(-room, fmin(room, q));
            else
                q = fmax(0, q);
            for (int k = 0; k < n; k++) after[k] += course.response[k * n + i] * (q - p[i]);
            p[i] = q;
        }
    for (int i = 0; i < x->n; i++) {
        s->load[i] += p[2 * i];
        s->work[i] += 0.5 * p[2 * i] * (s->u[2 * i] + after[2 * i]);
    }
    memcpy(s->u, after, sizeof after);
}

static int is_over(const problem *x, const stepped *s, int i)
{
    if (x->law[i] == PM_LAW_NEWTON) return s->u[2 * i] >= -x->e[i] * s->before[i];
    if (x->law[i] == PM_LAW_POISSON) return s->load[i] >= s->left[i][0];
    return s->work[i] >= s->left[i][1];
}

/* By Euler steps, with velocities that fall by exp(-s) in compression. */
static void step_through(const problem *x, stepped *s)
{
    double least[MOST];
    memset(s, 0, sizeof *s);
    memcpy(s->u, course.velocity, 2 * (size_t)x->n * sizeof *s->u);
    for (int i = 0; i < x->n; i++) s->before[i] = s->u[2 * i];
    for (int k = 0; k < 12 * STEPS; k++) {
        for (int i = 0; i < x->n; i++) least[i] = s->u[2 * i] < 0 ? -s->u[2 * i] : 0;
        step(x, s, least, 1.0 / STEPS);
    }
    for (int i = 0; i < x->n; i++) {
        s->rebounds[i] = x->e[i] > 0 && s->before[i] < 0 && s->load[i] > 0;
        s->left[i][0] = x->e[i] * s->load[i];
        s->left[i][1] = -x->e[i] * x->e[i] * s->work[i];
        s->load[i] = s->work[i] = 0;
    }
    for (int k = 0, more = 1; more && k < 20 * STEPS; k++) {
        more = 0;
        for (int i = 0; i < x->n; i++) {
            if (s->rebounds[i] && is_over(x, s, i)) s->rebounds[i] = 0;
            least[i] = s->rebounds[i] ? -x->e[i] * s->before[i] : 0;
            more |= s->rebounds[i];
        }
        if (more) step(x, s, least, 1.0 / STEPS);
    }
}

static void against_steps(void)
{
    for (int k = 0; k < 30; k++) {
        const problem x = random_problem(k % 2 ? 2 : 0, -1);
        double after[6];
        stepped s;
        pose(&x);
        step_through(&x, &s);
        EQUAL(follow(&x, after), 1);
        for (int i = 0; i < 2 * x.n && !course.limited; i++) NEAR(course.velocity[i], s.u[i], STEPPED);
    }
}

/* ---- laws ---- */
static void obeys_the_laws(void)
{
    int followed = 0;
    for (int k = 0; k < PROBLEMS; k++) {
        const problem x = random_problem(k % 4, k % 2 ? PM_LAW_STRONGE : -1);
        double after[6];
        const int found = follow(&x, after);
        CHECK(found == 1 || k % 4 >= 2); /* wedges and stacks may jam, or go two ways */
        if (found != 1) continue;
        followed++;
        CHECK(kinetic(&x, after) <= kinetic(&x, x.velocity) * (1 + CLOSE));
        if (k % 2) CHECK(!course.limited);
        for (int i = 0; i < x.n; i++) {
            const double normal = course.impulse[2 * i], friction = course.impulse[2 * i + 1];
            double rate = 0;
            for (int q = 0; q < 6; q++) rate += x.jacobian[2 * i][q] * after[q];
            CHECK(normal >= 0);
            CHECK(fabs(friction) <= x.mu[i] * normal + CLOSE);
            CHECK(rate >= -CLOSE);
            NEAR(rate, course.velocity[2 * i], CLOSE);
        }
    }
    CHECK(followed >= 0.99 * PROBLEMS);
}

/* Poisson's impulses without friction, with the same restitution at all: (1 + e) times those of the plastic blow. */
static void without_friction(void)
{
    for (int k = 0; k < 400; k++) {
        problem x = random_problem(k % 4, PM_LAW_POISSON);
        double after[6], plastic[2 * MOST];
        for (int i = 0; i < x.n; i++) x.mu[i] = x.e[i] = 0;
        EQUAL(follow(&x, after), 1);
        memcpy(plastic, course.impulse, sizeof plastic);
        for (int i = 0; i < x.n; i++) x.e[i] = 0.6;
        EQUAL(follow(&x, after), 1);
        for (int i = 0; i < 2 * x.n && x.n == 2; i++)
            if (course.contact[0].before < 0 && course.contact[1].before < 0)
                NEAR(course.impulse[i], 1.6 * plastic[i], CLOSE);
    }
}

static void as_one_alone(void)
{
    for (int k = 0; k < PROBLEMS; k++) {
        problem x = random_problem(0, -1);
        x.n = 1;
        const int rough = k % 3 == 0;
        pose(&x);
        if (rough) course.contact[0].friction.friction = PM_FRICTION_ROUGH;
        const pm_impact_course one = {.a = course.response[0],
                                      .b = course.response[1],
                                      .c = course.response[3],
                                      .normal = course.velocity[0],
                                      .slip = course.velocity[1],
                                      .mu_static = rough ? INFINITY : x.mu[0],
                                      .mu_kinetic = rough ? INFINITY : x.mu[0],
                                      .restitution = x.e[0],
                                      .no_slip = course.no_slip,
                                      .law = x.law[0]};
        pm_impact_course_end end;
        if (!(one.normal < 0)) continue;
        if (!pm_impact_course_follow(&one, &end)) {
            CHECK(rough); /* without its slip it does not approach */
            continue;
        }
        EQUAL(pm_contact_course_follow(&course), 1);
        if (course.limited) continue; /* of one contact impact_together.c looks after that */
        NEAR(course.velocity[0], end.normal, CLOSE);
        NEAR(course.velocity[1], end.slip, CLOSE);
        NEAR(course.impulse[0], end.impulse, CLOSE);
        NEAR(course.impulse[1], end.impulse * end.ratio, CLOSE);
    }
}

/* x -> -x, and the contacts in the other order. */
static problem mirror(const problem *x)
{
    problem y = *x;
    for (int i = 0; i < x->n; i++) {
        const int k = x->n - 1 - i;
        y.mu[k] = x->mu[i], y.e[k] = x->e[i], y.law[k] = x->law[i];
        for (int q = 0; q < 6; q++) {
            const double sign = q % 3 == 1 ? 1 : -1;
            y.jacobian[2 * k][q] = sign * x->jacobian[2 * i][q];
            y.jacobian[2 * k + 1][q] = -sign * x->jacobian[2 * i + 1][q];
        }
    }
    for (int q = 0; q < 6; q++) y.velocity[q] = (q % 3 == 1 ? 1 : -1) * x->velocity[q];
    return y;
}

static void mirrored_and_permuted(void)
{
    for (int k = 0; k < PROBLEMS; k++) {
        const problem x = random_problem(k % 4, -1), y = mirror(&x);
        double one[6], other[6];
        const int found = follow(&x, one);
        EQUAL(follow(&y, other), found);
        for (int q = 0; q < 6 && found == 1; q++) NEAR(other[q], (q % 3 == 1 ? 1 : -1) * one[q], 100 * CLOSE);
    }
}

/* A flat box falls straight: it rebounds with e, and does not turn. */
static void flat(void)
{
    for (int law = 0; law < PM_LAWS; law++)
        for (int family = 0; family < 2; family++) {
            problem x = random_problem(family, law);
            double after[6];
            for (int i = 0; i < x.n; i++) x.mu[i] = 0.1, x.e[i] = 0.4;
            x.velocity[0] = 2, x.velocity[1] = -1, x.velocity[2] = 0;
            EQUAL(follow(&x, after), 1);
            NEAR(after[1], 0.4, CLOSE);
            NEAR(after[0] - 2, -0.1 * 1.4, CLOSE);
        }
}

/* A bounce that is over is closed, and the other contact is struck as if the first had never parted. */
static void spent(void)
{
    problem x = random_problem(0, PM_LAW_POISSON);
    x.mu[0] = x.mu[1] = x.velocity[0] = x.velocity[2] = 0;
    x.velocity[1] = 1;
    pose(&x);
    for (int i = 0; i < 2; i++) course.contact[i].is_spent = 1;
    EQUAL(pm_contact_course_follow(&course), 1);
    for (int i = 0; i < 2; i++) NEAR(course.velocity[2 * i], 0, CLOSE);
    CHECK(course.impulse[0] + course.impulse[2] < 0);
}

int main(void)
{
    EQUAL(pm_contact_course_create(&course, &memory, MOST, 0), 0);
    against_steps();
    obeys_the_laws();
    without_friction();
    as_one_alone();
    mirrored_and_permuted();
    flat();
    spent();
    pm_arena_free(&memory);
    return check_failures();
}

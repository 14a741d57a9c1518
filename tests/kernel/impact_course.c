/* One contact with friction, followed through its blow: against a course stepped in small impulses, closed forms, mirror
 * images, the energies of the three laws. */
#include "impact/impact_course.h"
#include "check.h"

#define CLOSE 1e-12
#define STEPS 200000 /* of the stepped course, over four times the impulse of a smooth plastic blow */
#define STEPPED 2e-4 /* what these steps allow */

static pm_impact_course some(int law)
{
    pm_impact_course x = {.law = law, .no_slip = 1e-12};
    x.a = check_random(0.5, 2);
    x.c = check_random(0.5, 4);
    x.b = check_random(-0.95, 0.95) * sqrt(x.a * x.c);
    x.normal = check_random(-4, -1);
    x.slip = check_random(-3, 3);
    x.mu_static = x.mu_kinetic = check_random(0, 1.5);
    x.restitution = check_random(0, 1);
    return x;
}

typedef struct stepped {
    double normal, slip, p, ratio, work;
} stepped;

/* Euler in the normal impulse: which way friction acts is looked at before every small step, by its law alone. */
static stepped step_through(const pm_impact_course *x)
{
    stepped s = {x->normal, x->slip, 0, 0, 0};
    const double reach = x->normal < 0 ? -x->normal : 3 * fabs(x->slip);
    const double dp = 4 * reach / (x->a - x->b * x->b / x->c) / STEPS;
    double friction = 0, p_end = INFINITY, work_end = INFINITY;
    int compressed = 0;
    for (int i = 0; i < 4 * STEPS; i++) {
        const double hold = -(s.slip + x->b * dp) / x->c; /* would end the slip within the step */
        const double most = x->mu_kinetic * dp, f = fmax(-most, fmin(most, hold));
        const double before = s.normal;
        s.normal += x->a * dp + x->b * f;
        s.slip += x->b * dp + x->c * f;
        friction += f;
        s.p += dp;
        s.work += 0.5 * (before + s.normal) * dp;
        if (!compressed && s.normal >= 0) {
            compressed = 1;
            p_end = (1 + x->restitution) * s.p;
            work_end = (1 - x->restitution * x->restitution) * s.work;
        }
        if (!compressed) continue;
        if (x->law == PM_LAW_NEWTON && s.normal >= -x->restitution * x->normal) break;
        if (x->law == PM_LAW_POISSON && s.p >= p_end) break;
        if (x->law == PM_LAW_STRONGE && s.work >= work_end) break;
    }
    s.ratio = friction / s.p;
    return s;
}

static void against_steps(void)
{
    int reversed = 0, held = 0;
    for (int law = 0; law < PM_LAWS; law++)
        for (int n = 0; n < 60; n++) {
            const pm_impact_course x = some(law);
            pm_impact_course_end end;
            CHECK(pm_impact_course_follow(&x, &end));
            const stepped s = step_through(&x);
            NEAR(end.normal, s.normal, STEPPED * 10);
            NEAR(end.slip, s.slip, STEPPED * 10);
            NEAR(end.impulse, s.p, STEPPED * 10);
            NEAR(end.ratio, s.ratio, STEPPED * 10);
            reversed += end.slip * x.slip < 0;
            held += end.slip == 0;
        }
    CHECK(reversed > 5 && held > 20);
}

/* du = A dP from beginning to end, and no more friction than mu times the normal impulse. */
static void balances(void)
{
    for (int n = 0; n < 300; n++) {
        const pm_impact_course x = some(n % PM_LAWS);
        pm_impact_course_end end;
        CHECK(pm_impact_course_follow(&x, &end));
        NEAR(end.normal, x.normal + (x.a + x.b * end.ratio) * end.impulse, CLOSE * 100);
        NEAR(end.slip, x.slip + (x.b + x.c * end.ratio) * end.impulse, CLOSE * 100);
        CHECK(fabs(end.ratio) <= x.mu_kinetic * (1 + CLOSE));
        if (end.slip * x.slip > 0) NEAR(end.ratio, -copysign(x.mu_kinetic, x.slip), CLOSE);
    }
}

static void without_friction(void)
{
    for (int n = 0; n < 60; n++) {
        pm_impact_course x = some(n % PM_LAWS);
        x.mu_static = x.mu_kinetic = 0;
        pm_impact_course_end end;
        CHECK(pm_impact_course_follow(&x, &end));
        NEAR(end.impulse, -(1 + x.restitution) * x.normal / x.a, CLOSE * 10);
        NEAR(end.normal, -x.restitution * x.normal, CLOSE * 10);
        EQUAL(end.ratio, 0);
    }
}

static void mirrored(void)
{
    for (int n = 0; n < 60; n++) {
        const pm_impact_course x = some(n % PM_LAWS);
        pm_impact_course y = x;
        y.b = -x.b;
        y.slip = -x.slip;
        pm_impact_course_end a, b;
        CHECK(pm_impact_course_follow(&x, &a) && pm_impact_course_follow(&y, &b));
        EQUAL(a.normal, b.normal);
        EQUAL(a.slip, -b.slip);
        EQUAL(a.ratio, -b.ratio);
    }
}

static double given(const pm_impact_course *x, const pm_impact_course_end *end)
{
    return 0.5 * end->impulse * (x->normal + end->normal + end->ratio * (x->slip + end->slip));
}

/* Stronge's and Poisson's never give energy; Newton's may, where the slip changes. */
static void energies(void)
{
    int newton_gains = 0, differ = 0;
    for (int n = 0; n < 2000; n++) {
        pm_impact_course x = some(PM_LAW_STRONGE);
        pm_impact_course_end end[PM_LAWS];
        x.restitution = check_random(0.7, 1);
        for (x.law = 0; x.law < PM_LAWS; x.law++) CHECK(pm_impact_course_follow(&x, &end[x.law]));
        CHECK(given(&x, &end[PM_LAW_STRONGE]) <= CLOSE);
        CHECK(given(&x, &end[PM_LAW_POISSON]) <= CLOSE);
        newton_gains += given(&x, &end[PM_LAW_NEWTON]) > CLOSE;
        differ += fabs(end[1].impulse - end[2].impulse) > 1e-3;
    }
    CHECK(newton_gains > 10 && differ > 100);
}

/* A rough pair holds from the beginning; where its grip drives it apart at once there is no blow to follow. */
static void rough(void)
{
    for (int n = 0; n < 60; n++) {
        pm_impact_course x = some(n % PM_LAWS);
        x.mu_static = x.mu_kinetic = INFINITY;
        pm_impact_course_end end;
        const double gripped = x.normal - x.b * x.slip / x.c, stiffness = x.a - x.b * x.b / x.c;
        const int ends = pm_impact_course_follow(&x, &end);
        EQUAL(ends, gripped < 0);
        if (!ends) continue;
        EQUAL(end.slip, 0);
        const double normal = x.law == PM_LAW_NEWTON ? -x.restitution * x.normal : -x.restitution * gripped;
        NEAR(end.normal, normal, CLOSE * 10);
        NEAR(end.impulse, (normal - gripped) / stiffness, CLOSE * 100);
    }
}

/* Friction that draws a pair together strikes it though it does not approach; with less of it there is no blow. */
static void without_collision(void)
{
    int drawn = 0, held = 0;
    while (drawn < 45) {
        pm_impact_course x = some(drawn % PM_LAWS);
        pm_impact_course_end end, mirrored;
        x.normal = 0;
        x.b = copysign(check_random(0.6, 0.9) * sqrt(x.a * x.c), x.slip);
        x.mu_static = x.mu_kinetic = check_random(0, 4);
        const int draws = x.a < x.mu_kinetic * fabs(x.b);
        EQUAL(pm_impact_course_draws(&x), draws);
        EQUAL(pm_impact_course_follow(&x, &end), draws);
        held += !draws;
        if (!draws) continue;
        const stepped s = step_through(&x);
        NEAR(end.normal, s.normal, STEPPED * 50);
        NEAR(end.slip, s.slip, STEPPED * 50);
        NEAR(end.impulse, s.p, STEPPED * 50);
        NEAR(end.ratio, s.ratio, STEPPED * 50);
        CHECK(given(&x, &end) < 0);
        EQUAL(end.slip, 0);
        if (x.law == PM_LAW_NEWTON) EQUAL(end.normal, 0);
        x.slip = -x.slip;
        EQUAL(pm_impact_course_draws(&x), 0); /* b of a mirror image has the other sign, too */
        x.b = -x.b;
        CHECK(pm_impact_course_follow(&x, &mirrored));
        NEAR(mirrored.ratio, -end.ratio, CLOSE);
        NEAR(mirrored.normal, end.normal, CLOSE);
        drawn++;
    }
    CHECK(held > 5);
}

/* A pair that has one way to go: slip and approach end together, whatever rounding makes of it. */
static void one_way(void)
{
    static const int laws[] = {PM_LAW_NEWTON, PM_LAW_POISSON, PM_LAW_STRONGE};
    for (int i = 0; i < 3000; i++) {
        pm_impact_course x = some(laws[i % 3]);
        pm_impact_course_end end;
        const double n = check_random(0.2, 1), t = check_random(-1, 1), rate = check_random(-3, -1);
        x.a = n * n;
        x.b = n * t;
        x.c = t * t;
        x.normal = n * rate;
        x.slip = t * rate;
        x.mu_static = x.mu_kinetic = 1.01 * n / fabs(t); /* it is held then */
        if (x.law != PM_LAW_POISSON) x.restitution = 0;
        CHECK(pm_impact_course_follow(&x, &end));
        NEAR(end.normal, 0, CLOSE);
        NEAR(end.slip, 0, CLOSE);
    }
}

int main(void)
{
    one_way();
    against_steps();
    balances();
    without_friction();
    mirrored();
    energies();
    rough();
    without_collision();
    return check_failures();
}

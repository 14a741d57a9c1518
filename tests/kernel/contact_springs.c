/* Blows that stiffnesses share: closed forms of one contact, springs followed by small steps, what the laws keep, limits. */
#include "impact/contact_springs.h"

#include "check.h"
#include "numerics/tolerances.h"
#include "planemotion.h"
#include "scene.h"

#define MOST 5
#define CLOSE 1e-11

static pm_contact_springs springs;

/* ---- chains of bodies on a line ---- */
typedef struct chain {
    int n; /* bodies; n - 1 contacts */
    double mass[MOST], velocity[MOST], stiffness[MOST], e[MOST], exponent;
} chain;

/* Of normal velocity i to normal impulse k, without friction. */
static double *response_of(int i, int k) { return springs.response + 2 * i * 2 * springs.n + 2 * k; }

static void begin(int n)
{
    springs.n = n;
    memset(springs.response, 0, 4 * (size_t)n * n * sizeof *springs.response);
}

static void pose_chain(const chain *x)
{
    const int n = x->n - 1;
    begin(n);
    springs.exponent = x->exponent;
    for (int i = 0; i < n; i++) {
        springs.spring[i] = (pm_contact_spring){.stiffness = x->stiffness[i],
                                                .restitution = x->e[i],
                                                .before = x->velocity[i + 1] - x->velocity[i]};
        for (int k = 0; k < n; k++)
            *response_of(i, k) = i == k       ? 1 / x->mass[i] + 1 / x->mass[i + 1]
                                 : k == i + 1 ? -1 / x->mass[k]
                                 : i == k + 1 ? -1 / x->mass[i]
                                              : 0;
    }
}

/* Velocities after the blow. */
static void strike(const chain *x, double after[MOST])
{
    pose_chain(x);
    EQUAL(pm_contact_springs_follow(&springs), 1);
    for (int i = 0; i < x->n; i++) {
        const double left = i > 0 ? springs.spring[i - 1].impulse[0] : 0,
                     right = i + 1 < x->n ? springs.spring[i].impulse[0] : 0;
        after[i] = x->velocity[i] + (left - right) / x->mass[i];
    }
    for (int i = 0; i + 1 < x->n; i++) NEAR(after[i + 1] - after[i], springs.spring[i].before, CLOSE);
}

static chain any_chain(int n)
{
    chain x = {.n = n, .exponent = 1 + 0.5 * (int)check_random(0, 3)};
    for (int i = 0; i < n; i++) {
        x.mass[i] = pow(10, check_random(-0.5, 0.5));
        x.velocity[i] = check_random(-1, 1);
        x.stiffness[i] = pow(10, check_random(-1, 1));
        x.e[i] = check_random(0, 1);
    }
    x.velocity[0] = 1.2;
    return x;
}

/* Whatever the stiffness, two bodies part with e times the speed with which they met. */
static void two_bodies(void)
{
    for (int i = 0; i < 300; i++) {
        chain x = any_chain(2);
        double after[MOST];
        if (i % 10 == 0) x.e[0] = i % 20 / 10;
        x.stiffness[0] = pow(10, check_random(-9, 9));
        strike(&x, after);
        NEAR(after[1] - after[0], x.e[0] * (x.velocity[0] - x.velocity[1]), 1e-12);
    }
}

/* ---- the law by small steps ---- */
/* Euler's steps of springs that are released faster than compressed; what is open holds nothing. */
static void step_through(double h, double after[MOST])
{
    const int n = springs.n;
    double x[MOST] = {0}, p[MOST] = {0};
    for (int s = 0, open = 0; s < 400000 && !open; s++) {
        for (int i = 0; i < n; i++) p[i] += h * springs.spring[i].stiffness * pow(x[i], springs.exponent);
        open = 1;
        for (int i = 0; i < n; i++) {
            const double e = springs.spring[i].restitution;
            after[i] = springs.spring[i].before;
            for (int k = 0; k < n; k++) after[i] += *response_of(i, k) * p[k];
            x[i] = fmax(0, x[i] - h * after[i] * (after[i] > 0 ? 1 / (e * e) : 1));
            open &= x[i] == 0 && after[i] >= -1e-9;
        }
    }
}

/* Chains of up to five bodies whose first strikes the others, which rest and touch; some lose energy. */
static void chains_by_small_steps(void)
{
    for (int i = 0; i < 12; i++) {
        chain x = {.n = 3 + i % 3, .velocity = {1}, .exponent = i % 2 ? 1.5 : 1};
        double after[MOST], stepped[MOST];
        for (int k = 0; k < x.n; k++) {
            x.mass[k] = 1 + 0.3 * k;
            x.stiffness[k] = pow(3, k == 1 ? i % 3 - 1 : 0);
            x.e[k] = i < 6 ? 1 : 0.6 + 0.1 * k;
        }
        pose_chain(&x);
        step_through(1e-3, stepped);
        strike(&x, after);
        for (int k = 0; k + 1 < x.n; k++) NEAR(springs.spring[k].before, stepped[k], 5e-3);
    }
}

/* ---- what is kept ---- */
static double energy(const chain *x, const double *v)
{
    double sum = 0;
    for (int i = 0; i < x->n; i++) sum += 0.5 * x->mass[i] * v[i] * v[i];
    return sum;
}

/* Nothing pulls, nothing penetrates, no energy is gained, and none lost where all e = 1; units do not count, nor does the side
 * from which the chain is seen. */
static void laws_of_chains(void)
{
    for (int i = 0; i < 200; i++) {
        chain x = any_chain(2 + i % 4), other;
        double after[MOST], again[MOST];
        const int keeps = i % 5 == 0;
        for (int k = 0; k < x.n && keeps; k++) x.e[k] = 1;
        other = x;
        strike(&x, after);
        for (int k = 0; k + 1 < x.n; k++) {
            CHECK(springs.spring[k].impulse[0] >= 0);
            CHECK(springs.spring[k].before >= 0);
        }
        const double gain = energy(&x, after) - energy(&x, x.velocity);
        CHECK(gain < CLOSE);
        if (keeps) NEAR(gain, 0, CLOSE);
        for (int k = 0; k < x.n; k++) { /* from the other side, in other units */
            other.mass[k] = 7 * x.mass[x.n - 1 - k];
            other.velocity[k] = -0.01 * x.velocity[x.n - 1 - k];
            if (k + 1 == x.n) continue;
            other.stiffness[k] = 300 * x.stiffness[x.n - 2 - k];
            other.e[k] = x.e[x.n - 2 - k];
        }
        strike(&other, again);
        for (int k = 0; k < x.n; k++) NEAR(-100 * again[x.n - 1 - k], after[k], 1e-10);
    }
}

/* Longer steps change nothing: what is compressed again for a moment inside one is not passed over. */
static void longer_steps(void)
{
    const double tolerance = springs.tolerance;
    for (int i = 0; i < 2000; i++) {
        const chain x = any_chain(3);
        double after[MOST], again[MOST];
        strike(&x, after);
        springs.tolerance = PM_COARSER * tolerance;
        strike(&x, again);
        springs.tolerance = tolerance;
        for (int k = 0; k < x.n; k++) NEAR(again[k], after[k], 1e-10);
    }
}

/* Three balls, one contact far stiffer than the other: 1 and 2 have parted before 3 feels it; or 2 and 3 part while 1 is still
 * being slowed, and it strikes as often as it would one by one, here the way back for all: -1/3, 2/3, 2/3. */
static void one_after_the_other(void)
{
    static const double expected[2][3] = {{0, 0, 1}, {-1. / 3, 2. / 3, 2. / 3}};
    for (int i = 0; i < 2; i++) {
        chain x = {.n = 3, .mass = {1, 1, 1}, .velocity = {1}, .e = {1, 1}, .exponent = 1};
        double after[MOST];
        x.stiffness[i] = 1e6;
        x.stiffness[1 - i] = 1;
        strike(&x, after);
        for (int k = 0; k < 3; k++) NEAR(after[k], expected[i][k], 2e-3);
    }
}

/* ---- contacts that depend on each other ---- */
/* A beam falls on three feet: no rigid body tells how they share the blow, their stiffnesses do. */
static void three_feet(double e)
{
    const double at[3] = {-1, 0.2, 1}, k[3] = {1, 4, 2};
    double after[MOST], force = 0, moment = 0;
    begin(3);
    springs.exponent = 1;
    for (int i = 0; i < 3; i++) {
        springs.spring[i] =
            (pm_contact_spring){.stiffness = k[i], .restitution = e, .before = -1 - 0.1 * at[i]};
        for (int j = 0; j < 3; j++) *response_of(i, j) = 1 + 2.5 * at[i] * at[j];
    }
    step_through(1e-3, after);
    EQUAL(pm_contact_springs_follow(&springs), 1);
    for (int i = 0; i < 3; i++) {
        force += springs.spring[i].impulse[0];
        moment += at[i] * springs.spring[i].impulse[0];
        NEAR(springs.spring[i].before, after[i], 5e-3);
    }
    for (int i = 0; i < 3; i++)
        NEAR(springs.spring[i].before, -1 - 0.1 * at[i] + force + 2.5 * at[i] * moment, CLOSE);
}

/* ---- in a scene ---- */
/* Balls that touch in a row: all contacts but the first rest, and take part with their restitution.  Where one has no stiffness
 * the blow is shared by the pace, and counted. */
static void balls_in_a_row(const chain *x, int route, int without)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    *scene_setting(s, PM_SETTING_SIMULTANEOUS) = PM_SIMULTANEOUS_OPEN;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_set(s, PM_SETTING_EXPONENT, x->exponent);
    int rim[MOST], out[MOST];
    double after[MOST];
    for (int i = 0; i < x->n; i++) {
        const int body = scene_body(s, x->mass[i], 1, 2 * i, 0, 0), centre = scene_point(s, body, 0, 0);
        rim[i] = scene_circle(s, centre, 1);
        scene_start_velocity(s, centre, x->velocity[i], 0);
        out[i] = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, centre, PM_PART_X));
    }
    for (int i = 0; i + 1 < x->n; i++) {
        const int c =
            scene_contact(s, PM_CONTACT_CIRCLE, rim[i], rim[i + 1], 1, x->e[i], PM_FRICTION_SMOOTH, 0);
        scene_cell(s, PM_TABLE_CONTACT, c, PM_CONTACT_LAW, PM_LAW_STRONGE);
        if (i != without)
            scene_cell(s, PM_TABLE_CONTACT, c, PM_CONTACT_STIFFNESS, scene_value(s, x->stiffness[i]));
    }
    scene_until_time(s, 0.1);
    EQUAL(scene_run(s, NULL), PM_OK);
    strike(x, after);
    EQUAL(s->count[PM_COUNT_SHARED_BLOWS], without != PM_NONE);
    EQUAL(s->count[PM_COUNT_ORDERED_BLOWS], without != PM_NONE);
    for (int i = 0; i < x->n && without == PM_NONE; i++) NEAR(s->out[out[i]], after[i], 1e-10);
    scene_free(s);
}

static void scenes(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    chain x = {.n = 4, .mass = {1, 2, 1, 3}, .velocity = {1}, .stiffness = {1, 0.5, 3}, .e = {1, 0.8, 0.6}};
    for (int i = 0; i < 3; i++) {
        x.exponent = i % 2 ? 1.5 : 1;
        balls_in_a_row(&x, routes[i], PM_NONE);
        balls_in_a_row(&x, routes[i], 1);
    }
}

int main(void)
{
    pm_arena arena = {0};
    if (pm_contact_springs_create(&springs, &arena, MOST)) return 1;
    two_bodies();
    chains_by_small_steps();
    laws_of_chains();
    longer_steps();
    one_after_the_other();
    three_feet(1);
    three_feet(0.7);
    scenes();
    pm_arena_free(&arena);
    return check_failures();
}

/* Reactions that redundant constraints share: feet that give way together, what is unique of their loads, the least share. */
#include "equations/shared_loads.h"
#include "check.h"
#include "elements/constraint.h"
#include "scene.h"

#define G 9.81
enum { FEET = 3 };
static const double place[FEET] = {-1, 0.5, 1.5};

typedef struct beam {
    scene *s;
    int body, contact[FEET];
} beam;

/* A body on feet at one height with its mass centre over x = 0, pushed by a force c t at a height h above them. */
static beam on_feet(const double *mu, double h, double c, const int *order)
{
    beam x = {.s = scene_create()};
    x.body = scene_body(x.s, 2, 0.5, 0, 0, 0);
    const int line = scene_floor(x.s, 0), at = scene_point(x.s, x.body, 0, h);
    for (int k = 0; k < FEET; k++) {
        const int i = order[k];
        const int foot = scene_circle(x.s, scene_point(x.s, x.body, place[i], 0), 0);
        x.contact[i] = scene_contact(x.s, PM_CONTACT_LINE, foot, line, 0, 0,
                                     mu ? PM_FRICTION_COULOMB : PM_FRICTION_SMOOTH, mu ? mu[i] : 0);
        if (mu)
            x.s->cell[PM_TABLE_CONTACT][k * PM_CONTACT_COLUMNS + PM_CONTACT_STATIC] = scene_value(x.s, mu[i]);
    }
    if (c != 0)
        scene_applied(x.s, at, PM_GROUND,
                      SCENE_PROGRAM(x.s, scene_m(scene_time(x.s)), scene_k(x.s, c), scene_op(PM_OP_MUL)),
                      SCENE_PROGRAM(x.s, scene_k(x.s, 0)));
    return x;
}

static const int orders[3][FEET] = {{0, 1, 2}, {2, 0, 1}, {1, 2, 0}};

/* The same friction everywhere: they slide at mu m g, or it tips over the last foot at m g x / h. */
static void give_way(double mu, double h)
{
    const double all[FEET] = {mu, mu, mu}, c = 7, slides = mu * 2 * G / c,
                 tips = 2 * G * place[FEET - 1] / (h * c);
    for (int k = 0; k < 6; k++) {
        beam x = on_feet(all, h, k < 3 ? c : -c, orders[k % 3]);
        const double back = 2 * G * -place[0] / (h * c), over = k < 3 ? tips : back;
        const int change = slides < over ? PM_TRIGGER_SLIP : PM_TRIGGER_OPEN;
        const int foot = slides < over ? 0 : k < 3 ? 0 : FEET - 1;
        scene_until(x.s, scene_on(x.s, change, x.contact[foot]), 1);
        const int t = scene_ask_measure(x.s, scene_time(x.s));
        EQUAL(scene_run(x.s, NULL), PM_OK);
        NEAR(x.s->out[t], fmin(slides, over), 1e-9);
        scene_free(x.s);
    }
}

static scene_code normal_of(const beam *x, int i)
{
    return scene_m(scene_measure(x->s, PM_MEASURE_CONTACT_NORMAL, x->contact[i]));
}

/* What all distributions agree on has a number; a single load has none. */
static void unique(const int *order)
{
    beam x = on_feet(NULL, 0, 0, order);
    const int one = scene_ask_end(x.s, SCENE_PROGRAM(x.s, normal_of(&x, 0)));
    const int all =
        scene_ask_end(x.s, SCENE_PROGRAM(x.s, normal_of(&x, 0), normal_of(&x, 1), scene_op(PM_OP_ADD),
                                         normal_of(&x, 2), scene_op(PM_OP_ADD)));
    const int least = scene_ask_extreme(x.s, PM_ASK_MIN, SCENE_PROGRAM(x.s, normal_of(&x, 2)), PM_NONE);
    scene_until_time(x.s, 1);
    EQUAL(scene_run(x.s, NULL), PM_OK);
    CHECK(isnan(x.s->out[one]) && isnan(x.s->out[least]));
    EQUAL(x.s->reason[0], PM_REASON_SHARED);
    EQUAL(x.s->reason[1], PM_REASON_NONE);
    EQUAL(x.s->reason[2], PM_REASON_SHARED);
    NEAR(x.s->out[all], 2 * G, 1e-10);
    scene_free(x.s);
}

/* min sum N^2 with sum N = m g and sum x N = 0: N = a + b x. */
static void least(const int *order)
{
    beam x = on_feet(NULL, 0, 0, order);
    double sum = 0, square = 0;
    int out[FEET];
    for (int i = 0; i < FEET; i++) {
        sum += place[i];
        square += place[i] * place[i];
        out[i] = scene_ask_end(x.s, SCENE_PROGRAM(x.s, normal_of(&x, i)));
    }
    *scene_setting(x.s, PM_SETTING_SHARED) = PM_SHARED_LEAST;
    scene_until_time(x.s, 1);
    EQUAL(scene_run(x.s, NULL), PM_OK);
    const double d = FEET * square - sum * sum, a = 2 * G * square / d, b = -2 * G * sum / d;
    for (int i = 0; i < FEET; i++) NEAR(x.s->out[out[i]], a + b * place[i], 1e-9);
    scene_free(x.s);
}

/* The vectors balance: sum z j = 0 over the constraints. */
static void balance(void)
{
    const double mu[FEET] = {0.3, 0.5, 0.2};
    beam x = on_feet(mu, 0, 0, orders[1]);
    scene_until_time(x.s, 1);
    CHECK(scene_begin(x.s) == PM_OK);
    pm_workspace *w = x.s->w;
    CHECK(pm_shared_look_vectors(w) == 3);
    for (int i = 0; i < w->active.shared->n; i++)
        for (int k = 0; k < 3; k++) {
            double sum = 0;
            for (int c = 0; c < w->active.n; c++)
                sum += pm_shared_entry(w, i, c) * w->active.constraint[c].j[k];
            pm_constraint own = w->active.redundant[i];
            pm_constraint_kind(own.kind)->evaluate(&w->frame, &own);
            NEAR(sum + w->active.shared->own[i] * own.j[k], 0, 1e-12);
        }
    scene_free(x.s);
}

/* A body that is pinned at two places: pulls along the line of the pins are shared, what is across is not. */
static void pinned_twice(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.5, 0, 0, 0);
    for (int k = -1; k < 2; k += 2)
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, k, 0), scene_point(s, PM_GROUND, k, 0), 0);
    scene_until_time(s, 1);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_X));
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_Y));
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(isnan(s->out[x]));
    NEAR(s->out[y], G, 1e-10);
    scene_free(s);
}

/* What has become infinite is the same for all distributions: the blows of a block that comes to rest on three feet. */
static void blows_without_end(void)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_RK;
    const int b = scene_body(s, 2, 0.5, 0, 0.4, 0);
    int hit = PM_NONE;
    for (int k = -1; k < 2; k++) {
        const int foot = scene_circle(s, scene_point(s, b, 0.3 * k, -0.2), 0);
        const int c =
            scene_contact(s, PM_CONTACT_LINE, foot, scene_floor(s, 0), 0, 0.3, PM_FRICTION_SMOOTH, 0);
        if (k == 0) hit = scene_on(s, PM_TRIGGER_STRIKE, c);
    }
    scene_until_time(s, 1);
    const int count = scene_ask_count(s, hit);
    const int load = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, 0));
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(isinf(s->out[count]));
    CHECK(isnan(s->out[load]));
    scene_free(s);
}

int main(void)
{
    for (int k = 0; k < 3; k++) {
        unique(orders[k]);
        least(orders[k]);
    }
    give_way(0.4, 0.5);
    give_way(0.2, 0);
    give_way(0.9, 4);
    balance();
    pinned_twice();
    blows_without_end();
    return check_failures();
}

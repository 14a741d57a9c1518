/* let_go.c - what a contact or a bearing holds is too much for a short while, within a step, and it lets go: friction on either side,
 * of which |F| would have a corner between samples, and a floor that can only push.
 *
 * What is to be held goes as s r t (T - t): it passes the limit at t1, where r t (T - t) = limit, and soon falls below it again. */
#include "check.h"
#include "scene.h"

#define CASES 500

typedef struct hump {
    double limit, top, length; /* top: over the limit; length T */
    int side;
} hump;

static hump draw(double limit)
{
    return (hump){limit, check_random(1.01, 1.6), check_random(0.3, 2), check_random(0, 1) < 0.5 ? -1 : 1};
}

static double rate(const hump *x) { return 4 * x->limit * x->top / (x->length * x->length); }

static double first(const hump *x) { return 0.5 * x->length * (1 - sqrt(1 - 1 / x->top)); }

static int program(scene *s, int time, const hump *x)
{
    return SCENE_PROGRAM(s, scene_k(s, x->side * rate(x)), scene_m(time), scene_op(PM_OP_MUL),
                         scene_k(s, x->length), scene_m(time), scene_op(PM_OP_SUB), scene_op(PM_OP_MUL));
}

static void lets_go(scene *s, int route, int trigger, const hump *x)
{
    const int when = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_TIME, trigger));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    scene_until(s, trigger, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[when], first(x), 1e-9);
    scene_free(s);
}

/* A disk on a bearing. */
static void bearing(int route)
{
    const hump x = draw(0.8);
    scene *s = scene_create();
    const int disk = scene_body(s, 1, 0.2, 0, 0, 0), time = scene_time(s);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, disk, 0, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_force(s, PM_FORCE_FRICTION, pin, pin, x.limit, 0);
    scene_couple(s, disk, PM_GROUND, program(s, time, &x));
    lets_go(s, route, scene_on(s, PM_TRIGGER_JOINT_SLIP, pin), &x);
}

/* A block on a floor: pushed along it, or lifted. */
static void block(int route, int lifted)
{
    const double mu = check_random(0.1, 0.6), weight = 9.81;
    hump x = draw(lifted ? weight : mu * weight);
    scene *s = scene_create();
    const int body = scene_body(s, 1, 1, 0, 0, 0), time = scene_time(s), point = scene_point(s, body, 0, 0);
    const int foot = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, point, 0), scene_floor(s, 0), 0, 0,
                                   PM_FRICTION_COULOMB, mu);
    const int nothing = SCENE_PROGRAM(s, scene_k(s, 0));
    if (lifted) x.side = 1;
    const int pushes = program(s, time, &x);
    scene_applied(s, point, PM_GROUND, lifted ? nothing : pushes, lifted ? pushes : nothing);
    lets_go(s, route, scene_on(s, lifted ? PM_TRIGGER_OPEN : PM_TRIGGER_SLIP, foot), &x);
}

int main(void)
{
    static const int route[] = {PM_ROUTE_RK, PM_ROUTE_IDA, PM_ROUTE_AUTO};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < CASES; i++) {
            bearing(route[k]);
            block(route[k], 0);
            block(route[k], 1);
        }
    return check_failures();
}

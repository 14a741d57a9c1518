/* A belt that slips between wheels on fixed axles, against closed forms on the routes that do them: it slips until both wheels run
 * alike, holds up to 2 T tanh(mu wrap / 2), lets go of a couple that grows, passes on no impulse; what the axles carry; a belt
 * that grips and whose tension is known. */
#include "check.h"
#include "scene.h"

static const double at[2] = {0.7, -0.4}, inertia[2] = {0.3, 0.8}, radius[2] = {0.1, 0.25};
static const double tension = 50, mu = 0.3;

typedef struct belt {
    scene *s;
    int wheel[2], pin[2], joint;
    double across,
        most; /* sine of the angle of a strand with the line of centres; what it drives with at most */
} belt;

static belt belt_create(int route, int kind, double sense)
{
    belt x = {.s = scene_create()};
    int circle[2], hub[2];
    *scene_setting(x.s, PM_SETTING_ROUTE) = route;
    for (int k = 0; k < 2; k++) {
        const double place[2] = {k * at[0], k * at[1]};
        x.wheel[k] = scene_body(x.s, 1, inertia[k], place[0], place[1], 0);
        hub[k] = scene_point(x.s, x.wheel[k], 0, 0);
        x.pin[k] = scene_joint(x.s, PM_JOINT_PIN, hub[k], scene_point(x.s, PM_GROUND, place[0], place[1]), 0);
        circle[k] = scene_circle(x.s, hub[k], radius[k]);
    }
    scene_set(x.s, PM_SETTING_GRAVITY_Y, 0);
    x.joint = scene_belt(x.s, kind, circle[0], circle[1], sense, tension);
    x.across = (sense * radius[1] - radius[0]) / hypot(at[0], at[1]);
    const double wrap = 2 * acos(sense * fabs(x.across));
    x.most = 2 * tension * tanh(0.5 * mu * wrap);
    const double pull = 2 * tension * sqrt(1 - x.across * x.across);
    scene_line_force(x.s, hub[0], hub[1], SCENE_PROGRAM(x.s, scene_k(x.s, pull)));
    if (kind == PM_JOINT_BELT_SLIPS) scene_force(x.s, PM_FORCE_FRICTION, x.joint, x.joint, x.most, 0);
    return x;
}

static double mobility(void)
{
    double sum = 0;
    for (int k = 0; k < 2; k++) sum += radius[k] * radius[k] / inertia[k];
    return sum;
}

/* The first wheel turns at first; 0.4 s before the end of the slip, and long after it. */
static void slips(int route, double sense, double omega, int after)
{
    belt x = belt_create(route, PM_JOINT_BELT_SLIPS, sense);
    scene *s = x.s;
    const double end = radius[0] * fabs(omega) / (x.most * mobility()), t = after ? 2 * end : end - 0.4;
    const double slips_for = fmin(t, end), force = copysign(x.most, -omega); /* T_1 - T_2 */
    scene_start_omega(s, x.wheel[0], omega);
    scene_start_omega(s, x.wheel[1], 0);
    scene_until_time(s, t);
    const int spin[2] = {scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.wheel[0])),
                         scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.wheel[1]))};
    const int pull[2] = {scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_NORMAL, x.joint)),
                         scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_FRICTION, x.joint))};
    const int slip = scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_SLIP, x.joint));
    const int axle[2] = {scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, x.pin[0], PM_PART_X)),
                         scene_ask_measure(s, scene_part(s, PM_MEASURE_JOINT_FORCE, x.pin[0], PM_PART_Y))};
    const int sticks = scene_on(s, PM_TRIGGER_JOINT_STICK, x.joint);
    const int times = scene_ask_count(s, sticks);
    EQUAL(scene_run(s, NULL), PM_OK);
    EQUAL(s->out[times], after);
    EQUAL(s->count[PM_COUNT_ROUTE], route == PM_ROUTE_AUTO ? PM_ROUTE_UNIFORM : route);
    const double w[2] = {omega + force * radius[0] / inertia[0] * slips_for,
                         -sense * force * radius[1] / inertia[1] * slips_for};
    for (int k = 0; k < 2; k++) NEAR(s->out[spin[k]], w[k], 1e-10);
    const double drives = after ? 0 : force;
    NEAR(s->out[pull[0]], tension + 0.5 * drives, 1e-9);
    NEAR(s->out[pull[1]], tension - 0.5 * drives, 1e-9);
    NEAR(s->out[slip], after ? 0 : radius[0] * w[0] - sense * radius[1] * w[1], 1e-10);
    const double distance = hypot(at[0], at[1]), n[2] = {at[0] / distance, at[1] / distance};
    const double along = -2 * tension * sqrt(1 - x.across * x.across), aside = drives * x.across;
    NEAR(s->out[axle[0]], along * n[0] - aside * n[1], 1e-9);
    NEAR(s->out[axle[1]], along * n[1] + aside * n[0], 1e-9);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-10 && s->audit[PM_AUDIT_MOMENTUM] < 1e-10);
    scene_free(s);
}

/* A couple that grows out of rest turns both wheels, until the belt lets go: I_2 alpha_2 = r_2 F. */
static void lets_go(int route, double sense, double rate)
{
    belt x = belt_create(route, PM_JOINT_BELT_SLIPS, sense);
    scene *s = x.s;
    scene_couple(s, x.wheel[0], PM_GROUND,
                 SCENE_PROGRAM(s, scene_m(scene_time(s)), scene_k(s, rate), scene_op(PM_OP_MUL)));
    const int event = scene_on(s, PM_TRIGGER_JOINT_SLIP, x.joint);
    scene_until(s, event, 1);
    const int when = scene_ask_measure(s, scene_time(s));
    const int spin = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.wheel[1]));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double ratio = sense * radius[0] / radius[1], whole = inertia[0] + ratio * ratio * inertia[1];
    const double t = x.most * radius[1] / inertia[1] * whole / fabs(ratio * rate);
    NEAR(s->out[when], t, 1e-9 * t);
    NEAR(s->out[spin], 0.5 * ratio * rate * t * t / whole, 1e-8);
    scene_free(s);
}

/* An angular impulse on the first wheel: a belt that slips leaves the other one as it is, one that grips takes it along. */
static void struck(int kind, double sense)
{
    belt x = belt_create(PM_ROUTE_AUTO, kind, sense);
    scene *s = x.s;
    const int begin = scene_on(s, PM_TRIGGER_START, PM_NONE);
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_ANGULAR, begin, PM_NONE, x.wheel[0],
              SCENE_PROGRAM(s, scene_k(s, 6)), PM_NONE);
    scene_until_time(s, 1e-9);
    const int spin[2] = {scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.wheel[0])),
                         scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.wheel[1]))};
    EQUAL(scene_run(s, NULL), PM_OK);
    const double ratio = sense * radius[0] / radius[1];
    const int grips = kind == PM_JOINT_BELT_GRIPS;
    const double omega = 6 / (inertia[0] + (grips ? ratio * ratio * inertia[1] : 0));
    NEAR(s->out[spin[0]], omega, 1e-6);
    NEAR(s->out[spin[1]], grips ? ratio * omega : 0, 1e-6);
    scene_free(s);
}

/* One that grips: what the strands carry differs by what it drives with, however much. */
static void grips(int route, double sense)
{
    const double couple = -20;
    belt x = belt_create(route, PM_JOINT_BELT_GRIPS, sense);
    scene *s = x.s;
    scene_couple(s, x.wheel[0], PM_GROUND, SCENE_PROGRAM(s, scene_k(s, couple)));
    scene_until_time(s, 0.5);
    const int pull[2] = {scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_NORMAL, x.joint)),
                         scene_ask_measure(s, scene_measure(s, PM_MEASURE_JOINT_FRICTION, x.joint))};
    const int spin = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.wheel[1]));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double ratio = sense * radius[0] / radius[1],
                 alpha = couple / (inertia[0] + ratio * ratio * inertia[1]),
                 force = (inertia[0] * alpha - couple) / radius[0];
    NEAR(s->out[pull[0]], tension + 0.5 * force, 1e-9);
    NEAR(s->out[pull[1]], tension - 0.5 * force, 1e-9);
    NEAR(s->out[spin], 0.5 * ratio * alpha, 1e-9);
    scene_free(s);
}

/* A circle that reaches over the other one, or nearly. */
static void reaches_over(int kind, double beyond)
{
    belt x = belt_create(PM_ROUTE_AUTO, kind, 1);
    scene *s = x.s;
    const double large = radius[0] + hypot(at[0], at[1]) + beyond;
    scene_cell(s, PM_TABLE_CIRCLE, 1, PM_CIRCLE_RADIUS, scene_value(s, large));
    scene_until_time(s, 0.1);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.wheel[0]));
    EQUAL(scene_run(s, NULL), beyond > 0 ? PM_ASSEMBLY : PM_OK);
    scene_free(s);
}

int main(void)
{
    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (double sense = -1; sense < 2; sense += 2) {
        for (int i = 0; i < 3; i++) {
            for (int after = 0; after < 2; after++) {
                slips(routes[i], sense, 40, after);
                slips(routes[i], sense, -40, after);
            }
            lets_go(routes[i], sense, 3);
            lets_go(routes[i], sense, -3);
            grips(routes[i], sense);
        }
        struck(PM_JOINT_BELT_SLIPS, sense);
        struck(PM_JOINT_BELT_GRIPS, sense);
    }
    for (int kind = PM_JOINT_BELT_GRIPS; kind <= PM_JOINT_BELT_SLIPS; kind++) {
        reaches_over(kind, 0.01);
        reaches_over(kind, -0.01);
    }
    return check_failures();
}

/* What no answer depends on is left out: a scene with idle parts has the very bits of the scene without them, and whatever
 * one body can do to another is found: what is asked of the one is the same whether the other is asked, too, or not. */
#include <string.h>

#include "check.h"
#include "scene.h"

/* ---- idle parts ---- */
/* A pendulum of two rods from (x, 0), and what may be on it: an event that acts, a contact, a start value. */
static void idle(scene *s, double x)
{
    const int a = scene_body(s, 1, 0.1, x + 0.5, 0, 0), b = scene_body(s, 2, 0.2, x + 1.5, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, a, -0.5, 0), scene_point(s, PM_GROUND, x, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, a, 0.5, 0), 0);
    scene_start_omega(s, b, 1);
    const int end = scene_circle(s, scene_point(s, b, 0.5, 0), 0.05);
    scene_contact(s, PM_CONTACT_LINE, end, scene_line(s, scene_point(s, PM_GROUND, x, -1.5), 0), 0, 0.5,
                  PM_FRICTION_COULOMB, 0.2);
    scene_force(s, PM_FORCE_ROTARY_DAMPER, a, b, 0.1, 0);
    const int fall =
        scene_when(s, PM_TRIGGER_FALL, scene_minus(s, scene_measure(s, PM_MEASURE_ANGLE, a), -0.4));
    SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_ANGULAR, fall, PM_NONE, a,
              SCENE_PROGRAM(s, scene_k(s, 0.3), scene_m(scene_measure(s, PM_MEASURE_OMEGA, b)),
                            scene_op(PM_OP_MUL)),
              PM_NONE);
}

/* A rod swings down and strikes a stop; `parts` idle pendulums are written before it and as many behind. */
static scene *rod(int parts)
{
    scene *s = scene_create();
    for (int i = 0; i < parts; i++) idle(s, 5.0 * (i + 1));
    const int b = scene_body(s, 2, 2 / 12.0, 0.5, 0, 0), tip = scene_point(s, b, 0.5, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    const int stop =
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, tip, 0),
                      scene_line(s, scene_point(s, PM_GROUND, 0, -0.9), 0), 0, 0.6, PM_FRICTION_SMOOTH, 0);
    for (int i = 0; i < parts; i++) idle(s, -5.0 * (i + 1));
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, stop);
    scene_until_time(s, 1.5);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    scene_ask_event(s, scene_read(s, scene_time(s)), strike, 1, 0);
    scene_ask_extreme(s, PM_ASK_MAX,
                      scene_read(s, scene_part(s, PM_MEASURE_JOINT_FORCE, parts * 2, PM_PART_NORM)), PM_NONE);
    return s;
}

static void idle_parts_cost_nothing(int route)
{
    scene *alone = rod(0);
    *scene_setting(alone, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(alone, NULL), PM_OK);
    for (int parts = 1; parts <= 3; parts += 2) {
        scene *s = rod(parts);
        *scene_setting(s, PM_SETTING_ROUTE) = route;
        EQUAL(scene_run(s, NULL), PM_OK);
        for (int i = 0; i < s->nout; i++) EQUAL(memcmp(&s->out[i], &alone->out[i], sizeof(double)), 0);
        EQUAL(memcmp(s->audit, alone->audit, sizeof s->audit), 0);
        EQUAL(memcmp(s->count, alone->count, sizeof s->count), 0);
        scene_free(s);
    }
    scene_free(alone);
}

/* What fails is told by the rows of the caller. */
static void places_are_the_callers(void)
{
    scene *s = scene_create();
    idle(s, 1);
    const int b = scene_body(s, 1, 0.1, 0, 0, 0);
    const int link =
        scene_joint(s, PM_JOINT_LINK, scene_point(s, b, 0.5, 0), scene_point(s, PM_GROUND, 3, 0), -1);
    scene_until_time(s, 1);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    EQUAL(scene_run(s, NULL), PM_BAD_VALUE);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_JOINT);
    EQUAL(s->where[PM_WHERE_ROW], link);
    scene_free(s);
}

/* ---- whatever couples ---- */
enum coupling {
    SPRING,
    TOUCH,
    FORCE_READS,
    AXES,
    EVENT_ADDS,
    EVENT_STRIKES,
    ENDS,
    START_RELATIVE,
    TOTAL_ENERGY,
    LAST_JUMP,
    CONDITION,
    COUPLINGS
};

/* Disc b on a spring goes down to the floor and back, disc a is free; without weight. */
static scene *pair(int coupling, int ask_both)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.3, 3, 0, 0), a = scene_body(s, 1, 0.2, 0, 0, 0);
    const int pa = scene_point(s, a, 0.1, 0.2), pb = scene_point(s, b, 0, 0.1);
    scene_force(s, PM_FORCE_SPRING, pb, scene_point(s, PM_GROUND, 3, 2), 40, 1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_start_omega(s, b, 2);
    scene_start_velocity(s, scene_point(s, b, 0, 0), 0, -5);
    const int time = scene_time(s), yb = scene_part(s, PM_MEASURE_POSITION, pb, PM_PART_Y);
    const int omega = scene_measure(s, PM_MEASURE_OMEGA, a);
    const int low = scene_when(s, PM_TRIGGER_FALL, scene_read(s, yb));
    const int zero = SCENE_PROGRAM(s, scene_k(s, 0)), five = SCENE_PROGRAM(s, scene_k(s, 5));
    const int ca = scene_circle(s, scene_point(s, a, 0, 0), 0.3),
              cb = scene_circle(s, scene_point(s, b, 0, 0), 0.4);
    const int ground =
        scene_contact(s, PM_CONTACT_LINE, cb, scene_line(s, scene_point(s, PM_GROUND, 0, -0.6), 0), 0, 0.5,
                      PM_FRICTION_SMOOTH, 0);
    double end = 0.8;
    switch (coupling) {
    case SPRING: scene_force(s, PM_FORCE_SPRING, pa, pb, 5, 1); break;
    case TOUCH:
        scene_contact(s, PM_CONTACT_CIRCLE, ca, cb, 1, 0.5, PM_FRICTION_COULOMB, 0.3);
        scene_start_velocity(s, scene_point(s, a, 0, 0), 4, 3);
        break;
    case FORCE_READS: scene_applied(s, pa, PM_GROUND, scene_read(s, yb), zero); break;
    case AXES: scene_applied(s, pa, b, five, zero); break;
    case EVENT_ADDS:
        SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_REMOVE, low, PM_TABLE_FORCE,
                  scene_couple(s, a, PM_GROUND, five), PM_NONE, PM_NONE);
        break;
    case EVENT_STRIKES:
        SCENE_ROW(s, PM_TABLE_ACTION, PM_ACTION_IMPULSE, scene_on(s, PM_TRIGGER_STRIKE, ground), PM_NONE, pa,
                  five, zero);
        break;
    case ENDS:
        scene_couple(s, a, PM_GROUND, five);
        scene_until(s, low, 1);
        end = 5;
        break;
    case START_RELATIVE: /* what is said of b tells the spin of a */
        scene_start(s, PM_START_VELOCITY,
                    scene_measure_with(s, PM_MEASURE_OMEGA, b, PM_PART_NONE, PM_MEASURE_IN, a), 3);
        break;
    case TOTAL_ENERGY: break;
    case LAST_JUMP: break;
    default: scene_couple(s, a, PM_GROUND, SCENE_PROGRAM(s, scene_m(yb), scene_k(s, 0), scene_op(PM_OP_LT)));
    }
    scene_until_time(s, end);
    scene_ask_measure(s, coupling == TOTAL_ENERGY ? scene_measure(s, PM_MEASURE_KINETIC, PM_NONE)
                         : coupling == LAST_JUMP  ? scene_measure(s, PM_MEASURE_LOST, PM_NONE)
                                                  : omega);
    scene_ask_measure(s, time);
    if (ask_both) scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    return s;
}

static void couplings_are_found(void)
{
    for (int k = 0; k < COUPLINGS; k++) {
        scene *one = pair(k, 0), *both = pair(k, 1);
        EQUAL(scene_run(one, NULL), PM_OK);
        EQUAL(scene_run(both, NULL), PM_OK);
        CHECK(both->out[0] != 0);
        NEAR(one->out[0], both->out[0], 0);
        NEAR(one->out[1], both->out[1], 0);
        scene_free(one);
        scene_free(both);
    }
}

static void needs(void)
{
    scene *s = pair(AXES, 0);
    int32_t body[2], force[2], event[2], where[PM_WHERE_COLUMNS];
    double detail[PM_DETAIL_COLUMNS];
    scene_pack(s);
    EQUAL(pm_needs(s->ntable, s->table, s->nconstant, s->constant, 0, PM_TABLE_BODY, 2, body, where, detail),
          PM_OK);
    CHECK(body[0] && body[1]);
    scene_free(s);
    s = pair(TOTAL_ENERGY, 0);
    scene_cell(s, PM_TABLE_MEASURE, s->rows[PM_TABLE_MEASURE] - 1, PM_MEASURE_A, 1); /* of body a alone */
    scene_pack(s);
    EQUAL(pm_needs(s->ntable, s->table, s->nconstant, s->constant, 0, PM_TABLE_BODY, 2, body, where, detail),
          PM_OK);
    CHECK(!body[0] && body[1]);
    EQUAL(
        pm_needs(s->ntable, s->table, s->nconstant, s->constant, 0, PM_TABLE_FORCE, 1, force, where, detail),
        PM_OK);
    CHECK(!force[0]);
    EQUAL(
        pm_needs(s->ntable, s->table, s->nconstant, s->constant, 0, PM_TABLE_EVENT, 2, event, where, detail),
        PM_OK);
    CHECK(!event[0] && event[1]);
    EQUAL(pm_needs(s->ntable, s->table, s->nconstant, s->constant, 0, PM_TABLE_BODY, 3, body, where, detail),
          PM_BAD_TABLE);
    scene_free(s);
}

int main(void)
{
    idle_parts_cost_nothing(PM_ROUTE_RK);
    idle_parts_cost_nothing(PM_ROUTE_AUTO);
    places_are_the_callers();
    couplings_are_found();
    needs();
    return check_failures();
}

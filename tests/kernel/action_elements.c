/* Actions that add and remove: pins in flight, floors, springs, what does not fit. */
#include "actions.h"
#include "check.h"
#include "scene.h"

#define GRAVITY 9.81

/* A flying rod is pinned at its end when it is there: angular momentum about the pin is kept, the rest is lost; let go
 * again at once, it flies on freely. */
static void pinned_in_flight(int let_go)
{
    const double m = 1.7, l = 0.9, inertia = m * l * l / 12, vx = 0.7, vy = 1.9, spin = 2.2;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, m, inertia, 0, 0, 0), g = scene_point(s, b, 0, 0);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, l / 2, 0), scene_point(s, PM_GROUND, l / 2, 0), 0);
    take(s, PM_NONE, PM_TABLE_JOINT, pin);
    scene_start_velocity(s, g, vx, vy);
    scene_start_omega(s, b, spin);
    const int e = start_event(s);
    add(s, e, PM_TABLE_JOINT, pin);
    if (let_go) take(s, e, PM_TABLE_JOINT, pin);
    const double omega_1 = (inertia * spin - m * vy * l / 2) / (inertia + m * l * l / 4);
    const double kinetic = 0.5 * (m * (vx * vx + vy * vy) + inertia * spin * spin);
    const int omega = ask(s, PM_MEASURE_OMEGA, b), y = ask_part(s, PM_MEASURE_VELOCITY, g, PM_PART_NORM);
    const int lost = ask(s, PM_MEASURE_LOST, PM_NONE),
              force = ask_part(s, PM_MEASURE_JOINT_FORCE, 0, PM_PART_NORM);
    scene_until_time(s, 0.5);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[omega], omega_1, 1e-10);
    NEAR(s->out[y], fabs(omega_1) * l / 2, 1e-10);
    NEAR(s->out[lost], kinetic - 0.5 * (inertia + m * l * l / 4) * omega_1 * omega_1, 1e-11);
    NEAR(s->out[force], let_go ? 0 : m * omega_1 * omega_1 * l / 2, 1e-8);
    closes(s);
    scene_free(s);
}

/* Of a joint that is added its partners must be there. */
static void does_not_fit(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, 0, 0);
    const int pin =
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, 0.5, 0), scene_point(s, PM_GROUND, 0.5, 0), 0);
    take(s, PM_NONE, PM_TABLE_JOINT, pin);
    const int e = at_time(s, 0.5);
    add(s, e, PM_TABLE_JOINT, pin);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_ASSEMBLY);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_ACTION);
    EQUAL(s->where[PM_WHERE_ROW], 1);
    NEAR(s->detail[PM_DETAIL_VALUE], 0.5 * GRAVITY * 0.25, 1e-9);
    NEAR(s->detail[PM_DETAIL_TIME], 0.5, 1e-12);
    scene_free(s);
}

static void overlaps(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.1, 0, 0.3, 0), circle = scene_circle(s, scene_point(s, b, 0, 0), 0.1);
    const int floor =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
    take(s, PM_NONE, PM_TABLE_CONTACT, floor);
    add(s, at_time(s, 0.25), PM_TABLE_CONTACT, floor);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_PENETRATION);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_ACTION);
    NEAR(s->detail[PM_DETAIL_VALUE], 0.2 - 0.5 * GRAVITY * 0.0625, 1e-9);
    scene_free(s);
}

/* A ball bounces on a floor that is taken away at t1 and comes back at t2, below a second one. */
static void floors(int route)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int b = scene_body(s, 1, 0, 0, 1, 0), g = scene_point(s, b, 0, 0), circle = scene_circle(s, g, 0);
    const int high =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, 1, PM_FRICTION_SMOOTH, 0);
    const int low =
        scene_contact(s, PM_CONTACT_LINE, circle, scene_line(s, scene_point(s, PM_GROUND, 0, -1), 0), 0, 0,
                      PM_FRICTION_SMOOTH, 0);
    const int e = at_time(s, 0.5);
    take(s, PM_NONE, PM_TABLE_CONTACT, low);
    take(s, e, PM_TABLE_CONTACT, high);
    add(s, e, PM_TABLE_CONTACT, low);
    const int struck = scene_on(s, PM_TRIGGER_STRIKE, low);
    scene_until_time(s, 3);
    const double fall = sqrt(2 / GRAVITY), v = GRAVITY * fall,
                 from = 0.5 - fall; /* first strike before t = 0.5 */
    const int time = ask(s, PM_MEASURE_EVENT_TIME, struck),
              y = ask_part(s, PM_MEASURE_POSITION, g, PM_PART_Y);
    const int normal = ask(s, PM_MEASURE_CONTACT_NORMAL, low), none = ask(s, PM_MEASURE_CONTACT_CLOSED, high);
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(from > 0);
    NEAR(s->out[time], fall + (v + sqrt(v * v + 2 * GRAVITY)) / GRAVITY, 1e-9);
    NEAR(s->out[y], -1, 1e-11);
    NEAR(s->out[normal], GRAVITY, 1e-9);
    EQUAL(s->out[none], 0);
    closes(s);
    scene_free(s);
}

/* A spring holds a weight; taken away, the weight falls; its work stays what it was, and the ledger closes. */
static void spring_goes(void)
{
    const double m = 2, k = 40;
    scene *s = scene_create();
    const int b = scene_body(s, m, 0, 0, -1, 0), g = scene_point(s, b, 0, 0);
    const int spring = scene_force(s, PM_FORCE_SPRING, g, scene_point(s, PM_GROUND, 0, 0), k, 0.2);
    const int e = at_time(s, 0.4), again = at_time(s, 0.6);
    take(s, e, PM_TABLE_FORCE, spring);
    add(s, again, PM_TABLE_FORCE, spring);
    const int w = scene_measure(s, PM_MEASURE_FORCE_WORK, spring),
              y = scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y);
    const int v = scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y);
    const int y_1 = scene_ask_event(s, scene_read(s, y), e, 1, 0),
              v_1 = scene_ask_event(s, scene_read(s, v), e, 1, 0);
    const int w_1 = scene_ask_event(s, scene_read(s, w), e, 1, 0);
    const int y_2 = scene_ask_event(s, scene_read(s, y), again, 1, 1),
              w_2 = scene_ask_event(s, scene_read(s, w), again, 1, 1);
    const int v_3 = scene_ask_measure(s, v), y_3 = scene_ask_measure(s, y), w_3 = scene_ask_measure(s, w);
    scene_until_time(s, 0.9);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[y_2], s->out[y_1] + 0.2 * s->out[v_1] - 0.5 * GRAVITY * 0.04, 1e-9);
    NEAR(s->out[w_1], 0.5 * m * s->out[v_1] * s->out[v_1] + m * GRAVITY * (s->out[y_1] + 1), 1e-8);
    NEAR(s->out[w_2], s->out[w_1], 1e-12);
    NEAR(s->out[w_3], 0.5 * m * s->out[v_3] * s->out[v_3] + m * GRAVITY * (s->out[y_3] + 1), 1e-8);
    closes(s);
    scene_free(s);
}

int main(void)
{
    pinned_in_flight(0);
    pinned_in_flight(1);
    does_not_fit();
    overlaps();
    floors(PM_ROUTE_RK);
    floors(PM_ROUTE_UNIFORM);
    floors(PM_ROUTE_IDA);
    spring_goes();
    return check_failures();
}

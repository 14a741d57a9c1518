/* Blows one by one: a rod that strikes three times, a cradle, a ball between floor and ceiling, runs that end in between. */
#include "check.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"
#include "struck.h"

/* ---- one by one ---- */
static void one_by_one(scene *s) { *scene_setting(s, PM_SETTING_SIMULTANEOUS) = PM_SIMULTANEOUS_ONE_BY_ONE; }

/* A falling rod on two supports: left, right, left again; each strike is an event of its own at t = 0. */
static void rod_strikes_three_times(void)
{
    const double m = 2, half = 0.6, i = m * half * half / 3, v = 1.7;
    scene *s = scene_create();
    const int b = scene_body(s, m, i, 0, 0, 0), g = scene_point(s, b, 0, 0), line = scene_floor(s, 0);
    int strike[2], ask[3][3], contact[2];
    for (int k = 0; k < 2; k++) {
        const int end = scene_circle(s, scene_point(s, b, k ? half : -half, 0), 0);
        contact[k] = scene_contact(s, PM_CONTACT_LINE, end, line, 0, 1, PM_FRICTION_SMOOTH, 0);
        strike[k] = scene_on(s, PM_TRIGGER_STRIKE, contact[k]);
    }
    const int vy = scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y)),
              omega = scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, b)),
              lost = scene_read(s, scene_measure(s, PM_MEASURE_LOST, PM_NONE));
    const int turned = scene_when(s, PM_TRIGGER_CROSS,
                                  omega); /* the second blow carries the spin through zero, the third to it */
    for (int k = 0; k < 3; k++) {
        ask[k][0] = scene_ask_event(s, vy, strike[k % 2], 1 + k / 2, 0);
        ask[k][1] = scene_ask_event(s, omega, strike[k % 2], 1 + k / 2, 0);
        ask[k][2] = scene_ask_event(s, vy, strike[k % 2], 1 + k / 2, 1);
    }
    const int loss = scene_ask_end(s, lost);
    const int turns = scene_ask_count(s, turned);
    scene_until_time(s, 0.01);
    scene_start_velocity(s, g, 0, -v);
    one_by_one(s);
    EQUAL(scene_run(s, NULL), PM_OK);
    double u = -v, w = 0;
    for (int k = 0; k < 3; k++) {
        const double arm = k == 1 ? half : -half, p = -2 * (u + w * arm) / (1 / m + arm * arm / i);
        NEAR(s->out[ask[k][2]], u, CLOSE);
        u += p / m;
        w += p * arm / i;
        NEAR(s->out[ask[k][0]], u, CLOSE);
        NEAR(s->out[ask[k][1]], w, CLOSE);
    }
    NEAR(u, v, CLOSE);
    NEAR(s->out[loss], 0, CLOSE);
    EQUAL(s->out[turns], 2);
    EQUAL(s->count[PM_COUNT_JUMPS], 3);
    CHECK(s->audit[PM_AUDIT_ENERGY] < CLOSE && s->audit[PM_AUDIT_MOMENTUM] < CLOSE);
    scene_free(s);
}

/* The end of the run may lie between two blows of one instant. */
static void ends_between_blows(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.12, 0, 0, 0), g = scene_point(s, b, 0, 0), line = scene_floor(s, 0);
    for (int k = -1; k <= 1; k += 2)
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, 0.6 * k, 0), 0), line, 0, 1,
                      PM_FRICTION_SMOOTH, 0);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b)),
              first = scene_on(s, PM_TRIGGER_STRIKE, 0), second = scene_on(s, PM_TRIGGER_STRIKE, 1);
    const int count = scene_ask_count(s, second);
    scene_until(s, first, 1);
    scene_start_velocity(s, g, 0, -1);
    one_by_one(s);
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    NEAR(s->out[omega], -0.6 / 0.12 * 2 / (1 + 0.36 / 0.12), CLOSE);
    EQUAL(s->out[count], 0);
    EQUAL(s->count[PM_COUNT_JUMPS], 1);
    scene_free(s);
}

/* Equal elastic balls in a row hand the blow on; together they would share it.  Also those that rest. */
static void cradle(int n)
{
    scene *s = scene_create();
    int circle[5], velocity[5];
    for (int i = 0; i < n; i++) {
        const int g = scene_point(s, scene_body(s, 1, 0.1, 0.4 * i, 0.2, 0), 0, 0);
        circle[i] = scene_circle(s, g, 0.2);
        velocity[i] = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X));
        scene_contact(s, PM_CONTACT_LINE, circle[i], scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
        if (i == 0) scene_start_velocity(s, g, 2, 0);
    }
    for (int i = n - 1; i > 0; i--) /* against the way of the blow: every order gives the same here */
        scene_contact(s, PM_CONTACT_CIRCLE, circle[i - 1], circle[i], 1, 1, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 0.1);
    one_by_one(s);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < n; i++) NEAR(s->out[velocity[i]], i == n - 1 ? 2 : 0, CLOSE);
    EQUAL(s->count[PM_COUNT_JUMPS], n - 1);
    scene_free(s);
}

/* A ball that fits between floor and ceiling: elastic, it would strike for ever; else it comes to rest. */
static void between_floor_and_ceiling(void)
{
    static const double restitution[] = {1, 0.5};
    for (int k = 0; k < 2; k++) {
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0.1, 0, 0.2, 0), g = scene_point(s, b, 0, 0),
                  circle = scene_circle(s, g, 0.2);
        const int above = scene_line(s, scene_point(s, PM_GROUND, 0, 0.4), 2 * acos(0.));
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, restitution[k], PM_FRICTION_SMOOTH,
                      0);
        scene_contact(s, PM_CONTACT_LINE, circle, above, 0, restitution[k], PM_FRICTION_SMOOTH, 0);
        const int vy = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y));
        scene_start_velocity(s, g, 1, -3);
        scene_until_time(s, 0.1);
        one_by_one(s);
        EQUAL(scene_run(s, NULL), k ? PM_OK : PM_BLOWS_ENDLESS);
        if (k) NEAR(s->out[vy], 0, CLOSE);
        if (!k) CHECK(s->detail[PM_DETAIL_BOUND] > 1000);
        scene_free(s);
    }
}

int main(void)
{
    rod_strikes_three_times();
    ends_between_blows();
    for (int n = 2; n <= 5; n++) cradle(n);
    between_floor_and_ceiling();
    return check_failures();
}

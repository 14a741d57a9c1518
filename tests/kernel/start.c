/* Assembly of the start: what is written stays, the rest moves as little as possible; contradictions, open motions and
 * overlaps are told with their place. */
#include "check.h"
#include "scene.h"

typedef struct start {
    int32_t info[PM_CHECK_COLUMNS], where[PM_WHERE_COLUMNS];
    double number[PM_CHECK_NUMBERS], pose[24][3], velocity[24][3], detail[PM_DETAIL_COLUMNS];
    int status;
    int32_t joint[64], contact[64];
} start;

static start check_scene(scene *s)
{
    start x = {.status = 0};
    const double none = 0;
    scene_pack(s);
    x.status = pm_check(s->ntable, s->table, s->nconstant, s->constant, s->nparam, &none, NULL, x.info,
                        x.number, s->rows[PM_TABLE_BODY], x.pose[0], x.velocity[0], 64, x.joint, 64,
                        x.contact, x.where, x.detail);
    return x;
}

/* A rod hung on a pin, drawn with its end off by (dx, dy). */
static scene *pendulum(double dx, double dy)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.5, 0.5 + dx, dy, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_until_time(s, 1);
    return s;
}

/* The least motion in the metric of M onto the pin: found here by search over the angle. */
static void moves_least(void)
{
    const double dx = 0.03, dy = 0.05;
    scene *s = pendulum(dx, dy);
    const start x = check_scene(s);
    EQUAL(x.status, PM_OK);
    double best = INFINITY, angle = 0;
    for (int i = 0; i <= 200000; i++) {
        const double a = -0.2 + 2e-6 * i, ex = 0.5 * cos(a) - 0.5 - dx, ey = 0.5 * sin(a) - dy;
        const double cost = 2 * (ex * ex + ey * ey) + 0.5 * a * a;
        if (cost < best) {
            best = cost;
            angle = a;
        }
    }
    NEAR(x.pose[0][2], angle, 3e-3); /* steps of Gauss and Newton are least each, their sum nearly so */
    NEAR(x.pose[0][0] - 0.5 * cos(x.pose[0][2]), 0, 1e-14);
    NEAR(x.pose[0][1] - 0.5 * sin(x.pose[0][2]), 0, 1e-14);
    CHECK(x.number[PM_CHECK_MOVED] > 0.02 && x.number[PM_CHECK_MOVED] < 0.06);
    CHECK(x.number[PM_CHECK_OPENING] < 1e-14);
    EQUAL(x.info[PM_CHECK_COORDINATES], 3);
    EQUAL(x.info[PM_CHECK_CONSTRAINTS], 2);
    EQUAL(x.info[PM_CHECK_REDUNDANT], 0);
    EQUAL(x.info[PM_CHECK_FREEDOM], 1);
    scene_free(s);

    s = pendulum(0, 0);
    EQUAL(check_scene(s).number[PM_CHECK_MOVED], 0);
    scene_free(s);
}

static void keeps_what_is_written(void)
{
    scene *s = pendulum(0.1, -0.1);
    scene_start(s, PM_START_POSITION, scene_measure(s, PM_MEASURE_ANGLE, 0), 0.6);
    scene_start_omega(s, 0, -1.5);
    const start x = check_scene(s);
    EQUAL(x.status, PM_OK);
    NEAR(x.pose[0][2], 0.6, 1e-15);
    NEAR(x.velocity[0][2], -1.5, 1e-15);
    NEAR(x.velocity[0][0], 0.75 * sin(0.6), 1e-14);
    NEAR(x.velocity[0][1], -0.75 * cos(0.6), 1e-14);
    scene_free(s);
}

/* A part of a velocity that is zero but for rounding is written as zero, beside the angular velocity that it follows from. */
static void zero_is_written(void)
{
    scene *s = pendulum(0, 0);
    const int g = scene_point(s, 0, 0, 0);
    scene_start(s, PM_START_POSITION, scene_measure(s, PM_MEASURE_ANGLE, 0), -0.25 * 6.283185307179586);
    scene_start_omega(s, 0, 2);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y), 0);
    EQUAL(check_scene(s).status, PM_OK);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X), 1 + 1e-7);
    EQUAL(check_scene(s).status, PM_START_CONFLICT);
    scene_free(s);
}

/* A slider-crank from a rough drawing; the crank's angle is written. */
static void slider_crank(void)
{
    scene *s = scene_create();
    const int crank = scene_body(s, 1, 0.01, 0.1, 0.05, 0.3), rod = scene_body(s, 2, 0.1, 0.5, 0.1, -0.1),
              piston = scene_body(s, 1, 0, 0.8, 0.05, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, -0.1, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, 0.1, 0), scene_point(s, rod, -0.35, 0), 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, 0.35, 0), scene_point(s, piston, 0, 0), 0);
    scene_joint(s, PM_JOINT_SLIDER, scene_point(s, piston, 0, 0), scene_floor(s, 0), 0);
    scene_start(s, PM_START_POSITION, scene_measure(s, PM_MEASURE_ANGLE, crank), 0.9);
    scene_start_omega(s, crank, 10);
    scene_until_time(s, 0.1);
    const start x = check_scene(s);
    const double beta = asin(0.2 * sin(0.9) / 0.7), place = 0.2 * cos(0.9) + 0.7 * cos(beta);
    EQUAL(x.status, PM_OK);
    NEAR(x.pose[2][0], place, 1e-13);
    NEAR(x.velocity[1][2], -2 * cos(0.9) / (0.7 * cos(beta)), 1e-12);
    NEAR(x.velocity[2][0], -2 * sin(0.9) - 2 * cos(0.9) * tan(beta), 1e-12);
    scene_free(s);
}

/* BARS parallelograms in a row, roughly drawn: so many joints that their rows are solved as one block. */
#define BARS 6
static scene *parallelograms(void)
{
    scene *s = scene_create();
    for (int i = 0; i <= BARS; i++) {
        const int crank = scene_body(s, 1, 0.1, i + 0.3, 0.4 + 0.01 * i, 0.9);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, crank, -0.5, 0), scene_point(s, PM_GROUND, i, 0), 0);
        if (i == 0) continue;
        const int bar = scene_body(s, 2, 0.2, i + 0.05, 0.8, 0.02), before = i == 1 ? 0 : bar - 3;
        scene_joint(s, PM_JOINT_PIN, scene_point(s, bar, -0.5, 0), scene_point(s, before, 0.5, 0), 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, bar, 0.5, 0), scene_point(s, crank, 0.5, 0), 0);
    }
    scene_start(s, PM_START_POSITION, scene_measure(s, PM_MEASURE_ANGLE, 0), 0.9);
    scene_until_time(s, 0.01);
    return s;
}

static void many_rows(void)
{
    scene *s = parallelograms();
    scene_start_omega(s, 3, 1.5);
    start x = check_scene(s);
    EQUAL(x.status, PM_OK);
    for (int i = 0; i <= BARS; i++) {
        const int crank = i == 0 ? 0 : 2 * i - 1;
        NEAR(x.pose[crank][2], 0.9, 1e-13);
        NEAR(x.pose[crank][0], i + 0.5 * cos(0.9), 1e-13);
        NEAR(x.velocity[crank][2], 1.5, 1e-13);
        if (i == 0) continue;
        NEAR(x.pose[crank + 1][1], sin(0.9), 1e-13);
        NEAR(x.velocity[crank + 1][0], -1.5 * sin(0.9), 1e-13);
        NEAR(x.velocity[crank + 1][2], 0, 1e-13);
    }
    scene_start_omega(s, 0, 1.5); /* said twice */
    EQUAL(check_scene(s).status, PM_OK);
    scene_start_omega(s, 1, 1.6);
    x = check_scene(s);
    EQUAL(x.status, PM_START_CONFLICT);
    EQUAL(x.where[PM_WHERE_ROW], 3);
    NEAR(x.detail[PM_DETAIL_BOUND], 1.5, 1e-12);
    scene_free(s);

    s = parallelograms(); /* what is written is met, and the joints cannot be */
    scene_start(s, PM_START_POSITION, scene_measure(s, PM_MEASURE_ANGLE, 3), 0.5);
    EQUAL(check_scene(s).status, PM_ASSEMBLY);
    scene_free(s);
}

/* Rods that hang on each other, all drawn at the pin of the first, each at its own angle, which is written: they go to their
 * places in one step, however far that is. */
#define RODS 24
static void drawn_at_one_place(void)
{
    scene *s = scene_create();
    for (int i = 0; i < RODS; i++) {
        const int rod = scene_body(s, 1, 0.1, 0, 0, 0), before = i == 0 ? PM_GROUND : i - 1;
        scene_joint(s, PM_JOINT_PIN, scene_point(s, rod, -0.5, 0),
                    scene_point(s, before, i == 0 ? 0 : 0.5, 0), 0);
        scene_start(s, PM_START_POSITION, scene_measure(s, PM_MEASURE_ANGLE, rod), -0.01 * i);
    }
    scene_until_time(s, 0.01);
    const start found = check_scene(s);
    EQUAL(found.status, PM_OK);
    double x = 0, y = 0;
    for (int i = 0; i < RODS; i++) {
        const double dx = 0.5 * cos(0.01 * i), dy = -0.5 * sin(0.01 * i);
        NEAR(found.pose[i][2], -0.01 * i, 1e-13);
        NEAR(found.pose[i][0], x + dx, 1e-12);
        NEAR(found.pose[i][1], y + dy, 1e-12);
        x += 2 * dx;
        y += 2 * dy;
    }
    scene_free(s);
}

static void cannot_be_met(void)
{
    scene *s = scene_create(); /* a link of 1 between points that a pin and a written place keep 3 apart */
    const int b = scene_body(s, 1, 0, 3, 0, 0), p = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_LINK, p, scene_point(s, PM_GROUND, 0, 0), 1);
    scene_start(s, PM_START_POSITION, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X), 3);
    scene_until_time(s, 1);
    start x = check_scene(s);
    EQUAL(x.status, PM_ASSEMBLY);
    CHECK(x.where[PM_WHERE_TABLE] == PM_TABLE_JOINT || x.where[PM_WHERE_TABLE] == PM_TABLE_START);
    EQUAL(x.where[PM_WHERE_ROW], 0);
    CHECK(x.detail[PM_DETAIL_VALUE] > x.detail[PM_DETAIL_BOUND]);
    EQUAL(scene_run(s, NULL), PM_ASSEMBLY);
    scene_free(s);
}

static void contradictory_velocities(void)
{
    scene *s = pendulum(0, 0); /* the end of a rod that swings at 2 rad/s moves at 2 m/s, not at 3 */
    scene_start_omega(s, 0, 2);
    scene_start(s, PM_START_VELOCITY,
                scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, 0, 0.5, 0), PM_PART_Y), 3);
    start x = check_scene(s);
    EQUAL(x.status, PM_START_CONFLICT);
    EQUAL(x.where[PM_WHERE_TABLE], PM_TABLE_START);
    EQUAL(x.where[PM_WHERE_ROW], 1);
    NEAR(x.detail[PM_DETAIL_VALUE], 3, 0);
    NEAR(x.detail[PM_DETAIL_BOUND], 2, 1e-14);
    scene_free(s);

    s = pendulum(0, 0); /* along the rod it cannot move at all */
    scene_start(s, PM_START_VELOCITY,
                scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, 0, 0.5, 0), PM_PART_X), 0.1);
    EQUAL(check_scene(s).status, PM_START_CONFLICT);
    scene_free(s);

    s = pendulum(0, 0); /* the same said twice is no contradiction */
    scene_start_omega(s, 0, 2);
    scene_start(s, PM_START_VELOCITY,
                scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, 0, 0.5, 0), PM_PART_Y), 2);
    EQUAL(check_scene(s).status, PM_OK);
    scene_free(s);
}

static void open_motion(void)
{
    scene *s = pendulum(0, 0); /* a second rod on the first, of which nothing is said */
    const int b = scene_body(s, 2, 0.5, 1.5, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.5, 0), scene_point(s, 0, 0.5, 0), 0);
    scene_start_omega(s, 0, 2);
    start x = check_scene(s);
    EQUAL(x.status, PM_START_OPEN);
    EQUAL(x.where[PM_WHERE_TABLE], PM_TABLE_BODY);
    EQUAL(x.where[PM_WHERE_ROW], b);
    scene_free(s);

    s = pendulum(0, 0); /* a pendulum of its own, of which nothing is said: at rest */
    const int d = scene_body(s, 2, 0.5, 3, 3, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, d, -0.5, 0), scene_point(s, PM_GROUND, 2.5, 3), 0);
    scene_start_omega(s, 0, 2);
    x = check_scene(s);
    EQUAL(x.status, PM_OK);
    NEAR(x.velocity[0][2], 2, 1e-14);
    for (int k = 0; k < 3; k++) NEAR(x.velocity[d][k], 0, 1e-15);
    scene_free(s);

    s = pendulum(0, 0); /* a body on its own: what is not said is zero */
    const int c = scene_body(s, 2, 0.5, 3, 3, 0);
    scene_start_omega(s, 0, 2);
    scene_start(s, PM_START_VELOCITY,
                scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, c, 0.2, 0), PM_PART_X), 1);
    x = check_scene(s);
    EQUAL(x.status, PM_OK);
    NEAR(x.velocity[c][0], 1, 1e-15);
    NEAR(x.velocity[c][1], 0, 1e-15);
    NEAR(x.velocity[c][2], 0, 1e-15);
    scene_free(s);
}

static void overlap(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0, 0, 0.1, 0), p = scene_point(s, b, 0, 0);
    const int floor_line = scene_floor(s, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0.05), floor_line, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0.3), floor_line, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    const start x = check_scene(s);
    EQUAL(x.status, PM_PENETRATION);
    EQUAL(x.where[PM_WHERE_TABLE], PM_TABLE_CONTACT);
    EQUAL(x.where[PM_WHERE_ROW], 1);
    NEAR(x.detail[PM_DETAIL_VALUE], -0.2, 1e-15);
    scene_free(s);
}

int main(void)
{
    moves_least();
    keeps_what_is_written();
    zero_is_written();
    slider_crank();
    many_rows();
    drawn_at_one_place();
    cannot_be_met();
    contradictory_velocities();
    open_motion();
    overlap();
    return check_failures();
}

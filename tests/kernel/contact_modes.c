/* Contacts in motion: stick, slip, roll, open; forces that push and never pull. */
#include "check.h"
#include "scene.h"

#define G 9.81

/* A particle on a slope, thrown along it with v0 (up > 0). */
typedef struct slope {
    double time, distance, status, sticks, least_normal;
} slope;

static slope block(double angle, double mu_static, double mu_kinetic, double v0, double t)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0, 0, 0, 0), p = scene_point(s, b, 0, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), scene_floor(s, angle), 0, 0,
                                PM_FRICTION_COULOMB, mu_kinetic);
    s->cell[PM_TABLE_CONTACT][c * PM_CONTACT_COLUMNS + PM_CONTACT_STATIC] = scene_value(s, mu_static);
    if (v0 != 0) scene_start_velocity(s, p, v0 * cos(angle), v0 * sin(angle));
    scene_until_time(s, t);
    scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
    s->cell[PM_TABLE_UNTIL][PM_UNTIL_COLUMNS + PM_UNTIL_GROUP] = 1; /* either */
    const int along =
        scene_measure_with(s, PM_MEASURE_POSITION, p, PM_PART_ALONG, PM_MEASURE_VALUE, scene_value(s, angle));
    const int time = scene_ask_measure(s, scene_time(s)), distance = scene_ask_measure(s, along);
    const int sticks =
        scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, scene_on(s, PM_TRIGGER_STICK, c)));
    const int normal = scene_ask_extreme(
        s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, c)), PM_NONE);
    scene_run(s, NULL);
    const slope x = {s->out[time], s->out[distance], s->status, s->out[sticks], s->out[normal]};
    scene_free(s);
    return x;
}

static void slopes(void)
{
    const double angle = 0.35, down = G * sin(angle), press = G * cos(angle);
    slope x = block(angle, 0.5, 0.3, 0, 2); /* tan 0.35 = 0.365: stays */
    EQUAL(x.status, PM_NO_TIME_ROUTE);
    EQUAL(x.time, 0);
    x = block(angle, 0.3, 0.2, 0, 2); /* slides down */
    EQUAL(x.status, PM_OK);
    NEAR(x.distance, -0.5 * (down - 0.2 * press) * 4, 1e-10);
    NEAR(x.least_normal, 2 * press, 1e-10);
    x = block(angle, 0.5, 0.3, 3, 10); /* thrown up: stops and stays */
    EQUAL(x.status, PM_OK);
    NEAR(x.time, 3 / (down + 0.3 * press), 1e-10);
    NEAR(x.distance, 4.5 / (down + 0.3 * press), 1e-10);
    EQUAL(x.sticks, 1);
    x = block(angle, 0.3, 0.2, 3, 2); /* thrown up: stops, comes back */
    const double up = 3 / (down + 0.2 * press), back = 2 - up;
    NEAR(x.distance, 1.5 * up - 0.5 * (down - 0.2 * press) * back * back, 1e-9);
    x = block(0, 0.4, 0.4, 3, 10);
    NEAR(x.time, 3 / (0.4 * G), 1e-10);
    NEAR(x.distance, 4.5 / (0.4 * G), 1e-10);
}

/* A force that grows, F = c t: slip begins at mu_s m g / c, then m dv/dt = c t - mu_k m g. */
static void begins_to_slip(void)
{
    const double m = 2, c = 3, mu_static = 0.5, mu_kinetic = 0.3, t0 = mu_static * m * G / c, end = t0 + 1.5;
    scene *s = scene_create();
    const int b = scene_body(s, m, 0, 0, 0, 0), p = scene_point(s, b, 0, 0), line = scene_floor(s, 0);
    const int contact =
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, p, 0), line, 0, 0, PM_FRICTION_COULOMB, mu_kinetic);
    s->cell[PM_TABLE_CONTACT][PM_CONTACT_STATIC] = scene_value(s, mu_static);
    const int push = SCENE_PROGRAM(s, scene_m(scene_time(s)), scene_k(s, c), scene_op(PM_OP_MUL));
    scene_applied(s, p, PM_GROUND, push, SCENE_PROGRAM(s, scene_k(s, 0)));
    const int slips = scene_on(s, PM_TRIGGER_SLIP, contact);
    const int at = scene_ask_event(s, scene_read(s, scene_time(s)), slips, 1, 0);
    scene_until_time(s, end);
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[at], t0, 1e-10);
    NEAR(s->out[v], (0.5 * c * (end * end - t0 * t0) - mu_kinetic * m * G * 1.5) / m, 1e-10);
    scene_free(s);
}

/* A sphere thrown without spin rolls at 5/7 of its speed. */
static void slides_then_rolls(double direction)
{
    const double r = 0.1, mu = 0.2, v0 = 4 * direction;
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.8 * r * r, 0, r, 0), g = scene_point(s, b, 0, 0);
    const int c = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, g, r), scene_floor(s, 0), 0, 0,
                                PM_FRICTION_COULOMB, mu);
    const int vx = scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X);
    scene_start(s, PM_START_VELOCITY, vx, v0);
    const int sticks = scene_on(s, PM_TRIGGER_STICK, c);
    const int at = scene_ask_event(s, scene_read(s, scene_time(s)), sticks, 1, 0);
    scene_until_time(s, 2);
    const int v = scene_ask_measure(s, vx),
              omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b));
    const int friction = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_FRICTION, c));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[at], fabs(2 * v0 / (7 * mu * G)), 1e-10);
    NEAR(s->out[v], v0 * 5 / 7, 1e-10);
    NEAR(s->out[omega], -v0 * 5 / 7 / r, 1e-9);
    NEAR(s->out[friction], 0, 1e-9);
    scene_free(s);
}

/* A block thrown on a plank that lies on smooth ice: they end together; sliding between two moving bodies. */
static void block_on_a_plank(int block_first)
{
    const double m = 1, big = 3, mu = 0.25, v0 = 2;
    scene *s = scene_create();
    const int plank = scene_body(s, big, 0.5, 0, 0, 0), b = scene_body(s, m, 0, 0, 0, 0);
    const int pb = scene_point(s, b, 0, 0), pp = scene_point(s, plank, 0, 0);
    scene_joint(s, PM_JOINT_SLIDER_FIXED, pp, scene_floor(s, 0), 0);
    const int line = scene_line(s, pp, 0);
    const int c =
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, pb, 0), line, 0, 0, PM_FRICTION_COULOMB, mu);
    scene_start_velocity(s, pb, block_first ? v0 : 0, 0);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, pp, PM_PART_X),
                block_first ? 0 : v0);
    const int sticks = scene_on(s, PM_TRIGGER_STICK, c);
    scene_until(s, sticks, 1);
    const int t = scene_ask_measure(s, scene_time(s)),
              v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, pp, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[t], v0 / (mu * G * (1 + m / big)), 1e-10);
    NEAR(s->out[v], v0 * (block_first ? m : big) / (m + big), 1e-10);
    scene_free(s);
}

/* A particle leaves a smooth circle of radius R where cos = (2 + v0^2 / g R) / 3; a sphere that rolls on it where
 * cos = (10 + 7 v0^2 / g (R + r)) / 17. */
static void leaves_a_circle(double r, int friction)
{
    const double big = 1.3, arm = big + r, v0 = 0.4, ratio = v0 * v0 / (G * arm);
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.8 * r * r, 0, arm, 0), g = scene_point(s, b, 0, 0);
    const int fixed = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), big);
    const int c = scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, g, r), fixed, 1, 0, friction, 0);
    scene_start_velocity(s, g, v0, 0);
    const int opens = scene_on(s, PM_TRIGGER_OPEN, c);
    const int y =
        scene_ask_event(s, scene_read(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y)), opens, 1, 0);
    const int normal =
        scene_ask_event(s, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, c)), opens, 1, 1);
    const int least = scene_ask_extreme(
        s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, c)), PM_NONE);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    const int gap = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_GAP, c));
    const int fall =
        scene_when(s, PM_TRIGGER_FALL, scene_read(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y)));
    scene_until(s, fall, 1);
    EQUAL(scene_run(s, NULL), PM_OK);
    const double cosine = friction == PM_FRICTION_ROUGH ? (10 + 7 * ratio) / 17 : (2 + ratio) / 3;
    NEAR(s->out[y] / arm, cosine, 1e-9);
    NEAR(s->out[normal], 0, 1e-7);
    CHECK(s->out[least] > -1e-7);
    const double v = sqrt(G * arm * cosine), sine = sqrt(1 - cosine * cosine), vy = v * sine,
                 h = arm * cosine;
    const double time = (-vy + sqrt(vy * vy + 2 * G * h)) / G; /* free flight */
    NEAR(s->out[x], arm * sine + v * cosine * time, 1e-7);
    CHECK(s->out[gap] > 0);
    scene_free(s);
}

/* A ladder between a smooth wall and a smooth floor leaves the wall at 2/3 of its height. */
static void ladder(void)
{
    const double length = 2, theta = 1.1;
    scene *s = scene_create();
    const int b = scene_body(s, 5, 5 * length * length / 12, 0.5 * length * cos(theta),
                             0.5 * length * sin(theta), 2 * acos(0.) - theta);
    const int low = scene_point(s, b, -0.5 * length, 0), top = scene_point(s, b, 0.5 * length, 0);
    const int floor_contact = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, low, 0), scene_floor(s, 0), 0,
                                            0, PM_FRICTION_SMOOTH, 0);
    const int wall = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, top, 0), scene_floor(s, -acos(0.)), 0,
                                   0, PM_FRICTION_SMOOTH, 0);
    const int opens = scene_on(s, PM_TRIGGER_OPEN, wall);
    const int y =
        scene_ask_event(s, scene_read(s, scene_part(s, PM_MEASURE_POSITION, top, PM_PART_Y)), opens, 1, 0);
    const int least = scene_ask_extreme(
        s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, floor_contact)), PM_NONE);
    scene_until(s, scene_on(s, PM_TRIGGER_STRIKE, floor_contact), 1);
    scene_until(s,
                scene_when(s, PM_TRIGGER_FALL,
                           scene_minus(s, scene_part(s, PM_MEASURE_POSITION, top, PM_PART_Y), 0.3)),
                1);
    s->cell[PM_TABLE_UNTIL][PM_UNTIL_COLUMNS + PM_UNTIL_GROUP] = 1;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[y], 2 / 3. * length * sin(theta), 1e-9);
    CHECK(s->out[least] > 0);
    scene_free(s);
}

/* A crate on a slope: it stands, slides without tipping, or tips about its lower edge. */
static int crate(double angle, double mu, double half_width, double half_height, double t, double *turned,
                 double *moved)
{
    scene *s = scene_create();
    const double c = cos(angle), d = sin(angle);
    const int b = scene_body(s, 3, 3 * (half_width * half_width + half_height * half_height) / 3,
                             -half_height * d, half_height * c, angle);
    for (int i = -1; i <= 1; i += 2)
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, i * half_width, -half_height), 0),
                      scene_floor(s, angle), 0, 0, PM_FRICTION_COULOMB, mu);
    scene_until_time(s, t);
    const int turn = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    const int move =
        scene_ask_measure(s, scene_part(s, PM_MEASURE_MOVED, scene_point(s, b, 0, 0), PM_PART_NORM));
    int least[2];
    for (int i = 0; i < 2; i++)
        least[i] = scene_ask_extreme(s, PM_ASK_MIN,
                                     scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, i)), PM_NONE);
    const int status = scene_run(s, NULL);
    for (int i = 0; i < 2; i++) CHECK(s->out[least[i]] > -1e-9); /* at the very start too */
    *turned = s->out[turn];
    *moved = s->out[move];
    scene_free(s);
    return status;
}

static void crates(void)
{
    double turned, moved;
    EQUAL(crate(0.2, 0.5, 0.3, 0.5, 0.5, &turned, &moved), PM_OK);
    NEAR(turned, 0, 1e-14);
    NEAR(moved, 0, 1e-14);
    EQUAL(crate(0.5, 0.2, 0.3, 0.3, 0.5, &turned, &moved), PM_OK);
    NEAR(turned, 0, 1e-10);
    NEAR(moved, 0.125 * G * (sin(0.5) - 0.2 * cos(0.5)), 1e-9);
    EQUAL(crate(0.5, 0.9, 0.2, 0.6, 0.2, &turned, &moved),
          PM_OK); /* tan 0.5 > 0.2/0.6: tips down the slope */
    CHECK(turned > 0.01);
    const double i_edge = 4 / 3. * (0.04 + 0.36), couple = G * (0.6 * sin(0.5) - 0.2 * cos(0.5));
    NEAR(turned, 0.5 * couple / i_edge * 0.04, 5e-2 * turned); /* and a little faster as it goes */
}

/* ---- a box on a box ---- */
/* Two boxes of width 1 and height 0.2, one on the other: two corners of each are at one place, and the lower one sticks by two
 * corners.  The upper box slides as if it touched by two corners alone; the lower one stays. */
static void slides_on_a_box(int side, int lower_first)
{
    const double w = 1, h = 0.2, i = (w * w + h * h) / 12, mu = 0.1, half_turn = acos(-1.);
    scene *s = scene_create();
    const int a = scene_body(s, 1, i, 0, h / 2, 0), b = scene_body(s, 1, i, 0, 3 * h / 2, 0);
    const int top = scene_line(s, scene_point(s, a, 0, h / 2), 0),
              bottom = scene_line(s, scene_point(s, b, 0, -h / 2), half_turn);
    for (int group = 0; group < 2; group++) {
        if (group == lower_first) {
            for (int k = -1; k <= 1; k += 2)
                scene_segment(s, scene_circle(s, scene_point(s, b, k * w / 2, -h / 2), 0), top, -w / 2, w / 2,
                              0, PM_FRICTION_COULOMB, mu);
            for (int k = -1; k <= 1; k += 2)
                scene_segment(s, scene_circle(s, scene_point(s, a, k * w / 2, h / 2), 0), bottom, -w / 2,
                              w / 2, 0, PM_FRICTION_COULOMB, mu);
        } else {
            for (int k = -1; k <= 1; k += 2)
                scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, a, k * w / 2, -h / 2), 0),
                              scene_floor(s, 0), 0, 0, PM_FRICTION_COULOMB, 0.5);
        }
    }
    const int upper = scene_ask_measure(
                  s, scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, b, 0, 0), PM_PART_X)),
              lower = scene_ask_measure(
                  s, scene_part(s, PM_MEASURE_VELOCITY, scene_point(s, a, 0, 0), PM_PART_X));
    scene_start_velocity(s, scene_point(s, b, 0, 0), side, 0);
    scene_until_time(s, 0.3);
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[upper], side * (1 - mu * G * 0.3), 1e-9);
    NEAR(s->out[lower], 0, 1e-12);
    scene_free(s);
}

/* ---- blocks that rock ---- */
/* Let go on one edge it rocks to rest, without end in a finite time. */
static void rocks_to_rest(int route, double tilt, double half_width, double half_height)
{
    scene *s = scene_by(route, 1e-6);
    const double c = cos(tilt), d = sin(tilt), side = tilt > 0 ? 1 : -1;
    const int b =
        scene_body(s, 3, half_width * half_width + half_height * half_height,
                   half_width * c * side - half_height * d, half_width * fabs(d) + half_height * c, tilt);
    int hit = PM_NONE;
    for (int i = -1; i <= 1; i += 2) {
        const int foot = scene_circle(s, scene_point(s, b, i * half_width, -half_height), 0);
        const int k =
            scene_contact(s, PM_CONTACT_LINE, foot, scene_floor(s, 0), 0, 0, PM_FRICTION_COULOMB, 0.9);
        if (i == side) hit = scene_on(s, PM_TRIGGER_STRIKE, k);
    }
    scene_until(s, scene_on(s, PM_TRIGGER_REST, PM_NONE), 1);
    const int count = scene_ask_count(s, hit);
    const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, b));
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(isinf(s->out[count]));
    NEAR(s->out[turned], 0, 1e-9);
    scene_free(s);
}

/* Its left foot rests and slips so fast, its right one strikes at 1e-6 m/s: too slow to clatter, both feet are held.  The slip that
 * is left, and the energy. */
static double held_while_it_slips(double half_height, double mu, double slip, double *energy)
{
    scene *s = scene_create();
    const double omega = -1e-6, inertia = (1 + 4 * half_height * half_height) / 12;
    const int b = scene_body(s, 1, inertia, 0, half_height, 0);
    int foot[2];
    for (int i = 0; i < 2; i++) {
        foot[i] = scene_point(s, b, i - 0.5, -half_height);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, foot[i], 0), scene_floor(s, 0), 0, 0.3,
                      PM_FRICTION_COULOMB, mu);
    }
    scene_start_velocity(s, foot[0], slip, 0);
    scene_start_omega(s, b, omega);
    scene_until_time(s, 1e-13);
    const int ask = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, foot[0], PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double left = s->out[ask], before = slip - omega * half_height;
    *energy = left * left / (before * before + 0.25 * omega * omega + inertia * omega * omega);
    scene_free(s);
    return left;
}

/* Friction may end a slip: it does not turn it back, and a foot that only is held from parting has none that could drive it. */
static void feet_that_are_held_do_not_drive(void)
{
    for (double h = 0.1; h < 4; h *= 1.5)
        for (double mu = 0.3; mu < 1; mu += 0.2)
            for (double slip = 0.3e-6; slip < 5e-6; slip *= 1.4)
                for (int side = -1; side <= 1; side += 2) {
                    double energy;
                    const double left = held_while_it_slips(h, mu, side * slip, &energy);
                    CHECK(side * left > -1e-15);
                    CHECK(energy < 1 + 1e-9);
                }
    double energy;
    NEAR(held_while_it_slips(1.5, 0.9, 1.2e-6, &energy), 0, 1e-15); /* the blow leaves no slip */
    /* M (v' - v) = J^T P with both feet held, friction at the right one alone, which pushes */
    const double pushes = (0.25e-6 + 10 / 12. * 1e-6) / (1 - 1.5 * 0.3);
    NEAR(held_while_it_slips(1.5, 0.3, 4e-6, &energy), 4e-6 + 1.5e-6 - 0.3 * pushes, 1e-11);
}

/* ---- a rod that comes to where friction draws it in ---- */
/* It parts, or has no motion there; contacts that change in turn at one time are no answer. */
static void comes_to_be_drawn(int route, double degrees, int side)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const double angle = degrees * acos(-1.) / 180, x = 0.5 * side * cos(angle), y = 0.5 * sin(angle);
    const int b = scene_body(s, 1, 1 / 12., x, y, 0), foot = scene_point(s, b, -x, -y);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, foot, 0), scene_floor(s, 0), 0, 0, PM_FRICTION_COULOMB,
                  1.6);
    scene_start_velocity(s, foot, -4 * side, 0);
    scene_start_omega(s, b, 2 * side);
    scene_until_time(s, 0.1);
    const int status = scene_run(s, NULL);
    CHECK(status == PM_OK || status == PM_PAINLEVE);
    scene_free(s);
}

int main(void)
{
    slopes();
    begins_to_slip();
    slides_then_rolls(1);
    slides_then_rolls(-1);
    block_on_a_plank(1);
    block_on_a_plank(0);
    leaves_a_circle(0, PM_FRICTION_SMOOTH);
    leaves_a_circle(0.2, PM_FRICTION_SMOOTH);
    leaves_a_circle(0.2, PM_FRICTION_ROUGH);
    ladder();
    crates();
    for (int k = 0; k < 6; k++) {
        const int route[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA}, side = k < 3 ? 1 : -1;
        rocks_to_rest(route[k % 3], 0.17 * side, 0.1, 0.15);
        rocks_to_rest(route[k % 3], 0.05 * side, 0.1, 0.4);
        for (double degrees = 36; degrees < 38; degrees += 0.125)
            comes_to_be_drawn(route[k % 3], degrees, side);
    }
    feet_that_are_held_do_not_drive();
    for (int k = 0; k < 4; k++) slides_on_a_box(k % 2 ? 1 : -1, k / 2);
    return check_failures();
}

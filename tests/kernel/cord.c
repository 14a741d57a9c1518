/* A cord that slips on a rim, against closed forms on the routes that do them: two weights over a disk, which the cord passes
 * faster or slower than it turns until it holds, with static friction above the kinetic one; a jerk over a peg; a cord that is
 * pulled off its peg.  Tensions obey T_2 = T_1 e^(mu wrap).  Weights that swing are integrated beside it. */
#include "check.h"
#include "scene.h"

#define PI 3.14159265358979324
#define GRAVITY 9.81

static const double radius = 0.1, heavy = 1.7, light = 1.3, inertia = 0.02, mu_static = 0.5, mu_kinetic = 0.4;
static const int sense[3] = {1, 1, -1};

typedef struct weights {
    scene *s;
    int body[2], point[2], disk, cord;
} weights;

/* They hang at the left and the right of a disk, or of a peg. */
static weights weights_create(int route, double m, double other, int on_disk, double turns)
{
    weights x = {.s = scene_create(), .disk = PM_GROUND};
    const double mass[2] = {m, other};
    int circle[2];
    scene_set(x.s, PM_SETTING_GRAVITY_Y, -GRAVITY);
    *scene_setting(x.s, PM_SETTING_ROUTE) = route;
    for (int i = 0; i < 2; i++) {
        x.body[i] = scene_body(x.s, mass[i], 1, (i ? 1 : -1) * radius, -2, 0);
        x.point[i] = scene_point(x.s, x.body[i], 0, 0);
        circle[i] = scene_circle(x.s, x.point[i], 0);
    }
    if (on_disk) x.disk = scene_body(x.s, 2, inertia, 0, 0, 0);
    const int centre = scene_point(x.s, x.disk, 0, 0);
    if (on_disk) scene_joint(x.s, PM_JOINT_PIN, centre, scene_point(x.s, PM_GROUND, 0, 0), 0);
    x.cord = scene_cord_over(x.s, circle[0], circle[1], scene_circle(x.s, centre, radius), sense, turns,
                             mu_static, mu_kinetic);
    return x;
}

static int ask_tension(scene *s, int cord, int strand)
{
    return scene_ask_measure(
        s, scene_measure_with(s, PM_MEASURE_CONTACT_TENSION, cord, PM_PART_NONE, PM_MEASURE_MEMBER, strand));
}

static void hold_still(weights *x)
{
    for (int i = 0; i < 2; i++) {
        scene_start_velocity(x->s, x->point[i], 0, 0);
        scene_start_omega(x->s, x->body[i], 0);
    }
}

/* The disk turns at first; the cord slips on it until it holds. */
static void slows_down(int route, double omega)
{
    weights x = weights_create(route, light, heavy, 1, 0);
    scene *s = x.s;
    const double factor = exp((omega > 0 ? 1 : -1) * mu_kinetic * PI);
    const double a = GRAVITY * (heavy - factor * light) / (heavy + factor * light);
    const double pull[2] = {light * (GRAVITY + a), heavy * (GRAVITY - a)};
    const double alpha = (pull[0] - pull[1]) * radius / inertia;
    const double stop = -radius * omega / (a + radius * alpha);
    const double later = GRAVITY * (heavy - light) / (heavy + light + inertia / (radius * radius));
    hold_still(&x);
    scene_start_omega(s, x.disk, omega);
    scene_until_time(s, 2 * stop);
    const int down = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, x.point[1], PM_PART_Y));
    const int spin = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, x.disk));
    const int tension[2] = {ask_tension(s, x.cord, 0), ask_tension(s, x.cord, 1)};
    const int force = scene_ask_measure(s, scene_part(s, PM_MEASURE_CONTACT_FORCE, x.cord, PM_PART_Y));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double v = (a + later) * stop;
    NEAR(s->out[down], -v, 1e-9);
    NEAR(s->out[spin], -v / radius, 1e-8);
    NEAR(s->out[tension[0]], light * (GRAVITY + later), 1e-8);
    NEAR(s->out[tension[1]], heavy * (GRAVITY - later), 1e-8);
    NEAR(s->out[force], light * (GRAVITY + later), 1e-8);
    CHECK(s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9);
    scene_free(s);
}

/* On a peg, with some turns: it holds up to e^(mu_static wrap), and slips with mu_kinetic. */
static void on_a_peg(int route, double turns, double share, int on_left)
{
    const double wrap = PI + 2 * PI * turns, most = exp(mu_static * wrap), factor = exp(mu_kinetic * wrap);
    const double great = light * share * most;
    weights x = weights_create(route, on_left ? great : light, on_left ? light : great, 0, turns);
    scene *s = x.s;
    scene_until_time(s, 0.3);
    const int tension[2] = {ask_tension(s, x.cord, on_left), ask_tension(s, x.cord, !on_left)};
    const int slip = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_SLIP, x.cord));
    EQUAL(scene_run(s, NULL), PM_OK);
    const double a = share > 1 ? GRAVITY * (great - factor * light) / (great + factor * light) : 0;
    NEAR(s->out[slip], (on_left ? -0.3 : 0.3) * a, 1e-9);
    NEAR(s->out[tension[0]], light * (GRAVITY + a), 1e-8);
    NEAR(s->out[tension[1]], great * (GRAVITY - a), 1e-8 * great);
    scene_free(s);
}

/* Weights that swing while the cord slips, beside equations of their own.  Strand i has the free length r and stands at the angle
 * `turn` outwards from straight down; with d along the strand and n across, outwards,
 *     velocity = +-u d + r turn' n,    r' = +-u + R turn',    r turn'' = -g sin turn - (2 (+-u) + R turn') turn',
 * where u is the speed of the cord towards strand 1, and its tensions T_i = m_i (g cos turn + r turn'^2 -+ u') stand in the
 * ratio e^(mu wrap), wrap = PI - turn_0 - turn_1. */
typedef struct swing {
    double r[2], turn[2], rate[2], u;
} swing;
enum { SWING = sizeof(swing) / sizeof(double) };

static const double swinging[2] = {light, 4 * heavy};

/* The rates of a swing; with them its tensions. */
static swing swing_rates(const swing *x, double tension[2])
{
    const double ratio = exp(mu_kinetic * (PI - x->turn[0] - x->turn[1]));
    double pull[2];
    swing rates;
    for (int i = 0; i < 2; i++) {
        const double along = i ? x->u : -x->u, rate = x->rate[i];
        pull[i] = swinging[i] * (GRAVITY * cos(x->turn[i]) + x->r[i] * rate * rate);
        rates.r[i] = along + radius * rate;
        rates.turn[i] = rate;
        rates.rate[i] = -(GRAVITY * sin(x->turn[i]) + (2 * along + radius * rate) * rate) / x->r[i];
    }
    rates.u = (pull[1] - ratio * pull[0]) / (swinging[1] + ratio * swinging[0]);
    for (int i = 0; i < 2; i++) tension[i] = pull[i] + (i ? -1 : 1) * swinging[i] * rates.u;
    return rates;
}

static swing swing_ahead(const swing *x, double h, const swing *rates)
{
    swing ahead;
    const double *from = (const double *)x, *rate = (const double *)rates;
    for (int k = 0; k < SWING; k++) ((double *)&ahead)[k] = from[k] + h * rate[k];
    return ahead;
}

/* By the classical Runge-Kutta method. */
static swing swing_to(double t, swing x, double tension[2])
{
    const int steps = 1000;
    const double h = t / steps, share[4] = {h / 6, h / 3, h / 3, h / 6}, step[4] = {0, 0.5 * h, 0.5 * h, h};
    for (int n = 0; n < steps; n++) {
        swing rates = x, next = x;
        for (int k = 0; k < 4; k++) {
            const swing look = swing_ahead(&x, step[k], &rates);
            rates = swing_rates(&look, tension);
            next = swing_ahead(&next, share[k], &rates);
        }
        x = next;
    }
    swing_rates(&x, tension);
    return x;
}

static void swings(int route)
{
    const double t = 0.5, out[2] = {1.5, 0.8}, u = 0.3;
    weights x = weights_create(route, swinging[0], swinging[1], 0, 0);
    scene *s = x.s;
    int place[2][2], tension[2];
    for (int i = 0; i < 2; i++) {
        scene_start_velocity(s, x.point[i], (i ? 1 : -1) * out[i], (i ? -1 : 1) * u);
        scene_start_omega(s, x.body[i], 0);
        tension[i] = ask_tension(s, x.cord, i);
        for (int k = 0; k < 2; k++)
            place[i][k] = scene_ask_measure(
                s, scene_part(s, PM_MEASURE_POSITION, x.point[i], k ? PM_PART_Y : PM_PART_X));
    }
    scene_until_time(s, t);
    EQUAL(scene_run(s, NULL), PM_OK);
    double pull[2];
    const swing end = swing_to(t, (swing){{2, 2}, {0}, {out[0] / 2, out[1] / 2}, u}, pull);
    CHECK(fabs(end.turn[0]) > 0.05 && fabs(end.turn[1]) > 0.05);
    for (int i = 0; i < 2; i++) {
        const double c = cos(end.turn[i]), d = sin(end.turn[i]);
        NEAR(s->out[place[i][0]], (i ? 1 : -1) * (radius * c + end.r[i] * d), 1e-9);
        NEAR(s->out[place[i][1]], radius * d - end.r[i] * c, 1e-9);
        NEAR(s->out[tension[i]], pull[i], 1e-7);
    }
    scene_free(s);
}

/* A weight that falls jerks the other one up: the impulses, too, stand in the ratio of the capstan. */
static void jerk(void)
{
    weights x = weights_create(PM_ROUTE_AUTO, light, heavy, 0, 0);
    scene *s = x.s;
    const double speed = 1.2;
    hold_still(&x);
    s->rows[PM_TABLE_START] -= 3; /* of the weight that falls */
    scene_start_velocity(s, x.point[1], 0, -speed);
    scene_start_omega(s, x.body[1], 0);
    scene_until_time(s, 1e-3);
    const int impulse[2] = {
        scene_ask_measure(s, scene_measure_with(s, PM_MEASURE_CONTACT_TENSION_IMPULSE, x.cord, PM_PART_NONE,
                                                PM_MEASURE_MEMBER, 0)),
        scene_ask_measure(s, scene_measure_with(s, PM_MEASURE_CONTACT_TENSION_IMPULSE, x.cord, PM_PART_NONE,
                                                PM_MEASURE_MEMBER, 1))};
    EQUAL(scene_run(s, NULL), PM_OK);
    const double factor = exp(mu_kinetic * PI), up = heavy * speed / (heavy + factor * light);
    NEAR(s->out[impulse[0]], light * up, 1e-12);
    NEAR(s->out[impulse[1]], factor * light * up, 1e-12);
    scene_free(s);
}

/* Drawn straight the cord leaves its peg. */
static void leaves(void)
{
    weights x = weights_create(PM_ROUTE_RK, 1, 1, 0, 0);
    scene *s = x.s;
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    for (int i = 0; i < 2; i++)
        SCENE_ROW(s, PM_TABLE_FORCE, PM_FORCE_APPLIED, x.point[i], PM_GROUND, PM_NONE, PM_NONE,
                  SCENE_PROGRAM(s, scene_k(s, i ? 5 : -5)), SCENE_PROGRAM(s, scene_k(s, 0.5)),
                  PM_SPRING_BOTH);
    scene_until_time(s, 10);
    EQUAL(scene_run(s, NULL), PM_STRAND_ENDS);
    EQUAL(s->detail[1], 1);
    scene_free(s);
}

/* A drum that turns winds up a block, which is held back: both would stop where the block has gone `beyond` past the tangent
 * point.  What ends so shortly before the motion does is no less seen. */
static void winds_up(int route, double beyond)
{
    const double way = 2, force = 3, mass = heavy + inertia / (radius * radius);
    const double rate = force / mass, speed = sqrt(2 * rate * (way + beyond));
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    const int drum = scene_body(s, 2, inertia, 0, 0, 0), block = scene_body(s, heavy, 1, -way, radius, 0);
    const int centre = scene_point(s, drum, 0, 0), end = scene_point(s, block, 0, 0);
    scene_joint(s, PM_JOINT_PIN, centre, scene_point(s, PM_GROUND, 0, 0), 0);
    scene_cord(s, scene_circle(s, end, 0), 1, scene_circle(s, centre, radius), -1, 0, 0);
    SCENE_ROW(s, PM_TABLE_FORCE, PM_FORCE_APPLIED, end, PM_GROUND, PM_NONE, PM_NONE,
              SCENE_PROGRAM(s, scene_k(s, -force)), SCENE_PROGRAM(s, scene_k(s, 0)), PM_SPRING_BOTH);
    scene_start_velocity(s, end, speed, 0);
    scene_start_omega(s, block, 0);
    scene_start_omega(s, drum, -speed / radius);
    scene_until_time(s, speed / rate);
    const int status = scene_run(s, NULL);
    EQUAL(status, beyond > 0 ? PM_STRAND_ENDS : PM_OK);
    EQUAL(s->count[PM_COUNT_ROUTES], 1 << PM_ROUTE_UNIFORM);
    scene_free(s);
}

/* A yoke holds both ends of a cord over a disk, and turns with it about one axis: only the constraint of the slip is independent
 * of the pins, and its strands turn as far as the disk does. */
static void turns_with_its_ends(int route, double omega)
{
    scene *s = scene_by(route, 1e-11);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int disk = scene_body(s, 2, inertia, 0, 0, 0), yoke = scene_body(s, 2, inertia, 0, 0, 0);
    const int centre = scene_point(s, disk, 0, 0), axis = scene_point(s, PM_GROUND, 0, 0);
    scene_joint(s, PM_JOINT_PIN, centre, axis, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, yoke, 0, 0), axis, 0);
    const int end[2] = {scene_circle(s, scene_point(s, yoke, -radius, -2), 0),
                        scene_circle(s, scene_point(s, yoke, radius, -2), 0)};
    const int cord =
        scene_cord_over(s, end[0], end[1], scene_circle(s, centre, radius), sense, 0, mu_static, mu_kinetic);
    scene_start_omega(s, disk, omega);
    scene_start_omega(s, yoke, omega);
    scene_until_time(s, 7);
    const int turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, disk)),
              slip = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_SLIP, cord));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[turned], 7 * omega, 1e-9);
    NEAR(s->out[slip], 0, 1e-11);
    scene_free(s);
}

int main(void)
{
    for (int i = 1; i <= 5; i++) {
        winds_up(PM_ROUTE_AUTO, pow(10, -i));
        winds_up(PM_ROUTE_AUTO, -pow(10, -i));
    }

    static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};
    for (int i = 0; i < 3; i++) {
        slows_down(routes[i], 12);
        slows_down(routes[i], -9);
        swings(routes[i]);
        turns_with_its_ends(routes[i], 1);
        turns_with_its_ends(routes[i], -1);
        for (int left = 0; left < 2; left++) {
            on_a_peg(routes[i], 0, 0.999, left);
            on_a_peg(routes[i], 0, 1.001, left);
            on_a_peg(routes[i], 1, 0.999, left);
            on_a_peg(routes[i], 1, 1.001, left);
        }
    }
    jerk();
    leaves();
    return check_failures();
}

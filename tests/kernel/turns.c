/* Two contacts that are struck by turns without a loss: what is passed over, beside the same blow by blow and beside the straight
 * line that the way is when it is mirrored. */
#include "uniform.h"

#define PI 3.14159265358979323846
#define APART 1e-9 /* between both, of what is compared, relative: each blow is rounded */

enum { STRIKES, OTHERS, LAST, X, Y, SPEED_X, SPEED_Y, ANGLE, ASKED };
enum { FOLLOWED = 1, LOSES = 2, LISTED = 4, BESIDE = 8 };

static void ask(scene *s, int p, int body, int strike, int other, int how)
{
    scene_ask_count(s, strike);
    scene_ask_count(s, other);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_TIME, other));
    for (int k = 0; k < 4; k++)
        scene_ask_measure(s, scene_part(s, k < 2 ? PM_MEASURE_POSITION : PM_MEASURE_VELOCITY, p,
                                        k % 2 ? PM_PART_Y : PM_PART_X));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_ANGLE, body));
    if (how & LISTED)
        scene_ask_event(s, scene_read(s, scene_part(s, PM_MEASURE_POSITION, p, PM_PART_X)), strike, 40, 0);
    if (how & FOLLOWED)
        scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, p, PM_PART_X)),
                          PM_NONE);
}

/* ---- a disk between two lines ---- */
#define WIDTH 3.0 /* m, between lines that are parallel */

typedef struct corner {
    double angle, tilt, along, off, inwards, across; /* rad, m from the apex, m/s */
} corner;

static corner any_corner(void)
{
    const double angle = pow(10, check_random(-3.5, -1));
    return (corner){angle,
                    check_random(0, 2 * PI),
                    check_random(3, 5) / sin(angle),
                    check_random(1, 1.5),
                    check_random(5, 20) / sin(angle),
                    check_random(-1, 1)};
}

static scene *in_corner(const corner *x, double until, int how)
{
    const double r = 0.1, c = cos(x->tilt), n = sin(x->tilt), e = how & LOSES ? 1 - 1e-6 : 1;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, 2, 0.01, c * x->along - n * x->off, n * x->along + c * x->off, 0);
    const int p = scene_point(s, b, 0, 0), rim = scene_circle(s, p, r);
    int strike[2];
    for (int k = 0; k < 2; k++) {
        const double far = k == 1 && x->angle == 0 ? WIDTH : 0;
        const int line =
            scene_line(s, scene_point(s, PM_GROUND, -n * far, c * far), x->tilt + k * (x->angle + PI));
        strike[k] = scene_on(s, PM_TRIGGER_STRIKE,
                             scene_contact(s, PM_CONTACT_LINE, rim, line, 0, e, PM_FRICTION_SMOOTH, 0));
    }
    if (how & BESIDE) { /* a wall across, before the disk comes nearest to the apex */
        const double apex = r / tan(0.5 * x->angle), speed = hypot(x->inwards, x->across),
                     nearest = fabs((x->along - apex) * x->across + (x->off - r) * x->inwards) / speed,
                     far = apex + 1.3 * nearest - r;
        const int at = scene_point(s, PM_GROUND, far * c, far * n);
        scene_contact(s, PM_CONTACT_LINE, rim, scene_line(s, at, x->tilt - 0.5 * PI), 0, 1,
                      PM_FRICTION_SMOOTH, 0);
    }
    scene_start_velocity(s, p, -c * x->inwards - n * x->across, -n * x->inwards + c * x->across);
    scene_start_omega(s, b, 2);
    scene_until_time(s, until);
    ask(s, p, b, strike[0], strike[1], how);
    return s;
}

/* ---- two disks and a wall ---- */
static scene *blocks(double ratio, double way, double until, int how)
{
    const double e = how & LOSES ? 1 - 1e-6 : 1;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, 1, 0.01, way, 0, 0), light = scene_point(s, b, 0, 0),
              heavy = scene_point(s, scene_body(s, ratio, 0.01 * ratio, 2 * way, 0, 0), 0, 0);
    const int rim = scene_circle(s, light, 0.1), other = scene_circle(s, heavy, 0.2);
    const int strike =
        scene_on(s, PM_TRIGGER_STRIKE,
                 scene_contact(s, PM_CONTACT_LINE, rim, scene_floor(s, way > 0 ? -PI / 2 : PI / 2), 0, e,
                               PM_FRICTION_SMOOTH, 0));
    const int meet = scene_on(s, PM_TRIGGER_STRIKE,
                              scene_contact(s, PM_CONTACT_CIRCLE, other, rim, 1, e, PM_FRICTION_COULOMB, 0));
    scene_start_velocity(s, light, 0, 0);
    scene_start_omega(s, b, 3);
    scene_start_velocity(s, heavy, way > 0 ? -1 : 1, 0);
    scene_until_time(s, until);
    ask(s, light, b, strike, meet, how);
    return s;
}

/* ---- beside each other ---- */
/* Rounding of velocities counts in a slim corner: its ledgers close less well than elsewhere. */
static int runs(scene *s)
{
    scene_route(s, PM_ROUTE_UNIFORM, 1e-11);
    *scene_setting(s, PM_SETTING_MAX_STEPS) = *scene_setting(s, PM_SETTING_MAX_EVENTS) = 1000000;
    EQUAL(scene_run(s, NULL), PM_OK);
    CHECK(s->audit[PM_AUDIT_ENERGY] < CLOSE && s->audit[PM_AUDIT_MOMENTUM] < 0.1 * APART);
    return s->status == PM_OK;
}

/* fewer: percent of the blows that are followed at most; 0: none is passed over. */
static void compare(scene *passed, scene *followed, int fewer)
{
    if (!runs(passed) || !runs(followed)) return;
    const int jumps = (int)passed->count[PM_COUNT_JUMPS], all = (int)followed->count[PM_COUNT_JUMPS];
    CHECK(all >= followed->out[STRIKES] + followed->out[OTHERS]);
    CHECK(fewer ? jumps < fewer * all / 100.0 || all < 100 : jumps == all);
    EQUAL(passed->out[STRIKES], followed->out[STRIKES]);
    EQUAL(passed->out[OTHERS], followed->out[OTHERS]);
    double size = 1;
    for (int k = X; k <= SPEED_Y; k++) size = fmax(size, fabs(followed->out[k]));
    for (int k = LAST; k <= ANGLE; k++) NEAR(passed->out[k], followed->out[k], APART * size);
    if (followed->nout > ASKED + 1) NEAR(passed->out[ASKED], followed->out[ASKED], APART * size);
    scene_free(passed);
    scene_free(followed);
}

static void in_corners(void)
{
    for (int i = 0; i < 60; i++) {
        const corner x = any_corner();
        const double until = check_random(0.3, 1.5);
        const int how = i % 3 == 0 ? LISTED : i % 3 == 1 ? BESIDE : 0;
        compare(in_corner(&x, until, how), in_corner(&x, until, how | FOLLOWED), how == BESIDE ? 101 : 90);
    }
}

/* Between parallel lines: along them it goes straight on. */
static void in_strips(void)
{
    for (int i = 0; i < 10; i++) {
        const corner x = {0,
                          i < 4 ? i * PI / 2 : check_random(0, 2 * PI),
                          0,
                          1.1,
                          check_random(-1, 1),
                          check_random(90, 300)};
        const int how = i % 2 ? LISTED : 0;
        compare(in_corner(&x, 9, how), in_corner(&x, 9, how | FOLLOWED), 50);
    }
}

static void of_blocks(void)
{
    for (int i = 0; i < 40; i++) {
        const double ratio = pow(10, check_random(2, 6)), way = i % 2 ? -1 : 1, until = check_random(1, 5);
        const int how = i % 3 ? 0 : LISTED;
        compare(blocks(ratio, way, until, how), blocks(ratio, way, until, how | FOLLOWED), 50);
    }
}

static void what_loses_is_followed(void)
{
    const corner x = any_corner();
    compare(in_corner(&x, 1, LOSES), in_corner(&x, 1, LOSES | FOLLOWED), 0);
    compare(blocks(1e4, 1, 5, LOSES), blocks(1e4, 1, 5, LOSES | FOLLOWED), 0);
}

/* Mirrored at its sides the wedge turns by its angle at each blow: pi over it is how many there are (less one where it is even). */
static void of_pi(void)
{
    for (int k = 1; k < 8; k++) {
        scene *s = blocks(pow(100, k), 1, 30, 0);
        const double blows = ceil(PI / atan(pow(10, -k))) - 1;
        if (runs(s)) EQUAL(s->out[STRIKES] + s->out[OTHERS], blows);
        CHECK(s->count[PM_COUNT_JUMPS] <= blows && s->count[PM_COUNT_JUMPS] < 60);
        scene_free(s);
    }
}

int main(void)
{
    in_corners();
    in_strips();
    of_blocks();
    what_loses_is_followed();
    of_pi();
    return check_failures();
}

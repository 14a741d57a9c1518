/* Curves by points: what goes over a knot and comes back, on every route, and where the pieces of a curve are. */
#include "elements/curve_piece.h"

#include "check.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define CLOSE 1e-8
#define G 9.81
#define STEEP 0.8 /* of the cubic, 1/m^2 */

static const int routes[] = {PM_ROUTE_AUTO, PM_ROUTE_RK, PM_ROUTE_IDA};

/* x = s; y = 0 before s = 0 and STEEP s^3 after: its third derivative jumps. */
static int ramp(scene *s)
{
    const double knot[] = {-2, 0, 2}, y[] = {0, 0, 0, 0, 0, 0, 0, STEEP};
    const int table = scene_piecewise(s, 3, knot, 3, y, PM_BEYOND_NONE);
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x_of = SCENE_PROGRAM(s, place),
              y_of = SCENE_PROGRAM(s, place, (scene_code){PM_OP_PIECEWISE, table});
    return SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, PM_GROUND, 0, 0), x_of, y_of, scene_value(s, -2),
                     scene_value(s, 2), 0, 1, table);
}

/* ---- over a knot and back ---- */
/* A point (radius 0) or a disk, whose energy of motion is `inertia` times that of its centre. */
typedef struct body_on_ramp {
    double radius, inertia, speed;
} body_on_ramp;

static double height(double r, double s) { return STEEP * s * s * s + r / hypot(1, 3 * STEEP * s * s); }

/* Where it turns back, by halving. */
static double highest(const body_on_ramp *b)
{
    double low = 0, high = 1;
    for (int i = 0; i < 60; i++) {
        const double s = 0.5 * (low + high);
        if (2 * G * (height(b->radius, s) - b->radius) < b->inertia * b->speed * b->speed)
            low = s;
        else
            high = s;
    }
    return low;
}

/* The time up to there: with s = top (1 - u^2) nothing is singular; by Simpson's rule but for u = 0. */
static double rise(const body_on_ramp *b)
{
    const double top = highest(b);
    enum { N = 4000 };
    double sum = 0;
    for (int i = 0; i <= N; i++) {
        const double u = i == 0 ? 1e-5 : (double)i / N, s = top * (1 - u * u), slope = 3 * STEEP * s * s;
        const double rate = hypot(1, slope), bend = 6 * STEEP * s / (rate * rate * rate);
        const double fallen = 2 * G * (height(b->radius, top) - height(b->radius, s)) / b->inertia;
        sum += (i == 0 || i == N ? 1
                : i % 2          ? 4
                                 : 2) *
               (1 - b->radius * bend) * rate * 2 * top * u / sqrt(fallen);
    }
    return sum / N / 3;
}

enum how { SLIDES, LIES, ROLLS, GRIPS };

static void hold(scene *s, enum how how, int body, double radius, int curve)
{
    const int g = scene_point(s, body, 0, 0), circle = scene_circle(s, g, radius);
    if (how == SLIDES)
        scene_joint(s, PM_JOINT_SLOT, g, curve, 0);
    else if (how == ROLLS)
        scene_joint(s, PM_JOINT_ROLLING_CURVE, circle, curve, 0);
    else
        scene_contact(s, PM_CONTACT_CURVE, circle, curve, 0, 0,
                      how == GRIPS ? PM_FRICTION_ROUGH : PM_FRICTION_SMOOTH, 0);
}

static void goes_up_and_comes_back(int route, enum how how)
{
    const int round = how == ROLLS || how == GRIPS;
    const body_on_ramp of = {.radius = round ? 0.1 : 0, .inertia = round ? 1.5 : 1, .speed = 2};
    scene *s = scene_create();
    const int b = scene_body(s, 3, round ? 1.5 * of.radius * of.radius : 0, -1, of.radius, 0);
    const int g = scene_point(s, b, 0, 0);
    hold(s, how, b, of.radius, ramp(s));
    scene_start_velocity(s, g, of.speed, 0);
    if (round) scene_start_omega(s, b, -of.speed / of.radius);
    const int back =
        scene_when(s, PM_TRIGGER_FALL, scene_minus(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X), -1));
    scene_until(s, back, 1);
    const int t = scene_ask_measure(s, scene_time(s)),
              v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X)),
              turned = scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, b));
    *scene_setting(s, PM_SETTING_ROUTE) = route;
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[t], 2 / of.speed + 2 * rise(&of), CLOSE);
    NEAR(s->out[v], -of.speed, CLOSE);
    if (round) NEAR(s->out[turned], 0, CLOSE);
    CHECK(s->audit[PM_AUDIT_ENERGY] < 1e-9 && s->audit[PM_AUDIT_MOMENTUM] < 1e-9);
    scene_free(s);
}

/* ---- pieces ---- */
static void pieces(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0, -1, 0, 0), curve = ramp(s);
    scene_joint(s, PM_JOINT_SLOT, scene_point(s, b, 0, 0), curve, 0);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    const pm_frame *frame = &s->w->frame;
    CHECK(pm_curve_has_pieces(s->model, curve));
    /* a piece goes on beyond its knot */
    NEAR(pm_curve_along(frame, curve, 0.5, -1).p[1], 0, 1e-15);
    NEAR(pm_curve_along(frame, curve, -0.5, 1).p[1], -STEEP / 8, 1e-15);
    NEAR(pm_curve_at(frame, curve, 0.5).bend_rate, pm_curve_along(frame, curve, 0.5, 1.9).bend_rate, 0);
    /* beside the knot, and on it by the way it goes */
    CHECK(pm_curve_piece_within(frame, curve, 0.3, -1) < 0);
    CHECK(pm_curve_piece_within(frame, curve, -0.3, 1) > 0);
    CHECK(pm_curve_piece_ahead(frame, curve, 1e-15, -1, 1e-12) < 0);
    CHECK(pm_curve_piece_ahead(frame, curve, -1e-15, 1, 1e-12) > 0);
    CHECK(pm_curve_piece_ahead(frame, curve, -1e-3, 1, 1e-12) < 0);
    CHECK(pm_curve_piece_ahead(frame, curve, 2, 1, 1e-12) < 2);
    CHECK(pm_curve_piece_is_last(frame, curve, 1.9) && pm_curve_piece_is_last(frame, curve, -1.9));
    CHECK(!pm_curve_piece_is_last(frame, curve, 0.1) && !pm_curve_piece_is_last(frame, curve, -0.1));
    scene_free(s);
}

/* ---- tables that no curve may read ---- */
static void refused(int knots, int shifted)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0, -1, 0, 0), curve = ramp(s);
    const double other[] = {-2, 0.5, 2}, y[8] = {0};
    scene_joint(s, PM_JOINT_SLOT, scene_point(s, b, 0, 0), curve, 0);
    scene_until_time(s, 1);
    const int table = scene_piecewise(s, 3, other, 3, y, PM_BEYOND_NONE);
    s->cell[PM_TABLE_CURVE][PM_CURVE_KNOTS] = knots ? table : PM_NONE;
    if (shifted) {
        const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
        s->cell[PM_TABLE_CURVE][PM_CURVE_KNOTS] = 0;
        s->cell[PM_TABLE_CURVE][PM_CURVE_Y] =
            SCENE_PROGRAM(s, place, scene_k(s, 0.1), scene_op(PM_OP_ADD), (scene_code){PM_OP_PIECEWISE, 0});
    }
    EQUAL(scene_run(s, NULL), PM_BAD_TABLE);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_CURVE);
    scene_free(s);
}

int main(void)
{
    pieces();
    refused(0, 0);
    refused(1, 0);
    refused(0, 1);
    for (int k = 0; k < 3; k++)
        for (enum how how = SLIDES; how <= GRIPS; how++) goes_up_and_comes_back(routes[k], how);
    return check_failures();
}

/* Rows: for every kind of joint and contact, with the ground and with a moving partner on either side: Jacobian = differences of the residual, gamma = -(dG/dt) v by differences of the rate, and, on the constraint, the rate from the line of action = j v.  Rolling on and in circles closes after a thousand turns. */
#include "elements/constraint.h"
#include "check.h"
#include "constraint_check.h"
#include "elements/contact.h"
#include "elements/joint.h"
#include "equations/active_set.h"
#include "scene.h"
#include "state/workspace.h"

#define TWO_PI 6.283185307179586

static void point_joints(int ground_side)
{
    static const int kinds[] = {PM_JOINT_PIN, PM_JOINT_WELD, PM_JOINT_LINK};
    for (int i = 0; i < 3; i++) {
        pair x = make_pair(ground_side);
        scene_joint(x.s, kinds[i], x.point[0], x.point[1], kinds[i] == PM_JOINT_LINK ? x.distance : 0.35);
        check_scene(x.s, kinds[i] == PM_JOINT_LINK); /* a pin's force is taken at the point of a */
        scene_free(x.s);
    }
}

/* A circle of radius R touching a line: the line's angle from its body follows from where the centres are. */
static void line_rows(int ground_side, double radius)
{
    pair x = make_pair(ground_side);
    const double direction =
        atan2(x.at[0][1] - x.at[1][1], x.at[0][0] - x.at[1][0]) - asin(radius / x.distance);
    const double of_body = ground_side == 1 ? 0 : pose_b[2];
    const int circle = scene_circle(x.s, x.point[0], radius),
              line = scene_line(x.s, x.point[1], direction - of_body);
    scene_joint(x.s, PM_JOINT_ROLLING_LINE, circle, line, 0);
    scene_contact(x.s, PM_CONTACT_LINE, circle, line, 0, 0.5, PM_FRICTION_ROUGH, 0);
    scene_teeth(x.s, circle, line, 0, 0.35);
    check_scene(x.s, 1);
    pm_constraint row[PM_JOINT_CONSTRAINTS];
    if (x.s->w) {
        look(x.s->w, NULL, 0);
        pm_joint_constraints(&x.s->w->frame, &x.s->w->state, 0, row);
        pm_constraint_kind(row[0].kind)->evaluate(&x.s->w->frame, &row[0]);
        NEAR(row[0].g, 0, 1e-14);
    }
    scene_free(x.s);
    x = make_pair(ground_side); /* sliders: the centre on the line */
    const int slide =
        scene_line(x.s, x.point[1], atan2(x.at[0][1] - x.at[1][1], x.at[0][0] - x.at[1][0]) - of_body);
    scene_joint(x.s, PM_JOINT_SLIDER, x.point[0], slide, 0);
    scene_joint(x.s, PM_JOINT_SLIDER_FIXED, x.point[0], slide, 0.4);
    check_scene(x.s, 1);
    scene_free(x.s);
}

static void circle_rows(int ground_side, double side, double ratio)
{
    pair x = make_pair(ground_side);
    const double d = x.distance;
    const double small = ratio * d, large = side > 0 ? d - small : d + small; /* radii that touch */
    const double a = side == -2 ? large : small, b = side == -2 ? small : large;
    const int ca = scene_circle(x.s, x.point[0], a), cb = scene_circle(x.s, x.point[1], b);
    scene_joint(x.s, PM_JOINT_ROLLING_CIRCLE, ca, cb, side);
    scene_contact(x.s, PM_CONTACT_CIRCLE, ca, cb, side, 0.5, PM_FRICTION_ROUGH, 0);
    scene_teeth(x.s, ca, cb, side, 0.35);
    check_scene(x.s, 1);
    if (x.s->w) {
        pm_constraint row[PM_JOINT_CONSTRAINTS];
        look(x.s->w, NULL, 0);
        pm_joint_constraints(&x.s->w->frame, &x.s->w->state, 0, row);
        pm_constraint_kind(row[0].kind)->evaluate(&x.s->w->frame, &row[0]);
        NEAR(row[0].g, 0, 1e-14);
        /* moving the centres together opens an inner contact and closes an outer one */
        const double *q = x.s->w->state.q;
        double nearer[6] = {0};
        const int moved = ground_side == 0 ? 1 : 0;
        const double away[2] = {x.at[1 - moved][0] - x.at[moved][0], x.at[1 - moved][1] - x.at[moved][1]};
        const int column = moved == 1 && ground_side != 0 ? 3 : 0;
        nearer[column] = away[0] / d;
        nearer[column + 1] = away[1] / d;
        NEAR(residual_at(x.s->w, row[0], nearer, 1e-3), side > 0 ? -1e-3 : 1e-3, 1e-15);
        (void)q;
    }
    scene_free(x.s);
}

static void periodic_row(int ground_side)
{
    pair x = make_pair(ground_side);
    const int circle = scene_circle(x.s, x.point[0], x.distance);
    const int row = SCENE_ROW(x.s, PM_TABLE_PATTERN, x.point[1], scene_value(x.s, 0.3),
                              scene_value(x.s, 0.05), scene_value(x.s, -1));
    scene_contact(x.s, PM_CONTACT_PATTERN, circle, row, 0, 0, PM_FRICTION_ROUGH, 0);
    check_scene(x.s, 1);
    scene_free(x.s);
    x = make_pair(ground_side); /* member 2 */
    scene_contact(x.s, PM_CONTACT_LINE, scene_circle(x.s, x.point[0], 0), scene_line(x.s, x.point[1], 0), 0,
                  0, PM_FRICTION_SMOOTH, 0);
    const int again = SCENE_ROW(x.s, PM_TABLE_PATTERN, x.point[1], scene_value(x.s, 0.3),
                                scene_value(x.s, 0.05), scene_value(x.s, -1));
    scene_contact(x.s, PM_CONTACT_PATTERN, scene_circle(x.s, x.point[0], 0.2), again, 0, 0, PM_FRICTION_ROUGH,
                  0);
    check_scene(x.s, 0);
    scene_free(x.s);
}

/* Half axes a, b round a point; free outside. */
static int ellipse(scene *s, int point, double a, double b)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE));
    const int x = SCENE_PROGRAM(s, scene_k(s, a), place, scene_op(PM_OP_COS), scene_op(PM_OP_MUL)),
              y = SCENE_PROGRAM(s, scene_k(s, b), place, scene_op(PM_OP_SIN), scene_op(PM_OP_MUL));
    return SCENE_ROW(s, PM_TABLE_CURVE, point, x, y, scene_value(s, 0), scene_value(s, TWO_PI), 1, -1,
                     PM_NONE);
}

/* Two ellipses at a distance, and deep in each other by a part of it. */
static void pair_rows(int ground_side, double part)
{
    pair x = make_pair(ground_side);
    const double a = part * x.distance;
    scene_contact(x.s, PM_CONTACT_CURVES, ellipse(x.s, x.point[0], a, 0.7 * a),
                  ellipse(x.s, x.point[1], 0.8 * a, 1.1 * a), 0, 0.5, PM_FRICTION_ROUGH, 0);
    if (open_case(x.s)) {
        int member;
        pm_workspace *w = x.s->w;
        look(w, NULL, 0);
        const double gap = pm_contact_gap(&w->frame, &w->state, 0, &member);
        pm_constraint row[2];
        pm_contact_constraint_both(&w->frame, 0, 0, member, &row[0], &row[1]);
        for (int k = 0; k < 2; k++) check_row(w, row[k], 0);
        pm_constraint_kind(row[0].kind)->evaluate(&w->frame, &row[0]);
        NEAR(row[0].g, gap, 1e-14);
        CHECK(part < 0.5 ? gap > 0 : gap < 0);
    }
    scene_free(x.s);
}

/* A thousand turns on a line: x = r angle to rounding, whatever the integrator does. */
static void rolls_on_a_line(void)
{
    scene *s = scene_create();
    const double r = 0.3, turns = 1000;
    const int b = scene_body(s, 2, 0.11, 0, r, 0), g = scene_point(s, b, 0, 0);
    scene_joint(s, PM_JOINT_ROLLING_LINE, scene_circle(s, g, r), scene_floor(s, 0), 0);
    scene_start_omega(s, b, -40);
    const int turned = scene_measure(s, PM_MEASURE_TURNED, b);
    scene_until(
        s,
        scene_when(s, PM_TRIGGER_FALL,
                   SCENE_PROGRAM(s, scene_m(turned), scene_k(s, TWO_PI * turns), scene_op(PM_OP_ADD))),
        1);
    const int place = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    const int end = scene_ask_measure(s, scene_time(s));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[place], r * TWO_PI * turns, 1e-11 * r * TWO_PI * turns);
    NEAR(s->out[end], TWO_PI * turns / 40, 1e-9);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-11);
    scene_free(s);
}

/* A thousand turns round inside a circle, without weight: (R - r) times the centre's angle + r times the wheel's = const. */
static void rolls_in_a_circle(double side)
{
    scene *s = scene_create();
    const double r = 0.2, big = 0.7, turns = 1000, arm = side > 0 ? big + r : big - r;
    const int b = scene_body(s, 2, 0.05, arm, 0, 0), g = scene_point(s, b, 0, 0);
    const int fixed = scene_circle(s, scene_point(s, PM_GROUND, 0, 0), big);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    scene_joint(s, PM_JOINT_ROLLING_CIRCLE, scene_circle(s, g, r), fixed, side);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y), 50 * arm);
    const double wheel = TWO_PI * turns * (side > 0 ? arm : -arm) / r; /* the centre turns by `turns` */
    const int turned = scene_measure(s, PM_MEASURE_TURNED, b);
    scene_until(s, scene_when(s, PM_TRIGGER_CROSS, scene_minus(s, turned, wheel)), 1);
    const int x = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_X));
    const int y = scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, g, PM_PART_Y));
    const int t = scene_ask_measure(s, scene_time(s));
    EQUAL(scene_run(s, NULL), PM_OK);
    NEAR(s->out[x], arm, 1e-10);
    NEAR(s->out[y], 0, 1e-10);
    NEAR(s->out[t], TWO_PI * turns / 50, 1e-6);
    CHECK(s->audit[PM_AUDIT_CONSTRAINT] < 1e-11);
    scene_free(s);
}

int main(void)
{
    static const double sides[] = {1, -1, -2};
    for (int ground_side = -1; ground_side < 2; ground_side++) {
        point_joints(ground_side);
        line_rows(ground_side, 0);
        line_rows(ground_side, 0.35);
        for (int i = 0; i < 3; i++) circle_rows(ground_side, sides[i], 0.4);
        circle_rows(ground_side, 1, 0); /* a point on a circle */
        circle_rows(ground_side, 1, 1); /* a circle on a point */
        circle_rows(ground_side, -1, 0);
        periodic_row(ground_side);
        pair_rows(ground_side, 0.3);
        pair_rows(ground_side, 0.65);
    }
    rolls_on_a_line();
    rolls_in_a_circle(1);
    rolls_in_a_circle(-1);
    return check_failures();
}

/* Rows: for every kind of joint and contact, with the ground and with a moving partner on either side:
 * Jacobian = differences of the residual, gamma = -(dG/dt) v by differences of the rate, and, on the constraint, the
 * rate from the line of action = j v.  Rolling on and in circles closes after a thousand turns. */
#include "elements/constraint.h"

#include "check.h"
#include "elements/contact.h"
#include "elements/joint.h"
#include "elements/teeth.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "scene.h"
#include "state/workspace.h"

#define TWO_PI 6.283185307179586
#define STEP 1e-6

static const double pose_a[3] = {0.31, -0.22, 0.7}, pose_b[3] = {-0.83, 0.64, -1.9};
static const double mark[2][2] = {{0.17, -0.08}, {-0.12, 0.21}};
static const double speed[6] = {0.9, -1.3, 2.1, -0.4, 0.8, -1.7};

/* body[0], body[1], or the ground: partners[k] of the pair looked at */
typedef struct pair {
    scene *s;
    int body[2], point[2];
    double at[2][2], distance;
} pair;

static void place_of(const double pose[3], const double at[2], double p[2])
{
    p[0] = pose[0] + cos(pose[2]) * at[0] - sin(pose[2]) * at[1];
    p[1] = pose[1] + sin(pose[2]) * at[0] + cos(pose[2]) * at[1];
}

static pair make_pair(int ground_side)
{
    pair x = {.s = scene_create()};
    const double *pose[2] = {pose_a, pose_b};
    static const double scene_pose[3] = {0, 0, 0};
    for (int k = 0; k < 2; k++) {
        const int ground = ground_side == k;
        x.body[k] = ground ? PM_GROUND : scene_body(x.s, 1.5 + k, 0.2, pose[k][0], pose[k][1], pose[k][2]);
        x.point[k] = scene_point(x.s, x.body[k], mark[k][0], mark[k][1]);
        place_of(ground ? scene_pose : pose[k], mark[k], x.at[k]);
    }
    x.distance = hypot(x.at[0][0] - x.at[1][0], x.at[0][1] - x.at[1][1]);
    return x;
}

/* Puts the drawn pose and a velocity into w->state and looks at it; q is moved by eps along `direction`. */
static void look(pm_workspace *w, const double *direction, double eps)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->nbody; i++)
        for (int k = 0; k < 3; k++) {
            w->state.q[3 * i + k] = w->numbers.value[PM_BODY_ROW(m, i)[PM_BODY_X + k]] +
                                    (direction ? eps * direction[3 * i + k] : 0);
            w->state.v[3 * i + k] = speed[3 * i + k];
        }
    pm_frame_look_state(&w->frame, &w->state);
}

static double residual_at(pm_workspace *w, pm_constraint row, const double *direction, double eps)
{
    look(w, direction, eps);
    pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
    return row.g;
}

static double rate_at(pm_workspace *w, pm_constraint row, const double *direction, double eps)
{
    look(w, direction, eps);
    pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
    return pm_constraint_times(&w->frame, &row, w->state.v);
}

/* The gap that is watched is the residual, its rate that by the Jacobian, to the last bit. */
static void check_gap(const pm_frame *frame, const pm_constraint *row)
{
    double rate;
    if (!pm_constraint_kind(row->kind)->gap) return;
    NEAR(pm_constraint_kind(row->kind)->gap(frame, row, &rate), row->g, 0);
    NEAR(pm_constraint_kind(row->kind)->gap(frame, row, NULL), row->g, 0);
    NEAR(rate, pm_constraint_times(frame, row, frame->v), 0);
}

/* The second derivatives are those of the Jacobian, and looking for them leaves no trace. */
static void check_bend(pm_workspace *w, pm_constraint row)
{
    double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES], velocity[6];
    look(w, NULL, 0);
    for (int i = 0; i < w->model->nq; i++) velocity[i] = w->frame.velocity[i];
    pm_constraint_bend(&w->frame, &row, bend);
    for (int i = 0; i < w->model->nq; i++) EQUAL(w->frame.velocity[i], velocity[i]);
    for (int n = 0; n < 3 * pm_constraint_bodies(&row); n++) {
        if (row.body[n / 3] == w->model->nbody) continue;
        double direction[6] = {0}, j[2][PM_CONSTRAINT_COORDINATES];
        direction[3 * row.body[n / 3] + n % 3] = 1;
        for (int side = 0; side < 2; side++) {
            look(w, direction, side == 0 ? -STEP : STEP);
            pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
            memcpy(j[side], row.j, sizeof row.j);
        }
        for (int i = 0; i < 3 * pm_constraint_bodies(&row); i++)
            if (row.body[i / 3] != w->model->nbody) NEAR(bend[i][n], (j[1][i] - j[0][i]) / (2 * STEP), 2e-8);
    }
    look(w, NULL, 0);
}

static void check_row(pm_workspace *w, pm_constraint row, int on_constraint)
{
    const int nq = w->model->nq;
    double difference[6], dense[6] = {0};
    look(w, NULL, 0);
    if (row.memory != PM_NONE)
        pm_constraint_kind(row.kind)->remember(&w->frame, &row, &w->state.memory[row.memory], 1);
    pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
    if (row.memory != PM_NONE) NEAR(row.g, 0, 1e-14);
    check_gap(&w->frame, &row);
    for (int p = 0; p < pm_constraint_bodies(&row); p++)
        for (int k = 0; k < 3 && row.body[p] < w->model->nbody; k++)
            dense[3 * row.body[p] + k] += row.j[3 * p + k];
    for (int i = 0; i < nq; i++) {
        double direction[6] = {0};
        direction[i] = 1;
        difference[i] =
            (residual_at(w, row, direction, STEP) - residual_at(w, row, direction, -STEP)) / (2 * STEP);
        NEAR(dense[i], difference[i], 2e-9);
    }
    const double change = (rate_at(w, row, speed, STEP) - rate_at(w, row, speed, -STEP)) / (2 * STEP);
    NEAR(row.gamma, -change, 1e-7);
    check_bend(w, row);
    look(w, NULL, 0);
    if (on_constraint)
        NEAR(pm_constraint_rate(&w->frame, &row), pm_constraint_times(&w->frame, &row, w->state.v), 1e-13);
}

/* The flanks of both sides push a away from b, and against each other along the pitch curves. */
static void check_flanks(pm_workspace *w, const pm_constraint *row)
{
    pm_line_of_action one, other, apart;
    pm_constraint normal = *row;
    normal.kind = row->kind == PM_CONSTRAINT_RACK ? PM_CONSTRAINT_LINE_NORMAL : PM_CONSTRAINT_DISTANCE;
    pm_constraint_kind(normal.kind)->act(&w->frame, &normal, &apart);
    pm_constraint_kind(row->kind)->act(&w->frame, row, &one);
    pm_teeth_turn(w, row->joint);
    pm_constraint_kind(row->kind)->act(&w->frame, row, &other);
    NEAR(pm_dot(one.direction, one.direction), 1, 1e-14);
    NEAR(pm_dot(one.direction, apart.direction), sin(0.35), 1e-14);
    NEAR(pm_dot(other.direction, apart.direction), sin(0.35), 1e-14);
    NEAR(pm_dot(one.direction, other.direction), -cos(0.7), 1e-14);
}

static int open_case(scene *s)
{
    return CHECK(scene_open(s) == PM_OK) && CHECK(pm_case_begin(s->w, s->constant) == PM_OK);
}

/* The slack of a cord and its slip on a rim; its rates are those of its strands along their lines. */
static void check_cord(scene *s)
{
    pm_constraint row[2], strand[2];
    if (!open_case(s)) return;
    pm_workspace *w = s->w;
    look(w, NULL, 0);
    pm_contact_constraint_both(&w->frame, 0, s->model->contact_slot[0], 0, &row[0], &row[1]);
    pm_memory *memory = &w->state.memory[row[0].memory];
    for (int k = 0; k < 2; k++) {
        pm_constraint_kind(row[k].kind)->remember(&w->frame, &row[k], memory, 1);
        check_row(w, row[k], 1);
    }
    const double wrap = pm_constraint_cord_wrap(&w->frame, &row[0]);
    CHECK(wrap > 2 * TWO_PI && wrap < 3 * TWO_PI);
    pm_constraint_cord_strands(&row[0], strand);
    for (int k = 0; k < 2; k++) {
        pm_line_of_action one;
        pm_constraint_kind(strand[k].kind)->act(&w->frame, &strand[k], &one);
        memory->direction = atan2(one.direction[1], one.direction[0]);
        if (k == 0) memory->behind = memory->direction;
    }
    const double turned = (memory->direction - memory->behind) * (row[0].radius_rim < 0 ? -1 : 1);
    NEAR(remainder(wrap - turned, TWO_PI), 0, 1e-13);
}

/* All rows of all joints and contacts of the scene. */
static void check_scene(scene *s, int on_constraint)
{
    if (!open_case(s)) return;
    pm_workspace *w = s->w;
    look(w, NULL, 0);
    for (int i = 0; i < s->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint row[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, row);
        for (int k = 0; k < n; k++) {
            EQUAL(row[k].joint, i);
            check_row(w, row[k], on_constraint || row[k].kind == PM_CONSTRAINT_ANGLE);
            if (!pm_joint_of(s->model, i)->flanks) continue;
            pm_teeth_turn(w, i);
            check_row(w, row[k], on_constraint);
            check_flanks(w, &row[k]);
        }
    }
    for (int i = 0; i < s->rows[PM_TABLE_CONTACT]; i++) {
        pm_constraint row[2];
        pm_contact_constraint_both(&w->frame, i, s->model->contact_slot[i], i == 0 ? 0 : 2, &row[0], &row[1]);
        for (int k = 0; k < 2; k++) check_row(w, row[k], on_constraint);
        EQUAL(row[0].memory, PM_NONE);
        CHECK(row[1].memory >= 0 && row[1].memory < s->model->nmemory);
    }
}

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

/* What a belt drives with is half the difference of what its strands do: the same force, and the same couple on each body. */
static void check_belt(pm_workspace *w, const pm_constraint *belt, const pm_constraint strand[2])
{
    pm_line_of_action whole, of[2];
    pm_constraint_kind(belt->kind)->act(&w->frame, belt, &whole);
    for (int k = 0; k < 2; k++) pm_constraint_kind(strand[k].kind)->act(&w->frame, &strand[k], &of[k]);
    for (int body = 0; body < 2; body++) {
        double force[2] = {0}, moment = 0; /* about where the whole acts */
        for (int k = 0; k < 2; k++) {
            const double half = k == 0 ? 0.5 : -0.5;
            const double arm[2] = {of[k].at[0] - whole.at[0], of[k].at[1] - whole.at[1]};
            for (int i = 0; i < 2; i++) force[i] += half * of[k].direction[i];
            moment += half * pm_cross(arm, of[k].direction);
        }
        for (int i = 0; i < 2; i++) NEAR(force[i], whole.direction[i], 1e-14);
        NEAR(body == 0 ? moment : -moment, whole.couple[body], 1e-14);
    }
}

/* Two circles of a belt, which may be alike. */
static void belt_rows(int ground_side, double sense, double radius_a, double radius_b)
{
    pair x = make_pair(ground_side);
    const int a = scene_circle(x.s, x.point[0], radius_a), b = scene_circle(x.s, x.point[1], radius_b);
    scene_belt(x.s, PM_JOINT_BELT_GRIPS, a, b, sense, 30);
    scene_joint(x.s, PM_JOINT_BELT, a, b, sense);
    check_scene(x.s, 1);
    if (x.s->w) {
        pm_constraint belt[PM_JOINT_CONSTRAINTS], strand[PM_JOINT_CONSTRAINTS];
        look(x.s->w, NULL, 0);
        EQUAL(pm_joint_constraints(&x.s->w->frame, &x.s->w->state, 0, belt), 1);
        EQUAL(pm_joint_constraints(&x.s->w->frame, &x.s->w->state, 1, strand), 2);
        check_belt(x.s->w, belt, strand);
    }
    scene_free(x.s);
}

/* A cord over a rim that is on the ground, or on one of the bodies while an end is on the ground. */
static void cord_rows(int rim_on)
{
    pair x = make_pair(-1);
    const int sense[3] = {1, -1, rim_on == 0 ? 1 : -1};
    const int away = scene_point(x.s, PM_GROUND, 1.9, -2.3);
    const int ends[3][2] = {{x.point[0], x.point[1]}, {away, x.point[1]}, {x.point[0], away}};
    const int rim = scene_point(x.s, rim_on - 1 < 0 ? PM_GROUND : x.body[rim_on - 1], 0.4, 2.6);
    scene_cord_over(x.s, scene_circle(x.s, ends[rim_on][0], 0.11), scene_circle(x.s, ends[rim_on][1], 0.07),
                    scene_circle(x.s, rim, 0.13), sense, 2, 0.3, 0.2);
    check_cord(x.s);
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
        belt_rows(ground_side, 1, 0.31, 0.17);
        belt_rows(ground_side, 1, 0.2, 0.2);
        belt_rows(ground_side, -1, 0.31, 0.17);
    }
    for (int rim_on = 0; rim_on < 3; rim_on++) cord_rows(rim_on);
    rolls_on_a_line();
    rolls_in_a_circle(1);
    rolls_in_a_circle(-1);
    return check_failures();
}

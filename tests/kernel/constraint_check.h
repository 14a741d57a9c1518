/* How constraints are checked on a pair of bodies: Jacobian = differences of the residual, gamma = -(dG/dt) v by differences
 * of the rate, and, on the constraint, the rate from the line of action = j v. */
#ifndef CONSTRAINT_CHECK_H
#define CONSTRAINT_CHECK_H

#include "check.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/joint.h"
#include "elements/teeth.h"
#include "equations/active_set.h"
#include "equations/saddle.h"
#include "scene.h"
#include "state/workspace.h"

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

static inline void place_of(const double pose[3], const double at[2], double p[2])
{
    p[0] = pose[0] + cos(pose[2]) * at[0] - sin(pose[2]) * at[1];
    p[1] = pose[1] + sin(pose[2]) * at[0] + cos(pose[2]) * at[1];
}

static inline pair make_pair(int ground_side)
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
static inline void look(pm_workspace *w, const double *direction, double eps)
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

static inline double residual_at(pm_workspace *w, pm_constraint row, const double *direction, double eps)
{
    look(w, direction, eps);
    pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
    return row.g;
}

static inline double rate_at(pm_workspace *w, pm_constraint row, const double *direction, double eps)
{
    look(w, direction, eps);
    pm_constraint_kind(row.kind)->evaluate(&w->frame, &row);
    return pm_constraint_times(&w->frame, &row, w->state.v);
}

/* The gap that is watched is the residual, its rate that by the Jacobian, to the last bit. */
static inline void check_gap(const pm_frame *frame, const pm_constraint *row)
{
    double rate;
    if (!pm_constraint_kind(row->kind)->gap) return;
    NEAR(pm_constraint_kind(row->kind)->gap(frame, row, &rate), row->g, 0);
    NEAR(pm_constraint_kind(row->kind)->gap(frame, row, NULL), row->g, 0);
    NEAR(rate, pm_constraint_times(frame, row, frame->v), 0);
}

/* The second derivatives are those of the Jacobian, and looking for them leaves no trace. */
static inline void check_bend(pm_workspace *w, pm_constraint row)
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

static inline void check_row(pm_workspace *w, pm_constraint row, int on_constraint)
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
static inline void check_flanks(pm_workspace *w, const pm_constraint *row)
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

static inline int open_case(scene *s)
{
    return CHECK(scene_open(s) == PM_OK) && CHECK(pm_case_begin(s->w, s->constant) == PM_OK);
}

/* All rows of all joints and contacts of the scene. */
static inline void check_scene(scene *s, int on_constraint)
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

#endif

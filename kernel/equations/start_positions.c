/* start_positions.c - positions of a start: Gauss-Newton on constraints of joints and written positions together, each
 * step the least one (in the metric of M), so what is written stays and the rest moves as little as possible. */
#include "equations/start_positions.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/contact.h"
#include "elements/joint.h"
#include "elements/measure.h"
#include "equations/active_set.h"
#include "equations/least_change.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

/* Worst opening of joints and written positions at the frame; where it is. */
static double worst_opening(pm_workspace *w, int *table, int *row)
{
    const pm_model *m = w->model;
    double worst = 0;
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < n; k++) {
            if (c[k].memory != PM_NONE) continue; /* no slip: anchored where the assembly ends */
            pm_constraint_kind(c[k].kind)->evaluate(&w->frame, &c[k]);
            const double size = fabs(c[k].g) * (pm_constraint_is_angle(&c[k]) ? w->numbers.size : 1);
            if (!(size <= worst)) {
                worst = size;
                *table = PM_TABLE_JOINT;
                *row = i;
            }
        }
    }
    for (int i = 0; i < m->rows[PM_TABLE_START]; i++) {
        if (pm_start_level(w->model, i) != PM_START_POSITION) continue;
        const double miss =
            fabs(pm_measure(w, pm_start_measure(w->model, i)) - pm_start_value(w->model, &w->numbers, i));
        if (!(miss <= worst)) {
            worst = miss;
            *table = PM_TABLE_START;
            *row = i;
        }
    }
    return worst;
}

/* Whether each written position is independent of those before it, and of the block. */
static int take_written_positions(pm_workspace *w, pm_least_change *s, double *dense)
{
    int all = 1;
    for (int i = 0; i < w->model->rows[PM_TABLE_START]; i++) {
        double miss;
        if (pm_start_level(w->model, i) != PM_START_POSITION) continue;
        const double residual =
            pm_measure(w, pm_start_measure(w->model, i)) - pm_start_value(w->model, &w->numbers, i);
        pm_measure_start_gradient(w, pm_start_measure(w->model, i), PM_START_POSITION, dense);
        all &= pm_least_change_take(&w->active, &w->saddle, s, dense, -residual, &miss);
    }
    return all;
}

/* One Gauss-Newton step in w->scratch; what is written comes first, so that it decides where constraints disagree. */
static void position_step(pm_workspace *w, double *x, double *dense)
{
    const pm_model *m = w->model;
    pm_least_change s = {.x = x, .across = dense + m->nq};
    double miss;
    memset(x, 0, (size_t)m->nq * sizeof *x);
    const int solved =
        pm_least_change_block(w, &s, PM_START_POSITION) && take_written_positions(w, &s, dense);
    pm_active_set_clear(&w->active, w->model);
    if (solved) return;
    s.n = s.block = 0;
    memset(x, 0, (size_t)m->nq * sizeof *x);
    take_written_positions(w, &s, dense);
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint c[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, c);
        for (int k = 0; k < n; k++) {
            if (c[k].memory != PM_NONE) continue;
            pm_constraint_kind(c[k].kind)->evaluate(&w->frame, &c[k]);
            pm_least_change_take_constraint(w, &s, &c[k], -c[k].g, dense, &miss);
        }
    }
}

/* The longest move and the largest turn of a step, by the scene's size. */
static double longest(const pm_model *model, const pm_numbers *numbers, const double *x, double *turn)
{
    double move = 0;
    *turn = 0;
    for (int i = 0; i < model->nq; i++) {
        double *largest = i % 3 == 2 ? turn : &move;
        *largest = pm_max(fabs(x[i]) / pm_numbers_length(numbers, i), *largest);
    }
    return move;
}

static void go(pm_workspace *w, const double *from, const double *x, double factor)
{
    for (int i = 0; i < w->model->nq; i++) w->state.q[i] = from[i] + factor * x[i];
    pm_frame_look_state(&w->frame, &w->state);
}

/* Goes along a step, which leads to other branches where it is long.  Bodies that hardly turn may go far, as those of a
 * long chain do which are drawn at one place: a joint is linear in its places.  If that does not close it, they go back. */
static void take_step(pm_workspace *w, const double *x, double *from, double opening)
{
    double turn;
    int table, row;
    const double move = longest(w->model, &w->numbers, x, &turn), most = pm_max(move, turn);
    memcpy(from, w->state.q, (size_t)w->model->nq * sizeof *from);
    if (turn <= PM_ASSEMBLY_LONGEST) {
        go(w, from, x, 1);
        if (most <= PM_ASSEMBLY_LONGEST || worst_opening(w, &table, &row) <= PM_GAIN * opening) return;
    }
    go(w, from, x, PM_ASSEMBLY_LONGEST / most);
}

int pm_start_assemble(pm_workspace *w, pm_start_report *report)
{
    const pm_model *m = w->model;
    const double allowed = w->numbers.value[PM_SETTING(m, PM_SETTING_ASSEMBLY)] * w->numbers.size;
    double *x = w->scratch, *dense = x + m->nq, best = INFINITY;
    int table = PM_NONE, row = PM_NONE;
    pm_frame_look_state(&w->frame, &w->state);
    for (int sweep = 0; sweep < PM_ASSEMBLY_SWEEPS; sweep++) {
        pm_active_set_find_feet(&w->frame, &w->state);
        report->opening = worst_opening(w, &table, &row);
        const int gains = report->opening < PM_GAIN * best;
        if (!(report->opening > PM_ASSEMBLED * w->numbers.size) || (report->opening <= allowed && !gains))
            break;
        best = pm_min(report->opening, best);
        position_step(w, x, dense);
        take_step(w, x, dense + 2 * m->nq, report->opening);
    }
    for (int i = 0; i < m->nbody; i++)
        for (int k = 0; k < 3; k++) {
            const double drawn = PM_BODY_ROW(m, i)[PM_BODY_ROTATES] || k < 2
                                     ? w->numbers.value[PM_BODY_ROW(m, i)[PM_BODY_X + k]]
                                     : 0;
            report->moved =
                pm_max(fabs(w->state.q[3 * i + k] - drawn) * (k == 2 ? w->numbers.size : 1), report->moved);
        }
    return report->opening <= allowed
               ? PM_OK
               : pm_fail(&w->result, PM_ASSEMBLY, table, row, report->opening, allowed);
}

static double apart(const pm_frame *frame, const pm_constraint *c)
{
    const pm_marks x = pm_constraint_marks(frame, c);
    return pm_length(x.d);
}

/* Pitch circles, or one and the pitch line of a rack, touch. */
static int check_gears(const pm_frame *frame, pm_result *result, int table, int at, const pm_constraint *c)
{
    const int rack = c->kind == PM_CONSTRAINT_RACK;
    const double allowed = PM_MESHES * (rack ? c->radius_a : apart(frame, c));
    pm_constraint touch = *c;
    touch.kind = rack ? PM_CONSTRAINT_LINE_NORMAL : PM_CONSTRAINT_DISTANCE;
    pm_constraint_kind(touch.kind)->evaluate(frame, &touch);
    const double open = fabs(touch.g);
    return open <= allowed ? PM_OK : pm_fail(result, PM_ASSEMBLY, table, at, open, allowed);
}

static int check_strand(const pm_frame *frame, pm_result *result, int table, int at, const pm_constraint *c)
{
    if (c->over) {
        pm_constraint strand[2];
        pm_constraint_cord_strands(c, strand);
        const int status = check_strand(frame, result, table, at, &strand[0]);
        return status ? status : check_strand(frame, result, table, at, &strand[1]);
    }
    const double distance = apart(frame, c), past = fabs(c->radius_b - c->radius_a);
    return distance > past ? PM_OK : pm_fail(result, PM_ASSEMBLY, table, at, past - distance, 0);
}

int pm_start_check_couplings(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_constraint c[PM_JOINT_CONSTRAINTS];
    int status = PM_OK;
    for (int i = 0; !status && i < m->rows[PM_TABLE_JOINT]; i++) {
        const int kind = PM_JOINT_ROW(m, i)[PM_JOINT_KIND];
        const pm_joint_ops *ops = pm_joint_of(m, i);
        const int belt = kind == PM_JOINT_BELT || ops->strands;
        if ((kind != PM_JOINT_GEARS && !belt && !ops->flanks) ||
            pm_state_is_absent(m, &w->state, PM_TABLE_JOINT, i))
            continue;
        const int n = pm_joint_constraints_of_any(&w->frame, i, c);
        for (int k = 0; !status && k < n; k++)
            status = belt ? check_strand(&w->frame, &w->result, PM_TABLE_JOINT, i, &c[k])
                          : check_gears(&w->frame, &w->result, PM_TABLE_JOINT, i, &c[k]);
    }
    for (int i = 0; !status && i < m->rows[PM_TABLE_CONTACT]; i++) {
        if (!pm_contact_measures_itself(m, i)) continue;
        pm_contact_constraint_normal(&w->frame, i, m->contact_slot[i], 0, &c[0]);
        status = pm_contact_is_cord(m, i) ? check_strand(&w->frame, &w->result, PM_TABLE_CONTACT, i, &c[0])
                                          : check_gears(&w->frame, &w->result, PM_TABLE_CONTACT, i, &c[0]);
    }
    return status;
}

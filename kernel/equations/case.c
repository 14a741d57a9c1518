/* case.c - the numbers of a case: values (case_values.c), masses, scales; what several of them must keep together is checked
 * here, with its place. */
#include "equations/case.h"

#include <math.h>

#include "elements/contact.h"
#include "elements/contact_curve.h"
#include "elements/curve.h"
#include "elements/force.h"
#include "elements/joint.h"
#include "elements/turning_plane.h"
#include "equations/case_values.h"
#include "expression/program.h"
#include "numerics/minmax.h"
#include "numerics/tolerances.h"
#include "scene/reference.h"
#include "state/evidence.h"
#include "state/frame.h"
#include "state/workspace.h"

static int out_of_bound(pm_result *result, int table, int row, int member, double value, double bound)
{
    return pm_fail_member(result, PM_BAD_VALUE, table, row, member, value, bound);
}

/* value must be finite and > low (or >= low). */
static int check(pm_workspace *w, int table, int row, int column, double low, int strict)
{
    const int index = pm_model_row(w->model, table, row, pm_reference_columns[table])[column];
    const double value = w->numbers.value[index];
    if (isfinite(value) && (strict ? value > low : value >= low)) return PM_OK;
    return out_of_bound(&w->result, table, row, column, value, low);
}

static int read_bodies(pm_workspace *w)
{
    for (int i = 0; i < w->model->nbody; i++) {
        const int32_t *e = PM_BODY_ROW(w->model, i);
        const int status = e[PM_BODY_ROTATES] ? check(w, PM_TABLE_BODY, i, PM_BODY_INERTIA, 0, 0) : PM_OK;
        if (status) return status;
        w->numbers.mass[i] = w->numbers.value[e[PM_BODY_MASS]];
        w->numbers.inverse_mass[3 * i] = w->numbers.inverse_mass[3 * i + 1] = 1 / w->numbers.mass[i];
        w->numbers.inverse_mass[3 * i + 2] =
            e[PM_BODY_ROTATES] ? 1 / w->numbers.value[e[PM_BODY_INERTIA]] : 0;
    }
    return PM_OK;
}

static int check_rows(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_PATTERN]; i++) {
        const int32_t *e = PM_PATTERN_ROW(w->model, i);
        const double step =
            hypot(w->numbers.value[e[PM_PATTERN_STEP_X]], w->numbers.value[e[PM_PATTERN_STEP_Y]]);
        if (!(step > 0) || !isfinite(step))
            return out_of_bound(&w->result, PM_TABLE_PATTERN, i, PM_PATTERN_STEP_X, step, 0);
    }
    return PM_OK;
}

static int check_curves(pm_workspace *w)
{
    int status = PM_OK;
    for (int i = 0; !status && i < w->model->rows[PM_TABLE_CURVE]; i++) status = pm_curve_check(w, i);
    return status;
}

/* 1, -1 or -2: which circle is inside the other. */
static int check_side(const pm_numbers *numbers, pm_result *result, int table, int row, int column, int index)
{
    const double side = numbers->value[index];
    return side == 1 || side == -1 || side == -2 ? PM_OK : out_of_bound(result, table, row, column, side, 1);
}

/* A cord is wound about a rim by full turns. */
static int check_turns(pm_workspace *w, int contact, double turns)
{
    return turns >= 0 && turns == floor(turns)
               ? PM_OK
               : out_of_bound(&w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_TURNS, turns, 0);
}

/* Of two curves the first is the line without ends. */
static int touches_endless(const pm_model *m, const int32_t *e)
{
    const int kind = e[PM_CONTACT_KIND];
    return (kind == PM_CONTACT_CURVE || kind == PM_CONTACT_CURVES) && pm_curve_is_endless(m, e[PM_CONTACT_B]);
}

/* Flanks that both touch press on each other by nothing that is known: without backlash teeth are a joint.  A point touches
 * neither a point nor a pattern; points that meet have no radius. */
static int check_partners(pm_workspace *w, int contact)
{
    const pm_model *m = w->model;
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    if (touches_endless(m, e))
        return out_of_bound(&w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_B, PM_CURVE_ENDLESS,
                            PM_CURVE_ROUND);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_CURVES) return PM_OK;
    double radius = w->numbers.value[PM_CIRCLE_ROW(m, e[PM_CONTACT_A])[PM_CIRCLE_RADIUS]];
    if (pm_contact_has_flank(m, contact) && !(w->numbers.value[e[PM_CONTACT_SLACK]] > 0))
        return out_of_bound(&w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_SLACK,
                            w->numbers.value[e[PM_CONTACT_SLACK]], 0);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_TEETH)
        return check_side(&w->numbers, &w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_SIDE,
                          e[PM_CONTACT_SIDE]);
    if (pm_contact_has_rim(m, contact)) return check_turns(w, contact, w->numbers.value[e[PM_CONTACT_TURNS]]);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_LINE || e[PM_CONTACT_KIND] == PM_CONTACT_CURVE ||
        pm_contact_measures_itself(m, contact))
        return PM_OK;
    if (e[PM_CONTACT_KIND] == PM_CONTACT_POINT) {
        radius = pm_max(w->numbers.value[PM_CIRCLE_ROW(m, e[PM_CONTACT_B])[PM_CIRCLE_RADIUS]], radius);
        return radius == 0 ? PM_OK
                           : out_of_bound(&w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_A, radius, 0);
    }
    if (e[PM_CONTACT_KIND] == PM_CONTACT_SEGMENT) {
        const double from = w->numbers.value[e[PM_CONTACT_FROM]], to = w->numbers.value[e[PM_CONTACT_TO]];
        return from < to ? PM_OK
                         : out_of_bound(&w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_TO, to, from);
    }
    if (e[PM_CONTACT_KIND] == PM_CONTACT_CIRCLE) {
        radius = pm_max(w->numbers.value[PM_CIRCLE_ROW(m, e[PM_CONTACT_B])[PM_CIRCLE_RADIUS]], radius);
        const int status = check_side(&w->numbers, &w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_SIDE,
                                      e[PM_CONTACT_SIDE]);
        if (status) return status;
    }
    return radius > 0 ? PM_OK : out_of_bound(&w->result, PM_TABLE_CONTACT, contact, PM_CONTACT_A, radius, 0);
}

static int check_joint(pm_workspace *w, int joint)
{
    const pm_joint_ops *ops = pm_joint_of(w->model, joint);
    const int32_t *e = PM_JOINT_ROW(w->model, joint);
    if (ops->flanks && w->numbers.value[e[PM_JOINT_VALUE_2]] > PM_PRESSURE_MOST)
        return out_of_bound(&w->result, PM_TABLE_JOINT, joint, PM_JOINT_VALUE_2,
                            w->numbers.value[e[PM_JOINT_VALUE_2]], PM_PRESSURE_MOST);
    if (ops->number == PM_NUMBER_SIDE)
        return check_side(&w->numbers, &w->result, PM_TABLE_JOINT, joint, PM_JOINT_VALUE, e[PM_JOINT_VALUE]);
    const int length = ops->number == PM_NUMBER_LENGTH;
    return ops->number ? check(w, PM_TABLE_JOINT, joint, PM_JOINT_VALUE, length ? 0 : -INFINITY, length)
                       : PM_OK;
}

static int check_elements(pm_workspace *w)
{
    const pm_model *m = w->model;
    int status = PM_OK;
    for (int i = 0; !status && i < m->rows[PM_TABLE_JOINT]; i++) status = check_joint(w, i);
    for (int i = 0; !status && i < m->rows[PM_TABLE_CONTACT]; i++) status = check_partners(w, i);
    for (int i = 0; !status && i < m->rows[PM_TABLE_FORCE]; i++) {
        const int *number = pm_force_of(m, i)->number;
        for (int k = 0; !status && k < 2 && number[k]; k++)
            status = check(w, PM_TABLE_FORCE, i, PM_FORCE_VALUE_1 + k,
                           number[k] == PM_FORCE_NOT_NEGATIVE ? 0 : -INFINITY, 0);
    }
    return status;
}

static void read_settings(pm_workspace *w)
{
    const pm_model *m = w->model;
    w->numbers.gravity[0] = w->numbers.value[PM_SETTING(m, PM_SETTING_GRAVITY_X)];
    w->numbers.gravity[1] = w->numbers.value[PM_SETTING(m, PM_SETTING_GRAVITY_Y)];
    w->numbers.accuracy = w->numbers.value[PM_SETTING(m, PM_SETTING_ACCURACY)];
    w->numbers.tolerance = pm_evidence_tolerance(w);
}

/* Rows of constraints are compared in a metric in which no coordinate is too light: which depend on each other is the same in
 * any. */
static void mark_light(pm_numbers *numbers, int nbody)
{
    double greatest = 0;
    for (int i = 0; i < nbody; i++) greatest = pm_max(numbers->mass[i], greatest);
    numbers->light_any = 0;
    numbers->compared_by_mass = 1;
    for (int i = 0; i < 3 * nbody; i++) {
        const double whole = greatest * (i % 3 == 2 ? numbers->size * numbers->size : 1);
        numbers->light[i] = numbers->inverse_mass[i] * PM_LIGHT * whole > 1;
        numbers->light_any |= numbers->light[i];
        const double most = 1 / (PM_LIGHT_METRIC * whole);
        numbers->compared_by_mass &= numbers->inverse_mass[i] <= most;
        numbers->inverse_root[i] = sqrt(pm_min(numbers->inverse_mass[i], most));
    }
}

/* What has no mass is given some in the metric of the constraints; saddle.c takes it off again.  Without any mass in the
 * scene nothing could be said. */
static int set_stand_ins(pm_workspace *w)
{
    const pm_model *m = w->model;
    double least = INFINITY;
    w->numbers.massless = 0;
    for (int i = 0; i < m->nbody; i++)
        if (w->numbers.mass[i] > 0) least = pm_min(w->numbers.mass[i], least);
    for (int i = 0; i < m->nq; i++) {
        const int none = isinf(w->numbers.inverse_mass[i]);
        if (none && isinf(least)) return out_of_bound(&w->result, PM_TABLE_BODY, i / 3, PM_BODY_MASS, 0, 0);
        w->numbers.stand_in[i] =
            none ? PM_STAND_IN * least * (i % 3 == 2 ? w->numbers.size * w->numbers.size : 1) : 0;
        if (none) w->numbers.inverse_mass[i] = 1 / w->numbers.stand_in[i];
        w->numbers.massless |= none;
    }
    mark_light(&w->numbers, m->nbody);
    return PM_OK;
}

static int is_on_ground(const pm_model *m, int circle)
{
    return PM_POINT_ROW(m, PM_CIRCLE_ROW(m, circle)[PM_CIRCLE_POINT])[PM_POINT_BODY] == PM_GROUND;
}

static int is_track(const pm_model *m, int curve)
{
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++)
        if (pm_joint_of(m, i)->b == PM_TABLE_CURVE && PM_JOINT_ROW(m, i)[PM_JOINT_B] == curve) return 1;
    return 0;
}

/* A road of the ground may be far longer than what touches it. */
static int is_road(const pm_model *m, int curve)
{
    return pm_model_body_of(m, PM_TABLE_CURVE, curve) == PM_GROUND && !is_track(m, curve);
}

/* Half the extent of the largest curve that is a road, or that is none. */
static double size_of_curves(const pm_frame *frame, int roads)
{
    const pm_model *m = frame->model;
    double size = 0;
    for (int i = 0; i < m->rows[PM_TABLE_CURVE]; i++)
        if (is_road(m, i) == roads && !pm_curve_is_endless(m, i))
            size = fmax(0.5 * pm_curve_extent(frame, i), size);
    return size;
}

/* Extent of the marks on bodies and of the bodies as drawn; 1 m where there is none. */
static void set_size(const pm_frame *frame, pm_numbers *numbers)
{
    const pm_model *m = frame->model;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, size = 0;
    for (int i = 0; i < m->nbody; i++)
        for (int k = 0; k < 2; k++) {
            const double x = numbers->value[PM_BODY_ROW(m, i)[PM_BODY_X + k]];
            low[k] = pm_min(x, low[k]);
            high[k] = pm_max(x, high[k]);
        }
    for (int k = 0; k < 2 && m->nbody > 0; k++) size = pm_max(high[k] - low[k], size);
    for (int i = 0; i < m->rows[PM_TABLE_POINT]; i++) {
        const int32_t *e = PM_POINT_ROW(m, i);
        const double x = fabs(numbers->value[e[PM_POINT_X]]), y = fabs(numbers->value[e[PM_POINT_Y]]);
        if (e[PM_POINT_BODY] != PM_GROUND && !(x + y <= size)) size = pm_max(hypot(x, y), size);
    }
    for (int i = 0; i < m->rows[PM_TABLE_CIRCLE]; i++)
        if (!is_on_ground(m, i)) size = pm_max(numbers->value[PM_CIRCLE_ROW(m, i)[PM_CIRCLE_RADIUS]], size);
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        const int32_t *e = PM_JOINT_ROW(m, i);
        if (e[PM_JOINT_KIND] == PM_JOINT_LINK) size = pm_max(numbers->value[e[PM_JOINT_VALUE]], size);
    }
    if (size == 0) /* a particle alone: how far it is from the ground's marks */
        for (int i = 0; i < m->rows[PM_TABLE_POINT]; i++) {
            const int32_t *e = PM_POINT_ROW(m, i);
            if (e[PM_POINT_BODY] != PM_GROUND || m->nbody == 0) continue;
            size = fmax(
                size, hypot(numbers->value[e[PM_POINT_X]] - low[0], numbers->value[e[PM_POINT_Y]] - low[1]));
        }
    for (int i = 0; i < m->rows[PM_TABLE_CIRCLE]; i++) /* a small peg is not all that there is */
        if (is_on_ground(m, i)) size = pm_max(numbers->value[PM_CIRCLE_ROW(m, i)[PM_CIRCLE_RADIUS]], size);
    size = fmax(size_of_curves(frame, 0), size);
    if (size == 0) size = size_of_curves(frame, 1);
    numbers->size = size > 0 && isfinite(size) ? size : 1;
}

double pm_case_max_time(const pm_model *model, const pm_numbers *numbers)
{
    const int index = PM_SETTING(model, PM_SETTING_MAX_TIME);
    return index == PM_NONE ? PM_MAX_TIME : numbers->value[index];
}

double pm_case_max_cpu(const pm_model *model, const pm_numbers *numbers)
{
    const int index = PM_SETTING(model, PM_SETTING_MAX_CPU);
    return index == PM_NONE ? INFINITY : numbers->value[index];
}

int pm_case_speed(const pm_model *model, pm_numbers *numbers, const double *v)
{
    double fastest = 0;
    for (int i = 0; i < model->nq; i++)
        fastest = pm_max(fabs(v[i]) * (i % 3 == 2 ? numbers->size : 1), fastest);
    if (!(fastest > PM_FASTER * numbers->speed)) return 0;
    numbers->speed = fastest;
    return 1;
}

double pm_case_acceleration(const pm_numbers *numbers)
{
    return hypot(numbers->gravity[0], numbers->gravity[1]) + numbers->speed * numbers->speed / numbers->size;
}

double pm_case_force(const pm_model *model, const pm_numbers *numbers)
{
    const double acceleration = pm_case_acceleration(numbers);
    double sum = 0;
    for (int i = 0; i < model->nbody; i++) sum += numbers->mass[i] * acceleration;
    return sum;
}

double pm_case_time_scale(const pm_model *model, const pm_numbers *numbers, const double *v, const double *a)
{
    double rate = 0;
    for (int i = 0; i < model->nq; i++) {
        const double length = pm_numbers_length(numbers, i);
        rate = pm_max(pm_max(fabs(v[i]) / length, sqrt(fabs(a[i]) / length)), rate);
    }
    return rate > 0 ? numbers->coarse / rate : INFINITY;
}

int pm_case_begin(pm_workspace *w, const double *param)
{
    int status = pm_case_values(w, param);
    if (!status) status = pm_case_values_check(w);
    if (status) return status;
    read_settings(w);
    status = read_bodies(w);
    if (!status) status = pm_turning_plane_case(w);
    if (!status) status = check_rows(w);
    if (!status) status = check_curves(w);
    if (!status) status = check_elements(w);
    if (!status) status = pm_contact_curve_begin(w);
    if (status) return status;
    pm_joint_compose(&w->frame);
    pm_contact_compose(&w->frame);
    pm_case_values_fold(w);
    set_size(&w->frame, &w->numbers);
    w->numbers.speed = 0;
    return set_stand_ins(w);
}

double pm_case_shift(const pm_workspace *w, pm_state *shifted)
{
    const pm_numbers *n = &w->numbers;
    pm_state_copy(shifted, &w->state);
    for (int i = 0; i < w->model->nq; i++) {
        const double part = PM_SHIFT * (i % 2 ? -1 : 1) * (0.6 + 0.4 / (1 + i)),
                     length = pm_numbers_length(n, i);
        shifted->q[i] += part * length;
        shifted->v[i] += part * length * n->speed / n->size;
    }
    for (int i = 0; i < w->model->nz; i++) shifted->z[i] *= 1 + PM_SHIFT;
    shifted->t += PM_SHIFT * n->size / n->speed;
    return PM_SHIFT;
}

void pm_case_later(const pm_workspace *w, double later, pm_state *to)
{
    pm_state_copy(to, &w->state);
    for (int i = 0; i < w->model->nq; i++) {
        to->q[i] += later * (w->state.v[i] + 0.5 * later * w->frame.a[i]);
        to->v[i] += later * w->frame.a[i];
    }
    to->t += later;
}

double pm_case_apart(const pm_numbers *numbers, int nq, const double *a, const double *b)
{
    double apart = 0;
    for (int i = 0; i < nq; i++) {
        const double length = pm_numbers_length(numbers, i);
        const double place = fabs(a[i] - b[i]), speed = fabs(a[nq + i] - b[nq + i]);
        apart = pm_max((place + speed * numbers->size / numbers->speed) / length, apart);
    }
    return apart;
}

/* measure.c - table of measure kinds: what each needs, what its `a` points at, how it is read off the frame. */
#include "elements/measure.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/joint.h"
#include "elements/measure_kinds.h"
#include "elements/slope.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

/* The words of the table below. */
enum { NOTHING = -1, BODY = PM_TABLE_BODY, POINT = PM_TABLE_POINT, JOINT = PM_TABLE_JOINT };
enum { CONTACT = PM_TABLE_CONTACT, FORCE = PM_TABLE_FORCE, EVENT = PM_TABLE_EVENT };
enum {
    CONSTANT = PM_CLASS_CONSTANT,
    TIME_ONLY = PM_CLASS_TIME,
    PLACE = PM_CLASS_PLACE,
    MOTION = PM_CLASS_MOTION
};
enum { SAME = PM_ENERGY_CLASS_NONE, LINEAR = PM_ENERGY_CLASS_LINEAR, ROOT = PM_ENERGY_CLASS_ROOT };
enum { CONVEX = PM_ENERGY_CLASS_CONVEX, UNKNOWN = PM_ENERGY_CLASS_UNKNOWN, NO_DEGREE = PM_DEGREE_OTHER };
enum { DYNAMIC = PM_MEASURE_DYNAMIC, OR_ALL = PM_MEASURE_OR_ALL, OF_ALL = PM_MEASURE_OF_ALL };
enum { STARTS_POSITION = PM_MEASURE_STARTS_POSITION, STARTS_VELOCITY = PM_MEASURE_STARTS_VELOCITY };

static const pm_measure_ops kinds[PM_MEASURE_KINDS] = {
    [PM_MEASURE_TIME] = {NOTHING, TIME_ONLY, UNKNOWN, 1, 0, .scalar = pm_measured_time,
                         .slope = pm_measure_slope_nothing},
    [PM_MEASURE_ANGLE] = {BODY, PLACE, SAME, 2, STARTS_POSITION, .scalar = pm_measured_angle,
                          .slope = pm_measure_slope_angle},
    [PM_MEASURE_TURNED] = {BODY, PLACE, SAME, 2, 0, .scalar = pm_measured_turned,
                           .slope = pm_measure_slope_turned},
    [PM_MEASURE_OMEGA] = {BODY, MOTION, ROOT, 1, STARTS_VELOCITY, .scalar = pm_measured_omega,
                          .slope = pm_measure_slope_omega},
    [PM_MEASURE_ALPHA] = {BODY, MOTION, LINEAR, 0, DYNAMIC, .scalar = pm_measured_alpha},
    [PM_MEASURE_MASS] = {BODY, CONSTANT, SAME, 0, OR_ALL, .scalar = pm_measured_mass,
                         .slope = pm_measure_slope_nothing},
    [PM_MEASURE_WEIGHT] = {BODY, CONSTANT, SAME, 0, OR_ALL, .scalar = pm_measured_weight,
                           .slope = pm_measure_slope_nothing},
    [PM_MEASURE_INERTIA] = {BODY, PLACE, SAME, 0, 0, .scalar = pm_measured_inertia,
                            .slope = pm_measure_slope_inertia},
    [PM_MEASURE_KINETIC] = {BODY, MOTION, LINEAR, 2, OR_ALL, .scalar = pm_measured_kinetic,
                            .slope = pm_measure_slope_kinetic},
    [PM_MEASURE_MOMENTUM] = {BODY, MOTION, ROOT, 1, OR_ALL, .vector = pm_measured_momentum,
                             .slope = pm_measure_slope_momentum},
    [PM_MEASURE_ANGULAR_MOMENTUM] = {BODY, MOTION, ROOT, 1, OR_ALL, .scalar = pm_measured_angular_momentum,
                                     .slope = pm_measure_slope_angular_momentum},
    [PM_MEASURE_POLE] = {BODY, MOTION, SAME, NO_DEGREE, 0, .vector = pm_measured_pole,
                         .slope = pm_measure_slope_pole},
    [PM_MEASURE_POSITION] = {POINT, PLACE, SAME, 2, STARTS_POSITION, .vector = pm_measured_position,
                             .slope = pm_measure_slope_position},
    [PM_MEASURE_MOVED] = {POINT, PLACE, SAME, 2, 0, .vector = pm_measured_moved,
                          .slope = pm_measure_slope_moved},
    [PM_MEASURE_PATH] = {POINT, MOTION, SAME, NO_DEGREE, 0, .scalar = pm_measured_path,
                         .slope = pm_measure_slope_nothing},
    [PM_MEASURE_VELOCITY] = {POINT, MOTION, ROOT, 1, STARTS_VELOCITY, .vector = pm_measured_velocity,
                             .slope = pm_measure_slope_velocity},
    [PM_MEASURE_ACCELERATION] = {POINT, MOTION, LINEAR, 0, DYNAMIC, .vector = pm_measured_acceleration},
    [PM_MEASURE_JOINT_FORCE] = {JOINT, MOTION, LINEAR, 0, DYNAMIC, .vector = pm_measured_joint_force},
    [PM_MEASURE_JOINT_COUPLE] = {JOINT, MOTION, LINEAR, 0, DYNAMIC, .scalar = pm_measured_joint_couple},
    [PM_MEASURE_JOINT_IMPULSE] = {JOINT, MOTION, UNKNOWN, 0, DYNAMIC | OF_ALL,
                                  .vector = pm_measured_joint_impulse},
    [PM_MEASURE_JOINT_NORMAL] = {JOINT, MOTION, LINEAR, 0, DYNAMIC, .scalar = pm_measured_joint_normal},
    [PM_MEASURE_JOINT_FRICTION] = {JOINT, MOTION, LINEAR, 0, DYNAMIC, .scalar = pm_measured_joint_friction},
    [PM_MEASURE_JOINT_FRICTION_NEEDED] = {JOINT, MOTION, CONVEX, 0, DYNAMIC,
                                          .scalar = pm_measured_joint_friction_needed},
    [PM_MEASURE_JOINT_SLIP] = {JOINT, MOTION, ROOT, 1, 0, .scalar = pm_measured_joint_slip,
                               .slope = pm_measure_slope_joint_slip},
    [PM_MEASURE_JOINT_POWER] = {JOINT, MOTION, UNKNOWN, NO_DEGREE, DYNAMIC,
                                .scalar = pm_measured_joint_power},
    [PM_MEASURE_CONTACT_GAP] = {CONTACT, PLACE, SAME, 2, 0, .scalar = pm_measured_contact_gap,
                                .slope = pm_measure_slope_gap},
    [PM_MEASURE_CONTACT_CLOSED] = {CONTACT, MOTION, SAME, 0, 0, .scalar = pm_measured_contact_closed,
                                   .slope = pm_measure_slope_nothing},
    [PM_MEASURE_CONTACT_SLIP] = {CONTACT, MOTION, ROOT, 1, 0, .scalar = pm_measured_contact_slip,
                                 .slope = pm_measure_slope_slip},
    [PM_MEASURE_CONTACT_NORMAL] = {CONTACT, MOTION, LINEAR, 0, DYNAMIC, .scalar = pm_measured_contact_normal},
    [PM_MEASURE_CONTACT_FRICTION] = {CONTACT, MOTION, LINEAR, 0, DYNAMIC,
                                     .scalar = pm_measured_contact_friction},
    [PM_MEASURE_CONTACT_FRICTION_NEEDED] = {CONTACT, MOTION, CONVEX, 0, DYNAMIC,
                                            .scalar = pm_measured_contact_friction_needed},
    [PM_MEASURE_CONTACT_FORCE] = {CONTACT, MOTION, LINEAR, 0, DYNAMIC, .vector = pm_measured_contact_force},
    [PM_MEASURE_CONTACT_COUPLE] = {CONTACT, MOTION, LINEAR, 0, DYNAMIC, .scalar = pm_measured_contact_couple},
    [PM_MEASURE_CONTACT_TENSION] = {CONTACT, MOTION, LINEAR, 0, DYNAMIC,
                                    .scalar = pm_measured_contact_tension},
    [PM_MEASURE_CONTACT_TENSION_IMPULSE] = {CONTACT, MOTION, UNKNOWN, 0, OF_ALL,
                                            .scalar = pm_measured_contact_tension_impulse},
    [PM_MEASURE_CONTACT_IMPULSE] = {CONTACT, MOTION, UNKNOWN, 0, OF_ALL,
                                    .vector = pm_measured_contact_impulse},
    [PM_MEASURE_FORCE_FORCE] = {FORCE, MOTION, UNKNOWN, 0, 0, .vector = pm_measured_force_force,
                                .slope = pm_measure_slope_force},
    [PM_MEASURE_FORCE_COUPLE] = {FORCE, MOTION, UNKNOWN, 0, 0, .scalar = pm_measured_force_couple,
                                 .slope = pm_measure_slope_couple},
    [PM_MEASURE_FORCE_WORK] = {FORCE, MOTION, SAME, NO_DEGREE, 0, .scalar = pm_measured_force_work,
                               .slope = pm_measure_slope_work},
    [PM_MEASURE_FORCE_POWER] = {FORCE, MOTION, ROOT, 1, 0, .scalar = pm_measured_force_power,
                                .slope = pm_measure_slope_power},
    [PM_MEASURE_FORCE_STRETCH] = {FORCE, PLACE, SAME, NO_DEGREE, 0, .scalar = pm_measured_force_stretch,
                                  .slope = pm_measure_slope_stretch},
    [PM_MEASURE_FORCE_RATE] = {FORCE, MOTION, ROOT, NO_DEGREE, 0, .scalar = pm_measured_force_rate,
                               .slope = pm_measure_slope_rate},
    [PM_MEASURE_FORCE_ENERGY] = {FORCE, PLACE, SAME, NO_DEGREE, 0, .scalar = pm_measured_force_energy,
                                 .slope = pm_measure_slope_energy},
    [PM_MEASURE_EVENT_COUNT] = {EVENT, MOTION, UNKNOWN, 0, 0, .scalar = pm_measured_event_count,
                                .slope = pm_measure_slope_nothing},
    [PM_MEASURE_EVENT_TIME] = {EVENT, MOTION, UNKNOWN, 0, 0, .scalar = pm_measured_event_time,
                               .slope = pm_measure_slope_nothing},
    [PM_MEASURE_EVENT_SIDE] = {EVENT, MOTION, UNKNOWN, 0, 0, .scalar = pm_measured_event_side,
                               .slope = pm_measure_slope_nothing},
    [PM_MEASURE_PLACE] = {NOTHING, PLACE, SAME, NO_DEGREE, 0, .scalar = pm_measured_place},
    [PM_MEASURE_MODE_OMEGA] = {NOTHING, MOTION, UNKNOWN, NO_DEGREE, 0, .scalar = pm_measured_mode_omega},
    [PM_MEASURE_MODE_DAMPING] = {NOTHING, MOTION, UNKNOWN, NO_DEGREE, 0, .scalar = pm_measured_mode_damping},
    [PM_MEASURE_MODES_COUNT] = {NOTHING, MOTION, UNKNOWN, NO_DEGREE, 0, .scalar = pm_measured_modes_count},
    [PM_MEASURE_MODES_GROWTH] = {NOTHING, MOTION, UNKNOWN, NO_DEGREE, 0, .scalar = pm_measured_modes_growth},
    [PM_MEASURE_POTENTIAL] = {NOTHING, PLACE, SAME, 2, OF_ALL, .scalar = pm_measured_potential,
                              .slope = pm_measure_slope_potential},
    [PM_MEASURE_TOTAL] = {NOTHING, MOTION, LINEAR, 2, OF_ALL, .scalar = pm_measured_total,
                          .slope = pm_measure_slope_total},
    [PM_MEASURE_LOST] = {NOTHING, MOTION, UNKNOWN, 0, OF_ALL, .scalar = pm_measured_lost,
                         .slope = pm_measure_slope_nothing},
    [PM_MEASURE_SPIN_OMEGA] = {NOTHING, PLACE, SAME, NO_DEGREE, 0, .scalar = pm_measured_spin_omega,
                               .slope = pm_measure_slope_spin_omega},
    [PM_MEASURE_SPIN_ANGLE] = {NOTHING, MOTION, UNKNOWN, NO_DEGREE, 0, .scalar = pm_measured_spin_angle,
                               .slope = pm_measure_slope_nothing},
    [PM_MEASURE_SPIN_MOMENTUM] = {NOTHING, PLACE, SAME, NO_DEGREE, 0, .scalar = pm_measured_spin_momentum,
                                  .slope = pm_measure_slope_nothing},
    [PM_MEASURE_SPIN_INERTIA] = {NOTHING, PLACE, SAME, NO_DEGREE, 0, .scalar = pm_measured_spin_inertia,
                                 .slope = pm_measure_slope_spin_inertia},
};

const pm_measure_ops *pm_measure_kind(int kind) { return &kinds[kind]; }

const pm_measure_ops *pm_measure_ops_of(const pm_model *m, int i)
{
    return &kinds[PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND]];
}

int pm_measure_level(const pm_model *m, int i)
{
    return pm_measure_ops_of(m, i)->flags & PM_MEASURE_DYNAMIC ? PM_LEVEL_DYNAMIC : PM_LEVEL_KINEMATIC;
}

/* ---- reading ---- */
static double part_of(const pm_numbers *numbers, const int32_t *e, const double v[2])
{
    switch (e[PM_MEASURE_PART]) {
    case PM_PART_X: return v[0];
    case PM_PART_Y: return v[1];
    case PM_PART_NORM: return hypot(v[0], v[1]);
    case PM_PART_ANGLE: return atan2(v[1], v[0]);
    default: {
        const double direction = numbers->value[e[PM_MEASURE_VALUE]];
        return v[0] * cos(direction) + v[1] * sin(direction);
    }
    }
}

static double read_part(const pm_measure_args *x)
{
    double v[2];
    kinds[x->e[PM_MEASURE_KIND]].vector(x, v);
    return part_of(&x->w->numbers, x->e, v);
}

static pm_measure_reader reader_of(pm_workspace *w, const int32_t *e)
{
    const pm_measure_ops *ops = &kinds[e[PM_MEASURE_KIND]];
    return (pm_measure_reader){ops->scalar ? ops->scalar : read_part, {w, e, e[PM_MEASURE_A]}};
}

pm_measure_reader pm_measure_reader_of(pm_workspace *w, int i)
{
    return reader_of(w, PM_MEASURE_ROW(w->model, i));
}

double pm_measure_signed(pm_workspace *w, int i)
{
    const pm_measure_reader x = pm_measure_reader_of(w, i);
    return pm_measure_read(&x);
}

double pm_measure(pm_workspace *w, int i)
{
    const double value = pm_measure_signed(w, i);
    return pm_program_takes_size(w->model, i) ? fabs(value) : value;
}

/* ---- derivatives ---- */
int pm_measure_moves(const pm_model *m, int i)
{
    return pm_measure_ops_of(m, i)->slope != pm_measure_slope_nothing;
}

/* Of the part that is read, by the components of v. */
static void part_slope(const pm_numbers *numbers, const int32_t *e, const double v[2], double weight,
                       double out[2])
{
    const double square = v[0] * v[0] + v[1] * v[1], direction = numbers->value[e[PM_MEASURE_VALUE]];
    const double norm = square > 0 ? weight / sqrt(square) : 0, turn = square > 0 ? weight / square : 0;
    const double by[][2] = {[PM_PART_X] = {weight, 0},
                            [PM_PART_Y] = {0, weight},
                            [PM_PART_NORM] = {norm * v[0], norm * v[1]},
                            [PM_PART_ANGLE] = {-turn * v[1], turn * v[0]},
                            [PM_PART_ALONG] = {weight * cos(direction), weight * sin(direction)}};
    for (int k = 0; k < 2; k++) out[k] = by[e[PM_MEASURE_PART]][k];
}

/* By what is read at the coordinates on either side. */
static void by_differences(pm_workspace *w, int i, double weight, pm_slope *to)
{
    const pm_frame kept = w->frame;
    const int nq = w->model->nq;
    double *q = w->scratch, *v = q + nq;
    memcpy(q, kept.q, (size_t)nq * sizeof *q);
    memcpy(v, kept.v, (size_t)nq * sizeof *v);
    for (int k = 0; k < 2 * nq; k++) {
        const int body[2] = {k % nq / 3, w->model->nbody};
        if (w->numbers.fixed[body[0]]) continue;
        const double old = q[k], scale = k < nq ? w->numbers.size : w->numbers.speed;
        const double step = PM_SLOPE_STEP * (k % 3 == 2 ? scale / w->numbers.size : scale);
        double at[2], slope[6] = {0};
        for (int side = 0; side < 2; side++) {
            q[k] = side == 0 ? old - step : old + step;
            pm_frame_look(&w->frame, kept.t, q, v, kept.z, kept.memory);
            at[side] = pm_measure_signed(w, i);
        }
        q[k] = old;
        slope[k % 3] = weight * (at[1] - at[0]) / (2 * step);
        pm_slope_add_bodies(&w->frame, to, 2, body, slope, 1, k >= nq);
    }
    pm_frame_look(&w->frame, kept.t, kept.q, kept.v, kept.z, kept.memory);
    w->frame.level = kept.level;
}

void pm_measure_slope(pm_workspace *w, int i, double weight, pm_slope *to)
{
    const int32_t *e = PM_MEASURE_ROW(w->model, i);
    const pm_measure_ops *ops = &kinds[e[PM_MEASURE_KIND]];
    const pm_measure_args x = {w, e, e[PM_MEASURE_A]};
    double by[2] = {weight, 0}, v[2];
    if (ops->slope && ops->vector) {
        ops->vector(&x, v);
        part_slope(&w->numbers, e, v, weight, by);
    }
    if (!ops->slope || !ops->slope(&x, by, to)) by_differences(w, i, weight, to);
}

int pm_measure_can_start(const pm_model *m, int i, int level)
{
    const int32_t *e = PM_MEASURE_ROW(m, i);
    const int linear = e[PM_MEASURE_PART] != PM_PART_NORM && e[PM_MEASURE_PART] != PM_PART_ANGLE;
    return linear && (kinds[e[PM_MEASURE_KIND]].flags &
                      (level == PM_START_POSITION ? STARTS_POSITION : STARTS_VELOCITY));
}

/* The measure's rate is linear in v: reading it with unit velocities gives the coefficients exactly. */
void pm_measure_start_gradient(pm_workspace *w, int i, int level, double *coefficient)
{
    int32_t rate[PM_MEASURE_COLUMNS];
    memcpy(rate, PM_MEASURE_ROW(w->model, i), sizeof rate);
    if (level == PM_START_POSITION)
        rate[PM_MEASURE_KIND] =
            rate[PM_MEASURE_KIND] == PM_MEASURE_ANGLE ? PM_MEASURE_OMEGA : PM_MEASURE_VELOCITY;
    const pm_measure_reader x = reader_of(w, rate);
    double *velocity = w->frame.velocity;
    for (int k = 0; k < w->model->nq; k++) velocity[k] = 0;
    for (int k = 0; k < w->model->nq; k++) {
        velocity[k] = 1;
        coefficient[k] = pm_measure_read(&x);
        velocity[k] = 0;
    }
    for (int k = 0; k < w->model->nq; k++) velocity[k] = w->frame.v[k];
}

/* ---- the tables of a scene ---- */
/* Whether joints of its kind have the normal force or the friction that is to be read. */
static int joint_has(const pm_model *m, int kind, int joint)
{
    const pm_joint_ops *ops = pm_joint_of(m, joint);
    const int slides = ops->slip != PM_NONE && ops->slip != PM_CONSTRAINT_RATIO;
    switch (kind) {
    case PM_MEASURE_JOINT_FRICTION: return ops->presses || ops->strands || slides;
    case PM_MEASURE_JOINT_SLIP: return ops->slip != PM_NONE;
    case PM_MEASURE_JOINT_POWER: return ops->programs > 0;
    case PM_MEASURE_JOINT_NORMAL: return ops->presses || ops->strands;
    case PM_MEASURE_JOINT_FRICTION_NEEDED: return ops->presses;
    default: return 1;
    }
}

static int validate(const pm_model *m, int i, pm_where *where)
{
    const int32_t *e = PM_MEASURE_ROW(m, i);
    const int kind = e[PM_MEASURE_KIND], a = e[PM_MEASURE_A], part = e[PM_MEASURE_PART];
    if (kind < 0 || kind >= PM_MEASURE_KINDS)
        return pm_bad_table(where, PM_TABLE_MEASURE, i, kind, PM_MEASURE_KINDS);
    const pm_measure_ops *ops = &kinds[kind];
    const int low = ops->of == PM_TABLE_BODY && kind != PM_MEASURE_POLE ? PM_GROUND : 0;
    const int all = (ops->flags & OR_ALL) && a == PM_NONE;
    if (ops->of >= 0 && !all && (a < low || a >= m->rows[ops->of]))
        return pm_bad_table(where, PM_TABLE_MEASURE, i, a, m->rows[ops->of]);
    if (ops->vector && (part <= PM_PART_NONE || part >= PM_PARTS))
        return pm_bad_table(where, PM_TABLE_MEASURE, i, part, PM_PARTS);
    if (part == PM_PART_ALONG && e[PM_MEASURE_VALUE] < 0)
        return pm_bad_table(where, PM_TABLE_MEASURE, i, e[PM_MEASURE_VALUE], 0);
    const int of_mode = kind == PM_MEASURE_MODE_OMEGA || kind == PM_MEASURE_MODE_DAMPING;
    if (of_mode && e[PM_MEASURE_MEMBER] < 1)
        return pm_bad_table(where, PM_TABLE_MEASURE, i, e[PM_MEASURE_MEMBER], 1);
    if (ops->of == PM_TABLE_JOINT && !joint_has(m, kind, a))
        return pm_bad_table(where, PM_TABLE_MEASURE, i, PM_JOINT_ROW(m, a)[PM_JOINT_KIND], PM_JOINT_KINDS);
    return PM_OK;
}

static int validate_start(const pm_model *m, int i, pm_where *where)
{
    const int32_t *e = PM_START_ROW(m, i);
    const int level = e[PM_START_LEVEL];
    if (level >= PM_START_POSITION && level <= PM_START_VELOCITY &&
        pm_measure_can_start(m, e[PM_START_MEASURE], level))
        return PM_OK;
    return pm_bad_table(where, PM_TABLE_START, i, e[PM_START_MEASURE], level);
}

int pm_measure_validate(const pm_model *m, pm_where *where)
{
    int status = PM_OK;
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE] && !status; i++) status = validate(m, i, where);
    for (int i = 0; i < m->rows[PM_TABLE_START] && !status; i++) status = validate_start(m, i, where);
    return status;
}

/* measure.c - table of measure kinds: what each needs, what its `a` points at, how it is read off the frame. */
#include "elements/measure.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/joint.h"
#include "elements/measure_kinds.h"
#include "expression/program.h"
#include "state/workspace.h"

enum { ALL_ALLOWED = 1, CAN_START_POSITION = 2, CAN_START_VELOCITY = 4 };

typedef struct pm_measure_ops {
    int level;
    int of; /* table that `a` points into; -1: none */
    pm_scalar *scalar;
    pm_vector *vector;
    int flags;
} pm_measure_ops;

static const pm_measure_ops kinds[PM_MEASURE_KINDS] = {
    [PM_MEASURE_TIME] = {PM_LEVEL_KINEMATIC, -1, pm_measured_time, 0, 0},
    [PM_MEASURE_ANGLE] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_angle, 0, CAN_START_POSITION},
    [PM_MEASURE_TURNED] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_turned, 0, 0},
    [PM_MEASURE_OMEGA] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_omega, 0, CAN_START_VELOCITY},
    [PM_MEASURE_ALPHA] = {PM_LEVEL_DYNAMIC, PM_TABLE_BODY, pm_measured_alpha, 0, 0},
    [PM_MEASURE_MASS] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_mass, 0, ALL_ALLOWED},
    [PM_MEASURE_WEIGHT] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_weight, 0, ALL_ALLOWED},
    [PM_MEASURE_INERTIA] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_inertia, 0, 0},
    [PM_MEASURE_KINETIC] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_kinetic, 0, ALL_ALLOWED},
    [PM_MEASURE_MOMENTUM] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, 0, pm_measured_momentum, ALL_ALLOWED},
    [PM_MEASURE_ANGULAR_MOMENTUM] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, pm_measured_angular_momentum, 0,
                                     ALL_ALLOWED},
    [PM_MEASURE_POLE] = {PM_LEVEL_KINEMATIC, PM_TABLE_BODY, 0, pm_measured_pole, 0},
    [PM_MEASURE_POSITION] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, 0, pm_measured_position, CAN_START_POSITION},
    [PM_MEASURE_MOVED] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, 0, pm_measured_moved, 0},
    [PM_MEASURE_PATH] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, pm_measured_path, 0, 0},
    [PM_MEASURE_VELOCITY] = {PM_LEVEL_KINEMATIC, PM_TABLE_POINT, 0, pm_measured_velocity, CAN_START_VELOCITY},
    [PM_MEASURE_ACCELERATION] = {PM_LEVEL_DYNAMIC, PM_TABLE_POINT, 0, pm_measured_acceleration, 0},
    [PM_MEASURE_JOINT_FORCE] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, 0, pm_measured_joint_force, 0},
    [PM_MEASURE_JOINT_COUPLE] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, pm_measured_joint_couple, 0, 0},
    [PM_MEASURE_JOINT_IMPULSE] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, 0, pm_measured_joint_impulse, 0},
    [PM_MEASURE_JOINT_NORMAL] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, pm_measured_joint_normal, 0, 0},
    [PM_MEASURE_JOINT_FRICTION] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, pm_measured_joint_friction, 0, 0},
    [PM_MEASURE_JOINT_FRICTION_NEEDED] = {PM_LEVEL_DYNAMIC, PM_TABLE_JOINT, pm_measured_joint_friction_needed,
                                          0, 0},
    [PM_MEASURE_CONTACT_GAP] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, pm_measured_contact_gap, 0, 0},
    [PM_MEASURE_CONTACT_CLOSED] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, pm_measured_contact_closed, 0, 0},
    [PM_MEASURE_CONTACT_SLIP] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, pm_measured_contact_slip, 0, 0},
    [PM_MEASURE_CONTACT_NORMAL] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT, pm_measured_contact_normal, 0, 0},
    [PM_MEASURE_CONTACT_FRICTION] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT, pm_measured_contact_friction, 0, 0},
    [PM_MEASURE_CONTACT_FRICTION_NEEDED] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT,
                                            pm_measured_contact_friction_needed, 0, 0},
    [PM_MEASURE_CONTACT_FORCE] = {PM_LEVEL_DYNAMIC, PM_TABLE_CONTACT, 0, pm_measured_contact_force, 0},
    [PM_MEASURE_CONTACT_IMPULSE] = {PM_LEVEL_KINEMATIC, PM_TABLE_CONTACT, 0, pm_measured_contact_impulse, 0},
    [PM_MEASURE_FORCE_FORCE] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, 0, pm_measured_force_force, 0},
    [PM_MEASURE_FORCE_COUPLE] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, pm_measured_force_couple, 0, 0},
    [PM_MEASURE_FORCE_WORK] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, pm_measured_force_work, 0, 0},
    [PM_MEASURE_FORCE_POWER] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, pm_measured_force_power, 0, 0},
    [PM_MEASURE_FORCE_STRETCH] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, pm_measured_force_stretch, 0, 0},
    [PM_MEASURE_FORCE_ENERGY] = {PM_LEVEL_KINEMATIC, PM_TABLE_FORCE, pm_measured_force_energy, 0, 0},
    [PM_MEASURE_EVENT_COUNT] = {PM_LEVEL_KINEMATIC, PM_TABLE_EVENT, pm_measured_event_count, 0, 0},
    [PM_MEASURE_EVENT_TIME] = {PM_LEVEL_KINEMATIC, PM_TABLE_EVENT, pm_measured_event_time, 0, 0},
    [PM_MEASURE_POTENTIAL] = {PM_LEVEL_KINEMATIC, -1, pm_measured_potential, 0, 0},
    [PM_MEASURE_TOTAL] = {PM_LEVEL_KINEMATIC, -1, pm_measured_total, 0, 0},
    [PM_MEASURE_LOST] = {PM_LEVEL_KINEMATIC, -1, pm_measured_lost, 0, 0},
    [PM_MEASURE_SPIN_OMEGA] = {PM_LEVEL_KINEMATIC, -1, pm_measured_spin_omega, 0, 0},
    [PM_MEASURE_SPIN_ANGLE] = {PM_LEVEL_KINEMATIC, -1, pm_measured_spin_angle, 0, 0},
    [PM_MEASURE_SPIN_MOMENTUM] = {PM_LEVEL_KINEMATIC, -1, pm_measured_spin_momentum, 0, 0},
    [PM_MEASURE_SPIN_INERTIA] = {PM_LEVEL_KINEMATIC, -1, pm_measured_spin_inertia, 0, 0},
};

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

static double read_off(const pm_measure_args *x)
{
    const pm_measure_ops *ops = &kinds[x->e[PM_MEASURE_KIND]];
    if (ops->scalar) return ops->scalar(x);
    double v[2];
    ops->vector(x, v);
    return part_of(&x->w->numbers, x->e, v);
}

double pm_measure_signed(pm_workspace *w, int i)
{
    const int32_t *e = PM_MEASURE_ROW(w->model, i);
    const pm_measure_args x = {w, e, e[PM_MEASURE_A]};
    return read_off(&x);
}

double pm_measure(pm_workspace *w, int i)
{
    const double value = pm_measure_signed(w, i);
    return pm_program_takes_size(w->model, i) ? fabs(value) : value;
}

int pm_measure_of(int kind) { return kinds[kind].of; }

int pm_measure_level(const pm_model *m, int i) { return kinds[PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND]].level; }

int pm_measure_can_start(const pm_model *m, int i, int level)
{
    const int32_t *e = PM_MEASURE_ROW(m, i);
    const int linear = e[PM_MEASURE_PART] != PM_PART_NORM && e[PM_MEASURE_PART] != PM_PART_ANGLE;
    return linear && (kinds[e[PM_MEASURE_KIND]].flags &
                      (level == PM_START_POSITION ? CAN_START_POSITION : CAN_START_VELOCITY));
}

/* The measure's rate is linear in v: reading it with unit velocities gives the coefficients exactly. */
void pm_measure_start_row(pm_workspace *w, int i, int level, double *coefficient)
{
    int32_t rate[PM_MEASURE_COLUMNS];
    memcpy(rate, PM_MEASURE_ROW(w->model, i), sizeof rate);
    if (level == PM_START_POSITION)
        rate[PM_MEASURE_KIND] =
            rate[PM_MEASURE_KIND] == PM_MEASURE_ANGLE ? PM_MEASURE_OMEGA : PM_MEASURE_VELOCITY;
    const pm_measure_args x = {w, rate, rate[PM_MEASURE_A]};
    double *velocity = w->frame.velocity;
    for (int k = 0; k < w->model->nq; k++) velocity[k] = 0;
    for (int k = 0; k < w->model->nq; k++) {
        velocity[k] = 1;
        coefficient[k] = read_off(&x);
        velocity[k] = 0;
    }
    for (int k = 0; k < w->model->nq; k++) velocity[k] = w->frame.v[k];
}

/* ---- the tables of a scene ---- */
static int bad(pm_where *where, int row, double value, double bound)
{
    *where = (pm_where){PM_TABLE_MEASURE, row, PM_NONE, value, bound};
    return PM_BAD_TABLE;
}

/* Whether joints of its kind have the normal force or the friction that is to be read. */
static int joint_has(const pm_model *m, int kind, int joint)
{
    const pm_joint_ops *ops = pm_joint_of(m, joint);
    const int slides = ops->rubs != PM_NONE && ops->rubs != PM_CONSTRAINT_RATIO;
    switch (kind) {
    case PM_MEASURE_JOINT_FRICTION: return ops->presses || slides;
    case PM_MEASURE_JOINT_NORMAL:
    case PM_MEASURE_JOINT_FRICTION_NEEDED: return ops->presses;
    default: return 1;
    }
}

static int validate(const pm_model *m, int i, pm_where *where)
{
    const int32_t *e = PM_MEASURE_ROW(m, i);
    const int kind = e[PM_MEASURE_KIND], a = e[PM_MEASURE_A], part = e[PM_MEASURE_PART];
    if (kind < 0 || kind >= PM_MEASURE_KINDS) return bad(where, i, kind, PM_MEASURE_KINDS);
    const pm_measure_ops *ops = &kinds[kind];
    const int low = ops->of == PM_TABLE_BODY && kind != PM_MEASURE_POLE ? PM_GROUND : 0;
    const int all = (ops->flags & ALL_ALLOWED) && a == PM_NONE;
    if (ops->of >= 0 && !all && (a < low || a >= m->rows[ops->of])) return bad(where, i, a, m->rows[ops->of]);
    if (ops->vector && (part <= PM_PART_NONE || part >= PM_PARTS)) return bad(where, i, part, PM_PARTS);
    if (part == PM_PART_ALONG && e[PM_MEASURE_VALUE] < 0) return bad(where, i, e[PM_MEASURE_VALUE], 0);
    if (ops->of == PM_TABLE_JOINT && !joint_has(m, kind, a))
        return bad(where, i, PM_JOINT_ROW(m, a)[PM_JOINT_KIND], PM_JOINT_KINDS);
    return PM_OK;
}

static int validate_start(const pm_model *m, int i, pm_where *where)
{
    const int32_t *e = PM_START_ROW(m, i);
    const int level = e[PM_START_LEVEL];
    if (level >= PM_START_POSITION && level <= PM_START_VELOCITY &&
        pm_measure_can_start(m, e[PM_START_MEASURE], level))
        return PM_OK;
    *where = (pm_where){PM_TABLE_START, i, PM_NONE, e[PM_START_MEASURE], level};
    return PM_BAD_TABLE;
}

int pm_measure_validate(const pm_model *m, pm_where *where)
{
    int status = PM_OK;
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE] && !status; i++) status = validate(m, i, where);
    for (int i = 0; i < m->rows[PM_TABLE_START] && !status; i++) status = validate_start(m, i, where);
    return status;
}

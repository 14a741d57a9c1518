/* check_reads.c - what the programs of a scene read, by who they belong to: forces no accelerations, drives nothing but the
 * time, curves nothing but the place on them, modes only answers at an instant. */
#include "elements/force.h"
#include "elements/joint.h"
#include "elements/measure.h"
#include "expression/operation.h"
#include "expression/piecewise.h"
#include "expression/program.h"
#include "expression/program_class.h"
#include "scene/build.h"
#include "scene/reference.h"

static int is_dynamic(const pm_model *m, int measure)
{
    return pm_measure_level(m, measure) == PM_LEVEL_DYNAMIC;
}

static int needs_forces(const pm_model *m, int measure)
{
    const int32_t *e = PM_MEASURE_ROW(m, measure);
    const int kind = e[PM_MEASURE_KIND];
    const int of_force = kind == PM_MEASURE_FORCE_FORCE || kind == PM_MEASURE_FORCE_COUPLE ||
                         kind == PM_MEASURE_FORCE_POWER || kind == PM_MEASURE_FORCE_ENERGY;
    return is_dynamic(m, measure) ||
           (of_force && PM_FORCE_ROW(m, e[PM_MEASURE_A])[PM_FORCE_KIND] >= PM_FORCE_APPLIED);
}

static int is_place(const pm_model *m, int measure)
{
    return PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND] == PM_MEASURE_PLACE;
}

static int is_no_place(const pm_model *m, int measure) { return !is_place(m, measure); }

static int is_program_of(const pm_model *m, int curve, int program)
{
    const int32_t *e = PM_CURVE_ROW(m, curve);
    return e[PM_CURVE_X] == program || e[PM_CURVE_Y] == program;
}

static int is_of_curve(const pm_model *m, int program)
{
    for (int i = 0; i < m->rows[PM_TABLE_CURVE]; i++)
        if (is_program_of(m, i, program)) return 1;
    return 0;
}

static int has_knots(const pm_model *m, int table, int knots)
{
    if (knots == PM_NONE) return 0;
    const pm_piecewise a = pm_piecewise_of(m, table), b = pm_piecewise_of(m, knots);
    for (int i = 0; a.pieces == b.pieces && i <= a.pieces; i++)
        if (a.knot[i] != b.knot[i]) return 0;
    return a.pieces == b.pieces && a.beyond == PM_BEYOND_NONE && b.beyond == PM_BEYOND_NONE;
}

/* A curve reads tables with its knots alone, each at the place itself. */
static int reads_other_table(const pm_model *m, int program, int knots)
{
    int before = PM_NONE;
    for (pm_program_walk x = pm_program_walk_begin(m, program); pm_program_walk_next(&x); before = x.op) {
        if (!pm_operation_of_table(x.op)) continue;
        if (x.op != PM_OP_PIECEWISE || before != PM_OP_MEASURE || !has_knots(m, x.arg, knots)) return 1;
    }
    return 0;
}

static int check_knots(const pm_model *m, int curve, pm_where *where)
{
    const int32_t *e = PM_CURVE_ROW(m, curve);
    for (int k = PM_CURVE_X; k <= PM_CURVE_Y; k++)
        if (reads_other_table(m, e[k], e[PM_CURVE_KNOTS]))
            return pm_bad_table(where, PM_TABLE_CURVE, curve, e[k], PM_NONE);
    return PM_OK;
}

/* Programs of curves read the place on them, no other measure and no table but by its knots; no other program does. */
static int check_curves(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->rows[PM_TABLE_CURVE]; i++)
        if (PM_CURVE_ROW(m, i)[PM_CURVE_SIDE] == 0)
            return pm_bad_table(where, PM_TABLE_CURVE, i, 0, 1);
        else if (check_knots(m, i, where))
            return PM_BAD_TABLE;
    for (int i = 0; i < m->rows[PM_TABLE_PROGRAM]; i++) {
        const int measure = pm_program_walk_reads(m, i, is_of_curve(m, i) ? is_no_place : is_place);
        if (measure != PM_NONE) return pm_bad_table(where, PM_TABLE_PROGRAM, i, measure, PM_NONE);
    }
    return PM_OK;
}

/* Modes are those of an instant: what reads them answers an ask at the end or at an event, and is for nothing else. */
static int is_of_modes(const pm_model *m, int measure)
{
    const int kind = PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND];
    return kind >= PM_MEASURE_MODE_OMEGA && kind <= PM_MEASURE_MODES_GROWTH;
}

static int check_modes_of(const pm_model *m, int table, int row, pm_where *where)
{
    pm_reference of[PM_REFERENCES];
    const int n = pm_reference_of(m, table, row, of);
    for (int k = 0; k < n; k++) {
        if (of[k].of != PM_TABLE_PROGRAM || pm_program_walk_reads(m, of[k].index, is_of_modes) == PM_NONE)
            continue;
        if (table != PM_TABLE_ASK || of[k].column != PM_ASK_PROGRAM ||
            pm_model_ask_watches(PM_ASK_ROW(m, row)))
            return pm_bad_table(where, table, row, of[k].index, PM_NONE);
    }
    return PM_OK;
}

static int check_modes(const pm_model *m, pm_where *where)
{
    int status = PM_OK;
    for (int table = 0; table < PM_TABLES; table++)
        for (int i = 0; !status && i < m->rows[table]; i++) status = check_modes_of(m, table, i, where);
    return status;
}

/* A force's program may not use what must itself be computed from forces: accelerations, reactions, other programs'. */
static int check_forces(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++) {
        const int32_t *e = PM_FORCE_ROW(m, i);
        const int kind = e[PM_FORCE_KIND], option = e[PM_FORCE_OPTION];
        if (kind == PM_FORCE_FRICTION && pm_joint_of(m, e[PM_FORCE_A])->slip == PM_NONE)
            return pm_bad_table(where, PM_TABLE_FORCE, i, e[PM_FORCE_A], PM_NONE);
        if (kind == PM_FORCE_SPRING && (option < PM_SPRING_BOTH || option > PM_SPRING_PUSH))
            return pm_bad_table(where, PM_TABLE_FORCE, i, option, PM_SPRING_PUSH);
        for (int k = 0; k < pm_force_programs(e); k++) {
            const int measure = pm_program_walk_reads(m, e[PM_FORCE_PROGRAM_X + k], needs_forces);
            if (measure != PM_NONE) return pm_bad_table(where, PM_TABLE_FORCE, i, measure, PM_NONE);
        }
    }
    return PM_OK;
}

/* What an impulse is must be known before the forces and accelerations after it are. */
static int check_impulses(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++)
        for (int k = PM_ACTION_PROGRAM_X; k <= PM_ACTION_PROGRAM_Y; k++) {
            const int program = PM_ACTION_ROW(m, i)[k];
            const int measure = program < 0 ? PM_NONE : pm_program_walk_reads(m, program, is_dynamic);
            if (measure != PM_NONE) return pm_bad_table(where, PM_TABLE_ACTION, i, measure, PM_NONE);
        }
    return PM_OK;
}

static int check_drives(const pm_model *m, pm_where *where)
{
    int table = PM_NONE, row = PM_NONE, program;
    for (int k = 0; (program = pm_reference_drive(m, k, &table, &row)) != PM_NONE; k++)
        if (!pm_program_class_reads_time_alone(m, program))
            return pm_bad_table(where, table, row, program, PM_NONE);
    return PM_OK;
}

/* One turning plane, with the second moments of all bodies; its couple is no matter of accelerations. */
static int check_spin(const pm_model *m, pm_where *where)
{
    const int n = m->rows[PM_TABLE_SPIN], bodies = n > 0 ? m->rows[PM_TABLE_BODY] : 0;
    if (n > 1) return pm_bad_table(where, PM_TABLE_SPIN, 0, n, 1);
    if (m->rows[PM_TABLE_SECOND] != bodies)
        return pm_bad_table(where, PM_TABLE_SECOND, 0, m->rows[PM_TABLE_SECOND], bodies);
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++) {
        const int kind = PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND];
        if (n == 0 && kind >= PM_MEASURE_SPIN_OMEGA && kind <= PM_MEASURE_SPIN_INERTIA)
            return pm_bad_table(where, PM_TABLE_MEASURE, i, kind, 0);
    }
    const int couple = n > 0 ? pm_model_row(m, PM_TABLE_SPIN, 0, PM_SPIN_COLUMNS)[PM_SPIN_COUPLE] : PM_NONE;
    const int measure = couple < 0 ? PM_NONE : pm_program_walk_reads(m, couple, is_dynamic);
    return measure == PM_NONE ? PM_OK : pm_bad_table(where, PM_TABLE_SPIN, 0, measure, PM_NONE);
}

int pm_check_reads(const pm_model *m, pm_where *where)
{
    int status = check_forces(m, where);
    if (!status) status = check_curves(m, where);
    if (!status) status = check_modes(m, where);
    if (!status) status = check_drives(m, where);
    if (!status) status = check_spin(m, where);
    if (!status) status = check_impulses(m, where);
    return status;
}

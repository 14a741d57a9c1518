/* reference.c - which columns of the tables point into which other tables: the checks that they do, and the walk along them. */
#include "scene/reference.h"

#include "elements/force.h"
#include "elements/joint.h"
#include "elements/measure.h"
#include "expression/operation.h"

const int pm_reference_columns[PM_TABLES] = {
    [PM_TABLE_CODE] = PM_CODE_COLUMNS,       [PM_TABLE_PROGRAM] = PM_PROGRAM_COLUMNS,
    [PM_TABLE_VALUE] = PM_VALUE_COLUMNS,     [PM_TABLE_BODY] = PM_BODY_COLUMNS,
    [PM_TABLE_POINT] = PM_POINT_COLUMNS,     [PM_TABLE_LINE] = PM_LINE_COLUMNS,
    [PM_TABLE_CIRCLE] = PM_CIRCLE_COLUMNS,   [PM_TABLE_PATTERN] = PM_PATTERN_COLUMNS,
    [PM_TABLE_CURVE] = PM_CURVE_COLUMNS,     [PM_TABLE_JOINT] = PM_JOINT_COLUMNS,
    [PM_TABLE_CONTACT] = PM_CONTACT_COLUMNS, [PM_TABLE_FORCE] = PM_FORCE_COLUMNS,
    [PM_TABLE_MEASURE] = PM_MEASURE_COLUMNS, [PM_TABLE_START] = PM_START_COLUMNS,
    [PM_TABLE_TRIGGER] = PM_TRIGGER_COLUMNS, [PM_TABLE_EVENT] = PM_EVENT_COLUMNS,
    [PM_TABLE_UNTIL] = PM_UNTIL_COLUMNS,     [PM_TABLE_ASK] = PM_ASK_COLUMNS,
    [PM_TABLE_SETTING] = PM_SETTING_COLUMNS, [PM_TABLE_FIND] = PM_FIND_COLUMNS,
    [PM_TABLE_VARY] = PM_VARY_COLUMNS,       [PM_TABLE_CONDITION] = PM_CONDITION_COLUMNS,
    [PM_TABLE_SPIN] = PM_SPIN_COLUMNS,       [PM_TABLE_SECOND] = PM_SECOND_COLUMNS,
    [PM_TABLE_ACTION] = PM_ACTION_COLUMNS,   [PM_TABLE_PIECEWISE] = PM_PIECEWISE_COLUMNS,
    [PM_TABLE_READING] = PM_READING_COLUMNS,
};

/* One column of a table must lie in [low, rows of `of`), or be PM_NONE where that is allowed. */
typedef struct pm_range {
    int column, of, low, none_allowed;
} pm_range;

typedef struct pm_ranges {
    const pm_range *range;
    int count;
} pm_ranges;

#define COUNTED(...)                          \
    .range = (const pm_range[]){__VA_ARGS__}, \
    .count = (int)(sizeof((const pm_range[]){__VA_ARGS__}) / sizeof(pm_range))

/* Whatever kind a row is of. */
static const pm_ranges ranges[PM_TABLES] = {
    [PM_TABLE_VALUE] = {COUNTED({PM_VALUE_PROGRAM, PM_TABLE_PROGRAM, 0, 0})},
    [PM_TABLE_BODY] = {COUNTED({PM_BODY_MASS, PM_TABLE_VALUE, 0, 0}, {PM_BODY_INERTIA, PM_TABLE_VALUE, 0, 0},
                               {PM_BODY_X, PM_TABLE_VALUE, 0, 0}, {PM_BODY_Y, PM_TABLE_VALUE, 0, 0},
                               {PM_BODY_ANGLE, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_POINT] = {COUNTED({PM_POINT_BODY, PM_TABLE_BODY, PM_GROUND, 0},
                                {PM_POINT_X, PM_TABLE_VALUE, 0, 0}, {PM_POINT_Y, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_LINE] = {COUNTED({PM_LINE_POINT, PM_TABLE_POINT, 0, 0}, {PM_LINE_ANGLE, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_CIRCLE] = {COUNTED({PM_CIRCLE_POINT, PM_TABLE_POINT, 0, 0},
                                 {PM_CIRCLE_RADIUS, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_PATTERN] = {COUNTED(
        {PM_PATTERN_POINT, PM_TABLE_POINT, 0, 0}, {PM_PATTERN_STEP_X, PM_TABLE_VALUE, 0, 0},
        {PM_PATTERN_STEP_Y, PM_TABLE_VALUE, 0, 0}, {PM_PATTERN_COUNT, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_CURVE] = {COUNTED({PM_CURVE_POINT, PM_TABLE_POINT, 0, 0}, {PM_CURVE_X, PM_TABLE_PROGRAM, 0, 0},
                                {PM_CURVE_Y, PM_TABLE_PROGRAM, 0, 0}, {PM_CURVE_FROM, PM_TABLE_VALUE, 0, 0},
                                {PM_CURVE_TO, PM_TABLE_VALUE, 0, 0},
                                {PM_CURVE_KNOTS, PM_TABLE_PIECEWISE, 0, 1})},
    [PM_TABLE_CONTACT] = {COUNTED(
        {PM_CONTACT_SIDE, PM_TABLE_VALUE, 0, 1}, {PM_CONTACT_RESTITUTION, PM_TABLE_VALUE, 0, 0},
        {PM_CONTACT_STATIC, PM_TABLE_VALUE, 0, 1}, {PM_CONTACT_KINETIC, PM_TABLE_VALUE, 0, 1},
        {PM_CONTACT_SPEED, PM_TABLE_PROGRAM, 0, 1}, {PM_CONTACT_SLACK, PM_TABLE_VALUE, 0, 1},
        {PM_CONTACT_TANGENTIAL, PM_TABLE_VALUE, 0, 1}, {PM_CONTACT_STIFFNESS, PM_TABLE_VALUE, 0, 1},
        {PM_CONTACT_PRESSURE, PM_TABLE_VALUE, 0, 1}, {PM_CONTACT_TURNS, PM_TABLE_VALUE, 0, 1},
        {PM_CONTACT_LEVER, PM_TABLE_VALUE, 0, 1}, {PM_CONTACT_FROM, PM_TABLE_VALUE, 0, 1},
        {PM_CONTACT_TO, PM_TABLE_VALUE, 0, 1})},
    [PM_TABLE_JOINT] = {COUNTED({PM_JOINT_PROGRAM_X, PM_TABLE_PROGRAM, 0, 1},
                                {PM_JOINT_PROGRAM_Y, PM_TABLE_PROGRAM, 0, 1},
                                {PM_JOINT_VALUE_2, PM_TABLE_VALUE, 0, 1})},
    [PM_TABLE_MEASURE] = {COUNTED(
        {PM_MEASURE_IN, PM_TABLE_BODY, PM_GROUND, 1}, {PM_MEASURE_ON, PM_TABLE_BODY, PM_GROUND, 1},
        {PM_MEASURE_ABOUT, PM_TABLE_POINT, 0, 1}, {PM_MEASURE_VALUE, PM_TABLE_VALUE, 0, 1})},
    [PM_TABLE_START] = {COUNTED({PM_START_MEASURE, PM_TABLE_MEASURE, 0, 0},
                                {PM_START_VALUE, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_TRIGGER] = {COUNTED({PM_TRIGGER_EVENT, PM_TABLE_EVENT, 0, 0},
                                  {PM_TRIGGER_PROGRAM, PM_TABLE_PROGRAM, 0, 1})},
    [PM_TABLE_UNTIL] = {COUNTED({PM_UNTIL_EVENT, PM_TABLE_EVENT, 0, 0})},
    [PM_TABLE_ASK] = {COUNTED(
        {PM_ASK_PROGRAM, PM_TABLE_PROGRAM, 0, 0}, {PM_ASK_EVENT_INDEX, PM_TABLE_EVENT, 0, 1},
        {PM_ASK_PROGRAM_2, PM_TABLE_PROGRAM, 0, 1}, {PM_ASK_FIRST_VALUE, PM_TABLE_VALUE, 0, 1})},
    [PM_TABLE_SETTING] = {COUNTED(
        {PM_SETTING_GRAVITY_X, PM_TABLE_VALUE, 0, 0}, {PM_SETTING_GRAVITY_Y, PM_TABLE_VALUE, 0, 0},
        {PM_SETTING_ACCURACY, PM_TABLE_VALUE, 0, 0}, {PM_SETTING_MAX_TIME, PM_TABLE_VALUE, 0, 1},
        {PM_SETTING_ASSEMBLY, PM_TABLE_VALUE, 0, 0}, {PM_SETTING_MAX_CPU, PM_TABLE_VALUE, 0, 1},
        {PM_SETTING_EXPONENT, PM_TABLE_VALUE, 0, 0}, {PM_SETTING_NUDGE, PM_TABLE_PROGRAM, 0, 1})},
    [PM_TABLE_FIND] = {COUNTED({PM_FIND_PROGRAM, PM_TABLE_PROGRAM, 0, 1})},
    [PM_TABLE_VARY] = {COUNTED({PM_VARY_LOW, PM_TABLE_VALUE, 0, 0}, {PM_VARY_HIGH, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_CONDITION] = {COUNTED({PM_CONDITION_PROGRAM, PM_TABLE_PROGRAM, 0, 0})},
    [PM_TABLE_SPIN] = {COUNTED({PM_SPIN_X, PM_TABLE_VALUE, 0, 0}, {PM_SPIN_Y, PM_TABLE_VALUE, 0, 0},
                               {PM_SPIN_ANGLE, PM_TABLE_VALUE, 0, 0}, {PM_SPIN_INERTIA, PM_TABLE_VALUE, 0, 0},
                               {PM_SPIN_OMEGA, PM_TABLE_VALUE, 0, 0},
                               {PM_SPIN_COUPLE, PM_TABLE_PROGRAM, 0, 1})},
    [PM_TABLE_SECOND] = {COUNTED({PM_SECOND_X, PM_TABLE_VALUE, 0, 0}, {PM_SECOND_Y, PM_TABLE_VALUE, 0, 0},
                                 {PM_SECOND_Z, PM_TABLE_VALUE, 0, 0})},
    [PM_TABLE_ACTION] = {COUNTED({PM_ACTION_EVENT, PM_TABLE_EVENT, 0, 1},
                                 {PM_ACTION_PROGRAM_X, PM_TABLE_PROGRAM, 0, 1},
                                 {PM_ACTION_PROGRAM_Y, PM_TABLE_PROGRAM, 0, 1})},
    [PM_TABLE_READING] = {COUNTED({PM_READING_EVENT, PM_TABLE_EVENT, 0, 0},
                                  {PM_READING_TABLE, PM_TABLE_PIECEWISE, 0, 0},
                                  {PM_READING_PROGRAM, PM_TABLE_PROGRAM, 0, 0})},
};
#undef COUNTED

/* The tables of its partners, by kind. */
static const int contact_partner[PM_CONTACT_KINDS][2] = {
    [PM_CONTACT_LINE] = {PM_TABLE_CIRCLE, PM_TABLE_LINE},
    [PM_CONTACT_CIRCLE] = {PM_TABLE_CIRCLE, PM_TABLE_CIRCLE},
    [PM_CONTACT_PATTERN] = {PM_TABLE_CIRCLE, PM_TABLE_PATTERN},
    [PM_CONTACT_CORD] = {PM_TABLE_CIRCLE, PM_TABLE_CIRCLE},
    [PM_CONTACT_POINT] = {PM_TABLE_CIRCLE, PM_TABLE_CIRCLE},
    [PM_CONTACT_SEGMENT] = {PM_TABLE_CIRCLE, PM_TABLE_LINE},
    [PM_CONTACT_TEETH] = {PM_TABLE_CIRCLE, PM_TABLE_CIRCLE},
    [PM_CONTACT_RACK] = {PM_TABLE_CIRCLE, PM_TABLE_LINE},
    [PM_CONTACT_CURVE] = {PM_TABLE_CIRCLE, PM_TABLE_CURVE},
    [PM_CONTACT_CURVES] = {PM_TABLE_CURVE, PM_TABLE_CURVE},
};

int pm_reference_in_range(const pm_model *m, int of, int index)
{
    return index >= (of == PM_TABLE_BODY ? PM_GROUND : 0) && index < m->rows[of];
}

static int check_ranges(const pm_model *m, int table, pm_where *where)
{
    for (int i = 0; i < m->rows[table]; i++) {
        const int32_t *e = pm_model_row(m, table, i, pm_reference_columns[table]);
        for (int k = 0; k < ranges[table].count; k++) {
            const pm_range *x = &ranges[table].range[k];
            const int index = e[x->column];
            if (index == PM_NONE && x->none_allowed) continue;
            if (index < x->low || index >= m->rows[x->of])
                return pm_bad_table(where, table, i, index, m->rows[x->of]);
        }
    }
    return PM_OK;
}

/* ---- joints, contacts and forces: their kind and partners stand in the same columns ---- */
static int partners(int a, int b, pm_reference *out)
{
    out[0] = (pm_reference){.column = PM_JOINT_A, .of = a};
    out[1] = (pm_reference){.column = PM_JOINT_B, .of = b};
    return 2;
}

static int of_joint(const int32_t *e, pm_reference *out)
{
    const pm_joint_ops *ops = pm_joint_kind(e[PM_JOINT_KIND]);
    int n = partners(ops->a, ops->b, out);
    if (ops->number) out[n++] = (pm_reference){.column = PM_JOINT_VALUE, .of = PM_TABLE_VALUE};
    if (ops->flanks || ops->strands)
        out[n++] = (pm_reference){.column = PM_JOINT_VALUE_2, .of = PM_TABLE_VALUE};
    for (int k = 0; k < ops->programs; k++)
        out[n++] = (pm_reference){.column = PM_JOINT_PROGRAM_X + k, .of = PM_TABLE_PROGRAM};
    return n;
}

static int of_contact(const int32_t *e, pm_reference *out)
{
    const int *of = contact_partner[e[PM_CONTACT_KIND]];
    const int n = partners(of[0], of[1], out);
    if (e[PM_CONTACT_RIM] == PM_NONE) return n;
    out[n] = (pm_reference){.column = PM_CONTACT_RIM, .of = PM_TABLE_CIRCLE};
    return n + 1;
}

static int of_force(const int32_t *e, pm_reference *out)
{
    const pm_force_ops *ops = pm_force_kind(e[PM_FORCE_KIND]);
    int n = partners(ops->a, ops->b, out);
    for (int k = 0; k < 2 && ops->number[k]; k++)
        out[n++] = (pm_reference){.column = PM_FORCE_VALUE_1 + k, .of = PM_TABLE_VALUE};
    for (int k = 0; k < pm_force_programs(e); k++)
        out[n++] = (pm_reference){.column = PM_FORCE_PROGRAM_X + k, .of = PM_TABLE_PROGRAM};
    return n;
}

typedef int pm_refers(const int32_t *e, pm_reference *out);

static int check_elements(const pm_model *m, int table, int kinds, pm_refers *refers, pm_where *where)
{
    for (int i = 0; i < m->rows[table]; i++) {
        const int32_t *e = pm_model_row(m, table, i, pm_reference_columns[table]);
        if (e[PM_JOINT_KIND] < 0 || e[PM_JOINT_KIND] >= kinds)
            return pm_bad_table(where, table, i, e[PM_JOINT_KIND], kinds);
        pm_reference ref[PM_REFERENCES];
        const int n = refers(e, ref);
        for (int k = 0; k < n; k++)
            if (!pm_reference_in_range(m, ref[k].of, e[ref[k].column]))
                return pm_bad_table(where, table, i, e[ref[k].column], m->rows[ref[k].of]);
    }
    return PM_OK;
}

int pm_reference_check(const pm_model *m, pm_where *where)
{
    int status = PM_OK;
    for (int table = 0; !status && table < PM_TABLES; table++) status = check_ranges(m, table, where);
    if (!status) status = check_elements(m, PM_TABLE_JOINT, PM_JOINT_KINDS, of_joint, where);
    if (!status) status = check_elements(m, PM_TABLE_CONTACT, PM_CONTACT_KINDS, of_contact, where);
    if (!status) status = check_elements(m, PM_TABLE_FORCE, PM_FORCE_KINDS, of_force, where);
    return status;
}

/* ---- what a kind decides elsewhere ---- */
static int of_code(const int32_t *e, pm_reference *out)
{
    const int op = e[PM_CODE_OP];
    if (op == PM_OP_VALUE) *out = (pm_reference){.column = PM_CODE_ARG, .of = PM_TABLE_VALUE};
    if (op == PM_OP_MEASURE) *out = (pm_reference){.column = PM_CODE_ARG, .of = PM_TABLE_MEASURE};
    if (pm_operation_of_table(op)) *out = (pm_reference){.column = PM_CODE_ARG, .of = PM_TABLE_PIECEWISE};
    return op == PM_OP_VALUE || op == PM_OP_MEASURE || pm_operation_of_table(op);
}

static int of_measure(const int32_t *e, pm_reference *out)
{
    const int of = pm_measure_kind(e[PM_MEASURE_KIND])->of;
    *out = (pm_reference){.column = PM_MEASURE_A, .of = of};
    return of >= 0;
}

static int of_trigger(const int32_t *e, pm_reference *out)
{
    const int kind = e[PM_TRIGGER_KIND], rest = kind == PM_TRIGGER_REST,
              joint = kind >= PM_TRIGGER_JOINT_SLIP;
    *out = (pm_reference){.column = PM_TRIGGER_A,
                          .of = rest    ? PM_TABLE_BODY
                                : joint ? PM_TABLE_JOINT
                                        : PM_TABLE_CONTACT};
    return rest || joint || (kind >= PM_TRIGGER_STRIKE && kind <= PM_TRIGGER_STICK);
}

static int of_action(const int32_t *e, pm_reference *out)
{
    const int kind = e[PM_ACTION_KIND];
    *out = (pm_reference){.column = PM_ACTION_A,
                          .of = kind <= PM_ACTION_REMOVE    ? e[PM_ACTION_TABLE]
                                : kind == PM_ACTION_IMPULSE ? PM_TABLE_POINT
                                                            : PM_TABLE_BODY};
    return 1;
}

static int by_kind(int table, const int32_t *e, pm_reference *out)
{
    switch (table) {
    case PM_TABLE_JOINT: return of_joint(e, out);
    case PM_TABLE_CONTACT: return of_contact(e, out);
    case PM_TABLE_FORCE: return of_force(e, out);
    case PM_TABLE_CODE: return of_code(e, out);
    case PM_TABLE_MEASURE: return of_measure(e, out);
    case PM_TABLE_TRIGGER: return of_trigger(e, out);
    case PM_TABLE_ACTION: return of_action(e, out);
    default: return 0;
    }
}

int pm_reference_of(const pm_model *m, int table, int row, pm_reference out[PM_REFERENCES])
{
    const int32_t *e = pm_model_row(m, table, row, pm_reference_columns[table]);
    pm_reference all[PM_REFERENCES];
    int most = by_kind(table, e, all), n = 0;
    for (int k = 0; k < ranges[table].count; k++)
        all[most++] =
            (pm_reference){.column = ranges[table].range[k].column, .of = ranges[table].range[k].of};
    for (int i = 0; i < most; i++) {
        all[i].index = e[all[i].column];
        if (all[i].index >= 0 && all[i].index < m->rows[all[i].of]) out[n++] = all[i];
    }
    return n;
}

int pm_reference_bodies(const pm_model *m, int table, int row, int body[PM_REFERENCES])
{
    pm_reference ref[PM_REFERENCES];
    int found = 0;
    const int n = pm_reference_of(m, table, row, ref);
    for (int k = 0; k < n; k++)
        if (ref[k].of >= PM_TABLE_BODY && ref[k].of <= PM_TABLE_CURVE)
            body[found++] = pm_model_body_of(m, ref[k].of, ref[k].index);
    return found;
}

/* ---- drives ---- */
int pm_reference_drive(const pm_model *m, int k, int *table, int *row)
{
    static const int of[2] = {PM_TABLE_JOINT, PM_TABLE_CONTACT};
    static const int first[2] = {PM_JOINT_PROGRAM_X, PM_CONTACT_SPEED},
                     last[2] = {PM_JOINT_PROGRAM_Y, PM_CONTACT_SPEED}; /* columns */
    for (int t = 0; t < 2; t++)
        for (int i = 0; i < m->rows[of[t]]; i++)
            for (int c = first[t]; c <= last[t]; c++) {
                const int program = pm_model_row(m, of[t], i, pm_reference_columns[of[t]])[c];
                if (program < 0 || k-- > 0) continue;
                *table = of[t];
                *row = i;
                return program;
            }
    return PM_NONE;
}

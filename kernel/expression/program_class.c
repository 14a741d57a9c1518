/* program_class.c - abstract interpretation of programs: each stack entry carries its nature instead of a number. */
#include "expression/program_class.h"

#include "expression/program.h"

const int32_t *pm_program_code(const pm_model *m, int program, int *length)
{
    const int32_t *p = pm_table_row(m, PM_TABLE_PROGRAM, program, PM_PROGRAM_COLUMNS);
    *length = p[PM_PROGRAM_LENGTH];
    return pm_table_row(m, PM_TABLE_CODE, p[PM_PROGRAM_FIRST], PM_CODE_COLUMNS);
}

static int measure_nature(const pm_model *m, int measure)
{
    switch ((enum pm_measure_kind)PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND]) {
    case PM_MEASURE_TIME: return PM_CLASS_TIME;
    case PM_MEASURE_MASS:
    case PM_MEASURE_WEIGHT: return PM_CLASS_CONSTANT;
    case PM_MEASURE_ANGLE:
    case PM_MEASURE_TURNED:
    case PM_MEASURE_INERTIA:
    case PM_MEASURE_POSITION:
    case PM_MEASURE_MOVED:
    case PM_MEASURE_CONTACT_GAP:
    case PM_MEASURE_FORCE_STRETCH:
    case PM_MEASURE_FORCE_ENERGY:
    case PM_MEASURE_POTENTIAL:
    case PM_MEASURE_SPIN_INERTIA: return PM_CLASS_PLACE;
    case PM_MEASURE_SPIN_OMEGA:
    case PM_MEASURE_SPIN_MOMENTUM: return m->spin_z == PM_NONE ? PM_CLASS_PLACE : PM_CLASS_MOTION;
    default: return PM_CLASS_MOTION;
    }
}

/* Time stays linear under sums, and products and quotients with constants; places may be combined at will. */
static int combine(int op, int a, int b)
{
    if (a == PM_CLASS_MOTION || b == PM_CLASS_MOTION) return PM_CLASS_MOTION;
    if (a != PM_CLASS_TIME && b != PM_CLASS_TIME) return a > b ? a : b;
    if (a == PM_CLASS_PLACE || b == PM_CLASS_PLACE) return PM_CLASS_MOTION;
    const int linear = op == PM_OP_ADD || op == PM_OP_SUB || (op == PM_OP_MUL && a != b) ||
                       (op == PM_OP_DIV && b == PM_CLASS_CONSTANT);
    return linear ? PM_CLASS_TIME : PM_CLASS_MOTION;
}

static int alone(int op, int a)
{
    if (a != PM_CLASS_TIME || op == PM_OP_NEG) return a;
    return PM_CLASS_MOTION;
}

int pm_program_class_of(const pm_model *m, int program)
{
    int stack[PM_STACK], top = -1, length;
    const int32_t *code = pm_program_code(m, program, &length);
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS) {
        const int op = code[PM_CODE_OP];
        if (op <= PM_OP_VALUE) {
            stack[++top] = PM_CLASS_CONSTANT;
        } else if (op == PM_OP_MEASURE) {
            stack[++top] = measure_nature(m, code[PM_CODE_ARG]);
        } else if (op == PM_OP_ANSWER) {
            stack[++top] = PM_CLASS_MOTION;
        } else if (op == PM_OP_SELECT) {
            top -= 2;
            const int c = combine(op, stack[top], stack[top + 1]);
            stack[top] = combine(op, c, stack[top + 2]);
        } else if (pm_program_operands(op) == 1) {
            stack[top] = alone(op, stack[top]);
        } else {
            top--;
            stack[top] = combine(op, stack[top], stack[top + 1]);
        }
    }
    return stack[0];
}

static int reads(const pm_model *m, int program, int kind_a, int kind_b)
{
    int length;
    const int32_t *code = pm_program_code(m, program, &length);
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS) {
        if (code[PM_CODE_OP] != PM_OP_MEASURE) continue;
        const int kind = PM_MEASURE_ROW(m, code[PM_CODE_ARG])[PM_MEASURE_KIND];
        if (kind == kind_a || kind == kind_b) return 1;
    }
    return 0;
}

int pm_program_class_reads_time(const pm_model *m, int program)
{
    return reads(m, program, PM_MEASURE_TIME, PM_MEASURE_EVENT_TIME);
}

int pm_program_class_reads_counts(const pm_model *m, int program)
{
    return reads(m, program, PM_MEASURE_EVENT_COUNT, PM_MEASURE_EVENT_TIME);
}

/* What enters a value: nothing but constants, something that counts or decides, something continuous. */
enum pm_grain { GRAIN_CONSTANT = 0, GRAIN_DISCRETE = 1, GRAIN_CONTINUOUS = 2 };

/* What leaves an operation, from the greatest of its operands. */
static int grain_after(int op, int operand)
{
    switch (op) {
    case PM_OP_LT:
    case PM_OP_LE:
    case PM_OP_GT:
    case PM_OP_GE:
    case PM_OP_EQ:
    case PM_OP_NE:
    case PM_OP_AND:
    case PM_OP_OR:
    case PM_OP_NOT:
    case PM_OP_FLOOR: return operand == GRAIN_CONSTANT ? GRAIN_CONSTANT : GRAIN_DISCRETE;
    default: return operand;
    }
}

static int reads_sought(const pm_model *m, int program);

/* A parameter that is sought changes by and by, and so do values that depend on it. */
static int is_sought(const pm_model *m, int op, int arg)
{
    if (op == PM_OP_VALUE)
        return reads_sought(m, m->table[PM_TABLE_VALUE][arg * PM_VALUE_COLUMNS + PM_VALUE_PROGRAM]);
    for (int i = 0; op == PM_OP_PARAMETER && i < m->rows[PM_TABLE_VARY]; i++)
        if (PM_VARY_ROW(m, i)[PM_VARY_PARAMETER] == arg) return 1;
    return 0;
}

static int reads_sought(const pm_model *m, int program)
{
    int length;
    const int32_t *code = pm_program_code(m, program, &length);
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS)
        if (is_sought(m, code[PM_CODE_OP], code[PM_CODE_ARG])) return 1;
    return 0;
}

int pm_program_class_is_discrete(const pm_model *m, int program)
{
    int stack[PM_STACK], top = -1, length;
    const int32_t *code = pm_program_code(m, program, &length);
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS) {
        const int op = code[PM_CODE_OP];
        int grain = is_sought(m, op, code[PM_CODE_ARG]) ? GRAIN_CONTINUOUS : GRAIN_CONSTANT;
        for (int k = pm_program_operands(op); k > 0; k--, top--)
            grain = stack[top] > grain ? stack[top] : grain;
        if (op == PM_OP_MEASURE) {
            const int kind = PM_MEASURE_ROW(m, code[PM_CODE_ARG])[PM_MEASURE_KIND];
            grain = kind == PM_MEASURE_EVENT_COUNT ? GRAIN_DISCRETE : GRAIN_CONTINUOUS;
        }
        stack[++top] = grain_after(op, grain);
    }
    return stack[0] == GRAIN_DISCRETE;
}

/* program.c - postfix evaluator on doubles.  A comparison with a not-a-number is false; arithmetic keeps it. */
#include "expression/program.h"

#include <math.h>

#include "expression/program_fold.h"
#include "state/workspace.h"

int pm_program_operands(int op)
{
    switch ((enum pm_op)op) {
    case PM_OP_CONSTANT:
    case PM_OP_PARAMETER:
    case PM_OP_VALUE:
    case PM_OP_MEASURE:
    case PM_OP_ANSWER: return 0;
    case PM_OP_NEG:
    case PM_OP_NOT:
    case PM_OP_SIN:
    case PM_OP_COS:
    case PM_OP_TAN:
    case PM_OP_ASIN:
    case PM_OP_ACOS:
    case PM_OP_ATAN:
    case PM_OP_SQRT:
    case PM_OP_ABS:
    case PM_OP_EXP:
    case PM_OP_LOG:
    case PM_OP_FLOOR: return 1;
    case PM_OP_ADD:
    case PM_OP_SUB:
    case PM_OP_MUL:
    case PM_OP_DIV:
    case PM_OP_POW:
    case PM_OP_LT:
    case PM_OP_LE:
    case PM_OP_GT:
    case PM_OP_GE:
    case PM_OP_EQ:
    case PM_OP_NE:
    case PM_OP_AND:
    case PM_OP_OR:
    case PM_OP_ATAN2:
    case PM_OP_MIN:
    case PM_OP_MAX:
    case PM_OP_HYPOT: return 2;
    case PM_OP_SELECT: return 3;
    case PM_OPS: break;
    }
    return -1;
}

double pm_program_unary(int op, double a)
{
    switch (op) {
    case PM_OP_NEG: return -a;
    case PM_OP_NOT: return a == 0;
    case PM_OP_SIN: return sin(a);
    case PM_OP_COS: return cos(a);
    case PM_OP_TAN: return tan(a);
    case PM_OP_ASIN: return asin(a);
    case PM_OP_ACOS: return acos(a);
    case PM_OP_ATAN: return atan(a);
    case PM_OP_SQRT: return sqrt(a);
    case PM_OP_ABS: return fabs(a);
    case PM_OP_EXP: return exp(a);
    case PM_OP_LOG: return log(a);
    default: return floor(a);
    }
}

/* fmin and fmax would drop a not-a-number: here it must stay visible. */
static double lesser(double a, double b) { return isnan(a) || a < b ? a : b; }
static double greater(double a, double b) { return isnan(a) || a > b ? a : b; }

static double other_binary(int op, double a, double b)
{
    switch (op) {
    case PM_OP_POW: return pow(a, b);
    case PM_OP_LT: return a < b;
    case PM_OP_LE: return a <= b;
    case PM_OP_GT: return a > b;
    case PM_OP_GE: return a >= b;
    case PM_OP_EQ: return a == b;
    case PM_OP_NE: return a != b;
    case PM_OP_AND: return a != 0 && b != 0;
    case PM_OP_OR: return a != 0 || b != 0;
    case PM_OP_ATAN2: return atan2(a, b);
    case PM_OP_MIN: return lesser(a, b);
    case PM_OP_MAX: return greater(a, b);
    default: return hypot(a, b);
    }
}

/* The most frequent ones without a call. */
static inline double binary(int op, double a, double b)
{
    switch (op) {
    case PM_OP_ADD: return a + b;
    case PM_OP_SUB: return a - b;
    case PM_OP_MUL: return a * b;
    case PM_OP_DIV: return a / b;
    default: return other_binary(op, a, b);
    }
}

double pm_program_binary(int op, double a, double b) { return binary(op, a, b); }

int pm_program_takes_size(const pm_model *m, int measure)
{
    const int kind = PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND];
    return kind == PM_MEASURE_JOINT_FRICTION_NEEDED || kind == PM_MEASURE_CONTACT_FRICTION_NEEDED;
}

static double measured(pm_workspace *w, int measure)
{
    const double value = w->read_measure(w, measure);
    return pm_program_takes_size(w->model, measure) ? fabs(value) : value;
}

/* Instructions as they stand in the table; w NULL: they read no measure and no answer. */
static double run_code(const pm_model *m, const int32_t *code, int length, const double *param,
                       const double *value, pm_workspace *w)
{
    double stack[PM_STACK];
    int top = -1;
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS) {
        const int op = code[PM_CODE_OP], arg = code[PM_CODE_ARG];
        switch (op) {
        case PM_OP_CONSTANT: stack[++top] = m->constant[arg]; break;
        case PM_OP_PARAMETER: stack[++top] = param[arg]; break;
        case PM_OP_VALUE: stack[++top] = value[arg]; break;
        case PM_OP_MEASURE: stack[++top] = measured(w, arg); break;
        case PM_OP_ANSWER: stack[++top] = w->result.out[arg]; break;
        case PM_OP_SELECT:
            top -= 2;
            stack[top] = stack[top] != 0 ? stack[top + 1] : stack[top + 2];
            break;
        default:
            if (pm_program_operands(op) == 1) {
                stack[top] = pm_program_unary(op, stack[top]);
            } else {
                top--;
                stack[top] = pm_program_binary(op, stack[top], stack[top + 1]);
            }
        }
    }
    return stack[0];
}

/* What is left of a program once the numbers of the case are known. */
static double run_steps(pm_workspace *w, const pm_program_step *s, const pm_program_step *end)
{
    const double *number = w->numbers.folded;
    double stack[PM_STACK + 1], *top = stack;
    stack[0] = NAN; /* it stays empty */
    for (; s < end; s++) switch (s->kind) {
        case STEP_NUMBER: *++top = number[s->arg]; break;
        case STEP_MEASURE: *++top = w->read_measure(w, s->arg); break;
        case STEP_ANSWER: *++top = w->result.out[s->arg]; break;
        case STEP_UNARY: *top = pm_program_unary(s->op, *top); break;
        case STEP_WITH_NUMBER: *top = binary(s->op, *top, number[s->arg]); break;
        case STEP_BINARY:
            top--;
            *top = binary(s->op, top[0], top[1]);
            break;
        default: top -= 2; *top = top[0] != 0 ? top[1] : top[2];
        }
    return *top;
}

static double run_program(const pm_model *m, int index, const double *param, const double *value,
                          pm_workspace *w)
{
    const int32_t *program = pm_table_row(m, PM_TABLE_PROGRAM, index, PM_PROGRAM_COLUMNS);
    return run_code(m, pm_table_row(m, PM_TABLE_CODE, program[PM_PROGRAM_FIRST], PM_CODE_COLUMNS),
                    program[PM_PROGRAM_LENGTH], param, value, w);
}

double pm_program_run(pm_workspace *w, int index)
{
    const pm_program_fold *f = w->model->programs.fold;
    const int first = f->first[index], end = f->first[index + 1];
    if (w->numbers.is_folded && first < end) return run_steps(w, f->step + first, f->step + end);
    return run_program(w->model, index, w->numbers.param, w->numbers.value, w);
}

double pm_program_value(const pm_model *m, int index, const double *param, const double *value)
{
    return run_program(m, index, param, value, NULL);
}

void pm_program_numbers(pm_workspace *w)
{
    const pm_model *m = w->model;
    for (int i = 0; i < m->programs.fold->nnumber; i++) {
        const pm_program_part *x = &m->programs.fold->part[i];
        w->numbers.folded[i] = run_code(m, pm_table_row(m, PM_TABLE_CODE, x->first, PM_CODE_COLUMNS),
                                        x->length, w->numbers.param, w->numbers.value, w);
    }
    w->numbers.is_folded = 1;
}

static int bad(pm_where *where, int row, double value, double bound)
{
    *where = (pm_where){PM_TABLE_PROGRAM, row, PM_NONE, value, bound};
    return PM_BAD_TABLE;
}

/* Answers may be read only when a run has ended. */
static int is_of_find(const pm_model *m, int program)
{
    for (int i = 0; i < m->rows[PM_TABLE_FIND]; i++)
        if (PM_FIND_ROW(m, i)[PM_FIND_PROGRAM] == program) return 1;
    for (int i = 0; i < m->rows[PM_TABLE_CONDITION]; i++)
        if (PM_CONDITION_ROW(m, i)[PM_CONDITION_PROGRAM] == program) return 1;
    return 0;
}

static int validate_one(const pm_model *m, int index, int first_value_allowed, pm_where *where)
{
    const int32_t *program = pm_table_row(m, PM_TABLE_PROGRAM, index, PM_PROGRAM_COLUMNS);
    const int first = program[PM_PROGRAM_FIRST], length = program[PM_PROGRAM_LENGTH];
    if (first < 0 || length < 1 || (int64_t)first + length > m->rows[PM_TABLE_CODE])
        return bad(where, index, first, m->rows[PM_TABLE_CODE]);
    const int32_t *code = pm_table_row(m, PM_TABLE_CODE, first, PM_CODE_COLUMNS);
    const int is_value = first_value_allowed < m->nvalue;
    const int limit[PM_OPS] = {
        [PM_OP_CONSTANT] = m->nconstant,
        [PM_OP_PARAMETER] = m->nparam,
        [PM_OP_VALUE] = first_value_allowed,
        [PM_OP_MEASURE] = is_value ? 0 : m->rows[PM_TABLE_MEASURE],
        [PM_OP_ANSWER] = !is_value && is_of_find(m, index) ? m->nout : 0,
    };
    int depth = 0;
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS) {
        const int op = code[PM_CODE_OP], arg = code[PM_CODE_ARG], takes = pm_program_operands(op);
        if (takes < 0) return bad(where, index, op, PM_OPS);
        if (takes == 0 && (arg < 0 || arg >= limit[op])) return bad(where, index, arg, limit[op]);
        if (depth < takes) return bad(where, index, depth, takes);
        depth += 1 - takes;
        if (depth > PM_STACK) return bad(where, index, depth, PM_STACK);
    }
    return depth == 1 ? PM_OK : bad(where, index, depth, 1);
}

int pm_program_validate(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->nvalue; i++) {
        const int index = m->table[PM_TABLE_VALUE][i * PM_VALUE_COLUMNS + PM_VALUE_PROGRAM];
        const int status = validate_one(m, index, i, where); /* only values of lower index */
        if (status) return status;
    }
    for (int i = 0; i < m->rows[PM_TABLE_PROGRAM]; i++) {
        const int status = validate_one(m, i, m->nvalue, where);
        if (status) return status;
    }
    return PM_OK;
}

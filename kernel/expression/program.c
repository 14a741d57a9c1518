/* program.c - the value of a program, and the check of its code. */
#include "expression/program.h"

#include <math.h>

#include "expression/operation.h"
#include "expression/piecewise.h"
#include "expression/program_fold.h"
#include "state/workspace.h"

/* The most frequent ones without a call. */
static inline double binary(int op, double a, double b)
{
    switch (op) {
    case PM_OP_ADD: return a + b;
    case PM_OP_SUB: return a - b;
    case PM_OP_MUL: return a * b;
    case PM_OP_DIV: return a / b;
    default: return pm_operations[op].two(a, b);
    }
}

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

/* What an instruction pushes; w NULL: programs of values read no measure and no answer. */
static inline double pushed(const pm_program_walk *x, const double *param, const double *value,
                            pm_workspace *w)
{
    if (x->op <= PM_OP_VALUE) return pm_program_number(x, param, value);
    return x->op == PM_OP_MEASURE ? measured(w, x->arg) : w->result.out[x->arg];
}

enum { OF_TABLE = -1 }; /* beside how many operands an operation takes */

/* The operation of an instruction that takes operands, on a[0], a[1] .. */
static inline double operated(const pm_program_walk *x, const double *a)
{
    switch (pm_operation_of_table(x->op) ? OF_TABLE : x->takes) {
    case 1: return pm_operations[x->op].one(*a);
    case 2: return binary(x->op, a[0], a[1]);
    case OF_TABLE: return pm_piecewise_operation(x->m, x->op, x->arg, a);
    default: return a[0] != 0 ? a[1] : a[2];
    }
}

/* Instructions as they stand in the table. */
static double run_code(pm_program_walk x, const double *param, const double *value, pm_workspace *w)
{
    double stack[PM_STACK];
    stack[0] = stack[1] = stack[2] = NAN; /* no valid code reads them before they are pushed */
    while (pm_program_walk_next(&x)) {
        double *a = stack + x.at;
        *a = x.takes == 0 ? pushed(&x, param, value, w) : operated(&x, a);
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
        case STEP_UNARY: *top = pm_operations[s->op].one(*top); break;
        case STEP_WITH_NUMBER: *top = binary(s->op, *top, number[s->arg]); break;
        case STEP_BINARY:
            top--;
            *top = binary(s->op, top[0], top[1]);
            break;
        case STEP_TABLE:
            top -= pm_operations[s->op].takes - 1;
            *top = pm_piecewise_operation(w->model, s->op, s->arg, top);
            break;
        default: top -= 2; *top = top[0] != 0 ? top[1] : top[2];
        }
    return *top;
}

double pm_program_run(pm_workspace *w, int index)
{
    const pm_program_fold *f = w->model->programs.fold;
    const int first = f->first[index], end = f->first[index + 1];
    if (w->numbers.is_folded && first < end) return run_steps(w, f->step + first, f->step + end);
    return run_code(pm_program_walk_begin(w->model, index), w->numbers.param, w->numbers.value, w);
}

int pm_program_outside(pm_workspace *w, int index, double *x)
{
    double stack[PM_STACK];
    stack[0] = stack[1] = stack[2] = NAN;
    for (pm_program_walk k = pm_program_walk_begin(w->model, index); pm_program_walk_next(&k);) {
        double *a = stack + k.at;
        *x = a[0];
        if (k.takes == 0) *a = pushed(&k, w->numbers.param, w->numbers.value, w);
        if (k.takes > 0) *a = operated(&k, a);
        if (pm_operation_of_table(k.op) && isfinite(*x) && isnan(*a)) return k.arg;
    }
    return PM_NONE;
}

double pm_program_value(const pm_model *m, int index, const double *param, const double *value)
{
    return run_code(pm_program_walk_begin(m, index), param, value, NULL);
}

void pm_program_fold_number(pm_workspace *w, int i)
{
    const pm_program_part *x = &w->model->programs.fold->part[i];
    w->numbers.folded[i] =
        run_code(pm_program_walk_part(w->model, x->first, x->length), w->numbers.param, w->numbers.value, w);
}

static int is_of_find(const pm_model *m, int program)
{
    for (int i = 0; i < m->rows[PM_TABLE_FIND]; i++)
        if (PM_FIND_ROW(m, i)[PM_FIND_PROGRAM] == program) return 1;
    for (int i = 0; i < m->rows[PM_TABLE_CONDITION]; i++)
        if (PM_CONDITION_ROW(m, i)[PM_CONDITION_PROGRAM] == program) return 1;
    return 0;
}

/* How many answers are there when the program is run: none before a run has ended, all of them for a find. */
static int answered_before(const pm_model *m, int program)
{
    if (is_of_find(m, program)) return m->nout;
    int least = 0;
    for (int i = m->nask; i-- > 0;) {
        const int32_t *e = PM_ASK_ROW(m, i);
        const int reads = e[PM_ASK_PROGRAM] == program || e[PM_ASK_PROGRAM_2] == program;
        if (reads) least = e[PM_ASK_KIND] == PM_ASK_END ? e[PM_ASK_OUT] : 0;
        if (reads && least == 0) return 0;
    }
    return least;
}

static int validate_one(const pm_model *m, int index, int first_value_allowed, pm_where *where)
{
    const int32_t *program = pm_model_row(m, PM_TABLE_PROGRAM, index, PM_PROGRAM_COLUMNS);
    const int first = program[PM_PROGRAM_FIRST], length = program[PM_PROGRAM_LENGTH];
    if (first < 0 || length < 1 || (int64_t)first + length > m->rows[PM_TABLE_CODE])
        return pm_bad_table(where, PM_TABLE_PROGRAM, index, first, m->rows[PM_TABLE_CODE]);
    const int is_value = first_value_allowed < m->nvalue;
    const int limit[PM_OPS] = {
        [PM_OP_CONSTANT] = m->nconstant,
        [PM_OP_PARAMETER] = m->nparam,
        [PM_OP_VALUE] = first_value_allowed,
        [PM_OP_MEASURE] = is_value ? 0 : m->rows[PM_TABLE_MEASURE],
        [PM_OP_ANSWER] = is_value ? 0 : answered_before(m, index),
        [PM_OP_PIECEWISE] = m->rows[PM_TABLE_PIECEWISE],
        [PM_OP_PIECE] = m->rows[PM_TABLE_PIECEWISE],
        [PM_OP_KNOT] = m->rows[PM_TABLE_PIECEWISE],
    };
    int depth = 0;
    for (int i = first; i < first + length; i++) {
        const int32_t *code = pm_model_row(m, PM_TABLE_CODE, i, PM_CODE_COLUMNS);
        const int op = code[PM_CODE_OP], arg = code[PM_CODE_ARG];
        if (op < 0 || op >= PM_OPS) return pm_bad_table(where, PM_TABLE_PROGRAM, index, op, PM_OPS);
        const int takes = pm_operations[op].takes;
        if ((takes == 0 || pm_operation_of_table(op)) && (arg < 0 || arg >= limit[op]))
            return pm_bad_table(where, PM_TABLE_PROGRAM, index, arg, limit[op]);
        if (depth < takes) return pm_bad_table(where, PM_TABLE_PROGRAM, index, depth, takes);
        depth += 1 - takes;
        if (depth > PM_STACK) return pm_bad_table(where, PM_TABLE_PROGRAM, index, depth, PM_STACK);
    }
    return depth == 1 ? PM_OK : pm_bad_table(where, PM_TABLE_PROGRAM, index, depth, 1);
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

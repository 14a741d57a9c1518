/* program_batch.c - a program at all nodes of a step together: each operation goes over the nodes. */
#include <math.h>
#include <string.h>

#include "expression/operation.h"
#include "expression/piecewise.h"
#include "expression/program.h"
#include "expression/program_fold.h"
#include "numerics/chebyshev_nodes.h"
#include "state/workspace.h"

typedef double pm_lane[PM_NODES_MOST];

static void fill(int n, double number, double *to)
{
    for (int k = 0; k < n; k++) to[k] = number;
}

/* a = a op b, b at every node or (step 0) the same at all. */
static inline void combine(int op, int n, double *restrict a, const double *restrict b, int step)
{
    switch (op) {
    case PM_OP_ADD:
        for (int k = 0; k < n; k++) a[k] += b[step * k];
        break;
    case PM_OP_SUB:
        for (int k = 0; k < n; k++) a[k] -= b[step * k];
        break;
    case PM_OP_MUL:
        for (int k = 0; k < n; k++) a[k] *= b[step * k];
        break;
    case PM_OP_DIV:
        for (int k = 0; k < n; k++) a[k] /= b[step * k];
        break;
    default:
        for (int k = 0; k < n; k++) a[k] = pm_operations[op].two(a[k], b[step * k]);
    }
}

static void apply(int op, int n, double *a)
{
    if (op == PM_OP_NEG)
        for (int k = 0; k < n; k++) a[k] = -a[k];
    else if (op == PM_OP_ABS)
        for (int k = 0; k < n; k++) a[k] = fabs(a[k]);
    else
        for (int k = 0; k < n; k++) a[k] = pm_operations[op].one(a[k]);
}

static void choose(int n, double *condition, const double *yes, const double *no)
{
    for (int k = 0; k < n; k++) condition[k] = condition[k] != 0 ? yes[k] : no[k];
}

static int jumps(int op) { return pm_operation_has(op, PM_OPERATION_JUMPS); }

static int is_switch(int op) { return pm_operation_has(op, PM_OPERATION_JUMPS | PM_OPERATION_CORNERS); }

int pm_program_switches(const pm_model *m, int index)
{
    const pm_program_fold *f = m->programs.fold;
    int count = 0;
    for (int k = f->first[index]; k < f->first[index + 1]; k++) {
        const pm_program_step *s = &f->step[k];
        const int operates = s->kind == STEP_UNARY || s->kind == STEP_BINARY || s->kind == STEP_WITH_NUMBER;
        if ((operates && s->op == PM_OP_FLOOR) || s->op == PM_OP_PIECEWISE) return 0;
        count += operates && is_switch(s->op);
    }
    return count <= PM_SWITCHES ? count : 0;
}

int pm_program_only_dips(const pm_model *m, int index, int greatest)
{
    const pm_program_fold *f = m->programs.fold;
    if (pm_program_switches(m, index) != 1) return 0;
    const int op = f->step[f->first[index + 1] - 1].op;
    return greatest ? op == PM_OP_ABS || op == PM_OP_MAX : op == PM_OP_MIN;
}

/* Which branch is taken at all nodes, as its sign says. */
static void take_branch(int op, int n, double *a, const double *b, int step, int sign)
{
    for (int k = 0; k < n; k++) {
        if (op == PM_OP_ABS)
            a[k] *= sign;
        else if (jumps(op))
            a[k] = pm_operations[op].two(sign, 0);
        else if (op == PM_OP_MIN ? sign > 0 : sign < 0)
            a[k] = b[step * k];
    }
}

static void operate(const pm_program_step *s, int n, double *a, const double *b, int step, pm_switches *x)
{
    if (x && is_switch(s->op)) {
        double *arg = x->arg[x->n];
        for (int k = 0; k < n; k++) arg[k] = s->op == PM_OP_ABS ? a[k] : a[k] - b[step * k];
        x->jumps[x->n] = (unsigned char)jumps(s->op);
        if (x->sign) {
            take_branch(s->op, n, a, b, step, x->sign[x->n++]);
            return;
        }
        x->n++;
    }
    if (s->kind == STEP_UNARY)
        apply(s->op, n, a);
    else
        combine(s->op, n, a, b, step);
}

/* An operation that reads a table. */
static void look_up(const pm_model *m, const pm_program_step *s, int n, double *a, const double *b)
{
    for (int k = 0; k < n; k++) {
        const double operand[2] = {a[k], b[k]};
        a[k] = pm_piecewise_operation(m, s->op, s->arg, operand);
    }
}

void pm_program_run_nodes(pm_workspace *w, int index, int n, const int *place, const double *measured,
                          pm_switches *switches, double *value)
{
    const pm_program_fold *f = w->model->programs.fold;
    const pm_program_step *s = f->step + f->first[index], *end = f->step + f->first[index + 1];
    const double *number = w->numbers.folded;
    pm_lane stack[PM_STACK];
    int top = -1;
    if (switches) switches->n = 0;
    if (s == end) { /* the program of a value: it reads no measure */
        fill(n, pm_program_run(w, index), value);
        return;
    }
    for (; s < end; s++) switch (s->kind) {
        case STEP_NUMBER: fill(n, number[s->arg], stack[++top]); break;
        case STEP_MEASURE:
            memcpy(stack[++top], measured + place[s->arg] * PM_NODES_MOST, (size_t)n * sizeof(double));
            break;
        case STEP_ANSWER: fill(n, w->result.out[s->arg], stack[++top]); break;
        case STEP_UNARY: operate(s, n, stack[top], NULL, 0, switches); break;
        case STEP_WITH_NUMBER: operate(s, n, stack[top], number + s->arg, 0, switches); break;
        case STEP_BINARY:
            top--;
            operate(s, n, stack[top], stack[top + 1], 1, switches);
            break;
        case STEP_TABLE: {
            const int two = pm_operations[s->op].takes == 2;
            top -= two;
            look_up(w->model, s, n, stack[top], stack[top + two]);
            break;
        }
        default: top -= 2; choose(n, stack[top], stack[top + 1], stack[top + 2]);
        }
    if (value) memcpy(value, stack[0], (size_t)n * sizeof(double));
}

/* program_nodes.c - a program at all nodes of a step together: each operation goes over the nodes. */
#include <math.h>
#include <string.h>

#include "nodes.h"
#include "program.h"
#include "program_fold.h"

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
        for (int k = 0; k < n; k++) a[k] = pm_program_binary(op, a[k], b[step * k]);
    }
}

static void apply(int op, int n, double *a)
{
    if (op == PM_OP_NEG)
        for (int k = 0; k < n; k++) a[k] = -a[k];
    else
        for (int k = 0; k < n; k++) a[k] = pm_program_unary(op, a[k]);
}

static void choose(int n, double *condition, const double *yes, const double *no)
{
    for (int k = 0; k < n; k++) condition[k] = condition[k] != 0 ? yes[k] : no[k];
}

void pm_program_run_nodes(pm_workspace *w, int index, int n, const int *place, const double *measured,
                          double *value)
{
    const pm_program_fold *f = w->model->fold;
    const pm_program_step *s = f->step + f->first[index], *end = f->step + f->first[index + 1];
    const double *number = w->number;
    pm_lane stack[PM_STACK];
    int top = -1;
    if (s == end) { /* the program of a value: it reads no measure */
        fill(n, pm_program_run(w->model, index, w->param, w->value, w), value);
        return;
    }
    for (; s < end; s++) switch (s->kind) {
        case STEP_NUMBER: fill(n, number[s->arg], stack[++top]); break;
        case STEP_MEASURE:
            memcpy(stack[++top], measured + place[s->arg] * PM_NODES_MOST, (size_t)n * sizeof(double));
            break;
        case STEP_ANSWER: fill(n, w->out[s->arg], stack[++top]); break;
        case STEP_UNARY: apply(s->op, n, stack[top]); break;
        case STEP_WITH_NUMBER: combine(s->op, n, stack[top], number + s->arg, 0); break;
        case STEP_BINARY:
            top--;
            combine(s->op, n, stack[top], stack[top + 1], 1);
            break;
        default: top -= 2; choose(n, stack[top], stack[top + 1], stack[top + 2]);
        }
    memcpy(value, stack[0], (size_t)n * sizeof(double));
}

/* wave_kinds.c - what a program may have along a step, by its operations. */
#include "events/wave_kinds.h"

#include "expression/operation.h"
#include "expression/program.h"
#include "expression/program_fold.h"

enum { SWITCHES = PM_OPERATION_JUMPS | PM_OPERATION_CORNERS | PM_OPERATION_COUNTS };

/* What a step of a program may have that its operands have not. */
static int more_than_operands(const pm_program_step *s)
{
    const int op = s->op;
    switch (s->kind) {
    case STEP_NUMBER:
    case STEP_MEASURE:
    case STEP_ANSWER: return PM_WAVES_NONE;
    case STEP_TABLE:
        return op == PM_OP_PIECEWISE ? PM_WAVES_ANY : PM_WAVES_NONE; /* a piece is a polynomial */
    default:
        if (op == PM_OP_NEG || op == PM_OP_ADD || op == PM_OP_SUB || op == PM_OP_MUL ||
            (op == PM_OP_DIV && s->kind == STEP_WITH_NUMBER))
            return PM_WAVES_NONE;
        return op == PM_OP_SELECT || pm_operation_has(op, SWITCHES) ? PM_WAVES_SWITCHES_ONLY : PM_WAVES_ANY;
    }
}

/* The size of something has a corner at zero: that is seen where it is read. */
static int is_size(const pm_model *m, const pm_program_step *s)
{
    return s->kind == STEP_MEASURE && pm_program_takes_size(m, s->arg);
}

/* The most that a step of the program has; an answer would be no polynomial. */
int pm_wave_kinds_of(const pm_model *m, int program)
{
    const pm_program_fold *f = m->programs.fold;
    int most = PM_WAVES_NONE;
    for (int k = f->first[program]; k < f->first[program + 1]; k++) {
        const int more = more_than_operands(&f->step[k]);
        if (f->step[k].kind == STEP_ANSWER) return PM_WAVES_NONE;
        if (more > most) most = more;
        k += is_size(m, &f->step[k]);
    }
    return most;
}

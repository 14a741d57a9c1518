/* program_fold.c - finds the parts of programs that stay the same through a case.
 *
 * In postfix code every operand is a range of instructions that ends where it is complete.  A range of which every
 * instruction is a constant, a parameter, a value, a mass or a weight is the same number wherever the program is run:
 * the largest such ranges become numbers of the case. */
#include "expression/program_fold.h"

#include <stdlib.h>
#include <string.h>

#include "expression/operation.h"
#include "expression/program.h"

static const int32_t *code_at(const pm_model *m, int k)
{
    return pm_model_row(m, PM_TABLE_CODE, k, PM_CODE_COLUMNS);
}

/* What an instruction pushes stays the same through a case. */
static int is_steady(const pm_model *m, int op, int arg)
{
    if (op == PM_OP_ANSWER) return 0;
    if (op != PM_OP_MEASURE) return 1;
    const int kind = PM_MEASURE_ROW(m, arg)[PM_MEASURE_KIND];
    return kind == PM_MEASURE_MASS || kind == PM_MEASURE_WEIGHT;
}

/* end[k]: where the largest steady operand ends that begins at instruction k, or PM_NONE. */
static void find_steady(const pm_model *m, int first, int length, int *end)
{
    int begin[PM_STACK], steady[PM_STACK], k = first; /* of the operands that wait */
    for (pm_program_walk x = pm_program_walk_part(m, first, length); pm_program_walk_next(&x); k++) {
        end[k] = PM_NONE;
        if (x.takes == 0) begin[x.at] = k;
        if (x.takes == 0) steady[x.at] = is_steady(m, x.op, x.arg);
        for (int i = 1; i < x.takes; i++) steady[x.at] &= steady[x.at + i];
        if (steady[x.at]) end[begin[x.at]] = k;
    }
}

static int same_part(const pm_model *m, const pm_program_part *a, const pm_program_part *b)
{
    return a->length == b->length && memcmp(code_at(m, a->first), code_at(m, b->first),
                                            (size_t)a->length * PM_CODE_COLUMNS * sizeof(int32_t)) == 0;
}

static int number_of(const pm_model *m, pm_program_fold *f, pm_program_part part)
{
    for (int i = 0; i < f->nnumber; i++)
        if (same_part(m, &f->part[i], &part)) return i;
    f->part[f->nnumber] = part;
    return f->nnumber++;
}

static pm_program_step step_of(const int32_t *code)
{
    const int op = code[PM_CODE_OP];
    pm_program_step s = {.op = op, .arg = code[PM_CODE_ARG], .kind = STEP_TABLE};
    if (pm_operation_of_table(op)) return s;
    switch (pm_operations[op].takes) {
    case 0: s.kind = op == PM_OP_MEASURE ? STEP_MEASURE : STEP_ANSWER; break;
    case 1: s.kind = STEP_UNARY; break;
    case 2: s.kind = STEP_BINARY; break;
    default: s.kind = STEP_SELECT;
    }
    return s;
}

/* Appends the program's steps to n others; returns how many there are then. */
static int fold_one(const pm_model *m, pm_program_fold *f, int program, int *end, int n)
{
    const int32_t *p = pm_model_row(m, PM_TABLE_PROGRAM, program, PM_PROGRAM_COLUMNS);
    const int first = p[PM_PROGRAM_FIRST], last = first + p[PM_PROGRAM_LENGTH];
    const int from = n;
    find_steady(m, first, last - first, end);
    for (int k = first; k < last; k++) {
        if (end[k] != PM_NONE) {
            const int number = number_of(m, f, (pm_program_part){k, end[k] + 1 - k});
            f->step[n++] = (pm_program_step){.kind = STEP_NUMBER, .arg = number};
            k = end[k];
            continue;
        }
        const pm_program_step s = step_of(code_at(m, k));
        const int second = n - 1;
        if (s.kind == STEP_BINARY && second > from && f->step[second].kind == STEP_NUMBER)
            f->step[second] =
                (pm_program_step){.kind = STEP_WITH_NUMBER, .op = s.op, .arg = f->step[second].arg};
        else
            f->step[n++] = s;
        if (s.kind == STEP_MEASURE && pm_program_takes_size(m, s.arg))
            f->step[n++] = (pm_program_step){.kind = STEP_UNARY, .op = PM_OP_ABS};
    }
    return n;
}

/* Values are worked out before there are numbers. */
static int is_of_value(const pm_model *m, int program)
{
    for (int i = 0; i < m->nvalue; i++)
        if (m->table[PM_TABLE_VALUE][i * PM_VALUE_COLUMNS + PM_VALUE_PROGRAM] == program) return 1;
    return 0;
}

int pm_program_fold_create(pm_model *m)
{
    const int nprogram = m->rows[PM_TABLE_PROGRAM];
    size_t length = 0;
    for (int i = 0; i < nprogram; i++)
        length += (size_t)pm_model_row(m, PM_TABLE_PROGRAM, i, PM_PROGRAM_COLUMNS)[PM_PROGRAM_LENGTH];
    pm_program_fold *f = m->programs.fold = calloc(1, sizeof *f);
    int *end = calloc((size_t)m->rows[PM_TABLE_CODE] + 1, sizeof *end);
    if (f) {
        f->step = calloc(2 * length + 1, sizeof *f->step); /* a size is two */
        f->part = calloc(length + 1, sizeof *f->part);
        f->first = calloc((size_t)nprogram + 1, sizeof *f->first);
    }
    const int status = f && end && f->step && f->part && f->first ? PM_OK : PM_NO_MEMORY;
    for (int i = 0; i < nprogram && !status; i++)
        f->first[i + 1] = is_of_value(m, i) ? f->first[i] : fold_one(m, f, i, end, f->first[i]);
    free(end);
    return status;
}

void pm_program_fold_free(pm_model *m)
{
    if (!m->programs.fold) return;
    free(m->programs.fold->step);
    free(m->programs.fold->part);
    free(m->programs.fold->first);
    free(m->programs.fold);
    m->programs.fold = NULL;
}

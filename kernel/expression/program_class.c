/* program_class.c - what of measures, events and sought parameters enters a program. */
#include "expression/program_class.h"

#include "expression/operation.h"

static int is_time(const pm_model *m, int measure)
{
    const int kind = PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND];
    return kind == PM_MEASURE_TIME || kind == PM_MEASURE_EVENT_TIME;
}

static int is_of_event(const pm_model *m, int measure)
{
    const int kind = PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND];
    return kind == PM_MEASURE_EVENT_COUNT || kind == PM_MEASURE_EVENT_TIME;
}

int pm_program_class_reads_time(const pm_model *m, int program)
{
    return pm_program_walk_reads(m, program, is_time) != PM_NONE;
}

static int is_no_time(const pm_model *m, int measure)
{
    return PM_MEASURE_ROW(m, measure)[PM_MEASURE_KIND] != PM_MEASURE_TIME;
}

int pm_program_class_reads_time_alone(const pm_model *m, int program)
{
    return pm_program_walk_reads(m, program, is_no_time) == PM_NONE;
}

int pm_program_class_reads_counts(const pm_model *m, int program)
{
    return pm_program_walk_reads(m, program, is_of_event) != PM_NONE;
}

/* What enters a value: nothing but constants, something that counts or decides, something continuous. */
enum pm_grain { GRAIN_CONSTANT = 0, GRAIN_DISCRETE = 1, GRAIN_CONTINUOUS = 2 };

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
    for (pm_program_walk x = pm_program_walk_begin(m, program); pm_program_walk_next(&x);)
        if (is_sought(m, x.op, x.arg)) return 1;
    return 0;
}

static int read_grain(const pm_program_walk *x, const void *none)
{
    (void)none;
    if (x->op != PM_OP_MEASURE) return is_sought(x->m, x->op, x->arg) ? GRAIN_CONTINUOUS : GRAIN_CONSTANT;
    const int counts = PM_MEASURE_ROW(x->m, x->arg)[PM_MEASURE_KIND] == PM_MEASURE_EVENT_COUNT;
    return counts ? GRAIN_DISCRETE : GRAIN_CONTINUOUS;
}

static int grain_after(const pm_program_walk *x, int a)
{
    return a != GRAIN_CONSTANT && pm_operation_has(x->op, PM_OPERATION_COUNTS) ? GRAIN_DISCRETE : a;
}

static int grain_of_two(const pm_program_walk *x, int a, int b) { return grain_after(x, a > b ? a : b); }

int pm_program_class_is_discrete(const pm_model *m, int program)
{
    static const pm_program_rules rules = {read_grain, grain_after, grain_of_two};
    return pm_program_rules_apply(m, program, &rules, NULL) == GRAIN_DISCRETE;
}

/* case_values.c - parameters -> values, and the bounds that each number must keep, with their places.
 *
 * Most values of a scene depend on no parameter: they are worked out and checked in the first case of a workspace, and from
 * then on only those that some parameter reaches.  So are the numbers of programs (program_fold.h). */
#include "equations/case_values.h"

#include <math.h>

#include "expression/operation.h"
#include "expression/program.h"
#include "expression/program_fold.h"
#include "numerics/tolerances.h"
#include "scene/reference.h"
#include "state/arena.h"
#include "state/evidence.h"

/* What the numbers of a column must be, where they are given: finite, at least `low` (strict: more), at most `high`. */
typedef struct pm_bounds {
    int table, column;
    double low, high;
    int strict;
} pm_bounds;

static const pm_bounds bounds[] = {
    {PM_TABLE_SETTING, PM_SETTING_GRAVITY_X, -INFINITY, INFINITY, 0},
    {PM_TABLE_SETTING, PM_SETTING_GRAVITY_Y, -INFINITY, INFINITY, 0},
    {PM_TABLE_SETTING, PM_SETTING_ACCURACY, PM_ACCURACY_LEAST, PM_ACCURACY_MOST, 0},
    {PM_TABLE_SETTING, PM_SETTING_MAX_TIME, 0, INFINITY, 1},
    {PM_TABLE_SETTING, PM_SETTING_MAX_CPU, 0, INFINITY, 1},
    {PM_TABLE_SETTING, PM_SETTING_ASSEMBLY, 0, INFINITY, 1},
    {PM_TABLE_SETTING, PM_SETTING_EXPONENT, 1, 10, 0},
    {PM_TABLE_BODY, PM_BODY_MASS, 0, INFINITY, 0},
    {PM_TABLE_BODY, PM_BODY_X, -INFINITY, INFINITY, 0},
    {PM_TABLE_BODY, PM_BODY_Y, -INFINITY, INFINITY, 0},
    {PM_TABLE_BODY, PM_BODY_ANGLE, -INFINITY, INFINITY, 0},
    {PM_TABLE_POINT, PM_POINT_X, -INFINITY, INFINITY, 0},
    {PM_TABLE_POINT, PM_POINT_Y, -INFINITY, INFINITY, 0},
    {PM_TABLE_LINE, PM_LINE_ANGLE, -INFINITY, INFINITY, 0},
    {PM_TABLE_CIRCLE, PM_CIRCLE_RADIUS, 0, INFINITY, 0},
    {PM_TABLE_PATTERN, PM_PATTERN_COUNT, -INFINITY, PM_MOST_MEMBERS, 0},
    {PM_TABLE_CONTACT, PM_CONTACT_RESTITUTION, 0, 1, 0},
    {PM_TABLE_CONTACT, PM_CONTACT_TANGENTIAL, 0, 1, 0},
    {PM_TABLE_CONTACT, PM_CONTACT_STIFFNESS, 0, INFINITY, 1},
    {PM_TABLE_CONTACT, PM_CONTACT_SLACK, 0, INFINITY, 0},
    {PM_TABLE_CONTACT, PM_CONTACT_STATIC, 0, INFINITY, 0},
    {PM_TABLE_CONTACT, PM_CONTACT_KINETIC, 0, INFINITY, 0},
    {PM_TABLE_CONTACT, PM_CONTACT_PRESSURE, 0, PM_PRESSURE_MOST, 0},
    {PM_TABLE_JOINT, PM_JOINT_VALUE_2, 0, INFINITY, 0},
    {PM_TABLE_START, PM_START_VALUE, -INFINITY, INFINITY, 0},
};

/* A number of a row that some parameter reaches. */
typedef struct pm_bounded {
    int bounds, row; /* of `bounds`, of its table */
} pm_bounded;

typedef struct pm_case_plan {
    int settled;              /* the values that no parameter reaches are there, within their bounds */
    int nvaried, nbounded;    /* how many a parameter reaches, and how many numbers of rows are such */
    int *varied;              /* [nvalue] these values, each after those that it reads */
    unsigned char *is_varied; /* [nvalue] */
    pm_bounded *bounded;      /* [numbers of rows with bounds] */
    int folded;               /* the numbers of programs that no parameter reaches are there */
    int nrefolded;            /* how many a parameter may reach */
    int *refolded;            /* [numbers of programs] these */
} pm_case_plan;

enum { BOUNDS = sizeof bounds / sizeof *bounds };

static const int32_t *entry_of(const pm_model *m, const pm_bounds *x, int row)
{
    return pm_model_row(m, x->table, row, pm_reference_columns[x->table]) + x->column;
}

static int program_of(const pm_model *m, int value)
{
    return m->table[PM_TABLE_VALUE][value * PM_VALUE_COLUMNS + PM_VALUE_PROGRAM];
}

/* A part of a program; masses and the weight may go with any parameter. */
static int is_reached(const pm_case_plan *plan, pm_program_walk x)
{
    while (pm_program_walk_next(&x))
        if (x.op == PM_OP_PARAMETER || x.op == PM_OP_MEASURE ||
            (x.op == PM_OP_VALUE && plan->is_varied[x.arg]))
            return 1;
    return 0;
}

static void find_refolded(const pm_model *m, pm_case_plan *x)
{
    for (int i = 0; i < m->programs.fold->nnumber; i++) {
        const pm_program_part *part = &m->programs.fold->part[i];
        if (is_reached(x, pm_program_walk_part(m, part->first, part->length)))
            x->refolded[x->nrefolded++] = i;
    }
}

int pm_case_values_create(pm_workspace *w)
{
    const pm_model *m = w->model;
    int rows = 0;
    for (int k = 0; k < BOUNDS; k++) rows += m->rows[bounds[k].table];
    if (PM_ARENA_NEW(&w->memory, w->numbers.plan)) return PM_NO_MEMORY;
    pm_case_plan *x = w->numbers.plan;
    const pm_array array[] = {PM_ARRAY(x->varied, m->nvalue), PM_ARRAY(x->is_varied, m->nvalue),
                              PM_ARRAY(x->bounded, rows), PM_ARRAY(x->refolded, m->programs.fold->nnumber)};
    const int status = pm_arena_take(&w->memory, PM_ARRAYS(array));
    if (status) return status;
    for (int i = 0; i < m->nvalue; i++) {
        x->is_varied[i] = (unsigned char)is_reached(x, pm_program_walk_begin(m, program_of(m, i)));
        if (x->is_varied[i]) x->varied[x->nvaried++] = i;
    }
    find_refolded(m, x);
    for (int k = 0; k < BOUNDS; k++)
        for (int i = 0; i < m->rows[bounds[k].table]; i++) {
            const int32_t value = *entry_of(m, &bounds[k], i);
            if (value != PM_NONE && x->is_varied[value]) x->bounded[x->nbounded++] = (pm_bounded){k, i};
        }
    return PM_OK;
}

static void run(pm_workspace *w, int value)
{
    const pm_numbers *n = &w->numbers;
    n->value[value] = pm_program_value(w->model, program_of(w->model, value), n->param, n->value);
}

int pm_case_values(pm_workspace *w, const double *param)
{
    const pm_case_plan *x = w->numbers.plan;
    w->numbers.param = param;
    w->numbers.is_folded = 0;
    for (int i = 0; i < w->model->nparam; i++)
        if (!isfinite(param[i]))
            return pm_fail_member(&w->result, PM_BAD_VALUE, PM_NONE, i, PM_NONE, param[i], 0);
    if (x->settled)
        for (int i = 0; i < x->nvaried; i++) run(w, x->varied[i]);
    else
        for (int i = 0; i < w->model->nvalue; i++) run(w, i);
    return PM_OK;
}

void pm_case_values_fold(pm_workspace *w)
{
    pm_case_plan *x = w->numbers.plan;
    const int all = !x->folded, n = all ? w->model->programs.fold->nnumber : x->nrefolded;
    for (int i = 0; i < n; i++) pm_program_fold_number(w, all ? i : x->refolded[i]);
    x->folded = w->numbers.is_folded = 1;
}

static int check(pm_workspace *w, const pm_bounds *x, int row)
{
    const int32_t index = *entry_of(w->model, x, row);
    if (index == PM_NONE) return PM_OK;
    const double value = w->numbers.value[index];
    const int finite = isfinite(value), enough = x->strict ? value > x->low : value >= x->low;
    if (finite && enough && value <= x->high) return PM_OK;
    return pm_fail_member(&w->result, PM_BAD_VALUE, x->table, row, x->column, value,
                          finite && value > x->high ? x->high : x->low);
}

int pm_case_values_check(pm_workspace *w)
{
    pm_case_plan *x = w->numbers.plan;
    int status = PM_OK;
    for (int i = 0; x->settled && i < x->nbounded && !status; i++)
        status = check(w, &bounds[x->bounded[i].bounds], x->bounded[i].row);
    for (int k = 0; !x->settled && k < BOUNDS && !status; k++)
        for (int i = 0; i < w->model->rows[bounds[k].table] && !status; i++) status = check(w, &bounds[k], i);
    if (!status) x->settled = 1;
    return status;
}

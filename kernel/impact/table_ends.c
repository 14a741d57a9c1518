/* table_ends.c - a run is over where a force or drive reads a table beyond its ends.
 *
 * A reading by the motion has a piece of the table (PM_EFFECT_PIECE): beyond the last piece it has left the table.  A reading
 * by the time alone may stand at the very end of the table: a moment later it is beyond. */
#include "impact/table_ends.h"

#include <float.h>
#include <math.h>

#include "elements/force.h"
#include "expression/piecewise.h"
#include "expression/program.h"
#include "impact/switches.h"
#include "scene/reference.h"
#include "state/frame.h"
#include "state/state.h"

/* A run stops at the first table that the program reads where it has no value. */
static int check_program(pm_workspace *w, int program)
{
    double x;
    const int row = pm_program_outside(w, program, &x);
    if (row == PM_NONE) return PM_OK;
    const pm_piecewise p = pm_piecewise_of(w->model, row);
    return pm_fail(&w->result, PM_TABLE_ENDS, PM_TABLE_PIECEWISE, row, x,
                   p.knot[x < p.knot[0] + 0.5 * (p.knot[p.pieces] - p.knot[0]) ? 0 : p.pieces]);
}

static int check_all(pm_workspace *w)
{
    const pm_model *m = w->model;
    int status = PM_OK, table, row, program;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        for (int k = 0; k < pm_force_of(m, i)->programs && !status; k++)
            if (!pm_state_is_absent(m, &w->state, PM_TABLE_FORCE, i))
                status = check_program(w, PM_FORCE_ROW(m, i)[PM_FORCE_PROGRAM_X + k]);
    for (int k = 0; !status && (program = pm_reference_drive(m, k, &table, &row)) != PM_NONE; k++)
        if (!pm_state_is_absent(m, &w->state, table, row)) status = check_program(w, program);
    return status;
}

int pm_table_ends_leave(pm_workspace *w)
{
    const pm_model *m = w->model;
    int strict = 0;
    for (int i = 0; i < m->rows[PM_TABLE_PIECEWISE]; i++)
        strict |= pm_model_row(m, PM_TABLE_PIECEWISE, i, PM_PIECEWISE_COLUMNS)[PM_PIECEWISE_BEYOND] ==
                  PM_BEYOND_NONE;
    if (!strict) return PM_OK;
    int status = pm_switches_settle(w, 1);
    const double t = w->frame.t;
    w->frame.t = pm_frame_side_time(&w->frame, t) + 4 * DBL_EPSILON * fabs(t) + DBL_MIN;
    if (!status) status = check_all(w);
    w->frame.t = t;
    return status;
}

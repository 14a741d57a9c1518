/* ida_newton.c - when Newton's iteration of a step may stop.
 *
 * IDA's own test (P. N. Brown, A. C. Hindmarsh, L. R. Petzold, SIAM J. Sci. Comput. 15, 1994) compares a change with the
 * errors allowed; where these are near rounding no iteration passes it.  Here a change that is rounding ends it, too. */
#include <math.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include "numerics/tolerances.h"
#include "routes/ida/ida.h"
#include "state/workspace.h"

static int is_rounding(const pm_ida *r, N_Vector change)
{
    N_Vector present;
    if (IDAGetCurrentY(r->memory, &present)) return 0;
    const double *d = N_VGetArrayPointer(change), *y = N_VGetArrayPointer(present);
    for (int i = 0; i < r->n; i++)
        if (!(fabs(d[i]) <= PM_IDA_GAINED * pm_ida_rounding_at(&r->rounding, i, y[i]))) return 0;
    return 1;
}

static int has_converged(SUNNonlinearSolver solver, N_Vector sum, N_Vector change, double allowed,
                         N_Vector weight, void *workspace)
{
    const pm_workspace *w = workspace;
    pm_ida *r = w->ida;
    const double size = N_VWrmsNorm(change, weight);
    int before;
    (void)sum;
    if (is_rounding(r, change)) return SUN_NLS_SUCCESS;
    if (SUNNonlinSolGetCurIter(solver, &before)) return SUN_NLS_CONV_RECVR;
    if (r->jacobian.fresh) r->left_over = PM_IDA_UNKNOWN;
    r->jacobian.fresh = 0;
    if (before == 0) {
        r->first_change = size;
        if (size <= PM_IDA_NOTHING * allowed) return SUN_NLS_SUCCESS;
    } else {
        const double rate = pow(size / r->first_change, 1.0 / before);
        if (!(rate <= PM_IDA_STALLED)) return SUN_NLS_CONV_RECVR;
        r->left_over = rate / (1 - rate);
    }
    return r->left_over * size <= allowed ? SUN_NLS_SUCCESS : SUN_NLS_CONTINUE;
}

int pm_ida_newton_create(pm_workspace *w)
{
    pm_ida *r = w->ida;
    r->newton = SUNNonlinSol_Newton(r->y, r->context);
    if (!r->newton) return PM_NO_MEMORY;
    int flag = IDASetNonlinearSolver(r->memory, r->newton);
    if (flag == IDA_SUCCESS) flag = SUNNonlinSolSetConvTestFn(r->newton, has_converged, w);
    if (flag == IDA_SUCCESS) flag = IDASetNonlinConvCoef(r->memory, PM_IDA_NEWTON);
    return flag == IDA_SUCCESS ? PM_OK : pm_fail(&w->result, PM_SOLVER, PM_NONE, PM_NONE, flag, 0);
}

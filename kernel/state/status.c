/* status.c - texts of statuses, and where a case failed. */
#include <stdio.h>

#include "numerics/bracket.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

static const char *text_of(enum pm_status status)
{
    switch (status) { /* no default: the compiler finds a missing one */
    case PM_OK: return "ok";
    case PM_LIMIT_TIME: return "the time limit was reached before the end of the run";
    case PM_LIMIT_EVENTS: return "the limit on events was reached before the end of the run";
    case PM_LIMIT_STEPS: return "the limit on steps was reached before the end of the run";
    case PM_LIMIT_CPU: return "the limit on computing time was reached before the end of the run";
    case PM_CANCELLED: return "stopped on request";
    case PM_STAYS_AT_REST: return "everything is at rest and stays so; the end of the run cannot come";
    case PM_FIND_SEVERAL: return "several values were found; the answers are those of the first";
    case PM_FIND_AT_BOUND: return "what is sought lies at a bound";
    case PM_NOT_UNIQUE: return "the laws of contact allow several motions";
    case PM_PAINLEVE: return "no motion obeys the laws of contact (Painleve)";
    case PM_ROUGH_IMPOSSIBLE: return "no motion keeps a rough contact from slipping";
    case PM_ENDS_SINGULAR: return "a singular position was reached before the end of the run";
    case PM_STRAND_ENDS: return "a cord has no free length left";
    case PM_TABLE_ENDS: return "a table of values has no value there";
    case PM_CURVE_ENDS: return "what runs along a curve has come to its end";
    case PM_BOUNCES_ON: return "bounces too low to be computed go on without an end that is known";
    case PM_ALTERNATES: return "contacts change in turn and no time passes";
    case PM_DRIVE_JUMPS: return "a prescribed place jumps";
    case PM_UNDECIDED: return "the errors of the run might have changed a decision on the way";
    case PM_NO_TIME_ROUTE: return "a route in time was asked for, and no time passes";
    case PM_BAD_TABLE: return "the scene's tables are inconsistent";
    case PM_NO_MEMORY: return "out of memory";
    case PM_BAD_VALUE: return "a value is not finite or out of its bound";
    case PM_ASSEMBLY: return "the joints cannot be met from the start that is written";
    case PM_START_CONFLICT: return "the start velocities contradict the joints or each other";
    case PM_START_OPEN: return "the start velocities leave the motion of a fastened body open";
    case PM_SINGULAR: return "the joints and forces do not determine the accelerations";
    case PM_STEP_TOO_SMALL: return "the integrator cannot go on at the accuracy asked";
    case PM_BLOW_UNDECIDED: return "no consistent set of contacts was found";
    case PM_AUDIT: return "the independent check of the run does not close";
    case PM_SOLVER: return "a numerical library reported a failure";
    case PM_PENETRATION: return "contacts overlap at the start";
    case PM_UNSUPPORTED: return "the scene needs something that this route does not do";
    case PM_CONTACT_SLOTS: return "too many members of one pattern are in contact at once";
    case PM_FIND_NONE: return "no value between the bounds does what is sought";
    case PM_FIND_JUMP: return "what is sought jumps over the value wanted";
    case PM_BLOWS_ENDLESS: return "the blows at one instant do not end";
    case PM_BLOW_SEVERAL:
        return "this impact law is for one contact at a time, and several take part in a blow";
    case PM_NO_IMPULSE: return "no impulse does the work asked";
    case PM_NUDGE_UNSTEADY: return "a nudge acts where there is neither rest nor a steady motion";
    case PM_NUDGE_STABLE: return "nothing that a nudge could begin grows";
    case PM_NO_EQUILIBRIUM: return "no equilibrium was found near the start";
    case PM_EQUILIBRIUM_MOVES: return "the start is not at rest";
    case PM_EQUILIBRIUM_OPEN: return "friction leaves the equilibrium open";
    }
    return "unknown status";
}

int pm_status_text(int status, int64_t ntext, int8_t *text)
{
    return snprintf((char *)text, (size_t)ntext, "%s", text_of((enum pm_status)status));
}

int pm_fail(pm_result *result, int status, int table, int row, double value, double bound)
{
    return pm_fail_member(result, status, table, row, PM_NONE, value, bound);
}

int pm_fail_member(pm_result *result, int status, int table, int row, int member, double value, double bound)
{
    result->where = (pm_where){table, row, member, value, bound};
    return status;
}

int pm_fail_early(pm_result *result, pm_patience *patience)
{
    const int status = pm_patience_ends(patience);
    if (status == PM_LIMIT_CPU)
        return pm_fail(result, status, PM_TABLE_SETTING, 0, patience->limit, patience->limit);
    return status;
}

int pm_fail_search(pm_result *result, int search_end)
{
    if (search_end == PM_SEARCH_FOUND) return PM_OK;
    return pm_fail(result, PM_SOLVER, PM_NONE, PM_NONE, search_end, PM_BRACKET_VALUES);
}

/* planemotion.h - the public face of the kernel: rigid bodies in plane motion.
 *
 * A scene arrives as flat integer tables plus constants (planemotion_tables.h); a case is a vector of parameters; a run gives
 * numbers for the questions ("asks") of the scene.  SI units and radians only.
 *
 * kernel/layout.py reads the constants of both headers, so that Python uses the same numbers. */
#ifndef PLANEMOTION_H
#define PLANEMOTION_H

#include <stdint.h>

#include "planemotion_tables.h"

/* ---- status ---------------------------------------------------------------------------------------
 * 0 ok; > 0 an early stop (what was answered before stands) or, for a find, a remark (all answers stand);
 * < 0 failure: of the answers only those stand that were reached before it while the ledgers of the audit closed. */
enum pm_status {
    PM_OK = 0,
    PM_LIMIT_TIME = 1,    /* max_time reached before the end of the run */
    PM_LIMIT_EVENTS = 2,  /* max_events reached */
    PM_LIMIT_STEPS = 3,   /* max_steps reached */
    PM_CANCELLED = 4,     /* the stop flag was raised */
    PM_STAYS_AT_REST = 5, /* nothing moves any more and the end was not reached */
    /* the first of several is the answer: where = condition; detail = the next, how many */
    PM_FIND_SEVERAL = 6,
    /* what is sought lies at a bound of the interval, or where runs begin to fail: where = varied
     * parameter; detail = its value */
    PM_FIND_AT_BOUND = 7,
    PM_UNDECIDED = 8, /* the run came to its end; its errors, or bounds, leave a decision on the way open */
    /* on the way a position was reached where nothing determines how it goes on: where = joint */
    PM_ENDS_SINGULAR = 9,
    /* a route in time was asked for and no time passes; all answers stand: where = setting */
    PM_NO_TIME_ROUTE = 10,
    /* laws of contact allow several motions: where = contact that tells them apart; detail = its
     * coefficient of friction, contacts that take part; or where = trigger whose load is not unique */
    PM_NOT_UNIQUE = 11,
    PM_PAINLEVE = 12,         /* no motion obeys the laws of contact without a blow: where, detail likewise */
    PM_ROUGH_IMPOSSIBLE = 13, /* the same where a contact that may not slip takes part */
    PM_LIMIT_CPU = 14,        /* max_cpu reached: detail = the limit */
    PM_STRAND_ENDS = 15,      /* a taut cord has no free length left: where = contact; detail = t */
    PM_ALTERNATES = 16,       /* modes of contacts change in turn and no time passes: where = contact; or a
                                 force switches to and fro: where = event of its switch; detail = how often */
    PM_TABLE_ENDS = 17,       /* a force or a drive reads a table of values beyond its end: where = table of
                                 PM_TABLE_PIECEWISE; detail = argument, the end */
    PM_DRIVE_JUMPS = 18, /* a place that is prescribed jumps: where = joint; detail = by how much, m or rad */
    PM_CURVE_ENDS = 19,  /* what runs along a curve comes to its end: where = joint; detail = t */
    /* all is at rest but for bounces too low to be computed, which do not come to an end that is known:
     * where = contact; detail = the last flight, the one before, s */
    PM_BOUNCES_ON = 20,
    PM_BAD_TABLE = -1, /* the tables contradict this header: where = table, row */
    PM_NO_MEMORY = -2,
    PM_BAD_VALUE = -3,      /* not finite or out of its bound: where = table, row; detail = value, bound */
    PM_ASSEMBLY = -4,       /* joints cannot be met from the start given: where; detail = opening */
    PM_START_CONFLICT = -5, /* start velocities contradict joints or each other: detail = asked, implied */
    PM_START_OPEN = -6,     /* start velocities leave a fastened body's motion open: where = body */
    PM_SINGULAR = -7,       /* the saddle-point system has no unique acceleration */
    PM_STEP_TOO_SMALL = -8, /* the integrator cannot go on at the tolerance asked */
    PM_BLOW_UNDECIDED = -9, /* no consistent set of contacts was found for a blow or a phase */
    PM_AUDIT = -10,         /* the independent evidence does not close: detail = residual, bound */
    PM_SOLVER = -11,        /* IDA or GSL reported a failure: detail = its code */
    PM_PENETRATION = -12,   /* contacts overlap at the start: where; detail = gap */
    PM_UNSUPPORTED = -13,   /* the scene needs something that this route or build does not do */
    PM_CONTACT_SLOTS = -14, /* more members of one pattern are closed at once than the kernel keeps */
    PM_FIND_NONE = -15,     /* nothing found: where = condition or find; detail = what it is at both bounds */
    PM_FIND_JUMP = -16, /* the condition jumps over zero: where = condition; detail = value on both sides */
    /* blows one by one at one instant do not end, or one that stiffnesses share: where = contact; detail =
     * how many; how much stiffer it is than another */
    PM_BLOWS_ENDLESS = -17,
    /* a restitution along a contact goes with newton alone in its blow: where = contact; detail = how many
     * take part */
    PM_BLOW_SEVERAL = -19,
    /* no impulse does that work: where = action; detail = work, the least that is possible */
    PM_NO_IMPULSE = -20,
    /* where it acts there is neither rest nor a steady motion: where = action, or setting */
    PM_NUDGE_UNSTEADY = -22,
    PM_NUDGE_STABLE =
        -23, /* nothing that it could begin grows: where likewise; detail = rate of what grows otherwise, 1/s */
    /* no equilibrium was found near the start: where = body; detail = acceleration left of it, m/s^2 */
    PM_NO_EQUILIBRIUM = -24,
    PM_EQUILIBRIUM_MOVES = -25, /* a drive moves at the start: where = body; detail = its velocity */
    /* friction leaves open where it is: where = contact, or force that is a friction; detail = what it needs
     * where it is drawn, what it has; or not a number: where the contact closes nothing tells */
    PM_EQUILIBRIUM_OPEN = -26
};

/* ---- asks --------------------------------------------------------------------------------------------------- */
enum pm_ask_kind {
    PM_ASK_END = 0, /* program at the end of the run, after its jump; it may read answers of asks before it */
    PM_ASK_EVENT = 1, /* program at the nth firing of an event, before or after its jump */
    PM_ASK_MAX = 2,   /* greatest value of program over the run */
    PM_ASK_MIN = 3,
    PM_ASK_AT_MAX = 4, /* program where program_2 is greatest */
    PM_ASK_AT_MIN = 5,
    PM_ASK_GRID = 6, /* program where program_2 first equals each of `count` values from first_value on */
    PM_ASK_EACH = 7, /* program at each firing of an event, up to `count` of them */
    /* of program by the time; program_2: a condition, program is 0 where it does not hold */
    PM_ASK_INTEGRAL = 8,
    PM_ASK_MEAN = 9, /* the integral over the time in which the condition holds: over all time without one */
    PM_ASK_RMS = 10, /* root of the mean of the square of program, likewise */
    /* the value below which program is for a part of that time: value index first_value, 0 < part < 1 */
    PM_ASK_PERCENTILE = 11,
    PM_ASK_KINDS = 12
};
enum pm_ask_column {
    PM_ASK_KIND = 0,
    PM_ASK_PROGRAM = 1,
    PM_ASK_EVENT_INDEX = 2, /* or PM_NONE */
    PM_ASK_NTH = 3,         /* from 1 */
    PM_ASK_BEFORE = 4,      /* 1: before the jump */
    PM_ASK_PROGRAM_2 = 5,   /* or PM_NONE */
    PM_ASK_FIRST_VALUE = 6, /* or PM_NONE */
    PM_ASK_OUT = 7,         /* first column of out[] */
    PM_ASK_COUNT = 8,       /* number of columns of out[] */
    PM_ASK_COLUMNS = 9
};
/* Why an ask has no number (out is NaN there, or infinite). */
enum pm_reason {
    PM_REASON_NONE = 0,
    PM_REASON_NOT_REACHED = 1, /* the instant did not come */
    PM_REASON_UNDEFINED = 2, /* the expression has no value at some instant (a ratio to a force <= 0, 0/0) */
    PM_REASON_FAILED = 3,    /* the run failed */
    PM_REASON_INFINITE = 4,  /* it grows without bound: the count of blows that add up in finite time, 1/0 */
    PM_REASON_SHARED = 5,    /* it is not unique: redundant constraints share it, and nothing tells how */
    PM_REASON_CUT = 6, /* of a list: the event fired more often than it is long; what stands in it is sound */
    PM_REASON_TWO_SIDED = 7 /* there is a number, and another one on the other side of what was found */
};

/* ---- settings ----------------------------------------------------------------------------------------------- */
/* Reactions and impulses that are not unique: constraints depend on each other. */
enum pm_shared_setting {
    PM_SHARED_NONE = 0,  /* they have no number (PM_REASON_SHARED) */
    PM_SHARED_LEAST = 1, /* those with the least sum of squares that the contacts allow */
    PM_SHARED_SETTINGS = 2
};
enum pm_route {
    PM_ROUTE_AUTO = 0,    /* each phase by the cheapest route that is exact enough */
    PM_ROUTE_RK = 1,      /* smooth motion in time: explicit, 8th order */
    PM_ROUTE_IDA = 2,     /* smooth motion in time: SUNDIALS IDA; stiff forces; the reference */
    PM_ROUTE_STATE = 3,   /* only the start is asked */
    PM_ROUTE_JUMP = 4,    /* only states before and after an impulse are asked */
    PM_ROUTE_UNIFORM = 5, /* constant accelerations */
    PM_ROUTE_PATH = 6,    /* one degree of freedom: work and energy along the path */
    PM_ROUTES = 7
};
enum pm_simultaneous {
    PM_SIMULTANEOUS_TOGETHER = 0,
    PM_SIMULTANEOUS_ONE_BY_ONE = 1, /* in the order of the contacts, each blow an instant of its own */
    PM_SIMULTANEOUS_OPEN = 2,       /* not chosen: together; blows that are others one by one are counted */
    PM_SIMULTANEOUS_KINDS = 3
};
enum pm_setting_column {
    PM_SETTING_GRAVITY_X = 0, /* value indices */
    PM_SETTING_GRAVITY_Y = 1,
    PM_SETTING_ACCURACY = 2, /* value index: relative tolerance of the integration, 1e-14 .. 1e-2 */
    PM_SETTING_MAX_TIME = 3, /* value index, s; or PM_NONE: PM_MAX_TIME where the run steps in time */
    PM_SETTING_ASSEMBLY = 4, /* value index: allowed opening relative to the scene's size */
    PM_SETTING_ROUTE = 5,    /* enum pm_route */
    PM_SETTING_MAX_EVENTS = 6,
    PM_SETTING_MAX_STEPS = 7,
    PM_SETTING_NUDGE = 8,         /* program or PM_NONE: of a nudge at the start */
    PM_SETTING_ESTIMATE = 9,      /* 1: errors and margins are estimated, by further passes of the case */
    PM_SETTING_SIMULTANEOUS = 10, /* enum pm_simultaneous */
    PM_SETTING_MAX_CPU = 11, /* value index, s of computing time of a case with all its passes; or PM_NONE */
    PM_SETTING_SHARED = 12,  /* enum pm_shared_setting */
    /* value index, 1 .. 10: n of contacts with stiffnesses, see PM_CONTACT_STIFFNESS */
    PM_SETTING_EXPONENT = 13,
    PM_SETTING_EQUILIBRIUM = 14, /* 1: it starts in an equilibrium near the start that is written */
    PM_SETTING_COLUMNS = 15
};

/* ---- finds ----------------------------------------------------------------------------------------------------
 * A case looks for one or two of its parameters by whole runs, and answers the asks with what it found; param[] of a
 * varied parameter is ignored.  Conditions and the extreme ask are read at the end of each run, after its jump. */
#define PM_FIND_MOST 2 /* parameters that vary */
#define PM_FIND_MOST_SAMPLES 4096
#define PM_FIND_MOST_PAIR_SAMPLES 64 /* of each of two parameters */
#define PM_FIND_MOST_CONDITIONS 8
enum pm_find_goal {
    PM_FIND_VALUE = 0, /* as many conditions ZERO as parameters vary */
    PM_FIND_GREATEST = 1,
    PM_FIND_LEAST = 2,
    PM_FIND_GOALS = 3
};
enum pm_find_column {
    PM_FIND_GOAL = 0,
    PM_FIND_PROGRAM = 1, /* what is to be extreme; PM_NONE: the (one) parameter itself */
    PM_FIND_SAMPLES = 2, /* equal intervals into which each range is divided to look for brackets, >= 2 */
    PM_FIND_COLUMNS = 3
};
/* Parameter and its bounds; their values must not depend on varied parameters. */
enum pm_vary_column { PM_VARY_PARAMETER = 0, PM_VARY_LOW = 1, PM_VARY_HIGH = 2, PM_VARY_COLUMNS = 3 };
enum pm_condition_kind {
    PM_CONDITION_ZERO = 0,         /* program = 0; the run must come to its end */
    PM_CONDITION_POSITIVE = 1,     /* program > 0; likewise */
    PM_CONDITION_NOT_NEGATIVE = 2, /* program >= 0; likewise */
    PM_CONDITION_HOLDS = 3,        /* program != 0; an early stop is an outcome, too */
    PM_CONDITION_KINDS = 4
};
enum pm_condition_column { PM_CONDITION_KIND = 0, PM_CONDITION_PROGRAM = 1, PM_CONDITION_COLUMNS = 2 };
/* What a find says beside the answers; not a number where there is none. */
enum pm_found_column {
    PM_FOUND_FIRST = 0,
    PM_FOUND_SECOND = 1,
    PM_FOUND_FIRST_ERROR = 2, /* estimated, absolute */
    PM_FOUND_SECOND_ERROR = 3,
    PM_FOUND_COLUMNS = 4
};

/* ---- results -------------------------------------------------------------------------------------------------- */
enum pm_audit { PM_AUDIT_ENERGY = 0, PM_AUDIT_MOMENTUM = 1, PM_AUDIT_CONSTRAINT = 2, PM_AUDITS = 3 };
/* How far a case can be trusted; not a number where nothing was estimated. */
enum pm_trust {
    /* least distance of a decision from its threshold over its error; infinite: none was taken */
    PM_TRUST_MARGIN = 0,
    /* greatest error of an answer over what the accuracy asked allows; 1 or less: kept */
    PM_TRUST_EXCESS = 1,
    PM_TRUSTS = 2
};
/* Where a case failed: table and row (PM_NONE if nowhere in particular) and numbers that belong to the message.  Of a case
 * that is ok: the first of PM_COUNT_ORDERED_BLOWS: row and member are two of its contacts; detail = its time, s. */
enum pm_where_column { PM_WHERE_TABLE = 0, PM_WHERE_ROW = 1, PM_WHERE_MEMBER = 2, PM_WHERE_COLUMNS = 3 };
enum pm_detail_column { PM_DETAIL_VALUE = 0, PM_DETAIL_BOUND = 1, PM_DETAIL_TIME = 2, PM_DETAIL_COLUMNS = 3 };
/* Of a case that is PM_UNDECIDED: table and row are those of the event, contact or joint that its least margin belongs to, the
 * member tells what was decided there; detail = margin, 1 and the time of the decision, s. */
enum pm_decision {
    /* passes that differ by their errors only have other counts or statuses; no place is known */
    PM_DECISION_OUTCOME = 0,
    PM_DECISION_HAPPENS = 1,  /* whether it is reached */
    PM_DECISION_REVERSES = 2, /* whether what is reached is passed, or turns back there */
    PM_DECISION_ORDER = 3,    /* whether a blow comes before a time of the scene */
    PM_DECISION_STRIKES = 4,
    PM_DECISION_PULLS_IN_BLOW = 5,
    PM_DECISION_SLIDES_IN_BLOW = 6,
    PM_DECISION_JOINS = 7,
    PM_DECISION_PULLS = 8,
    PM_DECISION_SLIDES = 9,
    PM_DECISION_SLIP_LEFT = 10,
    PM_DECISION_MEETS = 11,
    PM_DECISION_PARTS = 12,
    PM_DECISION_SHARES = 13,
    PM_DECISION_ENDS = 14,  /* whether the run can go on there: the pass that it is compared with could not */
    PM_DECISION_UNSEEN = 15 /* whether it is reached: not every place of a step could be looked at */
};
enum pm_count_column {
    PM_COUNT_PHASES = 0,
    PM_COUNT_EVENTS = 1,
    PM_COUNT_JUMPS = 2,
    PM_COUNT_STEPS = 3,
    PM_COUNT_SOLVES = 4, /* saddle-point solutions */
    PM_COUNT_ROUTE = 5,  /* enum pm_route that ran: the costliest, if phases took several */
    /* whole runs of the case: more than 1 in a find, whose last one the other counts are of */
    PM_COUNT_RUNS = 6,
    PM_COUNT_FOUND = 7, /* brackets of a find in which something was found; changes of an outcome */
    /* of the case, the others for its errors; all other counts are of the one that answers */
    PM_COUNT_PASSES = 8,
    PM_COUNT_ROUTES = 9,             /* sum of 2^route over all that ran */
    PM_COUNT_REPEATED_SEGMENTS = 10, /* that repeat one that was computed, and were passed over */
    /* whose restitution was lowered: with friction it would have gained energy */
    PM_COUNT_LIMITED_BLOWS = 11,
    /* of several contacts, followed: how these share each is what their common pace says */
    PM_COUNT_SHARED_BLOWS = 12,
    /* of several contacts, which one by one would leave another motion; PM_SIMULTANEOUS_OPEN alone */
    PM_COUNT_ORDERED_BLOWS = 13,
    PM_COUNT_STIFF_PHASES = 14,    /* in which stability made the steps of rk short, not accuracy */
    PM_COUNT_UNSTABLE_STARTS = 15, /* 1: the equilibrium in which it starts is unstable */
    PM_COUNT_COLUMNS = 16
};
/* What pm_check reports of the assembled start. */
enum pm_check_column {
    PM_CHECK_COORDINATES = 0,
    PM_CHECK_CONSTRAINTS = 1, /* constraints of joints and closed contacts at the start */
    PM_CHECK_REDUNDANT = 2,   /* constraints that depend on others */
    PM_CHECK_FREEDOM = 3,     /* degrees of freedom */
    PM_CHECK_CLOSED = 4,      /* contacts closed at the start */
    PM_CHECK_EQUILIBRIUM = 5, /* enum pm_equilibrium_kind */
    PM_CHECK_COLUMNS = 6
};
/* Small motion next to it, with contacts and frictions as they are. */
enum pm_equilibrium_kind {
    PM_EQUILIBRIUM_NONE = 0, /* none was asked for */
    PM_EQUILIBRIUM_STABLE = 1,
    PM_EQUILIBRIUM_NEUTRAL = 2, /* something can move on and nothing draws it back */
    PM_EQUILIBRIUM_UNSTABLE = 3,
    PM_EQUILIBRIUM_NOT_TOLD = 4, /* forces are not smooth there */
    PM_EQUILIBRIUM_KINDS = 5
};
enum pm_check_number {
    PM_CHECK_MOVED = 0,   /* greatest displacement by the assembly, m */
    PM_CHECK_SIZE = 1,    /* size of the scene, m */
    PM_CHECK_OPENING = 2, /* greatest residual after assembly, m */
    PM_CHECK_SETTLED = 3, /* greatest displacement from there to an equilibrium, m */
    PM_CHECK_NUMBERS = 4
};

/* Runs cases first .. over `nworker` threads; every row of the results depends on its own parameters only.
 *   table[ntable], constant[nconstant]   the scene (see above)
 *   param[ncase][nparam]                 parameters of each case, SI
 *   stop[1]                              raised (non-zero) by another thread to end early; cases not ended get PM_CANCELLED
 *   progress[1]                          number of cases finished, for another thread to read
 *   out[ncase][nout], reason[ncase][nask], status[ncase], where[ncase][PM_WHERE_COLUMNS],
 *   detail[ncase][PM_DETAIL_COLUMNS], audit[ncase][PM_AUDITS], count[ncase][PM_COUNT_COLUMNS],
 *   found[ncase][PM_FOUND_COLUMNS]
 *   error[ncase][nout]                   estimated, absolute, in the unit of out; not a number where there is none
 *   margin[ncase][nask]                  that of the case for integers and yes-or-no answers, else not a number
 *   trust[ncase][PM_TRUSTS]
 * Returns PM_OK, or PM_BAD_TABLE / PM_NO_MEMORY with where[0] set; then no case has run. */
int pm_batch(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t ncase,
             int64_t nparam, const double *param, int nworker, const int32_t *stop, int64_t *progress,
             int64_t nout, double *out, int64_t nask, int32_t *reason, int32_t *status, int32_t *where,
             double *detail, double *audit, int64_t *count, double *found, double *error, double *margin,
             double *trust);

/* Runs one case as pm_batch does, but with all parameters as given (no find), and records it: rows (t, program values) at its
 * start, before and after every event, at its end, and between them on a grid of times or at places of every step; `mark` is 0
 * for those, 1 before an event, 2 after it.
 *   every                  > 0: the grid is 0, every, 2 every, ..., s;  0: the ends and nodes of steps
 *   trace_program[ntrace]  programs to record
 *   bend[ntrace]           without a grid: what a straight line over t from row to row may miss of each, in its unit, else
 *                          there are rows between;  INFINITY: whatever it misses
 *   history[cap][1 + ntrace], mark[cap];  needed[1]: rows wanted.
 * If needed > cap the first cap rows are there: call again with larger buffers. */
int pm_trace(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             const double *param, const int32_t *stop, double every, int64_t ntrace,
             const int32_t *trace_program, const double *bend, int64_t cap, double *history, int32_t *mark,
             int64_t *needed, int32_t *where, double *detail);

/* ---- phases of a run: which route computes each, and what it has to do ---- */
enum pm_phase_column {
    PM_PHASE_ROUTE = 0,
    PM_PHASE_RULE = 1,     /* of the planner, for pm_rule_text */
    PM_PHASE_UNKNOWNS = 2, /* coordinates that the route integrates or follows */
    /* constraints of joints and contacts between them; all others these coordinates meet by themselves */
    PM_PHASE_LOOPS = 3,
    PM_PHASE_CONSTRAINTS = 4, /* constraints of joints and closed contacts, redundant ones not counted */
    PM_PHASE_REDUNDANT = 5,
    PM_PHASE_FREEDOM = 6,
    PM_PHASE_WATCHED = 7, /* event functions */
    PM_PHASE_CLOCK = 8,   /* 1: the time is computed */
    PM_PHASE_DYNAMIC = 9, /* 1: accelerations and reactions are needed within it */
    PM_PHASE_STEPS = 10,
    PM_PHASE_REPEATED_SEGMENTS = 11, /* segments passed over before it */
    PM_PHASE_OUT_OF_REACH = 12,      /* contacts that can never close (gap_bounds.h) */
    PM_PHASE_FIXED = 13,             /* fixed bodies (fixed_bodies.h) */
    /* gaps that were not looked at in its steps, out of reach of them (gap_culling.h) */
    PM_PHASE_SKIPPED = 14,
    PM_PHASE_COLUMNS = 15
};
/* Runs one case as pm_trace does and reports its phases: phase[cap][PM_PHASE_COLUMNS], time[cap] of their begins, s (not a
 * number where the time is not computed); needed[1]: rows wanted; joint[cap][njoint], contact[cap][ncontact], 0 before: as
 * pm_check says.  most > 0: stops as the phase of that number begins (its row is there).  Returns a status of the case;
 * PM_CANCELLED where it was stopped. */
int pm_phases(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
              const double *param, const int32_t *stop, int64_t most, int64_t cap, int32_t *phase,
              double *time, int64_t njoint, int32_t *joint, int64_t ncontact, int32_t *contact,
              int64_t *needed, int32_t *where, double *detail);

/* Which rows of table `of` the answers of the scene depend on: needed[nconstraint], 1 or 0.  A run leaves the others out
 * (a trace and a check do not).  Returns PM_OK, PM_BAD_TABLE or PM_NO_MEMORY. */
int pm_needs(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             int of, int64_t nrow, int32_t *needed, int32_t *where, double *detail);

/* Why the planner chose a route, in English, of at most ntext bytes, not ended by 0; its length. */
int pm_rule_text(int rule, int64_t ntext, int8_t *text);

/* What a route (enum pm_route) can compute, likewise: for the message where it was asked for and declines. */
int pm_route_text(int route, int64_t ntext, int8_t *text);

/* Assembles the start of one case: info[PM_CHECK_COLUMNS], number[PM_CHECK_NUMBERS], pose[nbody][3] (x, y, angle),
 * velocity[nbody][3]; joint[njoint], contact[ncontact], 0 before: the number of the group of joints and contacts that share
 * their loads since some of them are redundant, or 0.  Returns a status of the case. */
int pm_check(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             const double *param, const int32_t *stop, int32_t *info, double *number, int64_t nbody,
             double *pose, double *velocity, int64_t njoint, int32_t *joint, int64_t ncontact,
             int32_t *contact, int32_t *where, double *detail);

/* Text of a status, at most ntext-1 characters and a zero; returns its length. */
int pm_status_text(int status, int64_t ntext, int8_t *text);

#endif

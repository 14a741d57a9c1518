/* planemotion.h - the public face of the kernel: rigid bodies in plane motion.
 *
 * A scene arrives as flat integer tables plus constants (pm_model_create); a case is a vector of
 * parameters; a run gives numbers for the questions ("asks") of the scene.  SI units and radians only.
 *
 * Every number of a scene (a mass, a coordinate, a coefficient) is an entry of the case's *value table*:
 * value[i] is computed by a program (postfix code) from the parameters and from values of lower index.
 * In the tables below a column named `..._value` holds an index into the value table, `..._program` an
 * index of a program that is run on the current state, `body` a body index (PM_GROUND = ground).
 *
 * The constants of this file are read by kernel/layout.py, so that Python uses the same numbers.
 */
#ifndef PLANEMOTION_H
#define PLANEMOTION_H

#include <stdint.h>

#define PM_GROUND (-1)
#define PM_NONE (-2)

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
    PM_FIND_SEVERAL =
        6, /* the first of several is the answer: where = condition; detail = the next, how many */
    PM_FIND_AT_BOUND =
        7,            /* what is sought lies at a bound of the interval, or where runs begin to fail: where =
                             varied parameter; detail = its value */
    PM_UNDECIDED = 8, /* the run came to its end, but its errors might have changed a decision on the way */
    PM_ENDS_SINGULAR =
        9, /* on the way a position was reached where nothing tells how it goes on: where = joint */
    PM_NO_TIME_ROUTE =
        10, /* a route in time was asked for and no time passes; all answers stand: where = setting */
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
    PM_CONTACT_SLOTS = -14, /* more members of one row are closed at once than the kernel keeps */
    PM_FIND_NONE = -15,     /* nothing found: where = condition or find; detail = what it is at both bounds */
    PM_FIND_JUMP = -16, /* the condition jumps over zero: where = condition; detail = value on both sides */
    PM_BLOWS_ENDLESS =
        -17, /* blows one by one at one instant do not end: where = contact; detail = how many */
    PM_BLOW_GAINS =
        -18, /* the law of a blow with friction would create energy: where = contact; detail = J, bound */
    PM_BLOW_SEVERAL =
        -19, /* the law is for one contact at a time: where = contact; detail = how many take part */
    PM_NO_IMPULSE =
        -20, /* no impulse does that work: where = action; detail = work, the least that is possible */
    PM_BLOW_TURNS =
        -21, /* a slip turns in a blow of several contacts: where = contact; detail = m/s after it */
    PM_NUDGE_UNSTEADY =
        -22, /* where it acts there is neither rest nor a steady motion: where = action, or setting */
    PM_NUDGE_STABLE =
        -23 /* nothing that it could begin grows: where likewise; detail = rate of what grows otherwise, 1/s */
};

/* ---- tables ---------------------------------------------------------------------------------------
 * `table` is one int32 array: first a directory of PM_TABLES pairs (offset, rows), in the order of
 * enum pm_table, then the tables row by row, each with the number of columns given by its enum. */
enum pm_table {
    PM_TABLE_CODE = 0,    /* pm_code_column: instructions of all programs */
    PM_TABLE_PROGRAM = 1, /* pm_program_column: first instruction and length of each program */
    PM_TABLE_VALUE = 2,   /* pm_value_column: the program of each value, in order of evaluation */
    PM_TABLE_BODY = 3,
    PM_TABLE_POINT = 4,
    PM_TABLE_LINE = 5,
    PM_TABLE_CIRCLE = 6,
    PM_TABLE_ROW = 7, /* periodic rows of points */
    PM_TABLE_JOINT = 8,
    PM_TABLE_CONTACT = 9,
    PM_TABLE_FORCE = 10,
    PM_TABLE_MEASURE = 11,
    PM_TABLE_START = 12,
    PM_TABLE_TRIGGER = 13,
    PM_TABLE_EVENT = 14, /* pm_event_column: one row per named event */
    PM_TABLE_UNTIL = 15,
    PM_TABLE_ASK = 16,
    PM_TABLE_SETTING = 17, /* one row: pm_setting_column */
    PM_TABLE_FIND = 18,    /* one row where parameters are sought: pm_find_column; none otherwise */
    PM_TABLE_VARY = 19,
    PM_TABLE_CONDITION = 20,
    PM_TABLE_SPIN = 21,   /* one row where the plane of the scene turns about an axis in it: pm_spin_column */
    PM_TABLE_SECOND = 22, /* then one row per body: pm_second_column */
    PM_TABLE_ACTION = 23, /* what events do */
    PM_TABLES = 24
};

/* ---- programs -------------------------------------------------------------------------------------
 * A stack machine on doubles.  Comparisons and logic give 1 or 0.  Binary operators take the value below
 * the top as their left operand. */
enum pm_op {
    PM_OP_CONSTANT = 0,  /* push constant[arg] */
    PM_OP_PARAMETER = 1, /* push parameter[arg] of the case */
    PM_OP_VALUE = 2,     /* push value[arg] */
    PM_OP_MEASURE = 3,   /* push measure arg of the current state (not allowed in values) */
    PM_OP_ADD = 4,
    PM_OP_SUB = 5,
    PM_OP_MUL = 6,
    PM_OP_DIV = 7,
    PM_OP_POW = 8,
    PM_OP_NEG = 9,
    PM_OP_LT = 10,
    PM_OP_LE = 11,
    PM_OP_GT = 12,
    PM_OP_GE = 13,
    PM_OP_EQ = 14,
    PM_OP_NE = 15,
    PM_OP_AND = 16,
    PM_OP_OR = 17,
    PM_OP_NOT = 18,
    PM_OP_SIN = 19,
    PM_OP_COS = 20,
    PM_OP_TAN = 21,
    PM_OP_ASIN = 22,
    PM_OP_ACOS = 23,
    PM_OP_ATAN2 = 24,
    PM_OP_SQRT = 25,
    PM_OP_ABS = 26,
    PM_OP_MIN = 27,
    PM_OP_MAX = 28,
    PM_OP_EXP = 29,
    PM_OP_LOG = 30,
    PM_OP_HYPOT = 31, /* sqrt(a^2 + b^2) */
    PM_OP_FLOOR = 32,
    PM_OP_SELECT = 33, /* c a b -> a if c != 0, else b */
    PM_OP_ATAN = 34,
    PM_OP_ANSWER = 35, /* push out[arg], answered before (only in the programs of a find) */
    PM_OPS = 36
};
#define PM_MAX_TIME 1000 /* s: limit of runs for which none is set */
#define PM_STACK 64      /* greatest depth of the stack */
enum pm_code_column { PM_CODE_OP = 0, PM_CODE_ARG = 1, PM_CODE_COLUMNS = 2 };
enum pm_program_column { PM_PROGRAM_FIRST = 0, PM_PROGRAM_LENGTH = 1, PM_PROGRAM_COLUMNS = 2 };
enum pm_value_column { PM_VALUE_PROGRAM = 0, PM_VALUE_COLUMNS = 1 };

/* ---- bodies and marks -------------------------------------------------------------------------------
 * A body's coordinates are (x, y, angle) of its mass centre G.  x, y, angle are the pose as drawn: the
 * assembly keeps what the start table fixes and moves the rest.  Points are given in body axes from G (of
 * the ground: scene coordinates). */
enum pm_body_column {
    PM_BODY_TURNS = 0,   /* 0: a particle, its angle stays 0 */
    PM_BODY_MASS = 1,    /* value index, >= 0; 0 where rows determine the motion all the same */
    PM_BODY_INERTIA = 2, /* value index, centroidal, >= 0 if the body turns */
    PM_BODY_X = 3,       /* value indices of the pose of G as drawn */
    PM_BODY_Y = 4,
    PM_BODY_ANGLE = 5,
    PM_BODY_COLUMNS = 6
};
enum pm_point_column { PM_POINT_BODY = 0, PM_POINT_X = 1, PM_POINT_Y = 2, PM_POINT_COLUMNS = 3 };
/* A line through a point, at `angle` from the body's x axis; its free side is on its left. */
enum pm_line_column { PM_LINE_POINT = 0, PM_LINE_ANGLE = 1, PM_LINE_COLUMNS = 2 };
/* A circle round a point; radius value >= 0 (0: the point itself). */
enum pm_circle_column { PM_CIRCLE_POINT = 0, PM_CIRCLE_RADIUS = 1, PM_CIRCLE_COLUMNS = 2 };
/* Members point + k*(step_x, step_y) in the axes of the point's body, k = 0 .. count-1; count < 0: endless
 * both ways. */
enum pm_row_column {
    PM_ROW_POINT = 0,
    PM_ROW_STEP_X = 1,
    PM_ROW_STEP_Y = 2,
    PM_ROW_COUNT = 3,
    PM_ROW_COLUMNS = 4
};

/* ---- joints: held both ways --------------------------------------------------------------------------- */
enum pm_joint_kind {
    PM_JOINT_PIN = 0,            /* a, b points: coincide.                                  2 rows */
    PM_JOINT_SLIDER = 1,         /* a point on line b.                                      1 row  */
    PM_JOINT_SLIDER_FIXED = 2,   /* the same, angle(a) - angle(b) = value held.             2 rows */
    PM_JOINT_LINK = 3,           /* a, b points at distance value > 0 (also: point in circular slot). 1 row */
    PM_JOINT_WELD = 4,           /* a, b points coincide and angle(a) - angle(b) = value.   3 rows */
    PM_JOINT_ROLLING_LINE = 5,   /* a circle rolls on line b, on its left.                  2 rows */
    PM_JOINT_ROLLING_CIRCLE = 6, /* a circle rolls on circle b; value = side (below).       2 rows */
    PM_JOINT_GEARS =
        7, /* a, b circles mesh at their pitch point; value = side; axles or a carrier keep their distance.  1 row */
    PM_JOINT_BELT = 8, /* a tight belt round circles a, b; value = 1 open, -1 crossed.     2 rows */
    PM_JOINT_RATE = 9, /* a, b bodies: the spin of a relative to b is program_x.           1 row  */
    PM_JOINT_DRIVE =
        10, /* a, b points: the velocity of a relative to b is program_x, program_y in the scene's axes.
                            2 rows */
    PM_JOINT_RATIO =
        11, /* a, b bodies: angle(a) - value angle(b) as at the start; the ground takes the couples'
                            difference.  1 row */
    PM_JOINT_KINDS = 12
};
/* side of two circles: 1 outside each other, -1 a inside b, -2 b inside a */
enum pm_joint_column {
    PM_JOINT_KIND = 0,
    PM_JOINT_A = 1,
    PM_JOINT_B = 2,
    PM_JOINT_VALUE = 3,
    PM_JOINT_PROGRAM_X = 4, /* of the time alone, or PM_NONE */
    PM_JOINT_PROGRAM_Y = 5,
    PM_JOINT_COLUMNS = 6
};

/* ---- contacts: push only ------------------------------------------------------------------------------ */
enum pm_contact_kind {
    PM_CONTACT_LINE = 0,   /* circle a (radius 0: a point) against line b */
    PM_CONTACT_CIRCLE = 1, /* circle a against circle b; side value as for rolling; not both radii 0 */
    PM_CONTACT_ROW = 2,    /* circle a (radius > 0) against the members of row b */
    PM_CONTACT_CORD =
        3, /* a straight strand from circle a (radius 0: a point) to circle b: pulls only, the gap is its
                            slack; it is wound on the circles and does not slip there */
    PM_CONTACT_POINT = 4, /* circles a, b of radius 0: points that meet from wherever; it must capture */
    PM_CONTACT_SEGMENT =
        5, /* circle a against line b between two places of it, and its ends; see the columns */
    PM_CONTACT_KINDS = 6
};
enum pm_friction { PM_FRICTION_SMOOTH = 0, PM_FRICTION_COULOMB = 1, PM_FRICTION_ROUGH = 2 };
/* What becomes of a pair that touches and does not part (two points: that meet). */
enum pm_capture {
    PM_CAPTURE_NONE = 0,
    PM_CAPTURE_POINT = 1, /* it stays as a pin at the place of contact */
    PM_CAPTURE_BODY = 2,  /* it stays as one body, as it arrived */
    PM_CAPTURES = 3
};
/* What restitution multiplies: the velocity of approach, the impulse of compression, (squared) its work. */
enum pm_law { PM_LAW_NEWTON = 0, PM_LAW_POISSON = 1, PM_LAW_STRONGE = 2, PM_LAWS = 3 };
enum pm_contact_column {
    PM_CONTACT_KIND = 0,
    PM_CONTACT_A = 1,
    PM_CONTACT_B = 2,
    PM_CONTACT_SIDE = 3,        /* value index (circle/circle) or PM_NONE */
    PM_CONTACT_RESTITUTION = 4, /* value index, 0..1 */
    PM_CONTACT_FRICTION = 5,    /* enum pm_friction */
    PM_CONTACT_STATIC = 6,      /* value index of the static coefficient, PM_NONE unless Coulomb */
    PM_CONTACT_KINETIC = 7,     /* value index of the kinetic coefficient, PM_NONE unless Coulomb */
    PM_CONTACT_SPEED =
        8, /* program of the time alone: speed of the surface of b along its line (as a line: towards its
                               angle); or PM_NONE */
    PM_CONTACT_SLACK = 9, /* cord: value index, slack at the start, >= 0; or PM_NONE */
    PM_CONTACT_SENSE_A =
        10, /* cord: +1 if one passes the circle counterclockwise going from a to b, -1 clockwise */
    PM_CONTACT_SENSE_B = 11,
    PM_CONTACT_CAPTURE = 12, /* enum pm_capture; smooth, with no surface speed */
    PM_CONTACT_TANGENTIAL =
        13,              /* value index, 0..1: restitution of the slip where it can be held; or PM_NONE */
    PM_CONTACT_LAW = 14, /* enum pm_law */
    PM_CONTACT_FROM =
        15, /* segment: value indices, places on the line from its point, from < to; or PM_NONE */
    PM_CONTACT_TO = 16,
    PM_CONTACT_COLUMNS = 17
};

/* ---- forces --------------------------------------------------------------------------------------------- */
enum pm_force_kind {
    PM_FORCE_SPRING = 0,  /* points a, b; value_1 stiffness, value_2 free length; option: pm_spring_only */
    PM_FORCE_TORSION = 1, /* bodies a, b; value_1 stiffness, value_2 free angle(a) - angle(b) */
    PM_FORCE_DAMPER = 2,  /* points a, b; value_1 rate of (N s/m) the change of distance */
    PM_FORCE_ROTARY_DAMPER = 3, /* bodies a, b; value_1 rate (N m s/rad) */
    PM_FORCE_APPLIED = 4,       /* at point a: program_x, program_y, in the axes of body b (ground: scene) */
    PM_FORCE_COUPLE = 5,        /* on body a, opposite on body b (PM_GROUND: none): program_x */
    PM_FORCE_FRICTION =
        6, /* dry friction of joint a (= b): a pin, a slider, or a link as a slot; a couple or a force up to
                                   value_1 + value_2 * its reaction */
    PM_FORCE_KINDS = 7
};
enum pm_spring_only { PM_SPRING_BOTH = 0, PM_SPRING_PULL = 1, PM_SPRING_PUSH = 2 };
enum pm_force_column {
    PM_FORCE_KIND = 0,
    PM_FORCE_A = 1,
    PM_FORCE_B = 2,
    PM_FORCE_VALUE_1 = 3,
    PM_FORCE_VALUE_2 = 4,
    PM_FORCE_PROGRAM_X = 5,
    PM_FORCE_PROGRAM_Y = 6,
    PM_FORCE_OPTION = 7,
    PM_FORCE_COLUMNS = 8
};

/* ---- measures: what can be read off a state --------------------------------------------------------------
 * `a` is a body, point, joint, contact, force or event index as the kind says.  Vector kinds take a part.
 * `in_body`: the quantity as seen from a moving body, in its axes (PM_NONE: scene).  `about`: point index
 * (PM_NONE: the body's own G; scene: the origin).  `on`: body on which a joint's force acts (PM_NONE: the first
 * partner).  `value`: value index of the direction angle of part ALONG.  `member`: of a row (PM_NONE: all). */
enum pm_measure_kind {
    PM_MEASURE_TIME = 0,
    PM_MEASURE_ANGLE = 1,             /* body a; in_body: relative angle */
    PM_MEASURE_TURNED = 2,            /* body a: angle since the start */
    PM_MEASURE_OMEGA = 3,             /* body a; in_body: relative */
    PM_MEASURE_ALPHA = 4,             /* body a */
    PM_MEASURE_MASS = 5,              /* body a, PM_NONE: all bodies */
    PM_MEASURE_WEIGHT = 6,            /* body a, PM_NONE: all bodies: mass times |gravity| */
    PM_MEASURE_INERTIA = 7,           /* body a, about G or `about` */
    PM_MEASURE_KINETIC = 8,           /* body a, PM_NONE: all bodies */
    PM_MEASURE_MOMENTUM = 9,          /* vector; body a, PM_NONE: all bodies */
    PM_MEASURE_ANGULAR_MOMENTUM = 10, /* body a about G or `about`; all: the origin or `about` */
    PM_MEASURE_POLE = 11,             /* vector: instantaneous centre of body a */
    PM_MEASURE_POSITION = 12,         /* vector: point a; in_body */
    PM_MEASURE_MOVED = 13,            /* vector: point a since the start */
    PM_MEASURE_PATH = 14,             /* distance travelled by point a */
    PM_MEASURE_VELOCITY = 15,         /* vector: point a; in_body */
    PM_MEASURE_ACCELERATION = 16,     /* vector: point a */
    PM_MEASURE_JOINT_FORCE = 17,      /* vector */
    PM_MEASURE_JOINT_COUPLE = 18,
    PM_MEASURE_JOINT_IMPULSE = 19,         /* vector, of the last jump */
    PM_MEASURE_JOINT_NORMAL = 20,          /* rolling: > 0 pushes */
    PM_MEASURE_JOINT_FRICTION = 21,        /* rolling: along the line, or left of the normal on a */
    PM_MEASURE_JOINT_FRICTION_NEEDED = 22, /* |F|/N; undefined (not a number) unless N > 0 */
    PM_MEASURE_CONTACT_GAP = 23,
    PM_MEASURE_CONTACT_CLOSED = 24, /* 1 or 0; a row without member: how many are closed */
    PM_MEASURE_CONTACT_SLIP = 25,
    PM_MEASURE_CONTACT_NORMAL = 26, /* sum over the closed members; 0 when open */
    PM_MEASURE_CONTACT_FRICTION = 27,
    PM_MEASURE_CONTACT_FRICTION_NEEDED = 28, /* greatest |F|/N over the closed members; 0 when open */
    PM_MEASURE_CONTACT_FORCE = 29,           /* vector, on a's body */
    PM_MEASURE_CONTACT_IMPULSE = 30,         /* vector, on a's body, of the last jump */
    PM_MEASURE_FORCE_FORCE = 31,             /* vector: on a's body */
    PM_MEASURE_FORCE_COUPLE = 32,
    PM_MEASURE_FORCE_WORK = 33, /* since the start */
    PM_MEASURE_FORCE_POWER = 34,
    PM_MEASURE_FORCE_STRETCH = 35,
    PM_MEASURE_FORCE_ENERGY = 36,
    PM_MEASURE_EVENT_COUNT = 37,
    PM_MEASURE_EVENT_TIME = 38, /* of the last firing; undefined before the first */
    PM_MEASURE_POTENTIAL = 39,  /* of weight and springs; weight is zero at the scene's origin */
    PM_MEASURE_TOTAL = 40,      /* kinetic + potential */
    PM_MEASURE_LOST = 41,       /* kinetic energy lost in the last jump */
    PM_MEASURE_SPIN_OMEGA = 42, /* of the plane about its axis */
    PM_MEASURE_SPIN_ANGLE = 43,
    PM_MEASURE_SPIN_MOMENTUM = 44,
    PM_MEASURE_SPIN_INERTIA = 45, /* of all that turns along, about the axis */
    PM_MEASURE_KINDS = 46
};
enum pm_part {
    PM_PART_NONE = 0,
    PM_PART_X = 1,
    PM_PART_Y = 2,
    PM_PART_NORM = 3,
    PM_PART_ANGLE = 4, /* direction, in (-pi, pi] */
    PM_PART_ALONG = 5,
    PM_PARTS = 6
};
enum pm_measure_column {
    PM_MEASURE_KIND = 0,
    PM_MEASURE_A = 1,
    PM_MEASURE_PART = 2,
    PM_MEASURE_IN = 3,
    PM_MEASURE_ON = 4,
    PM_MEASURE_ABOUT = 5,
    PM_MEASURE_VALUE = 6,
    PM_MEASURE_MEMBER = 7,
    PM_MEASURE_COLUMNS = 8
};

/* ---- spin -------------------------------------------------------------------------------------------------
 * The plane turns freely about an axis in it, through (x, y) at an angle; `inertia` is that of whatever else turns along;
 * `omega` its rate at the start; `couple` a program, or PM_NONE. */
enum pm_spin_column {
    PM_SPIN_X = 0, /* value indices */
    PM_SPIN_Y = 1,
    PM_SPIN_ANGLE = 2,
    PM_SPIN_INERTIA = 3,
    PM_SPIN_OMEGA = 4,
    PM_SPIN_COUPLE = 5,
    PM_SPIN_COLUMNS = 6
};
/* Second moments of a body about G: integrals of x^2, y^2 (its own axes, the product zero) and z^2 (across the plane) over
 * its mass; value indices. */
enum pm_second_column { PM_SECOND_X = 0, PM_SECOND_Y = 1, PM_SECOND_Z = 2, PM_SECOND_COLUMNS = 3 };

/* ---- start ------------------------------------------------------------------------------------------------
 * One row per written start value: measure = value.  POSITION rows take ANGLE or POSITION (x, y, along),
 * VELOCITY rows OMEGA or VELOCITY (x, y, along).  What is not written: positions are moved as little as possible to
 * meet the joints; velocities follow from the joints, and are 0 for a body on its own. */
enum pm_start_level { PM_START_POSITION = 0, PM_START_VELOCITY = 1 };
enum pm_start_column { PM_START_LEVEL = 0, PM_START_MEASURE = 1, PM_START_VALUE = 2, PM_START_COLUMNS = 3 };

/* ---- events ------------------------------------------------------------------------------------------------
 * A trigger makes its event fire; several triggers may belong to one event. */
enum pm_trigger_kind {
    PM_TRIGGER_CROSS = 0, /* program goes through 0, either way; a zero that holds must first be left */
    PM_TRIGGER_RISE = 1,  /* program becomes > 0 */
    PM_TRIGGER_FALL = 2,  /* program becomes < 0 */
    PM_TRIGGER_EVERY = 3, /* program reaches an integer */
    PM_TRIGGER_START = 4,
    PM_TRIGGER_STRIKE = 5,       /* contact a */
    PM_TRIGGER_OPEN = 6,         /* contact a */
    PM_TRIGGER_SLIP = 7,         /* contact a starts to slide */
    PM_TRIGGER_STICK = 8,        /* contact a stops sliding */
    PM_TRIGGER_REST = 9,         /* a = body, or PM_NONE: all bodies are at rest and stay */
    PM_TRIGGER_JOINT_SLIP = 10,  /* joint a, which has friction, starts to slide */
    PM_TRIGGER_JOINT_STICK = 11, /* joint a stops sliding */
    PM_TRIGGER_KINDS = 12
};
enum pm_trigger_column {
    PM_TRIGGER_KIND = 0,
    PM_TRIGGER_EVENT = 1,
    PM_TRIGGER_PROGRAM = 2, /* or PM_NONE */
    PM_TRIGGER_A = 3,
    PM_TRIGGER_COLUMNS = 4
};
enum pm_event_column {
    PM_EVENT_NTH = 0, /* it fires only when its triggers do so for the nth time; 0: whenever they do */
    PM_EVENT_COLUMNS = 1
};
/* What an event does when it fires: its rows, in order.  What is added holds from then on, what is removed no longer;
 * velocities that then clash meet in a plastic blow.  Impulses that follow each other in the table act at once. */
enum pm_action_kind {
    PM_ACTION_ADD = 0,     /* row a of `table` */
    PM_ACTION_REMOVE = 1,  /* the same; without an event: it does not hold from the start on */
    PM_ACTION_IMPULSE = 2, /* at point a: program_x, program_y, in the scene's axes */
    PM_ACTION_ANGULAR = 3, /* on body a: program_x */
    PM_ACTION_WORK =
        4, /* the angular impulse on body a that does the work program_x and keeps the sense of rotation */
    PM_ACTION_NUDGE =
        5, /* an unstable rest or steady motion is left to the side where program_x becomes > 0 */
    PM_ACTION_KINDS = 6
};
enum pm_action_column {
    PM_ACTION_KIND = 0,
    PM_ACTION_EVENT = 1,     /* or PM_NONE */
    PM_ACTION_TABLE = 2,     /* PM_TABLE_JOINT, PM_TABLE_CONTACT or PM_TABLE_FORCE; PM_NONE for all others */
    PM_ACTION_A = 3,         /* PM_NONE for a nudge */
    PM_ACTION_PROGRAM_X = 4, /* or PM_NONE; reads no forces and no accelerations */
    PM_ACTION_PROGRAM_Y = 5,
    PM_ACTION_COLUMNS = 6
};
/* The run ends when for some group every row's event has fired `nth` times. */
enum pm_until_column { PM_UNTIL_GROUP = 0, PM_UNTIL_EVENT = 1, PM_UNTIL_NTH = 2, PM_UNTIL_COLUMNS = 3 };

/* ---- asks --------------------------------------------------------------------------------------------------- */
enum pm_ask_kind {
    PM_ASK_END = 0,   /* program at the end of the run, after its jump */
    PM_ASK_EVENT = 1, /* program at the nth firing of an event, before or after its jump */
    PM_ASK_MAX = 2,   /* greatest value of program over the run */
    PM_ASK_MIN = 3,
    PM_ASK_AT_MAX = 4, /* program where program_2 is greatest */
    PM_ASK_AT_MIN = 5,
    PM_ASK_GRID = 6, /* program where program_2 first equals each of `count` values from first_value on */
    PM_ASK_EACH = 7, /* program at each firing of an event, up to `count` of them */
    PM_ASK_KINDS = 8
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
    PM_REASON_INFINITE = 4   /* it grows without bound: the count of blows that add up in finite time, 1/0 */
};

/* ---- settings ----------------------------------------------------------------------------------------------- */
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
    PM_SIMULTANEOUS_KINDS = 2
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
    PM_SETTING_COLUMNS = 11
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
    PM_TRUST_MARGIN =
        0, /* least distance of a decision from its threshold over its error; infinite: none was taken */
    PM_TRUST_EXCESS =
        1, /* greatest error of an answer over what the accuracy asked allows; 1 or less: kept */
    PM_TRUSTS = 2
};
/* Where a case failed: table and row (PM_NONE if nowhere in particular) and numbers that belong to the message. */
enum pm_where_column { PM_WHERE_TABLE = 0, PM_WHERE_ROW = 1, PM_WHERE_MEMBER = 2, PM_WHERE_COLUMNS = 3 };
enum pm_detail_column { PM_DETAIL_VALUE = 0, PM_DETAIL_BOUND = 1, PM_DETAIL_TIME = 2, PM_DETAIL_COLUMNS = 3 };
enum pm_count_column {
    PM_COUNT_PHASES = 0,
    PM_COUNT_EVENTS = 1,
    PM_COUNT_JUMPS = 2,
    PM_COUNT_STEPS = 3,
    PM_COUNT_SOLVES = 4, /* saddle-point solutions */
    PM_COUNT_ROUTE = 5,  /* enum pm_route that ran: the costliest, if phases took several */
    PM_COUNT_RUNS =
        6, /* whole runs of the case: more than 1 in a find, whose last one the other counts are of */
    PM_COUNT_FOUND = 7, /* brackets of a find in which something was found; changes of an outcome */
    PM_COUNT_PASSES =
        8, /* of the case, the others for its errors; all other counts are of the one that answers */
    PM_COUNT_ROUTES = 9, /* sum of 2^route over all that ran */
    PM_COUNT_LEGS = 10,  /* legs that repeat one that was computed, and were passed over */
    PM_COUNT_COLUMNS = 11
};
/* What pm_check reports of the assembled start. */
enum pm_check_column {
    PM_CHECK_COORDINATES = 0,
    PM_CHECK_ROWS = 1,      /* joint and closed contact rows at the start */
    PM_CHECK_REDUNDANT = 2, /* rows that depend on others */
    PM_CHECK_FREEDOM = 3,   /* degrees of freedom */
    PM_CHECK_CLOSED = 4,    /* contacts closed at the start */
    PM_CHECK_COLUMNS = 5
};
enum pm_check_number {
    PM_CHECK_MOVED = 0,   /* greatest displacement by the assembly, m */
    PM_CHECK_SIZE = 1,    /* size of the scene, m */
    PM_CHECK_OPENING = 2, /* greatest residual after assembly, m */
    PM_CHECK_NUMBERS = 3
};

/* Runs cases first .. over `nworker` threads; every row of the results depends on its own parameters only.
 *   table[ntable], constant[nconstant]   the scene (see above)
 *   param[ncase][nparam]                 parameters of each case, SI
 *   stop[1]                              raised (non-zero) by another thread to end early; cases not begun get PM_CANCELLED
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

/* Runs one case as pm_batch does, but with all parameters as given (no find), and records it: one row (t, program values) at every accepted step, before and
 * after every event; `mark` is 0 for a step, 1 before an event, 2 after it.
 *   trace_program[ntrace]  programs to record;  history[cap][1 + ntrace], mark[cap];  needed[1]: rows wanted.
 * If needed > cap the first cap rows are there: call again with larger buffers. */
int pm_trace(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             const double *param, int64_t ntrace, const int32_t *trace_program, int64_t cap, double *history,
             int32_t *mark, int64_t *needed, int32_t *where, double *detail);

/* ---- phases of a run: which route computes each, and what it has to do ---- */
enum pm_phase_column {
    PM_PHASE_ROUTE = 0,
    PM_PHASE_RULE = 1,     /* of the planner, for pm_rule_text */
    PM_PHASE_UNKNOWNS = 2, /* coordinates that the route integrates or follows */
    PM_PHASE_LOOPS =
        3, /* rows of joints and contacts between them; all others these coordinates meet by themselves */
    PM_PHASE_ROWS = 4, /* rows of joints and closed contacts, redundant ones not counted */
    PM_PHASE_REDUNDANT = 5,
    PM_PHASE_FREEDOM = 6,
    PM_PHASE_WATCHED = 7, /* event functions */
    PM_PHASE_CLOCK = 8,   /* 1: the time is computed */
    PM_PHASE_DYNAMIC = 9, /* 1: accelerations and reactions are needed within it */
    PM_PHASE_STEPS = 10,
    PM_PHASE_LEGS = 11,      /* legs passed over before it */
    PM_PHASE_UNREACHED = 12, /* contacts that can never close (gap_bounds.h) */
    PM_PHASE_STILL = 13,     /* bodies that joints hold still (fixed_bodies.h) */
    PM_PHASE_SPARED =
        14, /* gaps that were not looked at in its steps, out of reach of them (gap_culling.h) */
    PM_PHASE_COLUMNS = 15
};
/* Runs one case as pm_trace does and tells its phases: phase[cap][PM_PHASE_COLUMNS], time[cap] of their begins, s
 * (not a number where the time is not computed); needed[1]: rows wanted.  most > 0: stops as the phase of that number
 * begins (its row is there).  Returns a status of the case; PM_CANCELLED where it was stopped. */
int pm_phases(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
              const double *param, int64_t most, int64_t cap, int32_t *phase, double *time, int64_t *needed,
              int32_t *where, double *detail);

/* Which rows of table `of` the answers of the scene depend on: needed[nrow], 1 or 0.  A run leaves the others out (a trace
 * and a check do not).  Returns PM_OK, PM_BAD_TABLE or PM_NO_MEMORY. */
int pm_needs(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             int of, int64_t nrow, int32_t *needed, int32_t *where, double *detail);

/* Why the planner chose a route, in English, of at most ntext bytes, not ended by 0; its length. */
int pm_rule_text(int rule, int64_t ntext, int8_t *text);

/* What a route (enum pm_route) can compute, likewise: for the message where it was asked for and declines. */
int pm_route_text(int route, int64_t ntext, int8_t *text);

/* Assembles the start of one case: info[PM_CHECK_COLUMNS], number[PM_CHECK_NUMBERS], pose[nbody][3] (x, y, angle),
 * velocity[nbody][3].  Returns a status of the case. */
int pm_check(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant, int64_t nparam,
             const double *param, int32_t *info, double *number, int64_t nbody, double *pose,
             double *velocity, int32_t *where, double *detail);

/* Text of a status, at most ntext-1 characters and a zero; returns its length. */
int pm_status_text(int status, int64_t ntext, int8_t *text);

#endif

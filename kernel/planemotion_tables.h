/* planemotion_tables.h - the tables of a scene: which columns each has, and the kinds that stand in them.
 *
 * Every number of a scene (a mass, a coordinate, a coefficient) is an entry of the case's *value table*: value[i] is computed by
 * a program (postfix code) from the parameters and from values of lower index.  A column named `..._value` holds an index
 * into the value table, `..._program` an index of a program that is run on the current state, `body` a body index
 * (PM_GROUND: the ground). */
#ifndef PLANEMOTION_TABLES_H
#define PLANEMOTION_TABLES_H

#include "planemotion_marks.h"
#include "planemotion_programs.h"

#define PM_GROUND (-1)
#define PM_NONE (-2)

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
    PM_TABLE_PATTERN = 7, /* patterns */
    PM_TABLE_CURVE = 8,
    PM_TABLE_JOINT = 9,
    PM_TABLE_CONTACT = 10,
    PM_TABLE_FORCE = 11,
    PM_TABLE_MEASURE = 12,
    PM_TABLE_START = 13,
    PM_TABLE_TRIGGER = 14,
    PM_TABLE_EVENT = 15, /* pm_event_column: one row per named event */
    PM_TABLE_UNTIL = 16,
    PM_TABLE_ASK = 17,
    PM_TABLE_SETTING = 18, /* one row: pm_setting_column */
    PM_TABLE_FIND = 19,    /* one row where parameters are sought: pm_find_column; none otherwise */
    PM_TABLE_VARY = 20,
    PM_TABLE_CONDITION = 21,
    PM_TABLE_SPIN = 22,   /* one row where the plane of the scene turns about an axis in it: pm_spin_column */
    PM_TABLE_SECOND = 23, /* then one row per body: pm_second_column */
    PM_TABLE_ACTION = 24, /* what events do */
    PM_TABLE_PIECEWISE = 25, /* pm_piecewise_column: tables of measured values, as piecewise polynomials */
    PM_TABLE_READING = 26,   /* pm_reading_column: where a table is read along the motion */
    PM_TABLES = 27
};

/* ---- joints: held both ways; at the end of a line: how many constraints ---------- */
enum pm_joint_kind {
    PM_JOINT_PIN = 0,            /* a, b points: coincide.                                  2 */
    PM_JOINT_SLIDER = 1,         /* a point on line b.                                      1  */
    PM_JOINT_SLIDER_FIXED = 2,   /* the same, angle(a) - angle(b) = value held.             2 */
    PM_JOINT_LINK = 3,           /* a, b points at distance value > 0 (also: point in circular slot). 1 */
    PM_JOINT_WELD = 4,           /* a, b points coincide and angle(a) - angle(b) = value.   3 */
    PM_JOINT_ROLLING_LINE = 5,   /* a circle rolls on line b, on its left.                  2 */
    PM_JOINT_ROLLING_CIRCLE = 6, /* a circle rolls on circle b; value = side (below).       2 */
    PM_JOINT_GEARS = 7, /* a, b circles mesh; value = side; axles or a carrier hold their distance.  1 */
    PM_JOINT_BELT = 8,  /* a tight belt round circles a, b; value = 1 open, -1 crossed.     2 */
    PM_JOINT_RATE = 9,  /* a, b bodies: the spin of a relative to b is program_x.           1  */
    /* a, b points: the velocity of a from b is (program_x, program_y), scene's axes. 2 */
    PM_JOINT_DRIVE = 10,
    PM_JOINT_RATIO = 11,     /* a, b bodies: angle(a) - value angle(b) stays; the ground holds the rest.  1 */
    PM_JOINT_PLACED = 12,    /* a, b points: a from b is (program_x, program_y) in the scene's axes.  2 */
    PM_JOINT_ANGLE = 13,     /* a, b bodies: angle(a) - angle(b) = program_x.  1 */
    PM_JOINT_LENGTH = 14,    /* a, b points at distance program_x > 0.  1 */
    PM_JOINT_PIN_ANGLE = 15, /* PIN, and ANGLE of its bodies.  3 */
    PM_JOINT_SLIDER_PLACE = 16,       /* SLIDER, and a is program_x along line b from its point.  2 */
    PM_JOINT_SLIDER_FIXED_PLACE = 17, /* SLIDER_FIXED, likewise.  3 */
    PM_JOINT_SLOT = 18,               /* a point on curve b: a slot, a bead on a wire.                    1 */
    PM_JOINT_TEETH = 19, /* GEARS by teeth: their flanks meet at the pressure angle value_2.          1 */
    PM_JOINT_RACK = 20,  /* a circle meshes with the teeth of line b, at the pressure angle value_2.      1 */
    PM_JOINT_ROLLING_CURVE = 21, /* a circle rolls on curve b, on its free side.                          2 */
    PM_JOINT_ROLLING_CURVES = 22, /* closed curve a rolls on curve b, each on the other's free side.      2 */
    /* BELT on axles whose distance is fixed; either strand carries value_2 at rest.  1 */
    PM_JOINT_BELT_GRIPS = 23,
    PM_JOINT_BELT_SLIPS = 24, /* the same; it drives by its PM_FORCE_FRICTION alone.  0 */
    PM_JOINT_KINDS = 25
};
/* side of two circles: 1 outside each other, -1 a inside b, -2 b inside a */
enum pm_joint_column {
    PM_JOINT_KIND = 0,
    PM_JOINT_A = 1,
    PM_JOINT_B = 2,
    PM_JOINT_VALUE = 3,
    PM_JOINT_PROGRAM_X = 4, /* prescribed rates or places: of the time alone, or PM_NONE */
    PM_JOINT_PROGRAM_Y = 5,
    /* value index: of what has teeth the pressure angle, 0 .. 60 degrees; of BELT_GRIPS, BELT_SLIPS a tension */
    PM_JOINT_VALUE_2 = 6,
    PM_JOINT_COLUMNS = 7
};

/* ---- contacts: push only ------------------------------------------------------------------------------ */
enum pm_contact_kind {
    PM_CONTACT_LINE = 0,    /* circle a (radius 0: a point) against line b */
    PM_CONTACT_CIRCLE = 1,  /* circle a against circle b; side value as for rolling; not both radii 0 */
    PM_CONTACT_PATTERN = 2, /* circle a (radius > 0) against the members of pattern b */
    /* a straight strand from circle a (radius 0: a point) to circle b: pulls only, the gap is its slack;
     * it is wound on the circles and does not slip there */
    PM_CONTACT_CORD = 3,
    PM_CONTACT_POINT = 4, /* circles a, b of radius 0: points that meet from wherever; it must capture */
    /* circle a against line b between two places of it, and its ends; see the columns */
    PM_CONTACT_SEGMENT = 5,
    PM_CONTACT_TEETH = 6, /* one flank of toothed wheels a, b with backlash; see the columns */
    PM_CONTACT_RACK = 7,  /* one flank of wheel a and the rack on line b, likewise */
    PM_CONTACT_CURVE = 8, /* circle a (radius 0: a point) against curve b, and its ends where it is open */
    /* curve a against curve b, and the ends of a where it is open (an edge: a straight curve) against b; what leaves
     * b by an end of that touches no more */
    PM_CONTACT_CURVES = 9,
    PM_CONTACT_KINDS = 10
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
/* Where it slips and no motion obeys the laws: the run ends (PM_PAINLEVE), or an impact without collision goes on. */
enum pm_painleve { PM_PAINLEVE_STOPS = 0, PM_PAINLEVE_STRIKES = 1, PM_PAINLEVE_KINDS = 2 };
enum pm_contact_column {
    PM_CONTACT_KIND = 0,
    PM_CONTACT_A = 1,
    PM_CONTACT_B = 2,
    PM_CONTACT_SIDE = 3,        /* value index (circle/circle, wheels) or PM_NONE */
    PM_CONTACT_RESTITUTION = 4, /* value index, 0..1 */
    PM_CONTACT_FRICTION = 5,    /* enum pm_friction */
    PM_CONTACT_STATIC = 6,      /* value index of the static coefficient, PM_NONE unless Coulomb */
    PM_CONTACT_KINETIC = 7,     /* value index of the kinetic coefficient, PM_NONE unless Coulomb */
    /* program of the time alone: speed of the surface of b along its line (as a line: towards its angle);
     * or PM_NONE */
    PM_CONTACT_SPEED = 8,
    PM_CONTACT_SLACK = 9, /* cord, flank: value index, slack or gap at the start, >= 0; or PM_NONE */
    /* cord: +1 if one passes the circle counterclockwise going from a to b, -1 clockwise;
     * flank: SENSE_A is 1 of the one that pushes a along its tangent, else -1 */
    PM_CONTACT_SENSE_A = 10,
    PM_CONTACT_SENSE_B = 11,
    PM_CONTACT_CAPTURE = 12, /* enum pm_capture; smooth, with no surface speed */
    /* value index, 0..1: restitution of the slip where it can be held; or PM_NONE */
    PM_CONTACT_TANGENTIAL = 13,
    PM_CONTACT_LAW = 14, /* enum pm_law */
    /* segment: value indices, places on the line from its point, from < to; or PM_NONE */
    PM_CONTACT_FROM = 15,
    PM_CONTACT_TO = 16,
    PM_CONTACT_PAINLEVE = 17, /* enum pm_painleve */
    /* value index, > 0: k of N = k x^n beside those of other contacts, n = PM_SETTING_EXPONENT; smooth, of
     * Stronge's law; or PM_NONE */
    PM_CONTACT_STIFFNESS = 18,
    PM_CONTACT_PRESSURE = 19, /* value index of the pressure angle of a flank; or PM_NONE */
    /* cord: circle that it lies on between a and b and may slip on, by its friction; or PM_NONE: one strand.  Then the
     * sense in which it passes that, and the value index of the full turns that it is wound beyond what is drawn */
    PM_CONTACT_RIM = 20,
    PM_CONTACT_SENSE_RIM = 21,
    PM_CONTACT_TURNS = 22,
    /* flank: value index of how far from where the pitch curves touch its teeth slide on each other, on an average, where
     * they have friction; or PM_NONE */
    PM_CONTACT_LEVER = 23,
    PM_CONTACT_COLUMNS = 24
};

/* ---- forces --------------------------------------------------------------------------------------------- */
enum pm_force_kind {
    /* points a, b; value_1 stiffness, value_2 free length; option: pm_spring_only, and then program_x: the side of its stretch, so
     * that a phase ends where it becomes slack or no longer is; or PM_NONE */
    PM_FORCE_SPRING = 0,
    PM_FORCE_TORSION = 1,       /* bodies a, b; value_1 stiffness, value_2 free angle(a) - angle(b) */
    PM_FORCE_DAMPER = 2,        /* points a, b; value_1 rate of (N s/m) the change of distance */
    PM_FORCE_ROTARY_DAMPER = 3, /* bodies a, b; value_1 rate (N m s/rad) */
    PM_FORCE_APPLIED = 4,       /* at point a: program_x, program_y, in the axes of body b (ground: scene) */
    PM_FORCE_COUPLE = 5,        /* on body a, opposite on body b (PM_GROUND: none): program_x */
    /* dry friction of joint a (= b): a pin, a slider, a link as a slot, gears, or a belt; a couple or a force
     * up to value_1 + value_2 * its reaction */
    PM_FORCE_FRICTION = 6,
    PM_FORCE_LINE = 7, /* points a, b: program_x draws them together along their connection */
    PM_FORCE_KINDS = 8
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
 * partner).  `value`: value index of the direction angle of part ALONG.  `member`: of a pattern (PM_NONE: all). */
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
    PM_MEASURE_JOINT_IMPULSE = 19, /* vector, of the last jump */
    PM_MEASURE_JOINT_NORMAL = 20,  /* rolling: > 0 pushes; belt: what its first strand carries */
    /* rolling: along the line, or left of the normal on a; belt: what its second strand carries */
    PM_MEASURE_JOINT_FRICTION = 21,
    PM_MEASURE_JOINT_FRICTION_NEEDED = 22, /* |F|/N; undefined (not a number) unless N > 0 */
    PM_MEASURE_CONTACT_GAP = 23,
    PM_MEASURE_CONTACT_CLOSED = 24, /* 1 or 0; a pattern without member: how many are closed */
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
    PM_MEASURE_FORCE_RATE = 46,   /* d/dt of its stretch */
    /* of PM_EFFECT_SWITCH: 1 from where its program became > 0, 0 from where it became < 0; of
     * PM_EFFECT_PIECE: the piece in which its argument lies */
    PM_MEASURE_EVENT_SIDE = 47,
    PM_MEASURE_JOINT_POWER = 48, /* of what drives the joint: its reactions times the rates prescribed */
    PM_MEASURE_PLACE = 49,       /* s of a curve: in its programs alone */
    PM_MEASURE_MODE_OMEGA = 50, /* of small motion: mode number `member`, from 1; in asks at instants alone */
    PM_MEASURE_MODE_DAMPING = 51,
    PM_MEASURE_MODES_COUNT = 52,
    PM_MEASURE_MODES_GROWTH = 53,   /* > 0: small motion grows */
    PM_MEASURE_CONTACT_COUPLE = 54, /* of what is captured as one body, of friction of teeth; 0 of all else */
    /* of a cord over a rim, of its strand number `member`, 0 or 1: what pulls there, and in the last jump */
    PM_MEASURE_CONTACT_TENSION = 55,
    PM_MEASURE_CONTACT_TENSION_IMPULSE = 56,
    PM_MEASURE_JOINT_SLIP = 57, /* of what has friction: along it, m/s or rad/s */
    PM_MEASURE_KINDS = 58
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
    PM_EVENT_NTH = 0,    /* it fires only when its triggers do so for the nth time; 0: whenever they do */
    PM_EVENT_EFFECT = 1, /* enum pm_event_effect */
    PM_EVENT_COLUMNS = 2
};
enum pm_event_effect {
    PM_EFFECT_NONE = 0,   /* on what acts on the bodies, but by actions of the event */
    PM_EFFECT_COUNT = 1,  /* programs of forces read its count or time: a phase ends, another begins */
    PM_EFFECT_SWITCH = 2, /* programs of forces read its side: two triggers, rise and fall of one program */
    /* programs read a table along the motion (PM_TABLE_READING): its triggers are the ends of a piece */
    PM_EFFECT_PIECE = 3,
    PM_EFFECTS = 4
};
/* What an event does when it fires: its rows, in order.  What is added holds from then on, what is removed no longer;
 * velocities that then clash meet in a plastic blow.  Impulses that follow each other in the table act at once. */
enum pm_action_kind {
    PM_ACTION_ADD = 0,     /* row a of `table` */
    PM_ACTION_REMOVE = 1,  /* the same; without an event: it does not hold from the start on */
    PM_ACTION_IMPULSE = 2, /* at point a: program_x, program_y, in the scene's axes */
    PM_ACTION_ANGULAR = 3, /* on body a: program_x */
    /* the angular impulse on body a that does the work program_x and keeps the sense of rotation */
    PM_ACTION_WORK = 4,
    /* an unstable rest or steady motion is left to the side where program_x becomes > 0 */
    PM_ACTION_NUDGE = 5,
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

#endif

/* planemotion_programs.h - the programs of a scene and the tables that they read: operations of the postfix code, piecewise
 * polynomials. */
#ifndef PLANEMOTION_PROGRAMS_H
#define PLANEMOTION_PROGRAMS_H

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
    /* push out[arg], answered before (only in programs of asks at the end, and of a find) */
    PM_OP_ANSWER = 35,
    PM_OP_TANH = 36,
    PM_OP_PIECEWISE = 37, /* x -> piecewise polynomial arg at x */
    PM_OP_PIECE = 38,     /* x n -> its piece n at x, and beyond the ends of that piece */
    PM_OP_KNOT = 39,      /* n -> where its piece n begins; PM_BEYOND_KNOTS where there is no such knot */
    PM_OPS = 40
};
#define PM_MAX_TIME 1000 /* s: limit of runs for which none is set */
#define PM_STACK 64      /* greatest depth of the stack */
enum pm_code_column { PM_CODE_OP = 0, PM_CODE_ARG = 1, PM_CODE_COLUMNS = 2 };
enum pm_program_column { PM_PROGRAM_FIRST = 0, PM_PROGRAM_LENGTH = 1, PM_PROGRAM_COLUMNS = 2 };
enum pm_value_column { PM_VALUE_PROGRAM = 0, PM_VALUE_COLUMNS = 1 };

/* ---- piecewise polynomials --------------------------------------------------------------------------
 * Piece n = 0 .. knots - 2 lies between knot n and knot n + 1 and is c[0] + c[1] u + .. + c[degree] u^degree, u = x - knot n.
 * From constant[first] on stand the knots, which increase, then the coefficients of each piece.  Piece -1 lies below them,
 * piece knots - 1 above; where it repeats, pieces are numbered on both ways. */
#define PM_BEYOND_KNOTS 1e100 /* no argument is larger */
#define PM_PIECEWISE_DEGREE 3 /* the highest */
enum pm_beyond {
    PM_BEYOND_NONE = 0,   /* no value: a run ends where a force or a drive reads it (PM_TABLE_ENDS) */
    PM_BEYOND_HOLD = 1,   /* the value of the end */
    PM_BEYOND_EXTEND = 2, /* the straight line with the slope of the end */
    PM_BEYOND_REPEAT = 3, /* the same over and over */
    PM_BEYOND_ZERO = 4,   /* 0 */
    PM_BEYOND_KINDS = 5
};
enum pm_piecewise_column {
    PM_PIECEWISE_FIRST = 0,
    PM_PIECEWISE_KNOTS = 1, /* 2 or more */
    PM_PIECEWISE_DEGREE_OF = 2,
    PM_PIECEWISE_BEYOND = 3, /* enum pm_beyond */
    PM_PIECEWISE_COLUMNS = 4
};
/* The measure EVENT_SIDE of an event with PM_EFFECT_PIECE is the piece in which x lies: it holds for a phase. */
enum pm_reading_column {
    PM_READING_EVENT = 0,
    PM_READING_TABLE = 1,   /* row of PM_TABLE_PIECEWISE */
    PM_READING_PROGRAM = 2, /* x */
    PM_READING_COLUMNS = 3
};

#endif

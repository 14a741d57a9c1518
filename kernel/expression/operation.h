/* operation.h - the operations of programs in one table, and the one walk over a program's code.
 *
 * Code is postfix: an operation takes its operands off a stack and leaves one result there.  Whoever reads a program, for its
 * value, its rate, its degree or its class, keeps a stack of what it reads, of any type, and goes along the code:
 *     for (pm_program_walk x = pm_program_walk_begin(m, program); pm_program_walk_next(&x);)
 *         stack[x.at] = the result of x.op, from the x.takes operands stack[x.at], stack[x.at + 1] ..
 * What the program leaves is stack[0]. */
#ifndef PM_OPERATION_H
#define PM_OPERATION_H

#include "state/model.h"

/* What is known of an operation besides its value. */
enum pm_operation_trait {
    PM_OPERATION_JUMPS = 1, /* a comparison: jumps where its operands become equal */
    /* smooth but where its operand, or the difference of its operands, changes sign */
    PM_OPERATION_CORNERS = 2,
    PM_OPERATION_COUNTS = 4, /* gives an integer, or a yes or no */
    PM_OPERATION_RISES = 8   /* a rising function of its operand */
};

typedef struct pm_operation {
    unsigned char takes;           /* operands: 0, 1, 2, 3 */
    unsigned char traits;          /* of enum pm_operation_trait */
    double (*one)(double);         /* its value, by how many operands it takes; the choice has none */
    double (*two)(double, double); /* left and right operand */
} pm_operation;

extern const pm_operation pm_operations[PM_OPS];

/* It reads the piecewise polynomial `arg` (expression/piecewise.h): its value depends on more than its operands. */
static inline int pm_operation_of_table(int op) { return op >= PM_OP_PIECEWISE && op <= PM_OP_KNOT; }
static inline int pm_operation_has(int op, int traits) { return (pm_operations[op].traits & traits) != 0; }

/* A walk, at the instruction that pm_program_walk_next has come to. */
typedef struct pm_program_walk {
    const pm_model *m;
    const int32_t *next, *end; /* of the code */
    int op, arg, takes;
    int at; /* where on the stack its operands begin, and its result belongs */
} pm_program_walk;

/* A part of the code; a program. */
static inline pm_program_walk pm_program_walk_part(const pm_model *m, int first, int length)
{
    const int32_t *code = pm_model_row(m, PM_TABLE_CODE, first, PM_CODE_COLUMNS);
    return (pm_program_walk){
        .m = m, .next = code, .end = code + length * PM_CODE_COLUMNS, .takes = 0, .at = -1};
}

static inline pm_program_walk pm_program_walk_begin(const pm_model *m, int program)
{
    const int32_t *e = pm_model_row(m, PM_TABLE_PROGRAM, program, PM_PROGRAM_COLUMNS);
    return pm_program_walk_part(m, e[PM_PROGRAM_FIRST], e[PM_PROGRAM_LENGTH]);
}

/* Goes on to the next instruction of valid code; 0 where it ends. */
static inline int pm_program_walk_next(pm_program_walk *x)
{
    if (x->next == x->end) return 0;
    x->op = x->next[PM_CODE_OP];
    x->arg = x->next[PM_CODE_ARG];
    x->takes = pm_operations[x->op].takes;
    x->at += 1 - x->takes;
    x->next += PM_CODE_COLUMNS;
    return x->at >= 0; /* as it is in valid code */
}

/* What an instruction pushes that is a number of the case: a constant, a parameter, a value. */
static inline double pm_program_number(const pm_program_walk *x, const double *param, const double *value)
{
    if (x->op == PM_OP_CONSTANT) return x->m->constant[x->arg];
    return x->op == PM_OP_PARAMETER ? param[x->arg] : value[x->arg];
}

/* A program read for a class of it, a small integer: that of what an instruction without operands pushes, and of the result
 * of one and of two operands; a choice is two after each other.  `of` is the reader's own. */
typedef struct pm_program_rules {
    int (*read)(const pm_program_walk *x, const void *of);
    int (*one)(const pm_program_walk *x, int a);
    int (*two)(const pm_program_walk *x, int a, int b);
} pm_program_rules;

int pm_program_rules_apply(const pm_model *m, int program, const pm_program_rules *rules, const void *of);

/* The first measure that a program reads of which `is` holds; PM_NONE: it reads none. */
typedef int pm_measure_is(const pm_model *m, int measure);
int pm_program_walk_reads(const pm_model *m, int program, pm_measure_is *is);

#endif

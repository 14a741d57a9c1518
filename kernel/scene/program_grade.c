/* program_grade.c - what kind of function a program is: each entry of the stack carries its class instead of a number.
 *
 * With the kinetic energy T at a fixed place on a path (one degree of freedom) every velocity is c sqrt(T), every
 * acceleration and reaction a + b T: how a program goes with T follows from its measures.  The norm of a vector whose parts
 * are linear in T is convex; so is the ratio |F| / N of two linear forces with N > 0 quasi-convex: greatest at the ends of a
 * range of T. */
#include "scene/program_grade.h"

#include "elements/measure.h"
#include "expression/operation.h"
#include "expression/program_class.h"

/* The piece of a table in which its argument lies: beside that it tells nothing. */
static int is_of_piece(const pm_model *m, int measure)
{
    const int32_t *e = PM_MEASURE_ROW(m, measure);
    return e[PM_MEASURE_KIND] == PM_MEASURE_EVENT_SIDE &&
           PM_EVENT_ROW(m, e[PM_MEASURE_A])[PM_EVENT_EFFECT] == PM_EFFECT_PIECE;
}

/* ---- what it is a function of ---- */
static int read_class(const pm_program_walk *x, const void *none)
{
    (void)none;
    if (x->op != PM_OP_MEASURE) return x->op == PM_OP_ANSWER ? PM_CLASS_MOTION : PM_CLASS_CONSTANT;
    if (is_of_piece(x->m, x->arg)) return PM_CLASS_CONSTANT;
    const int kind = PM_MEASURE_ROW(x->m, x->arg)[PM_MEASURE_KIND];
    const int spins = kind == PM_MEASURE_SPIN_OMEGA || kind == PM_MEASURE_SPIN_MOMENTUM;
    return spins && x->m->spin_z != PM_NONE ? PM_CLASS_MOTION : pm_measure_kind(kind)->class;
}

/* Time stays linear under sums, and products and quotients with constants; places may be of_twod at will. */
static int of_two(const pm_program_walk *x, int a, int b)
{
    const int op = x->op;
    if (a == PM_CLASS_MOTION || b == PM_CLASS_MOTION) return PM_CLASS_MOTION;
    if (a != PM_CLASS_TIME && b != PM_CLASS_TIME) return a > b ? a : b;
    if (a == PM_CLASS_PLACE || b == PM_CLASS_PLACE) return PM_CLASS_MOTION;
    const int linear = op == PM_OP_ADD || op == PM_OP_SUB || (op == PM_OP_MUL && a != b) ||
                       (op == PM_OP_DIV && b == PM_CLASS_CONSTANT);
    return linear ? PM_CLASS_TIME : PM_CLASS_MOTION;
}

static int of_one(const pm_program_walk *x, int a)
{
    return a == PM_CLASS_TIME && x->op != PM_OP_NEG ? PM_CLASS_MOTION : a;
}

int pm_program_grade_class(const pm_model *m, int program)
{
    static const pm_program_rules rules = {read_class, of_one, of_two};
    return pm_program_rules_apply(m, program, &rules, NULL);
}

/* ---- how it goes with the kinetic energy ---- */
static int sum(int a, int b)
{
    if (a == PM_ENERGY_CLASS_NONE) return b == PM_ENERGY_CLASS_ROOT ? PM_ENERGY_CLASS_STEADY : b;
    if (b == PM_ENERGY_CLASS_NONE) return a == PM_ENERGY_CLASS_ROOT ? PM_ENERGY_CLASS_STEADY : a;
    if (a == b && (a == PM_ENERGY_CLASS_LINEAR || a == PM_ENERGY_CLASS_ROOT)) return a;
    return PM_ENERGY_CLASS_UNKNOWN;
}

static int product(int a, int b)
{
    if (a == PM_ENERGY_CLASS_NONE || b == PM_ENERGY_CLASS_NONE) {
        const int other = a == PM_ENERGY_CLASS_NONE ? b : a; /* the place's factor may be negative */
        return other >= PM_ENERGY_CLASS_CONVEX ? PM_ENERGY_CLASS_UNKNOWN : other;
    }
    return a == PM_ENERGY_CLASS_ROOT && b == PM_ENERGY_CLASS_ROOT ? PM_ENERGY_CLASS_LINEAR
                                                                  : PM_ENERGY_CLASS_UNKNOWN;
}

static int quotient(int a, int b)
{
    if (b == PM_ENERGY_CLASS_NONE) return product(a, b);
    return a == PM_ENERGY_CLASS_ROOT && b == PM_ENERGY_CLASS_ROOT ? PM_ENERGY_CLASS_NONE
                                                                  : PM_ENERGY_CLASS_UNKNOWN;
}

static int extreme(int a, int b, int kept)
{
    const int steady = a <= PM_ENERGY_CLASS_STEADY || a == kept;
    return steady && (b <= PM_ENERGY_CLASS_STEADY || b == kept) ? kept : PM_ENERGY_CLASS_UNKNOWN;
}

static int binary(const pm_program_walk *x, int a, int b)
{
    switch (x->op) {
    case PM_OP_ADD: return sum(a, b);
    case PM_OP_SUB:
        return b == PM_ENERGY_CLASS_CONVEX || b == PM_ENERGY_CLASS_CONCAVE ? PM_ENERGY_CLASS_UNKNOWN
                                                                           : sum(a, b);
    case PM_OP_MUL: return product(a, b);
    case PM_OP_DIV: return quotient(a, b);
    case PM_OP_MAX: return extreme(a, b, PM_ENERGY_CLASS_CONVEX);
    case PM_OP_MIN: return extreme(a, b, PM_ENERGY_CLASS_CONCAVE);
    default:
        return a == PM_ENERGY_CLASS_NONE && b == PM_ENERGY_CLASS_NONE ? PM_ENERGY_CLASS_NONE
                                                                      : PM_ENERGY_CLASS_UNKNOWN;
    }
}

static int unary(const pm_program_walk *x, int a)
{
    if (a == PM_ENERGY_CLASS_NONE || a == PM_ENERGY_CLASS_UNKNOWN) return a;
    if (pm_operation_has(x->op, PM_OPERATION_RISES))
        return a <= PM_ENERGY_CLASS_STEADY ? PM_ENERGY_CLASS_STEADY : a;
    switch (x->op) {
    case PM_OP_NEG:
        if (a == PM_ENERGY_CLASS_CONVEX) return PM_ENERGY_CLASS_CONCAVE;
        return a == PM_ENERGY_CLASS_CONCAVE ? PM_ENERGY_CLASS_CONVEX : a;
    case PM_OP_ABS:
        if (a == PM_ENERGY_CLASS_ROOT) return a;
        return a <= PM_ENERGY_CLASS_STEADY ? PM_ENERGY_CLASS_CONVEX : PM_ENERGY_CLASS_UNKNOWN;
    default: return PM_ENERGY_CLASS_UNKNOWN;
    }
}

static int read_energy(const pm_program_walk *x, const void *none)
{
    (void)none;
    if (x->op != PM_OP_MEASURE) return x->op == PM_OP_ANSWER ? PM_ENERGY_CLASS_UNKNOWN : PM_ENERGY_CLASS_NONE;
    if (is_of_piece(x->m, x->arg)) return PM_ENERGY_CLASS_NONE;
    const pm_measure_ops *ops = pm_measure_ops_of(x->m, x->arg);
    const int part = ops->vector ? PM_MEASURE_ROW(x->m, x->arg)[PM_MEASURE_PART] : PM_PART_NONE;
    if (part == PM_PART_NORM && ops->energy == PM_ENERGY_CLASS_LINEAR) return PM_ENERGY_CLASS_CONVEX;
    return part == PM_PART_ANGLE && ops->energy != PM_ENERGY_CLASS_NONE ? PM_ENERGY_CLASS_UNKNOWN
                                                                        : ops->energy;
}

int pm_program_grade_energy(const pm_model *m, int program)
{
    static const pm_program_rules rules = {read_energy, unary, binary};
    return pm_program_rules_apply(m, program, &rules, NULL);
}

/* ---- all programs ---- */
void pm_program_grade_all(pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_PROGRAM]; i++) {
        int level = PM_LEVEL_NONE;
        for (pm_program_walk x = pm_program_walk_begin(m, i); pm_program_walk_next(&x);)
            if (x.op == PM_OP_MEASURE && pm_measure_level(m, x.arg) > level)
                level = pm_measure_level(m, x.arg);
        m->programs.level[i] = (unsigned char)level;
        m->programs.class[i] = (unsigned char)pm_program_grade_class(m, i);
        m->programs.energy[i] = (unsigned char)pm_program_grade_energy(m, i);
    }
}

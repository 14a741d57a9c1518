/* program_energy.c - how programs change with the kinetic energy T at a fixed place on a path (one degree of freedom).
 *
 * There every velocity is c sqrt(T), every acceleration and reaction a + b T: a program's growth follows from its
 * measures by abstract interpretation.  The norm of a vector whose parts are linear in T is convex; so is the ratio |F| / N
 * of two linear forces with N > 0 quasi-convex: greatest at the ends of a range of T. */
#include "expression/program.h"
#include "expression/program_class.h"

static int of_vector(int part, int component, int norm)
{
    if (part == PM_PART_NORM) return norm;
    return part == PM_PART_ANGLE ? PM_ENERGY_CLASS_UNKNOWN : component;
}

static int measure_growth(const pm_model *m, int measure)
{
    const int32_t *e = PM_MEASURE_ROW(m, measure);
    const int part = e[PM_MEASURE_PART];
    switch ((enum pm_measure_kind)e[PM_MEASURE_KIND]) {
    case PM_MEASURE_ANGLE:
    case PM_MEASURE_TURNED:
    case PM_MEASURE_MASS:
    case PM_MEASURE_WEIGHT:
    case PM_MEASURE_INERTIA:
    case PM_MEASURE_POLE:
    case PM_MEASURE_POSITION:
    case PM_MEASURE_MOVED:
    case PM_MEASURE_PATH:
    case PM_MEASURE_CONTACT_GAP:
    case PM_MEASURE_CONTACT_CLOSED:
    case PM_MEASURE_FORCE_WORK:
    case PM_MEASURE_FORCE_STRETCH:
    case PM_MEASURE_FORCE_ENERGY:
    case PM_MEASURE_POTENTIAL:
    case PM_MEASURE_SPIN_OMEGA: /* this route is taken where no couple acts */
    case PM_MEASURE_SPIN_MOMENTUM:
    case PM_MEASURE_SPIN_INERTIA: return PM_ENERGY_CLASS_NONE;
    case PM_MEASURE_OMEGA:
    case PM_MEASURE_ANGULAR_MOMENTUM:
    case PM_MEASURE_CONTACT_SLIP:
    case PM_MEASURE_FORCE_POWER: return PM_ENERGY_CLASS_ROOT;
    case PM_MEASURE_MOMENTUM:
    case PM_MEASURE_VELOCITY: return of_vector(part, PM_ENERGY_CLASS_ROOT, PM_ENERGY_CLASS_ROOT);
    case PM_MEASURE_ALPHA:
    case PM_MEASURE_KINETIC:
    case PM_MEASURE_TOTAL:
    case PM_MEASURE_JOINT_COUPLE:
    case PM_MEASURE_JOINT_NORMAL:
    case PM_MEASURE_JOINT_FRICTION:
    case PM_MEASURE_CONTACT_NORMAL:
    case PM_MEASURE_CONTACT_FRICTION: return PM_ENERGY_CLASS_LINEAR;
    case PM_MEASURE_ACCELERATION:
    case PM_MEASURE_JOINT_FORCE:
    case PM_MEASURE_CONTACT_FORCE: return of_vector(part, PM_ENERGY_CLASS_LINEAR, PM_ENERGY_CLASS_CONVEX);
    case PM_MEASURE_JOINT_FRICTION_NEEDED:
    case PM_MEASURE_CONTACT_FRICTION_NEEDED: return PM_ENERGY_CLASS_CONVEX;
    default: return PM_ENERGY_CLASS_UNKNOWN;
    }
}

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

static int binary(int op, int a, int b)
{
    switch (op) {
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

static int unary(int op, int a)
{
    if (a == PM_ENERGY_CLASS_NONE || a == PM_ENERGY_CLASS_UNKNOWN) return a;
    switch (op) {
    case PM_OP_NEG:
        if (a == PM_ENERGY_CLASS_CONVEX) return PM_ENERGY_CLASS_CONCAVE;
        return a == PM_ENERGY_CLASS_CONCAVE ? PM_ENERGY_CLASS_CONVEX : a;
    case PM_OP_ABS:
        if (a == PM_ENERGY_CLASS_ROOT) return a;
        return a <= PM_ENERGY_CLASS_STEADY ? PM_ENERGY_CLASS_CONVEX : PM_ENERGY_CLASS_UNKNOWN;
    case PM_OP_SQRT:
    case PM_OP_ATAN:
    case PM_OP_EXP:
    case PM_OP_LOG: return a <= PM_ENERGY_CLASS_STEADY ? PM_ENERGY_CLASS_STEADY : a; /* rising functions */
    default: return PM_ENERGY_CLASS_UNKNOWN;
    }
}

int pm_program_energy_of(const pm_model *m, int program)
{
    int stack[PM_STACK], top = -1, length;
    const int32_t *code = pm_program_code(m, program, &length);
    for (int i = 0; i < length; i++, code += PM_CODE_COLUMNS) {
        const int op = code[PM_CODE_OP];
        if (op <= PM_OP_VALUE) {
            stack[++top] = PM_ENERGY_CLASS_NONE;
        } else if (op == PM_OP_MEASURE) {
            stack[++top] = measure_growth(m, code[PM_CODE_ARG]);
        } else if (op == PM_OP_ANSWER) {
            stack[++top] = PM_ENERGY_CLASS_UNKNOWN;
        } else if (op == PM_OP_SELECT) {
            top -= 2;
            const int all_still = stack[top] + stack[top + 1] + stack[top + 2] == 3 * PM_ENERGY_CLASS_NONE;
            stack[top] = all_still ? PM_ENERGY_CLASS_NONE : PM_ENERGY_CLASS_UNKNOWN;
        } else if (pm_program_operands(op) == 1) {
            stack[top] = unary(op, stack[top]);
        } else {
            top--;
            stack[top] = binary(op, stack[top], stack[top + 1]);
        }
    }
    return stack[0];
}

/* numbers.h - the numbers of one case: what its parameters make of the tables.
 *
 * equations/case.c fills them when a case begins; from then on only the speed scale grows.  SI and radians. */
#ifndef PM_NUMBERS_H
#define PM_NUMBERS_H

/* The axis about which the plane turns, and what the case says of it (elements/turning_plane.h). */
typedef struct pm_turning_plane {
    double through[2], angle;
    double normal[2]; /* to the left of the axis */
    double inertia;   /* of whatever else turns along */
    double momentum;  /* at the start */
} pm_turning_plane;

typedef struct pm_numbers {
    const double *param;       /* [nparam] of the case, in the caller's array */
    double *value;             /* [nvalue] */
    struct pm_case_plan *plan; /* which of them parameters reach (equations/case_values.h) */
    double *folded;            /* [fold->nnumber] of the programs: what stays the same throughout the case */
    int is_folded;             /* `folded` is worked out */
    double *mass;              /* [nbody] kg */
    double *inverse_mass;      /* [nq] 1/kg, 1/(kg m^2): diagonal of M^-1; 0: held (a particle's angle) */
    double *inverse_root;      /* [nq] its square root, but no more than PM_LIGHT_METRIC allows */
    unsigned char *light;      /* [nq] next to no inertia beside the heaviest body, of the scene's size */
    int light_any;
    int compared_by_mass; /* constraints are compared by the masses themselves: none is next to nothing */
    double *stand_in;     /* [nq] what stands for a mass or inertia of 0 in inverse_mass; else 0 */
    unsigned char *fixed; /* [nbody + 1] the body is fixed; last: the ground, which is */
    int massless;         /* some coordinate has such */
    double gravity[2];    /* m/s^2 */
    pm_turning_plane plane;
    struct pm_constraint *of_joint;   /* [njoint_constraint] constraints of all joints (elements/joint.h) */
    struct pm_constraint *of_contact; /* [ncontact] their normal constraints (elements/constraint.h) */
    struct pm_curve_course *course;   /* [ncurve] of curves that contacts touch (elements/curve_feet.h) */
    double size;                      /* m, length scale of the scene */
    double speed;                     /* m/s, speed scale; grows with the motion */
    double accuracy;                  /* relative, asked of the answers */
    double tolerance;                 /* relative, of integration */
    double coarse; /* factor on steps and on what counts as nothing: 1, more in a coarse run */
} pm_numbers;

/* The natural size of coordinate i of all bodies, m or rad. */
static inline double pm_numbers_length(const pm_numbers *numbers, int i)
{
    return i % 3 == 2 ? 1 : numbers->size;
}

#endif

/* joint.h - joints, and the couplings that hold both ways: one table of kinds. */
#ifndef PM_JOINT_H
#define PM_JOINT_H

#include "elements/constraint.h"

/* What the number of a joint (PM_JOINT_VALUE) is. */
enum pm_joint_number {
    PM_NUMBER_NONE = 0,
    PM_NUMBER_ANY = 1,    /* an angle, a sense */
    PM_NUMBER_LENGTH = 2, /* > 0 */
    PM_NUMBER_SIDE = 3    /* 1: circles outside each other, -1: a in b, -2: b in a */
};

/* When a shifted scene (symmetry.h) has the same joint. */
enum pm_joint_repeats {
    PM_REPEATS_NEVER = 0,   /* nobody has thought it through */
    PM_REPEATS_MARKS = 1,   /* its marks stay */
    PM_REPEATS_ROTATION = 2 /* its marks stay, and its bodies keep their relative angle */
};

/* One kind.  `compose` fills c[0 .. nconstraint), which come blank, from row e of the table of the joint. */
typedef struct pm_joint_ops {
    int a, b;     /* the tables of its partners */
    int number;   /* enum pm_joint_number */
    int programs; /* 0, 1 or 2 of prescribed rates or places */
    int nconstraint;
    int by_friction; /* 1: not the joint but its friction holds them, which slips where it is overcome */
    int memories;    /* so many of its last constraints keep an anchor */
    int feet;        /* 1: its constraints share the memory of a foot on a curve */
    int presses;     /* constraint 0 is a normal force */
    int strands;     /* 1: constraint 0 is a belt, each strand of which carries value_2 at rest */
    int flanks;      /* 1: teeth, of which one flank is loaded at a time (teeth.h); it has a pressure angle */
    int slip;        /* the kind of constraint along which it slips where it has friction, or PM_NONE */
    int repeats;     /* enum pm_joint_repeats */
    void (*compose)(const pm_frame *frame, const int32_t *e, pm_constraint *c);
} pm_joint_ops;

const pm_joint_ops *pm_joint_kind(int kind);
const pm_joint_ops *pm_joint_of(const pm_model *m, int joint);

/* The constraints of all joints, with the numbers of the case: pm_joint_constraints copies them. */
void pm_joint_compose(const pm_frame *frame);

#endif

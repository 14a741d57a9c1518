/* pair.h - two curves beside each other: where they are nearest, and all places where they may touch. */
#ifndef PM_PAIR_H
#define PM_PAIR_H

#include "elements/constraint.h"
#include "elements/curve_feet.h"

/* Two curves as the body of b sees them: the point of a from that of b in the axes of b, and how a is turned there. */
typedef struct pm_pair {
    const pm_frame *frame;
    int a, b; /* rows of the curves */
    double at[2], axis[2], angle;
} pm_pair;

/* Of the two curves of a constraint (pm_constraint_marks_curves), at the frame. */
pm_pair pm_pair_of(const pm_frame *frame, const pm_constraint *c);

/* Places of both that face each other, in the axes of b: t of a is -t of b, and p of a is at the height h on n of b.  `way` and
 * `closer` say how they go on (pair.c). */
typedef struct pm_pair_place {
    pm_curve_place a, b;
    double height;
    double closer; /* b_a + b_b - h b_a b_b, 1/m: negative where they touch at one place */
} pm_pair_place;

/* The places next to a.s and b.s, on the piece in which `of` lies (not a number: wherever); height: no number where there is
 * none. */
pm_pair_place pm_pair_meet(const pm_pair *x, double a, double b, double of);

/* Which corner touches: an end of a on b, or an end of b on a, where they are open. */
enum pm_pair_corner {
    PM_PAIR_WITHIN = 0,
    PM_PAIR_FROM = 1,
    PM_PAIR_TO = 2,
    PM_PAIR_SECOND_FROM = 3,
    PM_PAIR_SECOND_TO = 4
};
static inline int pm_pair_is_second(int corner) { return corner >= PM_PAIR_SECOND_FROM; }
/* PM_PAIR_FROM or PM_PAIR_TO: which end of its own curve it is. */
static inline int pm_pair_end(int corner) { return pm_pair_is_second(corner) ? corner - PM_PAIR_TO : corner; }

/* The places of a constraint, from those that it remembers (constraint_pair.c). */
pm_pair_place pm_constraint_pair_places(const pm_frame *frame, const pm_constraint *c);

/* What is next to each other. */
typedef struct pm_pair_near {
    pm_pair_place at; /* of a corner: of its curve the end, whatever its direction is */
    int corner;       /* enum pm_pair_corner */
} pm_pair_near;

/* Places that are not looked for: the feet on b of what is closed, and those on a; and the corners that it has come over, with
 * what is next to them on their curve. */
typedef struct pm_pair_closed {
    pm_curve_taken feet, first;
    int passed[PM_PAIR_SECOND_TO + 1];
} pm_pair_closed;

/* The place where they are nearest, or of those where they overlap the one where they do least, but for what is closed; 0:
 * there is none. */
int pm_pair_nearest(const pm_pair *x, const pm_pair_closed *closed, pm_pair_near *near);
/* By how far the curve of a corner goes on to the inside from there, along n of the other in its axes: the sine of the angle
 * between them; negative where what touches is within. */
double pm_pair_corner_rises(const pm_pair *x, int corner, const double n[2]);

#endif

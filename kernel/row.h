/* row.h - scalar constraint rows: one table of kinds, each with residual, Jacobian, gamma and line of action. */
#ifndef PM_ROW_H
#define PM_ROW_H

#include <math.h>

#include "body.h"
#include "model.h"
#include "still.h"

enum pm_row_kind {
    PM_ROW_POINT_X = 0,
    PM_ROW_POINT_Y = 1,
    PM_ROW_LINE_NORMAL = 2,
    PM_ROW_LINE_TANGENT = 3,
    PM_ROW_DISTANCE = 4,
    PM_ROW_CIRCLE_TANGENT = 5,
    PM_ROW_ANGLE = 6,
    PM_ROW_STRAND = 7,
    PM_ROW_DRIVE_X = 8,
    PM_ROW_DRIVE_Y = 9,
    PM_ROW_TURN = 10,
    PM_ROW_KINDS = 11
};

/* Where a unit reaction acts on body[0], from geometry alone: the audit uses it instead of the Jacobian.  On body[1] the
 * opposite force acts in the same line, and couple[1], which is the opposite couple unless something else takes a share:
 * the housing of a gear box, which is the ground. */
typedef struct pm_line_of_action {
    double at[2], direction[2], couple[2];
} pm_line_of_action;

typedef struct pm_steady pm_steady; /* steady.h */

/* Bounds over the next h seconds of a motion with constant accelerations. */
typedef struct pm_row_bounds {
    double bend; /* the second rate of the residual is not below it */
    double rate; /* its first rate is not beyond it, either way */
    int exact;   /* the second rate *is* bend, throughout */
} pm_row_bounds;

/* One kind: `evaluate` fills j, g, gamma at the frame; `act` gives the line of action; `remember` (no-slip rows)
 * sets or refreshes the memory from the frame: anchor_too = 1 closes the row here.  `steady`: the Jacobian stays the same
 * along the curve (NULL: it never does); `bound` (rows that are gaps): of the row as evaluated at the frame, with the
 * accelerations a[nq + 3]. */
typedef struct pm_row_ops {
    void (*evaluate)(const pm_workspace *w, pm_row *row);
    void (*act)(const pm_workspace *w, const pm_row *row, pm_line_of_action *x);
    void (*remember)(const pm_workspace *w, const pm_row *row, pm_memory *memory, int anchor_too);
    int (*steady)(const pm_workspace *w, const pm_row *row, const pm_steady *x);
    void (*bound)(const pm_workspace *w, const pm_row *row, const double *a, double h, pm_row_bounds *x);
} pm_row_ops;

extern const pm_row_ops pm_row_point_x, pm_row_point_y, pm_row_line_normal, pm_row_line_tangent,
    pm_row_distance, pm_row_circle_tangent, pm_row_angle, pm_row_strand, pm_row_drive_x, pm_row_drive_y,
    pm_row_turn;

const pm_row_ops *pm_row_kind(int kind);

/* The rows of joint i with the numbers of the case; returns how many. */
int pm_row_of_joint(const pm_workspace *w, int joint, pm_row row[PM_JOINT_ROWS]);
/* The same, whether the joint is there or not. */
int pm_row_of_any_joint(const pm_workspace *w, int joint, pm_row row[PM_JOINT_ROWS]);
/* The normal row alone of a contact that is closed (or may close) in `slot` with `member`. */
void pm_row_normal_of_contact(const pm_workspace *w, int contact, int slot, int member, pm_row *normal);
/* Its tangential row, from the normal one. */
void pm_row_tangent_of_contact(const pm_workspace *w, int contact, const pm_row *normal, pm_row *tangent);
/* Both. */
void pm_row_of_contact(const pm_workspace *w, int contact, int slot, int member, pm_row *normal,
                       pm_row *tangent);

/* Whether its two bodies act on each other and on nothing else. */
static inline int pm_row_is_inner(const pm_workspace *w, const pm_row *row)
{
    const unsigned char *still = w->still->body;
    return !still[row->body[0]] && !still[row->body[1]] && row->ratio == 1;
}

/* Rate of a row from the geometry of its line of action (equals j v). */
double pm_row_rate(const pm_workspace *w, const pm_row *row);
/* The same relative to its prescribed rate: how a surface slips on a moving belt. */
double pm_row_slip(const pm_workspace *w, const pm_row *row);

/* The two marks of a row in the frame, and what all kinds share. */
typedef struct pm_marks {
    pm_point a, b;
    double d[2];    /* a - b */
    double u[2];    /* velocity of a - velocity of b */
    double quad[2]; /* relative acceleration of the marks when the coordinates do not accelerate */
    double omega_a, omega_b;
} pm_marks;
pm_marks pm_row_marks(const pm_workspace *w, const pm_row *row);
/* j = (n, r_a x n) on a, -(n, r_b x n) on b. */
void pm_row_along(pm_row *row, const pm_marks *x, const double n[2], double factor);

/* How far, how fast and how hard (beyond the constant accelerations of their mass centres) two marks part at most over the
 * next h seconds; `turn`, `spin`: how fast and how hard body[1] turns. */
typedef struct pm_row_reach {
    double apart[2]; /* accelerations of the mass centres, relative */
    double swing;    /* of accelerations by turning: rho sqrt(omega^4 + alpha^2), both marks */
    double distance, rate;
    double turn, spin;
} pm_row_reach;
pm_row_reach pm_row_reach_of(const pm_row *row, const pm_marks *x, const double *a, double h);

/* No overflow is possible at the scale of scenes: a plain root is an eighth of hypot's price. */
static inline double pm_length(const double a[2]) { return sqrt(a[0] * a[0] + a[1] * a[1]); }
static inline double pm_dot(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }
static inline double pm_cross(const double a[2], const double b[2]) { return a[0] * b[1] - a[1] * b[0]; }

#endif

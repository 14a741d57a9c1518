/* constraint_marks.h - the two marks of a row: points, lines and circles of the model's tables with the numbers of the case. */
#ifndef PM_CONSTRAINT_MARKS_H
#define PM_CONSTRAINT_MARKS_H

#include "elements/constraint.h"

/* A row of a kind that belongs to nothing yet. */
pm_constraint pm_constraint_marks_blank(int kind);

void pm_constraint_marks_points(const pm_frame *frame, pm_constraint *row, int a, int b);
void pm_constraint_marks_point_and_line(const pm_frame *frame, pm_constraint *row, int point, int line);
void pm_constraint_marks_circle_and_line(const pm_frame *frame, pm_constraint *row, int circle, int line);
/* Side 1: outside each other; -1: a inside b; -2: b inside a. */
void pm_constraint_marks_circles(const pm_frame *frame, pm_constraint *row, int a, int b, double side);
void pm_constraint_marks_radii(pm_constraint *row, double radius_a, double radius_b, double side);
/* A strand from circle a to circle b; which way round each it goes is the sign of its radius. */
void pm_constraint_marks_strand(const pm_frame *frame, pm_constraint *row, int a, int b, double sense_a,
                                double sense_b);
/* Circle and member of a periodic row of points. */
void pm_constraint_marks_member(const pm_frame *frame, pm_constraint *row, int circle, int of, int member);

#endif

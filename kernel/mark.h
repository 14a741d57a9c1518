/* mark.h - the two marks of a row: points, lines and circles of the model's tables with the numbers of the case. */
#ifndef PM_MARK_H
#define PM_MARK_H

#include "row.h"

/* A row of a kind that belongs to nothing yet. */
pm_row pm_row_blank(int kind);

void pm_mark_points(const pm_workspace *w, pm_row *row, int a, int b);
void pm_mark_point_and_line(const pm_workspace *w, pm_row *row, int point, int line);
void pm_mark_circle_and_line(const pm_workspace *w, pm_row *row, int circle, int line);
/* Side 1: outside each other; -1: a inside b; -2: b inside a. */
void pm_mark_circles(const pm_workspace *w, pm_row *row, int a, int b, double side);
void pm_mark_radii(pm_row *row, double radius_a, double radius_b, double side);
/* A strand from circle a to circle b; which way round each it goes is the sign of its radius. */
void pm_mark_strand(const pm_workspace *w, pm_row *row, int a, int b, double sense_a, double sense_b);
/* Circle and member of a periodic row of points. */
void pm_mark_member(const pm_workspace *w, pm_row *row, int circle, int of, int member);

#endif

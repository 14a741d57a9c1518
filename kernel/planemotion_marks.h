/* planemotion_marks.h - the tables of bodies and of their marks: points, lines, circles, patterns, curves. */
#ifndef PLANEMOTION_MARKS_H
#define PLANEMOTION_MARKS_H

/* ---- bodies and marks -------------------------------------------------------------------------------
 * A body's coordinates are (x, y, angle) of its mass centre G.  x, y, angle are the pose as drawn: the
 * assembly keeps what the start table fixes and moves the rest.  Points are given in body axes from G (of
 * the ground: scene coordinates). */
enum pm_body_column {
    PM_BODY_ROTATES = 0, /* 0: a particle, its angle stays 0 */
    PM_BODY_MASS = 1,    /* value index, >= 0; 0 where constraints determine the motion all the same */
    PM_BODY_INERTIA = 2, /* value index, centroidal, >= 0 if the body rotates */
    PM_BODY_X = 3,       /* value indices of the pose of G as drawn */
    PM_BODY_Y = 4,
    PM_BODY_ANGLE = 5,
    PM_BODY_COLUMNS = 6
};
enum pm_point_column { PM_POINT_BODY = 0, PM_POINT_X = 1, PM_POINT_Y = 2, PM_POINT_COLUMNS = 3 };
/* A line through a point, at `angle` from the body's x axis; its free side is on its left. */
enum pm_line_column { PM_LINE_POINT = 0, PM_LINE_ANGLE = 1, PM_LINE_COLUMNS = 2 };
/* A circle round a point; radius value >= 0 (0: the point itself). */
enum pm_circle_column { PM_CIRCLE_POINT = 0, PM_CIRCLE_RADIUS = 1, PM_CIRCLE_COLUMNS = 2 };
/* Members point + k*(step_x, step_y) in the axes of the point's body, k = 0 .. count-1; count < 0: endless
 * both ways. */
enum pm_pattern_column {
    PM_PATTERN_POINT = 0,
    PM_PATTERN_STEP_X = 1,
    PM_PATTERN_STEP_Y = 2,
    PM_PATTERN_COUNT = 3,
    PM_PATTERN_COLUMNS = 4
};

/* The points (x(s), y(s)) of a curve, in the axes of the body of `point` from there; its free side, where a contact touches
 * it and to which its normal points, is on its left as s grows (side 1) or on its right (-1). */
enum pm_curve_column {
    PM_CURVE_POINT = 0,
    PM_CURVE_X = 1, /* programs of PM_MEASURE_PLACE alone, smooth to the third derivative but at knots */
    PM_CURVE_Y = 2,
    PM_CURVE_FROM = 3, /* value indices: from < to */
    PM_CURVE_TO = 4,
    PM_CURVE_CLOSED = 5, /* pm_curve_closed */
    PM_CURVE_SIDE = 6,   /* 1 or -1 */
    /* row of PM_TABLE_PIECEWISE, or PM_NONE: the programs read tables with these knots at PM_MEASURE_PLACE itself, smooth to
     * the second derivative; phases end there */
    PM_CURVE_KNOTS = 7,
    PM_CURVE_COLUMNS = 8
};
/* What is at `from` and `to`: ends; the same place, where it goes on; nothing, for a straight line goes on beyond both. */
enum pm_curve_closed {
    PM_CURVE_WITH_ENDS = 0,
    PM_CURVE_ROUND = 1,
    PM_CURVE_ENDLESS = 2,
    PM_CURVE_CLOSINGS = 3
};

#endif

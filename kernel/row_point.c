/* row_point.c - two points coincide (pin): p_a - p_b = 0, one row for each axis of the scene.
 *
 * With n the axis:  C = n.(p_a - p_b),  Cdot = n.(v_a - v_b),
 * gamma = -n.(-omega_a^2 r_a + omega_b^2 r_b). */
#include "row.h"
#include "steady.h"

static const double axis_x[2] = {1, 0}, axis_y[2] = {0, 1};

static void evaluate(const pm_workspace *w, pm_row *row, const double n[2])
{
    const pm_marks x = pm_row_marks(w, row);
    pm_row_along(row, &x, n, 1);
    row->g = pm_dot(x.d, n);
    row->gamma = -pm_dot(x.quad, n);
}

static void act(const pm_workspace *w, const pm_row *row, pm_line_of_action *x, const double n[2])
{
    const pm_point a = pm_point_at(w, row->body[0], row->a[0], row->a[1]);
    *x = (pm_line_of_action){.at = {a.p[0], a.p[1]}, .direction = {n[0], n[1]}};
}

static void evaluate_x(const pm_workspace *w, pm_row *row) { evaluate(w, row, axis_x); }
static void evaluate_y(const pm_workspace *w, pm_row *row) { evaluate(w, row, axis_y); }
static void act_x(const pm_workspace *w, const pm_row *row, pm_line_of_action *x) { act(w, row, x, axis_x); }
static void act_y(const pm_workspace *w, const pm_row *row, pm_line_of_action *x) { act(w, row, x, axis_y); }

/* The levers stay: neither mark goes round. */
static int steady(const pm_workspace *w, const pm_row *row, const pm_steady *x)
{
    return pm_steady_marks(w, x, row);
}

const pm_row_ops pm_row_point_x = {.evaluate = evaluate_x, .act = act_x, .steady = steady};
const pm_row_ops pm_row_point_y = {.evaluate = evaluate_y, .act = act_y, .steady = steady};

/* measure_body.c - what is read off bodies and points.
 *
 * Seen from a moving body its own velocity field is taken off, v_P - v_G - omega x GP, in its axes.  Angular momentum about
 * a point P: H_P = H_O - OP x L, (17.28) moved to P.  The pole is where v_G + omega x GP = 0. */
#include "elements/measure_kinds.h"
#include "elements/turning_plane.h"
#include "state/workspace.h"

/* ---- bodies ---- */
static const double *velocity(const pm_measure_args *x, int body)
{
    return x->w->frame.velocity + 3 * pm_model_body_index(x->w->model, body);
}
static const double *pose(const pm_measure_args *x, int body)
{
    return x->w->frame.pose + 5 * pm_model_body_index(x->w->model, body);
}

static int seen_from(const pm_measure_args *x)
{
    return x->e[PM_MEASURE_IN] == PM_NONE ? PM_GROUND : x->e[PM_MEASURE_IN];
}

double pm_measured_angle(const pm_measure_args *x) { return pose(x, x->a)[2] - pose(x, seen_from(x))[2]; }
double pm_measured_turned(const pm_measure_args *x)
{
    return x->a < 0 || x->a == x->w->model->nbody ? 0 : pose(x, x->a)[2] - x->w->start.q[3 * x->a + 2];
}
double pm_measured_omega(const pm_measure_args *x)
{
    return velocity(x, x->a)[2] - velocity(x, seen_from(x))[2];
}
double pm_measured_alpha(const pm_measure_args *x)
{
    return x->a == PM_GROUND ? 0 : x->w->frame.a[3 * x->a + 2];
}

double pm_measured_mass(const pm_measure_args *x)
{
    double sum = 0;
    for (int i = 0; i < x->w->model->nbody; i++)
        if (x->a == PM_NONE || x->a == i) sum += x->w->numbers.mass[i];
    return sum;
}
double pm_measured_weight(const pm_measure_args *x)
{
    return pm_measured_mass(x) * hypot(x->w->numbers.gravity[0], x->w->numbers.gravity[1]);
}

double pm_measured_inertia(const pm_measure_args *x)
{
    if (x->a == PM_GROUND) return 0;
    double sum = pm_frame_inertia(&x->w->frame, x->a);
    if (x->e[PM_MEASURE_ABOUT] != PM_NONE) {
        const pm_point p = pm_frame_point_of(&x->w->frame, x->e[PM_MEASURE_ABOUT]);
        const double *g = pose(x, x->a), dx = g[0] - p.p[0], dy = g[1] - p.p[1];
        sum += x->w->numbers.mass[x->a] * (dx * dx + dy * dy);
    }
    return sum;
}

double pm_measured_kinetic(const pm_measure_args *x)
{
    return x->a == PM_GROUND
               ? 0
               : pm_frame_kinetic(&x->w->frame, x->a) + pm_turning_plane_kinetic(&x->w->frame, x->a);
}

void pm_measured_momentum(const pm_measure_args *x, double out[2])
{
    double m[3] = {0, 0, 0};
    if (x->a != PM_GROUND) pm_frame_momentum(&x->w->frame, x->a, m);
    out[0] = m[0];
    out[1] = m[1];
}

double pm_measured_angular_momentum(const pm_measure_args *x)
{
    double m[3] = {0, 0, 0}, about[2] = {0, 0};
    if (x->a == PM_GROUND) return 0;
    pm_frame_momentum(&x->w->frame, x->a, m);
    if (x->e[PM_MEASURE_ABOUT] != PM_NONE) {
        const pm_point p = pm_frame_point_of(&x->w->frame, x->e[PM_MEASURE_ABOUT]);
        about[0] = p.p[0];
        about[1] = p.p[1];
    } else if (x->a != PM_NONE) {
        return pm_frame_inertia(&x->w->frame, x->a) * velocity(x, x->a)[2];
    }
    return m[2] - (about[0] * m[1] - about[1] * m[0]);
}

void pm_measured_pole(const pm_measure_args *x, double out[2])
{
    const double *v = velocity(x, x->a), *g = pose(x, x->a);
    out[0] = v[2] == 0 ? NAN : g[0] - v[1] / v[2];
    out[1] = v[2] == 0 ? NAN : g[1] + v[0] / v[2];
}

/* ---- points ---- */
static void into_axes(const double *axes, double v[2])
{
    const double x = axes[3] * v[0] + axes[4] * v[1], y = -axes[4] * v[0] + axes[3] * v[1];
    v[0] = x;
    v[1] = y;
}

void pm_measured_position(const pm_measure_args *x, double out[2])
{
    const pm_point p = pm_frame_point_of(&x->w->frame, x->a);
    const double *axes = pose(x, seen_from(x));
    out[0] = p.p[0] - axes[0];
    out[1] = p.p[1] - axes[1];
    into_axes(axes, out);
}

/* As the moving body's own observer sees it: the velocity of the body's point at P is taken off. */
void pm_measured_velocity(const pm_measure_args *x, double out[2])
{
    const pm_point p = pm_frame_point_of(&x->w->frame, x->a);
    const double *axes = pose(x, seen_from(x)), *v = velocity(x, seen_from(x));
    out[0] = p.v[0] - (v[0] - v[2] * (p.p[1] - axes[1]));
    out[1] = p.v[1] - (v[1] + v[2] * (p.p[0] - axes[0]));
    into_axes(axes, out);
}

void pm_measured_acceleration(const pm_measure_args *x, double out[2])
{
    const pm_point p = pm_frame_point_of(&x->w->frame, x->a);
    pm_frame_acceleration(&x->w->frame, &p, out);
}

void pm_measured_moved(const pm_measure_args *x, double out[2])
{
    const int32_t *e = PM_POINT_ROW(x->w->model, x->a);
    const pm_point now = pm_frame_point_of(&x->w->frame, x->a);
    out[0] = out[1] = 0;
    if (e[PM_POINT_BODY] == PM_GROUND) return;
    const double *q = x->w->start.q + 3 * e[PM_POINT_BODY], px = x->w->numbers.value[e[PM_POINT_X]],
                 py = x->w->numbers.value[e[PM_POINT_Y]];
    out[0] = now.p[0] - (q[0] + cos(q[2]) * px - sin(q[2]) * py);
    out[1] = now.p[1] - (q[1] + sin(q[2]) * px + cos(q[2]) * py);
}

double pm_measured_path(const pm_measure_args *x)
{
    const ptrdiff_t i = (x->e - x->w->model->table[PM_TABLE_MEASURE]) / PM_MEASURE_COLUMNS;
    return x->w->frame.z[x->w->model->path_z[i]];
}

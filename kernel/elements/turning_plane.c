/* turning_plane.c - the plane of the scene turns freely about an axis in it (an axial part: its inertia depends on the place).
 *
 * The scene is what an observer on the plane draws.  Every point of it moves across the plane with Omega times its
 * distance d from the axis, at right angles to what the observer sees, so that with the coordinates q in the plane
 *
 *   T = T(q, v) + J(q) Omega^2 / 2        J = J0 + sum of (m d^2 + Sx sin^2 f + Sy cos^2 f + Sz)
 *
 * Sx, Sy, Sz are a body's second moments (integrals of x^2, y^2, z^2 over its mass) about G along its own axes and across
 * the plane, f the angle of its x axis from the axis of the spin.  The angle of the plane does not occur: its momentum
 * H = J Omega changes by the couple about the axis only (17.24 for an axis), and never in a blow within the plane.
 * Eliminated by H (Routh; Goldstein, Classical Mechanics, 8.3) it leaves a potential H^2 / 2J: M stays constant, and the
 * centrifugal forces are
 *
 *   Q = -d/dq (H^2 / 2J) = Omega^2 / 2 dJ/dq        at G: m Omega^2 d from the axis;  couple: Omega^2 (Sx - Sy) sin f cos f
 *
 * The observer's Coriolis forces are all across the plane.  Where no couple acts H is a constant and the forces depend on
 * the place alone; else H is a running integral. */
#include "elements/turning_plane.h"

#include <math.h>

#include "elements/drive.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"

static const int32_t *spin_row(const pm_model *m)
{
    return pm_model_row(m, PM_TABLE_SPIN, 0, PM_SPIN_COLUMNS);
}

/* ---- model ---- */
void pm_turning_plane_lay_out(pm_model *m)
{
    m->spin_z = m->spin_angle_z = PM_NONE;
    if (!pm_turning_plane_turns(m)) return;
    if (spin_row(m)[PM_SPIN_COUPLE] >= 0) m->spin_z = m->nz++;
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++)
        if (PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND] == PM_MEASURE_SPIN_ANGLE && m->spin_angle_z == PM_NONE)
            m->spin_angle_z = m->nz++;
}

/* ---- case and start ---- */
static int read_axis(pm_workspace *w)
{
    pm_turning_plane *s = &w->numbers.plane;
    const int32_t *e = spin_row(w->model);
    for (int k = 0; k < PM_SPIN_COUPLE; k++) {
        const double value = w->numbers.value[e[k]];
        const int ok = isfinite(value) && (k != PM_SPIN_INERTIA || value >= 0);
        if (!ok)
            return pm_fail_member(&w->result, PM_BAD_VALUE, PM_TABLE_SPIN, 0, k, value,
                                  k == PM_SPIN_INERTIA ? 0 : -INFINITY);
    }
    s->through[0] = w->numbers.value[e[PM_SPIN_X]];
    s->through[1] = w->numbers.value[e[PM_SPIN_Y]];
    s->angle = w->numbers.value[e[PM_SPIN_ANGLE]];
    s->normal[0] = -sin(s->angle);
    s->normal[1] = cos(s->angle);
    s->inertia = w->numbers.value[e[PM_SPIN_INERTIA]];
    /* a plane that turns takes the direction of the gravity along only if that is the axis' own */
    const double across = fabs(w->numbers.gravity[0] * s->normal[0] + w->numbers.gravity[1] * s->normal[1]);
    const double allowed = PM_SPIN_ACROSS * hypot(w->numbers.gravity[0], w->numbers.gravity[1]);
    return across > allowed
               ? pm_fail_member(&w->result, PM_BAD_VALUE, PM_TABLE_SPIN, 0, PM_SPIN_ANGLE, across, allowed)
               : PM_OK;
}

int pm_turning_plane_case(pm_workspace *w)
{
    w->numbers.plane = (pm_turning_plane){.momentum = 0};
    if (!pm_turning_plane_turns(w->model)) return PM_OK;
    for (int i = 0; i < w->model->nbody; i++)
        for (int k = 0; k < PM_SECOND_COLUMNS; k++) {
            const double value = w->numbers.value[PM_SECOND_ROW(w->model, i)[k]];
            if (!isfinite(value) || value < 0)
                return pm_fail_member(&w->result, PM_BAD_VALUE, PM_TABLE_SECOND, i, k, value, 0);
        }
    return read_axis(w);
}

int pm_turning_plane_start(pm_workspace *w)
{
    if (!pm_turning_plane_turns(w->model)) return PM_OK;
    const double inertia = pm_turning_plane_inertia(&w->frame);
    if (!(inertia > 0))
        return pm_fail_member(&w->result, PM_BAD_VALUE, PM_TABLE_SPIN, 0, PM_SPIN_INERTIA, inertia, 0);
    w->numbers.plane.momentum = inertia * w->numbers.value[spin_row(w->model)[PM_SPIN_OMEGA]];
    return PM_OK;
}

/* ---- the state ---- */
/* A body's distance from the axis, on the left of its direction, and its x axis as seen from the axis. */
static double distance(const pm_frame *frame, int i)
{
    const double *pose = frame->pose + 5 * i, *n = frame->numbers->plane.normal;
    return (pose[0] - frame->numbers->plane.through[0]) * n[0] +
           (pose[1] - frame->numbers->plane.through[1]) * n[1];
}

static void direction(const pm_frame *frame, int i, double *sine, double *cosine)
{
    const double *pose = frame->pose + 5 * i, *n = frame->numbers->plane.normal;
    *sine = pose[3] * n[0] + pose[4] * n[1];
    *cosine = pose[3] * n[1] - pose[4] * n[0];
}

static double second(const pm_frame *frame, int i, int column)
{
    return frame->numbers->value[PM_SECOND_ROW(frame->model, i)[column]];
}

static double body_inertia(const pm_frame *frame, int i)
{
    double sine, cosine;
    const double d = distance(frame, i);
    direction(frame, i, &sine, &cosine);
    return frame->numbers->mass[i] * d * d + second(frame, i, PM_SECOND_X) * sine * sine +
           second(frame, i, PM_SECOND_Y) * cosine * cosine + second(frame, i, PM_SECOND_Z);
}

double pm_turning_plane_inertia(const pm_frame *frame)
{
    if (!pm_turning_plane_turns(frame->model)) return 0;
    double sum = frame->numbers->plane.inertia;
    for (int i = 0; i < frame->model->nbody; i++) sum += body_inertia(frame, i);
    return sum;
}

double pm_turning_plane_momentum(const pm_frame *frame)
{
    const int z = frame->model->spin_z;
    return frame->numbers->plane.momentum + (z == PM_NONE ? 0 : frame->z[z]);
}

double pm_turning_plane_omega(const pm_frame *frame)
{
    const double momentum = pm_turning_plane_momentum(frame);
    return momentum == 0 ? 0 : momentum / pm_turning_plane_inertia(frame);
}

double pm_turning_plane_angle(const pm_frame *frame) { return frame->z[frame->model->spin_angle_z]; }

double pm_turning_plane_kinetic(const pm_frame *frame, int i)
{
    if (!pm_turning_plane_turns(frame->model)) return 0;
    const double omega = pm_turning_plane_omega(frame);
    return 0.5 * omega * (i == PM_NONE ? pm_turning_plane_momentum(frame) : omega * body_inertia(frame, i));
}

/* ---- forces ---- */
void pm_turning_plane_forces(pm_frame *frame)
{
    if (!pm_turning_plane_turns(frame->model)) return;
    const double omega = pm_turning_plane_omega(frame), square = omega * omega;
    for (int i = 0; i < frame->model->nbody; i++) {
        double sine, cosine, *f = frame->f + 3 * i;
        const double outward = square * frame->numbers->mass[i] * distance(frame, i);
        direction(frame, i, &sine, &cosine);
        f[0] += outward * frame->numbers->plane.normal[0];
        f[1] += outward * frame->numbers->plane.normal[1];
        f[2] += square * (second(frame, i, PM_SECOND_X) - second(frame, i, PM_SECOND_Y)) * sine * cosine;
    }
}

/* ---- derivatives ---- */
/* dJ/dq of one body. */
static void inertia_slope(const pm_frame *frame, int i, double out[3])
{
    double sine, cosine;
    const double arm = 2 * frame->numbers->mass[i] * distance(frame, i), *n = frame->numbers->plane.normal;
    direction(frame, i, &sine, &cosine);
    out[0] = arm * n[0];
    out[1] = arm * n[1];
    out[2] = 2 * (second(frame, i, PM_SECOND_X) - second(frame, i, PM_SECOND_Y)) * sine * cosine;
}

void pm_turning_plane_add_inertia(const pm_frame *frame, pm_slope *to, int i, double weight)
{
    for (int k = 0; k < frame->model->nbody; k++) {
        double slope[6] = {0};
        const int pair[2] = {k, frame->model->nbody};
        if (i != PM_NONE && i != k) continue;
        inertia_slope(frame, k, slope);
        pm_slope_add_bodies(frame, to, 2, pair, slope, weight, 0);
    }
}

void pm_turning_plane_add_omega(const pm_frame *frame, pm_slope *to, double weight)
{
    const double inertia = pm_turning_plane_inertia(frame);
    if (inertia > 0)
        pm_turning_plane_add_inertia(frame, to, PM_NONE, -weight * pm_turning_plane_omega(frame) / inertia);
}

void pm_turning_plane_add_kinetic(const pm_frame *frame, pm_slope *to, int i, double weight)
{
    if (!pm_turning_plane_turns(frame->model)) return;
    const double omega = pm_turning_plane_omega(frame);
    if (i == PM_NONE) {
        pm_turning_plane_add_omega(frame, to, 0.5 * weight * pm_turning_plane_momentum(frame));
        return;
    }
    pm_turning_plane_add_inertia(frame, to, i, 0.5 * weight * omega * omega);
    pm_turning_plane_add_omega(frame, to, weight * omega * body_inertia(frame, i));
}

void pm_turning_plane_add_forces(const pm_frame *frame, double *slope)
{
    const int n = pm_turning_plane_turns(frame->model) ? frame->model->nbody : 0;
    const double omega = pm_turning_plane_omega(frame), square = n > 0 ? omega * omega : 0,
                 *normal = frame->numbers->plane.normal,
                 inertia = n > 0 ? pm_turning_plane_inertia(frame) : 1;
    for (int i = 0; i < n && square > 0; i++) {
        double sine, cosine, own[3], other[3];
        direction(frame, i, &sine, &cosine);
        inertia_slope(frame, i, own);
        for (int k = 0; k < 4; k++)
            slope[(3 * i + k / 2) * 3 * n + 3 * i + k % 2] +=
                square * frame->numbers->mass[i] * normal[k / 2] * normal[k % 2];
        slope[(3 * i + 2) * 3 * n + 3 * i + 2] +=
            square * (second(frame, i, PM_SECOND_X) - second(frame, i, PM_SECOND_Y)) *
            (cosine * cosine - sine * sine);
        for (int k = 0; k < n; k++) {
            inertia_slope(frame, k, other);
            for (int p = 0; p < 9; p++)
                slope[(3 * i + p / 3) * 3 * n + 3 * k + p % 3] -=
                    square * own[p / 3] * other[p % 3] / inertia;
        }
    }
}

double pm_turning_plane_force_size(const pm_frame *frame, const double *t)
{
    if (!pm_turning_plane_turns(frame->model)) return 0;
    const double omega = pm_turning_plane_omega(frame);
    double sum = 0;
    for (int i = 0; i < frame->model->nbody; i++, t += 3)
        sum += frame->numbers->mass[i] * frame->numbers->size * hypot(t[0], t[1]) +
               (second(frame, i, PM_SECOND_X) + second(frame, i, PM_SECOND_Y)) * fabs(t[2]);
    return omega * omega * sum;
}

/* Not from the generalised forces: every element of mass is pulled from the axis by Omega^2 times its distance, at its
 * own place, so that the moment about the origin is that of the moments of mass. */
void pm_turning_plane_outer(const pm_frame *frame, double outer[PM_LEDGER])
{
    outer[0] = outer[1] = outer[2] = 0;
    if (!pm_turning_plane_turns(frame->model)) return;
    const double omega = pm_turning_plane_omega(frame), *n = frame->numbers->plane.normal;
    for (int i = 0; i < frame->model->nbody; i++) {
        const double *pose = frame->pose + 5 * i, turned = 2 * (pose[2] - frame->numbers->plane.angle);
        const double sx = second(frame, i, PM_SECOND_X), sy = second(frame, i, PM_SECOND_Y);
        const double pull = omega * omega * frame->numbers->mass[i] * distance(frame, i);
        /* integral of (along the axis) (away from it) over the body, about G: Mohr's circle */
        const double product = 0.5 * (sx - sy) * sin(turned);
        outer[0] += pull * n[0];
        outer[1] += pull * n[1];
        outer[2] += pull * (pose[0] * n[1] - pose[1] * n[0]) + omega * omega * product;
    }
}

/* ---- running integrals ---- */
int pm_turning_plane_program(const pm_model *m)
{
    return pm_turning_plane_turns(m) ? spin_row(m)[PM_SPIN_COUPLE] : PM_NONE;
}

static double couple(pm_workspace *w)
{
    const int program = pm_turning_plane_program(w->model);
    return program >= 0 ? pm_drive_program(w, program) : 0;
}

void pm_turning_plane_rates(pm_workspace *w, double *zdot)
{
    const pm_model *m = w->model;
    if (m->spin_z != PM_NONE) zdot[m->spin_z] = couple(w);
    if (m->spin_angle_z != PM_NONE) zdot[m->spin_angle_z] = pm_turning_plane_omega(&w->frame);
}

double pm_turning_plane_power(pm_workspace *w)
{
    return w->model->spin_z == PM_NONE ? 0 : couple(w) * pm_turning_plane_omega(&w->frame);
}

double pm_turning_plane_scale(const pm_frame *frame, int z)
{
    if (z == frame->model->spin_angle_z) return 1;
    if (z != frame->model->spin_z) return 0;
    return fmax(fabs(pm_turning_plane_momentum(frame)),
                pm_turning_plane_inertia(frame) * frame->numbers->speed / frame->numbers->size);
}

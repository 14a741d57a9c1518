/* frame.c - bodies in absolute coordinates q = (x, y, angle) of their mass centres.
 *
 * M is diagonal and constant: T = sum (m (vx^2 + vy^2) + I omega^2) / 2, (17.9) of the book.  A point at r from G has
 * v = v_G + omega k x r and a = a_G + alpha k x r - omega^2 r.  A particle does not rotate: the inverse of its inertia is
 * 0.  Nothing outside this file may assume that M is constant. */
#include "state/frame.h"

#include <math.h>

#include "numerics/lanes.h"

int pm_frame_rotations_create(pm_frame *frame, pm_arena *memory)
{
    int bits = 1; /* zeros of different signs are kept in different halves */
    while (1 << bits < PM_ROTATIONS_OF_BODY * frame->model->nbody) bits++;
    const pm_array array[] = {PM_ARRAY(frame->rotation, 1 << bits)};
    const int status = pm_arena_take(memory, PM_ARRAYS(array));
    frame->rotation_shift = 64 - bits;
    for (int i = 0; !status && i < 1 << bits; i++) frame->rotation[i].angle = NAN;
    return status;
}

const pm_rotation *pm_frame_rotation_found(pm_rotation *x, double angle)
{
    const pm_lanes direction = pm_lanes_direction(angle);
    *x = (pm_rotation){angle, direction[0], direction[1]};
    return x;
}

void pm_frame_look(pm_frame *frame, double t, const double *q, const double *v, const double *z,
                   const pm_memory *memory)
{
    pm_frame *f = frame;
    const int n = frame->model->nbody;
    const unsigned char *fixed = frame->numbers->fixed;
    f->t = t;
    f->q = q;
    f->v = v;
    f->z = z;
    f->memory = memory;
    f->level = PM_LEVEL_KINEMATIC;
    for (int i = 0; i < n; i++) {
        double *pose = f->pose + 5 * i;
        if (fixed[i]) continue; /* as it was looked at when it was found to be fixed */
        pm_lanes_copy_threes(pose, q + 3 * i, 1);
        const pm_rotation *x = pm_frame_rotation(frame, pose[2]);
        pose[3] = x->cosine;
        pose[4] = x->sine;
        pm_lanes_copy_threes(f->velocity + 3 * i, v + 3 * i, 1);
    }
    f->pose[5 * n + 3] = 1; /* the ground: all else stays 0 */
}

void pm_frame_look_placed(pm_frame *frame, const pm_state *s, const double *q, const double *v)
{
    frame->t = s->t;
    frame->q = q;
    frame->v = v;
    frame->z = s->z;
    frame->memory = s->memory;
    frame->level = PM_LEVEL_KINEMATIC;
    pm_lanes_copy_threes(frame->velocity, v, frame->model->nbody);
    frame->pose[5 * frame->model->nbody + 3] = 1;
}

void pm_frame_look_along(pm_frame *frame, pm_state *s, const pm_memory *memory, const double *pose,
                         double rate, const double *direction)
{
    double *to = frame->pose, *q = s->q, *v = s->v, *velocity = frame->velocity;
    for (const double *end = pose + 5 * frame->model->nbody; pose < end;
         pose += 5, direction += 3, to += 5, q += 3, v += 3, velocity += 3) {
        const pm_lanes place = pm_lanes_load(pose), way = rate * pm_lanes_load(direction);
        const double angle = pose[2], omega = rate * direction[2];
        pm_lanes_store_three(to, place, angle);
        pm_lanes_store(to + 3, pm_lanes_load(pose + 3));
        pm_lanes_store_three(q, place, angle);
        pm_lanes_store_three(v, way, omega);
        pm_lanes_store_three(velocity, way, omega);
    }
    to[3] = 1; /* the ground: all else stays 0 */
    frame->t = s->t;
    frame->q = s->q;
    frame->v = s->v;
    frame->z = s->z;
    frame->memory = memory;
    frame->level = PM_LEVEL_KINEMATIC;
}

void pm_frame_look_state(pm_frame *frame, const pm_state *s)
{
    pm_frame_look(frame, s->t, s->q, s->v, s->z, s->memory);
}

pm_point pm_frame_point_of(const pm_frame *frame, int index)
{
    const int32_t *e = PM_POINT_ROW(frame->model, index);
    return pm_frame_point(frame, pm_model_body_index(frame->model, e[PM_POINT_BODY]),
                          frame->numbers->value[e[PM_POINT_X]], frame->numbers->value[e[PM_POINT_Y]]);
}

void pm_frame_acceleration(const pm_frame *frame, const pm_point *p, double a[2])
{
    a[0] = a[1] = 0;
    if (p->body == frame->model->nbody) return;
    const double *acc = frame->a + 3 * p->body;
    const double omega = frame->velocity[3 * p->body + 2];
    a[0] = acc[0] - acc[2] * p->r[1] - omega * omega * p->r[0];
    a[1] = acc[1] + acc[2] * p->r[0] - omega * omega * p->r[1];
}

double pm_frame_inertia(const pm_frame *frame, int i)
{
    const int32_t *e = PM_BODY_ROW(frame->model, i);
    if (frame->numbers->fixed[i]) return e[PM_BODY_ROTATES] ? frame->numbers->value[e[PM_BODY_INERTIA]] : 0;
    const double inverse =
        frame->numbers->stand_in[3 * i + 2] > 0 ? 0 : frame->numbers->inverse_mass[3 * i + 2];
    return inverse > 0 ? 1 / inverse : 0;
}

double pm_frame_kinetic(const pm_frame *frame, int i)
{
    if (i == PM_NONE) {
        double sum = 0;
        for (int k = 0; k < frame->model->nbody; k++)
            if (!frame->numbers->fixed[k]) sum += pm_frame_kinetic(frame, k);
        return sum;
    }
    const double *v = frame->velocity + 3 * i;
    const double forth = frame->numbers->mass[i] * (v[0] * v[0] + v[1] * v[1]);
    return 0.5 * (v[2] == 0 ? forth : forth + pm_frame_inertia(frame, i) * v[2] * v[2]);
}

void pm_frame_momentum(const pm_frame *frame, int i, double momentum[3])
{
    if (i == PM_NONE) {
        momentum[0] = momentum[1] = momentum[2] = 0;
        for (int k = 0; k < frame->model->nbody; k++) {
            double one[3];
            if (frame->numbers->fixed[k]) continue;
            pm_frame_momentum(frame, k, one);
            for (int c = 0; c < 3; c++) momentum[c] += one[c];
        }
        return;
    }
    const double *pose = frame->pose + 5 * i, *v = frame->velocity + 3 * i, m = frame->numbers->mass[i];
    momentum[0] = m * v[0];
    momentum[1] = m * v[1];
    const double spin = v[2] == 0 ? 0 : pm_frame_inertia(frame, i) * v[2];
    momentum[2] = spin + pose[0] * momentum[1] - pose[1] * momentum[0];
}

double pm_frame_weight_energy(const pm_frame *frame)
{
    double sum = 0;
    for (int i = 0; i < frame->model->nbody; i++)
        sum -= frame->numbers->mass[i] * (frame->numbers->gravity[0] * frame->pose[5 * i] +
                                          frame->numbers->gravity[1] * frame->pose[5 * i + 1]);
    return sum;
}

double pm_frame_total_mass(const pm_frame *frame)
{
    double sum = 0;
    for (int i = 0; i < frame->model->nbody; i++) sum += frame->numbers->mass[i];
    return sum;
}

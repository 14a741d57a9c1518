/* constraint_bend.c - the second derivatives K of a constraint by the positions of its two bodies.
 *
 * Every residual is a function C(q) of the positions (and of the time), its Jacobian the gradient of it, and along a motion
 * without accelerations C'' = v K v = -gamma, but for what is prescribed.  gamma is known in closed form at any velocities:
 * its values along single coordinates and along pairs of them give K, without a difference in positions:
 *   K_ii = -gamma(e_i)        2 K_ik = -gamma(e_i + e_k) + gamma(e_i) + gamma(e_k)
 * C depends on where the two bodies are from each other, not where both are: the coordinates are the way between them
 * and their two angles. */
#include "elements/constraint.h"

#include <string.h>

enum { X = 0, Y = 1, ANGLE_A = 2, ANGLE_B = 3, COORDINATES = 4 };

/* Velocities of its two bodies at which coordinates i and k change, by the scene's size (an angle by 1) a second. */
static void move(pm_frame *frame, const pm_constraint *c, int i, int k)
{
    const double size = frame->numbers->size;
    const int a_moves = !frame->numbers->fixed[c->body[0]];
    double *va = frame->velocity + 3 * c->body[0], *vb = frame->velocity + 3 * c->body[1];
    for (int n = 0; n < 3; n++) va[n] = vb[n] = 0;
    const int of[2] = {i, k};
    for (int n = 0; n < 2; n++) switch (of[n]) {
        case PM_NONE: break;
        case ANGLE_A: va[2] = 1; break;
        case ANGLE_B: vb[2] = 1; break;
        default:
            if (a_moves)
                va[of[n]] = size;
            else
                vb[of[n]] = -size;
        }
}

/* v K v, and what is prescribed. */
static double bent(pm_frame *frame, const pm_constraint *c, int i, int k)
{
    pm_constraint moved = *c;
    move(frame, c, i, k);
    pm_constraint_kind(c->kind)->evaluate(frame, &moved);
    return -moved.gamma;
}

static int is_still(const pm_frame *frame, const pm_constraint *c, int i)
{
    return i >= ANGLE_A && frame->numbers->fixed[c->body[i - ANGLE_A]];
}

static void by_coordinates(pm_frame *frame, const pm_constraint *c, double k[COORDINATES][COORDINATES])
{
    const double prescribed = bent(frame, c, PM_NONE, PM_NONE);
    for (int i = 0; i < COORDINATES; i++)
        k[i][i] = is_still(frame, c, i) ? 0 : bent(frame, c, i, PM_NONE) - prescribed;
    for (int i = 0; i < COORDINATES; i++)
        for (int n = 0; n < i; n++) {
            const int still = is_still(frame, c, i) || is_still(frame, c, n);
            k[i][n] = k[n][i] = still ? 0 : 0.5 * (bent(frame, c, i, n) - prescribed - k[i][i] - k[n][n]);
        }
}

static void from_velocities(pm_frame *frame, const pm_constraint *c,
                            double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES])
{
    static const int of[6] = {X, Y, ANGLE_A, X, Y, ANGLE_B};
    double k[COORDINATES][COORDINATES], kept[6];
    for (int i = 0; i < 6; i++) kept[i] = frame->velocity[3 * c->body[i / 3] + i % 3];
    by_coordinates(frame, c, k);
    for (int i = 0; i < 6; i++) frame->velocity[3 * c->body[i / 3] + i % 3] = kept[i];
    for (int i = 0; i < 6; i++)
        for (int n = 0; n < 6; n++) {
            const double sign_i = i == 3 || i == 4 ? -1 : 1, sign_n = n == 3 || n == 4 ? -1 : 1;
            const double length =
                (i % 3 < 2 ? frame->numbers->size : 1) * (n % 3 < 2 ? frame->numbers->size : 1);
            bend[i][n] = sign_i * sign_n * k[of[i]][of[n]] / length;
        }
}

void pm_constraint_straight(const pm_frame *frame, const pm_constraint *c,
                            double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES])
{
    (void)frame;
    (void)c;
    (void)bend;
}

/* Of a cord over a rim: those of its strands, which share the body of the rim. */
static void of_strands(pm_frame *frame, const pm_constraint *c,
                       double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES])
{
    static const int place[2][2] = {{0, 2}, {2, 1}};
    double of[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES], share[2];
    pm_constraint strand[2];
    pm_constraint_cord_strands(c, strand);
    pm_constraint_cord_tensions(c, share);
    for (int n = 0; n < 2; n++) {
        from_velocities(frame, &strand[n], of);
        for (int i = 0; i < 6; i++)
            for (int k = 0; k < 6; k++)
                bend[3 * place[n][i / 3] + i % 3][3 * place[n][k / 3] + k % 3] += share[n] * of[i][k];
    }
}

void pm_constraint_bend(pm_frame *frame, const pm_constraint *c,
                        double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES])
{
    const pm_constraint_ops *ops = pm_constraint_kind(c->kind);
    memset(bend, 0, sizeof(double[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES]));
    if (c->over)
        of_strands(frame, c, bend);
    else if (ops->bend)
        ops->bend(frame, c, bend);
    else
        from_velocities(frame, c, bend);
}

void pm_constraint_bend_along(const pm_frame *frame, const pm_constraint *c,
                              double bend[PM_CONSTRAINT_COORDINATES][PM_CONSTRAINT_COORDINATES],
                              const double *v, double out[PM_CONSTRAINT_COORDINATES])
{
    for (int i = 0; i < 3 * pm_constraint_bodies(c); i++)
        out[i] = pm_constraint_jacobian_times(frame, c, bend[i], v);
}

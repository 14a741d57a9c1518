/* rk_formula.c - the formula DOP853 (dop853.h): the stages and the end of a step, its error, y inside it.
 *
 *   y_s = y0 + h sum_j a_sj k_j,    k_s = y'(t0 + c_s h, y_s),    y1 = y0 + h sum_s b_s k_s
 *
 * Error in the norm of Hairer, Norsett, Wanner I, II.10.  With x = (t - t0) / h the dense output is
 *
 *   y(t) = y0 + x (d_0 + (1 - x) (d_1 + x (d_2 + (1 - x) (d_3 + ...)))) */
#include <math.h>
#include <string.h>

#include "numerics/lanes.h"
#include "routes/rk/dop853.h"
#include "routes/rk/rk.h"
#include "state/workspace.h"
#include "tree/tree.h"

/* y = y0 + h sum_k weight[k] stage[k] for the first n of `stride` entries; k is 0 and from .. to - 1. */
static inline void combine(int n, int stride, const double *y0, double h, double sum, const double *weight,
                           int from, int to, const double *stage, double *y)
{
    int i = 0;
    for (; i + 4 <= n; i += 4) {
        const double *x = stage + i;
        const pm_lanes a = pm_lanes_load(x), b = pm_lanes_load(x + 2);
        pm_lanes first = sum * a, second = sum * b;
        x += from * stride;
        for (int k = from; k < to; k++, x += stride) {
            first += weight[k] * (pm_lanes_load(x) - a);
            second += weight[k] * (pm_lanes_load(x + 2) - b);
        }
        pm_lanes_store(y + i, pm_lanes_load(y0 + i) + h * first);
        pm_lanes_store(y + i + 2, pm_lanes_load(y0 + i + 2) + h * second);
    }
    for (; i < n; i++) {
        double slope = sum * stage[i];
        for (int k = from; k < to; k++) slope += weight[k] * (stage[k * stride + i] - stage[i]);
        y[i] = y0[i] + h * slope;
    }
}

int pm_rk_stages(pm_workspace *w, double h, double *k, double *y)
{
    struct pm_rk *r = w->rk;
    const int swift = r->swift;
    for (int s = 1; s < STAGES; s++) {
        combine(r->controlled, r->all, r->y0, h, stage_time[s], stage_weight[s], stage_from[s], s, k, y);
        const int with_ledger = r->ledger && step_weight[s] != 0;
        const int status = swift && !with_ledger ? pm_tree_small_derivative(w, y, k + s * r->all)
                                                 : pm_rk_derivative(w, r->t0 + stage_time[s] * h, y,
                                                                    with_ledger, k + s * r->all);
        if (status) return status;
    }
    const int n = r->ledger ? r->all : r->controlled;
    combine(n, r->all, r->y0, h, 1, step_weight, STEP_FROM, STAGES, k, y);
    memcpy(y + n, r->y0 + n, (size_t)(r->all - n) * sizeof *y);
    return PM_OK;
}

void pm_rk_last_stage(const struct pm_rk *r, double *y)
{
    const int s = STAGES - 1;
    combine(r->controlled, r->all, r->y0, r->h, stage_time[s], stage_weight[s], stage_from[s], s, r->k, y);
}

/* Sums of the squares of scale times sum_k weight[k] stage[k], by the three estimators; k is 0 and STEP_FROM .. STAGES - 1. */
static void error_squares(const struct pm_rk *r, double *of_5, double *beside, double *of_3)
{
    const int n = r->controlled;
    pm_lanes sum5 = {0, 0}, sum_beside = {0, 0}, sum3 = {0, 0};
    for (int i = 0; i < n; i += 2) {
        const double *k = r->k + i; /* one number more than there are is read, not used */
        pm_lanes x = pm_lanes_load(k), scale = pm_lanes_load(r->scale + i);
        pm_lanes e5 = error_weight_5[0] * x, b = error_weight_5_beside[0] * x, e3 = error_weight_3[0] * x;
        k += STEP_FROM * r->all;
        for (int s = STEP_FROM; s < STAGES; s++, k += r->all) {
            x = pm_lanes_load(k);
            e5 += error_weight_5[s] * x;
            b += error_weight_5_beside[s] * x;
            e3 += error_weight_3[s] * x;
        }
        e5 *= scale, b *= scale, e3 *= scale;
        if (i + 1 == n) e5[1] = b[1] = e3[1] = 0;
        sum5 += e5 * e5;
        sum_beside += b * b;
        sum3 += e3 * e3;
    }
    *of_5 = pm_lanes_sum(sum5);
    *beside = pm_lanes_sum(sum_beside);
    *of_3 = pm_lanes_sum(sum3);
}

double pm_rk_error(const struct pm_rk *r, double h, double rounding)
{
    double of_5, beside, of_3;
    error_squares(r, &of_5, &beside, &of_3);
    const double e5 = sqrt((of_5 + PM_RK_BESIDE * beside) / (1 + PM_RK_BESIDE)) - rounding / h;
    return e5 <= 0 ? 0 : h * e5 * e5 / sqrt((e5 * e5 + 0.01 * of_3) * r->controlled); /* NaN stays NaN */
}

static int prepare_dense(pm_workspace *w)
{
    struct pm_rk *r = w->rk;
    const int n = r->controlled, all = r->all;
    for (int s = STAGES + 1; s < ALL_STAGES; s++) {
        combine(n, all, r->y0, r->h, stage_time[s], stage_weight[s], stage_from[s], s, r->k, r->y);
        const int status = pm_rk_derivative(w, r->t0 + stage_time[s] * r->h, r->y, 0, r->k + s * all);
        if (status) return status;
    }
    for (int i = 0; i < n; i++) {
        const double change = r->now[i] - r->y0[i], f0 = r->h * r->k[i], f1 = r->h * r->k[STAGES * all + i];
        r->dense[i] = change;
        r->dense[n + i] = f0 - change;
        r->dense[2 * n + i] = 2 * change - (f0 + f1);
        for (int d = 3; d < PM_RK_DENSE; d++) {
            double sum = 0;
            for (int s = 0; s < ALL_STAGES; s++) sum += dense_weight[d - 3][s] * r->k[s * all + i];
            r->dense[d * n + i] = r->h * sum;
        }
    }
    r->dense_ready = 1;
    return PM_OK;
}

int pm_rk_dense(pm_workspace *w, double t)
{
    struct pm_rk *r = w->rk;
    const int n = r->controlled;
    if (!r->dense_ready) {
        const int status = prepare_dense(w);
        if (status) return status;
    }
    const double x = (t - r->t0) / r->h;
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int d = PM_RK_DENSE - 1; d >= 0; d--)
            sum = (sum + r->dense[d * n + i]) * (d % 2 == 0 ? x : 1 - x);
        r->y[i] = r->y0[i] + sum;
    }
    memcpy(r->y + n, r->y0 + n, (size_t)(r->all - n) * sizeof *r->y);
    return PM_OK;
}

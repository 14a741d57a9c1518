/* quadratic_program.c - s = s+ - s-, and with the multipliers l of the conditions
 *
 *   [K -K -A^T; -K K A^T; A -A 0] [s+; s-; l] + [c; -c; b] >= 0,  [s+; s-; l] >= 0,  one of each pair is 0. */
#include "numerics/quadratic_program.h"

#include <string.h>

static void fill(const pm_quadratic_program *x, double *matrix, double *q)
{
    const int k = x->k, n = x->n, m = 2 * k + n;
    memset(matrix, 0, (size_t)m * m * sizeof *matrix);
    for (int i = 0; i < 2 * k; i++) {
        const double sign = i < k ? 1 : -1;
        q[i] = sign * x->c[i % k];
        for (int j = 0; j < 2 * k && x->K; j++)
            matrix[i * m + j] = sign * (j < k ? 1 : -1) * x->K[i % k * k + j % k];
        for (int r = 0; r < n; r++) {
            matrix[i * m + 2 * k + r] = -sign * x->A[r * k + i % k];
            matrix[(2 * k + r) * m + i] = sign * x->A[r * k + i % k];
        }
    }
    memcpy(q + 2 * k, x->b, (size_t)n * sizeof *q);
}

int pm_quadratic_program_solve(const pm_quadratic_program *x)
{
    const int m = 2 * x->k + x->n;
    double *matrix = x->scratch, *q = matrix + (size_t)m * m, *z = q + m, *lemke = z + m;
    fill(x, matrix, q);
    if (!pm_lemke_solve(m, matrix, q, 0, lemke, x->basis, z)) return 0;
    for (int i = 0; i < x->k; i++) x->s[i] = z[i] - z[x->k + i];
    memcpy(x->bound, z + 2 * x->k, (size_t)x->n * sizeof *z);
    return 1;
}

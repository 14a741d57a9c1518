/* Lemke's method on problems full of ties: whole numbers, M positive semidefinite of low rank with or without a skew part, q
 * such that there is a solution.  For these it ends with one whatever ties there are, if they are broken by rows of the inverse
 * basis. [R. W. Cottle, J.-S. Pang and R. E. Stone, The Linear Complementarity Problem, 1992, theorem 4.4.13] */
#include "numerics/lemke.h"

#include <string.h>

#include "check.h"

#define MOST 8
#define PROBLEMS 20000
#define CLOSE 1e-6

static double whole(void) { return floor(check_random(0, 3)) - 1; }

/* M = A A^T, and a skew part. */
static void pose(int m, int rank, int skew, double *matrix)
{
    double a[MOST * MOST];
    for (int i = 0; i < m * rank; i++) a[i] = whole();
    memset(matrix, 0, (size_t)m * m * sizeof *matrix);
    for (int i = 0; i < m * m; i++)
        for (int k = 0; k < rank; k++) matrix[i] += a[i / m * rank + k] * a[i % m * rank + k];
    for (int i = 0; i < m && skew; i++)
        for (int k = i + 1; k < m; k++) {
            const double s = whole();
            matrix[i * m + k] += s;
            matrix[k * m + i] -= s;
        }
}

/* q = w - M z for some z, w >= 0 that complement each other. */
static void choose(int m, const double *matrix, double *q)
{
    double z[MOST];
    for (int i = 0; i < m; i++) {
        z[i] = check_random(0, 1) < 0.5;
        q[i] = z[i] == 0 && check_random(0, 1) < 0.4;
    }
    for (int i = 0; i < m; i++)
        for (int k = 0; k < m; k++) q[i] -= matrix[i * m + k] * z[k];
}

static void ties(int n)
{
    const int m = 3 + n % (MOST - 2), rank = n % 4 == 0 ? m : 2;
    double matrix[MOST * MOST], q[MOST], z[MOST], scratch[PM_LEMKE_SCRATCH(MOST)];
    int basis[MOST];
    pose(m, rank, n % 4 != 1, matrix);
    choose(m, matrix, q);
    if (!CHECK(pm_lemke_solve(m, matrix, q, 0, scratch, basis, z))) return;
    for (int i = 0; i < m; i++) {
        double w = q[i];
        for (int k = 0; k < m; k++) w += matrix[i * m + k] * z[k];
        CHECK(w > -CLOSE && z[i] >= 0 && fabs(w * z[i]) < CLOSE);
    }
}

int main(void)
{
    for (int n = 0; n < PROBLEMS; n++) ties(n);
    return check_failures();
}

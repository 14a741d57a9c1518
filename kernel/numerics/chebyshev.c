/* chebyshev.c - the polynomial through values at the Chebyshev-Lobatto nodes of [0, 1].
 *
 * Values by the barycentric formula; integrals by the Gauss-Legendre formula that is exact for its degree: 5 points up to
 * degree 9, 9 points up to degree 17. */
#include "numerics/chebyshev.h"

#include <math.h>
#include <stddef.h>

#include "numerics/bracket.h"
#include "numerics/lanes.h"
#include "numerics/minmax.h"

#define SHORT 5
#define LONG 9

static const double short_at[SHORT] = {0.0469100770306680036, 0.230765344947158454, 0.5, 0.769234655052841546,
                                       0.953089922969331996};
static const double short_weight[SHORT] = {0.118463442528094544, 0.239314335249683234, 0.284444444444444444,
                                           0.239314335249683234, 0.118463442528094544};
static const double long_at[LONG] = {
    0.0159198802461869551, 0.0819844463366821029, 0.193314283649704801, 0.337873288298095535, 0.5,
    0.662126711701904465,  0.806685716350295199,  0.918015553663317897, 0.984080119753813045};
static const double long_weight[LONG] = {0.040637194180787206, 0.090324080347428702, 0.130305348201467731,
                                         0.15617353852000142,  0.165119677500629882, 0.15617353852000142,
                                         0.130305348201467731, 0.090324080347428702, 0.040637194180787206};

double pm_chebyshev_value(const pm_chebyshev_nodes *nodes, const double *value, int stride, double s)
{
    const double *at = nodes->at;
    const int last = nodes->n - 1;
    double above = 0, below = 0, sign = 1;
    for (int k = 0; k <= last; k++, sign = -sign) {
        const double d = s - at[k];
        if (d == 0) return value[k * stride];
        const double c = (k == 0 || k == last ? 0.5 * sign : sign) / d;
        above += c * value[k * stride];
        below += c;
    }
    return above / below;
}

double pm_chebyshev_integral(const pm_chebyshev_nodes *nodes, const double *value, int stride, double s)
{
    const int few = nodes->n <= 2 * SHORT, points = few ? SHORT : LONG;
    const double *at = few ? short_at : long_at, *weight = few ? short_weight : long_weight;
    double sum = 0;
    for (int i = 0; i < points; i++) sum += weight[i] * pm_chebyshev_value(nodes, value, stride, s * at[i]);
    return s * sum;
}

static double times(const double *weight, const double *value, int n)
{
    double sum = 0;
    for (int k = 0; k < n; k++) sum += weight[k] * value[k];
    return sum;
}

/* Two nodes at once; their number is odd. */
double pm_chebyshev_high(const pm_chebyshev_nodes *nodes, const double *value)
{
    const int end = nodes->n - 1;
    const double *one = nodes->last, *other = nodes->last + nodes->n;
    pm_lanes a = {one[end] * value[end], 0}, b = {other[end] * value[end], 0};
    for (int k = 0; k < end; k += 2) {
        const pm_lanes x = pm_lanes_load(value + k);
        a += pm_lanes_load(one + k) * x;
        b += pm_lanes_load(other + k) * x;
    }
    return pm_max(fabs(pm_lanes_sum(a)), fabs(pm_lanes_sum(b)));
}

double pm_chebyshev_tail(const pm_chebyshev_nodes *nodes, const double *value)
{
    double size = 0;
    for (int k = 0; k < nodes->n; k++) size = pm_max(fabs(value[k]), size);
    return size > 0 ? pm_chebyshev_high(nodes, value) / size : 0;
}

double pm_chebyshev_slope_at(const pm_chebyshev_nodes *nodes, const double *value, int node)
{
    return times(nodes->slope + node * nodes->n, value, nodes->n);
}

void pm_chebyshev_integrals(const pm_chebyshev_nodes *nodes, const double *value, double *sum)
{
    for (int k = 0; k < nodes->n; k++) sum[k] = times(nodes->integral + k * nodes->n, value, nodes->n);
}

double pm_chebyshev_whole(const pm_chebyshev_nodes *nodes, const double *value)
{
    return times(nodes->integral + (nodes->n - 1) * nodes->n, value, nodes->n);
}

typedef struct pm_polynomial {
    const pm_chebyshev_nodes *nodes;
    const double *value;
    double slope; /* where it was looked at last */
} pm_polynomial;

/* p' = sum c_k (p - f_k) / (s - s_k) / sum c_k, c_k = w_k / (s - s_k) */
double pm_chebyshev_slope(const pm_chebyshev_nodes *nodes, const double *value, double s, double *here)
{
    const int last = nodes->n - 1;
    double above = 0, below = 0, steep = 0, steeper = 0, sign = 1;
    for (int k = 0; k <= last; k++, sign = -sign) {
        const double d = s - nodes->at[k];
        if (d == 0) {
            *here = value[k];
            return pm_chebyshev_slope_at(nodes, value, k);
        }
        const double inverse = 1 / d, c = (k == 0 || k == last ? 0.5 * sign : sign) * inverse;
        above += c * value[k];
        below += c;
        steep += c * inverse * value[k];
        steeper += c * inverse;
    }
    *here = above / below;
    return (*here * steeper - steep) / below;
}

static double at(void *polynomial, double s, void *context, double *slope)
{
    pm_polynomial *p = polynomial;
    double here;
    (void)context;
    *slope = p->slope = pm_chebyshev_slope(p->nodes, p->value, s, &here);
    return here;
}

int pm_chebyshev_root(const pm_chebyshev_nodes *nodes, const double *value, double a, double fa, double b,
                      double fb, double *s, double *slope)
{
    pm_polynomial p = {nodes, value, NAN};
    const int status = pm_bracket_newton(at, &p, NULL, a, fa, b, fb, s);
    *slope = p.slope;
    return status;
}

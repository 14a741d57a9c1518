/* series.c - the polynomial of degree 8 through values at the Chebyshev-Lobatto nodes of [0, 1].
 *
 * Values by the barycentric formula; integrals by Gauss-Legendre formulas that are exact for that degree: 5 points for
 * the polynomial itself, 9 for g(w^2), to which s = w^2 turns g(s) / sqrt(s). */
#include "series.h"

#include <math.h>

#include "event.h"
#include "root.h"

#define N PM_NODES_MOST
#define PLAIN 5
#define ROOT 9

static const double plain_at[PLAIN] = {0.0469100770306680036, 0.230765344947158454, 0.5, 0.769234655052841546,
                                       0.953089922969331996};
static const double plain_weight[PLAIN] = {0.118463442528094544, 0.239314335249683234, 0.284444444444444444,
                                           0.239314335249683234, 0.118463442528094544};
static const double root_at[ROOT] = {
    0.0159198802461869551, 0.0819844463366821029, 0.193314283649704801, 0.337873288298095535, 0.5,
    0.662126711701904465,  0.806685716350295199,  0.918015553663317897, 0.984080119753813045};
static const double root_weight[ROOT] = {0.040637194180787206, 0.090324080347428702, 0.130305348201467731,
                                         0.15617353852000142,  0.165119677500629882, 0.15617353852000142,
                                         0.130305348201467731, 0.090324080347428702, 0.040637194180787206};
/* Coefficients of the Chebyshev polynomials of degree 7 and 8, of the sum with halved ends. */
static const double last[2][N] = {{-0.125, 0.230969883127821689, -0.176776695296636881, 0.0956708580912724429,
                                   0, -0.0956708580912724429, 0.176776695296636881, -0.230969883127821689,
                                   0.125},
                                  {0.0625, -0.125, 0.125, -0.125, 0.125, -0.125, 0.125, -0.125, 0.0625}};

/* Integrals from 0 to each node of the polynomial through the samples. */
static const double integral[N][N] = {
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0.015446942589330503, 0.0245714827645891713, -0.00272920316931175515, 0.00120327178475258205,
     -0.000725485879564450569, 0.000519333276389297193, -0.000418521846936992318, 0.000370471635777763454,
     -0.000178057410669496999},
    {0.00116227467783116062, 0.0905074980671016493, 0.0617039298990436991, -0.0101495035930345914,
     0.00525418597066119917, -0.00354480910215512417, 0.00277836480016473876, -0.00242760599071765423,
     0.00116227467783116062},
    {0.0132993390173217848, 0.0610025790877815766, 0.15851788614537362, 0.0857880097303461294,
     -0.0148111620896931339, 0.00811411017937561485, -0.00583809919891828365, 0.00491128192854602109,
     -0.00232566098267821519},
    {0.00396825396825396825, 0.0816543373161876208, 0.128766834940148802, 0.199309711753153823,
     0.0984126984126984127, -0.0184507823929089319, 0.0109157047423908809, -0.00854501270817854328,
     0.00396825396825396825},
    {0.0102621689191861517, 0.0681980426794630564, 0.145520638881457966, 0.172744819180869276,
     0.211636558915089959, 0.0950709196298987614, -0.0188353464628339376, 0.012106745520227501,
     -0.0053628310808138483},
    {0.00677423325867677589, 0.0755369305987267317, 0.136904174882374944, 0.184403738462400015,
     0.191571210854735626, 0.191008432953279482, 0.0779786097834959834, -0.0173981734590925718,
     0.00677423325867677589},
    {0.00811456534717743351, 0.0727388529722313141, 0.140101061529476675, 0.180339596083855594,
     0.197550882704961276, 0.179655657575492309, 0.142411742851851438, 0.0485378418434199062,
     -0.00751043465282256649},
    {0.00793650793650793651, 0.0731093246080090775, 0.139682539682539683, 0.180858929360244891,
     0.196825396825396825, 0.180858929360244891, 0.139682539682539683, 0.0731093246080090775,
     0.00793650793650793651}};

double pm_series_value(const double *value, int stride, double s)
{
    const double *at = pm_nodes_chebyshev.at;
    double above = 0, below = 0;
    for (int k = 0; k < N; k++) {
        const double d = s - at[k];
        if (d == 0) return value[k * stride];
        const double c = (k % 2 ? -1 : 1) * (k == 0 || k == N - 1 ? 0.5 : 1) / d;
        above += c * value[k * stride];
        below += c;
    }
    return above / below;
}

double pm_series_integral(const double *value, int stride, double s)
{
    double sum = 0;
    for (int i = 0; i < PLAIN; i++) sum += plain_weight[i] * pm_series_value(value, stride, s * plain_at[i]);
    return s * sum;
}

double pm_series_integral_leaving(const double *g, double s)
{
    const double end = sqrt(s);
    double sum = 0;
    for (int i = 0; i < ROOT; i++)
        sum += root_weight[i] * pm_series_value(g, 1, end * root_at[i] * end * root_at[i]);
    return 2 * end * sum;
}

double pm_series_integral_resting(const double *g, double s)
{
    const double begin = sqrt(1 - s);
    double sum = 0;
    for (int i = 0; i < ROOT; i++)
        sum += root_weight[i] * pm_series_value(g, 1, 1 - begin * root_at[i] * begin * root_at[i]);
    return 2 * begin * sum;
}

double pm_series_tail(const double *value)
{
    double high = 0, size = 0;
    for (int d = 0; d < 2; d++) {
        double c = 0;
        for (int k = 0; k < N; k++) c += last[d][k] * value[k];
        high = fmax(high, fabs(c));
    }
    for (int k = 0; k < N; k++) size = fmax(size, fabs(value[k]));
    return size > 0 ? high / size : 0;
}

void pm_series_slopes(const double *value, double *slope)
{
    const double *weight = pm_nodes_chebyshev.slope;
    for (int k = 0; k < N; k++) {
        slope[k] = 0;
        for (int i = 0; i < N; i++) slope[k] += weight[k * N + i] * value[i];
    }
}

static double at(pm_workspace *w, double s, void *value)
{
    (void)w;
    return pm_series_value(value, 1, s);
}

int pm_series_root(pm_workspace *w, const double *value, double a, double fa, double b, double fb, double *s)
{
    return pm_root_find(w, w->event->solver, at, (void *)(uintptr_t)value, a, fa, b, fb, s);
}

void pm_series_integrals(const double *value, double *sum)
{
    for (int k = 0; k < N; k++) {
        sum[k] = 0;
        for (int i = 0; i < N; i++) sum[k] += integral[k][i] * value[i];
    }
}

/* chebyshev.h - the polynomial through values at the nodes of a step; s is the fraction of the step.  All but the slopes:
 * Chebyshev-Lobatto nodes. */
#ifndef PM_CHEBYSHEV_H
#define PM_CHEBYSHEV_H

#include "numerics/chebyshev_nodes.h"

double pm_chebyshev_value(const pm_chebyshev_nodes *nodes, const double *node_value, int stride, double s);
/* Its slope (by s) at a node. */
double pm_chebyshev_slope_at(const pm_chebyshev_nodes *nodes, const double *node_value, int node);
/* Its slope at s, and its value there. */
double pm_chebyshev_slope(const pm_chebyshev_nodes *nodes, const double *node_value, double s, double *here);
/* Integral from 0 to s. */
double pm_chebyshev_integral(const pm_chebyshev_nodes *nodes, const double *node_value, int stride, double s);
/* Integrals from 0 to each node. */
void pm_chebyshev_integrals(const pm_chebyshev_nodes *nodes, const double *node_value, double *integral);
/* Over all of [0, 1]. */
double pm_chebyshev_whole(const pm_chebyshev_nodes *nodes, const double *value);
/* The greater of the two highest coefficients. */
double pm_chebyshev_high(const pm_chebyshev_nodes *nodes, const double *node_value);
/* How far the highest coefficients stand off from the largest: about the relative error of the polynomial. */
double pm_chebyshev_tail(const pm_chebyshev_nodes *nodes, const double *node_value);
/* A root between a and b, where it takes the values fa and fb of different sign; *slope: next to it, not a number where one
 * of these is zero.  Returns enum pm_search_end (bracket.h). */
int pm_chebyshev_root(const pm_chebyshev_nodes *nodes, const double *node_value, double a, double fa,
                      double b, double fb, double *s, double *slope);

#endif

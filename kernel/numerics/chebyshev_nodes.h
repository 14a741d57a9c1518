/* chebyshev_nodes.h - where a step is sampled for events and extremes: fractions of the step, its ends included, and the weights
 * of what the polynomial through the samples tells. */
#ifndef PM_CHEBYSHEV_NODES_H
#define PM_CHEBYSHEV_NODES_H

#define PM_NODES 5 /* equidistant: routes that step in time */
#define PM_NODES_MOST \
    17 /* Chebyshev-Lobatto: the path route, which takes every second of them where that is enough */
#define PM_NODES_CLOCK 33 /* of these again: its clock */

typedef struct pm_chebyshev_nodes {
    const struct pm_chebyshev_nodes *finer; /* these and more; NULL: none */
    int n;
    const double *at;       /* [n] from 0 to 1 */
    const double *slope;    /* [n][n] times samples: slopes by the fraction */
    const double *integral; /* [n][n] likewise: integrals from 0 to each node; NULL: equidistant nodes */
    const double *last;     /* [2][n]: the two highest Chebyshev coefficients */
} pm_chebyshev_nodes;

extern const pm_chebyshev_nodes pm_chebyshev_nodes_equal, pm_chebyshev_nodes_halves, pm_chebyshev_nodes_9,
    pm_chebyshev_nodes_17;
/* cos(pi m / (PM_NODES_CLOCK - 1)), a whole turn */
extern const double pm_chebyshev_nodes_cosine[2 * PM_NODES_CLOCK - 2];

/* Samples there tell a smooth function nearly to rounding. */
static inline int pm_chebyshev_nodes_spectral(const pm_chebyshev_nodes *nodes)
{
    return nodes->integral != 0;
}

#endif

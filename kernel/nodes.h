/* nodes.h - where a step is sampled for events and extremes: fractions of the step, its ends included, and the weights
 * of the slopes of the polynomial through the samples. */
#ifndef PM_NODES_H
#define PM_NODES_H

#define PM_NODES 5      /* equidistant: routes that step in time */
#define PM_NODES_MOST 9 /* Chebyshev-Lobatto: the path route */

typedef struct pm_nodes {
    int n;
    const double *at;    /* [n] from 0 to 1 */
    const double *slope; /* [n][n] times samples: slopes by the fraction */
} pm_nodes;

extern const pm_nodes pm_nodes_equal, pm_nodes_chebyshev;

#endif

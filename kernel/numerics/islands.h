/* islands.h - which of n things hang together: a forest whose roots name the islands (union-find).
 *
 * parent[i] leads from i towards the root of its island, whose parent is itself; the caller owns parent[n].  The root of an
 * island is the least of its members, whatever the order in which they were joined. */
#ifndef PM_ISLANDS_H
#define PM_ISLANDS_H

/* Each is an island of its own. */
static inline void pm_islands_begin(int *parent, int n)
{
    for (int i = 0; i < n; i++) parent[i] = i;
}

/* The root of the island of i; ways to it become shorter. */
static inline int pm_islands_root(int *parent, int i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/* The islands of a and b are one from now on. */
static inline void pm_islands_join(int *parent, int a, int b)
{
    const int x = pm_islands_root(parent, a), y = pm_islands_root(parent, b);
    parent[x > y ? x : y] = x > y ? y : x;
}

#endif

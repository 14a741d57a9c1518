/* tree_order.c - the order of the coordinates and of the loop constraints, so that what belongs together is near. */
#include "elements/constraint.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

/* A body comes after all that it carries, and branches one after the other: the mass matrix then does not fill in when it is
 * factored, and loops between neighbours are narrow. */
static void number_coordinates(pm_tree *t)
{
    const int ground = t->model->nbody;
    int top = t->n; /* of what is left for bodies on the ground */
    for (int i = 0; i < ground; i++) t->weight[i] = t->node[i].ncoordinate;
    for (int i = ground - 1; i >= 0; i--)
        if (t->node[i].parent != ground) t->weight[t->placed[t->node[i].parent] - 1] += t->weight[i];
    for (int i = 0; i < ground; i++) {
        const int parent = t->node[i].parent;
        int *left = parent == ground ? &top : &t->top[t->placed[parent] - 1];
        t->top[i] = t->node[i].first = *left - t->node[i].ncoordinate;
        *left -= t->weight[i];
    }
    for (int i = 0; i < t->model->nbody; i++) {
        const pm_tree_node *x = &t->node[i];
        for (int k = 0; k < x->ncoordinate; k++)
            t->kind[x->first + k] = x->placement == FREE                 ? k
                                    : x->placement == SLIDER             ? PM_TREE_LENGTH
                                    : pm_tree_shifts(x) && k == x->shift ? PM_TREE_DIRECTION
                                                                         : PM_TREE_ANGLE;
    }
}

/* The coordinates that move a body, in falling order: those of its parent and its own. */
static void list_coordinates(pm_tree *t)
{
    int n = 0;
    for (int k = 0; k < t->n; k++) t->first_coupled[k] = k;
    for (int i = 0; i < t->model->nbody; i++) {
        pm_tree_node *x = &t->node[i];
        x->list = n;
        if (x->parent != t->model->nbody) {
            const pm_tree_node *parent = &t->node[t->placed[x->parent] - 1];
            for (int k = 0; k < parent->nlist; k++) t->moved_by[n++] = t->moved_by[parent->list + k];
        }
        for (int k = x->ncoordinate; k-- > 0;) t->moved_by[n++] = x->first + k;
        x->nlist = n - x->list;
        for (int k = x->list; k < n; k++)
            if (t->moved_by[n - 1] < t->first_coupled[t->moved_by[k]])
                t->first_coupled[t->moved_by[k]] = t->moved_by[n - 1];
    }
}

void pm_tree_loop_ends(const pm_tree *t, const pm_constraint *c, int *low, int *high)
{
    *low = t->n;
    *high = -1;
    for (int p = 0; p < pm_constraint_bodies(c); p++) {
        if (c->body[p] == t->model->nbody) continue;
        const pm_tree_node *x = &t->node[t->placed[c->body[p]] - 1];
        if (x->nlist == 0) continue;
        const int first = t->moved_by[x->list], last = t->moved_by[x->list + x->nlist - 1]; /* they fall */
        if (last < *low) *low = last;
        if (first > *high) *high = first;
    }
}

/* Loop constraints in the order of the bodies that they hold, so that what each shares with others is near. */
static void list_loops(const pm_active_set *active, pm_tree *t)
{
    for (int i = 0; i < active->n; i++) {
        if (t->used[i]) continue;
        int low, key, at = t->nloop++;
        pm_tree_loop_ends(t, &active->constraint[i], &low, &key);
        for (; at > 0 && t->to[at - 1] < key; at--) {
            t->loop[at] = t->loop[at - 1];
            t->to[at] = t->to[at - 1];
        }
        t->loop[at] = i;
        t->to[at] = key;
    }
}

/* Where the loop constraints, and what elimination makes of them, are not zero: up to the last coordinate of what they
 * hold, which the mass matrix does not couple to those after it.  No row ends, or meets the first that shares some of
 * that with it, before the row before it does. */
static void bound_loops(const pm_active_set *active, pm_tree *t)
{
    for (int i = 0, first = 0; i < t->nloop; i++) {
        pm_tree_loop_ends(t, &active->constraint[t->loop[i]], &t->from[i], &t->to[i]);
        t->to[i]++;
        while (first < i && t->from[first] >= t->to[i]) first++;
        t->first_loop[i] = first;
    }
}

void pm_tree_order(const pm_active_set *active, pm_tree *t)
{
    number_coordinates(t);
    list_coordinates(t);
    list_loops(active, t);
    bound_loops(active, t);
}

/* tree_cost.c - whether accelerations come cheaper from the coordinates of a tree or from all its constraints. */
#include "elements/constraint.h"
#include "numerics/tolerances.h"
#include "state/workspace.h"
#include "tree/tree.h"
#include "tree/tree_node.h"

/* Multiplications of a solve in the coordinates: of the mass matrix, body by body, and of its factor. */
static double cost_of_coordinates(const pm_tree *t)
{
    double sum = 0;
    for (int i = 0; i < t->model->nbody; i++) sum += 1.5 * (double)t->node[i].nlist * t->node[i].nlist;
    for (int k = 0; k < t->n; k++) sum += 0.5 * (double)(k - t->first_coupled[k]) * (k - t->first_coupled[k]);
    return sum;
}

/* The same of all constraints in their order, by the envelope of their system. */
static double cost_of_constraints(const pm_active_set *active, int *first_of_body, int nbody)
{
    double sum = 0;
    for (int i = 0; i < nbody; i++) first_of_body[i] = PM_NONE;
    for (int i = 0; i < active->n; i++) {
        int first = i;
        for (int p = 0; p < pm_constraint_bodies(&active->constraint[i]); p++) {
            const int body = active->constraint[i].body[p];
            if (body == nbody) continue;
            if (first_of_body[body] == PM_NONE) first_of_body[body] = i;
            if (first_of_body[body] < first) first = first_of_body[body];
        }
        sum += PM_TREE_WHOLE_EACH + 0.5 * (double)(i - first) * (i - first);
    }
    return sum;
}

/* Large trees hang together by few bodies: a chain of n links takes n^3 in its angles, and n by its pins. */
int pm_tree_is_whole(const pm_workspace *w)
{
    const pm_tree *t = w->tree;
    return t->n > PM_TREE_SUMMED && cost_of_constraints(&w->active, w->saddle.first_constraint,
                                                        w->model->nbody) < cost_of_coordinates(t);
}

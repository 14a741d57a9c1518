/* tree_augmented.h - the equations of a tree whose parts turn about each other, with what stays the same summed up once.
 * For the tree's own files. */
#ifndef PM_TREE_AUGMENTED_H
#define PM_TREE_AUGMENTED_H

#include "tree/tree.h"

/* Memory, for at most n coordinates and `most` entries of moved_by; doubles that are needed. */
size_t pm_tree_augmented_doubles(size_t n, size_t most);
void pm_tree_augmented_create(pm_tree_augmented *x, size_t n, size_t most, double *block);

/* Directions and rates of the turning coordinates from the frame; or from coordinates and rates alone. */
void pm_tree_augmented_read(pm_workspace *w);
void pm_tree_augmented_set(pm_workspace *w, const double *y, const double *ydot);
/* The lower triangle of B^T M B in t->mass, and right-hand side -B^T M c + weights (unless there are other forces: then all
 * of frame.f). */
void pm_tree_augmented_equations(pm_workspace *w, double *x);
/* Velocities of the bodies that loop rows or forces need, by unit rates (t->influence), and their c (t->bias). */
void pm_tree_augmented_influence(pm_workspace *w);

#endif

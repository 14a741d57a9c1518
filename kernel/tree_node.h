/* tree_node.h - how one body is placed on its parent; shared by the tree's own files. */
#ifndef PM_TREE_NODE_H
#define PM_TREE_NODE_H

enum pm_placement { FREE, PIN, WELD, SLIDER, ROLL_LINE, ROLL_CIRCLE };

struct pm_tree_node {
    int body, parent, placement;
    int child_is_a;
    int first;       /* its first coordinate */
    int turns;       /* its body does */
    double child[2]; /* mark on the body */
    double mark[2];  /* mark on the parent */
    double angle;    /* weld, slider: angle of a minus angle of b */
    double line;     /* direction of the line in b */
    double radius_a, radius_b, length;
    int memory;
};

#endif

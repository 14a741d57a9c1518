/* tree_node.h - how one body is placed on its parent; shared by the tree's own files.
 *
 * Velocities of a body c from those of its parent p (tree_place.c sets the vectors at the frame's pose):
 *   v_c = v_p + omega_p by_parent + omega_c by_own + rate by_slide,
 * omega_c the parent's (weld, slider), zero (a particle) or the rate of its own coordinate; `rate` along a slider's line, or
 * of the direction of a link. */
#ifndef PM_TREE_NODE_H
#define PM_TREE_NODE_H

enum pm_placement { FREE, PIN, WELD, LINK, SLIDER, ROLL_LINE, ROLL_CIRCLE };

struct pm_tree_node {
    int body, parent, placement;
    int child_is_a;
    int first, ncoordinate; /* its own coordinates: an angle comes first */
    int shift;              /* number of the one along the line, or of the link's direction */
    int list, nlist;        /* those that move it, in tree->moved_by */
    int rotates;            /* its body does */
    int needed;             /* at a solve: tree_augmented.c */
    int constraint[PM_JOINT_CONSTRAINTS], nconstraint; /* the active constraints that it solves */
    double child[2];                                   /* mark on the body */
    double mark[2];                                    /* mark on the parent */
    double angle; /* weld, slider: of the body minus that of the parent; link: of the weight, in the scene */
    double rotation[2]; /* its cosine and sine */
    double line[2];     /* direction of the line in b */
    double radius;      /* of a circle on a line */
    double length;      /* distance of the centres, or of the marks of a link */
    double roll_own,
        roll_parent; /* rolling: way, or direction, by the angles of the body and of the parent */
    double touch[2]; /* rolling on a point: P_a - p_b in the axes of the circle's body */
    int memory;
    /* at the frame's pose */
    union {
        struct {
            double r_child[2]; /* mark from the mass centre */
            double rho[2];     /* P_a - p_b */
            double t[2];       /* direction of the line; k x (direction of the centres, or of the link) */
        };
        double arm[PM_TREE_ARM]; /* all that reactions go by */
    };
    double r_mark[2]; /* mark on the parent from its mass centre */
    double by_parent[2], by_own[2], by_slide[2];
};

static inline int pm_tree_follows(const struct pm_tree_node *x)
{
    return x->placement == WELD || x->placement == SLIDER;
}

static inline int pm_tree_shifts(const struct pm_tree_node *x)
{
    return x->placement == LINK || x->placement == SLIDER;
}

/* Velocity of the body at rates own[ncoordinate] of its coordinates, by that of its parent. */
static inline void pm_tree_move(const struct pm_tree_node *x, const double parent[3], const double *own,
                                double to[3])
{
    if (x->placement == FREE) {
        to[0] = own[0];
        to[1] = own[1];
        to[2] = x->rotates ? own[2] : 0;
        return;
    }
    const double omega = pm_tree_follows(x) ? parent[2] : x->rotates ? own[0] : 0;
    to[0] = parent[0] + parent[2] * x->by_parent[0] + omega * x->by_own[0];
    to[1] = parent[1] + parent[2] * x->by_parent[1] + omega * x->by_own[1];
    to[2] = omega;
    if (!pm_tree_shifts(x)) return;
    to[0] += own[x->shift] * x->by_slide[0];
    to[1] += own[x->shift] * x->by_slide[1];
}

/* Rate along a slider's line, or of a link's direction, from the velocities of its two bodies. */
static inline double pm_tree_slide_rate(const struct pm_tree_node *x, const double *parent, const double *own)
{
    double rate = 0;
    for (int k = 0; k < 2; k++)
        rate += x->by_slide[k] * (own[k] - parent[k] - parent[2] * x->by_parent[k] - own[2] * x->by_own[k]);
    return x->placement == LINK ? rate / (x->length * x->length) : rate;
}

/* What is quadratic in the velocities in the acceleration of a body from its parent's. */
static inline void pm_tree_add_quadratic(const struct pm_tree_node *x, const double *parent,
                                         const double *own, double *a)
{
    const double sign = x->child_is_a ? 1 : -1;
    for (int k = 0; k < 2; k++)
        a[k] += own[2] * own[2] * x->r_child[k] - parent[2] * parent[2] * x->r_mark[k];
    if (x->placement <= WELD) return;
    const double s = pm_tree_shifts(x) ? pm_tree_slide_rate(x, parent, own)
                                       : x->roll_own * own[2] + x->roll_parent * parent[2];
    if (x->placement == ROLL_CIRCLE || x->placement == LINK) {
        for (int k = 0; k < 2; k++) a[k] -= sign * s * s * x->rho[k];
        return;
    }
    const double omega = x->child_is_a ? parent[2] : own[2];
    a[0] += sign * (-2 * omega * s * x->t[1] - omega * omega * x->rho[0]);
    a[1] += sign * (2 * omega * s * x->t[0] - omega * omega * x->rho[1]);
}

#endif

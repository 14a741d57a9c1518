"""Faults planted in `kernel/tree/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault("tree: loop rows end before their last", "tree/tree.c", "        t->to[i]++;\n", ""),
    Fault(
        "tree: loop rows share nothing", "tree/tree.c", "t->first_loop[i] = first;", "t->first_loop[i] = i;"
    ),
    Fault(
        "tree: joints that may place a body yet",
        "tree/tree.c",
        "if (i == *spent && is_spent(&w->active, w->tree, &g)) ++*spent;",
        "++*spent;",
    ),
    Fault(
        "tree: the other partner is the parent",
        "tree/tree.c",
        "x->parent = c->body[child_is_a ? 1 : 0]",
        "x->parent = w->model->nbody",
    ),
    Fault(
        "tree: a dropped loop row",
        "tree/tree.c",
        "if (t->used[i]) continue;\n        int low, key",
        "if (t->used[i] || i + 1 == active->n) continue;\n        int low, key",
    ),
    Fault(
        "tree: rolls the wrong way",
        "tree/tree.c",
        "x->roll_own = -sign * c->radius_a",
        "x->roll_own = sign * c->radius_a",
    ),
    Fault(
        "tree: angle of the second partner",
        "tree/tree.c",
        "x->angle = sign * last->value",
        "x->angle = last->value",
    ),
    Fault(
        "rk: summed weights",
        "tree/tree_augmented.c",
        "numbers->gravity[1] * p[0] -",
        "numbers->gravity[1] * p[0] +",
    ),
    Fault("rk: summed centrifugal forces", "tree/tree_augmented.c", "x[k] -= a->square", "x[k] += a->square"),
    Fault(
        "tree: a band that is too narrow",
        "tree/tree_band.c",
        "if (last > t->part.right[j]) t->part.right[j] = last;",
        "if (last - 1 > t->part.right[j]) t->part.right[j] = last - 1;",
    ),
    Fault(
        "tree: a reaction of the wrong sign",
        "tree/tree_dynamics.c",
        "fy = sign * wrench[1]",
        "fy = -sign * wrench[1]",
    ),
    Fault(
        "tree: reactions of children are forgotten",
        "tree/tree_dynamics.c",
        "pm_lanes_load(to) + pm_lanes_load(wrench)",
        "pm_lanes_load(to)",
    ),
    Fault(
        "tree: bias of a mark",
        "tree/tree_node.h",
        "own[2] * own[2] * x->r_child[k] - parent",
        "own[2] * own[2] * x->r_child[k] + parent",
    ),
    Fault(
        "tree: bias along a line", "tree/tree_node.h", "(-2 * omega * s * x->t[1]", "(2 * omega * s * x->t[1]"
    ),
    Fault(
        "tree: bias of circles",
        "tree/tree_node.h",
        "a[k] -= sign * s * s",
        "a[k] += sign * s * s",
    ),
    Fault(
        "tree: a link's rate by its length",
        "tree/tree_node.h",
        "rate / (x->length * x->length)",
        "rate / x->length",
    ),
    Fault(
        "tree: a link's direction in the sums is its body's",
        "tree/tree_augmented.c",
        "if (t->kind[k] == PM_TREE_DIRECTION) {",
        "if (t->kind[k] < 0) {",
    ),
    Fault(
        "tree: a link pulls the other way",
        "tree/tree_place.c",
        "x->by_slide[k] = sign * x->length * x->t[k];",
        "x->by_slide[k] = -sign * x->length * x->t[k];",
    ),
    Fault(
        "tree: a link's direction from the other side",
        "tree/tree_place.c",
        "r[0] * rho[1] - r[1] * rho[0]",
        "r[1] * rho[0] - r[0] * rho[1]",
    ),
    Fault(
        "path: a link keeps its levers",
        "routes/path/path_rigid.c",
        "if (b->holds) set_arm(b, rotation, x, place);",
        "if (b->holds && b->rotates) set_arm(b, rotation, x, place);",
    ),
    Fault(
        "tree: partitioned, without the quadratic part",
        "tree/tree_partition.c",
        "c->gamma - pm_constraint_times(&w->frame, c, a)",
        "-pm_constraint_times(&w->frame, c, a)",
    ),
    Fault(
        "tree: partitioned, a rate of the wrong sign",
        "tree/tree_partition.c",
        "t->residual[i] = -jacobian[i * t->n + independent]",
        "t->residual[i] = jacobian[i * t->n + independent]",
    ),
    Fault(
        "tree: partitioned, reactions of other rows",
        "tree/tree_partition.c",
        "pm_tree_solve_dependent_transposed(t, t->residual)",
        "pm_tree_solve_dependent(t, t->residual)",
    ),
    Fault(
        "tree: sign of a loop row's step",
        "tree/tree_partition.c",
        "y[t->part.column[c]] += t->residual[c]",
        "y[t->part.column[c]] -= t->residual[c]",
    ),
    Fault(
        "tree: the other side of a line",
        "tree/tree_place.c",
        "rho[0] = s * t[0] - x->radius * t[1]",
        "rho[0] = s * t[0] + x->radius * t[1]",
    ),
    Fault("tree: entries of the place before stay", "tree/tree_rates.c", "entry[c] = 0;", "(void)0;"),
    Fault("swift: centrifugal forces", "tree/tree_small.c", "f[k] -= square[i]", "f[k] += square[i]"),
    Fault("swift: gamma", "tree/tree_small.c", "gamma[i] += square[k]", "gamma[i] -= square[k]"),
    Fault("swift: a series is too short", "tree/tree_small.c", "- z2 * (1. / 87178291200)", ""),
    Fault(
        "swift: a series is used far away",
        "tree/tree_small.c",
        "by[0] > -PM_SERIES_REACH",
        "by[0] > -9 * PM_SERIES_REACH",
    ),
    Fault("swift: shifted masses", "tree/tree_small.c", "p->mass[i][i] += 2 * more", "p->mass[i][i] += more"),
    Fault("swift: a cofactor", "tree/tree_small.c", "- m[0][0] * m[2][1]", "+ m[0][0] * m[2][1]"),
    Fault(
        "swift: rates keep off the rows",
        "tree/tree_small.c",
        "opening[i] -= jacobian",
        "opening[i] += jacobian",
    ),
    Fault(
        "swift: weights",
        "tree/tree_small_sums.c",
        "= -numbers->gravity[1] * p[1]",
        "= numbers->gravity[1] * p[1]",
    ),
    Fault("swift: a mark that does not turn", "tree/tree_small_sums.c", "lever[1] += p.r[1];", ""),
    Fault(
        "swift: a row between two angles",
        "tree/tree_small_sums.c",
        "x->shift[k] += sign;",
        "x->shift[k] += 1;",
    ),
    Fault(
        "swift: any moving line",
        "tree/tree_small_sums.c",
        "return c->body[1] == model->nbody;",
        "return 1;",
    ),
    Fault(
        "modes: along the rows of the loops",
        "tree/free_motion.c",
        "sum += x->basis[i * x->n + x->nloop + k] * s[k];",
        "sum += x->basis[i * x->n + k] * s[k];",
    ),
    Fault(
        "modes: no damping",
        "tree/small_motion.c",
        "x->matrix[(f + k) * n + by] = x->free.change[k]",
        "x->matrix[(f + k) * n + by] = by < f ? x->free.change[k] : 0",
    ),
    Fault("modes: nothing is nothing", "tree/small_motion.c", "    clean(root, n, rate);\n", ""),
    Fault(
        "modes: the frame stays elsewhere",
        "tree/small_motion.c",
        "    pm_frame_look_state(&w->frame, &w->state);\n    if (level",
        "    if (level",
    ),
    Fault(
        "modes: the tree of the phase",
        "tree/free_motion.c",
        "    x->tree = w->tree;\n    w->tree = of_phase;",
        "    x->tree = of_phase;\n    w->tree = of_phase;",
    ),
    Fault(
        "modes: both of a pair",
        "tree/small_motion.c",
        "if (GSL_IMAG(root[i]) < 0) continue;",
        "if (GSL_IMAG(root[i]) < -1e99) continue;",
    ),
]

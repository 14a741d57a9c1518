"""Faults planted in `kernel/routes/ida/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "ida: forces at the time of its clock",
        "routes/ida/ida_clock.c",
        "return shown - (ida->clock.ahead + over(ida->clock.now, step, shown));",
        "return shown;",
    ),
    Fault(
        "ida: its clock does not run away",
        "routes/ida/ida_clock.c",
        "if (ida->clock.matters) ida->clock.ahead += over(",
        "if (0) ida->clock.ahead += over(",
    ),
    Fault(
        "ida: a step ends a rounding beside its end",
        "routes/ida/route_ida.c",
        "y[i] + later * yp[i]",
        "y[i] + 0 * later * yp[i]",
    ),
    Fault(
        "ida: steps follow the rounding of the time",
        "routes/ida/ida_rounding.c",
        "x->residual[m->nq + i] += x->timed[i]",
        "x->residual[m->nq + i] += 0 * x->timed[i]",
    ),
    Fault(
        "ida: rounding ends no iteration",
        "routes/ida/ida_newton.c",
        "if (is_rounding(r, change)) return",
        "if (0 * is_rounding(r, change)) return",
    ),
    Fault(
        "ida: a tolerance that is too loose",
        "routes/ida/ida_system.c",
        "pow(asked, PM_IDA_POWER)",
        "pow(asked, 0.5 * PM_IDA_POWER)",
    ),
    Fault(
        "ida: friction of a joint keeps the load that it began with",
        "routes/ida/ida_system.c",
        "    pm_joint_friction_update(w);\n",
        "",
    ),
    Fault(
        "ida: power of a rubbing constraint without its turn",
        "routes/ida/ida_slopes.c",
        "slope, pm_constraint_bodies(c), c->body, turn, size, 0)",
        "slope, pm_constraint_bodies(c), c->body, turn, 0 * size, 0)",
    ),
    Fault(
        "ida: the lever of a force does not turn in the Jacobian",
        "routes/ida/ida_slopes.c",
        "sign * (r[0] * action->force[0] + r[1] * action->force[1])",
        "0 * sign * (r[0] * action->force[0] + r[1] * action->force[1])",
    ),
    Fault(
        "ida: friction of a joint does not lean the reactions of its matrix",
        "routes/ida/ida_jacobian.c",
        "+= share * c->j[p]",
        "+= 0 * share * c->j[p]",
    ),
    Fault("ida: sign of the bends", "routes/ida/ida_linear.c", "= -j->gv_slope[", "= j->gv_slope["),
    Fault(
        "ida: a first step beyond a whole bounce",
        "routes/ida/route_ida.c",
        "fmin(first, fmax(PM_IDA_SHORTEST * first, PM_IDA_FLIGHT * begin_functions(w)))",
        "fmin(first, fmax(1e9 * first, PM_IDA_FLIGHT * begin_functions(w)))",
    ),
    Fault(
        "ida: a state without a value counts as solved",
        "routes/ida/ida_system.c",
        "return !isnan(none)",
        "return 1",
    ),
    Fault(
        "ida, sparse: sign of the bends",
        "routes/ida/ida_sparse.c",
        "-ic * ic * j->stiffness",
        "ic * ic * j->stiffness",
    ),
    Fault(
        "ida, sparse: turns of the rows",
        "routes/ida/ida_sparse.c",
        "ic * e[r] * j->gv_slope",
        "0 * ic * e[r] * j->gv_slope",
    ),
    Fault(
        "ida, sparse: forces by the rows",
        "routes/ida/ida_sparse.c",
        "put_reaction(w, s, 2 * nq + r, 1, r, j->h, -1)",
        "put_reaction(w, s, 2 * nq + r, 1, r, j->g, -1)",
    ),
    Fault(
        "ida, sparse: no damping",
        "routes/ida/ida_sparse.c",
        "(i == k) - ic * damping",
        "(i == k) - 0 * damping",
    ),
    Fault(
        "ida, sparse: the pattern before",
        "routes/ida/ida_sparse.c",
        "return s->symbolic && s->n == n &&",
        "return s->symbolic && s->n == n ||",
    ),
    Fault(
        "ida: sign in the residual of q",
        "routes/ida/ida_system.c",
        "r[i] = yp[i] - v[i]",
        "r[i] = yp[i] + v[i]",
    ),
    Fault(
        "ida: sign of the forces",
        "routes/ida/ida_system.c",
        "r[nq + i] = -w->numbers.inverse_mass[i] * force[i]",
        "r[nq + i] = w->numbers.inverse_mass[i] * force[i]",
    ),
    Fault(
        "ida: sign of the reactions",
        "routes/ida/ida_system.c",
        "w->saddle.rhs[i] = -yp[l + i]",
        "w->saddle.rhs[i] = yp[l + i]",
    ),
    Fault(
        "ida: friction left out",
        "routes/ida/ida_system.c",
        "pm_saddle_spread(&w->saddle, 1, r + nq)",
        "pm_saddle_spread(&w->saddle, 0, r + nq)",
    ),
    Fault(
        "ida: singular positions that a step has come to",
        "routes/ida/route_ida.c",
        "return fmin(j->independence, pm_saddle_independence_there(w, &w->state));",
        "return j->independence;",
    ),
    Fault(
        "ida: singular positions are not handed over",
        "routes/ida/route_ida.c",
        "(lost ? PM_IDA_LOST : PM_IDA_NEAR_SINGULAR)",
        "0",
    ),
    Fault(
        "rounding: places of marks are exact",
        "routes/ida/ida_rounding.c",
        "double open = of_sum(m, c, x->own) + of_marks(c);",
        "double open = of_sum(m, c, x->own);",
    ),
]

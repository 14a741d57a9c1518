"""Faults planted in `kernel/routes/uniform/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "uniform: strands never end",
        "routes/uniform/uniform_strand.c",
        "w->uniform->strand_end[2 * i + k] = end_of(course);",
        "end_of(course);",
    ),
    Fault(
        "uniform: a place that was looked at stands for a later one",
        "routes/uniform/uniform_motion.c",
        "return u->looked == t &&",
        "return !isnan(u->looked) && t >= 0 &&",
    ),
    Fault(
        "uniform: joints rub for ever",
        "routes/uniform/route_uniform.c",
        "end = pm_min(u->joint_slip_end[i], end)",
        "end = pm_min(INFINITY, end)",
    ),
    Fault(
        "uniform: sign of the accelerations",
        "routes/uniform/uniform_motion.c",
        "v[i] = u->v[i] + t * u->a[i]",
        "v[i] = u->v[i] - t * u->a[i]",
    ),
    Fault(
        "uniform: half of the way",
        "routes/uniform/uniform_motion.c",
        "0.5 * t * u->a[i]",
        "0.25 * t * u->a[i]",
    ),
    Fault(
        "uniform: missed end of sliding",
        "routes/uniform/route_uniform.c",
        "if (!(slope < 0)) return INFINITY",
        "return INFINITY",
    ),
    Fault(
        "uniform: a parabola passes twice",
        "routes/uniform/route_uniform.c",
        "if (reversal > fmax(PM_UNIFORM_TURNED, rounding) && reversal < 1)",
        "if (reversal < 0)",
    ),
    Fault(
        "uniform: distance travelled",
        "routes/uniform/uniform_motion.c",
        "sum += p * p * (asinh",
        "sum -= p * p * (asinh",
    ),
    Fault(
        "uniform: a speed that vanishes",
        "routes/uniform/route_uniform.c",
        "if (x.squared) p[k] *= p[k]",
        "(void)x.squared",
    ),
    Fault(
        "edge: no face",
        "routes/uniform/uniform_edge.c",
        "return first_fall(&gap, x, 0, is_within);",
        "return INFINITY;",
    ),
    Fault(
        "edge: no corners",
        "routes/uniform/uniform_edge.c",
        "if (!(x->radius > 0)) return INFINITY;",
        "return INFINITY;",
    ),
    Fault(
        "edge: only the first root",
        "routes/uniform/uniform_edge.c",
        "for (int i = 0; i <= ntop; i++) {",
        "for (int i = 0; i < 1; i++) {",
    ),
    Fault(
        "edge: what touches has no end",
        "routes/uniform/uniform_edge.c",
        "end = fmin(end, first_fall(&room, x, side, always));",
        "",
    ),
    Fault(
        "edge: from one end only",
        "routes/uniform/uniform_edge.c",
        "{{2, {x.from, -vs, -as}}",
        "{{2, {x.from, vs, as}}",
    ),
    Fault(
        "edge: seen from rest",
        "routes/uniform/uniform_edge.c",
        "v[k] = u->v[3 * body[0] + k] - u->v[3 * body[1] + k];",
        "v[k] = u->v[3 * body[0] + k];",
    ),
    Fault(
        "uniform: missed root of a touching contact that leaves",
        "routes/uniform/uniform_gap.c",
        "return rate > 0 ? (rate + sqrt(square)) / -bend",
        "return rate > 0 ? INFINITY",
    ),
    Fault(
        "zeno: wrong e",
        "routes/uniform/zeno.c",
        "v[i] = u->v[i] + t * u->a[i] + d * e / (1 - e)",
        "v[i] = u->v[i] + t * u->a[i] + d / (1 - e)",
    ),
    Fault(
        "zeno: drift of the blows",
        "routes/uniform/zeno.c",
        "+ d * e * e / (1 - e * e));",
        "+ d * e / (1 - e * e));",
    ),
    Fault(
        "zeno: impulses left out of the ledger",
        "routes/uniform/zeno.c",
        "pm_ledger_series(w, sum)",
        "(void)sum",
    ),
    Fault(
        "zeno: forces at the wrong place", "routes/uniform/zeno.c", "factor = 0.5 * t * e3", "factor = t * e3"
    ),
    Fault("zeno: another contact", "routes/uniform/zeno.c", "* r->time)) return 0", "* r->time)) continue"),
    Fault(
        "zeno: slip that ends", "routes/uniform/zeno.c", "if (!(fabs(now) > change)) return 0", "(void)change"
    ),
    Fault(
        "zeno: a trigger on the way",
        "routes/uniform/zeno.c",
        ": !(x->least > 0 || x->greatest < 0);",
        ": 0;",
    ),
    Fault(
        "uniform: rows are dropped from the proof",
        "routes/uniform/route_uniform.c",
        "!pm_constraint_all_steady(&w->frame, &w->active, &u->curve) ||",
        "",
    ),
    Fault(
        "series: what all its flights fire is counted once",
        "routes/uniform/zeno.c",
        "flight && may_fire(w, r, i, &x))",
        "flight && 0 * may_fire(w, r, i, &x))",
    ),
    Fault(
        "turns: the way turns the other way round",
        "routes/uniform/wedge.c",
        "a = x->a * c + x->b * s,",
        "a = x->a * c - x->b * s,",
    ),
    Fault(
        "turns: what is in neither direction stands still",
        "routes/uniform/wedge.c",
        "at->time * rest +",
        "0 * rest +",
    ),
    Fault(
        "turns: the place along the side stays",
        "routes/uniform/wedge.c",
        "at->along * x->along[i]",
        "0 * x->along[i]",
    ),
    Fault(
        "turns: impulses at the first place",
        "routes/uniform/wedge.c",
        ".along = x->far * (x->b * (side ? x->cosine : 1) * short_of(x, n) / many + away) / b",
        ".along = 0",
    ),
    Fault(
        "turns: impulses left out of the ledger",
        "routes/uniform/turns.c",
        "pm_ledger_series(w, 1)",
        "(void)sum",
    ),
    Fault(
        "turns: one blow too many is counted",
        "routes/uniform/turns.c",
        "of[0] * (pairs - 1)",
        "of[0] * pairs",
    ),
    Fault(
        "turns: strikes that are asked for",
        "routes/uniform/turns.c",
        "if (nth == 0 && pm_awaited(",
        "if (nth < 0 && pm_awaited(",
    ),
    Fault("turns: another contact", "routes/uniform/turns.c", "if (!(c.g > both)) return 0", "(void)both"),
    Fault(
        "turns: an extreme on the way",
        "routes/uniform/turns.c",
        "return w->ask->nobserver > 0 ||",
        "return",
    ),
    Fault(
        "turns: too late", "routes/uniform/turns.c", "if (last.time < time &&", "if (last.time < 2 * time &&"
    ),
    Fault(
        "gaps: bounds over a shorter stretch are about as long as what was safe",
        "routes/uniform/uniform_gap.c",
        "sqrt(safe) * sqrt(far)",
        "PM_UNIFORM_WIDER * safe",
    ),
    Fault(
        "zeno: its last blow is one that a coarse run has not seen",
        "routes/uniform/zeno.c",
        "w->firing.jumped = NAN;",
        "",
    ),
    Fault(
        "uniform: what goes over an end comes near to it",
        "routes/uniform/uniform_edge.c",
        "is_leaving(&w->frame, &edge) ? pm_contact_length(&w->frame) : -INFINITY",
        "-INFINITY",
    ),
]

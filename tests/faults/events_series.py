"""Faults planted in `kernel/events/`: what is told of series of blows that are not followed to their end."""

from tests.faults.fault import Fault

FAULTS = [
    Fault("integral: a series is left out", "events/integral_series.c", "    of->sum += sum.value;\n", ""),
    Fault(
        "integral: a series though its flights differ",
        "events/integral_series.c",
        "return x->error <= fmax(open,",
        "return x->error <= INFINITY || x->error <= fmax(open,",
    ),
    Fault(
        "integral: what is off its limit shrinks as the flights do",
        "events/integral_series.c",
        "isnan(now) ? ratio : now)",
        "ratio)",
    ),
    Fault(
        "integral: a contact that is closed early loses its flights",
        "events/integral_series.c",
        "end(w, i, x->ratio);",
        "",
    ),
    Fault(
        "integral: a run that ends inside a series knows all of it",
        "events/integral_series.c",
        "if (pm_bounce_series_goes_on(w, i)) end(w, i, 0);",
        "if (0) end(w, i, 0);",
    ),
    Fault(
        "blows left: those that nothing waits for are not counted",
        "events/blows_left.c",
        "while (x->counted && goes_on(w, i)",
        "while (0 && goes_on(w, i)",
    ),
    Fault(
        "blows left: nothing fires in their flights",
        "events/flight_firings.c",
        "if (again && n < PM_FIRINGS_MOST)",
        "if (again && n < 0)",
    ),
    Fault(
        "blows left: what fires in a flight fires as it begins",
        "events/blows_left.c",
        "x->blow + x->firing[x->at].phase * x->flight",
        "x->blow + 0 * x->firing[x->at].phase * x->flight",
    ),
    Fault(
        "blows left: what the last flights do not reach fires in them",
        "events/flight_firings.c",
        "return off <= fmax(",
        "return off >= 0 || off <= fmax(",
    ),
    Fault(
        "left out: within a flight that is left out speeds are known",
        "events/left_out.c",
        "fmax(fabs(high - value), fmax(fabs(up - value), fabs(down - value)))",
        "fabs(high - value)",
    ),
    Fault(
        "left out: within a flight that is left out heights are known",
        "events/left_out.c",
        "high = value_moved(w, x, program, change, top, 0)",
        "high = value_moved(w, x, program, change, 0 * top, 0)",
    ),
    Fault(
        "waves: a distance is seen by its last sample alone",
        "events/waves.c",
        "const int strict = !c->w->phase.route->sees_ends && pm_wave_kinds_distance(c->w->model, measure);",
        "const int strict = 0;",
    ),
]

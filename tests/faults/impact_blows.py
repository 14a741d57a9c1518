"""Faults planted in `kernel/impact/`: blows by the laws, their order, and when they end."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "jump: what parts as a series is cut off is a decision",
        "impact/impact.c",
        "if (!w->blow->series_ends && !pm_last",
        "if (!pm_last",
    ),
    Fault(
        "series: what bounces without an end does so though it is pressed on",
        "impact/impact_end.c",
        "w->impulses.slot[2 * i] > PM_BLOW_ROUNDING * most)",
        "w->impulses.slot[2 * i] > 2 * most)",
    ),
    Fault(
        "contacts that depend on each other at the place of a blow all hold",
        "impact/impact_trial.c",
        "if (!status && !w->active.clear && pm_active_set_let_loose(w) > 0)",
        "if (!status && !w->active.clear && w->active.n < 0)",
    ),
    Fault(
        "a blow that was followed in vain leaves its mode behind",
        "impact/impact_trial.c",
        "return b->given[slot].is ? PM_SLIDE_FORWARD : b->trial[slot];",
        "return b->equations ? PM_SLIDE_FORWARD : b->given[slot].is ? PM_SLIDE_FORWARD : b->trial[slot];",
    ),
    Fault(
        "what a blow made part is not struck by the next one at the same instant",
        "impact/impact.c",
        "if (b->apart[i] == PM_PARTED) b->apart[i] = PM_NOT_APART;",
        "",
    ),
    Fault(
        "blows at one instant that shrink are given up",
        "impact/impact.c",
        "if (i == PM_BLOWS_AT_ONCE)",
        "if (i == 64)",
    ),
    Fault(
        "a blow of one contact and a joint that rubs is not followed",
        "impact/impact_loaded.c",
        "if (alone == PM_NONE) return status;",
        "return status;",
    ),
    Fault(
        "jump: rough contacts that rest let go of their slip",
        "impact/impact.c",
        "== PM_FRICTION_ROUGH)\n            b->share[i] = PM_JOINED",
        "> PM_FRICTION_ROUGH)\n            b->share[i] = PM_JOINED",
    ),
    Fault(
        "jump: what is pressed on rebounds",
        "impact/impact_trial.c",
        "part == PM_STRUCK && !b->plastic && !b->held[slot]",
        "!b->plastic && !b->held[slot]",
    ),
    Fault(
        "capture: what is held takes no part in later blows",
        "impact/impact.c",
        "if (captured && b->share[i] == PM_OUT) b->share[i] = PM_JOINED;",
        "",
    ),
    Fault(
        "capture: its impulse along the wrong axes",
        "impact/impact_end.c",
        "axes[4] = {1, 0, 0, 1}",
        "axes[4] = {0, 1, 1, 0}",
    ),
    Fault(
        "drive: not in a blow",
        "impact/impact_trial.c",
        "pm_constraint_times(&w->frame, &w->active.constraint[i], w->state.v) - w->active.constraint[i].rate",
        "pm_constraint_times(&w->frame, &w->active.constraint[i], w->state.v)",
    ),
    Fault(
        "blow: sign of restitution", "impact/impact_trial.c", "return -(1 + e) * u;", "return -(1 - e) * u;"
    ),
    Fault(
        "blow: slip is not given back",
        "impact/impact_trial.c",
        "? -(1 + pm_contact_tangential",
        "? -(1 - pm_contact_tangential",
    ),
    Fault(
        "blow: gains of energy are not seen",
        "impact/impact_end.c",
        "return given <= PM_BLOW_ROUNDING * size + nothing ?",
        "return 1 ?",
    ),
    Fault(
        "one by one: all at once",
        "impact/impact.c",
        "if (is_blow(w->model, i, &x) && *struck > 0 && pm_impact_one_by_one(w->model)) break;",
        "",
    ),
    Fault(
        "blow: row of a resting contact dropped",
        "impact/impact_together.c",
        "struck ? PM_STRUCK : PM_JOINED; if",
        "struck ? PM_STRUCK : PM_DROPPED; if",
    ),
    Fault(
        "blow: what stays is opened",
        "impact/impact_end.c",
        "w->state.slot[i].mode = pm_contact_modes_of_slip(&w->frame, contact, member)",
        "w->state.slot[i].mode = PM_OPEN",
    ),
    Fault(
        "impact: what sticks after a blow slides by rounding",
        "impact/impact_trial.c",
        "end.slip == 0};",
        "0};",
    ),
    Fault(
        "held: what pushes without friction goes on slipping",
        "impact/impact_held.c",
        "if (status || all_obey(w, b) || solve_counted(w, b)) return status;\n"
        "    return solve_one_by_one(w, b);",
        "return status;",
    ),
    Fault(
        "held: what pushes without friction sticks, though others could",
        "impact/impact_held.c",
        "for (int sticks = 0; sticks <= n; sticks++)",
        "for (int sticks = n; sticks <= n; sticks++)",
    ),
    Fault(
        "together: restitution left out",
        "impact/impact_together.c",
        "pm_last_bounce_restitution(w, contact, before) * fmin(before, 0)",
        "0",
    ),
    Fault(
        "limit: a gain is left",
        "impact/impact_together.c",
        "-2 * none / (slope + root)",
        "-3 * none / (slope + root)",
    ),
    Fault(
        "shock: a contact that is to stop is struck",
        "impact/impact.c",
        "if (PM_CONTACT_ROW(m, contact)[PM_CONTACT_PAINLEVE] != PM_PAINLEVE_STRIKES) continue;",
        "",
    ),
    Fault(
        "order: nobody looks",
        "impact/impact.c",
        "PM_SETTING(m, PM_SETTING_SIMULTANEOUS) == PM_SIMULTANEOUS_OPEN)",
        "0)",
    ),
    Fault(
        "order: what was chosen is counted",
        "impact/impact.c",
        "PM_SETTING(m, PM_SETTING_SIMULTANEOUS) == PM_SIMULTANEOUS_OPEN)",
        "PM_SETTING(m, PM_SETTING_SIMULTANEOUS) != PM_SIMULTANEOUS_ONE_BY_ONE)",
    ),
    Fault(
        "order: one blow of each contact",
        "impact/impact_order.c",
        "k < PM_ORDER_STRIKES * n",
        "k < n",
    ),
    Fault(
        "order: the first contact of the file alone is struck first",
        "impact/impact_order.c",
        "for (int i = 0, second; i < x->problem.n; i++)",
        "for (int i = 0, second; i < 1; i++)",
    ),
    Fault(
        "order: others are not moved",
        "impact/impact_order.c",
        "for (int r = 0; r < 2 * x->n; r++)",
        "for (int r = 2 * i; r < 2 * i + 2; r++)",
    ),
    Fault(
        "order: no restitution",
        "impact/impact_order.c",
        ".restitution = pm_last_bounce_restitution(w, contact, u[0]),",
        "",
    ),
    Fault(
        "order: restitution along a contact is left out",
        "impact/impact_order.c",
        "? pm_contact_tangential(&w->frame, contact) * u[1] : 0",
        "? 0 : 0",
    ),
    Fault(
        "order: the wrong law",
        "impact/impact_order.c",
        ".law = pm_contact_law(w->model, contact),",
        ".law = PM_LAW_NEWTON,",
    ),
    Fault(
        "order: the last blow is told, not the first",
        "impact/impact_order.c",
        "if (w->result.count[PM_COUNT_ORDERED_BLOWS]++ > 0) return;",
        "w->result.count[PM_COUNT_ORDERED_BLOWS]++;",
    ),
    Fault(
        "together: friction by the slip before",
        "impact/impact_together.c",
        "slip_rate(w, b, x->slot[i], before[0], before[1], now[1]);",
        "before[1];",
    ),
    Fault(
        "together: no slip is given back",
        "impact/impact_together.c",
        "return rebounds ? now + pm_contact_tangential(&w->frame, contact) * before : now;",
        "(void)rebounds; return now;",
    ),
    Fault(
        "impact: rounding of places far away is not told",
        "impact/impact_find.c",
        "PM_DISTURBED_BLOW * pm_evidence_noise(&w->evidence, i)",
        "0 * pm_evidence_noise(&w->evidence, i)",
    ),
    Fault(
        "impact: a small moment of inertia makes much of rounding",
        "impact/impact_trial.c",
        "if (w->active.n > 1 && !w->saddle.light.is_used) pm_saddle_correct(w, b->after);",
        "",
    ),
]

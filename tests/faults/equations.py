"""Faults planted in `kernel/equations/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "capture: lets go when it would pull",
        "equations/active_set.c",
        "status = append_captured(w, nbasis)",
        "status = PM_OK",
    ),
    Fault(
        "cord: slack ones are not followed", "equations/active_set.c", "follow_slack_cords(frame, s); }", "}"
    ),
    Fault(
        "rows: a redundant row stays",
        "equations/active_set.c",
        "*depends = rest.left < PM_DEPENDENT_NEARBY",
        "*depends = 0",
    ),
    Fault(
        "mode: friction along the slip",
        "equations/active_set.c",
        "PM_SLIDE_FORWARD ? -mu : mu",
        "PM_SLIDE_FORWARD ? mu : -mu",
    ),
    Fault("joint: rows are those of no case", "equations/case.c", "pm_joint_compose(&w->frame);", ";"),
    Fault(
        "rk: energy is taken instead of returned",
        "equations/energy_level.c",
        "1 + missing / kinetic",
        "1 - missing / kinetic",
    ),
    Fault(
        "rk: a damped motion keeps its energy",
        "equations/energy_level.c",
        "only_potentials(w->model, &w->state) && !pm_active_set_is_driven",
        "!pm_active_set_is_driven",
    ),
    Fault(
        "still: no case is searched",
        "equations/fixed_bodies.c",
        "x->possible = x->n > 0;",
        "x->possible = 0;",
    ),
    Fault(
        "still: rows that nearly depend hold",
        "equations/fixed_bodies.c",
        "WIDE, PM_CLEARLY_INDEPENDENT}",
        "WIDE, 0}",
    ),
    Fault(
        "still: a joint that may go holds",
        "equations/fixed_bodies.c",
        "pm_model_is_changed(m, PM_TABLE_JOINT, i) || ",
        "",
    ),
    Fault(
        "still: reactions are not told",
        "equations/fixed_bodies.c",
        "fixed->is_asked[e[PM_MEASURE_A]] = 1;",
        ";",
    ),
    Fault(
        "still: contacts of what stands still stay",
        "equations/fixed_bodies.c",
        "any |= let_go(w, &normal);",
        ";",
    ),
    Fault(
        "still: what is pushed stays",
        "equations/fixed_bodies.c",
        "let_move(m, fixed, PM_TABLE_ACTION, i);",
        ";",
    ),
    Fault(
        "still: what moves holds",
        "equations/fixed_bodies.c",
        "if (!w->numbers.fixed[other] && place <= i) continue;",
        "if (place == i) continue;",
    ),
    Fault(
        "reach: a chain is as short as its last rod",
        "equations/gap_bounds.c",
        ".high = r + x->high,",
        ".high = r,",
    ),
    Fault("reach: a link has no length", "equations/gap_bounds.c", "from.high + length;", "from.high;"),
    Fault(
        "reach: a joint that may go holds",
        "equations/gap_bounds.c",
        "if (pm_model_is_changed(w->model, PM_TABLE_JOINT, joint)) return 0;",
        "",
    ),
    Fault(
        "reach: a hole is a ball",
        "equations/gap_bounds.c",
        "if (side > 0) return least_distance",
        "return least_distance",
    ),
    Fault(
        "reach: nothing is too near",
        "equations/gap_bounds.c",
        "fmax(r - x->high, x->low - r)",
        "fmax(r + x->high, x->low - r)",
    ),
    Fault("reach: a plate hangs still", "equations/gap_bounds.c", "if (!b->fixed) {", "if (0) {"),
    Fault("reach: edges have no end", "equations/gap_bounds.c", "hypot(fmax(beyond, 0), ", "hypot(0, "),
    Fault(
        "start: a block of joints pushed the wrong way",
        "equations/least_change.c",
        "level == PM_START_POSITION ? -row->g : row->rate",
        "level == PM_START_POSITION ? row->g : row->rate",
    ),
    Fault(
        "start: what lies across a block of joints",
        "equations/least_change.c",
        "saddle->rhs[i] = -along(saddle->model, saddle->numbers, &active->row[i], s->across)",
        "saddle->rhs[i] = along(saddle->model, saddle->numbers, &active->row[i], s->across)",
    ),
    Fault("still: weights are carried twice", "equations/ledger.c", "if (w->numbers.fixed[i]) continue;", ""),
    Fault(
        "spin: not in the ledger",
        "equations/ledger.c",
        "pm_turning_plane_outer(&w->frame, outer);",
        "outer[0] = outer[1] = outer[2] = 0;",
    ),
    Fault("spin: a couple without work", "equations/ledger.c", " + pm_turning_plane_power(w)", ""),
    Fault(
        "action: the outer impulse is not in the ledger",
        "equations/ledger.c",
        "at, force, couple, 1)",
        "at, force, couple, 0)",
    ),
    Fault("drive: no work", "equations/ledger.c", "+ drive_power(&w->active, w->frame.lambda)", ""),
    Fault(
        "audit: a path at the rate of another",
        "equations/ledger.c",
        "zdot[m->nz_work + i]",
        "zdot[m->nz_work]",
    ),
    Fault(
        "audit: always content",
        "equations/ledger.c",
        "return pm_fail(&w->result, PM_AUDIT",
        "w->result.where.row = pm_fail(&w->result, PM_AUDIT",
    ),
    Fault(
        "audit: loss of a blow", "equations/ledger.c", "loss -= 0.5 * lambda[i]", "loss -= 0.4 * lambda[i]"
    ),
    Fault(
        "projection: position left out",
        "equations/projection.c",
        "pm_saddle_spread(&w->saddle, 0, s->q)",
        "(void)0",
    ),
    Fault("massless: a stand-in stays", "equations/saddle.c", "+ w->numbers.stand_in[i] * before[i]", ""),
    Fault(
        "grip: one round of friction",
        "equations/saddle.c",
        "|| !pm_joint_friction_update(w)) {",
        "|| pm_joint_friction_update(w) >= 0) {",
    ),
    Fault(
        "saddle: sign of gamma",
        "equations/saddle.c",
        "w->saddle.wanted[i] = w->active.row[i].gamma;",
        "w->saddle.wanted[i] = -w->active.row[i].gamma;",
    ),
    Fault(
        "saddle: friction left out of the force",
        "equations/saddle.c",
        "use_h ? force_direction(s, row) : row->j",
        "use_h ? row->j : row->j",
    ),
    Fault(
        "saddle: coupling of the second partner",
        "equations/saddle.c",
        "for (int r = 0; r < 2; r++)",
        "for (int r = 0; r < 1; r++)",
    ),
    Fault(
        "saddle: coupling of the second partner, symmetric",
        "equations/saddle.c",
        "if (b == other->body[0]) sum += product(jb, other->j);",
        "",
    ),
    Fault(
        "recall: velocities do not count",
        "equations/solve_cache.c",
        "if (r->velocity[3 * i + k] != frame->velocity[3 * i + k]) return 0;",
        "",
    ),
    Fault(
        "recall: other rows do not count", "equations/solve_cache.c", "r->rows != w->active.version ||", ""
    ),
    Fault(
        "recall: forces of the time do not count",
        "equations/solve_cache.c",
        "w->model->programs.cacheable && ",
        "",
    ),
    Fault(
        "recall: rows of another place",
        "equations/solve_cache.c",
        "memcmp(r->q, w->state.q,",
        "memcmp(r->q, r->q,",
    ),
    Fault("recall: factors of other rows", "equations/saddle.c", "if (x->j[k] != row->j[k]) return 0;", ";"),
    Fault("recall: factors of other bodies", "equations/saddle.c", "x->body[1] != row->body[1]", "0"),
    Fault("start: contradictions pass", "equations/start.c", "return PM_START_CONFLICT", "continue"),
    Fault(
        "start: open motions pass",
        "equations/start.c",
        "&& rest.left > PM_START_OPEN_PART",
        "&& rest.left > 2",
    ),
    Fault(
        "action: what begins absent is there",
        "equations/start.c",
        "e[PM_ACTION_A])] = 1",
        "e[PM_ACTION_A])] = 0",
    ),
    Fault("audit: blind at loose accuracy", "equations/ledger.c", "PM_LEDGER_MOST * (", "1e3 * ("),
    Fault(
        "case: rows of any length",
        "equations/case.c",
        "PM_ROW_COUNT, -INFINITY, PM_MOST_MEMBERS",
        "PM_ROW_COUNT, -INFINITY, INFINITY",
    ),
]

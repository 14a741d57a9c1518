"""Faults planted in `kernel/impact/`: actions, drives, switches and ends of tables at an instant."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "to close a gap of rounding bodies are put elsewhere",
        "impact/contact_modes_settle.c",
        "return most > PM_PUT_ELSEWHERE * w->numbers.size || open",
        "return open",
    ),
    Fault(
        "a gap of rounding that nothing closes counts as closed",
        "impact/contact_modes_settle.c",
        "|| open > PM_STAYS_OPEN * w->numbers.size;",
        "|| open > 1e6 * PM_STAYS_OPEN * w->numbers.size;",
    ),
    Fault(
        "a foot that stands open by a hair does not hold what is not unique without it",
        "impact/contact_modes_beside.c",
        "if (status != PM_NOT_UNIQUE) return status;",
        "return status;",
    ),
    Fault(
        "a foot in the air holds what is not unique without it",
        "impact/contact_modes_beside.c",
        "gap <= PM_NEAR_BESIDE *",
        "gap <= 10 * PM_NEAR_BESIDE *",
    ),
    Fault(
        "a foot that has been closed in vain stays closed",
        "impact/contact_modes_beside.c",
        "if (share[i] == PM_JOINED) w->state",
        "if (0) w->state",
    ),
    Fault(
        "a foot that parts takes no part in a blow that is not unique without it",
        "impact/impact.c",
        "if (!status && joined > 0) {",
        "if (0) {",
    ),
    Fault(
        "a foot that stands open by less than the bounces that are left out does not rest",
        "impact/impact.c",
        "if (!w->blow->series_ends) return 0;",
        "return 0;",
    ),
    Fault(
        "a foot far from its wall rests where a series ends",
        "impact/impact.c",
        "if (!(gap > 0 && gap <= pm_last_bounce_height(w, contact))",
        "if (!(gap > 0)",
    ),
    Fault(
        "meeting: a blow is where the rounded time has it",
        "impact/meeting.c",
        "if (left == 0) return PM_OK;",
        "if (left * 0 == 0) return PM_OK;",
    ),
    Fault(
        "drives: a rate that jumps is no blow",
        "impact/drives.c",
        "*clashes |= fabs(off) * length > pm_contact_speed(&w->frame);",
        "(void)off;",
    ),
    Fault(
        "instants without time go on for ever",
        "impact/instant.c",
        "if (++w->instant.at_once < most) return PM_OK;",
        "if (1) return PM_OK;",
    ),
    Fault(
        "instants without time add up over the run",
        "impact/instant.c",
        "w->instant.at_once = w->instant.let_go = 0;",
        "",
    ),
    Fault("action: an impulse has no moment", "impact/action.c", "couple + pm_cross(arm, force)", "couple"),
    Fault(
        "action: the moment of an impulse has the other sign",
        "impact/action.c",
        "couple + pm_cross(arm, force)",
        "couple - pm_cross(arm, force)",
    ),
    Fault(
        "action: impulses that follow each other are not added up",
        "impact/action.c",
        "p[0] += force[0]",
        "p[0] = force[0]",
    ),
    Fault(
        "action: the work of an impulse counts with the velocity before it",
        "impact/action.c",
        "w->ledger.energy_lost -= 0.5 * (before + work_now(w))",
        "w->ledger.energy_lost -= 0.5 * (before + before)",
    ),
    Fault(
        "action: work turns the sense of rotation",
        "impact/action.c",
        "copysign(sqrt(spin * spin + 2 * c * work), spin)",
        "-copysign(0.5 * sqrt(spin * spin + 2 * c * work), spin)",
    ),
    Fault(
        "action: what work was asked is not looked at again",
        "impact/action.c",
        "status || fabs(done - work)",
        "1 || fabs(done - work)",
    ),
    Fault(
        "action: a spring keeps its energy when it goes",
        "impact/action.c",
        "w->ledger.energy_lost -= energy",
        "(void)energy",
    ),
    Fault(
        "action: the work of a spring that went is forgotten",
        "impact/action.c",
        "w->ledger.force_energy_start[force] += energy",
        "(void)energy",
    ),
    Fault(
        "action: a removed contact stays closed",
        "impact/action.c",
        "let_slots_go(w->model, &w->state, a); *absent",
        "*absent",
    ),
    Fault("action: a joint that is added need not fit", "impact/action.c", "!(open <= allowed)", "open < 0"),
    Fault(
        "action: a joint that is added leaves the velocities",
        "impact/action.c",
        "status || !clashes ? status",
        "1 ? status",
    ),
    Fault(
        "instant: contacts stay as they were", "impact/instant.c", "m->nslot == 0 || contacts_stay(w)", "1"
    ),
    Fault(
        "error: marks do not look at forces",
        "impact/instant.c",
        "return asked > watched ? asked : watched;",
        "return asked;",
    ),
    Fault(
        "shock: a route that cannot go on does not say why",
        "impact/instant.c",
        "const int slot = pm_impact_jammed(w);",
        "const int slot = PM_NONE;",
    ),
    Fault(
        "jump: what holds from the start on fires",
        "impact/instant.c",
        "if (begins && !jumped)",
        "if (begins && jumped)",
    ),
    Fault(
        "event: nobody waits for a count",
        "impact/instant.c",
        "w->model->programs.wait_for_counts && pm_trigger_count_marked(w)",
        "w->model->programs.wait_for_counts && 0",
    ),
    Fault(
        "switch: one that is left from zero keeps its side",
        "impact/switches.c",
        "if (side_of(ahead) == w->firing.side[event]) return PM_OK;",
        "return PM_OK;",
    ),
    Fault(
        "switch: a force that holds the motion is let go on",
        "impact/switches.c",
        "if (side_of(otherwise) == w->firing.side[event] || otherwise == here) return PM_OK;",
        "return PM_OK;",
    ),
    Fault(
        "switch: a blow does not change sides",
        "impact/instant.c",
        "    if (*jumped) pm_trigger_jump_sides(w);\n",
        "",
    ),
    Fault(
        "tables: the piece is kept at its end",
        "impact/switches.c",
        "*piece = there;",
        "(void)there;",
    ),
    Fault(
        "tables: a run goes on beyond the end",
        "impact/table_ends.c",
        "if (row == PM_NONE) return PM_OK;",
        "return PM_OK;",
    ),
    Fault(
        "instant: what has no motion changes in turn",
        "impact/instant.c",
        "status != PM_SINGULAR && status != PM_ALTERNATES)",
        "status != PM_SINGULAR)",
    ),
    Fault(
        "drives: what lies on a surface jumps with it",
        "impact/drives.c",
        "s->mode = pm_contact_modes_of_slip(&w->frame, contact, s->member);",
        ";",
    ),
    Fault(
        "drives: what is rough is not struck by its surface",
        "impact/drives.c",
        "== PM_FRICTION_ROUGH) *clashes = 1;",
        "== PM_FRICTION_ROUGH) (void)clashes;",
    ),
]

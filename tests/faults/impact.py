"""Faults planted in `kernel/impact/`."""

from tests.faults.fault import Fault

FAULTS = [
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
        "modes: forces that are rounding pull",
        "impact/contact_modes.c",
        "return fmax(sum, pm_case_force(frame->model, frame->numbers));",
        "return sum;",
    ),
    Fault(
        "mode: a joint slips unseen",
        "impact/contact_modes.c",
        "if (before == PM_STICK && pm_contact_modes_slides(now))",
        "if (0)",
    ),
    Fault(
        "edge: friction keeps its side round a corner",
        "impact/contact_modes.c",
        "if (pm_contact_modes_slides(s->mode)) s->mode =",
        "if (0) s->mode =",
    ),
    Fault(
        "edge: what has left it comes back",
        "impact/contact_modes.c",
        "w->instant.slot_released[slot] = PM_FOR_GOOD;",
        "w->instant.slot_released[slot] = PM_LET_GO;",
    ),
    Fault(
        "edge: nobody takes over",
        "impact/contact_modes.c",
        "return heir == PM_NONE ? PM_OK : hand_over(w, mode, heir);",
        "return PM_OK;",
    ),
    Fault(
        "mode: slides against the force",
        "impact/contact_modes.c",
        "friction > 0 ? PM_SLIDE_BACKWARD : PM_SLIDE_FORWARD",
        "friction > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD",
    ),
    Fault(
        "mode: contacts may pull",
        "impact/contact_modes.c",
        "return pm_contact_modes_pulling(w, w->frame.lambda, PM_SITE_PULLS, size) == PM_NONE &&",
        "return",
    ),
    Fault(
        "mode: stick has no bound",
        "impact/contact_modes.c",
        "if (!(room >= -PM_PULLS * size)) return i;",
        "if (site == PM_SITE_SLIDES_IN_BLOW && !(room >= -PM_PULLS * size)) return i;",
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
        "blow: reversed slip",
        "impact/contact_problem.c",
        "sense(x->trial[i]) * a[1] >= -slack",
        "sense(x->trial[i]) * a[1] <= slack",
    ),
    Fault(
        "blow: row of a resting contact dropped",
        "impact/impact_together.c",
        "struck ? PM_STRUCK : PM_JOINED; if",
        "struck ? PM_STRUCK : PM_DROPPED; if",
    ),
    Fault(
        "blow: pulling contacts stay",
        "impact/contact_problem.c",
        "load < -slack ||",
        "",
    ),
    Fault(
        "blow: friction beyond its bound",
        "impact/contact_modes.c",
        "const double room = pm_contact_static(&w->frame, contact) *",
        "const double room = (site == PM_SITE_SLIDES_IN_BLOW ? 2 : 1) *"
        " pm_contact_static(&w->frame, contact) *",
    ),
    Fault(
        "blow: friction along the slip",
        "impact/contact_problem.c",
        "return sense(mode) ? -sense(mode) *",
        "return sense(mode) ? sense(mode) *",
    ),
    Fault(
        "blow: what stays is opened",
        "impact/impact_end.c",
        "w->state.slot[i].mode = pm_contact_modes_of_slip(&w->frame, contact, member)",
        "w->state.slot[i].mode = PM_OPEN",
    ),
    Fault("jump: its blows can be counted", "impact/impact_end.c", "pm_trigger_countless(w, contact);", ""),
    Fault(
        "impact: friction drives the slip",
        "impact/impact_course.c",
        "-copysign(x->mu_kinetic,",
        "copysign(x->mu_kinetic,",
    ),
    Fault(
        "impact: what has stopped holds", "impact/impact_course.c", "fabs(x->b) <= x->mu_static * x->c", "1"
    ),
    Fault("impact: slip does not end", "impact/impact_course.c", "now->slip * now->rate_t < 0 ?", "0 ?"),
    Fault(
        "impact: restitution of the whole impulse",
        "impact/impact_course.c",
        "(1 + e) * now.impulse",
        "2 * e * now.impulse",
    ),
    Fault("impact: restitution of the work", "impact/impact_course.c", "-e * e * now.work", "-e * now.work"),
    Fault("impact: joints do not hold", "impact/impact_course.c", "pm_saddle_spread(&w->saddle, 0, x);", ""),
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
        "problem: friction is not scaled",
        "impact/contact_problem.c",
        "mu * x->scale[2 * i] / x->scale[2 * i + 1] : 0",
        "mu : 0",
    ),
    Fault("problem: what parts approaches", "impact/contact_problem.c", "if (a[0] < -slack) return 0;", ""),
    Fault(
        "problem: motions are not told apart",
        "impact/contact_problem.c",
        "if (!first && (other == PM_NONE || law < by_law)) continue;",
        "if (!first) continue;",
    ),
    Fault(
        "problem: friction of Lemke's method on one side only",
        "impact/contact_problem.c",
        "= 2 * scaled_friction(x, i, x->contact[i].rub);",
        "= scaled_friction(x, i, x->contact[i].rub);",
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
        "system: joints give way",
        "impact/contact_system.c",
        "pm_saddle_respond_roughly(w, x->force, x->response);",
        "pm_saddle_respond_roughly(w, x->force, x->response); x->response[0] *= 1.01;",
    ),
]

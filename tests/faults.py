"""Plants faults in a copy of the kernel, one at a time, and expects its tests to catch each of them.

    python tests/faults.py            all faults (`make faults`)
    python tests/faults.py gamma ida  those whose name has one of these words
    python tests/faults.py --first    no more than one test that catches each: a fifth of the time
    python tests/faults.py --jobs 1   that many at once, instead of one for each core

A fault is one small change of one source: a sign in a column of a Jacobian, a wrong gamma, a dropped event
function, a wrong restitution, a dropped row ... The table tells what caught it: names of tests, "audit" where
a run said by itself that it cannot be trusted, "routes" where two routes disagreed. A fault that nothing
catches, or that no longer fits the source, makes the exit status 1.
"""

import argparse
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COMPILER = os.environ.get("CC", "gcc")
FLAGS = ["-std=gnu11", "-O1", "-ffp-contract=off", "-fno-math-errno", "-D_GNU_SOURCE", "-UNDEBUG", "-w"]
LIBRARIES = os.environ.get("FAULTS_LIBRARIES", "-lgsl -lgslcblas -lsundials_ida -lklu -lm -lpthread").split()
TEST_SECONDS = 12  # of the processor: a test that takes longer hangs; the slowest needs four
WAIT_SECONDS = 20 * TEST_SECONDS  # of the clock: a test that waits for ever hangs too, without using any
MESSAGE = 2000  # characters of a compiler's message that are worth showing
AUDIT = "-10, expected 0"  # how check.h prints a run that ended with PM_AUDIT


@dataclass(frozen=True)
class Fault:
    """In `file`, `old` becomes `new`; white space in `old` stands for any white space. `old` occurs once."""

    name: str
    file: str
    old: str
    new: str


FAULTS = [
    # what is not worked out twice
    Fault(
        "recall: velocities do not count",
        "equations/solve_cache.c",
        "if (r->velocity[3 * i + k] != w->frame.velocity[3 * i + k]) return 0;",
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
    Fault(
        "recall: factors of other rows", "equations/solve_cache.c", "if (x->j[k] != row->j[k]) return 0;", ";"
    ),
    Fault("recall: factors of other bodies", "equations/solve_cache.c", "x->body[1] != row->body[1]", "0"),
    Fault("joint: rows are those of no case", "equations/case.c", "pm_joint_compose(&w->frame);", ";"),
    Fault(
        "still: no case is searched",
        "equations/fixed_bodies.c",
        "x->possible = x->n > 0;",
        "x->possible = 0;",
    ),
    Fault("event: a mark at a step's end comes again", "run/advance.c", "hold_hits(w, w->step.end);", ";"),
    Fault("ask: marks do not solve", "events/ask.c", "raise_to(&a->fired_level, level);", ";"),
    Fault(
        "instant: contacts stay as they were", "impact/instant.c", "m->nslot == 0 || contacts_stay(w)", "1"
    ),
    Fault("event: a turn is passed as a mark", "run/advance.c", "!due && !w->step.reverses &&", "!due &&"),
    Fault(
        "nodes: the same number is read at every node",
        "expression/program_batch.c",
        "operate(s, n, stack[top], stack[top + 1], 1, switches)",
        "operate(s, n, stack[top], stack[top + 1], 0, switches)",
    ),
    Fault(
        "nodes: a choice takes the other way",
        "expression/program_batch.c",
        "!= 0 ? yes[k] : no[k]",
        "!= 0 ? no[k] : yes[k]",
    ),
    Fault(
        "nodes: few are enough for waves",
        "events/event_sampling.c",
        "while (!status && w->step.nodes->finer &&",
        "while (0 &&",
    ),
    Fault(
        "nodes: measures in another order",
        "events/watched_samples.c",
        "s->place[measure] = i;",
        "s->place[measure] = 0;",
    ),
    Fault(
        "nodes: least of the triggers is not kept",
        "events/event_sampling.c",
        "least = pm_min(value[k], least);",
        "",
    ),
    Fault(
        "fold: operands change places",
        "expression/program.c",
        "binary(s->op, *top, number[s->arg])",
        "binary(s->op, number[s->arg], *top)",
    ),
    Fault(
        "fold: positions stay",
        "expression/program_fold.c",
        "kind == PM_MEASURE_MASS ||",
        "kind != PM_MEASURE_TIME ||",
    ),
    Fault(
        "crossing: what has fired is not sought again",
        "run/advance.c",
        "e->function[i].search = SEARCH_NONE;",
        "",
    ),
    Fault(
        "contact: members are counted from zero",
        "elements/contact.c",
        "return k > place ? k - 1 : k;",
        "return k;",
    ),
    Fault(
        "ask: what an extreme has above the place is taken off",
        "events/extremum_nodes.c",
        "p->sign * g, p->sign * above",
        "p->sign * g, -p->sign * above",
    ),
    Fault(
        "ask: an extreme between nodes is none",
        "events/extremum.c",
        "p.best = best > p.g[top_inside] ? best : p.g[top_inside];",
        "p.best = best > p.g[top_inside] ? best : p.g[top_inside] + fabs(p.g[top_inside]);",
    ),
    Fault(
        "ask: a look tells a slope of the other sign",
        "events/extremum_rise.c",
        "rise->rate = x->slope + off * x->pull;",
        "rise->rate = x->slope - off * x->pull;",
    ),
    Fault("ask: looks before are forgotten", "events/extremum_rise.c", "x->slope += slope;", ""),
    Fault(
        "ask: a bend of two rates that are not known",
        "events/extremum_rise.c",
        "(error + before->rate_error + ",
        "0 * (error + before->rate_error + ",
    ),
    Fault(
        "ask: a node far away is the extreme",
        "events/extremum.c",
        "if (n * n * fabs(x->s - w->step.nodes->at[k]) > NEAR)",
        "if (0)",
    ),
    Fault(
        "ask: one value that is none fails the run",
        "events/extremum_search.c",
        "if (status) return status == PM_SOLVER ? PM_OK : status;",
        "if (status) return status;",
    ),
    Fault(
        "ask: no value is passed over",
        "events/extremum_search.c",
        "w->ask->undefined[p->ask] = 1; /* it takes finite",
        "; /* it takes finite",
    ),
    Fault(
        "ask: values are searched for the least top",
        "events/extremum_search.c",
        "? NAN : -pm_peak_value(x->w, x->peak)",
        "? NAN : pm_peak_value(x->w, x->peak)",
    ),
    Fault(
        "part: no top where a value only rises", "events/extremum_between.c", "if (isnan(s) ||", "if (1 ||"
    ),
    Fault("part: one side of a top is both", "events/extremum_between.c", "0.5 * (s + b->s)", "s"),
    Fault(
        "hidden: all tops are at nodes",
        "events/extremum_hidden.c",
        "<= ALIKE * rise) return k;",
        "<= 0) return k;",
    ),
    Fault(
        "hidden: nodes that are lower hide nothing",
        "events/extremum.c",
        "nodes->n && !pm_extremum_hidden_possible(nodes, p)",
        "nodes->n",
    ),
    Fault(
        "hidden: a slope that is hardly told is told",
        "events/extremum_hidden.c",
        "return fabs(here->rate) <= p->slope_error &&",
        "return 0 &&",
    ),
    Fault("hidden: every top has been found", "events/extremum_hidden.c", "p->met >> k & 1", "1"),
    Fault(
        "hidden: a step is as long as its samples",
        "events/extremum_hidden.c",
        "if (nodes->at[k] > p->end) return",
        "if (0) return",
    ),
    Fault("branch: a program takes but one", "events/extremum_branch.c", "return found;", "return 0;"),
    Fault(
        "branch: a corner is no extreme",
        "events/extremum_branch.c",
        "return only_dips(b, only, k, left, right) ?",
        "return !b->at.jumps[only] ?",
    ),
    Fault("branch: a jump has no other side", "events/extremum_branch.c", "*t - beside", "*t + beside"),
    Fault(
        "branch: one that no node shows",
        "events/extremum_branch.c",
        "if (turn[j + 1] - turn[j] <= apart)",
        "if (1)",
    ),
    Fault(
        "branch: one that is not taken",
        "events/extremum_nodes.c",
        "if (pm_peak_reigns(p)) pm_ask_offer",
        "pm_ask_offer",
    ),
    Fault(
        "branch: the greater of two is the lesser",
        "expression/program_batch.c",
        "op == PM_OP_MIN ? sign > 0 : sign < 0",
        "sign < 0",
    ),
    Fault(
        "eliminate: rows that are taken off end where they did",
        "numerics/elimination.c",
        "x->high[r] = greater(x->high[r], x->high[i]);",
        "",
    ),
    Fault(
        "eliminate: rows that are taken off begin where they did",
        "numerics/elimination.c",
        "x->low[r] = lesser(x->low[r], x->low[i]);",
        "",
    ),
    Fault(
        "eliminate: later rows have entries where they had",
        "numerics/elimination.c",
        "x->last[r] = greater(x->last[r], x->high[i]);",
        "",
    ),
    Fault(
        "eliminate: any entry is a pivot",
        "numerics/elimination.c",
        "if (x->place[c] >= i && fabs(row[c]) > fabs(row[best])) best = c;",
        "if (x->place[c] >= i && row[best] == 0) best = c;",
    ),
    Fault(
        "eliminate: a row that depends on others has a pivot",
        "numerics/elimination.c",
        "least = fmin(least, pivot);",
        "least = fmin(least, pivot > 0 ? pivot : 1);",
    ),
    Fault("tree: loop rows end before their last", "tree/tree.c", "        t->to[i]++;\n", ""),
    Fault(
        "tree: loop rows share nothing", "tree/tree.c", "t->first_loop[i] = first;", "t->first_loop[i] = i;"
    ),
    Fault(
        "tree: joints that may place a body yet",
        "tree/tree.c",
        "if (i == *spent && is_spent(w, &g)) ++*spent;",
        "++*spent;",
    ),
    Fault("tree: entries of the place before stay", "tree/tree_rates.c", "entry[c] = 0;", "(void)0;"),
    Fault(
        "ask: what is untold is no error",
        "events/ask.c",
        "if (a->bound[ask] > best) pm_accuracy_more",
        "if (0) pm_accuracy_more",
    ),
    Fault(
        "ask: the end of a step that was shortened is no extreme",
        "events/extremum.c",
        "return !(next + (high - low) <= best);",
        "return 0;",
    ),
    Fault(
        "crossing: what is near is far",
        "events/event_bracket.c",
        "> 0 ? 1 : -1) ? FAR * x->biggest : 0",
        "> 0 ? 1 : -1) ? 0 : 0",
    ),
    Fault(
        "crossing: the last step goes the other way",
        "events/event_locate.c",
        "shift = -value / slope, next",
        "shift = value / slope, next",
    ),
    Fault(
        "contact: a rate without the row's body",
        "elements/contact.c",
        "a.v[0] - b.v[0], a.v[1] - b.v[1]",
        "a.v[0], a.v[1]",
    ),
    # contacts out of reach
    Fault(
        "clear: a body does not turn", "events/gap_culling.c", "+ x->radius[i] * fabs(pose[2] - from[2])", ""
    ),
    Fault(
        "clear: the other body stands still", "events/gap_culling.c", "+ w->event->culling.moved[body[1]]", ""
    ),
    Fault(
        "clear: the way is not added up",
        "events/gap_culling.c",
        "x->left[i] -= BETWEEN * moved(w, body);",
        "",
    ),
    Fault(
        "clear: circles pass each other between samples",
        "events/gap_culling.c",
        "fmax(free, safe)",
        "INFINITY",
    ),
    Fault("clear: accelerations do not count", "events/gap_culling.c", "+ 2 * a * way", ""),
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
        "if (is_changed(w->model, PM_TABLE_JOINT, joint)) return 0;",
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
    # edges that end, by polynomials of the time
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
        "for (int i = 0; i <= nturn; i++) {",
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
        "clear: edges are passed in long steps",
        "events/gap_culling.c",
        "case PM_CONTACT_SEGMENT: return part_of_edge(w, e);",
        "",
    ),
    # what joints hold still
    Fault(
        "still: rows that nearly depend hold",
        "equations/fixed_bodies.c",
        "left > CLEARLY * CLEARLY * all",
        "left > 0",
    ),
    Fault("still: a joint that may go holds", "equations/fixed_bodies.c", "is_changed(m, i) || ", ""),
    Fault(
        "still: reactions are not told",
        "equations/fixed_bodies.c",
        "w->fixed->told[e[PM_MEASURE_A]] = 1;",
        ";",
    ),
    Fault(
        "still: contacts of what stands still stay",
        "equations/fixed_bodies.c",
        "any |= let_go(w, &normal);",
        ";",
    ),
    Fault("still: what is pushed stays", "equations/fixed_bodies.c", "let_move(w, PM_TABLE_ACTION, i);", ";"),
    Fault(
        "still: what moves holds",
        "equations/fixed_bodies.c",
        "if (!x->body[other] && place <= i) continue;",
        "if (place == i) continue;",
    ),
    Fault("still: weights are carried twice", "equations/ledger.c", "if (w->numbers.fixed[i]) continue;", ""),
    Fault(
        "still: bodies have no inertia",
        "state/frame.c",
        "if (frame->numbers->fixed[i]) return",
        "if (0) return",
    ),
    # what no answer depends on
    Fault(
        "needed: a contact lets nothing act",
        "scene/dependency.c",
        "{PM_TABLE_JOINT, PM_TABLE_CONTACT, PM_TABLE_FORCE}",
        "{PM_TABLE_JOINT, PM_TABLE_FORCE}",
    ),
    Fault(
        "needed: what a program reads is not followed",
        "scene/dependency.c",
        "more |= mark(x, ref[k].of, e[ref[k].column])",
        "if (table != PM_TABLE_CODE) more |= mark(x, ref[k].of, e[ref[k].column])",
    ),
    Fault("needed: events do nothing", "scene/dependency.c", "more |= mark(x, PM_TABLE_ACTION, i);", ";"),
    Fault(
        "needed: a start beside another is its own",
        "scene/dependency.c",
        " || is_needed_body(x, e[PM_MEASURE_IN])",
        "",
    ),
    Fault(
        "needed: the last jump is of one island",
        "scene/dependency.c",
        "case PM_MEASURE_LOST:",
        "case PM_MEASURE_KINDS:",
    ),
    Fault(
        "reduce: places of the smaller scene",
        "scene/prune.c",
        "return known ? m->prune.original[table][row] : row;",
        "return row;",
    ),
    # planes that turn
    Fault(
        "spin: its couple turns the wrong way", "elements/turning_plane.c", "f[2] += square", "f[2] -= square"
    ),
    Fault(
        "spin: pulls towards the axis", "elements/turning_plane.c", "outward = square", "outward = -square"
    ),
    Fault(
        "spin: both moments in the plane exchanged",
        "elements/turning_plane.c",
        "sine * sine +",
        "cosine * cosine +",
    ),
    Fault(
        "spin: nothing across the plane", "elements/turning_plane.c", " + second(frame, i, PM_SECOND_Z);", ";"
    ),
    Fault(
        "spin: keeps its rate, not its momentum",
        "elements/turning_plane.c",
        "momentum / pm_turning_plane_inertia(frame)",
        "momentum / 0.3",
    ),
    Fault("spin: no energy", "elements/turning_plane.c", "return 0.5 * omega * (i", "return 0 * (i"),
    Fault(
        "spin: not in the ledger",
        "equations/ledger.c",
        "pm_turning_plane_outer(&w->frame, outer);",
        "outer[0] = outer[1] = outer[2] = 0;",
    ),
    Fault("spin: a couple without work", "equations/ledger.c", " + pm_turning_plane_power(w)", ""),
    Fault(
        "spin: no potential along the path",
        "routes/path/path_open.c",
        " + pm_turning_plane_kinetic(&w->frame, PM_NONE)",
        "",
    ),
    Fault(
        "spin: rounding leaves the rest",
        "routes/path/route_path.c",
        " + pm_turning_plane_force_size(&w->frame, x->tangent)",
        "",
    ),
    Fault(
        "spin: taken for uniform", "elements/constant_motion.c", "pm_turning_plane_turns(w->model) || ", ""
    ),
    # actions
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
        "let_slots_go(w, a);\n    *absent",
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
        "action: the event acts each time",
        "elements/trigger.c",
        "w->event->seen[event] + 1 == nth",
        "nth > 0",
    ),
    Fault(
        "action: what begins absent is there",
        "impact/action.c",
        "e[PM_ACTION_A])] = 1",
        "e[PM_ACTION_A])] = 0",
    ),
    Fault(
        "action: the outer impulse is not in the ledger",
        "equations/ledger.c",
        "at, force, couple, 1)",
        "at, force, couple, 0)",
    ),
    Fault(
        "jump: rough contacts that rest let go of their slip",
        "impact/impact.c",
        "== PM_FRICTION_ROUGH)\n            share[i] = JOINED",
        "> PM_FRICTION_ROUGH)\n            share[i] = JOINED",
    ),
    Fault(
        "jump: what is pressed on rebounds",
        "impact/impact.c",
        "part == STRUCK ? restitution_of(w, slot, x.normal) : 0",
        "restitution_of(w, slot, x.normal)",
    ),
    # captures
    Fault(
        "capture: the place is not turned into the body",
        "elements/capture.c",
        "out[1] = -pose[4] * x",
        "out[1] = pose[4] * x",
    ),
    Fault(
        "capture: a body is held as a pin",
        "elements/capture.c",
        "can_turn(&w->frame, normal.body[1]) ? 3 : 2",
        "0 ? 3 : 2",
    ),
    Fault(
        "capture: a particle holds the other's angle",
        "elements/capture.c",
        "PM_BODY_ROW(frame->model, body)[PM_BODY_TURNS]",
        "1",
    ),
    Fault(
        "capture: points are seen to meet where they part",
        "events/event.c",
        "FUNCTION_MEETING, i, 1,",
        "FUNCTION_MEETING, i, -1,",
    ),
    Fault(
        "capture: who has passed by meets no more in the step",
        "events/event_search.c",
        "since = from = f->found",
        "since = from = w->step.end",
    ),
    Fault(
        "capture: who passes by is stopped",
        "events/event_search.c",
        "> PASSES * w->numbers.size",
        "> w->numbers.size",
    ),
    Fault(
        "capture: points meet from afar",
        "elements/capture.c",
        "room = MEETS",
        "room = 0.1",
    ),
    Fault(
        "capture: what is held takes no part in later blows",
        "impact/impact.c",
        "if (captured && share[i] == OUT) share[i] = JOINED;",
        "",
    ),
    Fault(
        "capture: its impulse along the wrong axes",
        "impact/impact.c",
        "axes[4] = {1, 0, 0, 1}",
        "axes[4] = {0, 1, 1, 0}",
    ),
    Fault(
        "capture: its force is that of its first row",
        "elements/measure_contact.c",
        "PM_JOINT_CONSTRAINTS * slot + axis",
        "PM_JOINT_CONSTRAINTS * slot",
    ),
    Fault(
        "capture: lets go when it would pull",
        "equations/active_set.c",
        "status = append_captured(w, nbasis)",
        "status = PM_OK",
    ),
    # couplings and drives
    Fault(
        "strand: tangent point on the wrong side",
        "elements/constraint_strand.c",
        "- row->radius_a * strand.n[k]",
        "+ row->radius_a * strand.n[k]",
    ),
    Fault(
        "strand: gamma without turning",
        "elements/constraint_strand.c",
        "across * across / x.length - pm_dot",
        "-pm_dot",
    ),
    Fault(
        "strand: the other drum winds the wrong way",
        "elements/constraint_strand.c",
        "row->j[5] -= row->radius_b",
        "row->j[5] += row->radius_b",
    ),
    Fault(
        "strand: its turning pays nothing out",
        "elements/constraint_strand.c",
        "(row->radius_b - row->radius_a) * direction + row->radius_a",
        "row->radius_a",
    ),
    Fault(
        "cord: slack ones are not followed", "equations/active_set.c", "    follow_slack_cords(w, s);\n}", "}"
    ),
    Fault("massless: a stand-in stays", "equations/saddle.c", "+ w->numbers.stand_in[i] * before[i]", ""),
    Fault(
        "massless: it has the energy of its stand-in",
        "state/frame.c",
        "frame->numbers->stand_in[3 * i + 2] > 0 ? 0",
        "0 ? 0",
    ),
    Fault(
        "grip: friction goes with the slip",
        "elements/joint_friction.c",
        "== PM_SLIDE_FORWARD ? -size",
        "== PM_SLIDE_FORWARD ? size",
    ),
    Fault(
        "grip: slides the wrong way",
        "elements/joint_friction.c",
        "friction > 0 ? PM_SLIDE_BACKWARD",
        "friction < 0 ? PM_SLIDE_BACKWARD",
    ),
    Fault(
        "grip: never overcome within a phase",
        "elements/joint_friction.c",
        "if (needed <= limit",
        "if (w->state.t > 0 || needed <= limit",
    ),
    Fault(
        "grip: load of one axis",
        "elements/joint_friction.c",
        "sum = hypot(sum, x[active])",
        "sum = x[active]",
    ),
    Fault(
        "grip: a load has a sign", "elements/joint_friction.c", "hypot(sum, x[active])", "(sum + x[active])"
    ),
    Fault(
        "grip: one round of friction",
        "equations/saddle.c",
        "|| !pm_joint_friction_update(w)) {",
        "|| pm_joint_friction_update(w) >= 0) {",
    ),
    Fault("grip: no reaction", "elements/joint_friction.c", "x->body_b = row.body[1];", ""),
    Fault(
        "uniform: joints rub for ever",
        "routes/uniform/route_uniform.c",
        "end = fmin(end, u->rub_end[i])",
        "end = fmin(end, INFINITY)",
    ),
    Fault(
        "drive: no acceleration",
        "elements/constraint_drive.c",
        "row->gamma += pm_drive_change(frame, row->drive);",
        "",
    ),
    Fault(
        "ratio: opposite couples",
        "elements/constraint_drive.c",
        ".couple = {1, -row->ratio}}",
        ".couple = {1, -1}}",
    ),
    Fault(
        "run: one that fails late keeps nothing",
        "run/run.c",
        "if (status < 0 && started)",
        "if (status < 0 && started && 0)",
    ),
    Fault(
        "run: one that fails late keeps what is asked at its end",
        "events/ask.c",
        "if (at_instant && kept[k])",
        "if (1)",
    ),
    Fault("ratio: the ground takes nothing", "elements/constraint.h", " && row->ratio == 1;", ";"),
    Fault(
        "ratio: the other way",
        "elements/constraint_drive.c",
        "row->j[5] = -row->ratio;",
        "row->j[5] = row->ratio;",
    ),
    Fault("drive: no work", "equations/ledger.c", "+ drive_power(w, w->frame.lambda)", ""),
    Fault(
        "drive: its way starts anew at every step",
        "elements/drive.c",
        "memory->anchor += pm_drive_way(frame, program, memory);",
        "",
    ),
    Fault(
        "drive: not in a blow",
        "impact/impact.c",
        "pm_saddle_times(&w->frame, &w->active.row[i], w->state.v) - w->active.row[i].rate",
        "pm_saddle_times(&w->frame, &w->active.row[i], w->state.v)",
    ),
    Fault(
        "belt: friction does not know that it runs",
        "elements/constraint.c",
        "return pm_constraint_rate(frame, row) - pm_drive_rate(frame, row->drive);",
        "return pm_constraint_rate(frame, row);",
    ),
    Fault(
        "gears: both inside",
        "elements/constraint_marks.c",
        "row->radius_a = side == -1 ? -radius_a : radius_a;",
        "row->radius_a = radius_a;",
    ),
    # estimated errors and margins
    Fault(
        "error: the companion as tight as the run",
        "study/accuracy.c",
        "? COARSER * tightest : tightest",
        "? 2 * tightest : tightest",
    ),
    Fault(
        "error: steps that nothing limits are the same",
        "study/accuracy.c",
        "w->numbers.coarse = companion ? COARSE : 1",
        "w->numbers.coarse = 1",
    ),
    Fault(
        "error: nothing of rounding",
        "study/accuracy.c",
        "1 + DISTURBANCE * sign(w->accuracy)",
        "1 + 0 * DISTURBANCE * sign(w->accuracy)",
    ),
    Fault(
        "error: what was not kept is not repeated", "study/accuracy.c", "trust[PM_TRUST_EXCESS] <= 1;", "1;"
    ),
    Fault("margin: near misses", "events/event_bracket.c", "if (least > 0 && least < f->near &&", "if (0 &&"),
    Fault(
        "margin: what rises has nearly not fallen",
        "state/evidence.c",
        "return f->side * f->direction > 0;",
        "return 0 * f->side;",
    ),
    Fault(
        "margin: rates by time and by the path are one",
        "state/evidence.c",
        "x->in_time != y->in_time",
        "x->in_time > 2",
    ),
    Fault(
        "margin: what touches has nearly not struck",
        "state/evidence.c",
        "return f->kind == FUNCTION_GAP && pm",
        "return 0 && pm",
    ),
    Fault(
        "modes: forces that are rounding pull",
        "impact/contact_modes.c",
        "return fmax(sum, pm_case_force(w));",
        "return sum;",
    ),
    Fault(
        "margin: other counts in the companion",
        "study/accuracy.c",
        "e->main->outcome == e->other->outcome ? margin",
        "1 ? margin",
    ),
    Fault(
        "margin: undecided is not told",
        "study/accuracy.c",
        "e->main->status = PM_UNDECIDED",
        "e->main->status = PM_OK",
    ),
    # singular positions
    Fault(
        "path: nothing is bridged",
        "routes/path/path_place.c",
        "return null_vector(w, p->bridge.y) ? status",
        "return 1 ? status",
    ),
    Fault(
        "rk: loop rows keep the rates that the energy did not return",
        "routes/rk/rk_settle.c",
        "gamma *= factor * factor",
        "gamma *= 1",
    ),
    Fault(
        "rk: stages near a singular position only shorten the step",
        "routes/rk/route_rk.c",
        "t->part.least_regular < NEAR_SINGULAR * t->part.most_regular",
        "t->part.least_regular < 0",
    ),
    Fault(
        "path: the bridge's own curvature",
        "routes/path/path_bridge.c",
        "momentum += m * tangent[i] * f->v[i];",
        ";",
    ),
    # errors that the path knows
    Fault(
        "error: the clock's own",
        "routes/path/path_error.c",
        "p->clock.error += (w->state.t - p->clock.t0)",
        "p->clock.error += 0",
    ),
    Fault(
        "error: an event that ends the run",
        "routes/path/path_error.c",
        "if (PM_UNTIL_ROW(m, i)[PM_UNTIL_EVENT] == event)",
        "if (0)",
    ),
    Fault(
        "error: counts that forces decide",
        "routes/path/path_error.c",
        "margin = fmin(margin, fabs(x->distance)",
        "(void)(fabs(x->distance)",
    ),
    Fault(
        "error: marks do not look at forces",
        "impact/instant.c",
        "return asked > watched ? asked : watched;",
        "return asked;",
    ),
    Fault(
        "error: what fired in the step had to",
        "state/evidence.c",
        "f->held && !(f->since > w->step.begin)",
        "f->held",
    ),
    Fault(
        "root: Newton's method ends too soon",
        "numerics/bracket.c",
        "#define NOTHING 1e-16",
        "#define NOTHING 1e-5",
    ),
    # tree coordinates
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
        "a[k] -= sign * roll * roll",
        "a[k] += sign * roll * roll",
    ),
    Fault(
        "tree: the other partner is the parent",
        "tree/tree.c",
        "x->parent = row->body[child_is_a ? 1 : 0]",
        "x->parent = w->model->nbody",
    ),
    Fault(
        "tree: a dropped loop row",
        "tree/tree.c",
        "if (t->used[i]) continue;\n        int low, key",
        "if (t->used[i] || i + 1 == w->active.n) continue;\n        int low, key",
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
        "pm_pair_load(to) + pm_pair_load(wrench)",
        "pm_pair_load(to)",
    ),
    Fault(
        "tree: partitioned, without the quadratic part",
        "tree/tree_partition.c",
        "row->gamma - pm_saddle_times(&w->frame, row, a)",
        "-pm_saddle_times(&w->frame, row, a)",
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
        "tree: a band that is too narrow",
        "tree/tree_band.c",
        "if (last > t->part.right[j]) t->part.right[j] = last;",
        "if (last - 1 > t->part.right[j]) t->part.right[j] = last - 1;",
    ),
    Fault(
        "start: a block of joints pushed the wrong way",
        "equations/least_change.c",
        "level == PM_START_POSITION ? -row->g : row->rate",
        "level == PM_START_POSITION ? row->g : row->rate",
    ),
    Fault(
        "start: what lies across a block of joints",
        "equations/least_change.c",
        "w->saddle.rhs[i] = -along(w, &w->active.row[i], s->across)",
        "w->saddle.rhs[i] = along(w, &w->active.row[i], s->across)",
    ),
    # trees
    Fault(
        "tree: the other side of a line",
        "tree/tree_place.c",
        "rho[0] = s * t[0] - x->radius * t[1]",
        "rho[0] = s * t[0] + x->radius * t[1]",
    ),
    Fault(
        "tree: rolls the wrong way",
        "tree/tree.c",
        "x->roll_own = -sign * row->radius_a",
        "x->roll_own = sign * row->radius_a",
    ),
    Fault(
        "tree: angle of the second partner",
        "tree/tree.c",
        "x->angle = sign * last->value",
        "x->angle = last->value",
    ),
    Fault(
        "tree: sign of a loop row's step",
        "tree/tree_partition.c",
        "t->residual[i] = -w->active.row[t->loop[i]].g",
        "t->residual[i] = w->active.row[t->loop[i]].g",
    ),
    # the path route
    Fault(
        "path: sign of the tangent",
        "routes/path/path_place.c",
        "t[column[i]] = -sum / pivot",
        "t[column[i]] = sum / pivot",
    ),
    Fault(
        "path: accelerations without what the velocities make of them",
        "routes/path/path_open.c",
        "(place->force - place->change * square)",
        "place->force",
    ),
    Fault(
        "path: a missed turning point",
        "routes/path/path_step.c",
        "if (lowest > 0) continue; const",
        "if (lowest > -INFINITY) continue; const",
    ),
    Fault(
        "path: a dip of T between two nodes",
        "routes/path/path_step.c",
        "p->force[k - 1] < 0 && p->force[k] > 0",
        "p->force[k - 1] < 0 && p->force[k] > INFINITY",
    ),
    Fault(
        "path: clock at rest without its root",
        "routes/path/path_step.c",
        ": p->at_rest ? PM_CLOCK_LEAVES",
        ": p->at_rest ? PM_CLOCK_PLAIN",
    ),
    Fault(
        "path: clock that ends at rest, not turned round",
        "routes/path/path_clock.c",
        "reversed ? -sign : 1",
        "1",
    ),
    Fault(
        "path: clock by too few nodes",
        "routes/path/path_clock.c",
        "if (!(FEWER * high <= most)) return 0;",
        "",
    ),
    Fault(
        "path: no evidence of the rows",
        "routes/path/route_path.c",
        "pm_max(broken_row(w), w->ledger.evidence)",
        "w->ledger.evidence",
    ),
    Fault(
        "path: no evidence of the forces",
        "routes/path/route_path.c",
        "pm_max(missed_force(w), w->ledger.evidence)",
        "w->ledger.evidence",
    ),
    Fault(
        "path: clock that is not resolved",
        "routes/path/path_clock.c",
        "return p->clock.tail <= most ||",
        "return 1 ||",
    ),
    Fault(
        "path: leaves rest against the force",
        "routes/path/route_path.c",
        "(x->force > 0 ? 1 : -1)",
        "(x->force > 0 ? -1 : 1)",
    ),
    Fault(
        "path: nudged to the other side",
        "routes/start/perturbation.c",
        "side > 0 ? 1 : side < 0 ? -1 : 0",
        "side > 0 ? -1 : side < 0 ? 1 : 0",
    ),
    Fault(
        "mode: a joint slips unseen",
        "impact/contact_modes.c",
        "if (before == PM_STICK && slides(now))",
        "if (0)",
    ),
    Fault("nudge: to the other side", "routes/start/perturbation.c", "if (there < 0 &&", "if (there > 0 &&"),
    Fault(
        "nudge: a deviation that is not small",
        "routes/start/perturbation.c",
        "#define SIZE 0.1",
        "#define SIZE 1e5",
    ),
    Fault(
        "nudge: by positions alone",
        "routes/start/perturbation.c",
        "s->v[i] += part * e->v[i]",
        "s->v[i] += 0 * part",
    ),
    Fault(
        "nudge: against the forces",
        "routes/start/perturbation.c",
        "read_at(w, w->frame.a) > 0",
        "read_at(w, w->frame.a) < 0",
    ),
    Fault(
        "nudge: a stable rest on a path",
        "routes/start/perturbation.c",
        "status || goes ? status : fail(w, PM_NUDGE_STABLE, 0)",
        "status",
    ),
    Fault(
        "nudge: bodies that hang together",
        "routes/start/perturbation.c",
        "more |= join(w, w->active.row[i].body[0], w->active.row[i].body[1])",
        "more |= 0",
    ),
    Fault(
        "escape: axes that turn the other way",
        "routes/start/fastest_growth.c",
        "(e->dv[i] - turned(e->spin",
        "(e->dv[i] + turned(e->spin",
    ),
    Fault(
        "escape: no squaring", "routes/start/fastest_growth.c", "#define SQUARINGS 60", "#define SQUARINGS 5"
    ),
    Fault(
        "escape: steady at one time only",
        "routes/start/fastest_growth.c",
        "for (int i = 0; i < 3; i++) { const double t",
        "for (int i = 0; i < 1; i++) { const double t",
    ),
    Fault(
        "path: work goes by the length of the way",
        "routes/path/path_step.c",
        "i < w->model->nz_work ? p->sense * p->h",
        "i < w->model->nz_work ? p->h",
    ),
    Fault(
        "path: momentum of the outer world",
        "routes/path/route_path.c",
        "ledger[i] = w->path->impulse[i] + momentum[i]",
        "ledger[i] = w->path->impulse[i]",
    ),
    Fault(
        "ask: a grid value beyond the instant",
        "events/ask.c",
        "if (!status && t > w->step.end) continue;",
        "",
    ),
    Fault(
        "event: root of samples with a corner",
        "events/event_samples.c",
        "#define RESOLVED 1e-6",
        "#define RESOLVED 1e6",
    ),
    # legs that repeat
    Fault(
        "leg: ratio of the blow",
        "routes/path/repeat.c",
        "l->ratio = kinetic / l->before",
        "l->ratio = 1.000001 * kinetic / l->before",
    ),
    Fault(
        "leg: work on the way",
        "routes/path/repeat.c",
        "l->work = pm_repeat_energy_work(w)",
        "l->work = -pm_repeat_energy_work(w)",
    ),
    Fault(
        "leg: barrier ignored",
        "routes/path/repeat_energy.c",
        "if (!(next - pm_repeat_energy_depth(l) > near)) {",
        "if (0) {",
    ),
    Fault(
        "leg: anchors stay behind",
        "routes/path/repeat_pass.c",
        "if (w->state.slot[i].mode == PM_STICK) pm_active_set_anchor(w, &w->state, i)",
        "if (0) pm_active_set_anchor(w, &w->state, i)",
    ),
    Fault(
        "leg: momentum ledger",
        "routes/path/repeat_pass.c",
        "close_momentum(w, momentum); return pm_active_set_build(w)",
        "return pm_active_set_build(w)",
    ),
    Fault(
        "leg: members stay behind",
        "routes/path/repeat_pass.c",
        "s->slot[i].member += (int32_t)(legs * l->member)",
        "s->slot[i].member += (int32_t)(l->member)",
    ),
    Fault(
        "leg: what blows take is lost",
        "routes/path/repeat_pass.c",
        "w->ledger.energy_lost += legs->lost",
        "w->ledger.energy_lost += 0 * legs->lost",
    ),
    Fault(
        "leg: firings are not counted",
        "routes/path/repeat_pass.c",
        "w->event->count[i] += legs * each",
        "w->event->count[i] += each",
    ),
    Fault(
        "leg: the end within the last leg",
        "routes/path/repeat_limit.c",
        "(double)(lacks / each - 1)",
        "(double)(lacks / each)",
    ),
    Fault(
        "leg: a trigger that the energy moves",
        "routes/path/repeat.c",
        "mark == l->expected_mark && !pm_repeat_limit_signs_changed(w)",
        "mark == l->expected_mark",
    ),
    Fault(
        "replay: impulses that are read",
        "routes/path/repeat_replay.c",
        "kind == PM_MEASURE_CONTACT_IMPULSE",
        "0",
    ),
    Fault("path: what bends it does not react", "routes/path/path_open.c", "+ pm_pair_load(c) * square", ""),
    Fault(
        "path: levers of another place",
        "routes/path/path_open.c",
        "pm_tree_react_inward(w, place->arm)",
        "pm_tree_react_inward(w, NULL)",
    ),
    Fault(
        "path: a line that does not turn along",
        "routes/path/path_rigid.c",
        "x->bend = 2 * rate * n - x->rho;",
        "",
    ),
    Fault(
        "path: a group bent outward",
        "routes/path/path_rigid.c",
        "c = x->bend - spin * r",
        "c = x->bend + spin * r",
    ),
    Fault(
        "path: a welded body that is not turned", "routes/path/path_rigid.c", "turned(turn, b->turn)", "turn"
    ),
    Fault("path: a repeated step keeps its T", "routes/path/path_cycle.c", "x->kinetic += more;", ""),
    Fault("path: a repeated step stays where it was", "routes/path/path_cycle.c", "shift(w, from, x);", ""),
    Fault(
        "path: a dip of the speed between the nodes",
        "routes/path/path_step.c",
        "&& !speed_resolved(p)",
        "&& 0",
    ),
    Fault("replay: nothing is watched", "routes/path/repeat_replay.c", "status = pm_ask_step(w);", ""),
    Fault(
        "replay: T of the first leg passed over",
        "routes/path/repeat.c",
        ".kinetic = legs->kinetic,",
        ".kinetic = l->kinetic,",
    ),
    Fault(
        "replay: the leg is not passed over",
        "routes/path/repeat.c",
        "if (*told) pm_repeat_energy_add(l, legs);",
        "",
    ),
    Fault(
        "leg: multiples of a speed",
        "routes/path/repeat_limit.c",
        "return growth != PM_ENERGY_CLASS_NONE || fabs(change",
        "return fabs(change",
    ),
    Fault(
        "leg: given back without its energies",
        "routes/path/repeat_record.c",
        "MOVE(s->before, l->before)",
        "if (!back) MOVE(s->before, l->before)",
    ),
    Fault(
        "leg: never refuted",
        "routes/path/repeat.c",
        "if (l->pending == 0) return 0; read_end",
        "return 0; read_end",
    ),
    Fault(
        "leg: a list is left out",
        "routes/path/repeat_limit.c",
        "return each_is_asked ? 0 : at_most",
        "return at_most",
    ),
    Fault(
        "leg: a grid is left out",
        "routes/path/repeat_limit.c",
        "return grid_is_full(w, e) ? PM_MOST_REPEATS : 0",
        "return (void)grid_is_full, PM_MOST_REPEATS",
    ),
    Fault(
        "symmetry: any body is round",
        "scene/symmetry.c",
        "return !turned(s, e[PM_POINT_BODY]) ||",
        "return 1 ||",
    ),
    Fault(
        "symmetry: across a line",
        "scene/symmetry.c",
        "return fabs(across) <= SAME * hypot(s->by[0], s->by[1])",
        "return 1",
    ),
    Fault(
        "growth: the ratio of two forces",
        "scene/program_energy.c",
        "if (b == PM_ENERGY_CLASS_NONE) return product(a, b);",
        "if (b <= PM_ENERGY_CLASS_LINEAR) return a;",
    ),
    Fault(
        "nature: a product of times",
        "scene/program_class.c",
        "(op == PM_OP_MUL && a != b)",
        "op == PM_OP_MUL",
    ),
    # Jacobians: a sign in each kind of column
    Fault(
        "jacobian: x of the first partner",
        "elements/constraint.c",
        "row->j[0] = factor * n[0]",
        "row->j[0] = -factor * n[0]",
    ),
    Fault(
        "jacobian: y of the first partner",
        "elements/constraint.c",
        "row->j[1] = factor * n[1]",
        "row->j[1] = -factor * n[1]",
    ),
    Fault(
        "jacobian: angle of the first partner",
        "elements/constraint.c",
        "row->j[2] = factor *",
        "row->j[2] = -factor *",
    ),
    Fault(
        "jacobian: x of the second partner",
        "elements/constraint.c",
        "row->j[3] = -factor * n[0]",
        "row->j[3] = factor * n[0]",
    ),
    Fault(
        "jacobian: y of the second partner",
        "elements/constraint.c",
        "row->j[4] = -factor * n[1]",
        "row->j[4] = factor * n[1]",
    ),
    Fault(
        "jacobian: angle of the second partner",
        "elements/constraint.c",
        "row->j[5] = -factor *",
        "row->j[5] = factor *",
    ),
    Fault("jacobian: relative angle", "elements/constraint_angle.c", "row->j[5] = -1", "row->j[5] = 1"),
    Fault(
        "jacobian: line that turns, normal",
        "elements/constraint_line.c",
        "row->j[5] -= pm_dot(x.d, l.t)",
        "row->j[5] += pm_dot(x.d, l.t)",
    ),
    Fault(
        "jacobian: wheel on a line",
        "elements/constraint_line.c",
        "row->j[2] += row->radius_a",
        "row->j[2] -= row->radius_a",
    ),
    Fault(
        "jacobian: line that turns, tangent",
        "elements/constraint_line.c",
        "pm_dot(x.d, l.n) - row->radius_a; row->g = rolled",
        "pm_dot(x.d, l.n) + row->radius_a; row->g = rolled",
    ),
    Fault(
        "jacobian: wheel on a circle",
        "elements/constraint_tangent.c",
        "row->j[2] -= row->radius_a",
        "row->j[2] += row->radius_a",
    ),
    Fault(
        "jacobian: circle under a wheel",
        "elements/constraint_tangent.c",
        "row->j[5] -= row->radius_b",
        "row->j[5] += row->radius_b",
    ),
    Fault(
        "jacobian: side of a distance",
        "elements/constraint_distance.c",
        "pm_constraint_along(row, &x, n, row->sign)",
        "pm_constraint_along(row, &x, n, 1)",
    ),
    # gamma and memory
    Fault("gamma: pin", "elements/constraint_point.c", "row->gamma = omega_a", "row->gamma = -omega_a"),
    Fault(
        "gamma: line, Coriolis",
        "elements/constraint_line.c",
        "- 2 * x.omega_b * pm_dot(x.u, l.t)",
        "+ 2 * x.omega_b * pm_dot(x.u, l.t)",
    ),
    Fault(
        "gamma: line, no slip",
        "elements/constraint_line.c",
        "+ 2 * x.omega_b * pm_dot(x.u, l.n)",
        "- 2 * x.omega_b * pm_dot(x.u, l.n)",
    ),
    Fault(
        "gamma: distance",
        "elements/constraint_distance.c",
        "+ across * across / distance",
        "- across * across / distance",
    ),
    Fault(
        "gamma: circle, no slip",
        "elements/constraint_tangent.c",
        "- 2 * pm_dot(x.u, n) * spin",
        "+ 2 * pm_dot(x.u, n) * spin",
    ),
    Fault(
        "rk: steps outrun the reactions",
        "routes/rk/route_rk.c",
        "return w->active.n > 0 ? w->rk->turning : INFINITY;",
        "return INFINITY;",
    ),
    Fault(
        "memory: turns are forgotten",
        "elements/constraint_tangent.c",
        "turn * round(c / turn)",
        "0 * round(c / turn)",
    ),
    Fault(
        "memory: anchor of another place",
        "elements/constraint_line.c",
        "memory->anchor = rolled(frame, row, &x, &l)",
        "memory->anchor = rolled(frame, row, &x, &l) + 1e-3",
    ),
    Fault(
        "line of action: other side of the wheel",
        "elements/constraint_tangent.c",
        "y.a.p[k] - row->radius_a",
        "y.a.p[k] + row->radius_a",
    ),
    # the linear system and the projection
    Fault(
        "saddle: sign of gamma",
        "equations/saddle.c",
        "w->saddle.wanted[i] = w->active.row[i].gamma;",
        "w->saddle.wanted[i] = -w->active.row[i].gamma;",
    ),
    Fault(
        "saddle: friction left out of the force",
        "equations/saddle.c",
        "use_h ? force_direction(w, row) : row->j",
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
        "dense: Cholesky",
        "numerics/dense.c",
        "k = 0; k < j; k++) s -= ai[k] * aj[k]",
        "k = 0; k < j; k++) s += ai[k] * aj[k]",
    ),
    Fault(
        "dense: LU without its pivots",
        "numerics/dense.c",
        "i < n; i++) { const double swap = x[pivot[i]]",
        "i < n; i++) { const double swap = x[i]",
    ),
    Fault(
        "dense: inverse without its exchanges",
        "numerics/dense.c",
        "i < n && pivot[j] != j; i++",
        "i < 0 && pivot[j] != j; i++",
    ),
    Fault(
        "projection: position goes away",
        "equations/projection.c",
        "w->saddle.rhs[i] = -w->active.row[i].g",
        "w->saddle.rhs[i] = w->active.row[i].g",
    ),
    Fault(
        "projection: velocity goes away",
        "equations/projection.c",
        "w->active.row[i].rate - pm_saddle_times",
        "w->active.row[i].rate + pm_saddle_times",
    ),
    Fault(
        "projection: position left out", "equations/projection.c", "pm_saddle_spread(w, 0, s->q)", "(void)0"
    ),
    Fault(
        "rows: a redundant row stays",
        "equations/active_set.c",
        "*depends = rest.left < STILL_DEPENDENT",
        "*depends = 0",
    ),
    # forces
    Fault(
        "force: spring pushes",
        "elements/force.c",
        "return stiffness * x->stretch",
        "return -stiffness * x->stretch",
    ),
    Fault(
        "force: couple of a torsion spring",
        "elements/force.c",
        "x->couple = -stiffness",
        "x->couple = stiffness",
    ),
    Fault("force: no reaction on the second partner", "elements/force.c", "x.couple, -1)", "x.couple, 0)"),
    Fault(
        "force: moment of a force",
        "elements/force.c",
        "(couple + (at[0] - pose[0])",
        "(couple - (at[0] - pose[0])",
    ),
    # blows
    Fault("blow: sign of restitution", "impact/impact.c", "return -(1 + e) * u;", "return -(1 - e) * u;"),
    Fault(
        "blow: slip is not given back",
        "impact/impact.c",
        "? -(1 + pm_contact_tangential",
        "? -(1 - pm_contact_tangential",
    ),
    Fault(
        "blow: gains of energy are not seen",
        "impact/impact.c",
        "return given <= GAINS * size + nothing ?",
        "return 1 ?",
    ),
    Fault(
        "one by one: all at once",
        "impact/impact.c",
        "if (is_blow(w, i, &x) && *struck > 0 && one_by_one(w)) break;",
        "",
    ),
    Fault(
        "one by one: one event for all", "elements/trigger.c", "w->event->fired[i] = PM_FIRED_EARLIER;", ";"
    ),
    Fault("one by one: resting contacts join", "impact/impact.c", "(!one_by_one(w) && join_", "(join_"),
    Fault(
        "blow: reversed slip",
        "impact/impact.c",
        "trial[i] == PM_SLIDE_FORWARD ? 1 : -1",
        "trial[i] == PM_SLIDE_FORWARD ? -1 : 1",
    ),
    Fault(
        "impact: friction drives the slip", "impact/impact_course.c", "-copysign(x->rub,", "copysign(x->rub,"
    ),
    Fault("impact: what has stopped holds", "impact/impact_course.c", "fabs(x->b) <= x->grip * x->c", "1"),
    Fault("impact: slip does not end", "impact/impact_course.c", "now->slip * now->rate_t < 0 ?", "0 ?"),
    Fault(
        "impact: restitution of the whole impulse",
        "impact/impact_course.c",
        "(1 + e) * now.impulse",
        "2 * e * now.impulse",
    ),
    Fault("impact: restitution of the work", "impact/impact_course.c", "-e * e * now.work", "-e * now.work"),
    Fault("edge: it does not end", "events/event.c", "case FUNCTION_END:", "case FUNCTION_END: return 1;"),
    Fault("edge: its end is not seen beside it", "elements/edge.c", "if (beyond <= 0) return", "return"),
    Fault(
        "edge: what is behind it touches",
        "elements/contact.c",
        "|| pm_edge_touches(&w->frame, contact)",
        "|| 1",
    ),
    Fault(
        "edge: what is behind it stays there",
        "events/event.c",
        "return f->below ? pm_edge_gap_from_below(&w->frame, f->index) : gap;",
        "return gap;",
    ),
    Fault(
        "edge: the wrong corner",
        "elements/edge.c",
        "if (x.radius > 0) *member = x.from > x.to",
        "if (x.radius > 0) *member = x.from < x.to",
    ),
    Fault(
        "edge: friction keeps its side round a corner",
        "impact/contact_modes.c",
        "if (slides(s->mode)) s->mode =",
        "if (0) s->mode =",
    ),
    Fault(
        "edge: what has left it comes back",
        "impact/contact_modes.c",
        "w->instant.slot_released[slot] = FOR_GOOD;",
        "w->instant.slot_released[slot] = LET_GO;",
    ),
    Fault(
        "edge: a corner turns the slip round",
        "elements/edge.c",
        "member != PM_SEGMENT_FACE ? -1 : 1",
        "member != PM_SEGMENT_FACE ? 1 : 1",
    ),
    Fault(
        "edge: nobody takes over",
        "impact/contact_modes.c",
        "return heir == PM_NONE ? PM_OK : hand_over(w, mode, heir);",
        "return PM_OK;",
    ),
    Fault(
        "edge: both edges have the corner",
        "elements/contact.c",
        "pm_edge_is_covered(w, s, contact) ? INFINITY :",
        "",
    ),
    Fault("edge: the next one is not seen", "elements/edge.c", "room = beyond_end(&x, end);", ""),
    Fault("impact: joints do not hold", "impact/impact_course.c", "pm_saddle_spread(w, 0, x);", ""),
    Fault(
        "blow: row of a resting contact dropped",
        "impact/impact.c",
        "share[i] = JOINED;\n        trial",
        "share[i] = DROPPED;\n        trial",
    ),
    Fault("blow: pulling contacts stay", "impact/impact.c", "return worst != PM_NONE", "return 0"),
    Fault(
        "blow: friction beyond its bound",
        "impact/impact.c",
        "pm_contact_static(&w->frame, contact) * w->saddle.rhs",
        "2 * pm_contact_static(&w->frame, contact) * w->saddle.rhs",
    ),
    Fault(
        "blow: friction along the slip",
        "impact/impact.c",
        "slip > 0 : friction < 0",
        "slip < 0 : friction > 0",
    ),
    Fault(
        "blow: what stays is opened",
        "impact/impact.c",
        "w->state.slot[i].mode = pm_contact_modes_of_slip(w, contact, member)",
        "w->state.slot[i].mode = PM_OPEN",
    ),
    # modes
    Fault(
        "mode: friction along the slip",
        "equations/active_set.c",
        "PM_SLIDE_FORWARD ? -mu : mu",
        "PM_SLIDE_FORWARD ? mu : -mu",
    ),
    Fault(
        "mode: slides against the force",
        "impact/contact_modes.c",
        "friction > 0 ? PM_SLIDE_BACKWARD : PM_SLIDE_FORWARD",
        "friction > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD",
    ),
    Fault("mode: contacts may pull", "impact/contact_modes.c", "if (worst == PM_NONE) return 0", "return 0"),
    Fault(
        "mode: stick has no bound",
        "impact/contact_modes.c",
        "if (room >= -SLACK * size) continue; w->state.slot[i].mode",
        "if (room >= -1e300 * size) continue; w->state.slot[i].mode",
    ),
    # events
    Fault(
        "missed root: gap of a contact",
        "events/event.c",
        "add(w, FUNCTION_GAP, contact, -1",
        "add(w, FUNCTION_GAP, contact, 1",
    ),
    Fault(
        "missed root: normal force",
        "events/event.c",
        "add(w, FUNCTION_NORMAL, i",
        "if (0) add(w, FUNCTION_NORMAL, i",
    ),
    Fault("missed root: grip", "events/event.c", "add(w, FUNCTION_GRIP, i", "add(w, FUNCTION_NORMAL, i"),
    Fault("missed root: slip", "events/event.c", "add(w, FUNCTION_SLIP, i", "if (0) add(w, FUNCTION_SLIP, i"),
    Fault("missed root: two in one step", "events/event_bracket.c", "return least <= 0", "return 0"),
    Fault(
        "missed root: a dip beside the end of a step",
        "events/event_bracket.c",
        "const int turned = near &&",
        "const int turned = 0 &&",
    ),
    Fault(
        "missed root: dips do not show at nodes",
        "events/event_bracket.c",
        "return b < a ? k + 2",
        "if (b >= 0) return 0; return b < a ? k + 2",
    ),
    Fault(
        "missed root: leaves its zero on the other side",
        "events/event_bracket.c",
        "told ? pm_chebyshev_value(",
        "told ? -pm_chebyshev_value(",
    ),
    Fault(
        "event: where samples tell it roughly is exact",
        "events/event_locate.c",
        "pm_event_samples_residual(f, f->biggest) <= TOLD * fabs(slope * h)",
        "pm_event_samples_residual(f, f->biggest) <= 1e8 * TOLD * fabs(slope * h)",
    ),
    Fault(
        "missed root: comes back to a held zero at once",
        "events/event_bracket.c",
        "return crosses(f, g, gb)",
        "return 0",
    ),
    Fault(
        "event: the wrong way",
        "events/event_bracket.c",
        "if (f->direction <= 0 && a > 0 && b <= 0)",
        "if (f->direction >= 0 && a > 0 && b <= 0)",
    ),
    Fault(
        "event: a blow's change of sign",
        "elements/trigger.c",
        "const int rises = before < 0 && after > 0",
        "const int rises = 0",
    ),
    Fault(
        "event: not at its place",
        "events/event_locate.c",
        "polish(w, i, x, slope, place, taken)",
        "(*place += 1e-8, PM_OK)",
    ),
    Fault("event: a mark passed twice", "run/advance.c", "fmax(x, e->function[i].located)", "0"),
    Fault(
        "event: a mark passed again beside its place",
        "run/advance.c",
        "fmax(x, e->function[i].located)",
        "x",
    ),
    Fault(
        "event: a trigger on time that comes late",
        "elements/trigger.c",
        "return due > now ? due : INFINITY",
        "return due > now ? due + 1e-7 : INFINITY",
    ),
    # the rk route
    Fault(
        "rk: a digit of the dense output", "routes/rk/dop853.h", "18.148505520854727", "18.148515520854727"
    ),
    Fault(
        "rk: a digit of the step",
        "routes/rk/dop853.h",
        "0.04471061572777259};",
        "0.04471071572777259};",
    ),
    Fault(
        "rk: a sign of the dense output",
        "routes/rk/rk_formula.c",
        "2 * change - (f0 + f1)",
        "2 * change - (f0 - f1)",
    ),
    Fault(
        "rk: no control of the error",
        "routes/rk/rk_formula.c",
        "return sum5 == 0 ? 0 :",
        "return sum5 >= 0 ? 0 :",
    ),
    Fault(
        "rk: energy is taken instead of returned",
        "equations/energy_level.c",
        "1 + missing / kinetic",
        "1 - missing / kinetic",
    ),
    Fault(
        "rk: a damped motion keeps its energy",
        "equations/energy_level.c",
        "only_potentials(w) && drives",
        "drives",
    ),
    Fault(
        "rk: impulses of a sampled step",
        "routes/rk/rk_settle.c",
        "if (!w->rk->ledger) follow_momenta",
        "follow_momenta",
    ),
    Fault(
        "rk: summed weights",
        "tree/tree_augmented.c",
        "w->numbers.gravity[1] * p[0] -",
        "w->numbers.gravity[1] * p[0] +",
    ),
    Fault("rk: summed centrifugal forces", "tree/tree_augmented.c", "x[k] -= a->square", "x[k] += a->square"),
    Fault(
        "rk: errors of the last coordinate",
        "routes/rk/rk_formula.c",
        "i < n; i += 2) {",
        "i + 2 < n; i += 2) {",
    ),
    Fault(
        "audit: a path at the rate of another",
        "equations/ledger.c",
        "zdot[m->nz_work + i]",
        "zdot[m->nz_work]",
    ),
    Fault("swift: centrifugal forces", "tree/tree_small.c", "f[k] -= square[i]", "f[k] += square[i]"),
    Fault(
        "swift: weights",
        "tree/tree_small_sums.c",
        "= -w->numbers.gravity[1] * p[1]",
        "= w->numbers.gravity[1] * p[1]",
    ),
    Fault("swift: gamma", "tree/tree_small.c", "gamma[i] += square[k]", "gamma[i] -= square[k]"),
    Fault("swift: a series is too short", "tree/tree_small.c", "- z2 * (1. / 87178291200)", ""),
    Fault("swift: a series is used far away", "tree/tree_small.c", "by[0] > -CLOSE", "by[0] > -9 * CLOSE"),
    Fault("swift: a mark that does not turn", "tree/tree_small_sums.c", "lever[1] += p.r[1];", ""),
    Fault(
        "swift: a row between two angles",
        "tree/tree_small_sums.c",
        "x->shift[k] += sign;",
        "x->shift[k] += 1;",
    ),
    Fault("swift: shifted masses", "tree/tree_small.c", "p->mass[i][i] += 2 * more", "p->mass[i][i] += more"),
    Fault("swift: a cofactor", "tree/tree_small.c", "- m[0][0] * m[2][1]", "+ m[0][0] * m[2][1]"),
    Fault(
        "swift: any moving line",
        "tree/tree_small_sums.c",
        "return row->body[1] == w->model->nbody;",
        "return 1;",
    ),
    Fault(
        "swift: rates keep off the rows",
        "tree/tree_small.c",
        "opening[i] -= jacobian",
        "opening[i] += jacobian",
    ),
    # answers, audit, batch, start
    Fault(
        "ask: maxima for minima",
        "events/extremum_between.c",
        "return a->rate > 0 && b->rate < 0",
        "return a->rate < 0 && b->rate > 0",
    ),
    Fault(
        "ask: grid value of another instant",
        "events/ask.c",
        "w->numbers.value[e[PM_ASK_FIRST_VALUE] + k], 0,",
        "w->numbers.value[e[PM_ASK_FIRST_VALUE]], 0,",
    ),
    Fault(
        "audit: always content",
        "equations/ledger.c",
        "return pm_fail(w, PM_AUDIT",
        "w->result.where.row = pm_fail(w, PM_AUDIT",
    ),
    Fault(
        "audit: loss of a blow", "equations/ledger.c", "loss -= 0.5 * lambda[i]", "loss -= 0.4 * lambda[i]"
    ),
    Fault(
        "batch: a step size from the case before",
        "routes/rk/route_rk.c",
        "if (w->result.count[PM_COUNT_STEPS] == 0 || w->state.t > r->end) r->next = 0",
        "(void)0",
    ),
    Fault("batch: counts from the case before", "run/run.c", "pm_trigger_reset(w)", "(void)0"),
    Fault(
        "start: contradictions pass", "equations/start_velocities.c", "return PM_START_CONFLICT", "continue"
    ),
    Fault(
        "start: open motions pass",
        "equations/start_velocities.c",
        "&& rest.left > OPEN_PART",
        "&& rest.left > 2",
    ),
    Fault(
        "program: left and right",
        "expression/program.c",
        "case PM_OP_SUB: return a - b",
        "case PM_OP_SUB: return b - a",
    ),
    Fault(
        "measure: velocity of a moving observer",
        "elements/measure_body.c",
        "out[0] = p.v[0] - (v[0] - v[2]",
        "out[0] = p.v[0] - (v[0] + v[2]",
    ),
    # the uniform route
    Fault(
        "uniform: sign of the accelerations",
        "routes/uniform/route_uniform.c",
        "v[i] = u->v[i] + t * u->a[i]",
        "v[i] = u->v[i] - t * u->a[i]",
    ),
    Fault(
        "uniform: half of the way",
        "routes/uniform/route_uniform.c",
        "0.5 * t * u->a[i]",
        "0.25 * t * u->a[i]",
    ),
    Fault(
        "uniform: rows are dropped from the proof",
        "elements/constant_motion.c",
        "|| !rows_hold(w, x)) return 0",
        ") return 0",
    ),
    Fault(
        "uniform: levers of locked bodies do not change their couples",
        "elements/constant_motion.c",
        "x->levers = more = 1",
        "more = 1",
    ),
    Fault(
        "uniform: missed root of a rod that spins",
        "elements/constraint_line.c",
        "? pm_dot(r.apart, l.n) - r.swing",
        "? pm_dot(r.apart, l.n) - 0.5 * r.swing",
    ),
    Fault(
        "uniform: missed root of a touching contact that leaves",
        "routes/uniform/uniform_gap.c",
        "return rate > 0 ? (rate + sqrt(square)) / -bend",
        "return rate > 0 ? INFINITY",
    ),
    Fault(
        "uniform: missed root of one inside the other",
        "elements/constraint_distance.c",
        "-(hardest + r.rate * r.rate / nearest)",
        "-hardest",
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
        "if (turn > TURN_APART && turn < 1)",
        "if (turn < 0)",
    ),
    Fault(
        "uniform: distance travelled",
        "routes/uniform/route_uniform.c",
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
    Fault(
        "zeno: strikes that are asked for",
        "routes/uniform/zeno.c",
        "e[PM_ASK_COUNT] > count) return 1",
        "0) return 1",
    ),
    Fault("zeno: another contact", "routes/uniform/zeno.c", "* r->time)) return 0", "* r->time)) continue"),
    Fault(
        "zeno: slip that ends", "routes/uniform/zeno.c", "if (!(fabs(now) > change)) return 0", "(void)change"
    ),
    Fault(
        "zeno: a trigger on the way",
        "routes/uniform/zeno.c",
        "!(x.least > 0 || x.greatest < 0)) return 0",
        "0) return 0",
    ),
    Fault(
        "jump: a series cut off loses nothing",
        "impact/impact.c",
        "(w->numbers.coarse > 1 ? EARLIER : 1)",
        "1",
    ),
    Fault("jump: its blows can be counted", "impact/impact.c", "pm_trigger_countless(w, contact);", ""),
    Fault(
        "jump: its last blows are decisions",
        "impact/impact.c",
        "fabs(rate) <= UNKNOWN *",
        "fabs(rate) <= 0 *",
    ),
    Fault(
        "error: a cut goes with the tolerance",
        "study/accuracy.c",
        "doubtful || e->main->cut ||",
        "doubtful ||",
    ),
    Fault(
        "decision: nothing is compared after a series", "state/evidence.c", "log->instant = part * PART;", ""
    ),
    # the ida route
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
        "ida, sparse: sign of the bends",
        "routes/ida/ida_sparse.c",
        "-ic * ic * j->stiffness",
        "ic * ic * j->stiffness",
    ),
    Fault(
        "ida, sparse: turns of the rows",
        "routes/ida/ida_sparse.c",
        "ic * e[r] * j->turn",
        "0 * ic * e[r] * j->turn",
    ),
    Fault(
        "ida, sparse: forces by the rows",
        "routes/ida/ida_sparse.c",
        "put_reaction(w, s, 2 * nq + r, 1, r, j->h, -1)",
        "put_reaction(w, s, 2 * nq + r, 1, r, j->g, -1)",
    ),
    Fault(
        "ida: singular positions that a step has come to",
        "routes/ida/route_ida.c",
        "return fmin(j->independence, pm_saddle_independence_there(w, &w->state));",
        "return j->independence;",
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
    Fault("ida: sign of the bends", "routes/ida/ida_linear.c", "= -j->turn[", "= j->turn["),
    Fault(
        "ida: sign of the reactions",
        "routes/ida/ida_system.c",
        "w->saddle.rhs[i] = -yp[l + i]",
        "w->saddle.rhs[i] = yp[l + i]",
    ),
    Fault(
        "ida: friction left out",
        "routes/ida/ida_system.c",
        "pm_saddle_spread(w, 1, r + nq)",
        "pm_saddle_spread(w, 0, r + nq)",
    ),
    Fault(
        "ida: missed root of a normal force",
        "run/advance.c",
        "e->hit[i] |= e->root[i] != 0",
        "e->hit[i] |= e->root[i] != 0 && e->function[i].kind != FUNCTION_NORMAL",
    ),
    Fault(
        "ida: singular positions are not handed over",
        "routes/ida/route_ida.c",
        "(lost ? LOST : NEAR_SINGULAR)",
        "0",
    ),
    Fault(
        "ida: missed root between two steps",
        "routes/ida/ida_root.c",
        "return !(fmin(fabs(a), fabs(b)) > REACH * change)",
        "return 0",
    ),
    # Finds
    Fault(
        "find: a change of sign between samples is not seen",
        "study/find.c",
        "if (value * last < 0) status = close_bracket",
        "if (value * last < -1e300) status = close_bracket",
    ),
    Fault(
        "find: two roots between samples are not looked for",
        "study/find.c",
        "if (!status && i > 1 && value * last > 0",
        "if (!status && i > 1 && value * last > 1e300",
    ),
    Fault("find: a pole is taken for a root", "study/find_root.c", "#define JUMP 1e-3", "#define JUMP 1e300"),
    Fault(
        "find: the outcome is bisected to the wrong side",
        "study/find_root.c",
        "if (look.holds) { *yes = look; } else {",
        "if (!look.holds) { *yes = look; } else {",
    ),
    Fault(
        "find: differences without Richardson's correction",
        "study/find_extremum.c",
        "for (int k = 1; k <= i; k++) {",
        "error = i == 0 ? *value = table[0][0], INFINITY : error; for (int k = 1; k <= 0; k++) {",
    ),
    Fault(
        "find: the ends of the bounds do not count",
        "study/find.c",
        "const int left = i == 0 || !is_feasible(p - 1)",
        "const int left = i > 0 && !is_feasible(p - 1)",
    ),
    Fault(
        "find: the least is taken for the greatest",
        "study/find_look.c",
        "(f->goal == PM_FIND_GREATEST ? 1 : -1) * read_program",
        "(f->goal == PM_FIND_GREATEST ? 1 : 1) * read_program",
    ),
    Fault(
        "find: the other value is given for the second parameter",
        "study/find_pair.c",
        "x[k] = f->low[k] + part * (f->high[k] - f->low[k]);\n    }\n    if (!c->status)",
        "x[k] = f->low[0] + part * (f->high[k] - f->low[k]);\n    }\n    if (!c->status)",
    ),
]


class Misfit(Exception):
    """A fault whose text does not occur once in the source, or with which it does not compile."""


def planted(source: str, fault: Fault) -> str:
    pattern = r"\s+".join(re.escape(word) for word in fault.old.split())
    changed, n = re.subn(pattern, lambda _: fault.new, source)
    if n != 1:
        raise Misfit(f"kernel/{fault.file} has {n} places like `{fault.old}`")
    return changed


def run(command: list[str]) -> None:
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode:
        raise Misfit(" ".join(command) + "\n" + result.stderr[:MESSAGE])


class Workshop:
    """A copy of the kernel with its objects, and the tests as objects; a pool of threads shares the work."""

    def __init__(self, folder: Path, pool: ThreadPoolExecutor, first: bool) -> None:
        self.pool = pool
        self.first = first
        self.caught: Counter[tuple[str, str]] = Counter()  # faults of a source, by a test
        self.kernel = folder / "kernel"
        shutil.copytree(ROOT / "kernel", self.kernel)
        self.sources = sorted(path.relative_to(self.kernel).as_posix() for path in self.kernel.rglob("*.c"))
        listed = (ROOT / "tests/kernel/meson.build").read_text(encoding="utf-8")
        self.tests = re.findall(r"^  '(\w+)',$", listed, re.MULTILINE)
        self.objects = folder
        list(pool.map(self.compile, self.sources))
        list(
            pool.map(
                lambda name: self.compile_to(ROOT / f"tests/kernel/{name}.c", folder / f"test_{name}.o"),
                self.tests,
            )
        )

    def compile_to(self, source: Path, target: Path) -> None:
        run([COMPILER, *FLAGS, f"-I{self.kernel}", "-c", str(source), "-o", str(target)])

    def compile(self, name: str) -> None:
        self.compile_to(self.kernel / name, self.object_of(name))

    def object_of(self, name: str) -> Path:
        return self.objects / f"kernel_{Path(name).stem}.o"

    def users(self, file: str) -> list[str]:
        """What must be compiled again when `file` changes."""
        if file.endswith(".c"):
            return [file]
        return [
            name for name in self.sources if f'"{file}"' in (self.kernel / name).read_text(encoding="utf-8")
        ]

    def findings(self, name: str) -> list[str]:
        """What test `name` has to say: nothing, or its name and what else it noticed."""
        program = self.objects / f"test_{name}"
        objects = [str(self.object_of(source)) for source in self.sources]
        run([COMPILER, str(program) + ".o", *objects, "-o", str(program), *LIBRARIES])
        try:
            result = subprocess.run(
                ["sh", "-c", f"ulimit -t {TEST_SECONDS}; exec {program}"],
                capture_output=True,
                text=True,
                errors="replace",
                timeout=WAIT_SECONDS,
            )
        except subprocess.TimeoutExpired:
            return [f"{name} (waits)"]
        if result.returncode == 0:
            return []
        stopped = result.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
        if stopped and not result.stderr:  # else it has failed before
            return [f"{name} (hangs)"]
        noticed = ["audit"] if AUDIT in result.stderr else []
        noticed += ["routes"] if ": routes_agree: " in result.stderr else []
        return [*noticed, name]

    def time_tests(self) -> list[str]:
        """What the tests find in the sound kernel; from then on quick ones are tried before slow ones."""
        seconds = {}
        found = []
        for name in self.tests:
            begun = resource.getrusage(resource.RUSAGE_CHILDREN)
            found += self.findings(name)
            ended = resource.getrusage(resource.RUSAGE_CHILDREN)
            seconds[name] = ended.ru_utime - begun.ru_utime
        self.tests.sort(key=lambda name: seconds[name])
        return found

    def check(self, file: str) -> list[str]:
        """What the tests find now that `file` is changed; the audit and the comparison of routes come first.

        Tests that have caught much in this file are tried before others.
        """
        found: set[str] = set()
        tests = sorted(self.tests, key=lambda name: -self.caught[file, name])
        for name, words in zip(tests, self.pool.map(self.unless_found(found), tests), strict=True):
            found.update(words)
            self.caught[file, name] += bool(words)
        return sorted(found, key=lambda word: (word not in ("audit", "routes"), word))

    def unless_found(self, found: set[str]) -> Callable[[str], list[str]]:
        """`findings`, or nothing as soon as one test is enough and has failed: one that hangs tells less."""

        def look(name: str) -> list[str]:
            failed = any(not word.endswith(")") for word in found)
            words = [] if self.first and failed else self.findings(name)
            found.update(words)
            return words

        return look

    def plant(self, fault: Fault) -> list[str]:
        path = self.kernel / fault.file
        sound = path.read_text(encoding="utf-8")
        path.write_text(planted(sound, fault), encoding="utf-8")
        try:
            list(self.pool.map(self.compile, self.users(fault.file)))
            return self.check(fault.file)
        finally:
            path.write_text(sound, encoding="utf-8")
            list(self.pool.map(self.compile, self.users(fault.file)))


def options() -> argparse.Namespace:
    asked = argparse.ArgumentParser(description="plants faults in a copy of the kernel, one at a time")
    asked.add_argument("words", nargs="*", help="only faults whose name has one of these")
    asked.add_argument("--first", action="store_true", help="no more than one test that catches each")
    asked.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers and tests at once")
    return asked.parse_args()


def main() -> int:
    asked = options()
    faults = [fault for fault in FAULTS if not asked.words or any(word in fault.name for word in asked.words)]
    width = max(len(fault.name) for fault in faults)
    survivors = 0
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(asked.jobs) as pool:
        workshop = Workshop(Path(folder), pool, asked.first)
        found = workshop.time_tests()
        if found:
            sys.exit(f"the tests fail without any fault: {', '.join(found)}")
        print(f"{'fault':{width}}  caught by", flush=True)
        for fault in faults:
            try:
                found = workshop.plant(fault)
                verdict = ", ".join(found) or "NOTHING"
            except Misfit as misfit:
                found, verdict = [], f"DOES NOT FIT: {misfit}"
            survivors += not found
            print(f"{fault.name:{width}}  {verdict}", flush=True)
    print(f"{len(faults)} faults, {len(faults) - survivors} caught")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())

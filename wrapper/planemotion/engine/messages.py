"""What happened to a case, in the scene's own words: file, place, what is wrong, value and bound."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .. import _layout as layout
from ..base.arrays import Floats, Ints
from ..base.errors import located
from ..compile.bounds import named, with_unit
from ..compile.flatten import FlatScene
from .find_messages import FIND_STATUSES, describe_find
from .kernel import kernel, kernel_text, route_name, status_text
from .outcome import CaseResults
from .undecided import undecided

_SETTINGS = {layout.PM_SETTING_NUDGE: "start.nudge", layout.PM_SETTING_ROUTE: "solve.route"}
_NEVER = "until: never reached; the motion repeats itself, and nothing ends it"
# Joints of which a place, an angle or a length is prescribed.
_PRESCRIBED = frozenset(
    (
        layout.PM_JOINT_PLACED,
        layout.PM_JOINT_ANGLE,
        layout.PM_JOINT_LENGTH,
        layout.PM_JOINT_PIN_ANGLE,
        layout.PM_JOINT_SLIDER_PLACE,
        layout.PM_JOINT_SLIDER_FIXED_PLACE,
    )
)
_TABLE_NAMES = {value: name.removeprefix("PM_TABLE_").lower() for name, value in layout.pm_table.items()}


def message(flat: FlatScene, results: CaseResults, i: int) -> str:
    """What happened to case i, in the scene's own words; "" if it is ok."""
    status = int(results.status[i])
    if status == layout.PM_OK:
        return ""
    text = describe(flat, status, results.where[i], results.detail[i], results.param[i])
    if status < layout.PM_OK and not np.isnan(results.out[i]).all():
        text += "; the answers that are there were reached before, while the audit closed"
    return text


def describe(flat: FlatScene, status: int, where: Ints, detail: Floats, param: Floats | None = None) -> str:
    """File, place, what is wrong, value and bound of a status that is not ok.

    `where` [3]: table, row, member; `detail` [3]: value and bound in SI, time in s; `param` [parameters]: of
    the case, SI.
    """
    place = _place_name(flat, where, status)
    if status in FIND_STATUSES and flat.find is not None:
        sentence = describe_find(flat, status, where, detail, flat.defaults if param is None else param)
        return located(sentence, flat.file, flat.source)
    found, bound, time = (float(number) for number in detail)
    text = _DESCRIPTIONS.get(status)
    if status == layout.PM_UNDECIDED:
        return located(undecided(place, where, detail), flat.file, flat.source)
    elif status == layout.PM_ASSEMBLY and _is_driven(flat, where) and not place.startswith("events."):
        sentence = _open_drive(place, found, bound)
    elif status == layout.PM_DRIVE_JUMPS:
        kind = int(flat.rows(layout.PM_TABLE_JOINT)[int(where[layout.PM_WHERE_ROW])][layout.PM_JOINT_KIND])
        unit = "rad" if kind in (layout.PM_JOINT_ANGLE, layout.PM_JOINT_PIN_ANGLE) else "m"
        sentence = (
            f"{place}: what is prescribed jumps by {found:.6g} {unit}, which no force can do; what was "
            "answered before stands; let it be continuous: a rate that jumps is a blow"
        )
    elif status == layout.PM_BAD_VALUE and _is_driven(flat, where):
        sentence = f"{place}: what is prescribed is {found:.6g} at the start; " + (
            "a length must be greater than 0" if math.isfinite(bound) else "a finite number is wanted"
        )
    elif status == layout.PM_BAD_VALUE and int(where[layout.PM_WHERE_TABLE]) == layout.PM_TABLE_CURVE:
        sentence = _bad_curve(place, int(where[layout.PM_WHERE_MEMBER]), found, bound)
    elif status == layout.PM_BAD_VALUE:
        sentence = _bad_value(place, found, bound, _unit(flat, where))
    else:
        sentence = text(place, found, bound) if text is not None else ""
    if not sentence:
        sentence = ": ".join(piece for piece in (place, status_text(status)) if piece)
        if math.isfinite(found):
            numbers = f"{found:.6g}" + (f", bound {bound:.6g}" if math.isfinite(bound) else "")
            sentence += f" ({numbers})"
    if math.isfinite(time) and time > 0 and status != layout.PM_LIMIT_TIME:
        sentence += f", at t = {time:.6g} s"
    return located(sentence, flat.file, flat.source)


def _named(flat: FlatScene, where: Ints) -> tuple[str, str]:
    """Key and unit of the number that is out of its bound."""
    table, row = int(where[layout.PM_WHERE_TABLE]), int(where[layout.PM_WHERE_ROW])
    if table < 0 or row < 0:
        return "", ""
    return named(table, flat.rows(table)[row], int(where[layout.PM_WHERE_MEMBER]))


def _unit(flat: FlatScene, where: Ints) -> str:
    return _named(flat, where)[1]


def _place_name(flat: FlatScene, where: Ints, status: int) -> str:
    """The key path of the row at fault; of a number out of its bound that of the number."""
    table, row = int(where[layout.PM_WHERE_TABLE]), int(where[layout.PM_WHERE_ROW])
    names = flat.names.get(table, ())
    if table == layout.PM_TABLE_SETTING and row in _SETTINGS:
        return _SETTINGS[row]
    if 0 <= row < len(names):
        member = int(where[layout.PM_WHERE_MEMBER])
        if status == layout.PM_BAD_VALUE:
            return f"{names[row]}.{_named(flat, where)[0]}".removesuffix(".")
        is_contact = table == layout.PM_TABLE_CONTACT and status != layout.PM_UNDECIDED
        return f"{names[row]}[{member}]" if is_contact and member > 0 else names[row]
    return _TABLE_NAMES.get(table, "") if table >= 0 else ""


def _here(place: str) -> str:
    return " where it is added" if place.startswith("events.") else " at the start"


def _open_drive(place: str, found: float, bound: float) -> str:
    return (
        f"start: what is prescribed at {place} and the values written do not fit: it is missed by "
        f"{found:.4g} m (an angle: that times the size of the scene; allowed {bound:.2g} m); "
        'leave the start value of its body out, or mark it as a guess, such as angle = "~0 deg"'
    )


def _is_driven(flat: FlatScene, where: Ints) -> bool:
    """Whether a place or an angle is prescribed there."""
    table, row = int(where[layout.PM_WHERE_TABLE]), int(where[layout.PM_WHERE_ROW])
    return (
        table == layout.PM_TABLE_JOINT
        and row >= 0
        and int(flat.rows(table)[row][layout.PM_JOINT_KIND]) in _PRESCRIBED
    )


def _open_joint(place: str, found: float, bound: float) -> str:
    if place.startswith("events."):
        return (
            f"{place}: the joint does not fit there: it is open by {found:.4g} m (allowed {bound:.2g} m); "
            "add it where its partners are as drawn"
        )
    if place.startswith("couplings.") and bound == 0:
        return (
            f"start: {place}: no straight strand as drawn: one circle reaches over the other by {found:.4g} m"
        )
    if place.startswith("couplings."):
        return (
            f"start: {place}: the pitch circles are drawn {found:.4g} m from touching each other "
            f"(allowed {bound:.2g} m); move one of the centres, or change a radius"
        )
    # The kernel measures openings in m, or rad where a direction is held.
    return (
        f"start: the joints cannot be met with the values written: {place or 'a joint'} is open by "
        f'{found:.4g} m (allowed {bound:.2g} m); mark a value as a guess, such as angle = "~0 deg", '
        "or change a length"
    )


def _rate_unit(place: str) -> str:
    return "rad/s" if place.endswith("omega") else "m/s"


def _bad_value(place: str, found: float, bound: float, unit: str) -> str:
    if place == "spin.angle":
        return (
            f"{place}: {found:.6g} m/s^2 of the weight act across the axis; a plane that turns keeps its "
            'weight only along a vertical axis (angle = "90 deg"), or has none in it (plane = "horizontal")'
        )
    if place == "spin.inertia" and found == 0:
        return f"{place}: nothing that turns has an inertia about the axis at the start; give it"
    if math.isfinite(bound):
        wanted = f"the bound is {with_unit(bound, unit)}" if found or bound else "it must be greater than 0"
        return f"{place or 'a value'}: it is {with_unit(found, unit)}; {wanted}"
    return f"{place}: it is {found:.6g} at the start; a force is finite, and a power needs a motion"


def _bad_curve(place: str, column: int, found: float, bound: float) -> str:
    match column:
        case layout.PM_CURVE_X:
            return (
                f"{place}: at s = {found:.6g} its place or its direction is no number, or it is more than "
                f"{bound:.0g} m away from its point"
            )
        case layout.PM_CURVE_Y:
            return f"{place}: at s = {found:.6g} it has a cusp; a curve is smooth: begin or end beside it"
        case layout.PM_CURVE_SIDE:
            return (
                f"{place}: at s = {found:.6g} it bends too sharply for what touches it, by {bound:.2g} rad "
                "in a 1024th of it: write its parts as curves of their own"
            )
        case layout.PM_CURVE_POINT:
            return f"{place}: at s = {found:.6g} it crosses itself: what touches it has no one side there"
        case layout.PM_CURVE_CLOSED:
            return f"{place}: it does not close: its ends are {found:.6g} m apart (allowed {bound:.2g} m)"
        case _:
            return f"{place}: s ends at {found:.6g} and begins at {bound:.6g}; it must end later"


def _alternates(place: str, found: float, bound: float) -> str:
    if place.endswith("switches"):
        return (
            f"{place} and pushes the motion back from both sides, which holds it there: no value of the "
            "force does that; take friction of a contact or a joint, or a smooth expression; what was "
            "answered before stands"
        )
    return (
        f"{place}: contacts stick, slip or part in turn, {found:.0f} times without time passing: next to a "
        "position where they lock each other no motion that is found goes on; what was answered before stands"
    )


def _not_reached(limit: str, bound: str) -> str:
    return f"until: not reached within solve.max_{limit} ({bound})"


_DESCRIPTIONS: dict[int, Any] = {
    layout.PM_LIMIT_TIME: lambda place, found, bound: (
        _not_reached("time", f"{bound:g} s") if math.isfinite(found) else _NEVER
    ),
    layout.PM_LIMIT_EVENTS: lambda place, found, bound: _not_reached("events", f"{found:.0f}"),
    layout.PM_LIMIT_STEPS: lambda place, found, bound: _not_reached("steps", f"{found:.0f}"),
    layout.PM_LIMIT_CPU: lambda place, found, bound: (
        f"solve.max_cpu: given up after {bound:g} s of computing time; what was answered before stands"
    ),
    layout.PM_ALTERNATES: _alternates,
    layout.PM_BOUNCES_ON: lambda place, found, bound: (
        f"{place}: its bounces are too low to be computed, and each takes about as long as the one before "
        f"({found:.6g} s after {bound:.6g} s): nothing tells that it ever comes to rest; what was "
        "answered before stands"
    ),
    layout.PM_CANCELLED: lambda place, found, bound: "cancelled before it was finished",
    layout.PM_STAYS_AT_REST: lambda place, found, bound: (
        "until: not reached; everything has come to rest and stays"
        if found > 0 or bound > 0
        else "until: not reached; everything is at rest from the start and stays: give a velocity in "
        "start, or by start.nudge the side to which an unstable rest is left"
    ),
    layout.PM_ASSEMBLY: _open_joint,
    layout.PM_START_CONFLICT: lambda place, found, bound: (
        f"{place}: {with_unit(found, _rate_unit(place))} is given, but the other start values and the joints "
        f"give {bound:.6g}; leave one of them out"
    ),
    layout.PM_START_OPEN: lambda place, found, bound: (
        f"start: what is given leaves the motion of {place} undetermined; give its omega or a velocity"
    ),
    layout.PM_SINGULAR: lambda place, found, bound: (
        f"{place}: it has no mass, and nothing else determines its motion here; give it one, or fasten it"
        if place.startswith("bodies.")
        else f"{place or 'the scene'}: the joints do not determine the accelerations here: a singular "
        "position (a dead centre, or two joints that have come together); end the run before it, or "
        "change a length"
    ),
    layout.PM_ENDS_SINGULAR: lambda place, found, bound: (
        f"{place or 'the scene'}: a singular position was reached before the end of the run (a dead centre, "
        "or two joints that have come together), and on this route nothing tells how the motion goes on; "
        'what was answered before stands; end the run before it, or try solve.route = "path"'
    ),
    layout.PM_STRAND_ENDS: lambda place, found, bound: (
        f"{place}: at t = {found:.6g} s the cord leaves the rim that it may slip on: nothing is left of its "
        "wrap; what was answered before stands; end the run before it"
        if bound
        else f"{place}: at t = {found:.6g} s no free length is left of the cord: what it pulls has reached "
        "the drum, or its tangent point; what was answered before stands; end the run before it"
    ),
    layout.PM_TABLE_ENDS: lambda place, found, bound: (
        f"{place}: it ends at {bound:.6g} and is read at {found:.6g} (SI); what was answered before "
        'stands; end the run before it, or give it an outside: "hold", "extend" or "repeat"'
    ),
    layout.PM_CURVE_ENDS: lambda place, found, bound: (
        f"{place}: what runs along the curve has come to its end; what was answered before stands; end the "
        "run before it, or make the curve longer"
    ),
    layout.PM_STEP_TOO_SMALL: lambda place, found, bound: (
        "the integrator cannot go on at solve.accuracy: the motion has no smooth continuation here (a "
        "singular position, a force that jumps); end the run before it, or lower the accuracy"
    ),
    layout.PM_UNSUPPORTED: lambda place, found, bound: (
        f"{place}: a blow loads this joint, and friction that goes with the load takes no part in one of "
        "bodies without mass, in an impact without collision, or in one that is followed by its law and has "
        "rough contacts, captures or stiffnesses"
        if place.endswith(".friction")
        else f"{place}: another nudge acts at the same instant; one at a time"
        if place.endswith(".nudge")
        else f'{place} = "{route_name(int(found))}": this route does not compute the motion; it takes '
        f"{kernel_text(kernel().pm_route_text, int(found))}; leave {place} out"
        if place == "solve.route"
        else ""
    ),
    layout.PM_NOT_UNIQUE: lambda place, found, bound: (
        f"{place}: it waits for a load that is not unique: redundant constraints share it, and nothing tells "
        'how; wait for a sum that is, or take solve.shared = "least"'
        if place.startswith(("events.", "until"))
        else f"{place}: redundant constraints share the load of this joint in a blow, and with it its "
        "friction; nothing tells how: take one of them away"
        if place.endswith(".friction")
        else f"{place}: with friction {found:.4g} at the {bound:.0f} contacts that take part, the laws of "
        "contact allow several motions, and nothing tells which; the run ends here"
    ),
    layout.PM_PAINLEVE: lambda place, found, bound: (
        f"{place}: with friction {found:.4g} no motion obeys the laws of contact here "
        f"({bound:.0f} contacts take part; Painleve's paradox); the run ends here; with painleve = "
        '"impact" at a contact that slips and strikes alone it goes on'
    ),
    layout.PM_ROUGH_IMPOSSIBLE: lambda place, found, bound: (
        f"{place}: it is rough, and no motion keeps it from slipping while its normal force pushes; "
        "the run ends here: give it a coefficient of friction"
    ),
    layout.PM_NO_TIME_ROUTE: lambda place, found, bound: (
        f'{place} = "{route_name(int(found))}": no time passes: everything that is asked is answered at the '
        "start, without any integration; the answers stand"
    ),
    layout.PM_SOLVER: lambda place, found, bound: (
        f"{place + ': ' if place else ''}the solver of this route gave up (its code {found:.0f}); "
        'try solve.route = "rk" or another accuracy'
    ),
    layout.PM_BLOWS_ENDLESS: lambda place, found, bound: (
        f"{place}.stiffness: the blow did not end in {bound:.0f} steps; this contact is {found:.3g} times "
        "as stiff as another: stiffnesses nearer to each other, or a restitution below 1, end it"
        if "." in place
        else f"the blows at this instant do not end ({found:.0f} of them): bodies are wedged without loss; "
        "lower a restitution, or take the other order by solve.impacts"
    ),
    layout.PM_BLOW_UNDECIDED: lambda place, found, bound: (
        f"{place}: with friction {found:.4g} at the {bound:.0f} contacts that take part in this blow, no "
        "motion obeys its law: the bodies are wedged; take less friction or restitution, or another law"
        if place and bound > 0
        else f"what the contacts do at this instant is not settled after {found:.0f} rounds"
        if not place
        else f"{place}: this blow has no end by its law: friction wedges the bodies; take less friction, or "
        "another law"
    ),
    layout.PM_BLOW_SEVERAL: lambda place, found, bound: (
        f"{place}.tangential: it is of the law newton, and in a blow of {found:.0f} contacts another one "
        "follows poisson or stronge; give all the law newton, or leave it out"
    ),
    layout.PM_PENETRATION: lambda place, found, bound: (
        f"{place}: the two overlap by {abs(found):.4g} m{_here(place)}; move one of them"
    ),
    layout.PM_NUDGE_UNSTEADY: lambda place, found, bound: (
        f"{place}: it acts where there is neither rest nor a steady motion that could be left to either "
        "side: the motion goes another way by itself; leave out the nudge, or put it at another instant"
    ),
    layout.PM_NUDGE_STABLE: lambda place, found, bound: (
        f"{place}: nothing that it could begin grows: "
        + ("what grows there does not move what it names" if found > 0 else "the rest or motion is stable")
        + "; name a velocity that changes as it is left"
    ),
    layout.PM_NO_EQUILIBRIUM: lambda place, found, bound: (
        f"start: no equilibrium was found near the positions given: an acceleration of {found:.4g} m/s^2 is "
        f"left of {place} (a rotation: that times the size of the scene); draw it nearer to one"
    ),
    layout.PM_EQUILIBRIUM_MOVES: lambda place, found, bound: (
        f"start: an equilibrium is at rest, and what drives {place} moves it at the start "
        f"({found:.4g} m/s or rad/s); let the drive begin at rest, or leave the equilibrium out"
    ),
    layout.PM_EQUILIBRIUM_OPEN: lambda place, found, bound: (
        f"start: with the friction of {place} there are many equilibria, and it is not drawn in one: it "
        + (
            f"would need {f'{found:.4g}' if math.isfinite(found) else 'more'} and has {bound:.4g}"
            + ("" if place.startswith("contacts.") else " (N or N m)")
            + "; draw it where friction can hold it"
            if not math.isnan(found)
            else "would come to touch where nothing tells; draw it touching there, or let it be smooth"
        )
    ),
    layout.PM_NO_IMPULSE: lambda place, found, bound: (
        f"{place}: no impulse on this body does the work {found:.6g} J and keeps the sense of rotation"
        + (
            f"; {bound:.6g} J would stop it"
            if math.isfinite(bound) and bound != 0
            else "; it does not rotate"
        )
    ),
}

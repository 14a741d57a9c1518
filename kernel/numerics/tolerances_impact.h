/* tolerances_impact.h - the part of tolerances.h that belongs to blows and to the modes of contacts. */
#ifndef PM_TOLERANCES_IMPACT_H
#define PM_TOLERANCES_IMPACT_H

/* one line for each number */
/* clang-format off */

/* ---- impact ---- */
#define PM_MEETING_ROUNDINGS 4 /* of the time of a blow: so far off it may be found; larger: what is no rounding is taken for it */
#define PM_ABSURD 1e-8 /* of the forces: where modes were solved for and loads fail by more, what nearly depends holds them; smaller: rounding is taken for that */
#define PM_REVERSED 2 /* slips that are reversed at once where contacts nearly lock; more: more ways are tried */
#define PM_LET_GO_FEW 2 /* contacts that are let go at once where they depend on others for an instant; more: slower, fewer: such runs end singular */
#define PM_NEAR_BESIDE 1e-8 /* of the scene's size: what stands open by less counts as closed where several motions are allowed without it; larger: feet hold that are in the air */
#define PM_PUT_ELSEWHERE 1e-7 /* of the scene's size: so far no rounding of gaps moves bodies; larger: energy is lost, smaller: contacts that close from a distance are let go */
#define PM_STAYS_OPEN 1e-12 /* likewise: so much no projection that ends leaves open; larger: likewise, smaller: rounding far from the origin is taken for it */
#define PM_APART_IN_TIME 1e-6 /* of the natural acceleration: towards each other no more, where others hold a pair to the first order; larger: contacts that press are let go */
#define PM_SLIP_HELD 1e-13 /* of the speed: where others hold a slip to the first order, so much of it is one; larger: it is told by the place ahead, smaller: by rounding */
#define PM_MODES_ROUNDS 8 /* of modes found anew, where friction of joints goes with their load; more would only put off the failure */
#define PM_PROBLEM_TIE 1e-10 /* of the scaled loads, at least 1: none; larger: contacts that pull or part are kept closed */
#define PM_PROBLEM_LEMKE_TIE 1e-9 /* likewise of Lemke's loads, which only propose modes; likewise */
#define PM_PROBLEM_EXACT 1e-13 /* likewise: obeyed to rounding, which goes before what is obeyed within the tie; larger: next to places where contacts lock motions count as several, smaller: rounding chooses one of several */
#define PM_PROBLEM_SOLVED 1e-15 /* of the loads, over the distance of their equations from singular ones: likewise; smaller: rounding chooses one of several */
#define PM_PROBLEM_SAME 1e-7 /* of the scaled rates: the same motion; larger: motions that differ are taken for one */
#define PM_PROBLEM_LARGEST 1e9 /* scaled load: beyond it the mode has no unique loads; larger: rounding is taken for loads */
#define PM_PROBLEM_IMMOBILE 1e-14 /* of the contact's other response: nothing moves that way; larger: friction is left out */
#define PM_SYSTEM_HELD 1e-14 /* of the greatest response, and of what nothing else would hold: nothing moves; larger: light bodies beside heavy ones stand still */
#define PM_PROBLEM_DEPENDS 1e-12 /* of its response: a rough tangent that others hold; larger: what holds is left out */
#define PM_PROBLEM_SOUND 1e-8 /* that distance: smaller, and loads are left out of the mean of those that are possible; larger: so are loads that are known */
#define PM_PROBLEM_COUNTED 4 /* contacts: up to here all modes are tried and motions counted; more: 4 times dearer each */
#define PM_PROBLEM_TRIES 8 /* of Lemke's method from other beginnings; more: fewer problems without a solution found, slower */
#define PM_PROBLEM_SWEEPS 4000 /* over contacts one by one, where all else fails; more: fewer problems without a solution found */
#define PM_PROBLEM_SWEEPS_LOOK 20 /* sweeps: so often the modes are tried as equations; more would only be later */
#define PM_PROBLEM_TRIED 7 /* contacts: up to here all modes are tried where Lemke's method fails; likewise */
#define PM_JOINTS_COUNTED 3 /* joints that rub by their load in a blow: up to here all modes are tried and motions counted; more: 3 to 5 times dearer each */
#define PM_JOINTS_MENDED 8 /* times the joints, where they are more: modes mended one by one; more: fewer blows undecided */
#define PM_JOINTS_TURNS 200 /* rounds to find the direction of a bearing's reaction; likewise */
#define PM_JOINTS_TURNED 1e-14 /* rad: it is found; larger: less exact */
#define PM_JOINTS_FREE 1e-12 /* of the response of a joint's slip, or of what moves its reaction: none; larger: frictions are left out */
#define PM_INSTANTS_AT_ONCE 1000 /* instants with no time between them; more: contacts that change in turn for ever end later */
#define PM_VAIN_INSTANTS 50 /* with no time between them: after so many a contact that closes and is left open may sink a little; more: later; fewer: what closes in the end sinks */
#define PM_VAIN_MOST 10 /* doublings of what counts as touching for it; more: contacts overlap; fewer: such runs end */
#define PM_LET_GO_AT_ONCE 20 /* likewise where the load of a rough contact vanishes; larger: it is told later, smaller: a load that is rounding once ends a run */
#define PM_AT_ONCE 1e-14 /* of the time: so much is none; larger: short phases are none */
#define PM_DRIVE_SAME 1e-11 /* of the scene's size: a prescribed place that changes by less at an instant does not jump; larger: small steps are passed over */
#define PM_FOOT_LOOK 1e-4 /* of the time size / speed: so far ahead a look tells into which piece of a curve a foot goes; larger: it may turn back */
#define PM_FOOT_ON_END 1e-7 /* of what it changes by in that look: at the end of a piece; larger: an end that is passed soon is reached */
#define PM_SWITCH_LOOK 1e-7 /* of the scene's size and speed: so far apart are states whose difference is a derivative of a switch's argument; larger: it is that of other places, smaller: rounding */
#define PM_SWITCH_BEND 1e-5 /* of the scene's size: likewise of a second derivative; likewise */
#define PM_SWITCH_LOOKS 3 /* differences, each PM_SWITCH_FARTHER times as far apart: one shows the derivative; more: one that is zero takes longer */
#define PM_SWITCH_FARTHER 1e4 /* times as far apart; larger: a derivative is that of other places, smaller: slow bodies beside fast ones have none */
#define PM_SWITCH_ROUNDINGS 16 /* of places and velocities, and what they make of a switch's argument: on zero; larger: thin regions of force are passed over, smaller: rounding leaves a switch on its old side */
#define PM_SWITCH_PATTERNS 2 /* signs with which places are shifted to see that; more: slower, fewer: shifts may cancel */
#define PM_PIECE_NOTHING 4e-12 /* of what a table is read at: a piece so short is passed; larger: what it does is left out, smaller: its end is not found */
#define PM_SWITCH_AGAIN 1e-7 /* of the time size / speed: a force that switches again within it does so at once; larger: fast vibrations through a switch end the run */
#define PM_SWITCHES_AT_ONCE 1000 /* so many running: the motion cannot leave the switch; more: that is told later */
#define PM_DISTURBED_BLOW 4e-16 /* of positions, while a blow is found: some roundings; more: errors estimated larger */
#define PM_BLOWS_AT_ONCE 10000 /* blows at one instant, each smaller than the one before; more: an endless series ends later */
#define PM_BLOW_ROUNDING 1e-10 /* of the energies that a blow moves: rounding; larger: a law that gains energy passes */
#define PM_BLOW_NOTHING 1e-14 /* of its impulses at the scene's speed: a blow that moves no more is rounding itself; likewise */
#define PM_COURSE_LOCKED 1e-13 /* of the normal response: what friction leaves of it where it holds the pair; larger: pairs that part are held */
#define PM_COURSE_IMMOBILE 1e-14 /* of the normal response: along the tangent nothing moves; larger: friction is left out */
#define PM_COURSE_ROUNDING 1e-12 /* of the greatest velocity of a blow: none; larger: approaches are passed over */
#define PM_COURSE_DOUBT 1e-14 /* of the greatest velocity of a blow: rounding of those that a stretch begins with; larger: next to places where contacts lock motions count as several, smaller: rounding chooses one of several */
#define PM_COURSE_SAME 1e-10 /* of a stretch: what ends so soon after it ends with it; larger: slips that end soon after count as none, smaller: rounding makes stretches */
#define PM_COURSE_ALMOST 1e-9 /* of the greatest velocity of a blow: a slip that is left, where no motion goes on with it and one may without; larger: slips that go on are stopped */
#define PM_COURSE_COUNTED 5 /* contacts of a blow that is followed: up to here the order in the file decides nothing; more: 4 times dearer each */
#define PM_COURSE_EVENTS 400 /* in a phase of a blow, for each contact: two slips that end in turn, each time by 0.98 or less of the time before, are at rest; more: one that does not end is found later */
#define PM_SPRINGS_COLUMNS 7 /* of the extrapolation in a blow with stiffnesses: order 14; more: longer steps, more rounding */
#define PM_SPRINGS_TOLERANCE 1e-14 /* of its velocities, in each step; PM_COARSER times as much in a coarse run; smaller: rounding makes steps short; larger: less exact blows */
#define PM_SPRINGS_FIRST 0.1 /* of the time in which the stiffest contact is compressed: first step; larger: tried again with a shorter one */
#define PM_SPRINGS_SAFE 0.95 /* of the step that the error allows; larger: more are tried again */
#define PM_SPRINGS_SHORTER 0.2 /* of the step before: no less; smaller: shorter ones after a sudden error */
#define PM_SPRINGS_LONGER 3.0 /* likewise: no more; larger: more are tried again */
#define PM_SPRINGS_EXACT 1e-12 /* of the error allowed: none at all; any small number does the same */
#define PM_SPRINGS_LOOKS 12 /* for a place in the step: each at a quarter, where a contact is inside its phase; or the nearest to its end; more: slower */
#define PM_SPRINGS_AHEAD 1e-9 /* of that time: loads so much later decide what slips; larger: those that change are not those of the place */
#define PM_SPRINGS_COMPLIANCE 1e-13 /* of held contacts beside the response: those that depend on each other share; larger: they creep */
#define PM_SPRINGS_LEAST 1e-3 /* of the greatest friction: what shares at least; larger: loads that begin share too much */
#define PM_SPRINGS_HOLDS 1e-13 /* of the load of the stiffest: friction is not exceeded by less; smaller: rounding makes it slip */
#define PM_SPRINGS_TURNS 64 /* contacts turned in one choice of what slips, for each; more: several coefficients go in circles longer */
#define PM_SPRINGS_SOFT 1e-6 /* of the response: compliance of what is wedged while its impulses are found; larger: what is wedged creeps */
#define PM_SPRINGS_REFINED 6 /* times, until it does not count; fewer: what is wedged creeps */
#define PM_SPRINGS_ROUGH 1e3 /* friction of a rough contact where several share it; larger: others have less of it */
#define PM_SPRINGS_KEPT 0.1 /* of each load: what is wedged is balanced by at least so much of it; larger: what is wedged swings on */
#define PM_SPRINGS_STILL 1e-9 /* of the velocities of the blow: what is wedged is at rest; larger: bodies are wedged that would come free */
#define PM_SPRINGS_BALANCED 1e-6 /* of the greatest load: none; loads of what is wedged are balanced; likewise */
#define PM_SPRINGS_CAUGHT 1e-3 /* of loads, and of what friction could still hold: may change until what is wedged rests; larger: likewise */
#define PM_SPRINGS_SWINGS 32 /* to and fro for each contact without another change: wedged; fewer: bodies that would still come free */
#define PM_SPRINGS_STEPS 400000 /* of a blow with stiffnesses; more: one that does not end is found later */
#define PM_JAMMED 1e-3 /* of the friction that draws a contact together: so near, a route that cannot go on stops for it; larger: other failures are taken for it */
#define PM_ORDER_SLOW 1e-9 /* of the greatest velocity of a blow: contacts struck one by one have done; larger: some that differ do not count */
#define PM_ORDER_SAME 1e-7 /* likewise: the same motion as of all at once; likewise */
#define PM_ORDER_STRIKES 64 /* for each contact, one by one; fewer: blows that go on for long count as other ones */
#define PM_ACTION_OPENING 1e-9 /* of the scene's size: a joint added that is open by more does not fit there; larger: it jumps */
#define PM_ACTION_FITTED 1e-13 /* of the work: the impulse that does it is found; larger: less exact */
#define PM_ACTION_FITS 32 /* tries to find it: the answer is linear but where contacts join or let go; more: slower */
#define PM_AT_REST 1e-11 /* of the scene's speed, and of that squared over its size: at rest; larger: what creeps rests */
#define PM_REVERSAL 1e-7 /* of the scene's speed: how fast it is looked at just before and after it reverses; larger: less exact */
#define PM_BEYOND 1e-9 /* of what a shift of the state changes a value by: it changes so little by the motion after an instant, it stays; larger: what goes beyond slowly fires as the next phase begins */

#endif

/* tolerances.h - every number of the kernel that decides something: what counts as zero, as equal, as lost, as too many.
 *
 * One line each: the value, its unit ("of x": relative to x), why it is that, and what a larger one would do.  Nothing with
 * a dimension is compared with a bare number: sizes come from the case (numbers.size in m, numbers.speed in m/s) or from the
 * terms that were summed.  Where a number was calibrated the table of that calibration is named.  Numbers that decide
 * nothing - coefficients of a formula, lengths of arrays - stand where they are used. */
#ifndef PM_TOLERANCES_H
#define PM_TOLERANCES_H

/* one line for each number */
/* clang-format off */

/* ---- all rooms ---- */

#define PM_EPSILON 2.3e-16 /* of a number: rounding of one operation; more would stop searches earlier */

/* ---- numerics ---- */

#define PM_BRACKET_VALUES 300    /* values: a triple root takes 140; more would only put off the message */
#define PM_BRACKET_WIDTH 1e-14   /* of the bracket: a root near x = 0 is that close; more would move events */
#define PM_BRACKET_NOTHING 1e-16 /* of the bracket: a shift of Newton that gains nothing; likewise */
#define PM_BRACKET_POLISHED 1e-15  /* of the step: a shift that gains nothing on exact states; likewise */
#define PM_BRACKET_SLOPE_STEP 1e-4 /* of the step: distance of differences; more: curvature spoils slopes */
#define PM_BRACKET_FAR 0.1       /* of the step: a longer shift is no polish, it may leave for another root */
#define PM_PIVOT_LOSS 1e-14 /* of its diagonal: a pivot that is lost; larger: more matrices count as singular */
#define PM_CHEBYSHEV_SMOOTH 1e-3 /* of the values: tail of what has no corners; more would miss some */

/* ---- state ---- */

#define PM_EVIDENCE_NOTHING 1e-14 /* of its natural size: zero in both passes, by the structure of the scene; larger: hides decisions */
#define PM_EVIDENCE_LOOSEST 1e-2 /* tolerance of a coarse run: beyond it steps are not resolved; larger: errors told too large */
#define PM_COARSER 30.0 /* times the tolerance of the run that a coarse one is compared with; larger: errors told too large */

/* ---- expression ---- */

/* ---- elements ---- */

#define PM_TOUCHING 1e-10 /* of the scene's size: gaps below it touch; larger: contacts close early, blows lose height */
#define PM_NO_SPEED 1e-11 /* of the scene's speed: speeds below it are none; larger: slow slip and rebounds are lost */
#define PM_CAPTURE_MEETS 1e-7 /* of the scene's size: points so near meet (places are known better); larger: near misses are caught */
#define PM_CAPTURE_ACROSS 1e-10 /* cosine of distance and velocity: below it the distance stays; larger: the nearest place is less exact */
#define PM_CENTRED 1e-15 /* of the scene's size: a mark so near is the mass centre; larger: what goes round is taken for steady */
#define PM_STEADY_ROUNDING 1e-13 /* of speeds and accelerations in the scene: less is none; larger: slow motions are taken for rest */
#define PM_EDGE_HANDING_OVER 4 /* touching lengths: so near to their corner two edges in one line are both touched; larger: sooner */
#define PM_FRICTION_SAME 4e-15 /* of itself: a friction that changes by less has been found; larger: it is less exact */
#define PM_SPIN_ACROSS 1e-12 /* of gravity: part across the axis that rounding makes of 90 degrees; larger: a lean axis passes */

/* ---- scene ---- */

#define PM_SYMMETRY_SAME 1e-9 /* of a turn, of a step of a row, of the way: the same; larger: segments that differ are repeated */

/* ---- equations ---- */
/* natural sizes */
#define PM_SHIFT 1e-6 /* of a state's own size: shows the size of what is read there; larger: not linear */
/* which constraints depend on each other */
#define PM_INDEPENDENT \
    1e-9 /* part of a row that others leave, of the row: it counts; larger: holds too little */
#define PM_CLEARLY_INDEPENDENT 1e-3 /* the same, above which nothing else is asked; larger: slower */
#define PM_NEIGHBOUR 1e-3 /* of the scene's size: how far a dead centre is left; larger: another place */
#define PM_DEPENDENT_NEARBY 1e-6 /* part left at the neighbour: redundant below; larger: drops what holds */
#define PM_TAKEN_OFF_ENOUGH \
    0.5 /* of the square of a row: if that stays, rounding has not grown; larger: slower */
#define PM_BLOCK_OF_ROWS \
    24 /* constraints solved as one block; fewer are as quick one by one, and told sharply */
#define PM_BLOCK_PASSES 2 /* with the factors of a block: the second takes off the rounding of the first */
/* what is met */
#define PM_MET 4e-15 /* of size, speed or terms: residual with nothing left to gain; larger: drift stays */
#define PM_PROJECTION_SWEEPS 8 /* Newton steps back onto constraints: four do, but for rounding far off */
#define PM_FRICTION_ROUNDS 400 /* of friction and reactions: more, and the joint jams */
#define PM_STAND_IN \
    1e-3 /* of the least mass, for what has none: each round gains as many digits; larger: fewer */
#define PM_STAND_IN_ROUNDS 60    /* three digits each, unless there is too little mass elsewhere */
#define PM_ORDERED_AS_WRITTEN 10 /* bodies: up to here another order of the joints gains nothing */
/* starts */
#define PM_ASSEMBLY_SWEEPS 60 /* Gauss-Newton steps; more would wander */
#define PM_ASSEMBLY_LONGEST \
    0.3 /* of the scene's size: longest step of the assembly; larger: jumps to other branches */
#define PM_ASSEMBLED 4e-16 /* of the scene's size: nothing is open; larger: starts less exact */
#define PM_MESHES 1e-3     /* of their distance: gears open by less mesh, drawn by rounded numbers */
#define PM_START_AGREES \
    1e-9 /* relative: start velocities that differ by less agree; larger: hides contradictions */
#define PM_START_OPEN_PART 1e-6 /* of a unit velocity: left open; larger: hides open motions */
/* sizes and bounds */
#define PM_MOST_MEMBERS 1e9 /* of a periodic row: int32 numbers them; more would not be told apart */
#define PM_FASTER 1.1       /* growth of the speed scale that is worth new weights; larger: coarser weights */
#define PM_OUT_OF_REACH \
    1e-6 /* of the scene's reach: gaps above stay open whatever the drift; larger: skips fewer */
/* energy and ledgers */
#define PM_LEVEL_SHARE \
    0.1 /* of the greatest kinetic energy: below it velocities say too little of the energy */
#define PM_LEVEL_MOST 0.01 /* of the kinetic energy: what misses more is no drift; larger: hides faults */
#define PM_LEVEL_ROUNDING 2e-15 /* of the terms of the energy: below it nothing is known to be wrong */
#define PM_LEDGER_PLACE 5e-16   /* of the distance from the origin: rounding of a position, at each event */
#define PM_LEDGER_SPIN \
    1e-14 /* of the energy of a spin, which may be far above that of the motion in its plane */
#define PM_LEDGER_SLOWEST \
    1e-3 /* of the scene's speed: slower motion is no scale of its own; larger: blind to it */
#define PM_LEDGER_ROUNDING \
    1e-7 /* relative residual: long runs gather rounding; larger: blind at tight accuracy */
#define PM_LEDGER_ERRORS \
    2e3 /* of the tolerance: a thousand blows leave 475 (studies, 1e-2 .. 1e-12); larger: blind */
#define PM_LEDGER_MOST \
    0.05 /* of all energy or momentum: no answer stands with more; larger: blind when loose */

/* ---- tree ---- */
#define PM_FACTORS_STAY \
    1e-8 /* of size or speed: a correction this small keeps the factors; larger: a sweep more */
#define PM_LOOP_SWEEPS 20 /* Newton steps of the dependent coordinates; more, and a shorter step is better */
#define PM_LOOP_FINEST 4e-16 /* of size and speed: near a singular position what is left is amplified */
#define PM_LOOP_STALLED \
    1e-12                 /* of the scene's size: met, as far as far-off coordinates allow; larger: drift */
#define PM_LOOP_RANK 1e-9 /* of the greatest pivot: below it loop constraints depend on each other */
#define PM_LOOPS_MANY 12  /* loop constraints: from here a partition is cheaper than the whole system */
#define PM_LOOP_FLAT 0.01 /* square of the independent part of a loop constraint: below, partition */
#define PM_LOOP_STEEP \
    5 /* rate of a dependent coordinate over an independent one: choose anew; larger: less exact */
#define PM_SERIES_REACH 0.5 /* rad: so far the series of cosine and sine have all figures */

/* ---- events ---- */
#define PM_SAME_PLACE 1e-11 /* of a step: events that are closer are one instant; larger: two blows become one */
#define PM_GAP_ROUNDING 4e-15 /* of how far bodies are from the origin: gaps are rounded by it; larger: a bounce that comes back at once is lost */
#define PM_FORCE_SLACK 1e-10 /* of the scene's weight-like force: forces that begin on zero are solved for so well; larger: contacts part late */
#define PM_ON_MULTIPLE 1e-9 /* of the multiples' distance: `every` begins on one of them; larger: one right after the begin is lost */
#define PM_ON_GRID 1e-9 /* of a grid value: it is met at the start or end of the run; larger: answered beside its place */
#define PM_GRID_ROUNDING 1e-12 /* of the greatest watched value: so much of a grid value, of 0 too, is rounding; larger: as above */
#define PM_ON_ZERO 1e-12 /* of a function's greatest size in the step: it is zero, has no sign; larger: a zero right after the begin is lost */
#define PM_DIP_NEAR 0.3 /* of a function's greatest size in the step: below it there may be a dip to zero; larger: more is looked at */
#define PM_DIP_FAR 0.5 /* likewise: above it no parabola of three nodes comes near to zero; larger: more is looked at */
#define PM_DIP_CLOSE 0.1 /* of the values beside it: a dip that is worth a closer look; larger: more are */
#define PM_DIP_STEP 1e-3 /* of the nodes' distance: differences at the bottom of a dip; larger: bend less exact, smaller: rounding */
#define PM_DIP_STEPS 3 /* of Newton's method to the bottom; more: slower */
#define PM_BOUNCE_HALVINGS 30 /* of a step, to find the top of a short bounce; more: shorter bounces are seen */
#define PM_LEAVING_HALVINGS 20 /* of a step: a trigger has left its zero where it is first seen off it; more: earlier zeros are seen */
#define PM_EVENT_RATE_STEP 1e-4 /* of the step: differences that make the rate at a zero; larger: less exact, smaller: rounding */
#define PM_PLACE_ROUNDING 1e-15 /* of the step: rounding of a place; larger: zeros are polished less */
#define PM_PLACE_RESOLVED 1e-14 /* of the step: a zero is known so well by the samples that no look tells more; larger: zeros less exact */
#define PM_OFF_ZERO 1e-9 /* of a function's values beside its zero: it is not on it; larger: corners are met less exactly */
#define PM_TAIL_WAVES 1e-4 /* tail of samples between which there may be waves: finer nodes are taken; larger: extremes are missed */
#define PM_TAIL_RESOLVED 1e-6 /* tail of samples that show a function between the nodes; larger: zeros less exact, or missed */
#define PM_TAIL_RESIDUAL 10.0 /* times the tail: how far a function may be from the polynomial through its samples; larger: more looks */
#define PM_POINTS_PASS 1e-5 /* of the scene's size: two points farther apart where they are nearest do not meet; larger: they meet in passing */
#define PM_EXTREMUM_ROUNDING 4e-16 /* of the value's size: what looks scatter by; larger: bounds of extremes wider */
#define PM_EXTREMUM_NOTHING 1e-15 /* of the value's size: so little more is rounding; larger: extremes less exact */
#define PM_EXTREMUM_LEVEL 1e-14 /* of the value's size: a value that changes less is level; larger: flat tops are left out */
#define PM_EXTREMUM_SLOPE_TAIL 2.0 /* times degree and highest coefficients: error of a polynomial's slope; larger: more looks */
#define PM_EXTREMUM_FLAT 0.1 /* of the spread in a step: a slope between nodes that may have either sign; larger: more is searched */
#define PM_EXTREMUM_SHARP 0.1 /* tail of samples whose slopes are known roughly, at the best; larger: corners are climbed in vain */
#define PM_EXTREMUM_END_TAIL 4.0 /* as PM_EXTREMUM_SLOPE_TAIL, at the ends of a step; larger: more looks */
#define PM_EXTREMUM_LIKELY 0.1 /* of the most that a slope may be off by: what it is; larger: errors told too large */
#define PM_EXTREMUM_WIDE 3.0 /* times the fall beside a node: so far may rise what the nodes do not show; larger: more is searched */
#define PM_EXTREMUM_NEAR 0.3 /* of a bend: so much it changes over this part of 1 / n^2 of the step; larger: extremes at nodes less exact */
#define PM_EXTREMUM_DIPS 1e-5 /* tail of a value whose corners can only be dips: looks show what they change; larger: extremes less exact */
#define PM_EXTREMUM_SHARE 1e-2 /* of the tolerance: so little more is not looked for, but counts as an error; larger: errors larger */
#define PM_JUMP_BESIDE 1e-13 /* of the nodes' distance: right before and right after a jump; larger: extremes at jumps less exact */
#define PM_SWITCHES_APART 1e-9 /* of the nodes' distance: switches that are closer change together; larger: branches between them are left out */
#define PM_HIDDEN_BEND 0.8 /* of the bend that a parabola would have: less is level; larger: more is searched by looks */
#define PM_HIDDEN_ALIKE 0.1 /* of what others near them differ by: nodes between which a top may hide; larger: more is searched */
#define PM_HIDDEN_PARTINGS 5 /* of an interval about a level place: a sixth is left each time; more: slower */
#define PM_RISE_SLOWLY 0.5 /* of the residual before: looks that leave more lead nowhere; larger: more looks */
#define PM_EXTREMUM_STEPS 6 /* of Newton's method to an extreme; more: slower */
#define PM_RISE_BESIDE 3e-6 /* of the step: two nodes nearer to each other show no slope; larger: extremes at nodes less exact */
#define PM_RISE_PART 0.3 /* of the residual of a slope before a look: it stays so after it, at the least; larger: more looks */
#define PM_EXTREMUM_RATE_STEP 2e-3 /* of the step: differences of five values that make a rate; larger: less exact, smaller: rounding */
#define PM_EXTREMUM_NEAR_STEP 1e-4 /* of the step: differences of two values, next to an extreme; likewise */
#define PM_EXTREMUM_SEARCHES 60 /* values that are compared where slopes are not known; more: slower */
#define PM_EXTREMUM_CLOSE 1e-8 /* of the step: so near to an extreme its value is that, by the square; larger: extremes less exact */
#define PM_CULLING_PART 0.5 /* of a gap: its marks may move so far unseen; larger: seen too late */
#define PM_CULLING_BETWEEN 3.0 /* times the movement at the nodes: between them it is less (Lebesgue constants); larger: more is looked at */
#define PM_CULLING_WITHIN 0.9 /* of a gap: so far two circles may come in a step without meeting; larger: one may pass the other */
#define PM_CULLING_EDGE 0.01 /* of an edge's length: what strikes near its end is behind it for that way; larger: longer steps miss it */
#define PM_CULLING_LIKE_BEFORE 2.0 /* times what bodies moved in the last step: what they will in the next; larger: more is looked at */
#define PM_LAST_BOUNCE 1e-7 /* of the scene's speed: the height of slower rebounds, v^2 / 2g, is lost in rounding; larger: rests too early */
#define PM_BOUNCE_SPENT 1e-6 /* of the scene's speed: a rebound that cannot be seen and is slower is over; likewise */
#define PM_BOUNCE_UNKNOWN 30.0 /* times PM_LAST_BOUNCE: heights are known to some percent; larger: fewer blows are decisions */
#define PM_BOUNCE_EARLIER 4.0 /* times PM_LAST_BOUNCE in a coarse run: shows what the cut loses; larger: errors told too large */

/* ---- impact ---- */
#define PM_PULLS 1e-11 /* of the forces, or of the impulses in a blow: a load this small does not pull or slip; larger: contacts part late */
#define PM_BLOWS_AT_ONCE 64 /* rounds of blows of all contacts at one instant; more: an endless series ends later */
#define PM_BLOWS_IN_ORDER 10000 /* blows one by one at one instant; likewise */
#define PM_BLOW_ROUNDING 1e-10 /* of the energies that a blow turns over: rounding; larger: a law that gains energy passes */
#define PM_BLOW_NOTHING 1e-14 /* of its impulses at the scene's speed: a blow that turns over no more is rounding itself; likewise */
#define PM_COURSE_LOCKED 1e-13 /* of the normal response: what friction leaves of it where it holds the pair; larger: pairs that part are held */
#define PM_COURSE_IMMOBILE 1e-14 /* of the normal response: along the tangent nothing moves; larger: friction is left out */
#define PM_ACTION_OPENING 1e-9 /* of the scene's size: a joint added that is open by more does not fit there; larger: it jumps */
#define PM_ACTION_FITTED 1e-13 /* of the work: the impulse that does it is found; larger: less exact */
#define PM_ACTION_FITS 32 /* tries to find it: the answer is linear but where contacts join or let go; more: slower */
#define PM_AT_REST 1e-11 /* of the scene's speed, and of that squared over its size: at rest; larger: what creeps rests */
#define PM_REVERSAL 1e-7 /* of the scene's speed: how fast it is looked at just before and after it turns back; larger: less exact */

/* ---- routes/path ---- */

#define PM_CLOCK_TAIL 1e-13      /* tail of dt/du at the least; more: less exact times */
#define PM_WORK_TAIL 1e-12       /* tail of the rates of work; more: less exact energies */
#define PM_PATH_STILL 1e-11      /* of the scene's speed: at rest; more: slow starts lose their speed */
#define PM_PATH_BALANCED 1e-12   /* of the forces: in equilibrium; more: weak forces move nothing */
#define PM_PATH_STEPS_PER_TURN 8 /* steps in a turn of a coordinate; more: slower, contacts are seen sooner */
#define PM_PATH_LENGTH \
    0.5 /* of the scene's size: longest step of a coordinate that is a length; more: contacts are missed */
#define PM_PATH_FARTHER \
    4.0 /* steps, where no loop is closed and no contact is near; more: nodes resolve them more seldom */
#define PM_PATH_FASTER 2.0 /* steps, of coordinates that are no driver; more: Newton may leave the branch */
#define PM_PATH_BEYOND \
    1.2 /* of the way to a contact that seems to come, so that the step sees it; more: coarser nodes */
#define PM_PATH_LAP 1e-14         /* of a turn: rounding of a sum of steps; more: laps end early */
#define PM_PATH_CHECK_ROUNDINGS 8 /* roundings in a difference of potentials; more: the audit sees less */
#define PM_PATH_SAME_STEP 1e-9 /* of a step's length: as long as the last one; more: places shift by that */
#define PM_PATH_SAME_DIRECTION \
    1e-9 /* of the rates at a unit rate of the driver: the same direction; more: likewise */
#define PM_PATH_KEEP \
    0.3 /* of the fastest coordinate: a driver this fast stays; more: more changes of driver */
#define PM_PATH_WEAK \
    3e-2 /* of the rows' natural size: weaker pivots leave slopes to rounding over its square; more: more bridges */
#define PM_PATH_LINKS 8 /* levers in the size of a scene that is no long chain; more: chains seem singular */
#define PM_BRIDGE_REACH \
    0.2 /* rad, or of the scene's size: from the centre to the places that bear a bridge; more: less exact */
#define PM_BRIDGE_SERVES 0.5 /* of the reach: places taken from the bridge; more: less exact at its ends */
#define PM_BRIDGE_STRIDE \
    0.25 /* of the reach: strides to the first place that bears; more: Newton may leave the branch */
#define PM_BRIDGE_MET \
    1e-11 /* of the scene's size: the loop rows on the bridge are met; more: drift at singular places */
#define PM_PATH_FORM_TAIL 1e-8 /* tail of T at nodes that resolve it; more: places of rest are missed */
#define PM_PATH_SPEED_TAIL \
    1e-6 /* tail of the speed where triggers watch it; more: dips over a barrier are missed */
#define PM_PATH_LENGTHEN 2.0 /* of a step that was resolved: the next one; more: more halvings */
#define PM_PATH_TIME_TAIL \
    30 /* of the tolerance: tail of dt/du, whose integral is 1000 times better; more: less exact times */
#define PM_PATH_PART \
    0.25 /* of a full step: a longer way to a place of rest takes a coarse run two steps; more: one */
#define PM_PATH_SHORTEST 1e-12 /* of a full step: shorter ones end the run; more: it ends earlier */
#define PM_CLOCK_NOISE \
    1e-6 /* a tail below it that no halving makes smaller is rounding; more: real tails pass */
#define PM_CLOCK_GAINS \
    0.5 /* of the tail over a longer step: what is no rounding falls below; more: rounding is halved */
#define PM_CLOCK_FEWER \
    4.0 /* weight of the tail at the nodes of a step, which are fewer; more: finer nodes are taken more often */
#define PM_CLOCK_OPEN \
    32.0 /* weight of that tail inside a step, by 1/2k and not 1/k^2; more: errors of time told larger */
#define PM_CLOCK_NOTHING \
    1e-17 /* of the greatest coefficient: smaller ones are dropped; more: less exact times */
#define PM_ENERGY_ROUNDINGS \
    1e-15 /* of the energies: roundings of a step, or of a blow and the segment after it; more: errors told larger */
#define PM_ERROR_FASTER 1e-6 /* of the speeds: step of a difference by T; more: curvature spoils it */
#define PM_ERROR_UNRESOLVED \
    2e-3 /* of the tail of dt/du: what its integral is off by; more: errors of time told larger */
#define PM_ERROR_EXACT \
    1e-12 /* tail of a function that its samples show to rounding; more: extremes seem exact */
#define PM_ERROR_RESIDUAL \
    10.0 /* of the tail: how far an extreme may be from that of the polynomial; more: smaller margins */
#define PM_ERROR_WIDE \
    3.0 /* of what a node is nearer to zero than its neighbours: so much nearer an extreme may be; more: slower */
#define PM_ERROR_RESTING \
    10.0 /* an error of T moves the place of rest, too; more: errors of time told larger */
#define PM_REPEAT_SAME_ENERGY 1e-13 /* of T: a lap without gain or loss; more: slow losses are left out */
#define PM_REPEAT_SAME_STEP \
    1e-16 /* of T: from one segment to the next it does not change in its last digit; more: series end early */
#define PM_REPEAT_BARRIER \
    1e-6 /* of the segment's energies: so near to the barrier it is computed; more: fewer are passed over */
#define PM_REPEAT_WHOLE 1e-9 /* of a multiple: a whole number of them; more: marks shift */
#define PM_REPEAT_SAME_PLACE \
    1e-11 /* of the scene's reach: the same configuration; more: places drift along a row */
#define PM_REPEAT_SAME_MOTION \
    1e-9 /* of the scene's speed: velocities in the same proportion; more: likewise speeds */
#define PM_REPEAT_SAME_END 1e-9 /* of T: the segment that is told ends as it should; more: wrong ends pass */

/* ---- routes/rk ---- */

#define PM_RK_MARGIN \
    0.1 /* of the accuracy asked: errors of steps add up, and grow with the motion; more: less accurate */
#define PM_RK_LEVEL_MARGIN \
    0.3 /* the same where energy holds a single freedom on its path: only delays add up */
#define PM_RK_TIGHTEST \
    5e-15 /* relative: below it the estimate of errors is rounding; more: less can be asked for */
#define PM_RK_SAFETY 0.7       /* of the step that the error allows; more: more steps are rejected */
#define PM_RK_SHRINK 0.2       /* of a step: the shortest next one; more: more rejections in a row */
#define PM_RK_GROW 4.0         /* of a step: the longest next one; more: more rejections */
#define PM_RK_LEAST_STEP 8e-16 /* of the time: a shorter step changes nothing; more: a run gives up earlier */
#define PM_RK_FIRST_RETRY 0.25 /* of a step in which there is no value: the next try; more: more tries */
#define PM_RK_SIDESTEP \
    1.2 /* of a step: a little longer or shorter, its stages are elsewhere; more: loses length */
#define PM_RK_SIDESTEPS 12 /* tries past a singular stage; more would only put off the shrinking */
#define PM_RK_NEAR_SINGULAR \
    0.2 /* of the step's most regular stage: rounding is amplified below; more: side steps in vain */
#define PM_RK_OVER \
    0.3 /* of the motion's own time: a first step that passes a singular position; more: less accurate */
#define PM_RK_LEDGER_STEPS \
    16 /* steps from one that integrates the ledger to the next; more: a thinner audit */

/* ---- routes/ida ---- */
#define PM_IDA_TO_MEETING 0.25 /* of the time to what is met: the limit holds a step late; more: steps over it */

#define PM_IDA_TIGHTER \
    1e-2 /* of the tolerance: IDA's errors are far above what it is asked for; more: less accurate */
#define PM_IDA_TIGHTEST 1e-12 /* relative: below it steps follow rounding; more: less can be asked for */
#define PM_IDA_NEWTON 0.1     /* of the error allowed: Newton's iteration may stop; more: its error shows */
#define PM_IDA_FIRST_STEP \
    0.3 /* of sqrt(tolerance) times the motion's own time: a step of order 1; more: rejected */
#define PM_IDA_RATE_TIME \
    1e-4 /* of the motion's own time: distance of differences at the begin; more: curvature spoils them */
#define PM_IDA_ON_ZERO \
    1e-12 /* of a trigger's natural size: zero at the begin; more: what begins close to zero is missed */
#define PM_IDA_FLIGHT 0.05 /* of the flight of a bounce: a first step; more: its shape, of order 1, is lost */
#define PM_IDA_SHORTEST \
    1e-4 /* of the first step else: no flight makes it shorter; more: the last bounces are lost */
#define PM_IDA_LONGEST_STEP \
    0.25 /* of the motion's own time, where something is watched; more: unseen between samples */
#define PM_IDA_LEAST_STEP \
    8e-16 /* of the time: a shorter step changes nothing; more: a run gives up earlier */
#define PM_IDA_NEAR_SINGULAR \
    0.1 /* independent part of a constraint: Newton may fail below; more: left to rk for longer */
#define PM_IDA_LOST \
    0.2 /* the same where a step of a long chain failed: up to where the plan comes back (PM_PLAN_PASSED) */
#define PM_IDA_LEAST_ROOM \
    4e-15 /* of the time: IDA finds begin and end too close below; more: stops farther off */
#define PM_IDA_SLIGHT \
    1e-6 /* of size and speed: the last matrix corrects this much; more: slower than a new projection */
#define PM_IDA_CORRECTED 4e-15 /* of size and speed: nothing is left to correct; more: constraints drift */
#define PM_IDA_MANY 40   /* unknowns (v, L): up to there inverses are faster than KLU; more: slower chains */
#define PM_IDA_PIVOT 0.1 /* of the greatest in its column: a pivot that keeps the order; more: more fill-in */
#define PM_IDA_LEDGER_WEIGHT \
    1e-2 /* of the weight of what is controlled: the ledger feeds nothing back; more: slower */
#define PM_IDA_ROUNDING \
    3.6e-15 /* of a value: angles and L grow, smaller errors are rounding; more: less accurate far away */

/* ---- routes/uniform ---- */

#define PM_UNIFORM_FIRST_STRIDE \
    4.0 /* of the motion's own time: first step where polynomials are watched; more: coarser samples */
#define PM_UNIFORM_LONGER 2.0 /* of a step: the next one; likewise */
#define PM_UNIFORM_TURNED \
    1e-9 /* of a step: a parabola that turns so near to its begin has turned; more: extremes are missed */
#define PM_UNIFORM_DEFINITE \
    100.0 /* roundings of accelerations: a definite one; more: more phases are left to rk */
#define PM_UNIFORM_SAME_TIME \
    1e-11 /* of a step: contacts that close so near to each other do so at once; more: series of blows merge */
#define PM_UNIFORM_SLOW_CHANGE \
    0.1 /* of the speed in the interval: below, Gauss is exact and the closed form cancels; more: less exact */
#define PM_UNIFORM_HALVINGS \
    200                   /* halvings: more than doubles have digits and exponents; more changes nothing */
#define PM_UNIFORM_NEAR 4 /* members of a row that are looked at one by one; more: slower */
#define PM_UNIFORM_ROUNDING \
    1e-15 /* of the places of marks: a gap below it is closed; more: contacts close early */
#define PM_UNIFORM_TIME_ROUNDING 4.5e-16 /* of a time: two roundings; more: roots less exact */
#define PM_UNIFORM_REFINEMENTS 8         /* shorter intervals tried for a bound; more: slower */
#define PM_UNIFORM_WIDER 4.0    /* of the step that was safe: the next interval; more: weaker bounds */
#define PM_UNIFORM_SHORTER 0.01 /* the same where nothing was safe; more: more tries */
#define PM_UNIFORM_ADVANCES \
    100000              /* safe steps in one step of the route; more: endless approaches last longer */
#define PM_ZENO_ALIKE 2 /* blows in a row that were e times the one before; more: the leap comes later */
#define PM_ZENO_GEOMETRIC \
    1e-8 /* of a blow: rounding of a slow one in a fast scene; more: series that are none are taken */
#define PM_ZENO_SLOW \
    1e-3 /* of the scene's speed: a rebound too low for a look of its own; more: leaps come earlier */
#define PM_ZENO_ENOUGH 500 /* blows alike, however fast; more: slower */
#define PM_ZENO_MARGIN 2.0 /* of what the flights to come may still change; more: fewer leaps */

/* ---- routes/start ---- */

#define PM_GROWTH_STEADY \
    1e-10 /* of the accelerations in the scene: none in the axes; more: unsteady motions pass */
#define PM_GROWTH_STEP 1e-3 /* of the scene's size: deviation for differences; more: curvature spoils them */
#define PM_GROWTH_SHORT \
    0.1 /* of the time of the fastest change: h of exp(L h); more: its polynomial is less exact */
#define PM_GROWTH_ALIKE \
    1e-8 /* of the changes at different times, by differences: the same; more: unsteady motions pass */
#define PM_GROWTH_SQUARINGS 60 /* squarings of exp(L h); more: slower where nothing grows alone */
#define PM_GROWTH_ALONE \
    1e-12 /* of the power: it changes no more, one rate is left; more: others are mixed in */
#define PM_GROWTH_GROWS \
    1e-4 /* of the fastest change: less is what differences make of no growth; more: slow growth is missed */
#define PM_GROWTH_FOLLOWS 1e-7 /* of the fastest change: L u = r u; more: what does not grow as one passes */
#define PM_GROWTH_EXCITED \
    1e-7 /* of what is left of any blow: this one excites growth; more: weak ones are refused */
#define PM_PERTURBATION_SIZE \
    0.1 /* of the root of the tolerance: what is neglected goes with its square; more: less exact */
#define PM_PERTURBATION_STILL 1e-11 /* of the scene's speed: at rest; more: slow motions count as rest */
#define PM_PERTURBATION_SHOWS \
    1e-6 /* of the deviation: what the program must make of it; more: weak programs are refused */
#define PM_PERTURBATION_ASIDE \
    1e-3 /* rad, or of the scene's size: where on a path the forces are looked at; more: another place */
#define PM_PERTURBATION_NOTHING \
    1e-12 /* of the forces before: no force there; more: weakly unstable rests seem stable */

/* ---- run ---- */

#define PM_DISTURBED_SPEED \
    3e-14 /* of velocities, in coarse runs: PM_COARSER times some roundings; more: larger errors told */
#define PM_DISTURBED_PLACE 2e-15 /* of positions; more: a contact that has just been left would overlap */
#define PM_PLAN_PASSED \
    0.2 /* independent part of each constraint: a singular position lies behind; more: later */

/* ---- study ---- */

#define PM_ACCURACY_CLAIMED \
    2e-14 /* of an answer: least error that is claimed; more: hides accuracy that is there */
#define PM_ACCURACY_COARSE \
    1.75 /* steps of a coarse run, of the motion's own time: in order 8 PM_COARSER and some more; calibrated */
#define PM_ACCURACY_REFINEMENTS \
    2 /* passes at tighter tolerances; more: longer runs that may not get better */
#define PM_ACCURACY_LEAST_FACTOR \
    1e-4 /* of the tolerance, from one pass to the next: least change; more: more passes */
#define PM_ACCURACY_MOST_FACTOR 0.1 /* the same: a smaller change is not worth a pass */
#define PM_ACCURACY_FINER \
    2 /* times a route's finest tolerance: nothing is gained below; more: gives up earlier */
#define PM_ACCURACY_AIM \
    0.2 /* of the accuracy asked, when the tolerance is tightened; more: may need another pass */
#define PM_ACCURACY_NEAR_ENOUGH \
    1e-3 /* of the tolerance: so far the last pass serves for a comparison; less: loose errors */
#define PM_ACCURACY_LEAST_SHARE \
    0.1 /* of a difference that is not disturbed: rounding does not go with the tolerance */
#define PM_MARGIN_LEAST \
    2.2e-16 /* of the natural size: least difference of two passes; more: smaller margins */
#define PM_FIND_PROBE \
    1e-3 /* of the distance of samples: shows whether the ask gets better off an end; more: beyond a peak */
#define PM_FIND_TIE 1e-9  /* of their size: extremes that differ by less are several; more: more remarks */
#define PM_FIND_SAME 1e-9 /* of the bounds' distance: places that are one; more: takes two for one */
#define PM_FIND_OUTCOME \
    5e-11 /* of a threshold: what the tolerances of decisions (1e-11) leave; more: larger errors told */
#define PM_FIND_TOUCH \
    4 /* times nearer to zero than its samples: a condition may reach it; more: fewer looks, misses */
#define PM_FIND_WIDEST 0.25 /* of the interval: first distance of differences; more: leaves the interval */
#define PM_FIND_HALVINGS 12 /* towards an end, for the other sign of the derivative; more: more runs */
#define PM_FIND_VALUES 100  /* values of the minimiser; more would only put off its end */
#define PM_FIND_CLOSE \
    1e-13 /* of the place: width at which the minimiser stops; more: less accurate corners */
#define PM_FIND_NOISE \
    1e-9 /* of a value: it may seem worse by this at the derivative's root; more: takes other roots */
#define PM_PAIR_STEPS 60    /* steps from one start; more would only put off its end */
#define PM_PAIR_STILL 1e-15 /* of the bounds' distance: a step that is no step; more: ends earlier */
#define PM_PAIR_MET \
    1e-8 /* of the greatest size on the grid: a condition is met; more: takes what only comes near */
#define PM_PAIR_SAME 1e-7 /* of the bounds' distance: roots that are one; more: takes two for one */
#define PM_ROOT_STEPS 200 /* runs to close a bracket; more would only put off its end */
#define PM_ROOT_FEW \
    1e-9 /* of the bracket: as far as a root's error goes; more: steps over other thresholds */
#define PM_ROOT_JUMP \
    1e-3 /* of the first step of the function: what a closed bracket cannot have left; more: jumps pass for roots */

#endif

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

#define PM_GAIN 0.5 /* of what was left before: a sweep that leaves more gains nothing, what is left is rounding; larger: more sweeps in vain */
#define PM_EPSILON 2.3e-16 /* of a number: rounding of one operation; more would stop searches earlier */

/* ---- numerics ---- */

#define PM_BRACKET_VALUES 300    /* values: a triple root takes 140; more would only put off the message */
#define PM_BRACKET_POLISH 6 /* exact values taken to polish a root that no bracket holds: the secant method needs three; more: slower */
#define PM_BRACKET_WIDTH 1e-14   /* of the bracket: a root near x = 0 is that close; more would move events */
#define PM_BRACKET_NOTHING 1e-16 /* of the bracket: a shift of Newton that gains nothing; likewise */
#define PM_BRACKET_POLISHED 1e-15  /* of the step: a shift that gains nothing on exact states; likewise */
#define PM_BRACKET_SLOPE_STEP 1e-4 /* of the step: distance of differences; more: curvature spoils slopes */
#define PM_BRACKET_LONGER 100 /* shifts before: a secant whose values differ by their rounding alone leads anywhere; larger: to another root */
#define PM_BRACKET_JUMPS 100 /* widths of the sides that have closed on a root: a better place farther off shows a jump; larger: jumps are met elsewhere */
#define PM_BRACKET_FAR 0.1       /* of the step: a longer shift is no polish, it may leave for another root */
#define PM_PIVOT_LOSS 1e-14 /* of its diagonal: a pivot that is lost; larger: more matrices count as singular */
#define PM_LEMKE_TIE 1e-8    /* of the scaled problem: ratios that are equal; taken as exact a third of all problems fails; larger: pivots that are no ties are taken for some */
#define PM_LEMKE_PIVOT 1e-11 /* of the column's largest entry, at least 1: no pivot; larger: bases are passed over */
#define PM_LEMKE_PIVOTS 20   /* for each unknown; more would only put off the failure */
#define PM_PIECES_BOUNDED 16 /* of a piecewise polynomial: over more of them it has no bounds; more: costs time, and they are halved anyway */
#define PM_INTERVAL_ROUNDING 1e-15 /* of a bound: widens it by some roundings; more: needless cuts, less: not rigorous */
#define PM_CHEBYSHEV_SMOOTH 1e-3 /* of the values: tail of what has no corners; more would miss some */

/* ---- state ---- */

#define PM_EVIDENCE_NOTHING 1e-14 /* of its natural size: zero in both passes, by the structure of the scene; larger: hides decisions */
#define PM_EVIDENCE_LOOSEST 1e-2 /* tolerance of a coarse run: beyond it steps are not resolved; larger: errors are estimated too large */
#define PM_EVIDENCE_DRIFT 0.3 /* of the disturbance of a step: so much of it goes to one side; larger: errors of long runs are estimated larger */
#define PM_EVIDENCE_MOVES 1e-10 /* of a coordinate, in a step: what changes less rests; larger: rounding of slow motion is not seen */
#define PM_EVIDENCE_STEP 1e-15 /* of positions and velocities, at each step of a coarse run: of PM_COARSER roundings most cancel in the weights of a step; larger: errors of unstable motion are estimated larger */
#define PM_COARSER 30.0 /* times the tolerance of the run that a coarse one is compared with; larger: errors are estimated too large */

/* ---- expression ---- */

#define PM_EXPONENT_MOST 150.0 /* beyond it e^x counts as constant, so that what it divides keeps bounds: 1 / (e^x + e^-x) is nothing there; larger: bounds overflow */

#define PM_PROGRAM_AHEAD 1e-8 /* of a measure, and of 1: a difference where a program has no derivative; larger: it is that of another place */

/* ---- elements ---- */

#define PM_SLOPE_STEP 1e-6 /* of the scene's size or speed: differences of a measure that has no derivative; larger: curvature, smaller: rounding */
#define PM_SLOPE_SAME 1e-9 /* of the scene's size: a gap that is the residual of its constraint; larger: that of something else may pass */
#define PM_TOUCHING 1e-10 /* of the scene's size: gaps below it touch; larger: contacts close early, blows lose height */
#define PM_NO_SPEED 1e-11 /* of the scene's speed: speeds below it are none; larger: slow slip and rebounds are lost */
#define PM_CAPTURE_MEETS 1e-7 /* of the scene's size: points so near meet (places are known better); larger: near misses are caught */
#define PM_CAPTURE_ACROSS 1e-10 /* cosine of distance and velocity: below it the distance stays; larger: the nearest place is less exact */
#define PM_CENTRED 1e-15 /* of the scene's size: a mark so near is the mass centre; larger: what goes round is taken for steady */
#define PM_STEADY_ROUNDING 1e-13 /* of speeds and accelerations in the scene: less is none; larger: slow motions are taken for rest */
#define PM_BESIDE_TOUCHING 8 /* touching lengths: nearer gaps go with what counts as touching, and two passes are compared by that; larger: errors of gaps may go unseen */
#define PM_EDGE_END 2e-15 /* of the scene's size, and of the distance from the origin: so far beyond an end a mark is at it; larger: it leaves late, smaller: rounding opens a way between edges that meet */
#define PM_EDGE_BEHIND 1e-6 /* rad: an edge that leans by more lies behind a face; larger: corners of boxes that slide on each other catch */
#define PM_EDGE_SUNK 8 /* touching lengths: so deep a mark may be sunk where others have come to rest, smaller: it falls through; larger: what comes up from behind touches early */
#define PM_EDGE_HANDING_OVER 4 /* touching lengths: so near to their corner two edges in one line are both touched; larger: sooner */
#define PM_FRICTION_SAME 4e-15 /* of the greatest reaction: a load that changes by less has been found; larger: it is less exact */
#define PM_FRICTION_ROUNDING 1e-11 /* likewise: a change this small that shrinks no more is rounding; larger: slow convergence ends early */
#define PM_SPIN_ACROSS 1e-12 /* of gravity: part across the axis that rounding makes of 90 degrees; larger: a lean axis passes */

#define PM_CURVE_STEP 0.5 /* rad: turn of the tangent in one step of the search for a foot; larger: it may leave for another foot */
#define PM_CURVE_WINDOW 1.5 /* rad: turn of the tangent to a foot from the one before, less than a loop has; larger: crossings are mistaken */
#define PM_CURVE_STEPS 40 /* of such a search; more would only put off that it is given up */
#define PM_CURVE_PART 0.1 /* of the parameter's range in one step, where the tangent tells nothing; larger: a foot may be passed */
#define PM_CURVE_CENTRE 0.05 /* of the radius of curvature: so near its centre a foot is no longer well determined; larger: more steps */
#define PM_CURVE_BASIN 0.5 /* of the way to where a foot ends: a step of the search for it; larger: in hollows it may leave for another foot */
#define PM_CURVE_LAST 1e-8 /* rad: a step after which the foot is exact, since errors square; larger: what rolls or sticks is told to jump, and ida creeps */
#define PM_CURVE_FOUND 8 /* roundings of a place: a step that gains nothing; larger: feet less exact */
#define PM_CURVE_FARTHEST 1e30 /* m: distance of a place from the point of its curve; larger: products of four lengths are no numbers */
#define PM_CURVE_SAMPLES 256 /* places at which a whole curve is looked at; fewer: feet on wavy curves are missed, cusps too */
#define PM_CURVE_NODES 1024 /* parts of a curve that contacts touch; fewer: curves with many waves are refused */
#define PM_CURVE_TURN 0.5 /* rad: turn of the tangent in such a part, so that one foot is in it at most; larger: feet are missed */
#define PM_CURVE_SAME 1e-5 /* of the parameter's range: feet so near are one; larger: a second one is seen later */
#define PM_CURVE_STRIDE 16 /* nodes from look to look for a first bound of a distance; more or fewer: slower */
#define PM_CURVE_BISECTIONS 60 /* of a part in which Newton's method leaves the foot; fewer: less exact */
#define PM_PAIR_BEHIND 1e-6 /* of a depth: a place of another curve that is as near, and no nearer; larger: what is on the far side of a thin body touches */
#define PM_PAIR_FARTHER 1.5 /* of the way from an end behind another curve: the next place that is looked at; larger: the front may be stepped over */
#define PM_CURVE_CUSP 1e-6 /* of the mean rate of a curve: a place at which it stops; larger: steep parameters are refused */
#define PM_CURVE_LENGTH 1e-13 /* of a length along a curve; larger: rolling and sticking drift */
#define PM_CURVE_HALVINGS 6 /* of a part of a curve whose length is not found at once; fewer: less exact where it is steep */
#define PM_CURVE_BESIDE 1e-9 /* of the parameter's range: so far beside a knot a place is surely in its piece; larger: short pieces are passed */
#define PM_CURVE_CLOSES 1e-9 /* of its extent: a gap that rounding makes of none; larger: open curves pass as closed */

/* ---- scene ---- */

#define PM_SYMMETRY_SAME 1e-9 /* of a revolution, of a step of a pattern, of the way: the same; larger: segments that differ are repeated */

/* ---- equations ---- */
/* natural sizes */
#define PM_STRETCH_ROUNDING 3e-15 /* of the places that a spring joins and its free length: so little stretch is none, nor what coarse runs add (PM_DISTURBED_PLACE); larger: a spring next to its free position does not pull, smaller: rounding moves what rests there */
#define PM_SPEED_ROUNDING 1e-4 /* of the speed by the forces that such a shift makes: that of forces which are rounding; larger: weak forces at a start count as none */
#define PM_SPEED_ARM 1e3 /* times its moment of inertia is that of a body as a point at its joint: it goes round that; less: other scales of speed, larger: speeds of small bodies on long arms are measured by far too great ones */
#define PM_SHIFT 1e-6 /* of a state's own size: shows the size of what is read there; larger: not linear */
/* loads */
#define PM_PRESSURE_MOST 1.0471975511965976 /* rad, 60 degrees: teeth have no greater pressure angle; larger: they would hardly turn each other */
#define PM_PULLS 1e-11 /* of the forces, or of the impulses in a blow: a load this small does not pull or slip; larger: contacts part late */
/* which constraints depend on each other */
#define PM_INDEPENDENT 1e-9 /* part of a constraint that others leave, of it: it counts; larger: holds too little */
#define PM_LOOSE 1e-7 /* the same of contacts in a blow, at whose place it adds nothing; larger: bodies are held less, smaller: blows are singular */
#define PM_CLEARLY_INDEPENDENT 1e-3 /* the same, above which nothing else is asked; larger: slower */
#define PM_MOSTLY_INDEPENDENT 0.7 /* the same: of two constraints, either of which may be left out, one leaves as much; larger: none is taken at once */
#define PM_WORN 0.5 /* of the most independence that the kept constraints have had: others are looked for; larger: more often, smaller: rounding grows */
#define PM_NEIGHBOUR 1e-3 /* of the scene's size: how far a dead centre is left; larger: another place */
#define PM_DEPENDENT_NEARBY 1e-6 /* part left at the neighbour: redundant below; larger: drops what holds */
#define PM_TAKEN_OFF_ENOUGH 0.5 /* of the square of a row of G: if that stays, rounding has not grown; larger: slower */
#define PM_BLOCK_OF_ROWS 24 /* constraints solved as one block; fewer are as quick one by one, and told sharply */
#define PM_BLOCK_PASSES 2 /* with the factors of a block: the second takes off the rounding of the first; more gain nothing */
#define PM_SHARED_MOST 24 /* redundant constraints of one group that are treated; more: slower, and larger scratch */
#define PM_SHARED_NOTHING 1e-9 /* of the largest load of a balance: none; larger: constraints are left out of their group */
#define PM_SHARED_BOUNDS 1e-6 /* multiplier of a condition that bounds a group (they add to 1); larger: fewer give way */
#define PM_SHARED_TINY 1e-300 /* N s: a blow without impulses has a size; larger: very small ones are not shared */
#define PM_SHARED_READ 1e-7 /* of what its parts do: what a balance does not change; larger: shared reactions pass */
/* what is met */
#define PM_MET 4e-15 /* of size, speed or terms: residual with nothing left to gain; larger: drift stays */
#define PM_MET_AT_ONCE 2e-16 /* the same, before anything is taken off; larger: both runs that are compared keep it, and unstable motion makes much of it */
#define PM_PROJECTION_SWEEPS 8 /* Newton steps back onto constraints: four do, but for rounding far off; more would only put off the end */
#define PM_PROJECTION_NEAR 1e-6 /* of the size: what polynomials of the time miss constraints by is drift; larger: bodies are put elsewhere */
#define PM_FRICTION_ROUNDS 400 /* of friction and reactions: more, and the joint jams */
#define PM_STAND_IN 1e-3 /* of the least mass, for what has none: each round gains as many digits; larger: fewer */
#define PM_STAND_IN_ROUNDS 60    /* three digits each, unless there is too little mass elsewhere; more would only put off the failure */
#define PM_LIGHT 1e-4 /* of the greatest mass, or that times the scene's size squared: less is next to no inertia; larger: slower */
#define PM_LIGHT_METRIC 1e-8 /* likewise: no less where rows are compared; larger: starts move light bodies less */
#define PM_LIGHT_LEAST_PIVOT 1e-4 /* of the diagonal of S: so many figures may be lost; larger: slower */
#define PM_LIGHT_SCALINGS 4 /* each brings the greatest entry of a row to the root of what it is off; more: slower */
#define PM_ORDERED_AS_WRITTEN 10 /* bodies: up to here another order of the joints gains nothing; more: long chains fill in */
/* starts */
#define PM_ASSEMBLY_SWEEPS 60 /* Gauss-Newton steps; more would wander */
#define PM_ASSEMBLY_LONGEST 0.3 /* of the scene's size: longest step of the assembly; larger: jumps to other branches */
#define PM_ASSEMBLED 4e-16 /* of the scene's size: nothing is open; larger: starts less exact */
#define PM_MESHES 1e-3     /* of their distance: gears open by less mesh, drawn by rounded numbers */
#define PM_START_AGREES 1e-9 /* relative: start velocities that differ by less agree; larger: hides contradictions */
#define PM_START_OPEN_PART 1e-6 /* of a unit velocity: left open; larger: hides open motions */
/* sizes and bounds */
#define PM_ACCURACY_LEAST 1e-14 /* relative, of solve.accuracy: rounding leaves no better; less: runs in vain */
#define PM_ACCURACY_MOST 1e-2 /* likewise: beyond it steps are not resolved; larger: errors are estimated too large */
#define PM_MOST_MEMBERS 1e9 /* of a pattern: int32 numbers them; more would not be distinguished */
#define PM_FASTER 1.1       /* growth of the speed scale that is worth new weights; larger: coarser weights */
#define PM_FIXED_SET 6 /* bodies that are tried together, whether joints fix them; more: slower, and larger scratch */
#define PM_OUT_OF_REACH 1e-6 /* of the scene's reach: gaps above stay open whatever the drift; larger: skips fewer */
/* energy and ledgers */
#define PM_LEVEL_SHARE 0.1 /* of the greatest kinetic energy: below it velocities say too little of the energy; larger: the energy is kept less often */
#define PM_LEVEL_MOST 0.01 /* of the kinetic energy: what misses more is no drift; larger: hides faults */
#define PM_LEVEL_ROUNDING 2e-15 /* of the terms of the energy: below it nothing is known to be wrong; larger: drift stays */
#define PM_LEDGER_PLACE 5e-16   /* of the distance from the origin: rounding of a position, at each event; larger: blind far from the origin */
#define PM_LEDGER_SPIN 1e-14 /* of the energy of a spin, which may be far above that of the motion in its plane; larger: blind to the motion in the plane */
#define PM_LEDGER_SLOWEST 1e-3 /* of the scene's speed: slower motion is no scale of its own; larger: blind to it */
#define PM_LEDGER_ROUNDING 1e-7 /* relative residual: long runs gather rounding; larger: blind at tight accuracy */
#define PM_LEDGER_ERRORS 2e3 /* of the tolerance: a thousand blows leave 475 (studies, 1e-2 .. 1e-12); larger: blind */
#define PM_LEDGER_BLIND 1e-3 /* relative: what rounding alone may leave of a ledger; larger: an audit that sees nothing passes */
#define PM_LEDGER_MOST 0.05 /* of all energy or momentum: no answer stands with more; larger: blind when loose */

/* ---- tree ---- */
#define PM_FACTORS_STAY 1e-8 /* of size or speed: a correction this small keeps the factors; larger: a sweep more */
#define PM_MODE_NOTHING 1e-11 /* of the fastest mode, squared frequencies and rates of growth: what differences cannot tell from zero; larger: soft modes are lost */
#define PM_MODE_SAME 1e-8 /* of a frequency: two that are the same; larger: the order of modes is that of their damping */
#define PM_MODE_CONFIRMED 1e-6 /* of the fastest mode: two lengths of differences agree; larger: modes where the scene is not smooth */
#define PM_TREE_SUMMED 64 /* coordinates up to which the sums of tree_augmented.c are kept: their square in memory; more: more memory */
#define PM_TREE_WHOLE_EACH 200.0 /* multiplications that a constraint costs in the whole system, beside its factors; more: larger trees in their own coordinates */
#define PM_TREE_LINKED 8 /* coordinates that move one body, links among them, up to which links are placed; more: long chains on links are slower */
#define PM_TREE_FEW 3 /* freedoms up to which coordinates are partitioned: work grows with their square; more: slower */
#define PM_LOOP_SWEEPS 20 /* Newton steps of the dependent coordinates; more, and a shorter step is better */
#define PM_LOOP_FINEST 4e-16 /* of size and speed: near a singular position what is left is amplified; larger: less exact there */
#define PM_LOOP_STALLED 1e-12                 /* of the scene's size: met, as far as far-off coordinates allow; larger: drift */
#define PM_LOOP_GAIN 0.25 /* of what was left before: a sweep that leaves more gains nothing; larger: more sweeps in vain */
#define PM_LOOP_RANK 1e-9 /* of the greatest pivot: below it loop constraints depend on each other; larger: constraints that hold are dropped */
#define PM_LOOPS_MANY 12  /* loop constraints: from here a partition is cheaper than the whole system; more: slower */
#define PM_LOOP_FLAT 0.01 /* square of the independent part of a loop constraint: below, partition; larger: slower */
#define PM_LOOP_STEEP 5 /* rate of a dependent coordinate over an independent one: choose anew; larger: less exact */
#define PM_SERIES_REACH 0.5 /* rad: so far the series of cosine and sine have all figures; larger: figures are lost */

/* ---- events ---- */
#define PM_TIME_HALVINGS 64 /* of a stretch of time, to neighbouring numbers; fewer: switches less exact */
#define PM_TIME_BUDGET 4096 /* stretches that are looked at for a switch; more would only put off a phase end */
#define PM_TIME_SAME 2.3e-16 /* of the time: neighbouring numbers; larger: switches less exact */
#define PM_TIME_ROUNDING 2e-15 /* of the time: a jump so shortly before a time of the scene may come after it; larger: right answers are called undecided */
#define PM_TIME_ROUNDED 3e-16 /* of the time of a switch or of a force, in coarse runs: its own rounding and that of the program; more: errors of short pulses estimated larger */
#define PM_TIME_TOGETHER 1e-14 /* of the time: a switch that is so near belongs to an instant; larger: switches less exact, less: no step fits between */
#define PM_HISTORY_PARTING 0.4 /* of a stretch between two rows of a history: off the middle, where a chord may cross; less: a worse look */
#define PM_HISTORY_SAFETY 2.0 /* times what a chord misses there: it misses more elsewhere; larger: more rows, less: bends are passed */
#define PM_HISTORY_PARTINGS 10 /* of a stretch between two nodes, at a corner or a jump; more: rows nearer to it */
#define PM_MOTION_LEAST 1e-9 /* of the time size / speed: what is not shown over less is left to the error of the step; larger: narrow peaks in space are passed over, smaller: steps become none where a root begins */
#define PM_MOTION_HALVINGS 30 /* of a step, until its samples tell forces that read the motion; fewer: narrow peaks are met unprepared */
#define PM_MOTION_GROW 4.0 /* times a step whose samples show them: the longest next one; larger: cut more often */
#define PM_MOTION_CUT 1e-9 /* of a measure's change in a step: waves so small are rounding; larger: narrow peaks are missed, less: rounding makes steps short */
#define PM_SHOWN_SIZE 4.0 /* times a value: as near as the bound of the greatest one is brought; larger: what is nothing is larger */
#define PM_TIME_WIDER 0.5 /* of the range of the bends at samples: beyond it they do not tell the stretch; larger: pulses are missed */
#define PM_TIME_DENSE 4.0 /* times the second differences of samples: what their bends may be; larger: pulses into which a sample falls are missed */
#define PM_TIME_LEVEL 1e-3 /* of their size, likewise */
#define PM_TIME_PARTS 64 /* of a stretch, halved until samples show it; more: fewer needless cuts, each dearer */
#define PM_TIME_AHEAD 4.0 /* times the last step: so far ahead programs are sampled at once; larger: samples lie less dense */
#define PM_TIME_ENOUGH 1.5 /* times the last step: so much that is shown is enough for the next; larger: sampled more often */
#define PM_SAME_PLACE 1e-11 /* of a step: events that are closer are one instant; larger: two blows become one */
#define PM_GAP_ROUNDING 4e-15 /* of how far bodies are from the origin: gaps are rounded by it; larger: a bounce that comes back at once is lost */
#define PM_FORCE_SLACK 1e-10 /* of the scene's weight-like force: forces that begin on zero are solved for so well; larger: contacts part late */
#define PM_ON_MULTIPLE 1e-9 /* of a multiple's number, 1 at the least: it is on it as a run begins, and parts from it; larger: one right after the begin is lost, smaller: one that has just fired is met twice */
#define PM_MULTIPLE_CLOSE 1e-3 /* of the multiples' distance: what turns back so close to one is looked at; larger: more is */
#define PM_TURN_SLOPE 0.25 /* of the way to the next node: by such a slope at an end of a step nothing turns back beside it; larger: more looks, smaller: turns are missed */
#define PM_TURN_PLACE 1e-6 /* of the nodes' distance: a place where something turns back is known so well, its value by the square; larger: less exact, smaller: rounding */
#define PM_TURN_LOOKS 40 /* for such a place; fewer: corners are met less exactly */
#define PM_ON_GRID 1e-9 /* of a grid value: it is met at the start or end of the run; larger: answered beside its place */
#define PM_GRID_ROUNDING 1e-12 /* of the greatest watched value: so much of a grid value, of 0 too, is rounding; larger: as above */
#define PM_INTEGRAL_ERROR 0.1 /* of the run's tolerance: what quadrature may add to an integral over the time; larger: less exact */
#define PM_INTEGRAL_ROUNDING 1e-13 /* of an integral: less is rounding; larger: less exact, less: looks in vain */
#define PM_PERCENTILE_INSIDE 1e-12 /* of a piece: so far from its ends values are read, on its own side of a switch; more: less exact */
#define PM_PERCENTILE_PARTS 8 /* halvings of a step until a polynomial tells its values; more: more memory where they are not smooth */
#define PM_PERCENTILE_HALVINGS 1100 /* halvings of a range: more than doubles have digits and exponents; more changes nothing */
#define PM_INTEGRAL_SHORT 1e-4 /* of a piece: in what is so short all but noise is straight; longer: waves are taken for noise, shorter: time is rounded */
#define PM_INTEGRAL_NOISE 8 /* times the noise that is seen in three places: looks end there; more: less exact, less: looks in vain */
#define PM_INTEGRAL_ALL 1e-9 /* of the time of the run: so much of it an integral must cover; larger: parts may be missing */
#define PM_STRAND_ACROSS 1e-12 /* of distance and speed of what a cord pulls: it goes across; larger: a strand is shortest earlier */
#define PM_STRAND_NEAR 1000 /* times as short: a failure so close to a strand's end comes of it; larger: others are told as that */
#define PM_STRAND_SOON 4.0 /* steps like the last: a failure so long before a strand ends comes of it; larger: others are told as that */
#define PM_WRAP_NOTHING 1e-9 /* rad: of so small a wrap a cord has left its rim, or lies on it as drawn; larger: it leaves early */
#define PM_STRAND_LEAST 1e-5 /* of the radii of its circles: so short, a strand has come to its end; larger: one that only comes close ends */
#define PM_ON_ZERO 1e-12 /* of a function's greatest size in the step: it is zero, has no sign; larger: a zero right after the begin is lost */
#define PM_DIP_NEAR 0.3 /* of a function's greatest size in the step: below it there may be a dip to zero; larger: more is looked at */
#define PM_DIP_FAR 0.5 /* likewise: above it no parabola of three nodes comes near to zero; larger: more is looked at */
#define PM_DIP_CLOSE 0.1 /* of the values beside it: a dip that is worth a closer look; larger: more are */
#define PM_DIP_HIDDEN 0.5 /* likewise where samples are as far apart as the dip is wide: its bottom is known to some tenths; larger: more are */
#define PM_DIP_STEP 1e-3 /* of the nodes' distance: differences at the bottom of a dip; larger: bend less exact, smaller: rounding */
#define PM_DIP_STEPS 3 /* of Newton's method to the bottom; more: slower */
#define PM_BOUNCE_HALVINGS 30 /* of a step, to find the top of a short bounce; more: shorter bounces are seen */
#define PM_LEAVING_HALVINGS 20 /* of a step: a trigger has left its zero where it is first seen off it; more: earlier zeros are seen */
#define PM_LEAVING_LEAST 1e-14 /* of the place: so close to a zero that was located nothing has left it; larger: what comes back at once is missed */
#define PM_LEAVING_JUMP 1e-2 /* of half the window about a switch: so close to a jump nothing has left it; larger: what comes back at once is missed, smaller: its scatter counts as more jumps */
#define PM_EVENT_ON_ZERO 1e-12 /* of a trigger's natural size: zero as a phase in time begins; larger: what begins close to zero is missed */
#define PM_EVENT_RESTED 1e-2 /* of that: what has rested on its zero has not left it, by rounding; larger: what leaves slowly fires later, smaller: rounding fires */
#define PM_EVENT_RATE_STEP 1e-4 /* of the step: differences that make the rate at a zero; larger: less exact, smaller: rounding */
#define PM_EVENT_RATE_CLOSER 8.0 /* times so short a difference tells a jump, which has no rate; larger: roundings look like jumps, smaller: steep zeros do */
#define PM_EVENT_RATE_JUMPS 0.7 /* of these times its rate grows by there: at a jump by all of them, at a zero by none, at a root by their root; larger: jumps near others are taken for rates */
#define PM_PLACE_ROUNDING 1e-15 /* of the step: rounding of a place; larger: zeros are polished less */
#define PM_PLACE_RESOLVED 1e-14 /* of the step: a zero is known so well by the samples that no look shows more; larger: zeros less exact */
#define PM_PLACE_SHARP 1e-9 /* of the step: a zero is known so well in spite of the rounding of samples, else it is looked for; larger: zeros beside others are met twice, less: more looks */
#define PM_OFF_ZERO 1e-9 /* of a function's values beside its zero: it is not on it; larger: corners are met less exactly */
#define PM_TAIL_WAVES 1e-4 /* tail of samples between which there may be waves: finer nodes are taken; larger: extremes are missed */
#define PM_SERIES_ROUNDING 1e-14 /* of the coefficients: what rounding leaves of the highest, and values scatter by; larger: less is resolved */
#define PM_SERIES_SCATTERS 0.5 /* of the lower coefficients, sums of both: the upper ones do not fall off; larger: noise is halved to the end */
#define PM_TAIL_FEW 1e-2 /* likewise of up to five, which only tell whether more are needed; larger: waves are missed */
#define PM_TAIL_DISTANCE 1e-8 /* likewise of a distance, which may be small for a moment right before a node; larger: that is missed, less: more windows */
#define PM_WAVES_CALM 10.0 /* times the range of the samples: a bend over a step that hides nothing between nodes; larger: low peaks are missed, less: more bounds */
#define PM_WAVES_DEGREE 3 /* of a product of measures: so high, it may have waves along a step; larger: extremes are missed, less: more bounds */
#define PM_WAVES_FEW 0.01 /* of the range of the samples: what the polynomial through few nodes may leave out; larger: waves are missed */
#define PM_WAVES_RATES 0.05 /* of the greatest rate: the polynomial through samples has another one at a node: waves; larger: they are missed */
#define PM_SWITCH_HALVINGS 42 /* of a step: a switch is so nearly known in it; less: jumps are seen less exactly */
#define PM_SWITCH_PARTS 400   /* of a step: enclosed to find its first switch; less: windows are halved instead, each dearer */
#define PM_WINDOW_SWITCH 1e-11 /* of a step: a window about a switch that has been found; larger: jumps less exact, less: rounding parts it */
#define PM_WINDOW_LEAST 1e-9 /* of a step: what is not shown in a window so short is a corner; larger: waves are missed, less: corners cost more */
#define PM_TAIL_RESOLVED 1e-6 /* tail of samples that show a function between the nodes; larger: zeros less exact, or missed */
#define PM_TAIL_RESIDUAL 10.0 /* times the tail: how far a function may be from the polynomial through its samples; larger: more looks */
#define PM_MEETING_SOON 2.0 /* of the time between two nodes: points that need no longer to come together may do so there; less: they are missed, larger: more nodes */
#define PM_POINTS_PASS 1e-5 /* of the scene's size: two points farther apart where they are nearest do not meet; larger: they meet in passing */
#define PM_EXTREMUM_ROUNDING 4e-16 /* of the value's size: what looks scatter by; larger: bounds of extremes wider */
#define PM_EXTREMUM_NOTHING 1e-15 /* of the value's size: so little more is rounding; larger: extremes less exact */
#define PM_EXTREMUM_LEVEL 1e-14 /* of the value's size: a value that changes less is level; larger: flat tops are left out */
#define PM_EXTREMUM_SLOPE_TAIL 2.0 /* times degree and highest coefficients: error of a polynomial's slope; larger: more looks */
#define PM_EXTREMUM_FLAT 0.1 /* of the spread in a step: a slope between nodes that may have either sign; larger: more is searched */
#define PM_EXTREMUM_SHARP 0.1 /* tail of samples whose slopes are known roughly, at the best; larger: corners are climbed in vain */
#define PM_EXTREMUM_END_TAIL 4.0 /* as PM_EXTREMUM_SLOPE_TAIL, at the ends of a step; larger: more looks */
#define PM_EXTREMUM_LIKELY 0.1 /* of the most that a slope may be off by: what it is; larger: errors are estimated too large */
#define PM_EXTREMUM_WIDE 3.0 /* times the fall beside a node: so far may rise what the nodes do not show; larger: more is searched */
#define PM_EXTREMUM_NEAR 0.3 /* of a bend: so much it changes over this part of 1 / n^2 of the step; larger: extremes at nodes less exact */
#define PM_EXTREMUM_DIPS 1e-5 /* tail of a value whose corners can only be dips: looks show what they change; larger: extremes less exact */
#define PM_BOUND_PARTS 400 /* of a step, that are halved: what they do not tell then is an error, or undecided; less: more is left open, more: level values cost more in vain */
#define PM_BOUND_SURE 1e3 /* times what rounding makes of a value: so small a one has a sign, whatever the motion is off by; larger: zeros beside others are missed, less: they are counted twice */
#define PM_BOUND_LEAST 1e-14 /* of a step: a part in which bounds look for more than a corner that has been found; larger: corners less exact */
#define PM_EXTREMUM_SHARE 1e-2 /* of the tolerance: so little more is not looked for, but counts as an error; larger: errors larger */
#define PM_SWITCHES_APART 1e-9 /* of the nodes' distance: switches that are closer change together; larger: branches between them are left out */
#define PM_HIDDEN_ALIKE 0.1 /* of what others near them differ by: nodes between which a top may hide; larger: more is searched */
#define PM_HIDDEN_PARTINGS 5 /* of an interval about a level place: a sixth is left each time; more: slower */
#define PM_RISE_SLOWLY 0.5 /* of the residual before: looks that leave more lead nowhere; larger: more looks */
#define PM_EXTREMUM_STEPS 6 /* of Newton's method to an extreme; more: slower */
#define PM_RISE_BESIDE 3e-6 /* of the step: two nodes nearer to each other show no slope; larger: extremes at nodes less exact */
#define PM_RISE_PART 0.3 /* of the residual of a slope before a look: it stays so after it, at the least; larger: more looks */
#define PM_EXTREMUM_RATE_STEP 2e-3 /* of the step: differences of five values that make a rate; larger: less exact, smaller: rounding */
#define PM_EXTREMUM_NEAR_STEP 1e-4 /* of the step: differences of two values, next to an extreme; likewise */
#define PM_CULLING_PART 0.5 /* of a gap: its marks may move so far unseen; larger: seen too late */
#define PM_CULLING_BETWEEN 3.0 /* times the movement at the nodes: between them it is less (Lebesgue constants); larger: more is looked at */
#define PM_CULLING_WITHIN 0.9 /* of a gap: so far two circles may come in a step without meeting; larger: one may pass the other */
#define PM_CULLING_CURVE 0.01 /* of the size of a curve: what strikes it near an end of it is behind it for that way; larger: longer steps miss it */
#define PM_PASSAGE_BETWEEN 2.0 /* times the way from node to node: the path between is no longer; larger: steps are cut in vain, less: circles pass through each other */
#define PM_CULLING_LIKE_BEFORE 2.0 /* times what bodies moved in the last step: what they will in the next; larger: more is looked at */
#define PM_PASSAGE_BEND 2.0 /* times the deviation that differences of nodes show: of a way from its chord; larger: more looks */
#define PM_PASSAGE_LOOKS 40 /* for a passage through an edge between two nodes; fewer: grazing ones are not seen */
#define PM_LAST_BOUNCE 1e-7 /* of the scene's speed: the height of slower rebounds, v^2 / 2g, is lost in rounding; larger: rests too early */
#define PM_LOWEST_TOP 5e-5 /* of the scene's speed: bounces of slower rebounds touch at their top (PM_TOUCHING); larger: series are cut off earlier */
#define PM_BOUNCE_SETTLED 1e-5 /* of the scene's speed: slower rebounds of a series whose end is known are not computed; larger: loses more by the square, smaller: flights show more rounding */
#define PM_SERIES_SETTLED 1e-3 /* of the ratio of flights: it is that of the flights to come; larger: series end at a wrong time, smaller: those that rock end early */
#define PM_SERIES_SHRINKS 0.1 /* of what the speeds shrink by: flights that shrink less have no end that is known; larger: series that end are doubted, smaller: some are called over that go on */
#define PM_SERIES_NEARLY 0.5 /* likewise where several are struck in turn until they touch; larger: ends are guessed, smaller: they come early */
#define PM_BOUNCE_SPENT 1e-6 /* of the scene's speed: a rebound that cannot be seen and is slower is over; likewise */
#define PM_BOUNCE_UNKNOWN 30.0 /* times PM_LAST_BOUNCE: heights are known to some percent; larger: fewer blows are decisions */
#define PM_BLOWS_LEFT_TOGETHER 100 /* blows of a series within the rounding of its end that are counted one by one; more: slower */
#define PM_FIRINGS_ALIKE 1e-2 /* of a flight: what fires at this part of two of them fires in each; larger: what happens once is taken for a series, smaller: series that rounding blurs are missed */
#define PM_FIRINGS_ON_ZERO 1e-6 /* of what a trigger watches in the last flight: it is on its zero at the end of the series; larger: what ends later is called countless, smaller: so is rounding */
#define PM_BLOWS_LEFT_SURE 1.5 /* times what is left out at a blow that is not computed: ratios are known to some percent; larger: errors are estimated too large */
#define PM_BOUNCE_EARLIER 4.0 /* times PM_LAST_BOUNCE in a coarse run: shows what the cut loses; larger: errors are estimated too large */

/* ---- routes ---- */

#include "numerics/tolerances_routes.h" /* one file would be too long */

/* ---- run ---- */

#define PM_DISTURBED_SPEED 3e-14 /* of velocities, in coarse runs: PM_COARSER times some roundings; more: errors estimated larger */
#define PM_DISTURBED_PLACE 2e-15 /* of positions; more: a contact that has just been left would overlap */
#define PM_PLAN_PASSED 0.2 /* independent part of each constraint: a singular position lies behind; more: later */

#define PM_RUN_ENDS_SINGULAR 1e-5 /* the same where a run ends: velocities are known no better than places over it; less: answers there are off by more than is told; larger: refuses right ones */
#define PM_RUN_SINGULAR 1e-4 /* independent part of a constraint: a ledger that does not close there comes of it; larger: other faults are told as that */

/* ---- study ---- */

#define PM_ACCURACY_CLAIMED 1.2e-14 /* of an answer: least error that is claimed; more: hides accuracy that is there; less: rounding exceeds it */
#define PM_ACCURACY_CLAIMED_PLACE 2e-14 /* the same of the place of an extreme; likewise */
#define PM_ACCURACY_COARSE 1.75 /* steps of a coarse run, of the motion's own time: in order 8 PM_COARSER and some more; calibrated */
#define PM_ACCURACY_FEW 16 /* steps of a run: two runs of few steps may err alike; more: estimates cost more; less: errors are told too small */
#define PM_ACCURACY_LOOSE 1e-8 /* accuracies above it take two coarse runs on rk, as errors of such steps hardly go with the tolerance; less: estimates cost more; more: errors are told too small by chance */
#define PM_ACCURACY_GROWN 1e-12 /* of its size: an error beyond, after several blows on rk, takes two coarse runs; less: estimates cost more; more: errors that have grown from rounding are told too small by chance */
#define PM_ACCURACY_ANOTHER 2.5 /* times the tolerance of the first of them: that of the second; less: both may err alike; more: errors are estimated too large */
#define PM_ACCURACY_REFINEMENTS 2 /* passes at tighter tolerances; more: longer runs that may not get better */
#define PM_ACCURACY_LEAST_FACTOR 1e-4 /* of the tolerance, from one pass to the next: least change; more: more passes */
#define PM_ACCURACY_MOST_FACTOR 0.1 /* the same: a smaller change is not worth a pass */
#define PM_ACCURACY_FINER 2 /* times a route's finest tolerance: nothing is gained below; more: gives up earlier */
#define PM_ACCURACY_AIM 0.1 /* of the accuracy asked, when the tolerance is tightened; more: may need another pass */
#define PM_ACCURACY_OF_TERMS 4e-15 /* of the greatest terms: some roundings of each; more: hides accuracy that is there */
#define PM_ACCURACY_OF_STEP 2e-16 /* of an answer, for each step: rounding that goes to one side; more: errors of long runs estimated larger */
#define PM_ACCURACY_OF_MOTION 0.1 /* of the error of the state at the end, as a time: least error of what is asked there; more: told too large; less: differences that are small by chance are believed */
#define PM_ACCURACY_OF_OTHERS 0.03 /* of the greatest difference of two runs, over the size of what differs: least error of any answer; likewise */
#define PM_ACCURACY_CHANCE 100 /* times its own error that is at the most; more: early answers of unstable motion told too large; less: as above */
#define PM_ACCURACY_NEIGHBOURS 8 /* part of a list that is known no better than its worst value; more: errors that are small by chance are believed */
#define PM_SCALES_TIMES 0.01 /* of the accuracy: rounded times make more of a pulse, and errors do not go with the tolerance alone; more: they are told too small */
#define PM_SCALES_STEPS 0.6 /* of the power by which steps should grow with the tolerance: other limits chose them below; less: rounding is taken for the error of a method */
#define PM_SCALES_ERRORS 10.0 /* times the error that should be left at a tighter tolerance: it is of another kind beyond; more: such errors are told too small */
#define PM_ACCURACY_PAYS 0.8 /* of the errors before: what a tighter pass must leave to pay; more: passes that gain little */
#define PM_ACCURACY_LONGER 12 /* times the steps of the first pass: no later one is waited for any longer; more: slower */
#define PM_ACCURACY_FEW_STEPS 300 /* steps that any pass may take besides; likewise */
#define PM_MARGIN_SAME_INSTANT 0.5 /* of the time since the instant before: passes that are farther apart are at other instants; larger: right answers are called undecided */
#define PM_MARGIN_SAME_BLOW 1.5 /* between the speeds of approach of two passes: more, and they are other blows of a series; larger: right answers are called undecided */
#define PM_MARGIN_LEAST 2.2e-16 /* of the natural size: least difference of two passes; more: smaller margins */
#define PM_FIND_PROBE 1e-3 /* of the distance of samples: shows whether the ask gets better off an end; more: beyond a peak */
#define PM_FIND_LOOSE 1e-6 /* tolerance of samples whose sign alone counts; larger: more of them are run again; less: slower */
#define PM_FIND_TIE 1e-9  /* of their size: extremes that differ by less are several; more: more remarks */
#define PM_FIND_SAME 1e-9 /* of the bounds' distance: places that are one; more: takes two for one */
#define PM_FIND_OUTCOME 5e-11 /* of a threshold: what the tolerances of decisions (1e-11) leave; more: errors estimated larger */
#define PM_FIND_BESIDE 4 /* times PM_FIND_OUTCOME, or the tolerance: how far beside what was found answers are looked at; less: rounding takes the side; more: moves farther */
#define PM_FIND_SMALL 1e-3 /* of the bounds' distance: a parameter that is no larger is next to zero; more: looks farther beside it */
#define PM_FIND_STEP 10 /* times what an answer changes on either side: it differs beyond; less: logarithms are told; more: small steps are not */
#define PM_FIND_SEEN 100 /* tolerances, of an answer's size: differences below are those of runs; less: false remarks; more: small steps are not told */
#define PM_FIND_TOUCH 4 /* times nearer to zero than its samples: a condition may reach it; more: fewer looks, misses */
#define PM_FIND_WIDEST 0.25 /* of the interval: first distance of differences; more: leaves the interval */
#define PM_FIND_HALVINGS 12 /* towards an end, for the other sign of the derivative; more: more runs */
#define PM_FIND_VALUES 100  /* values of the minimiser; more would only put off its end */
#define PM_FIND_CLOSE 1e-13 /* of the place: width at which the minimiser stops; more: less accurate corners */
#define PM_FIND_NOISE 1e-9 /* of a value: it may seem worse by this at the derivative's root; more: takes other roots */
#define PM_PAIR_STEPS 60    /* steps from one start; more would only put off its end */
#define PM_PAIR_STILL 1e-15 /* of the bounds' distance: a step that is no step; more: ends earlier */
#define PM_PAIR_MET 1e-8 /* of the greatest size on the grid: a condition is met; more: takes what only comes near */
#define PM_PAIR_SAME 1e-7 /* of the bounds' distance: roots that are one; more: takes two for one */
#define PM_ROOT_STEPS 200 /* runs to close a bracket; more would only put off its end */
#define PM_ROOT_FEW 1e-9 /* of the bracket: as far as a root's error goes; more: steps over other thresholds */
#define PM_ROOT_JUMP 1e-3 /* of the first step of the function: what a closed bracket cannot have left; more: jumps pass for roots */

/* ---- the limit on computing time ---- */
#define PM_PATIENCE_BETWEEN 2e-4 /* s: looks at the clock that are nearer are made more seldom; more: heard later */
#define PM_PATIENCE_QUESTIONS 64 /* most questions without a look; more: costs less, and is heard later */

#endif

/* tolerances.h - every number of the kernel that decides something: what counts as zero, as equal, as lost, as too many.
 *
 * One line each: the value, its unit ("of x": relative to x), why it is that, and what a larger one would do.  Nothing with
 * a dimension is compared with a bare number: sizes come from the case (numbers.size in m, numbers.speed in m/s) or from the
 * terms that were summed.  Where a number was calibrated the table of that calibration is named.  Numbers that decide
 * nothing - coefficients of a formula, lengths of arrays - stand where they are used. */
#ifndef PM_TOLERANCES_H
#define PM_TOLERANCES_H

/* ---- all rooms ---- */

#define PM_EPSILON 2.3e-16 /* of a number: rounding of one operation; more would stop searches earlier */

/* ---- numerics ---- */

#define PM_BRACKET_VALUES 300    /* values: a triple root takes 140; more would only put off the message */
#define PM_BRACKET_WIDTH 1e-14   /* of the bracket: a root near x = 0 is that close; more would move events */
#define PM_BRACKET_NOTHING 1e-16 /* of the bracket: a shift of Newton that gains nothing; likewise */
#define PM_BRACKET_POLISHED 1e-15  /* of the step: a shift that gains nothing on exact states; likewise */
#define PM_BRACKET_SLOPE_STEP 1e-4 /* of the step: distance of differences; more: curvature spoils slopes */
#define PM_BRACKET_FAR 0.1       /* of the step: a longer shift is no polish, it may leave for another root */
#define PM_CHEBYSHEV_SMOOTH 1e-3 /* of the values: tail of what has no corners; more would miss some */

/* ---- state ---- */

/* ---- expression ---- */

/* ---- elements ---- */

/* ---- scene ---- */

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

/* ---- impact ---- */

/* ---- routes/path ---- */

/* ---- routes/rk ---- */

/* ---- routes/ida ---- */

/* ---- routes/uniform ---- */

/* ---- routes/start ---- */

/* ---- run ---- */

/* ---- study ---- */

#endif

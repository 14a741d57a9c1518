/* tolerances_routes.h - the part of tolerances.h that belongs to the routes. */
#ifndef PM_TOLERANCES_ROUTES_H
#define PM_TOLERANCES_ROUTES_H

/* one line for each number */
/* clang-format off */

/* ---- routes/path ---- */

#define PM_CLOCK_TAIL 1e-13      /* tail of dt/du at the least; more: less exact times */
#define PM_WORK_TAIL 1e-12       /* tail of the rates of work; more: less exact energies */
#define PM_PATH_TURNS 1e-13 /* of the scene's size, in the driver: a way to the turning point that energies do not show; larger: short ways are left to another route */
#define PM_PATH_STILL 1e-11      /* of the scene's speed: at rest; more: slow starts lose their speed */
#define PM_PATH_BALANCED 1e-12   /* of the forces: in equilibrium; more: weak forces move nothing */
#define PM_PATH_STEPS_PER_TURN 8 /* steps in a turn of a coordinate; more: slower, contacts are seen sooner */
#define PM_PATH_LENGTH 0.5 /* of the scene's size: longest step of a coordinate that is a length; more: contacts are missed */
#define PM_PATH_FARTHER 4.0 /* steps, where no loop is closed and no contact is near; more: nodes resolve them more seldom */
#define PM_PATH_FASTER 2.0 /* steps, of coordinates that are no driver; more: Newton may leave the branch */
#define PM_PATH_BEYOND 1.2 /* of the way to a contact that seems to come, so that the step sees it; more: coarser nodes */
#define PM_PATH_LAP 1e-14         /* of a turn: rounding of a sum of steps; more: laps end early */
#define PM_PATH_CHECK_ROUNDINGS 8 /* roundings in a difference of potentials; more: the audit sees less */
#define PM_PATH_SAME_STEP 1e-9 /* of a step's length: as long as the last one; more: places shift by that */
#define PM_PATH_SAME_DIRECTION 1e-9 /* of the rates at a unit rate of the driver: the same direction; more: likewise */
#define PM_PATH_KEEP 0.3 /* of the fastest coordinate: a driver this fast stays; more: more changes of driver */
#define PM_PATH_WEAK 3e-2 /* of the constraints' natural size: weaker pivots leave slopes to rounding over its square; more: more bridges */
#define PM_PATH_LINKS 8 /* levers in the size of a scene that is no long chain; more: chains seem singular */
#define PM_BRIDGE_REACH 0.2 /* rad, or of the scene's size: from the centre to the places that bear a bridge; more: less exact */
#define PM_BRIDGE_SERVES 0.5 /* of the reach: places taken from the bridge; more: less exact at its ends */
#define PM_BRIDGE_STRIDE 0.25 /* of the reach: strides to the first place that bears; more: Newton may leave the branch */
#define PM_BRIDGE_STRIDES 1e4 /* to the first place that bears, at the most; more: a place far away is sought in vain for long */
#define PM_BRIDGE_MET 1e-11 /* of the scene's size: the loop constraints on the bridge are met; more: drift at singular positions */
#define PM_PATH_FORM_TAIL 1e-8 /* tail of T at nodes that resolve it; more: places of rest are missed */
#define PM_PATH_SPEED_TAIL 1e-6 /* tail of the speed where triggers watch it; more: dips over a barrier are missed */
#define PM_PATH_TURNS_SOON 0.1 /* of a step: so close behind its end the motion comes to rest; larger: more steps */
#define PM_PATH_SHORT_OF_TURN 0.6 /* of such a step: the one that is tried instead, more than a half; larger: it is shortened again */
#define PM_PATH_LENGTHEN 2.0 /* of a step that was resolved: the next one; more: more halvings */
#define PM_PATH_TIME_TAIL 30 /* of the tolerance: tail of dt/du, whose integral is 1000 times better; more: less exact times */
#define PM_PATH_PART 0.25 /* of a full step: a longer way to a place of rest takes a coarse run two steps; more: one */
#define PM_PATH_SHORTEST 1e-12 /* of a full step: shorter ones end the run; more: it ends earlier */
#define PM_PATH_TIME_LOOSE 3e-6 /* tail of dt/du at the most: where it falls more slowly the integral is not 1000 times better; more: errors of time at loose tolerances estimated too small */
#define PM_CLOCK_NOISE 1e-6 /* a tail below it that no halving makes smaller is rounding; more: real tails pass */
#define PM_CLOCK_GAINS 0.5 /* of the tail over a longer step: what is no rounding falls below; more: rounding is halved */
#define PM_CLOCK_FEWER 4.0 /* weight of the tail at the nodes of a step, which are fewer; more: finer nodes are taken more often */
#define PM_CLOCK_OPEN 32.0 /* weight of that tail inside a step, by 1/2k and not 1/k^2; more: errors of time estimated larger */
#define PM_CLOCK_OFF 250.0 /* weight of the tails of mass and T, half of which the time is off by where it is slow, 0.5 / PM_ERROR_UNRESOLVED; more: shorter steps */
#define PM_CLOCK_SLOWEST 0.05 /* from one coefficient to the next: so much they are taken to fall at the least; more: errors of time estimated smaller */
#define PM_CLOCK_ROUNDED 1e-15 /* of the mass: coefficients below it are rounding; more: errors of time estimated smaller */
#define PM_CLOCK_FALLS 1e-5 /* from four coefficients to the next: where they fall by more, nothing is taken for a constant; more: errors of time estimated smaller */
#define PM_CLOCK_CONSTANT 20.0 /* likewise, of the power by which they fall; more: errors of time estimated larger */
#define PM_CLOCK_LATE 4e-16 /* of the time: so much rounding may leave out of it; more: other differences are taken for that */
#define PM_CLOCK_ROUNDING 7e-15 /* of a time, in coarse runs: PM_COARSER roundings, of which no two cancel; more: errors of late answers estimated larger */
#define PM_PATH_ROUNDED 7e-15 /* of the driver, in coarse runs: PM_COARSER roundings; more: errors beside places of rest estimated larger */
#define PM_CLOCK_LIKELY 0.1 /* of what the tails of the steps allow: what they sum up to; more: errors at loose tolerances estimated larger */
#define PM_CLOCK_NOTHING 1e-17 /* of the greatest coefficient: smaller ones are dropped; more: less exact times */
#define PM_ENERGY_ROUNDINGS 1e-15 /* of the energies: roundings of a step, or of a blow and the segment after it; more: errors are estimated larger */
#define PM_ERROR_FASTER 1e-6 /* of the speeds: step of a difference by T; more: curvature spoils it */
#define PM_ERROR_UNRESOLVED 2e-3 /* of the tail of dt/du: what its integral is off by; more: errors of time estimated larger */
#define PM_ERROR_EXACT 1e-12 /* tail of a function that its samples show to rounding; more: extremes seem exact */
#define PM_ERROR_RESIDUAL 10.0 /* of the tail: how far an extreme may be from that of the polynomial; more: smaller margins */
#define PM_ERROR_WIDE 3.0 /* of what a node is nearer to zero than its neighbours: so much nearer an extreme may be; more: slower */
#define PM_ERROR_ASIDE 1e-4 /* of a step, or of the way to where it rests: step of a difference along the motion; more: curvature spoils it */
#define PM_ERROR_ASIDE_LEAST 1e-6 /* of a step, at the least, beside a place of rest; less: rounding spoils it */
#define PM_ERROR_ASIDE_PLACE 1e-10 /* of the driver, likewise */
#define PM_ERROR_ASIDE_OFF 1e-9 /* of a step and of the driver: so far outside the frame may look; more: places of other steps pass */
#define PM_ERROR_LIKELY 0.15 /* of what roundings of T allow for the time: what they sum up to, where it is given; more: errors at given times are estimated larger */
#define PM_ERROR_ENERGY_ROUNDINGS 6e-16 /* of the energies: what rounds T at one place; more: errors beside places of rest are estimated larger */
#define PM_ERROR_TIME_ROUNDINGS 4e-16 /* of a time: two roundings; more: errors at given times are estimated larger */
#define PM_ERROR_RESTING 10.0 /* an error of T moves the place of rest, too; more: errors of time estimated larger */
#define PM_REPEAT_RESTS 4 /* places of rest that the first is compared with, and twice as many each time that none was the same; more: slower */
#define PM_MOST_REPEATS 100000000 /* segments that are passed over at once; more would not be distinguished */
#define PM_REPEAT_SAME_ENERGY 1e-13 /* of T: a lap without gain or loss; more: slow losses are left out */
#define PM_REPEAT_ALIKE 1e-8 /* of T, taken by the blows of all segments: their roundings add up as if none took anything; less: by rounding */
#define PM_REPEAT_BARRIER 1e-6 /* of the segment's energies: so near to the barrier it is computed; more: fewer are passed over */
#define PM_REPEAT_WHOLE 1e-9 /* of a multiple: a whole number of them; more: marks shift */
#define PM_REPEAT_SAME_PLACE 1e-11 /* of the scene's reach: the same configuration; more: places drift along a pattern */
#define PM_REPEAT_SAME_MOTION 1e-9 /* of the scene's speed: velocities in the same proportion; more: likewise speeds */
#define PM_REPEAT_SAME_END 1e-9 /* of T: the segment that is told ends as it should; more: wrong ends pass */

/* ---- routes/rk ---- */

#define PM_RK_MARGIN 0.1 /* of the accuracy asked: errors of steps add up, and grow with the motion; more: less accurate */
#define PM_RK_LEVEL_MARGIN 0.3 /* the same where energy holds a single freedom on its path: only delays add up */
#define PM_RK_TIGHTEST 5e-15 /* relative: below it the estimate of errors is rounding; more: less can be asked for */
#define PM_RK_SAFETY 0.7       /* of the step that the error allows; more: more steps are rejected */
#define PM_RK_BESIDE 0.3       /* weight of the second estimator of order 5: where the first passes through zero, it tells; less: steps are accepted there; more: shorter steps */
#define PM_RK_SHRINK 0.2       /* of a step: the shortest next one; more: more rejections one after the other */
#define PM_RK_GROW 4.0         /* of a step: the longest next one; more: more rejections */
#define PM_RK_LEAST_STEP 8e-16 /* of the time: a shorter step changes nothing; more: a run gives up earlier */
#define PM_RK_FIRST_RETRY 0.25 /* of a step in which there is no value: the next try; more: more tries */
#define PM_RK_SIDESTEP 1.2 /* of a step: a little longer or shorter, its stages are elsewhere; more: loses length */
#define PM_RK_SIDESTEPS 12 /* tries past a singular stage; more would only put off the shrinking */
#define PM_RK_REST_OF_HALF 0.1 /* of a half of a main run's step: what is left of it is not worth a step; more: halves that are uneven */
#define PM_RK_BEYOND_END 1e-3 /* of a half of a main run's step: so far beyond its end a coarse one goes; less: takes the place where that one ended for its own; more: other errors */
#define PM_RK_SAME_PLACE 1e-3 /* of a step: places of one event while it is looked for; more: two events are one */
#define PM_RK_NOTED 64 /* ends of steps and places within them of a run that takes few; less: errors there may be told too small */
#define PM_RK_NEAR_SINGULAR 0.2 /* of the step's most regular stage: rounding is amplified below; more: side steps in vain */
#define PM_RK_OVER 0.3 /* of the motion's own time: a first step that passes a singular position; more: less accurate */
#define PM_RK_LEDGER_STEPS 16 /* steps from one that integrates the ledger to the next; more: a thinner audit */
#define PM_RK_FROM_REST 1e3 /* times the speed at which a step begins: so much faster at its end, it begins from rest; more: steps from rest are short in vain; less: less accurate starts */
#define PM_RK_TIME_ROUNDED 1e-15 /* of a program of the time, and of what it changes by in all the time: rounding; more: errors of weak pulses are missed; less: steps become short in vain */
#define PM_RK_PLACE_ROUNDED 1e-15 /* of a place, at both ends of a step: rounding of what it goes on by; more: errors of places far away are missed; less: steps become short there in vain */
#define PM_RK_STEADY 0.05 /* of the allowed error, PM_RK_SAFETY^8: with more the next step is no longer; more: steps stay short where rounding is the error */
#define PM_RK_FAR 20.0 /* of the scene's size, or rad: nearer places are not far away, and PM_RK_TIGHTEST stands for their rounding; less: stiffness is noticed late */
#define PM_RK_MOST_MOVED 2.0 /* of the scene's size, or rad: so far a step that is sampled may go where it is PM_RK_GROWN times as fast at its end; larger: samples show less; less: more steps */
#define PM_RK_MOST_TURNED 0.2 /* rad: so far a step may turn what turns PM_RK_GROWN times as fast at its end, at the tightest; larger: the integrals of reactions are wrong; less: more steps */
#define PM_RK_GROWN 1.2 /* larger: likewise; less: more steps where rates at the begin limit them well */

#define PM_RK_STABLE 6.1 /* |h lambda| to which the formula is stable: no shorter by accuracy; more: stiffness is missed */
#define PM_RK_STIFF_STEPS 1500 /* of a phase: so many an implicit route needs, too; more: later handed over */
#define PM_RK_STIFF_EVERY 50   /* steps between looks, where none was in doubt; more: seen later */
#define PM_RK_STIFF_LOOKS 15   /* that found it stiff; more: later, and surer */
#define PM_RK_STIFF_CLEAR 6    /* in a row that did not: the others were chance; likewise */

/* ---- routes/ida ---- */
#define PM_IDA_TO_MEETING 0.25 /* of the time to what is met: the limit holds a step late; more: steps over it */

#define PM_IDA_TIGHTER 4e-3 /* of the tolerance to PM_IDA_POWER: what IDA keeps in each step; more: less accurate */
#define PM_IDA_POWER 1.2 /* errors of order 5 add up over steps that go with 1/6 of it; more: loose runs err */
#define PM_IDA_FINEST 1e-10 /* relative: below it steps follow rounding; more: less can be asked for */
#define PM_IDA_NEWTON 0.01  /* of the error allowed: Newton's iteration may stop; more: its error shows */
#define PM_IDA_NOTHING 1e-4 /* of that: a first change that needs no other to tell how fast they shrink; likewise */
#define PM_IDA_STALLED 0.9 /* of the change before: the iteration leads nowhere; more: tried longer */
#define PM_IDA_UNKNOWN 20.0 /* times a change: what it may leave where no rate is known yet; more: one iteration more */
#define PM_IDA_GAINED 4.0 /* roundings: a change with nothing left to gain; more: unknowns less exact */
#define PM_IDA_ROUNDINGS 8.0 /* roundings: differences over five steps show no less of an error; more: less accurate far away */
#define PM_IDA_LATER 0.1 /* of a step: between two looks at forces, which tell what rounding the time makes of them; more: narrow pulses are passed; less: a turn of one is taken for no change */
#define PM_IDA_LATER_ROUNDINGS 64.0 /* of the time, at the least, likewise; less: their difference is rounding itself */
#define PM_IDA_TRIES 40 /* of a step, each a quarter of the one before: forces that rise from nothing tell no first length; more would only put off the failure */
#define PM_IDA_FIRST_STEP 0.3 /* of sqrt(tolerance) times the motion's own time: a step of order 1; more: rejected */
#define PM_IDA_RATE_TIME 1e-4 /* of the motion's own time: distance of differences at the begin; more: curvature spoils them */
#define PM_IDA_FLIGHT 0.05 /* of the flight of a bounce: a first step; more: its shape, of order 1, is lost */
#define PM_IDA_SHORTEST 1e-4 /* of the first step else: no flight makes it shorter; more: the last bounces are lost */
#define PM_IDA_LONGEST_STEP 0.25 /* of the motion's own time, where something is watched; more: unseen between samples */
#define PM_IDA_LEAST_STEP 8e-16 /* of the time: a shorter step changes nothing; more: a run gives up earlier */
#define PM_IDA_NEAR_SINGULAR 0.1 /* independent part of a constraint: Newton may fail below; more: left to rk for longer */
#define PM_IDA_LOST 0.2 /* the same where a step of a long chain failed: up to where the plan comes back (PM_PLAN_PASSED) */
#define PM_IDA_SHORT_ROOM 1e-11 /* of the time: IDA would begin with a thousandth of it, which is no step; more: short phases less exact */
#define PM_IDA_LEAST_ROOM 4e-15 /* of the time: IDA finds begin and end too close below; more: stops farther off */
#define PM_IDA_SLIGHT 1e-6 /* of size and speed: the last matrix corrects this much; more: slower than a new projection */
#define PM_IDA_CORRECTED 4e-15 /* of size and speed: nothing is left to correct; more: constraints drift */
#define PM_IDA_MANY 40   /* unknowns (v, L): up to there inverses are faster than KLU; more: slower chains */
#define PM_IDA_PIVOT 0.1 /* of the greatest in its column: a pivot that keeps the order; more: more fill-in */
#define PM_IDA_LEDGER_WEIGHT 1e-2 /* of the weight of what is controlled: the ledger feeds nothing back; more: slower */

/* ---- routes/uniform ---- */

#define PM_UNIFORM_FIRST_STRIDE 4.0 /* of the motion's own time: first step where polynomials are watched; more: coarser samples */
#define PM_UNIFORM_FINEST 5e-14 /* relative: what other phases of the run may reach; more: less can be asked for */
#define PM_UNIFORM_LONGER 2.0 /* of a step: the next one; likewise */
#define PM_UNIFORM_TURNED 1e-9 /* of a step: a parabola whose extremum is so near to its begin has passed it; more: extremes are missed */
#define PM_UNIFORM_REVERSAL_ROUNDING 1e-15 /* of its values: how far off three of them put the extremum of a parabola; less: steps of no length */
#define PM_UNIFORM_DEFINITE 100.0 /* roundings of accelerations: a definite one; more: more phases are left to rk */
#define PM_UNIFORM_SAME_TIME 1e-11 /* of a step: contacts that close so near to each other do so at once; more: series of blows merge */
#define PM_UNIFORM_SLOW_CHANGE 0.1 /* of the speed in the interval: below, Gauss is exact and the closed form cancels; more: less exact */
#define PM_UNIFORM_HALVINGS 200                   /* halvings: more than doubles have digits and exponents; more changes nothing */
#define PM_UNIFORM_NEAR 4 /* members of a pattern that are looked at one by one; more: slower */
#define PM_UNIFORM_ROUNDING 1e-15 /* of the places of marks: a gap below it is closed; more: contacts close early */
#define PM_UNIFORM_TIME_ROUNDING 4.5e-16 /* of a time: two roundings; more: roots less exact */
#define PM_UNIFORM_TOGETHER 1e-12 /* of the time since the last blow: contacts that close so soon after the first close with it; less: by rounding the bounce of one of them is lost alone */
#define PM_UNIFORM_REFINEMENTS 8         /* shorter intervals tried for a bound; more: slower */
#define PM_UNIFORM_WIDER 4.0    /* of the step that was safe: the next interval; more: weaker bounds */
#define PM_UNIFORM_SHORTER 0.01 /* the same where nothing was safe; more: more tries */
#define PM_UNIFORM_ADVANCES 100000              /* safe steps in one step of the route; more: endless approaches last longer */
#define PM_ZENO_ALIKE 2 /* successive blows that were e times the one before; more: the leap comes later */
#define PM_ZENO_GEOMETRIC 1e-8 /* of a blow: rounding of a slow one in a fast scene; more: series that are none are taken */
#define PM_ZENO_SLOW 1e-3 /* of the scene's speed: a rebound too low for a look of its own; more: leaps come earlier */
#define PM_ZENO_EARLIER 100.0 /* times PM_ZENO_SLOW in a coarse run: a tenth of the scene's speed, with hardly a hundredth of what rounding does still to come; larger: less of that is seen, smaller: slower */
#define PM_ZENO_ENOUGH 500 /* blows alike, however fast; more: slower */
#define PM_ZENO_MARGIN 2.0 /* of what the flights to come may still change; more: fewer leaps */
#define PM_TURNS_ALIKE 6 /* successive blows of two contacts by turns; more: the leap comes later */
#define PM_TURNS_FEW 8 /* pairs of blows: fewer are not passed over; more: slower */
#define PM_TURNS_MOST 1e15 /* the same: more are passed over by and by; more: their number is rounded */
#define PM_TURNS_ROUNDING 1e-13 /* of velocities: a blow has mirrored them; more: blows with a loss pass */
#define PM_TURNS_PARALLEL 1e-15 /* sine of the angle between two sides: none but rounding; more: their wedge is taken for a strip */
#define PM_TURNS_LEDGER 1e-10 /* of the momentum: rounding of what is passed over at once; more: the audit is less sharp */
#define PM_TURNS_SERIES 0.05 /* angle: below, a series is more exact than a difference; more: its terms that are left out count */

/* ---- routes/start ---- */

#define PM_GROWTH_STEADY 1e-10 /* of the accelerations in the scene: none in the axes; more: unsteady motions pass */
#define PM_GROWTH_STEP 1e-3 /* of the scene's size: deviation for differences; more: curvature spoils them */
#define PM_GROWTH_SHORT 0.1 /* of the time of the fastest change: h of exp(L h); more: its polynomial is less exact */
#define PM_GROWTH_ALIKE 1e-8 /* of the changes at different times, by differences: the same; more: unsteady motions pass */
#define PM_GROWTH_SQUARINGS 60 /* squarings of exp(L h); more: slower where nothing grows alone */
#define PM_GROWTH_ALONE 1e-12 /* of the power: it changes no more, one rate is left; more: others are mixed in */
#define PM_GROWTH_GROWS 1e-4 /* of the fastest change: less is what differences make of no growth; more: slow growth is missed */
#define PM_GROWTH_FOLLOWS 1e-7 /* of the fastest change: L u = r u; more: what does not grow as one passes */
#define PM_GROWTH_EXCITED 1e-7 /* of what is left of any blow: this one excites growth; more: weak ones are refused */
#define PM_SETTLE_DIFFERENCE (1. / 512) /* rad, or of the scene's size: displacement for derivatives of the forces; more: curvature spoils them */
#define PM_SETTLE_LONGEST 0.3 /* likewise: longest step; more: it jumps to an equilibrium farther off */
#define PM_SETTLE_NEUTRAL 1e-10 /* of the stiffest direction: nothing acts along this one, to what differences tell; more: soft directions stay as drawn */
#define PM_SETTLE_HALVINGS 6 /* of a step whose forces are not smaller; more: slower to find that it leads nowhere */
#define PM_SETTLE_FALL 0.1   /* of the fall of the forces that the step promises; more: more steps are halved */
#define PM_SETTLE_NEAR 1e-6 /* rad, or of the scene's size: a step of Newton's method that converges, whatever rounding makes of the forces; more: others pass */
#define PM_SETTLE_SWEEPS 60 /* steps; more: slower where there is none */
#define PM_SETTLE_SINKS 300 /* steps of sinking; likewise */
#define PM_SETTLE_SUNK 1e-3 /* rad, or of the scene's size: so near that Newton's method ends it; more: it may lead elsewhere */
#define PM_SETTLE_ROUNDS 10 /* and two for each contact: changes of which contacts carry; more: slower where none end */
#define PM_SETTLE_MET 1e-9 /* of the forces in the scene: none; more: slow motions pass */
#define PM_SETTLE_RESTS 1e-7 /* of the accelerations in the scene, as contacts find them: none; likewise */
#define PM_PERTURBATION_SIZE 0.1 /* of the root of the tolerance: what is neglected goes with its square; more: less exact */
#define PM_PERTURBATION_STILL 1e-11 /* of the scene's speed: at rest; more: slow motions count as rest */
#define PM_PERTURBATION_SHOWS 1e-6 /* of the deviation: what the program must make of it; more: weak programs are refused */
#define PM_PERTURBATION_ASIDE 1e-3 /* rad, or of the scene's size: where on a path the forces are looked at; more: another place */
#define PM_PERTURBATION_NOTHING 1e-12 /* of the forces before: no force there; more: weakly unstable rests seem stable */

#endif

/* energy_level.c - motion without losses keeps its energy:  T + V = T_0 + V_0  (17.12).
 *
 * Where forces have potentials, nothing is driven and nothing slides with friction, no integrator needs to let the energy
 * drift: a wrong energy is a wrong rate of the whole motion, whose error grows with the square of the time.  After a step
 * velocities are multiplied by
 *     s = sqrt((E - V) / T),
 * the least correction in the metric of M that has the energy E (projection: Hairer, Lubich, Wanner, Geometric Numerical
 * Integration, IV.4); constraints that prescribe no rate hold for any multiple.  Near a turning point velocities say
 * little of the energy, and nothing is corrected: the level stays, so that a later step makes up for it.
 *
 * What the corrections return would have drifted off: it remains the evidence of the energy ledger (ledger.c). */
#include "equations/energy_level.h"

#include <math.h>

#include "elements/force.h"
#include "elements/joint_friction.h"
#include "elements/turning_plane.h"
#include "equations/active_set.h"
#include "numerics/tolerances.h"
#include "state/frame.h"
#include "state/workspace.h"

static int only_potentials(const pm_model *m, const pm_state *state)
{
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (m->force_z[i] != PM_NONE && !pm_state_is_absent(m, state, PM_TABLE_FORCE, i)) return 0;
    return 1;
}

static double potential(pm_workspace *w) { return pm_frame_weight_energy(&w->frame) + pm_force_potential(w); }

/* Of weights and springs, each for itself: far from the origin they are great and cancel in what moves. */
static double size_of_terms(pm_workspace *w)
{
    double sum = 0;
    for (int i = 0; i < w->model->nbody; i++)
        sum += w->numbers.mass[i] * (fabs(w->numbers.gravity[0] * w->frame.pose[5 * i]) +
                                     fabs(w->numbers.gravity[1] * w->frame.pose[5 * i + 1]));
    return sum + fabs(pm_force_potential(w));
}

void pm_energy_level_begin(pm_workspace *w, pm_energy_level_level *level)
{
    level->kept = !w->active.asymmetric && !w->numbers.massless && !pm_turning_plane_turns(w->model) &&
                  !pm_joint_friction_any(w->model) && only_potentials(w->model, &w->state) &&
                  !pm_active_set_is_driven(&w->active);
    if (!level->kept) return;
    level->kinetic = pm_frame_kinetic(&w->frame, PM_NONE);
    level->energy = level->kinetic + potential(w);
}

double pm_energy_level_factor(pm_workspace *w, const pm_energy_level_level *level, double *gained)
{
    const double kinetic = pm_frame_kinetic(&w->frame, PM_NONE);
    *gained = 0;
    if (!level->kept || !(kinetic > PM_LEVEL_SHARE * level->kinetic)) return 1;
    const double missing = level->energy - potential(w) - kinetic;
    /* where it is slow its velocities do not take in the rounding of what was fast */
    const double most = fmax(kinetic, level->kinetic), terms = most + size_of_terms(w);
    if (!(fabs(missing) > PM_LEVEL_ROUNDING * terms * most / kinetic &&
          fabs(missing) < PM_LEVEL_MOST * kinetic))
        return 1;
    *gained = missing;
    return sqrt(1 + missing / kinetic);
}

void pm_energy_level_note(const pm_frame *frame, pm_ledger *ledger, pm_energy_level_level *level,
                          double gained)
{
    level->kinetic = fmax(level->kinetic, pm_frame_kinetic(frame, PM_NONE));
    level->returned += gained;
    ledger->evidence =
        fmax(ledger->evidence, fabs(level->returned) / fmax(ledger->energy_scale, level->kinetic));
}

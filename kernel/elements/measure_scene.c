/* measure_scene.c - what is read off forces, events, the whole scene and its turning plane.
 *
 * The work of a force with a potential V is V at the start less V now; that of others is a running integral. */
#include "elements/force.h"
#include "elements/measure_kinds.h"
#include "elements/trigger.h"
#include "elements/turning_plane.h"
#include "state/workspace.h"

/* ---- forces and events ---- */
void pm_measured_force_force(const pm_measure_args *x, double out[2])
{
    const pm_action f = pm_force_action(x->w, x->a);
    const int other =
        x->e[PM_MEASURE_ON] != PM_NONE && pm_model_body_index(x->w->model, x->e[PM_MEASURE_ON]) != f.body_a;
    for (int k = 0; k < 2; k++) out[k] = other ? -f.force[k] : f.force[k];
}
double pm_measured_force_couple(const pm_measure_args *x) { return pm_force_action(x->w, x->a).couple; }
double pm_measured_force_work(const pm_measure_args *x)
{
    const int z = x->w->model->force_z[x->a];
    if (z != PM_NONE) return x->w->frame.z[z];
    return x->w->ledger.force_energy_start[x->a] - pm_force_action(x->w, x->a).energy;
}
double pm_measured_force_power(const pm_measure_args *x) { return pm_force_action(x->w, x->a).power; }
double pm_measured_force_stretch(const pm_measure_args *x)
{
    return pm_force_place(&x->w->frame, x->a).stretch;
}
double pm_measured_force_rate(const pm_measure_args *x) { return pm_force_place(&x->w->frame, x->a).rate; }
double pm_measured_force_energy(const pm_measure_args *x) { return pm_force_action(x->w, x->a).energy; }
double pm_measured_event_count(const pm_measure_args *x) { return pm_trigger_count(&x->w->firing, x->a); }
double pm_measured_event_time(const pm_measure_args *x) { return pm_trigger_time(&x->w->firing, x->a); }
double pm_measured_event_side(const pm_measure_args *x) { return x->w->firing.side[x->a]; }

/* It has a value in programs of curves alone, which are not run on a state. */
double pm_measured_place(const pm_measure_args *x)
{
    (void)x;
    return NAN;
}

/* ---- the scene ---- */
double pm_measured_time(const pm_measure_args *x) { return x->w->frame.t; }
double pm_measured_potential(const pm_measure_args *x)
{
    return pm_frame_weight_energy(&x->w->frame) + pm_force_potential(x->w);
}
double pm_measured_total(const pm_measure_args *x)
{
    return pm_frame_kinetic(&x->w->frame, PM_NONE) + pm_turning_plane_kinetic(&x->w->frame, PM_NONE) +
           pm_measured_potential(x);
}
double pm_measured_lost(const pm_measure_args *x) { return x->w->impulses.energy_lost; }

/* ---- the turning plane ---- */
double pm_measured_spin_omega(const pm_measure_args *x) { return pm_turning_plane_omega(&x->w->frame); }
double pm_measured_spin_angle(const pm_measure_args *x) { return pm_turning_plane_angle(&x->w->frame); }
double pm_measured_spin_momentum(const pm_measure_args *x) { return pm_turning_plane_momentum(&x->w->frame); }
double pm_measured_spin_inertia(const pm_measure_args *x) { return pm_turning_plane_inertia(&x->w->frame); }

/* measure_kinds.h - how each kind of measure is read off the frame; measure.c has the table of them. */
#ifndef PM_MEASURE_KINDS_H
#define PM_MEASURE_KINDS_H

#include <math.h>

#include "elements/slope.h"
#include "state/frame.h"
#include "state/workspace.h"

/* One measure. */
typedef struct pm_measure_args {
    pm_workspace *w;
    const int32_t *e; /* its row */
    int a;            /* partner; bodies: PM_NONE for all, nbody for the ground */
} pm_measure_args;

typedef double pm_scalar(const pm_measure_args *x);
typedef void pm_vector(const pm_measure_args *x, double out[2]);

/* measure_body.c */
pm_scalar pm_measured_angle, pm_measured_turned, pm_measured_omega, pm_measured_alpha, pm_measured_mass,
    pm_measured_weight, pm_measured_inertia, pm_measured_kinetic, pm_measured_angular_momentum,
    pm_measured_path;
pm_vector pm_measured_momentum, pm_measured_pole, pm_measured_position, pm_measured_moved,
    pm_measured_velocity, pm_measured_acceleration;
/* measure_joint.c */
pm_scalar pm_measured_joint_couple, pm_measured_joint_normal, pm_measured_joint_friction,
    pm_measured_joint_friction_needed, pm_measured_joint_power, pm_measured_joint_slip;
pm_vector pm_measured_joint_force, pm_measured_joint_impulse;
/* measure_contact.c */
pm_scalar pm_measured_contact_gap, pm_measured_contact_closed, pm_measured_contact_slip,
    pm_measured_contact_normal, pm_measured_contact_couple, pm_measured_contact_friction,
    pm_measured_contact_friction_needed, pm_measured_contact_tension, pm_measured_contact_tension_impulse;
pm_vector pm_measured_contact_force, pm_measured_contact_impulse;
/* measure_scene.c */
pm_scalar pm_measured_force_couple, pm_measured_force_work, pm_measured_force_power,
    pm_measured_force_stretch, pm_measured_force_rate, pm_measured_force_energy, pm_measured_event_count,
    pm_measured_event_time, pm_measured_event_side, pm_measured_potential, pm_measured_total,
    pm_measured_lost, pm_measured_time, pm_measured_spin_omega, pm_measured_spin_angle,
    pm_measured_spin_momentum, pm_measured_spin_inertia, pm_measured_place;
pm_vector pm_measured_force_force;
/* measure_modes.c */
pm_scalar pm_measured_mode_omega, pm_measured_mode_damping, pm_measured_modes_count, pm_measured_modes_growth;

/* measure_slope.c */
typedef int pm_measure_sloped(const pm_measure_args *x, const double weight[2], pm_slope *to);
pm_measure_sloped pm_measure_slope_nothing, pm_measure_slope_angle, pm_measure_slope_turned,
    pm_measure_slope_omega, pm_measure_slope_inertia, pm_measure_slope_kinetic, pm_measure_slope_momentum,
    pm_measure_slope_angular_momentum, pm_measure_slope_pole, pm_measure_slope_position,
    pm_measure_slope_moved, pm_measure_slope_velocity, pm_measure_slope_gap, pm_measure_slope_slip,
    pm_measure_slope_joint_slip, pm_measure_slope_force, pm_measure_slope_couple, pm_measure_slope_work,
    pm_measure_slope_power, pm_measure_slope_stretch, pm_measure_slope_rate, pm_measure_slope_energy,
    pm_measure_slope_potential, pm_measure_slope_total, pm_measure_slope_spin_omega,
    pm_measure_slope_spin_inertia;

/* The least coefficient of friction with which it holds, with the sign of the friction; not a number where nothing presses. */
static inline double pm_measured_needed(double normal, double friction)
{
    return normal > 0 ? friction / normal : NAN;
}

#endif

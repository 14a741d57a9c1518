/* teeth.c - which flanks are loaded.  What changes with them is how the teeth are pressed apart, and not the motion: what holds
 * the wheels at their distance takes that up. */
#include "elements/teeth.h"

#include "elements/joint.h"
#include "numerics/tolerances.h"

int pm_teeth_mesh(const pm_model *m, const pm_state *state, int joint)
{
    return pm_joint_of(m, joint)->flanks && !pm_state_is_absent(m, state, PM_TABLE_JOINT, joint);
}

double pm_teeth_pressed(const pm_workspace *w, int joint)
{
    return pm_reaction(w, w->active.of_joint[w->model->joint_constraint[joint]]);
}

void pm_teeth_turn(pm_workspace *w, int joint)
{
    pm_memory *memory = &w->state.memory[w->model->joint_memory[joint]];
    memory->direction = -pm_teeth_loaded(memory);
}

int pm_teeth_turn_pulling(pm_workspace *w, double slack)
{
    int turned = 0;
    for (int i = 0; w->model->nteeth > 0 && i < w->model->rows[PM_TABLE_JOINT]; i++) {
        if (!pm_teeth_mesh(w->model, &w->state, i) || !(pm_teeth_pressed(w, i) < -slack)) continue;
        pm_teeth_turn(w, i);
        turned = 1;
    }
    return turned;
}

int pm_teeth_turn_struck(pm_workspace *w)
{
    double greatest = 0;
    int turned = 0;
    if (w->model->nteeth == 0) return 0;
    for (int i = 0; i < w->model->njoint_constraint; i++)
        greatest = fmax(greatest, fabs(w->impulses.joint[i]));
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        const double impulse = w->impulses.joint[w->model->joint_constraint[i]];
        if (!pm_teeth_mesh(w->model, &w->state, i)) continue;
        w->impulses.flank[i] = pm_teeth_loaded(&w->state.memory[w->model->joint_memory[i]]);
        if (!(impulse < -PM_PULLS * greatest)) continue;
        pm_teeth_turn(w, i);
        turned = 1;
    }
    return turned;
}

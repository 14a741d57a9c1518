/* build.c - flat tables -> immutable structure: what is numbered, and what the programs read, once per scene. */
#include "scene/build.h"

#include <stdlib.h>

#include "elements/force.h"
#include "elements/joint.h"
#include "elements/turning_plane.h"
#include "expression/program_class.h"
#include "expression/program_fold.h"
#include "scene/program_grade.h"
#include "scene/reference.h"
#include "state/arena.h"
#include "state/model.h"

int pm_model_is_driven(const pm_model *m)
{
    int table, row;
    return pm_reference_drive(m, 0, &table, &row) != PM_NONE;
}

/* Numbers constraints, slots, memories and running integrals. */
static void lay_out(pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        const pm_joint_ops *ops = pm_joint_of(m, i);
        m->joint_constraint[i] = m->njoint_constraint;
        m->joint_memory[i] = ops->memories + ops->feet > 0 ? m->nmemory : PM_NONE;
        m->nmemory += ops->memories + ops->feet;
        m->njoint_constraint += ops->nconstraint;
        m->nteeth += ops->flanks;
    }
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        const int32_t *e = PM_CONTACT_ROW(m, i);
        const int kind = e[PM_CONTACT_KIND];
        const int several =
            kind == PM_CONTACT_PATTERN || kind == PM_CONTACT_CURVE || kind == PM_CONTACT_CURVES;
        const int slots = several ? PM_PATTERN_SLOTS : 1;
        m->nedge += e[PM_CONTACT_KIND] == PM_CONTACT_SEGMENT;
        m->contact_slot[i] = m->nslot;
        for (int k = 0; k < slots; k++) m->contact_of_slot[m->nslot++] = i;
        m->contact_kept[i] = e[PM_CONTACT_CAPTURE] == PM_CAPTURE_NONE ? PM_NONE : m->nkept;
        if (e[PM_CONTACT_CAPTURE] != PM_CAPTURE_NONE) m->nkept += slots;
    }
    m->contact_slot[m->rows[PM_TABLE_CONTACT]] = m->nslot;
    m->friction_memory = m->nmemory;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        if (PM_FORCE_ROW(m, i)[PM_FORCE_KIND] == PM_FORCE_FRICTION) m->friction_force[m->nfriction++] = i;
    m->nmemory += m->nfriction + m->nslot; /* the slots' memories come last */
    m->nconstraint = m->njoint_constraint + 2 * m->nslot + m->nkept + m->nfriction;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        m->force_z[i] = pm_force_of(m, i)->stores ? PM_NONE : m->nz++;
    m->nz_work = m->nz;
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++) {
        m->path_z[i] = PM_NONE;
        if (PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND] != PM_MEASURE_PATH) continue;
        m->path_z[i] = m->nz++;
        m->path[m->npath++] = i;
    }
    pm_turning_plane_lay_out(m);
    m->nz_controlled = m->nz;
    m->nz += 1 + PM_LEDGER; /* work of sliding friction and of drives, then the outer impulses */
}

static void look_for_actions(pm_model *m)
{
    m->nelement = m->rows[PM_TABLE_JOINT] + m->rows[PM_TABLE_CONTACT] + m->rows[PM_TABLE_FORCE];
    for (int i = 0; i < m->rows[PM_TABLE_ACTION]; i++) m->acts |= PM_ACTION_ROW(m, i)[PM_ACTION_EVENT] >= 0;
    for (int i = 0; i < m->rows[PM_TABLE_EVENT]; i++) m->acts |= PM_EVENT_ROW(m, i)[PM_EVENT_NTH] > 0;
}

/* Whether a scene at rest may still see something happen: a force, a drive or a trigger that depends on time. */
static void look_for_time(pm_model *m)
{
    int table, row, program;
    m->programs.use_time |= m->spin_z != PM_NONE || m->spin_angle_z != PM_NONE;
    for (int k = 0; (program = pm_reference_drive(m, k, &table, &row)) != PM_NONE; k++)
        m->programs.use_time |= pm_program_class_reads_time(m, program);
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++)
        for (int k = 0; k < pm_force_of(m, i)->programs; k++)
            m->programs.use_time |=
                pm_program_class_reads_time(m, PM_FORCE_ROW(m, i)[PM_FORCE_PROGRAM_X + k]);
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        if (e[PM_TRIGGER_KIND] <= PM_TRIGGER_EVERY)
            m->programs.use_time |= pm_program_class_reads_time(m, e[PM_TRIGGER_PROGRAM]);
    }
}

static int by_place(const pm_model *m, int program)
{
    const int class = m->programs.class[program];
    return class == PM_CLASS_CONSTANT || class == PM_CLASS_PLACE;
}

/* Whether work depends on the way alone: springs, and applied forces and couples that read no motion and no time.  The
 * angle of a spin needs the time. */
static void look_at_forces(pm_model *m)
{
    m->programs.forces_by_place = m->spin_z == PM_NONE && m->spin_angle_z == PM_NONE;
    for (int i = 0; i < m->rows[PM_TABLE_FORCE]; i++) {
        const pm_force_ops *ops = pm_force_of(m, i);
        m->programs.forces_by_place &= ops->stores || ops->programs > 0;
        for (int k = 0; k < ops->programs; k++)
            m->programs.forces_by_place &= by_place(m, PM_FORCE_ROW(m, i)[PM_FORCE_PROGRAM_X + k]);
    }
    m->programs.cacheable =
        m->programs.forces_by_place && !m->acts && m->nfriction == 0 && !pm_model_is_driven(m);
}

/* A program that is watched within steps: it may read the time, or the count or time of an event, which jumps where one is
 * marked. */
static void look_at_watched(pm_model *m, int program)
{
    m->programs.sample_time |= pm_program_class_reads_time(m, program);
    m->programs.watch_counts |= pm_program_class_reads_counts(m, program);
}

static void look_at_programs(pm_model *m)
{
    for (int i = 0; i < m->rows[PM_TABLE_PROGRAM]; i++)
        m->programs.read_time |= pm_program_class_reads_time(m, i);
    m->programs.read_time |= PM_SETTING(m, PM_SETTING_MAX_TIME) >= 0;
    for (int i = 0; i < m->rows[PM_TABLE_MEASURE]; i++)
        m->programs.read_impulses |= PM_MEASURE_ROW(m, i)[PM_MEASURE_KIND] == PM_MEASURE_CONTACT_IMPULSE;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++)
        if (PM_TRIGGER_ROW(m, i)[PM_TRIGGER_PROGRAM] >= 0)
            look_at_watched(m, PM_TRIGGER_ROW(m, i)[PM_TRIGGER_PROGRAM]);
    m->programs.wait_for_counts = m->programs.watch_counts;
    for (int i = 0; i < m->nask; i++) {
        const int32_t *e = PM_ASK_ROW(m, i);
        if (!pm_model_ask_watches(e)) continue;
        m->programs.integrals |= pm_model_ask_is_integral(e);
        look_at_watched(m, e[PM_ASK_PROGRAM]);
        if (e[PM_ASK_PROGRAM_2] >= 0) look_at_watched(m, e[PM_ASK_PROGRAM_2]);
    }
}

static int create_arrays(pm_model *m)
{
    const int njoint = m->rows[PM_TABLE_JOINT], ncontact = m->rows[PM_TABLE_CONTACT],
              nforce = m->rows[PM_TABLE_FORCE], nmeasure = m->rows[PM_TABLE_MEASURE],
              nprogram = m->rows[PM_TABLE_PROGRAM];
    const pm_array array[] = {
        PM_ARRAY(m->contact_slot, ncontact + 1),
        PM_ARRAY(m->contact_of_slot, PM_PATTERN_SLOTS * ncontact),
        PM_ARRAY(m->contact_kept, ncontact),
        PM_ARRAY(m->joint_constraint, njoint),
        PM_ARRAY(m->joint_memory, njoint),
        PM_ARRAY(m->force_z, nforce),
        PM_ARRAY(m->friction_force, nforce),
        PM_ARRAY(m->path_z, nmeasure),
        PM_ARRAY(m->path, nmeasure),
        PM_ARRAY(m->programs.level, nprogram),
        PM_ARRAY(m->programs.class, nprogram),
        PM_ARRAY(m->programs.energy, nprogram),
    };
    const int status = pm_arena_take(&m->memory, PM_ARRAYS(array));
    return status ? status : pm_program_fold_create(m);
}

static void fill(pm_model *m)
{
    lay_out(m);
    look_for_actions(m);
    pm_program_grade_all(m);
    look_for_time(m);
    look_at_programs(m);
    look_at_forces(m);
}

int pm_model_create(int64_t ntable, const int32_t *table, int64_t nconstant, const double *constant,
                    int64_t nparam, pm_model **model, pm_where *where)
{
    pm_model *m = calloc(1, sizeof *m);
    *model = NULL;
    if (!m) return PM_NO_MEMORY;
    m->constant = constant;
    m->nconstant = (int)nconstant;
    m->nparam = (int)nparam;
    int status = pm_check_directory(m, ntable, table, where);
    if (!status) status = pm_check_tables(m, where);
    if (!status) status = create_arrays(m);
    if (status) {
        pm_model_free(m);
        return status;
    }
    fill(m);
    *model = m;
    return PM_OK;
}

void pm_model_free(pm_model *model)
{
    if (!model) return;
    pm_arena_free(&model->memory);
    pm_program_fold_free(model);
    free(model->prune.table);
    free(model);
}

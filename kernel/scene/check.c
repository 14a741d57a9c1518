/* check.c - the tables of a scene against planemotion.h.  Every index is checked here, once, so that the rest of the kernel
 * may trust the tables; what contradicts is PM_BAD_TABLE with table, row, value and bound. */
#include "scene/build.h"

#include "elements/contact.h"
#include "elements/measure.h"
#include "expression/piecewise.h"
#include "expression/program.h"
#include "scene/reference.h"

int pm_check_directory(pm_model *m, int64_t ntable, const int32_t *table, pm_where *where)
{
    if (ntable < 2 * PM_TABLES) return pm_bad_table(where, PM_NONE, 0, (double)ntable, 2 * PM_TABLES);
    for (int i = 0; i < PM_TABLES; i++) {
        const int64_t first = table[2 * i], rows = table[2 * i + 1];
        if (first < 0 || rows < 0 || first + rows * pm_reference_columns[i] > ntable)
            return pm_bad_table(where, i, PM_NONE, (double)(first + rows * pm_reference_columns[i]),
                                (double)ntable);
        m->table[i] = table + first;
        m->rows[i] = (int)rows;
    }
    m->nbody = m->rows[PM_TABLE_BODY];
    m->nq = 3 * m->nbody;
    m->nvalue = m->rows[PM_TABLE_VALUE];
    m->nask = m->rows[PM_TABLE_ASK];
    return m->rows[PM_TABLE_SETTING] == 1
               ? PM_OK
               : pm_bad_table(where, PM_TABLE_SETTING, PM_NONE, m->rows[PM_TABLE_SETTING], 1);
}

/* Kinds and counts: what stands in a column lies between low and high; `told` is the bound that is told otherwise. */
typedef struct pm_span {
    int table, column, low, high, told;
} pm_span;

static const pm_span spans[] = {
    {PM_TABLE_CURVE, PM_CURVE_CLOSED, 0, PM_CURVE_CLOSINGS - 1, PM_CURVE_CLOSINGS},
    {PM_TABLE_CURVE, PM_CURVE_SIDE, -1, 1, 1},
    {PM_TABLE_CONTACT, PM_CONTACT_FRICTION, PM_FRICTION_SMOOTH, PM_FRICTION_ROUGH, PM_FRICTION_ROUGH},
    {PM_TABLE_CONTACT, PM_CONTACT_LAW, PM_LAW_NEWTON, PM_LAWS - 1, PM_LAWS},
    {PM_TABLE_CONTACT, PM_CONTACT_PAINLEVE, 0, PM_PAINLEVE_KINDS - 1, PM_PAINLEVE_KINDS},
    {PM_TABLE_TRIGGER, PM_TRIGGER_KIND, 0, PM_TRIGGER_KINDS - 1, PM_TRIGGER_KINDS},
    {PM_TABLE_ASK, PM_ASK_KIND, 0, PM_ASK_KINDS - 1, PM_ASK_KINDS},
    {PM_TABLE_UNTIL, PM_UNTIL_NTH, 1, INT32_MAX, 1},
    {PM_TABLE_EVENT, PM_EVENT_NTH, 0, INT32_MAX, 0},
    {PM_TABLE_EVENT, PM_EVENT_EFFECT, PM_EFFECT_NONE, PM_EFFECTS - 1, PM_EFFECTS},
    {PM_TABLE_PIECEWISE, PM_PIECEWISE_KNOTS, 2, INT32_MAX / 8, 2},
    {PM_TABLE_PIECEWISE, PM_PIECEWISE_DEGREE_OF, 0, PM_PIECEWISE_DEGREE, PM_PIECEWISE_DEGREE},
    {PM_TABLE_PIECEWISE, PM_PIECEWISE_BEYOND, 0, PM_BEYOND_KINDS - 1, PM_BEYOND_KINDS},
    {PM_TABLE_ACTION, PM_ACTION_KIND, 0, PM_ACTION_KINDS - 1, PM_ACTION_KINDS},
    {PM_TABLE_SETTING, PM_SETTING_ROUTE, 0, PM_ROUTES - 1, PM_ROUTES},
    {PM_TABLE_SETTING, PM_SETTING_ESTIMATE, 0, 1, 1},
    {PM_TABLE_SETTING, PM_SETTING_SIMULTANEOUS, 0, PM_SIMULTANEOUS_KINDS - 1, PM_SIMULTANEOUS_KINDS},
    {PM_TABLE_SETTING, PM_SETTING_SHARED, 0, PM_SHARED_SETTINGS - 1, PM_SHARED_SETTINGS},
    {PM_TABLE_SETTING, PM_SETTING_EQUILIBRIUM, 0, 1, 1},
    {PM_TABLE_SETTING, PM_SETTING_MAX_EVENTS, 1, INT32_MAX, 1},
    {PM_TABLE_SETTING, PM_SETTING_MAX_STEPS, 1, INT32_MAX, 1},
    {PM_TABLE_FIND, PM_FIND_GOAL, 0, PM_FIND_GOALS - 1, PM_FIND_GOALS},
    {PM_TABLE_CONDITION, PM_CONDITION_KIND, 0, PM_CONDITION_KINDS - 1, PM_CONDITION_KINDS},
};

static int check_spans(const pm_model *m, pm_where *where)
{
    for (size_t k = 0; k < sizeof spans / sizeof *spans; k++) {
        const pm_span *x = &spans[k];
        for (int i = 0; i < m->rows[x->table]; i++) {
            const int value = pm_model_row(m, x->table, i, pm_reference_columns[x->table])[x->column];
            if (value < x->low || value > x->high) return pm_bad_table(where, x->table, i, value, x->told);
        }
    }
    return PM_OK;
}

/* A contact that captures has no other law; two points must. */
static int captures_soundly(const int32_t *e)
{
    const int kind = e[PM_CONTACT_KIND], capture = e[PM_CONTACT_CAPTURE];
    if (capture == PM_CAPTURE_NONE) return kind != PM_CONTACT_POINT;
    return capture > PM_CAPTURE_NONE && capture < PM_CAPTURES && kind != PM_CONTACT_CORD &&
           kind < PM_CONTACT_TEETH && e[PM_CONTACT_FRICTION] == PM_FRICTION_SMOOTH && e[PM_CONTACT_SPEED] < 0;
}

static int is_sense(int32_t x) { return x == 1 || x == -1; }

/* A cord over a rim passes that, too, and may have friction there; its blows are those of Newton's law.  A
 * flank has friction by a lever.  Nothing else that measures itself has any. */
static int slips_soundly(const pm_model *m, int contact)
{
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    if (e[PM_CONTACT_LEVER] != PM_NONE)
        return pm_contact_has_flank(m, contact) && e[PM_CONTACT_FRICTION] == PM_FRICTION_COULOMB &&
               e[PM_CONTACT_RIM] == PM_NONE;
    if (e[PM_CONTACT_RIM] == PM_NONE)
        return !pm_contact_measures_itself(m, contact) || e[PM_CONTACT_FRICTION] == PM_FRICTION_SMOOTH;
    return pm_contact_is_cord(m, contact) && e[PM_CONTACT_FRICTION] != PM_FRICTION_ROUGH &&
           is_sense(e[PM_CONTACT_SENSE_RIM]) && e[PM_CONTACT_TURNS] >= 0 &&
           e[PM_CONTACT_LAW] == PM_LAW_NEWTON;
}

/* What measures itself at the start has a slack and a sense; what has flanks, a pressure angle. */
static int check_slack(const pm_model *m, int contact, pm_where *where)
{
    const int32_t *e = PM_CONTACT_ROW(m, contact);
    const int flank = e[PM_CONTACT_KIND] == PM_CONTACT_TEETH || e[PM_CONTACT_KIND] == PM_CONTACT_RACK;
    if (e[PM_CONTACT_SLACK] < 0)
        return pm_bad_table(where, PM_TABLE_CONTACT, contact, e[PM_CONTACT_SLACK], 0);
    if (flank && (e[PM_CONTACT_PRESSURE] < 0 || e[PM_CONTACT_LAW] != PM_LAW_NEWTON))
        return pm_bad_table(where, PM_TABLE_CONTACT, contact, e[PM_CONTACT_PRESSURE], 0);
    if (e[PM_CONTACT_KIND] == PM_CONTACT_TEETH && e[PM_CONTACT_SIDE] < 0)
        return pm_bad_table(where, PM_TABLE_CONTACT, contact, PM_NONE, 0);
    for (int k = PM_CONTACT_SENSE_A; k <= PM_CONTACT_SENSE_B; k++)
        if (!is_sense(e[k])) return pm_bad_table(where, PM_TABLE_CONTACT, contact, e[k], 1);
    return PM_OK;
}

static int check_contacts(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->rows[PM_TABLE_CONTACT]; i++) {
        const int32_t *e = PM_CONTACT_ROW(m, i);
        const int friction = e[PM_CONTACT_FRICTION];
        if (!captures_soundly(e))
            return pm_bad_table(where, PM_TABLE_CONTACT, i, e[PM_CONTACT_CAPTURE], PM_CAPTURES);
        if (!slips_soundly(m, i)) return pm_bad_table(where, PM_TABLE_CONTACT, i, e[PM_CONTACT_RIM], PM_NONE);
        if (friction == PM_FRICTION_COULOMB && (e[PM_CONTACT_STATIC] < 0 || e[PM_CONTACT_KINETIC] < 0))
            return pm_bad_table(where, PM_TABLE_CONTACT, i, PM_NONE, 0);
        if (e[PM_CONTACT_KIND] == PM_CONTACT_CIRCLE && e[PM_CONTACT_SIDE] < 0)
            return pm_bad_table(where, PM_TABLE_CONTACT, i, PM_NONE, 0);
        const int segment = e[PM_CONTACT_KIND] == PM_CONTACT_SEGMENT;
        if (segment && (e[PM_CONTACT_FROM] < 0 || e[PM_CONTACT_TO] < 0))
            return pm_bad_table(where, PM_TABLE_CONTACT, i, PM_NONE, 0);
        if (e[PM_CONTACT_SPEED] >= 0 && e[PM_CONTACT_KIND] != PM_CONTACT_LINE && !segment)
            return pm_bad_table(where, PM_TABLE_CONTACT, i, e[PM_CONTACT_SPEED], PM_NONE);
        const int law = e[PM_CONTACT_LAW];
        if (e[PM_CONTACT_TANGENTIAL] >= 0 && (friction == PM_FRICTION_SMOOTH || law != PM_LAW_NEWTON))
            return pm_bad_table(where, PM_TABLE_CONTACT, i, e[PM_CONTACT_TANGENTIAL], PM_NONE);
        if (e[PM_CONTACT_STIFFNESS] >= 0 && law != PM_LAW_STRONGE)
            return pm_bad_table(where, PM_TABLE_CONTACT, i, e[PM_CONTACT_STIFFNESS], PM_NONE);
        const int status = pm_contact_measures_itself(m, i) ? check_slack(m, i, where) : PM_OK;
        if (status) return status;
    }
    return PM_OK;
}

static int check_triggers(const pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        const int kind = e[PM_TRIGGER_KIND], a = e[PM_TRIGGER_A];
        if (kind <= PM_TRIGGER_EVERY && e[PM_TRIGGER_PROGRAM] < 0)
            return pm_bad_table(where, PM_TABLE_TRIGGER, i, e[PM_TRIGGER_PROGRAM], 0);
        if (kind >= PM_TRIGGER_STRIKE && kind <= PM_TRIGGER_STICK &&
            !pm_reference_in_range(m, PM_TABLE_CONTACT, a))
            return pm_bad_table(where, PM_TABLE_TRIGGER, i, a, m->rows[PM_TABLE_CONTACT]);
        if (kind >= PM_TRIGGER_JOINT_SLIP && !pm_reference_in_range(m, PM_TABLE_JOINT, a))
            return pm_bad_table(where, PM_TABLE_TRIGGER, i, a, m->rows[PM_TABLE_JOINT]);
        if (kind == PM_TRIGGER_REST && a != PM_NONE && (a < 0 || a >= m->nbody))
            return pm_bad_table(where, PM_TABLE_TRIGGER, i, a, m->nbody);
    }
    return PM_OK;
}

/* What forces read of an event is told by programs: of a switch by the rise and the fall of one, of a piece by its ends. */
static int check_effect(const pm_model *m, int event, pm_where *where)
{
    const int effect = PM_EVENT_ROW(m, event)[PM_EVENT_EFFECT];
    int program[2] = {PM_NONE, PM_NONE}; /* that rises, that falls */
    if (effect != PM_EFFECT_SWITCH && effect != PM_EFFECT_PIECE) return PM_OK;
    for (int i = 0; i < m->rows[PM_TABLE_TRIGGER]; i++) {
        const int32_t *e = PM_TRIGGER_ROW(m, i);
        const int kind = e[PM_TRIGGER_KIND], falls = kind == PM_TRIGGER_FALL;
        if (e[PM_TRIGGER_EVENT] != event) continue;
        if ((kind != PM_TRIGGER_RISE && !falls) || program[falls] != PM_NONE)
            return pm_bad_table(where, PM_TABLE_TRIGGER, i, kind, PM_TRIGGER_FALL);
        program[falls] = e[PM_TRIGGER_PROGRAM];
    }
    const int whole = program[0] >= 0 && program[1] >= 0;
    return whole && (effect == PM_EFFECT_PIECE || program[0] == program[1])
               ? PM_OK
               : pm_bad_table(where, PM_TABLE_EVENT, event, program[1], program[0]);
}

static int check_events(const pm_model *m, pm_where *where)
{
    int status = PM_OK;
    for (int i = 0; !status && i < m->rows[PM_TABLE_EVENT]; i++) status = check_effect(m, i, where);
    return status;
}

static int check_asks(pm_model *m, pm_where *where)
{
    for (int i = 0; i < m->nask; i++) {
        const int32_t *e = PM_ASK_ROW(m, i);
        const int kind = e[PM_ASK_KIND], count = e[PM_ASK_COUNT];
        if (kind == PM_ASK_EVENT && e[PM_ASK_NTH] < 1)
            return pm_bad_table(where, PM_TABLE_ASK, i, e[PM_ASK_NTH], 1);
        if (count < 1 || e[PM_ASK_OUT] != m->nout)
            return pm_bad_table(where, PM_TABLE_ASK, i, e[PM_ASK_OUT], m->nout);
        if (kind != PM_ASK_GRID && kind != PM_ASK_EACH && count != 1)
            return pm_bad_table(where, PM_TABLE_ASK, i, count, 1);
        if ((kind == PM_ASK_EVENT || kind == PM_ASK_EACH) && e[PM_ASK_EVENT_INDEX] < 0)
            return pm_bad_table(where, PM_TABLE_ASK, i, e[PM_ASK_EVENT_INDEX], m->rows[PM_TABLE_EVENT]);
        if ((kind == PM_ASK_AT_MAX || kind == PM_ASK_AT_MIN || kind == PM_ASK_GRID) &&
            e[PM_ASK_PROGRAM_2] < 0)
            return pm_bad_table(where, PM_TABLE_ASK, i, e[PM_ASK_PROGRAM_2], m->rows[PM_TABLE_PROGRAM]);
        if (kind == PM_ASK_PERCENTILE && e[PM_ASK_FIRST_VALUE] < 0)
            return pm_bad_table(where, PM_TABLE_ASK, i, e[PM_ASK_FIRST_VALUE], 0);
        if (kind == PM_ASK_GRID && (e[PM_ASK_FIRST_VALUE] < 0 || e[PM_ASK_FIRST_VALUE] > m->nvalue - count))
            return pm_bad_table(where, PM_TABLE_ASK, i, (double)e[PM_ASK_FIRST_VALUE] + count, m->nvalue);
        if (count > INT32_MAX - m->nout) return pm_bad_table(where, PM_TABLE_ASK, i, count, INT32_MAX);
        m->nout += count;
    }
    return PM_OK;
}

/* Which table column a of an action points into; which programs it needs. */
static int check_action(const pm_model *m, int i, pm_where *where)
{
    const int32_t *e = PM_ACTION_ROW(m, i);
    const int kind = e[PM_ACTION_KIND], of = e[PM_ACTION_TABLE], a = e[PM_ACTION_A];
    if (e[PM_ACTION_EVENT] == PM_NONE && kind != PM_ACTION_REMOVE)
        return pm_bad_table(where, PM_TABLE_ACTION, i, kind, PM_ACTION_REMOVE);
    if (kind <= PM_ACTION_REMOVE) {
        if (of != PM_TABLE_JOINT && of != PM_TABLE_CONTACT && of != PM_TABLE_FORCE)
            return pm_bad_table(where, PM_TABLE_ACTION, i, of, PM_TABLE_FORCE);
        return pm_reference_in_range(m, of, a) ? PM_OK
                                               : pm_bad_table(where, PM_TABLE_ACTION, i, a, m->rows[of]);
    }
    if (of != PM_NONE) return pm_bad_table(where, PM_TABLE_ACTION, i, of, PM_NONE);
    if (kind == PM_ACTION_NUDGE) {
        const int program = e[PM_ACTION_PROGRAM_X];
        if (a != PM_NONE) return pm_bad_table(where, PM_TABLE_ACTION, i, a, PM_NONE);
        return program >= 0 ? PM_OK
                            : pm_bad_table(where, PM_TABLE_ACTION, i, program, m->rows[PM_TABLE_PROGRAM]);
    }
    const int at = kind == PM_ACTION_IMPULSE ? PM_TABLE_POINT : PM_TABLE_BODY;
    if (a < 0 || a >= m->rows[at]) return pm_bad_table(where, PM_TABLE_ACTION, i, a, m->rows[at]);
    const int rotates = kind == PM_ACTION_IMPULSE || PM_BODY_ROW(m, a)[PM_BODY_ROTATES];
    if (!rotates) return pm_bad_table(where, PM_TABLE_ACTION, i, a, PM_BODY_ROTATES);
    for (int k = 0; k < (kind == PM_ACTION_IMPULSE ? 2 : 1); k++)
        if (e[PM_ACTION_PROGRAM_X + k] < 0)
            return pm_bad_table(where, PM_TABLE_ACTION, i, e[PM_ACTION_PROGRAM_X + k],
                                m->rows[PM_TABLE_PROGRAM]);
    return PM_OK;
}

static int check_actions(const pm_model *m, pm_where *where)
{
    int status = PM_OK;
    for (int i = 0; !status && i < m->rows[PM_TABLE_ACTION]; i++) status = check_action(m, i, where);
    return status;
}

/* A find: one or two parameters, and as many conditions ZERO as it needs. */
static int check_find(const pm_model *m, pm_where *where)
{
    const int nvary = m->rows[PM_TABLE_VARY], nfind = m->rows[PM_TABLE_FIND];
    if (nfind > 1) return pm_bad_table(where, PM_TABLE_FIND, 1, nfind, 1);
    if (nfind == 0) return PM_OK;
    const int32_t *find = PM_FIND_ROW(m, 0);
    if (nvary < 1 || nvary > PM_FIND_MOST)
        return pm_bad_table(where, PM_TABLE_VARY, PM_NONE, nvary, PM_FIND_MOST);
    const int most = nvary == 2 ? PM_FIND_MOST_PAIR_SAMPLES : PM_FIND_MOST_SAMPLES;
    if (find[PM_FIND_SAMPLES] < 2 || find[PM_FIND_SAMPLES] > most)
        return pm_bad_table(where, PM_TABLE_FIND, 0, find[PM_FIND_SAMPLES], most);
    for (int i = 0; i < nvary; i++) {
        const int parameter = PM_VARY_ROW(m, i)[PM_VARY_PARAMETER];
        if (parameter < 0 || parameter >= m->nparam)
            return pm_bad_table(where, PM_TABLE_VARY, i, parameter, m->nparam);
    }
    int zeros = 0;
    if (m->rows[PM_TABLE_CONDITION] > PM_FIND_MOST_CONDITIONS)
        return pm_bad_table(where, PM_TABLE_CONDITION, PM_NONE, m->rows[PM_TABLE_CONDITION],
                            PM_FIND_MOST_CONDITIONS);
    for (int i = 0; i < m->rows[PM_TABLE_CONDITION]; i++)
        zeros += PM_CONDITION_ROW(m, i)[PM_CONDITION_KIND] == PM_CONDITION_ZERO;
    const int fewest = nvary == 2 || find[PM_FIND_GOAL] == PM_FIND_VALUE ? nvary : 0;
    return zeros < fewest || zeros > nvary ? pm_bad_table(where, PM_TABLE_CONDITION, PM_NONE, zeros, nvary)
                                           : PM_OK;
}

int pm_check_tables(pm_model *m, pm_where *where)
{
    int status = pm_reference_check(m, where);
    if (!status) status = check_spans(m, where);
    if (!status) status = check_contacts(m, where);
    if (!status) status = check_triggers(m, where);
    if (!status) status = check_events(m, where);
    if (!status) status = check_asks(m, where);
    if (!status) status = check_actions(m, where);
    if (!status) status = check_find(m, where);
    if (!status) status = pm_measure_validate(m, where);
    if (!status) status = pm_piecewise_check(m, where);
    if (!status) status = pm_program_validate(m, where);
    if (!status) status = pm_check_reads(m, where);
    return status;
}

/* dependency.c - what the answers of a run depend on.
 *
 * Bodies that a joint, a contact or a force lets act on each other are one island, whether the contact ever closes or
 * not; the ground connects nothing, it does not move.  Needed are the asks, the end of the run, what is sought and the
 * settings; then, until nothing more comes,
 *   - what a needed row refers to: a force that reads another body needs that body, though it is not acted on;
 *   - with a body its island, all that acts on it, its marks and its start values;
 *   - with an event its triggers; with an element or a body what events do to it, and so these events.
 * Some answers are about all that there is: energy and momentum of the whole scene, rest of it, what happened in the last
 * jump wherever it was, a plane that turns with everything in it.  Then nothing is left out.
 *
 * What is left out has no way to change a needed number: the system of equations falls apart into one for each island, and
 * the coupling by the events is among the references.  The ledger of the audit is that of the islands that are computed. */
#include "scene/dependency.h"

#include <stdlib.h>

#include "elements/measure.h"
#include "numerics/islands.h"
#include "scene/reference.h"

/* ---- islands ---- */
enum { BODIES = 3 }; /* most that one acts on */

static void unite(pm_dependency *x, const int body[BODIES])
{
    for (int k = 0; k < BODIES; k++)
        for (int n = 0; n < k; n++)
            if (body[k] >= 0 && body[n] >= 0) pm_islands_join(x->island, body[k], body[n]);
}

/* The bodies that a joint, contact or force acts on.  An applied force only takes its axes from its second one. */
static void bodies_of(const pm_model *m, int table, int row, int body[BODIES])
{
    const int32_t *e = pm_model_row(m, table, row, pm_reference_columns[table]);
    if (table == PM_TABLE_FORCE && e[PM_FORCE_KIND] == PM_FORCE_FRICTION) {
        bodies_of(m, PM_TABLE_JOINT, e[PM_FORCE_A], body);
        return;
    }
    int of[PM_REFERENCES];
    const int alone = table == PM_TABLE_FORCE && e[PM_FORCE_KIND] == PM_FORCE_APPLIED;
    const int n = pm_reference_bodies(m, table, row, of);
    for (int k = 0; k < BODIES; k++) body[k] = k < n && !(alone && k == 1) ? of[k] : PM_GROUND;
}

static const int elements[] = {PM_TABLE_JOINT, PM_TABLE_CONTACT, PM_TABLE_FORCE};
enum { NELEMENTS = sizeof elements / sizeof *elements };

static void find_islands(const pm_model *m, pm_dependency *x)
{
    pm_islands_begin(x->island, m->nbody);
    for (int k = 0; k < NELEMENTS; k++)
        for (int i = 0; i < m->rows[elements[k]]; i++) {
            int body[BODIES];
            bodies_of(m, elements[k], i, body);
            unite(x, body);
        }
}

/* ---- marking ---- */
enum { MARKED = 1, FOLLOWED = 2 };

static int mark(pm_dependency *x, int table, int row)
{
    if (x->row[table][row]) return 0;
    x->row[table][row] = MARKED;
    return 1;
}

static int mark_range(pm_dependency *x, int table, int first, int count)
{
    int more = 0;
    for (int i = first; i < first + count; i++) more |= mark(x, table, i);
    return more;
}

static int is_about_everything(int table, const int32_t *e)
{
    if (table == PM_TABLE_SPIN) return 1;
    if (table == PM_TABLE_TRIGGER) return e[PM_TRIGGER_KIND] == PM_TRIGGER_REST;
    if (table != PM_TABLE_MEASURE) return 0;
    const int flags = pm_measure_kind(e[PM_MEASURE_KIND])->flags;
    return (flags & PM_MEASURE_OF_ALL) || ((flags & PM_MEASURE_OR_ALL) && e[PM_MEASURE_A] == PM_NONE);
}

/* What row i of a table refers to. */
static int follow(const pm_model *m, pm_dependency *x, int table, int i)
{
    const int32_t *e = pm_model_row(m, table, i, pm_reference_columns[table]);
    pm_reference ref[PM_REFERENCES];
    int more = 0;
    const int n = pm_reference_of(m, table, i, ref);
    x->row[table][i] = FOLLOWED;
    x->everything |= is_about_everything(table, e);
    for (int k = 0; k < n; k++) more |= mark(x, ref[k].of, ref[k].index);
    if (table == PM_TABLE_PROGRAM)
        more |= mark_range(x, PM_TABLE_CODE, e[PM_PROGRAM_FIRST], e[PM_PROGRAM_LENGTH]);
    if (table == PM_TABLE_ASK && e[PM_ASK_KIND] == PM_ASK_GRID)
        more |= mark_range(x, PM_TABLE_VALUE, e[PM_ASK_FIRST_VALUE], e[PM_ASK_COUNT]);
    return more;
}

static int follow_all(const pm_model *m, pm_dependency *x)
{
    int more = 0;
    for (int table = PM_TABLES - 1; table >= 0; table--) /* against the order in which they refer, mostly */
        for (int i = 0; i < m->rows[table]; i++)
            if (x->row[table][i] == MARKED) more |= follow(m, x, table, i);
    return more;
}

static int is_needed_body(const pm_dependency *x, int body)
{
    return body >= 0 && x->row[PM_TABLE_BODY][body];
}

static int add_islands(const pm_model *m, pm_dependency *x)
{
    int more = 0;
    for (int i = 0; i < m->nbody; i++)
        if (x->row[PM_TABLE_BODY][i]) more |= mark(x, PM_TABLE_BODY, pm_islands_root(x->island, i));
    for (int i = 0; i < m->nbody; i++)
        if (x->row[PM_TABLE_BODY][pm_islands_root(x->island, i)]) more |= mark(x, PM_TABLE_BODY, i);
    return more;
}

/* ---- which rows of a table are needed with what is marked already ---- */
/* Marks of the ground cost nothing; of some that nothing refers to the scene takes its size. */
static int mark_is_needed(const pm_model *m, const pm_dependency *x, int table, int i)
{
    const int body = pm_model_body_of(m, table, i);
    return body == PM_GROUND || is_needed_body(x, body);
}

static int element_is_needed(const pm_model *m, const pm_dependency *x, int table, int i)
{
    int body[BODIES], needed = 0;
    bodies_of(m, table, i, body);
    for (int k = 0; k < BODIES; k++) needed |= is_needed_body(x, body[k]);
    return needed;
}

/* A start value relative to a body says something of both. */
static int start_is_needed(const pm_model *m, const pm_dependency *x, int table, int i)
{
    const int32_t *e = PM_MEASURE_ROW(m, pm_model_row(m, table, i, PM_START_COLUMNS)[PM_START_MEASURE]);
    const int body = pm_model_body_of(m, pm_measure_kind(e[PM_MEASURE_KIND])->of, e[PM_MEASURE_A]);
    return is_needed_body(x, body) || is_needed_body(x, e[PM_MEASURE_IN]);
}

/* Where a nudge leads nowhere the run says so. */
static int action_is_needed(const pm_model *m, const pm_dependency *x, int table, int i)
{
    const int32_t *e = pm_model_row(m, table, i, PM_ACTION_COLUMNS);
    const int kind = e[PM_ACTION_KIND], a = e[PM_ACTION_A];
    if (kind == PM_ACTION_NUDGE) return 1;
    if (kind <= PM_ACTION_REMOVE) return x->row[e[PM_ACTION_TABLE]][a];
    return is_needed_body(x,
                          pm_model_body_of(m, kind == PM_ACTION_IMPULSE ? PM_TABLE_POINT : PM_TABLE_BODY, a));
}

static int trigger_is_needed(const pm_model *m, const pm_dependency *x, int table, int i)
{
    return x->row[PM_TABLE_EVENT][pm_model_row(m, table, i, PM_TRIGGER_COLUMNS)[PM_TRIGGER_EVENT]];
}

static int reading_is_needed(const pm_model *m, const pm_dependency *x, int table, int i)
{
    return x->row[PM_TABLE_EVENT][pm_model_row(m, table, i, PM_READING_COLUMNS)[PM_READING_EVENT]];
}

static const struct {
    int table;
    int (*is_needed)(const pm_model *m, const pm_dependency *x, int table, int i);
} needs[] = {
    {PM_TABLE_POINT, mark_is_needed},      {PM_TABLE_LINE, mark_is_needed},
    {PM_TABLE_CIRCLE, mark_is_needed},     {PM_TABLE_PATTERN, mark_is_needed},
    {PM_TABLE_CURVE, mark_is_needed},      {PM_TABLE_JOINT, element_is_needed},
    {PM_TABLE_CONTACT, element_is_needed}, {PM_TABLE_FORCE, element_is_needed},
    {PM_TABLE_START, start_is_needed},     {PM_TABLE_ACTION, action_is_needed},
    {PM_TABLE_TRIGGER, trigger_is_needed}, {PM_TABLE_READING, reading_is_needed},
};

static int add_needed(const pm_model *m, pm_dependency *x)
{
    int more = 0;
    for (size_t k = 0; k < sizeof needs / sizeof *needs; k++)
        for (int i = 0; i < m->rows[needs[k].table]; i++)
            if (needs[k].is_needed(m, x, needs[k].table, i)) more |= mark(x, needs[k].table, i);
    return more;
}

static void mark_roots(const pm_model *m, pm_dependency *x)
{
    static const int roots[] = {PM_TABLE_ASK,  PM_TABLE_UNTIL,     PM_TABLE_SETTING, PM_TABLE_FIND,
                                PM_TABLE_VARY, PM_TABLE_CONDITION, PM_TABLE_SPIN};
    for (size_t k = 0; k < sizeof roots / sizeof *roots; k++) mark_range(x, roots[k], 0, m->rows[roots[k]]);
}

static int create(const pm_model *m, pm_dependency *x)
{
    size_t rows = 0;
    for (int i = 0; i < PM_TABLES; i++) rows += (size_t)m->rows[i];
    *x = (pm_dependency){.block = calloc(1, rows + (size_t)m->nbody * sizeof(int) + 1)};
    if (!x->block) return PM_NO_MEMORY;
    x->island = x->block;
    unsigned char *row = (unsigned char *)(x->island + m->nbody);
    for (int i = 0; i < PM_TABLES; row += m->rows[i++]) x->row[i] = row;
    return PM_OK;
}

int pm_dependency_find(const pm_model *m, pm_dependency *x)
{
    const int status = create(m, x);
    if (status) return status;
    find_islands(m, x);
    mark_roots(m, x);
    for (int more = 1; more && !x->everything;)
        more = follow_all(m, x) | add_islands(m, x) | add_needed(m, x);
    for (int i = 0; x->everything && i < PM_TABLES; i++) mark_range(x, i, 0, m->rows[i]);
    return PM_OK;
}

void pm_dependency_free(pm_dependency *x)
{
    free(x->block);
    *x = (pm_dependency){.block = NULL};
}

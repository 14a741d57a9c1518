/* recorded.c - a scene is autonomous: its parameters determine the run, so that it is recorded once, on a grid of times that
 * has the communication points.  The rows are the kernel's own dense output; a point between them takes another run. */
#include "recorded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "planemotion.h"

/* Rows that a record is first given room for, and numbers that it may have. */
#define FIRST_ROWS 4096
#define MOST_NUMBERS 100000000
/* Part of a step by which sums of steps miss its multiples. */
#define ROUNDING 1e-6

static int make_room(pm_recorded *record, int64_t rows, int64_t columns)
{
    double *row;
    int32_t *mark;
    if (rows <= record->room) return PM_OK;
    if (rows > MOST_NUMBERS / columns) return PM_NO_MEMORY;
    row = realloc(record->row, (size_t)(rows * columns) * sizeof *row);
    if (row) record->row = row;
    mark = realloc(record->mark, (size_t)rows * sizeof *mark);
    if (mark) record->mark = mark;
    if (!row || !mark) return PM_NO_MEMORY;
    record->room = rows;
    return PM_OK;
}

int pm_recorded_make(pm_recorded *record, const pm_scene_file *scene, double every)
{
    const int64_t columns = 1 + scene->noutput;
    int64_t needed = FIRST_ROWS;
    int32_t where[PM_WHERE_COLUMNS], stop[1] = {0};
    double detail[PM_DETAIL_COLUMNS], *bend = malloc((size_t)columns * sizeof *bend);
    if (!bend) return PM_NO_MEMORY;
    for (int64_t i = 0; i < columns; i++) bend[i] = INFINITY;
    do {
        if (make_room(record, needed, columns)) {
            free(bend);
            return PM_NO_MEMORY;
        }
        record->status = pm_trace(scene->ntable, scene->table, scene->nconstant, scene->constant,
                                  scene->nparam, scene->value, stop, every, scene->noutput, scene->program,
                                  bend, record->room, record->row, record->mark, &needed, where, detail);
    } while (needed > record->room);
    free(bend);
    record->rows = needed;
    record->every = every;
    record->end = needed > 0 ? record->row[(needed - 1) * columns] : 0;
    return PM_OK;
}

int pm_recorded_has(const pm_recorded *record, double t)
{
    const double steps = t / record->every, whole = round(steps);
    return record->rows > 0 && (t >= record->end || (whole >= 1 && fabs(steps - whole) < ROUNDING));
}

const double *pm_recorded_at(const pm_recorded *record, const pm_scene_file *scene, double t)
{
    const int64_t columns = 1 + scene->noutput;
    const double last = t + ROUNDING * fmin(t, record->every);
    int64_t low = 0, high = record->rows; /* rows before low are not later than t, those from high on are */
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (record->row[middle * columns] <= last)
            low = middle + 1;
        else
            high = middle;
    }
    return record->row + (low > 0 ? low - 1 : 0) * columns + 1;
}

void pm_recorded_free(pm_recorded *record)
{
    free(record->row);
    free(record->mark);
    memset(record, 0, sizeof *record);
}

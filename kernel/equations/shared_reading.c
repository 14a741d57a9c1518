/* shared_reading.c - a value is unique if no vector z changes it.  What rounding leaves of a change is seen beside the changes
 * that the entries of z make one by one. */
#include "equations/shared_reading.h"

#include <math.h>
#include <string.h>

#include "elements/constraint.h"
#include "elements/measure.h"
#include "equations/case.h"
#include "equations/shared_loads.h"
#include "expression/program.h"
#include "numerics/tolerances.h"

static int wants_least(const pm_workspace *w)
{
    return PM_SETTING(w->model, PM_SETTING_SHARED) == PM_SHARED_LEAST;
}

int pm_shared_matters(const pm_workspace *w)
{
    return (w->active.nredundant > 0 || w->impulses.nshared > 0) && !wants_least(w);
}

/* ---- what a distribution changes ---- */
enum { ALL = -1 };

/* Adds `size` of vector i, or of one entry of it alone; 0 where that entry is none. */
typedef int shift(pm_workspace *w, int i, int entry, double size);

static int shift_reactions(pm_workspace *w, int i, int entry, double size)
{
    const pm_shared *x = w->active.shared;
    const double *z = x->z + (size_t)i * w->model->nconstraint;
    for (int c = 0; c < w->active.n; c++)
        if (entry == ALL || entry == c) w->frame.lambda[c] += size * z[c];
    if (entry == ALL || entry == w->active.n) w->active.share[i] += size * x->own[i];
    return entry == ALL || entry == w->active.n || z[entry] != 0;
}

static int shift_impulses(pm_workspace *w, int i, int entry, double size)
{
    const int nj = w->model->njoint_constraint, n = nj + 2 * w->model->nslot;
    const double *z = w->impulses.shared + (size_t)i * n;
    for (int k = 0; k < n; k++)
        if (entry == ALL || entry == k)
            *(k < nj ? w->impulses.joint + k : w->impulses.slot + k - nj) += size * z[k];
    return entry == ALL || z[entry] != 0;
}

/* How the value changes. */
static double change(pm_workspace *w, int program, shift *by, int i, int entry, double size, double before)
{
    if (!by(w, i, entry, size)) return 0;
    const double after = pm_program_run(w, program);
    by(w, i, entry, -size);
    const int same =
        after == before || (isnan(after) && isnan(before)); /* of infinite values no difference tells */
    return same ? 0 : after - before;
}

/* No vector changes the value, beside what its entries do one by one. */
static int all_stay(pm_workspace *w, int program, shift *by, int n, int entries, double size, double before)
{
    int unique = 1;
    for (int i = 0; i < n && unique; i++) {
        double parts = 0;
        for (int k = 0; k < entries; k++) parts += fabs(change(w, program, by, i, k, size, before));
        unique = fabs(change(w, program, by, i, ALL, size, before)) <= PM_SHARED_READ * parts;
    }
    return unique;
}

/* The value for all distributions of the reactions; these and their shares are as they were afterwards. */
static int is_unique_in_reactions(pm_workspace *w, int program, double before)
{
    double *kept = w->active.shared->kept;
    const int n = pm_shared_look(w);
    memcpy(kept, w->frame.lambda, (size_t)w->active.n * sizeof *kept);
    const int unique = all_stay(w, program, shift_reactions, n, w->active.n + 1,
                                pm_case_force(w->model, &w->numbers), before);
    memcpy(w->frame.lambda, kept, (size_t)w->active.n * sizeof *kept);
    memset(w->active.share, 0, (size_t)w->active.nredundant * sizeof *w->active.share);
    return unique;
}

static int is_unique_in_impulses(pm_workspace *w, int program, double before)
{
    const size_t nj = w->model->njoint_constraint, ns = 2 * (size_t)w->model->nslot;
    const double size = pm_case_force(w->model, &w->numbers) * w->numbers.size / w->numbers.speed;
    double *kept = w->active.shared->kept;
    memcpy(kept, w->impulses.joint, nj * sizeof *kept);
    memcpy(kept + nj, w->impulses.slot, ns * sizeof *kept);
    const int unique =
        all_stay(w, program, shift_impulses, w->impulses.nshared, (int)(nj + ns), size, before);
    memcpy(w->impulses.joint, kept, nj * sizeof *kept);
    memcpy(w->impulses.slot, kept + nj, ns * sizeof *kept);
    return unique;
}

int pm_shared_is_unique(pm_workspace *w, int program)
{
    const double before = pm_program_run(w, program);
    if (w->active.nredundant > 0 && w->model->programs.level[program] == PM_LEVEL_DYNAMIC &&
        !is_unique_in_reactions(w, program, before))
        return 0;
    return is_unique_in_impulses(w, program, before);
}

/* ---- the least distribution ---- */
/* A couple counts as the force that makes it at the scene's size. */
static double weight_of(const pm_workspace *w, const pm_constraint *c)
{
    const int couple = pm_constraint_is_angle(c);
    return couple ? 1 / (w->numbers.size * w->numbers.size) : 1;
}

/* sum weight (load + z s)^2 / 2 of a group, in units of `size`: K and c. */
static void pose_squares(pm_workspace *w, const double *load, double size, int nmember)
{
    pm_shared *x = w->active.shared;
    const size_t wide = w->model->nconstraint;
    for (int i = 0; i < nmember; i++) {
        const double *z = x->z + x->member[i] * wide;
        x->cost[i] = 0;
        for (int c = 0; c < w->active.n; c++)
            x->cost[i] += weight_of(w, &w->active.constraint[c]) * z[c] * load[c] / size;
        for (int k = 0; k < nmember; k++) {
            const double *other = x->z + x->member[k] * wide, own = x->own[x->member[i]];
            double sum = i == k ? weight_of(w, &w->active.redundant[x->member[i]]) * own * own : 0;
            for (int c = 0; c < w->active.n; c++)
                sum += weight_of(w, &w->active.constraint[c]) * z[c] * other[c];
            x->square[i * nmember + k] = sum;
        }
    }
}

/* How much of each of its vectors a group takes for the least distribution, x->found; how many vectors, x->member. */
static int find_least(pm_workspace *w, const double *load, int first, double size)
{
    pm_shared *x = w->active.shared;
    int nmember;
    const int n = pm_shared_conditions(w, load, first, size, &nmember);
    if (n < 0) return 0;
    const double over = fmax(0, -x->slack[first] / size) + PM_SHARED_NOTHING;
    for (int r = 0; r < n; r++)
        x->right[r] += isfinite(over) ? over : 0; /* rounding may have used up the slack */
    pose_squares(w, load, size, nmember);
    return pm_shared_solve(x, nmember, n, x->square) ? nmember : 0;
}

/* How much of each vector the least distribution takes: x->amount. */
static void find_amounts(pm_workspace *w, const double *load, double size)
{
    pm_shared *x = w->active.shared;
    memset(x->amount, 0, (size_t)x->n * sizeof *x->amount);
    for (int g = 0; g < x->n; g++) {
        if (x->group[g] != g) continue;
        const int n = find_least(w, load, g, size);
        for (int i = 0; i < n; i++) x->amount[x->member[i]] = size * x->found[i];
    }
}

static void take_amounts(pm_workspace *w, shift *by)
{
    for (int i = 0; i < w->active.shared->n; i++) by(w, i, ALL, w->active.shared->amount[i]);
}

static double largest(const double *x, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(x[i]));
    return most;
}

static void find_least_reactions(pm_workspace *w)
{
    pm_shared *x = w->active.shared;
    if ((x->is_least && pm_shared_is_known(w)) || !pm_shared_look(w)) return;
    find_amounts(w, w->frame.lambda,
                 fmax(largest(w->frame.lambda, w->active.n), pm_case_force(w->model, &w->numbers)));
    x->is_least = 1;
}

/* The reactions are the least while they are read: the ledgers take those of the active constraints. */
double pm_shared_read_least(pm_workspace *w, int measure)
{
    if (w->active.nredundant == 0 || pm_measure_level(w->model, measure) != PM_LEVEL_DYNAMIC)
        return pm_measure_signed(w, measure);
    double *kept = w->active.shared->kept;
    find_least_reactions(w);
    memcpy(kept, w->frame.lambda, (size_t)w->active.n * sizeof *kept);
    take_amounts(w, shift_reactions);
    const double value = pm_measure_signed(w, measure);
    memcpy(w->frame.lambda, kept, (size_t)w->active.n * sizeof *kept);
    memset(w->active.share, 0, (size_t)w->active.nredundant * sizeof *w->active.share);
    return value;
}

/* ---- impulses ---- */
static double slide_at(const pm_workspace *w, int place)
{
    return place >= 0 ? w->active.constraint[place].slide
                      : w->active.redundant[PM_REDUNDANT_PLACE(place)].slide;
}

static void note_vector(pm_workspace *w, int i)
{
    const pm_model *m = w->model;
    const int nj = m->njoint_constraint;
    double *z = w->impulses.shared + (size_t)i * (nj + 2 * m->nslot);
    memset(z, 0, ((size_t)nj + 2 * m->nslot) * sizeof *z);
    for (int k = 0; k < nj; k++)
        if (w->active.of_joint[k] != PM_NONE) z[k] = pm_shared_entry(w, i, w->active.of_joint[k]);
    for (int k = 0; k < m->nslot; k++) {
        const int normal = w->active.slot_normal[k], tangent = w->active.slot_tangent[k];
        if (normal == PM_NONE) continue;
        z[nj + 2 * k] = pm_shared_entry(w, i, normal);
        z[nj + 2 * k + 1] =
            tangent != PM_NONE ? pm_shared_entry(w, i, tangent) : slide_at(w, normal) * z[nj + 2 * k];
    }
}

void pm_shared_note_impulses(pm_workspace *w)
{
    pm_shared *x = w->active.shared;
    w->impulses.nshared = x->known = x->is_least = 0;
    if (w->active.nredundant == 0) return;
    w->impulses.nshared = pm_shared_look_vectors(w);
    for (int i = 0; i < x->n; i++) {
        note_vector(w, i);
        x->slack[i] = 0;
    }
    if (!wants_least(w)) return;
    find_amounts(w, w->saddle.rhs, fmax(largest(w->saddle.rhs, w->active.n), PM_SHARED_TINY));
    take_amounts(w, shift_impulses);
}

int pm_shared_are_told(const pm_workspace *w) { return w->active.nredundant > 0 && wants_least(w); }

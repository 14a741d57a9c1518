/* percentile.c - the value v below which f is for the part p of the time: T(v) = p T, T(v) the time in which f < v.
 *
 * A step is kept as pieces with a polynomial through Chebyshev nodes each, halved until that resolves f, and cut where it turns:
 * between two turns f is monotone, and where it passes v is a root.  T(v) grows with v, so that bisection finds v. */
#include "events/percentile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "events/ask.h"
#include "numerics/bracket.h"
#include "numerics/chebyshev.h"
#include "numerics/tolerances.h"
#include "state/arena.h"

#define NODES PM_NODES_MOST

typedef struct pm_percentile_piece {
    double span;          /* s */
    double sample[NODES]; /* of f at the nodes */
    double low, high;     /* about between these */
    double error;         /* of the polynomial */
    int nturn;
    double turn[NODES]; /* where f turns, fractions of the piece */
} pm_percentile_piece;

static const pm_chebyshev_nodes *nodes(void) { return &pm_chebyshev_nodes_17; }

/* ---- memory ---- */
typedef struct pm_percentile_owner {
    pm_percentile *of;
    int n;
} pm_percentile_owner;

static void give_back(void *object)
{
    pm_percentile_owner *x = object;
    for (int i = 0; i < x->n; i++) free(x->of[i].piece);
    free(x->of);
    free(x);
}

int pm_percentile_create(pm_workspace *w)
{
    const int nask = w->model->nask;
    pm_percentile_owner *x = calloc(1, sizeof *x);
    if (x) *x = (pm_percentile_owner){calloc((size_t)nask + 1, sizeof *x->of), nask};
    if (x && !x->of) {
        free(x);
        x = NULL;
    }
    if (pm_arena_keep(&w->memory, x, give_back)) return PM_NO_MEMORY;
    w->ask->percentile = x->of;
    return PM_OK;
}

void pm_percentile_reset(pm_workspace *w)
{
    for (int i = 0; i < w->model->nask; i++) w->ask->percentile[i].n = 0;
    for (int i = 0; i < w->model->nask; i++) w->ask->percentile[i].unseen = 0;
}

static pm_percentile_piece *add(pm_percentile *x)
{
    if (x->n == x->room) {
        const int room = 2 * x->room + 16;
        pm_percentile_piece *piece = realloc(x->piece, (size_t)room * sizeof *piece);
        if (!piece) return NULL;
        x->piece = piece;
        x->room = room;
    }
    return &x->piece[x->n++];
}

/* ---- pieces ---- */
static int is_held(pm_workspace *w, int ask, double from, double to)
{
    const int condition = PM_ASK_ROW(w->model, ask)[PM_ASK_PROGRAM_2];
    if (condition < 0) return 1;
    return !pm_ask_look(w, 0.5 * (from + to), 0) && pm_ask_value(w, condition) > 0;
}

/* f at the nodes; those at the ends are a little inside, on the side of the piece.  0 where f has no value. */
static int read_nodes(pm_workspace *w, int program, double from, double to, double *sample)
{
    for (int k = 0; k < NODES; k++) {
        const double s = fmin(fmax(nodes()->at[k], PM_PERCENTILE_INSIDE), 1 - PM_PERCENTILE_INSIDE);
        sample[k] = pm_ask_look(w, from + s * (to - from), 0) ? NAN : pm_ask_value(w, program);
        if (!isfinite(sample[k])) return 0;
    }
    return 1;
}

/* Between two nodes where the slope changes its sign. */
static double find_turn(const double *sample, double a, double slope_a, double b)
{
    double here;
    for (int i = 0; i < PM_PERCENTILE_HALVINGS && b - a > 0; i++) {
        const double middle = 0.5 * (a + b), slope = pm_chebyshev_slope(nodes(), sample, middle, &here);
        if (middle <= a || middle >= b) break;
        if ((slope > 0) == (slope_a > 0))
            a = middle;
        else
            b = middle;
    }
    return 0.5 * (a + b);
}

static void find_turns(pm_percentile_piece *x)
{
    double before = pm_chebyshev_slope_at(nodes(), x->sample, 0);
    x->nturn = 0;
    for (int k = 1; k < NODES; k++) {
        const double slope = pm_chebyshev_slope_at(nodes(), x->sample, k);
        if ((before > 0 && slope < 0) || (before < 0 && slope > 0))
            x->turn[x->nturn++] = find_turn(x->sample, nodes()->at[k - 1], before, nodes()->at[k]);
        if (slope != 0) before = slope;
    }
}

static void bound(pm_percentile_piece *x)
{
    x->low = INFINITY;
    x->high = -INFINITY;
    for (int k = 0; k < NODES + x->nturn; k++) {
        const double value =
            k < NODES ? x->sample[k] : pm_chebyshev_value(nodes(), x->sample, 1, x->turn[k - NODES]);
        x->low = fmin(x->low, value);
        x->high = fmax(x->high, value);
    }
}

static int take(pm_workspace *w, int ask, double from, double to, int halvings)
{
    pm_percentile_piece piece = {.span = to - from};
    double size = 0;
    if (!read_nodes(w, PM_ASK_ROW(w->model, ask)[PM_ASK_PROGRAM], from, to, piece.sample)) return PM_OK;
    for (int k = 0; k < NODES; k++) size = fmax(size, fabs(piece.sample[k]));
    piece.error = pm_chebyshev_high(nodes(), piece.sample);
    const double least = fmax(PM_INTEGRAL_ERROR * w->numbers.tolerance, PM_INTEGRAL_ROUNDING) * size;
    if (piece.error > least && halvings > 0) {
        const double middle = 0.5 * (from + to);
        const int status = take(w, ask, from, middle, halvings - 1);
        return status ? status : take(w, ask, middle, to, halvings - 1);
    }
    find_turns(&piece);
    bound(&piece);
    pm_percentile_piece *at = add(&w->ask->percentile[ask]);
    if (!at) return PM_NO_MEMORY;
    *at = piece;
    return PM_OK;
}

int pm_percentile_take(pm_workspace *w, int ask, double from, double to)
{
    return is_held(w, ask, from, to) ? take(w, ask, from, to, PM_PERCENTILE_PARTS) : PM_OK;
}

int pm_percentile_pass(pm_workspace *w, int ask, double value, double time)
{
    pm_percentile *x = &w->ask->percentile[ask];
    pm_percentile_piece *at = add(x);
    if (!at) return PM_NO_MEMORY;
    *at = (pm_percentile_piece){.span = time, .low = value, .high = value};
    for (int k = 0; k < NODES; k++) at->sample[k] = value;
    x->unseen += time;
    return PM_OK;
}

/* ---- the answer ---- */
/* The part of a piece in which f is below v. */
static double part_below(const pm_percentile_piece *x, double v)
{
    double shifted[NODES], sum = 0, a = 0, fa;
    if (x->high < v) return 1;
    if (x->low >= v) return 0;
    for (int k = 0; k < NODES; k++) shifted[k] = x->sample[k] - v;
    fa = shifted[0];
    for (int i = 0; i <= x->nturn; i++) {
        const double b = i < x->nturn ? x->turn[i] : 1, fb = pm_chebyshev_value(nodes(), shifted, 1, b);
        double root = fa < 0 ? b : a, slope;
        if ((fa < 0) != (fb < 0)) (void)pm_chebyshev_root(nodes(), shifted, a, fa, b, fb, &root, &slope);
        sum += fa < 0 ? root - a : fb < 0 ? b - root : 0;
        a = b;
        fa = fb;
    }
    return sum;
}

static double time_below(const pm_percentile *x, double v)
{
    double sum = 0;
    for (int i = 0; i < x->n; i++) sum += x->piece[i].span * part_below(&x->piece[i], v);
    return sum;
}

/* The least v of which f is below for so long. */
static double value_at(const pm_percentile *x, double low, double high, double time)
{
    for (int i = 0; i < PM_PERCENTILE_HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        if (time_below(x, middle) < time)
            low = middle;
        else
            high = middle;
    }
    return high;
}

double pm_percentile_answer(const pm_workspace *w, int ask, double *error)
{
    const pm_percentile *x = &w->ask->percentile[ask];
    const double part = w->numbers.value[PM_ASK_ROW(w->model, ask)[PM_ASK_FIRST_VALUE]];
    double low = INFINITY, high = -INFINITY, all = 0;
    for (int i = 0; i < x->n; i++) {
        low = fmin(low, x->piece[i].low);
        high = fmax(high, x->piece[i].high);
        all += x->piece[i].span;
    }
    *error = 0;
    if (!(part > 0 && part < 1) || !(all > 0)) return NAN;
    const double value = value_at(x, low, high, part * all);
    for (int i = 0; i < x->n; i++)
        if (x->piece[i].low <= value && value <= x->piece[i].high) *error = fmax(*error, x->piece[i].error);
    if (x->unseen > 0)
        *error += value_at(x, low, high, fmin(part * all + x->unseen, all)) -
                  value_at(x, low, high, fmax(part * all - x->unseen, 0));
    return value;
}

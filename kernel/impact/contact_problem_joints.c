/* contact_problem_joints.c - friction of joints in a given mode taken out of the problem; the modes one by one.
 *
 * Few joints: all modes are tried, and motions counted.  More: a mode that does not hold is mended joint by joint.  The direction
 * of a bearing's reaction is found by iteration. */
#include "impact/contact_problem_joints.h"

#include <math.h>
#include <string.h>

#include "numerics/dense.h"
#include "numerics/tolerances_impact.h"
#include "planemotion.h"
#include "state/state.h"

int pm_contact_problem_joints_create(pm_contact_problem_joints *x, pm_arena *arena,
                                     pm_contact_problem *contacts, int most, int joints)
{
    const size_t two = 2 * (size_t)most, m = joints, all = two + m;
    const pm_array array[] = {
        PM_ARRAY(x->joint, m),
        PM_ARRAY(x->kept, m),
        PM_ARRAY(x->bias, two),
        PM_ARRAY(x->response, all * all),
        PM_ARRAY(x->load, two),
        PM_ARRAY(x->reaction, 2 * m * all),
        PM_ARRAY(x->rate, two),
        PM_ARRAY(x->mode, most),
        PM_ARRAY(x->given, m * (two + 1)),
        PM_ARRAY(x->pivot, m),
        PM_ARRAY(x->right, m),
        PM_ARRAY(x->system, m * m),
    };
    x->contacts = contacts;
    return pm_arena_take(arena, PM_ARRAYS(array));
}

static int sense(int mode) { return (mode == PM_SLIDE_FORWARD) - (mode == PM_SLIDE_BACKWARD); }
static int contacts_of(const pm_contact_problem_joints *x) { return 2 * x->contacts->n; }
static int all_of(const pm_contact_problem_joints *x) { return 2 * x->contacts->n + x->m; }

/* ---- one mode ---- */
/* Of the reaction of joint k along its direction: by a unit load in direction i. */
static double along(const pm_contact_problem_joints *x, int k, int i)
{
    const double *l = x->reaction + 2 * k * all_of(x);
    return x->joint[k].along[0] * l[i] + x->joint[k].along[1] * l[all_of(x) + i];
}

/* What friction k obeys: coefficient of F_j (j >= 0), of p_i (i >= 0), or what is left (both PM_NONE). */
static double entry(const pm_contact_problem_joints *x, int k, int j, int i)
{
    const pm_contact_problem_joint *c = &x->joint[k];
    const int n = contacts_of(x), at = j >= 0 ? n + j : i;
    const double load = sense(c->mode) * c->coefficient;
    if (c->mode == PM_STICK) return at == PM_NONE ? c->bias : x->response[(n + k) * all_of(x) + at];
    if (at == PM_NONE) return load * (c->along[0] * c->start[0] + c->along[1] * c->start[1]);
    return (j == k) + (load != 0 ? load * along(x, k, at) : 0);
}

/* F = given (1, p); 0 if the mode does not tell it. */
static int give_friction(pm_contact_problem_joints *x)
{
    const int n = contacts_of(x), m = x->m;
    for (int k = 0; k < m; k++)
        for (int j = 0; j < m; j++) x->system[k * m + j] = entry(x, k, j, PM_NONE);
    if (pm_dense_lu_factor(m, x->system, x->pivot)) return 0;
    for (int i = -1; i < n; i++) {
        for (int k = 0; k < m; k++) x->right[k] = -entry(x, k, PM_NONE, i < 0 ? PM_NONE : i);
        pm_dense_lu_solve(m, x->system, x->pivot, x->right);
        for (int k = 0; k < m; k++) x->given[k * (n + 1) + i + 1] = x->right[k];
    }
    return 1;
}

/* The contacts with friction taken out. */
static void reduce(pm_contact_problem_joints *x)
{
    const int n = contacts_of(x), all = all_of(x);
    for (int r = 0; r < n; r++)
        for (int i = -1; i < n; i++) {
            double sum = i < 0 ? x->bias[r] : x->response[r * all + i];
            for (int k = 0; k < x->m; k++)
                sum += x->response[r * all + n + k] * x->given[k * (n + 1) + i + 1];
            *(i < 0 ? &x->contacts->contact[r / 2].bias[r % 2] : &x->contacts->response[r * n + i]) = sum;
        }
}

/* A sum, and how large the terms are that it is the sum of. */
typedef struct pm_total {
    double sum, size;
} pm_total;

static void add(pm_total *to, double x)
{
    to->sum += x;
    to->size += fabs(x);
}

/* Of a row of W or L, over contacts and joints. */
static pm_total total(const pm_contact_problem_joints *x, double start, const double *row)
{
    const int n = contacts_of(x);
    pm_total t = {0, 0};
    add(&t, start);
    for (int i = 0; i < n; i++) add(&t, row[i] * x->contacts->load[i]);
    for (int k = 0; k < x->m; k++) add(&t, row[n + k] * x->joint[k].friction);
    return t;
}

static pm_total reaction(const pm_contact_problem_joints *x, int k, int component)
{
    return total(x, x->joint[k].start[component], x->reaction + (2 * k + component) * all_of(x));
}

static pm_total slip(const pm_contact_problem_joints *x, int k)
{
    return total(x, x->joint[k].bias, x->response + (contacts_of(x) + k) * all_of(x));
}

static void find_friction(pm_contact_problem_joints *x)
{
    const int n = contacts_of(x);
    for (int k = 0; k < x->m; k++) {
        const double *given = x->given + k * (n + 1);
        double sum = given[0];
        for (int i = 0; i < n; i++) sum += given[i + 1] * x->contacts->load[i];
        x->joint[k].friction = sum;
    }
    for (int k = 0; k < x->m; k++) x->joint[k].rate = x->joint[k].mode == PM_STICK ? 0 : slip(x, k).sum;
}

/* ---- what holds ---- */
/* What joint k does not obey. */
typedef enum pm_broken { PM_HOLDS, PM_LETS_GO, PM_HOLDS_STILL, PM_TURNS } pm_broken;

static pm_broken broken(const pm_contact_problem_joints *x, int k)
{
    const pm_contact_problem_joint *c = &x->joint[k];
    const pm_total r[2] = {reaction(x, k, 0), reaction(x, k, 1)}, s = slip(x, k);
    const double size = hypot(r[0].sum, r[1].sum), tie = PM_PROBLEM_TIE * (r[0].size + r[1].size);
    if (c->mode == PM_STICK)
        return fabs(c->friction) <= c->coefficient * (size + tie) ? PM_HOLDS : PM_LETS_GO;
    if (c->along[0] * r[0].sum + c->along[1] * r[1].sum < size - tie) return PM_TURNS;
    return c->slips || sense(c->mode) * s.sum >= -PM_PROBLEM_TIE * s.size ? PM_HOLDS : PM_HOLDS_STILL;
}

/* The directions of the bearings' reactions, as they are now; how far the one that rotated most. */
static double rotate(pm_contact_problem_joints *x)
{
    double most = 0;
    for (int k = 0; k < x->m; k++) {
        pm_contact_problem_joint *c = &x->joint[k];
        if (c->nload == 1) continue;
        const double r[2] = {reaction(x, k, 0).sum, reaction(x, k, 1).sum}, size = hypot(r[0], r[1]);
        if (!(size > 0)) continue;
        most = fmax(most, hypot(r[0] / size - c->along[0], r[1] / size - c->along[1]));
        for (int i = 0; i < 2; i++) c->along[i] = r[i] / size;
    }
    return most;
}

/* The motions in the mode of the joints that is tried; 0 if it has none, whether it holds or not. */
static int solve_mode(pm_contact_problem_joints *x)
{
    int found = 0;
    for (int i = 0; i < PM_JOINTS_TURNS; i++) {
        if (!give_friction(x)) return 0;
        reduce(x);
        found = pm_contact_problem_solve(x->contacts);
        if (found == 0) return 0;
        find_friction(x);
        if (rotate(x) <= PM_JOINTS_TURNED) return found;
    }
    return 0;
}

static int all_hold(const pm_contact_problem_joints *x)
{
    for (int k = 0; k < x->m; k++)
        if (broken(x, k) != PM_HOLDS) return 0;
    return 1;
}

/* ---- what was found ---- */
static void keep(pm_contact_problem_joints *x)
{
    const size_t n = contacts_of(x);
    memcpy(x->load, x->contacts->load, n * sizeof *x->load);
    memcpy(x->rate, x->contacts->rate, n * sizeof *x->rate);
    memcpy(x->mode, x->contacts->mode, n / 2 * sizeof *x->mode);
    memcpy(x->kept, x->joint, (size_t)x->m * sizeof *x->joint);
}

static void take(pm_contact_problem_joints *x)
{
    const size_t n = contacts_of(x);
    memcpy(x->contacts->load, x->load, n * sizeof *x->load);
    memcpy(x->contacts->rate, x->rate, n * sizeof *x->rate);
    memcpy(x->contacts->mode, x->mode, n / 2 * sizeof *x->mode);
    memcpy(x->joint, x->kept, (size_t)x->m * sizeof *x->joint);
}

/* A contact that moves otherwise than in the motion that is kept (0 if joints alone do), or PM_NONE. */
static int difference(const pm_contact_problem_joints *x)
{
    double size = 0;
    for (int i = 0; i < contacts_of(x); i++) size = fmax(size, fabs(x->bias[i]) + fabs(x->rate[i]));
    for (int i = 0; i < contacts_of(x); i++)
        if (fabs(x->rate[i] - x->contacts->rate[i]) > PM_PROBLEM_SAME * size) return i / 2;
    for (int k = 0; k < x->m; k++)
        if (fabs(x->kept[k].rate - x->joint[k].rate) > PM_PROBLEM_SAME * slip(x, k).size) return 0;
    return PM_NONE;
}

/* ---- the modes ---- */
/* Mode number i of a joint: it holds, slides forward or backward; from which side a slider is pressed.  0: there is none. */
static int set_mode(pm_contact_problem_joint *c, int i)
{
    static const int mode[] = {PM_STICK, PM_SLIDE_FORWARD, PM_SLIDE_BACKWARD};
    const int sides = c->nload == 1 ? 2 : 1;
    if (i >= 3 * sides) return 0;
    c->mode = mode[i / sides];
    if (c->nload == 1) {
        c->along[0] = i % sides ? -1 : 1;
        c->along[1] = 0;
    }
    return 1;
}

/* A joint that slips already goes on; one that holds has no side. */
static int is_mode(const pm_contact_problem_joint *c)
{
    if (c->slips) return sense(c->mode) == c->slips;
    return c->mode != PM_STICK || c->nload == 2 || c->along[0] > 0;
}

/* The next mode of all joints after number at[]; 0 after the last. */
static int next_mode(pm_contact_problem_joints *x, int *at)
{
    for (int k = 0; k < x->m; k++) {
        while (set_mode(&x->joint[k], ++at[k]))
            if (is_mode(&x->joint[k])) return 1;
        for (at[k] = 0; set_mode(&x->joint[k], at[k]) && !is_mode(&x->joint[k]);) at[k]++;
    }
    return 0;
}

/* Bearings begin with the reactions that they would have without friction of joints. */
static void begin(pm_contact_problem_joints *x, int *at)
{
    for (int k = 0; k < x->m; k++) {
        x->joint[k].mode = PM_OPEN;
        x->joint[k].along[0] = 1;
        x->joint[k].along[1] = 0;
    }
    solve_mode(x);
    for (int k = 0; k < x->m; k++)
        for (at[k] = 0; set_mode(&x->joint[k], at[k]) && !is_mode(&x->joint[k]);) at[k]++;
}

static int try_all(pm_contact_problem_joints *x)
{
    int at[PM_JOINTS_COUNTED], motions = 0;
    begin(x, at);
    do {
        const int found = solve_mode(x);
        if (found == 0 || !all_hold(x)) continue;
        const int other = motions > 0 ? difference(x) : found > 1 ? x->contacts->differs : PM_NONE;
        if (motions > 0 && other == PM_NONE) continue;
        if (other != PM_NONE) x->differs = other;
        motions += motions > 0 ? 1 : found;
        if (motions <= found) keep(x);
    } while (motions < 2 && next_mode(x, at));
    if (motions > 0) take(x);
    return motions;
}

/* Joint k obeys what it has not obeyed. */
static void mend(pm_contact_problem_joints *x, int k, pm_broken what)
{
    pm_contact_problem_joint *c = &x->joint[k];
    if (what == PM_TURNS) c->along[0] = -c->along[0];
    if (what == PM_HOLDS_STILL) c->mode = PM_STICK;
    if (what != PM_LETS_GO) return;
    c->mode = c->friction > 0 ? PM_SLIDE_BACKWARD : PM_SLIDE_FORWARD;
    if (c->nload == 1) c->along[0] = copysign(1, reaction(x, k, 0).sum);
}

static int mend_one_by_one(pm_contact_problem_joints *x)
{
    for (int k = 0; k < x->m; k++) {
        pm_contact_problem_joint *c = &x->joint[k];
        c->mode = c->slips > 0 ? PM_SLIDE_FORWARD : c->slips < 0 ? PM_SLIDE_BACKWARD : PM_STICK;
        c->along[0] = 1;
        c->along[1] = 0;
    }
    for (int i = 0; i < PM_JOINTS_MENDED * x->m; i++) {
        const int found = solve_mode(x);
        int k = 0;
        if (found == 0) return 0;
        while (k < x->m && broken(x, k) == PM_HOLDS) k++;
        if (k == x->m) {
            x->differs = x->contacts->differs;
            return found;
        }
        mend(x, k, broken(x, k));
    }
    return 0;
}

int pm_contact_problem_joints_solve(pm_contact_problem_joints *x)
{
    x->differs = PM_NONE;
    return x->m <= PM_JOINTS_COUNTED ? try_all(x) : mend_one_by_one(x);
}

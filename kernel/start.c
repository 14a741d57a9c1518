/* start.c - assembly of an approximate start.
 *
 * Positions: Gauss-Newton on joint rows and written positions together, each step the least one (row basis in the metric
 * of M), so what is written stays and the rest moves as little as possible.  Velocities: the rows of joints and of
 * contacts that rest (rough ones hold their tangents too), then what is written, are taken one after the other into an
 * orthonormal basis: a row that depends on the others must agree with them (else a conflict that names it); directions
 * that stay open are an error for fastened bodies, unless nothing is written of any that are fastened to each other
 * (those rest), and zero for a body on its own.
 *
 * A basis of n rows costs n^3.  Many rows G of joints that clearly do not depend on each other are solved as one block
 * instead, with S = G M^-1 G^T (saddle.h): x = M^-1 G^T S^-1 r, and of each further row d the part across them counts,
 * d - G^T S^-1 G M^-1 d. */
#include "start.h"

#include <math.h>
#include <string.h>

#include "action.h"
#include "active.h"
#include "basis.h"
#include "body.h"
#include "case.h"
#include "contact.h"
#include "measure.h"
#include "row.h"
#include "saddle.h"
#include "spin.h"

#define SWEEPS 60
#define LONGEST 0.3    /* step of the assembly, in sizes of the scene */
#define AGREES 1e-9    /* relative disagreement of start velocities that is rounding */
#define OPEN_PART 1e-6 /* of a unit velocity of a body left open */
#define MANY 24 /* rows of joints: fewer are as quick in the basis, and dependent ones are told sharply */
#define CLEARLY 1e-3 /* independent part of every row of a block */
#define PASSES 2     /* with the factors: the second takes off what rounding left of the first */
#define MESHES 1e-3  /* of their distance: gears that are open by less mesh, drawn by rounded numbers */

static void draw(pm_workspace *w)
{
    const pm_model *m = w->model;
    memset(w->state.block, 0, w->state.bytes);
    w->state.t = 0;
    for (int i = 0; i < m->nbody; i++)
        for (int k = 0; k < 3; k++) w->state.q[3 * i + k] = w->value[PM_BODY_ROW(m, i)[PM_BODY_X + k]];
    for (int i = 0; i < m->nbody; i++)
        if (!PM_BODY_ROW(m, i)[PM_BODY_TURNS]) w->state.q[3 * i + 2] = 0;
    pm_action_begin(m, &w->state);
}

/* The least change x (in the metric of M) that the basis spans with the given components y: x = M^-1/2 B^T y.  A new row
 * with right-hand side r: its component is (r - row.x) / (left * norm). */
typedef struct pm_solution {
    int n;          /* rows in the basis */
    double *x;      /* [nq] */
    int block;      /* rows solved as one block: the active ones */
    double *across; /* [nq] part of a row across them */
} pm_solution;

static double norm_of(const pm_workspace *w, const double *row)
{
    double sum = 0;
    for (int i = 0; i < w->model->nq; i++) sum += row[i] * row[i] * w->inverse_mass[i];
    return sqrt(sum);
}

/* Adds a row, times a factor, to a dense one. */
static void add_sparse(const pm_workspace *w, const pm_row *row, double factor, double *dense)
{
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 3 && row->body[p] != w->model->nbody; k++)
            dense[3 * row->body[p] + k] += factor * row->j[3 * p + k];
}

static void spread_row(const pm_workspace *w, const pm_row *row, double *dense)
{
    memset(dense, 0, (size_t)w->model->nq * sizeof *dense);
    add_sparse(w, row, 1, dense);
}

/* G M^-1 d of one row of the block. */
static double along(const pm_workspace *w, const pm_row *row, const double *d)
{
    double sum = 0;
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 3 && row->body[p] != w->model->nbody; k++)
            sum += row->j[3 * p + k] * w->inverse_mass[3 * row->body[p] + k] * d[3 * row->body[p] + k];
    return sum;
}

/* Adds a row to the basis if it depends neither on that nor on the block; the new size. */
static int add_row(pm_workspace *w, const pm_solution *s, const double *row, pm_basis_rest *rest)
{
    if (!s->block) return pm_basis_add_dense(w, s->n, row, rest);
    memcpy(s->across, row, (size_t)w->model->nq * sizeof *row);
    for (int pass = 0; pass < PASSES; pass++) {
        for (int i = 0; i < w->nactive; i++) w->rhs[i] = -along(w, &w->row[i], s->across);
        pm_saddle_solve(w);
        for (int i = 0; i < w->nactive; i++) add_sparse(w, &w->row[i], w->rhs[i], s->across);
    }
    const double all = norm_of(w, row), part = norm_of(w, s->across);
    *rest = (pm_basis_rest){0, all};
    if (!(part > PM_INDEPENDENT * all)) return s->n;
    const int n = pm_basis_add_dense(w, s->n, s->across, rest);
    rest->left *= rest->norm / all;
    rest->norm = all;
    return n;
}

/* Solves for the rows of joints, at the level of positions (but those that are anchored later) or velocities, if they are
 * many and clearly independent. */
static int take_block(pm_workspace *w, pm_solution *s, int level)
{
    const pm_model *m = w->model;
    if (m->njoint_row < MANY) return 0;
    w->nactive = 0;
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_row rows[PM_JOINT_ROWS];
        const int n = pm_row_of_joint(w, w->joint_order[i], rows);
        for (int k = 0; k < n; k++) {
            if (level == PM_START_POSITION && rows[k].memory != PM_NONE) continue;
            pm_row *row = &w->row[w->nactive];
            *row = rows[k];
            pm_row_kind(row->kind)->evaluate(w, row);
            w->wanted[w->nactive++] = level == PM_START_POSITION ? -row->g : row->rate;
        }
    }
    if (w->nactive < MANY || !(pm_saddle_independence(w) > CLEARLY)) return 0;
    for (int pass = 0; pass < PASSES; pass++) {
        for (int i = 0; i < w->nactive; i++) w->rhs[i] = w->wanted[i] - pm_saddle_times(w, &w->row[i], s->x);
        pm_saddle_solve(w);
        pm_saddle_spread(w, 0, s->x);
    }
    s->block = w->nactive;
    return 1;
}

/* A row of which the solution misses so much has been added to the basis, which has n rows now; 1 if it is a new one. */
static int meet(const pm_workspace *w, pm_solution *s, int n, const pm_basis_rest *rest, double *miss)
{
    if (n == s->n) return 0;
    const double *e = w->basis + (size_t)s->n * (size_t)w->model->nq,
                 component = *miss / (rest->left * rest->norm);
    const int *range = w->basis_range + 2 * s->n;
    for (int i = range[0]; i < range[1]; i++) s->x[i] += component * e[i] * w->inverse_root[i];
    s->n = n;
    *miss = 0;
    return 1;
}

/* Takes one equation row.x = rhs into the solution; *miss is by how much it is violated if it depends on the others. */
static int take(pm_workspace *w, pm_solution *s, const double *row, double rhs, double *miss)
{
    pm_basis_rest rest;
    double now = 0;
    for (int i = 0; i < w->model->nq; i++) now += row[i] * s->x[i];
    *miss = rhs - now;
    return meet(w, s, add_row(w, s, row, &rest), &rest, miss);
}

/* The same of an evaluated row. */
static int take_row(pm_workspace *w, pm_solution *s, const pm_row *row, double rhs, double *dense,
                    double *miss)
{
    pm_basis_rest rest;
    if (s->block) {
        spread_row(w, row, dense);
        return take(w, s, dense, rhs, miss);
    }
    *miss = rhs - pm_saddle_times(w, row, s->x);
    return meet(w, s, pm_basis_add(w, s->n, row->j, row->body, &rest), &rest, miss);
}

static double start_value(const pm_workspace *w, int i)
{
    return w->value[PM_START_ROW(w->model, i)[PM_START_VALUE]];
}
static int start_measure(const pm_workspace *w, int i) { return PM_START_ROW(w->model, i)[PM_START_MEASURE]; }
static int start_level(const pm_workspace *w, int i) { return PM_START_ROW(w->model, i)[PM_START_LEVEL]; }

/* Worst opening of joints and written positions at the frame; where it is. */
static double worst_opening(pm_workspace *w, int *table, int *row)
{
    const pm_model *m = w->model;
    double worst = 0;
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_row rows[PM_JOINT_ROWS];
        const int n = pm_row_of_joint(w, i, rows);
        for (int k = 0; k < n; k++) {
            if (rows[k].memory != PM_NONE) continue; /* no slip: anchored where the assembly ends */
            pm_row_kind(rows[k].kind)->evaluate(w, &rows[k]);
            const double size = fabs(rows[k].g) * (rows[k].kind == PM_ROW_ANGLE ? w->size : 1);
            if (!(size <= worst)) {
                worst = size;
                *table = PM_TABLE_JOINT;
                *row = i;
            }
        }
    }
    for (int i = 0; i < m->rows[PM_TABLE_START]; i++) {
        if (start_level(w, i) != PM_START_POSITION) continue;
        const double miss = fabs(pm_measure(w, start_measure(w, i)) - start_value(w, i));
        if (!(miss <= worst)) {
            worst = miss;
            *table = PM_TABLE_START;
            *row = i;
        }
    }
    return worst;
}

/* Whether each written position is independent of those before it, and of the block. */
static int take_written_positions(pm_workspace *w, pm_solution *s, double *dense)
{
    int all = 1;
    for (int i = 0; i < w->model->rows[PM_TABLE_START]; i++) {
        double miss;
        if (start_level(w, i) != PM_START_POSITION) continue;
        const double residual = pm_measure(w, start_measure(w, i)) - start_value(w, i);
        pm_measure_start_row(w, start_measure(w, i), PM_START_POSITION, dense);
        all &= take(w, s, dense, -residual, &miss);
    }
    return all;
}

/* One Gauss-Newton step in w->scratch; what is written comes first, so that it decides where rows disagree. */
static void position_step(pm_workspace *w, double *x, double *dense)
{
    const pm_model *m = w->model;
    pm_solution s = {.x = x, .across = dense + m->nq};
    double miss;
    memset(x, 0, (size_t)m->nq * sizeof *x);
    const int solved = take_block(w, &s, PM_START_POSITION) && take_written_positions(w, &s, dense);
    pm_active_clear(w);
    if (solved) return;
    s.n = s.block = 0;
    memset(x, 0, (size_t)m->nq * sizeof *x);
    take_written_positions(w, &s, dense);
    for (int i = 0; i < m->rows[PM_TABLE_JOINT]; i++) {
        pm_row rows[PM_JOINT_ROWS];
        const int n = pm_row_of_joint(w, i, rows);
        for (int k = 0; k < n; k++) {
            if (rows[k].memory != PM_NONE) continue;
            pm_row_kind(rows[k].kind)->evaluate(w, &rows[k]);
            take_row(w, &s, &rows[k], -rows[k].g, dense, &miss);
        }
    }
}

static void limit_step(const pm_workspace *w, double *x)
{
    double longest = 0;
    for (int i = 0; i < w->model->nq; i++) longest = fmax(longest, fabs(x[i]) * (i % 3 == 2 ? w->size : 1));
    const double factor = longest > LONGEST * w->size ? LONGEST * w->size / longest : 1;
    for (int i = 0; i < w->model->nq; i++) x[i] *= factor;
}

static int assemble(pm_workspace *w, pm_start_report *report)
{
    const pm_model *m = w->model;
    const double allowed = w->value[PM_SETTING(m, PM_SETTING_ASSEMBLY)] * w->size;
    double *x = w->scratch, *dense = x + m->nq, best = INFINITY;
    int table = PM_NONE, row = PM_NONE;
    pm_frame_look_state(w, &w->state);
    for (int sweep = 0; sweep < SWEEPS; sweep++) {
        report->opening = worst_opening(w, &table, &row);
        const int gains = report->opening < 0.5 * best;
        if (!(report->opening > 4e-16 * w->size) || (report->opening <= allowed && !gains)) break;
        best = fmin(best, report->opening);
        position_step(w, x, dense);
        limit_step(w, x);
        for (int i = 0; i < m->nq; i++) w->state.q[i] += x[i];
        pm_frame_look_state(w, &w->state);
    }
    for (int i = 0; i < m->nbody; i++)
        for (int k = 0; k < 3; k++) {
            const double drawn =
                PM_BODY_ROW(m, i)[PM_BODY_TURNS] || k < 2 ? w->value[PM_BODY_ROW(m, i)[PM_BODY_X + k]] : 0;
            report->moved = fmax(report->moved, fabs(w->state.q[3 * i + k] - drawn) * (k == 2 ? w->size : 1));
        }
    return report->opening <= allowed ? PM_OK : pm_fail(w, PM_ASSEMBLY, table, row, report->opening, allowed);
}

static double apart(const pm_workspace *w, const pm_row *row)
{
    const pm_marks x = pm_row_marks(w, row);
    return pm_length(x.d);
}

static int check_gears(pm_workspace *w, int joint, const pm_row *row)
{
    const double distance = apart(w, row), open = fabs(distance - fabs(row->value));
    return open <= MESHES * distance
               ? PM_OK
               : pm_fail(w, PM_ASSEMBLY, PM_TABLE_JOINT, joint, open, MESHES * distance);
}

static int check_strand(pm_workspace *w, int table, int at, const pm_row *row)
{
    const double distance = apart(w, row), past = fabs(row->radius_b - row->radius_a);
    return distance > past ? PM_OK : pm_fail(w, PM_ASSEMBLY, table, at, past - distance, 0);
}

/* Pitch circles touch, and strands have a way past their circles: no row holds that. */
static int check_couplings(pm_workspace *w)
{
    const pm_model *m = w->model;
    pm_row row[PM_JOINT_ROWS];
    int status = PM_OK;
    for (int i = 0; !status && i < m->rows[PM_TABLE_JOINT]; i++) {
        const int kind = PM_JOINT_ROW(m, i)[PM_JOINT_KIND];
        if (kind != PM_JOINT_GEARS && kind != PM_JOINT_BELT) continue;
        const int n = pm_row_of_joint(w, i, row);
        for (int k = 0; !status && k < n; k++)
            status = kind == PM_JOINT_GEARS ? check_gears(w, i, &row[k])
                                            : check_strand(w, PM_TABLE_JOINT, i, &row[k]);
    }
    for (int i = 0; !status && i < m->rows[PM_TABLE_CONTACT]; i++) {
        if (!pm_contact_is_cord(m, i)) continue;
        pm_row_normal_of_contact(w, i, m->contact_slot[i], 0, &row[0]);
        status = check_strand(w, PM_TABLE_CONTACT, i, &row[0]);
    }
    return status;
}

/* ---- velocities ---- */
static int any_velocity_written(const pm_workspace *w)
{
    if (pm_model_is_driven(w->model)) return 1;
    for (int i = 0; i < w->model->rows[PM_TABLE_START]; i++)
        if (start_level(w, i) == PM_START_VELOCITY && start_value(w, i) != 0) return 1;
    return 0;
}

/* Which bodies hang together; the ground joins nobody. */
typedef struct pm_islands {
    int *island; /* [nbody] the same number: held to each other, or one written velocity is of both */
    unsigned char *fastened; /* [nbody + 1] */
    unsigned char *written;  /* [nbody] a velocity that is not zero */
} pm_islands;

static void join(const pm_workspace *w, const pm_islands *x, int a, int b)
{
    if (a == w->model->nbody || b == w->model->nbody) return;
    const int from = x->island[b], to = x->island[a];
    for (int i = 0; i < w->model->nbody; i++)
        if (x->island[i] == from) x->island[i] = to;
}

static void fasten(const pm_workspace *w, const pm_islands *x, const pm_row *row)
{
    for (int p = 0; p < 2; p++) x->fastened[row->body[p]] = 1;
    join(w, x, row->body[0], row->body[1]);
}

static void note_written(const pm_workspace *w, const pm_islands *x, const double *row, double value)
{
    int first = PM_NONE;
    for (int k = 0; k < w->model->nq; k++) {
        if (row[k] == 0) continue;
        if (first == PM_NONE) first = k / 3;
        join(w, x, first, k / 3);
        if (value != 0) x->written[k / 3] = 1;
    }
}

/* Nothing is written of this body, nor of any that hangs together with it. */
static int left_alone(const pm_workspace *w, const pm_islands *x, int body)
{
    for (int i = 0; i < w->model->nbody; i++)
        if (x->island[i] == x->island[body] && x->written[i]) return 0;
    return 1;
}

static void hold_joints(pm_workspace *w, pm_solution *s, double *dense, const pm_islands *islands)
{
    const int solved = take_block(w, s, PM_START_VELOCITY);
    double miss;
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        pm_row rows[PM_JOINT_ROWS];
        const int n = pm_row_of_joint(w, i, rows);
        for (int k = 0; k < n; k++) {
            pm_row_kind(rows[k].kind)->evaluate(w, &rows[k]);
            fasten(w, islands, &rows[k]);
            if (solved) continue;
            take_row(w, s, &rows[k], rows[k].rate, dense, &miss);
        }
    }
}

/* Contacts that touch at the start and never slip, and taut cords, count as joints: the normal, too, unless the start
 * breaks it. */
static void hold_contacts(pm_workspace *w, pm_solution *s, double *dense, const pm_islands *islands)
{
    double miss;
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        pm_row row[2];
        const int cord = pm_contact_is_cord(w->model, i);
        if (!cord && pm_contact_friction(w->model, i) != PM_FRICTION_ROUGH) continue;
        if (!pm_contact_touches(w, &w->state, i, &member)) continue;
        pm_row_of_contact(w, i, w->model->contact_slot[i], member, &row[0], &row[1]);
        for (int k = 0; k < (cord ? 1 : 2); k++) {
            pm_row_kind(row[k].kind)->evaluate(w, &row[k]);
            take_row(w, s, &row[k], row[k].rate, dense, &miss);
            fasten(w, islands, &row[k]);
        }
    }
}

static int take_written(pm_workspace *w, pm_solution *s, double *dense, const pm_islands *islands)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_START]; i++) {
        if (start_level(w, i) != PM_START_VELOCITY) continue;
        const double value = start_value(w, i);
        double miss, size = 0;
        pm_measure_start_row(w, start_measure(w, i), PM_START_VELOCITY, dense);
        note_written(w, islands, dense, value);
        for (int k = 0; k < w->model->nq; k++) size = fmax(size, fabs(dense[k] * s->x[k]));
        if (take(w, s, dense, value, &miss) || fabs(miss) <= AGREES * fmax(size, fabs(value))) continue;
        pm_fail(w, PM_START_CONFLICT, PM_TABLE_START, i, value, value - miss);
        return PM_START_CONFLICT;
    }
    return PM_OK;
}

/* Every body's own directions must be settled now; of a body on its own, or left alone, the open ones are set to zero. */
static int settle_rest(pm_workspace *w, pm_solution *s, double *dense, const pm_islands *islands)
{
    const pm_model *m = w->model;
    int n_free = 0;
    for (int i = 0; i < m->nq; i++) n_free += w->inverse_mass[i] > 0;
    if (s->block + s->n >= n_free) return PM_OK; /* all is settled */
    for (int i = 0; i < m->nbody; i++)
        for (int k = 2; k >= 0; k--) { /* the spin first, then the velocity of G */
            double miss;
            if (w->inverse_mass[3 * i + k] == 0) continue;
            memset(dense, 0, (size_t)m->nq * sizeof *dense);
            dense[3 * i + k] = 1;
            const int n = s->n;
            if (!islands->fastened[i] || left_alone(w, islands, i)) {
                take(w, s, dense, 0, &miss);
                continue;
            }
            pm_basis_rest rest;
            if (add_row(w, s, dense, &rest) > n && rest.left > OPEN_PART)
                return pm_fail(w, PM_START_OPEN, PM_TABLE_BODY, i, k, rest.left);
        }
    return PM_OK;
}

/* Solves for the velocities; contacts that rest and never slip hold like joints if `with_contacts`. */
static int solve_velocities(pm_workspace *w, int with_contacts)
{
    const pm_model *m = w->model;
    double *x = w->scratch, *dense = x + m->nq;
    pm_islands islands = {(int *)(void *)(dense + 2 * m->nq), NULL, NULL};
    islands.fastened = (unsigned char *)(islands.island + m->nbody);
    islands.written = islands.fastened + m->nbody + 1;
    pm_solution s = {.x = x, .across = dense + m->nq};
    memset(x, 0, (size_t)m->nq * sizeof *x);
    for (int i = 0; i < m->nbody; i++) islands.island[i] = i;
    memset(islands.fastened, 0, 2 * (size_t)m->nbody + 1);
    hold_joints(w, &s, dense, &islands);
    if (with_contacts) hold_contacts(w, &s, dense, &islands);
    int status = take_written(w, &s, dense, &islands);
    if (!status) status = settle_rest(w, &s, dense, &islands);
    pm_active_clear(w);
    memcpy(w->state.v, x, (size_t)m->nq * sizeof *x);
    return status;
}

/* A rough contact that touches, neither approaches nor parts, and yet slips: that cannot be. */
static int rough_contact_slips(pm_workspace *w)
{
    pm_frame_look_state(w, &w->state);
    pm_case_speed(w, w->state.v);
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        double rate;
        if (pm_contact_friction(w->model, i) != PM_FRICTION_ROUGH) continue;
        if (!pm_contact_touches(w, &w->state, i, &member)) continue;
        pm_contact_member_gap(w, i, member, &rate);
        if (fabs(rate) > AGREES * w->speed) continue;
        if (fabs(pm_contact_member_slip(w, i, member)) > AGREES * w->speed) return 1;
    }
    return 0;
}

/* What is written may break a resting contact: that is no contradiction but a blow, or a parting, at t = 0. */
static int velocities(pm_workspace *w)
{
    if (!any_velocity_written(w)) return PM_OK; /* at rest */
    const int status = solve_velocities(w, 1);
    if (status != PM_START_CONFLICT) return status;
    const pm_where where = w->where;
    if (solve_velocities(w, 0) == PM_OK && !rough_contact_slips(w)) return PM_OK;
    w->where = where;
    return status;
}

/* No contact may overlap at the start. */
static int check_overlap(pm_workspace *w)
{
    for (int i = 0; i < w->model->rows[PM_TABLE_CONTACT]; i++) {
        int member;
        const double gap = pm_contact_gap(w, &w->state, i, &member);
        if (gap >= -pm_contact_length(w) || !pm_contact_touches(w, &w->state, i, &member)) continue;
        pm_fail(w, PM_PENETRATION, PM_TABLE_CONTACT, i, gap, -pm_contact_length(w));
        w->where.member = member;
        return PM_PENETRATION;
    }
    return PM_OK;
}

int pm_start(pm_workspace *w, pm_start_report *report)
{
    *report = (pm_start_report){0, 0};
    pm_active_clear(w);
    draw(w);
    int status = assemble(w, report);
    if (!status) status = check_couplings(w);
    if (status) return status;
    pm_active_anchor_start(w, &w->state);
    if ((status = velocities(w)) || (status = check_overlap(w))) return status;
    pm_frame_look_state(w, &w->state);
    pm_case_speed(w, w->state.v);
    if ((status = pm_spin_start(w))) return status;
    pm_state_copy(&w->start, &w->state);
    return PM_OK;
}

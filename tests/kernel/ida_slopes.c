/* The blocks of ida's Newton matrix on random scenes with every kind of force, each program reading measures of every kind, against differences of what they are derivatives of, extrapolated twice (Richardson). */
#include "check.h"
#include "elements/constraint.h"
#include "elements/force.h"
#include "elements/measure.h"
#include "equations/ledger.h"
#include "equations/saddle.h"
#include "routes/ida/ida.h"
#include "scene.h"
#include "state/workspace.h"

enum { MOST = 400, BODIES = 5, ROUNDS = 40 };

typedef struct marks {
    int body[BODIES + 1], point[2 * BODIES], ground, contact, floor;
    int spring, torsion, damper, rotary, near, apart, slips[2];
    int turns; /* the plane does */
} marks;

static double any(void) { return check_random(-1, 1); }

static int one_of(int n) { return (int)check_random(0, n - 1e-9); }

/* What is at (x, y) of a body at its start. */
typedef struct pose {
    double x, y, angle;
} pose;

static pose seen(pose b, double x, double y)
{
    return (pose){b.x + cos(b.angle) * x - sin(b.angle) * y, b.y + sin(b.angle) * x + cos(b.angle) * y,
                  b.angle};
}

static int body_at(scene *s, pose b)
{
    return scene_body(s, check_random(0.5, 2), check_random(0.03, 0.3), b.x, b.y, b.angle);
}

/* It slides along a parabola, with friction or without, and waits to meet a point of the first rod. */
static void bead(scene *s, marks *x, int rubs)
{
    const scene_code place = scene_m(scene_measure(s, PM_MEASURE_PLACE, PM_NONE)), mul = scene_op(PM_OP_MUL);
    const double at = any();
    const int y = SCENE_PROGRAM(s, place, place, mul, scene_k(s, 0.4), mul);
    const int curve = SCENE_ROW(s, PM_TABLE_CURVE, scene_point(s, PM_GROUND, -4, 0), SCENE_PROGRAM(s, place),
                                y, scene_value(s, -3), scene_value(s, 3), 0, 1, PM_NONE);
    x->body[5] = body_at(s, (pose){at - 4, 0.4 * at * at, any()});
    const int centre = scene_point(s, x->body[5], 0, 0),
              slot = scene_joint(s, PM_JOINT_SLOT, centre, curve, 0);
    if (rubs) scene_force(s, PM_FORCE_FRICTION, slot, slot, 0.3, 0.2);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, centre, PM_PART_X), 0.7);
    scene_start_omega(s, x->body[5], any());
    x->apart = scene_capture(s, PM_CONTACT_POINT, scene_circle(s, centre, 0), scene_circle(s, x->point[0], 0),
                             0, PM_CAPTURE_POINT);
}

/* It slips between bodies that move as they do. */
static int belt(scene *s, const marks *x, int crossed)
{
    const int one = scene_circle(s, x->point[4], 0.11), other = scene_circle(s, x->point[0], 0.06);
    const int joint = scene_belt(s, PM_JOINT_BELT_SLIPS, one, other, crossed ? -1 : 1, 20);
    scene_force(s, PM_FORCE_FRICTION, joint, joint, 1.3, 0);
    return joint;
}

/* Two rods in a chain whose first pin rubs by its load, a body on a link and on a cord's drum, a belt between two of them, a disk that rolls on a floor and a
 * block that slides on it with friction. */
static marks bodies(scene *s, int rubs)
{
    marks x;
    const double p = any(), q = any(), r = 0.3;
    const pose place[BODIES] = {{cos(p), 3 + sin(p), p},
                                {2 * cos(p) + cos(q), 3 + 2 * sin(p) + sin(q), q},
                                {1.5 + any(), 6 + any(), any()},
                                {0.4 * any(), r, any()},
                                {4, 0.1, 0}};
    for (int i = 0; i < BODIES; i++) x.body[i] = body_at(s, place[i]);
    x.ground = scene_point(s, PM_GROUND, 0, 3);
    for (int i = 0; i < BODIES; i++) {
        x.point[2 * i] = scene_point(s, x.body[i], any(), any());
        x.point[2 * i + 1] = scene_point(s, x.body[i], 0.5 * any(), 0.5 * any());
    }
    const int hinge = scene_joint(s, PM_JOINT_PIN, scene_point(s, x.body[0], -1, 0), x.ground, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, x.body[1], -1, 0), scene_point(s, x.body[0], 1, 0), 0);
    const pose from = seen(place[2], 0.2, 0.1), to = seen(place[1], 1, 0);
    scene_joint(s, PM_JOINT_LINK, scene_point(s, x.body[2], 0.2, 0.1), scene_point(s, x.body[1], 1, 0),
                hypot(from.x - to.x, from.y - to.y));
    x.floor = scene_floor(s, 0);
    const int rim = scene_circle(s, scene_point(s, x.body[3], 0, 0), r);
    scene_joint(s, PM_JOINT_ROLLING_LINE, rim, x.floor, 0);
    for (int side = -1; side <= 1; side += 2)
        x.contact =
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, x.body[4], 0.2 * side, -0.1), 0),
                          x.floor, 0, 0, PM_FRICTION_COULOMB, 0.3);
    x.near = scene_contact(s, PM_CONTACT_CIRCLE, rim, scene_circle(s, x.point[5], 0.2), 1, 0,
                           PM_FRICTION_SMOOTH, 0);
    scene_force(s, PM_FORCE_FRICTION, hinge, hinge, 0.4, 0.05);
    x.slips[0] = hinge;
    x.slips[1] = belt(s, &x, rubs);
    bead(s, &x, rubs);
    const double omega[] = {1.3, any(), any(), any()};
    for (int i = 0; i < 4; i++) scene_start_omega(s, x.body[i], omega[i]);
    scene_start(s, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, x.point[4], PM_PART_X), any());
    scene_start_velocity(s, scene_point(s, x.body[4], 0, 0), 2, 0);
    return x;
}

/* ---- forces ---- */
static void plain_forces(scene *s, marks *x)
{
    x->spring = scene_force(s, PM_FORCE_SPRING, x->point[one_of(10)], x->ground, 20, 0.4);
    scene_cell(s, PM_TABLE_FORCE, x->spring, PM_FORCE_OPTION, one_of(3));
    scene_force(s, PM_FORCE_SPRING, x->point[0], x->point[4], 30, 0.7);
    x->torsion = scene_force(s, PM_FORCE_TORSION, x->body[0], x->body[one_of(2) + 1], 7, 0.2);
    x->damper = scene_force(s, PM_FORCE_DAMPER, x->point[2], x->point[6 + one_of(4)], 3, 0);
    x->rotary = scene_force(s, PM_FORCE_ROTARY_DAMPER, x->body[3], x->body[one_of(3)], 0.4, 0);
}

/* A measure that forces may read: number n of so many. */
enum { READ = 38 };

static int measure(scene *s, const marks *x, int n)
{
    const int body = x->body[one_of(BODIES)], other = x->body[one_of(BODIES)], point = x->point[one_of(10)];
    const int part = 1 + one_of(5), line[] = {x->spring, x->damper}, turn[] = {x->torsion, x->rotary};
    const int along = part == PM_PART_ALONG ? scene_value(s, any()) : PM_NONE;
    int row = PM_NONE;
    switch (n) {
    case 0: row = scene_measure(s, PM_MEASURE_TIME, PM_NONE); break;
    case 1: row = scene_measure_with(s, PM_MEASURE_ANGLE, body, 0, PM_MEASURE_IN, other); break;
    case 2: row = scene_measure(s, PM_MEASURE_TURNED, body); break;
    case 3: row = scene_measure(s, PM_MEASURE_OMEGA, body); break;
    case 4: row = scene_measure_with(s, PM_MEASURE_OMEGA, body, 0, PM_MEASURE_IN, other); break;
    case 5: row = scene_measure(s, PM_MEASURE_MASS, body); break;
    case 6: row = scene_measure_with(s, PM_MEASURE_INERTIA, body, 0, PM_MEASURE_ABOUT, point); break;
    case 7: row = scene_measure(s, PM_MEASURE_KINETIC, body); break;
    case 8: row = scene_measure(s, PM_MEASURE_KINETIC, PM_NONE); break;
    case 9: row = scene_part(s, PM_MEASURE_MOMENTUM, body, part); break;
    case 10: row = scene_part(s, PM_MEASURE_MOMENTUM, PM_NONE, part); break;
    case 11: row = scene_measure(s, PM_MEASURE_ANGULAR_MOMENTUM, body); break;
    case 12:
        row = scene_measure_with(s, PM_MEASURE_ANGULAR_MOMENTUM, body, 0, PM_MEASURE_ABOUT, point);
        break;
    case 13: row = scene_measure(s, PM_MEASURE_ANGULAR_MOMENTUM, PM_NONE); break;
    case 14: row = scene_part(s, PM_MEASURE_POLE, x->body[one_of(4)], part); break;
    case 15: row = scene_part(s, PM_MEASURE_POSITION, point, part); break;
    case 16: row = scene_measure_with(s, PM_MEASURE_POSITION, point, part, PM_MEASURE_IN, other); break;
    case 17: row = scene_part(s, PM_MEASURE_MOVED, point, 1 + one_of(2)); break; /* it has no direction yet */
    case 18: row = scene_part(s, PM_MEASURE_VELOCITY, point, part); break;
    case 19: row = scene_measure_with(s, PM_MEASURE_VELOCITY, point, part, PM_MEASURE_IN, other); break;
    case 20: row = scene_measure(s, PM_MEASURE_CONTACT_GAP, x->near); break;
    case 21: row = scene_measure(s, PM_MEASURE_CONTACT_GAP, x->contact); break;
    case 22: row = scene_measure(s, PM_MEASURE_CONTACT_SLIP, x->contact); break;
    case 23: row = scene_measure(s, PM_MEASURE_FORCE_STRETCH, line[one_of(2)]); break;
    case 24: row = scene_measure(s, PM_MEASURE_FORCE_STRETCH, turn[one_of(2)]); break;
    case 25: row = scene_measure(s, PM_MEASURE_FORCE_RATE, line[one_of(2)]); break;
    case 26: row = scene_measure(s, PM_MEASURE_FORCE_RATE, turn[one_of(2)]); break;
    case 27: row = scene_part(s, PM_MEASURE_FORCE_FORCE, line[one_of(2)], part); break;
    case 28: row = scene_measure(s, PM_MEASURE_FORCE_COUPLE, turn[one_of(2)]); break;
    case 29:
        row = scene_measure(s, PM_MEASURE_FORCE_POWER, one_of(2) ? line[one_of(2)] : turn[one_of(2)]);
        break;
    case 30: row = scene_measure(s, PM_MEASURE_FORCE_ENERGY, one_of(2) ? x->spring : x->torsion); break;
    case 31: row = scene_measure(s, PM_MEASURE_FORCE_WORK, one_of(2) ? x->spring : x->torsion); break;
    case 32: row = scene_measure(s, PM_MEASURE_POTENTIAL, PM_NONE); break;
    case 33: row = scene_measure(s, PM_MEASURE_CONTACT_GAP, x->apart); break;
    case 34: row = scene_measure(s, x->turns ? PM_MEASURE_SPIN_OMEGA : PM_MEASURE_TIME, PM_NONE); break;
    case 35: row = scene_measure(s, x->turns ? PM_MEASURE_SPIN_INERTIA : PM_MEASURE_TIME, PM_NONE); break;
    case 36: row = scene_measure(s, PM_MEASURE_JOINT_SLIP, x->slips[one_of(2)]); break;
    default: row = scene_measure(s, PM_MEASURE_TOTAL, PM_NONE);
    }
    if (along != PM_NONE) scene_cell(s, PM_TABLE_MEASURE, row, PM_MEASURE_VALUE, along);
    return row;
}

/* Pushes a measure, a slip where the contact is closed and else 0; returns the length of the code. */
static int push(scene *s, const marks *x, scene_code *code)
{
    const int n = one_of(READ), row = measure(s, x, n);
    code[0] = scene_m(scene_measure(s, PM_MEASURE_CONTACT_CLOSED, x->contact));
    code[n == 22] = scene_m(row);
    code[2] = scene_k(s, 0);
    code[3] = scene_op(PM_OP_SELECT);
    return n == 22 ? 4 : 1;
}

/* 2 tanh(m / 3) m' + sin(m'') of three measures. */
static int program(scene *s, const marks *x)
{
    scene_code code[32];
    int n = push(s, x, code);
    code[n++] = scene_k(s, 3);
    code[n++] = scene_op(PM_OP_DIV);
    code[n++] = scene_op(PM_OP_TANH);
    n += push(s, x, code + n);
    code[n++] = scene_op(PM_OP_MUL);
    code[n++] = scene_k(s, 2);
    code[n++] = scene_op(PM_OP_MUL);
    n += push(s, x, code + n);
    code[n++] = scene_op(PM_OP_SIN);
    code[n++] = scene_op(PM_OP_ADD);
    return scene_program(s, n, code);
}

static void forces_of_motion(scene *s, const marks *x)
{
    scene_applied(s, x->point[one_of(10)], x->body[one_of(BODIES)], program(s, x), program(s, x));
    scene_couple(s, x->body[one_of(2)], x->body[2 + one_of(3)], program(s, x));
    SCENE_ROW(s, PM_TABLE_FORCE, PM_FORCE_LINE, x->point[one_of(4)], x->point[4 + one_of(6)], PM_NONE,
              PM_NONE, program(s, x), PM_NONE, 0);
}

/* ---- differences ---- */
/* M^-1 (f + H^T lambda), G v, z' */
static void look(pm_workspace *w, const double *y, const double *yp, double *out)
{
    const int nq = w->model->nq;
    pm_ida_system_look(w, w->state.t, y, yp);
    for (int i = 0; i < nq; i++) out[i] = w->numbers.inverse_mass[i] * w->frame.f[i];
    memcpy(w->saddle.rhs, w->frame.lambda, (size_t)w->active.n * sizeof(double));
    pm_saddle_spread(&w->saddle, 1, out);
    for (int i = 0; i < w->active.n; i++)
        out[nq + i] = pm_constraint_times(&w->frame, &w->active.constraint[i], y + nq);
    pm_ledger_rates(w, out + nq + w->active.n);
}

/* Along one unknown of y, or of y' where that is what changes; rest: what extrapolation changed last. */
static void difference(pm_workspace *w, double *y, double *yp, double *changes, double h, int n, double *out,
                       double *rest)
{
    double level[3][MOST], side[2][MOST];
    const double old = *changes;
    for (int l = 0; l < 3; l++) {
        const double step = h / (1 << l);
        for (int k = 0; k < 2; k++) {
            *changes = k ? old + step : old - step;
            look(w, y, yp, side[k]);
        }
        *changes = old;
        for (int i = 0; i < n; i++) level[l][i] = (side[1][i] - side[0][i]) / (2 * step);
    }
    for (int i = 0; i < n; i++) {
        const double once = (4 * level[1][i] - level[0][i]) / 3, twice = (4 * level[2][i] - level[1][i]) / 3;
        out[i] = (16 * twice - once) / 15;
        rest[i] = fabs(twice - once);
    }
}

static void near_all(int n, const double *found, int stride, const double *expected, const double *rest,
                     const char *what, int column, int number)
{
    double most = 1;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(expected[i]));
    for (int i = 0; i < n; i++)
        if (!NEAR(found[i * stride], expected[i], 1e-6 * most + rest[i]))
            fprintf(stderr, "  %s, row %d, column %d, scene %d\n", what, i, column, number);
}

/* Where friction goes along a curve the blocks have its direction on the curve: they are those of motions that keep to it. */
static void along_constraints(pm_workspace *w, double *block, int rows, int stride, int across)
{
    const int nq = w->model->nq;
    for (int i = 0; i < rows; i++) {
        double row[MOST] = {0};
        for (int r = 0; r < nq; r++)
            for (int k = 0; k < nq; k++)
                row[r] += w->ida->jacobian.project[r * nq + k] * block[i * stride + k * across];
        for (int r = 0; r < nq; r++) block[i * stride + r * across] = row[r];
    }
}

enum { LARGEST = 80 };

static double by_place[MOST * LARGEST], by_place_rest[MOST * LARGEST];

static void check_places(pm_workspace *w, double *y, double *yp, int n, int projects, int number)
{
    pm_ida_jacobian *x = &w->ida->jacobian;
    const int nq = w->model->nq, na = w->active.n, nz = w->model->nz;
    double *ledger = x->ledger + w->model->nconstraint * nz;
    for (int k = 0; k < nq; k++)
        difference(w, y, yp, &y[k], 3e-4, n, by_place + k * n, by_place_rest + k * n);
    if (projects) {
        EQUAL(pm_ida_linear_factor(w), PM_OK);
        along_constraints(w, by_place, n, 1, n);
        along_constraints(w, x->stiffness, nq, nq, 1);
        along_constraints(w, x->gv_slope, na, nq, 1);
        along_constraints(w, ledger, nz, 1, nz);
    }
    for (int k = 0; k < nq; k++) {
        const double *d = by_place + k * n, *e = by_place_rest + k * n;
        near_all(nq, x->stiffness + k, nq, d, e, "stiffness", k, number);
        near_all(na, x->gv_slope + k, nq, d + nq, e + nq, "d(G v)/dq", k, number);
        near_all(nz, ledger + k * nz, 1, d + nq + na, e + nq + na, "dz'/dq", k, number);
    }
}

static void check_others(pm_workspace *w, double *y, double *yp, int n, int number)
{
    const pm_ida_jacobian *x = &w->ida->jacobian;
    const int nq = w->model->nq, na = w->active.n, nz = w->model->nz, z = nq + na;
    double d[MOST], e[MOST], by_mass[MOST];
    for (int k = 0; k < nq; k++) {
        difference(w, y, yp, &y[nq + k], 3e-4, n, d, e);
        near_all(nq, x->damping + k, nq, d, e, "damping", k, number);
        near_all(nz, x->ledger + (w->model->nconstraint + nq + k) * nz, 1, d + z, e + z, "dz'/dv", k, number);
    }
    for (int k = 0; k < na; k++) {
        difference(w, y, yp, &yp[pm_ida_place_l(w->model) + k], 1e-3, n, d, e);
        for (int i = 0; i < nq; i++) by_mass[i] = w->numbers.inverse_mass[i] * x->h[k * nq + i];
        near_all(nq, by_mass, 1, d, e, "M^-1 H^T", k, number);
        near_all(nz, x->ledger + k * nz, 1, d + z, e + z, "dz'/dlambda", k, number);
    }
}

static void check_blocks(scene *s, int projects, int number)
{
    double y[MOST] = {0}, yp[MOST] = {0};
    pm_workspace *w = s->w;
    pm_ida_system_layout(w);
    EQUAL(pm_ida_system_start(w, y, yp), PM_OK);
    const int nq = w->model->nq, na = w->active.n, n = nq + na + w->model->nz;
    if (!CHECK(w->ida->n <= MOST) || !CHECK(n <= LARGEST)) return;
    for (int i = 0; i < nq; i++) y[nq + i] += 0.3 * any(); /* not as the constraints have it */
    for (int i = 0; i < na; i++) yp[pm_ida_place_l(w->model) + i] += any();
    pm_ida_jacobian_evaluate(w, w->state.t, 24, y, yp);
    check_others(w, y, yp, n, number);
    check_places(w, y, yp, n, projects, number);
}

/* About the vertical through (1, 0), with a couple that reads the motion. */
static void turning_plane(scene *s, const marks *x)
{
    for (int i = 0; i < s->rows[PM_TABLE_BODY]; i++)
        SCENE_ROW(s, PM_TABLE_SECOND, scene_value(s, check_random(0, 0.2)),
                  scene_value(s, check_random(0, 0.2)), scene_value(s, check_random(0, 0.2)));
    SCENE_ROW(s, PM_TABLE_SPIN, scene_value(s, 1), scene_value(s, 0), scene_value(s, acos(0)),
              scene_value(s, 0.5), scene_value(s, 1.5), program(s, x));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_SPIN_ANGLE, PM_NONE));
}

static void random_scene(int number)
{
    scene *s = scene_create();
    *scene_setting(s, PM_SETTING_ROUTE) = PM_ROUTE_IDA;
    const int rubs = number % 2;
    marks x = bodies(s, rubs);
    x.turns = number % 3 == 0;
    plain_forces(s, &x);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_PATH, x.point[one_of(8)]));
    if (x.turns) turning_plane(s, &x);
    forces_of_motion(s, &x);
    if (EQUAL(scene_begin(s), PM_OK)) check_blocks(s, rubs, number);
    scene_free(s);
}

int main(void)
{
    for (int i = 0; i < ROUNDS; i++) random_scene(i);
    return check_failures();
}

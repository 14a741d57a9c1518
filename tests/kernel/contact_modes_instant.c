/* A box in a gutter lies flat on one wall but for a hair.  Its corner C sticks to the other wall; B, in the corner below C, slides along
 * the first wall, at right angles to BC.  To the first order C alone holds B, to the second B leaves its wall.  Their equations with
 * friction at B are solved by rounding, if at all: no load at B is told by them.  The box turns about C.
 * So it does where it is tilted a little more and B is open by rounding: to close that gap it would have to go to another place.
 *
 * Where friction cannot hold C, both corners may push: then C slips to the second order alone, whichever way it is tilted and turns,
 * and how B and C share their loads goes with the friction against that slip.  All motions are enumerated.
 *
 * At rest and tilted by more than rounding, it turns, slips or stays, as the laws say of the walls as they are. */
#include "check.h"
#include "elements/contact.h"
#include "equations/active_set.h"
#include "impact/contact_modes.h"
#include "numerics/dense.h"
#include "scene.h"
#include "state/frame.h"

#define G 9.81
#define HIGHER 1.0 /* m, where it starts */

typedef struct gutter {
    double mass, inertia, wide, high, one, other, mu, omega, hair, gap;
    int b, c; /* slots */
} gutter;

typedef struct places {
    double b[2], c[2], centre[2];
} places;

static gutter random_gutter(double hair, int rests)
{
    const int b = check_random(-1, 1) > 0;
    gutter x = {
        .mass = check_random(0.5, 5),
        .wide = check_random(0.05, 0.4),
        .high = check_random(0.05, 0.4),
        .one = -check_random(0.8, 1.2),
        .other = check_random(0.8, 1.2),
        .mu = check_random(0.2, 1),
        .omega = rests ? 0 : copysign(pow(10, check_random(-7, -4)), check_random(-1, 1)),
        .hair = hair,
        .b = b,
        .c = 1 - b,
    };
    x.inertia = x.mass * (x.wide * x.wide + x.high * x.high) / 12;
    return x;
}

/* From the foot of the gutter. */
static places places_of(const gutter *x)
{
    const double angle = x->one + x->hair, c = cos(angle), d = sin(angle);
    const double way = x->high * cos(x->other - angle) / sin(x->one - x->other); /* of B up its wall */
    places p = {.b = {-way * cos(x->one), -way * sin(x->one)}};
    p.c[0] = p.b[0] - x->high * d;
    p.c[1] = p.b[1] + x->high * c;
    const double up = x->gap / sin(x->other - x->one); /* along the wall of C */
    for (int i = 0; i < 2; i++) {
        p.b[i] += up * (i ? sin(x->other) : cos(x->other));
        p.c[i] += up * (i ? sin(x->other) : cos(x->other));
    }
    p.centre[0] = p.c[0] - 0.5 * (x->wide * c - x->high * d);
    p.centre[1] = p.c[1] - 0.5 * (x->wide * d + x->high * c);
    return p;
}

/* Its angular acceleration about C; *holds: whether friction can hold C then, 1 or 0; -1: just, or just not. */
static double turns(const gutter *x, const places *p, int *holds)
{
    const double r[2] = {p->centre[0] - p->c[0], p->centre[1] - p->c[1]};
    const double alpha = -x->mass * G * r[0] / (x->inertia + x->mass * (r[0] * r[0] + r[1] * r[1]));
    const double force[2] = {-alpha * r[1], alpha * r[0] + G}; /* by mass */
    const double normal = -sin(x->other) * force[0] + cos(x->other) * force[1],
                 tangent = cos(x->other) * force[0] + sin(x->other) * force[1];
    const double share = normal > 0 ? fabs(tangent) / (x->mu * normal) : INFINITY;
    *holds = share < 0.99 ? 1 : share > 1.01 ? 0 : -1;
    return alpha;
}

static void add_box(scene *s, const gutter *x, const places *p)
{
    const int box = scene_body(s, x->mass, x->inertia, p->centre[0], p->centre[1] + HIGHER, x->one + x->hair);
    for (int i = 0; i < 2; i++) {
        const int is_c = i == x->c,
                  corner = scene_point(s, box, 0.5 * x->wide, is_c ? 0.5 * x->high : -0.5 * x->high);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, corner, 0),
                      scene_floor(s, is_c ? x->other : x->one), 0, 0.5, PM_FRICTION_COULOMB, x->mu);
    }
}

/* So many boxes that do not see each other, each for itself. */
static scene *in_the_air(const gutter *x, const places *p, int boxes)
{
    scene *s = scene_create();
    for (int k = 0; k < boxes; k++) add_box(s, x, p);
    scene_until_time(s, 1);
    return s;
}

/* They have come down and turn about C; both corners are closed. */
static void lay(pm_workspace *w, const gutter *x, const places *p)
{
    for (int k = 0; k < w->model->nbody; k++) {
        double *q = w->state.q + 3 * k, *v = w->state.v + 3 * k;
        q[1] -= HIGHER;
        v[0] = -x->omega * (p->centre[1] - p->c[1]);
        v[1] = x->omega * (p->centre[0] - p->c[0]);
        v[2] = x->omega;
        w->state.slot[2 * k + x->c].mode = PM_STICK;
        w->state.slot[2 * k + x->b].mode = x->omega > 0   ? PM_SLIDE_FORWARD
                                           : x->omega < 0 ? PM_SLIDE_BACKWARD
                                                          : PM_STICK;
    }
    memset(w->instant.slot_released, 0, (size_t)w->model->nslot);
    pm_frame_look_state(&w->frame, &w->state);
    for (int i = 0; i < w->model->nslot; i++) pm_active_set_anchor(&w->frame, &w->state, i);
}

/* 1 if C could be held. */
static int turns_about_c(double hair, double gap)
{
    gutter x = random_gutter(hair, 0);
    x.gap = gap;
    const places p = places_of(&x);
    int holds;
    const double alpha = turns(&x, &p, &holds);
    if (holds != 1) return 0;
    scene *s = in_the_air(&x, &p, 1);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    lay(w, &x, &p);
    EQUAL(pm_contact_modes_settle(w), PM_OK);
    EQUAL(w->state.slot[x.b].mode, PM_OPEN);
    EQUAL(w->state.slot[x.c].mode, PM_STICK);
    NEAR(w->frame.a[2], alpha, 1e-6 * alpha);
    NEAR(w->state.q[2], x.one + x.hair, 1e-9);
    scene_free(s);
    return 1;
}

/* ---- C cannot be held ---- */
typedef struct one_motion {
    double alpha;
    int way; /* of the slip at C where both corners push; 0: one of them does not */
} one_motion;

/* Force by unit normal load at a corner that slips that way, its normal, and what the normal row makes of the velocities' turning. */
static double push(const gutter *x, const places *p, int corner, int way, double n[3], double force[3])
{
    const double *at = corner ? p->c : p->b, wall = corner ? x->other : x->one;
    const double r[2] = {at[0] - p->centre[0], at[1] - p->centre[1]}, u[2] = {-sin(wall), cos(wall)};
    for (int i = 0; i < 2; i++) {
        n[i] = u[i];
        force[i] = u[i] - way * x->mu * (i ? sin(wall) : cos(wall));
    }
    n[2] = r[0] * n[1] - r[1] * n[0];
    force[2] = r[0] * force[1] - r[1] * force[0];
    return -x->omega * x->omega * (r[0] * n[0] + r[1] * n[1]);
}

/* Accelerations where so many corners push, from `first` on, that slip those ways; 0 if a load pulls. */
static int pushed(const gutter *x, const places *p, int first, int corners, const int way[2], double a[3])
{
    const double by[3] = {1 / x->mass, 1 / x->mass, 1 / x->inertia};
    double n[2][3], force[2][3], rows[4], load[2] = {0};
    int pivot[2];
    for (int i = 0; i < corners; i++)
        load[i] =
            G * cos(first + i ? x->other : x->one) - push(x, p, first + i, way[first + i], n[i], force[i]);
    for (int i = 0; i < corners * corners; i++) {
        rows[i] = 0;
        for (int k = 0; k < 3; k++) rows[i] += n[i / corners][k] * by[k] * force[i % corners][k];
    }
    if (pm_dense_lu_factor(corners, rows, pivot)) return 0;
    pm_dense_lu_solve(corners, rows, pivot, load);
    for (int k = 0; k < 3; k++) {
        a[k] = k == 1 ? -G : 0;
        for (int i = 0; i < corners; i++) a[k] += by[k] * force[i][k] * load[i];
    }
    for (int i = 0; i < corners; i++)
        if (load[i] < 0) return 0;
    return 1;
}

/* Acceleration of a corner, along the normal or the tangent of its wall. */
static double goes(const gutter *x, const places *p, int corner, int along, const double a[3])
{
    const double *at = corner ? p->c : p->b, wall = corner ? x->other : x->one;
    const double r[2] = {at[0] - p->centre[0], at[1] - p->centre[1]}, square = x->omega * x->omega;
    const double d[2] = {along ? cos(wall) : -sin(wall), along ? sin(wall) : cos(wall)};
    return d[0] * (a[0] - a[2] * r[1] - square * r[0]) + d[1] * (a[1] + a[2] * r[0] - square * r[1]);
}

/* Both corners push, and BC has turned by phi from the normal of the wall of B: C is high cos(phi) above that wall, and slips down the
 * other one where phi^2 grows.  A hair of rounding counts as none; -1 where it may or may not be that. */
static int may_slip(const gutter *x, int way)
{
    const int down = cos(x->other) > 0 ? -1 : 1;
    if (fabs(x->hair) < 1e-14) return way == down;
    return fabs(x->hair) < 1e-11 ? -1 : way == (x->hair * x->omega > 0 ? down : -down);
}

/* All that the laws allow where B slips and C does not yet; 0 where that is not clear. */
static int motions(const gutter *x, const places *p, one_motion *found)
{
    int n = 0;
    double a[3];
    for (int c = -1; c <= 1; c += 2) {
        const int way[2] = {x->omega > 0 ? 1 : -1, c};
        if (pushed(x, p, 1, 1, way, a) && goes(x, p, 0, 0, a) > 0 && c * goes(x, p, 1, 1, a) > 0)
            found[n++] = (one_motion){a[2], 0};
        if (pushed(x, p, 0, 2, way, a)) {
            const int may = may_slip(x, c);
            if (may < 0) return 0;
            if (may) found[n++] = (one_motion){a[2], c};
        }
        if (c > 0 && pushed(x, p, 0, 1, way, a) && goes(x, p, 1, 0, a) > 0)
            found[n++] = (one_motion){a[2], 0};
    }
    return n;
}

/* 1 where both corners push and C slips, held by B to the first order. */
static int slips_at_c(double hair, int boxes)
{
    const gutter x = random_gutter(hair, 0);
    const places p = places_of(&x);
    one_motion of[6];
    int holds;
    (void)turns(&x, &p, &holds);
    const int n = motions(&x, &p, of);
    if (holds != 0 || n != 1) return 0;
    scene *s = in_the_air(&x, &p, boxes);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    lay(w, &x, &p);
    EQUAL(pm_contact_modes_settle(w), PM_OK);
    for (int k = 0; k < boxes; k++) {
        NEAR(w->frame.a[3 * k + 2], of[0].alpha, 1e-6 * fabs(of[0].alpha));
        NEAR(w->frame.v[3 * k + 2], x.omega, 1e-8 * fabs(x.omega));
        if (of[0].way != 0)
            EQUAL(w->state.slot[2 * k + x.c].mode, of[0].way > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD);
    }
    scene_free(s);
    return of[0].way != 0;
}

/* ---- at rest ---- */
/* Loads by unit normal load; a last one, where they are two, that does nothing. */
typedef struct generators {
    double of[4][3];
    int n, pushing;
} generators;

/* Of a corner at `at` with accelerations a: in the cone, against what slips, none where it parts; 0: it goes into the wall. */
static int add_generators(generators *g, const gutter *x, const places *p, int corner, const double a[3])
{
    const double *at = corner ? p->c : p->b, wall = corner ? x->other : x->one;
    const double r[2] = {at[0] - p->centre[0], at[1] - p->centre[1]}, n[2] = {-sin(wall), cos(wall)},
                 t[2] = {cos(wall), sin(wall)}, rate[2] = {a[0] - a[2] * r[1], a[1] + a[2] * r[0]};
    const double parts = rate[0] * n[0] + rate[1] * n[1], slips = rate[0] * t[0] + rate[1] * t[1];
    for (int way = -1; way <= 1 && parts < 1e-11 * G; way += 2) {
        if (way * slips < -1e-8 * G) continue;
        double *one = g->of[g->n++];
        for (int q = 0; q < 2; q++) one[q] = n[q] - way * x->mu * t[q];
        one[2] = r[0] * one[1] - r[1] * one[0];
    }
    return parts > -1e-11 * G;
}

/* Whether loads on three of them, none negative, make the accelerations a. */
static int three_make(const generators *g, int without, const gutter *x, const double a[3])
{
    double rows[9], load[3] = {x->mass * a[0], x->mass * (a[1] + G), x->inertia * a[2]};
    int pivot[3];
    for (int k = 0; k < 9; k++) rows[k] = g->of[(without + 1 + k % 3) % g->n][k / 3];
    if (pm_dense_lu_factor(3, rows, pivot)) return 0;
    pm_dense_lu_solve(3, rows, pivot, load);
    const double none = 1e-6 * x->mass * G;
    for (int k = 0; k < 3; k++)
        if (load[k] < -none || (load[k] > none && (without + 1 + k) % g->n >= g->pushing)) return 0;
    return 1;
}

/* Whether accelerations from rest obey the laws at both corners. */
static int obeys(const gutter *x, const places *p, const double a[3])
{
    generators g = {.n = 0};
    if (!add_generators(&g, x, p, 0, a) || !add_generators(&g, x, p, 1, a)) return 0;
    g.pushing = g.n;
    if (g.n == 2) {
        const double(*u)[3] = (const double(*)[3])g.of;
        for (int i = 0; i < 3; i++)
            g.of[2][i] = u[0][(i + 1) % 3] * u[1][(i + 2) % 3] - u[0][(i + 2) % 3] * u[1][(i + 1) % 3];
        g.n = 3;
    }
    for (int without = 0; without < g.n && g.n > 2; without++)
        if (three_make(&g, without, x, a)) return 1;
    return 0;
}

/* Tilted, and at rest: it stays, turns about C, or slips.  1 if several motions obey the laws. */
static int starts(double hair)
{
    const gutter x = random_gutter(hair, 1);
    const places p = places_of(&x);
    const double none[3] = {0}, alpha = turns(&x, &p, &(int){0});
    const double turn[3] = {-alpha * (p.centre[1] - p.c[1]), alpha * (p.centre[0] - p.c[0]), alpha};
    const int stays = obeys(&x, &p, none), goes = obeys(&x, &p, turn);
    scene *s = in_the_air(&x, &p, 1);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    lay(w, &x, &p);
    const int status = pm_contact_modes_settle(w);
    if (status != PM_NOT_UNIQUE) {
        EQUAL(status, PM_OK);
        CHECK(!(stays && goes));
        CHECK(obeys(&x, &p, w->frame.a));
    } else {
        CHECK(stays);
    }
    scene_free(s);
    return stays && goes;
}

int main(void)
{
    int held = 0;
    for (int i = 0; i < 2000; i++) {
        held += turns_about_c(0, 0);
        for (int side = -1; side <= 1; side += 2)
            held += turns_about_c(side * pow(10, -check_random(9.5, 17)), 0);
    }
    CHECK(held > 1000);
    int open = 0;
    for (int i = 0; i < 2000; i++)
        open += turns_about_c(pow(10, -check_random(4, 9)), pow(10, -check_random(9, 11)));
    CHECK(open > 500);
    int slips = 0;
    for (int i = 0; i < 4000; i++) {
        const int boxes = 1 + (i % 4 == 0);
        slips += slips_at_c(0, boxes);
        for (int side = -1; side <= 1; side += 2)
            slips += slips_at_c(side * pow(10, -check_random(9.05, 17)), boxes);
    }
    CHECK(slips > 3000);
    int several = 0;
    for (int i = 0; i < 3000; i++)
        for (int side = -1; side <= 1; side += 2) several += starts(side * pow(10, -check_random(4, 9.3)));
    CHECK(several > 100);
    return check_failures();
}

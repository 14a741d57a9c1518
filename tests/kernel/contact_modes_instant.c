/* A box in a gutter lies flat on one wall but for a hair.  Its corner C sticks to the other wall; B, in the corner below C, slides along
 * the first wall, at right angles to BC.  To the first order C alone holds B, to the second B leaves its wall.  Their equations with
 * friction at B are solved by rounding, if at all: no load at B is told by them.  The box turns about C. */
#include "check.h"
#include "elements/contact.h"
#include "equations/active_set.h"
#include "impact/contact_modes.h"
#include "scene.h"
#include "state/frame.h"

#define G 9.81
#define HIGHER 1.0 /* m, where it starts */

typedef struct gutter {
    double mass, inertia, wide, high, one, other, mu, omega, hair;
    int b, c; /* slots */
} gutter;

typedef struct places {
    double b[2], c[2], centre[2];
} places;

static gutter random_gutter(double hair)
{
    const int b = check_random(-1, 1) > 0;
    gutter x = {
        .mass = check_random(0.5, 5),
        .wide = check_random(0.05, 0.4),
        .high = check_random(0.05, 0.4),
        .one = -check_random(0.8, 1.2),
        .other = check_random(0.8, 1.2),
        .mu = check_random(0.2, 1),
        .omega = copysign(pow(10, check_random(-7, -4)), check_random(-1, 1)),
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
    p.centre[0] = p.c[0] - 0.5 * (x->wide * c - x->high * d);
    p.centre[1] = p.c[1] - 0.5 * (x->wide * d + x->high * c);
    return p;
}

/* Its angular acceleration about C; *holds: whether friction can hold C then. */
static double turns(const gutter *x, const places *p, int *holds)
{
    const double r[2] = {p->centre[0] - p->c[0], p->centre[1] - p->c[1]};
    const double alpha = -x->mass * G * r[0] / (x->inertia + x->mass * (r[0] * r[0] + r[1] * r[1]));
    const double force[2] = {-alpha * r[1], alpha * r[0] + G}; /* by mass */
    const double normal = -sin(x->other) * force[0] + cos(x->other) * force[1],
                 tangent = cos(x->other) * force[0] + sin(x->other) * force[1];
    *holds = fabs(tangent) < 0.99 * x->mu * normal;
    return alpha;
}

static scene *in_the_air(const gutter *x, const places *p)
{
    scene *s = scene_create();
    const int box = scene_body(s, x->mass, x->inertia, p->centre[0], p->centre[1] + HIGHER, x->one + x->hair);
    for (int i = 0; i < 2; i++) {
        const int is_c = i == x->c,
                  corner = scene_point(s, box, 0.5 * x->wide, is_c ? 0.5 * x->high : -0.5 * x->high);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, corner, 0),
                      scene_floor(s, is_c ? x->other : x->one), 0, 0.5, PM_FRICTION_COULOMB, x->mu);
    }
    scene_until_time(s, 1);
    return s;
}

/* It has come down and turns about C; both corners are closed. */
static void lay(pm_workspace *w, const gutter *x, const places *p)
{
    w->state.q[1] -= HIGHER;
    w->state.v[0] = -x->omega * (p->centre[1] - p->c[1]);
    w->state.v[1] = x->omega * (p->centre[0] - p->c[0]);
    w->state.v[2] = x->omega;
    w->state.slot[x->c].mode = PM_STICK;
    w->state.slot[x->b].mode = x->omega > 0 ? PM_SLIDE_FORWARD : PM_SLIDE_BACKWARD;
    memset(w->instant.slot_released, 0, (size_t)w->model->nslot);
    pm_frame_look_state(&w->frame, &w->state);
    for (int i = 0; i < 2; i++) pm_active_set_anchor(&w->frame, &w->state, i);
}

/* 1 if C could be held. */
static int turns_about_c(double hair)
{
    const gutter x = random_gutter(hair);
    const places p = places_of(&x);
    int holds;
    const double alpha = turns(&x, &p, &holds);
    if (!holds) return 0;
    scene *s = in_the_air(&x, &p);
    EQUAL(scene_begin(s), PM_OK);
    pm_workspace *w = s->w;
    lay(w, &x, &p);
    EQUAL(pm_contact_modes_settle(w), PM_OK);
    EQUAL(w->state.slot[x.b].mode, PM_OPEN);
    EQUAL(w->state.slot[x.c].mode, PM_STICK);
    NEAR(w->frame.a[2], alpha, 1e-6 * alpha);
    scene_free(s);
    return 1;
}

int main(void)
{
    int held = 0;
    for (int i = 0; i < 2000; i++) {
        held += turns_about_c(0);
        for (int side = -1; side <= 1; side += 2)
            held += turns_about_c(side * pow(10, -check_random(9.5, 17)));
    }
    CHECK(held > 1000);
    return check_failures();
}

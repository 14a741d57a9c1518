/* Blows: the laws of impulsive motion recomputed from the velocities before and after, for one contact struck or several,
 * with resting contacts, with joints, for every friction; and the awkward cases that have one right answer. */
#include "impact/impact.h"

#include "check.h"
#include "elements/constraint.h"
#include "elements/contact.h"
#include "equations/saddle.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define MOST 32
#define CLOSE 1e-11

typedef struct blow {
    int jumped;
    double before[MOST], after[MOST];
} blow;

static void look(pm_workspace *w, const double *v)
{
    pm_frame_look(&w->frame, 0, w->state.q, v, w->state.z, w->state.memory);
}

static double kinetic(pm_workspace *w, const double *v)
{
    look(w, v);
    return pm_frame_kinetic(&w->frame, PM_NONE);
}

/* Gives the assembled scene the velocities v at an instant; contact i rests before if bit i of `resting` is set. */
static blow strike(scene *s, const double *v, unsigned resting)
{
    pm_workspace *w = s->w;
    blow x = {.jumped = 0};
    double fastest = 0;
    for (int i = 0; i < w->model->nslot; i++)
        if (!(resting >> i & 1)) w->state.slot[i].mode = PM_OPEN;
    for (int i = 0; i < w->model->nq; i++) {
        w->state.v[i] = x.before[i] = v[i];
        fastest = fmax(fastest, fabs(v[i]));
    }
    w->numbers.speed = fastest;
    pm_frame_look_state(&w->frame, &w->state);
    const int status = pm_impact(w, &x.jumped);
    EQUAL(status, PM_OK);
    memcpy(x.after, w->state.v, (size_t)w->model->nq * sizeof *v);
    return x;
}

/* M (v' - v) = sum of the impulses, each at its point along its direction: no Jacobian. */
static void momentum_balance(scene *s, const blow *x)
{
    pm_workspace *w = s->w;
    const pm_model *m = w->model;
    double sum[MOST] = {0};
    look(w, x->after);
    for (int pass = 0; pass < 2; pass++) {
        const int n = pass ? m->nslot : m->rows[PM_TABLE_JOINT];
        for (int i = 0; i < n; i++) {
            pm_constraint row[PM_JOINT_CONSTRAINTS];
            const int rows = pass ? 2 : pm_joint_constraints(&w->frame, &w->state, i, row);
            if (pass)
                pm_contact_constraint_both(&w->frame, pm_contact_of_slot(m, i), i, w->state.slot[i].member,
                                           &row[0], &row[1]);
            for (int k = 0; k < rows; k++) {
                const double size =
                    pass ? w->impulses.slot[2 * i + k] : w->impulses.joint[m->joint_constraint[i] + k];
                pm_line_of_action a;
                pm_constraint_kind(row[k].kind)->act(&w->frame, &row[k], &a);
                for (int p = 0; p < 2; p++) {
                    const int body = row[k].body[p];
                    if (body == m->nbody) continue;
                    const double *pose = w->frame.pose + 5 * body, sign = p ? -size : size;
                    sum[3 * body] += sign * a.direction[0];
                    sum[3 * body + 1] += sign * a.direction[1];
                    sum[3 * body + 2] += size * a.couple[p] + sign * ((a.at[0] - pose[0]) * a.direction[1] -
                                                                      (a.at[1] - pose[1]) * a.direction[0]);
                }
            }
        }
    }
    for (int i = 0; i < m->nq; i++)
        if (w->numbers.inverse_mass[i] > 0)
            NEAR(sum[i] * w->numbers.inverse_mass[i], x->after[i] - x->before[i], CLOSE);
}

static double normal_rate(pm_workspace *w, int slot, const double *v)
{
    double rate;
    look(w, v);
    pm_contact_member_gap(&w->frame, pm_contact_of_slot(w->model, slot), w->state.slot[slot].member, &rate);
    return rate;
}

static double slip_rate(pm_workspace *w, int slot, const double *v)
{
    look(w, v);
    return pm_contact_member_slip(&w->frame, pm_contact_of_slot(w->model, slot), w->state.slot[slot].member);
}

/* A blow that would have gained energy keeps all of it: it lies between two that obey the laws, and obeys their bounds. */
static int is_between(scene *s, const blow *x)
{
    const double before = kinetic(s->w, x->before);
    return kinetic(s->w, x->after) > before * (1 - 1e-12) && s->w->impulses.energy_lost < 1e-12 * before;
}

static void contact_laws(scene *s, const blow *x, int slot, int rested)
{
    pm_workspace *w = s->w;
    const int contact = pm_contact_of_slot(w->model, slot), friction = pm_contact_friction(w->model, contact);
    const double u = normal_rate(w, slot, x->before), after = normal_rate(w, slot, x->after);
    const double slip_before = slip_rate(w, slot, x->before), slip = slip_rate(w, slot, x->after);
    const double p = w->impulses.slot[2 * slot], f = w->impulses.slot[2 * slot + 1],
                 mu = pm_contact_static(&w->frame, contact);
    CHECK(p >= -CLOSE);
    CHECK(after >= -CLOSE);
    const int between = is_between(s, x);
    if (p > CLOSE && !between)
        NEAR(after, rested ? 0 : -pm_contact_restitution(&w->frame, contact) * u, CLOSE); /* (17.19) */
    if (p <= CLOSE) NEAR(f, 0, CLOSE); /* no normal impulse, no friction */
    if (friction == PM_FRICTION_SMOOTH) EQUAL(f, 0);
    if (friction == PM_FRICTION_ROUGH && p > CLOSE) NEAR(slip, 0, CLOSE);
    const int several = w->model->nslot > 1 && w->impulses.slot[0] > CLOSE && w->impulses.slot[2] > CLOSE;
    if (friction != PM_FRICTION_COULOMB) return;
    CHECK(fabs(f) <= mu * p + CLOSE);
    if (fabs(slip) > CLOSE && p > CLOSE && !between && (several || slip * slip_before >= 0)) {
        NEAR(fabs(f), mu * p, CLOSE); /* one alone whose slip has reversed: tests/kernel/impact_course.c */
        CHECK(f * slip <= CLOSE);
    }
}

static void laws(scene *s, const blow *x, unsigned resting)
{
    pm_workspace *w = s->w;
    CHECK(kinetic(w, x->after) <= kinetic(w, x->before) * (1 + 1e-13));
    for (int i = 0; i < w->model->rows[PM_TABLE_JOINT]; i++) {
        pm_constraint row[PM_JOINT_CONSTRAINTS];
        const int n = pm_joint_constraints(&w->frame, &w->state, i, row);
        look(w, x->after);
        for (int k = 0; k < n; k++) NEAR(pm_constraint_rate(&w->frame, &row[k]), 0, CLOSE);
    }
    for (int i = 0; i < w->model->nslot; i++) CHECK(normal_rate(w, i, x->after) >= -CLOSE);
    if (x->jumped != 1) return; /* a sequence: the impulses kept are those of its last blow */
    NEAR(w->impulses.energy_lost, kinetic(w, x->before) - kinetic(w, x->after), CLOSE);
    momentum_balance(s, x);
    for (int i = 0; i < w->model->nslot; i++) contact_laws(s, x, i, resting >> i & 1);
}

/* ---- one rod, one corner ---- */
static scene *rod(double angle, double e, int friction, double mu, int ends)
{
    scene *s = scene_create();
    const int b = scene_body(s, 2, 0.3, 0, 0.6 * fabs(sin(angle)), angle), line = scene_floor(s, 0);
    for (int i = 0; i < ends; i++) {
        const int end = scene_circle(s, scene_point(s, b, i ? 0.6 : -0.6, 0), 0);
        scene_contact(s, PM_CONTACT_LINE, end, line, 0, e, friction, mu);
    }
    scene_until_time(s, 1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    CHECK(scene_begin(s) == PM_OK);
    return s;
}

static void rod_corner(void)
{
    static const double restitution[] = {0, 0.3, 1}, mu[] = {0, 0.05, 5, 0};
    static const int friction[] = {PM_FRICTION_SMOOTH, PM_FRICTION_COULOMB, PM_FRICTION_COULOMB,
                                   PM_FRICTION_ROUGH};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 3; i++)
            for (int n = 0; n < 20; n++) {
                scene *s = rod(check_random(0.1, 1.4), restitution[i], friction[k], mu[k], 1);
                const double v[] = {check_random(-2, 2), check_random(-6, -3), check_random(-2, 2)};
                const blow x = strike(s, v, 0);
                laws(s, &x, 0);
                EQUAL(x.jumped, 1);
                CHECK(s->w->impulses.slot[0] > 0);
                scene_free(s);
            }
}

/* A corner that parts already is not struck. */
static void parts_already(void)
{
    scene *s = rod(0.5, 0.5, PM_FRICTION_ROUGH, 0, 1);
    const double v[] = {1, 0.5, 0};
    const blow x = strike(s, v, 0);
    EQUAL(x.jumped, 0);
    for (int i = 0; i < 3; i++) EQUAL(x.after[i], v[i]);
    scene_free(s);
}

/* A flat rod: both ends at once, or one after the other. */
static void two_ends(void)
{
    static const double restitution[] = {0, 0.6, 1};
    for (int i = 0; i < 3; i++) {
        scene *s = rod(0, restitution[i], PM_FRICTION_SMOOTH, 0, 2);
        const double v[] = {0.4, -2, 0};
        blow x = strike(s, v, 0);
        EQUAL(x.jumped, 1);
        laws(s, &x, 0);
        NEAR(x.after[1], 2 * restitution[i], CLOSE);
        NEAR(x.after[2], 0, CLOSE);
        scene_free(s);
        for (int n = 0; n < 40; n++) {
            static const int friction[] = {PM_FRICTION_SMOOTH, PM_FRICTION_COULOMB, PM_FRICTION_ROUGH};
            s = rod(0, restitution[i], friction[n % 3], 0.3, 2);
            const double u[] = {check_random(-1, 1), check_random(-3, -1), check_random(-4, 4)};
            x = strike(s, u, 0);
            CHECK(x.jumped >= 1);
            laws(s, &x, 0);
            scene_free(s);
        }
    }
}

/* A rod that rests on two supports at -a and a is struck at its right end from above by a ball. */
static blow rod_on_supports(double a, double e, int friction, double impulse[3])
{
    const double half = 0.6;
    scene *s = scene_create();
    const int b = scene_body(s, 2, 2 * half * half / 3, 0, 0, 0), ball = scene_body(s, 0.5, 0, half, 0.1, 0);
    const int top = scene_line(s, scene_point(s, b, 0, 0), 0);
    for (int i = -1; i <= 1; i += 2) {
        const int support = scene_line(s, scene_point(s, PM_GROUND, 0, 0), 0);
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, i * a, 0), 0), support, 0, 0,
                      friction, 0);
    }
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0.1), top, 0, e,
                  PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    CHECK(scene_begin(s) == PM_OK);
    const double v[] = {0, 0, 0, 0, -3, 0};
    const blow x = strike(s, v, 3); /* both supports rest */
    EQUAL(x.jumped, 1);
    laws(s, &x, 3);
    for (int i = 0; i < 3; i++) impulse[i] = s->w->impulses.slot[2 * i];
    scene_free(s);
    return x;
}

static void resting_contact_joins(void)
{
    static const int friction[] = {PM_FRICTION_SMOOTH, PM_FRICTION_ROUGH};
    double p[3];
    for (int k = 0; k < 2; k++) {
        const double a = 0.4, e = 0.5, half = 0.6, i_support = 2 * half * half / 3 + 2 * a * a,
                     arm = half - a;
        blow x = rod_on_supports(a, e, friction[k], p);
        CHECK(p[0] == 0 && p[1] > 0 &&
              p[2] > 0); /* the near one is pressed, the far one rises and carries nothing */
        const double struck = (1 + e) * 3 / (1 / 0.5 + arm * arm / i_support);
        NEAR(p[2], struck, CLOSE);
        NEAR(x.after[2], -struck * arm / i_support, CLOSE);
        x = rod_on_supports(0.15, 0, friction[k],
                            p); /* within the middle third both could be pressed: one is enough */
        CHECK(p[1] > 0);
        x = rod_on_supports(0.7, 1, friction[k],
                            p); /* struck between the supports: nothing moves but the ball */
        CHECK(p[0] >= 0 && p[1] > 0);
        NEAR(x.after[4], 3, CLOSE);
        NEAR(x.after[1], 0, CLOSE);
        NEAR(x.after[2], 0, CLOSE);
    }
}

/* What touches without approaching rests, though it is not closed yet, as at the start of a run. */
static void touching_joins(void)
{
    scene *s = rod(0, 0.5, PM_FRICTION_SMOOTH, 0, 2);
    const double v[] = {0, -0.6,
                        -1}; /* about the left end, which the blow at the right end would press down */
    const blow x = strike(s, v, 0);
    EQUAL(x.jumped, 1);
    laws(s, &x, 1);
    NEAR(x.after[1], 0.3, CLOSE);
    NEAR(x.after[2], 0.5, CLOSE);
    scene_free(s);
}

/* A spinning ball that rolls from the blow on: that is where it comes to stick. */
static void sticks_by_a_blow(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.4, 0, 1, 0), center = scene_point(s, b, 0, 0);
    const int contact = scene_contact(s, PM_CONTACT_LINE, scene_circle(s, center, 1), scene_floor(s, 0), 0, 0,
                                      PM_FRICTION_COULOMB, 5);
    scene_start_velocity(s, center, 0, -3);
    scene_start_omega(s, b, -1);
    scene_until(s, scene_on(s, PM_TRIGGER_STICK, contact), 1);
    const int t = scene_ask_measure(s, scene_time(s));
    const int v = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, center, PM_PART_X));
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    EQUAL(s->out[t], 0);
    NEAR(s->out[v], 2.0 / 7, CLOSE);
    scene_free(s);
}

/* ---- joints hold ---- */
static void pendulum_struck(void)
{
    for (int n = 0; n < 20; n++) {
        const double e = check_random(0, 1), place = check_random(-0.4, 0.6);
        scene *s = scene_create();
        const int b = scene_body(s, 2, 0.24, 0, -0.6, -acos(0.)),
                  ball = scene_body(s, 0.7, 0.01, -0.2, -0.6 - place, 0);
        scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -0.6, 0), scene_point(s, PM_GROUND, 0, 0), 0);
        const int face = scene_line(s, scene_point(s, b, 0, 0),
                                    2 * acos(0.)); /* its free side is on the left of the rod */
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, ball, 0, 0), 0.2), face, 0, e,
                      PM_FRICTION_ROUGH, 0);
        scene_until_time(s, 1);
        CHECK(scene_begin(s) == PM_OK);
        const double arm = 0.6 + place, v[] = {0.6 * 0.5, 0, 0.5, 4, 0, 1.5};
        const blow x = strike(s, v, 0);
        EQUAL(x.jumped, 1);
        laws(s, &x, 0);
        /* moment of momentum about the pin: kept, whatever the pin's impulse is */
        double h[2];
        for (int k = 0; k < 2; k++) {
            const double *u = k ? x.after : x.before;
            h[k] = 0.24 * u[2] + 2 * 0.6 * u[0] + 0.01 * u[5] + 0.7 * (arm * u[3] - 0.2 * u[4]);
        }
        NEAR(h[1], h[0], CLOSE);
        scene_free(s);
    }
}

/* ---- the sphere between two rough bars ---- */
static void never_wedged(void)
{
    for (double d = 0.1; d < 1.4; d += 0.25) { /* bars, in radii apart; beyond it would leave the bar */
        const double beta = asin(0.5 * d), k = (2 + 5 * cos(2 * beta)) / 7;
        scene *s = scene_create();
        const int b = scene_body(s, 3, 0.4 * 3, 0, 1, 0), g = scene_point(s, b, 0, 0);
        const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), scene_value(s, d),
                                  scene_value(s, 0), scene_value(s, -1));
        scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, g, 1), row, 0, 0, PM_FRICTION_ROUGH, 0);
        scene_start_omega(s, b, -1.5);
        const int hit = scene_on(s, PM_TRIGGER_STRIKE, 0), omega = scene_measure(s, PM_MEASURE_OMEGA, b);
        const int before = scene_ask_event(s, scene_read(s, omega), hit, 1, 1);
        const int after = scene_ask_event(s, scene_read(s, omega), hit, 1, 0);
        const int closed = scene_ask_measure(s, scene_measure(s, PM_MEASURE_CONTACT_CLOSED, 0));
        scene_until(s, hit, 1);
        EQUAL(scene_run(s, NULL), PM_OK);
        NEAR(s->out[after], k * s->out[before], 1e-10);
        NEAR(s->out[before], -sqrt(2.25 + 2 * 9.81 * (1 - cos(beta)) / 1.4), 1e-9);
        EQUAL(s->out[closed], 1); /* the bar behind is left at once and carries nothing in the blow */
        scene_free(s);
    }
}

/* Two rolling spheres: the floor's no-slip rows carry nothing in the blow between them. */
static void rolling_spheres(void)
{
    scene *s = scene_create();
    const double r = 0.2, v1 = 3, e = 0.8;
    int circle[2], line = scene_floor(s, 0);
    for (int i = 0; i < 2; i++) {
        const int b = scene_body(s, 1, 0.4 * r * r, 2 * r * i, r, 0);
        circle[i] = scene_circle(s, scene_point(s, b, 0, 0), r);
        scene_contact(s, PM_CONTACT_LINE, circle[i], line, 0, 0, PM_FRICTION_COULOMB, 0.3);
    }
    scene_contact(s, PM_CONTACT_CIRCLE, circle[0], circle[1], 1, e, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    const double v[] = {v1, 0, -v1 / r, 0, 0, 0};
    const blow x = strike(s, v, 3);
    laws(s, &x, 3);
    NEAR(x.after[0], 0.5 * (1 - e) * v1, CLOSE);
    NEAR(x.after[3], 0.5 * (1 + e) * v1, CLOSE);
    NEAR(x.after[2], -v1 / r, CLOSE); /* they slide now */
    NEAR(x.after[5], 0, CLOSE);
    EQUAL(s->w->state.slot[0].mode, PM_SLIDE_BACKWARD);
    EQUAL(s->w->state.slot[1].mode, PM_SLIDE_FORWARD);
    scene_free(s);
}

/* A row of balls at rest, struck at its end: together without restitution, never with more energy. */
static void row_of_balls(void)
{
    for (int n = 0; n < 3; n++) {
        scene *s = scene_create();
        int circle[4];
        for (int i = 0; i < 4; i++)
            circle[i] = scene_circle(s, scene_point(s, scene_body(s, 1 + i, 0.1, 0.4 * i, 0, 0), 0, 0), 0.2);
        for (int i = 0; i < 3; i++)
            scene_contact(s, PM_CONTACT_CIRCLE, circle[i], circle[i + 1], 1, 0.5 * n, PM_FRICTION_SMOOTH, 0);
        scene_until_time(s, 1);
        scene_set(s, PM_SETTING_GRAVITY_Y, 0);
        CHECK(scene_begin(s) == PM_OK);
        const double v[12] = {2};
        const blow x = strike(s, v, 6);
        laws(s, &x, 6);
        if (n == 0)
            for (int i = 0; i < 4; i++) NEAR(x.after[3 * i], 0.2, CLOSE);
        scene_free(s);
    }
}

/* ---- one by one ---- */
static void one_by_one(scene *s) { *scene_setting(s, PM_SETTING_SIMULTANEOUS) = PM_SIMULTANEOUS_ONE_BY_ONE; }

/* A falling rod on two supports: left, right, left again; each strike is an event of its own at t = 0. */
static void rod_strikes_three_times(void)
{
    const double m = 2, half = 0.6, i = m * half * half / 3, v = 1.7;
    scene *s = scene_create();
    const int b = scene_body(s, m, i, 0, 0, 0), g = scene_point(s, b, 0, 0), line = scene_floor(s, 0);
    int strike[2], ask[3][3], contact[2];
    for (int k = 0; k < 2; k++) {
        const int end = scene_circle(s, scene_point(s, b, k ? half : -half, 0), 0);
        contact[k] = scene_contact(s, PM_CONTACT_LINE, end, line, 0, 1, PM_FRICTION_SMOOTH, 0);
        strike[k] = scene_on(s, PM_TRIGGER_STRIKE, contact[k]);
    }
    const int vy = scene_read(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y)),
              omega = scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, b)),
              lost = scene_read(s, scene_measure(s, PM_MEASURE_LOST, PM_NONE));
    const int turned = scene_when(s, PM_TRIGGER_CROSS,
                                  omega); /* the second blow carries the spin through zero, the third to it */
    for (int k = 0; k < 3; k++) {
        ask[k][0] = scene_ask_event(s, vy, strike[k % 2], 1 + k / 2, 0);
        ask[k][1] = scene_ask_event(s, omega, strike[k % 2], 1 + k / 2, 0);
        ask[k][2] = scene_ask_event(s, vy, strike[k % 2], 1 + k / 2, 1);
    }
    const int loss = scene_ask_end(s, lost);
    const int turns = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, turned));
    scene_until_time(s, 0.01);
    scene_start_velocity(s, g, 0, -v);
    one_by_one(s);
    EQUAL(scene_run(s, NULL), PM_OK);
    double u = -v, w = 0;
    for (int k = 0; k < 3; k++) {
        const double arm = k == 1 ? half : -half, p = -2 * (u + w * arm) / (1 / m + arm * arm / i);
        NEAR(s->out[ask[k][2]], u, CLOSE);
        u += p / m;
        w += p * arm / i;
        NEAR(s->out[ask[k][0]], u, CLOSE);
        NEAR(s->out[ask[k][1]], w, CLOSE);
    }
    NEAR(u, v, CLOSE);
    NEAR(s->out[loss], 0, CLOSE);
    EQUAL(s->out[turns], 2);
    EQUAL(s->count[PM_COUNT_JUMPS], 3);
    CHECK(s->audit[PM_AUDIT_ENERGY] < CLOSE && s->audit[PM_AUDIT_MOMENTUM] < CLOSE);
    scene_free(s);
}

/* The end of the run may lie between two blows of one instant. */
static void ends_between_blows(void)
{
    scene *s = scene_create();
    const int b = scene_body(s, 1, 0.12, 0, 0, 0), g = scene_point(s, b, 0, 0), line = scene_floor(s, 0);
    for (int k = -1; k <= 1; k += 2)
        scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, 0.6 * k, 0), 0), line, 0, 1,
                      PM_FRICTION_SMOOTH, 0);
    const int omega = scene_ask_measure(s, scene_measure(s, PM_MEASURE_OMEGA, b)),
              first = scene_on(s, PM_TRIGGER_STRIKE, 0), second = scene_on(s, PM_TRIGGER_STRIKE, 1);
    const int count = scene_ask_measure(s, scene_measure(s, PM_MEASURE_EVENT_COUNT, second));
    scene_until(s, first, 1);
    scene_start_velocity(s, g, 0, -1);
    one_by_one(s);
    EQUAL(scene_run(s, NULL), PM_NO_TIME_ROUTE);
    NEAR(s->out[omega], -0.6 / 0.12 * 2 / (1 + 0.36 / 0.12), CLOSE);
    EQUAL(s->out[count], 0);
    EQUAL(s->count[PM_COUNT_JUMPS], 1);
    scene_free(s);
}

/* Equal elastic balls in a row hand the blow on; together they would share it.  Also those that rest. */
static void cradle(int n)
{
    scene *s = scene_create();
    int circle[5], velocity[5];
    for (int i = 0; i < n; i++) {
        const int g = scene_point(s, scene_body(s, 1, 0.1, 0.4 * i, 0.2, 0), 0, 0);
        circle[i] = scene_circle(s, g, 0.2);
        velocity[i] = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_X));
        scene_contact(s, PM_CONTACT_LINE, circle[i], scene_floor(s, 0), 0, 0, PM_FRICTION_SMOOTH, 0);
        if (i == 0) scene_start_velocity(s, g, 2, 0);
    }
    for (int i = n - 1; i > 0; i--) /* against the way of the blow: every order gives the same here */
        scene_contact(s, PM_CONTACT_CIRCLE, circle[i - 1], circle[i], 1, 1, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 0.1);
    one_by_one(s);
    EQUAL(scene_run(s, NULL), PM_OK);
    for (int i = 0; i < n; i++) NEAR(s->out[velocity[i]], i == n - 1 ? 2 : 0, CLOSE);
    EQUAL(s->count[PM_COUNT_JUMPS], n - 1);
    scene_free(s);
}

/* A ball that fits between floor and ceiling: elastic, it would strike for ever; else it comes to rest. */
static void between_floor_and_ceiling(void)
{
    static const double restitution[] = {1, 0.5};
    for (int k = 0; k < 2; k++) {
        scene *s = scene_create();
        const int b = scene_body(s, 1, 0.1, 0, 0.2, 0), g = scene_point(s, b, 0, 0),
                  circle = scene_circle(s, g, 0.2);
        const int above = scene_line(s, scene_point(s, PM_GROUND, 0, 0.4), 2 * acos(0.));
        scene_contact(s, PM_CONTACT_LINE, circle, scene_floor(s, 0), 0, restitution[k], PM_FRICTION_SMOOTH,
                      0);
        scene_contact(s, PM_CONTACT_LINE, circle, above, 0, restitution[k], PM_FRICTION_SMOOTH, 0);
        const int vy = scene_ask_measure(s, scene_part(s, PM_MEASURE_VELOCITY, g, PM_PART_Y));
        scene_start_velocity(s, g, 1, -3);
        scene_until_time(s, 0.1);
        one_by_one(s);
        EQUAL(scene_run(s, NULL), k ? PM_OK : PM_BLOWS_ENDLESS);
        if (k) NEAR(s->out[vy], 0, CLOSE);
        if (!k) CHECK(s->detail[PM_DETAIL_BOUND] > 1000);
        scene_free(s);
    }
}

/* One contact carries all of the blow of two, and slides the other way after it; its own course would leave the other one
 * approaching.  The blow is that of the laws, at once; in a mirror, too. */
static void carried_by_one(void)
{
    static const double place[2][2] = {{0.107, -0.144}, {0.419, -0.129}}, angle[] = {-1.634, -0.938},
                        mu[] = {1.19, 0.69}, e[] = {0, 0.057};
    blow x[2];
    for (int k = 0; k < 2; k++) {
        const int flip = k ? -1 : 1;
        scene *s = scene_create();
        const int b = scene_body(s, 1.2, 0.0194, 0, 0, 0);
        for (int i = 0; i < 2; i++) {
            const double at = flip * place[i][0];
            const int line = scene_line(s, scene_point(s, PM_GROUND, at, place[i][1]), flip * angle[i]);
            scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, b, at, place[i][1]), 0), line, 1,
                          e[i], PM_FRICTION_COULOMB, mu[i]);
        }
        scene_until_time(s, 1);
        CHECK(scene_begin(s) == PM_OK);
        x[k] = strike(s, (double[]){-0.3675 * flip, 0.0821, -3.135 * flip}, 0);
        laws(s, &x[k], 0);
        scene_free(s);
    }
    for (int i = 0; i < 3; i++) NEAR(x[1].after[i], (i == 1 ? 1 : -1) * x[0].after[i], CLOSE);
}

/* A particle in the corner of two walls: each blow throws it at the other wall, a little slower, and it takes hundreds of
 * them. */
static void dies_out_at_once(void)
{
    const double opening = 0.02;
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    const int b = scene_body(s, 1, 0, 0, 0, 0), c = scene_circle(s, scene_point(s, b, 0, 0), 0);
    scene_contact(s, PM_CONTACT_LINE, c, scene_floor(s, 0), 1, 0.9, PM_FRICTION_SMOOTH, 0);
    scene_contact(s, PM_CONTACT_LINE, c, scene_line(s, scene_point(s, PM_GROUND, 0, 0), opening - acos(-1.)),
                  1, 0.9, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    const blow x = strike(s, (double[]){-1, -0.03, 0}, 0);
    CHECK(x.jumped > 100);
    CHECK(kinetic(s->w, x.after) < kinetic(s->w, x.before));
    for (int i = 0; i < 2; i++) CHECK(normal_rate(s->w, i, x.after) > -CLOSE);
    scene_free(s);
}

int main(void)
{
    carried_by_one();
    dies_out_at_once();
    rod_corner();
    parts_already();
    two_ends();
    resting_contact_joins();
    touching_joins();
    sticks_by_a_blow();
    pendulum_struck();
    never_wedged();
    rolling_spheres();
    row_of_balls();
    rod_strikes_three_times();
    ends_between_blows();
    for (int n = 2; n <= 5; n++) cradle(n);
    between_floor_and_ceiling();
    return check_failures();
}

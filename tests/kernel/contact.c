/* Gaps: the nearest open member of a periodic row is that of a search over all; closed ones do not count. */
#include "elements/contact.h"
#include "elements/contact_pattern.h"

#include "check.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define STEP_X 0.31
#define STEP_Y 0.07

static scene *row_scene(double x, double y, double count)
{
    scene *s = scene_create();
    const int c = scene_circle(s, scene_point(s, scene_body(s, 1, 0.1, x, y, 0.3), 0, 0), 0.2);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0.1, -0.2),
                              scene_value(s, STEP_X), scene_value(s, STEP_Y), scene_value(s, count));
    scene_contact(s, PM_CONTACT_PATTERN, c, row, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    return s;
}

static double distance(double x, double y, int k)
{
    return hypot(x - 0.1 - k * STEP_X, y + 0.2 - k * STEP_Y) - 0.2;
}

static void nearest_member(void)
{
    for (int n = 0; n < 400; n++) {
        const int count = n % 4 == 0 ? -1 : n % 9; /* endless, or 0 .. 8 */
        const double x = check_random(-3, 5), y = check_random(0.9, 2);
        scene *s = row_scene(x, y, count);
        if (CHECK(scene_begin(s) == PM_OK)) {
            int first = count < 0 ? -30 : 0, last = count < 0 ? 30 : count - 1, best = 0, second = 0, member;
            double least = INFINITY, next = INFINITY;
            for (int k = first; k <= last; k++)
                if (distance(x, y, k) < least) {
                    least = distance(x, y, k);
                    best = k;
                }
            for (int k = first; k <= last; k++)
                if (k != best && distance(x, y, k) < next) {
                    next = distance(x, y, k);
                    second = k;
                }
            NEAR(pm_contact_gap(&s->w->frame, &s->w->state, 0, &member), least, 1e-13);
            if (isfinite(least)) EQUAL(member, best);
            s->w->state.slot[1] = (pm_slot){PM_SMOOTH, best};
            NEAR(pm_contact_gap(&s->w->frame, &s->w->state, 0, &member), next, 1e-13);
            if (isfinite(next)) EQUAL(member, second);
            EQUAL(pm_contact_free_slot(&s->w->frame, &s->w->state, 0), 0);
        }
        scene_free(s);
    }
}

/* Along a way the members next to the last place serve again between the same two, beyond either end of the pattern, too. */
static void nearest_along(void)
{
    for (int n = 0; n < 40; n++) {
        const int count = n % 4 == 0 ? -1 : 1 + n % 9;
        scene *s = row_scene(0, 1, count);
        if (CHECK(scene_begin(s) == PM_OK)) {
            pm_workspace *w = s->w;
            pm_near near = {.n = -1};
            double x = -2;
            for (int k = 0; k < 300; k++) {
                x += check_random(-0.2, 0.24);
                int member, again;
                w->state.q[0] = x;
                pm_frame_look_state(&w->frame, &w->state);
                const pm_beside beside = pm_contact_pattern_beside(&w->frame, 0);
                const double gap = pm_contact_pattern_nearest(&w->frame, &w->state, 0, &beside, &member);
                EQUAL(pm_contact_pattern_nearest_of(&w->frame, &w->state, 0, &beside, &near, &again) == gap,
                      1);
                EQUAL(again, member);
            }
        }
        scene_free(s);
    }
}

/* A gap's rate is its derivative along the motion, with both partners moving. */
static void rates(void)
{
    scene *s = scene_create();
    const int a = scene_body(s, 1, 0.1, 0, 1, 0.2), b = scene_body(s, 2, 0.3, 0.4, 0, -0.1);
    scene_contact(s, PM_CONTACT_LINE, scene_circle(s, scene_point(s, a, 0.1, 0.1), 0.2),
                  scene_line(s, scene_point(s, b, 0, 0.1), 0.2), 0, 0, PM_FRICTION_ROUGH, 0);
    scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, scene_point(s, a, 0.1, 0.1), 0.2),
                  scene_circle(s, scene_point(s, b, 0, 0.1), 0.3), 1, 0, PM_FRICTION_ROUGH, 0);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, b, 0.2, 0.1), scene_value(s, 0.3),
                              scene_value(s, -0.1), scene_value(s, 3));
    scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, scene_point(s, a, 0.1, 0.1), 0.2), row, 0, 0,
                  PM_FRICTION_ROUGH, 0);
    scene_start_velocity(s, scene_point(s, a, 0, 0), 0.3, -0.8);
    scene_start_velocity(s, scene_point(s, b, 0, 0), -0.5, 0.4);
    scene_start_omega(s, a, 1.5);
    scene_start_omega(s, b, -2.5);
    scene_until_time(s, 1);
    if (CHECK(scene_begin(s) == PM_OK)) {
        pm_workspace *w = s->w;
        for (int i = 0; i < 3; i++) {
            double rate, gap[2];
            int member;
            pm_frame_look_state(&w->frame, &w->state);
            NEAR(pm_contact_member_gap(&w->frame, i, 0, &rate),
                 pm_contact_gap(&w->frame, &w->state, i, &member), 0);
            for (int side = 0; side < 2; side++) {
                pm_state_copy(&w->probe, &w->state);
                for (int k = 0; k < w->model->nq; k++) w->probe.q[k] += (side ? 1e-6 : -1e-6) * w->state.v[k];
                pm_frame_look_state(&w->frame, &w->probe);
                gap[side] = pm_contact_member_gap(&w->frame, i, 0, NULL);
            }
            NEAR(rate, (gap[1] - gap[0]) / 2e-6, 1e-8);
        }
    }
    scene_free(s);
}

/* More members at once than there are slots for is said, not guessed. */
static void too_many(void)
{
    scene *s = scene_create(); /* bars much closer than what counts as touching */
    const int c = scene_circle(s, scene_point(s, scene_body(s, 1, 0.1, 0, 0.2, 0), 0, 0), 0.2);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), scene_value(s, 1e-12),
                              scene_value(s, 0), scene_value(s, -1));
    scene_contact(s, PM_CONTACT_PATTERN, c, row, 0, 0, PM_FRICTION_SMOOTH, 0);
    scene_until_time(s, 1);
    EQUAL(scene_run(s, NULL), PM_CONTACT_SLOTS);
    EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_CONTACT);
    EQUAL(s->where[PM_WHERE_ROW], 0);
    scene_free(s);
}

/* Members are numbered by int32: a row that has more is said to be too long. */
static void too_long(void)
{
    static const double count[] = {1e9, 3e9, 1e300};
    for (int i = 0; i < 3; i++) {
        scene *s = scene_create();
        const int c = scene_circle(s, scene_point(s, scene_body(s, 1, 0.1, 0, 0.5, 0), 0, 0), 0.2);
        const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), scene_value(s, 0.1),
                                  scene_value(s, 0), scene_value(s, count[i]));
        scene_contact(s, PM_CONTACT_PATTERN, c, row, 0, 0, PM_FRICTION_SMOOTH, 0);
        scene_until_time(s, 0.1);
        EQUAL(scene_run(s, NULL), i == 0 ? PM_OK : PM_BAD_VALUE);
        if (i > 0) EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_PATTERN);
        scene_free(s);
    }
}

/* A row without end has no member where no int32 numbers it: that is said, too, and no circle falls through. */
static void too_far(void)
{
    for (int i = 0; i < 2; i++) {
        scene *s = row_scene(0.3e9 * (1 + i), 1, -1); /* 0.93e9 and 1.86e9 steps from the first member */
        EQUAL(scene_run(s, NULL), i == 0 ? PM_OK : PM_BAD_VALUE);
        if (i == 1) {
            EQUAL(s->where[PM_WHERE_TABLE], PM_TABLE_CONTACT);
            EQUAL(s->where[PM_WHERE_ROW], 0);
            CHECK(s->detail[PM_DETAIL_VALUE] > 1.8e9 && s->detail[PM_DETAIL_BOUND] == 1e9);
        }
        scene_free(s);
    }
}

int main(void)
{
    nearest_member();
    nearest_along();
    rates();
    too_many();
    too_long();
    too_far();
    return check_failures();
}

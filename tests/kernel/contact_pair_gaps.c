/* Gaps of two curves beside all places looked at. */
#include "check.h"
#include "curve_pair.h"
#include "elements/contact.h"
#include "scene.h"
#include "state/frame.h"
#include "state/workspace.h"

#define CLOSE 1e-8
#define LOOKS 160

/* ---- gaps ---- */
typedef struct shape {
    double a, b, wave, half; /* half > 0: an edge */
    double pose[3];
} shape;

static void place_of(const shape *x, double s, double p[2])
{
    const double own[2] = {x->half > 0 ? x->half * (s / TWO_PI * 2 - 1) : x->a * cos(s),
                           x->half > 0 ? 0 : x->b * sin(s) * (1 + x->wave * cos(3 * s))};
    const double c = cos(x->pose[2]), d = sin(x->pose[2]);
    p[0] = x->pose[0] + c * own[0] - d * own[1];
    p[1] = x->pose[1] + d * own[0] + c * own[1];
}

/* Least distance of both, by looking at all places, and closer about the best. */
static double least(const shape *x, const shape *y)
{
    double from[2] = {0, 0}, wide[2] = {TWO_PI, TWO_PI}, best = INFINITY;
    for (int pass = 0, n = 240; pass < 9; pass++, n = 30) {
        double at[2] = {0, 0};
        best = INFINITY;
        for (int i = 0; i <= n; i++)
            for (int k = 0; k <= n; k++) {
                const double s = from[0] + wide[0] * i / n, t = from[1] + wide[1] * k / n;
                double p[2], q[2];
                place_of(x, x->half > 0 ? fmin(fmax(s, 0), TWO_PI) : s, p);
                place_of(y, t, q);
                const double d = hypot(p[0] - q[0], p[1] - q[1]);
                if (d < best) best = d, at[0] = s, at[1] = t;
            }
        for (int k = 0; k < 2; k++) {
            from[k] = at[k] - 2 * wide[k] / n;
            wide[k] *= 4.0 / n;
        }
    }
    return best;
}

/* Some place of x lies in y. */
static int is_in(const shape *x, const shape *y)
{
    for (int i = 0; i <= LOOKS; i++) {
        double p[2];
        place_of(x, TWO_PI * i / LOOKS, p);
        int wound = 0;
        for (int k = 0; k < LOOKS; k++) {
            double q[2], r[2];
            place_of(y, TWO_PI * k / LOOKS, q);
            place_of(y, TWO_PI * (k + 1) / LOOKS, r);
            if ((q[1] > p[1]) == (r[1] > p[1])) continue;
            if (p[0] < q[0] + (p[1] - q[1]) / (r[1] - q[1]) * (r[0] - q[0])) wound = !wound;
        }
        if (wound) return 1;
    }
    return 0;
}

/* An edge whose free side looks away from the other has no gap to it but by its corners: that is not compared. */
static int faces(const shape *x, const shape *y)
{
    const double n[2] = {sin(x->pose[2]), -cos(x->pose[2])};
    return !(x->half > 0) || n[0] * (y->pose[0] - x->pose[0]) + n[1] * (y->pose[1] - x->pose[1]) > 1;
}

static void gaps(int edge, int swapped)
{
    shape x = {1.1, 0.8, 0.1, edge ? 0.7 : 0, {0}}, y = {0.9, 0.6, 0.15, 0, {0}};
    scene *s = scene_create();
    const int a = scene_body(s, 1, 0.1, 4, 0, 0), b = scene_body(s, 1, 0.1, 0, 0, 0);
    touch_in_order(s, swapped, edge ? bottom(s, a, x.half, 0) : ring(s, a, 0, x.a, x.b, x.wave),
                   ring(s, b, 0, y.a, y.b, y.wave), 0, PM_FRICTION_SMOOTH);
    scene_until_time(s, 1);
    CHECK(scene_begin(s) == PM_OK);
    pm_workspace *w = s->w;
    for (int n = 0, apart = 0, within = 0; n < 400 && (apart < 12 || within < 4); n++) {
        int member;
        for (int k = 0; k < 2; k++) {
            shape *one = k ? &y : &x;
            for (int i = 0; i < 2; i++) one->pose[i] = check_random(-1.4, 1.4);
            one->pose[2] = check_random(-7, 7);
            memcpy(w->state.q + 3 * k, one->pose, sizeof one->pose);
        }
        if (!faces(&x, &y)) continue;
        pm_frame_look_state(&w->frame, &w->state);
        const double gap = pm_contact_gap(&w->frame, &w->state, 0, &member), distance = least(&x, &y);
        if (distance < 1e-3) continue;
        if (is_in(&x, &y) || is_in(&y, &x)) continue;
        apart++;
        NEAR(gap, distance, CLOSE);
        EQUAL(pm_contact_touches(&w->frame, &w->state, 0, &member), 0);
        /* a little nearer than they are, they overlap */
        const double d = hypot(x.pose[0] - y.pose[0], x.pose[1] - y.pose[1]);
        for (double part = 0; part < 1; part += 0.01) {
            for (int i = 0; i < 2; i++)
                w->state.q[i] = x.pose[i] + (part * distance + 0.03 / d * part) * (y.pose[i] - x.pose[i]) / d;
            pm_frame_look_state(&w->frame, &w->state);
            const double now = pm_contact_gap(&w->frame, &w->state, 0, &member);
            if (now > 0) continue;
            shape moved = x;
            memcpy(moved.pose, w->state.q, sizeof moved.pose);
            CHECK(least(&moved, &y) < 0.06);
            within++;
            break;
        }
    }
    scene_free(s);
}

int main(void)
{
    gaps(0, 0);
    for (int swapped = 0; swapped < 2; swapped++) gaps(1, swapped);
    return check_failures();
}

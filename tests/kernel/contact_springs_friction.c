/* Blows that stiffnesses share, with friction: beside small steps, the course of one contact, grooves; laws that hold for all. */
#include "impact/contact_springs.h"

#include "check.h"
#include "impact/impact_course.h"
#include "planemotion.h"

#define MOST 4
#define CLOSE 1e-11

static pm_contact_springs springs;

/* A body with n feet at random places, or several bodies that feel each other: W = sum of J M^-1 J', of less than full rank
 * where n > 1 and rank = 3. */
typedef struct rubbing {
    int n, rank;
    double row[2 * MOST][2 * MOST]; /* J M^-1/2 */
    double start[2 * MOST], hold[MOST], rub[MOST], stiffness[MOST], e[MOST], exponent;
} rubbing;

static rubbing any_rubbing(int n, int rank, double ratio)
{
    rubbing x = {.n = n, .rank = rank, .exponent = 1 + 0.5 * (int)check_random(0, 2)};
    double velocity[2 * MOST];
    for (int k = 0; k < rank; k++) velocity[k] = check_random(-1, 1);
    for (int r = 0; r < 2 * n; r++) {
        for (int k = 0; k < rank; k++) x.row[r][k] = check_random(-1, 1) + (r == k);
        for (int k = 0; k < rank; k++) x.start[r] += x.row[r][k] * velocity[k];
        const double sense = r % 2 == 0 && x.start[r] > 0 ? -1 : 1; /* most approach */
        for (int k = 0; k < rank && check_random(0, 1) < 2; k++) x.row[r][k] *= sense;
        x.start[r] *= sense;
    }
    for (int i = 0; i < n; i++) {
        x.rub[i] = check_random(0, 0.8);
        x.hold[i] = ratio * x.rub[i];
        x.stiffness[i] = pow(3, check_random(-1, 1));
        x.e[i] = check_random(0.3, 1);
    }
    return x;
}

static double response_in(const rubbing *x, int r, int k)
{
    double sum = 0;
    for (int j = 0; j < x->rank; j++) sum += x->row[r][j] * x->row[k][j];
    return sum;
}

static void pose_rubbing(const rubbing *x)
{
    const int two = 2 * x->n;
    springs.n = x->n;
    springs.exponent = x->exponent;
    for (int r = 0; r < two; r++)
        for (int k = 0; k < two; k++) springs.response[r * two + k] = response_in(x, r, k);
    for (int i = 0; i < x->n; i++)
        springs.spring[i] = (pm_contact_spring){.stiffness = x->stiffness[i],
                                                .restitution = x->e[i],
                                                .hold = x->hold[i],
                                                .rub = x->rub[i],
                                                .before = x->start[2 * i],
                                                .slip = x->start[2 * i + 1]};
}

/* Euler's steps; friction ends slips in a step where it can, found by sweeps over the contacts. */
static void rub_through(const rubbing *x, double h, double u[2 * MOST])
{
    const int two = 2 * x->n;
    double place[MOST] = {0};
    memcpy(u, x->start, sizeof x->start);
    for (int s = 0, open = 0, still = 0; s < 2000000 && !open && still < 500; s++) {
        double load[2 * MOST] = {0}, fastest = 0;
        for (int i = 0; i < x->n; i++) load[2 * i] = h * x->stiffness[i] * pow(place[i], x->exponent);
        for (int r = 0; r < two; r++)
            for (int k = 0; k < x->n; k++) u[r] += response_in(x, r, 2 * k) * load[2 * k];
        for (int sweep = 0; sweep < 60; sweep++)
            for (int i = 0; i < x->n; i++) {
                const int t = 2 * i + 1;
                const double most = x->rub[i] * load[2 * i], own = response_in(x, t, t),
                             wanted = fmax(-most, fmin(most, load[t] - u[t] / own)), more = wanted - load[t];
                for (int r = 0; r < two && more != 0; r++) u[r] += response_in(x, r, t) * more;
                load[t] = wanted;
            }
        open = 1;
        for (int i = 0; i < x->n; i++) {
            const double v = u[2 * i], e = x->e[i];
            place[i] = fmax(0, place[i] - h * v * (v > 0 ? 1 / (e * e) : 1));
            open &= place[i] == 0 && v >= -1e-9;
            if (place[i] > 0) fastest = fmax(fastest, fmax(fabs(v), fabs(u[2 * i + 1])));
        }
        still = fastest < 1e-4 ? still + 1 : 0;
    }
}

static void friction_by_small_steps(void)
{
    for (int i = 0; i < 12; i++) {
        const int n = 1 + i % 3;
        const rubbing x = any_rubbing(n, i % 2 ? 3 : 2 * n, 1);
        double stepped[2 * MOST];
        rub_through(&x, 1e-3, stepped);
        pose_rubbing(&x);
        EQUAL(pm_contact_springs_follow(&springs), 1);
        for (int k = 0; k < n; k++) {
            NEAR(springs.spring[k].before, stepped[2 * k], 2e-2);
            NEAR(springs.spring[k].slip, stepped[2 * k + 1], 2e-2);
        }
    }
}

/* Nothing pulls, friction stays in its cone and takes energy, none is gained, velocities are what impulses make of them. */
static void laws_of_friction(void)
{
    for (int i = 0; i < 300; i++) {
        const int n = 1 + i % 4;
        const rubbing x = any_rubbing(n, i % 3 ? 3 : 2 * n, i % 2 ? 1.3 : 1);
        double p[2 * MOST], gain = 0;
        pose_rubbing(&x);
        EQUAL(pm_contact_springs_follow(&springs), 1);
        for (int k = 0; k < n; k++) {
            memcpy(p + 2 * k, springs.spring[k].impulse, sizeof springs.spring[k].impulse);
            CHECK(p[2 * k] >= 0 && fabs(p[2 * k + 1]) <= x.hold[k] * p[2 * k] * (1 + 1e-9) + CLOSE);
            CHECK(springs.spring[k].before >= 0);
        }
        for (int r = 0; r < 2 * n; r++) {
            double change = 0;
            for (int k = 0; k < 2 * n; k++) change += response_in(&x, r, k) * p[k];
            gain += p[r] * (x.start[r] + 0.5 * change);
            NEAR(x.start[r] + change, r % 2 ? springs.spring[r / 2].slip : springs.spring[r / 2].before,
                 1e-10);
        }
        CHECK(gain < CLOSE);
    }
}

/* Contact i of x is contact place[i] of what is returned, and all slips go the other way. */
static rubbing turned(const rubbing *x, const int *place)
{
    rubbing y = *x;
    for (int i = 0; i < x->n; i++) {
        const int to = place[i];
        for (int k = 0; k < 2 * MOST; k++) {
            y.row[2 * to][k] = x->row[2 * i][k];
            y.row[2 * to + 1][k] = -x->row[2 * i + 1][k];
        }
        y.start[2 * to] = x->start[2 * i];
        y.start[2 * to + 1] = -x->start[2 * i + 1];
        y.hold[to] = x->hold[i];
        y.rub[to] = x->rub[i];
        y.stiffness[to] = x->stiffness[i];
        y.e[to] = x->e[i];
    }
    return y;
}

/* On a plane floor: which foot gives how much of the friction does not show in the motion. */
static rubbing any_plate(int n)
{
    rubbing x = any_rubbing(n, 3, 1);
    const double velocity[] = {check_random(-1, 1), check_random(-2, -1), check_random(-1, 1)};
    for (int i = 0; i < n; i++) {
        const double foot[] = {0, 1, check_random(-1, 1)}, floor[] = {1, 0, 0.7};
        for (int k = 0; k < 2 * MOST; k++) {
            x.row[2 * i][k] = k < 3 ? foot[k] : 0;
            x.row[2 * i + 1][k] = k < 3 ? floor[k] : 0;
        }
        for (int d = 0; d < 2; d++) {
            x.start[2 * i + d] = 0;
            for (int k = 0; k < 3; k++) x.start[2 * i + d] += x.row[2 * i + d][k] * velocity[k];
        }
    }
    return x;
}

static void mirrors_and_orders(void)
{
    for (int i = 0; i < 60; i++) {
        const int n = 2 + i % 3, forward[] = {0, 1, 2, 3}, backward[] = {n - 1, n - 2, n - 3, n - 4};
        const int *place = i % 2 ? forward : backward;
        const rubbing x = i % 5 > 1 ? any_plate(n) : any_rubbing(n, 2 * n, 1), y = turned(&x, place);
        pm_contact_spring first[MOST];
        pose_rubbing(&x);
        EQUAL(pm_contact_springs_follow(&springs), 1);
        memcpy(first, springs.spring, (size_t)n * sizeof *first);
        pose_rubbing(&y);
        EQUAL(pm_contact_springs_follow(&springs), 1);
        for (int k = 0; k < n; k++) {
            const pm_contact_spring *other = &springs.spring[place[k]];
            NEAR(other->before, first[k].before, 1e-9);
            NEAR(other->slip, -first[k].slip, 1e-9);
            NEAR(other->impulse[0], first[k].impulse[0], 1e-9);
            NEAR(other->impulse[1], -first[k].impulse[1], 1e-9);
        }
    }
}

/* One contact alone: Routh's course with Stronge's end, whatever its stiffness and exponent. */
static void beside_the_course(const rubbing *x)
{
    const pm_impact_course one = {.a = response_in(x, 0, 0),
                                  .b = response_in(x, 0, 1),
                                  .c = response_in(x, 1, 1),
                                  .normal = x->start[0],
                                  .slip = x->start[1],
                                  .mu_static = x->hold[0],
                                  .mu_kinetic = x->rub[0],
                                  .restitution = x->e[0],
                                  .no_slip = 1e-12,
                                  .law = PM_LAW_STRONGE};
    pm_impact_course_end end;
    CHECK(pm_impact_course_follow(&one, &end));
    pose_rubbing(x);
    EQUAL(pm_contact_springs_follow(&springs), 1);
    const double close = 1e-10 * fmax(1, end.impulse * end.impulse); /* great where friction nearly locks */
    NEAR(springs.spring[0].before, end.normal, close);
    NEAR(springs.spring[0].slip, end.slip, close);
    NEAR(springs.spring[0].impulse[0], end.impulse, close);
    NEAR(springs.spring[0].impulse[1], end.ratio * end.impulse, close);
}

/* The last are nearly locked by their friction: what moves slowly is not wedged. */
static void one_contact(void)
{
    for (int i = 0; i < 400; i++) {
        rubbing x = any_rubbing(1, 2, i % 2 ? 1.3 : 1);
        beside_the_course(&x);
    }
    for (int i = 0; i < 6; i++) {
        const rubbing x = {.n = 1,
                           .rank = 2,
                           .row = {{1}, {1, 1e-3 + 1e-3 * i}},
                           .start = {-1},
                           .hold = {1.2},
                           .rub = {1.2},
                           .stiffness = {1},
                           .e = {0.5},
                           .exponent = 1};
        beside_the_course(&x);
    }
}

/* A point mass of 1 kg runs with 1 m/s into a groove, each of whose walls is inclined by `angle` to its way. */
static void strike_groove(double angle, double mu, double e, double exponent)
{
    rubbing x = {.n = 2, .rank = 2, .exponent = exponent};
    for (int i = 0; i < 2; i++) {
        const double side = i ? -1 : 1;
        x.row[2 * i][0] = -sin(angle); /* away from the wall: back, and to the middle */
        x.row[2 * i][1] = side * cos(angle);
        x.row[2 * i + 1][0] = cos(angle);
        x.row[2 * i + 1][1] = side * sin(angle);
        x.start[2 * i] = -sin(angle);
        x.start[2 * i + 1] = cos(angle);
        x.hold[i] = x.rub[i] = mu;
        x.stiffness[i] = 1;
        x.e[i] = e;
    }
    pose_rubbing(&x);
    EQUAL(pm_contact_springs_follow(&springs), 1);
}

/* Where its walls are steeper than friction holds it comes out again by the law of each wall; else it stays there: least are the
 * impulses with which friction does all it can. */
static void grooves(void)
{
    const double angle = 0.4, wide = 0.8 * tan(angle), narrow = 1.5 * tan(angle);
    for (int k = 0; k < 6; k++) {
        const double e = k % 3 == 0 ? 1 : k % 3 == 1 ? 0.9 : 0.3, exponent = k < 3 ? 1 : 1.5;
        strike_groove(angle, wide, e, exponent);
        const double into = sin(angle) + wide * cos(angle), out = sin(angle) - wide * cos(angle),
                     back = e * sqrt(out / into);
        for (int i = 0; i < 2; i++) {
            NEAR(springs.spring[i].before, back * sin(angle), 1e-10);
            NEAR(springs.spring[i].slip, -back * cos(angle), 1e-10);
            NEAR(springs.spring[i].impulse[0], 0.5 / into + 0.5 * back / out, 1e-10);
        }
        strike_groove(angle, narrow, e, exponent);
        for (int i = 0; i < 2; i++) {
            const double push = 0.5 / (sin(angle) + narrow * cos(angle));
            EQUAL(springs.spring[i].before, 0);
            EQUAL(springs.spring[i].slip, 0);
            NEAR(springs.spring[i].impulse[0], push, 1e-9);
            NEAR(springs.spring[i].impulse[1], -narrow * push, 1e-9);
        }
    }
}

int main(void)
{
    pm_arena arena = {0};
    if (pm_contact_springs_create(&springs, &arena, MOST)) return 1;
    friction_by_small_steps();
    laws_of_friction();
    mirrors_and_orders();
    one_contact();
    grooves();
    pm_arena_free(&arena);
    return check_failures();
}

/* Kinetic energies from segment to segment in closed form, beside one segment after the other in long double. */
#include "check.h"
#include "numerics/tolerances.h"
#include "routes/path/repeat.h"

enum { CASES = 20000 };

typedef struct series {
    pm_repeat l;
    double begin, error;
    int64_t most;
} series;

/* Blows that take nearly nothing up to nearly all, work either way, up to thousands of segments; some are known not to be sure. */
static series make(void)
{
    series x = {.begin = exp(check_random(-3, 3)), .error = check_random(0, 1e-12)};
    const int loses = check_random(0, 1) < 0.8;
    x.l.kinetic = x.begin;
    x.l.ratio = loses ? 1 - pow(10, check_random(-6, -0.1)) : 1;
    x.l.work = x.begin * pow(10, check_random(-4, 0.5)) * (check_random(0, 1) < 0.5 ? -1 : 1);
    x.l.lowest = x.begin * (1 - pow(10, check_random(-3, 0))); /* the way down to it is the depth */
    x.l.unsure = check_random(0, 1) < 0.3 ? x.begin * pow(10, check_random(-2, 1)) : NAN;
    x.most = (int64_t)pow(10, check_random(0, 4));
    return x;
}

typedef struct walk {
    int64_t n;
    long double kinetic, lost, error;
    int is_last;
    long double closest; /* to the barrier, or to the unsure one, of those that were looked at; of T */
} walk;

static int is_before(const series *x, long double kinetic, walk *k)
{
    const double unsure = x->l.unsure;
    if (isnan(unsure)) return 1;
    k->closest = fminl(k->closest, fabsl(kinetic - unsure) / unsure);
    return (kinetic - unsure) * (x->begin - unsure) > 0;
}

static walk walk_along(const series *x)
{
    const long double m = x->l.ratio, depth = x->l.kinetic - x->l.lowest,
                      least = depth + PM_REPEAT_BARRIER * fmax(x->l.kinetic, fabs((double)depth));
    walk k = {.kinetic = x->begin, .error = x->error, .closest = fabsl(x->begin - least) / x->begin};
    if (!(x->begin > least)) return k;
    while (k.n < x->most) {
        const long double end = k.kinetic + x->l.work, next = m * end;
        k.closest = fminl(k.closest, fabsl(next - least) / x->begin);
        if (!(next > least)) {
            k.is_last = 1;
            return k;
        }
        if (!is_before(x, next, &k)) return k;
        k.n++;
        k.lost += end - next;
        k.error = m * k.error + PM_ENERGY_ROUNDINGS * (end + next);
        k.kinetic = next;
    }
    return k;
}

int main(void)
{
    int passed = 0, last = 0;
    for (int i = 0; i < CASES; i++) {
        const series x = make();
        const walk k = walk_along(&x);
        const pm_repeats c = pm_repeat_energy_over_barrier(&x.l, x.begin, x.most, x.error);
        if (k.closest < 1e-12) continue; /* there rounding decides */
        const double turned = x.begin + (double)k.n * fabs(x.l.work);
        EQUAL(c.n, k.n);
        EQUAL(c.is_last, k.is_last);
        NEAR(c.kinetic, (double)k.kinetic, 1e-15 * turned);
        NEAR(c.lost, (double)k.lost, 1e-15 * turned);
        NEAR(c.error, (double)k.error, 1e-6 * (double)k.error);
        passed += k.n > 0;
        last += k.is_last;
    }
    CHECK(passed > CASES / 4);
    CHECK(last > CASES / 20);
    return check_failures();
}

/* The scenes of the benchmark by hand: `void SCENE(n, cases[n][..], out[n][..], setting)`; the setting is a
 * tolerance, or a number of panels.
 *
 * Motions in time: the order 8 method of Dormand and Prince on least coordinates.  Turns and falls: energy,
 * and the time by quadrature: the trapezoidal rule over a whole turn, Gauss's two point rule on u = sqrt(angle) else. */
#include <math.h>

#include "routes/rk/dop853.h"

#define PI 3.14159265358979323846
#define G_SI 9.81
#define G_US (32.2 * 0.3048)
#define INCH 0.0254
#define MOST_UNKNOWNS 4

typedef void rhs_function(const double *y, double *f, const double *p);

/* Steps as the error allows: the estimators of order 5 and 3 as in Hairer, Norsett and Wanner, safety 0.7. */
static void integrate(rhs_function *rhs, int n, double *y, double end, double rtol, const double *p)
{
    double k[STAGES + 1][MOST_UNKNOWNS], z[MOST_UNKNOWNS], t = 0, h = 1e-3;
    rhs(y, k[0], p);
    while (t < end) {
        if (h > end - t) h = end - t;
        for (int s = 1; s <= STAGES; s++) {
            for (int i = 0; i < n; i++) {
                double sum = 0;
                for (int j = 0; j < s; j++) sum += stage_weight[s][j] * k[j][i];
                z[i] = y[i] + h * sum;
            }
            rhs(z, k[s], p);
        }
        double square_5 = 0, square_3 = 0;
        for (int i = 0; i < n; i++) {
            double e5 = 0, e3 = 0;
            for (int j = 0; j <= STAGES; j++) e5 += error_weight_5[j] * k[j][i], e3 += error_weight_3[j] * k[j][i];
            square_5 += e5 * e5;
            square_3 += e3 * e3;
        }
        const double both = square_5 + 0.01 * square_3, error = both > 0 ? h * square_5 / sqrt(both * n) / rtol : 0;
        if (error <= 1) {
            t += h;
            for (int i = 0; i < n; i++) y[i] = z[i], k[0][i] = k[STAGES][i];
        }
        h *= fmin(5, fmax(0.2, 0.7 * pow(fmax(error, 1e-10), -0.125)));
    }
}

static void rhs_double_pendulum(const double *y, double *f, const double *p)
{
    (void)p;
    const double c = cos(y[0] - y[1]), s = sin(y[0] - y[1]);
    const double m11 = 4.0 / 3, m22 = 1.0 / 3, m12 = 0.5 * c;
    const double f1 = -1.5 * G_SI * cos(y[0]) - 0.5 * s * y[3] * y[3];
    const double f2 = -0.5 * G_SI * cos(y[1]) + 0.5 * s * y[2] * y[2];
    const double det = m11 * m22 - m12 * m12;
    f[0] = y[2];
    f[1] = y[3];
    f[2] = (f1 * m22 - f2 * m12) / det;
    f[3] = (m11 * f2 - m12 * f1) / det;
}

static void rhs_slider_crank(const double *y, double *f, const double *p)
{
    (void)p;
    const double a = 0.1, length = 0.3, m1 = 0.2, m2 = 0.2, m3 = 0.4;
    const double s = sin(y[0]), c = cos(y[0]), root = sqrt(length * length - a * a * s * s);
    const double phi = a * c / root, dphi = (-a * s * root + a * c * a * a * s * c / root) / (root * root);
    const double x2 = -a * s - a * s * phi / 2, y2 = a * c / 2;
    const double dx2 = -a * c - (a * c * phi + a * s * dphi) / 2, dy2 = -a * s / 2;
    const double x3 = -a * s - a * s * phi, dx3 = -a * c - a * c * phi - a * s * dphi;
    const double rod = m2 * length * length / 12;
    const double inertia = m1 * a * a / 3 + m2 * (x2 * x2 + y2 * y2) + rod * phi * phi + m3 * x3 * x3;
    const double slope = 2 * (m2 * (x2 * dx2 + y2 * dy2) + rod * phi * dphi + m3 * x3 * dx3);
    f[0] = y[1];
    f[1] = -(0.5 * slope * y[1] * y[1] + G_SI * a / 2 * (m1 + m2) * c) / inertia;
}

static void rhs_pendulum(const double *y, double *f, const double *p)
{
    f[0] = y[1];
    f[1] = -p[0] * cos(y[0]);
}

void double_pendulum(int n, const double *cases, double *out, double setting)
{
    (void)cases;
    for (int i = 0; i < n; i++) {
        double y[4] = {0};
        integrate(rhs_double_pendulum, 4, y, 5, setting, 0);
        out[2 * i] = cos(y[0]) + cos(y[1]);
        out[2 * i + 1] = sin(y[0]) + sin(y[1]);
    }
}

void slider_crank(int n, const double *cases, double *out, double setting)
{
    (void)cases;
    for (int i = 0; i < n; i++) {
        double y[2] = {PI / 4, 10};
        integrate(rhs_slider_crank, 2, y, 10, setting, 0);
        out[i] = y[0];
    }
}

void pendulum_a01(int n, const double *cases, double *out, double setting)
{
    (void)cases;
    const double k = G_SI;
    for (int i = 0; i < n; i++) {
        double y[2] = {PI, 0};
        integrate(rhs_pendulum, 2, y, 10, setting, &k);
        out[2 * i] = cos(y[0]);
        out[2 * i + 1] = sin(y[0]);
    }
}

static void four_bars(int n, double *out, double setting, int couplers)
{
    const double inertia = (couplers + 1) / 3.0 + couplers, moment = (couplers + 1) / 2.0 + couplers;
    const double k = G_SI * moment / inertia;
    for (int i = 0; i < n; i++) {
        double y[2] = {PI / 2, -1};
        integrate(rhs_pendulum, 2, y, 10, setting, &k);
        out[2 * i] = y[0];
        out[2 * i + 1] = inertia * y[1] * y[1] / 2 + G_SI * moment * sin(y[0]);
    }
}

void four_bars_2(int n, const double *cases, double *out, double setting)
{
    (void)cases;
    four_bars(n, out, setting, 2);
}

void four_bars_40(int n, const double *cases, double *out, double setting)
{
    (void)cases;
    four_bars(n, out, setting, 40);
}

void sphere_over_bars(int n, const double *cases, double *out, double setting)
{
    (void)setting;
    const double r = 10 * INCH, contact = 1.4;
    for (int i = 0; i < n; i++) {
        const double s = cases[2 * i] / (2 * r), k = (0.4 + 1 - 2 * s * s) / contact;
        const double c = 2 * G_US * s * s / (1 + sqrt(1 - s * s)) / (contact * r);
        double square = cases[2 * i + 1] * cases[2 * i + 1], first = NAN;
        int bars = 0;
        for (;;) {
            const double next = k * k * (square + c) - c;
            if (next <= 0) break;
            square = next;
            if (bars++ == 0) first = sqrt(square);
        }
        out[2 * i] = first;
        out[2 * i + 1] = bars;
    }
}

void rolling_collar(int n, const double *cases, double *out, double setting)
{
    const double r = 0.3, m = 2, omega0 = 15;
    const int steps = (int)setting;
    for (int i = 0; i < n; i++) {
        const double d = cases[2 * i], mc = cases[2 * i + 1] * m;
        const double fixed = 2 * m * r * r + mc * (r * r + d * d), swing = 2 * mc * r * d, lift = 2 * mc * G_SI * d;
        const double energy = (fixed - swing) * omega0 * omega0;
        double time = 0;
        for (int j = 0; j < steps; j++) {
            const double c = cos(2 * PI * j / steps);
            time += sqrt((fixed - swing * c) / (energy - lift * (1 - c)));
        }
        out[2 * i] = sqrt((energy - 2 * lift) / (fixed + swing));
        out[2 * i + 1] = 2 * PI / steps * time;
    }
}

void linkage_c5(int n, const double *cases, double *out, double setting)
{
    (void)cases;
    const int steps = (int)setting;
    static const double mark[] = {10, 20, 30, 40, 50, 60, 70, 80, 89};
    const double length = 30 * INCH, gauss = 0.5773502691896257;
    for (int i = 0; i < n; i++) {
        double *answer = out + 11 * i, time = 0;
        for (int j = 0; j < 9; j++) {
            const double s = sin(mark[j] * PI / 180);
            answer[j] = sqrt(3 * G_US * s / (length * (1 + 3 * s * s)));
        }
        const double end = 89 * PI / 180, h = sqrt(end) / steps;
        for (int j = 0; j < steps; j++)
            for (int side = -1; side <= 1; side += 2) {
                const double u = (j + 0.5 * (1 + side * gauss)) * h, s = sin(u * u);
                time += h * u * sqrt(length * (1 + 3 * s * s) / (3 * G_US * s));
            }
        answer[9] = 2 * length * sin(end) * answer[8];
        answer[10] = time;
    }
}

void zeno_ball(int n, const double *cases, double *out, double setting)
{
    (void)cases;
    (void)setting;
    for (int i = 0; i < n; i++) {
        const double first = sqrt(2 / G_SI);
        out[2 * i] = first;
        out[2 * i + 1] = first * (1 + 0.9) / (1 - 0.9);
    }
}

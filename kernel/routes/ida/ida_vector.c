/* ida_vector.c - the vector operations that IDA uses, compiled with our flags: a distribution's SUNDIALS
 * may come without optimisation, and these loops are most of its time.
 *
 * All clones of a vector share one length that their owner may change between two runs of the integrator:
 * the number of active constraints changes with the phase, and neither the work nor the root mean squares may
 * depend on constraints that a scene could have but has not. */
#include "routes/ida/ida.h"

#include <math.h>
#include <stdlib.h>

typedef struct pm_ida_content {
    const int *length;
    int most;
    double data[];
} pm_ida_content;

static pm_ida_content *content_of(N_Vector x) { return x->content; }
static double *data_of(N_Vector x) { return content_of(x)->data; }
static int length_of(N_Vector x) { return *content_of(x)->length; }

/* ---- creation ---- */
static void *new_content(const int *length, int most)
{
    pm_ida_content *c = calloc(1, sizeof *c + (size_t)most * sizeof(double));
    if (!c) return NULL;
    c->length = length;
    c->most = most;
    return c;
}

static void destroy(N_Vector x)
{
    if (!x) return;
    free(x->content);
    x->content = NULL;
    N_VFreeEmpty(x);
}

static N_Vector clone(N_Vector like)
{
    N_Vector x = N_VNewEmpty(like->sunctx);
    if (!x) return NULL;
    x->content = new_content(content_of(like)->length, content_of(like)->most);
    if (x->content && N_VCopyOps(like, x) == 0) return x;
    destroy(x);
    return NULL;
}

static N_Vector_ID get_id(N_Vector x)
{
    (void)x;
    return SUNDIALS_NVEC_CUSTOM;
}

static sunindextype get_length(N_Vector x) { return length_of(x); }

/* ---- one and two vectors ---- */
static void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z)
{
    const double *px = data_of(x), *py = data_of(y);
    double *pz = data_of(z);
    const int n = length_of(z);
    for (int i = 0; i < n; i++) pz[i] = a * px[i] + b * py[i];
}

static void scale(double c, N_Vector x, N_Vector z)
{
    const double *px = data_of(x);
    double *pz = data_of(z);
    const int n = length_of(z);
    for (int i = 0; i < n; i++) pz[i] = c * px[i];
}

static void constant(double c, N_Vector z)
{
    double *pz = data_of(z);
    const int n = length_of(z);
    for (int i = 0; i < n; i++) pz[i] = c;
}

static void add_constant(N_Vector x, double b, N_Vector z)
{
    const double *px = data_of(x);
    double *pz = data_of(z);
    const int n = length_of(z);
    for (int i = 0; i < n; i++) pz[i] = px[i] + b;
}

static void product(N_Vector x, N_Vector y, N_Vector z)
{
    const double *px = data_of(x), *py = data_of(y);
    double *pz = data_of(z);
    const int n = length_of(z);
    for (int i = 0; i < n; i++) pz[i] = px[i] * py[i];
}

static void absolute(N_Vector x, N_Vector z)
{
    const double *px = data_of(x);
    double *pz = data_of(z);
    const int n = length_of(z);
    for (int i = 0; i < n; i++) pz[i] = fabs(px[i]);
}

static void inverse(N_Vector x, N_Vector z)
{
    const double *px = data_of(x);
    double *pz = data_of(z);
    const int n = length_of(z);
    for (int i = 0; i < n; i++) pz[i] = 1 / px[i];
}

/* ---- reductions ---- */
static double least(N_Vector x)
{
    const double *px = data_of(x);
    const int n = length_of(x);
    double low = INFINITY;
    for (int i = 0; i < n; i++) low = px[i] < low ? px[i] : low;
    return low;
}

static double rms(N_Vector x, N_Vector weight)
{
    const double *px = data_of(x), *pw = data_of(weight);
    const int n = length_of(x);
    double sum = 0;
    for (int i = 0; i < n; i++) sum += px[i] * pw[i] * (px[i] * pw[i]);
    return sqrt(sum / n);
}

static double rms_masked(N_Vector x, N_Vector weight, N_Vector mask)
{
    const double *px = data_of(x), *pw = data_of(weight), *pm = data_of(mask);
    const int n = length_of(x);
    double sum = 0;
    for (int i = 0; i < n; i++)
        if (pm[i] > 0) sum += px[i] * pw[i] * (px[i] * pw[i]);
    return sqrt(sum / n);
}

/* ---- several vectors at once ---- */
static int linear_combination(int nvec, double *c, N_Vector *x, N_Vector z)
{
    const int n = length_of(z);
    double *pz = data_of(z);
    const double *first = data_of(x[0]);
    for (int i = 0; i < n; i++) pz[i] = c[0] * first[i]; /* z may be x[0], and no other */
    for (int k = 1; k < nvec; k++) {
        const double a = c[k], *px = data_of(x[k]);
        for (int i = 0; i < n; i++) pz[i] += a * px[i];
    }
    return 0;
}

static int scale_array(int nvec, double *c, N_Vector *x, N_Vector *z)
{
    for (int k = 0; k < nvec; k++) scale(c[k], x[k], z[k]);
    return 0;
}

static int linear_sum_array(int nvec, double a, N_Vector *x, double b, N_Vector *y, N_Vector *z)
{
    for (int k = 0; k < nvec; k++) linear_sum(a, x[k], b, y[k], z[k]);
    return 0;
}

N_Vector pm_ida_vector_create(SUNContext context, const int *length, int most)
{
    N_Vector x = N_VNewEmpty(context);
    if (!x) return NULL;
    x->content = new_content(length, most);
    if (!x->content) {
        destroy(x);
        return NULL;
    }
    x->ops->nvgetvectorid = get_id;
    x->ops->nvclone = clone;
    x->ops->nvdestroy = destroy;
    x->ops->nvgetarraypointer = data_of;
    x->ops->nvgetlength = get_length;
    x->ops->nvlinearsum = linear_sum;
    x->ops->nvconst = constant;
    x->ops->nvprod = product;
    x->ops->nvscale = scale;
    x->ops->nvabs = absolute;
    x->ops->nvinv = inverse;
    x->ops->nvaddconst = add_constant;
    x->ops->nvmin = least;
    x->ops->nvwrmsnorm = rms;
    x->ops->nvwrmsnormmask = rms_masked;
    x->ops->nvlinearcombination = linear_combination;
    x->ops->nvscalevectorarray = scale_array;
    x->ops->nvlinearsumvectorarray = linear_sum_array;
    return x;
}

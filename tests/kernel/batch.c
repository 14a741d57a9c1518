/* Batches: the same bits for any number of workers and any chunks, the stop flag, the trace, texts of statuses. */
#include <pthread.h>
#include <time.h>

#include "check.h"
#include "estimating.h"
#include "scene.h"

#define CASES 48
#define OUTS 4

typedef struct results {
    double out[CASES][OUTS], error[CASES][OUTS], margin[CASES][OUTS], trust[CASES][PM_TRUSTS],
        audit[CASES][PM_AUDITS], detail[CASES][PM_DETAIL_COLUMNS];
    int32_t reason[CASES][OUTS], status[CASES], where[CASES][PM_WHERE_COLUMNS];
    int64_t count[CASES][PM_COUNT_COLUMNS], progress;
    double found[CASES][PM_FOUND_COLUMNS];
} results;

static double param[CASES][2];

/* A sphere that rolls over bars, d and omega apart; some cases fail, some end early. */
static scene *bars(void)
{
    scene *s = scene_create();
    const int d = scene_parameter(s), omega = scene_parameter(s);
    const int b = scene_body(s, 3, 0.4 * 3 * 0.0625, 0, 0.25, 0), g = scene_point(s, b, 0, 0);
    const int row = SCENE_ROW(s, PM_TABLE_PATTERN, scene_point(s, PM_GROUND, 0, 0), d, scene_value(s, 0),
                              scene_value(s, -1));
    scene_contact(s, PM_CONTACT_PATTERN, scene_circle(s, g, 0.25), row, 0, 0, PM_FRICTION_ROUGH, 0);
    const int w = scene_measure(s, PM_MEASURE_OMEGA, b);
    SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, w, omega);
    const int strike = scene_on(s, PM_TRIGGER_STRIKE, 0);
    scene_until(s, scene_when(s, PM_TRIGGER_RISE, scene_read(s, w)), 1);
    scene_ask_event(s, scene_read(s, w), strike, 1, 1);
    scene_ask_event(s, scene_read(s, w), strike, 2, 0);
    scene_ask_count(s, strike);
    scene_ask_extreme(s, PM_ASK_MIN, scene_read(s, scene_measure(s, PM_MEASURE_CONTACT_NORMAL, 0)), PM_NONE);
    *scene_setting(s, PM_SETTING_MAX_EVENTS) = 60;
    scene_pack(s);
    for (int i = 0; i < CASES; i++) {
        param[i][0] = i % 11 == 5 ? -0. : 0.02 + 0.004 * i; /* bars at one place: refused */
        param[i][1] = -0.4 - 0.05 * (i % 9);
    }
    return s;
}

/* A ball flies straight into the lower of two rods that hang at rest without weight: first uniform motion, then that of rk. */
static scene *struck_chain(void)
{
    scene *s = scene_create();
    scene_set(s, PM_SETTING_GRAVITY_Y, 0);
    *scene_setting(s, PM_SETTING_ESTIMATE) = 1;
    const int mass = scene_parameter(s), speed = scene_parameter(s);
    const int lower = hang_two_rods(s, -M_PI / 2, -M_PI / 2), upper = lower - 1;
    const int ball = scene_body(s, 1, 0, -1, -1.2, 0), centre = scene_point(s, ball, 0, 0);
    scene_cell(s, PM_TABLE_BODY, ball, PM_BODY_MASS, mass);
    scene_contact(s, PM_CONTACT_CIRCLE, scene_circle(s, centre, 0.05),
                  scene_circle(s, scene_point(s, lower, -0.3, 0), 0.02), 1, 0.5, PM_FRICTION_SMOOTH, 0);
    SCENE_ROW(s, PM_TABLE_START, PM_START_VELOCITY, scene_part(s, PM_MEASURE_VELOCITY, centre, PM_PART_X),
              speed);
    scene_until_time(s, 3);
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, upper));
    scene_ask_measure(s, scene_measure(s, PM_MEASURE_TURNED, lower));
    scene_ask_measure(s, scene_part(s, PM_MEASURE_POSITION, scene_point(s, lower, 0.5, 0), PM_PART_X));
    scene_ask_extreme(s, PM_ASK_MAX, scene_read(s, scene_measure(s, PM_MEASURE_OMEGA, lower)), PM_NONE);
    scene_pack(s);
    for (int i = 0; i < CASES; i++) {
        param[i][0] = 0.2 + 0.05 * (i % 7);
        param[i][1] = 1 + 0.25 * (i * 5 % 11);
    }
    return s;
}

static int run(const scene *s, results *x, int first, int n, int workers, const int32_t *stop)
{
    return pm_batch(s->ntable, s->table, s->nconstant, s->constant, n, s->nparam, param[first], workers, stop,
                    &x->progress, OUTS, x->out[first], OUTS, x->reason[first], x->status + first,
                    x->where[first], x->detail[first], x->audit[first], x->count[first], x->found[first],
                    x->error[first], x->margin[first], x->trust[first]);
}

static int same(const results *a, const results *b)
{
    return !memcmp(a->out, b->out, sizeof a->out) && !memcmp(a->audit, b->audit, sizeof a->audit) &&
           !memcmp(a->error, b->error, sizeof a->error) && !memcmp(a->margin, b->margin, sizeof a->margin) &&
           !memcmp(a->trust, b->trust, sizeof a->trust) && !memcmp(a->detail, b->detail, sizeof a->detail) &&
           !memcmp(a->reason, b->reason, sizeof a->reason) &&
           !memcmp(a->status, b->status, sizeof a->status) && !memcmp(a->where, b->where, sizeof a->where) &&
           !memcmp(a->count, b->count, sizeof a->count);
}

/* Some roll on, some are refused. */
static void bars_end_differently(void)
{
    static results x;
    scene *s = bars();
    const int32_t stop = 0;
    x.progress = 10 * CASES; /* of another batch */
    EQUAL(run(s, &x, 0, CASES, 1, &stop), PM_OK);
    EQUAL(x.progress, CASES);
    int seen[64] = {0};
    for (int i = 0; i < CASES; i++) seen[x.status[i] + 32]++;
    CHECK(seen[32] > 20 && seen[32 + PM_BAD_VALUE] > 3);
    EQUAL(run(s, &x, 0, 0, 2, &stop), PM_OK);
    scene_free(s);
}

/* One after the other, by any number of workers, in any chunks, each alone: no case owes anything to the one before. */
static void same_bits(scene *s)
{
    static results one, other;
    const int32_t stop = 0;
    EQUAL(run(s, &one, 0, CASES, 1, &stop), PM_OK);
    for (int workers = 0; workers <= 3; workers++) {
        memset(&other, 0, sizeof other);
        EQUAL(run(s, &other, 0, CASES, workers, &stop), PM_OK);
        CHECK(same(&one, &other));
    }
    for (int chunk = 1; chunk < CASES; chunk = 2 * chunk + 5) {
        memset(&other, 0, sizeof other);
        for (int first = 0; first < CASES; first += chunk)
            EQUAL(run(s, &other, first, first + chunk < CASES ? chunk : CASES - first, 1 + chunk % 3, &stop),
                  PM_OK);
        CHECK(same(&one, &other));
    }
    memset(&other, 0, sizeof other);
    for (int i = CASES - 1; i >= 0; i--) EQUAL(run(s, &other, i, 1, 1, &stop), PM_OK);
    CHECK(same(&one, &other));
    scene_free(s);
}

static void stopped_before(void)
{
    static results x;
    scene *s = bars();
    const int32_t stop = 1;
    EQUAL(run(s, &x, 0, CASES, 2, &stop), PM_OK);
    EQUAL(x.progress, CASES);
    for (int i = 0; i < CASES; i++) {
        EQUAL(x.status[i], PM_CANCELLED);
        CHECK(isnan(x.out[i][0]) && isnan(x.audit[i][0]));
        EQUAL(x.reason[i][0], PM_REASON_FAILED);
    }
    scene_free(s);
}

/* Another thread reads the progress while many short cases end at once: it only grows. */
typedef struct reader {
    int64_t *progress;
    int ends, falls;
} reader;

static void *read_progress(void *context)
{
    reader *x = context;
    int64_t last = 0;
    while (!__atomic_load_n(&x->ends, __ATOMIC_RELAXED)) {
        const int64_t now = __atomic_load_n(x->progress, __ATOMIC_RELAXED);
        x->falls += now < last;
        last = now;
    }
    return NULL;
}

static void progress_only_grows(void)
{
    static results x;
    scene *s = bars();
    const int32_t stop = 1; /* cases that are not begun are the shortest */
    for (int i = 0; i < 20; i++) {
        reader at = {.progress = &x.progress};
        pthread_t thread;
        x.progress = 0;
        CHECK(pthread_create(&thread, NULL, read_progress, &at) == 0);
        EQUAL(run(s, &x, 0, CASES, 4, &stop), PM_OK);
        __atomic_store_n(&at.ends, 1, __ATOMIC_RELAXED);
        pthread_join(thread, NULL);
        EQUAL(at.falls, 0);
        EQUAL(x.progress, CASES);
    }
    scene_free(s);
}

static void *raise_soon(void *stop)
{
    const struct timespec a_while = {0, 20000000};
    nanosleep(&a_while, NULL);
    __atomic_store_n((int32_t *)stop, 1, __ATOMIC_RELAXED);
    return NULL;
}

/* The status of a run without end; limit: s of computing time. */
static int endless(const int32_t *stop, double limit)
{
    scene *s = scene_create();
    if (limit > 0) scene_set(s, PM_SETTING_MAX_CPU, limit);
    const int b = scene_body(s, 1, 1, 0, 0, 0);
    scene_joint(s, PM_JOINT_PIN, scene_point(s, b, -1, 0), scene_point(s, PM_GROUND, 0, 0), 0);
    scene_until_time(s, 1e9);
    scene_set(s, PM_SETTING_MAX_TIME, 1e9);
    *scene_setting(s, PM_SETTING_MAX_STEPS) = INT32_MAX;
    scene_pack(s);
    int32_t status, reason[1], where[3];
    double out[1], detail[3], audit[3], found[PM_FOUND_COLUMNS], trust[PM_TRUSTS];
    int64_t count[PM_COUNT_COLUMNS], progress = 0;
    EQUAL(pm_batch(s->ntable, s->table, s->nconstant, s->constant, 1, 0, detail, 1, stop, &progress, 0, out,
                   0, reason, &status, where, detail, audit, count, found, out, out, trust),
          PM_OK);
    if (status == PM_LIMIT_CPU) {
        EQUAL(where[PM_WHERE_TABLE], PM_TABLE_SETTING);
        NEAR(detail[PM_DETAIL_BOUND], limit, 0);
        CHECK(detail[PM_DETAIL_TIME] > 0);
    }
    scene_free(s);
    return status;
}

/* It stops when the flag is raised, also where it has a limit that is far. */
static void stopped_inside(void)
{
    for (int limited = 0; limited < 2; limited++) {
        int32_t stop = 0;
        pthread_t thread;
        CHECK(pthread_create(&thread, NULL, raise_soon, &stop) == 0);
        EQUAL(endless(&stop, limited ? 1e6 : 0), PM_CANCELLED);
        pthread_join(thread, NULL);
    }
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* It stops when its time is spent, and not before; so does the next case of the same thread, which has the same time. */
static void time_is_spent(void)
{
    for (int i = 0; i < 2; i++) {
        const double begun = seconds();
        EQUAL(endless(NULL, 0.05), PM_LIMIT_CPU);
        const double spent = seconds() - begun;
        CHECK(spent > 0.05);
        CHECK(spent < 0.1);
    }
}

static void wrong_sizes(void)
{
    static results x;
    scene *s = bars();
    const int32_t stop = 0;
    EQUAL(pm_batch(s->ntable, s->table, s->nconstant, s->constant, 1, s->nparam, param[0], 1, &stop,
                   &x.progress, OUTS + 1, x.out[0], OUTS, x.reason[0], x.status, x.where[0], x.detail[0],
                   x.audit[0], x.count[0], x.found[0], x.error[0], x.margin[0], x.trust[0]),
          PM_BAD_TABLE);
    EQUAL(x.where[0][PM_WHERE_TABLE], PM_TABLE_ASK);
    scene_free(s);
}

/* A buffer too small says how much is wanted; the rows that fit are those of the large one. */
static void trace(void)
{
    scene *s = bars();
    const int32_t program[] = {s->cell[PM_TABLE_TRIGGER][PM_TRIGGER_COLUMNS + PM_TRIGGER_PROGRAM]};
    const double bend[] = {INFINITY};
    static double small[4][2], large[20000][2];
    static int32_t small_mark[4], mark[20000];
    int64_t needed, again;
    int32_t where[3];
    double detail[3];
    const double *p = param[20];
    const int status = pm_trace(s->ntable, s->table, s->nconstant, s->constant, s->nparam, p, NULL, 0, 1,
                                program, bend, 4, small[0], small_mark, &needed, where, detail);
    CHECK(needed > 4 && needed < 20000);
    EQUAL(pm_trace(s->ntable, s->table, s->nconstant, s->constant, s->nparam, p, NULL, 0, 1, program, bend,
                   needed, large[0], mark, &again, where, detail),
          status);
    EQUAL(again, needed);
    CHECK(!memcmp(small, large, sizeof small) && !memcmp(small_mark, mark, sizeof small_mark));
    static results x;
    const int32_t stop = 0;
    EQUAL(run(s, &x, 20, 1, 1, &stop), PM_OK);
    EQUAL(x.status[20], status);
    int strikes = 0;
    NEAR(large[0][1], p[1], 1e-15);
    EQUAL(mark[0], 2);
    for (int i = 1; i < needed; i++) {
        CHECK(large[i][0] >= large[i - 1][0]);
        if (mark[i] == 1) CHECK(mark[i + 1] == 2 && large[i + 1][0] == large[i][0]);
        if (mark[i] != 2) continue;
        if (++strikes == 1)
            EQUAL(large[i - 1][1], x.out[20][0]); /* the same bits as the batch, before the first blow */
    }
    EQUAL(strikes, x.count[20][PM_COUNT_EVENTS] - 1);
    const int32_t wrong[] = {100000};
    EQUAL(pm_trace(s->ntable, s->table, s->nconstant, s->constant, s->nparam, p, NULL, 0, 1, wrong, bend, 4,
                   small[0], small_mark, &needed, where, detail),
          PM_BAD_TABLE);
    scene_free(s);
}

static void texts(void)
{
    int8_t text[200], few[8];
    for (int status = PM_CONTACT_SLOTS; status <= PM_STAYS_AT_REST; status++) {
        const int n = pm_status_text(status, sizeof text, text);
        CHECK(n > 1 && n < (int)sizeof text && strcmp((char *)text, "unknown status") != 0);
        pm_status_text(status, sizeof few, few);
        CHECK(strlen((char *)few) < sizeof few);
    }
    pm_status_text(-77, sizeof text, text);
    CHECK(strcmp((char *)text, "unknown status") == 0);
}

int main(void)
{
    bars_end_differently();
    same_bits(bars());
    same_bits(struck_chain());
    stopped_before();
    progress_only_grows();
    stopped_inside();
    time_is_spent();
    wrong_sizes();
    trace();
    texts();
    return check_failures();
}

/* fuzz.c - tables changed at random through the whole kernel: none may fall, hang, or be ok with what is no number.
 *
 *   fuzz                          some thousand changes of scenes built here
 *   fuzz FILE first count jobs    changes first .. of the models in FILE, which `python -m tests.stress.tables` writes
 *   fuzz FILE --only number       one of them, in this process; FILE -: of the scenes built here
 *   fuzz FILE --valid             the models as they are
 *   fuzz FILE --threads           the models as they are, several batches at the same time, several threads each
 *
 * Each change has a number, from which alone it follows.  Workers are processes: what falls is counted, and the next one goes on. */
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "calls.h"
#include "planemotion.h"
#include "tables.h"

#define MOST_JOBS 64
#define PATIENCE 4 /* s of computing time until the stop flag is raised; as long again, and it hangs */
#define SHOWN 20   /* faults that are told */
#define QUICK 3000 /* changes without arguments */

enum { EXIT_FAULT = 40, EXIT_HANGS = 41 };

/* What a worker tells its parent, in memory of both. */
typedef struct board {
    int64_t number, done, stopped, slowest;
    int64_t outcome[CALLS_OUTCOMES];
    double seconds;
} board;

typedef struct range {
    int64_t first, count;
    int jobs;
} range;

static volatile int32_t stop;
static volatile sig_atomic_t rings;

static void ring(int sign)
{
    (void)sign;
    if (rings++) _exit(EXIT_HANGS);
    stop = 1;
}

static void wind(int seconds)
{
    const struct itimerval interval = {{seconds, 0}, {seconds, 0}};
    stop = 0;
    rings = 0;
    setitimer(ITIMER_PROF, &interval, NULL);
}

static double seconds_used(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Change `number` of its model, and what becomes of it. */
static int one(const corpus *c, int64_t number, const char **fault)
{
    uint64_t r = (uint64_t)number;
    tables x = tables_copy(&c->model[tables_below(&r, c->n)]);
    tables_mutate(&x, tables_random(&r));
    const int outcome = calls_all(&x, (uint64_t)number, (const int32_t *)&stop, fault);
    tables_free(&x);
    return outcome;
}

static void do_one(const corpus *c, board *b, int64_t number)
{
    const char *fault;
    const double begun = seconds_used();
    b->number = number;
    wind(PATIENCE);
    b->outcome[one(c, number, &fault)]++;
    const double used = seconds_used() - begun;
    if (used > b->seconds) {
        b->seconds = used;
        b->slowest = number;
    }
    b->stopped += rings > 0;
    b->done++;
    if (!fault) return;
    fprintf(stderr, "%s: ", fault);
    _exit(EXIT_FAULT);
}

/* Numbers of worker `job` from `from` on; the process ends with them. */
static pid_t start_worker(const corpus *c, const range *x, int64_t from, board *b)
{
    fflush(stdout);
    const pid_t pid = fork();
    if (pid != 0) return pid;
    signal(SIGPROF, ring);
    for (int64_t i = from; i < x->first + x->count; i += x->jobs) do_one(c, b, i);
    exit(0);
}

static void tell_fault(const board *b, int status)
{
    const int hangs = WIFEXITED(status) && WEXITSTATUS(status) == EXIT_HANGS;
    const int fault = WIFEXITED(status) && WEXITSTATUS(status) == EXIT_FAULT;
    fprintf(stderr, "number %lld: %s (wait status %d)\n", (long long)b->number,
            hangs   ? "it hangs"
            : fault ? "is ok"
                    : "it falls",
            status);
}

static int report(const board *b, const range *x, int faults, double seconds)
{
    static const char *const word[CALLS_OUTCOMES] = {"ok", "ended early", "failed", "refused"};
    board all = {.number = 0};
    for (int j = 0; j < x->jobs; j++) {
        all.done += b[j].done;
        all.stopped += b[j].stopped;
        for (int k = 0; k < CALLS_OUTCOMES; k++) all.outcome[k] += b[j].outcome[k];
        if (b[j].seconds < all.seconds) continue;
        all.seconds = b[j].seconds;
        all.slowest = b[j].slowest;
    }
    printf("%lld changed tables in %.0f s:", (long long)all.done, seconds);
    for (int k = 0; k < CALLS_OUTCOMES; k++) printf(" %s %lld,", word[k], (long long)all.outcome[k]);
    printf(" faults %d\nstopped by the flag: %lld; the slowest, number %lld, took %.1f s\n", faults,
           (long long)all.stopped, (long long)all.slowest, all.seconds);
    return faults > 0 || all.done < x->count - faults;
}

/* All numbers; a worker that falls is told and followed by another, from its next number on. */
static int fuzz(const corpus *c, const range *x)
{
    board *b = mmap(NULL, MOST_JOBS * sizeof *b, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (b == MAP_FAILED) return 1;
    pid_t pid[MOST_JOBS];
    int faults = 0, busy = x->jobs, status;
    const time_t begun = time(NULL);
    for (int j = 0; j < x->jobs; j++) pid[j] = start_worker(c, x, x->first + j, &b[j]);
    while (busy > 0) {
        const pid_t ended = wait(&status);
        if (ended < 0) break;
        busy--;
        if (status == 0) continue;
        int j = 0;
        while (pid[j] != ended) j++;
        if (faults++ < SHOWN) tell_fault(&b[j], status);
        if (b[j].number == 0 && b[j].done == 0 && x->first != 0) break; /* it never began */
        pid[j] = start_worker(c, x, b[j].number + x->jobs, &b[j]);
        busy++;
    }
    return report(b, x, faults, difftime(time(NULL), begun));
}

/* ---- models as they are ---- */
/* However long they take, as under valgrind. */
static void lift_limits(corpus *c)
{
    for (int i = 0; i < c->n; i++)
        if (tables_rows(&c->model[i], PM_TABLE_SETTING) == 1)
            tables_row(&c->model[i], PM_TABLE_SETTING, 0)[PM_SETTING_MAX_CPU] = PM_NONE;
}

static int valid(const corpus *c)
{
    int faults = 0, outcome[CALLS_OUTCOMES] = {0};
    for (int i = 0; i < c->n; i++) {
        const char *fault;
        tables x = tables_copy(&c->model[i]);
        wind(0);
        outcome[calls_all(&x, (uint64_t)i, (const int32_t *)&stop, &fault)]++;
        tables_free(&x);
        if (fault) fprintf(stderr, "model %d: %s\n", i, fault);
        faults += fault != NULL;
    }
    printf("%d models: ok %d, ended early %d, failed %d, refused %d, faults %d\n", c->n, outcome[CALLS_OK],
           outcome[CALLS_EARLY], outcome[CALLS_FAILED], outcome[CALLS_REFUSED], faults);
    return faults > 0 || outcome[CALLS_OK] == 0;
}

typedef struct thread {
    pthread_t id;
    const corpus *corpus;
    int first, differs;
} thread;

static void *run_batches(void *x)
{
    thread *t = x;
    for (int i = 0; i < t->corpus->n; i++) {
        const int model = (i + t->first) % t->corpus->n;
        const int differs = calls_batch_differs(&t->corpus->model[model], 6, 3);
        if (differs) fprintf(stderr, "model %d: cases that are alike differ\n", model);
        t->differs += differs;
    }
    return NULL;
}

static int threads(const corpus *c)
{
    thread t[3];
    int differs = 0;
    for (int i = 0; i < 3; i++) {
        t[i] = (thread){.corpus = c, .first = i < 2 ? 0 : c->n / 2};
        if (pthread_create(&t[i].id, NULL, run_batches, &t[i])) return 1;
    }
    for (int i = 0; i < 3; i++) {
        pthread_join(t[i].id, NULL);
        differs += t[i].differs;
    }
    printf("%d models in 3 batches at the same time, 3 threads each: %d differ\n", c->n, differs);
    return differs > 0;
}

static int only(const corpus *c, int64_t number)
{
    const char *fault;
    signal(SIGPROF, ring);
    wind(PATIENCE);
    const int outcome = one(c, number, &fault);
    printf("number %lld: outcome %d; %s; %.2f s\n", (long long)number, outcome, fault ? fault : "sound",
           seconds_used());
    return fault != NULL;
}

static int chosen(corpus *c, int argc, char **argv)
{
    const int as_they_are = argc == 3 && (!strcmp(argv[2], "--valid") || !strcmp(argv[2], "--threads"));
    if (as_they_are) lift_limits(c);
    if (as_they_are) return (argv[2][2] == 'v' ? valid : threads)(c);
    if (argc == 4 && !strcmp(argv[2], "--only")) return only(c, atoll(argv[3]));
    if (argc != 1 && argc != 5) {
        fprintf(stderr, "fuzz [FILE (--valid | --threads | --only number | first count jobs)]\n");
        return 2;
    }
    range x = {.first = 0, .count = QUICK, .jobs = 2};
    if (argc == 5) x = (range){.first = atoll(argv[2]), .count = atoll(argv[3]), .jobs = atoi(argv[4])};
    if (x.jobs < 1 || x.jobs > MOST_JOBS) return 2;
    return fuzz(c, &x);
}

int main(int argc, char **argv)
{
    corpus c = {0, NULL};
    if (argc == 1 || !strcmp(argv[1], "-"))
        corpus_build(&c);
    else if (corpus_read(&c, argv[1])) {
        fprintf(stderr, "%s: no models could be read\n", argv[1]);
        return 2;
    }
    const int failed = chosen(&c, argc, argv);
    corpus_free(&c);
    return failed;
}

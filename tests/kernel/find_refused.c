/* Finds of nothing, or of more than one thing: what is said; finds in a batch, and tables that do not fit. */
#include "check.h"
#include "find_throws.h"
#include "scene.h"

#define G 9.81

static void nothing_found(void)
{
    throwing f = thrown_down_to(0);
    scene_find(f.s, PM_FIND_VALUE, PM_NONE, 16);
    scene_vary(f.s, 0, 1, 10);
    scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, 20));
    const int out = scene_ask_measure(f.s, f.x);
    const double param[] = {0, 0.7};
    EQUAL(scene_run(f.s, param), PM_FIND_NONE);
    EQUAL(f.s->where[PM_WHERE_TABLE], PM_TABLE_CONDITION);
    NEAR(f.s->detail[PM_DETAIL_VALUE], sin(1.4) / G - 20, 1e-9);
    NEAR(f.s->detail[PM_DETAIL_BOUND], 100 * sin(1.4) / G - 20, 1e-9);
    CHECK(isnan(f.s->out[out]) && isnan(f.s->found[0]) && isnan(f.s->audit[0]));
    EQUAL(f.s->reason[0], PM_REASON_FAILED);
    f.s->cell[PM_TABLE_VARY][PM_VARY_HIGH] = scene_value(f.s, 0.5); /* bounds the wrong way round */
    EQUAL(scene_run(f.s, param), PM_BAD_VALUE);
    EQUAL(f.s->where[PM_WHERE_TABLE], PM_TABLE_VARY);
    scene_free(f.s);
}

/* A sign that changes through a pole or a step is no root; a run that fails says why. */
static void no_root(void)
{
    static const int op[] = {PM_OP_DIV, PM_OP_FLOOR};
    for (int i = 0; i < 2; i++) {
        throwing f = thrown_down_to(0);
        const int jump = i == 0 ? SCENE_PROGRAM(f.s, scene_k(f.s, 1), scene_p(0), scene_k(f.s, 7.3),
                                                scene_op(PM_OP_SUB), scene_op(op[i]))
                                : SCENE_PROGRAM(f.s, scene_p(0), scene_k(f.s, 7.3), scene_op(PM_OP_SUB),
                                                scene_op(op[i]), scene_k(f.s, 0.5), scene_op(PM_OP_ADD));
        scene_find(f.s, PM_FIND_VALUE, PM_NONE, 8);
        scene_vary(f.s, 0, 1, 10);
        scene_where(f.s, PM_CONDITION_ZERO, jump);
        const double param[] = {0, 0.7};
        EQUAL(scene_run(f.s, param), PM_FIND_JUMP);
        CHECK(f.s->detail[PM_DETAIL_VALUE] < 0 && f.s->detail[PM_DETAIL_BOUND] > 0);
        f.s->cell[PM_TABLE_BODY][PM_BODY_MASS] = scene_value(f.s, -1);
        EQUAL(scene_run(f.s, param), PM_BAD_VALUE);
        EQUAL(f.s->where[PM_WHERE_TABLE], PM_TABLE_BODY);
        scene_free(f.s);
    }
}

/* A condition on an answer taken at an event: the greatest height, which is not the state at the end. */
static void answers(void)
{
    throwing f = thrown_down_to(0);
    const int height = scene_ask_extreme(f.s, PM_ASK_MAX, scene_read(f.s, f.y), PM_NONE);
    scene_find(f.s, PM_FIND_VALUE, PM_NONE, 8);
    scene_vary(f.s, 0, 1, 20);
    const scene_code answer = {PM_OP_ANSWER, height};
    scene_where(f.s, PM_CONDITION_ZERO, SCENE_PROGRAM(f.s, answer, scene_k(f.s, 3), scene_op(PM_OP_SUB)));
    const double param[] = {0, 0.7}, v = sqrt(6 * G) / sin(0.7);
    EQUAL(scene_run(f.s, param), PM_OK);
    NEAR(f.s->found[0], v, 1e-9 * v);
    SCENE_ROW(f.s, PM_TABLE_TRIGGER, PM_TRIGGER_RISE, 0, SCENE_PROGRAM(f.s, answer), PM_NONE);
    EQUAL(scene_run(f.s, param), PM_BAD_TABLE); /* only a find reads answers */
    scene_free(f.s);
}

/* Each case has its own find; a case is the same alone and in a batch. */
static void batch(void)
{
    enum { CASES = 6 };
    throwing f = thrown_down_to(0);
    scene_find(f.s, PM_FIND_VALUE, PM_NONE, 16);
    scene_vary(f.s, 0, 1, 40);
    scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, 20));
    scene_ask_measure(f.s, f.time);
    scene_pack(f.s);
    double param[CASES][2], out[2][CASES], detail[CASES * PM_DETAIL_COLUMNS], audit[CASES * PM_AUDITS];
    double found[2][CASES][PM_FOUND_COLUMNS], error[CASES], margin[CASES], trust[CASES * PM_TRUSTS];
    int32_t reason[CASES], status[CASES], where[CASES * PM_WHERE_COLUMNS], stop = 0;
    int64_t progress = 0, count[CASES * PM_COUNT_COLUMNS];
    for (int i = 0; i < CASES; i++) {
        param[i][0] = i;
        param[i][1] = 0.3 + 0.2 * i;
    }
    for (int run = 0; run < 2; run++)
        EQUAL(pm_batch(f.s->ntable, f.s->table, f.s->nconstant, f.s->constant, CASES, 2, param[0], 1 + run,
                       &stop, &progress, 1, out[run], 1, reason, status, where, detail, audit, count,
                       found[run][0], error, margin, trust),
              PM_OK);
    for (int i = 0; i < CASES; i++) {
        NEAR(found[0][i][0], sqrt(20 * G / sin(2 * param[i][1])), 1e-9);
        EQUAL(found[0][i][0], found[1][i][0]);
        EQUAL(out[0][i], out[1][i]);
        EQUAL(scene_run(f.s, param[i]), PM_OK);
        EQUAL(f.s->found[0], found[0][i][0]);
        EQUAL(f.s->out[0], out[0][i]);
    }
    scene_free(f.s);
}

static void wrong_tables(void)
{
    throwing f = thrown_down_to(0);
    const double param[] = {1, 0.7};
    scene_find(f.s, PM_FIND_VALUE, PM_NONE, 16);
    EQUAL(scene_run(f.s, param), PM_BAD_TABLE); /* nothing varies */
    scene_vary(f.s, 2, 1, 10);
    scene_where(f.s, PM_CONDITION_ZERO, range_less(&f, 20));
    EQUAL(scene_run(f.s, param), PM_BAD_TABLE); /* no such parameter */
    f.s->cell[PM_TABLE_VARY][PM_VARY_PARAMETER] = 0;
    f.s->cell[PM_TABLE_FIND][PM_FIND_SAMPLES] = 1;
    EQUAL(scene_run(f.s, param), PM_BAD_TABLE);
    f.s->cell[PM_TABLE_FIND][PM_FIND_SAMPLES] = 16;
    f.s->cell[PM_TABLE_CONDITION][PM_CONDITION_KIND] = PM_CONDITION_POSITIVE;
    EQUAL(scene_run(f.s, param), PM_BAD_TABLE); /* a value needs a condition that can be met */
    scene_free(f.s);
}

int main(void)
{
    nothing_found();
    no_root();
    answers();
    batch();
    wrong_tables();
    return check_failures();
}

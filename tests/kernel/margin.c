/* What two passes say of a decision: how far apart they are, and where one ended otherwise. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "study/accuracy.h"

/* A log of one decision: a gap that is open by `gap` and touches as much as `touching` says. */
static pm_evidence_log log_of(pm_evidence_decision *x, double gap, double touching)
{
    *x = (pm_evidence_decision){.kind = PM_EVIDENCE_VALUE,
                                .trigger = PM_NONE,
                                .distance = gap,
                                .touching = touching,
                                .reach = INFINITY,
                                .unit = 1,
                                .t = 1};
    return (pm_evidence_log){.entry = x, .n = 1, .room = 1, .stride = 1};
}

static double margin_of(double gap, double touching, double other_gap, double other_touching)
{
    pm_evidence_decision x, y;
    const pm_evidence_log a = log_of(&x, gap, touching), b = log_of(&y, other_gap, other_touching);
    return pm_margin_of_logs(&a, &b, NULL).margin;
}

/* Gaps beside touching are far apart if both they and their parts of what counts as touching are. */
static void beside_touching(void)
{
    NEAR(margin_of(3e-9, 0, 4e-9, 0), 3, 1e-6);
    CHECK(margin_of(3e-9, 30, 3e-9, 1) > 1e5);  /* the same gap: nothing but rounding is between them */
    CHECK(margin_of(3e-9, 30, 1e-10, 1) > 1e5); /* the same part: a looser pass touches from farther off */
    NEAR(margin_of(3e-9, 30, 4e-9, 1), 3, 1e-6);
}

/* Signs of loads in other modes are no comparison; those of the same modes are, and so is what comes next. */
static void other_modes_tried(void)
{
    for (int same = 0; same < 2; same++) {
        pm_evidence_decision x[2], y[2];
        for (int i = 0; i < 2; i++) {
            (void)log_of(&x[i], i ? 3 : 1, 0);
            (void)log_of(&y[i], i ? 4 : -1, 0);
            x[i].instant = y[i].instant = i;
            x[i].kind = y[i].kind = PM_EVIDENCE_SIGN;
        }
        x[0].trial = 1;
        y[0].trial = same ? 1 : 2;
        const pm_evidence_log a = {.entry = x, .n = 2, .room = 2, .stride = 1},
                              b = {.entry = y, .n = 2, .room = 2, .stride = 1};
        NEAR(pm_margin_of_logs(&a, &b, NULL).margin, same ? 0.5 : 3, 1e-12);
    }
}

/* Two passes that are compared, and of which nothing else is known. */
static void compare(pm_accuracy *e, double parted)
{
    memset(e, 0, sizeof *e);
    e->main = &e->pass[0];
    e->other = &e->pass[1];
    e->closest = (pm_closest){INFINITY, NULL, PM_NONE, parted};
    e->main->tied = e->other->tied = e->main->unseen.t = e->other->unseen.t = NAN;
}

/* The run is in doubt where the pass that it is compared with could not go on. */
static void other_ended(void)
{
    pm_accuracy e;
    compare(&e, 0);
    e.main->outcome = 1;
    e.other->status = PM_BOUNCES_ON;
    e.other->where = (pm_where){PM_TABLE_CONTACT, 3, PM_NONE, 0.1, 0.2};
    e.other->t = 7;
    EQUAL(pm_margin_judge(&e, 1), 0);
    pm_margin_undecided(NULL, &e, 0);
    EQUAL(e.main->status, PM_UNDECIDED);
    EQUAL(e.main->where.table, PM_TABLE_CONTACT);
    EQUAL(e.main->where.row, 3);
    EQUAL(e.main->where.member, PM_DECISION_ENDS);
    NEAR(e.main->t, 7, 0);
}

/* Where two passes differ in what came of an instant, the answer says when that was: the last one before histories differ. */
static void decided_otherwise(void)
{
    pm_evidence_decision x[3], y[3];
    for (int i = 0; i < 3; i++) {
        (void)log_of(&x[i], 3, 0);
        (void)log_of(&y[i], 3.1, 0);
        x[i].instant = y[i].instant = i;
        x[i].t = y[i].t = 2 * i + 1;
    }
    x[2].history = 8;
    const pm_evidence_log a = {.entry = x, .n = 3, .room = 3, .stride = 1},
                          b = {.entry = y, .n = 3, .room = 3, .stride = 1};
    NEAR(pm_margin_of_logs(&a, &b, NULL).parted, 3, 0);
    y[2].history = 8;
    EQUAL(pm_margin_of_logs(&a, &b, NULL).parted, 0);
    pm_accuracy e;
    compare(&e, 3);
    pm_margin_undecided(NULL, &e, 0);
    EQUAL(e.main->where.member, PM_DECISION_OUTCOME);
    NEAR(e.main->t, 3, 0);
}

int main(void)
{
    decided_otherwise();
    beside_touching();
    other_modes_tried();
    other_ended();
    return check_failures();
}

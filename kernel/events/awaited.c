/* awaited.c - whether something waits for a further firing of an event: the end of the run, or an ask. */
#include "events/awaited.h"

#include "state/workspace.h"

int pm_awaited_nth(const pm_model *m, const pm_firing *firing, int event, int64_t more)
{
    const int64_t count = firing->count[event];
    for (int i = 0; i < m->nask; i++) {
        const int32_t *e = PM_ASK_ROW(m, i);
        if (e[PM_ASK_EVENT_INDEX] != event) continue;
        if (e[PM_ASK_KIND] == PM_ASK_EVENT && e[PM_ASK_NTH] > count && e[PM_ASK_NTH] - count <= more)
            return 1;
    }
    for (int i = 0; i < m->rows[PM_TABLE_UNTIL]; i++) {
        const int32_t *e = PM_UNTIL_ROW(m, i);
        if (e[PM_UNTIL_EVENT] == event && e[PM_UNTIL_NTH] > count && e[PM_UNTIL_NTH] - count <= more)
            return 1;
    }
    return 0;
}

int pm_awaited(const pm_model *m, const pm_firing *firing, int event, int64_t more)
{
    for (int i = 0; i < m->nask; i++) {
        const int32_t *e = PM_ASK_ROW(m, i);
        if (e[PM_ASK_EVENT_INDEX] == event && e[PM_ASK_KIND] == PM_ASK_EACH &&
            e[PM_ASK_COUNT] > firing->count[event])
            return 1;
    }
    return pm_awaited_nth(m, firing, event, more);
}

/* Elimination of rows with few entries, anywhere or near each other: each pivot is the greatest entry of its row in a column
 * that has none yet, the null vector meets the rows, and rows that depend on others are found out. */
#include "numerics/elimination.h"

#include <string.h>

#include "check.h"

#define MOST 40
#define SYSTEMS 400

typedef struct system {
    int rows, n;
    double a[MOST * MOST], f[MOST * MOST]; /* as it was, and eliminated */
    int column[MOST], scratch[6][MOST];
    pm_elimination x;
} system;

static void clear(system *s, int rows, int n)
{
    memset(s, 0, sizeof *s);
    s->rows = rows;
    s->n = n;
    s->x = (pm_elimination){.low = s->scratch[0],
                            .high = s->scratch[1],
                            .first = s->scratch[2],
                            .last = s->scratch[3],
                            .place = s->scratch[4],
                            .filled = s->scratch[5]};
}

static double eliminate(system *s)
{
    const int n = s->n;
    for (int i = 0; i < s->rows; i++) {
        const double *row = s->a + i * n;
        int *low = &s->x.low[i], *high = &s->x.high[i];
        for (*low = 0; *low < n && row[*low] == 0;) ++*low;
        for (*high = n - 1; *high >= 0 && row[*high] == 0;) --*high;
    }
    memcpy(s->f, s->a, sizeof s->f);
    return pm_elimination_run(s->rows, n, s->f, s->column, &s->x);
}

static void check_columns(const system *s)
{
    int seen[MOST] = {0};
    for (int k = 0; k < s->n; k++) {
        seen[s->column[k]]++;
        EQUAL(s->x.place[s->column[k]], k);
    }
    for (int k = 0; k < s->n; k++) EQUAL(seen[k], 1);
    for (int i = 0; i < s->rows; i++)
        for (int k = i + 1; k < s->n; k++)
            CHECK(fabs(s->f[i * s->n + s->column[k]]) <= fabs(s->f[i * s->n + s->column[i]]));
}

/* With the last column at 1 and the others without a pivot at 0. */
static void check_null(const system *s)
{
    const int n = s->n, *column = s->column;
    double x[MOST] = {0};
    x[column[n - 1]] = 1;
    for (int i = s->rows - 1; i >= 0; i--) {
        double sum = 0;
        for (int k = i + 1; k < n; k++) {
            const int c = column[k];
            if (c >= s->x.low[i] && c <= s->x.high[i]) sum -= s->f[i * n + c] * x[c];
        }
        x[column[i]] = sum / s->f[i * n + column[i]];
    }
    double size = 0;
    for (int k = 0; k < n; k++) size = fmax(size, fabs(x[k]));
    for (int i = 0; i < s->rows; i++) {
        double sum = 0;
        for (int k = 0; k < n; k++) sum += s->a[i * n + k] * x[k];
        NEAR(sum, 0, 1e-12 * size);
    }
}

static void check(system *s, double least)
{
    if (!(eliminate(s) > least)) return;
    check_columns(s);
    check_null(s);
}

/* A row that is the sum of two others, wherever it stands. */
static void check_dependent(system *s)
{
    const int n = s->n, to = (int)check_random(0, s->rows), by = (to + 1) % s->rows, and = (to + 2) % s->rows;
    for (int k = 0; k < n; k++) s->a[to * n + k] = s->a[by * n + k] + s->a[and*n + k];
    CHECK(eliminate(s) < 1e-10);
    check_columns(s);
}

/* Half of the entries are zero, all over. */
static void anywhere(int rows, int n)
{
    system s;
    clear(&s, rows, n);
    for (int i = 0; i < rows * n; i++)
        if (check_random(-1, 1) < 0.5) s.a[i] = check_random(-1, 1);
    check(&s, 1e-6);
    if (rows > 2) check_dependent(&s);
}

/* Rows of up to five entries that begin further and further on, or further and further back; two change places. */
static void chain(int rows, int n, int back)
{
    system s;
    clear(&s, rows, n);
    for (int i = 0; i < rows; i++) {
        const int from = (back ? rows - 1 - i : i) * n / rows;
        for (int k = from; k < from + 5 && k < n; k++) s.a[i * n + k] = check_random(-1, 1);
    }
    for (int k = 0; k < n; k++) {
        const double swap = s.a[k];
        s.a[k] = s.a[(rows - 1) * n + k];
        s.a[(rows - 1) * n + k] = swap;
    }
    check(&s, 1e-6);
    if (rows > 2) check_dependent(&s);
}

/* Nothing in a row: no pivot, and the others have theirs. */
static void empty(void)
{
    system s;
    clear(&s, 3, 4);
    s.a[0] = 2;
    s.a[2 * 4 + 0] = 1;
    s.a[2 * 4 + 3] = -5;
    NEAR(eliminate(&s), 0, 0);
    EQUAL(s.column[0], 0);
    EQUAL(s.column[2], 3);
    NEAR(s.f[2 * 4 + 3], -5, 0);
    clear(&s, 0, 2);
    eliminate(&s);
    EQUAL(s.column[1], 1);
}

int main(void)
{
    for (int i = 0; i < SYSTEMS; i++) {
        const int rows = 1 + i % (MOST - 3), n = rows + i % 4;
        anywhere(rows, n);
        chain(rows, n, 0);
        chain(rows, n, 1);
    }
    empty();
    return check_failures();
}

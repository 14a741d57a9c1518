"""Faults planted in `kernel/numerics/`."""

from tests.faults.fault import Fault

FAULTS = [
    Fault(
        "a secant of rounding leads to another root",
        "numerics/bracket.c",
        "PM_BRACKET_LONGER * fabs(*x - place)",
        "INFINITY",
    ),
    Fault(
        "a root is where a function that jumps is nearest to zero, and not where it jumps",
        "numerics/bracket.c",
        "return apart > PM_BRACKET_JUMPS",
        "return 0 * apart > PM_BRACKET_JUMPS",
    ),
    Fault(
        "root: Newton's method ends too soon",
        "numerics/tolerances.h",
        "#define PM_BRACKET_NOTHING 1e-16",
        "#define PM_BRACKET_NOTHING 1e-5",
    ),
    Fault(
        "root: Brent's method ends too soon",
        "numerics/tolerances.h",
        "#define PM_BRACKET_VALUES 300",
        "#define PM_BRACKET_VALUES 100",
    ),
    Fault(
        "slope: no number where nothing is beyond an end",
        "numerics/bracket.c",
        "if (!isnan(slope)) return slope;",
        "return slope;",
    ),
    Fault(
        "dense: Cholesky",
        "numerics/dense.c",
        "k = 0; k < j; k++) s -= ai[k] * aj[k]",
        "k = 0; k < j; k++) s += ai[k] * aj[k]",
    ),
    Fault(
        "dense: LU without its pivots",
        "numerics/dense.c",
        "i < n; i++) { const double swap = x[pivot[i]]",
        "i < n; i++) { const double swap = x[i]",
    ),
    Fault(
        "dense: inverse without its exchanges",
        "numerics/dense.c",
        "i < n && pivot[j] != j; i++",
        "i < 0 && pivot[j] != j; i++",
    ),
    Fault(
        "eliminate: rows that are taken off end where they did",
        "numerics/elimination.c",
        "x->high[r] = greater(x->high[r], x->high[i]);",
        "",
    ),
    Fault(
        "eliminate: rows that are taken off begin where they did",
        "numerics/elimination.c",
        "x->low[r] = lesser(x->low[r], x->low[i]);",
        "",
    ),
    Fault(
        "eliminate: later rows have entries where they had",
        "numerics/elimination.c",
        "x->last[r] = greater(x->last[r], x->high[i]);",
        "",
    ),
    Fault(
        "eliminate: any entry is a pivot",
        "numerics/elimination.c",
        "if (x->place[c] >= i && fabs(row[c]) > fabs(row[best])) best = c;",
        "if (x->place[c] >= i && row[best] == 0) best = c;",
    ),
    Fault(
        "eliminate: a row that depends on others has a pivot",
        "numerics/elimination.c",
        "least = fmin(least, pivot);",
        "least = fmin(least, pivot > 0 ? pivot : 1);",
    ),
    Fault(
        "escape: no squaring",
        "numerics/tolerances_routes.h",
        "#define PM_GROWTH_SQUARINGS 60",
        "#define PM_GROWTH_SQUARINGS 5",
    ),
    Fault(
        "nudge: a deviation that is not small",
        "numerics/tolerances_routes.h",
        "PM_PERTURBATION_SIZE 0.1",
        "PM_PERTURBATION_SIZE 1e5",
    ),
    Fault(
        "lemke: the complement of another",
        "numerics/lemke.c",
        "column = out < m ? out + m : out - m;",
        "column = out;",
    ),
    Fault("lemke: the greatest ratio leaves", "numerics/lemke.c", "return less < 0;", "return less > 0;"),
    Fault(
        "program: multipliers push the other way",
        "numerics/quadratic_program.c",
        "= -sign * x->A[r * k + i % k];",
        "= sign * x->A[r * k + i % k];",
    ),
    Fault(
        "lemke: another row begins",
        "numerics/lemke.c",
        "if (start_ratio(t, i) < start_ratio(t, least)) least = i;",
        "if (start_ratio(t, i) > start_ratio(t, least)) least = i;",
    ),
    Fault(
        "lemke: ties go by the rows",
        "numerics/lemke.c",
        "for (int n = -1; n < t->m; n++)",
        "for (int n = -1; n < 0; n++)",
    ),
    Fault(
        "lemke: what would grow leaves, too",
        "numerics/lemke.c",
        "if (*entry(t, i, column) <= PM_LEMKE_PIVOT * largest) continue; if",
        "if (fabs(*entry(t, i, column)) <= PM_LEMKE_PIVOT * largest) continue; if",
    ),
    Fault(
        "lemke: every try has the same covering vector",
        "numerics/lemke.c",
        "0.6180339887498949 * try * (i + 1)",
        "0.6180339887498949 * 0 * try * (i + 1)",
    ),
    Fault(
        "enclosure: a wave has no top",
        "numerics/interval.c",
        "if (meets(a, top) || x.hi > 1) x.hi = 1;",
        "if (x.hi > 1) x.hi = 1;",
    ),
    Fault(
        "series: derivatives of half the size",
        "numerics/chebyshev_series.c",
        "4.0 * j * c[j]",
        "2.0 * j * c[j]",
    ),
    Fault(
        "series: no bound of the bend",
        "numerics/chebyshev_series.c",
        "part.bend = about(second[0], half * x->third)",
        "part.bend = about(second[0], 0)",
    ),
    Fault(
        "series: what nodes do not resolve is resolved",
        "numerics/chebyshev_series.c",
        "x->resolved = x->high <=",
        "x->resolved = 1 || x->high <=",
    ),
    Fault(
        "waves: any bend is calm",
        "numerics/tolerances.h",
        "#define PM_WAVES_CALM 10.0",
        "#define PM_WAVES_CALM 1e4",
    ),
    Fault(
        "waves: few nodes tell them all",
        "numerics/tolerances.h",
        "#define PM_WAVES_FEW 0.01",
        "#define PM_WAVES_FEW 100.0",
    ),
]

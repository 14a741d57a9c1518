"""Sobol indices of an answer, with SALib.  Run it: python salib_sobol.py"""

import numpy as np
from SALib.analyze import sobol
from SALib.sample import sobol as sampling

import planemotion


def indices(scene, ask, bounds, n, seed=1):
    """First-order and total indices by parameter, with their 95 % errors, of n * (parameters + 2) cases.

    Cases come in groups that are compared with each other: a group with a failed case is left out.
    """
    names, ends = list(bounds), list(bounds.values())
    problem = {"num_vars": len(names), "names": names, "bounds": ends}
    cases = sampling.sample(problem, n, calc_second_order=False, seed=seed)
    answers = scene.function(names, ask)(cases).reshape(n, -1)
    whole = np.isfinite(answers).all(axis=1)
    found = sobol.analyze(problem, answers[whole].ravel(), calc_second_order=False, seed=seed)
    of_name = {name: {key: float(found[key][i]) for key in found} for i, name in enumerate(names)}
    return of_name, int(n - whole.sum())


if __name__ == "__main__":
    collar = planemotion.load("../rolling_collar.toml")
    ranges = {"d": (0.05, 0.29), "mass_ratio": (0.5, 2.0), "omega_below": (14.0, 20.0)}
    for name, index in indices(collar, "omega_above", ranges, 1024)[0].items():
        print(f"{name}: S1 {index['S1']:.3f} +- {index['S1_conf']:.3f}, ST {index['ST']:.3f}")

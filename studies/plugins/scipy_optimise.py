"""Where an answer is least, with SciPy: globally, all points of a generation at once, and then locally."""

import numpy as np
from scipy.optimize import differential_evolution, minimize

import planemotion


def least(scene, ask, bounds, seed=1):
    """Where `ask` is least within bounds: by differential evolution, and from there by the simplex method."""
    answer = scene.function(list(bounds), ask)
    limits = list(bounds.values())

    def cost(points):  # [parameters, n] of a generation, or [parameters]
        return np.nan_to_num(answer(np.transpose(points)), nan=1e300)

    options = {"vectorized": True, "updating": "deferred", "polish": False}
    found = differential_evolution(cost, limits, rng=seed, **options)
    exact = {"xatol": 1e-10, "fatol": 1e-14}
    return minimize(cost, found.x, method="Nelder-Mead", bounds=limits, options=exact)


if __name__ == "__main__":
    best = least(planemotion.load("../rolling_collar.toml"), "time_of_turn", {"d": (0.0, 0.29)})
    print(best.x, best.fun)

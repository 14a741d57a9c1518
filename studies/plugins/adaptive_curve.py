"""A curve of an answer over one parameter whose points lie where it bends, with adaptive."""

import adaptive
import numpy as np

import planemotion


def curve(scene, ask, name, bounds, loss=1e-3, at_once=16):
    """Points [n, 2] of the curve, until no interval has a greater loss; so many cases at once."""
    answer = scene.function([name], ask)
    learner = adaptive.Learner1D(None, bounds=bounds)
    while learner.loss() > loss:
        points, _ = learner.ask(at_once)
        for x, y in zip(points, answer(np.reshape(points, (-1, 1))), strict=True):
            learner.tell(x, float(np.nan_to_num(y)))
    return learner.to_numpy()


if __name__ == "__main__":
    print(curve(planemotion.load("../rolling_collar.toml"), "omega_above", "d", (0.0, 0.29)))

"""Mean, deviation and Sobol indices of an answer by a polynomial chaos expansion, with chaospy."""

import chaospy
import numpy as np

import planemotion


def expansion(scene, ask, inputs, order=4):
    """The expansion in the inputs' joint distribution, fitted at the nodes of a Gaussian quadrature."""
    joint = chaospy.J(*inputs.values())
    nodes, weights = chaospy.generate_quadrature(order, joint, rule="gaussian")
    answers = scene.function(list(inputs), ask)(nodes.T)
    if not np.isfinite(answers).all():
        raise ValueError(f"{np.isnan(answers).sum()} of {answers.size} cases have no answer; narrow inputs")
    return joint, chaospy.fit_quadrature(chaospy.generate_expansion(order, joint), nodes, weights, answers)


if __name__ == "__main__":
    collar = planemotion.load("../rolling_collar.toml")
    spread = {"d": chaospy.Uniform(0.05, 0.29), "omega_below": chaospy.Normal(17, 0.5)}
    law, fitted = expansion(collar, "omega_above", spread)
    print(chaospy.E(fitted, law), chaospy.Std(fitted, law), chaospy.Sens_m(fitted, law))

"""The files of studies/plugins with the real libraries, beside closed forms."""

from __future__ import annotations

import importlib.util
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import planemotion
from planemotion import load, load_text
from planemotion.base.arrays import Floats
from tests import STUDIES

FOLDER = STUDIES / "plugins"
LIBRARIES = {
    "salib_sobol": "SALib",
    "scipy_optimise": "scipy",
    "adaptive_curve": "adaptive",
    "chaospy_expansion": "chaospy",
    "umbridge_model": "umbridge",
}
MOST_LINES = 30
COLLAR = {"d": (0.05, 0.29), "omega_below": (14.0, 20.0)}


def plugin(name: str) -> ModuleType:
    pytest.importorskip(LIBRARIES[name])
    spec = importlib.util.spec_from_file_location(name, FOLDER / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def omega_above(d: Floats, omega: Floats, ratio: float = 1.0, r: float = 0.3) -> Floats:
    """Of studies/rolling_collar.toml: work and energy about the contact, over the mass of the hoop."""
    below, above = (2 * r**2 + ratio * (r + side * d) ** 2 for side in (-1, 1))
    return np.sqrt((below * omega**2 - 4 * ratio * 9.81 * d) / above)


def by_quadrature(function: Callable[..., Floats]) -> tuple[float, float, list[float], list[float]]:
    """Mean, variance, first-order and total Sobol indices over COLLAR, both uniform, by Gauss's rule."""
    node, weight = np.polynomial.legendre.leggauss(40)
    axes = [0.5 * (b - a) * node + 0.5 * (a + b) for a, b in COLLAR.values()]
    w = weight / 2
    y = function(*np.meshgrid(*axes, indexing="ij"))
    mean = float(w @ y @ w)
    variance = float(w @ (y - mean) ** 2 @ w)
    given = [(y @ w, w), (w @ y, w)]
    first = [float(weights @ (values - mean) ** 2) / variance for values, weights in given]
    return mean, variance, first, [1 - first[1], 1 - first[0]]


def test_every_file_is_short_and_tested() -> None:
    files = {path.stem: path.read_text() for path in FOLDER.glob("*.py")}
    assert files.keys() == LIBRARIES.keys()
    assert all(len(text.splitlines()) <= MOST_LINES for text in files.values())
    told = (FOLDER / "README.md").read_text()
    assert all(f"`{name}.py`" in told for name in files)


def test_sobol_indices_agree_with_quadrature_to_their_sampling_error() -> None:
    """From 2^14 cases: 4096 groups of 4."""
    begun = time.perf_counter()
    found, left_out = plugin("salib_sobol").indices(
        load(STUDIES / "rolling_collar.toml"), "omega_above", COLLAR, 4096
    )
    print(f"2^14 cases of the rolling collar: {time.perf_counter() - begun:.2f} s")
    assert left_out == 0
    _, _, first, total = by_quadrature(omega_above)
    for name, s1, st in zip(COLLAR, first, total, strict=True):
        index = found[name]
        assert abs(index["S1"] - s1) < 2 * index["S1_conf"] < 0.1
        assert abs(index["ST"] - st) < 2 * index["ST_conf"] < 0.1


def test_failed_cases_are_left_out() -> None:
    """Where it begins too slowly the collar does not come over: these cases have no answer."""
    found, left_out = plugin("salib_sobol").indices(
        load(STUDIES / "rolling_collar.toml"), "omega_above", {**COLLAR, "omega_below": (5.0, 20.0)}, 512
    )
    assert 20 < left_out < 500
    assert all(np.isfinite(index["S1"]) for index in found.values())


def test_optimisers_find_the_centre_of_percussion() -> None:
    rod = load_text("""
    until = "strike"
    parameters = { h = "0.5 m", e = 0.6 }
    ground.points.stop = [0, "-h"]
    bodies.rod = { rod = ["A", "B"], length = "1.2 m", mass = "3 kg", at = { A = [0, 0] } }
    joints.A = { pin = ["rod.A", "ground"] }
    contacts.stop = { touch = ["rod.bottom", "ground.stop"], restitution = "e" }
    events.strike = "stop strikes"
    start.rod.omega = "2 rad/s"
    ask.blow = { of = "(A.impulse.x on rod)^2", at = "strike" }
    """)
    best = plugin("scipy_optimise").least(rod, "blow", {"h": (0.3, 1.1)})
    assert best.x[0] == pytest.approx(0.8, abs=1e-6)


def test_an_adaptive_curve_follows_the_closed_form() -> None:
    points = plugin("adaptive_curve").curve(
        load(STUDIES / "rolling_collar.toml"), "omega_above", "d", (0.0, 0.29), loss=0.02
    )
    d, omega = np.asarray(points).T
    np.testing.assert_allclose(omega, omega_above(d, np.full_like(d, 15.0)), rtol=1e-9)
    assert len(d) < 300


def test_a_chaos_expansion_has_the_mean_and_the_indices() -> None:
    module = plugin("chaospy_expansion")
    import chaospy

    inputs = {name: chaospy.Uniform(*ends) for name, ends in COLLAR.items()}
    joint, fitted = module.expansion(load(STUDIES / "rolling_collar.toml"), "omega_above", inputs, order=6)
    mean, variance, first, _ = by_quadrature(omega_above)
    assert float(chaospy.E(fitted, joint)) == pytest.approx(mean, rel=1e-6)
    assert float(chaospy.Var(fitted, joint)) == pytest.approx(variance, rel=1e-4)
    np.testing.assert_allclose(chaospy.Sens_m(fitted, joint), first, atol=1e-4)
    with pytest.raises(ValueError, match="cases have no answer"):
        module.expansion(
            load(STUDIES / "rolling_collar.toml"), "omega_above", {"omega_below": chaospy.Uniform(2, 20)}
        )


SERVER = """
import sys, umbridge, planemotion
sys.path.insert(0, sys.argv[1])
from umbridge_model import SceneModel
collar = planemotion.load(sys.argv[2])
umbridge.serve_models([SceneModel(collar, ["d", "mass_ratio"], ["omega_above"])], int(sys.argv[3]))
"""


def test_a_model_served_over_http() -> None:
    plugin("umbridge_model")
    import umbridge

    study = STUDIES / "rolling_collar.toml"
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [sys.executable, "-c", SERVER, str(FOLDER), str(study), str(port)]
    with subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as server:
        try:
            model = reached(lambda: umbridge.HTTPModel(f"http://127.0.0.1:{port}", "planemotion"))
            assert model.get_input_sizes() == [2]
            assert model.get_output_sizes() == [1]
            assert model([[0.1, 1.0]]) == [[load(study).run(d="0.1 m")["omega_above"]]]
        finally:
            server.terminate()


def reached(connect: Callable[[], Any]) -> Any:
    """What connects as soon as the server listens."""
    for _ in range(300):
        try:
            return connect()
        except OSError:
            time.sleep(0.1)
    raise AssertionError("the server does not listen")


def test_a_function_has_the_bits_of_runs() -> None:
    scene = load(STUDIES / "rolling_collar.toml")
    function = scene.function({"d": "cm", "mass_ratio": ""}, ["omega_above", "hops"])
    assert function.units == ("cm", "")
    values = function([[10, 0.5], [29, 2.0]])
    for row, (d, ratio) in zip(values, [("10 cm", 0.5), ("29 cm", 2.0)], strict=True):
        result = scene.run(d=d, mass_ratio=ratio)
        assert row.tolist() == [result["omega_above"], result["hops"]]
    one = scene.function(["d"], "omega_above")
    assert one([0.1]) == one([[0.1]])[0] == scene.run(d="0.1 m")["omega_above"]


def test_a_case_without_an_answer_is_not_a_number() -> None:
    function = load(STUDIES / "rolling_collar.toml").function(["omega_below"], "omega_above")
    values, statuses = function.with_status([[2.0], [15.0]])
    assert np.isnan(values[0])
    assert np.isfinite(values[1])
    assert statuses[0] != "ok"
    assert statuses[1] == "ok"
    assert function(np.empty((0, 1))).shape == (0,)


@pytest.mark.parametrize(
    ("inputs", "outputs", "said"),
    [
        (["D"], "omega_above", "D"),
        (["d"], "omega", "omega"),
        ({"d": "kg"}, "omega_above", "length"),
    ],
)
def test_faults_are_told(inputs: Any, outputs: str, said: str) -> None:
    with pytest.raises(planemotion.SceneError, match=said):
        load(STUDIES / "rolling_collar.toml").function(inputs, outputs)


def test_an_array_of_another_shape() -> None:
    with pytest.raises(ValueError, match="is wanted: d"):
        load(STUDIES / "rolling_collar.toml").function(["d"], "omega_above")([[1, 2]])

"""Scenes as FMUs: what FMPy says of them, and their outputs beside the engine, at steps of any size."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planemotion import SceneError, StudyError, export_fmu, load, load_text
from planemotion.cli.main import main
from tests import ROOT
from tests.scenes import G

fmpy = pytest.importorskip("fmpy")
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="FMUs are for Linux")
BALL = """
id = "a ball"
parameters = { h = "1 m", e = 0.8, r = "3 cm" }
bodies.ball = { sphere = "r", mass = "100 g", at = [0, "h + r"] }
ground.lines.floor = { through = [0, 0] }
contacts.floor = { touch = ["ball.rim", "ground.floor"], restitution = "e" }
until = "t = 2 s"
"""


def simulated(path: Path, step: float, stop: float, **start: Any) -> Any:
    given = {"output_interval": step, "step_size": step, "stop_time": stop, "start_values": start}
    return fmpy.simulate_fmu(str(path), **given)


def height(t: np.ndarray, h: float, e: float) -> np.ndarray:
    """Of the lowest point of a ball that is let go from h: parabola after parabola, then at rest."""
    found = np.empty_like(t)
    for i, now in enumerate(t):
        begin, speed = np.sqrt(2 * h / G), np.sqrt(2 * G * h)
        if now <= begin:
            found[i] = h - G * now**2 / 2
            continue
        speed *= e
        while speed > 1e-12 and now > begin + 2 * speed / G:
            begin += 2 * speed / G
            speed *= e
        found[i] = speed * (now - begin) - G * (now - begin) ** 2 / 2 if speed > 1e-12 else 0.0
    return found


def test_fmpy_finds_no_fault(tmp_path: Path) -> None:
    for name in ("bouncing_ball", "slider_crank", "pendulum", "measured_road"):
        export_fmu(load(ROOT / f"studies/{name}.toml"), tmp_path / f"{name}.fmu")
        from fmpy.validation import validate_fmu

        assert validate_fmu(str(tmp_path / f"{name}.fmu")) == []


@pytest.mark.parametrize("step", [0.01, 0.0371, 0.3])
def test_a_bouncing_ball(tmp_path: Path, step: float) -> None:
    """Beside the closed form, at steps that meet no blow and at parameters that were set."""
    export_fmu(load_text(BALL), tmp_path / "ball.fmu", ["ball.y - r"])
    for given in ({}, {"h": 0.7, "e": 0.5, "r": 0.1}):
        found = simulated(tmp_path / "ball.fmu", step, 1.9, **given)
        expected = height(found["time"], given.get("h", 1.0), given.get("e", 0.8))
        assert len(found) > 5
        np.testing.assert_allclose(found["ball.y - r"], expected, atol=1e-9)


@pytest.mark.parametrize("step", [0.01, 0.137])
def test_a_slider_crank_has_the_bits_of_the_engine(tmp_path: Path, step: float) -> None:
    scene = load(ROOT / "studies/slider_crank.toml")
    outputs = ["crank.angle", "piston.x", "piston.velocity.x", "A.force.x", "energy.kinetic"]
    export_fmu(scene, tmp_path / "crank.fmu", outputs)
    for given, values in (({}, {}), ({"omega0": 25.0}, {"omega0": "25 rad/s"})):
        found = simulated(tmp_path / "crank.fmu", step, 20 * step, **given)
        history = scene.with_values(values).history(*outputs, every=f"{step} s")
        rows = np.searchsorted(history["t"].values, found["time"] + 1e-9, side="right") - 1
        assert len(found) == 21
        np.testing.assert_allclose(found["time"], history["t"][rows], rtol=1e-12, atol=1e-12)
        for name in outputs:
            np.testing.assert_array_equal(found[name], history[name][rows])


def test_steps_of_changing_size(tmp_path: Path) -> None:
    """A master that takes other steps each time; two instances beside each other."""
    from fmpy.fmi2 import FMU2Slave

    export_fmu(load_text(BALL), tmp_path / "ball.fmu", ["ball.y - r"])
    described = fmpy.read_model_description(str(tmp_path / "ball.fmu"))
    folder = fmpy.extract(str(tmp_path / "ball.fmu"), str(tmp_path / "with a space"))
    (output,) = [one.valueReference for one in described.modelVariables if one.causality == "output"]
    slaves = []
    for name in ("one", "other"):
        slave = FMU2Slave(
            guid=described.guid,
            unzipDirectory=folder,
            modelIdentifier=described.coSimulation.modelIdentifier,
            instanceName=name,
        )
        slave.instantiate()
        slave.setupExperiment(startTime=5.0)
        slave.enterInitializationMode()
        slaves.append(slave)
    (restitution,) = [one.valueReference for one in described.modelVariables if one.name == "e"]
    slaves[1].setReal([restitution], [0.3])
    random = np.random.default_rng(3)
    for slave in slaves:
        slave.exitInitializationMode()
    t = 0.0
    for step in random.uniform(1e-3, 0.2, 15):
        for slave, e in zip(slaves, (0.8, 0.3), strict=True):
            slave.doStep(currentCommunicationPoint=5.0 + t, communicationStepSize=step)
            expected = height(np.array([t + step]), 1.0, e)[0]
            assert slave.getReal([output])[0] == pytest.approx(expected, abs=1e-8)
        t += step
    slaves[0].reset()
    slaves[0].setupExperiment(startTime=0.0)
    slaves[0].enterInitializationMode()
    slaves[0].exitInitializationMode()
    assert slaves[0].getReal([output]) == pytest.approx([1.0])
    for slave in slaves:
        slave.terminate()
        slave.freeInstance()


def test_the_simulation_ends_with_the_run(tmp_path: Path) -> None:
    text = BALL.replace('"t = 2 s"', '"ball.y = (0.5 m)"')
    export_fmu(load_text(text), tmp_path / "ball.fmu", ["ball.y"])
    found = simulated(tmp_path / "ball.fmu", 0.1, 5.0)
    assert found["time"][-1] == pytest.approx(np.sqrt(2 * 0.53 / G), rel=1e-9)
    assert found["ball.y"][-1] == pytest.approx(0.5, rel=1e-9)
    described = fmpy.read_model_description(str(tmp_path / "ball.fmu"))
    assert float(described.defaultExperiment.stopTime) == pytest.approx(found["time"][-1], rel=1e-12)


def test_a_run_that_fails_says_so(tmp_path: Path) -> None:
    """A ball that begins below the floor."""
    export_fmu(load_text(BALL), tmp_path / "ball.fmu", ["ball.y"])
    told: list[str] = []
    with pytest.raises(Exception, match="failed"):
        fmpy.simulate_fmu(
            str(tmp_path / "ball.fmu"),
            start_values={"h": -0.5},
            logger=lambda _environment, _name, _status, _category, text: told.append(text.decode()),
        )
    assert any("the run failed at t = 0 s: " in text for text in told)


def test_it_needs_nothing_of_planemotion(tmp_path: Path) -> None:
    """Its libraries come with it, and are those that it takes; a wheel has them in a folder of its own."""
    export_fmu(load_text(BALL), tmp_path / "ball.fmu")
    with zipfile.ZipFile(tmp_path / "ball.fmu") as fmu:
        names = [name.rpartition("/")[2] for name in fmu.namelist() if name.startswith("binaries/")]
        fmu.extractall(tmp_path / "fmu")
    binaries = tmp_path / "fmu/binaries"
    library = binaries / "linux64/a_ball.so"
    assert len(names) > 1
    environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
    told = subprocess.run(["ldd", library], capture_output=True, text=True, check=True, env=environment)
    for line in told.stdout.splitlines():
        name = line.split()[0]
        assert (name in names) == (str(binaries) in line)


def test_all_units_are_of_si(tmp_path: Path) -> None:
    scene = load(ROOT / "studies/slider_crank.toml")
    made = export_fmu(scene, tmp_path / "crank.fmu", ["A.force.x", "crank.omega"])
    described = fmpy.read_model_description(str(tmp_path / "crank.fmu"))
    units = {one.name: one.unit for one in described.modelVariables}
    assert units["a"] == "m"
    assert units["omega0"] == "rad/s"
    assert units["A.force.x"] == "N"
    assert made.outputs == ("A.force.x", "crank.omega")
    (newton,) = [unit.baseUnit for unit in described.unitDefinitions if unit.name == "N"]
    assert (newton.kg, newton.m, newton.s) == (1, 1, -2)


def test_what_cannot_be_exported(tmp_path: Path) -> None:
    with pytest.raises(StudyError, match=r"an FMU has the ending \.fmu"):
        export_fmu(load_text(BALL), tmp_path / "ball.zip")
    with pytest.raises(SceneError, match="find: an FMU computes one run"):
        export_fmu(load(ROOT / "studies/widest_spacing.toml"), tmp_path / "ball.fmu")
    with pytest.raises(SceneError, match="bal"):
        export_fmu(load_text(BALL), tmp_path / "ball.fmu", ["bal.y"])
    assert list(tmp_path.iterdir()) == []


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "ball.fmu"
    study = str(ROOT / "studies/bouncing_ball.toml")
    with pytest.raises(SystemExit) as ended:
        main(["export-fmu", study, "--out", str(out), "--quantity", "ball.y"])
    assert not ended.value.code
    assert "ball.fmu: 4 parameters, 1 outputs" in capsys.readouterr().err

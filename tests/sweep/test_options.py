"""Sweeps over options by their key path: laws, kinds of friction, whether an element is there, routes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.text import Text

import planemotion as pm
from planemotion.pictures.sweep import plot_sweep
from planemotion.sweep.verify import verify
from planemotion.webpage.outcomes import case_values

# A spinning ball that bounces: its spin after the blow tells the friction, its height the law.
BALL = """
until = "hit 2"
[parameters]
e = 0.5
[ground.lines]
floor = { through = [0, 0], angle = 0 }
[bodies.ball]
disk = "0.1 m"
mass = "1 kg"
at = [0, "1 m"]
[contacts.floor]
touch = ["ball.rim", "ground.floor"]
restitution = "e"
friction = 0.1
[forces.wind]
force = "ball"
value = ["2 N", 0]
[start]
ball.omega = "10 rad/s"
[events]
hit = "floor strikes"
[ask]
w = "ball.omega"
x = "ball.x"
[sweep]
"""


def swept(more: str) -> Any:
    return pm.load_text(BALL + more).sweep()


def test_laws_and_friction_are_categories_with_the_bits_of_their_runs() -> None:
    laws, frictions = ("newton", "poisson", "stronge"), ("smooth", "0.1", "rough")
    made = swept(
        '"contacts.floor.law" = ["newton", "poisson", "stronge"]\n'
        '"contacts.floor.friction" = ["smooth", 0.1, "rough"]\ne = [0.4, 0.6]\n'
    )
    assert made["w"].dims == ("contacts.floor.law", "contacts.floor.friction", "e")
    assert made["contacts.floor.law"].values.tolist() == list(laws)
    assert made["contacts.floor.friction"].values.tolist() == list(frictions)
    scene = pm.load_text(BALL)
    for i, law in enumerate(laws):
        for j, friction in enumerate(frictions):
            own = {"contacts.floor.law": law, "contacts.floor.friction": friction, "e": 0.6}
            assert float(made["w"][i, j, 1]) == scene.with_values(own).run()["w"]
    assert float(made["w"][0, 0, 0]) == pytest.approx(10, abs=1e-12)  # smooth keeps the spin
    assert float(made["w"][0, 2, 0]) != pytest.approx(10, abs=1)  # rough does not


def test_an_element_is_there_or_not() -> None:
    made = swept('"forces.wind.active" = [true, false]\n')
    fall = np.sqrt(2 * 0.9 / 9.81)
    flight = fall + 2 * 0.5 * 9.81 * fall / 9.81
    assert made["forces.wind.active"].values.tolist() == ["true", "false"]
    calm = pm.load_text(BALL.replace("friction = 0.1", 'friction = "smooth"'))
    blown = calm.with_values({"forces.wind.active": "true"}).run()
    assert blown["x"] == pytest.approx(flight**2, abs=1e-10)  # a = 2 N / 1 kg
    assert calm.with_values({"forces.wind.active": "false"}).run()["x"] == pytest.approx(0, abs=1e-12)
    assert float(made["x"][0]) - float(made["x"][1]) > 0.5


def test_settings_can_be_swept() -> None:
    made = swept('"solve.route" = ["rk", "ida"]\n')
    assert len(set(made["route"].values.tolist())) == 2
    assert float(made["x"][0]) == pytest.approx(float(made["x"][1]), abs=1e-7)


def test_files_tables_and_pictures_have_the_words(tmp_path: Path) -> None:
    import xarray as xr

    text = BALL + '"contacts.floor.friction" = ["smooth", "rough"]\ne = [0.4, 0.5, 0.6]\n'
    scene = pm.load_text(text)
    scene.sweep(out=tmp_path)
    (result,) = tmp_path.glob("*.h5")
    table = next(tmp_path.glob("*.csv")).read_text().splitlines()
    assert table[0].startswith("contacts.floor.friction,e [1],w [rad/s]")
    assert table[1].startswith("smooth,0.4,")
    assert table[4].startswith("rough,0.4,")
    assert all(not one.faults for one in verify(tmp_path))
    with xr.open_dataset(result, engine="h5netcdf") as made:
        assert made["w"].equals(scene.sweep()["w"])
        assert case_values(made, {"contacts.floor.friction": 1, "e": 0}) == {
            "contacts.floor.friction": "rough",
            "e": "0.4",
        }
        figure = plot_sweep(made)
        told = [text.get_text() for text in figure.findobj(Text) if isinstance(text, Text)]
        assert "contacts.floor.friction = rough" in told
        alone = plot_sweep(made.isel(e=[0]))
        ticks = [tick.get_text() for tick in alone.axes[-1].get_xticklabels()]
        assert ticks == ["smooth", "rough"]


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ('"contacts.flor.law" = ["newton"]', 'unknown entry of contacts "flor"; there is floor'),
        ('"contacts.floor.law" = ["newton", "poison"]', 'unknown impact law "poison"'),
        ('"contacts.floor.law" = ["newton", "newton"]', "it is there twice"),
        ('"contacts.floor.law" = []', "an empty sweep"),
        ('"contacts.floor.friction" = { from = 0, to = 1, num = 3 }', "a list of what the option may be"),
        ('law = ["newton"]', 'or an option such as "contacts.floor.law"'),
    ],
)  # fmt: skip
def test_faults_of_options(more: str, told: str) -> None:
    with pytest.raises(pm.SceneError) as found:
        swept(more + "\n")
    assert told in str(found.value)

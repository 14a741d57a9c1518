"""Cases that a design draws: their distributions, that they are the same again, and their results."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from planemotion import SceneError, load_text
from planemotion.pictures.panels import open_sweep
from planemotion.pictures.sweep import plot_sweep
from planemotion.reporting import report_of
from tests.scenes import G

FALL = """
id = "fall"
parameters = {{ h = "1 m", v = "0 m/s", m = "1 kg" }}
bodies.ball = {{ mass = "m", at = [0, "h"] }}
start.ball.velocity.x = "v"
until = "ball.y = 0 m"
ask.T = "t"
ask.x = "ball.x"
ask.E = "energy.kinetic"
[sweep]
{sweep}
"""


def drawn(sweep: str, name: str = "h") -> np.ndarray:
    dataset = load_text(FALL.format(sweep=sweep)).sweep()
    assert dataset["status"].dims[0] == "case"
    assert (dataset["status"] == 0).all()
    return np.asarray(dataset[name].values)


@pytest.mark.parametrize(
    ("written", "law"),
    [
        ('{ uniform = ["1 m", "3 m"] }', stats.uniform(1, 2)),
        ('{ normal = ["10 m", "0.5 m"] }', stats.norm(10, 0.5)),
        ('{ lognormal = ["2 m", 0.3] }', stats.lognorm(0.3, scale=2)),
        ('{ triangular = ["1 m", "1.5 m", "4 m"] }', stats.triang(0.5 / 3, 1, 3)),
    ],
)
@pytest.mark.parametrize("design", ["latin", "sobol", "halton", "random"])
def test_distributions(written: str, law: stats.rv_frozen, design: str) -> None:
    """By the test of Kolmogorov and Smirnov; what is spread evenly is nearer to its law than random."""
    values = drawn(f"design = {{ {design} = 512, seed = 4 }}\nh = {written}")
    distance = stats.kstest(values, law.cdf).statistic
    assert distance < (0.06 if design == "random" else 0.01)


def test_a_latin_hypercube_has_one_in_each_part() -> None:
    values = drawn(
        'design = { latin = 100 }\nh = { uniform = ["1 m", "2 m"] }\nv = { uniform = [0, "1 m/s"] }'
    )
    assert sorted(np.floor(100 * (values - 1))) == list(range(100))


def test_within_cuts_off_what_lies_outside() -> None:
    values = drawn('design = { sobol = 256 }\nh = { normal = ["1 m", "1 m"], within = ["50 cm", "3 m"] }')
    assert values.min() >= 0.5
    assert values.max() <= 3
    law = stats.truncnorm(-0.5, 2, 1, 1)
    assert stats.kstest(values, law.cdf).statistic < 0.01


def test_the_same_seed_draws_the_same_whatever_the_workers() -> None:
    text = FALL.format(sweep='design = { latin = 50, seed = 7 }\nh = { uniform = ["1 m", "2 m"] }')
    one, two = (load_text(text).sweep(workers=n) for n in (1, 2))
    assert one.drop_attrs().equals(two.drop_attrs())
    other = load_text(text.replace("seed = 7", "seed = 8")).sweep()
    assert not np.array_equal(one["h"], other["h"])


def test_a_design_beside_a_grid() -> None:
    sweep = """
    design = { sobol = 64 }
    h = { uniform = ["1 m", "2 m"] }
    m = ["1 kg", "2 kg", "3 kg"]
    v = { uniform = ["1 m/s", "2 m/s"] }
    """
    dataset = load_text(FALL.format(sweep=sweep)).sweep()
    assert dict(dataset["T"].sizes) == {"case": 64, "m": 3}
    assert dataset["h"].dims == dataset["v"].dims == ("case",)
    h, v, m = dataset["h"], dataset["v"], dataset["m"]
    np.testing.assert_allclose(dataset["x"], (v * np.sqrt(2 * h / G)).broadcast_like(dataset["x"]), rtol=1e-9)
    np.testing.assert_allclose(
        dataset["E"], (0.5 * m * v**2 + m * G * h).transpose(*dataset["E"].dims), rtol=1e-9
    )
    frame = dataset[["T", "x", "E"]].to_dataframe()
    assert len(frame) == 64 * 3  # one row per case, with what was drawn
    assert {"h", "v"} <= set(frame.columns)


def test_a_mean_over_a_sobol_sequence() -> None:
    dataset = load_text(
        FALL.format(
            sweep="""
            design = { sobol = 1024 }
            h = { uniform = ["1 m", "4 m"] }
            v = { normal = ["3 m/s", "1 m/s"] }
            """
        )
    ).sweep()
    mean_time = math.sqrt(2 / G) * (2 / 3) * (8 - 1) / 3
    assert float(dataset["x"].mean()) == pytest.approx(3 * mean_time, rel=1e-3)


def test_files_pictures_and_reports(tmp_path: Path) -> None:
    sweep = """
    design = { latin = 30 }
    h = { uniform = ["1 m", "2 m"] }
    m = { from = "1 kg", to = "2 kg", num = 20 }
    """
    scene = load_text(FALL.format(sweep=sweep))
    scene.sweep(out=tmp_path)
    header = (tmp_path / "fall.csv").read_text(encoding="utf-8").splitlines()[0]
    assert header.startswith("h [m],m [kg],T [s],")
    with open_sweep(tmp_path / "fall.h5") as dataset:
        dots = plot_sweep(dataset).axes[1].get_lines()[0]
    assert dots.get_linestyle() == "None"  # nothing follows another
    assert np.size(dots.get_xdata()) == 30  # the masses are held: there is no map
    assert report_of(tmp_path / "fall.h5", {}, replays=2).html.count("markers") >= 3


@pytest.mark.parametrize(
    ("sweep", "told"),
    [
        ('h = { uniform = ["1 m", "2 m"] }', "sweep.h: a distribution needs a design"),
        ('design = { latin = 5 }\nh = ["1 m"]', "sweep.design: no parameter has a distribution"),
        ('design = { latin = 5, sobol = 8 }\nh = { uniform = [0, "2 m"] }', "not latin and sobol"),
        (
            'design = { seed = 5 }\nh = { uniform = [0, "2 m"] }',
            "one of latin, sobol, halton, random is wanted",
        ),
        ('design = { sobol = 100 }\nh = { uniform = [0, "2 m"] }', "even at powers of 2"),
        ('design = { latin = 0 }\nh = { uniform = [0, "2 m"] }', "sweep.design.latin = 0"),
        ('design = { lattin = 9 }\nh = { uniform = [0, "2 m"] }', 'did you mean "latin"?'),
        ('design = { latin = 9 }\nh = { uniform = ["2 m", "1 m"] }', "the first end must be less"),
        ('design = { latin = 9 }\nh = { uniform = ["2 m", "1 s"] }', "a time"),
        ('design = { latin = 9 }\nh = { uniform = ["2 s", "3 s"] }', "the parameter is a length"),
        ('design = { latin = 9 }\nh = { normal = ["2 m"] }', "normal = [mean, standard deviation] is wanted"),
        ('design = { latin = 9 }\nh = { normal = ["2 m", "0 m"] }', "the spread must be greater than 0"),
        ('design = { latin = 9 }\nh = { lognormal = ["2 m", "1 m"] }', "a number without a unit"),
        ('design = { latin = 9 }\nh = { lognormal = ["-2 m", 1] }', "greater than 0"),
        ('design = { latin = 9 }\nh = { triangular = ["1 m", "3 m", "2 m"] }', "between the ends"),
        ('design = { latin = 9 }\nh = { uniform = ["1 m", "2 m"], num = 3 }', "num: unknown key"),
        (
            'design = { latin = 9 }\nh = { normal = ["1 m", "1 mm"], within = ["2 m", "3 m"] }',
            "nothing between",
        ),
        (
            'design = { latin = 2 }\nzip = [["h", "m"]]\nh = { uniform = [0, "2 m"] }\nm = ["1 kg", "2 kg"]',
            "what is drawn moves together",
        ),
    ],
)
def test_messages(sweep: str, told: str) -> None:
    with pytest.raises(SceneError) as caught:
        load_text(FALL.format(sweep=sweep)).sweep()
    assert told in str(caught.value)


@pytest.mark.parametrize("design", ["latin", "sobol", "random"])
def test_correlated_parameters(design: str) -> None:
    """Normal scores have the correlation that is given, and each parameter the distribution that it had."""
    dataset = load_text(
        FALL.format(
            sweep=f"""
            design = {{ {design} = 4096, seed = 3, correlation = [["h", "v", 0.7], ["v", "m", -0.4]] }}
            h = {{ uniform = ["1 m", "3 m"] }}
            v = {{ lognormal = ["2 m/s", 0.3] }}
            m = {{ normal = ["10 kg", "1 kg"] }}
            """
        )
    ).sweep()
    laws = {"h": stats.uniform(1, 2), "v": stats.lognorm(0.3, scale=2), "m": stats.norm(10, 1)}
    scores = np.array([stats.norm.ppf(law.cdf(dataset[name].values)) for name, law in laws.items()])
    wanted = [[1, 0.7, 0], [0.7, 1, -0.4], [0, -0.4, 1]]
    np.testing.assert_allclose(np.corrcoef(scores), wanted, atol=0.04)
    for name, law in laws.items():
        assert stats.kstest(dataset[name].values, law.cdf).statistic < 0.03


@pytest.mark.parametrize(
    ("correlation", "said"),
    [
        ('[["h", "v", 1.0]]', "between -1 and 1"),
        ('[["h", "g", 0.5]]', "has no distribution"),
        ('[["h", "h", 0.5]]', "one pair of two parameters"),
        ('[["h", "v", 0.5], ["v", "h", 0.5]]', "one pair of two parameters"),
        ('[["h", "v", 0.9], ["v", "m", 0.9], ["h", "m", -0.9]]', "eigenvalue"),
        ('["h", "v", 0.5]', "pairs with their correlation"),
    ],
)
def test_correlations_that_cannot_be(correlation: str, said: str) -> None:
    sweep = f"""
    design = {{ latin = 8, correlation = {correlation} }}
    h = {{ uniform = ["1 m", "3 m"] }}
    v = {{ uniform = ["1 m/s", "3 m/s"] }}
    m = {{ uniform = ["1 kg", "3 kg"] }}
    """
    with pytest.raises(SceneError) as raised:
        load_text(FALL.format(sweep=sweep)).sweep()
    assert said in str(raised.value)

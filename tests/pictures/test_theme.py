"""Pictures on dark paper: every colour has its counterpart there, and nothing stays on white."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import planemotion
from planemotion.base.errors import StudyError
from planemotion.base.themes import THEMES
from planemotion.pen import theme
from planemotion.pictures.plots import plot

PACKAGE = Path(planemotion.__file__).parent
STUDIES = Path(__file__).parents[2] / "studies"


def _contrast(first: str, second: str) -> float:
    """The ratio of luminances as WCAG 2.1 defines it."""
    light, dark = sorted((_luminance(first), _luminance(second)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(colour: str) -> float:
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return float(np.dot(linear, (0.2126, 0.7152, 0.0722)))


def test_every_colour_of_the_house_has_a_counterpart_as_strong() -> None:
    texts = [
        path.read_text() for room in ("pen", "pictures", "kinds") for path in (PACKAGE / room).rglob("*.py")
    ]
    used = {found for text in texts for found in re.findall(r"#[0-9a-f]{6}", text)} - set(
        theme._DARK.values()
    )
    assert used <= set(theme._DARK)
    for light, dark in theme._DARK.items():
        if _contrast(light, "#ffffff") > 4.5:
            assert _contrast(dark, theme._DARK["#ffffff"]) > 4.5, light


@pytest.mark.parametrize("figure", [None, "free-body", "impulse-momentum", "energy"])
def test_nothing_white_stays(figure: str | None, tmp_path: Path) -> None:
    scene = planemotion.load(PACKAGE / "examples" / "pendulum.toml")
    light, dark = (_pixels(scene.draw(as_=figure, theme=one).save(tmp_path / "a.png")) for one in THEMES)
    assert np.mean(light) > 0.85
    assert np.mean(dark) < 0.25
    assert np.mean(np.all(dark > 0.93, axis=2)) < 1e-3


def test_of_a_sweep_and_what_is_refused(tmp_path: Path) -> None:
    scene = planemotion.load(STUDIES / "rolling_collar.toml")
    scene.sweep(out=tmp_path).close()
    (result,) = tmp_path.glob("*.h5")
    assert np.mean(_pixels(plot(result, tmp_path / "b.png", "dark"))) < 0.4
    with pytest.raises(StudyError, match='theme = "blue": light or dark is wanted'):
        scene.draw(theme="blue")
    with pytest.raises(StudyError, match='theme = "blue": light or dark is wanted'):
        plot(result, theme="blue")


def _pixels(path: Path) -> np.ndarray:
    from matplotlib.image import imread

    return np.asarray(imread(path))[..., :3]

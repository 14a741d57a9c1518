"""A body named alone in a contact touches with its shape, or is told why it cannot."""

from __future__ import annotations

import numpy as np
import pytest

from planemotion import SceneError, load_text

THROWN = """\
until = "rest"
ground.lines.floor = { through = [0, 0] }
bodies.b = { SHAPE, mass = "10 kg", at = [0, "1 m"], angle = "TILT deg" }
start.b = { velocity = ["3 m/s", 0], omega = "-1 rad/s" }
contacts.floor = { touch = TOUCH, friction = 0.4, restitution = 0.3 }
ask = { x = "b.x", y = "b.y", turned = "b.turned", t = "t" }
"""
SHAPES = {
    "plate": ('plate = ["0.6 m", "0.4 m"], corners = ["P", "Q", "R", "S"]', "b.corners"),
    "plate without names": ('plate = ["0.6 m", "0.4 m"]', "b.corners"),
    "rod": ('rod = ["A", "B"], length = "0.5 m"', "b.ends"),
    "disk": ('disk = "0.3 m"', "b.rim"),
}


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("shape", SHAPES)
def test_a_body_alone_touches_the_floor_with_its_shape(shape: str, swapped: bool) -> None:
    """It touched as its mass centre, which never came to rest."""
    written, marks = SHAPES[shape]
    tilt = round(np.random.default_rng(len(shape)).uniform(0, 90), 3)
    text = THROWN.replace("SHAPE", written).replace("TILT", f"{tilt}")
    if shape == "disk":  # it rolls on
        text = text.replace('"rest"', '"t = 2 s"')

    def thrown(mark: str) -> dict[str, object]:
        pair = ["ground.floor", mark] if swapped else [mark, "ground.floor"]
        result = load_text(text.replace("TOUCH", str(pair))).run()
        assert result.ok
        return {name: result[name] for name in result}

    alone = thrown("b")
    assert alone == thrown(marks)
    if shape != "disk":
        half = {"rod": (0.25, 0.0)}.get(shape, (0.3, 0.2))
        turned = np.radians(tilt) + float(str(alone["turned"]))
        height = abs(half[0] * np.sin(turned)) + abs(half[1] * np.cos(turned))
        assert alone["y"] == pytest.approx(height, abs=1e-9)


@pytest.mark.parametrize(
    ("bodies", "touch", "told"),
    [
        (
            'b = { rod = ["A", "B"], length = "1 m", mass = "2 kg" }',
            '["b", "ground.peg"]',
            'touch[0] = "b": the body alone touches only an endless line: did you mean b.top or b.bottom?',
        ),
        (
            'b = { plate = ["1 m", "1 m"], mass = "2 kg" }\nd = { disk = "1 m", mass = "2 kg" }',
            '["d", "b"]',
            'touch[1] = "b": the body alone touches only an endless line: '
            "did you mean b.bottom or b.right or b.top or b.left?",
        ),
        (
            'b = { half_ring = "1 m", mass = "2 kg" }',
            '["b", "ground.floor"]',
            'touch[0] = "b": the body alone does not say what touches: did you mean b.rim?',
        ),
    ],
)
def test_a_body_alone_is_told_where_its_shape_leaves_open_what_touches(
    bodies: str, touch: str, told: str
) -> None:
    scene = load_text(f"""
        until = "t = 1 s"
        ground.points.peg = [0, "-1 m"]
        ground.lines.floor = {{ through = [0, "-2 m"] }}
        [bodies]
        {bodies}
        [contacts]
        c = {{ touch = {touch} }}
    """)
    with pytest.raises(SceneError) as caught:
        scene.run()
    assert told in str(caught.value)

"""What is repeated, and parts: names, bounds, and faults with the file and line in which they stand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import planemotion as pm

# ruff: noqa: E501 - faults beside what is told of them

LINKS = """
until = "t = 0.1 s"
parameters.n = 3
[bodies."link[i]"]
for = "{range}"
rod = ["A", "B"]
length = "{length}"
mass = "1 kg"
[joints."pin[i]"]
for = "i in 2..n"
pin = ["link[i-1].B", "{other}"]
[joints.root]
pin = ["link[1].A", "ground"]
[ask]
x = "{ask}"
"""


def links(
    *,
    range: str = "i in 1..n",
    length: str = "1 m",
    other: str = "link[i].A",
    ask: str = "link[n].x",
    more: str = "",
) -> str:
    return LINKS.format(range=range, length=length, other=other, ask=ask) + more


def fault(text: str) -> str:
    with pytest.raises(pm.SceneError) as found:
        pm.load_text(text).run()
    return str(found.value)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"range": "i = 1..n"}, 'line 5: bodies.link[i].for = "i = 1..n": an index and its range are wanted'),
        ({"range": "m in 1..n"}, "m is a unit; choose another letter"),
        ({"range": "n in 1..3"}, "n is a parameter; choose another letter"),
        ({"range": "t in 1..3"}, "t has a meaning of its own"),
        ({"range": "i in 1..k"}, 'the range of i: "k" is neither an index nor a parameter'),
        ({"range": "i in 1..n/2"}, "the range of i: n/2 is 1.5; a whole number is wanted"),
        ({"range": "i in 1..200000"}, "bodies.link[i].for: more than 100000 parts"),
        ({"length": "1 kg"}, 'line 7: bodies.link[1].length = "1 kg": a length (such as m) is wanted; this is a mass'),
        ({"length": "j*(1 m)"}, 'unknown parameter "j"'),
        ({"other": "link[i+1].A"}, 'line 11: joints.pin[3].pin[1] = "link[4].A": unknown body "link[4]"'),
        ({"other": "link[j].A"}, 'the index in link[j].A: "j" is neither an index nor a parameter; for = "j in 1..n" makes one'),
        ({"other": "link[i].C"}, "link[2]"),
        ({"ask": "link[n+1].x"}, 'line 15: ask.x = "link[4].x"'),
        ({"more": '[bodies."link[2]"]\nmass = "1 kg"\nat = [0, 0]\n'}, 'bodies.link[2]: "link[2]" is given twice'),
        ({"more": '[bodies.ball]\nfor = "i in 1..2"\nmass = "1 kg"\n'}, 'bodies.ball: the name needs the index, such as "ball[i]"'),
        ({"more": "[runs.long]\nn = 4\n"}, "runs.long.n: n says what there is in the scene; a sweep or --set can change it"),
        ({"more": '[find]\nvary.n = [1, 3]\nwhere = "x > 0"\n'}, "find.vary.n: n says what there is"),
        ({"more": "[sweep]\nn = { uniform = [1, 3] }\ndesign.latin = 3\n"}, "sweep.n: n says what there is"),
        ({"more": "[sweep]\nn = [1, 1.5]\n"}, ""),
    ],
)  # fmt: skip
def test_faults_of_what_is_repeated(given: dict[str, str], told: str) -> None:
    text = links(**given)
    if told:
        assert told in fault(text)
    else:
        with pytest.raises(pm.SceneError, match=r"the range of i: n is 1\.5; a whole number is wanted"):
            pm.load_text(text).sweep()


def test_a_fault_of_all_is_told_once() -> None:
    assert fault(links(length="1 kg")).count("a length (such as m) is wanted") == 1


def test_names_of_two_indices_and_repeated_values() -> None:
    scene = pm.load_text("""
until = "t = 0 s"
plane = "horizontal"
[parameters]
d = "0.5 m"
"k[i]" = { for = "i in 1..2", value = "i*(2 N/m)" }
[ground.points]
"post[i]" = { for = "i in 0..2", value = ["i*d", "1 m"] }
[bodies."ball[i,j]"]
for = ["i in 1..3", "j in 1..i"]
mass = "i*(1 kg)"
at = ["i*d", "j*d"]
[forces."spring[i]"]
for = "i in 1..2"
spring = ["ball[i,1]", "ground.post[i-1]"]
stiffness = "k[i]"
free_length = 0
[ask]
far = "ball[3,3].y - ball[2,1].y"
force = "spring[2].force.norm"
heavy = "ball[3,2].mass"
pull = { of = "spring[1].stretch", unit = "cm" }
""")
    found = scene.run()
    assert found.far == pytest.approx(1.0, abs=1e-14)
    assert found.heavy == 3
    assert found.force == pytest.approx(4 * 2**0.5 / 2, abs=1e-12)
    assert found.pull == pytest.approx(100 * 0.5**0.5, abs=1e-10)
    assert list(scene.data.bodies) == [
        "ball[1,1]",
        "ball[2,1]",
        "ball[2,2]",
        "ball[3,1]",
        "ball[3,2]",
        "ball[3,3]",
    ]


WHEEL = """
until = "t = 1 s"
[parameters]
r = "0.3 m"
x = "0 m"
[ground.points]
O = ["x", "r"]
[bodies.disk]
disk = "r"
mass = "2 kg"
[joints.O]
pin = ["disk.center", "ground.O"]
[forces.push]
couple = "disk"
value = "1 N*m"
[ask]
w = { of = "disk.omega", unit = "rpm" }
"""
CAR = """
until = "t = 0.5 s"
parameters.base = "2 m"
[parts.front]
use = "wheel.toml"
[parts.rear]
use = "{use}"
with = {with_}
[ask]
apart = "front.disk.x - rear.disk.x"
"""


def car(folder: Path, *, use: str = "wheel.toml", with_: str = '{ x = "-base" }', wheel: str = WHEEL) -> Path:
    (folder / "wheel.toml").write_text(wheel)
    (folder / "car.toml").write_text(CAR.format(use=use, with_=with_))
    return folder / "car.toml"


def test_a_file_is_a_part(tmp_path: Path) -> None:
    scene = pm.load(car(tmp_path))
    found: Any = scene.run()
    assert found.apart == pytest.approx(2.0, abs=1e-14)
    assert found["front.w"] == pytest.approx(0.5 / 0.09 * 30 / 3.141592653589793, rel=1e-12)
    found = scene.with_values({"rear.r": "0.6 m"}).run()
    assert found["rear.w"] == pytest.approx(found["front.w"] / 4, rel=1e-12)
    swept = scene.sweep(grids={"rear.r": ["0.3 m", "0.6 m"]})
    assert swept["rear.w"].values[1] == found["rear.w"]
    assert list(scene.history("rear.disk.omega", every="0.1 s")) == ["rear.disk.omega"]
    again = pm.load_text(scene.whole_text).run()  # without the file of the wheel
    assert again["front.w"] == found["front.w"]


def test_the_builder_makes_the_same(tmp_path: Path) -> None:
    wheel = pm.load_text(WHEEL)
    made = pm.Scene("car", until="t = 0.5 s").parameters(base="2 m").template("wheel", wheel)
    made.part("front", use="wheel").part("rear", use="wheel", with_={"x": "-base"})
    made.body("ball[i]", for_="i in 1..2", mass="1 kg", at=["i*base", "5 m"])
    made.ask("apart", of="front.disk.x - rear.disk.x").ask("between", of="ball[2].x - ball[1].x")
    found = made.run()
    assert found["front.w"] == pm.load(car(tmp_path)).run()["front.w"]
    assert found.between == pytest.approx(2.0, abs=1e-14)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"use": "wheels.toml"}, 'car.toml:7:1: parts.rear.use = "wheels.toml": cannot be read: No such file'),
        ({"use": "wheel"}, 'parts.rear.use = "wheel": unknown template "wheel"; there is none; a file ends in ".toml"'),
        ({"use": "car.toml"}, 'parts.rear.use = "car.toml": it contains itself'),
        ({"with_": '{ y = "1 m" }'}, 'parts.rear.with.y: unknown parameter of this part "y"; there is r, x'),
        ({"with_": '{ x = "1 kg" }'}, "a length"),
        ({"wheel": WHEEL.replace('disk = "r"', 'disk = "r"\nradios = 3')}, "wheel.toml:10:1: bodies.front.disk.radios: unknown key"),
        ({"wheel": WHEEL.replace('mass = "2 kg"', 'mass = "2 m"')}, 'wheel.toml:10:1: bodies.front.disk.mass = "2 m": a mass (such as kg) is wanted'),
        ({"wheel": WHEEL + "[spin]\nangle = 0\n"}, "no spin"),
        ({"wheel": WHEEL + "[bodies.x\n"}, "wheel.toml:18"),
        ({"wheel": WHEEL + '[parts.own]\nuse = "wheel.toml"\n'}, "it contains itself"),
    ],
)  # fmt: skip
def test_faults_of_parts(tmp_path: Path, given: dict[str, str], told: str) -> None:
    with pytest.raises(pm.SceneError) as found:
        pm.load(car(tmp_path, **given)).run()
    assert told in str(found.value)


def test_parts_are_bounded_in_depth_and_number() -> None:
    deep = 'until = "t = 0 s"\n[parts.p]\nuse = "t0"\n'
    deep += "".join(f'[templates.t{k}.parts.p]\nuse = "t{k + 1}"\n' for k in range(30))
    assert "parts more than 16 levels deep" in fault(deep)
    many = 'until = "t = 0 s"\n[templates.t]\nparameters.r = 1\n[parts."p[i]"]\nfor = "i in 1..20000"\nuse = "t"\n'
    assert "more than 10000 parts" in fault(many)

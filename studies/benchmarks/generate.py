"""Scenes of any size, for cost growth: what a file would need a loop for."""

from __future__ import annotations

import planemotion


def four_bars(n: int, until: str = "t = 10 s") -> planemotion.Scene:
    """IFToMM A02: n + 1 cranks on pins 1 m apart, n couplers; upright, tips at 1 m/s to the right."""
    scene = planemotion.Scene(f"four_bars_{n}", until=until)
    for i in range(n + 1):
        scene.body(
            f"c{i}", rod=["O", "A"], length="1 m", mass="1 kg", at={"O": [f"{i} m", 0]}, angle="90 deg"
        )
        scene.joint(f"O{i}", pin=[f"c{i}.O", "ground"])
    for i in range(n):
        scene.body(f"b{i}", rod=["A", "B"], length="1 m", mass="1 kg", at={"A": f"c{i}.A"}, angle="0 deg")
        scene.joint(f"A{i}", pin=[f"b{i}.A", f"c{i}.A"])
        scene.joint(f"B{i}", pin=[f"b{i}.B", f"c{i + 1}.A"])
    scene.parameters(g="9.81 m/s^2").start({"c0.omega": "-1 rad/s"})
    return scene.ask("angle", "c0.angle", unit="rad").ask("energy", "energy.total", unit="J")


def pendulums(n: int, until: str = "t = 1 s", name: str = "") -> planemotion.Scene:
    """n rods of 1 m and 1 kg in series, let go from the level."""
    scene = planemotion.Scene(name or f"pendulums_{n}", until=until)
    end = "ground"
    for i in range(n):
        scene.body(f"r{i}", rod=["A", "B"], length="1 m", mass="1 kg", at={"A": [f"{i} m", 0]}, angle="0 deg")
        scene.joint(f"A{i}", pin=[f"r{i}.A", end])
        end = f"r{i}.B"
    return scene.parameters(g="9.81 m/s^2").ask("energy", "energy.total", unit="J")


def floors(n: int, until: str = "t = 2 s") -> planemotion.Scene:
    """A double pendulum above n level lines that it does not reach: contacts that are watched in vain."""
    scene = pendulums(2, until, f"floors_{n}")
    scene.ground(lines={f"f{i}": {"through": [0, f"{-3 - i / 100} m"]} for i in range(n)})
    for i in range(n):
        scene.contact(f"f{i}", touch=["r1.B", f"ground.f{i}"], restitution=0.5)
    return scene


def idle(n: int, until: str = "t = 2 s") -> planemotion.Scene:
    """A double pendulum that is asked for, and n others beside it that are not."""
    scene = pendulums(2, until, f"idle_{n}")
    for i in range(n):
        at = {"A": [f"{5 + 2 * i} m", 0]}
        scene.body(f"i{i}", rod=["A", "B"], length="1 m", mass="1 kg", at=at, angle="0 deg")
        scene.joint(f"I{i}", pin=[f"i{i}.A", "ground"])
    return scene.ask("omega", "r1.omega", unit="rad/s")

"""The rod on a pin that tests of sweeps and of the command line run."""

from __future__ import annotations

from tests.scenes.parts import rod_on_pin

# Let go at 30 degrees below the level; events, lists and a sweep over its length.
RELEASED = f"""
id = "pendulum"
title = "A rod that swings"
until = "t = 0.35 s"
parameters = {{ L = "0.73 m" }}
{rod_on_pin(length="L", mass="1.3 kg", angle="-30 deg")}
events.low = "AB.angle = -60 deg"
sweep.L = {{ from = "0.5 m", to = "1 m", num = 6 }}
[ask]
omega = {{ of = "AB.omega", unit = "rad/s" }}
reaction = {{ of = "A.force.norm", at = "low", unit = "N" }}
speeds = {{ of = "AB.B.speed", at = {{ each = "t", values = ["0.1 s", "0.2 s"] }}, unit = "m/s" }}
"""
# Set swinging from below, until it comes to rest for the first time; a sweep over two parameters.
THROWN = f"""
id = "pendulum"
until = "AB.omega < 0"
parameters = {{ L = "2*b", b = "10 in", omega0 = "30 deg/s", m = "1 kg" }}
sweep = {{ L = ["18 in", "0.5 m", "2 ft"], omega0 = {{ from = "30 deg/s", to = "100 deg/s", num = 8 }} }}
start.AB.omega = "omega0"
{rod_on_pin(length="L", mass="m", angle="-90 deg")}
[ask]
height = {{ of = "AB.B.y", unit = "in" }}
swing = "t"
angles = {{ of = "t", at = {{ each = "AB.angle", values = ["-89 deg", "-80 deg"] }}, unit = "min" }}
"""

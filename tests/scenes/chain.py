"""A chain of n equal links by an index, that hangs on the ground."""

from __future__ import annotations


def chain(until: str, more: str = "") -> str:
    """Links of L = 0.5 m and m = 0.8 kg, each 20 deg steeper and 0.3 rad/s faster than the one before it.

    `more`: tables that follow.
    """
    return f"""
until = "t = {until}"
[parameters]
n = 3
L = "0.5 m"
m = "0.8 kg"
[bodies."link[i]"]
for = "i in 1..n"
rod = ["A", "B"]
length = "L"
mass = "m"
angle = "(-20 deg)*i"
[ground.points]
O = [0, 0]
[joints.root]
pin = ["link[1].A", "ground.O"]
[joints."pin[i]"]
for = "i in 2..n"
pin = ["link[i-1].B", "link[i].A"]
[start]
"link[i].omega" = {{ for = "i in 1..n", value = "i*(0.3 rad/s)" }}
[ask]
"angle[i]" = {{ for = "i in 1..n", value = "link[i].angle" }}
tip = "link[n].B.y"
{more}"""

"""What tests of curves share: a bowl, and how a disk is held that rolls in one."""

from __future__ import annotations

ROLLS = {
    "contact": 'contacts.c = { touch = ["p.rim", "ground.bowl"], friction = "rough" }',
    "joint": 'joints.c = { rolling = ["p.rim", "ground.bowl"] }',
}

PARABOLA = '{ x = "(1 m)*s", y = "(0.25 m)*s^2", from = -3, to = 3 }'

"""What tests of curves share: how a disk is held that rolls in a bowl."""

from __future__ import annotations

ROLLS = {
    "contact": 'contacts.c = { touch = ["p.rim", "ground.bowl"], friction = "rough" }',
    "joint": 'joints.c = { rolling = ["p.rim", "ground.bowl"] }',
}

"""Units, addresses and expressions: what is read, what it means, which code it becomes."""

from __future__ import annotations

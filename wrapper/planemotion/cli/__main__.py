"""`python -m planemotion.cli` does what the command `planemotion` does."""

from __future__ import annotations

from .main import main

main()

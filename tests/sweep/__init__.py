"""Sweeps: grids, plans, chunks, files, resuming."""

from __future__ import annotations

"""Sweeps: grids, plans, chunks, files, resuming."""

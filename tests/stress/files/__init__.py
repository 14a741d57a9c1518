"""Sweeps that are killed at random, and disks that are full at random: what is resumed has the same bytes."""

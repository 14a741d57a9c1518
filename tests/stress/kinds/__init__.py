"""Whole scenes of many kinds, drawn at random beside closed forms."""

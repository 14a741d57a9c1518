"""Text for people: what a scene says and how it is computed, phase by phase.

It uses `engine` and `compile`.  Only the command line uses it.
"""

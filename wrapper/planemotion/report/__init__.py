"""Text for people: what a scene says and how it is computed, phase by phase.

It uses `engine` and `compile`.  The command line, Scene.check and Scene.explain, and `webpage` use it.
"""

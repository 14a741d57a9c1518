"""From the validated scene to the kernel's tables: one module for each group of words.

It uses `reading`, `kinds` and `geometry`; `flatten` goes through all of it once, `acts` says
what acts on each body.  `engine` runs the result,
and `sweep`, `pictures` and `report` begin with it.
"""

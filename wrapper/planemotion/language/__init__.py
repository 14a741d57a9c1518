"""The language of numbers: units, addresses such as `AB.B.velocity.x`, and expressions as trees.

It uses `base`, and knows neither scenes nor tables of the kernel beyond the codes of their operations.  Every
room that reads, computes or writes a number uses it.
"""

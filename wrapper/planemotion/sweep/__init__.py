"""Parametric studies: which cases there are, computing them in chunks, and the files that they leave.

It uses `engine` and `compile`.  The top runs studies with it, and `pictures` and `report` read what it wrote.
"""

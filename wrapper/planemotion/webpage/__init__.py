"""The page of a report: what is told of a scene or a study, as one file of HTML.

It uses `report`, `animation`, `pictures` and `engine`.  `reporting` runs what is reported, and writes the
page.
"""

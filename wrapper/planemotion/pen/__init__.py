"""Drawing with ink: colours, the signs of mechanics, and the sketch that knows where every mark is on paper.

It uses `geometry` for places, and matplotlib.  Kinds draw themselves with it, and `pictures` draws the rest.
"""

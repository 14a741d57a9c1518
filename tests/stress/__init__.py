"""Scenes changed at random, as nobody would write them: each is answered or told, and none hurts."""

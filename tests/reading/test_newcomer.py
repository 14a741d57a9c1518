"""Attempts of newcomers: each is explained by its message, and the last one answers as closed forms do."""

from __future__ import annotations

import numpy as np
import pytest

from planemotion import SceneError, load_text
from tests.reading.newcomers import FOUND, STORIES, Story
from tests.scenes import G


@pytest.mark.parametrize("story", STORIES.values(), ids=STORIES)
def test_every_failed_attempt_is_explained_by_its_message(story: Story) -> None:
    text = story.first
    for stumble in story.stumbles:
        with pytest.raises(SceneError) as caught:
            load_text(text).run()
        assert stumble.told in str(caught.value)
        for old, new in stumble.changes:
            assert old in text
            text = text.replace(old, new)
    result = load_text(text).run()
    for name, expected in story.answers.items():
        assert result[name] == pytest.approx(expected, rel=1e-9, abs=1e-8)


def test_what_was_found_is_told_without_an_ask() -> None:
    text = FOUND.first.replace('"mu"\nfrom = 0.01\nto = 0.5', "{ mu = [0.01, 0.5] }")
    result = load_text(text).run()
    mu = np.tan(np.pi / 6) - 2 / G  # v^2 = 2 g (sin - mu cos) x / cos
    assert result.found["mu"].value == pytest.approx(mu, rel=1e-9)
    assert f"found mu = {mu:.8g}" in repr(result)
    with pytest.raises(KeyError, match="what was found is in found"):
        result["mu"]


def test_a_size_that_is_awaited_at_zero_is_told() -> None:
    """A thrown ball has no speed at its top, and its speed does not pass through zero there."""
    scene = load_text("""
        until = "ball.speed = 0"
        bodies.ball = { mass = "1 kg", at = [0, 0] }
        start.ball.velocity.y = "3 m/s"
        events.top = { when = "ball.velocity.norm = (0 m/s)", nth = 1 }
        events.high = "ball.speed = 1 m/s"
        ask.h = "ball.y"
    """)
    until, top = scene.data.advice
    assert 'until = "ball.speed = 0": a size never passes through 0' in until
    assert 'such as "ball.velocity.x = 0"' in until
    assert 'events.top = "ball.velocity.norm = (0 m/s)"' in top
    assert '"ball.velocity.x = 0"' in top

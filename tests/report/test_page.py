"""The report of a scene, a study and a result: what must be on the page, and what is refused."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

import planemotion
from planemotion.base.errors import StudyError
from planemotion.reporting import report_of
from planemotion.webpage import needs

SCENE = """
title = "A ball <b>& more"
until = "t = 1 s"
[parameters]
v = "2 m/s"
[bodies]
k = { mass = "1 kg", at = [0, 0] }
[start]
"k.velocity" = ["v", 0]
[ask]
x = "k.x"
"""
SWEEP = SCENE + '[sweep]\nv = { from = "1 m/s", to = "4 m/s", num = 31 }\n'


def data_of(page: str) -> Any:
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)
    assert found is not None
    return json.loads(found[1])


def test_of_a_scene() -> None:
    page = planemotion.load_text(SCENE).report(v="3 m/s").html
    assert "A ball &lt;b&gt;&amp; more" in page
    assert "<b>& more" not in page
    assert '<td class="number">3</td>' in page
    (case,) = data_of(page)["replays"]["cases"]
    assert case["motion"]["title"].startswith("A ball")
    assert "http" not in re.sub(r"http://www.w3.org\S*", "", page.split("<script")[0])


def test_of_a_study_and_of_its_result(tmp_path: Path) -> None:
    scene = planemotion.load_text(SWEEP)
    page = scene.report(replays=4).html
    data = data_of(page)
    (plot,) = data["plots"]
    assert plot["data"][0]["y"] == pytest.approx([1 + i / 10 for i in range(31)])
    assert [case["words"] for case in data["replays"]["cases"]] == [f"v = {v} m/s" for v in (1, 2, 3, 4)]
    assert '<td class="number">31</td>' in page
    scene.sweep(out=tmp_path).close()
    (result,) = tmp_path.glob("*.h5")
    again = data_of(report_of(result, {}, 4).html)
    assert again["plots"] == data["plots"]
    with pytest.raises(StudyError, match="none can be set"):
        report_of(result, {"v": "2 m/s"})


def test_what_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    report = planemotion.load_text(SCENE).report()
    with pytest.raises(StudyError, match=r"\.pdf; a report is written as \.html"):
        report.save(tmp_path / "a.pdf")
    assert not list(tmp_path.iterdir())
    monkeypatch.setattr(needs, "find_spec", lambda name: None)
    with pytest.raises(StudyError, match=r'jinja2.*"planemotion\[report\]"'):
        planemotion.load_text(SCENE).report()

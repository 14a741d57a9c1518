"""Pages in a browser: `make test-browser` installs Chromium and Playwright and lets no test be skipped."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

_CHROMIUM = shutil.which("chromium")


def chromium() -> Any:
    """The fixture `browser` of a module; the module is skipped where no browser is installed."""
    if os.environ.get("PLANEMOTION_BROWSER") != "required":
        pytest.importorskip("playwright", reason="make test-browser installs it")
        if _CHROMIUM is None:
            pytest.skip("make test-browser installs Chromium", allow_module_level=True)

    @pytest.fixture(scope="module")
    def browser() -> Iterator[Any]:
        from playwright.sync_api import sync_playwright

        with sync_playwright() as driver:
            started = driver.chromium.launch(executable_path=_CHROMIUM, args=["--no-sandbox"])
            yield started
            started.close()

    return browser


@contextmanager
def opened(browser: Any, file: Path, theme: str) -> Iterator[Any]:
    """The page of a file, light or dark; errors in its console and requests to elsewhere are failures."""
    page = browser.new_page(viewport={"width": 1100, "height": 760}, color_scheme=theme)
    faults: list[str] = []
    page.on("console", lambda told: faults.append(told.text) if told.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("request", lambda asked: None if _within(asked.url, file) else faults.append(asked.url))
    page.goto(file.as_uri())
    yield page
    page.close()
    assert faults == []


def _within(url: str, file: Path) -> bool:
    """Whether it is the file itself, or something that stands in it."""
    return url == file.as_uri() or url.startswith(("data:", "blob:", "about:"))

"""The compiled kernel, imported when the first run needs it, and words for its numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from .. import _layout as layout

_STATUS_TEXT_LENGTH = 256
_STATUS_NAMES = {value: name.removeprefix("PM_").lower() for name, value in layout.pm_status.items()}
_ROUTE_NAMES = {value: name.removeprefix("PM_ROUTE_").lower() for name, value in layout.pm_route.items()}
AUDITS = tuple(name.removeprefix("PM_AUDIT_").lower() for name in layout.pm_audit if name != "PM_AUDITS")
REASONS: Mapping[int, str] = {
    layout.PM_REASON_NONE: "",
    layout.PM_REASON_NOT_REACHED: "not reached",
    layout.PM_REASON_UNDEFINED: "undefined: the expression has no value at some instant",
    layout.PM_REASON_FAILED: "the run failed",
    layout.PM_REASON_INFINITE: "infinite",
    layout.PM_REASON_SHARED: "not unique: redundant constraints share it",
    layout.PM_REASON_CUT: "the event fired more often than the list is long",
    layout.PM_REASON_TWO_SIDED: "another on the other side of what was found",
}


def status_name(status: int) -> str:
    """The word of a status: "ok", "limit_time", "assembly" ..."""
    return _STATUS_NAMES.get(status, f"status {status}")


def route_name(route: int) -> str:
    """The word of a route: "rk", "ida"."""
    return _ROUTE_NAMES.get(route, f"route {route}")


def status_text(status: int) -> str:
    """The kernel's own sentence for a status."""
    return kernel_text(kernel().pm_status_text, status)


def kernel_text(function: Callable[[int, npt.NDArray[np.int8]], int], number: int) -> str:
    """A text of the kernel."""
    text = np.zeros(_STATUS_TEXT_LENGTH, np.int8)
    length = function(number, text)
    return bytes(text[:length].tobytes()).decode("utf-8")


def kernel() -> Any:
    """The extension, imported when the first run needs it."""
    from .. import _kernel

    return _kernel

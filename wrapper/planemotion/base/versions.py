"""What computed a result: versions of the package, of the compiled kernel and of the libraries in it."""

from __future__ import annotations

import ctypes
import hashlib
from functools import cache
from importlib.metadata import version
from pathlib import Path

_TEXT_LENGTH = 64
_DIGITS = 16
# Other versions of these might compute other bits; the rest only writes files.
_OF_ROWS = ("planemotion", "kernel", "SUNDIALS", "GSL")


@cache
def versions() -> dict[str, str]:
    """Name -> version.  `kernel` is a checksum of the compiled extension: another build may round otherwise.

    Libraries that the kernel is not linked with are left out.
    """
    from .. import _kernel

    file = Path(_kernel.__file__)
    library = ctypes.CDLL(str(file))
    found = {
        "planemotion": version("planemotion"),
        "kernel": hashlib.sha256(file.read_bytes()).hexdigest()[:_DIGITS],
        "SUNDIALS": _sundials(library),
        "GSL": _gsl(library),
        "numpy": version("numpy"),
        "h5py": version("h5py"),
    }
    return {name: text for name, text in found.items() if text}


def row_versions() -> dict[str, str]:
    """Those on which the bits of an answer depend."""
    return {name: text for name, text in versions().items() if name in _OF_ROWS}


def _sundials(library: ctypes.CDLL) -> str:
    """The version of SUNDIALS that the kernel is linked with; "" if it has none."""
    text = ctypes.create_string_buffer(_TEXT_LENGTH)
    try:
        failed = library.SUNDIALSGetVersion(text, len(text))
    except AttributeError:
        return ""
    return "" if failed else text.value.decode()


def _gsl(library: ctypes.CDLL) -> str:
    """The version of GSL that the kernel is linked with; "" if it has none."""
    try:
        text = ctypes.c_char_p.in_dll(library, "gsl_version").value
    except ValueError:
        return ""
    return (text or b"").decode()

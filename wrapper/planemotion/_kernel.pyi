"""For the type checker: the f2py extension, whose routines kernel.pyf describes."""

from typing import Any

def __getattr__(name: str) -> Any: ...

"""The command line: `planemotion run | sweep | merge | map | check | explain | plot | draw | animate |
report | schema | export-fmu | new`.

Exit status: 0 all is well; 1 a run failed or ended early; 2 what was given is wrong (a file, a key, a value,
an output that cannot be written); 130 stopped by Ctrl-C.  Results go to stdout, all else to stderr.
"""

from __future__ import annotations

import errno
import sys
import warnings
from io import TextIOBase, TextIOWrapper
from typing import Any

import click

from ..base.errors import PlanemotionError, SceneHint, SimulationError
from .export import export_fmu
from .map import map_
from .new import new
from .options import FAILED, INTERRUPTED, WRONG, say
from .pictures import animate, draw, plot
from .report import report
from .run import run
from .schema import schema
from .sweep import merge, sweep
from .tell import check, explain


class _Closed(TextIOBase):
    """A standard output that was closed before: to write there is an error, so that nothing is lost."""

    def write(self, text: str) -> int:
        raise OSError(errno.EBADF, "it is closed, and there is something to write")


class _Commands(click.Group):
    """Turns the errors of the package into one message and an exit status."""

    def invoke(self, ctx: click.Context) -> Any:
        if sys.stdout is None:
            sys.stdout = _Closed()
        for stream in (sys.stdout, sys.stderr):  # names of files may hold bytes that are no text
            if isinstance(stream, TextIOWrapper):
                stream.reconfigure(errors="backslashreplace")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("always", SceneHint)
                warnings.showwarning = _show
                return super().invoke(ctx)
        except SimulationError as error:
            status, text = FAILED, str(error)
        except PlanemotionError as error:
            status, text = (INTERRUPTED if _is_interruption(error) else WRONG), str(error)
        except OSError as error:
            if error.errno == errno.EPIPE:  # `planemotion ... | head`: click ends quietly
                raise
            status, text = WRONG, f"{error.filename or 'standard output'}: {error.strerror or error}"
        except KeyboardInterrupt:
            status, text = INTERRUPTED, "stopped"
        say(text, error=status != INTERRUPTED)
        ctx.exit(status)


def _show(message: Warning | str, category: type[Warning], *place: Any, **more: Any) -> None:
    """A warning as a line for people; `place` in the sources says nothing to them."""
    say(f"{'hint' if issubclass(category, SceneHint) else 'warning'}: {message}")


def _is_interruption(error: PlanemotionError) -> bool:
    return type(error).__name__ == "SweepInterrupted"  # its module is heavy and may not be loaded


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="planemotion", prog_name="planemotion")
def main() -> None:
    """Rigid bodies in plane motion: energy, momentum, impacts.

    Scenes are TOML files; a study is a scene with a [sweep].
    """


_COMMANDS = (run, sweep, merge, map_, check, explain, plot, draw, animate, report, schema, export_fmu, new)
for _command in _COMMANDS:
    main.add_command(_command)


if __name__ == "__main__":
    main()

"""What Sphinx makes by running the program: the reference of the language, and the output of commands.

    ```{shell} planemotion run swing.toml --set e=0.8
    ```

shows the command and what it printed, run in a folder with the examples of the package.
A command that fails fails the build.

    ```{shell} planemotion draw swing.toml --out swing.svg
    :show: swing.svg
    ```

puts the picture that it made, or the page that moves, below it.
"""

from __future__ import annotations

import html
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import Any, ClassVar

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.parsers.rst.directives import unchanged
from status_table import status_table

from planemotion.examples import text_of, titles
from planemotion.report.reference import reference

HERE = Path(__file__).parent
# All commands of a build run in one folder, one after the other, as a reader would.
_FOLDER = Path(tempfile.mkdtemp(prefix="planemotion-docs-"))


class Shell(Directive):
    """A command and what it prints."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec: ClassVar = {"show": unchanged}

    def run(self) -> list[nodes.Node]:
        command = self.arguments[0]
        words = shlex.split(command)
        program = Path(sys.executable).with_name(words[0])
        environment = {**os.environ, "COLUMNS": "100", "NO_COLOR": "1"}
        if words[1] == "new" and not words[2].startswith("-"):  # it does not write over an example
            (_FOLDER / f"{words[2]}.toml").unlink(missing_ok=True)
        done = subprocess.run(
            [str(program), *words[1:]], cwd=_FOLDER, env=environment, capture_output=True, text=True
        )
        if done.returncode != 0:
            raise self.error(f"{command}: exit code {done.returncode}: {done.stderr or done.stdout}")
        text = f"$ {command}\n{done.stdout}".rstrip()
        return [nodes.literal_block(text, text, language="console"), *self._shown(command)]

    def _shown(self, command: str) -> list[nodes.Node]:
        """What the command made, copied beside the pages; names are those of the folder of examples."""
        name = self.options.get("show")
        if name is None:
            return []
        environment = self.state.document.settings.env
        made = Path(environment.app.outdir) / "made"
        made.mkdir(exist_ok=True)
        file = Path(shutil.copy(_FOLDER / name, made)).name
        place = f"{'../' * environment.docname.count('/')}made/{file}"
        said = html.escape(f"what this made: {command}", quote=True)
        if name.endswith(".html"):
            text = f'<iframe class="made" src="{place}" title="{said}"></iframe>'
        else:
            text = f'<img class="made" src="{place}" alt="{said}">'
        return [nodes.raw("", text, format="html")]


class ModuleText(Directive):
    """What a module says of itself, as it stands."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        text = import_module(self.arguments[0]).__doc__
        return [nodes.literal_block(text, text, language="text")]


def _begin(app: Any) -> None:
    for name in titles():
        (_FOLDER / f"{name}.toml").write_text(text_of(name), encoding="utf-8")
    (HERE / "reference" / "statuses.md").write_text(status_table(), encoding="utf-8")
    (HERE / "reference" / "language.md").write_text(reference(), encoding="utf-8")


def _end(app: Any, error: Exception | None) -> None:
    shutil.rmtree(_FOLDER, ignore_errors=True)


def setup(app: Any) -> dict[str, bool]:
    app.add_directive("shell", Shell)
    app.add_directive("module-text", ModuleText)
    app.connect("builder-inited", _begin)
    app.connect("build-finished", _end)
    return {"parallel_read_safe": False}

"""The rooms of the package: imports go down only, as wrapper/rooms.toml orders them.

Every import counts, wherever it stands: those for type checking and those inside functions, too.
"""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests import ROOT
from tests.circles import circles as circles_of

WRAPPER = ROOT / "wrapper"
PACKAGE = "planemotion"


@dataclass(frozen=True)
class Import:
    """`importer` imports `imported` in `line`; both are dotted names below the package."""

    importer: str
    imported: str
    line: int


@dataclass(frozen=True)
class House:
    """The rooms from the bottom to the top: folders by their names, modules beside them as lists."""

    rooms: tuple[str | list[str], ...]
    largest_circle: int
    longest_file: int
    half_of_functions: int
    most_functions: int
    longest_function: int

    @property
    def folders(self) -> list[str]:
        return [room for room in self.rooms if isinstance(room, str)]

    @property
    def made(self) -> list[str]:
        """Modules that the build makes: they have no source in the package."""
        return list(self.rooms[0])

    def floor(self, module: str) -> int | None:
        """How high a module stands; None if it is in no room."""
        folder = module.partition(".")[0]
        for floor, room in enumerate(self.rooms):
            if folder == room or (isinstance(room, list) and module in room):
                return floor
        return None


def house() -> House:
    table = tomllib.loads((WRAPPER / "rooms.toml").read_text(encoding="utf-8"))
    rooms = tuple(table.pop("rooms"))
    return House(rooms, **table)


def modules(package: Path) -> dict[str, Path]:
    """The modules of a package by their dotted names below it; of a folder that of its __init__."""
    found = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package).with_suffix("").parts
        found[".".join(parts[:-1] if len(parts) > 1 and parts[-1] == "__init__" else parts)] = path
    return found


def imports(package: Path, made: list[str]) -> list[Import]:
    """What imports what within a package; `made`: modules that have no source in it."""
    paths = modules(package)
    known = {*paths, *made}
    return [
        Import(name, imported, getattr(node, "lineno", 0))
        for name, path in paths.items()
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        for imported in _imported(node, package.name, _folder(name, path), known)
        if imported != name
    ]


def _folder(name: str, path: Path) -> str:
    """The dotted name of the folder that a module stands in."""
    if path.name == "__init__.py":
        return "" if name == "__init__" else name
    return name.rpartition(".")[0]


def _imported(node: ast.AST, package: str, folder: str, known: set[str]) -> Iterator[str]:
    """The modules of the package that a statement imports."""
    if isinstance(node, ast.Import):
        for name in node.names:
            first, _, below = name.name.partition(".")
            if first == package:
                yield _module(below, known)
    elif isinstance(node, ast.ImportFrom):
        source = _source(node, package, folder)
        if source is not None:
            for name in node.names:
                yield _module(f"{source}.{name.name}".lstrip("."), known)


def _source(node: ast.ImportFrom, package: str, folder: str) -> str | None:
    """The dotted name below the package from which is imported; None for another package."""
    written = node.module or ""
    if node.level == 0:
        first, _, below = written.partition(".")
        return below if first == package else None
    parts = folder.split(".") if folder else []
    return ".".join([*parts[: len(parts) - node.level + 1], *([written] if written else [])])


def _module(name: str, known: set[str]) -> str:
    """The module that `name` is, or is a name of."""
    while name and name not in known:
        name = name.rpartition(".")[0]
    return name or "__init__"


def homeless(package: Path, plan: House) -> list[str]:
    """Modules that stand in no room."""
    return [name for name in modules(package) if plan.floor(name) is None]


def upward(package: Path, plan: House) -> list[str]:
    """Imports of a room by one below it."""
    found = []
    for one in imports(package, plan.made):
        here, there = plan.floor(one.importer), plan.floor(one.imported)
        if here is not None and there is not None and there > here:
            found.append(f"{one.importer} -> {one.imported} (line {one.line})")
    return found


def circles(package: Path, plan: House) -> list[list[str]]:
    """Groups of modules that need each other in a circle."""
    needs: dict[str, set[str]] = {name: set() for name in (*modules(package), *plan.made)}
    for one in imports(package, plan.made):
        needs[one.importer].add(one.imported)
    return circles_of(needs)


def long_files(package: Path, plan: House) -> dict[str, int]:
    """The modules that have too many lines."""
    lengths = {name: path.read_text("utf-8").count("\n") for name, path in modules(package).items()}
    return {name: n for name, n in lengths.items() if n > plan.longest_file}


def functions(package: Path) -> dict[str, int]:
    """The lines of each function, with its docstring and without its decorators."""
    return {
        f"{name}: {node.name} (line {node.lineno})": (node.end_lineno or 0) - node.lineno + 1
        for name, path in modules(package).items()
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }


def long_functions(package: Path, plan: House) -> dict[str, int]:
    return {name: n for name, n in functions(package).items() if n > plan.longest_function}


# ---- the package ----------------------------------------------------------------------------------------


def test_every_module_stands_in_a_room() -> None:
    assert homeless(WRAPPER / PACKAGE, house()) == []


def test_every_room_is_there_and_says_what_it_is() -> None:
    for room in house().folders:
        said = ast.get_docstring(ast.parse((WRAPPER / PACKAGE / room / "__init__.py").read_text("utf-8")))
        assert said is not None, room
        assert len(re.findall(r"\.(?=\s|$)", said)) >= 3, room


def test_no_import_goes_up() -> None:
    assert upward(WRAPPER / PACKAGE, house()) == []


def test_circles_are_small() -> None:
    plan = house()
    assert [group for group in circles(WRAPPER / PACKAGE, plan) if len(group) > plan.largest_circle] == []


@pytest.mark.parametrize("folder", [WRAPPER / PACKAGE, ROOT / "tests", ROOT / "studies"])
def test_no_file_is_too_long(folder: Path) -> None:
    assert long_files(folder, house()) == {}


def test_functions_are_short() -> None:
    """Half of them, and nine of ten."""
    lengths = sorted(functions(WRAPPER / PACKAGE).values())
    assert lengths[len(lengths) // 2] <= house().half_of_functions
    assert lengths[len(lengths) * 9 // 10] <= house().most_functions


def test_no_function_is_too_long() -> None:
    assert long_functions(WRAPPER / PACKAGE, house()) == {}


# ---- the check itself -----------------------------------------------------------------------------------

PLAN = House((["_made"], "low", "high", ["__init__", "cli"]), 2, 5, 2, 2, 2)
SOUND = {
    "__init__.py": "from .cli import main",
    "cli.py": "from .high import wall\nimport house.low.stone",
    "low/__init__.py": "",
    "low/stone.py": "from .. import _made as made",
    "high/__init__.py": "",
    "high/wall.py": "from ..low.stone import block\nfrom . import roof",
    "high/roof.py": "import json",
}


def built(folder: Path, **changed: str) -> Path:
    """A small package, with other texts for some of its files (`low__stone` is low/stone.py)."""
    files = SOUND | {f"{name.replace('__', '/')}.py": text for name, text in changed.items()}
    for name, text in files.items():
        path = folder / "house" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder / "house"


def test_a_sound_house_has_no_faults(tmp_path: Path) -> None:
    package = built(tmp_path)
    assert (homeless(package, PLAN), upward(package, PLAN), circles(package, PLAN)) == ([], [], [])


def test_an_import_of_a_higher_room_is_named_with_its_line(tmp_path: Path) -> None:
    package = built(tmp_path, low__stone="x = 1\nfrom ..high.wall import brick")
    assert upward(package, PLAN) == ["low.stone -> high.wall (line 2)"]


def test_imports_in_functions_for_types_and_of_folders_count(tmp_path: Path) -> None:
    package = built(
        tmp_path,
        low__stone="if TYPE_CHECKING:\n    from ..high import roof",
        low__sand="def f():\n    from house import high",
        low__clay="import house.cli",
        low__lime="from .. import anything",
    )
    assert upward(package, PLAN) == [
        "low.clay -> cli (line 1)",
        "low.lime -> __init__ (line 1)",
        "low.sand -> high (line 2)",
        "low.stone -> high.roof (line 2)",
    ]


def test_a_module_without_a_room_is_found(tmp_path: Path) -> None:
    assert homeless(built(tmp_path, shed="", barn__hay=""), PLAN) == ["barn.hay", "shed"]


def test_a_circle_of_modules_is_found(tmp_path: Path) -> None:
    package = built(tmp_path, high__roof="from .wall import width")
    assert circles(package, PLAN) == [["high.roof", "high.wall"]]


def test_long_files_and_functions_are_found(tmp_path: Path) -> None:
    package = built(
        tmp_path,
        low__stone="@one\n@two\ndef f():\n    pass\n    return\n",
        low__sand="def f():\n    x = 1\n    y = 2\n\n\nz = 3\n",
    )
    assert long_files(package, PLAN) == {"low.sand": 6}
    assert long_functions(package, PLAN) == {"low.sand: f (line 1)": 3, "low.stone: f (line 3)": 3}

"""The constants that Python uses are those of the C header."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

import planemotion._layout as installed
from tests import ROOT

KERNEL = ROOT / "kernel"


def load(name: str, path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


layout = load("layout", KERNEL / "layout.py")


def constants(header: str) -> dict[str, int]:
    return layout.read(header).constant


def test_values_count_up_from_the_last_explicit_one() -> None:
    assert constants("enum pm_e { PM_A, PM_B = 3, PM_C, PM_D = -7, PM_E };") == {
        "PM_A": 0, "PM_B": 3, "PM_C": 4, "PM_D": -7, "PM_E": -6,
    }  # fmt: skip


def test_comments_are_no_part_of_the_header() -> None:
    header = """
    enum pm_e { /* PM_X, } */
        PM_A, // one, = 2
        PM_B, /* over
                 lines */
        /* PM_C = 5, */
    };
    // #define PM_OLD 1
    #define PM_NEW 2 /* its meaning */
    """
    assert constants(header) == {"PM_A": 0, "PM_B": 1, "PM_NEW": 2}


def test_a_trailing_comma_is_no_entry() -> None:
    assert constants("enum pm_e { PM_A, PM_B, };") == {"PM_A": 0, "PM_B": 1}


def test_a_typedef_is_an_enumeration_too() -> None:
    assert constants("typedef enum pm_e { PM_A } pm_e;") == {"PM_A": 0}


def test_the_type_of_an_argument_is_not_a_definition() -> None:
    assert constants("int pm_f(enum pm_e e);\nint pm_g(void);") == {}


@pytest.mark.parametrize(
    ("value", "number"),
    [
        ("0x1F", 31),
        ("10u", 10),
        ("7LL", 7),
        ("(-1)", -1),
        ("1 << 4", 16),
        ("PM_A", 5),
        ("(PM_A | 2) + 1", 8),
        ("~0", -1),
    ],
)
def test_integer_arithmetic(value: str, number: int) -> None:
    assert constants(f"#define PM_A 5\n#define PM_B {value}")["PM_B"] == number
    assert constants(f"#define PM_A 5\nenum pm_e {{ PM_B = {value} }};")["PM_B"] == number


def test_a_macro_may_run_over_two_lines() -> None:
    assert constants("#define PM_A \\\n    12\n") == {"PM_A": 12}


def test_macros_that_are_no_integers_are_left_out() -> None:
    header = """
    #ifndef PM_H
    #define PM_H
    #define PM_TOLERANCE 1e-9
    #define PM_HALF 0.5
    #define PM_API __attribute__((visibility("default")))
    #define PM_SQUARE(x) ((x) * (x))
    #define OTHER 3
    #endif
    """
    assert constants(header) == {}


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ("enum pm_e { PM_A = sizeof(int) };", "PM_A: cannot read the value 'sizeof(int)'"),
        ("enum pm_e { PM_A = PM_MISSING };", "PM_A: cannot read the value 'PM_MISSING'"),
        ("enum pm_e { PM_A = 010 };", "PM_A: cannot read the value '010'"),
        ("enum pm_e { PM_A = 1.5 };", "PM_A: cannot read the value '1.5'"),
        ("enum pm_e { PM_A PM_B };", "enum pm_e: cannot read the entry 'PM_A PM_B'"),
        ("enum pm_e { PM_A,, PM_B };", "enum pm_e: cannot read the entry ''"),
        ("enum pm_e { OTHER };", "enum pm_e: OTHER does not begin with PM_"),
        ("enum pm_e { };", "enum pm_e is empty"),
        ("enum { PM_A };", "an enumeration needs a name that begins with pm_"),
        ("enum pm_e { PM_A }; enum pm_e { PM_B };", "enum pm_e is defined twice"),
        ("enum pm_e { PM_A }; enum pm_f { PM_A };", "PM_A is defined twice"),
        ("#define PM_A PM_MISSING", "PM_A: cannot read the value 'PM_MISSING'"),
        ("#define PM_A (1 +", "PM_A: cannot read the value '(1 +'"),
    ],
)
def test_what_cannot_be_read_is_an_error(header: str, message: str) -> None:
    with pytest.raises(layout.LayoutError) as error:
        layout.read(header)
    assert message in str(error.value)


def test_the_written_module_holds_constants_and_enumerations(tmp_path: Path) -> None:
    header = "#define PM_N 2\nenum pm_side { PM_LEFT, PM_RIGHT = 3 };"
    path = tmp_path / "written.py"
    path.write_text(layout.write(layout.read(header), "planemotion.h"))
    module = load("written", path)
    assert (module.PM_N, module.PM_LEFT, module.PM_RIGHT) == (2, 0, 3)
    assert module.pm_side == {"PM_LEFT": 0, "PM_RIGHT": 3}


def test_headers_beside_it_are_read_in_their_places(tmp_path: Path) -> None:
    (tmp_path / "parts.h").write_text("#define PM_PARTS 3\n")
    header = tmp_path / "all.h"
    header.write_text('#include <stdint.h>\n#include "parts.h"\nenum pm_e { PM_A = PM_PARTS };\n')
    assert constants(layout.whole(header)) == {"PM_PARTS": 3, "PM_A": 3}


def test_an_error_names_the_header_and_writes_nothing(tmp_path: Path) -> None:
    header = tmp_path / "planemotion.h"
    header.write_text("enum pm_e { PM_A = 1.5 };")
    output = tmp_path / "out.py"
    done = subprocess.run(
        [sys.executable, KERNEL / "layout.py", header, output], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stderr.startswith(f"{header}: PM_A: cannot read")
    assert not output.exists()


@pytest.mark.skipif(shutil.which("cc") is None, reason="needs a C compiler")
def test_the_installed_constants_are_those_of_the_compiler(tmp_path: Path) -> None:
    names = [name for name in vars(installed) if name.startswith("PM_")]
    prints = "\n".join(f'    printf("{name} %lld\\n", (long long)({name}));' for name in names)
    source = tmp_path / "constants.c"
    source.write_text(
        f'#include "planemotion.h"\n#include <stdio.h>\n\nint main(void)\n{{\n{prints}\n    return 0;\n}}\n'
    )
    program = tmp_path / "constants"
    subprocess.run(["cc", "-I", KERNEL, source, "-o", program], check=True)
    printed = subprocess.run([program], capture_output=True, text=True, check=True).stdout
    assert printed.split("\n")[:-1] == [f"{name} {getattr(installed, name)}" for name in names]
    assert names

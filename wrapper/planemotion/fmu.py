"""A scene as an FMU for co-simulation (FMI 2.0): its tables beside the kernel.

In it are modelDescription.xml, resources/scene.bin (the tables), and in binaries/linux64 the kernel behind
the functions of FMI (wrapper/fmu/) with its libraries.  A scene has no inputs but its parameters.
"""

from __future__ import annotations

import hashlib
import os
import platform
import re
import subprocess
import sys
import time
import uuid
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import numpy as np

from ._layout import PM_OK
from .base.errors import SceneError, StudyError
from .base.files import appearing
from .compile.flatten import FlatScene, flatten
from .engine import call
from .engine.kernel import status_name
from .language.dimensions import Dimension
from .language.units import factor

if TYPE_CHECKING:
    from .scene import Scene

_MARK = b"planemotion FMU 1\n"
_LIBRARY = "planemotion_fmu.so"
_PLATFORM = "linux64"
_OF_A_WHEEL = "planemotion.libs"
# Libraries that every Linux brings along: those of glibc.
_OF_THE_SYSTEM = re.compile(r"^(ld-linux.*|linux-vdso|lib(c|m|dl|rt|pthread))\.so")
# Communication points of the default experiment.
_STEPS = 500


@dataclass(frozen=True)
class Fmu:
    """What was exported: the file, and the names of its parameters and outputs."""

    path: Path
    parameters: tuple[str, ...]
    outputs: tuple[str, ...]


def export_fmu(
    scene: Scene, out: str | os.PathLike[str], quantities: Sequence[str] = (), *, run: str | None = None
) -> Fmu:
    """Writes a scene as an FMU for co-simulation, FMI 2.0, for Linux on x86-64.

        planemotion.export_fmu(planemotion.load("ball.toml"), "ball.fmu", ["ball.y", "ball.velocity.y"])

    Parameters of the FMU are those of the scene; they can be set until the first step.  Outputs: `quantities`
    as in Scene.history; none: motion, energies and what the asks read.  All in SI.  `run`: one of [runs].
    The simulation ends with the run.  Raises SceneError for what the scene does not have or a [find],
    StudyError if the file cannot be written, or the run fails.
    """
    path = Path(out)
    if path.suffix != ".fmu":
        raise StudyError(f"{path}: an FMU has the ending .fmu")
    if sys.platform != "linux" or platform.machine() != "x86_64":
        raise StudyError(
            f"FMUs are written for Linux on x86-64; this is {sys.platform} on {platform.machine()}"
        )
    flat = flatten(scene, run, history=tuple(quantities))
    if flat.find is not None:
        reason = "an FMU computes one run; give what is sought a value, and remove [find]"
        raise SceneError(reason, file=scene.file, path="find")
    variables = _Variables(flat)
    guid = _guid(flat, variables)
    described = _description(scene, flat, variables, guid)
    with appearing(path) as temporary, zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as fmu:
        fmu.writestr("modelDescription.xml", described)
        fmu.writestr("resources/scene.bin", _tables(flat, variables, guid))
        fmu.writestr("resources/scene.toml", scene.whole_text)
        for name, library in _libraries(_identifier(flat.id)):
            fmu.write(library, f"binaries/{name}")
    return Fmu(path, variables.parameters, variables.outputs)


class _Variables:
    """The parameters that an FMU has, in their order in the tables, and its outputs, with their units."""

    def __init__(self, flat: FlatScene) -> None:
        self.parameters = flat.parameters
        self.fixed = flat.decided  # more was decided by them than the tables say
        self.values = flat.defaults.tolist()
        self.dimensions = [factor(unit)[1] for unit in flat.units]
        self.outputs = tuple(name for name in flat.trace if name not in flat.parameters)
        self.programs = [flat.trace[name][0] for name in self.outputs]
        self.units = [flat.trace[name][1] for name in self.outputs]


def _identifier(name: str) -> str:
    """A name as C has it."""
    made = re.sub(r"\W", "_", name, flags=re.ASCII)
    return made if made[:1].isalpha() else f"scene_{made}"


def _numbers(flat: FlatScene, variables: _Variables) -> bytes:
    arrays = (
        np.array(
            [len(flat.table), len(flat.constant), len(variables.parameters), len(variables.programs)],
            np.int64,
        ),
        np.asarray(flat.table, np.int32),
        np.asarray(flat.constant, np.float64),
        np.asarray(flat.defaults, np.float64),
        np.array(variables.programs, np.int32),
    )
    return b"".join(array.tobytes() for array in arrays)


def _guid(flat: FlatScene, variables: _Variables) -> str:
    """The same scene has the same."""
    told = repr((variables.parameters, variables.outputs)).encode()
    return str(uuid.UUID(bytes=hashlib.sha256(_numbers(flat, variables) + told).digest()[:16]))


def _tables(flat: FlatScene, variables: _Variables, guid: str) -> bytes:
    """What wrapper/fmu/scene_file.c reads."""
    return _MARK + guid.encode() + _numbers(flat, variables)


# ---- the model description ----


def _description(scene: Scene, flat: FlatScene, variables: _Variables, guid: str) -> str:
    root = ElementTree.Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=flat.id,
        guid=guid,
        description=scene.data.title,
        generationTool="planemotion",
        generationDateAndTime=time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
        variableNamingConvention="flat",
        numberOfEventIndicators="0",
    )
    ElementTree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=_identifier(flat.id),
        canHandleVariableCommunicationStepSize="true",
        canNotUseMemoryManagementFunctions="true",
    )
    _add_units(root, variables)
    _add_experiment(root, flat)
    scalars = ElementTree.SubElement(root, "ModelVariables")
    for number, name in enumerate(variables.parameters):
        fixed = name in variables.fixed
        one = _scalar(scalars, name, number, "local" if fixed else "parameter")
        one.set("variability", "constant" if fixed else "fixed")
        one.set("initial", "exact")
        unit = variables.dimensions[number].unit or "1"
        ElementTree.SubElement(one, "Real", start=repr(variables.values[number]), unit=unit)
    for number, name in enumerate(variables.outputs):
        one = _scalar(scalars, name, len(variables.parameters) + number, "output")
        one.set("variability", "continuous")
        one.set("initial", "calculated")
        ElementTree.SubElement(one, "Real", unit=variables.units[number] or "1")
    _add_structure(root, variables)
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _scalar(above: Any, name: str, number: int, causality: str) -> Any:
    return ElementTree.SubElement(
        above, "ScalarVariable", name=name, valueReference=str(number), causality=causality
    )


def _add_units(root: Any, variables: _Variables) -> None:
    """All units with their exponents of kg, m, s and rad; all are of SI."""
    used = {dimension.unit or "1": dimension for dimension in variables.dimensions}
    used.update({unit or "1": factor(unit)[1] for unit in variables.units})
    definitions = ElementTree.SubElement(root, "UnitDefinitions")
    for unit, dimension in sorted(used.items()):
        one = ElementTree.SubElement(definitions, "Unit", name=unit)
        exponents = _exponents(unit, dimension)
        if all(power == int(power) for power in exponents.values()):
            ElementTree.SubElement(one, "BaseUnit", {key: str(int(p)) for key, p in exponents.items() if p})


def _exponents(unit: str, dimension: Dimension) -> dict[str, Any]:
    rad = len(re.findall(r"\brad\b", unit))
    return {"kg": dimension.mass, "m": dimension.length, "s": dimension.time, "rad": rad}


def _add_experiment(root: Any, flat: FlatScene) -> None:
    """The run to its end, where it comes to one."""
    recorded = call.trace(flat, flat.defaults, every=1e9)
    if recorded.status < PM_OK:
        raise StudyError(f"{flat.id}: the run fails ({status_name(recorded.status)}); an FMU would, too")
    end = float(recorded.time[-1])
    if end > 0:
        ElementTree.SubElement(
            root, "DefaultExperiment", startTime="0", stopTime=repr(end), stepSize=repr(end / _STEPS)
        )


def _add_structure(root: Any, variables: _Variables) -> None:
    """Outputs depend on all parameters, as it is taken where nothing else is said."""
    structure = ElementTree.SubElement(root, "ModelStructure")
    first = len(variables.parameters) + 1
    for part in ("Outputs", "InitialUnknowns"):
        above = ElementTree.SubElement(structure, part)
        for number in range(len(variables.outputs)):
            ElementTree.SubElement(above, "Unknown", index=str(first + number))


# ---- the libraries ----


def _libraries(identifier: str) -> Iterator[tuple[str, Path]]:
    """Names in binaries/, and files: the kernel, and what it is linked with, but for what every Linux has.

    A wheel has its libraries in a folder beside its packages, and the kernel looks for them there.
    """
    kernel = Path(__file__).with_name(_LIBRARY)
    if not kernel.exists():
        raise StudyError(f"{kernel}: is not there; this installation cannot write FMUs")
    yield f"{_PLATFORM}/{identifier}.so", kernel
    try:
        told = subprocess.run(["ldd", kernel], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise StudyError(f"ldd, which tells what {kernel} is linked with, failed: {error}") from None
    for line in told.splitlines():
        name, _, where = line.strip().partition(" => ")
        place = where.partition(" (")[0]
        if place == "not found":
            raise StudyError(f"{kernel}: its library {name} is not found")
        if place and not _OF_THE_SYSTEM.match(name):
            folder = Path(place).parent.name
            yield f"{folder if folder == _OF_A_WHEEL else _PLATFORM}/{name}", Path(place)

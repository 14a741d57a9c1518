"""Results in the eyes of other programs: xarray with each of its engines, ncdump, and UDUNITS."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from planemotion import load_text
from planemotion.language.cf import cf_units, unit_of
from planemotion.language.units import _WORDS as WORDS
from planemotion.language.units import factor, parse_quantity

FALL = """
id = "fall"
parameters = { h = "1 m", a = "0 deg", P = "2 lb" }
bodies.ball = { mass = "1 slug", at = [0, "h"] }
start.ball.velocity.y = "-sin(a)*(1 m/s)"
until = "ball.y = 0 m"
ask.T = "t"
ask.v = { of = "ball.velocity.y", unit = "mph" }
ask.W = { of = "P", unit = "lb" }
ask.steps = { of = "ball.y", at = { each = "ball.y", values = ["0.5 m", "0.25 m"] }, unit = "ft" }
[sweep]
a = { from = "0 deg", to = "80 deg", num = 5 }
h = ["1 m", "2 m"]
P = ["1 lb", "2 lb", "3 lb"]

"""


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("out")
    load_text(FALL).sweep(out=out)
    return out / "fall.h5"


def test_units_are_those_of_udunits() -> None:
    """Every word of the language, alone and with others, means there what it means here."""
    cf = pytest.importorskip("cf_units")
    for word in WORDS:
        for text in (word, f"{word}^2/s", f"kg*m/({word}*s)"):
            ours, dimension = factor(text)
            theirs = cf.Unit(cf_units(text)["units"])
            assert theirs.convert(1.0, cf.Unit(dimension.unit or "1")) == pytest.approx(ours, rel=1e-12), text
    assert cf_units("m/s") == {"units": "m/s"}
    assert unit_of(cf_units("")) == "1"
    assert unit_of(cf_units("lb*ft")) == "lb*ft"


@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_xarray_opens_it(result: Path, engine: str) -> None:
    if engine == "netcdf4":
        pytest.importorskip("netCDF4")
    with xr.open_dataset(result, engine=engine) as dataset:
        assert dict(dataset["T"].sizes) == {"a": 5, "h": 2, "P": 3}
        assert set(dataset.coords) >= {"a", "h", "P", "ask", "steps_at"}
        assert dataset["a"].attrs["units"] == "degree"
        assert dataset["a"].attrs["unit"] == "deg"
        assert dataset["v"].attrs["units"] == "(mile/hour)"
        assert dataset["T"].dtype == np.float64
        assert dataset.attrs["Conventions"].startswith("CF-1.")
        assert dataset["T"].attrs["ancillary_variables"] == "T_error"


def test_all_variables_have_what_cf_asks_for(result: Path) -> None:
    """Numbers have units that UDUNITS reads and names for people; flags have a meaning for each value."""
    cf = pytest.importorskip("cf_units")
    with xr.open_dataset(result, engine="h5netcdf", decode_cf=False) as dataset:
        for name, variable in dataset.variables.items():
            attributes = variable.attrs
            if variable.dtype.kind in "fi" and "flag_values" not in attributes:
                cf.Unit(attributes["units"])
            if "flag_values" in attributes:
                values, words = np.atleast_1d(attributes["flag_values"]), attributes["flag_meanings"].split()
                assert len(values) == len(words) == len(set(values.tolist())), name
                assert values.dtype == variable.dtype, name
            for other in attributes.get("ancillary_variables", "").split():
                assert other in dataset
            if name not in dataset.dims:
                assert attributes["long_name"]


def test_ncdump_reads_it(result: Path) -> None:
    ncdump = shutil.which("ncdump")
    if ncdump is None:
        pytest.skip("there is no ncdump")
    told = subprocess.run(
        [ncdump, "-v", "T,a", str(result)], capture_output=True, text=True, check=True
    ).stdout
    for line in ("double T(a, h, P)", 'a:units = "degree"', 'T:units = "s"', ':Conventions = "CF-'):
        assert line in told
    header = subprocess.run([ncdump, "-k", str(result)], capture_output=True, text=True, check=True).stdout
    assert header.strip() == "netCDF-4"
    assert "a = 0, 20, 40, 60, 80 ;" in told


def test_what_stands_in_tables_is_written_as_in_scenes(result: Path) -> None:
    header = result.with_suffix(".csv").read_text(encoding="utf-8").splitlines()[0]
    assert header.startswith("a [deg],h [m],P [lb],T [s],v [mph],W [lb],")
    assert parse_quantity("1 lb").value_si == pytest.approx(4.4482216152605)

"""The recipes for clusters, run: what they leave is what one sweep leaves."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from planemotion import load
from tests import ROOT
from tests.slurm.cluster import missing, one_node

RECIPES = ROOT / "studies/cluster"
STUDY = ROOT / "studies/sphere_over_bars.toml"
SLURM = pytest.mark.skipif(bool(missing()), reason=f"not installed: {', '.join(missing())}")


@pytest.fixture(scope="module")
def table(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The table of the study by threads."""
    out = tmp_path_factory.mktemp("threads")
    load(STUDY).sweep(out=out)
    return (out / "sphere_over_bars.csv").read_bytes()


@pytest.fixture(scope="module")
def cluster() -> Iterator[dict[str, str]]:
    with one_node() as environment:
        yield with_programs(environment)


def with_programs(environment: dict[str, str]) -> dict[str, str]:
    """With planemotion and python of this environment."""
    return {**environment, "PATH": f"{Path(sys.executable).parent}:{environment['PATH']}"}


def run(command: list[str], folder: Path, environment: dict[str, str]) -> None:
    ended = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False, timeout=240
    )
    logs = "".join(path.read_text(errors="replace") for path in folder.rglob("*.log"))
    assert ended.returncode == 0, f"{ended.stdout}{ended.stderr}{logs}"


@SLURM
def test_a_job_array(tmp_path: Path, table: bytes, cluster: dict[str, str]) -> None:
    run(["sbatch", "--wait", str(RECIPES / "array.sh"), str(STUDY), "result"], tmp_path, cluster)
    run(["planemotion", "merge", str(STUDY), "--out", "result"], tmp_path, cluster)
    assert (tmp_path / "result/sphere_over_bars.csv").read_bytes() == table
    assert len(list(tmp_path.glob("shard-*.log"))) == 4


@SLURM
def test_submitit_on_slurm(tmp_path: Path, table: bytes, cluster: dict[str, str]) -> None:
    pytest.importorskip("submitit")
    program = str(RECIPES / "submitit_shards.py")
    run([sys.executable, program, str(STUDY), str(tmp_path / "result"), "3", "slurm"], tmp_path, cluster)
    assert (tmp_path / "result/sphere_over_bars.csv").read_bytes() == table


def test_snakemake(tmp_path: Path, table: bytes) -> None:
    pytest.importorskip("snakemake")
    shutil.copy(RECIPES / "Snakefile", tmp_path)
    given = [f"study={STUDY}", f"out={tmp_path / 'result'}", "id=sphere_over_bars", "shards=3"]
    command = [sys.executable, "-m", "snakemake", "--cores", "2", "--config", *given]
    run(command, tmp_path, with_programs(dict(os.environ)))
    assert (tmp_path / "result/sphere_over_bars.csv").read_bytes() == table

"""Sweeps over what changes how many parts there are: the bits of single runs, wherever they are computed."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import planemotion as pm
from tests.scenes.chain import chain

CHAIN = chain("0.2 s", '[sweep]\nL = ["0.5 m", "0.7 m", "1 m"]\nn = [4, 2, 3]')


def same(made: Any) -> None:
    scene = pm.load_text(CHAIN)
    for i, length in enumerate((0.5, 0.7, 1.0)):
        for j, n in enumerate((4, 2, 3)):
            one = scene.with_values({"L": f"{length} m", "n": n}).run()
            case = made.isel(L=i, n=j)
            assert float(case["tip"]) == one["tip"]
            for k in range(1, 5):
                wanted = one[f"angle[{k}]"] if k <= n else np.nan
                np.testing.assert_equal(float(case[f"angle[{k}]"]), wanted)
                place = list(made["ask"].values).index(f"angle[{k}]")
                assert int(case["reason"][place]) == (0 if k <= n else 1)


def test_each_case_has_the_bits_of_its_run() -> None:
    same(pm.load_text(CHAIN).sweep())


def test_any_executor_gives_the_same() -> None:
    with ProcessPoolExecutor(2) as pool:
        same(pm.load_text(CHAIN).sweep(executor=pool))


def test_files_and_shards_hold_the_same(tmp_path: Path) -> None:
    import xarray as xr

    scene = pm.load_text(CHAIN)
    for number in (1, 2):
        scene.sweep_shard(number, 2, out=tmp_path)
    scene.sweep(out=tmp_path, resume=True)
    (result,) = tmp_path.glob("*.h5")
    with xr.open_dataset(result, engine="h5netcdf") as made:
        same(made.load())


def test_n_may_be_zipped_with_a_parameter() -> None:
    text = CHAIN.replace("n = [4, 2, 3]", 'n = [4, 2, 3]\nzip = [["L", "n"]]')
    made = pm.load_text(text).sweep()
    one = pm.load_text(CHAIN).with_values({"L": "0.7 m", "n": 2}).run()
    assert made["tip"].shape == (3,)
    assert float(made["tip"][1]) == one["tip"]


def test_too_many_variants_are_refused() -> None:
    text = CHAIN.replace("n = [4, 2, 3]", "n = { from = 1, to = 2000, num = 2000 }")
    with pytest.raises(
        pm.SceneError, match=r"sweep\.n: 2000 scenes that differ in what there is; at most 1000"
    ):
        pm.load_text(text).sweep()

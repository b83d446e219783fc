"""A set: what is in it, read lazily and streamed, checked, exported."""

from __future__ import annotations

import importlib
import json
import os
import pickle
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.experiments.loop import Progress
from beardyn_core.population.batch import Array, Made, run_batch
from beardyn_core.population.data_card import card_text
from beardyn_core.population.draw import rows_of
from beardyn_core.population.features import NAMES, VERDICT
from beardyn_core.population.finalizing import verify
from beardyn_core.population.folder import read_about
from beardyn_core.population.signal_store import SignalStore
from beardyn_core.population.table import write_table
from test.population.sweeps import planned


def test_a_set_is_what_the_runs_are(made: tuple[Path, list[Progress]]) -> None:
    """Signals, labels and features against a simulation of the same scene here."""
    folder, _ = made
    runs, plan = bd.open_set(folder), planned()
    assert len(runs) == 6
    row = rows_of(plan.sweep)[1]
    alone = bd.simulate(plan.scene(row))
    np.testing.assert_array_equal(
        runs.arrays["vibration"][1], alone.vibration.values.astype(np.float32), strict=True
    )
    np.testing.assert_array_equal(runs.arrays["shaft_angle"][1], alone.shaft.angle)
    np.testing.assert_allclose(runs.signals.time_vibration, alone.vibration.time)
    own = runs.table.iloc[1]
    assert own["condition"] == alone.labels["condition"]
    assert own["bearing_kind"] == "tapered"
    assert own["load_fz_N_mean"] == pytest.approx(alone.labels["load_fz_N_mean"])
    assert own["status"] == "complete"
    assert runs.units["load_fz_N_mean"] == "N"
    assert runs.units["defects[0].width_mm"] == "mm"
    assert list(runs.features.columns) == ["run", *NAMES, VERDICT]
    assert runs.table["bearing_id"].nunique() == 6


def test_signals_are_read_when_they_are_asked_for(made: tuple[Path, list[Progress]]) -> None:
    signals = bd.open_set(made[0]).signals
    assert signals.vibration.dims == ("run", "time_vibration", "axis")
    assert not signals.vibration.variable._in_memory
    assert signals.vibration.attrs["units"] == "m/s^2"
    one = signals.vibration.sel(run=2, axis="z")
    assert one.shape == (signals.sizes["time_vibration"],)
    assert float(np.abs(one).max()) > 0.1


def test_batches_give_every_run_of_a_part_once_in_another_order_each_time(
    made: tuple[Path, list[Progress]],
) -> None:
    runs = bd.open_set(made[0])
    orders = []
    for seed in range(8):
        found: list[int] = []
        for batch in runs.batches(2, part=None, labels=("condition", "kurtosis"), seed=seed, buffer=3):
            assert batch["vibration"].shape[0] == len(batch["run"]) <= 2
            np.testing.assert_array_equal(batch["condition"], runs.table["condition"][batch["run"]])
            for run, received in zip(batch["run"], batch["vibration"], strict=True):
                np.testing.assert_array_equal(received, runs.arrays["vibration"][int(run)])
            found += batch["run"].tolist()
        assert sorted(found) == list(range(6))
        orders.append(tuple(found))
    assert len(set(orders)) > 1
    shared = [batch["run"] for k in (0, 1) for batch in runs.batches(2, part=None, share=(k, 2))]
    assert sorted(np.concatenate(shared)) == list(range(6))
    with pytest.raises(InputError, match="no signal 'vibratoin'"):
        next(runs.batches(signals=("vibratoin",)))
    with pytest.raises(InputError, match="no label 'condtion'"):
        next(runs.batches(labels=("condtion",)))


def test_a_torch_dataset_has_the_runs_of_its_part(made: tuple[Path, list[Progress]]) -> None:
    torch = pytest.importorskip("torch")
    runs = bd.open_set(made[0])
    every = runs.torch(None, labels=("condition", "load_fz_N_mean"))
    assert len(every) == 6
    signals, labels = every[1]
    assert torch.is_tensor(signals["vibration"])
    np.testing.assert_array_equal(signals["vibration"].numpy(), runs.arrays["vibration"][1])
    assert every.classes == {"condition": ["cup", "healthy"]}
    assert every.classes["condition"][int(labels["condition"])] == runs.table["condition"][1]
    assert sum(len(runs.torch(part)) for part in ("train", "validation", "test")) == 6
    loader = torch.utils.data.DataLoader(every.stream(buffer=4), batch_size=2)
    assert sum(len(batch["condition"]) for _, batch in loader) == 6
    assert len(pickle.loads(pickle.dumps(every))) == 6


def test_progress_tells_runs_rate_failures_and_the_dashboard(made: tuple[Path, list[Progress]]) -> None:
    _, told = made
    assert [each.done for each in told] == [0, 2, 4, 6]
    assert all(each.workers == 2 for each in told)
    assert told[-1].rate == pytest.approx(6 / told[-1].seconds)
    assert told[-1].remaining == 0.0


def test_the_card_says_what_how_and_for_what_not(made: tuple[Path, list[Progress]]) -> None:
    card = (made[0] / "README.md").read_text()
    for said in (
        "6 simulated runs of 6 axlebox bearings",
        "CC-BY-4.0",
        "beardyn",
        "| seed | 1 |",
        "Known limits",
        "model of a double-row tapered roller bearing in an axlebox",
    ):
        assert said in card
    assert "defects[0].width_mm` | mm" in card


def test_a_changed_missing_or_new_file_is_found(made: tuple[Path, list[Progress]], tmp_path: Path) -> None:
    folder = tmp_path / "copy"
    shutil.copytree(made[0], folder)
    assert verify(folder) == []
    (folder / "runs.parquet").write_bytes((folder / "runs.parquet").read_bytes()[:-1] + b"x")
    (folder / "features.parquet").unlink()
    (folder / "signals.zarr" / "more").write_text("x")
    told = "\n".join(verify(folder))
    assert "runs.parquet: is not what it was" in told
    assert "features.parquet: is missing" in told
    assert "more: was not there" in told
    with pytest.raises(InputError, match="is no set of runs"):
        verify(tmp_path)


@pytest.mark.parametrize("ending", [".h5", ".npz", ".parquet"])
def test_a_set_is_exported_whole_to_one_file(
    ending: str, made: tuple[Path, list[Progress]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    runs, path = bd.open_set(made[0]), tmp_path / f"set{ending}"
    words = ["export", str(made[0]), "-o", str(path), "--signals", "vibration"]
    assert command.main(words) == command.DONE
    wanted, conditions = runs.arrays["vibration"][:], runs.table["condition"].tolist()
    if ending == ".h5":
        with importlib.import_module("h5py").File(path) as file:
            found, labels = file["vibration"][:], [each.decode() for each in file["labels/condition"]]
            assert file["vibration"].attrs["units"] == "m/s^2"
    elif ending == ".npz":
        with np.load(path) as file:
            found, labels = file["vibration"], file["label_condition"].tolist()
    else:
        table = importlib.import_module("pyarrow.parquet").read_table(path)
        samples = np.stack(table["vibration"].to_numpy())
        found = np.moveaxis(samples.reshape(6, 3, -1), 2, 1)
        labels = table["condition"].to_pylist()
    np.testing.assert_array_equal(found, wanted)
    assert labels == conditions
    assert command.main(words) == command.BAD_INPUT
    assert command.main(["export", str(made[0]), "-o", str(tmp_path / "x.wav")]) == command.BAD_INPUT
    assert "a set is written as" in capsys.readouterr().err


def wide_set(folder: Path, count: int) -> None:
    """A set of noise, 0.6 MB a run, that does not pack."""
    random = np.random.default_rng(0)
    folder.mkdir()
    store = SignalStore(folder, count, 8)
    about = {"vibration": Array(np.empty((0, 3), np.float32), ("axis",), "m/s^2", "vibration")}
    times = {"vibration": np.arange(51_200) * 39_062}
    for first in range(0, count, 8):
        made = [
            Made(run, {}, {}, {"vibration": random.random((51_200, 3), np.float32)}, 0.0)
            for run in range(first, min(first + 8, count))
        ]
        store.write([replace(made[0], shapes=about, times=times), *made[1:]])
    rows = [{"run": run, "split": "train", "status": "complete", "condition": "cup"} for run in range(count)]
    write_table(folder / "runs.parquet", rows, {}, {})
    write_table(folder / "features.parquet", [{"run": run} for run in range(count)], {}, {})
    (folder / "set.json").write_text(json.dumps({"format": 1, "sweep": "wide", "parts": {}, "failed": 0}))


STREAMS = """
import resource, sys
import beardyn_core as bd

runs = bd.open_set(sys.argv[1])
runs.table, runs.features, runs.arrays["vibration"][0]  # libraries are loaded
used = 1024 * int(open("/proc/self/status").read().split("VmData:")[1].split()[0])
resource.setrlimit(resource.RLIMIT_DATA, (used + int(sys.argv[2]), -1))
seen = sum(len(batch["run"]) for batch in runs.batches(8, buffer=16))
try:
    runs.arrays["vibration"][:]
    print(seen, "fits")
except MemoryError:
    print(seen, "does not fit")
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="limits of memory are those of Linux")
def test_a_set_bigger_than_the_memory_streams_where_it_cannot_be_loaded(tmp_path: Path) -> None:
    """250 MB of signals in a process that may take 200 MB more than it has, stacks of threads included."""
    wide_set(tmp_path / "set", 400)
    words = [sys.executable, "-c", STREAMS, str(tmp_path / "set"), "200000000"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(words, env=environment, capture_output=True, text=True)
    assert done.stdout == "400 does not fit\n", done.stderr


@pytest.mark.parametrize(
    ("kinds", "words"),
    [
        (["tapered"], "of a double-row tapered roller bearing in"),
        (["cylindrical"], "of a pair of cylindrical roller bearings in"),
        (["spherical"], "of a spherical roller bearing in"),
        (
            ["cylindrical", "tapered"],
            "of a double-row tapered roller bearing or a pair of cylindrical roller bearings in",
        ),
    ],
)
def test_the_card_names_the_kinds_of_bearing_of_the_set(
    made: tuple[Path, list[Progress]], kinds: list[str], words: str
) -> None:
    about = read_about(made[0])
    rows = [
        {"bearing_id": f"b{k}", "condition": "cup", "bearing_kind": kinds[k % len(kinds)]} for k in range(4)
    ]
    given = {"run": 5, "bearing_id": "", "condition": None}  # gave up before it had a scene
    assert f"by a model {words} an axlebox." in card_text(planned(), about, [*rows, given])


@pytest.mark.slow  # kernels of pairs and of barrels are compiled
@pytest.mark.parametrize("kind", ["cylindrical", "spherical"])
def test_a_run_of_another_kind_is_labelled_so_with_its_own_play(kind: str) -> None:
    plan = planned(
        scene=f"freight_{kind}", runs=1,
        vary=[{"key": "bearing.radial_clearance_mm", "kind": "uniform", "low": 0.11, "high": 0.12}],
        set={"tier": "lumped", "effects": "standard", "duration_s": 0.05},
    )  # fmt: skip
    row = rows_of(plan.sweep)[0]
    (made,) = run_batch([row], plan)
    assert (made.labels["status"], made.labels["bearing_kind"]) == ("complete", kind)
    assert 1.1e-4 < made.labels["radial_clearance_m"] < 1.2e-4
    assert (made.labels["end_play_m"] is None) is (kind == "spherical")

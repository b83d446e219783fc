"""Sweeps from file to set: mistakes before anything runs, the same bits whoever runs them, nothing lost."""

from __future__ import annotations

import importlib
import json
import os
import pickle
import shutil
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest

import beardyn_core as bd
from beardyn_core.cli import main as command
from beardyn_core.config import read_sweep, scene_text
from beardyn_core.engine import Cluster
from beardyn_core.engine.cluster import LocalCluster
from beardyn_core.errors import InputError
from beardyn_core.population import sweeping
from beardyn_core.population.batch import run_batch
from beardyn_core.population.closing import verify
from beardyn_core.population.draw import rows_of
from beardyn_core.population.features import NAMES
from beardyn_core.population.folder import JOURNAL, done_rows
from beardyn_core.population.plan import Plan, plan_of
from beardyn_core.population.sweeping import Progress, Swept, conduct
from test.population.sweeps import TINY, tiny

WHOLE = ("runs.parquet", "features.parquet")


def planned(**changes: Any) -> Plan:
    return plan_of(*read_sweep(tiny(**changes)))


@pytest.fixture(scope="module")
def local() -> Iterator[LocalCluster]:
    """A scheduler with two workers that the tests of this file share, as another machine's would be."""
    started = LocalCluster(2, None)
    yield started
    started.close()


@pytest.fixture(scope="module")
def cluster(local: LocalCluster) -> Cluster:
    return Cluster(scheduler=local.address, patience=60.0)


@pytest.fixture(scope="module")
def made(cluster: Cluster, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Progress]]:
    """The tiny set, and what was told while it was made."""
    folder, told = tmp_path_factory.mktemp("set") / "tiny", list[Progress]()
    conduct(planned(), folder, cluster, report=told.append)
    return folder, told


def content(folder: Path) -> dict[str, bytes]:
    """Bytes of tables and signals."""
    files = [folder / name for name in WHOLE] + [
        p for p in (folder / "signals.zarr").rglob("*") if p.is_file()
    ]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


# --- before anything runs


def test_mistakes_name_the_file_and_the_key_and_how_many_runs_have_them(tmp_path: Path) -> None:
    wrong = tiny(
        vary=[
            *TINY["vary"],
            {"key": "end_play_mm", "kind": "uniform", "low": 1, "high": 3},
            {"key": "temprature_C", "kind": "choice", "one_of": [20]},
        ]
    )
    with pytest.raises(InputError) as refused:
        bd.sweep(wrong, tmp_path / "set")
    told = str(refused.value)
    assert "end_play_mm is " in told
    assert "it must be at most 2 (and " in told
    assert "sweep: run 0: temprature_C" in told
    assert "unknown key" in told
    assert not (tmp_path / "set").exists()


def test_mistakes_in_what_is_set_are_those_of_the_sweep() -> None:
    for key, value, mistake in (
        ("tier", "lumpd", "sweep: set.tier is 'lumpd'"),
        ("defects[3].width_mm", 2, "set.defects[3].width_mm: the scene has no such entry"),
        (
            "operation.speed_profile[0].speed_kmh",
            "fast",
            "sweep: set.operation.speed_profile[0].speed_kmh is",
        ),
    ):
        with pytest.raises(InputError) as refused:
            planned(set={**TINY["set"], key: value})
        assert mistake in str(refused.value)
    with pytest.raises(InputError, match="there is no scene 'smoth_run'"):
        planned(scene="smoth_run")


def test_a_signal_that_no_run_has_is_a_mistake() -> None:
    with pytest.raises(InputError, match=r"sweep: signals\[1\] is 'vibratoin'; allowed are vibration, force"):
        planned(signals=["force", "vibratoin"])


def test_a_key_that_no_run_has_is_a_mistake() -> None:
    with pytest.raises(InputError, match=r"waviness\[0\].order.*no run has such an entry"):
        planned(vary=[*TINY["vary"], {"key": "waviness[0].order", "kind": "choice", "one_of": [3]}])


def test_signals_of_different_lengths_and_runs_of_one_bearing_are_refused() -> None:
    with pytest.raises(InputError, match="duration_s is"):
        planned(vary=[*TINY["vary"], {"key": "duration_s", "kind": "choice", "one_of": [0.2, 0.4]}])
    without = {key: value for key, value in TINY["set"].items() if key != "scatter"}
    with pytest.raises(InputError, match="one and the same bearing"):
        planned(set=without, vary=TINY["vary"][3:])


def test_each_run_is_the_scene_that_its_values_say() -> None:
    plan = planned()
    rows = rows_of(plan.sweep)
    scenes = [plan.scene(row) for row in rows]
    for row, scene in zip(rows, scenes, strict=True):
        values = plan.keys(row)[1]
        assert scene.seed == row.seed
        assert scene.scatter is not None
        assert scene.scatter.seed == row.lot
        assert scene.operation.speed_profile[0].speed * 3.6 == pytest.approx(  # type: ignore[union-attr]
            values["operation.speed_profile[0].speed_kmh"]
        )
        if scene.defects:
            (spall,) = scene.defects
            assert 1e3 * spall.width == pytest.approx(values["defects[0].width_mm"])  # type: ignore[union-attr]
            assert spall.length == pytest.approx(2.0 * spall.width, rel=1e-5)  # type: ignore[union-attr]
        else:
            assert values["defects[0].width_mm"] is None
    assert {bool(scene.defects) for scene in scenes} == {True, False}


@pytest.mark.slow
def test_what_a_scene_leaves_open_is_chosen_once_for_all_runs() -> None:
    """Else a learner would tell a spall by the effects that its run was computed with."""
    plan = planned(set={**TINY["set"], "effects": {"preset": "auto"}, "tier": "lumped"})
    scenes = [plan.scene(row) for row in rows_of(plan.sweep)]
    assert len({repr(scene.effects) for scene in scenes}) == 1
    assert len({scene.numerics for scene in scenes}) == 1
    assert plan.chosen
    assert all(scene.chosen == plan.chosen for scene in scenes)


# --- the set


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
    assert own["load_fz_N_mean"] == pytest.approx(alone.labels["load_fz_N_mean"])
    assert own["status"] == "complete"
    assert runs.units["load_fz_N_mean"] == "N"
    assert runs.units["defects[0].width_mm"] == "mm"
    assert list(runs.features.columns) == ["run", *NAMES]
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
            for run, heard in zip(batch["run"], batch["vibration"], strict=True):
                np.testing.assert_array_equal(heard, runs.arrays["vibration"][int(run)])
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


# --- interrupted, killed, taken up again


def test_the_same_bits_come_from_this_process_and_from_two_workers(made: tuple[Path, list[Progress]]) -> None:
    plan, runs = planned(), bd.open_set(made[0])
    batch = run_batch(tuple(rows_of(plan.sweep)[3:6]), plan)  # other tasks than those of the set
    for each in batch.made:
        for name, values in each.arrays.items():
            np.testing.assert_array_equal(runs.arrays[name][each.run], values, strict=True)
        own = runs.table.iloc[each.run]
        plain = {name: value for name, value in each.labels.items() if isinstance(value, int | float | str)}
        assert len(plain) > 30
        assert {name: own[name] for name in plain} == plain


def test_a_sweep_that_was_stopped_goes_on_and_makes_the_same_set(
    made: tuple[Path, list[Progress]], cluster: Cluster, tmp_path: Path
) -> None:
    folder = tmp_path / "set"

    def stop(now: Progress) -> None:
        if now.done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        conduct(planned(), folder, cluster, report=stop)
    assert len(done_rows(folder)) == 2
    with pytest.raises(InputError, match="the same command goes on"):
        bd.open_set(folder)
    with (folder / JOURNAL).open("a") as journal:
        journal.write('{"made": [{"labels": {"run": 5')  # cut off by a crash
    told: list[Progress] = []
    swept = conduct(planned(), folder, cluster, report=told.append)
    assert (swept.here, swept.done, swept.complete) == (4, 6, True)
    assert told[0].done == 2
    assert content(folder) == content(made[0])
    assert conduct(planned(), folder, cluster).here == 0


def test_more_runs_continue_a_set(
    made: tuple[Path, list[Progress]], cluster: Cluster, tmp_path: Path
) -> None:
    folder = tmp_path / "set"
    assert conduct(planned(runs=3), folder, cluster).done == 3
    swept = conduct(planned(runs=6), folder, cluster)
    assert (swept.here, swept.done) == (3, 6)
    assert content(folder) == content(made[0])
    with pytest.raises(InputError, match="ask for as many or more"):
        conduct(planned(runs=3), folder, cluster)


def test_the_folder_of_another_sweep_or_of_other_code_is_refused_and_stays(
    made: tuple[Path, list[Progress]], cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "set"
    shutil.copytree(made[0], folder)
    before = content(folder)
    with pytest.raises(InputError, match=r"its 6 runs are of another sweep \(seed differ\)"):
        conduct(planned(seed=2), folder, cluster)
    monkeypatch.setattr("beardyn_core.population.folder.simulator_digest", lambda: "edited")
    with pytest.raises(InputError, match="of other code"):
        conduct(planned(), folder, cluster)
    monkeypatch.undo()
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "letter.txt").write_text("mine")
    with pytest.raises(InputError, match="holds files and no set"):
        conduct(planned(), tmp_path / "full", cluster, force=True)
    assert content(folder) == before
    assert conduct(planned(seed=2, runs=1), folder, cluster, force=True).done == 1


def test_a_run_that_fails_is_a_row_with_its_sentence(cluster: Cluster, tmp_path: Path) -> None:
    """A measurement that is shorter than the run; its neighbours in the same task are whole."""
    (tmp_path / "short.csv").write_text(
        "time_s,speed_rpm,fx_N,fy_N,fz_N\n0,1000,0,0,80000\n0.05,1000,0,0,80000\n"
    )
    steady = {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 1000}
    short = {"kind": "csv", "path": str(tmp_path / "short.csv")}
    changing = {"key": "operation", "kind": "choice", "one_of": [steady, short]}
    swept = conduct(planned(vary=[changing, TINY["vary"][0]], runs=4), tmp_path / "set", cluster)
    runs = bd.open_set(tmp_path / "set")
    failed = runs.table[runs.table["status"] == "failed"]
    assert len(failed) == swept.failed == 2
    assert failed["reason"].str.contains("short.csv").all()
    assert np.isnan(runs.arrays["vibration"][int(failed["run"].iloc[0])]).all()
    whole = runs.runs_of()
    assert len(whole) == 2
    assert all(np.isfinite(runs.arrays["vibration"][int(run)]).all() for run in whole)
    assert f"{len(failed)} failed" in (tmp_path / "set" / "README.md").read_text()


def test_a_killed_worker_costs_nothing(
    made: tuple[Path, list[Progress]], cluster: Cluster, local: LocalCluster, tmp_path: Path
) -> None:
    killed: list[int] = []

    def kill(now: Progress) -> None:
        if now.done == 2 and not killed:
            workers = psutil.Process(local.process_id).children(recursive=True)
            killed.append(next(each.pid for each in workers if "spawn_main" in " ".join(each.cmdline())))
            os.kill(killed[0], signal.SIGKILL)

    assert conduct(planned(), tmp_path / "set", cluster, report=kill).complete
    assert killed
    assert content(tmp_path / "set") == content(made[0])


@pytest.mark.slow
def test_a_killed_scheduler_costs_nothing_that_was_finished(
    made: tuple[Path, list[Progress]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of this machine: it is started anew, and the sweep goes on by itself."""
    started: list[LocalCluster] = []
    make = LocalCluster.__init__

    def noted(one: LocalCluster, workers: int, memory: float | None) -> None:
        make(one, workers, memory)
        started.append(one)

    def kill(now: Progress) -> None:
        if now.done == 2 and len(started) == 1:
            os.kill(started[0].process_id, signal.SIGKILL)

    monkeypatch.setattr(LocalCluster, "__init__", noted)
    said: list[str] = []
    swept = conduct(planned(), tmp_path / "set", Cluster(workers=2), report=kill, say=said.append)
    assert swept.complete
    assert len(started) == 2
    assert "the scheduler has died" in said[0]
    assert content(tmp_path / "set") == content(made[0])


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2, 8])
def test_any_number_of_workers_makes_the_same_bits(
    workers: int, made: tuple[Path, list[Progress]], tmp_path: Path
) -> None:
    swept = conduct(planned(), tmp_path / "set", Cluster(workers=workers))
    assert swept.complete
    assert content(tmp_path / "set") == content(made[0])


def test_a_worker_of_other_code_is_refused(
    cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sweeping, "simulator_digest", lambda: "mine")
    with pytest.raises(InputError, match="install the same version on every machine"):
        conduct(planned(runs=2), tmp_path / "set", cluster)


def test_a_sweep_stops_when_its_time_is_over(cluster: Cluster, tmp_path: Path) -> None:
    swept: Swept = conduct(planned(hours=1e-9), tmp_path / "set", cluster)
    assert not swept.complete
    assert swept.done < 6


def test_a_base_scene_may_come_from_anywhere(tmp_path: Path) -> None:
    """A file of one's own, beside the sweep."""
    (tmp_path / "mine.yaml").write_text(scene_text(planned().scene(rows_of(planned().sweep)[0])))
    (tmp_path / "own.yaml").write_text(json.dumps({**TINY, "scene": "mine.yaml", "set": {}, "runs": 2}))
    plan = plan_of(*read_sweep(tmp_path / "own.yaml"))
    assert plan.scene(rows_of(plan.sweep)[1]).tier == "lumped"

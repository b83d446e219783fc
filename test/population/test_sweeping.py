"""Sweeps from file to set: the same bits whoever runs them, interrupted or killed, nothing lost."""

from __future__ import annotations

import os
import shutil
import signal
from pathlib import Path

import numpy as np
import psutil
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.experiments import Cluster
from beardyn_core.experiments.cluster import LocalCluster
from beardyn_core.experiments.loop import Progress
from beardyn_core.population import folder as folder_module
from beardyn_core.population.batch import run_batch
from beardyn_core.population.draw import rows_of
from beardyn_core.population.folder import JOURNAL, done_rows
from beardyn_core.population.sweeping import Swept, conduct
from test.population.sweeps import TINY, content, planned


@pytest.mark.slow
def test_the_same_bits_come_from_this_process_and_from_two_workers(made: tuple[Path, list[Progress]]) -> None:
    plan, runs = planned(), bd.open_set(made[0])
    batch = run_batch(tuple(rows_of(plan.sweep)[3:6]), plan)  # other tasks than those of the set
    for each in batch:
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


@pytest.mark.slow  # effects are chosen for six kinds of runs
def test_what_is_chosen_for_a_set_does_not_depend_on_how_many_runs_it_has() -> None:
    """The extremes of two runs are others than those of twelve, and need other laminae."""
    free = {**TINY["set"], "effects": "auto", "tier": "quasistatic"}
    few, many = (planned(set=free, runs=runs) for runs in (2, 12))
    assert few.chosen
    assert few.identity == many.identity


def test_another_number_of_draws_that_do_not_continue_is_refused_in_its_own_words(
    cluster: Cluster, tmp_path: Path
) -> None:
    folder = tmp_path / "set"
    conduct(planned(sampling="latin_hypercube", runs=2), folder, cluster)
    told = r"is a set of 2 runs, and 4 are asked for; sampling latin_hypercube draws other runs"
    with pytest.raises(InputError, match=told):
        conduct(planned(sampling="latin_hypercube", runs=4), folder, cluster)


def test_the_folder_of_another_sweep_or_of_other_code_is_refused_and_stays(
    made: tuple[Path, list[Progress]], cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "set"
    shutil.copytree(made[0], folder)
    before = content(folder)
    with pytest.raises(InputError, match=r"its 6 runs are of another sweep \(different: seed\)"):
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
    assert any("the scheduler has died" in each for each in said)
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
    monkeypatch.setattr(folder_module, "simulator_digest", lambda: "mine")
    with pytest.raises(InputError, match="install the same version on every machine"):
        conduct(planned(runs=2), tmp_path / "set", cluster)


def test_a_sweep_stops_when_its_time_is_over(cluster: Cluster, tmp_path: Path) -> None:
    swept: Swept = conduct(planned(hours=1e-9), tmp_path / "set", cluster)
    assert not swept.complete
    assert swept.done < 6

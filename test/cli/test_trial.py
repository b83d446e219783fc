"""`beardyn trial` and `beardyn monitor`: bad input, what they print and write."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from beardyn_core.cli import main as command
from beardyn_core.scene.trial import Cell, Trial
from beardyn_core.study import trial as trial_module
from beardyn_core.study.trial import TrialRun


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Runs that were conducted, with a stand-in that finds every fault; stops where told."""
    seen: list[str] = []

    def stand_in(trial: Trial, cell: Cell, algorithm: str, digest: str) -> TrialRun:
        if len(seen) == 7:
            seen.append("stopped")
            raise KeyboardInterrupt
        seen.append(cell.key)
        found = cell.fault != "none"
        verdict = cell.fault if found else "healthy"
        return TrialRun(cell.key, digest, verdict, 3, 3 * found, (9.0,) * 3, 4.0, 19.0, "complete", 0.1)

    monkeypatch.setattr(trial_module, "conduct_run", stand_in)
    monkeypatch.setattr(trial_module.Twin, "warm", lambda _twin: 0.0)
    return seen


def test_every_mistake_is_told_at_once_and_nothing_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], runs: list[str]
) -> None:
    words = ["trial", "quick", "--tier", "fast", "--jobs", "0", "-o", str(tmp_path / "missing" / "out")]
    assert command.main(words) == command.BAD_INPUT
    told = capsys.readouterr()
    for mistake in ("'fast'", "--jobs 0", "does not exist"):
        assert mistake in told.err
    assert command.main(["trial", "quick", "--monitor", "nowhere:chain"]) == command.BAD_INPUT
    assert "no module nowhere" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
    assert not runs


def test_a_trial_is_stopped_taken_up_and_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], runs: list[str]
) -> None:
    words = ["trial", "quick", "--jobs", "1", "--json", "-o", str(tmp_path)]
    assert command.main(words) == command.INTERRUPTED
    told = capsys.readouterr()
    assert "interrupted; 7 of 51 runs are done; the same command goes on" in told.err
    assert json.loads((tmp_path / "trial.json").read_text())["complete"] is False
    assert not (tmp_path / "trial.png").exists()
    (tmp_path / "notes.txt").write_text("mine")  # the folder is the trial's all the same
    assert command.main(words) == command.DONE
    told = capsys.readouterr()
    assert "7 of 51 runs were done before" in told.err
    found = json.loads(told.out)
    assert found == json.loads((tmp_path / "trial.json").read_text())
    assert len(set(runs)) == len(runs) == 52
    assert found["slices"][0]["found"]["rate"] == 1.0
    assert found["slices"][0]["false_alarms"]["count"] == 0
    assert (tmp_path / "trial.png").stat().st_size > 10_000


def test_a_file_that_is_no_recording_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "run.mcap"
    path.write_text("nothing")
    assert command.main(["monitor", str(path)]) == command.BAD_INPUT
    assert str(path) in capsys.readouterr().err

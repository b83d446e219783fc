"""What effects were chosen for is said by the summary of a run and by the report on its recording."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from beardyn_core.choice import load_scene
from beardyn_core.cli.main import main
from beardyn_core.cli.simulate import text
from beardyn_core.record.sinks import McapSink
from beardyn_core.study import desk_run

SENTENCE = (
    "chosen for force within 5 %; differs from the full model by at most (bounds) force 1.2 %; left out: seal"
)


@pytest.mark.parametrize("chosen", [(SENTENCE, "seal off: 0.1 N m"), ()])
def test_summary_and_report_say_what_effects_were_chosen_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], chosen: tuple[str, ...]
) -> None:
    scene = replace(load_scene("cup_spall", tier="quasistatic", duration=0.06), chosen=chosen)
    recording = tmp_path / "run.mcap"
    summary = desk_run.run(scene, [McapSink(recording)])
    assert summary.chosen == (SENTENCE if chosen else "")
    assert main(["report", str(recording)]) == 0
    assert (SENTENCE in text(summary, recording, verbose=True)) == bool(chosen)
    shown = capsys.readouterr().out
    assert ("accuracy within 5 % of the full model; without seal\n" in shown) == bool(chosen)

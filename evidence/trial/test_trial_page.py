"""The page of the trial says what its runs found."""

from __future__ import annotations

import json

from beardyn_core.choice import load_trial
from beardyn_core.cli.json_output import json_text
from beardyn_core.study.trial_report import json_object
from beardyn_core.study.trial_result import TrialResult
from evidence.trial.page import page
from test.study.test_trial import run_of


def test_the_page_has_the_rates_of_the_runs() -> None:
    trial = load_trial("quick")
    cells = trial.cells()
    runs = [run_of(cell, cell.fault if cell.size > 3e-3 else "healthy") for cell in cells]
    found = json.loads(json_text("trial", json_object(TrialResult.of(trial, "", runs))))
    text = page(found)
    assert f"{found['run_count']} runs of 40 shaft revolutions in the tier `quasistatic`, seed 1" in text
    rows = [line for line in text.splitlines() if line.startswith("| cup |")]
    assert [row.split(" | ")[1:4] for row in rows] == [
        ["2", "0/3, 0 % (0 to 70.8)", "0"],
        ["6", "3/3, 100 % (29 to 100)", "0"],
        ["12", "3/3, 100 % (29 to 100)", "0"],
    ]
    assert "- cup: 6 mm (6 mm to beyond the largest)" in text
    assert "## `quasistatic` against `full`" in text
    assert "did not come to their end" not in text

"""The page of the trial says what its runs found."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from PIL import Image

from beardyn_core.choice import load_trial
from beardyn_core.cli.json_output import json_text
from beardyn_core.study.trial_report import json_object
from beardyn_core.study.trial_result import TrialResult
from evidence.trial import growth_picture
from evidence.trial.page import (
    MONITOR_PAGE,
    beside_others,
    monitor_page,
    other_trial,
    page,
    with_old_sections,
    with_section_of,
)
from evidence.trial.rivals import Judged, as_seldom, judge, orders, table
from evidence.trial.tiers import SPEEDS, TIERS, added, of_trial, scene_of
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
    assert "## `quick`" not in text


def test_the_page_of_the_monitor_has_its_settings() -> None:
    assert MONITOR_PAGE.read_text(encoding="utf-8") == monitor_page()


def test_what_grows_has_a_picture_and_a_column_for_each_surface(tmp_path: Path) -> None:
    trial = load_trial("growth")
    runs = [run_of(cell, cell.fault if cell.surface == "fine" else "healthy") for cell in trial.cells()]
    found = json.loads(json_text("trial", json_object(TrialResult.of(trial, "", runs))))
    section = other_trial(found)
    assert "(../pictures/growth.png)" in section
    assert "| cup | 0.6 | 6/6 | 0/6 | 0/6 |" in section
    growth_picture.draw(found, tmp_path / "growth.png")
    with Image.open(tmp_path / "growth.png") as picture:
        assert picture.size == (growth_picture.WIDTH_PX, growth_picture.HEIGHT_PX)


def test_sections_of_other_trials_are_put_in_replaced_and_kept() -> None:
    page = "# Trial\n\n## `quasistatic` against `full`\n\nchecked\n\n## Limits\n\nabout\n"
    one = with_section_of(page, "\n## `shapes`\n\none\n")
    assert one.index("checked") < one.index("## `shapes`\n\none\n\n## Limits")
    two = with_section_of(one, "## `shapes`\n\ntwo\n")
    assert two == one.replace("one", "two")
    assert with_old_sections(page, two) == two
    assert with_section_of(two, "") == two


def test_a_spall_adds_its_own_power() -> None:
    sound = np.array([0.0, 10.0, 3.0])
    spalled = 10.0 * np.log10(10.0 ** (0.1 * sound) + [1.0, 100.0, 0.0])
    found = added(spalled, sound)
    np.testing.assert_allclose(found[:2], [0.0, 20.0], atol=1e-12)


def test_tiers_are_compared_on_the_same_run_in_a_box_that_rings() -> None:
    trial = of_trial()
    full, fast = (scene_of(trial, tier, SPEEDS[0], spalled=True) for tier in TIERS)
    assert full.effects.structure is not None
    assert full.effects == fast.effects
    assert (full.seed, full.defects) == (fast.seed, fast.defects)


def _judged(method: str, run: str, fault: str, called: list[tuple[str, float]]) -> Judged:
    return judge(Judged(method, run, fault, "", 0, len(called), called), 0.0)


def test_the_rivals_are_counted_over_the_same_runs() -> None:
    quiet = [("healthy", -1.0)] * 4
    judged = [
        _judged("ours", "a", "cup", [("cup", 9.0)] * 4),
        _judged("ours", "b", "none", quiet),
        _judged("envelope", "a", "cup", [("cone", 9.0)] * 4),
        _judged("envelope", "b", "none", [("cup", 5.0), *quiet[:3]]),
        _judged("CPW", "a", "cup", [("cup", 9.0)] * 4),
        _judged("CPW", "b", "none", [("cup", 2.2), *quiet[:3]]),
    ]
    assert orders(judged) == (
        "Fewest false alarms first: ours, envelope, CPW. Fewest spalls missed first: ours, envelope, CPW."
    )
    rows = [row.split(" | ") for row in table(judged).splitlines()[2:]]
    assert [row[0].strip("| ") for row in rows] == [
        "ours",
        "envelope",
        "CPW",
        "CPW, threshold 2.5 dB higher",
    ]
    assert [row[1].split(",")[0] for row in rows] == ["1/1", "0/1", "1/1", "1/1"]
    assert [row[2:4] for row in rows] == [["0", "0"], ["1", "0"], ["0", "0"], ["0", "0"]]
    assert [row[5].split(",")[0] for row in rows] == ["0/4", "1/4", "1/4", "0/4"]
    # a page that is written without them keeps what it said of them
    bare = "# Trial\n\n## Limits\n\nabout\n"
    compared = with_section_of(bare, beside_others(judged))
    assert with_old_sections(bare, compared) == compared != bare


def test_a_threshold_is_raised_until_it_alarms_as_seldom_and_misses_what_is_below() -> None:
    loud = [("cup", 12.0)] * 3
    judged = [
        _judged("ours", "a", "none", [("healthy", -1.0)] * 3),
        _judged("CPW", "a", "none", [("cup", 6.4), ("healthy", -1.0), ("cup", 1.0)]),
        _judged("CPW", "b", "cup", [("cup", 3.0), ("cup", 5.0), ("cup", 12.0)]),
        _judged("CPW", "c", "cup", loud),
    ]
    raised, found = as_seldom(judged, "CPW", "ours")
    assert raised == 6.5
    assert [each.verdict for each in found] == ["healthy", "healthy", "cup"]

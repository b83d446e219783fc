"""The fast part of the hard battery; `make hard` runs all of it."""

from __future__ import annotations

import json
from contextlib import nullcontext
from dataclasses import asdict, fields, replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.plain_json import plain
from beardyn_core.config import load_bearing
from beardyn_core.experiments import ThisProcess
from beardyn_core.experiments.store import Entry, Store
from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX, Status
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from evidence.hard import __main__ as command
from evidence.hard import battery, run
from evidence.hard.battery import run_battery
from evidence.hard.case import RUN_AS, HardCase, Limit, steady
from evidence.hard.case_scene import load_of, merged, scene_of
from evidence.hard.catalogue import CASES
from evidence.hard.explicit_contact import hidden_chatter, largest_explicit_step, step_roller
from evidence.hard.refinement import changes, changes_of_runs
from evidence.hard.report import outcome_from, write_json
from evidence.hard.run import run_case
from evidence.hard.verdict import FAILED, GOOD, HOLDS, KNOWN, REPORTS, Finding, Outcome, judged, over_starts
from evidence.hard.watch import STATISTICS, Measures

# Transients need their whole time; what is steady shows itself in a few blocks.
SHORTEST_S = 0.16


def in_short(case: HardCase) -> HardCase:
    return replace(case, duration=min(case.duration, SHORTEST_S), refined=False)


@pytest.mark.parametrize("case", [case for case in CASES if case.fast], ids=lambda case: case.name)
def test_fast_case_passes(case: HardCase) -> None:
    outcome = run_case(in_short(case), starts=1)
    assert outcome.verdict in GOOD, outcome.reasons


def test_battery_has_at_least_forty_cases_each_with_its_own_name() -> None:
    assert len(CASES) >= 40
    assert len({case.name for case in CASES}) == len(CASES)


def test_every_limit_names_a_measure() -> None:
    names = {field.name for field in fields(Measures)}
    for case in CASES:
        assert {limit.measure for limit in case.all_limits} <= names, case.name


def test_every_way_of_running_is_used() -> None:
    assert {case.run_as for case in CASES} == set(RUN_AS)


def test_interrupted_long_case_goes_on_from_its_checkpoint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Interrupted after 5 of 8 blocks: the other 3 are run, and the measures are those of a straight run."""
    case = HardCase(
        "endless", "endurance", "", "", changes={"tier": "lumped"}, load=steady((0.0, 0.0, 8e4), 122.0),
        duration=0.16, refined=False, long=True,
    )  # fmt: skip
    straight = run_case(case, starts=1).measures
    monkeypatch.setattr(run, "CHECKPOINT_EVERY_S", 0.0)
    advance, advanced = Twin.advance, 0

    def interrupted(twin: Twin, blocks: int = 1) -> Block:
        nonlocal advanced
        advanced += 1
        if advanced == 6:
            raise KeyboardInterrupt
        return advance(twin, blocks)

    monkeypatch.setattr(Twin, "advance", interrupted)
    with pytest.raises(KeyboardInterrupt):
        run_case(case, tmp_path / "endless.checkpoint", starts=1)
    assert run_case(case, tmp_path / "endless.checkpoint", starts=1).measures == straight
    assert advanced == 6 + 3


def test_battery_keeps_what_is_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A refusal needs no kernel; the second time it is not run but read."""
    cases = [case for case in CASES if case.name == "sphere_beyond_apex"]
    told: list[Outcome] = []
    first = run_battery(cases, tmp_path, 1, lambda outcome, _there, _of: told.append(outcome))
    assert [outcome.verdict for outcome in first] == ["refused"]
    monkeypatch.setattr(battery, "Engine", None)
    again = run_battery(cases, tmp_path, 1, lambda outcome, _there, _of: told.append(outcome))
    assert repr(again) == repr(first)
    assert len(told) == 2


def test_only_what_is_to_be_done_again_is_forgotten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(battery, "Engine", lambda _cluster: nullcontext(ThisProcess()))
    cases = [case for case in CASES if case.run_as == "refused scene"][:2]
    run_battery(cases, tmp_path, 1, lambda *_: None)
    (tmp_path / f"{cases[0].name}-0.checkpoint").touch()
    battery.forget(cases[:1], tmp_path)
    plan = Store(tmp_path / battery.OUTCOMES, battery.LINES).resume(battery.plan_of(cases, tmp_path))
    assert plan.missing == (cases[0].name,)
    assert [path.name for path in tmp_path.iterdir()] == [battery.OUTCOMES]


def test_every_number_of_an_outcome_comes_back_from_the_folder(tmp_path: Path) -> None:
    outcome = judged(CASE, Finding(GOOD_MEASURES, changes(rows(5.0), rows(5.1))), 1.5)
    store = Store(tmp_path / battery.OUTCOMES, battery.LINES)
    plan = battery.plan_of([CASE], tmp_path)
    with store.opened(plan):
        store.add([Entry("steady", plan.digests["steady"], outcome)])
    again = store.resume(plan).kept["steady"]
    assert plain(asdict(again)) == plain(asdict(outcome))
    assert again.changes == outcome.changes


def test_results_of_an_earlier_version_stay_and_are_told_of(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    old = tmp_path / "sphere_beyond_apex-0123456789ab.outcome"
    old.write_bytes(b"pickled")

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "run_battery", interrupted)
    assert command.main(["sphere_beyond_apex", "--folder", str(tmp_path)]) == 130
    assert "1 results (*.outcome) are of an earlier version" in capsys.readouterr().err
    assert old.exists()


# --- finite is not stable


def test_explicit_steps_beyond_their_limit_stay_finite_with_the_right_mean_and_chatter() -> None:
    """2 us: half the cage's pull to 0.1 %, friction flipping by most of mu N, unseen at every second step."""
    bearing = load_bearing("HS130x230")
    assert 1e-6 < largest_explicit_step(bearing) < 2e-6
    run = step_roller(bearing, 2e-6)
    assert run.friction.mean() == pytest.approx(10.0, rel=1e-3)
    assert run.speed == pytest.approx(step_roller(bearing, 1e-7).speed, rel=1e-3)
    assert run.scatter() > 500.0
    assert run.scatter(stride=2) < 1e-6
    assert run.index > LARGEST_CHATTER_INDEX
    assert run.status == Status.CHATTER


@pytest.mark.parametrize(("method", "step"), [("explicit", 1e-7), ("explicit", 1e-6), ("implicit", 4e-5)])
def test_steps_within_their_limit_do_not_chatter(method: str, step: float) -> None:
    run = step_roller(load_bearing("HS130x230"), step, method)
    assert run.friction.mean() == pytest.approx(10.0, rel=1e-3)
    assert run.index < 1e-3
    assert run.status == Status.FINE


def test_table_of_hidden_chatter_crosses_the_limit() -> None:
    rows = hidden_chatter(load_bearing("HS130x230"))
    assert {Status(row.status) for row in rows} == {Status.FINE, Status.CHATTER}


# --- the judge: it must be able to say no

CASE = HardCase("steady", "load", "nothing", "nothing")
GOOD_MEASURES = Measures(simulated=0.2, energy_residual=1e-5, penetration=1e-5, chatter_index=0.01,
                         axis_error=0.0, quaternion_error=0.0, momentum_residual=1e-15)  # fmt: skip


def verdict_of(case: HardCase = CASE, sentence: str = "", **measures: object) -> str:
    return judged(case, Finding(replace(GOOD_MEASURES, **measures), sentence=sentence), 0.0).verdict  # type: ignore[arg-type]


def test_good_measures_hold() -> None:
    assert verdict_of() == HOLDS


@pytest.mark.parametrize(
    "measures",
    [
        {"energy_residual": 0.011}, {"energy_residual": float("nan")}, {"penetration": 2.1e-4},
        {"chatter_index": 0.3}, {"axis_error": 1e-9}, {"quaternion_error": 1e-9}, {"momentum_residual": 1e-6},
        {"finite": False}, {"status": int(Status.CHATTER)}, {"status": int(Status.NOT_FINITE)},
    ],
)  # fmt: skip
def test_each_measure_beyond_its_limit_fails(measures: dict[str, object]) -> None:
    assert verdict_of(**measures) == FAILED  # type: ignore[arg-type]


def test_sentence_that_is_missing_or_another_fails() -> None:
    case = replace(CASE, run_as="end", sentence="pressed more than")
    assert verdict_of(case) == FAILED
    assert verdict_of(case, sentence="a number became NaN") == FAILED
    assert verdict_of(case, sentence="a roller is pressed more than 200 um") == "ends"
    assert verdict_of(sentence="a roller is pressed more than 200 um") == FAILED


def test_report_that_is_asked_for_must_come() -> None:
    case = replace(CASE, must_report=Status.CHATTER)
    assert verdict_of(case) == FAILED
    assert verdict_of(case, status=int(Status.CHATTER), chatter_index=1.0) == REPORTS


def test_known_failure_is_not_called_a_pass() -> None:
    case = replace(CASE, known_failure="for a reason")
    assert verdict_of(case, energy_residual=0.5) == KNOWN
    assert verdict_of(case) == HOLDS


def started(*verdicts: str) -> Outcome:
    found = [
        Outcome("steady", verdict, ("a reason",) if verdict == FAILED else (), GOOD_MEASURES)
        for verdict in verdicts
    ]
    return over_starts(CASE, found, 1.0)


def test_a_verdict_that_a_nanometre_changes_is_a_failure() -> None:
    assert started(HOLDS, HOLDS, HOLDS).verdict == HOLDS
    one = started(HOLDS, HOLDS, FAILED, HOLDS)
    assert (one.verdict, one.starts, one.held) == (FAILED, 4, 3)
    assert one.reasons == ("begun 2 nm apart: a reason",)
    other = started(HOLDS, REPORTS)
    assert (other.verdict, other.reasons) == (FAILED, ("begun 1 nm apart: reports",))


def test_the_largest_measure_of_all_starts_is_shown() -> None:
    worse = replace(GOOD_MEASURES, energy_residual=2e-3)
    found = [Outcome("steady", HOLDS, (), GOOD_MEASURES), Outcome("steady", HOLDS, (), worse)]
    assert over_starts(CASE, found, 1.0).measures.energy_residual == 2e-3


def test_the_status_of_every_start_is_shown() -> None:
    chatters, ended = (
        Outcome("steady", REPORTS, (), replace(GOOD_MEASURES, status=int(bit)))
        for bit in (Status.CHATTER, Status.NOT_FINITE)
    )
    shown = over_starts(CASE, [chatters, ended], 1.0).measures
    assert shown.status == int(Status.CHATTER | Status.NOT_FINITE)


@pytest.mark.parametrize("name", ["pocket_clearance_2_mm", "axial_load_through_0.8_mm"])
def test_what_held_by_chance_holds_from_every_start(name: str) -> None:
    case = next(case for case in CASES if case.name == name)
    outcome = run_case(in_short(case))
    assert outcome.verdict == HOLDS, outcome.reasons
    assert outcome.held == outcome.starts == 5


def test_own_limit_replaces_the_usual_one() -> None:
    case = replace(CASE, limits=(Limit("energy_residual", high=1e-3),))
    assert verdict_of(case, energy_residual=5e-3) == FAILED


# --- half the step


def rows(torque: float, noise: float = 0.0, seed: int = 0) -> np.ndarray:
    found = np.tile([8e4, 1e4, torque, 52.0, 1e4], (12, 1))
    found[:, 2] += noise * np.random.default_rng(seed).standard_normal(12)
    return found


def torque_inside(found: tuple[object, ...]) -> bool:
    return bool(found[STATISTICS.index("torque")].inside)  # type: ignore[attr-defined]


def test_change_beyond_half_a_percent_is_outside_without_scatter() -> None:
    assert torque_inside(changes(rows(5.02), rows(5.0)))
    assert not torque_inside(changes(rows(5.03), rows(5.0)))


def test_scatter_between_blocks_excuses_no_more_than_five_percent() -> None:
    assert not torque_inside(changes(rows(5.6, 2.0, 1), rows(5.0, 2.0, 2)))


def test_band_between_runs_decides_for_several_runs() -> None:
    wide = [rows(torque) for torque in (4.0, 5.0, 6.0)]
    assert torque_inside(changes_of_runs(wide, [rows(torque) for torque in (4.4, 5.4, 6.4)]))
    narrow = [rows(torque) for torque in (4.99, 5.0, 5.01)]
    assert not torque_inside(changes_of_runs(narrow, [rows(torque) for torque in (5.39, 5.4, 5.41)]))


def test_runs_of_displaced_rollers_share_no_strike_and_runs_a_nanometre_apart_do() -> None:
    case = replace(next(case for case in CASES if case.name == "microload_1_N"), duration=0.02)
    torques: dict[bool, list[float]] = {False: [], True: []}
    for displaced, found in torques.items():
        for number in range(1, 5):
            apart = replace(case, start=0 if displaced else number)
            scene = scene_of(apart)
            pattern = number if displaced else 0
            rows = run._watched(scene, load_of(apart, scene), case.duration, None, pattern).statistics()
            found.append(float(rows[0, STATISTICS.index("torque")]))
    assert np.std(torques[True]) > 5.0 * np.std(torques[False]) > 0.0  # 20 times


# --- data


def test_changes_of_a_scene_merge_mappings_and_replace_the_rest() -> None:
    base = {"operation": {"kind": "constant", "speed_rpm": 1}, "defects": [1, 2], "mounting": {"cup": "held"}}
    found = merged(
        base, {"operation": {"kind": "stepped"}, "defects": [3], "mounting": {"journal_tilt": "free"}}
    )
    assert found == {
        "operation": {"kind": "stepped"},
        "defects": [3],
        "mounting": {"cup": "held", "journal_tilt": "free"},
    }
    assert base["mounting"] == {"cup": "held"}


def test_json_holds_what_the_page_needs(tmp_path: Path) -> None:
    outcome = judged(CASE, Finding(GOOD_MEASURES, changes(rows(5.0), rows(5.0))), 1.5)
    write_json(tmp_path / "hard.json", [CASE], [outcome], kernels=1)
    data = json.loads((tmp_path / "hard.json").read_text())
    again = outcome_from(data["cases"][0]["outcome"])
    assert (again.name, again.verdict, again.changes) == (outcome.name, outcome.verdict, outcome.changes)
    assert again.measures.energy_residual == GOOD_MEASURES.energy_residual
    assert np.isnan(again.measures.mean_torque)

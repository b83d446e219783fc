"""`simulate` and `explain` answer in a few lines; what they leave out stands behind --verbose."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.choice.rule import Choice, Decision, error_text, shorten_summary, tolerance
from beardyn_core.cli.main import DONE, main
from beardyn_core.effects import EffectSet
from beardyn_core.scene.scene import QUANTITIES

LONGEST = 8


@pytest.fixture(scope="module")
def ride(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel on a track, in a set of effects that is named."""
    path = tmp_path_factory.mktemp("ride") / "ride.yaml"
    path.write_text(
        "scene: ride\nbearing: HS130x230\nlubricant: L055\ntier: lumped\neffects: standard\nduration_s: 0.6\n"
        "operation: {kind: quarter_vehicle, vehicle: emu_300, irregularity: {kind: german_low},"
        " speed_profile: [{time_s: 0, speed_kmh: 160}], wheel_diameter_mm: 920}\n"
        'defects: [{kind: spall, "on": cup, row: 0, width_mm: 5, depth_um: 100}]\n'
    )
    return path


def said(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> list[str]:
    capsys.readouterr()
    assert main(arguments) == DONE
    return capsys.readouterr().out.splitlines()


def test_simulate_answers_in_eight_lines(
    ride: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recording = tmp_path / "run.mcap"
    lines = said(["simulate", str(ride), "-o", str(recording)], capsys)
    assert len(lines) <= LONGEST
    by_name = {line.split()[0]: line for line in lines}
    assert "spall on the cup" in by_name["scene"]
    assert "tier lumped" in by_name["computed"]
    assert "real-time factor" in by_name["computed"]
    assert "largest roller load" in by_name["force"]
    assert "GPa" in by_name["force"]
    assert "rpm" in by_name["torque"]
    assert "million revolutions" in by_name["life"]
    assert " km " in by_name["life"]
    assert str(recording) in by_name["recording"]
    assert all(len(line) <= 140 for line in lines)


def test_simulate_tells_the_rest_when_it_is_asked(ride: Path, capsys: pytest.CaptureFixture[str]) -> None:
    short = said(["simulate", str(ride)], capsys)
    long = said(["simulate", str(ride), "--verbose"], capsys)
    assert len(long) > len(short) + 8
    text = "\n".join(long)
    for more in ("effects ", "means over", "rating life", "energy residual", "ms per simulated s"):
        assert more in text
        assert more not in "\n".join(short)


def test_explain_has_a_line_for_each_effect(ride: Path, capsys: pytest.CaptureFixture[str]) -> None:
    short = said(["explain", str(ride), "--effects", "auto", "--tier", "full"], capsys)
    rows = [line.split()[:2] for line in short if line.split()[:1] in (["on"], ["off"])]
    assert ["on", "traction"] in rows
    assert len(rows) == len({name for _, name in rows}) > 10
    assert all(len(line) <= 130 for line in short)
    assert any(line.strip().startswith("answer: ") for line in short)
    long = said(["explain", str(ride), "--effects", "auto", "--tier", "full", "--verbose"], capsys)
    assert any("laminae" in line for line in long)
    assert any("cost" in line for line in long)


def choice(expected: dict[str, float], accuracy: float, left: list[str]) -> Choice:
    decisions = tuple(
        Decision(name, "off", "a reason", False, 0.0, {"torque": 0.01})  # an error: it is left out
        for name in left
    )
    return Choice(
        "full", EffectSet(), 6, 4, accuracy, tuple(expected), "", "", "", decisions, expected, 1.0, 1.0,
        True, 1e4,
    )  # fmt: skip


ERRORS = st.one_of(st.just(0.0), st.floats(1e-4, 3.0), st.just(float("nan")))


@given(
    expected=st.dictionaries(st.sampled_from(QUANTITIES), ERRORS, min_size=1),
    accuracy=st.sampled_from([0.01, 0.05, 0.2]),
    left=st.lists(st.sampled_from(["seal", "drag", "cage"]), unique=True),
)
def test_the_phrase_names_every_bound_that_is_wider_than_asked_for(
    expected: dict[str, float], accuracy: float, left: list[str]
) -> None:
    made = choice(expected, accuracy, left)
    phrase = made.phrase
    for name, error in expected.items():
        words = f"{name} {error_text(name, error)}".replace("roller_load", "roller load")
        assert (words in phrase) == (error > tolerance(name, accuracy))
    for name in left:
        assert name in phrase.partition("without ")[2]
    if any(error != error for error in expected.values()):
        assert "unknown" in phrase
    elif all(error <= tolerance(name, accuracy) for name, error in expected.items()):
        assert phrase.startswith("within ")
        assert "of the full model" in phrase
    assert len(phrase) < len(made.summary)


def test_a_sentence_of_another_kind_is_left_alone() -> None:
    assert shorten_summary("") == ""
    assert shorten_summary("chosen by hand") == "chosen by hand"

"""Maker's factors: what follows from a subset, what does not, what is refused, and a monitor with them."""

from __future__ import annotations

import math
from dataclasses import astuple, replace
from math import isnan, nan
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import beardyn_core as bd
from beardyn_core.base.edge import write_noun
from beardyn_core.bearing.kinematics import FaultFrequencies, frequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.chain import REFERENCE, Stretch
from beardyn_core.study.monitored_recording import Finding
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS, fault_signal


@given(
    count=st.integers(6, 40),
    ratio=st.floats(0.06, 0.35),
    angle=st.sampled_from([0.0, 10.0, 15.0, 25.0]),
    without=st.sampled_from([(), ("bpfo",), ("bpfi",), ("ftf",), ("bpfi", "ftf"), ("bpfo", "ftf")]),
)
def test_factors_rounded_to_three_digits_give_the_rest_back(
    count: int, ratio: float, angle: float, without: tuple[str, ...]
) -> None:
    assume(math.pi / math.asin(ratio) > count)
    exact = frequencies(count, 1.0, ratio, math.radians(angle))
    given = {name: round(getattr(exact, name), 3) for name in ("bpfo", "bpfi", "bsf", "ftf")}
    # 5.000 is the number 5: it may need another factor
    assume(all(value != round(value, 1) for value in given.values()))
    known: dict[str, Any] = {name: value for name, value in given.items() if name not in without}
    if len(without) == 2:
        known["roller_count"] = count
    plate = NamePlate(**known)
    assert plate.roller_count == count
    assert astuple(plate.frequencies) == pytest.approx(astuple(exact), rel=5e-3)
    assert not plate.cannot_tell
    if angle == 0.0:  # the spin follows where the contact angle is known
        del known["bsf"]
        spin = NamePlate(**known, contact_angle=0.0).frequencies.bsf
        assert isnan(spin) or spin == pytest.approx(exact.bsf, rel=0.02)  # NaN: too few digits
        assert isnan(NamePlate(**known).frequencies.bsf)


@pytest.mark.parametrize(
    ("given", "missing"),
    [
        ({"bpfo": 8.24}, {"cone", "roller"}),
        ({"bpfi": 10.76}, {"cup", "roller"}),
        ({"bpfo": 8.24, "bpfi": 10.76}, {"roller"}),
        ({"bpfo": 8.24, "ftf": 0.43}, {"roller"}),
        ({"roller_count": 19, "ftf": 0.434}, {"roller"}),
        ({"roller_count": 19, "ftf": 0.43}, {"cup", "roller"}),  # two digits: BPFO to 1.2 % only
        ({"bpfo": 8.24, "bpfi": 10.76, "bsf": 3.6}, set()),
        ({"bpfo": 8.24, "bsf": 3.6}, {"cone", "roller"}),  # without the cage a roller has no sidebands
    ],
)
def test_what_does_not_follow_is_missing_with_its_reason(given: dict[str, Any], missing: set[str]) -> None:
    plate = NamePlate(**given)
    assert set(plate.cannot_tell) == missing
    assert all(len(why) > 20 for why in plate.cannot_tell.values())


@pytest.mark.parametrize(
    ("given", "parts"),
    [
        ({"bpfo": 4, "bpfi": 5}, ["bpfo is 4; its last digit leaves the order open by 12 %", "bpfi is 5"]),
        ({"bpfo": 4, "roller_count": 9}, ["where 4.0 is exact, give roller_count and ftf"]),
        ({"bpfo": 4, "bpfi": 5, "ftf": 0.4}, ["bpfo is 4; its last digit"]),
        ({"bpfo": 4, "bpfi": 5, "bsf": 2.357}, ["bpfo is 4; its last digit"]),
        ({"bpfo": 4, "bpfi": 5, "ftf": 0.41}, ["9 x ftf = 3.69"]),
        ({"bpfo": 8.24, "ftf": 0.4}, ["ftf is 0.4; its last digit leaves the order open by 12 %"]),
        (
            {"bpfo": 107.4, "bpfi": 162.2, "bsf": 70.6, "ftf": 11.9},
            [
                "bpfo is 107.4; it must be at most 40; a factor is per turn",
                "bpfi is 162.2",
                "bsf is 70.6",
                "ftf is 11.9; it must be at most 1; a factor is per turn",
            ],
        ),
        ({"bpfo": 60.2}, ["divide it by the speed of the shaft in hertz"]),
        ({"bpfo": 10.76, "bpfi": 8.24}, ["are they exchanged"]),
        ({"bpfo": 8.24, "bpfi": 10.76, "bsf": 7.2}, ["twice the spin", "give 3.6"]),
        ({"bpfo": 8.24, "bpfi": 10.76, "bsf": 1.2}, ["60 degrees"]),
        ({"bpfo": 8.24, "bpfi": 10.76, "ftf": 0.40}, ["19 x ftf = 7.6"]),
        (
            {"bpfo": 8.24, "bpfi": 10.36, "bsf": 7.2, "ftf": 0.53},
            ["ftf is 0.53", "= 18.6; it must be a whole number", "twice the spin"],
        ),
        ({"bpfo": 8.24, "bpfi": 10.76, "roller_count": 18}, ["it must be roller_count, 18"]),
        ({"bpfo": 12.0, "roller_count": 19}, ["bpfo must be between 4.75 and 9.5"]),
        ({"ftf": 0.43}, ["neither bpfo nor bpfi follows from ftf"]),
        ({"bpfo": -3.0, "bsf": 900.0}, ["bpfo is -3", "bsf is 900"]),
        ({"bpfo": 3.6, "roller_diameter_mm": 7.94}, ["without pitch_diameter_mm"]),
        (
            {"bpfo": 3.7, "roller_count": 9, "roller_diameter_mm": 7.94, "pitch_diameter_mm": 39.04},
            ["from the diameters it is 3.5848"],
        ),
        ({"bpfo": 8.24, "bpfi": 10.76, "bsf": 3.6, "contact_angle_deg": 30}, ["30 degrees it is 3.207"]),
    ],
)
def test_contradicting_factors_are_refused_with_every_mistake(
    given: dict[str, Any], parts: list[str]
) -> None:
    with pytest.raises(bd.InputError) as caught:
        bd.name_plate(**given)
    for part in parts:
        assert part in str(caught.value)


@pytest.mark.parametrize(
    "given",
    [
        {"bpfo": 5, "bpfi": 7, "ftf": 0.417, "bsf": 2.92},  # the zeros of 5.000 are meant
        {"bpfo": 5, "roller_count": 12, "ftf": 0.417},
        {"bpfo": 7.6, "bpfi": 9.4},
        {"bpfo": 2.4, "bpfi": 3.6, "bsf": 2.061},  # of a list of three digits
        {"bpfo": 8.24, "bpfi": 10.76, "bsf": 3},  # a list has as many digits for all: 3.00
        {"bpfo": 60.2, "roller_count": 130},
    ],
)
def test_factors_with_digits_enough_are_taken(given: dict[str, Any]) -> None:
    assert bd.name_plate(**given).frequencies.bpfo == given["bpfo"]


def test_factors_are_written_and_read_again() -> None:
    plate = bd.name_plate(bpfo=8.24, bpfi=10.76, bsf=3.6, ftf=0.43)
    keys = write_noun(plate)
    assert keys.pop("name") == "bearing data"
    assert "roller_diameter_mm" not in keys
    assert bd.name_plate(**keys).frequencies == plate.frequencies
    assert bd.name_plate("6205", contact_angle_deg=0).has_dimensions
    assert not plate.has_dimensions


def told(fault: str | None, orders: FaultFrequencies, count: int) -> Any:
    _, angle, acceleration = fault_signal(fault, 71)
    return REFERENCE(Stretch(RATE, acceleration, angle, 8e4, 0), orders, count, SETTINGS)


@pytest.mark.parametrize("count", [ROLLERS, 0])
def test_a_part_whose_order_is_known_is_named_without_the_others(count: int) -> None:
    cup = told("cup", FaultFrequencies(nan, ORDERS.bpfo, nan, nan), count)
    assert cup.verdict == "cup"
    assert isnan(cup.scores[1])
    assert isnan(cup.scores[2])
    cone = told("cone", replace(ORDERS, bpfo=nan, bsf=nan, ftf=nan), count)
    assert cone.verdict == "cone"


def test_a_part_without_order_is_never_called_and_healthy_says_what_is_not_judged() -> None:
    cup_alone = FaultFrequencies(nan, ORDERS.bpfo, nan, nan)
    strange = told("cone", cup_alone, 0)
    assert strange.verdict in ("unexplained", "not_diagnosable")
    healthy = told(None, cup_alone, 0)
    assert healthy.verdict == "healthy"
    assert "not judged: inner ring (cone), rolling elements" in healthy.reason
    assert healthy.not_judged == strange.not_judged == ("cone", "roller")
    assert "not judged" not in told(None, ORDERS, ROLLERS).reason
    assert told(None, ORDERS, ROLLERS).not_judged == ()
    published = Finding.of(healthy).to_diagnostic("monitor")
    assert published.value("not_judged") == "cone roller"
    read = Finding.from_diagnostic(published)
    assert read is not None
    assert read.not_judged == ("cone", "roller")

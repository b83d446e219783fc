"""Parts whose lines are the shaft's are not judged, and parts with the same lines are named together."""

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.config import load_plate
from beardyn_core.monitor.chain import REFERENCE, MonitorSettings, Stretch
from beardyn_core.monitor.chain.ambiguity import parts_on_the_shaft
from test.measured.files import RATE, frequencies, struck

SPEED = 30.0


def _analysed(values, orders, count, revolutions=60.0):
    samples = min(len(values), round(revolutions / SPEED * RATE))
    angle = np.asarray(2.0 * np.pi * SPEED * np.arange(samples) / RATE, np.float64)
    return REFERENCE(Stretch(RATE, values[:samples, :1], angle, np.nan, 0), orders, count, MonitorSettings())


def test_balls_of_a_6203_lie_on_the_fourth_multiple_of_the_shaft():
    plate = load_plate("6203")
    assert 2.0 * plate.frequencies.bsf == pytest.approx(3.99, abs=0.01)
    found = _analysed(struck(0.0), plate.frequencies, plate.roller_count)
    assert found.verdict == "healthy"
    assert found.not_judged == ("roller",)
    assert "not judged: rolling elements, whose lines are multiples of the shaft's" in found.reason


def test_the_longer_a_stretch_is_the_nearer_lines_are_told_from_those_of_the_shaft():
    orders = load_plate("6203").frequencies
    assert parts_on_the_shaft(orders, 60.0) == ("roller",)
    assert parts_on_the_shaft(orders, 400.0) == ()
    assert parts_on_the_shaft(load_plate("6205").frequencies, 60.0) == ()


def test_healthy_without_all_parts_judged_has_no_confidence_and_a_named_part_is_judged():
    plate = load_plate("6203")
    assert np.isnan(_analysed(struck(0.0), plate.frequencies, plate.roller_count).confidence)
    known = replace(frequencies("6205"), bpfi=np.nan, bsf=np.nan, ftf=np.nan)
    assert np.isnan(_analysed(struck(0.0), known, 9).confidence)
    named = _analysed(struck(frequencies("6205").bpfo), known, 9)
    assert named.verdict == "cup"
    assert named.confidence > 0.8
    assert "cup" not in named.not_judged


def test_a_part_of_which_nothing_is_known_is_not_also_one_on_the_shaft():
    orders = replace(load_plate("6203").frequencies, bsf=np.nan)
    found = _analysed(struck(0.0), orders, 8)
    assert found.not_judged == ("roller",)
    assert "whose order is not known" in found.reason
    assert "multiples of the shaft" not in found.reason


def test_parts_with_the_same_lines_are_named_together():
    own = frequencies("6205")
    alike = FaultFrequencies(bpfo=own.bpfo, bpfi=own.bpfi, bsf=0.5 * own.bpfo, ftf=own.ftf)
    found = _analysed(struck(own.bpfo), alike, 9)
    assert found.verdict in ("cup", "roller")
    (other,) = found.also_fits
    assert {found.verdict, other} == {"cup", "roller"}
    assert "would have these lines, too" in found.reason
    alone = _analysed(struck(own.bpfo), own, 9)
    assert alone.also_fits == ()
    assert found.confidence < 0.5 < alone.confidence

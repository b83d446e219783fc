"""What the comparison with a neural posterior says, of guesses whose errors are known."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.follow.judging import crosswise_parts
from evidence.follow import judged, neural
from evidence.follow.page import PAGE
from evidence.follow.test_judged import guesses
from evidence.pages import with_section


def test_no_bearing_is_taught_and_judged() -> None:
    bearings = np.array([f"b{k % 13}" for k in range(40)])
    parts = list(crosswise_parts(bearings, neural.PARTS))
    assert len(parts) == neural.PARTS
    assert np.array_equal(np.sum(parts, axis=0), np.ones(40))
    for part in parts:
        assert not set(bearings[part]) & set(bearings[~part])


def test_the_descriptors_that_go_with_the_number_are_received_first() -> None:
    random = np.random.default_rng(1)
    values = random.normal(size=200)
    descriptors = random.normal(size=(200, 300))
    descriptors[:, 7] -= 3.0 * values
    chosen = neural.received_best(descriptors, values)
    assert chosen[0] == 7
    assert len(chosen) == neural.KEPT


def test_who_errs_less_is_told() -> None:
    better, worse = (dict.fromkeys(neural.SHOWN, guesses(error)) for error in (0.1, 0.3))
    said = neural.verdict(better, {"maf": worse, "nsf": worse})
    assert said.startswith("The flows err more in every number")
    said = neural.verdict({**better, "width": worse["width"]}, {"maf": worse, "nsf": better})
    assert said.startswith("A flow errs less in: width of the spall along the raceway (flow, splines, ")
    assert said.endswith(" % of runs inside of 90 %).")
    assert "end play" in neural.verdict({"width": better["width"]}, {"maf": worse})
    text = neural.section(better, {"maf": worse, "nsf": better}, 120.0)
    assert "| width of the spall along the raceway | shipped | 10 % of " in text
    assert "| width of the spall along the raceway | flow, Gaussian | 30 % of " in text
    assert "| width of the spall along the raceway | flow, splines | 10 % of " in text
    page = with_section(PAGE.read_text(encoding="utf-8"), neural.TITLE, text, neural.NEXT)
    assert with_section(page, neural.TITLE, text, neural.NEXT) == page
    again = with_section(page, judged.TITLE, f"{judged.TITLE}anew\n\n", judged.NEXT)  # leaves the others
    assert text in again
    assert f"{judged.TITLE}anew\n\n{neural.TITLE}" in again


def test_ways_are_compared_on_runs_that_all_of_them_guess() -> None:
    whole = guesses(0.1)
    part = whole.taken(whole.places > 2)
    ways = neural.by_way("width", {"width": part}, {"maf": {"width": whole}})
    assert {way: len(each.truth) for way, each in ways.items()} == dict.fromkeys(ways, len(part.truth))
    text = neural.section({}, {"maf": dict.fromkeys(neural.SHOWN, whole)}, 60.0)
    assert "| end play of the bearing as mounted | shipped | says nothing | - | - |" in text


def test_a_flow_finds_a_posterior_whose_form_is_known() -> None:
    pytest.importorskip("sbi")
    random = np.random.default_rng(1)
    values = random.normal(size=400)
    received = np.stack([values + 0.5 * random.normal(size=400), random.normal(size=400)], axis=1)
    found = neural.draws(received, values, np.array([[1.0, 0.0], [-1.0, 0.0]]), "maf")
    assert found.mean(axis=0) == pytest.approx([0.8, -0.8], abs=0.25)  # 1 / (1 + 0.5^2)
    assert found.std(axis=0) == pytest.approx([0.45, 0.45], abs=0.15)  # 0.5 / sqrt(1 + 0.5^2)

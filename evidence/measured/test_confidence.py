"""The confidence is fitted by what verdicts rest on; a machine is judged with the weights of the others."""

from __future__ import annotations

from dataclasses import astuple, replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.monitor.chain.confidence import PART, WEIGHTS, Grounds, confidence_of
from evidence.measured import confidence as page
from evidence.measured.confidence import (
    Answer,
    calibration,
    draw,
    fit,
    fitted,
    fold_of,
    judged,
    kept,
    text,
    weights_of,
)


def grounds(strikes: float, comb: float = 5.0) -> Grounds:
    return Grounds(comb=comb, strikes=strikes, steady=10.0, deviation=0.002, otherwise=0.3)


def answer(
    bearing: str,
    faulty: str,
    verdict: str,
    strikes: float = 2.0,
    *,
    machine: str = "m",
    inputs: str = "right",
    loud: bool = False,
) -> Answer:
    return Answer(machine, bearing, inputs, faulty, loud, verdict, grounds(strikes))


def synthetic(machines: int = 4, seed: int = 1) -> list[Answer]:
    """Parts and healthy bearings whose verdicts are right with a probability that strikes set."""
    random = np.random.default_rng(seed)
    several = []
    for number in range(machines):
        machine = f"machine {number}"
        for bearing in range(60):
            name = f"{machine} bearing {bearing}"
            strikes = float(np.exp(random.uniform(-1.5, 2.0)))
            right = random.random() < 1.0 / (1.0 + np.exp(-1.0 - 2.0 * np.log(strikes)))
            several.append(answer(name, "cup" if right else "cone", "cup", strikes, machine=machine))
            well = random.random() < 1.0 / (1.0 + strikes)
            several.append(answer(f"{name} h", "" if well else "cup", "healthy", strikes, machine=machine))
    return several


def test_the_fit_finds_how_strikes_set_the_share_of_right_verdicts() -> None:
    several = synthetic(machines=12)
    weights = fit(PART, several)
    assert weights[2] == pytest.approx(2.0, abs=0.5)
    bins = [each for each in calibration(several, judged(several), PART) if each.bearings > 30]
    assert len(bins) >= 3
    for each in bins:
        assert each.low - 0.05 <= each.stated <= each.high + 0.05
    assert bins[-1].right > 0.9 > bins[0].right + 0.2


def test_more_evidence_never_makes_a_fault_less_probable_nor_a_healthy_bearing_more() -> None:
    several = synthetic()
    against = [
        replace(each, faulty="cone" if each.faulty == "cup" else "cup")
        for each in several
        if each.verdict == "cup"
    ]
    assert fit(PART, [*against, *[each for each in several if each.verdict == "healthy"]])[2] == 0.0
    assert fit("healthy", several)[2] < 0.0


def test_a_machine_is_judged_with_the_weights_of_the_others() -> None:
    several = synthetic()
    confidence = judged(several, by_machine=True)
    others = fitted([each for each in several if each.machine != "machine 2"])
    index = next(i for i, each in enumerate(several) if each.machine == "machine 2")
    assert confidence[index] == confidence_of(several[index].verdict, several[index].grounds, others)
    assert confidence[index] != confidence_of(several[index].verdict, several[index].grounds, fitted(several))


def test_no_bearing_is_judged_with_weights_that_it_has_set() -> None:
    several = synthetic()
    folds = fold_of(several, by_machine=False)
    assert len(set(folds)) == page.FOLDS
    for name in {each.bearing for each in several}:
        assert len({fold for each, fold in zip(several, folds, strict=True) if each.bearing == name}) == 1
    others = fitted([each for each, fold in zip(several, folds, strict=True) if fold != folds[0]])
    assert judged(several)[0] == confidence_of(several[0].verdict, several[0].grounds, others)


def test_unexplained_is_right_where_an_input_is_wrong_or_a_neighbour_strikes() -> None:
    assert answer("b", "cup", "unexplained", inputs="speed").is_right
    assert not answer("b", "cup", "unexplained").is_right
    assert answer("b", "", "unexplained", loud=True).is_right
    assert not answer("b", "", "unexplained").is_right


def test_healthy_and_faulty_bearings_weigh_alike_and_so_do_bearings() -> None:
    several = [answer("a", "cup", "cup"), *[answer("b", "cup", "cup")] * 3, answer("c", "", "healthy", 0.2)]
    weight = weights_of(several)
    assert weight[0] == pytest.approx(weight[1:4].sum())
    assert weight[:4].sum() == pytest.approx(weight[4])


def test_the_page_and_its_picture_show_every_kind(tmp_path: Path) -> None:
    several = [
        *synthetic(),
        *[Answer("m", f"u{k}", "speed", "cup", False, "unexplained", grounds(3.0)) for k in range(9)],
    ]
    confidence = judged(several)
    draw(several, confidence, tmp_path / "picture.png")
    assert (tmp_path / "picture.png").stat().st_size > 5000
    written = text(several, confidence, "9 of nothing")
    for word in ("| a part |", "| healthy |", "| unexplained |", "machine 3", "9 of nothing"):
        assert word in written


def test_answers_are_kept_and_read_again() -> None:
    several = [*synthetic()[:3], Answer("m", "b", "right", "", True, "not_diagnosable", None)]
    rows = [list(astuple(replace(each, grounds=None)))[:-1] for each in several]
    rows = [[*row, each.grounds and list(each.grounds)] for row, each in zip(rows, several, strict=True)]
    assert kept(rows) == several


def test_the_page_shows_the_weights_that_are_shipped() -> None:
    rows = {}
    written = (
        page.PAGE.read_text(encoding="utf-8").partition("## How it is set")[2].partition("## Conditions")[0]
    )
    for line in written.splitlines():
        cells = [each.strip() for each in line.strip("|").split("|")]
        if cells[0] in page.KIND_WORDS.values():
            rows[cells[0]] = tuple(float(each) for each in cells[1:])
    assert rows == {page.KIND_WORDS[kind]: weights for kind, weights in WEIGHTS.items()}


def test_shipped_weights_have_the_prescribed_signs() -> None:
    assert set(WEIGHTS) == set(page.KINDS)
    for kind, signs in page._SIGNS.items():
        for weight, sign in zip(WEIGHTS[kind], signs, strict=True):
            assert weight == 0.0 if sign is None else sign * weight >= 0.0

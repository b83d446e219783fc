"""The year of a fleet: the page is of its numbers, and recordings are made as the page states."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.fleet.identity import Axlebox
from evidence.fleet.page import PAGE, page
from evidence.fleet.signals import TwinRun, names
from evidence.fleet.year import (
    DEAD,
    DEAD_FROM,
    FLAT_AXLE,
    FLAT_FROM,
    KEPT,
    SPALLS,
    boxes,
    run_of,
    width_mm,
    write_year,
)


def test_the_page_is_of_the_kept_numbers() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(json.loads(KEPT.read_text(encoding="utf-8")))


def test_spalls_grow_from_2_to_20_mm_in_their_time() -> None:
    for each in SPALLS:
        assert width_mm(each, each.begins - 1) == 0.0
        assert width_mm(each, each.begins) == pytest.approx(2.0)
        assert width_mm(each, each.begins + each.takes) == pytest.approx(20.0)


def test_each_axlebox_gets_the_run_of_its_condition() -> None:
    random = np.random.default_rng(1)
    known = set(names())
    assert len(list(boxes())) == 64
    for day in (0, FLAT_FROM, 300, 364):
        assert {run_of(box, day, random) for box in boxes()} <= known
    spall = SPALLS[0]
    assert run_of(spall.box, spall.begins, random) == "cup_2"
    assert run_of(spall.box, spall.begins + spall.takes, random) == "cup_20"
    assert run_of(Axlebox(*FLAT_AXLE, "left"), FLAT_FROM, random) == "flat_0"


def test_a_year_is_written_with_a_manifest_and_a_dead_sensor(tmp_path: Path) -> None:
    still = TwinRun(np.sin(np.arange(50_000.0)), 0.005 * np.arange(50_000.0))
    count = write_year(tmp_path, DEAD_FROM, dict.fromkeys(names(), still))
    with (tmp_path / "manifest.csv").open(encoding="utf-8") as file:
        lines = list(csv.DictReader(file))
    assert count == len(lines) == 2 * 64
    last = next(
        each
        for each in lines
        if (each["vehicle"], each["axle"], each["side"]) == DEAD and "220" in each["file"]
    )
    assert np.ptp(np.load(tmp_path / last["file"])["z"]) == 0

"""The cages follow the rollers under light loads, in every shipped set of effects."""

from __future__ import annotations

from dataclasses import replace

import pytest

from beardyn_core.physics.cage.watch import CageWatch
from beardyn_core.physics.tiers.status import Status, status_of_cages
from evidence.light.grid import (
    AUTO,
    AUTO_POINTS,
    FAST,
    LARGEST_RATIO,
    LOADS_KN,
    SETS,
    SPEEDS_RPM,
    run_point,
    run_scene,
    scene_of,
)
from test.examples import fast_ones


@pytest.mark.parametrize(
    ("effects", "load_kn", "speed_rpm"),
    fast_ones(
        [("all", 0.2, 1165.0), ("all", 5.0, 2500.0), ("standard", 1.0, 2500.0), ("standard", 80.0, 300.0)],
        0,
    ),
)
def test_cages_neither_over_run_nor_turn_back(effects: str, load_kn: float, speed_rpm: float) -> None:
    point = run_point(effects, load_kn, speed_rpm)
    assert point.holds, point
    assert not point.told


def test_five_kilonewtons_slip_by_less_than_one_percent() -> None:
    """`static_5kN` with `all` effects ran at 1.95 times the speed of rolling when its inlets were flooded."""
    assert 0.99 <= run_point("all", 5.0, 1165.0).ratio <= 1.002


@pytest.mark.slow
@pytest.mark.parametrize("speed_rpm", SPEEDS_RPM)
@pytest.mark.parametrize("effects", [*SETS, FAST])
def test_whole_grid(effects: str, speed_rpm: float) -> None:
    """Nothing runs back; what runs ahead is dry, and above 1 % the status tells."""
    for load in LOADS_KN:
        point = run_point(effects, load, speed_rpm)
        assert point.holds or (effects == "dry" and point.ratio > 1.0), point
        assert (point.ratio > 1.011) <= bool(point.told), point


@pytest.mark.slow
@pytest.mark.parametrize(("speed_rpm", "load_kn"), AUTO_POINTS)
def test_chosen_effects_let_no_cage_over_run(speed_rpm: float, load_kn: float) -> None:
    point = run_point(AUTO, load_kn, speed_rpm)
    assert point.holds, point
    assert not point.told


@pytest.mark.slow
@pytest.mark.parametrize("speed_rpm", SPEEDS_RPM[2:])
def test_chosen_ribs_are_lubricated_where_dry_ones_drive_cages(speed_rpm: float) -> None:
    for load in LOADS_KN:
        rib = scene_of(AUTO, load, speed_rpm).effects.rib
        assert rib is not None
        assert rib.lubrication is not None, load


@pytest.mark.slow
def test_a_dry_rib_is_what_drives_cages_ahead() -> None:
    """The cause that the page names: over 1.002 with the rib's friction, not without."""
    assert run_point("dry", 2.0, 2500.0).ratio > LARGEST_RATIO
    scene = scene_of("dry", 2.0, 2500.0)
    assert scene.effects.rib is not None
    smooth = replace(scene.effects, rib=replace(scene.effects.rib, friction=0.0))
    assert run_scene(replace(scene, effects=smooth)).ratio <= LARGEST_RATIO


def test_a_status_tells_of_cages_that_run_ahead_or_back() -> None:
    assert status_of_cages(CageWatch((1.02, 1.0), 2.0)) == Status.CAGE_FAST
    assert status_of_cages(CageWatch((1.0, -0.1), 2.0)) == Status.CAGE_BACKWARDS
    assert status_of_cages(CageWatch((1.02, -0.1), 0.5)) == Status.FINE  # not a revolution yet
    assert status_of_cages(CageWatch((0.5, 1.005), 2.0)) == Status.FINE

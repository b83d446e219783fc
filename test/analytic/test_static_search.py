"""Searches for a static equilibrium: what has none is told at once or soon, and what has one is found."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.life import static_rating
from beardyn_core.config import load_bearing
from beardyn_core.physics.statics.static import solve

HS = load_bearing("HS130x230")


@pytest.mark.parametrize(
    ("load", "prop"), [((0.0, 0.0, 5e3), 0.0), ((3e3, 1e3, -5e3), 0.0), ((0.0, 0.0, 1e5), 5e5)]
)
def test_a_row_that_its_own_thrust_drives_off_its_raceways_is_refused(load: tuple, prop: float) -> None:
    """A cone pressed across rises on the cup by its angle; a prop is told how far it would yield."""
    with pytest.raises(ValidityError, match=r"more than ([\d.e+]+) N press them together") as told:
        solve(HS, load, end_play=0.0, rows=1, laminae=6, axial_stiffness=prop)
    across = math.hypot(load[0], load[2])
    found = re.search(r"more than ([\d.e+]+) N press", str(told.value))
    assert found
    thrust = float(found.group(1))
    assert thrust == pytest.approx(across * math.tan(HS.cup_angle), rel=1e-3)
    if prop:
        assert f"would yield by {1e3 * (thrust - load[1]) / prop:.3g} mm" in str(told.value)
    pressed = (load[0], 4.0 * thrust, load[2])
    assert solve(HS, pressed, end_play=0.0, rows=1, laminae=6).residual < 1e-8 * across
    stiff = thrust / (0.1 * HS.effective_length)
    held = solve(HS, load, end_play=0.0, rows=1, laminae=6, axial_stiffness=stiff)
    assert held.residual < 1e-3 * across


@pytest.mark.parametrize("load", [(0.0, 0.0, 6e-13), (0.0, -6e-13, 0.0), (0.0, 0.0, 1e-4)])
def test_a_load_of_rounding_is_none(load: tuple[float, float, float]) -> None:
    assert solve(HS, load, end_play=0.0, rows=1, laminae=3).residual <= 1e-3


def test_a_row_that_is_pulled_apart_is_told_so() -> None:
    with pytest.raises(ValidityError, match=r"more than 0 N press them together along it, and -100 N do\."):
        solve(HS, (0.0, -100.0, 0.0), end_play=0.0, rows=1)


LIGHT_ON_A_PROP = {
    "force": (-2149.113242494816, 1667.552604097467, 2717.607053477167),
    "end_play": 0.0,
    "rows": 1,
    "axial_stiffness": 121589135.92873217,
}
TILTED_IN_MUCH_PLAY = {
    "force": (109781.45036012006, -42715.67930965623, 129167.91909576862),
    "moment": (11676.89661213817, 0.0, -3904.196864962324),
    "end_play": 0.004788623156976954,
    "tilt": "free",
    "speed": 227.84226092974623,
}


@pytest.mark.parametrize("case", [LIGHT_ON_A_PROP, TILTED_IN_MUCH_PLAY])
def test_a_search_does_not_stop_where_energies_tell_no_longer(case: dict[str, Any]) -> None:
    """Under light loads energies round; with a tilted cone a smaller residual may have the higher one."""
    found = solve(load_bearing("METRO120x220"), laminae=2, **case)
    assert found.residual < 1e-6
    assert found.iterations < 50


def test_a_row_of_one_that_is_pressed_as_much_as_it_must_is_not_refused() -> None:
    """The thrust of the bound is that of a load on one roller: with a full zone it takes more."""
    load, across = (0.0, 5e3, 8e3), 8e3
    found = solve(HS, load, end_play=0.0, rows=1, laminae=6)
    needed = math.tan(HS.cup_angle) * across
    assert found.cup_load.sum() * math.sin(HS.cup_angle) == pytest.approx(load[1], rel=1e-6)
    assert load[1] > needed


def test_a_search_ends_where_rollers_find_no_place() -> None:
    """775 kN beside the centre of a row that tilts: its rollers were out of balance for half of 82 steps."""
    row: dict[str, Any] = {"end_play": 2e-4, "rows": 1, "axial_stiffness": 4.9e7, "laminae": 2}
    metro = load_bearing("METRO120x220")
    with pytest.raises(ValidityError, match=r"mm off its place, where rollers have no place, and"):
        solve(metro, (0.0, 0.0, 7.75e5), tilt="free", tilt_stiffness=(1e5, 1e5), **row)
    assert solve(metro, (0.0, 0.0, 7.75e5), tilt="locked", **row).residual < 1e-3


def test_a_cone_that_drives_away_is_told_soon_with_how_far_it_is_off() -> None:
    """Rollers that turn press their cone away along the axle, and nothing holds a single row there."""
    with pytest.raises(ValidityError, match=r"after (\d+) steps the cone is [\d.]+ mm off its place") as told:
        solve(HS, (0.0, 0.0, 0.0), end_play=0.0, rows=1, laminae=6, speed=200.0)
    steps = int(str(told.value).split("after ")[1].split()[0])
    assert steps < 100


@pytest.mark.parametrize("seed", range(4))
def test_rollers_that_only_centrifugal_force_presses_stay_in_the_bearing(seed: int) -> None:
    """A crown error of a micrometre holds little moment: a long step took rollers over the rib, 10 cm off."""
    bearing = load_bearing("FR130x230x150")
    crown = np.random.default_rng(seed).uniform(-4e-3, 4.5e-3, (2, bearing.roller_count))
    found = solve(
        bearing, (138e3, 110e3, -183e3), (-885.0, 0.0, -739.0), end_play=2e-4, laminae=3, tilt="free",
        tilt_stiffness=(1e5, 1e5), crown=crown, speed=212.0,
    )  # fmt: skip
    assert np.abs(found.roller_radial).max() < 1e-3
    assert (found.cup_load > 0.0).all()
    assert (found.rib_load > 0.0).all()


def test_a_row_that_only_its_prop_holds_is_found_though_its_residual_leads_in_circles() -> None:
    """Next to no load at 4000 rpm: steps of a smaller residual and of a lower energy went to and fro."""
    metro = load_bearing("METRO120x220")
    found = solve(
        metro, (0.0, 0.0, 1.5), end_play=1.7e-3, laminae=7, rows=1, tilt="free", tilt_stiffness=(1e5, 1e5),
        axial_stiffness=2.5e7, speed=424.5,
    )  # fmt: skip
    assert found.residual < 1e-3


@pytest.mark.parametrize(
    ("load", "more"),
    [
        ((0.0, static_rating(HS), 0.0), {}),
        ((0.0, 2e4, 0.0), {"rows": 1, "axial_stiffness": 5e6}),
        ((0.0, 0.0, 1e5), {"rows": 1, "axial_stiffness": 3e6, "tilt": "locked"}),
        ((0.0, 0.0, 8e4), {"end_play": 5e-3}),
        ((1e4, 0.0, 8e4), {"tilt": "free", "tilt_stiffness": (1e5, 1e5)}),
    ],
)
def test_no_equilibrium_is_taken_for_a_cone_that_drives_away(load: tuple[float, ...], more: dict) -> None:
    """Rings that yield far: under the static rating along the axle, on a soft prop, through much play."""
    found = solve(HS, load, **({"end_play": 1e-4, "laminae": 6} | more))
    assert found.residual < 1e-3 * max(map(abs, load))

"""Load that a roller loses over a spall, in every tier, next to pressures on a grid of a half-space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.holed_line import lost_share
from beardyn_core.effects import EffectSet, LaminaCoupling
from beardyn_core.physics.lamina_table import contact_radii, surface_radius
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.spall_cover import counted_cover
from beardyn_core.physics.tiers.tiers import TIERS
from beardyn_core.scene.patch import Patch
from test.kernels.casting import Float, through
from test.kernels.fault_entries import massless_rollers, spring_contacts
from test.kernels.naive_half_space import HalfSpace
from test.kernels.pressed_roller import FAR, FORCE, NEAR, pressed
from test.kernels.rig import parameters_of
from test.scenes import scene_with, standard_scene

BEARING = standard_scene().bearing
LENGTH, MODULUS = BEARING.effective_length, BEARING.material.contact_modulus
RADIUS = float(contact_radii(BEARING, "cup", 1)[0])
LOAD = 1e4
DEPTH = (LOAD / line_contact_factor(BEARING.material, LENGTH)) ** 0.9
COUPLED = replace(EffectSet(), lamina_coupling=LaminaCoupling())

# widths in rolling direction and lengths along the roller, [m]
SIZES = [
    (8e-3, 1e-3),
    (4e-3, 2e-3),
    (8e-3, 4e-3),
    (8e-3, 8e-3),
    (12e-3, 8e-3),
    (8e-3, 16e-3),
    (8e-3, 25e-3),
    (20e-3, 30e-3),
]


def rectangle(width: float, length: float) -> tuple[Patch, ...]:
    """One patch."""
    return (Patch(on="cup", row=0, azimuth=NEAR, width=width, depth=1e-4, length=length),)


def ellipse(width: float, length: float, count: int = 13) -> tuple[Patch, ...]:
    """Strips of a round or oval pit."""
    middles = ((np.arange(count) + 0.5) / count - 0.5) * length
    chords = width * np.sqrt(1.0 - (2.0 * middles / length) ** 2)
    return strips(middles, chords, length)


def wedge(width: float, length: float, count: int = 13) -> tuple[Patch, ...]:
    """Strips of a pit that begins at one side of its width and is widest at the other."""
    middles = ((np.arange(count) + 0.5) / count - 0.5) * length
    return strips(middles, width * (0.5 + middles / length), length)


def strips(middles: Float, chords: Float, length: float) -> tuple[Patch, ...]:
    """Strips side by side, all with their centres at one azimuth."""
    whole = rectangle(1.0, length / len(middles))[0]
    return tuple(
        replace(whole, width=float(w), offset=float(y)) for y, w in zip(middles, chords, strict=True)
    )


SHAPES = {"rectangle": rectangle, "ellipse": ellipse, "wedge": wedge}


@cache
def half_space() -> tuple[HalfSpace, float, Float, float]:
    """Grid, approach at which the sound roller carries the load, its pressure, its load."""
    grid = HalfSpace(RADIUS, LENGTH, MODULUS, 0.33e-3, (24, 1000))
    approach = float(
        brentq(lambda d: grid.load(grid.pressure(d)) - LOAD, 0.8 * DEPTH, 1.6 * DEPTH, rtol=1e-3)
    )
    pressure = grid.pressure(approach)
    return grid, approach, pressure, grid.load(pressure)


def lost_on_the_half_space(patches: Sequence[Patch], arc: float = 0.0) -> float:
    """Share of the load that a roller loses at an arc [m] from the centre of a pit."""
    grid, approach, pressure, sound = half_space()
    pit = np.zeros_like(pressure)
    for patch in patches:
        over = np.abs(grid.x + arc) < 0.5 * patch.width
        under = np.abs(grid.y - patch.offset) < 0.5 * patch.length
        pit[np.ix_(over, under)] = patch.depth
    return 1.0 - grid.load(grid.pressure(approach, pit, first=pressure)) / sound


def azimuths(arcs: Sequence[float]) -> list[float]:
    """Azimuths at arcs [m] from the centre of the pit, and one far from it."""
    return [*(NEAR + arc / surface_radius(BEARING, "cup") for arc in arcs), FAR]


def lost_by_laminae(
    lanes: Any, patches: tuple[Patch, ...], arcs: Sequence[float], effects: EffectSet | None
) -> Float:
    """Share of the load that a roller of tier full loses at arcs [m]."""
    force = pressed(lanes, azimuths(arcs), DEPTH, patches, effects=effects)[:, FORCE]
    return np.asarray(1.0 - force[:-1] / force[-1])


def lost_by_springs(
    lanes: Any, patches: tuple[Patch, ...], arcs: Sequence[float], effects: EffectSet | None
) -> Float:
    """Share of the load that a roller of tier quasistatic loses."""
    p = parameters_of(scene_with(effects, defects=patches), lanes.width)
    cases = np.array([[azimuth, DEPTH] for azimuth in azimuths(arcs)])
    force = through(lanes, spring_contacts, np.repeat(cases, lanes.width, 0), 1, p.roller.half_length, p)
    force = force[:: lanes.width, 0]
    return np.asarray(1.0 - force[:-1] / force[-1])


def lost_between_rings(
    lanes: Any, patches: tuple[Patch, ...], arcs: Sequence[float], effects: EffectSet | None
) -> Float:
    """Share of the load that a roller of tier lumped loses: it gives way between cup and cone."""
    scene = replace(scene_with(effects, defects=patches), tier="lumped")
    p = TIERS["lumped"].parameters(scene, parameters_of(scene, lanes.width))
    cases = np.array([[azimuth, 2.0 * DEPTH, 0.0] for azimuth in azimuths(arcs)])
    load = through(lanes, massless_rollers, np.repeat(cases, lanes.width, 0), 1, p)[:: lanes.width, 0]
    return np.asarray(1.0 - load[:-1] / load[-1])


def between_rings(lost: float) -> float:
    """Share that a roller loses between two rings when its contact with one of them loses a share."""

    def miss(on_cup: float) -> float:
        return (1.0 - lost) * on_cup ** (10.0 / 9.0) - (2.0 - on_cup) ** (10.0 / 9.0)

    return 1.0 - (2.0 - float(brentq(miss, 1.0, 2.0))) ** (10.0 / 9.0)


def every(cases: Sequence[tuple[str, tuple[float, float]]]) -> list[Any]:
    """One case in the usual tests, the others among the slow ones."""
    usual = ("ellipse", SIZES[3])
    return [
        pytest.param(
            SHAPES[shape](*size),
            size[0],
            id=f"{shape} {1e3 * size[0]:g} x {1e3 * size[1]:g}",
            marks=() if (shape, size) == usual else pytest.mark.slow,
        )
        for shape, size in cases
    ]


ALL = every([(shape, size) for shape in SHAPES for size in SIZES])


@pytest.mark.parametrize(("patches", "width"), ALL)
def test_rollers_of_every_tier_lose_what_the_half_space_loses(
    lanes: Any, patches: tuple[Patch, ...], width: float
) -> None:
    """10 % of it over the middle of the spall; 20 % where it is about to leave."""
    arcs = [0.0, 0.2 * width]
    expected = [lost_on_the_half_space(patches, arc) for arc in arcs]
    for lost in (lost_by_laminae, lost_by_springs):
        for effects in (None, COUPLED):
            middle, aside = lost(lanes, patches, arcs, effects)
            assert middle == pytest.approx(expected[0], rel=0.1), (lost, effects)
            assert aside == pytest.approx(expected[1], rel=0.2), (lost, effects)
    for effects in (None, COUPLED):  # which it does not have
        middle, aside = lost_between_rings(lanes, patches, arcs, effects)
        assert middle == pytest.approx(between_rings(expected[0]), rel=0.1)
        assert aside == pytest.approx(between_rings(expected[1]), rel=0.2)


@pytest.mark.parametrize("length", [0.5e-3, 2e-3, 8e-3, 25e-3, 40e-3])
@pytest.mark.parametrize("offset", [0.0, 4e-3])
def test_strips_in_a_row_lose_what_the_grid_loses(length: float, offset: float) -> None:
    """5 % of it; 12 % over a hole of three contact widths."""
    patch = replace(rectangle(8e-3, length)[0], offset=offset)
    hole = (offset - 0.5 * length, offset + 0.5 * length)
    expected = lost_on_the_half_space([patch])
    assert lost_share([hole], LENGTH, RADIUS, MODULUS) == pytest.approx(
        expected, rel=0.12 if length < 2e-3 else 0.05
    )


@pytest.mark.parametrize("gap", [0.0, 1e-3])
def test_holes_at_an_end_and_beside_each_other_lose_what_the_grid_loses(gap: float) -> None:
    """8 % of it, with and without 1 mm of the line between them and the end, or each other."""
    whole = rectangle(8e-3, 4e-3)[0]
    at_end = (replace(whole, offset=0.5 * LENGTH - 2e-3 - gap),)
    two = tuple(replace(whole, offset=side * (2e-3 + 0.5 * gap)) for side in (-1.0, 1.0))
    for patches in (at_end, two):
        holes = [(patch.offset - 2e-3, patch.offset + 2e-3) for patch in patches]
        lost = lost_share(holes, LENGTH, RADIUS, MODULUS)
        assert lost == pytest.approx(lost_on_the_half_space(patches), rel=0.08)


def test_ridges_and_holes_narrower_than_the_contact_do_not_count() -> None:
    """Numbers that are rounded leave ridges of a nanometre, of which the strips would make anything."""
    pit = [(-4e-3, 0.0), (0.0, 4e-3)]
    whole = lost_share(pit, LENGTH, RADIUS, MODULUS)
    flush = lost_share([(0.5 * LENGTH - 4e-3, 0.5 * LENGTH)], LENGTH, RADIUS, MODULUS)
    for gap in (1e-15, 1e-9, 1e-7, 5e-6, 1e-4):
        apart = [(-4e-3 - gap, -gap), (0.0, 4e-3)]
        assert lost_share(apart, LENGTH, RADIUS, MODULUS) == pytest.approx(whole, rel=0.03)
        end = [(0.5 * LENGTH - 4e-3 - gap, 0.5 * LENGTH - gap)]
        assert lost_share(end, LENGTH, RADIUS, MODULUS) == pytest.approx(flush, rel=0.03)
        assert lost_share([(0.0, gap)], LENGTH, RADIUS, MODULUS) == 0.0
    shares = [lost_share([(-0.5 * w, 0.5 * w)], LENGTH, RADIUS, MODULUS) for w in np.linspace(0.0, 0.05, 60)]
    assert np.all(np.diff(shares) >= 0.0)
    assert (shares[0], shares[-1]) == (0.0, 1.0)


@given(
    st.lists(st.tuples(st.floats(-0.03, 0.03), st.floats(0.0, 0.03)), min_size=1, max_size=4),
    st.floats(0.02, 0.06),
)
def test_every_set_of_holes_loses_a_share_of_the_load(
    holes: list[tuple[float, float]], length: float
) -> None:
    lost = lost_share([(low, low + wide) for low, wide in holes], length, RADIUS, MODULUS)
    assert 0.0 <= lost <= 1.0


def test_a_load_changes_the_lost_share_little() -> None:
    """From a third to twice the pressure a hole of a twelfth of the line takes 0.041 to 0.032 of the load."""
    hole = [(-2e-3, 2e-3)]
    shares = [lost_share(hole, LENGTH, RADIUS, MODULUS, pressure) for pressure in (0.4e9, 0.8e9, 1.6e9)]
    assert shares[0] > shares[1] > shares[2] > 0.7 * shares[0]


@pytest.mark.parametrize("depth", [1e-6, 4e-6, 8e-6])
@pytest.mark.parametrize("effects", [None, COUPLED], ids=["independent", "coupled"])
def test_shallow_patches_lose_what_the_half_space_loses(
    lanes: Any, depth: float, effects: EffectSet | None
) -> None:
    """25 %: before their floor is free they take what springs take, and Palmgren's are stiffer by 8 %."""
    patches = (replace(rectangle(8e-3, 8e-3)[0], depth=depth),)
    (lost,) = lost_by_laminae(lanes, patches, [0.0], effects)
    assert lost == pytest.approx(lost_on_the_half_space(patches), rel=0.25)


def test_more_strips_change_nothing() -> None:
    """A round pit of 13, 25 and 49 strips: the load lost over its middle by 1 %, halfway out of it by 3 %."""
    lanes = Lanes(8)
    found = [lost_by_springs(lanes, ellipse(8e-3, 8e-3, count), [0.0, 2e-3], None) for count in (13, 25, 49)]
    for each in found[1:]:
        assert found[0][0] == pytest.approx(each[0], rel=0.01)
        assert found[0][1] == pytest.approx(each[1], rel=0.03)


def test_a_patch_along_the_whole_line_takes_all_of_the_load(lanes: Any) -> None:
    """Nothing is corrected there."""
    (whole,) = rectangle(8e-3, LENGTH)
    cover = counted_cover(BEARING, [whole], 6, None)
    np.testing.assert_array_equal(cover, np.ones((1, 6)))
    assert lost_by_laminae(lanes, (whole,), [0.0], None)[0] == pytest.approx(1.0)


def test_patches_on_each_other_add_their_depths_and_patches_side_by_side_their_lengths(lanes: Any) -> None:
    """Two halves lose as the whole; two patches of half the depth on each other as one."""
    (whole,) = rectangle(8e-3, 8e-3)
    halves = tuple(replace(whole, length=4e-3, offset=offset) for offset in (-2e-3, 2e-3))
    once = lost_by_springs(lanes, (whole,), [0.0, 2e-3], None)
    np.testing.assert_allclose(lost_by_springs(lanes, halves, [0.0, 2e-3], None), once, rtol=1e-6)
    shallow = tuple(replace(whole, depth=depth) for depth in (1e-6, 2e-6))
    deep = replace(whole, depth=3e-6)
    np.testing.assert_allclose(
        lost_by_springs(lanes, shallow, [0.0, 2e-3], None),
        lost_by_springs(lanes, (deep,), [0.0, 2e-3], None),
        rtol=1e-6,
    )

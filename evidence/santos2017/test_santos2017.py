"""The runs of Santos (2017), Dynamics of Tapered Roller Bearings, summary, Sections 7.1 and 8."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.config import shipped_names
from beardyn_core.effects import CoulombTraction
from beardyn_core.scene.scene import Scene
from evidence.santos2017.comparison import (
    AXIAL_FORCE,
    TOO_LITTLE,
    SantosRuns,
    held_by_a_force,
    refusal,
    rows,
    run_all,
)
from evidence.santos2017.friction import contacts_of, while_sliding, with_speed_jump
from evidence.santos2017.runs import SETTLED, STEP_AT, StepRecord, record, weight_carried
from evidence.santos2017.spectrum import Bands, bands, bounce, two_bands, variations

DOCS = Path(__file__).parents[2] / "docs"
REPORTS = DOCS / "evidence"
LARGEST_PICTURE = 60_000
FRICTION = 0.1
LOAD = 5.0e3


@cache
def run(name: str, duration: float | None = None) -> StepRecord:
    scene = load_scene(f"santos_{name}")
    return record(scene if duration is None else replace(scene, duration=duration))


@cache
def everything() -> SantosRuns:
    return run_all()


@cache
def spectra() -> dict[str, Bands]:
    scene = load_scene("santos_step")
    return {variation.name: bands(scene, variation) for variation in variations(scene)}


def test_rollers_make_a_quarter_turn_in_three_hundredths_of_a_second() -> None:
    """Section 7.1: about a quarter; ours within 0.2 % of epicyclic rolling."""
    turn = run("unloaded").cage_turn(0.03)
    assert turn == pytest.approx(0.25 * 2.0 * math.pi, rel=2e-3)


def test_unloaded_rollers_lie_on_cup_and_rib() -> None:
    """Section 7.1: they go to the outer raceway and until the large end meets the flange."""
    unloaded = run("unloaded")
    bearing = unloaded.scene.bearing
    cup, rib, cone = (contacts_of(unloaded, kind) for kind in ("cup", "rib", "cone"))
    snapshots = sum(int((block.snapshot_time_ns >= SETTLED * 1e9).sum()) for block in unloaded.blocks)
    # a roller that its pocket pushes may hop
    assert len(cup.normal) > 0.95 * snapshots * bearing.roller_count
    assert len(rib.normal) > 0.9 * snapshots * bearing.roller_count
    assert len(cone.normal) < 0.1 * len(cup.normal)
    orbit = run("unloaded").cage_turn(0.03) / 0.03
    centrifugal = bearing.roller_mass * orbit**2 * 0.5 * bearing.pitch_diameter
    # the triangle of cup, rib and centrifugal force; the weight is 4 % of that and averages out
    assert cup.normal.mean() == pytest.approx(centrifugal, rel=0.05)


def test_dry_sliding_contacts_have_a_tangential_force_of_ten_per_cent() -> None:
    """Section 7.1: always 10 % of the normal force."""
    rib = contacts_of(run("unloaded"), "rib")
    np.testing.assert_allclose(rib.ratio, FRICTION, rtol=0.02)
    cone = while_sliding(record(with_speed_jump(load_scene("santos_loaded"))), "cone")
    assert len(cone.ratio) >= 7
    assert cone.slip.min() > 1.0
    assert cone.mean_ratio == pytest.approx(FRICTION, rel=0.01)


def test_dry_rolling_contacts_follow_the_law_below_ten_per_cent() -> None:
    """Not as in Section 7.1: where a roller rolls, friction is what it needs and no more."""
    scene = load_scene("santos_loaded")
    cup = contacts_of(run("step"), "cup", STEP_AT + SETTLED)
    assert cup.ratio.max() < 1.03 * FRICTION
    assert 0.01 < cup.mean_ratio < 0.05
    traction = scene.effects.traction
    assert isinstance(traction, CoulombTraction)
    law = FRICTION * cup.slip / np.hypot(cup.slip, traction.regularisation_speed)
    # laminae slip differently, the output has their mean: exact for the typical roller only
    assert np.median(cup.ratio / law) == pytest.approx(1.0, abs=0.05)


def test_the_oil_separates_the_surfaces() -> None:
    """Not as in Section 7.1: full film by the limit 1.5 of its Eq. (8), friction below its 2 %."""
    for kind in ("cup", "cone"):
        contacts = contacts_of(run("lubricated"), kind)
        assert contacts.film_parameter.min() > 1.5
        assert contacts.mean_ratio < 0.01
        assert np.quantile(contacts.ratio, 0.99) < 0.021


def test_force_converges_to_the_load_within_a_hundredth_of_a_second() -> None:
    """Fig. 6(a): 5 kN from 0.01 s on. Ours in every window of 2 ms, and 0.1 % in the mean."""
    step = run("step")
    assert np.abs(step.force[step.time < 0.5 * STEP_AT, 2]).max() < 0.02 * LOAD
    assert step.force[:, 2].max() > 1.1 * LOAD
    after = step.radial_after(STEP_AT + SETTLED)
    window = round(2e-3 / (step.time[1] - step.time[0]))
    means = after[: len(after) // window * window].reshape(-1, window).mean(axis=1)
    np.testing.assert_allclose(means, LOAD, rtol=0.02)
    assert after.mean() == pytest.approx(LOAD, rel=1e-3)


def test_single_row_needs_axial_support() -> None:
    """Section 7.1: an axial force had to be introduced."""
    assert "axial_prop_stiffness_MN_per_m" in refusal()
    assert refusal(TOO_LITTLE)
    assert not refusal(AXIAL_FORCE)


def test_prop_carries_the_thrust_that_a_force_can_carry_instead() -> None:
    scene = load_scene("santos_loaded")
    propped = run("loaded", 0.04)
    thrust = propped.force[propped.time >= SETTLED, 1].mean()
    place = np.concatenate([block.body_pose[:, 1, 1] for block in propped.blocks])[2:].mean()
    assert thrust == pytest.approx(-scene.mounting.axial_prop_stiffness * place, rel=0.01)
    assert 0.2 * LOAD < thrust < AXIAL_FORCE
    held = record(replace(held_by_a_force(scene, AXIAL_FORCE), duration=0.04))
    assert held.axial_range < 1e-6
    assert held.radial_after(SETTLED).mean() == pytest.approx(LOAD, rel=1e-3)


def double_row_holds(name: str, load: float, duration: float) -> None:
    double = run(name, duration)
    assert double.scene.rows == 2
    assert double.scene.mounting.axial_prop_stiffness == 0.0
    force = double.radial_after(SETTLED)
    assert force.mean() == pytest.approx(load, rel=2e-3)
    assert abs(double.force[double.time >= SETTLED, 1].mean()) < 1e-3 * load
    assert double.axial_range < 1e-6


def test_double_row_holds_the_load_without_a_prop() -> None:
    """Section 8: only with a double row equilibrium can be maintained."""
    double_row_holds("double_row", LOAD, 0.06)


@pytest.mark.slow
def test_double_row_holds_a_hundred_kilonewton_for_the_longest_run() -> None:
    double_row_holds("double_row_100kN", 1.0e5, 0.2)


def test_two_bands_are_found_in_order_of_frequency() -> None:
    frequency = np.linspace(0.0, 3.0e4, 301)
    level = np.exp(-(((frequency - 2.0e4) / 500.0) ** 2)) + 0.3 * np.exp(
        -(((frequency - 1.0e4) / 500.0) ** 2)
    )
    level += 0.5 * np.exp(-(((frequency - 2.3e4) / 500.0) ** 2))  # too near the highest
    assert two_bands(frequency, level) == pytest.approx((1.0e4, 2.0e4))


def test_bounce_hardly_depends_on_the_load() -> None:
    """As the load to the power 1/20; the rollers on the cup alone do not see it."""
    scene = load_scene("santos_step")
    light, heavy = bounce(scene, LOAD), bounce(scene, 20.0 * LOAD)
    assert heavy[0] == pytest.approx(light[0], rel=0.01)
    assert heavy[1] / light[1] == pytest.approx(20.0**0.05, rel=0.01)


@pytest.mark.slow
def test_bands_of_the_force_are_roller_bounce_and_not_the_step() -> None:
    """Mass and stiffness move them as expected, the step does not; contact damping takes them away."""
    plain = spectra()["as it is"]
    np.testing.assert_allclose(plain.found, plain.bounce, rtol=0.1)
    damped = 0
    for name, each in spectra().items():
        if each.variation.time_constant > 1e-9:
            damped += 1
            assert each.level < 0.15 * plain.level
            continue
        expected = np.sqrt(np.prod(np.divide(each.bounce, plain.bounce)))
        assert each.shift_from(plain) == pytest.approx(expected, rel=0.05), name
    assert damped == 1


@pytest.mark.slow
def test_whole_roller_length_in_every_slice_puts_a_band_a_tenth_above_thirty_kilohertz() -> None:
    """Fig. 6(b): a band around 30 kHz; ours is at 33 kHz and does not move with the step."""
    stiff, finer = spectra()["contacts 4.92 times as stiff"], spectra()["the same, half the step"]
    assert stiff.found[1] == pytest.approx(33.0e3, rel=0.02)
    assert finer.found[1] == pytest.approx(stiff.found[1], rel=0.01)
    assert spectra()["as it is"].found[1] < 20.0e3


@pytest.mark.slow
def test_page_has_the_rows_as_they_are_computed() -> None:
    """Ours may differ in the last digit, wall times by machine; the published column not at all."""
    page = (REPORTS / "santos2017.md").read_text(encoding="utf-8")
    for row in rows(everything()):
        assert f"| {row.quantity} | {row.published} | " in page, "run python -m evidence.santos2017.page"


def test_pictures_are_small() -> None:
    pictures = sorted((DOCS / "pictures").glob("santos_*.png"))
    assert len(pictures) == 3
    page = (REPORTS / "santos2017.md").read_text(encoding="utf-8")
    for picture in pictures:
        assert picture.stat().st_size < LARGEST_PICTURE
        assert f"(../pictures/{picture.name})" in page


@pytest.mark.parametrize("name", [name for name in shipped_names("scenes") if name.startswith("santos_")])
def test_scene_says_what_it_is_for(name: str) -> None:
    scene: Scene = load_scene(name)
    assert scene.purpose.endswith(".")
    assert (scene.rows == 1) == (scene.mounting.axial_prop_stiffness > 0.0)
    assert scene.numerics.laminae == 6
    assert weight_carried(scene) == pytest.approx(
        9.80665 * scene.rows * (17 * scene.bearing.roller_mass + scene.bearing.cage.mass)
    )

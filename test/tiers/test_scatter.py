"""Scatter in running bearings: who carries more, and the same vibration in all tiers."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.effects import Gravity
from beardyn_core.physics.defect import roller_oversize
from beardyn_core.physics.roller_spring import roller_tangent
from beardyn_core.physics.scatter import crown_errors
from beardyn_core.physics.statics.static import StaticSolution, solve
from beardyn_core.run import blocks
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin
from evidence.validation.cage_whirl import WhirlCase, cage_whirl
from test.scenes import rigid_scene
from test.tiers.runs import FAST, Float, scene_of

FORCE = (0.0, 0.0, 8e4)
LOADED = Scatter(seed=2, roller_diameter=3e-6, profile=4e-6, row_clearance=6e-6)


def static(scene: Scene) -> StaticSolution:
    return solve(
        scene.bearing, FORCE, end_play=scene.end_play, laminae=scene.numerics.laminae, speed=0.5,
        oversize=roller_oversize(scene), crown=crown_errors(scene), tilt="locked",
    )  # fmt: skip


def test_a_larger_roller_carries_more_by_its_own_stiffness_and_what_the_cone_gives_way() -> None:
    """Naive: springs between rigid rings, right in the first order; extra loads within 8 % of the largest.

    Left out are the rib's share of the stiffness (3 %), the tilt of the rollers, with which the error of a
    crown is not its mean, and the second order of the 10/9 law.
    """
    scene = replace(scene_of("static_80kN", "full"), scatter=LOADED)
    nominal, found = static(replace(scene, scatter=None)), static(scene)
    bearing, made = scene.bearing, LOADED.deviations(scene.bearing)
    apart = made.row_clearance - made.row_clearance.mean()
    gap = 0.5 * math.cos(bearing.cup_angle) * apart[:, None]
    more = made.roller_diameter * math.cos(bearing.half_angle) - 2.0 * made.profile / 3.0 - gap
    load = nominal.cone_load.ravel()
    stiffness = np.where(load > 1.0, roller_tangent(bearing) * np.maximum(load, 1.0) ** 0.1, 0.0)
    azimuth = np.tile(2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count, 2)
    side = np.repeat([-1.0, 1.0], bearing.roller_count)
    sine, cosine = math.sin(bearing.cup_angle), math.cos(bearing.cup_angle)
    normal = np.stack([cosine * np.sin(azimuth), -side * sine, cosine * np.cos(azimuth)], axis=1)
    weighed = normal * stiffness[:, None]
    gives_way = normal @ np.linalg.solve(normal.T @ weighed, weighed.T @ more.ravel())
    expected = stiffness * (more.ravel() - gives_way)
    extra = (found.cone_load - nominal.cone_load).ravel()
    sure = load > 0.2 * load.max()  # at the border of the load zone rollers come and go
    assert np.abs(expected[sure]).max() > 0.05 * load.max()
    np.testing.assert_allclose(extra[sure], expected[sure], atol=0.08 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("tier", "tolerance"),
    [("quasistatic", 0.005), ("lumped", 0.05), pytest.param("full", 0.01, marks=pytest.mark.slow)],
)
def test_rollers_of_every_tier_carry_what_the_static_solution_says(tier: str, tolerance: float) -> None:
    """Crawling, so that no roller leaves its place; to a share of the largest load."""
    base = scene_of("static_80kN", tier)
    scene = replace(base, scatter=LOADED, effects=replace(base.effects, gravity=Gravity(0.0)))
    twin = Twin(scene)
    wrench = np.tile(np.array([*FORCE, 0.0, 0.0, 0.0]), (2, 1))
    twin.start(LoadHistory(np.array([0, 10**9]), wrench, np.full(2, 0.5), np.zeros((2, 3))))
    found = twin.advance().contacts[..., 0, 3:6]
    load = np.linalg.norm(found, axis=-1).mean(axis=0)
    expected = static(scene).cup_load
    np.testing.assert_allclose(load, expected, atol=tolerance * expected.max())
    assert np.abs(expected - static(base).cup_load).max() > 10.0 * 0.005 * expected.max()


def forces(scatter: Scatter | None, tier: str = "quasistatic", duration: float = 0.2) -> Float:
    scene = replace(load_scene("static_80kN", tier=tier), scatter=scatter)
    return np.concatenate([block.force for block in blocks(scene, duration)])


@pytest.mark.parametrize("tier", FAST)
def test_a_seed_is_one_bearing_and_no_scatter_leaves_every_bit(tier: str) -> None:
    one, again, other = (forces(Scatter("G2", seed), tier) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, again)
    assert np.abs(one - other).max() > 1.0
    np.testing.assert_array_equal(forces(Scatter(), tier), forces(None, tier))


def test_a_coarser_surface_is_louder_above_4_khz_by_its_factor() -> None:
    """To 0.5 dB; preloaded, so that no roller leaves the load zone and knocks when it comes back."""
    scene = load_scene("waviness", tier="quasistatic")
    quiet = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)

    def level(surface: str) -> float:
        scatter = Scatter("G1", 1, surface)
        made = replace(scene, sensors=quiet, waviness=(), scatter=scatter, end_play=-1e-4)
        found = [block.vibration[0].acceleration[:, 2] for block in blocks(made, 0.4)]
        signal = np.concatenate(found)[2560:]
        power = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(signal)))) ** 2
        return float(10.0 * np.log10(power[np.fft.rfftfreq(len(signal), 1.0 / 25_600) > 4000.0].sum()))

    none, fine, typical, coarse = (level(surface) for surface in ("none", "fine", "typical", "coarse"))
    assert fine - none > 10.0
    assert typical - fine == pytest.approx(10.5, abs=0.5)
    assert coarse - typical == pytest.approx(9.5, abs=0.5)


def test_the_facts_of_a_run_name_every_deviation() -> None:
    scene = replace(load_scene("static_80kN", tier="lumped"), scatter=Scatter("G2", 7))
    assert scene.scatter is not None
    truth: dict[str, Any] = Twin(scene).truth()["scatter"]
    made = scene.scatter.deviations(scene.bearing)
    assert (truth["grade"], truth["seed"]) == ("G2", 7)
    assert truth["roller_diameter_um"] == pytest.approx(2.0)
    assert truth["surface"] == "typical"
    assert truth["surface_factor"] == {"cup": 1.0, "cone": 1.0, "roller": 1.0}
    np.testing.assert_array_equal(truth["deviations_m"]["roller_diameter"], made.roller_diameter)
    assert Twin(replace(scene, scatter=None)).truth()["scatter"] is None


# --- against the full tier

BANDS = 1000.0 * 2.0 ** (np.arange(-9, 9) / 3.0)  # 125 Hz to 6.3 kHz
AXIAL = (450.0, 900.0)  # the axlebox along the axle


@cache
def levels(tier: str, scattered: bool) -> Float:
    """Third octaves of the axlebox's acceleration along y, z at 300 km/h, no noise, [2, band], [dB]."""
    scene = rigid_scene("healthy_300", tier=tier)
    assert isinstance(scene.operation, QuarterVehicleOperation)
    line = Irregularity("china_ballastless", shortest_wavelength=0.1, short_waves="none")  # of bearing noise
    scene = replace(scene, operation=replace(scene.operation, irregularity=line))
    quiet = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    scene = replace(scene, sensors=quiet, scatter=Scatter("G2", 7) if scattered else None)
    signal = np.concatenate([block.vibration[0].acceleration for block in blocks(scene, 2.5)])[12_800:, 1:]
    size, window = 8192, np.hanning(8192)[:, None]
    parts = [signal[at : at + size] for at in range(0, len(signal) - size, size // 2)]
    power = np.mean(
        [np.abs(np.fft.rfft((part - part.mean(axis=0)) * window, axis=0)) ** 2 for part in parts], 0
    )
    frequency = np.fft.rfftfreq(size, 1.0 / 25_600)
    edge = 2.0 ** (1.0 / 6.0)
    inside = [(frequency >= band / edge) & (frequency < band * edge) for band in BANDS]
    return 10.0 * np.log10(np.array([power[each].sum(axis=0) for each in inside]).T + 1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("tier", FAST)
def test_healthy_spectrum_of_the_fast_tiers_is_that_of_the_full_one(tier: str) -> None:
    """Within 3 dB, 4 in `lumped`: along z from 125 Hz to 6.3 kHz, along y from 160 Hz beside the axial mode.

    What drives that mode in `full` is skew of the rollers besides: with the creep along the cup, which keeps
    it down at lower speed, it is 4.7 dB too quiet here (1.3 too loud without). Along y at 125 Hz, a few lines
    of the spacing, the fast tiers are up to 4.1 dB off.
    Of identical rollers it is not: along z 10 dB and more in `lumped`, 3 and more where rollers move in their
    pockets, and along y the fast tiers are too quiet by as much in most bands.
    """
    apart = np.abs(levels(tier, True) - levels("full", True))
    assert apart[1].max() < {"lumped": 4.0, "quasistatic": 3.0}[tier]
    beside = (AXIAL[0] > BANDS) | (AXIAL[1] < BANDS)
    assert apart[0][1:][beside[1:]].max() < 3.0
    assert apart[0][~beside].max() < 5.0
    assert apart[0][0] < 5.0
    identical = np.abs(levels(tier, False) - levels("full", False))
    far = identical[0] > {"lumped": 10.0, "quasistatic": 3.0}[tier]
    assert far.mean() > 0.8  # of the bands


@pytest.mark.slow
def test_scatter_unevens_the_spacing_and_ties_the_whirl_to_the_cage() -> None:
    """10 kN along the axle: identical rollers stay even while their cage goes round by itself in its play.

    They are looked at for 1.2 s. After 1.5 to 4 s their cage has come to its play. There it hits them, going
    round at 2.2 times its speed, and leaves them even to 1.2 um; or, in 2 of 14 runs from other places, its
    centre turns with itself, lies on the same rollers and has pushed them 11 um apart after 4 s. That goes on
    alike with 1, 2 and 4 times the usual steps; which of the two a run comes to is chance. Rollers as made
    take 400 revolutions, 10 s, to settle; at 4 s their cage turns at 1.00 to 1.24 of itself.
    """
    scene = load_scene("static_80kN")
    scene = replace(scene, effects=replace(scene.effects, gravity=None))
    case = [WhirlCase(240.0, 1e4)]
    even = cage_whirl(scene, case, duration=1.2, settled=0.6)
    made = cage_whirl(replace(scene, scatter=Scatter("G2", 1)), case, duration=10.0, settled=7.5)
    assert even.spacing[0] < 1e-7
    assert made.spacing[0] > 1e-5
    assert made.frequency[0] == pytest.approx(1.0, abs=0.005)
    assert abs(even.frequency[0] - 1.0) > 0.02

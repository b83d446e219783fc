"""What faults do to a running bearing.

All runs share one specialisation: what a test does not ask for is present with no size.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.physics.bodies.layout import (
    CONE,
    CONTACT_OUTPUT,
    CUP,
    ENERGY_ELASTIC,
    ENERGY_EXTERNAL,
    ENERGY_KINETIC,
    ENERGY_LOST,
    ENERGY_NUMERICAL,
    OUTPUT_FIELDS,
    RADIUS,
    SIGNAL_FORCE,
    TURN,
)
from beardyn_core.physics.bodies.losses import LOSSES
from beardyn_core.physics.lamina_table import surface_radius
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.scene.defect import Defect, RollerError, WornPocket
from beardyn_core.scene.patch import Growth, Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Waviness, band_amplitudes
from beardyn_core.twin import Twin
from test.kernels.rig import Float, Rig
from test.runs import constant_load
from test.scenes import SPEED, scene_with, standard_scene

Z = 17
STEP = 1.0 / (25_600 * 4)
HEAVY: dict[str, Any] = {"journal_mass": 1e12}
SURFACES = ("cup", "cone", "roller")
FLAT = tuple(Patch(on, 0, 0.0, 6e-3, 0.0, 0.05) for on in SURFACES)
SPALL = Patch("cup", 0, math.pi / Z, 6e-3, 2e-6, 0.05)


def faulty(*defects: Defect, waviness: tuple[Waviness, ...] = (), **changes: Any) -> Scene:
    """A scene with these faults, and with every other kind of no size."""
    round_ones = tuple(Waviness(on, 0, (5,), (0.0,)) for on in SURFACES)
    none: tuple[Defect, ...] = (*FLAT, RollerError(0, 0, 0.0), WornPocket(0, 0, 0.0))
    return scene_with(defects=(*none, *defects), waviness=(*round_ones, *waviness), **changes)


def contact_force(rig: Rig, steps: int, roller: int) -> tuple[Float, Float]:
    """Force of cup and cone on a roller of row 0 every second step."""
    _, trend, _ = rig.run(steps, steps // 2)
    fields = rig.arrangement.to_rollers(np.moveaxis(trend, 2, 0))[:, :, 0, roller]
    first = [CONTACT_OUTPUT + contact * OUTPUT_FIELDS for contact in (CUP, CONE)]
    cup, cone = (np.linalg.norm(fields[at : at + 3], axis=0) for at in first)
    return cup, cone


def dips(faulty_force: Float, sound_force: Float) -> list[tuple[float, float]]:
    """Entry and exit time of every dip, at half of the deepest."""
    drop = faulty_force - sound_force
    low = np.flatnonzero(drop < 0.5 * drop.min())
    groups = np.split(low, np.flatnonzero(np.diff(low) > 20) + 1)
    return [(2.0 * STEP * group[0], 2.0 * STEP * (group[-1] + 1)) for group in groups]


def test_every_fault_of_no_size_is_an_absent_one() -> None:
    """To 1e-12 of the load.

    The two are compiled apart and round differently, which free rollers amplify: 4e-12 after 1000 steps.
    """
    patches_apart = [defect for defect in faulty().defects if not isinstance(defect, Patch)]
    scene = replace(faulty(), defects=tuple(patches_apart))
    present, absent = Rig.at_equilibrium(scene), Rig.at_equilibrium(scene_with())
    with_faults, without = present.run(256)[0], absent.run(256)[0]
    np.testing.assert_allclose(with_faults[:, :3], without[:, :3], atol=1e-12 * 8e4, rtol=1e-12)
    np.testing.assert_allclose(present.fields()[:13], absent.fields()[:13], rtol=1e-11, atol=1e-11)


def test_a_patch_of_no_depth_changes_what_begins_and_ends_within_a_step_alone() -> None:
    """While roller 0 leaves the flat patches it starts on (60 steps) and beyond.

    To 1e-12 of the load until a roller leaves the load zone: in a bearing with patches a contact that begins
    or ends within a step has a part of its force (`physics.laminae`); from then on to 1e-6.
    """
    present, absent = Rig.at_equilibrium(faulty()), Rig.at_equilibrium(scene_with())
    with_patches, without = present.run(256)[0], absent.run(256)[0]
    np.testing.assert_allclose(with_patches[:100, :3], without[:100, :3], atol=1e-12 * 8e4, rtol=1e-12)
    np.testing.assert_allclose(with_patches[:, :3], without[:, :3], atol=1e-6 * 8e4)


@pytest.mark.parametrize("width", [3e-3, 6e-3, 9e-3])
@pytest.mark.parametrize(("on", "speed"), [("cup", 0.0), ("cone", SPEED)])
def test_time_from_entry_to_exit_is_width_over_the_speed_of_the_roller_on_the_surface(
    on: str, speed: float, width: float
) -> None:
    """Edges at half of the drop, where the roller is sqrt(2 r depth/2) inside; two samples of 20 us.

    The cone overtakes the roller: its patch starts behind the roller and passes it.
    """
    azimuth = math.pi / Z if on == "cup" else -math.pi / Z
    spall = replace(SPALL, on=on, width=width, azimuth=azimuth)
    sound, spalled = (Rig.at_equilibrium(faulty(*d, **HEAVY)) for d in ((), (spall,)))
    pair = contact_force(spalled, 1024, 0), contact_force(sound, 1024, 0)
    contact = CUP if on == "cup" else CONE
    ((entry, leave),) = dips(pair[0][contact], pair[1][contact])
    bearing = standard_scene().bearing
    cage = fault_frequencies(bearing).ftf * SPEED
    surface_speed = abs(cage - speed) * surface_radius(bearing, on)
    inside = math.sqrt(2.0 * 0.5 * bearing.roller_diameter * 1e-6)
    assert leave - entry == pytest.approx((width - 2.0 * inside) / surface_speed, abs=4.0 * STEP, rel=0.01)


def test_roller_defect_hits_cup_and_cone_in_turn_at_twice_the_spin_frequency() -> None:
    """Roller 15 passes the load zone; the hits are half a turn of its spin apart.

    Each hit unloads both contacts, for the roller between them is free.
    """
    spall = replace(SPALL, on="roller", roller=15, azimuth=0.6, width=4e-3)
    runs = []
    for defects in ((), (spall,)):
        rig = Rig.at_equilibrium(faulty(*defects, **HEAVY))
        _, trend, _ = rig.run(2560, 1280)
        fields = rig.arrangement.to_rollers(np.moveaxis(trend, 2, 0))[:, :, 0, 15]
        runs.append((np.linalg.norm(fields[CONTACT_OUTPUT : CONTACT_OUTPUT + 3], axis=0), fields[RADIUS]))
    times = np.array([0.5 * (entry + leave) for entry, leave in dips(runs[1][0], runs[0][0])])
    assert len(times) >= 3
    # the roller moves towards the ring whose raceway its patch faces
    outward = (runs[1][1] - runs[0][1])[np.round(times / (2.0 * STEP)).astype(int)]
    assert np.all(np.abs(outward) > 0.2e-6)
    assert np.all(outward[1:] * outward[:-1] < 0.0)
    bsf = fault_frequencies(standard_scene().bearing).bsf * SPEED / (2.0 * math.pi)
    np.testing.assert_allclose(np.diff(times), 1.0 / (2.0 * bsf), rtol=0.02)


def cup_wave_lines(order: int) -> tuple[float, float]:
    """Radial and axial force at BPFO of a preloaded bearing without load, cup wavy in row 0."""
    wave = Waviness("cup", 0, (order,), (2e-7,))
    rig = Rig.at_equilibrium(faulty(waviness=(wave,), end_play=-4e-5, **HEAVY), force=(0.0, 0.0, 0.0))
    rig.run(1024)
    turned = rig.state.bodies[2, TURN]
    force = rig.run(8192)[0][:, SIGNAL_FORCE : SIGNAL_FORCE + 3]
    rate = (rig.state.bodies[2, TURN] - turned) / (len(force) * STEP)
    time = np.arange(len(force)) * STEP
    window = np.hanning(len(force))
    line = np.exp(-1j * Z * rate * time) * window @ (force - force.mean(axis=0)) * 2.0 / window.sum()
    return float(np.hypot(abs(line[0]), abs(line[2]))), float(abs(line[1]))


def test_cup_waves_of_order_z_push_axially_and_of_z_plus_minus_one_radially_at_bpfo() -> None:
    """Orders i Z and i Z +- 1: Wardle (1988), Yhland (1967); other orders leave the rings in peace."""
    radial, axial = cup_wave_lines(Z)
    assert axial > 10.0 * radial
    for order in (Z - 1, Z + 1):
        beside, along = cup_wave_lines(order)
        assert beside > 10.0 * along
        assert beside > axial  # the contact angle is flat: cos is more than sin
    for order in (Z - 3, Z + 2):
        assert max(cup_wave_lines(order)) < 0.05 * axial


def test_oversize_roller_carries_more_and_starts_in_equilibrium() -> None:
    """10 um more in diameter against 8 um of approach; the first 0.5 ms keep the static load within 1 %."""
    loads = []
    for error in (0.0, 1e-5):
        rig = Rig.at_equilibrium(faulty(RollerError(0, 1, error), **HEAVY))
        loads.append(contact_force(rig, 48, 1)[0])
    assert loads[1].mean() > 1.2 * loads[0].mean()
    # its orbit carries it 0.025 rad down the load zone, the same for both
    slope = loads[0] / loads[0][0]
    np.testing.assert_allclose(loads[1] / loads[1][0], slope, rtol=0.01)


def test_force_is_continuous_in_the_place_of_a_patch_along_the_roller() -> None:
    """A whole lamina less would be a sixth of the force; a shift of 0.25 mm may take 1.5 % at both ends."""
    rig = Rig.at_equilibrium(faulty(**HEAVY))
    kept = rig.state.copy()
    force = []
    for offset in np.arange(-15.0e-3, 15.0e-3, 0.25e-3):
        patch = replace(SPALL, azimuth=0.0, depth=1e-4, length=0.02, offset=offset)
        scene = faulty(patch, **HEAVY)
        rig.parameters = build_parameters(scene, rig.arrangement, np.zeros(6))
        rig.state = kept.copy()
        force.append(contact_force(rig, 2, 0)[0][-1])
    jumps = np.abs(np.diff(force))
    assert np.ptp(force) > 0.0
    assert jumps.max() < 0.015 * max(force)


def residual(scene: Scene, blocks: int) -> float:
    """Energy residual over dissipation, with the rings moving."""
    rig = Rig.at_equilibrium(scene)
    rig.run(2048)
    rig.run(1)
    first = rig.audit.copy()
    for _ in range(blocks):
        rig.run(2048)
    since = rig.audit - first
    lost = since[ENERGY_LOST : ENERGY_LOST + LOSSES].sum()
    stored = since[ENERGY_ELASTIC] + since[ENERGY_KINETIC]
    return abs(float(since[ENERGY_EXTERNAL] - lost - since[ENERGY_NUMERICAL] - stored)) / float(lost)


ROUGH = tuple(Waviness(on, 0, tuple(range(2, 31)), band_amplitudes(2, 30, 5e-7)) for on in SURFACES)
DENTED = (
    Patch("cup", 0, 0.2, 6e-3, 1e-4, 0.025),
    Patch("cone", 1, 0.0, 3e-3, 3e-5, 0.01, 8e-3, kind="dent", rim_height=4e-6, rim_width=1e-3),
    Patch("roller", 0, 0.4, 4e-3, 6e-5, 0.02, roller=2, kind="elliptic"),
)


@pytest.mark.parametrize(("defects", "waviness"), [((), ROUGH), (DENTED, ())])
def test_energy_balances_over_faults(defects: tuple[Defect, ...], waviness: tuple[Waviness, ...]) -> None:
    """The lean of the normal does the work that the gap takes from the springs: 0.1 % of what is lost."""
    assert residual(faulty(*defects, waviness=waviness), 5) < 1e-3


def test_energy_balances_where_rollers_fall_in_and_strike() -> None:
    """A contact that opens faster than its springs follow leaves 2 % of the losses in its dampers.

    What is left falls with the square of the step: 0.7 % at 4 steps a sample, 0.15 % at 8.
    """
    pit = Patch("cup", 0, 0.0, 6e-3, 2e-3, 0.05)
    assert residual(faulty(pit, steps_per_sample=8), 10) < 5e-3


def test_growing_patch_continues_from_a_snapshot_bit_for_bit_and_its_truth_tells_the_size() -> None:
    grown = replace(SPALL, azimuth=0.0, depth=5e-5, growth=Growth(0.0, 0.1))
    scene = faulty(grown)
    twin = Twin(scene)
    twin.start(constant_load((0.0, 0.0, 8e4), SPEED))
    twin.advance()
    assert twin.truth()["faults"][-1]["size_now"]["width"] == pytest.approx(0.2 * 6e-3)
    kept = twin.snapshot()
    first = [twin.advance() for _ in range(3)]
    twin.restore(kept)
    again = [twin.advance() for _ in range(3)]
    for one, two in zip(first, again, strict=True):
        np.testing.assert_array_equal(one.acceleration, two.acceleration)
    other = Twin(scene)
    other.restore(kept)
    np.testing.assert_array_equal(other.advance().acceleration, first[0].acceleration)
    full = Twin(faulty(replace(grown, growth=None)))
    full.start(constant_load((0.0, 0.0, 8e4), SPEED))
    assert not np.array_equal(full.advance().acceleration, first[0].acceleration)


def test_patch_grows_linearly_in_width_and_depth_or_in_one_of_them() -> None:
    patch = replace(SPALL, width=8e-3, depth=4e-5, rim_height=2e-6, growth=Growth(1.0, 3.0, 0.25))
    assert patch.size_at(0.0) == pytest.approx((2e-3, 1e-5, 5e-7))
    assert patch.size_at(2.0) == pytest.approx((5e-3, 2.5e-5, 1.25e-6))
    assert patch.size_at(9.0) == pytest.approx((8e-3, 4e-5, 2e-6))
    deeper = replace(patch, growth=Growth(1.0, 3.0, 0.0, width=False))
    assert deeper.size_at(2.0) == pytest.approx((8e-3, 2e-5, 1e-6))

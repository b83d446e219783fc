"""Options of the rib and the small rib in the whole step: absent, at zero, balanced, and at work."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numba
import numpy as np
import pytest

from beardyn_core.base.jit import OPTIONS
from beardyn_core.effects import EffectSet, Rib, RibMixedFilm, RibShearedFilm, SmallRib
from beardyn_core.physics.bodies.layout import (
    AXIS,
    CAGE_BODY,
    CONE_BODY,
    CONTACT_OUTPUT,
    CUP_BODY,
    ENERGY_LOST,
    LOSS_RIB,
    LOSS_SMALL_RIB,
    OUTPUT_FIELDS,
    OUTPUT_FORCE,
    OUTPUT_SLIP,
    POSITION,
    RIB,
    SIGNAL_TORQUE,
    VELOCITY,
)
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.scene.scene import Scene
from test.kernels.entries import ribs
from test.kernels.momentum import momenta
from test.kernels.rig import Rig, parameters_of
from test.kernels.states import shaken
from test.runs import Record, constant_load, record_under
from test.scenes import SPEED, scene_with, tapered

STEPS = 512
EVERYTHING = Rib(roller_end=True, drilling=True, lubrication=RibShearedFilm())


def with_rib(rib: Rib, small_rib: SmallRib | None = None) -> Scene:
    return scene_with(replace(EffectSet(), rib=rib, small_rib=small_rib))


@cache
def signals_of(rib: Rib, small_rib: SmallRib | None = None, clearance: float = 0.4e-3) -> Any:
    scene = with_rib(rib, small_rib)
    scene = replace(scene, bearing=replace(tapered(scene), small_rib_clearance=clearance))
    rig = Rig.at_equilibrium(scene)
    signals, _, _ = rig.run(STEPS)
    return signals, rig


def same(first: Any, second: Any) -> None:
    """Equal to rounding over 512 steps."""
    np.testing.assert_allclose(first[0][:, :3], second[0][:, :3], rtol=0.0, atol=1e-12 * 8e4 * 100)
    np.testing.assert_allclose(first[0][:, SIGNAL_TORQUE], second[0][:, SIGNAL_TORQUE], atol=1e-7)


# --- absent and zero


@pytest.mark.slow
def test_window_changes_nothing_where_contacts_stay_on_the_face() -> None:
    same(signals_of(Rib()), signals_of(Rib(window=False)))


@pytest.mark.slow
def test_film_with_the_dry_coefficient_is_no_film() -> None:
    """Zero amplitude: boundary and film friction both at the dry 0.05."""
    same(signals_of(Rib(lubrication=RibMixedFilm(0.7, 0.05, 0.05))), signals_of(Rib()))


@pytest.mark.slow
def test_small_rib_out_of_reach_is_no_small_rib() -> None:
    same(signals_of(Rib(), SmallRib(), 8e-3), signals_of(Rib()))


@pytest.mark.slow
def test_options_that_are_absent_leave_no_code() -> None:
    """Machine instructions of the rib contact alone grow with every option."""
    counts = []
    for rib in (Rib(window=False, roller_end=False), Rib(), EVERYTHING):
        kernel = numba.njit(**{**OPTIONS, "cache": False})(ribs.py_func)
        params = parameters_of(with_rib(rib)).effects.rib
        kernel(Lanes(8), np.ones((1, 22, 8)), np.zeros((1, 8, 8)), params, None)
        (listing,) = kernel.inspect_asm().values()
        lines = (line.strip() for line in listing.splitlines())
        counts.append(
            sum(1 for line in lines if line and not line.startswith((".", "#")) and line[-1] != ":")
        )
    assert counts == sorted(counts)
    assert len(set(counts)) == len(counts)


# --- balance


@pytest.mark.slow
@pytest.mark.parametrize("contact", ["rib", "small rib"])
def test_rib_and_cone_exchange_one_force_and_one_moment(contact: str) -> None:
    """As `test_momentum_pairs`, with every option of the rib and with the small rib pressed."""
    rig = shaken(31)
    p = build_parameters(with_rib(EVERYTHING, SmallRib()), rig.arrangement, np.zeros(6))
    assert p.effects.rib is not None
    assert p.effects.small_rib is not None
    assert p.effects.cage is not None
    cage = p.effects.cage._replace(half_clearance=1.0, half_end_clearance=1.0)
    rib, small = p.effects.rib, p.effects.small_rib
    if contact == "rib":
        small = small._replace(place=small.place - 1.0)
    else:
        rib = rib._replace(distance=rib.distance + 1.0, end=rib.end._replace(place=-1.0))  # type: ignore[union-attr]
        small = small._replace(place=small.place + 4.3e-4)
    effects = p.effects._replace(rib=rib, small_rib=small, cage=cage, gravity=None)
    rig.parameters = p._replace(effects=effects, cup=p.cup._replace(gap=1.0), cone=p.cone._replace(gap=1.0))
    linear, angular, size = momenta(rig)
    rig.run(1)
    linear_after, angular_after, _ = momenta(rig)
    wrenches, bodies = rig.work.wrenches, rig.state.bodies
    assert np.linalg.norm(wrenches[CONE_BODY, :3]) > 10.0
    force, moment = np.zeros(3), np.zeros(3)
    for body in (CUP_BODY, CONE_BODY):
        force += wrenches[body, :3]
        moment += wrenches[body, 3:] + np.cross(bodies[body, POSITION : POSITION + 3], wrenches[body, :3])
    assert np.abs(wrenches[CAGE_BODY:]).max() == 0.0
    assert np.abs(linear_after - linear + p.step * force).max() < 1e-12 * size
    assert np.abs(angular_after - angular + p.step * moment).max() < 1e-13 * size


@cache
def record(rib: Rib) -> Record:
    return record_under(
        with_rib(rib, SmallRib() if rib == EVERYTHING else None), constant_load((0.0, 1.5e4, 8e4), SPEED), 8
    )


@pytest.mark.slow
def test_energy_balance_closes_with_every_option() -> None:
    found = record(EVERYTHING)
    assert found.residual < 1e-3
    assert found.status == 0


@pytest.mark.slow
def test_rib_loses_what_its_friction_formula_says() -> None:
    """Sum of mu Q_f v over the rollers, and with spin inside the ellipse 10 to 20 % more (0.18 (a/h)^2)."""
    powers = {}
    for rib in (Rib(), Rib(drilling=True)):
        rig = Rig.at_equilibrium(with_rib(rib))
        rig.run(1024)
        before = rig.state.energy[ENERGY_LOST + LOSS_RIB]
        plain, count = 0.0, 16
        for _ in range(count):
            rig.run(64)
            fields = rig.fields()
            first = CONTACT_OUTPUT + RIB * OUTPUT_FIELDS
            force = np.linalg.norm(fields[first + OUTPUT_FORCE : first + OUTPUT_FORCE + 3], axis=0)
            plain += float((0.05 * force * fields[first + OUTPUT_SLIP]).sum()) / count
        powers[rib.drilling] = (
            (rig.state.energy[ENERGY_LOST + LOSS_RIB] - before) / (64 * count * rig.parameters.step) / plain
        )
    assert powers[False] == pytest.approx(1.0, rel=0.02)
    assert 1.08 < powers[True] / powers[False] < 1.2


@pytest.mark.slow
def test_lubricated_rib_shows_its_film_and_costs_less() -> None:
    """A full film of some micrometres carries the rib of a warm bearing; the dry rib has none."""
    dry, wet = record(Rib()), record(EVERYTHING)
    loaded = np.linalg.norm(wet.blocks[-1].contacts[-1, :, :, RIB, 3:6], axis=-1) > 100.0
    assert loaded.sum() > 8
    film = wet.blocks[-1].contacts[-1, :, :, RIB, 7]
    assert np.all(film[loaded] > 5e-7)
    assert np.all(film[loaded] < 1e-5)
    np.testing.assert_array_equal(dry.blocks[-1].contacts[-1, :, :, RIB, 7], 0.0)
    torque = [float(np.mean([b.shaft_torque.mean() for b in r.blocks[-3:]])) for r in (dry, wet)]
    assert abs(torque[1]) < abs(torque[0])


# --- small rib at work


@pytest.mark.slow
def test_small_rib_stops_a_roller_that_slides_to_the_small_end() -> None:
    """No load, no cage: pushed with 0.3 m/s along its axis a roller travels the clearance and comes back."""

    def travel(small_rib: SmallRib | None) -> tuple[float, float]:
        effects = replace(EffectSet(), cage=None, small_rib=small_rib)
        rig = Rig.at_equilibrium(scene_with(effects, end_play=4e-4), force=(0.0, 0.0, 0.0))
        fields = rig.fields()
        axis = fields[AXIS : AXIS + 3]
        start = fields[:3].copy()
        fields[VELOCITY : VELOCITY + 3] -= 0.3 * axis
        rig.set_fields(fields)
        farthest = 0.0
        for _ in range(64):
            rig.run(8)
            moved = rig.fields()[2] - start[2]
            farthest = max(farthest, float(-moved.min()))
        return farthest, float(rig.state.energy[ENERGY_LOST + LOSS_SMALL_RIB])

    with_, lost = travel(SmallRib())
    without, nothing = travel(None)
    assert with_ == pytest.approx(0.4e-3, abs=5e-5)
    assert without > 6e-4
    assert lost > 0.0
    assert nothing == 0.0

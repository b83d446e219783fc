"""Zero amplitude equals absence: every effect and option present with no size, against none of them.

Two kernels in all: the one with everything also shows that each amplitude, when it is not zero, is felt.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
import yaml

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.choice import scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.effects import (
    Audit,
    Cage,
    ContactDamping,
    CoulombTraction,
    Drag,
    EffectSet,
    Gravity,
    LaminaCoupling,
    LandGuidance,
    LineFilm,
    PocketFilm,
    Rib,
    RibMixedFilm,
    RingStructure,
    RollingResistance,
    Seal,
    SmallRib,
)
from beardyn_core.physics.bodies.layout import ROLLER_STATES
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.scene.defect import Defect, RollerError, WornPocket
from beardyn_core.scene.patch import PATCH_KINDS, Growth, Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Waviness
from test.kernels.rig import Float, Rig, parameters_of
from test.scenes import scene_with, standard_scene, tapered

pytestmark = pytest.mark.slow

STEPS, LONG = 100, 800
FORCE = 8e4
SLOW_CAGE = 0.98  # so that the pockets touch
DRY = CoulombTraction(friction=0.05)
ABSENT = EffectSet(contact_damping=None, traction=DRY, film=None, gravity=None, audit=None)
ZERO = EffectSet(
    contact_damping=ContactDamping(0.0),
    lamina_coupling=LaminaCoupling(strength=0.0),
    traction=DRY,
    film=LineFilm(thermal="murch_wilson", isoviscous=True),  # Coulomb's law does not ask for it
    rolling_resistance=RollingResistance(supply=0.0),
    drag=Drag(drag_coefficient=0.0, churning=0.0),
    rib=Rib(roller_end=True, drilling=True, lubrication=RibMixedFilm(0.7, Rib.friction, Rib.friction)),
    small_rib=SmallRib(),
    cage=Cage(lubrication=PocketFilm(), guidance=LandGuidance()),
    seal=Seal(torque=0.0, speed_coefficient=0.0),
    structure=RingStructure(stiffness_factor=1e19),
    gravity=Gravity(0.0),
    audit=Audit(),
)
FLAT = tuple(
    Patch(on, row, 0.0, 4e-3, 0.0, 0.02, kind=kind, rim_height=0.0, rim_width=1e-3)
    for kind in PATCH_KINDS
    for on, row in (("cup", 0), ("cone", 1), ("roller", 0))
    if (kind, on) != ("brinelling", "roller")
)
NO_FAULT: tuple[Defect, ...] = (*FLAT, RollerError(0, 0, 0.0), WornPocket(0, 0, 0.0))
ROUND = tuple(Waviness(on, 0, (5,), (0.0,)) for on in ("cup", "cone", "roller"))
OUT_OF_REACH, IN_REACH = 8e-3, 1e-9  # clearance of the small rib, [m]


def zero_scene(defects: tuple[Defect, ...] = NO_FAULT, waves: tuple[Waviness, ...] = ROUND) -> Scene:
    return scene_with(ZERO, defects=defects, waviness=waves)


def with_effects(**members: Any) -> Scene:
    scene = zero_scene()
    return replace(scene, effects=replace(scene.effects, **members))


def instead(index: int, defect: Defect) -> Scene:
    """A fault in the place of one of the same kind without size: nothing is compiled anew."""
    return zero_scene((*NO_FAULT[:index], defect, *NO_FAULT[index + 1 :]))


def run(
    scene: Scene, steps: int, option: str = "", clearance: float = OUT_OF_REACH, hair: int = 0
) -> tuple[Float, Rig]:
    """Forces and rig after some steps from one state; options that have no amplitude are zeroed here."""
    scene = replace(scene, bearing=replace(tapered(scene), small_rib_clearance=clearance))
    rig = Rig.at_equilibrium(scene, cage_ratio=SLOW_CAGE)
    p = build_parameters(scene, rig.arrangement, np.zeros(6))
    cage, rib = p.effects.cage, p.effects.rib
    assert cage is not None
    assert rib is not None
    if cage.film is not None and option != "pocket film":
        cage = cage._replace(film=cage.film._replace(wedge=0.0, squeeze=0.0, shear=0.0))
    if cage.land is not None and option != "land":
        cage = cage._replace(land=cage.land._replace(film=0.0, drag=0.0, clearance=1.0))
    if rib.drilling is not None and option != "drilling":
        rib = rib._replace(drilling=rib.drilling._replace(reach=0.0))
    rig.parameters = p._replace(effects=p.effects._replace(cage=cage, rib=rib))
    start = start_of_all(hair)
    rig.state.rollers[:, :ROLLER_STATES] = start.rollers[:, :ROLLER_STATES]
    rig.state.bodies[:] = start.bodies
    rig.state.flex[:] = 0.0
    signals, _, _ = rig.run(steps)
    return signals, rig


@cache
def start_of_all(hair: int) -> Any:
    """The same beginning for all runs, or some hairs beside it: an equilibrium differs with its effects."""
    return Rig.at_equilibrium(scene_with(ABSENT), cage_ratio=SLOW_CAGE * (1.0 + 1e-6 * hair)).state.copy()


@cache
def zero() -> Float:
    return run(zero_scene(), LONG)[0]


def test_everything_of_no_size_is_nothing() -> None:
    """Forces and moments to 1e-12 of the load, places and velocities to 1e-12 of their size, over 1 ms.

    No contact damping, and pockets that hit: from three starts of eight a last place becomes 4e-12 to 4e-10.
    What a thing of no size does it does from each of them, so the start that tells best counts.
    """
    assert min(difference(hair) for hair in range(5)) < 1e-12


def difference(hair: int) -> float:
    """How far a run with everything of no size is from one with nothing, the worst share of a size."""
    found, present = run(zero_scene(), STEPS, hair=hair)
    expected, absent = run(scene_with(ABSENT), STEPS, hair=hair)
    one, two = present.fields()[:ROLLER_STATES], absent.fields()[:ROLLER_STATES]
    return max(
        float(np.abs(found[:, :6] - expected[:, :6]).max()) / FORCE,
        float(np.max(np.abs(one - two) / (np.abs(two).max(axis=(1, 2), keepdims=True) + 1e-3))),
        float(np.abs(present.state.bodies - absent.state.bodies).max()),
    )


SPALL = Patch("cup", 0, 0.0, 4e-3, 1e-5, 0.02)
FELT: dict[str, tuple[Scene, str, float]] = {
    "contact damping": (with_effects(contact_damping=ContactDamping()), "", OUT_OF_REACH),
    "coupling": (with_effects(lamina_coupling=LaminaCoupling()), "", OUT_OF_REACH),
    "rolling": (with_effects(rolling_resistance=RollingResistance()), "", OUT_OF_REACH),
    "drag": (with_effects(drag=Drag()), "", OUT_OF_REACH),
    "rib film": (
        with_effects(rib=replace(ZERO.rib, lubrication=RibMixedFilm())),  # type: ignore[type-var]
        "",
        OUT_OF_REACH,
    ),
    "drilling": (zero_scene(), "drilling", OUT_OF_REACH),
    "small rib": (zero_scene(), "", IN_REACH),
    "pocket film": (zero_scene(), "pocket film", OUT_OF_REACH),
    "land": (zero_scene(), "land", OUT_OF_REACH),
    "seal": (with_effects(seal=Seal()), "", OUT_OF_REACH),
    "flexibility": (with_effects(structure=RingStructure()), "", OUT_OF_REACH),
    "gravity": (with_effects(gravity=Gravity()), "", OUT_OF_REACH),
    **{
        f"{patch.kind} on {patch.on}": (instead(i, replace(patch, depth=1e-5)), "", OUT_OF_REACH)
        for i, patch in enumerate(FLAT)
    },
    "rim": (instead(0, replace(FLAT[0], rim_height=1e-6)), "", OUT_OF_REACH),
    "diameter": (instead(len(FLAT), RollerError(0, 0, 1e-6)), "", OUT_OF_REACH),
    "worn pocket": (instead(len(FLAT) + 1, WornPocket(0, 0, 1e-3)), "", OUT_OF_REACH),
    "waviness": (zero_scene(waves=(Waviness("cup", 0, (5,), (1e-7,)), *ROUND[1:])), "", OUT_OF_REACH),
}


@pytest.mark.parametrize("name", FELT)
def test_an_amplitude_that_is_not_zero_is_felt(name: str) -> None:
    """Otherwise the comparison above would say nothing."""
    found = run(FELT[name][0], LONG, *FELT[name][1:])[0]
    assert np.abs(found - zero()).max() > 1e-6


def test_growth_to_the_full_size_is_the_full_size() -> None:
    """A patch that has grown, and one whose initial share is 1, are those that never grew, bit by bit."""
    arrangement = Rig.at_equilibrium(instead(0, SPALL)).arrangement
    whole = build_parameters(instead(0, SPALL), arrangement, np.zeros(6)).effects.faults.cup
    ungrown = replace(SPALL, growth=Growth(1.0, 2.0, 1.0))
    grown = build_parameters(instead(0, ungrown), arrangement, np.zeros(6)).effects.faults.cup
    assert whole is not None
    assert grown is not None
    for one, two in zip(whole, grown, strict=True):
        np.testing.assert_array_equal(one, two)
    assert ungrown.size_at(0.5) == SPALL.size_at(0.5)
    assert replace(ungrown, growth=Growth(1.0, 2.0)).size_at(2.0) == SPALL.size_at(0.0)


def numbers(scene: Scene) -> Float:
    """All numbers of the kernels' effects, one after the other."""
    found: list[Float] = []

    def collect(value: Any) -> None:
        if isinstance(value, tuple):
            for part in value:
                collect(part)
        elif value is not None:
            found.append(np.ravel(np.asarray(value, dtype=float)))

    collect(parameters_of(scene).effects)
    return np.concatenate(found)


def test_roughness_written_as_it_is_changes_nothing() -> None:
    bearing = standard_scene().bearing
    assert isinstance(bearing, Bearing)

    def rough(factor: float) -> Float:
        written = yaml.safe_load(scene_text(standard_scene()))
        written["roughness"] = {
            "raceway_um": factor * bearing.raceway_roughness * 1e6,
            "rib_um": factor * bearing.rib_roughness * 1e6,
        }
        return numbers(scene_from_text(yaml.safe_dump(written)))

    np.testing.assert_allclose(rough(1.0), numbers(standard_scene()), rtol=1e-12)
    assert not np.allclose(rough(2.0), numbers(standard_scene()), rtol=1e-6)

"""Cylindrical and spherical roller bearings: beside independent solutions, catalogue values, kinematics."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.bearing.life import dynamic_rating, reference_life, static_rating
from beardyn_core.bearing.profile import Profile
from beardyn_core.config import load_any_bearing
from beardyn_core.physics.statics.roller_contacts import ConePose, contact_model
from beardyn_core.physics.statics.roller_equilibrium import solve_rollers
from evidence.validation.anchor import Anchor
from evidence.validation.kind_solutions import (
    ISO_ROLLER,
    LAMINAE,
    cylindrical,
    half_space_load,
    hertz_of,
    hertz_rows,
    rest,
    sliced_load,
    spherical,
    standard_loads,
    standard_slices,
    thrust_by_small_motions,
    written_out_life,
)
from evidence.validation.life import LUNDBERG, rated_life_of_half_loaded_ring

# the same of two of Palmgren's contacts in series, E' of 206 GPa and 0.3
PALMGREN_ROLLER = 0.356 * 206e3 / (1.0 - 0.3**2) * 2.0 ** (-10.0 / 9.0)
TOPIC = "kinds of rollers"
MAR = "text copy in github.com/ArtemFilin1990/Mar, commit 7b871a58"
KRW = f"KRW, catalogue, wheelset cylindrical roller bearings; {MAR}. The rollers are derived from C and C_0"
KINEX = f"KINEX, catalogue, axlebox pair of this size; {MAR}"
KOYO = f"Koyo, general catalogue; {MAR}. The rollers are derived from C and C_0"
KRW_EA = f"KRW, catalogue, bearing of this size; {MAR}"
FACTORS = "maker's factor of SKF, FAG, NSK and RHP (catalogue of bearings); contact angle from Y_1 of Koyo"
STANDARD = "ISO/TS 16281 (2008), solved apart from this code with its constant and its profile; as a ratio"
SOFTER = (
    "the standard's rollers are 4 % softer than Palmgren's, so that the heaviest carries 1 % less, of which "
    "life feels the fourth power"
)
HERTZ = "two Hertz contacts in series along each contact line, rigid rings, solved apart; as a ratio"
HALF_SPACE = "pressures on a grid of the elastic half-space (Polonsky and Keer 1999), as a ratio"
SMALL = "small motions of roller and ribs, solved apart from this code; as a ratio"
HARRIS = "Harris, Rolling Bearing Analysis: Q_max = 4.08 F/Z for line contact without clearance, Z endless"


def largest_over_standard(name: str, radial: float) -> float:
    """Compare the largest roller load of a cylindrical bearing with that of the standard."""
    bearing = replace(cylindrical(name), profile=Profile("iso_16281"))
    return rest(bearing, 0.0, 0.0, radial).largest_roller_load / float(standard_loads(bearing, radial).max())


def life_over_standard(name: str, radial: float, constant: float = ISO_ROLLER) -> float:
    """Compare the reference life of a cylindrical bearing with that of the standard."""
    bearing = replace(cylindrical(name), profile=Profile("iso_16281"))
    found = rest(bearing, 0.0, 0.0, radial)
    lives = reference_life(bearing, found.cup_lamina_load, found.cone_lamina_load, 4.0, 1.0)
    slices = np.stack([standard_slices(bearing, radial, constant)] * 2)
    return lives.basic / 1e6 / written_out_life(bearing, slices, slices)


def largest_over_hertz(name: str, *force: float) -> float:
    """Compare the largest roller load of a spherical bearing with that of springs."""
    bearing = spherical(name)
    return rest(bearing, *force).largest_roller_load / float(hertz_rows(bearing, np.array(force)).max())


def life_over_hertz(name: str, *force: float) -> float:
    """Compare the reference life of a spherical bearing with that of `hertz_rows`, spread by Hertz."""
    bearing = spherical(name)
    loads, found = hertz_rows(bearing, np.array(force)), rest(bearing, *force)
    place = ((np.arange(LAMINAE) + 0.5) / LAMINAE - 0.5) * bearing.effective_length

    def spread(ring: str) -> Float:
        reach = hertz_of(bearing, ring).semi_axes(1.0)[0] * np.cbrt(np.maximum(loads, 1e-9))[..., None]
        shape = np.maximum(1.0 - (place / reach) ** 2, 0.0)
        return np.asarray(0.75 * loads[..., None] / reach * shape * bearing.effective_length / LAMINAE)

    lives = reference_life(bearing, found.cup_lamina_load, found.cone_lamina_load, 4.0, 1.0)
    return lives.basic / 1e6 / written_out_life(bearing, spread("cone"), spread("cup"))


def slices_over_half_space(ring: str, load: float) -> float:
    """Compare slices and half-space at Hertz's approach of a load [N]."""
    bearing = spherical()
    approach = (load / hertz_of(bearing, ring).factor) ** (2.0 / 3.0)
    return sliced_load(bearing, ring, approach) / half_space_load(bearing, ring, load, approach)


@lru_cache
def thrust_ratios() -> tuple[float, float]:
    """Compare raceway and rib load of the heaviest roller under 80 kN across and 12 kN along with `SMALL`."""
    bearing = cylindrical()
    found = rest(bearing, 0.0, 12e3, 80e3)
    cosine = np.cos(2.0 * math.pi * np.arange(bearing.roller_count) / bearing.roller_count)
    start = float(found.displacement[2]), float(found.displacement[1])
    radial, axial = float(found.cone_load[0] @ cosine), float(found.rib_load[0].sum())
    loads, ribs = thrust_by_small_motions(bearing, radial, axial, start)
    return float(found.cone_load[0].max() / loads.max()), float(found.rib_load[0].max() / ribs.max())


def rib_share() -> float:
    """Give the part of 12 kN that the ribs of one row carry along the axle."""
    bearing = cylindrical()
    ribs = rest(bearing, 0.0, 12e3, 80e3).rib_load[0].sum()
    return float(ribs) * math.cos(bearing.rib_opening) / 12e3


def moment_of_grooves(*force: float) -> float:
    """Give what the grooves of a loaded cone feel as moment about the sphere's middle, over load and radius.

    From the forces in the grooves, each at its roller: nothing in it knows of the sphere.
    """
    bearing = spherical()
    displacement = rest(bearing, *force).displacement
    model = contact_model(bearing, 0.0, LAMINAE, 0.0, 0.0)
    state = solve_rollers(model, ConePose(displacement, np.eye(3)), None)
    pressed = np.einsum("rkl,rklm->rkm", state.cone.force, state.cone.by_roller)
    on_cone = pressed[..., 0:1] * model.radial + pressed[..., 1:2] * model.axial
    moved = state.position[..., 0:1] * model.radial + state.position[..., 1:2] * model.axial
    arm = model.centre + moved + displacement
    moment = np.sum(np.cross(arm, on_cone) + pressed[..., 2:3] * model.tilt_axis, axis=(0, 1))
    return float(np.hypot(moment[0], moment[2]) / (np.linalg.norm(force) * bearing.sphere_radius))


def loads_changed_by_tilt() -> float:
    """Give the largest change of a roller load by a tilt of 20 mrad in the sphere, over the load."""
    model, shift = contact_model(spherical(), 0.0, LAMINAE, 0.0, 0.1), np.array([2e-5, 9e-5, 11e-5])
    sine, cosine = math.sin(0.02), math.cos(0.02)
    turned = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    before, after = (
        solve_rollers(model, ConePose(rotation @ shift, rotation), None).cup.force.sum(axis=-1)
        for rotation in (np.eye(3), turned)
    )
    return float(np.abs(after - before).max() / before.max())


def stribeck() -> float:
    """Give Q_max Z / F of one row of straight rollers without clearance."""
    bearing = replace(cylindrical(), radial_clearance=0.0, profile=Profile())
    return rest(bearing, 0.0, 0.0, 50e3).largest_roller_load * bearing.roller_count / 25e3


def rating_kN(name: str, static: bool) -> float:
    """Give a rating of a shipped bearing, of one row of a pair of cylindrical bearings, [kN]."""
    bearing = load_any_bearing(name)
    alone = 1.0 if bearing.self_aligning else 2.0 if static else 2.0 ** (7.0 / 9.0)
    rating = static_rating(bearing) if static else dynamic_rating(bearing).radial
    return rating / alone / 1e3


def spin_factor(name: str) -> float:
    """Give BSF of a shipped bearing."""
    return fault_frequencies(load_any_bearing(name)).bsf


_RATINGS = (
    ("WJ130x240", "WJ 130 x 240", 550.0, 780.0, KRW, 0.01),
    ("WJ120x240", "WJ 120 x 240", 560.0, 760.0, KRW, 0.01),
    ("WJ180x320", "WJ 180 x 320 x 86", 714.0, 1083.0, KRW, 0.01),
    ("WJ130x240", "PLC 410-33, 130 x 240", 539.6, 775.4, KINEX, 0.03),
    ("WJ120x240", "PLC 410-13, 120 x 240", 553.8, 742.5, KINEX, 0.03),
    ("SRB120x260", "22324RHR", 896.0, 1130.0, KOYO, 0.01),
    ("SRB130x280", "22326RHR", 1040.0, 1340.0, KOYO, 0.01),
    ("SRB120x260", "22324EA", 868.0, 1120.0, KRW_EA, 0.035),
    ("SRB130x280", "22326EA", 1015.0, 1328.0, KRW_EA, 0.035),
)

ANCHORS: tuple[Anchor, ...] = (
    *(
        Anchor(
            TOPIC,
            f"{'static' if static else 'dynamic'} rating of {written}",
            value,
            "kN",
            source,
            partial(rating_kN, name, static),
            tolerance=tolerance,
        )
        for name, written, dynamic, at_rest, source, tolerance in _RATINGS
        for static, value in ((False, dynamic), (True, at_rest))
    ),
    *(
        Anchor(TOPIC, f"BSF of {written}", value, "", FACTORS, partial(spin_factor, name), tolerance=0.002)
        for name, written, value in (("SRB120x260", "22324", 2.4075), ("SRB130x280", "22326", 2.4005))
    ),
    Anchor(TOPIC, "cylinders: largest roller load times Z / F", 4.08, "", HARRIS, stribeck, tolerance=0.01),
    *(
        Anchor(
            TOPIC,
            f"cylinders: largest roller load, {name}, {radial / 1e3:g} kN",
            1.0,
            "",
            STANDARD,
            partial(largest_over_standard, name, radial),
            tolerance=0.03,
        )
        for name in ("WJ130x240", "WJ120x240", "WJ180x320")
        for radial in (20e3, 80e3, 200e3)
    ),
    *(
        Anchor(
            TOPIC,
            f"cylinders: reference life, {name}, {radial / 1e3:g} kN, {whose} constant",
            1.0,
            "",
            STANDARD if misses else STANDARD.replace("its constant", "Palmgren's constant"),
            partial(life_over_standard, name, radial, constant),
            tolerance=0.03,
            misses=misses,
        )
        for name in ("WJ130x240", "WJ120x240", "WJ180x320")
        for radial in (80e3, 200e3)
        for whose, constant, misses in (
            ("Palmgren's", PALMGREN_ROLLER, ""),
            ("the standard's", ISO_ROLLER, SOFTER),
        )
    ),
    Anchor(
        TOPIC, "cylinders: heaviest raceway with 12 kN of thrust", 1.0, "", SMALL, lambda: thrust_ratios()[0],
        tolerance=0.03,
    ),
    Anchor(
        TOPIC, "cylinders: heaviest rib with 12 kN of thrust", 1.0, "", SMALL, lambda: thrust_ratios()[1],
        tolerance=0.03,
    ),
    Anchor(
        TOPIC, "cylinders: part of the thrust on ribs of one row", 1.0, "", "balance of forces", rib_share,
        tolerance=1e-4,
    ),
    *(
        Anchor(
            TOPIC,
            f"barrels: largest roller load, {name}, {force[1] / 1e3:g} kN along, {force[2] / 1e3:g} kN up",
            1.0,
            "",
            HERTZ,
            partial(largest_over_hertz, name, *force),
            tolerance=0.03,
        )
        for name in ("SRB120x260", "SRB130x280")
        for force in ((0.0, 0.0, 60e3), (0.0, 8e3, 40e3))
    ),
    *(
        Anchor(
            TOPIC,
            f"barrels: reference life, {name}, {force[1] / 1e3:g} kN along, {force[2] / 1e3:g} kN up",
            1.0,
            "",
            f"life written out from ISO/TS 16281 (2008); {HERTZ}",
            partial(life_over_hertz, name, *force),
            tolerance=0.03,
        )
        for name in ("SRB120x260", "SRB130x280")
        for force in ((0.0, 0.0, 60e3), (0.0, 8e3, 40e3))
    ),
    *(
        Anchor(
            TOPIC,
            f"barrels: load of the slices on the {ring}, at Hertz's approach of {load / 1e3:g} kN",
            1.0,
            "",
            HALF_SPACE,
            partial(slices_over_half_space, ring, load),
            tolerance=0.03,
        )
        for ring in ("cup", "cone")
        for load in (5e3, 15e3, 30e3)
    ),
    Anchor(
        TOPIC, "barrels: moment on the cone over load and radius, 15 kN along, 60 kN up", 0.0, "",
        "self-alignment: none; of what the grooves feel", partial(moment_of_grooves, 0.0, 15e3, 60e3),
        absolute=1e-4,
    ),
    Anchor(
        TOPIC, "barrels: change of roller loads by a tilt of 20 mrad", 0.0, "", "self-alignment: none",
        loads_changed_by_tilt, absolute=1e-7,
    ),
    *(
        Anchor(
            TOPIC,
            f"reference life of {name} at its rating, half the ring loaded, without edge stress",
            1.0,
            "10^6 rev",
            f"{LUNDBERG}; 0.83 for edges taken back",
            partial(rated_life_of_half_loaded_ring, name),
            tolerance=0.03,
        )
        for name in ("WJ130x240", "WJ120x240", "WJ180x320", "SRB120x260", "SRB130x280")
    ),
)  # fmt: skip

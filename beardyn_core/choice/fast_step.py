"""Time step of the fast tiers: as long as their fastest mode and their excitation allow."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.life import static_rating
from beardyn_core.bearing.rib_face import rib_faces
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.physics.journal import bending_give
from beardyn_core.physics.roller_spring import lever_of_cup, roller_stiffness
from beardyn_core.physics.suspension import box_coupling
from beardyn_core.physics.tiers.friction_steps import StepChoice
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import ConstantOperation, QuarterVehicleOperation, SteppedOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIERS, long_steps

# Turn of the fastest mode in a step, [rad]: its frequency is right within 0.5 %, see
# `physics.tiers.kinematic_rings`.
LARGEST_TURN = 1.0
# Highest third octave that a step of two samples leaves right where rings bend and rollers strike: loads
# within 0.1 %, levels within 0.3 dB, 2 dB up to 2.5 kHz, against steps of half a sample; strikes of wheel and
# rail are left out.
SLOW_BAND = 1250.0
_MOST_STEPS = 64


def fastest_mode(
    bearing: RollerBearing, mounting: Mounting, preloaded: bool, rows: int = 2, bending: Float | None = None
) -> float:
    """Estimate of the rings' angular frequency on the springs of the rollers, on the heavy side, [rad/s].

    Without what couples radial motion and tilt, 5 to 20 % where one row carries alone.

    Half of the rollers, with preload all of them, are taken to carry as the heaviest one does under the
    static load rating, where the line contacts are at their stiffest. ``bending`` [6, 6]: what an axle that
    bends adds to the inverse mass of the journal.
    """
    cosine, sine, lever = math.cos(bearing.cup_slant), math.sin(bearing.cup_slant), lever_of_cup(bearing)
    rollers = rows * bearing.roller_count
    # Stribeck's and Sjovall's factor of a line contact
    heaviest = 4.08 * static_rating(bearing) * 0.5 * rows / (rollers * cosine)
    tangent = float(roller_stiffness(bearing, heaviest))
    carrying = rollers * (1.0 if preloaded else 0.5)
    across, along = 0.5 * carrying * tangent * cosine**2, carrying * tangent * sine**2
    along += thrust_stiffness(bearing, rows)
    about = 0.5 * carrying * tangent * (lever**2 + bearing.effective_length**2 / 12.0)
    moving = [0, 1, 2, 3, 5]
    give = np.zeros((6, 6))
    if mounting.cup == "suspended":
        coupling = box_coupling(bearing, mounting)
        if coupling is None:
            mass = mounting.box_mass + bearing.cup_mass
            inertia = np.add(mounting.box_inertia, bearing.cup_inertia)
            give += np.diag([*[1.0 / mass] * 3, *(1.0 / inertia)])
        else:
            give += coupling.inverse_mass
    give[:3, :3] += np.eye(3) / (mounting.journal_mass + bearing.cone_mass)
    if mounting.journal_tilt == "free":
        give[[3, 5], [3, 5]] += 1.0 / mounting.journal_inertia
    if bending is not None:
        give += bending
    root = np.sqrt([across, along, across, about, about])
    squared = root[:, None] * give[np.ix_(moving, moving)] * root
    return math.sqrt(float(np.linalg.eigvalsh(squared).max()))


def thrust_stiffness(bearing: RollerBearing, rows: int) -> float:
    """Estimate the axial stiffness of all ends of cylinders on their ribs, on the heavy side, [N/m].

    All rollers share the largest thrust that catalogues allow at the static rating. 0 for other rollers.
    """
    faces = rib_faces(bearing)
    if not isinstance(bearing, CylindricalBearing) or not bearing.carries_thrust:
        return 0.0
    rollers = rows * bearing.roller_count
    each = bearing.largest_thrust * 0.5 * rows * static_rating(bearing) / rollers
    softness = 2.0 * max(face.factor for face in faces) ** (-2.0 / 3.0)
    return rollers * 1.5 * each ** (1.0 / 3.0) / softness


def fast_steps(scene: Scene, long: bool = True, band: float = math.inf) -> StepChoice:
    """Find the longest step with which a run in a fast tier is converged; ``long``: also beyond a sample.

    ``band``: highest third octave of the vibration that is asked for [Hz]; up to `SLOW_BAND` faults and rings
    that bend go with long steps in the lumped tier.

    Steps longer than a waveform sample end the band of the waveforms at 0.4 of the step rate. A healthy
    bearing under a load without strikes has nothing to say beyond (docs/tiers.md has the levels); edges of
    faults, strikes of wheel and rail, measured loads, background forces and boxes that bend do.
    The scene's own numerics do not matter.
    """
    limits = TIERS[scene.tier]
    fastest = _fastest(scene, 1)
    needed = fastest / (LARGEST_TURN * WAVEFORM_RATE)
    if needed > 1.0:
        enough = (n for n in range(2, _MOST_STEPS) if _fastest(scene, n) <= n * LARGEST_TURN * WAVEFORM_RATE)
        steps = next(enough, _MOST_STEPS)
        fastest = _fastest(scene, steps)
        return StepChoice(steps, _rings(fastest, steps))
    if not long or not limits.long_steps:
        return StepChoice(limits.steps_per_sample, f"the usual step of the tier {scene.tier}")
    slow = band <= SLOW_BAND and scene.tier == "lumped"
    sudden = _name_sudden_excitation(scene, slow)
    if sudden:
        return StepChoice(limits.steps_per_sample, f"{sudden} fill the band of the waveforms")
    allowed = long_steps(scene.tier, "" if scene.effects.structure is None else scene.effects.structure.kind)
    steps_per_sample = next((steps for steps in allowed if needed <= steps), limits.steps_per_sample)
    why = f"no more than {band:g} Hz is asked for" if slow else "nothing strikes"
    return StepChoice(steps_per_sample, f"{_rings(fastest, steps_per_sample)}, and {why}")


def _fastest(scene: Scene, steps: int) -> float:
    """Estimate the rate of `fastest_mode` with so many steps per sample, [rad/s]."""
    bending = bending_give(scene, 1.0 / (steps * WAVEFORM_RATE))
    return fastest_mode(scene.bearing, scene.mounting, scene.play < 0.0, scene.rows, bending)


def _rings(fastest: float, steps: float) -> str:
    kilohertz, turn = fastest / (2e3 * math.pi), fastest / steps / WAVEFORM_RATE
    return f"the rings on all rollers, at most {kilohertz:.3g} kHz, turn by {turn:.2g} rad a step"


def _name_sudden_excitation(scene: Scene, slow: bool = False) -> str:
    """Name the excitation that is too sudden for steps longer than a sample; empty when there is none.

    ``slow``: whether only the band is asked for in which faults and rings do with such steps.
    """
    operation, structure = scene.operation, scene.effects.structure
    if structure is not None and not (slow and structure.kind == "rings"):
        return "modes of the box"
    if not slow and (scene.defects or scene.waviness):
        return "faults"
    if not slow and scene.scattered is not None:
        return "rollers and raceways as made"
    if isinstance(operation, QuarterVehicleOperation):
        if operation.wheel_defects or operation.rail_defects:
            return "strikes of wheel or rail"
        if operation.bends_in_the_twin:
            return "modes of the axle"
    elif not isinstance(operation, ConstantOperation | SteppedOperation):
        return "measured loads"
    if scene.background is not None and scene.background.forces:
        return "forces of the background"
    if any(sensor.rate > WAVEFORM_RATE for sensor in scene.sensors):
        return "accelerometers with a faster rate"
    return ""

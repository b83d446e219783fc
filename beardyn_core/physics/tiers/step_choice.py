"""The coarsest time step that is converged, from the current stiffness.

The rule was made from steady runs at 1, 2, 3, 4, 8 and 16 steps per sample (5 to 150 kN, 10 to 210 rad/s,
standard and full effects, dry friction) and is checked at other points by `test/convergence`. In the full
tier these limits were met in order as the step grew:

- Vibration: levels of the housing above some frequency leave 1.5 dB; the load hardly matters.
- Bounce: a roller bounces between the raceways at 17 to 22 kHz. Sampled less than twice a period it returns
  as a line at the difference to the step rate, 25 dB above the level at 8 kHz. Without damping
  of the contacts nothing takes that energy away: at 3 steps a period, 2 or 3 laminae and skidding rollers,
  runs at 5 kN left the model's validity after 0.1 to 0.3 s; at 4.5 they did not, and with damping neither.
- Friction: steep dry friction flips from step to step. The index of that (`physics.tiers.status`) grows with
  slope and step, hardly with the load.
- Couplings that stay explicit: rollers in their pockets, and rings on all contacts. With an axle that bends
  at the journal (service_high_speed, 2 steps, 0.45 rad) the cone swings against damped contacts until
  rollers carry twice their load and friction flips; at 0.30 and 0.34 rad (3 steps there and in
  service_freight) it does not. Without damping of the contacts nothing swings at 0.45 either.

Mean torque and its scatter were within 0.5 % and 20 % wherever these limits hold. The limits of vibration are
of damping in the middle of the step (`tiers.build`), the others were found with damping of its end and
hold with less effort now.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import count

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import Cage, EffectSet, LoadSharingTraction, RingStructure, RotatingCage
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.physics.statics.equilibria import equilibrium
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.tiers.friction_steps import (
    LARGEST_EXPECTED_INDEX,
    LARGEST_STEPS,
    StepChoice,
    fixed_slope,
    friction_steps,
    shared_slope,
)
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.sensor import Accelerometer

AUDIBLE_BAND = 10_000.0
USUAL_NOISE = Accelerometer().noise_density  # [m/s^2/sqrt(Hz)]
# Upper end of the third octaves that stayed within 1.5 dB at 2 steps per sample, [Hz]. Between rigid rings
# they are up to 1.4 dB off at 8 and 10 kHz. Rings that bend pass less on there: what excites a band, be it
# waves to 10 kHz or a spall, is within 0.8 dB; what nothing excites is up to 6 dB off and below the noise of
# usual sensors (`test/convergence/test_two_steps.py`), so quieter ones take 3. Those hold to 11.3 kHz in any
# case, beyond in proportion. One step is no waveform: nothing filters what folds back.
_TWO_STEPS, _TWO_STEPS_OF_RINGS = 7_100.0, 11_300.0
_FULL_BAND_STEPS = 3
_BAND_PER_STEP = 3_770.0
_BOUNCES_PER_STEP, _UNDAMPED_BOUNCES_PER_STEP = 0.5, 0.25
_LARGEST_POCKET_TURN, _LARGEST_RING_TURN = 0.6, 0.4  # [rad]
_BARS = 4  # touches of a roller with both bars of its pocket


def rigid(_step: float) -> Float:
    """Add nothing to the inverse mass of a journal that does not bend."""
    return np.zeros((6, 6))


def choose_steps(
    bearing: RollerBearing,
    loads: tuple[float, float],
    speeds: tuple[float, float],
    effects: EffectSet,
    laminae: int = 6,
    *,
    axial: float = 0.0,
    end_play: float | None = None,
    mounting: Mounting | None = None,
    band: float = AUDIBLE_BAND,
    bending: Callable[[float], Float] = rigid,
    noise: float = USUAL_NOISE,
) -> StepChoice:
    """Choose the coarsest step of the full tier that is converged over a range of loads and speeds.

    Parameters
    ----------
    loads : tuple of float
        Smallest and largest radial load, [N].
    speeds : tuple of float
        Slowest and fastest shaft speed, [rad/s].
    axial : float
        Axial load that goes with the largest radial one, [N].
    end_play : float, optional
        [m]; the bearing's own when not given.
    mounting : Mounting, optional
        The usual one when not given.
    band : float
        Up to here third-octave levels of the vibration stay within 1.5 dB, [Hz]; 0 when only forces, torque
        and motion matter.
    bending : callable, optional
        From a step [s] to what an axle that bends adds to the inverse mass of the journal, shape [6, 6].
    noise : float
        Density of the noise of the quietest sensor, [m/s^2/sqrt(Hz)].

    Raises
    ------
    ValidityError
        There is no static equilibrium under the largest load.
    """
    static = equilibrium(
        bearing,
        (0.0, axial, max(abs(load) for load in loads)),
        end_play=end_play,
        laminae=laminae,
        speed=max(abs(speed) for speed in speeds),
        coupling=effects.lamina_coupling,
    )
    slowest = min(abs(speed) for speed in speeds)
    found = [
        _vibration(band, effects, noise),
        _bounce(bearing, static, laminae, effects.contact_damping is not None),
        *_friction(bearing, effects, slowest, laminae),
        *_explicit(bearing, static, effects, mounting or Mounting(), bending),
    ]
    decisive = max(found, key=lambda choice: choice.steps_per_sample)
    return StepChoice(min(decisive.steps_per_sample, LARGEST_STEPS), decisive.reason)


def _vibration(band: float, effects: EffectSet, noise: float) -> StepChoice:
    if band <= 0.0:
        return StepChoice(1, "no vibration is asked for")
    bends = isinstance(effects.structure, RingStructure) and noise >= USUAL_NOISE
    two = _TWO_STEPS_OF_RINGS if bends else _TWO_STEPS
    steps = 2 if band <= two else max(_FULL_BAND_STEPS, math.ceil(band / _BAND_PER_STEP))
    return StepChoice(
        steps, f"third-octave levels within 1.5 dB up to {band / 1e3:.3g} kHz need {steps} steps per sample"
    )


def bounce_frequency(bearing: RollerBearing, static: StaticSolution, laminae: int) -> float:
    """Work out the highest frequency at which a roller bounces between its raceways, [Hz]."""
    factor = line_contact_factor(bearing.material, bearing.effective_length) / laminae
    stiffness = np.zeros(static.cup_load.shape)
    for load in (static.cup_lamina_load, static.cone_lamina_load):
        pressed = np.maximum(load, 0.0)
        # d/d(delta) of K delta^(10/9) where that is the load
        stiffness += (10.0 / 9.0 * factor**0.9 * pressed**0.1).sum(axis=-1)
    return math.sqrt(float(stiffness.max()) / bearing.roller_mass) / (2.0 * math.pi)


def _bounce(bearing: RollerBearing, static: StaticSolution, laminae: int, damped: bool) -> StepChoice:
    frequency = bounce_frequency(bearing, static, laminae)
    most = _BOUNCES_PER_STEP if damped else _UNDAMPED_BOUNCES_PER_STEP
    steps = math.ceil(frequency / (most * WAVEFORM_RATE))
    resolved = "twice a period" if damped else "four times a period, as nothing damps it"
    return StepChoice(
        steps,
        f"rollers under {static.largest_roller_load / 1e3:.3g} kN bounce at {frequency / 1e3:.3g} kHz, which "
        f"{steps} steps per sample resolve {resolved}",
    )


def dry_slope(bearing: RollerBearing, effects: EffectSet, speed: float) -> float:
    """Work out the steepest rise of the coefficient of friction with the slip speed, [s/m]."""
    traction = effects.traction
    if isinstance(traction, LoadSharingTraction) and effects.film is None:
        return shared_slope(traction, 0.25 * bearing.pitch_diameter * speed)
    return fixed_slope(effects)


def _friction(
    bearing: RollerBearing, effects: EffectSet, slowest: float, laminae: int
) -> Iterator[StepChoice]:
    slope = dry_slope(bearing, effects, slowest)
    if slope > 0.0:
        steps = friction_steps(slope, laminae)
        yield StepChoice(
            steps,
            f"friction that rises by {slope:.3g} per m/s of slip keeps its chatter index below "
            f"{LARGEST_EXPECTED_INDEX:.2g} with {steps} steps per sample",
        )


def _explicit(
    bearing: RollerBearing,
    static: StaticSolution,
    effects: EffectSet,
    mounting: Mounting,
    bending: Callable[[float], Float],
) -> Iterator[StepChoice]:
    """Check couplings that the step treats explicitly: a fraction of a radian a step keeps them accurate."""
    contacts = float(np.linalg.eigvalsh(static.stiffness_tilt_held).max())
    rigid_give = 1.0 / (mounting.journal_mass + bearing.cone_mass)
    if mounting.cup == "suspended":
        rigid_give += 1.0 / (mounting.box_mass + bearing.cup_mass)

    def rings(steps: int) -> float:
        added = bending(1.0 / (steps * WAVEFORM_RATE))[:3, :3]
        return math.sqrt(contacts * (rigid_give + float(np.linalg.eigvalsh(added).max())))

    yield _turning(rings, _LARGEST_RING_TURN, "the rings on all their contacts")
    if isinstance(effects.cage, Cage | RotatingCage):
        inverse_mass = 1.0 / bearing.roller_mass + 1.0 / bearing.cage.mass
        pocket = math.sqrt(_BARS * bearing.cage.stiffness * inverse_mass)
        yield _turning(lambda _steps: pocket, _LARGEST_POCKET_TURN, "a roller in its pocket")


def _turning(rate_at: Callable[[int], float], most: float, what: str) -> StepChoice:
    steps = next(n for n in count(1) if rate_at(n) <= n * most * WAVEFORM_RATE)
    rate = rate_at(steps)
    return StepChoice(
        steps,
        f"{what}, explicit at {rate / (2.0 * math.pi) / 1e3:.3g} kHz, turn little enough with {steps} steps "
        "per sample",
    )

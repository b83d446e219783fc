"""The force spectrum of the loaded row, and what moves its bands.

A roller between the raceways is a mass on its line contacts. Their tangent stiffness goes with the load to
the power 1/10, so the frequency with 1/20: loaded rollers of one bearing bounce in one narrow band whatever
they carry, and rollers outside the load zone, which their centrifugal force holds to the cup alone, in
another below it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.contact_law import LINE_EXPONENT, line_contact_factor
from beardyn_core.effects import ContactDamping
from beardyn_core.physics.statics.static import solve
from beardyn_core.scene.scene import Scene
from evidence.santos2017.runs import SETTLED, STEP_AT, StepRecord, at_once, record

Float = NDArray[np.float64]

PUBLISHED_BAND = 30.0e3  # Section 7.1 and Fig. 6(b) [Hz]
RADIAL_LOAD = 5.0e3
SHAFT_SPEED = 1165.0 * math.pi / 30.0
# The line contact law of Santos (2017) is exact with the length of a slice. With the whole length of the
# roller in every one of its six slices the contact is stiffer by this.
WHOLE_LENGTH = 6.0 ** (8.0 / 9.0)
_NO_DAMPING = 1e-12  # time constant of the contacts, [s]
_LOWEST, _HIGHEST = 0.8, 1.2  # of the bounce: the rings on all rollers are below
_SMOOTHING = 1.0e3  # [Hz]
_APART = 1.3  # of two bands, ratio
_DURATION = 0.06  # [s]
_SHIFTED = (8.0e3, 22.0e3)  # both bands of the row as it is, with their flanks [Hz]
_SHIFTS = np.geomspace(0.6, 3.0, 321)
_RELATIVE_WIDTH = 0.03


@dataclass(frozen=True)
class Variation:
    """One change of the undamped loaded row.

    Parameters
    ----------
    name : str
    mass_factor : float
        Of the density, that is of the rollers: rings have masses of their own, [-].
    stiffness_factor : float
        Of the modulus of elasticity, [-].
    steps_per_sample : int
        The step is 1/(25 600 x this), [-].
    time_constant : float
        Of contact damping, [s].
    """

    name: str
    mass_factor: float = 1.0
    stiffness_factor: float = 1.0
    steps_per_sample: int = 16
    time_constant: float = _NO_DAMPING

    def applied(self, scene: Scene) -> Scene:
        """Apply this change to a scene."""
        material = scene.bearing.material
        changed = replace(
            material,
            density=material.density * self.mass_factor,
            youngs_modulus=material.youngs_modulus * self.stiffness_factor,
        )
        return replace(
            scene,
            bearing=replace(scene.bearing, material=changed, forced=True),
            effects=replace(scene.effects, contact_damping=ContactDamping(self.time_constant)),
            numerics=replace(scene.numerics, steps_per_sample=self.steps_per_sample),
        )


@dataclass(frozen=True)
class Bands:
    """Where a force spectrum stands out, and where rollers bounce.

    Parameters
    ----------
    variation : Variation
    step : float
        [s].
    frequency, amplitude : float64 arrays, shape [line]
        Spectrum of the radial force, [Hz], [N].
    found : tuple of 2 floats
        Its two highest bands where rollers may bounce, in order of frequency, [Hz].
    bounce : tuple of 2 floats
        Of the lightest and of the heaviest loaded roller, from stiffness and mass, [Hz].
    level : float
        Rms of the force in that range, [N].
    """

    variation: Variation
    step: float
    frequency: Float
    amplitude: Float
    found: tuple[float, float]
    bounce: tuple[float, float]
    level: float

    def shift_from(self, reference: Bands) -> float:
        """Return the factor in frequency by which the bands lie above those of another spectrum.

        Parameters
        ----------
        reference : Bands
            Of the row as it is.

        Returns
        -------
        float
            Where the logarithms of the two levels over the logarithm of frequency correlate best, [-].
        """
        grid = np.geomspace(*_SHIFTED, 200)
        wanted = reference.log_level(grid)
        match = [np.corrcoef(wanted, self.log_level(grid * shift))[0, 1] for shift in _SHIFTS]
        return float(_SHIFTS[int(np.argmax(match))])

    def log_level(self, frequency: Float) -> Float:
        """Return the logarithm of the root mean square of the amplitude within 3 % of a frequency.

        Parameters
        ----------
        frequency : float64 array, shape [place]
            [Hz].
        """
        total = np.concatenate([[0.0], np.cumsum(self.amplitude**2)])
        first = np.searchsorted(self.frequency, frequency * (1.0 - _RELATIVE_WIDTH))
        last = np.searchsorted(self.frequency, frequency * (1.0 + _RELATIVE_WIDTH))
        return np.asarray(0.5 * np.log((total[last] - total[first]) / (last - first)))


def bounce(scene: Scene, force: float = RADIAL_LOAD) -> tuple[float, float]:
    """Return the lowest and highest frequency of the rollers across the raceways, rings and axle at rest.

    Parameters
    ----------
    scene : Scene
    force : float
        Radial, [N].

    Returns
    -------
    tuple of 2 floats
        [Hz].

    Notes
    -----
    Each lamina has the stiffness 10/9 K^(9/10) Q^(1/10) of Q = K delta^(10/9). Motion of the rings, which
    raises the band of the loaded rollers by some per cent, and the stiffness of the rib are neglected.
    """
    bearing, laminae = scene.bearing, scene.numerics.laminae
    static = solve(
        bearing, (0.0, 0.0, force), end_play=scene.end_play, laminae=laminae, speed=SHAFT_SPEED,
        axial_stiffness=scene.mounting.axial_prop_stiffness, rows=scene.rows,
    )  # fmt: skip
    factor = line_contact_factor(bearing.material, bearing.effective_length) / laminae
    stiffness = np.zeros(static.cup_load.shape)
    for load in (static.cup_lamina_load, static.cone_lamina_load):
        pressed = np.maximum(load, 0.0)
        stiffness += (LINE_EXPONENT * factor**0.9 * pressed**0.1).sum(axis=-1)
    lowest, highest = np.sqrt(np.array([stiffness.min(), stiffness.max()]) / bearing.roller_mass)
    return float(lowest) / (2.0 * math.pi), float(highest) / (2.0 * math.pi)


def force_spectrum(run: StepRecord) -> tuple[Float, Float]:
    """Return the amplitude of the radial force, without what precedes 0.01 s after the step, as published.

    Returns
    -------
    frequency, amplitude : float64 arrays, shape [line]
        [Hz], [N].
    """
    force = run.radial_after(STEP_AT + SETTLED)
    window = np.hanning(len(force))
    amplitude = 2.0 * np.abs(np.fft.rfft((force - force.mean()) * window)) / window.sum()
    return np.fft.rfftfreq(len(force), run.time[1] - run.time[0]), amplitude


def smoothed(frequency: Float, amplitude: Float) -> Float:
    """Return the root mean square of the amplitude within 1 kHz, [N]."""
    width = max(1, round(_SMOOTHING / (frequency[1] - frequency[0])))
    return np.sqrt(np.convolve(amplitude**2, np.full(width, 1.0 / width), mode="same"))


def two_bands(frequency: Float, amplitude: Float) -> tuple[float, float]:
    """Find the two highest bands of a piece of a spectrum, in order of frequency, [Hz]."""
    inner = slice(1, -1)
    peak = (amplitude[inner] >= amplitude[:-2]) & (amplitude[inner] >= amplitude[2:])
    places = frequency[inner][peak][np.argsort(amplitude[inner][peak])[::-1]]
    first = float(places[0])
    second = float(next(place for place in places if not first / _APART < place < first * _APART))
    return min(first, second), max(first, second)


def bands(scene: Scene, variation: Variation) -> Bands:
    """Run a row with one change under a load that comes on at once, and find its bands.

    Parameters
    ----------
    scene : Scene
        ``santos_step``.
    variation : Variation
    """
    changed = replace(variation.applied(scene), duration=_DURATION)
    run = record(changed, at_once(changed, RADIAL_LOAD, SHAFT_SPEED))
    frequency, amplitude = force_spectrum(run)
    expected = bounce(changed)
    inside = (frequency > _LOWEST * expected[0]) & (frequency < _HIGHEST * expected[1])
    found = two_bands(frequency[inside], smoothed(frequency, amplitude)[inside])
    level = math.sqrt(
        float((amplitude[inside] ** 2).sum()) / 3.0
    )  # of a Hann window: 1.5 lines, amplitude^2/2
    step = float(run.time[1] - run.time[0])
    return Bands(variation, step, frequency, amplitude, found, expected, level)


def variations(scene: Scene) -> tuple[Variation, ...]:
    """List what is changed, one at a time."""
    light = (bounce(scene)[1] / PUBLISHED_BAND) ** 2
    return (
        Variation("as it is"),
        Variation("half the step", steps_per_sample=32),
        Variation("twice the step", steps_per_sample=8),
        Variation("rollers half as heavy", mass_factor=0.5),
        Variation(f"rollers of {1e3 * light * scene.bearing.roller_mass:.0f} g", mass_factor=light),
        Variation("contacts 4.92 times as stiff", stiffness_factor=WHOLE_LENGTH),
        Variation("the same, half the step", stiffness_factor=WHOLE_LENGTH, steps_per_sample=32),
        Variation("contact damping of 5 µs", time_constant=ContactDamping().time_constant),
    )

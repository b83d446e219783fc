"""Runs at several damping times, and what the inlet of the film gives by itself."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np
from scipy import stats

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.film_thickness import line_film
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.choice import load_scene
from beardyn_core.effects import ContactDamping
from beardyn_core.physics.tiers.status import describe
from beardyn_core.rail.build import load_history
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import RATES
from beardyn_core.twin import Twin

EFFECTS = "full"  # with the energy balance, which automatic ones leave out
TIMES_US = (2.5, 5.0, 12.0, 25.0)
SPANS_HZ = ((10.0, 500.0), (500.0, 2000.0), (2000.0, 8000.0))
SETTLED = 0.2  # first part of a run that is not looked at [s]
SPEEDS_RPM = (150.0, 500.0, 1165.0, 2500.0)


@dataclass(frozen=True)
class Measurement:
    """What the axlebox does at one damping time."""

    scene: A[str, "of the run"]
    time_us: A[float, "damping over stiffness of the contacts"]
    levels: A[tuple[float, ...], "rms of the vertical acceleration in `SPANS_HZ`, [m/s^2]"]
    peak: A[float, "largest vertical acceleration, [m/s^2]"]
    kurtosis: A[float, "of the vertical acceleration, 3 for noise"]
    share: A[float, "of contact damping in all losses"]
    residual: A[float, "of the energy audit"]
    says: A[str, "status, or the sentence with which it ended"]


def spalled(depth: float, width: float) -> Scene:
    """Load a steady bearing with a spall in the middle of its load zone, cup on its springs."""
    spall = Patch(on="cup", row=0, azimuth=0.0, width=width, depth=depth, length=0.025)
    scene = load_scene("cup_spall", effects=EFFECTS, tier="full")
    operation = ConstantOperation(force=(0.0, 0.0, 8e4), speed=122.0)
    return replace(scene, name=f"spall {1e3 * width:g} mm", operation=operation, defects=(spall,))


def scenes() -> list[tuple[Scene, float]]:
    """List the scenes with their durations, [s]."""
    track = load_scene("cup_spall", effects=EFFECTS, tier="full")
    return [(track, 1.2), (spalled(1e-4, 6e-3), 0.8), (spalled(2e-4, 1e-2), 0.8)]


def receive(scene: Scene, duration: float, time_us: float) -> Measurement:
    """Run a scene at one damping time, without sensor noise."""
    effects = replace(scene.effects, contact_damping=ContactDamping(1e-6 * time_us))
    quiet = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    scene = replace(scene, effects=effects, sensors=quiet)
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, duration, scene.seed))
    parts, status, says, audit = [], 0, "", None
    while twin.next_end_ns <= duration * 1e9:
        try:
            block = twin.advance()
        except ValidityError as error:
            says = str(error)
            break
        status, audit = status | int(block.status), block.audit
        if block.start_ns >= SETTLED * 1e9:
            parts.append(block.vibration[0].acceleration[:, 2])
    signal = np.concatenate(parts) if parts else np.zeros(1)
    signal = signal - signal.mean()
    share = audit.losses[1] / audit.dissipated if audit is not None and audit.losses else math.nan
    residual = math.nan if audit is None else audit.residual
    return Measurement(
        scene.name, time_us, levels(signal), float(np.abs(signal).max()), float(stats.kurtosis(signal) + 3.0),
        share, residual, says or describe(status),
    )  # fmt: skip


def levels(signal: Float) -> tuple[float, ...]:
    """Work out the rms of a signal in each of `SPANS_HZ`."""
    power = np.abs(np.fft.rfft(signal)) ** 2 * 2.0 / len(signal) ** 2
    frequency = np.fft.rfftfreq(len(signal), 1.0 / RATES[0])
    return tuple(
        math.sqrt(float(power[(frequency >= low) & (frequency < high)].sum())) for low, high in SPANS_HZ
    )


@dataclass(frozen=True)
class Inlet:
    """Damping time that the inlet of a film has by itself."""

    speed_rpm: A[float, "of the shaft"]
    entrainment: A[float, "mean surface speed on the cup, [m/s]"]
    film: A[float, "central thickness, [m]"]
    length: A[float, "of the inlet, in which the gap doubles, [m]"]
    time: A[float, "damping over stiffness, [s]"]
    corner: A[float, "frequency above which the film has no time to fill the contact, [Hz]"]


def inlet(speed_rpm: float, load: float = 2e4) -> Inlet:
    """Estimate the damping of the film of the most loaded roller on the cup.

    The film thickness follows the flow through the inlet, h ~ u^0.7. Surfaces that approach with v add v l to
    that flow over the length l of the inlet, as a speed larger by v l / h would: the film is thicker by
    0.7 v l / u, and a given approach presses the bodies deeper by that. So the damping over the stiffness is
    0.7 l / u, as long as the film fills the contact, of width 2 b, within a period.
    """
    scene = load_scene("static_80kN", effects=EFFECTS)
    bearing, oil = scene.bearing, scene.lubricant
    modulus = bearing.material.contact_modulus
    cup_radius = 0.5 * bearing.pitch_diameter + 0.5 * bearing.roller_diameter
    roller_radius = 0.5 * bearing.roller_diameter
    radius = 1.0 / (1.0 / roller_radius - 1.0 / cup_radius)
    per_length = load / bearing.effective_length
    half_width = math.sqrt(8.0 * per_length * radius / (math.pi * modulus))
    shaft = speed_rpm * math.pi / 30.0
    entrainment = cage_speed(bearing, shaft) * cup_radius
    film = line_film(
        per_length, entrainment, radius, modulus, oil.dynamic_viscosity(scene.temperature),
        oil.pressure_viscosity_at(scene.temperature), "pan_hamrock_central",
    )  # fmt: skip
    # beside a Hertz contact the gap grows as (4 sqrt(2) / 3) (x / b)^1.5 b^2 / 2 R
    length = half_width * (film * 2.0 * radius * 3.0 / (4.0 * math.sqrt(2.0) * half_width**2)) ** (2.0 / 3.0)
    corner = entrainment / (2.0 * half_width)
    return Inlet(speed_rpm, entrainment, film, length, 0.7 * length / entrainment, corner)

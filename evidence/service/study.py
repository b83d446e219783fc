"""Runs of the service scenes: levels, and the verdicts of the shipped monitor."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_scene
from beardyn_core.config import shipped_names
from beardyn_core.monitor.streaming import Monitor, MonitorInput
from beardyn_core.run import blocks
from beardyn_core.scene.background import Background, Roughness
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene

SPANS_HZ = ((20.0, 500.0), (500.0, 1000.0), (1000.0, 2000.0), (2000.0, 5000.0), (5000.0, 10_000.0))
OCTAVES_HZ = tuple(
    (centre / 2**0.5, centre * 2**0.5) for centre in (31.5, 63, 125, 250, 500, 1000, 2000, 4000)
)
LINES = (
    ("good", "smooth"),
    ("iso_3095", "disc_brake"),
    ("average_network", "composite"),
    ("average_network", "cast_iron"),
)
TIERS = ("full", "quasistatic")
PARTS = ("roughness", "drive", "other_bearing", "knocks", "pickup")
_SETTLED_S = 0.25


@dataclass(frozen=True)
class Measurement:
    """What one run came to."""

    name: str
    tier: str
    faults: str
    levels: A[tuple[float, ...], "rms of the vertical reading in each of `SPANS_HZ`, [m/s^2]"]
    peak: A[float, "largest vertical reading less its mean, [m/s^2]"]
    octaves: A[tuple[float, ...], "rms of the vertical reading in each of `OCTAVES_HZ`, [m/s^2]"]
    kurtosis: A[float, "of the vertical reading, 3 for noise"]
    verdicts: A[dict[str, int], "analyses by what the monitor said"]


def service_names() -> tuple[str, ...]:
    """List the scenes of a bearing in service."""
    return tuple(name for name in shipped_names("scenes") if name.startswith("service_"))


def receive(scene: Scene, duration: float | None = None) -> Measurement:
    """Run a scene and let the shipped monitor listen to its first sensor."""
    monitor = Monitor(fault_frequencies(scene.bearing), scene.bearing.roller_count)
    read, verdicts = [], Counter[str]()
    for block in blocks(scene, duration):
        result = monitor.take(MonitorInput.of_block(block))
        if result is not None and result.verdict != "waiting":
            verdicts[result.verdict] += 1
        read.append(block.vibration[0].acceleration[:, 2])
    rate = scene.sensors[0].rate
    signal = np.concatenate(read)[round(_SETTLED_S * rate) :]
    signal = signal - signal.mean()
    return Measurement(
        scene.name,
        scene.tier,
        "; ".join(scene.fault_sentences),
        levels(signal, rate),
        float(np.abs(signal).max()),
        levels(signal, rate, OCTAVES_HZ),
        float(np.mean(signal**4) / np.mean(signal**2) ** 2),
        dict(verdicts),
    )


def levels(
    signal: Float, rate: float, spans: tuple[tuple[float, float], ...] = SPANS_HZ
) -> tuple[float, ...]:
    """Compute the rms of a signal in each of some spans [Hz]."""
    window = np.hanning(len(signal))
    power = np.abs(np.fft.rfft(signal * window)) ** 2 * 2.0 / (len(signal) * np.sum(window**2))
    frequency = np.fft.rfftfreq(len(signal), 1.0 / rate)
    return tuple(float(np.sqrt(power[(frequency >= low) & (frequency < high)].sum())) for low, high in spans)


def services(tier: str) -> list[Scene]:
    """Load the service scenes for a tier."""
    return [load_scene(name, tier=tier) for name in service_names()]


def with_parts(scene: Scene, *parts: str) -> Scene:
    """Leave of a scene's background only some parts."""
    background = scene.background
    assert background is not None
    kept = {part: getattr(background, part) for part in parts}
    only = Background(background.name, background.description, **kept) if parts else None
    scene = replace(scene, background=only)
    return scene if "roughness" in parts else _on_smooth_rails(scene)


def _on_smooth_rails(scene: Scene) -> Scene:
    assert isinstance(scene.operation, QuarterVehicleOperation)
    irregularity = replace(scene.operation.irregularity, short_waves="none")
    return replace(scene, operation=replace(scene.operation, irregularity=irregularity))


def with_roughness(scene: Scene, rail: str, wheel: str) -> Scene:
    """Give a scene's background other levels of rail and wheel."""
    assert scene.background is not None
    return replace(scene, background=replace(scene.background, roughness=Roughness(rail, wheel)))

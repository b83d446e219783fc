"""Runs of the twin next to measured records: service scenes, healthy and with spalls, on three surfaces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np

import beardyn_core as bd
from beardyn_core.bearing.kinematics import FaultFrequencies, fault_frequencies
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from evidence.measured.texture_quantities import Texture, measure

TIER = "quasistatic"
DURATION, SETTLED = 6.5, 0.5  # of a run, and what of it is not measured, [s]
VERTICAL = 2  # axis of the accelerometer
TYPICAL = "typical"
SURFACES = ("fine", TYPICAL, "coarse")
PARTS = ("cup", "cone", "roller")
LABORATORY, FIELD = "laboratory", "field"
WIDTH_MM = 6.0
SPALLS: dict[str, dict[str, Any]] = {
    LABORATORY: {"kind": "spall", "width_mm": WIDTH_MM, "depth_um": 100.0, "length_mm": 25.0},
    FIELD: {"kind": "field_spall", "width_mm": WIDTH_MM},
}
# the scene of a faulty part where one is shipped, else the healthy one, which gets the spall
SCENES = {
    "freight": {"": "service_freight", "cone": "service_freight_cone"},
    "high speed": {"": "service_high_speed", "cup": "service_high_speed_cup"},
}


@dataclass(frozen=True)
class TwinCase:
    """One run."""

    train: A[str, "key of `SCENES`"]
    part: A[str, "with the spall, '' when healthy"]
    spall: A[str, "key of `SPALLS`, '' when healthy"]
    surface: A[str, "one of `SURFACES`"]

    @property
    def scene_name(self) -> str:
        """Name of the shipped scene that is run."""
        scenes = SCENES[self.train]
        return scenes.get(self.part, scenes[""])

    @property
    def key(self) -> str:
        """Name of the run among kept results."""
        return " | ".join(("twin", self.train, self.part, self.spall, self.surface))


def twin_cases() -> Iterator[TwinCase]:
    """List the runs: each train healthy and with both spalls of each part, on each surface.

    Rollers have the typical surface only.
    """
    for train in SCENES:
        for part, spall in (("", ""), *((part, spall) for part in PARTS for spall in SPALLS)):
            for surface in SURFACES if part != "roller" else (TYPICAL,):
                yield TwinCase(train, part, spall, surface)


def fault_order(frequencies: FaultFrequencies, part: str) -> float:
    """Give the order of the line of a fault; for a healthy bearing that of the cup."""
    return {"cone": frequencies.bpfi, "roller": 2.0 * frequencies.bsf}.get(part, frequencies.bpfo)


def scene_of(case: TwinCase, duration: float = DURATION) -> Scene:
    """Make the scene of a run: slices (laminae) coupled, all else as shipped."""
    written = read_file(find("scenes", case.scene_name))
    spall = [{"on": case.part, "row": 0, "azimuth_deg": 0.0, **SPALLS[case.spall]}] if case.part else []
    return bd.scene(
        case.scene_name,
        faults=spall,
        tier=TIER,
        effects={**written["effects"], "lamina_coupling": True},
        scatter={**written["scatter"], "surface": case.surface},
        duration=duration,
    )


def measure_twin(case: TwinCase, duration: float = DURATION) -> Texture:
    """Run a case and measure the vertical axis of its accelerometer."""
    scene = scene_of(case, duration)
    signal, times, shaft_angle, shaft_times = [], [], [], []
    for block in blocks(scene, duration):
        vibration = block.vibration[0]
        signal.append(vibration.acceleration[:, VERTICAL])
        times.append(vibration.time_ns)
        shaft_angle.append(block.shaft_angle)
        shaft_times.append(block.trend_time_ns)
    time = np.concatenate(times)
    angle = np.interp(time, np.concatenate(shaft_times), np.concatenate(shaft_angle))
    kept = slice(round(SETTLED * scene.waveform_rate), int(np.searchsorted(time, shaft_times[-1][-1])))
    order = fault_order(fault_frequencies(scene.bearing), case.part)
    return measure(np.concatenate(signal)[kept], scene.waveform_rate, angle[kept], order)

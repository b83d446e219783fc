"""What no drawing states of an axlebox: its value in a scene, its range, and its key in the file."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import write_noun
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.effects import ModalStructure
from beardyn_core.population.key_paths import Place, with_value
from beardyn_core.scene.scene import Scene

_DIGITS = 4  # that a value is written with
SENSOR = "sensor"  # in a place: number of the accelerometer that is used


@dataclass(frozen=True)
class Unknown:
    """A number of a scene that is fitted to recordings."""

    name: A[str, "on the command line and in results"]
    words: A[str, "what it is"]
    unit: A[str, "at the edge; empty for a factor"]
    relative: A[bool, "errors are shares of it: it is fitted as a logarithm"]
    span: A[tuple[float, float], "lowest and highest: factors on the base value, or what is added to it"]
    place: A[Place, "of the key in a scene file"]
    power: A[float, "of the value that stands there"] = 1.0
    step: A[float, "by which it is moved to see what follows from it, of its range"] = 0.12
    absent: A[str, "why a scene may not have it"] = ""

    def base_of(self, scene: Scene, sensor: int) -> float | None:
        """Find the value in a scene, whose sensor of a number is used; none where the scene has none."""
        structure = scene.effects.structure
        if self.name in ("frequency", "damping"):
            if not isinstance(structure, ModalStructure):
                return None
            return (
                structure.stiffness_factor**0.5 if self.name == "frequency" else structure.damping_factor
            ) or None
        if self.name == "background":
            received = scene.background
            return received.amplitude_factor or None if received is not None and received.forces else None
        if self.name == "noise":
            return scene.sensors[sensor].noise_density or None
        if isinstance(scene.bearing, CylindricalBearing):
            return None
        return float(write_noun(scene)["end_play_mm"])

    def ends(self, base: float) -> tuple[float, float]:
        """Lowest and highest value that is thought of, for a base value."""
        low, high = self.span
        return (low * base, high * base) if self.relative else (low + base, high + base)

    def scaled(self, value: float) -> float:
        """Take a value to the scale on which it is fitted."""
        return log(value) if self.relative else value

    def restored(self, scaled: float) -> float:
        """Take a value back from the scale on which it is fitted."""
        return exp(scaled) if self.relative else scaled

    def write_into(self, data: dict[str, Any], sensor: int, value: float, folder: Path) -> dict[str, Any]:
        """Write a value into the mapping of a scene file that lies in a folder."""
        place = tuple(sensor if each == SENSOR else each for each in self.place)
        return with_value(data, place, float(f"{value**self.power:.{_DIGITS}g}"), folder)

    def text(self, value: float) -> str:
        """Write a value with its unit."""
        return f"{value:.3g} {self.unit}".rstrip()


FREQUENCY = Unknown(
    "frequency",
    "natural frequencies of the box, factor",
    "",
    True,
    (0.8, 1.25),
    ("effects", "structure", "stiffness_factor"),
    2.0,
    0.04,  # as wide as the peaks of the box
    "has no modes of a box (effects: structure: {kind: modes, table: ...})",
)
DAMPING = Unknown(
    "damping",
    "damping of the box, factor",
    "",
    True,
    (0.25, 4.0),
    ("effects", "structure", "damping_factor"),
    absent=FREQUENCY.absent,
)
BACKGROUND = Unknown(
    "background",
    "amplitude of the background, factor",
    "",
    True,
    (0.25, 4.0),
    ("background", "amplitude_factor"),
    absent="has no background with roughness or forces",
)
NOISE = Unknown(
    "noise",
    "noise density of the accelerometer",
    "m/s2 per root Hz",
    True,
    (0.01, 200.0),
    ("sensors", SENSOR, "noise_density_m_per_s2_per_sqrt_Hz"),
    absent="has an accelerometer without noise",
)
END_PLAY = Unknown(
    "end_play", "end play as mounted", "mm", False, (-0.15, 0.15), ("end_play_mm",),
    absent="has a cylindrical pair, whose play between its ribs presses no roller",
)  # fmt: skip
UNKNOWNS = (FREQUENCY, DAMPING, BACKGROUND, NOISE, END_PLAY)
"""In the order in which they are reported."""
BY_NAME = {each.name: each for each in UNKNOWNS}

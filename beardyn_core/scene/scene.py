"""The scene: one bearing under one operation, with all that is asked of the run."""

from __future__ import annotations

from dataclasses import dataclass

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.thermal_closure import PartTemperatures
from beardyn_core.effects import EffectSet
from beardyn_core.scene.defect import Defect, MissingRoller
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Operation
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.scene.tier import missing_effects
from beardyn_core.scene.waviness import Waviness

# what a user can ask of a run; see `choice`
QUANTITIES = ("force", "deflection", "roller_load", "torque", "vibration", "cage_speed")
USUAL_QUANTITIES = QUANTITIES[:-1]

# options of the rib that only the full tier has
_FULL_RIB_OPTIONS = ("lubrication", "roller_end", "drilling")


@dataclass(frozen=True)
class Numerics:
    """Discretisation of a run.

    Parameters
    ----------
    laminae : int
        Laminae of each roller.
    steps_per_sample : float
        Time steps per waveform sample (25.6 kHz): the step is 1 / (25 600 x this), [-]. A whole number, or
        in the lumped tier 0.5 or 0.25.
    integrator : str
        See `scene.integrator`.
    """

    laminae: int = 6
    steps_per_sample: float = 4
    integrator: str = "implicit"


@dataclass(frozen=True)
class Scene:
    """One bearing under one operation, with all that is asked of the run.

    Parameters
    ----------
    name, purpose : str
    bearing : Bearing
    lubricant : Lubricant
    temperature : float
        Of lubricant and bearing, [K].
    end_play : float
        Total axial travel of the mounted bearing at its temperatures, negative for preload, [m].
    tier : str
        Name of a tier, see `scene.tier`.
    effects : EffectSet
    operation : Operation
        Where load and speed come from.
    mounting : Mounting
    defects : tuple of Patch, RollerError, WornPocket
    sensors : tuple of Accelerometer
    numerics : Numerics
    duration : float
        Simulated time, [s].
    seed : int
        Seed of irregularity and sensor noise.
    source_text : str
        The YAML the scene was read from, all references resolved; recorded with the run.
    waviness : tuple of Waviness
    temperatures : PartTemperatures or None
        Of cup, cone and rollers where they differ; `end_play` already has what they do to it.
    accuracy : float or None
        Stated relative accuracy of the quantities, for what is chosen automatically, [-].
    quantities : tuple of str
        What is asked of the run, out of `QUANTITIES`.
    chosen : tuple of str
        What has been chosen automatically, each with its reason.
    rows : int
        Rows of rollers, each with its cage: 2, or 1 for row 0 (inboard) alone.
    missing_rollers : tuple of MissingRoller
    """

    name: str
    purpose: str
    bearing: Bearing
    lubricant: Lubricant
    temperature: float
    end_play: float
    tier: str
    effects: EffectSet
    operation: Operation
    mounting: Mounting
    defects: tuple[Defect, ...]
    sensors: tuple[Accelerometer, ...]
    numerics: Numerics
    duration: float
    seed: int
    source_text: str
    waviness: tuple[Waviness, ...] = ()
    temperatures: PartTemperatures | None = None
    accuracy: float | None = None
    quantities: tuple[str, ...] = USUAL_QUANTITIES
    chosen: tuple[str, ...] = ()
    rows: int = 2
    missing_rollers: tuple[MissingRoller, ...] = ()

    def __repr__(self) -> str:
        """Give what it is about, in two lines."""
        where = type(self.operation).__name__.removesuffix("Operation")
        faults = "; ".join(self.fault_sentences) or "no faults"
        return (
            f"Scene {self.name}: bearing {self.bearing.name}, tier {self.tier}, {where}, "
            f"{self.duration:g} s, {faults}\n  effects: {', '.join(self.effects.names()) or 'none'}"
        )

    @property
    def effect_names(self) -> tuple[str, ...]:
        """Names of the effects that are present, faults included."""
        return (
            *self.effects.names(),
            *(("faults",) if self.faults else ()),
            *(("waviness",) if self.waviness else ()),
        )

    @property
    def fault_sentences(self) -> tuple[str, ...]:
        """Defects, missing rollers and waviness in words."""
        return tuple(fault.described() for fault in (*self.faults, *self.waviness))

    @property
    def faults(self) -> tuple[Defect, ...]:
        """Defects and missing rollers."""
        return (*self.defects, *self.missing_rollers)

    @property
    def missing_places(self) -> tuple[tuple[int, int], ...]:
        """Row and roller of those that are missing."""
        return tuple((each.row, each.roller) for each in self.missing_rollers)

    @property
    def roller_total(self) -> int:
        """Rollers that are there, of all rows."""
        return self.rows * self.bearing.roller_count - len(self.missing_rollers)

    @property
    def missing_effects(self) -> tuple[str, ...]:
        """Names of the effects and options that are asked for and that the tier does not represent."""
        rib = self.effects.rib
        options = () if rib is None else (name for name in _FULL_RIB_OPTIONS if getattr(rib, name))
        return missing_effects(self.tier, (*self.effect_names, *(f"rib.{name}" for name in options)))

"""The scene: one bearing under one operation, with all that is asked of the run."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from typing import Annotated as A
from typing import Any, Literal

from beardyn_core.base.edge import INTERNAL, SEED, At
from beardyn_core.base.units import UNITS
from beardyn_core.bearing.any_bearing import AnyBearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.bearing.thermal import Temperatures
from beardyn_core.effects import EffectSet
from beardyn_core.scene.axleboxes import Axleboxes
from beardyn_core.scene.background import Background
from beardyn_core.scene.defect import Defect, MissingRoller, doubts_about
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import ConstantOperation, Operation, SteppedOperation
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.sensor import Accelerometer, sensor_doubts, waveform_rate
from beardyn_core.scene.tier import LARGEST_STEPS, TIER_NAMES, missing_effects
from beardyn_core.scene.waviness import Waviness

# what a user can ask of a run; see `choice`
QUANTITIES = ("force", "deflection", "roller_load", "torque", "vibration", "cage_speed")
USUAL_QUANTITIES = QUANTITIES[:-1]
SNAPSHOT_RATES = tuple(200.0 * 2**k for k in range(7))  # [Hz]
EFFECTS = tuple(field.name for field in fields(EffectSet))


@dataclass(frozen=True)
class Numerics:
    """Discretisation of a run."""

    laminae: A[int, At(ge=1, le=100), "of each roller"] = 6
    steps_per_sample: A[
        float,
        "time steps per waveform sample of 1/25600 s; 1 in the fast tiers, also 0.5 and in tier "
        "lumped 0.25; to be given with integrator: explicit, up to "
        f"{LARGEST_STEPS['explicit']}",
    ] = 4
    integrator: A[
        str,
        At(one_of=("implicit", "explicit")),
        "explicit takes the contact forces of the beginning of a step: for references only, in "
        "tier full; friction hides an oscillation in it with steps above 0.5 us (dry) to 5 us (films)",
    ] = "implicit"


def snapshots_do_not_fit(rate: float, steps_per_sample: float) -> str | None:
    """Say why bodies and contacts cannot be kept at a rate [Hz]; ``None`` where they can."""
    # a snapshot is every second one of the instants that a block of steps is divided into
    fitting = [each for each in SNAPSHOT_RATES if each <= SNAPSHOT_RATES[-1] * min(steps_per_sample, 1.0)]
    if rate in fitting:
        return None
    return (
        f"snapshot_rate_Hz is {rate:g}; with steps_per_sample {steps_per_sample:g} allowed are "
        f"{', '.join(f'{each:g}' for each in fitting)}"
    )


@dataclass(frozen=True, kw_only=True)
class Scene:
    """One bearing under one operation, with all that is asked of the run."""

    name: A[str, At(longest=80, key="scene"), "name of the scene"]
    purpose: A[str, "one line: what the scene is for"] = ""
    bearing: A[AnyBearing, At(reference=True), "a shipped bearing, a path, or the keys of one"]
    lubricant: A[Lubricant, At(reference=True), "a shipped lubricant, a path, or the keys of one"]
    temperature: A[float, At("C", ge=-60.0, le=200.0), "lubricant and bearing"] = 343.15
    end_play: A[
        float,
        At("mm", ge=-0.5, le=2.0, optional=True),
        "total axial travel, negative for preload; the bearing's own when left out",
    ]
    tier: A[str, At(one_of=(*TIER_NAMES, "auto")), "which bodies move by their own equations of motion"] = (
        "full"
    )
    temperatures: A[
        Temperatures | None,
        "of the parts; with them the end play, of others the radial clearance, is that at assembly_C",
    ] = None
    effects: A[
        EffectSet, At(reference=True, usual="auto"), "a preset, a path, which effects are on, or auto"
    ] = EffectSet()
    accuracy: A[
        float | None,
        At("percent", gt=0.0, ge=0.1, le=50.0),
        "of what is asked for, when something is auto; 5 when left out",
    ] = None
    quantities: A[
        tuple[str, ...],
        At(one_of=QUANTITIES, size=(1, None)),
        "what is asked of the run, when something is auto",
    ] = USUAL_QUANTITIES
    vibration_to: A[
        float | None,
        At("Hz", gt=0.0, ge=200.0, le=20_000.0),
        "highest third octave of the vibration that is asked for, when something is auto; as far as the "
        "sensors measure when left out. Sensors without rate_kHz are then sampled no faster than that needs",
    ] = None
    operation: A[Operation, "where load and speed come from"]
    background: A[
        Background | None,
        At(reference=True),
        "what the sensors measure besides the bearing: a shipped one, a path, or the keys of one",
    ] = None
    mounting: A[Mounting, "axlebox on its suspension, and the journal in it"] = Mounting()
    rows: A[Literal[1, 2], "2, or 1 for row 0 (inboard) alone"] = 2
    axleboxes: A[
        Axleboxes | None, "all boxes of a wheelset, a bogie, a car or a train at once; left out: one box"
    ] = None
    missing_rollers: A[tuple[MissingRoller, ...], "rollers that are not there"] = ()
    defects: A[tuple[Defect, ...], "patches, a roller of another diameter, worn pockets"] = ()
    waviness: A[tuple[Waviness, ...], "harmonics of raceways and rollers"] = ()
    scatter: A[Scatter | None, "what this bearing of a lot differs by from its drawing"] = None
    sensors: A[tuple[Accelerometer, ...], At(size=(1, None)), "on the axlebox"] = (Accelerometer(),)
    numerics: A[Numerics, "discretisation of the run, or auto"] = Numerics()
    duration: A[float, At("s", gt=0.0, le=86400.0), "simulated time"] = 2.0
    seed: A[int, SEED, "of irregularity, background and sensor noise"] = 1
    snapshot_rate: A[
        float,
        At("Hz", ge=SNAPSHOT_RATES[0], le=SNAPSHOT_RATES[-1]),
        "how often bodies and contacts are kept: 200, or twice that, four times, up to 12 800; their size in "
        "memory and in a recording goes with it. At 200 `largest` of a contact has the loads in between",
    ] = SNAPSHOT_RATES[0]
    # what has been chosen automatically, each with its reason
    chosen: A[tuple[str, ...], INTERNAL] = field(default=(), compare=False)
    # what it was chosen from, so that a changed scene is chosen for anew
    left_open: A[LeftOpen | None, INTERNAL] = field(default=None, compare=False)

    def as_written(self, keys: dict[str, Any]) -> dict[str, Any]:
        """Write the play as mounted, before temperatures change it."""
        if self.bearing.self_aligning:  # it has none along the axle
            keys.pop("end_play_mm", None)
        if self.temperatures is not None:
            closure = self.temperatures.closure(self.bearing)
            if isinstance(self.bearing, RadialBearing):
                clearance = UNITS["mm"].to_edge(self.bearing.radial_clearance, closure)
                keys["bearing"]["radial_clearance_mm"] = clearance
            else:
                keys["end_play_mm"] = UNITS["mm"].to_edge(self.end_play, closure)
        return keys

    def __repr__(self) -> str:
        """Describe the scene in two lines."""
        where = type(self.operation).__name__.removesuffix("Operation")
        faults = "; ".join(self.fault_sentences) or "no faults"
        return (
            f"Scene {self.name}: bearing {self.bearing.name}, tier {self.tier}, {where}, "
            f"{self.duration:g} s, {faults}\n  effects: {', '.join(self.effects.names()) or 'none'}"
        )

    @property
    def play(self) -> float:
        """What temperatures change: the end play, or the radial clearance of cylinders and barrels, [m]."""
        if isinstance(self.bearing, RadialBearing):
            return self.bearing.radial_clearance
        return self.end_play

    def with_play(self, play: float) -> Scene:
        """Give the scene another play, see `play`, [m]."""
        if isinstance(self.bearing, RadialBearing):
            return replace(self, bearing=replace(self.bearing, radial_clearance=play))
        return replace(self, end_play=play)

    @property
    def mounted_bearing(self) -> AnyBearing:
        """The bearing with the end play of the scene, where ribs leave it."""
        return self.bearing.mounted(self.end_play)

    @property
    def effect_names(self) -> tuple[str, ...]:
        """Names of the effects that are present, faults included."""
        return (
            *self.effects.names(),
            *(("faults",) if self.faults else ()),
            *(("waviness",) if self.waviness else ()),
            *(("scatter",) if self.scattered is not None else ()),
        )

    @property
    def scattered(self) -> Scatter | None:
        """The scatter, ``None`` when nothing scatters."""
        return None if self.scatter is None or self.scatter.absent else self.scatter

    @property
    def waves(self) -> tuple[Waviness, ...]:
        """All waves of raceways and rollers: those that are given and those of the scatter."""
        return (*self.waviness, *(self.scattered.waves(self.bearing) if self.scattered else ()))

    @property
    def fault_sentences(self) -> tuple[str, ...]:
        """Defects, missing rollers and waviness in words."""
        return tuple(fault.described() for fault in (*self.faults, *self.waviness))

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences about what can be but is probably not meant: a force of 80 N, a very wide spall."""
        from beardyn_core.bearing.life import load_doubts

        forces = {}
        if isinstance(self.operation, ConstantOperation):
            forces["operation.force_kN"] = self.operation.force
        elif isinstance(self.operation, SteppedOperation):
            for index, step in enumerate(self.operation.steps):
                forces[f"operation.steps[{index}].force_kN"] = step.force
        loads = {key: load_doubts(self.bearing, force)[1] for key, force in forces.items()}
        told = [f"{key}: {doubt}" for key, doubt in loads.items() if doubt]
        effects = self.effects
        if effects.structure and not (effects.traction or effects.rib or effects.cage):
            told.append("effects: structure without cage, rib and traction; `preset: standard` brings them")
        told += sensor_doubts(self.sensors, self.bearing)
        return (*told, *doubts_about(self.defects, self.bearing))

    @property
    def waveform_rate(self) -> float:
        """Rate of the force waveform, and of every sensor that is not faster, [Hz]."""
        return waveform_rate(self.sensors)

    @property
    def faults(self) -> tuple[Defect, ...]:
        """Defects and missing rollers."""
        return (*self.defects, *self.missing_rollers)

    @property
    def missing_places(self) -> tuple[tuple[int, int], ...]:
        """Row and number of each missing roller."""
        return tuple((each.row, each.roller) for each in self.missing_rollers)

    @property
    def roller_total(self) -> int:
        """Number of rollers in all rows, without the missing ones."""
        return self.rows * self.bearing.roller_count - len(self.missing_rollers)

    @property
    def missing_effects(self) -> tuple[str, ...]:
        """Names of the effects and options that are asked for and that the tier does not represent."""
        rib = self.effects.rib
        # the contact beyond the rim of a roller end; film and drilling are in the torque of every tier
        beyond_rim = ("rib.roller_end",) if rib is not None and rib.roller_end else ()
        asked = (*self.effect_names, *beyond_rim)
        found = missing_effects(self.tier, asked)
        foreign = {
            name
            for name in self.effects.names()
            if not getattr(self.effects, name).about.suits(self.bearing.kind)
        }
        found = tuple(name for name in asked if name in {*foreign, *found})
        if (
            self.tier != "full" and self.effects.film is None
        ):  # what a fast tier has of traction is the creep of films
            found = tuple(name for name in asked if name in {"traction", *found})
        return found


@dataclass(frozen=True)
class LeftOpen:
    """What a scene left to the automatic choice, and what was chosen."""

    free: Free
    effects: A[EffectSet, "those that were written down, the others of the reference"]
    chosen: A[tuple[str, EffectSet, Numerics], "tier, effects and numerics"]
    rate: A[float | None, "of all sensors, [Hz]; ``None`` where it was not chosen"] = None

    def still(self, scene: Scene) -> bool:
        """Whether a scene still has what was chosen."""
        return bool(self.free.effects) and self.chosen == (scene.tier, scene.effects, scene.numerics)

    def rate_still(self, scene: Scene) -> bool:
        """Whether the sensors of a scene still have the rate that was chosen."""
        return self.rate is not None and all(sensor.rate == self.rate for sensor in scene.sensors)


@dataclass(frozen=True)
class Free:
    """Parts of a scene that the automatic choice may set; the rest stays as written."""

    tier: bool = True
    laminae: bool = True
    steps: bool = True
    effects: A[frozenset[str], "members of the effect set"] = frozenset(EFFECTS)
    rates: A[bool, "the rate of the sensors, where anything else may be chosen"] = True

    @property
    def anything(self) -> bool:
        """Whether any part may be chosen."""
        return self.tier or self.laminae or self.steps or bool(self.effects)


NOTHING = Free(tier=False, laminae=False, steps=False, effects=frozenset(), rates=False)

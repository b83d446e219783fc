"""The scene file: one bearing under one operation, with all that is asked of the run."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal, Self, cast

from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    Tag,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticKnownError

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.thermal_closure import STEEL_EXPANSION, PartTemperatures, end_play_change
from beardyn_core.config.bearing_file import BearingKeys
from beardyn_core.config.defect_file import DefectKeys, MissingRollerKeys, RoughnessKeys, WavinessKeys
from beardyn_core.config.effects_file import EffectsKeys
from beardyn_core.config.file_model import (
    Count,
    FileModel,
    Name,
    NonNegative,
    NonNegativeVector,
    Number,
    Positive,
    PositiveVector,
    Reference,
    Text,
    Vector,
    problem,
)
from beardyn_core.config.lubricant_file import LubricantKeys
from beardyn_core.config.operation_file import OperationKeys, scaled
from beardyn_core.config.units import KN, MEGA, MM, UM, ZERO_CELSIUS
from beardyn_core.scene.integrator import LARGEST_STEPS
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.scene import USUAL_QUANTITIES, Numerics, Scene
from beardyn_core.scene.sensor import FINE_STEPS, RATES, Accelerometer, steps_do_not_fit
from beardyn_core.scene.tier import LONG_STEPS, TIERS


class MountingKeys(FileModel):
    """Axlebox on its suspension, and the journal in it."""

    cup: Literal["held", "suspended"] = "suspended"
    journal_tilt: Literal["locked", "free"] = "locked"
    box_mass_kg: Positive = Field(100.0, description="axlebox without the cup")
    box_inertia_kg_m2: PositiveVector = (2.0, 2.0, 2.0)
    journal_mass_kg: Positive = Field(900.0, description="half wheelset")
    journal_inertia_kg_m2: Positive = Field(50.0, description="about x and z")
    stiffness_MN_per_m: NonNegativeVector = (10.0, 5.0, 1.2)
    damping_kN_s_per_m: NonNegativeVector = (20.0, 20.0, 10.0)
    rotational_stiffness_kN_m_per_rad: NonNegativeVector = (100.0, 200.0, 100.0)
    rotational_damping_N_m_s_per_rad: NonNegativeVector = (500.0, 1000.0, 500.0)
    box_centre_mm: Vector = Field(
        (0.0, 0.0, 0.0), description="centre of mass of the axlebox without the cup, from the bearing centre"
    )
    suspension_centre_mm: Vector = Field(
        (0.0, 0.0, 0.0), description="where the springs act on the axlebox, from the bearing centre"
    )
    load_offset_mm: Vector = Field(
        (0.0, 0.0, 0.0), description="where the load acts on the journal, from the bearing centre"
    )
    axial_prop_stiffness_MN_per_m: NonNegative = Field(
        0.0, description="of a spring between journal and ground along y; a single row needs it"
    )
    axial_prop_damping_kN_s_per_m: NonNegative = Field(0.0, description="of a damper beside that spring")

    @model_validator(mode="after")
    def _box_has_inertia(self) -> Self:
        away = [
            sum(c * c for k, c in enumerate(self.box_centre_mm) if k != axis) / MM**2 for axis in range(3)
        ]
        least = tuple(self.box_mass_kg * square for square in away)
        if any(have <= need for have, need in zip(self.box_inertia_kg_m2, least, strict=True) if need):
            raise problem(
                f"box_inertia_kg_m2 is {list(self.box_inertia_kg_m2)}; about the bearing centre it must be "
                f"above {[round(value, 4) for value in least]}, what box_mass_kg alone has at box_centre_mm"
            )
        return self

    @model_validator(mode="after")
    def _offset_load_turns_something(self) -> Self:
        if any(self.load_offset_mm) and self.cup == "held" and self.journal_tilt == "locked":
            raise problem(
                f"load_offset_mm is {list(self.load_offset_mm)}; it turns nothing while cup is held and "
                "journal_tilt is locked: set journal_tilt to free or cup to suspended"
            )
        return self

    def noun(self) -> Mounting:
        """The mounting, SI."""
        return Mounting(
            cup=self.cup,
            journal_tilt=self.journal_tilt,
            box_mass=self.box_mass_kg,
            box_inertia=self.box_inertia_kg_m2,
            journal_mass=self.journal_mass_kg,
            journal_inertia=self.journal_inertia_kg_m2,
            stiffness=scaled(self.stiffness_MN_per_m, MEGA),
            damping=scaled(self.damping_kN_s_per_m, KN),
            rotational_stiffness=scaled(self.rotational_stiffness_kN_m_per_rad, KN),
            rotational_damping=self.rotational_damping_N_m_s_per_rad,
            box_centre=_metres(self.box_centre_mm),
            suspension_centre=_metres(self.suspension_centre_mm),
            load_offset=_metres(self.load_offset_mm),
            axial_prop_stiffness=self.axial_prop_stiffness_MN_per_m * MEGA,
            axial_prop_damping=self.axial_prop_damping_kN_s_per_m * KN,
        )


def _metres(vector: tuple[float, float, float]) -> tuple[float, float, float]:
    x, y, z = vector
    return (x / MM, y / MM, z / MM)


class TemperaturesKeys(FileModel):
    """Temperatures of the parts, for the end play; it is given as mounted at the assembly temperature."""

    assembly_C: Annotated[Number, Field(ge=-60.0, le=80.0)] = 20.0
    cup_C: Annotated[Number, Field(ge=-60.0, le=250.0)]
    cone_C: Annotated[Number, Field(ge=-60.0, le=250.0)]
    rollers_C: Annotated[Number, Field(ge=-60.0, le=250.0)]
    expansion_um_per_m_K: NonNegative = STEEL_EXPANSION * UM

    def noun(self) -> PartTemperatures:
        """The temperatures, SI."""
        return PartTemperatures(
            self.cup_C + ZERO_CELSIUS, self.cone_C + ZERO_CELSIUS, self.rollers_C + ZERO_CELSIUS
        )

    def closure(self, bearing: Bearing) -> float:
        """What they add to the end play, [m]."""
        change = PartTemperatures(
            self.cup_C - self.assembly_C, self.cone_C - self.assembly_C, self.rollers_C - self.assembly_C
        )
        return end_play_change(bearing, change, self.expansion_um_per_m_K / UM)


class SensorKeys(FileModel):
    """A three-axis accelerometer screwed to the axlebox."""

    name: Annotated[Name, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]*$")] = "axlebox_top"
    position_mm: Vector = Field((0.0, 0.0, 170.0), description="from the bearing centre along x, y, z")
    noise_density_m_per_s2_per_sqrt_Hz: NonNegative = 0.02
    range_m_per_s2: Positive = Field(5000.0, description="clipping level of each axis")
    mounting_resonance_Hz: Annotated[Positive, Field(ge=500.0, le=100_000.0)] | None = Field(
        None, description="of the accelerometer on its mounting (ISO 5348); rigid when not given"
    )
    mounting_damping_ratio: Annotated[Positive, Field(ge=0.001, le=0.9)] | None = Field(
        None, description=f"of critical; {Accelerometer.mounting_damping_ratio:g} when not given"
    )
    rate_kHz: Annotated[Number, WithJsonSchema({"enum": [rate / KN for rate in RATES]})] = Field(
        RATES[0] / KN,
        description=f"51.2 needs an even numerics.steps_per_sample of {FINE_STEPS} or more, its default then",
    )

    @model_validator(mode="after")
    def _is_offered(self) -> Self:
        offered = [rate / KN for rate in RATES]
        if self.rate_kHz not in offered:
            raise problem(f"rate_kHz is {self.rate_kHz:g}; allowed is {offered[0]:g} or {offered[1]:g}")
        if self.mounting_damping_ratio is not None and self.mounting_resonance_Hz is None:
            raise problem(
                f"mounting_damping_ratio is {self.mounting_damping_ratio:g}; it damps nothing without "
                "mounting_resonance_Hz: give that too, or leave both out for a rigid mounting"
            )
        return self

    def noun(self) -> Accelerometer:
        """The accelerometer, SI."""
        x, y, z = self.position_mm
        damping = self.mounting_damping_ratio
        return Accelerometer(
            self.name,
            (x / MM, y / MM, z / MM),
            self.noise_density_m_per_s2_per_sqrt_Hz,
            self.range_m_per_s2,
            self.mounting_resonance_Hz,
            Accelerometer.mounting_damping_ratio if damping is None else damping,
            self.rate_kHz * KN,
        )


def _or_auto(least: int, most: int) -> WithJsonSchema:
    """A count or `auto`, which is resolved before the scene is made."""
    return WithJsonSchema(
        {"anyOf": [{"type": "integer", "minimum": least, "maximum": most}, {"const": "auto"}]}
    )


def _number_of_steps(value: Any) -> Any:
    if isinstance(value, float) and value in LONG_STEPS:
        return value  # in the fast tiers
    if not isinstance(value, int) or isinstance(value, bool):
        raise PydanticKnownError("int_type")
    if value < 1:
        raise PydanticKnownError("greater_than_equal", {"ge": 1})
    return value


StepsPerSample = Annotated[
    int | float,
    BeforeValidator(_number_of_steps),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "integer", "minimum": 1, "maximum": LARGEST_STEPS["explicit"]},
                {"enum": list(LONG_STEPS)},
                {"const": "auto"},
            ]
        }
    ),
]


class NumericsKeys(FileModel):
    """Discretisation of the run."""

    laminae: Annotated[Count, Field(ge=1, le=100), _or_auto(1, 100)] = 6
    integrator: Literal["implicit", "explicit"] = Field(
        "implicit",
        description="explicit takes the contact forces of the beginning of a step: for references only, in "
        "tier full; friction hides an oscillation in it with steps above 0.5 us (dry) to 5 us (films)",
    )
    steps_per_sample: StepsPerSample = Field(
        4,
        description="time steps per waveform sample of 1/25600 s; 1 in the fast tiers, also 0.5 and in tier "
        "lumped 0.25; to be given with integrator: explicit, up to "
        f"{LARGEST_STEPS['explicit']}",
    )

    @field_validator("steps_per_sample")
    @classmethod
    def _few_enough(cls, steps: float, info: ValidationInfo) -> float:
        most = LARGEST_STEPS[info.data.get("integrator", "explicit")]
        if steps > most:
            raise PydanticKnownError("less_than_equal", {"le": most})
        return steps

    def noun(self) -> Numerics:
        """The numerics."""
        return Numerics(self.laminae, self.steps_per_sample, self.integrator)


NumericsOrAuto = Annotated[
    Annotated[Literal["auto"], Tag("<name>")] | Annotated[NumericsKeys, Tag("<inline>")],
    Discriminator(lambda value: "<name>" if isinstance(value, str) else "<inline>"),
]
Quantity = Literal["force", "deflection", "roller_load", "torque", "vibration", "cage_speed"]


class SceneKeys(FileModel):
    """One bearing under one operation, with all that is asked of the run."""

    scene: Name = Field(description="name of the scene")
    purpose: Text = Field("", description="one line: what the scene is for")
    bearing: Reference[BearingKeys] = Field(description="a shipped bearing, a path, or the keys of one")
    lubricant: Reference[LubricantKeys] = Field(description="a shipped lubricant, a path, or the keys of one")
    temperature_C: Annotated[Number, Field(ge=-60.0, le=200.0)] = Field(
        70.0, description="lubricant and bearing"
    )
    end_play_mm: Annotated[Number, Field(ge=-0.5, le=2.0)] | None = Field(
        None, description="total axial travel, negative for preload; the bearing's own when not given"
    )
    tier: Literal["lumped", "quasistatic", "full", "auto"] = Field(
        "full", description="which bodies move by their own equations of motion"
    )
    temperatures: TemperaturesKeys | None = Field(
        None, description="of the parts; with them end_play_mm is the one mounted at assembly_C"
    )
    effects: Reference[EffectsKeys] = Field(
        "standard", description="a preset, a path, which effects are on, or auto"
    )
    accuracy_percent: Annotated[Positive, Field(ge=0.1, le=50.0)] | None = Field(
        None, description="of what is asked for, when something is auto; 5 when not given"
    )
    quantities: Annotated[tuple[Quantity, ...], Field(min_length=1)] = Field(
        cast(tuple[Quantity, ...], USUAL_QUANTITIES),
        description="what is asked of the run, when something is auto",
    )
    operation: OperationKeys = Field(description="where load and speed come from")
    mounting: MountingKeys = MountingKeys()
    rows: Annotated[Literal[1, 2], Field(description="2, or 1 for row 0 (inboard) alone")] = 2
    missing_rollers: tuple[MissingRollerKeys, ...] = Field((), description="rollers that are not there")
    defects: tuple[DefectKeys, ...] = ()
    waviness: tuple[WavinessKeys, ...] = ()
    roughness: RoughnessKeys = RoughnessKeys()
    sensors: Annotated[tuple[SensorKeys, ...], Field(min_length=1)] = (SensorKeys(),)
    numerics: NumericsOrAuto = NumericsKeys()
    duration_s: Annotated[Positive, Field(le=86400.0)] = 2.0
    seed: Annotated[Count, Field(ge=0, le=2**32 - 1)] = Field(
        1, description="of irregularity and sensor noise"
    )

    @model_validator(mode="before")
    @classmethod
    def _steps_of_the_tier(cls, data: Any) -> Any:
        """Write down the time step of the tier, or of a fast sensor, where the scene does not."""
        tier = TIERS.get(str(data.get("tier", "full"))) if isinstance(data, dict) else None
        numerics = data.get("numerics", {}) if isinstance(data, dict) else None
        if tier is None or not isinstance(numerics, dict) or "steps_per_sample" in numerics:
            return data
        sensors = data.get("sensors")
        fast = isinstance(sensors, list | tuple) and any(
            isinstance(each, dict) and each.get("rate_kHz") == RATES[1] / KN for each in sensors
        )
        steps = max(tier.steps_per_sample, FINE_STEPS if fast else 1)
        return {**data, "numerics": {**numerics, "steps_per_sample": steps}}

    @model_validator(mode="after")
    def _each_quantity_once(self) -> Self:
        for index, name in enumerate(self.quantities):
            if name in self.quantities[:index]:
                raise problem(f"quantities[{index}] is {name!r}, given twice; name each quantity once")
        return self

    @model_validator(mode="after")
    def _names_of_sensors(self) -> Self:
        names = [sensor.name for sensor in self.sensors]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise problem(
                    f"sensors[{index}].name is {name!r}, given twice; each sensor needs its own name"
                )
        return self

    @model_validator(mode="after")
    def _steps_serve_the_sensors(self) -> Self:
        if isinstance(self.numerics, NumericsKeys):
            found = steps_do_not_fit(
                tuple(sensor.noun() for sensor in self.sensors), self.numerics.steps_per_sample
            )
            if found:
                raise problem(found)
        return self

    def noun(self, source_text: str) -> Scene:
        """The scene, SI; references must have been resolved."""
        assert isinstance(self.bearing, BearingKeys)
        assert isinstance(self.lubricant, LubricantKeys)
        assert isinstance(self.effects, EffectsKeys)
        assert isinstance(self.numerics, NumericsKeys)
        bearing = self.bearing.noun()
        given = self.roughness
        if given.raceway_um is not None:
            bearing = replace(bearing, raceway_roughness=given.raceway_um / UM)
        if given.rib_um is not None:
            bearing = replace(bearing, rib_roughness=given.rib_um / UM)
        return Scene(
            name=self.scene,
            purpose=self.purpose,
            bearing=bearing,
            lubricant=self.lubricant.noun(),
            temperature=self.temperature_C + ZERO_CELSIUS,
            end_play=(bearing.end_play if self.end_play_mm is None else self.end_play_mm / MM)
            + (0.0 if self.temperatures is None else self.temperatures.closure(bearing)),
            tier=self.tier,
            effects=self.effects.noun(),
            operation=self.operation.noun(),
            mounting=self.mounting.noun(),
            defects=tuple(defect.noun(bearing) for defect in self.defects),
            sensors=tuple(sensor.noun() for sensor in self.sensors),
            numerics=self.numerics.noun(),
            duration=self.duration_s,
            seed=self.seed,
            source_text=source_text,
            waviness=tuple(wave.noun() for wave in self.waviness),
            temperatures=None if self.temperatures is None else self.temperatures.noun(),
            accuracy=None if self.accuracy_percent is None else 0.01 * self.accuracy_percent,
            quantities=self.quantities,
            rows=self.rows,
            missing_rollers=tuple(roller.noun() for roller in self.missing_rollers),
        )

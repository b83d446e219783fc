"""The scene file: one bearing under one operation, with all that is asked of the run."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator
from typing_extensions import Self

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.config.bearing_file import BearingKeys
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
from beardyn_core.config.units import DEG, KN, MEGA, MM, UM, ZERO_CELSIUS
from beardyn_core.scene.defect import Spall
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.scene import Numerics, Scene
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.scene.tier import TIERS


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
        )


class DefectKeys(FileModel):
    """A patch of missing material on a raceway or a roller."""

    kind: Literal["spall"] = "spall"
    on: Literal["cup", "cone", "roller"]
    row: Annotated[Count, Field(ge=0, le=1)] = Field(description="0 inboard, 1 outboard")
    azimuth_deg: Number = Field(
        0.0, description="from +z (the top) towards +x, in the body's own frame at the start of the run"
    )
    width_mm: Annotated[Positive, Field(le=200.0)] = Field(description="in rolling direction")
    depth_um: Annotated[Positive, Field(le=5000.0)]
    length_mm: Positive | None = Field(None, description="along the roller; the whole contact when not given")
    offset_mm: Number = Field(0.0, description="centre from mid-length, positive towards the large end")
    roller: Annotated[Count, Field(ge=0)] = Field(0, description="which roller, with `on: roller`")

    def contradictions(self, bearing: Bearing) -> list[str]:
        """What of this defect does not fit the bearing; key, value and what is allowed."""
        found = []
        effective_mm = bearing.effective_length * MM
        length_mm = effective_mm if self.length_mm is None else self.length_mm
        slack_mm = 1e-9 * effective_mm
        if self.on == "roller" and self.roller >= bearing.roller_count:
            found.append(
                f"roller is {self.roller}; {bearing.name} has {bearing.roller_count} rollers per row, "
                f"0 to {bearing.roller_count - 1}"
            )
        if length_mm > effective_mm + slack_mm:
            found.append(
                f"length_mm is {length_mm:g}; it must be at most {effective_mm:g}, the effective length"
            )
        elif abs(self.offset_mm) + 0.5 * length_mm > 0.5 * effective_mm + slack_mm:
            found.append(
                f"offset_mm is {self.offset_mm:g}; with length_mm {length_mm:g} the patch reaches beyond the "
                f"effective roller length, {effective_mm:g} mm"
            )
        if self.on == "roller" and self.width_mm > bearing.roller_diameter * MM:
            found.append(
                f"width_mm is {self.width_mm:g}; it must be at most {bearing.roller_diameter * MM:g}, "
                "the roller diameter"
            )
        if self.depth_um / UM > 0.1 * bearing.roller_diameter:
            found.append(
                f"depth_um is {self.depth_um:g}; it must be at most {0.1 * bearing.roller_diameter * UM:g}, "
                "a tenth of the roller diameter"
            )
        return found

    def noun(self, bearing: Bearing) -> Spall:
        """The spall, SI."""
        return Spall(
            on=self.on,
            row=self.row,
            azimuth=self.azimuth_deg * DEG,
            width=self.width_mm / MM,
            depth=self.depth_um / UM,
            length=bearing.effective_length if self.length_mm is None else self.length_mm / MM,
            offset=self.offset_mm / MM,
            roller=self.roller,
        )


class SensorKeys(FileModel):
    """A three-axis accelerometer screwed to the axlebox."""

    name: Annotated[Name, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]*$")] = "axlebox_top"
    position_mm: Vector = Field((0.0, 0.0, 170.0), description="from the bearing centre along x, y, z")
    noise_density_m_per_s2_per_sqrt_Hz: NonNegative = 0.02
    range_m_per_s2: Positive = Field(5000.0, description="clipping level of each axis")

    def noun(self) -> Accelerometer:
        """The accelerometer, SI."""
        x, y, z = self.position_mm
        return Accelerometer(
            self.name,
            (x / MM, y / MM, z / MM),
            self.noise_density_m_per_s2_per_sqrt_Hz,
            self.range_m_per_s2,
        )


class NumericsKeys(FileModel):
    """Discretisation of the run."""

    laminae: Annotated[Count, Field(ge=1, le=100)] = 6
    steps_per_sample: Annotated[Count, Field(ge=1, le=64)] = Field(
        4, description="time steps per waveform sample of 1/25600 s; 1 in tier lumped, 2 in quasistatic"
    )

    def noun(self) -> Numerics:
        """The numerics."""
        return Numerics(self.laminae, self.steps_per_sample)


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
    tier: Literal["lumped", "quasistatic", "full"] = Field(
        "full", description="which bodies move by their own equations of motion"
    )
    effects: Reference[EffectsKeys] = Field(
        "standard", description="a preset, a path, or which effects are on"
    )
    operation: OperationKeys = Field(description="where load and speed come from")
    mounting: MountingKeys = MountingKeys()
    defects: tuple[DefectKeys, ...] = ()
    sensors: Annotated[tuple[SensorKeys, ...], Field(min_length=1)] = (SensorKeys(),)
    numerics: NumericsKeys = NumericsKeys()
    duration_s: Annotated[Positive, Field(le=86400.0)] = 2.0
    seed: Annotated[Count, Field(ge=0, le=2**32 - 1)] = Field(
        1, description="of irregularity and sensor noise"
    )

    @model_validator(mode="before")
    @classmethod
    def _steps_of_the_tier(cls, data: Any) -> Any:
        """Write down the time step of the tier where the scene does not."""
        tier = TIERS.get(str(data.get("tier", "full"))) if isinstance(data, dict) else None
        numerics = data.get("numerics", {}) if isinstance(data, dict) else None
        if tier is None or not isinstance(numerics, dict) or "steps_per_sample" in numerics:
            return data
        return {**data, "numerics": {**numerics, "steps_per_sample": tier.steps_per_sample}}

    @model_validator(mode="after")
    def _names_of_sensors(self) -> Self:
        names = [sensor.name for sensor in self.sensors]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise problem(
                    f"sensors[{index}].name is {name!r}, given twice; each sensor needs its own name"
                )
        return self

    def noun(self, source_text: str) -> Scene:
        """The scene, SI; references must have been resolved."""
        assert isinstance(self.bearing, BearingKeys)
        assert isinstance(self.lubricant, LubricantKeys)
        assert isinstance(self.effects, EffectsKeys)
        bearing = self.bearing.noun()
        return Scene(
            name=self.scene,
            purpose=self.purpose,
            bearing=bearing,
            lubricant=self.lubricant.noun(),
            temperature=self.temperature_C + ZERO_CELSIUS,
            end_play=bearing.end_play if self.end_play_mm is None else self.end_play_mm / MM,
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
        )

"""The bearing file: geometry, masses, material, cage, with a source for every number."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from beardyn_core.bearing.geometry import Bearing, CageData
from beardyn_core.bearing.material import Material
from beardyn_core.bearing.profile import Profile
from beardyn_core.config.file_model import (
    Count,
    Name,
    NonNegative,
    Number,
    Positive,
    PositiveVector,
    SourcedModel,
    SourcedPart,
    Text,
    problem,
)
from beardyn_core.config.units import DEG, GIGA, KN, MEGA, MM, UM

_DESIGN = ("design_pressure_MPa", "design_load_kN")
# kind: keys it needs, keys of which it needs one, keys it may have
_PROFILE_KEYS: dict[str, tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]] = {
    "straight": ((), (), ()),
    "crowned": (("drop_um",), (), ()),
    "logarithmic": (("design_pressure_MPa",), (), ()),
    "lundberg": ((), _DESIGN, ()),
    "johns_gohar": ((), _DESIGN, ()),
    "iso_16281": ((), (), ("design_pressure_MPa",)),
    "fujiwara": (("drop_um",), _DESIGN, ("load_factor", "crowned_share")),
}


class ProfileKeys(SourcedPart):
    """Generator profile of the rollers."""

    kind: Literal[
        "straight", "crowned", "logarithmic", "lundberg", "johns_gohar", "iso_16281", "fujiwara"
    ] = "straight"
    drop_um: NonNegative | None = Field(
        None, description="crowned, fujiwara: drop at the ends of the effective length"
    )
    design_pressure_MPa: Annotated[Positive, Field(le=10000.0)] | None = Field(
        None,
        description="contact pressure that the profile makes uniform; iso_16281 without it is the standard's "
        "own function, Lundberg's for 3000 MPa",
    )
    design_load_kN: Positive | None = Field(
        None, description="lundberg, johns_gohar, fujiwara: load of one contact, instead of the pressure"
    )
    load_factor: Positive | None = Field(None, description="fujiwara: K1, factor of the design load; 1")
    crowned_share: Annotated[Positive, Field(le=1.0)] | None = Field(
        None, description="fujiwara: K2, share of the generator that is crowned; 1"
    )

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Self:
        needed, one_of, optional = _PROFILE_KEYS[self.kind]
        keys = ("drop_um", *_DESIGN, "load_factor", "crowned_share")
        given = [key for key in keys if getattr(self, key) is not None]
        for key in given:
            if key not in (*needed, *one_of, *optional):
                raise problem(f"gives {key}, which a {self.kind} profile does not have; remove it")
        for key in needed:
            if key not in given:
                raise problem(f"has no {key}; a {self.kind} profile needs it")
        chosen = [key for key in one_of if key in given]
        if one_of and len(chosen) != 1:
            found = "both" if chosen else "neither"
            raise problem(f"gives {found} of {' and '.join(one_of)}; a {self.kind} profile needs one")
        if self.kind == "fujiwara" and self.drop_um == 0.0:
            raise problem("gives drop_um 0; a fujiwara profile needs a drop above 0")
        return self

    def noun(self) -> Profile:
        """The profile, SI."""
        return Profile(
            kind=self.kind,
            drop=(self.drop_um or 0.0) / UM,
            design_pressure=(self.design_pressure_MPa or 0.0) * MEGA,
            design_load=(self.design_load_kN or 0.0) * KN,
            load_factor=self.load_factor or 1.0,
            crowned_share=self.crowned_share or 1.0,
        )


class MaterialKeys(SourcedPart):
    """Steel of rings and rollers."""

    youngs_modulus_GPa: Annotated[Positive, Field(ge=10.0, le=1000.0)] = 206.0
    poisson_ratio: Annotated[Number, Field(ge=0.0, lt=0.5)] = 0.3
    density_kg_per_m3: Annotated[Positive, Field(ge=500.0, le=25000.0)] = 7830.0

    def noun(self) -> Material:
        """The material, SI."""
        return Material(self.youngs_modulus_GPa * GIGA, self.poisson_ratio, self.density_kg_per_m3)


class CageKeys(SourcedPart):
    """Cage of one row."""

    mass_kg: Positive
    polar_inertia_kg_m2: Positive
    transverse_inertia_kg_m2: Positive
    circumferential_clearance_mm: Positive = Field(description="total, of a roller in its pocket")
    axial_clearance_mm: Positive = Field(description="total, of a roller in its pocket")
    stiffness_MN_per_m: Positive = Field(description="of one pocket contact")
    damping_N_s_per_m: NonNegative = Field(description="of one pocket contact")

    def noun(self) -> CageData:
        """The cage data, SI."""
        return CageData(
            mass=self.mass_kg,
            polar_inertia=self.polar_inertia_kg_m2,
            transverse_inertia=self.transverse_inertia_kg_m2,
            circumferential_clearance=self.circumferential_clearance_mm / MM,
            axial_clearance=self.axial_clearance_mm / MM,
            stiffness=self.stiffness_MN_per_m * MEGA,
            damping=self.damping_N_s_per_m,
        )


class BearingKeys(SourcedModel):
    """A double-row tapered roller bearing, O arrangement."""

    name: Name
    description: Text = ""
    roller_count: Annotated[Count, Field(ge=4, le=60)] = Field(description="per row")
    pitch_diameter_mm: Positive
    roller_diameter_mm: Positive = Field(description="mean, at mid-length")
    effective_length_mm: Positive = Field(description="of the raceway contact")
    roller_length_mm: Positive
    contact_angle_deg: Annotated[Positive, Field(lt=45.0)] = Field(description="roller axis to bearing axis")
    cup_angle_deg: Positive | None = Field(
        None, description="catalogue value, only compared with the closed one"
    )
    cone_angle_deg: Positive | None = Field(
        None, description="catalogue value, only compared with the closed one"
    )
    angle_tolerance_deg: Positive = 0.25
    row_spacing_mm: Positive = Field(description="between the roller mid-lengths of both rows")
    sphere_ratio: Positive = Field(description="radius of the roller's large end over the apex distance")
    rib_contact_height_mm: Positive = Field(description="above the cone raceway")
    rib_height_mm: Positive = Field(5.0, description="upper end of the rib face above the cone raceway")
    rib_undercut_mm: Positive = Field(1.0, description="lower end of the rib face above the cone raceway")
    roller_chamfer_mm: Positive = Field(
        0.5, description="radius of the large end less that of its spherical face"
    )
    small_rib_height_mm: Positive = Field(2.0, description="above the cone raceway")
    small_rib_clearance_mm: NonNegative = Field(
        0.4, description="free travel of a roller along its axis between the ribs"
    )
    bore_mm: Positive
    outer_diameter_mm: Positive
    width_mm: Positive
    end_play_mm: Annotated[Number, Field(ge=-0.5, le=2.0)] = Field(
        description="total axial travel when mounted"
    )
    raceway_roughness_um: Positive = Field(description="composite rms")
    rib_roughness_um: Positive = Field(description="composite rms")
    profile: ProfileKeys = ProfileKeys()
    material: MaterialKeys = MaterialKeys()
    cage: CageKeys
    cup_mass_kg: Positive
    cup_inertia_kg_m2: PositiveVector = Field(description="about x, y, z through the bearing centre")
    cone_mass_kg: Positive = Field(description="both cones and the spacer")

    def noun(self) -> Bearing:
        """The bearing, SI."""
        return Bearing(
            name=self.name,
            description=self.description,
            roller_count=self.roller_count,
            pitch_diameter=self.pitch_diameter_mm / MM,
            roller_diameter=self.roller_diameter_mm / MM,
            effective_length=self.effective_length_mm / MM,
            roller_length=self.roller_length_mm / MM,
            contact_angle=self.contact_angle_deg * DEG,
            row_spacing=self.row_spacing_mm / MM,
            sphere_ratio=self.sphere_ratio,
            rib_contact_height=self.rib_contact_height_mm / MM,
            bore=self.bore_mm / MM,
            outer_diameter=self.outer_diameter_mm / MM,
            width=self.width_mm / MM,
            end_play=self.end_play_mm / MM,
            raceway_roughness=self.raceway_roughness_um / UM,
            rib_roughness=self.rib_roughness_um / UM,
            profile=self.profile.noun(),
            material=self.material.noun(),
            cage=self.cage.noun(),
            cup_mass=self.cup_mass_kg,
            cup_inertia=self.cup_inertia_kg_m2,
            cone_mass=self.cone_mass_kg,
            sources=tuple(self.sources.items()),
            nominal_cup_angle=None if self.cup_angle_deg is None else self.cup_angle_deg * DEG,
            nominal_cone_angle=None if self.cone_angle_deg is None else self.cone_angle_deg * DEG,
            angle_tolerance=self.angle_tolerance_deg * DEG,
            rib_height=self.rib_height_mm / MM,
            rib_undercut=self.rib_undercut_mm / MM,
            roller_chamfer=self.roller_chamfer_mm / MM,
            small_rib_height=self.small_rib_height_mm / MM,
            small_rib_clearance=self.small_rib_clearance_mm / MM,
        )

"""Content of ``beardyn bearing --json``: geometry, fault frequencies, static solution."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from typing import Annotated as A

if TYPE_CHECKING:
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.physics.statics.static import StaticSolution

# properties of a bearing with their unit, in the order of the JSON object
_SHARED = (
    *(("m", name) for name in ("bore", "outer_diameter", "width", "row_spacing", "pitch_diameter")),
    *(("m", name) for name in ("roller_diameter", "effective_length", "roller_length")),
    *(("rad", "contact_angle"), ("m", "cup_radius"), ("m", "cone_radius"), ("m", "radial_clearance")),
)
_GEOMETRY_OF_OTHERS = {
    "cylindrical": (
        *_SHARED,
        *(("m", name) for name in ("end_play", "roller_play", "cup_rib_height", "cone_rib_height")),
        *(("m", "rib_contact_height"), ("rad", "rib_opening"), ("m", "end_radius")),
    ),
    "spherical": (
        *_SHARED,
        *(("m", name) for name in ("sphere_radius", "roller_profile_radius", "cone_profile_radius")),
    ),
}
_MASSES = (
    ("m", "roller_web"),
    *(("kg", "roller_mass"), ("kg_m2", "roller_axial_inertia"), ("kg_m2", "roller_transverse_inertia")),
)
_GEOMETRY = (
    *(("m", name) for name in ("bore", "outer_diameter", "width", "row_spacing", "pitch_diameter")),
    *(("m", name) for name in ("roller_diameter", "effective_length", "roller_length")),
    *(("rad", name) for name in ("contact_angle", "cup_angle", "cone_angle", "half_angle")),
    *(("m", name) for name in ("apex_distance", "large_end_radius", "small_end_radius", "sphere_radius")),
    *(
        ("m", "rib_contact_height"),
        ("rad", "rib_angle"),
        ("m", "pressure_centre_spread"),
        ("m", "roller_web"),
    ),
    *(("kg", "roller_mass"), ("kg_m2", "roller_axial_inertia"), ("kg_m2", "roller_transverse_inertia")),
    ("m", "roller_mass_offset"),
)


@dataclass(frozen=True)
class Case:
    """A bearing and what it is solved for, from the options."""

    args: argparse.Namespace
    bearing: A[RollerBearing, "with the radial clearance of the options"]
    load: A[tuple[float, float, float], "on the cone, [N]"]
    end_play: A[float | None, "``None`` where the bearing has none, [m]"]
    speed: A[float, "of the shaft, [rad/s]"]
    laminae: int

    @property
    def radial_clearance(self) -> float | None:
        """``None`` where the bearing has none, [m]."""
        clearance: float | None = getattr(self.bearing, "radial_clearance", None)
        return clearance


def report_object(case: Case, solution: StaticSolution) -> dict[str, Any]:
    """Gather the content of the JSON object."""
    from beardyn_core.bearing.kinematics import fault_frequencies

    return {
        "bearing": case.bearing.name,
        "geometry": _geometry(case.bearing),
        "fault_frequencies_per_rev": fault_frequencies(case.bearing).by_name,
        "static": {
            "applied_force_N": case.load,
            "end_play_m": case.end_play,
            "radial_clearance_m": case.radial_clearance,
            "tilt": case.args.tilt,
            "shaft_speed_rad_per_s": case.speed,
            "laminae": case.laminae,
            "rings": case.args.rings,
            "coupled_laminae": case.args.coupled_laminae,
            "displacement_m": solution.displacement,
            "tilt_rad": solution.tilt,
            "roller_load_N": solution.cup_load,
            "loaded_roller_count": sum(solution.loaded_roller_count),
            "loaded_roller_count_per_row": list(solution.loaded_roller_count),
            "largest_roller_load_N": solution.largest_roller_load,
            "largest_pressure_Pa": solution.largest_pressure,
            "roller_pressure_Pa": {
                "cup": solution.cup_pressure,
                "cone": solution.cone_pressure,
                "rib": solution.rib_pressure,
            },
            "rib_load_N": solution.rib_load,
            "most_loaded_roller": most_loaded_roller(case.bearing, solution),
            "stiffness_tilt_held_N_per_m": solution.stiffness_tilt_held,
            "stiffness_tilt_free_N_per_m": solution.stiffness_tilt_free,
        },
    }


def most_loaded_roller(bearing: RollerBearing, solution: StaticSolution) -> dict[str, Any]:
    """Compute load and Hertz pressure along the most loaded roller, to its large or outer end."""
    from beardyn_core.physics.lamina_table import lamina_places, lamina_pressure

    row, roller = divmod(int(solution.cup_load.argmax()), solution.cup_load.shape[1])
    count = solution.cup_lamina_load.shape[-1]
    report: dict[str, Any] = {"row": row, "roller": roller, "place_m": lamina_places(bearing, count)}
    for ring, loads in (("cup", solution.cup_lamina_load), ("cone", solution.cone_lamina_load)):
        load = loads[row, roller]
        report[f"{ring}_load_per_length_N_per_m"] = load * count / bearing.effective_length
        report[f"{ring}_pressure_Pa"] = lamina_pressure(bearing, load, ring)
    return report


def _geometry(bearing: RollerBearing) -> dict[str, Any]:
    from beardyn_core.bearing.life import dynamic_rating

    others = _GEOMETRY_OF_OTHERS.get(bearing.kind)
    return {
        "kind": bearing.kind,
        "roller_count": bearing.roller_count,
        "row_count": 2,
        **{
            f"{name}_{unit}": getattr(bearing, name)
            for unit, name in (_GEOMETRY if others is None else (*others, *_MASSES))
        },
        "gamma": bearing.gamma,
        "dynamic_load_rating_N": dynamic_rating(bearing).radial,
    }

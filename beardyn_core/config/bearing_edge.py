"""A bearing back to the keys of its file, for a scene that holds a bearing made in code."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.config.bearing_file import BearingKeys, CageKeys, MaterialKeys, ProfileKeys
from beardyn_core.config.file_model import FileModel
from beardyn_core.config.units import DEG, GIGA, KN, MEGA, MM, UM, stem_of

# Ending of a key -> how many of its unit make one SI unit.
_PER_SI = {"MN_per_m": 1.0 / MEGA, "mm": MM, "um": UM, "deg": 1.0 / DEG, "GPa": 1.0 / GIGA,
           "MPa": 1.0 / MEGA, "kN": 1.0 / KN}  # fmt: skip
_STATED = {"cup_angle_deg": "nominal_cup_angle", "cone_angle_deg": "nominal_cone_angle"}


def bearing_mapping(bearing: Bearing) -> dict[str, Any]:
    """Write a bearing as the mapping of a bearing file: reading it gives an equal bearing.

    Parameters
    ----------
    bearing : Bearing
    """
    keys = _keys_of(BearingKeys, bearing, leave_out=("profile", "material", "cage", "sources"))
    profile = _keys_of(ProfileKeys, bearing.profile)
    kept = {key: value for key, value in profile.items() if key == "kind" or _is_meant(key, bearing, value)}
    return {
        **keys,
        "sources": dict(bearing.sources),
        "profile": kept,
        "material": _keys_of(MaterialKeys, bearing.material),
        "cage": _keys_of(CageKeys, bearing.cage),
    }


def _is_meant(key: str, bearing: Bearing, value: float) -> bool:
    """Whether a number of the profile says something: 0 and a factor of 1 stand for nothing given."""
    usual = 1.0 if key in ("load_factor", "crowned_share") else 0.0
    return value != usual or (key == "drop_um" and bearing.profile.kind == "crowned")


def _keys_of(model: type[FileModel], noun: Any, leave_out: tuple[str, ...] = ()) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key in model.model_fields:
        if key in leave_out:
            continue
        value = getattr(noun, _STATED.get(key, stem_of(key)))
        if value is not None:
            found[key] = _at_the_edge(key, value, _PER_SI)
    return found


def _at_the_edge(key: str, value: Any, factors: Mapping[str, float]) -> Any:
    """Bring a number from SI to the unit of its key, as the short decimal that it came from."""
    if isinstance(value, tuple):
        return [_at_the_edge(key, each, factors) for each in value]
    factor = next((factors[ending] for ending in factors if key.endswith(f"_{ending}")), None)
    return value if factor is None else float(f"{value * factor:.14g}")

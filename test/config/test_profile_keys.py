"""Which keys which profile takes, and what a wrong one is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.profile import PROFILE_KINDS, Profile
from beardyn_core.config import load_bearing
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file, write_mapping


def bearing_file(folder: Path, profile: dict[str, Any]) -> Path:
    bearing = read_file(find("bearings", "HS130x230"))
    bearing["profile"] = profile
    bearing["name"] = "profiled"
    path = folder / "profiled.yaml"
    path.write_text(write_mapping(bearing))
    return path


GOOD: list[tuple[dict[str, Any], Profile]] = [
    ({"kind": "straight"}, Profile()),
    ({"kind": "crowned", "drop_um": 12}, Profile("crowned", drop=12e-6)),
    ({"kind": "logarithmic", "design_pressure_MPa": 1500}, Profile("logarithmic", design_pressure=1.5e9)),
    ({"kind": "lundberg", "design_load_kN": 10}, Profile("lundberg", design_load=1e4)),
    ({"kind": "johns_gohar", "design_pressure_MPa": 1500}, Profile("johns_gohar", design_pressure=1.5e9)),
    ({"kind": "iso_16281"}, Profile("iso_16281")),
    ({"kind": "iso_16281", "design_pressure_MPa": 1500}, Profile("iso_16281", design_pressure=1.5e9)),
    (
        {"kind": "fujiwara", "design_load_kN": 10, "drop_um": 12, "load_factor": 1.5, "crowned_share": 0.6},
        Profile("fujiwara", drop=12e-6, design_load=1e4, load_factor=1.5, crowned_share=0.6),
    ),
]


@pytest.mark.parametrize(("keys", "profile"), GOOD)
def test_profile_is_read_from_its_keys(tmp_path: Path, keys: dict[str, Any], profile: Profile) -> None:
    assert load_bearing(bearing_file(tmp_path, keys)).profile == profile


def test_every_kind_can_be_written() -> None:
    assert {keys["kind"] for keys, _ in GOOD} == set(PROFILE_KINDS)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"kind": "straight", "drop_um": 3}, "gives drop_um, which a straight profile does not have"),
        ({"kind": "crowned"}, "has no drop_um; a crowned profile needs it"),
        ({"kind": "logarithmic"}, "has no design_pressure_MPa; a logarithmic profile needs it"),
        ({"kind": "logarithmic", "design_load_kN": 1}, "gives design_load_kN, which a logarithmic profile"),
        ({"kind": "lundberg"}, "gives neither of design_pressure_MPa and design_load_kN"),
        (
            {"kind": "johns_gohar", "design_load_kN": 1, "design_pressure_MPa": 1000},
            "gives both of design_pressure_MPa and design_load_kN; a johns_gohar profile needs one",
        ),
        ({"kind": "iso_16281", "design_load_kN": 1}, "gives design_load_kN, which a iso_16281 profile"),
        ({"kind": "fujiwara", "design_load_kN": 1}, "has no drop_um; a fujiwara profile needs it"),
        ({"kind": "fujiwara", "design_load_kN": 1, "drop_um": 0}, "needs a drop above 0"),
        (
            {"kind": "fujiwara", "design_load_kN": 1, "drop_um": 9, "crowned_share": 1.2},
            "crowned_share is 1.2",
        ),
        ({"kind": "lundberg", "design_pressure_MPa": 2e4}, "design_pressure_MPa is 20000"),
        ({"kind": "conical"}, "conical"),
    ],
)  # fmt: skip
def test_a_key_that_does_not_fit_its_kind_is_named(tmp_path: Path, keys: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError) as refused:
        load_bearing(bearing_file(tmp_path, keys))
    (problem,) = refused.value.problems
    assert "profile" in problem
    assert words in problem

"""Cylindrical and spherical bearings wherever a user can ask for them: answered, or refused by a sentence."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import beardyn_core as bd
from beardyn_core.cli.main import main
from beardyn_core.config import load_any_bearing, load_bearing
from beardyn_core.config.plates import load_plate
from test.bearings import CYLINDRICAL, SPHERICAL

OTHERS = (*CYLINDRICAL, *SPHERICAL)
SCENE = """
scene: mine
purpose: A bearing of another kind.
bearing: {bearing}
lubricant: L055
operation: {{kind: constant, force_kN: [0, 0, 60], speed_rpm: 600}}
"""


def refused(text: str, name: str) -> bool:
    """Whether one sentence says for which kinds of bearings something is, and what is possible."""
    words = load_any_bearing(name).words
    return all(part in text for part in (name, words, "roller bearings only", "beardyn bearing"))


def scene_file(folder: Path, name: str) -> Path:
    path = folder / "mine.yaml"
    path.write_text(SCENE.format(bearing=name), encoding="utf-8")
    return path


def test_each_kind_is_shipped_with_sources() -> None:
    assert (len(CYLINDRICAL), len(SPHERICAL)) == (3, 2)
    for name in OTHERS:
        bearing = bd.bearing(name)
        assert all(source for _, source in bearing.sources)
        assert not {"roller_count", "pitch_diameter", "width"} - dict(bearing.sources).keys()


@pytest.mark.parametrize("name", OTHERS)
def test_questions_without_a_run_are_answered(name: str) -> None:
    bearing = bd.bearing(name)
    loads = bd.load_distribution(name, (0, 5, 60))
    assert loads.shape == (2, bearing.roller_count)
    assert loads.max() < 60e3
    soft, stiff = bd.stiffness(name, 60, radial_clearance_mm=[0.2, 0.0])[:, 2, 2]
    assert stiff > soft > 1e8
    life = bd.life(name, (0, 5, 60), 600)
    assert life.modified > life.basic > 1e9
    assert 0.3 < life.reference_basic / life.basic < 5.0
    frequencies = bd.fault_frequencies(bearing)
    assert frequencies["BPFO"] + frequencies["BPFI"] == pytest.approx(bearing.roller_count, rel=1e-12)


@pytest.mark.parametrize("name", OTHERS)
def test_kinematics_are_those_of_pure_rolling(name: str) -> None:
    """Surface speeds of roller and rings are equal at both contacts."""
    bearing = load_any_bearing(name)
    assert isinstance(bearing, bd.CylindricalBearing | bd.SphericalBearing)
    cage, found = bearing.cage_ratio, bearing.frequencies
    spin = found.bsf  # against the cage, turns per turn of the shaft
    radius = 0.5 * bearing.roller_diameter
    assert cage == found.ftf
    assert spin * radius == pytest.approx(cage * bearing.cup_radius, rel=1e-12)
    assert spin * radius == pytest.approx((1.0 - cage) * bearing.cone_radius, rel=1e-12)


@pytest.mark.parametrize("name", OTHERS)
def test_the_monitor_takes_their_bearing_data(name: str, tmp_path: Path) -> None:
    own = tmp_path / "own.yaml"
    assert main(["new", name, "-o", str(own)]) == 0
    for plate in (load_plate(name), load_plate(str(own))):
        assert plate.frequencies == load_any_bearing(name).frequencies


@pytest.mark.parametrize("name", OTHERS)
def test_what_is_for_tapered_bearings_alone_is_refused(name: str) -> None:
    with pytest.raises(bd.InputError) as caught:
        load_bearing(name)
    assert refused(str(caught.value), name)


@pytest.mark.parametrize("name", SPHERICAL)
def test_torque_and_film_of_barrels_are_refused(name: str) -> None:
    for call in (lambda: bd.torque(name, 600), lambda: bd.film(name, 600)):
        with pytest.raises(bd.InputError) as caught:
            call()
        assert refused(str(caught.value), name)


def test_thrust_on_a_pair_costs_what_its_ribs_rub() -> None:
    """Friction of both ribs times the slip of pure rolling at their contact heights, and a little spin."""
    pair = bd.bearing("WJ130x240")
    assert isinstance(pair, bd.CylindricalBearing)
    plain = bd.torque(pair, 600, (0, 0, 80), rib_friction=0.05)
    pushed = bd.torque(pair, 600, (0, 5, 80), rib_friction=0.05)
    per_turn = pair.pitch_diameter / pair.roller_diameter * pair.rib_contact_height  # both slips, over w
    assert pushed - plain == pytest.approx(0.05 * 5000.0 * per_turn, rel=0.05)
    films = bd.film(pair, 600, (0, 0, 80))
    assert 1e-7 < float(films["cup"][films["cup"] > 0.0].min()) < 5e-6


@pytest.mark.parametrize("name", SPHERICAL)
def test_a_scene_takes_a_spherical_bearing_and_its_text_gives_it_back(name: str) -> None:
    from beardyn_core.choice import scene_from_text
    from beardyn_core.config import scene_text

    made = bd.scene(bearing=name, load_kN=60, speed_rpm=600, radial_clearance_mm=0.2)
    assert isinstance(made.bearing, bd.SphericalBearing)
    assert made.bearing.radial_clearance == pytest.approx(0.2e-3)
    assert made.numerics.laminae >= 10
    assert scene_from_text(scene_text(made)) == made


@pytest.mark.parametrize("name", CYLINDRICAL)
def test_a_scene_takes_a_cylindrical_pair_and_its_text_gives_it_back(name: str) -> None:
    from beardyn_core.choice import scene_from_text
    from beardyn_core.config import scene_text

    made = bd.scene(bearing=name, load_kN=60, speed_rpm=600, radial_clearance_mm=0.2)
    assert isinstance(made.bearing, bd.CylindricalBearing)
    assert made.bearing.radial_clearance == pytest.approx(0.2e-3)
    assert scene_from_text(scene_text(made)) == made


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"bearing": {"cone_ribs": "none"}}, "nothing holds the axle along its axis"),
        (
            {"rows": 1},
            "a single row with cone_ribs outer, cup_ribs both: it holds the axle",
        ),
        ({"end_play_mm": 0.1}, "roller_play"),
        ({"bearing": "HS130x230", "radial_clearance_mm": 0.1}, "its play is end_play_mm"),
    ],
)
def test_a_scene_in_which_nothing_holds_a_pair_is_refused(keys: dict[str, Any], said: str) -> None:
    changes = keys.pop("bearing", "WJ130x240")
    bearing = {**_keys("WJ130x240"), **changes} if isinstance(changes, dict) else changes
    with pytest.raises(bd.InputError, match=said):
        bd.scene(bearing=bearing, load_kN=60, speed_rpm=600, **keys)


def test_warm_parts_close_the_radial_clearance_of_a_pair() -> None:
    """Steel that is hotter than the outer ring by 10 K grows by 1.2e-4 of its diameters."""
    temperatures = {"cup_C": 20, "cone_C": 30, "rollers_C": 30, "assembly_C": 20}
    warm = bd.scene(bearing="WJ130x240", load_kN=60, speed_rpm=600, temperatures=temperatures).bearing
    cold = bd.bearing("WJ130x240")
    assert isinstance(warm, bd.CylindricalBearing)
    assert isinstance(cold, bd.CylindricalBearing)
    inside = 2.0 * cold.cone_radius + 2.0 * cold.roller_diameter
    assert cold.radial_clearance - warm.radial_clearance == pytest.approx(12e-6 * 10.0 * inside, rel=1e-9)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"kind": "needle"}, "kind is 'needle'"),
        ({"roller_count": 25}, "overlap"),
        ({"roller_length_mm": 90}, "run into each other"),
        ({"outer_diameter_mm": 210}, "outer_diameter"),
        ({"bore_mm": 160}, "half the bore"),
        ({"width_mm": 120}, "not less than the width"),
        ({"end_play_mm": 0.1}, "roller_play"),
        ({"rib_contact_height_mm": 6.0}, "corner of the rib"),
        ({"rib_contact_height_mm": 1.2}, "undercut"),
        ({"cup_ribs": "left"}, "cup_ribs"),
        ({"contact_angle_deg": 3.0}, "unknown key"),
        ({"radial_clearance_mm": 4.0}, "radial_clearance_mm"),
    ],
)
def test_a_cylindrical_bearing_that_cannot_be_is_refused(keys: dict[str, Any], said: str) -> None:
    with pytest.raises(bd.InputError, match=said):
        bd.bearing("WJ130x240", **keys)


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"cup_osculation": 1.0}, "cup_osculation"),
        ({"contact_angle_deg": 5.0}, "run into each other"),
        ({"row_spacing_mm": 50.0}, "unknown key"),
        ({"end_play_mm": 0.1}, "unknown key"),
    ],
)
def test_a_spherical_bearing_that_cannot_be_is_refused(keys: dict[str, Any], said: str) -> None:
    with pytest.raises(bd.InputError, match=said):
        bd.bearing("SRB120x260", **keys)


def test_a_tapered_file_may_say_its_kind(tmp_path: Path) -> None:
    assert bd.bearing("HS130x230", kind="tapered") == bd.bearing("HS130x230")
    assert bd.scene(bearing={**_keys("HS130x230"), "kind": "tapered"}).bearing.name == "HS130x230"


def _keys(name: str) -> dict[str, Any]:
    from beardyn_core.base.edge import write_noun

    return write_noun(bd.bearing(name))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("SRB120x260", "--end-play", "0.1"), "its play is radial_clearance"),
        (("HS130x230", "--radial-clearance", "0.1"), "its play is end_play"),
        (("SRB120x260", "--coupled-laminae"), "cannot be coupled"),
        (("SRB120x260", "--laminae", "3"), "at least 10"),
        (("WJ130x240", "--radial-clearance", "3"), "--radial-clearance is 3 mm"),
    ],
)
def test_options_that_a_kind_does_not_have_are_refused(
    words: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bearing", *words]) == 2
    assert said in capsys.readouterr().err


def test_the_page_of_a_pair_has_ribs_and_clearance(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bearing", "WJ130x240", "--load", "0", "10", "80", "--radial-clearance", "0.2"]) == 0
    shown = capsys.readouterr().out
    for part in (
        "cylindrical roller bearing",
        "radial clearance 0.2 mm",
        "C_0r 1564 kN",
        "ribs of the inner ring",
    ):
        assert part in shown
    assert "from its inner to its outer end" in shown


def test_thrust_that_tips_cylinders_is_doubted(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bearing", "WJ130x240", "--load", "0", "30", "60"]) == 0
    assert "more than 0.4 of the radial one" in capsys.readouterr().err
    assert main(["bearing", "SRB120x260", "--load", "0", "30", "60"]) == 0
    assert "radial one" not in capsys.readouterr().err

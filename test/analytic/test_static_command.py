"""`beardyn bearing`: the table and the JSON object."""

import json
import re

import numpy as np
import pytest

from beardyn_core.cli.main import main


@pytest.fixture
def bearing_command(capsys):
    """Run the command; exit status, standard output, standard error."""

    def run(*words):
        status = main(["bearing", *words])
        return status, *capsys.readouterr()

    return run


def test_json_is_one_object_with_the_promised_keys(bearing_command):
    status, out, _ = bearing_command(
        *(
            "HS130x230",
            "--json",
            "--load",
            "0",
            "10",
            "80",
            "--end-play",
            "0",
            "--tilt",
            "free",
            "--laminae",
            "4",
        )
    )
    found = json.loads(out)
    assert status == 0
    assert {"geometry", "fault_frequencies_per_rev", "static"} <= set(found)
    assert set(found["fault_frequencies_per_rev"]) == {"FTF", "BPFO", "BPFI", "BSF"}
    static = found["static"]
    assert static["applied_force_N"] == [0.0, 1e4, 8e4]
    loads = np.array(static["roller_load_N"])
    assert loads.shape == (2, found["geometry"]["roller_count"])
    assert static["largest_roller_load_N"] == loads.max()
    assert (
        static["loaded_roller_count"] == np.count_nonzero(loads) == sum(static["loaded_roller_count_per_row"])
    )
    for key in ("stiffness_tilt_held_N_per_m", "stiffness_tilt_free_N_per_m"):
        assert np.array(static[key]).shape == (3, 3)
    assert len(static["displacement_m"]) == 3
    assert len(static["tilt_rad"]) == 2


def test_largest_load_of_80_kN_between_rigid_rings_is_that_of_the_formula(bearing_command):
    """80 kN radial, zero end play, rigid rings, a roller on the load line: 9.83 kN within 0.5 %."""
    words = ("HS130x230", "--json", "--load", "0", "0", "80", "--end-play", "0")
    _, out, _ = bearing_command(*words, "--rings", "rigid")
    assert json.loads(out)["static"]["largest_roller_load_N"] == pytest.approx(9.83e3, rel=5e-3)
    _, out, _ = bearing_command(*words)
    static = json.loads(out)["static"]
    assert static["rings"] == "elastic"
    assert static["largest_roller_load_N"] < 0.95 * 9.83e3


def test_table_names_the_default_load_and_shows_every_roller(bearing_command):
    status, out, _ = bearing_command("HS130x230", "--speed", "1000")
    assert status == 0
    assert "(0, 0, 80) kN on the cone (default)" in out
    assert len(re.findall(r"^ +[\d.]+ deg ", out, re.MULTILINE)) == 17
    assert "121.563 Hz" in out
    assert max(map(len, out.splitlines())) <= 100
    assert "elastic rings: the cup bends in a housing with a wall of 25 mm" in out
    assert "heaviest rib 443" in out
    assert "warning" not in out
    _, out, _ = bearing_command("HS130x230", "--speed", "1000", "--rings", "rigid")
    assert "rigid rings: only the contacts yield" in out
    assert "heaviest rib 697" in out


def test_rib_ellipse_beyond_the_face_is_a_warning(bearing_command):
    status, out, _ = bearing_command("HS130x230", "--load", "0", "2000", "80", "--speed", "100")
    assert status == 0
    assert re.search(r"warning: under \d+ N the rib's contact ellipse reaches down to", out)
    assert max(map(len, out.splitlines())) <= 100


def test_bad_input_is_answered_with_sentences(bearing_command):
    status, out, err = bearing_command(
        "HS130x230", "--load", "0", "0", "nan", "--end-play", "6", "--laminae", "0"
    )
    assert (status, out) == (2, "")
    assert len(err.splitlines()) == 3
    status, out, err = bearing_command("HS130x231")
    assert (status, out) == (2, "")
    assert "HS130x231" in err
    assert "HS130x230" in err


def test_an_end_play_has_the_limits_of_a_bearing_file(bearing_command):
    for end_play in ("-0.501", "2001um", "-5"):
        status, out, err = bearing_command("HS130x230", "--end-play", end_play)
        assert (status, out) == (2, "")
        assert err.startswith("beardyn: --end-play is ")
        assert "mm; it must be from -0.5 to 2, as in a bearing file" in err
    assert bearing_command("HS130x230", "--end-play", "2")[0] == 0


def test_options_of_a_lubricant_without_one_are_refused(bearing_command):
    status, out, err = bearing_command("HS130x230", "--contamination", "0.1", "--temperature", "20")
    assert (status, out) == (2, "")
    assert "--contamination is given, but no --lubricant" in err
    assert "--temperature is given, but no --lubricant" in err


def test_negative_numbers_may_have_an_exponent(bearing_command):
    status, out, _ = bearing_command(
        "HS130x230", "--json", "--load", "0", "-1.5e1", "-80000N", "--end-play", "-1e-2"
    )
    static = json.loads(out)["static"]
    assert status == 0
    assert static["applied_force_N"] == [0.0, -1.5e4, -8e4]
    assert static["end_play_m"] == -1e-5


def test_life_comes_with_a_lubricant_and_a_speed(bearing_command):
    words = ("HS130x230", "--load", "0", "0", "80", "--lubricant", "L055", "--speed", "2000")
    status, out, _ = bearing_command(*words, "--json")
    life = json.loads(out)["life"]
    assert status == 0
    assert life["equivalent_load_N"] == pytest.approx(80e3)
    assert life["L10_rev"] == pytest.approx(1e6 * (977.4 / 80.0) ** (10 / 3), rel=0.02)
    assert life["L10mr_rev"] > life["L10r_rev"] > life["L10_rev"]
    status, out, _ = bearing_command(*words)
    assert "ISO 16281" in out
    assert json.loads(bearing_command("HS130x230", "--json")[1])["life"] is None


def test_absurd_life_options_are_refused_all_at_once(bearing_command):
    status, out, error = bearing_command(
        "HS130x230", "--lubricant", "L055", "--temperature", "900", "--contamination", "2"
    )
    assert (status, out) == (2, "")
    assert "--temperature is 900" in error
    assert "--contamination is 2" in error
    assert "--speed is 0" in error


@pytest.mark.parametrize(
    ("words", "load", "end_play", "speed"),
    [
        (("--load", "0", "0", "5"), 5e3, 2e-4, 0.0),
        (("--load", "0", "0", "5000N", "--end-play", "0.1"), 5e3, 1e-4, 0.0),
        (("--load", "0", "0", "0.005MN", "--end-play", "100um", "--speed", "1200"), 5e3, 1e-4, 40 * np.pi),
        (("--load", "0", "0", "5kN", "--end-play", "1e-4 m", "--speed", "20Hz"), 5e3, 1e-4, 40 * np.pi),
    ],
)
def test_options_are_in_the_units_of_scenes_or_in_the_one_written(
    bearing_command, words, load, end_play, speed
):
    status, out, _ = bearing_command("HS130x230", "--json", *words)
    static = json.loads(out)["static"]
    assert status == 0
    assert static["applied_force_N"] == [0.0, 0.0, load]
    assert static["end_play_m"] == pytest.approx(end_play, rel=1e-15)
    assert static["shaft_speed_rad_per_s"] == pytest.approx(speed, rel=1e-15)


def test_newtons_and_metres_of_old_are_asked_about_and_not_taken_for_kilonewtons(bearing_command):
    status, out, error = bearing_command("HS130x230", "--load", "0", "0", "8e4", "--end-play", "-1e-5")
    assert (status, out) == (2, "")
    assert "--load is 80000 kN" in error
    assert "were newtons meant? Then write 80, or 8e4N" in error
    assert "were metres meant? Then write -0.01, or -1e-5m" in error
    assert bearing_command("HS130x230", "--load", "0", "0", "8e4N")[0] == 0


def test_a_foreign_unit_is_refused_with_those_that_are_known(bearing_command):
    status, _, error = bearing_command("HS130x230", "--load", "0", "0", "80lbf", "--speed", "fast")
    assert status == 2
    assert "--load is '80lbf'; allowed is a number in kN, or one with its unit: kN, N, MN" in error
    assert "--speed is 'fast'; allowed is a number in rpm" in error

"""Bearing data on the command line: the catalogue listed and copied, factors, which bearing fits."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import beardyn_core as bd
from beardyn_core.cli.main import BAD_INPUT, DONE, main
from beardyn_core.config import load_plate
from beardyn_core.study.monitored_recording import EXIT_CODES
from test.measured.test_monitor_files import motor

FACTORS = ["--bpfo", "3.585", "--bpfi", "5.415"]


def test_bearings_are_listed_by_dimensions(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["scenes", "catalogue", "--bore-mm", "25", "--outside-mm", "52"]
    assert main(words) == DONE
    text = capsys.readouterr().out
    assert "  6205           25 x 52 x 15 mm              BPFO  3.585" in text
    assert "11 of the catalogue" in text
    assert main([*words, "--bearing-kind", "spherical", "--json"]) == DONE
    found = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)["catalogue"]
    assert {each["name"] for each in found} == {"22205", "22205E1K"}
    assert all(each["source"] and each["place"] and each["bore_m"] == 0.025 for each in found)
    assert main(["scenes", "plates", "--json"]) == DONE  # the name of before
    assert len(json.loads(capsys.readouterr().out)["catalogue"]) == len(bd.catalogue())


def test_mistakes_of_a_list_are_said_as_options_are_written(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--bore-mm", "-1", "--bearing-kind", "magnetic", "--maker", "nobody"]
    assert main(["scenes", "catalogue", *words]) == BAD_INPUT
    told = capsys.readouterr().err
    for part in ("--bore-mm is -1", "--bearing-kind is 'magnetic'", "--maker is 'nobody'"):
        assert part in told
    assert main(["scenes", "sensors", "--bore-mm", "25"]) == BAD_INPUT
    assert "--bore-mm: of `beardyn scenes catalogue`" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["6205", "6206-2Z", "ER-16K", "HM133444", "352213"])
def test_a_bearing_of_the_catalogue_is_copied_with_its_source(name: str, tmp_path: Path) -> None:
    target = tmp_path / "mine.yaml"
    assert main(["new", name, "-o", str(target)]) == DONE
    copy, original = load_plate(str(target)), load_plate(name)
    assert copy.name == "mine"
    assert copy.frequencies == original.frequencies
    assert dict(copy.sources)
    assert "# Source: " in target.read_text()
    assert main(["new", name, "-o", str(target)]) == BAD_INPUT  # nothing existing is overwritten


def test_factors_give_the_verdict_of_the_dimensions_and_what_they_cannot_tell(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["monitor", str(motor(tmp_path)), "--speed-rpm", "1797"]
    assert main([*words, *FACTORS, "--json"]) == EXIT_CODES["cup"]
    found = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert found["verdict"] == "cup"
    assert set(found["bearings"][0]["cannot_tell"]) == {"roller"}
    assert found["not_judged"] == found["bearings"][0]["not_judged"] == ["roller"]
    assert {tuple(each["not_judged"]) for each in found["findings"]} == {("roller",)}
    assert main([*words, *FACTORS]) == EXIT_CODES["cup"]
    assert "not judged, rolling elements: bsf: the contact angle is not known" in capsys.readouterr().out
    assert main([*words, *FACTORS, "--bsf", "4.714", "--ftf", "0.6"]) == BAD_INPUT
    told = capsys.readouterr().err
    assert "--ftf is 0.6" in told
    assert "some makers list twice the spin, give 2.357" in told
    assert main([*words, "--bearing", "6205", *FACTORS]) == BAD_INPUT
    assert "give one of both" in capsys.readouterr().err


def test_a_frequency_in_hertz_is_answered_with_the_factor_at_the_stated_speed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(motor(tmp_path))
    hertz = ["--bpfo", "107.4", "--bpfi", "162.2"]
    assert main(["monitor", path, "--speed-rpm", "1797", *hertz]) == BAD_INPUT
    told = capsys.readouterr().err
    assert "--bpfo is 107.4; it must be at most 40; a factor is per turn of the shaft" in told
    assert "107.4 Hz at 1797 rpm is 3.586" in told
    assert "162.2 Hz at 1797 rpm is 5.416" in told
    speed = ["--speed-kmh", "100", "--wheel-diameter-mm", "920"]  # 9.611 turns a second
    assert main(["monitor", path, *speed, "--bpfo", "60"]) == BAD_INPUT
    assert "60 Hz at 576.65 rpm is 6.243" in capsys.readouterr().err
    assert main(["monitor", path, "--bpfo", "60"]) == BAD_INPUT
    assert "rpm is" not in capsys.readouterr().err


def test_mistakes_of_bearing_data_and_of_other_options_are_reported_at_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [
        "--bpfo",
        "4",
        "--warm",
        "500",
        "--monitor",
        "no_module:x",
        "--picture",
        "a.txt",
        "--box",
        "left",
    ]
    assert main(["monitor", str(motor(tmp_path)), *words, "--bore-mm", "3", "--memory", "m"]) == BAD_INPUT
    told = capsys.readouterr().err
    for part in (
        "--bpfo is 4; its last digit",
        "--warm is 500",
        "no_module",
        "--picture a.txt",
        "--box: is for recordings",
        "--bore-mm: of --which-bearing",
        "--memory is that of --trend",
        "the speed of the shaft is not known",
    ):
        assert part in told


def test_the_line_of_the_catalogue_that_was_taken_is_named_with_its_source(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["monitor", str(motor(tmp_path)), "--speed-rpm", "1797", "--bearing"]
    assert main([*words, "skf 6205-2rs"]) == EXIT_CODES["cup"]
    first = capsys.readouterr().out.splitlines()[0]
    assert first.startswith(
        "6205 of the catalogue: SKF, deep groove ball, 25 x 52 x 15 mm; source: Case Western"
    )
    assert main([*words, "6205", "--json"]) == EXIT_CODES["cup"]
    taken = json.loads(capsys.readouterr().out)["bearings"][0]["catalogue"]
    assert (taken["name"], taken["maker"]) == ("6205", "SKF")
    assert taken["source"].startswith("Case Western")
    main([*words, "HS130x230", "--json"])
    assert json.loads(capsys.readouterr().out)["bearings"][0]["catalogue"] is None


def test_an_import_points_to_the_monitor_that_compares_bearings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = str(motor(tmp_path)), tmp_path / "run.mcap"
    assert main(["import", path, "-o", str(out), "--which-bearing"]) == BAD_INPUT
    assert f"`beardyn monitor {path} --which-bearing`" in capsys.readouterr().err
    assert not out.exists()


def test_an_imported_recording_keeps_factors(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "run.mcap"
    assert main(["import", str(motor(tmp_path)), "-o", str(out), "--speed-rpm", "1797", *FACTORS]) == DONE
    assert main(["report", str(out)]) == DONE
    assert "bearing data: 9 rolling elements, BPFO 3.585, BPFI 5.415" in capsys.readouterr().out
    assert main(["monitor", str(out)]) == EXIT_CODES["cup"]
    assert "give roller_count, roller_diameter_mm and pitch_diameter_mm" in capsys.readouterr().out
    assert main(["monitor", str(out), "--which-bearing", "--bore-mm", "25", "--outside-mm", "52"]) == DONE
    assert "6205" in capsys.readouterr().out
    assert "6205" in [each.name for each in bd.which_bearing(out, bore_mm=25).fits]


def test_which_bearing_ranks_those_of_the_catalogue(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["monitor", str(motor(tmp_path)), "--speed-rpm", "1797", "--which-bearing"]
    assert main([*words, "--json"]) == DONE
    found = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)["which_bearing"]
    assert found["answer"] == "several fit equally"
    assert "6205" in [each["bearing"] for each in found["fits"]]
    assert found["searched"] == len(bd.catalogue())
    assert main([*words, "--bore-mm", "130"]) == DONE
    assert capsys.readouterr().out.startswith("none fits: a comb of order 3.59")
    words[3] = "1700"
    assert main([*words, "--bore-mm", "25", "--outside-mm", "52"]) == DONE
    assert "a wrong speed moves all orders alike: it would be the outer ring (cup) of 6205 at 1800" in (
        capsys.readouterr().out
    )


def test_which_bearing_refuses_what_it_would_leave_aside(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(motor(tmp_path))
    words = ["monitor", path, "--speed-rpm", "1797"]
    assert main([*words, "--which-bearing", "--bearing", "6205", "--bore-mm", "-3"]) == BAD_INPUT
    told = capsys.readouterr().err
    assert "--bearing: --which-bearing compares those of the catalogue" in told
    assert "--bore-mm is -3" in told
    idle = [
        "--warm",
        "90",
        "--hot",
        "120",
        "--neighbour",
        "6203",
        "--force",
        "--memory",
        "m",
        "--box",
        "left",
    ]
    assert main([*words, "--which-bearing", *idle]) == BAD_INPUT
    told = capsys.readouterr().err
    for option in ("--warm", "--hot", "--neighbour", "--force", "--memory", "--box"):
        assert f"beardyn: {option}: " in told
    assert main([*words, "--bore-mm", "25"]) == BAD_INPUT
    assert "--bore-mm: of --which-bearing" in capsys.readouterr().err
    assert main([*words, "--which-bearing", "--bore-mm", "25", "--outside-mm", "53"]) == BAD_INPUT
    assert "no bearing of the catalogue has these dimensions" in capsys.readouterr().err
    assert main(["monitor", path, "--which-bearing"]) == BAD_INPUT
    assert "give one of --speed-rpm" in capsys.readouterr().err

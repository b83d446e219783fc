"""Files through the whole command: added once, ranked, and shown on a page with the evidence."""

from __future__ import annotations

import json
import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.cli.main import main
from beardyn_core.fleet.identity import Axlebox
from beardyn_core.fleet.store import open_store
from test.cli.json_page import check
from test.fleet.made_history import recording, wide, write_files, write_manifest

FAULTY = Axlebox("V1", "2", "left")


def fleet(capsys: pytest.CaptureFixture[str], *words: object) -> tuple[int, str, str]:
    code = main(["fleet", *map(str, words)])
    told = capsys.readouterr()
    return code, told.out, told.err


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recordings")
    lines = write_files(folder, 3, FAULTY)
    dead = np.load(folder / lines[-1]["file"])["tacho"]
    np.savez(folder / lines[-1]["file"], z=np.zeros(len(dead)), tacho=dead)  # axle 2 right on the last day
    return folder


def test_recordings_are_added_once_ranked_and_shown(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store = tmp_path / "fleet.sqlite"
    words = ("add", folder, "--store", store, "--workers", 1, "--estimator", "none", "--json")
    code, out, _ = fleet(capsys, *words)
    assert (code, json.loads(out)["added"]) == (0, 12)
    check("fleet add", json.loads(out))
    code, out, _ = fleet(capsys, *words)
    assert (json.loads(out)["added"], json.loads(out)["known"]) == (0, 12)

    code, out, _ = fleet(capsys, "status", "--store", store, "--json")
    listed = json.loads(out)["axleboxes"]
    assert code == 12
    assert fleet(capsys, "acknowledge", "V1", 2, "left", "--store", store, "--by", "workshop")[0] == 0
    acknowledged = fleet(capsys, "status", "--store", store, "--json")[1]
    growing = fleet(capsys, "status", "--store", grown(tmp_path), "--json")[1]
    check("fleet status", *map(json.loads, (out, acknowledged, growing)))
    first = listed[0]
    assert (first["axle"], first["side"], first["health"], first["part"]) == ("2", "left", "plan", "cup")
    assert first["since_mileage_m"] == 1.0e6
    assert (listed[1]["side"], listed[1]["health"]) == ("right", "cannot_tell")
    assert listed[1]["last_verdict"] == "not_diagnosable"
    assert {each["health"] for each in listed[2:]} == {"ok"}

    code, out, _ = fleet(capsys, "status", "--store", store)
    assert "V1 axle 2 left" in out
    assert "2 axleboxes are ok" in out
    assert "outer ring (cup): named by 3 of the last 3" in out

    page = tmp_path / "fleet.html"
    code, out, _ = fleet(capsys, "report", "--store", store, "--html", page)
    text = page.read_text(encoding="utf-8")
    assert code == 0
    headings = ("What was assumed", "What to do next", "Spectrum of the envelope")
    assert "2 axleboxes that are ok, by vehicle" in text
    for part in (
        "V1 axle 2 left",
        "V1: axle 1 left, axle 1 right",
        "PLAN",
        "CANNOT TELL",
        "BPFO",
        "<svg",
        *headings,
    ):
        assert part in text
    assert not re.search(r"(src|href)=\"(?!#)", text)  # nothing is loaded
    links = re.findall(r'href="#(p\d+)"', text)
    assert links
    assert all(f'id="{each}"' in text for each in links)
    short = tmp_path / "short.html"
    assert fleet(capsys, "report", "--store", store, "--html", short, "--pages", 0)[0] == 0
    text = short.read_text(encoding="utf-8")
    assert "the first 0 of 1 with an alarm" in text
    assert "V1 axle 2 left" in text
    assert "<svg" not in text
    code, _, err = fleet(capsys, "report", "--store", store, "--html", short, "--pages", -1, "--force")
    assert (code, "--pages is -1" in err) == (2, True)
    code, _, err = fleet(capsys, "report", "--store", store, "--html", page)
    assert code == 2
    assert "the file exists" in err


def grown(folder: Path) -> Path:
    """Make a store of one axlebox whose spall grows."""
    store = folder / "grown.sqlite"
    with open_store(store, write=True, make=True) as opened:
        for day, width in enumerate((6.0e-3, 6.4e-3, 7.0e-3, 7.5e-3, 8.0e-3)):
            opened.add(recording(day), wide("cup", width))
    return store


def test_mileage_left_by_several_laws_in_text_json_and_page(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store, page = grown(tmp_path), tmp_path / "fleet.html"
    out = fleet(capsys, "status", "--store", store)[1]
    (several,) = [line for line in out.splitlines() if "by several laws" in line]
    assert "assumed: slow, then linear" in several
    (box,) = json.loads(fleet(capsys, "status", "--store", store, "--json")[1])["axleboxes"]
    laws = {each["law"]: each for each in box["growth_laws"]}
    agreeing = [each["mileage_left_m"] for each in laws.values() if each["agrees"]]
    low, high = box["mileage_left_span_m"]
    assert (low, high) == (min(each[0] for each in agreeing), max(each[2] for each in agreeing))
    assert laws["slow, then linear"]["mileage_left_m"] == box["mileage_left_m"]
    assert f"{low / 1e3:,.0f} to {high / 1e3:,.0f} km" in several
    first = datetime.fromtimestamp(box["mileage_left_span_dates_s"][0], UTC)
    assert f"before {first:%Y-%m-%d}" in box["do"]
    assert fleet(capsys, "report", "--store", store, "--html", page)[0] == 0
    text = page.read_text(encoding="utf-8")
    for each in laws:
        assert each in text
    assert "slow, then linear, assumed" in text
    faster = fleet(capsys, "status", "--store", store, "--json", "--growth-mm2", "400")[1]
    assert json.loads(faster)["axleboxes"][0]["mileage_left_m"][1] < box["mileage_left_m"][1]
    code, _, err = fleet(capsys, "status", "--store", store, "--growth-mm2", "0")
    assert (code, "--growth-mm2: is 0; it must be above 0" in err) == (2, True)


def test_mistakes_are_told_at_once_and_nothing_is_added(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = write_files(tmp_path / "own", 1)
    lines[1]["bearing"] = "no_such_bearing"
    lines[2]["time"] = "2099-01-01"
    write_manifest(tmp_path / "own", lines)
    store = tmp_path / "fleet.sqlite"
    code, _, err = fleet(capsys, "add", tmp_path / "own", "--store", store)
    assert code == 2
    assert "no_such_bearing" in err
    assert "in the future" in err
    code, _, err = fleet(capsys, "status", "--store", store)
    assert code == 2
    assert "has no recording" in err


@pytest.mark.slow  # two processes begin
def test_a_file_that_cannot_be_read_is_refused_and_the_others_are_added(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lines = write_files(tmp_path / "own", 1)
    (tmp_path / "own" / lines[0]["file"]).write_bytes(b"PK\x03\x04 cut off")
    words = ("--workers", 2, "--estimator", "none", "--json")
    code, out, err = fleet(capsys, "add", tmp_path / "own", "--store", tmp_path / "s.sqlite", *words)
    assert code == 3
    assert json.loads(out)["added"] == 3
    assert "not added" in err
    assert lines[0]["file"] in err


def test_one_file_is_added_by_options_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line = write_files(tmp_path / "own", 1, FAULTY)[2]
    (tmp_path / "own" / "manifest.csv").unlink()
    store = tmp_path / "fleet.sqlite"
    words = ["--vehicle", "V1", "--axle", 2, "--side", "left", "--bearing", line["bearing"], "--unit", "m/s2"]
    words += ["--rate-hz", line["rate_Hz"], "--channel", "z=z", "--tacho-channel", "tacho"]
    words = ["add", tmp_path / "own" / line["file"], "--store", store, *words, "--estimator", "none"]
    code, _, err = fleet(capsys, *words)
    assert code == 2
    assert "time is missing" in err
    assert "nothing names" not in err
    code, out, err = fleet(capsys, *words, "--time", "2026-03-01T10:00:00", "--workers", 1)
    assert (code, "1 recordings added" in out) == (0, True), err
    (box,) = json.loads(fleet(capsys, "status", "--store", store, "--json")[1])["axleboxes"]
    assert (box["axle"], box["last_verdict"]) == ("2", "cup")
    assert datetime.fromtimestamp(box["last_recording_s"], UTC) == datetime(2026, 3, 1, 10, tzinfo=UTC)

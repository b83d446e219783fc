"""The page about an axlebox: what stands on it, in which order; nothing is cut off, nothing is loaded."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.measured.about import Mounted
from beardyn_core.monitor.chain import VERDICTS, MonitorResult, MonitorSettings
from beardyn_core.monitor.severity import NOT_MEASURABLE, SEVERE, Severity
from beardyn_core.study.inspection import FROM_SCENE, FROM_USER, BearingResults, Inspection, inspect_run
from beardyn_core.study.report_page import page_fonts, page_pdf
from beardyn_core.study.report_page.advice import ADVICE, actions_for, headline_of
from beardyn_core.study.report_page.assumptions import assumed_inputs, assumed_rows
from beardyn_core.study.report_page.file_levels import FileLevel, level_rows
from beardyn_core.study.report_page.page import Facts, Headline, Page, PageReport, Points, Rows
from beardyn_core.study.report_page.page_content import Names, page_report
from beardyn_core.study.report_page.page_html import html_of
from test.fault_signals import fault_signal
from test.recordings import import_signal

RPM = 60.0 * 19.2


@pytest.fixture(scope="module")
def faulty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("faulty") / "cup.mcap"
    return import_signal(path, fault_signal("cup", 1)[2], speed_rpm=RPM)


@pytest.fixture(scope="module")
def inspection(faulty: Path) -> Inspection:
    (found,) = inspect_run(bd.read(faulty))
    return found


def judged(inspection: Inspection, verdict: str, **numbers: Any) -> Inspection:
    """The same signals with another verdict."""
    results = BearingResults()
    if verdict != "waiting":
        results.add(MonitorResult(verdict, f"because of <{verdict}>", 10**9, **numbers))
    found = Inspection(inspection.mounted, FROM_USER, inspection.settings, results, lambda: inspection.run)
    found.__dict__["severity"] = None
    return found


def text_of(html: str) -> str:
    """What a reader sees, without pictures."""
    html = re.sub(r"<(style|svg)\b.*?</\1>", " ", html, flags=re.DOTALL)
    words: list[str] = []
    parser = HTMLParser()
    parser.handle_data = words.append  # type: ignore[assignment]
    parser.feed(html)
    return re.sub(r"\s+", " ", "".join(words))


def page_of(inspection: Inspection, **names: str) -> str:
    return html_of(page_report([[inspection]], Names(**names), "made by a test"))


# --- what stands on the page ---------------------------------------------------------------------------


def test_the_page_has_its_parts_in_the_order_in_which_a_reader_asks(inspection: Inspection) -> None:
    html = page_of(inspection, train="train 7", axlebox="axle 2 left")
    text = text_of(html)
    wanted = [
        "train 7", "axle 2 left", "FAULT", "outer ring (cup)",
        "Confidence: the verdict is right with a probability of ", "analyses agree", "Record",
        "Kind of record: measured", "Axlebox: axle 2 left", "Bearing: HS130x230", "BPFO 7.294",
        "Files: cup.mcap", "Date of the record: not stated", "Shaft speed: 1152.0 rpm", "uncertain by 3 %",
        "Sampling: 25600 Hz, axes x, y, z, in m/s²", "Spectrum of the envelope", "Waveform",
        "What was assumed", "warm from 90 °C, hot from 120 °C", "Not judged: the cage", "What to do next",
        "Confirm it", "made by a test",
    ]  # fmt: skip
    places = [text.find(each) for each in wanted]
    assert -1 not in places, [each for each, place in zip(wanted, places, strict=True) if place < 0]
    assert places == sorted(places)
    labels = set(re.findall(r">([^<>]*(?:BPFO|BPFI|BSF|FTF|shaft))</text>", html))
    assert {"BPFO", "2×BPFO", "5×BPFO", "BPFI", "2 BSF", "FTF", "shaft", "3×shaft"} <= labels
    assert "from strike to strike" in html


def test_every_verdict_has_a_headline_a_word_for_prints_without_colour_and_an_advice(
    inspection: Inspection,
) -> None:
    assert set(ADVICE) == set(VERDICTS)
    words = {}
    for verdict in VERDICTS:
        text = text_of(page_of(judged(inspection, verdict)))
        headline = headline_of(judged(inspection, verdict))
        assert headline.word in text
        assert headline.sentence in text
        for action in ADVICE[verdict].actions:
            assert action in text
        words[verdict] = headline.word
    assert "outer ring (cup)" in ADVICE["cup"].sentence
    assert "inner ring (cone)" in ADVICE["cone"].sentence
    assert words["healthy"] == "NO FAULT FOUND"
    assert words["waiting"] == words["not_diagnosable"] == "CANNOT TELL"
    assert (
        len({words["healthy"], words["cup"], words["unexplained"], words["hot_box"], words["waiting"]}) == 5
    )


def test_no_verdict_is_a_promise() -> None:
    for each in ADVICE.values():
        text = " ".join((each.sentence, *each.actions)).lower()
        assert not re.search(r"\b(safe|certainly|surely|guarantee\w*|definitely|must be replaced)\b", text)
    assert "no proof" in " ".join(ADVICE["healthy"].actions)
    for verdict in ("unexplained", "not_diagnosable", "waiting"):
        assert ADVICE[verdict].actions[0].startswith("Do not read this page as healthy")


def test_size_and_heat_come_into_headline_and_advice(inspection: Inspection) -> None:
    hot = judged(inspection, "cup", temperature=400.0, temperature_state="hot")
    assert "HOT" in headline_of(hot).word
    assert actions_for(hot)[0] == ADVICE["hot_box"].actions[0]
    warm = judged(inspection, "healthy", temperature=365.0, temperature_state="warm")
    assert any("is warm" in each for each in actions_for(warm))
    assert "Temperature of the axlebox: 92 °C, warm." in headline_of(warm).details
    wide = judged(inspection, "cup")
    wide.__dict__["severity"] = Severity(SEVERE, 0.025, 0.023, 0.027, "severe")
    assert headline_of(wide).word == "FAULT, SEVERE"
    assert "95 % interval 23.0 to 27.0 mm" in " ".join(headline_of(wide).details)
    assert actions_for(wide)[0].startswith("Inform the person who is responsible")
    why = judged(inspection, "cup")
    why.__dict__["severity"] = Severity(
        NOT_MEASURABLE, np.nan, np.nan, np.nan, f"{NOT_MEASURABLE}: a noisy sensor"
    )
    assert "Size: not measurable; a noisy sensor." in headline_of(why).details


def test_a_verdict_that_fits_two_parts_names_both(inspection: Inspection) -> None:
    found = judged(inspection, "cup", also_fits=("cone",), not_judged=("roller",))
    assert "The lines fit inner ring (cone) as well" in headline_of(found).sentence
    assert "rolling elements, whose lines are multiples" in dict(assumed_rows(found))["Not judged"]


def test_analyses_that_disagree_are_counted(inspection: Inspection) -> None:
    results = BearingResults()
    for verdict in ("waiting", "cup", "healthy", "cup", "not_diagnosable", "cup"):
        results.add(MonitorResult(verdict, "so", 10**9, score=9.0, threshold=6.0))
    found = replace(judged(inspection, "cup"), results=results)
    found.__dict__["severity"] = None
    confidence = headline_of(found).details[0]
    assert "3 of 5 analyses agree; the others: no fault found 1, cannot tell 1" in confidence
    assert "passes the alarm by 3.0 dB" in confidence
    assert any("One analysis only" in each for each in actions_for(judged(inspection, "healthy")))


def test_a_fault_in_an_earlier_file_or_in_a_part_of_the_record_is_not_forgotten(
    inspection: Inspection,
) -> None:
    healthy = judged(inspection, "healthy")
    assert headline_of(healthy, ["healthy", "not_diagnosable"]) == headline_of(healthy)
    assert actions_for(healthy, ["healthy", "not_diagnosable"]) == actions_for(healthy)
    assert "outer ring (cup) in 1 of 2 files" in actions_for(healthy, ["cup", "healthy"])[0]
    (page,) = page_report([[judged(inspection, "cup")], [healthy]], Names(), "").pages
    assert page.headline.word == "NO FAULT FOUND, CHECK"
    assert page.headline.colour != ADVICE["healthy"].colour
    for count, is_told in ((1, False), (2, True)):
        results = BearingResults()
        for verdict in ["healthy"] * 4 + ["cone"] * count:
            results.add(MonitorResult(verdict, "so", 10**9))
        found = replace(healthy, results=results)
        found.__dict__["severity"] = None
        assert ("CHECK" in headline_of(found).word) == is_told
        assert ("No action follows" in " ".join(actions_for(found))) == (not is_told)
    assert "inner ring (cone) in 2 of 6 analyses" in headline_of(found).sentence
    assert "The latest file: roller." in headline_of(found, ["healthy", "roller"]).sentence
    assert "CHECK" not in headline_of(inspection, ["healthy", "cone"]).word


def test_every_assumed_input_of_a_scene_is_there_by_its_name(inspection: Inspection) -> None:
    scene = bd.scene("cup_spall")
    found = dict(assumed_inputs(scene))
    weak = {key for key, source in scene.bearing.sources if source.startswith("assumed")}
    assert weak
    assert {re.sub("[_.]", " ", key) for key in weak} <= set(found["Bearing"])
    simulated = replace(inspection, bearing_from=FROM_SCENE)
    rows = dict(assumed_rows(simulated, scene))
    assert rows["Bearing"].count("Zhao et al. 2026") == 1
    assert "rib height" in rows["Bearing: assumed or derived, not published"]
    plate = bd.name_plate("6205")
    rows = dict(assumed_rows(replace(inspection, mounted=Mounted("bearing", plate))))
    assert rows["Speed"] == "from a constant speed that was stated; searched over ±3 %"
    exact = replace(inspection, settings=MonitorSettings())
    assert "taken as exact" in dict(assumed_rows(exact))["Speed"]


# --- one file, safe whatever is in it ------------------------------------------------------------------


def test_names_of_files_are_text_and_no_program(inspection: Inspection) -> None:
    evil = "<script>alert(1)</script>\"'&轴箱"
    mounted = replace(inspection.mounted, plate=replace(inspection.mounted.plate, description=evil))
    html = page_of(replace(inspection, mounted=mounted), train=evil, axlebox=evil)
    assert "<script" not in html
    assert text_of(html).count(evil) >= 4  # two in the title, rows of train, axlebox and bearing


def test_the_page_loads_nothing_and_names_no_mark_twice(inspection: Inspection) -> None:
    html = page_of(inspection)
    assert not re.search(r"https?:|//\w|@import|<link|<script|<iframe|<img|\bon\w+=", html)
    assert all(each.startswith("#") for each in re.findall(r'(?:href|src)="([^"]*)"', html))
    marks = re.findall(r'\bid="([^"]*)"', html)
    assert len(marks) == len(set(marks))
    used = {*re.findall(r'href="#([^"]*)"', html), *re.findall(r"url\(#([^)]*)\)", html)}
    assert used <= set(marks)
    assert "size: A4" in html


@pytest.mark.parametrize("wrong", [None, 3, "x", ["x", 3], {"a": 1}])
def test_what_a_file_says_of_itself_may_be_damaged(inspection: Inspection, wrong: Any) -> None:
    run = bd.read(inspection.run.path or "")
    whole = run.measured
    for key in ("files", "speed", "sensors", "understood", "warnings"):
        run.measured = {**whole, key: wrong}
        found = replace(judged(inspection, "healthy"), read=lambda: run)
        found.__dict__["severity"] = None
        assert "NO FAULT FOUND" in text_of(page_of(found))


# --- files over time -----------------------------------------------------------------------------------


def test_a_row_for_each_file_and_of_many_one_for_neighbours_with_the_same_verdict() -> None:
    def level(number: int) -> FileLevel:
        verdict = "cup" if number >= 60 else "healthy"
        return FileLevel(f"{number:02}.csv", "", 1.0 + number / 100.0, 5.0, verdict, 2, 3)

    assert len(level_rows([level(n) for n in range(10)])) == 10
    rows = level_rows([level(n) for n in range(80)])
    assert [row[0] for row in rows] == ["1 to 60", "61 to 80"]
    assert rows[1][1:4] == ("60.csv to 79.csv", "not stated", "1.6 to 1.79")
    assert rows[1][5] == "outer ring (cup), 40 of 60"


def test_records_of_one_axlebox_are_one_page_with_their_levels(inspection: Inspection) -> None:
    report = page_report([[judged(inspection, "healthy")], [inspection]], Names(), "")
    (page,) = report.pages
    assert page.headline.word.startswith("FAULT")
    table = next(part for part in page.parts if isinstance(part, Rows))
    assert [row[5].partition(",")[0] for row in table.rows] == ["no fault found", "outer ring (cup)"]
    assert any(part.heading.startswith("Levels over 2 files, the last +0.0 dB") for part in page.parts)
    assert "Levels" not in page_report([[inspection]], Names(), "").text


def test_several_bearings_have_an_overview_with_the_worst_first(inspection: Inspection) -> None:
    verdicts = {"left": "healthy", "right": "cup", "next": "unexplained"}
    every = [
        replace(judged(inspection, verdict), mounted=replace(inspection.mounted, label=label))
        for label, verdict in verdicts.items()
    ]
    for each in every:
        each.__dict__["severity"] = None
    overview, *pages = page_report([every], Names(train="train 7"), "").pages
    table = next(part for part in overview.parts if isinstance(part, Rows))
    assert [row[1] for row in table.rows] == ["right", "next", "left"]
    assert "Worst of 3: right." in overview.headline.sentence
    assert [page.title.rpartition(", ")[2] for page in pages] == ["right", "next", "left"]


# --- paper ---------------------------------------------------------------------------------------------


def sheets_of(page: Page, fonts: page_fonts.Fonts | None = None) -> list[Figure]:
    return list(page_pdf._Sheets(fonts or page_fonts.fonts_for("a"), page, "foot", ()).filled())


def lines_of(sheets: list[Figure]) -> str:
    return " ".join(" ".join(text.get_text() for text in sheet.texts) for sheet in sheets)


def boxes_of(sheet: Figure) -> list[Bbox]:
    """Where the texts of a sheet are, [mm]; finely drawn, for on paper there is no grid of pixels."""
    sheet.set_dpi(25.4 * 30)
    renderer = FigureCanvasAgg(sheet).get_renderer()
    found = (text.get_window_extent(renderer) for text in sheet.texts if text.get_text().strip())
    return [Bbox(each.get_points() / 30.0) for each in found]


LONG = Facts(
    "Assumed",
    tuple((f"input {n}", f"value{n} " * 12 + "x" * (150 if n % 40 == 0 else 3)) for n in range(160)),
)


@pytest.mark.slow
@pytest.mark.parametrize(
    "part",
    [
        LONG,
        Points("Next", tuple(f"point{n} " + "word " * 40 for n in range(60))),
        Rows(
            "Files", ("no.", "file"), (0.2, 0.8), tuple((f"{n}", f"file{n} " + "y" * 200) for n in range(90))
        ),
        Facts("One", (("all", " ".join(f"word{n}" for n in range(3000))),)),
    ],
    ids=["facts", "points", "rows", "one that is longer than a sheet"],
)
def test_what_is_too_long_for_a_sheet_goes_on_on_the_next_and_nothing_is_cut_off(
    part: Facts | Points | Rows,
) -> None:
    page = Page("Title", Headline("WORD", "A sentence.", "#000000"), (part,))
    sheets = sheets_of(page)
    assert len(sheets) > 1
    written = lines_of(sheets)
    wanted = {
        *re.findall(r"(?:value|point|file|word)\d+", PageReport("", (page,), "").text),
    }
    assert wanted <= set(re.findall(r"(?:value|point|file|word)\d+", written))
    assert "Title, continued" in written
    for sheet in sheets:
        width, height = 210.0, 297.0
        for box in boxes_of(sheet):
            assert box.x0 >= 11.5
            assert box.x1 <= width - 11.5
            assert box.y0 >= 4.0
            assert box.y1 <= height - 5.0


def test_texts_of_a_sheet_do_not_lie_on_each_other(inspection: Inspection) -> None:
    (page,) = page_report([[inspection]], Names(), "foot").pages
    (sheet,) = sheets_of(page, page_fonts.fonts_for("x"))
    boxes = boxes_of(sheet)
    for number, one in enumerate(boxes):
        for other in boxes[:number]:
            across = min(one.x1, other.x1) - max(one.x0, other.x0)
            down = min(one.y1, other.y1) - max(one.y0, other.y0)
            assert across <= 0.3 or down <= 0.2 * min(one.height, other.height)


def test_a_character_that_no_font_has_is_said(
    inspection: Inspection, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page_fonts, "_other_fonts", list)
    report = page_report([[inspection]], Names(axlebox="轴箱 3"), "foot")
    (told,) = page_pdf.write_pdf(report, tmp_path / "page.pdf")
    assert told.startswith("the PDF cannot show 2 characters of the names in it, □ stands for each")
    fonts = page_fonts.fonts_for("轴箱 3")
    assert (fonts.shown("轴箱 3"), fonts.missing) == ("□□ 3", "箱轴")
    monkeypatch.undo()
    assert page_fonts.fonts_for("Prüfstand 3 °C µ") == page_fonts.Fonts((page_fonts.USUAL,), "")


# --- in Python -----------------------------------------------------------------------------------------


def test_python_writes_the_page_of_a_run_and_refuses_with_every_mistake(faulty: Path, tmp_path: Path) -> None:
    html = tmp_path / "page.html"
    assert bd.report(bd.read(faulty), html=html, train="train 7") == ()
    assert "outer ring (cup)" in html.read_text(encoding="utf-8")
    with pytest.raises(InputError) as refused:
        bd.report(faulty, html=html, pdf=tmp_path / "none" / "page.pdf")
    assert len(refused.value.problems) == 2
    assert "the file exists" in refused.value.problems[0]
    with pytest.raises(InputError, match="give html, pdf or both"):
        bd.report(faulty)
    with pytest.raises(InputError, match="has no axlebox right"):
        bd.report(bd.read(faulty), html=html, box="right", force=True)
    other = bd.report([faulty, faulty], html=html, bearing="6205", force=True)
    assert other == ()
    assert "6205" in html.read_text(encoding="utf-8")

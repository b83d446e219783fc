"""``beardyn report --html --pdf``: the verdict of ``beardyn monitor``, from the same files and options."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.cli.main import BAD_INPUT, DONE, main
from beardyn_core.cli.report_page import run_page
from beardyn_core.record.sinks import TrainSink
from beardyn_core.study.inspection import Inspection
from beardyn_core.study.report_page import page_writing
from test.measured.files import G, frequencies, struck
from test.measured.test_monitor_files import measured, motor
from test.record.synthetic_run import SyntheticRun, description
from test.recordings import write_recording
from test.study.test_report_page import text_of

MEASURED = ("--speed-rpm", "1800", "--bearing", "6205")
RECORDED = ("--bearing", "HS130x230")


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("recorded") / "run.mcap", 80, ("axlebox_top",))


@pytest.fixture
def seen(monkeypatch: pytest.MonkeyPatch) -> list[list[Inspection]]:
    """What the pages are written of."""
    found: list[list[Inspection]] = []
    write = page_writing.write_pages

    def written(records: list[list[Inspection]], **options: object) -> tuple[str, ...]:
        found.extend(records)
        return write(records, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(page_writing, "write_pages", written)
    return found


def sheets(pdf: Path) -> int:
    return len(re.findall(rb"/Type\s*/Page\b", pdf.read_bytes()))


def train_recording(path: Path) -> Path:
    """Two axleboxes in one recording."""
    sink, names = TrainSink(path), ("axle_1_left", "axle_1_right")
    sink.open({name: description(duration=1.6) for name in names})
    for block in SyntheticRun().blocks(80):
        for name in names:
            sink.write(sink.encode(name, block))
    sink.close()
    return path


def words_of(path: Path, *, measured: bool) -> tuple[str, ...]:
    return (str(path), *(MEASURED if measured else RECORDED))


@pytest.mark.parametrize("is_measured", [False, True])
def test_the_verdict_is_that_of_the_monitor(
    is_measured: bool,
    recording: Path,
    tmp_path: Path,
    seen: list[list[Inspection]],
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = motor(tmp_path) if is_measured else recording
    words = words_of(path, measured=is_measured)
    main(["monitor", *words, "--json"])
    told = json.loads(capsys.readouterr().out)["bearings"][0]
    page = tmp_path / "page.html"
    assert main(["report", *words, "--html", str(page)]) == DONE
    assert capsys.readouterr().out == f"{page}\n"
    ((found,),) = seen
    assert (found.verdict, found.conclusion.agreeing, found.conclusion.analyses) == (
        told["verdict"], told["agreeing"], told["analyses"],
    )  # fmt: skip
    assert [each.reason for each in found.results.findings] == [each["reason"] for each in told["findings"]]
    assert [each.score for each in found.results.findings] == [each["score_dB"] for each in told["findings"]]
    assert told["findings"][-1]["reason"] in text_of(page.read_text(encoding="utf-8"))


def test_one_file_and_one_box_fit_one_sheet_of_paper(recording: Path, tmp_path: Path) -> None:
    pdf = tmp_path / "page.pdf"
    assert main(["report", *words_of(recording, measured=False), "--pdf", str(pdf)]) == DONE
    assert sheets(pdf) == 1
    assert b"/MediaBox [ 0 0 595" in pdf.read_bytes()


def test_without_a_page_the_command_is_as_it_was(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["report", str(recording)]) == DONE
    assert "closed properly" in capsys.readouterr().out
    idle = ("--train", "7", "--bearing", "6205", "--speed-rpm", "900", "--hot", "100", "--bpfo", "3.5")
    assert main(["report", str(recording), str(recording), *idle]) == BAD_INPUT
    told = capsys.readouterr().err
    for option in ("--train", "--bearing", "--speed-rpm", "--hot", "--bpfo"):
        assert f"{option}: is of a page; give --html or --pdf too" in told
    assert "without --html or --pdf one recording is reported on" in told


def test_every_box_has_a_page_after_an_overview_and_box_picks_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = train_recording(tmp_path / "train.mcap")
    html, pdf = tmp_path / "page.html", tmp_path / "page.pdf"
    words = ["report", *words_of(path, measured=False), "--html", str(html), "--force"]
    assert main([*words, "--pdf", str(pdf)]) == DONE
    assert sheets(pdf) == 3
    text = html.read_text(encoding="utf-8")
    assert text.count("<section ") == 3
    assert "Overview of 2 bearings" in text_of(text)
    assert main([*words, "--box", "axle_1_right"]) == DONE
    text = html.read_text(encoding="utf-8")
    assert text.count("<section ") == 1
    assert "Axlebox: axle_1_right" in text_of(text)
    capsys.readouterr()
    assert main([*words, "--axlebox", "left one"]) == BAD_INPUT
    assert "axlebox is 'left one', the name of one, and the files have 2" in capsys.readouterr().err


def test_a_recording_that_was_cut_off_says_so_on_the_page(recording: Path, tmp_path: Path) -> None:
    cut, page = tmp_path / "cut.mcap", tmp_path / "page.html"
    cut.write_bytes(recording.read_bytes()[: recording.stat().st_size * 3 // 4])
    assert main(["report", *words_of(cut, measured=False), "--html", str(page)]) == DONE
    text = text_of(page.read_text(encoding="utf-8"))
    assert "NOT WHOLE" in text
    assert "the file was not closed properly" in text
    assert text.index("NOT WHOLE") < text.index("Confidence")


def test_several_recordings_are_records_over_time(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = tmp_path / "page.html"
    words = ["report", str(recording), str(recording), *RECORDED, "--html", str(page)]
    assert main(words) == DONE
    text = text_of(page.read_text(encoding="utf-8"))
    assert "Verdicts over 2 files in the order given; the last one is the record of this page" in text
    capsys.readouterr()
    assert (
        main([*words[:2], str(motor(tmp_path)), *MEASURED, "--html", str(tmp_path / "b.html")]) == BAD_INPUT
    )
    assert "is not; give recordings or measured files" in capsys.readouterr().err


def test_several_measured_files_are_one_measurement_with_a_level_for_each(tmp_path: Path) -> None:
    signal = struck(frequencies("6205").bpfo, 4.0)[:, 0] / G
    files = [
        measured(tmp_path, name, acc=signal[part] * factor)
        for name, part, factor in (("a.csv", slice(None, 24_000), 1.0), ("b.csv", slice(24_000, None), 3.0))
    ]
    page = tmp_path / "page.html"
    words = ["report", *map(str, files), *MEASURED, "--unit", "g", "--html", str(page)]
    assert main(words) == DONE
    text = text_of(page.read_text(encoding="utf-8"))
    assert "Levels over 2 files, the last +9.5 dB to the median before it" in text
    assert "Files: a.csv, b.csv" in text
    assert len(re.findall(r"outer ring \(cup\), \d of \d", text)) == 2


def test_the_date_is_that_of_the_clock_of_the_file(tmp_path: Path) -> None:
    path, page = tmp_path / "dated.npz", tmp_path / "page.html"
    signal = struck(frequencies("6205").bpfo, 2.0)[:, 0]
    np.savez(path, acc=signal, fs=12_000.0, start_time=np.array("2026-10-03T12:30:00"))
    words = ["report", str(path), *MEASURED, "--unit", "m/s2", "--html", str(page)]
    assert main(words) == DONE
    text = text_of(page.read_text(encoding="utf-8"))
    assert "Date of the record: 2026-10-03 12:30:00, clock of the file" in text


def test_names_of_any_writing_are_on_both_pages(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = motor(tmp_path).rename(tmp_path / "轴箱<b>右侧.csv")
    html, pdf = tmp_path / "页.html", tmp_path / "页.pdf"
    assert main(["report", *words_of(path, measured=True), "--html", str(html), "--pdf", str(pdf)]) == DONE
    text = html.read_text(encoding="utf-8")
    assert "<b>右侧" not in text
    assert "Files: 轴箱<b>右侧.csv" in text_of(text)
    assert sheets(pdf) == 1
    told = capsys.readouterr().err
    is_shown = b"WenQuanYi" in pdf.read_bytes() or b"CJK" in pdf.read_bytes()
    assert is_shown or "the PDF cannot show" in told


def test_all_mistakes_about_the_pages_are_told_at_once_and_nothing_is_read(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("beardyn_core.cli.report_page.inspect_files", None)
    kept = tmp_path / "kept.html"
    kept.write_text("of last week")
    words = ["report", str(recording), "--html", str(kept), "--pdf", str(tmp_path / "none" / "a.pdf")]
    wrong = ("--speed-uncertainty", "90", "--bearing", "none such", "--monitor", "no:where")
    assert main([*words, "--json", "--speed-rpm", "900", *wrong]) == BAD_INPUT
    told = capsys.readouterr().err
    assert f"--html {kept}: the file exists; --force replaces it" in told
    assert "does not exist; create it" in told
    assert "--json: a page is no JSON" in told
    assert "--speed-uncertainty is '90'" in told
    assert "--bearing none such: " in told
    assert "no:where" in told
    assert "--speed-rpm is for measured files" in told
    assert main(["report", str(recording), "--html", str(tmp_path / "a.txt")]) == BAD_INPUT
    assert "let its name end in .html" in capsys.readouterr().err
    both = str(tmp_path / "both")
    assert main(["report", str(recording), "--html", both, "--pdf", both]) == BAD_INPUT
    assert "--html and --pdf are the same file" in capsys.readouterr().err
    assert main(["report", str(recording), "--html", str(recording), "--force"]) == BAD_INPUT
    assert "the command reads this file" in capsys.readouterr().err
    assert kept.read_text() == "of last week"
    assert [each.name for each in tmp_path.iterdir()] == ["kept.html"]


def test_a_page_that_exists_is_replaced_with_force_as_a_whole(
    recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = tmp_path / "page.pdf"
    page.write_text("of last week")
    words = ["report", *words_of(recording, measured=False), "--pdf", str(page), "--force"]

    def broken(*_: object) -> list[str]:
        raise KeyboardInterrupt

    monkeypatch.setattr("beardyn_core.study.report_page.page_pdf.write_pdf", broken)
    assert main(words) not in (DONE, BAD_INPUT)
    assert page.read_text() == "of last week"
    monkeypatch.undo()
    assert main(words) == DONE
    assert page.read_bytes().startswith(b"%PDF")
    assert [each.name for each in tmp_path.iterdir()] == ["page.pdf"]


def test_without_matplotlib_the_extra_is_named(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert callable(run_page)
    for name in [each for each in sys.modules if each.partition(".")[0] == "matplotlib"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["report", str(recording), "--pdf", str(tmp_path / "page.pdf")]) == BAD_INPUT
    assert "--pdf needs matplotlib" in capsys.readouterr().err

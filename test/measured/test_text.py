"""Tables in text: any separator, decimal sign, header and unit give the same numbers, or a sentence."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

import beardyn_core as bd
from beardyn_core.measured.options import DECIMALS, SEPARATORS, Reading
from beardyn_core.measured.text_table import detect_table
from beardyn_core.measured.units import ACCELERATION, STANDARD_GRAVITY, split_unit, unit_in, usual
from test.examples import examples
from test.measured.files import G, noise

HEADINGS = ("{name} [{unit}]", "{name} ({unit})", "{name}_{unit}", "{name}")
UNITS = {
    "m/s2": ("m/s²", "m/s^2", "m/s2", "m/s**2"),
    "g": ("g",),
    "mg": ("mg",),
    "mm/s2": ("mm/s²", "mm/s^2"),
}


def written(
    path: Path, values: Any, separator: str, decimal: str, heading: str, unit: str, comments: int, end: str
) -> Path:
    names = ["time_s", *(heading.format(name=f"acc_{axis}", unit=unit) for axis in "xyz"[-values.shape[1] :])]
    rows = [f"# line {k}" for k in range(comments)] + ([separator.join(names)] if heading else [])
    for k, row in enumerate(values):
        cells = [f"{k / 1000:.4f}", *(f"{value:.6f}" for value in row)]
        rows.append(separator.join(cells).replace(".", decimal))
    path.write_bytes(end.join([*rows, ""]).encode())
    return path


@given(
    separator=some.sampled_from(sorted(SEPARATORS)),
    decimal=some.sampled_from(sorted(DECIMALS)),
    heading=some.sampled_from(HEADINGS),
    unit=some.sampled_from([(known, text) for known, texts in UNITS.items() for text in texts]),
    axes=some.sampled_from([1, 3]),
    comments=some.integers(0, 3),
    end=some.sampled_from(["\n", "\r\n"]),
    seed=some.integers(0, 99),
    asked=some.booleans(),
)
@settings(max_examples=examples(150), deadline=None)
def test_separator_decimal_header_and_unit_are_understood(
    tmp_path_factory: pytest.TempPathFactory, separator: str, decimal: str, heading: str,
    unit: tuple[str, str], axes: int, comments: int, end: str, seed: int, asked: bool,
) -> None:  # fmt: skip
    if separator == "comma" and decimal == "comma":
        return
    values = np.round(np.random.default_rng(seed).normal(0.0, 3.0, (64, axes)), 6)
    between = " " if SEPARATORS[separator] is None else str(SEPARATORS[separator])
    if between == " ":
        heading = heading.replace(" ", "")
    said = heading != "{name}" and not ("_" in heading and "/" in unit[1])
    path = tmp_path_factory.mktemp("text") / "a.csv"
    written(path, values, between, DECIMALS[decimal], heading, unit[1], comments, end)
    options: dict[str, Any] = {} if said else {"unit": unit[0]}
    if asked:
        options |= {"separator": separator, "decimal": decimal}
    run = bd.read_measured(path, **options)
    np.testing.assert_allclose(
        run.vibration.values[:, 3 - axes :], values * ACCELERATION[unit[0]], rtol=1e-12, atol=1e-15
    )
    assert run.vibration.rate == 1000.0
    (told,) = (each for each in run.measured["understood"] if "columns" in each)
    assert f"{separator} between, decimal {decimal}" in told


def test_words_for_the_axes_are_understood_and_a_load_is_none(tmp_path: Path) -> None:
    path, signal = tmp_path / "a.csv", noise(axes=3)
    names = ["Zeit_s", "Schwingung vertikal [g]", "längs (g)", "acc_lateral [g]", "vertical_load"]
    time = np.arange(len(signal)) / 2048.0
    table = np.column_stack([time, signal, np.full(len(signal), 8e4)])
    np.savetxt(path, table, delimiter=";", header=";".join(names), comments="", encoding="utf-8")
    run = bd.read_measured(path)
    np.testing.assert_allclose(run.vibration.values, signal[:, [1, 2, 0]] * G)


def test_a_table_without_a_header_has_columns_by_number(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("".join(f"9,39,{k},0.5,{k % 5}.25,{k % 3}.5\n" for k in range(100)))
    run = bd.read_measured(path, channels="x=5,z=6", rate_Hz=25600, unit="g")
    assert run.vibration.values[7, 0] == 2.25 * STANDARD_GRAVITY
    assert run.vibration.values[7, 2] == 1.5 * STANDARD_GRAVITY
    assert np.isnan(run.vibration.values[:, 1]).all()
    assert "no line names them" in run.measured["understood"][0]


def test_a_header_of_keys_and_numbers_names_no_column(tmp_path: Path) -> None:
    """A text file of LabVIEW: a head with tabs, and a heading for comments that no row has."""
    path = tmp_path / "a.lvm"
    head = "Writer_Version\t2\nX_Dimension\tTime\nX0\t0.0\nDelta_X\t8.333E-5\n***End_of_Header***\n"
    values = noise(1200)[:, 0]
    rows = "".join(f"{k / 12_000:.7f}\t{value}\n" for k, value in enumerate(values))
    path.write_text(f"{head}X_Value\tAcceleration\tComment\n{rows}")
    run = bd.read_measured(path, unit="g")
    np.testing.assert_allclose(run.vibration.values[:, 2], values * G)
    assert run.vibration.rate == pytest.approx(12_000.0)


def test_what_is_no_table_is_shown(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("time;acc [g]\n0;1.234,5\n1;2.345,6\n")
    with pytest.raises(bd.InputError, match=r"nothing between thousands.*; line 3 is '1;2\.345,6'"):
        bd.read_measured(tmp_path / "a.csv")
    (tmp_path / "one.csv").write_text("1.5D+00\n-2.5D-01\n" * 50)
    run = bd.read_measured(tmp_path / "one.csv", unit="m/s2", rate_Hz=12_000.0)
    assert run.vibration.values[:2, 2].tolist() == [1.5, -0.25]
    told = run.measured["understood"][0]
    assert "text: 1 column, decimal point; no line names them" in told


def test_a_row_of_units_and_lines_above_the_header_are_understood(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    head = "Logger: LX-7\nSerial: 0815\nSampling rate: 5000 Hz\n\nTime;Channel A\ns;g\n"
    path.write_text(head + "".join(f"{k / 5000:.4f};{k % 7 - 3}.5\n".replace(".", ",") for k in range(99)))
    run = bd.read_measured(path)
    assert run.vibration.rate == 5000.0
    assert run.vibration.values[0, 2] == pytest.approx(-3.5 * STANDARD_GRAVITY)
    assert run.measured["files"][0]["says"]["Logger"] == "LX-7"


def test_whole_numbers_with_commas_may_mean_two_things_and_are_asked_about(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("".join(f"{k % 7},{100 + k}\n" for k in range(50)))
    with pytest.raises(
        bd.InputError, match=r"may be 2 columns with commas between or 1 with a decimal comma"
    ):
        bd.read_measured(path, unit="g", rate_Hz=1000)
    one = bd.read_measured(path, unit="g", rate_Hz=1000, decimal="comma")
    assert one.vibration.values[3, 2] == pytest.approx(3.103 * STANDARD_GRAVITY)
    two = bd.read_measured(path, unit="g", rate_Hz=1000, separator="comma", channels="2")
    assert two.vibration.values[3, 2] == pytest.approx(103 * STANDARD_GRAVITY)


def test_leading_zeros_show_a_decimal_comma(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("".join(f"0,0{k}1\n" for k in range(50)))
    run = bd.read_measured(path, unit="m/s2", rate_Hz=1000)
    assert run.vibration.values[7, 2] == 0.071


def test_dates_with_times_give_the_rate(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    start = np.datetime64("2026-03-01T23:59:59.5", "ns")
    rows = (f"{start + np.timedelta64(k * 78125, 'ns')};{k % 9}.5" for k in range(20_000))
    path.write_text("stamp;az_g\n" + "\n".join(rows))
    run = bd.read_measured(path)
    assert run.vibration.rate == 12_800.0
    assert run.vibration.values[1, 2] == pytest.approx(1.5 * STANDARD_GRAVITY)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_usual_encodings_are_read(encoding: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    text = "Zeit [s];Körper [m/s²]\n" + "".join(f"{k / 100:.2f};{k % 5}.5\n" for k in range(60))
    path.write_bytes(text.encode(encoding))
    run = bd.read_measured(path)
    assert run.measured["sensors"]["accelerometer"]["channels"] == {"z": "Körper"}
    assert run.vibration.values[2, 2] == 2.5


def test_bad_cells_are_told_with_their_lines_all_at_once(tmp_path: Path) -> None:
    lines = ["time_s,az_g", *(f"{k / 100:.2f},{k % 5}.5" for k in range(60))]
    lines[10], lines[20], lines[30] = "0.09,", "0.19,OVER", "0.29,1.0,7"
    path = tmp_path / "a.csv"
    path.write_text("\n".join(lines))
    with pytest.raises(bd.InputError) as caught:
        bd.read_measured(path)
    text = str(caught.value)
    assert "line 11: az_g is '', which is no number" in text
    assert "line 21: az_g is 'OVER'" in text
    assert "line 31: has 3 values where 2 belong" in text


@pytest.mark.parametrize("content", ["hello\nworld\n", "a,b,c\n", "\n\n\n", "x" * 3000])
def test_text_without_numbers_is_a_sentence(content: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(content)
    with pytest.raises(bd.InputError, match=r"a\.csv: has no lines of numbers in columns"):
        detect_table(path, Reading())


@pytest.mark.parametrize(
    ("text", "unit"),
    [("m/s^2", "m/s2"), ("m s⁻²", "m/s2"), ("M/S²", "m/s2"), ("G", "g"), ("g's", "g"), ("U/min", "rpm"),
     ("V", "V"), ("mm/s²", "mm/s2"), ("kph", "km/h"), ("µs", "us")],
)  # fmt: skip
def test_units_are_known_as_people_write_them(text: str, unit: str) -> None:
    assert usual(text) == unit


def test_units_stand_in_brackets_or_at_the_end_of_a_name() -> None:
    assert split_unit("acc x [m/s²]") == ("acc x", "m/s²")
    assert split_unit("plain") == ("plain", "")
    assert unit_in("X097RPM", {"rpm": 1.0}) == "rpm"
    assert unit_in("az_m_s2", ACCELERATION) == "m/s2"
    assert unit_in("swing", ACCELERATION) == ""


@pytest.mark.parametrize("mark", ["", "# a remark\n", "% another\n"])
@pytest.mark.parametrize("quote", ["", '"'])
def test_a_file_without_mistakes_is_read_the_quick_way(
    mark: str, quote: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = [f"{quote}{k / 100:.2f}{quote};{quote}{k % 7},5{quote}\n" for k in range(60)]
    rows.insert(30, mark)
    path = tmp_path / "a.csv"
    path.write_text("time_s;az_g\n" + "".join(rows).replace(".", ","))
    if not (mark and quote):  # NumPy does not know both at once
        monkeypatch.setattr("beardyn_core.measured.csv_text._slow", None)
    run = bd.read_measured(path)
    np.testing.assert_allclose(run.vibration.values[:, 2], (np.arange(60) % 7 + 0.5) * STANDARD_GRAVITY)


def test_a_row_with_too_many_cells_is_found_although_its_first_ones_are_numbers(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = [f"{k / 100:.2f},{k % 7}.5\n" for k in range(60)]
    rows[20] = "0.20,1.5,9,9\n"
    path.write_text("time_s,az_g\n" + "".join(rows))
    with pytest.raises(bd.InputError, match="line 22: has 4 values where 2 belong"):
        bd.read_measured(path)


@pytest.mark.parametrize("value", ["#N/A", "#NV", "#DIV/0!", "#WERT!", '"#N/A"', "#NAME?", "#¡VALOR!"])
@pytest.mark.parametrize("row", ["{}", "{};0.5"])
def test_a_value_that_a_spreadsheet_has_not_is_no_comment(value: str, row: str, tmp_path: Path) -> None:
    """Left out, the samples behind it would come too early."""
    path = tmp_path / "a.csv"
    rows = [row.format(f"{0.25 + number % 7}") for number in range(5000)]
    rows[3000:3002] = [row.format(value)] * 2
    rows[10] = "# a note in between"
    path.write_text("\n".join(rows) + "\n# the end\n", encoding="utf-8")
    with pytest.raises(bd.InputError) as caught:
        bd.read_measured(path, rate_Hz=1000.0, unit="g", channels="z=1")
    (found,) = caught.value.problems
    word = value.strip('"')
    assert f"line 3001: 1 is {word!r}, which is no number; line 3002: 1 is {word!r}" in found


def test_an_empty_line_of_the_only_column_is_a_value_that_is_missing(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = [f"{0.25 + number % 7}" for number in range(5000)]
    path.write_text("\n".join(rows) + "\n\n  \n# the end\n\n")
    assert len(bd.read_measured(path, rate_Hz=1000.0, unit="g").vibration) == 5000
    rows[7] = rows[4999] = ""
    path.write_text("\n".join([*rows, "0.5"]) + "\n")
    with pytest.raises(bd.InputError, match="line 8: is empty, where a number belongs; line 5000: is empty"):
        bd.read_measured(path, rate_Hz=1000.0, unit="g")


def test_an_empty_line_between_two_blocks_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("beardyn_core.measured.csv_text._CHARACTERS", 100)
    path = tmp_path / "a.csv"
    path.write_text("0.50\n0.75\n" * 10 + "\n" * 300 + "0.25\n" * 50)
    with pytest.raises(bd.InputError, match=r"line 21: is empty, .* and 297 lines more"):
        bd.read_measured(path, rate_Hz=1000.0, unit="g")


@pytest.mark.parametrize(
    ("heading", "row", "name"),
    [
        ("acc_z [g]", "{}", "acc_z"),
        ("Acceleration vertical (g)", "{}", "Acceleration vertical"),
        ('"acc_z [g]"', "{}", "acc_z"),
        ("n [-] acc_z [g]", "1.5 {}", "acc_z"),
    ],
)
def test_a_unit_behind_a_space_is_read(heading: str, row: str, name: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("\n".join([heading, *(row.format(0.25 + number % 7) for number in range(100))]))
    run = bd.read_measured(path, rate_Hz=1000.0, channels=f"z={name}")
    assert np.ptp(run.vibration.values[:, 2]) == pytest.approx(6.0 * 9.80665)


@pytest.mark.parametrize(
    "line", ["run 7 of Tuesday", "Full scale: 50 (g)", "Measured at Derby (UK)", "Fs = 1000 [Hz]"]
)
def test_a_sentence_above_the_only_column_is_no_heading(line: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("\n".join([line, *(f"{0.25 + number % 7}" for number in range(100))]))
    with pytest.raises(bd.InputError, match="does not state the unit of 1"):
        bd.read_measured(path, rate_Hz=1000.0)


def test_a_rate_above_the_only_column_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    lines = ["# Sampling rate: 1000 (Hz)", "# sensor by the wheel (left)", "az [g]"]
    path.write_text("\n".join([*lines, *(f"{0.25 + number % 7}" for number in range(100))]))
    assert bd.read_measured(path).vibration.rate == 1000.0


@pytest.mark.parametrize("units", ["[s] [g]", "(s) (g)", "  [s]   [m/s^2]", "s (g)"])
def test_a_row_of_units_with_white_space_between_is_read(units: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = [f"{number / 1000:.3f} {0.25 + number % 7}" for number in range(100)]
    path.write_text("\n".join(["time az", units, *rows]))
    run = bd.read_measured(path)
    assert run.vibration.rate == 1000.0
    unit = usual(units.split()[1].strip("[]()"))
    assert np.ptp(run.vibration.values[:, 2]) == pytest.approx(6.0 * ACCELERATION[unit])


@pytest.mark.parametrize("word", ["#OVERLOAD!", "#END!", "#NO", "#NAVY", "#note"])
def test_a_word_behind_a_hash_is_a_comment(word: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = [f"{0.25 + number % 7}" for number in range(100)]
    path.write_text("\n".join([*rows, word, *rows]))
    assert len(bd.read_measured(path, rate_Hz=1000.0, unit="g").vibration) == 200


@pytest.mark.parametrize("heading", ["", "az_g\n"])
def test_a_value_that_is_missing_at_the_beginning_is_no_heading(heading: str, tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    rows = ["#N/A", "#N/A", *(f"{0.25 + number % 7}" for number in range(100))]
    path.write_text(heading + "\n".join(rows))
    with pytest.raises(bd.InputError, match=r"line \d: (1|az_g) is '#N/A', which is no number; line \d: "):
        bd.read_measured(path, rate_Hz=1000.0, unit="g")


@pytest.mark.parametrize("block", [7, 8, 1000])
def test_an_end_of_line_that_was_written_twice_is_no_missing_value(
    block: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("beardyn_core.measured.csv_text._CHARACTERS", block)
    path = tmp_path / "a.csv"
    path.write_bytes(b"az_g\r\r\n" + b"".join(b"%.2f\r\r\n" % (0.25 + n % 7) for n in range(100)))
    assert len(bd.read_measured(path, rate_Hz=1000.0).vibration) == 100

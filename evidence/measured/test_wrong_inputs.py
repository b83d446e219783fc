"""The page of wrong speeds and bearings: it counts what the monitor answers, and reads the public formats."""

from __future__ import annotations

from pathlib import Path

import pytest
from scipy.io import savemat

from beardyn_core.config import load_plate
from evidence.measured.cases import HIT, listenings, records
from evidence.measured.test_measured import struck
from evidence.measured.wrong_inputs import BEARINGS, ERRORS, PAGE, cases, main, orders_of, rows, text


@pytest.fixture(scope="module")
def hit_sm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A spalled outer ring and a healthy bearing as HIT-SM has them."""
    folder = tmp_path_factory.mktemp("hit") / "rig"
    folder.mkdir()
    order = load_plate("6205").frequencies.bpfo
    for name, struck_order in (("OR2_1200", order), ("Normal_1200", 0.0)):
        savemat(folder / f"{name}.mat", {"signal": struck(struck_order, 51.2e3, 20.0, 3.1)[:, None]})
    return folder


def test_records_of_hit_sm_are_read_with_their_part_and_speed(hit_sm: Path) -> None:
    healthy, faulty = sorted(records(hit_sm=hit_sm), key=lambda each: each.part)
    assert (healthy.group, healthy.part, faulty.part) == (HIT, "", "cup")
    (received,) = listenings(faulty)
    assert (received.plate.name, received.rate, received.shaft_frequency) == ("6205", 51.2e3, 20.0)


def test_a_clear_fault_is_never_healthy_and_never_another_part_whatever_is_stated(hit_sm: Path) -> None:
    faulty = next(each for each in records(hit_sm=hit_sm) if each.part)
    answers = dict(cases(next(iter(listenings(faulty)))))
    assert len(answers) == len(ERRORS) + 3
    assert answers["+0 %"] == "cup"
    assert set(answers.values()) <= {"cup", "unexplained", "not_diagnosable"}


def test_the_page_counts_answers_and_names_what_no_setting_finds(hit_sm: Path, tmp_path: Path) -> None:
    found = [
        ("a", "cup", "+0 %", "cup"),
        ("a", "cup", "+5 %", "unexplained"),
        ("b", "cone", "+0 %", "healthy"),
        ("b", "cone", "+5 %", "roller"),
        ("c", "", "in a healthy machine", "healthy"),
    ]
    assert rows(found)["+0 %"] == {"right": 1, "healthy": 1}
    page = text(found, "3 of a set")
    assert "| +5 % | 0 | 1 | 0 | 1 | 0 |" in page
    assert "(b)" in page
    assert "Another part is named in 25.0 %" in page


def test_an_interrupted_run_goes_on_from_its_results(hit_sm: Path, tmp_path: Path) -> None:
    kept, page = tmp_path / "kept.json", tmp_path / "page.md"
    kept.write_text(
        '{"HIT-SM rig/OR2_1200": [["HIT-SM rig/OR2_1200", "cup", "+0 %", "cup"]]}', encoding="utf-8"
    )
    assert main(["--hit", str(hit_sm), "--results", str(kept), "-o", str(page)]) == 0
    assert "| +0 % | 1 | 0 | 0 | 0 | 0 |" in page.read_text(encoding="utf-8")
    assert "| in a healthy machine | 1 | 0 | 0 | 0 |" in page.read_text(encoding="utf-8")


def test_the_page_in_the_repository_is_of_this_form() -> None:
    """Its numbers are those of files which are not here."""
    page = PAGE.read_text(encoding="utf-8")
    for heading in (line for line in text([], "nothing").splitlines() if line.startswith("#")):
        assert heading in page
    assert {name: orders_of(name)[1] for name in BEARINGS} == {"6203": 8, "6204": 8, "6205": 9, "6206": 9}

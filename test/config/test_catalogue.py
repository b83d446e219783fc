"""The catalogue of bearings: every line against physics and other sources, designations, search, mistakes."""

from __future__ import annotations

import math
import re
import shutil
from collections import Counter
from math import isnan
from pathlib import Path

import pytest

import beardyn_core as bd
from beardyn_core.bearing.catalogue_entry import CatalogueEntry
from beardyn_core.config import config_folder, load_plate
from beardyn_core.config.catalogue import catalogue, find_bearing
from beardyn_core.config.yaml_text import read_file

ENTRIES = catalogue()
LISTED = [each for each in ENTRIES if each.place.endswith(".yaml") is False]
PAGE = (Path(__file__).parents[2] / "docs" / "bearing_data.md").read_text(encoding="utf-8")


def gamma_of(entry: CatalogueEntry) -> float:
    orders = entry.plate.frequencies
    return (orders.bpfi - orders.bpfo) / (orders.bpfi + orders.bpfo)


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda each: each.name)
def test_factors_of_a_bearing_agree_with_each_other(entry: CatalogueEntry) -> None:
    orders, count = entry.plate.frequencies, entry.plate.roller_count
    assert not entry.plate.cannot_tell
    # makers round to three digits
    assert orders.bpfo + orders.bpfi == pytest.approx(count, abs=2.5e-3)
    assert orders.ftf == pytest.approx(orders.bpfo / count, abs=1.2e-3)
    gamma = gamma_of(entry)
    assert 0.05 < gamma < 0.5
    cosine = 2.0 * gamma * orders.bsf / (1.0 - gamma**2)
    least = 0.75 if "contact" in entry.kind else 0.86 if entry.kind == "tapered roller" else 0.94
    if entry.kind in ("deep groove ball", "cylindrical roller"):
        least = 0.985
    assert least < cosine < 1.012  # not twice the spin; a contact angle that the kind can have
    assert entry.source
    assert entry.place


@pytest.mark.parametrize(
    "entry", [each for each in ENTRIES if not isnan(each.bore)], ids=lambda each: each.name
)
def test_rolling_elements_fit_between_bore_and_outside_diameter(entry: CatalogueEntry) -> None:
    """A line of factors stands at the size it is of: what share of the section is rolling element."""
    orders, gamma = entry.plate.frequencies, gamma_of(entry)
    cosine = min(1.0, 2.0 * gamma * orders.bsf / (1.0 - gamma**2))
    ratio = gamma / cosine
    middle, section = (entry.outer_diameter + entry.bore) / 2.0, (entry.outer_diameter - entry.bore) / 2.0
    assert 0.38 < ratio * middle / section < 0.7
    assert entry.plate.roller_count * math.asin(ratio) / math.pi < 1.005
    assert entry.size_source
    assert 0.0 < entry.width < 2.0 * entry.outer_diameter


def test_every_source_is_used_and_every_line_has_one() -> None:
    texts = read_file(config_folder() / "catalogue" / "sources.yaml")
    written = (config_folder() / "catalogue" / "bearings.csv").read_text(encoding="utf-8")
    assert len(LISTED) >= 150
    assert all(each in written for each in texts)
    assert {" ".join(text.split()) for text in texts.values()} >= {each.source for each in LISTED}


def test_the_page_counts_what_is_there() -> None:
    kinds = Counter(each.kind for each in LISTED)
    rows = dict(re.findall(r"^\| ([a-z -]+?)(?: of an axlebox.*?)? \| (\d+) \|$", PAGE, re.MULTILINE))
    assert {name: int(count) for name, count in rows.items()} == kinds
    assert f"{len(LISTED)} bearings of test rigs" in PAGE
    own = sum("14 535" in each.source for each in LISTED)
    assert f"| {own} |" in PAGE
    assert f"| {len(LISTED) - own} |" in PAGE


@pytest.mark.parametrize(
    ("name", "bpfo", "bpfi", "tolerance"),
    [
        ("6205", 3.5848, 5.4152, 2e-4),  # CWRU
        ("22205", 6.1852, 8.8148, 1e-3),  # Schaeffler, in Soto-Ocampo et al. (2020), table 1
        ("NU206E", 5.24, 7.76, 2e-3),  # Schaeffler, in Schnur et al. (2025), table 1
        ("NTN 6201", 2.62, 4.38, 5e-3),  # data sheet, in the readme of VBL-VA001
        ("32305", 5.111, 7.889, 5e-3),  # HRB 32305 of the bogie rig of BJTU
        ("6204", 3.081, 4.919, 1.2e-2),  # MOCHU 6204, 8 balls of 7.94 mm on 34.57 mm (Lee et al. 2024)
        (
            "30204",
            6.232,
            8.768,
            1.5e-2,
        ),  # NTN 30204, 15 rollers of 6.2 mm on 35.8 mm (the same)
    ],
)
def test_factors_of_the_list_are_those_of_other_sources(
    name: str, bpfo: float, bpfi: float, tolerance: float
) -> None:
    orders = load_plate(name).frequencies
    assert (orders.bpfo, orders.bpfi) == pytest.approx((bpfo, bpfi), rel=tolerance)


def test_the_unit_of_a_high_speed_train_has_the_orders_of_its_dimensions() -> None:
    """Zhao et al. (2026), table 2: 17 rollers of 26.7 mm on 185 mm, at 10.5 degrees."""
    entry = find_bearing("CRH380B")
    share = 26.7 / 185.0 * math.cos(math.radians(10.5))
    assert entry.kind == "tapered unit"
    assert entry.plate.frequencies.bpfo == pytest.approx(8.5 * (1.0 - share), rel=1e-9)


def test_rollers_of_the_class_f_unit_are_those_of_its_patent() -> None:
    """US 2002/0164102: the cone assembly HM133444 of AAR class F has 23 rollers."""
    entry = find_bearing("HM133444")
    assert (entry.kind, entry.rows, entry.plate.roller_count) == ("tapered unit", 2, 23)
    assert entry.bore == pytest.approx(0.15715)


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("6205-2RS JEM", "6205"),
        ("SKF 6205/C3", "6205"),
        (" 6205 ", "6205"),
        ("SKF6205", "6205"),
        ("NU 214 ECP", "NU214E"),
        ("nu214-e-xl-tvp2", "NU214E"),
        ("FAG NU214E", "NU214E"),
        ("22228 CC/W33", "22228"),
        ("NTN 6202LLU", "NTN 6202"),
        ("NSK 6205DDU", "NSK 6205"),
        ("nsk6205", "NSK 6205"),
        ("3207 ATN9", "3207ATN9"),
        ("ER16K", "ER-16K"),
        ("HS130x230", "HS130x230"),
    ],
)
def test_endings_that_change_no_factor_are_left_aside(written: str, name: str) -> None:
    assert find_bearing(written).name == name
    assert load_plate(written).name == name


@pytest.mark.parametrize(
    "written",
    [
        *(
            "6205 ETN9",
            "30205 B",
            "3205 A",
            "22228 C",
            "FAG 22215S",
            "7205 BECBP",
            "6205 MAX",
            "3207",
            "NU214",
        ),
        *("62/22", "62202-RS", "62202-2RS", "63002-RS", "6205 & 6203", "FAG NU 214", "KOYO 6205"),
    ],
)
def test_what_may_be_another_inner_design_is_refused(written: str) -> None:
    with pytest.raises(bd.InputError, match="there is no bearing"):
        find_bearing(written)


@pytest.mark.parametrize("written", ["FAG 6205", "Timken 6200", "HRB 6202"])
def test_a_maker_whose_list_does_not_have_the_bearing_is_refused(written: str) -> None:
    with pytest.raises(bd.InputError, match="differ in their inner designs"):
        find_bearing(written)


def test_every_line_is_found_by_its_name_and_by_that_in_its_list() -> None:
    for entry in LISTED:
        assert find_bearing(entry.name).name == entry.name
        if "14 535" in entry.source and not entry.kind.startswith("tapered unit"):
            assert find_bearing(entry.place).name == entry.name


@pytest.mark.parametrize(("written", "near"), [("6299", "6219"), ("7205", "7205B"), ("NJ214", "NU214E")])
def test_an_unknown_name_is_answered_with_the_nearest(written: str, near: str) -> None:
    with pytest.raises(bd.InputError, match=f"no bearing '{written}'.*nearest are.*{near}.*bpfo"):
        load_plate(written)


def test_a_designation_is_no_path_and_a_path_no_designation(tmp_path: Path) -> None:
    path = tmp_path / "6205.yaml"
    path.write_text("name: mine\nroller_count: 10\nroller_diameter_mm: 8\npitch_diameter_mm: 40\n")
    assert load_plate(str(path)).roller_count == 10
    with pytest.raises(bd.InputError, match="was not found"):
        load_plate(str(tmp_path / "6206.yaml"))


def test_bearings_are_found_by_dimensions_kind_and_maker() -> None:
    found = bd.catalogue(bore_mm=25, outside_mm=52)
    assert {"6205", "30205", "NU205E", "22205"} <= {each.name for each in found}
    assert {each.name for each in bd.catalogue(bore_mm=25, outside_mm=52, kind="cylindrical")} == {
        "NU205E",
        "NU2205E",
    }
    assert all("NSK" in (each.maker, *each.also_in) for each in bd.catalogue(kind="spherical", maker="nsk"))
    assert [each.name for each in bd.catalogue(bore_mm=130, width_mm=160)] == [
        "HS130x230",
        "WJ130x240",
    ]
    assert bd.catalogue(bore_mm=25, outside_mm=53) == ()
    assert len(bd.catalogue()) == len(ENTRIES)


def test_mistakes_of_a_search_are_all_said() -> None:
    with pytest.raises(bd.InputError) as caught:
        bd.catalogue(bore_mm=-1, outside_mm=0, kind="magnetic", maker="nobody")
    text = str(caught.value)
    for part in ("bore_mm is -1", "outside_mm is 0", "kind is 'magnetic'", "maker is 'nobody'", "SKF"):
        assert part in text


def test_mistakes_of_the_table_are_all_said_with_their_lines(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(config_folder() / "bearings", tmp_path / "bearings")
    shutil.copytree(config_folder() / "catalogue", tmp_path / "catalogue")
    table = tmp_path / "catalogue" / "bearings.csv"
    lines = table.read_text(encoding="utf-8").splitlines()[:4]
    row = "{},SKF,{},,1,,,,,,,,{},{},{},{},{},somewhere,,"
    lines += [
        row.format("A", "ball", 3.585, 5.415, 2.357, 0.398, "cwru"),
        row.format("B", "other", 3.585, 5.415, 4.714, 0.398, "cwru"),
        row.format("C", "other", 3.585, 5.315, 2.357, 0.398, "memory"),
    ]
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")
    monkeypatch.setenv("BEARDYN_CONFIG", str(tmp_path))
    with pytest.raises(bd.InputError) as caught:
        catalogue()
    text = str(caught.value)
    for part in ("line 5, A: kind is 'ball'", "line 6, B", "twice the spin", "line 7, C: source is 'memory'"):
        assert part in text
    assert find_bearing("6205").plate.roller_count == 9  # a mistake elsewhere does not stand in the way

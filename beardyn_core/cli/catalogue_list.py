"""``beardyn scenes catalogue``: bearings of the catalogue, all or those of some dimensions."""

from __future__ import annotations

import argparse
import shutil
from math import isnan
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.cli.catalogue_line import size_text
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.which_bearing import add_sizes, chosen_entries, size_options

if TYPE_CHECKING:
    from beardyn_core.bearing.catalogue_entry import CatalogueEntry

CATALOGUE, FORMER = "catalogue", "plates"  # an older name


def add_catalogue_options(parser: argparse.ArgumentParser) -> None:
    """Declare by what the bearings of the catalogue are chosen."""
    group = parser.add_argument_group("catalogue", "bearings by their dimensions; of `scenes catalogue`")
    add_sizes(group)


def refuse_sizes(args: argparse.Namespace) -> None:
    """Refuse dimensions where something else is listed."""
    if given := size_options(args):
        raise InputError(f"{', '.join(given)}: of `beardyn scenes catalogue`; list that, or leave it out")


def run_catalogue(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    found = chosen_entries(args)
    if args.json:
        print(json_text("scenes", {CATALOGUE: [entry_object(each) for each in found]}))
        return 0
    print("catalogue (of measured files: beardyn monitor FILE --bearing NAME)")
    for each in found:
        print(_line(each))
    if size_options(args):
        print(f"{len(found)} of the catalogue have these dimensions, kind and maker")
    return 0


def entry_object(entry: CatalogueEntry) -> dict[str, Any]:
    """Describe a bearing of the catalogue, SI; null is what is not known."""
    plate = entry.plate
    return {
        "name": entry.name,
        "purpose": plate.description,
        "kind": entry.kind,
        "maker": entry.maker or None,
        "rows": entry.rows,
        "bore_m": entry.bore,
        "outer_diameter_m": entry.outer_diameter,
        "width_m": entry.width,
        "roller_count": plate.roller_count or None,
        "roller_diameter_m": plate.roller_diameter,
        "pitch_diameter_m": plate.pitch_diameter,
        "contact_angle_rad": plate.contact_angle,
        "fault_frequencies_per_rev": plate.frequencies.by_name,
        "from_inner_dimensions": plate.has_dimensions,
        "source": entry.source,
        "place": entry.place,
        "size_source": entry.size_source or None,
        "also_in": entry.also_in,
    }


def _line(entry: CatalogueEntry) -> str:
    orders = entry.plate.frequencies
    values = " ".join(
        f"{symbol} {'    ?' if isnan(value) else f'{value:6.3f}'}"
        for symbol, value in (
            ("BPFO", orders.bpfo), ("BPFI", orders.bpfi), ("BSF", orders.bsf), ("FTF", orders.ftf),
        )
    )  # fmt: skip
    about = ", ".join(each for each in (entry.maker, entry.kind, entry.about) if each)
    line = f"  {entry.name:14} {size_text(entry):28} {values}  {about}"
    return line[: max(shutil.get_terminal_size((140, 24)).columns, 120)].rstrip()

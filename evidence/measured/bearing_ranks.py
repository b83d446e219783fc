"""The place of the true bearing among those that fit: ``python -m evidence.measured.bearing_ranks``.

The speed is stated, 3 % uncertain, as with ``--speed-rpm``; once every bearing of the catalogue is compared,
once those of the true bore and outside diameter.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from beardyn_core.bearing.catalogue_entry import CatalogueEntry
from beardyn_core.config.catalogue import catalogue, find_bearing, search_catalogue
from beardyn_core.measured.stated_speed import UNCERTAINTY
from beardyn_core.monitor.bearing_search import SEARCH_SETTINGS, BearingSearchResult
from beardyn_core.monitor.chain import Stretch
from beardyn_core.study.fitting_bearing import bearing_search
from evidence.measured.cases import Listening, listenings, records

SETTINGS = replace(SEARCH_SETTINGS, speed_uncertainty=UNCERTAINTY)


def searched(listening: Listening, entries: Sequence[CatalogueEntry]) -> BearingSearchResult:
    """Compare bearings with a record, window by window."""
    search = bearing_search(entries)
    count = int(SETTINGS.window_revolutions * listening.rate / listening.shaft_frequency)
    orders = listening.plate.frequencies
    for first in range(0, max(1, len(listening.acceleration) - count + 1), count):
        signal = listening.acceleration[first : first + count, None]
        angle = np.arange(len(signal), dtype=np.float64) * (
            2.0 * np.pi * listening.shaft_frequency / listening.rate
        )
        search(Stretch(listening.rate, signal, angle, np.nan, 0), orders, 0, SETTINGS)
    return search.conclude()


def place_of(name: str, found: BearingSearchResult) -> int:
    """Find the place of a bearing among those that fit, from 1; 0 where it is not among them."""
    names = [each.name for each in found.fits]
    return names.index(name) + 1 if name in names else 0


def main(arguments: Sequence[str] | None = None) -> int:
    """Search the records and print each, and how often the true bearing fits."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--cwru", type=Path, metavar="FOLDER", help="with the .mat files of CWRU")
    parser.add_argument("--mfpt", type=Path, metavar="FOLDER", help="with the .mat files of MFPT")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="every Nth record; default all")
    args = parser.parse_args(arguments)
    rows: list[tuple[str, BearingSearchResult, int, BearingSearchResult, int]] = []
    print(
        "| record | part | bearing | comb | fit | place | of its size | place |\n"
        "|---|---|---|--:|--:|--:|--:|--:|"
    )
    for record in records(args.cwru, args.mfpt)[:: args.every]:
        listening = next(listenings(record))
        entry = find_bearing(listening.plate.name)
        sized = (
            search_catalogue(bore=entry.bore, outer_diameter=entry.outer_diameter)
            if entry.bore == entry.bore
            else catalogue()
        )
        whole, alike = searched(listening, catalogue()), searched(listening, sized)
        places = place_of(entry.name, whole), place_of(entry.name, alike)
        rows.append((listening.part, whole, places[0], alike, places[1]))
        print(
            f"| {record.name} | {listening.part or 'healthy'} | {entry.name} | {whole.comb_order:.3f} | "
            f"{len(whole.fits)} | {places[0] or '-'} | {len(alike.fits)} | {places[1] or '-'} |",
            flush=True,
        )
    for part in ("cup", "cone", "roller", ""):
        own = [row for row in rows if row[0] == part]
        found = [row for row in own if row[1].fits]
        print(
            f"{part or 'healthy'}: {len(own)} records, {len(found)} with bearings that fit; the true one "
            f"among them in {sum(row[2] > 0 for row in found)}, among the first five in "
            f"{sum(0 < row[2] <= 5 for row in found)}; of its size first in "
            f"{sum(row[4] == 1 for row in own)}"
        )
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

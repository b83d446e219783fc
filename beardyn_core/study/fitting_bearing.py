"""Bearings of the catalogue that fit the vibration of a run or of measured files."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.catalogue_entry import CatalogueEntry
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.measured.about import Mounted
from beardyn_core.measured.stated_speed import recorded_uncertainty, uncertainty_of
from beardyn_core.measured.survey import Survey
from beardyn_core.measured.watching import watch
from beardyn_core.monitor.bearing_search import SEARCH_SETTINGS, BearingSearch, BearingSearchResult
from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.record.reading import read_run
from beardyn_core.record.run import Run
from beardyn_core.study.monitored_recording import results_of

# a monitor is one of a bearing; a search looks at none of its numbers
_ANY = NamePlate(name="any bearing", roller_count=9, roller_diameter=8e-3, pitch_diameter=40e-3)


def bearing_search(entries: Sequence[CatalogueEntry]) -> BearingSearch:
    """Make the search over bearings of the catalogue.

    Raises
    ------
    InputError
        There is none.
    """
    if not entries:
        raise InputError(
            "no bearing of the catalogue has these dimensions, kind and maker; `beardyn scenes catalogue` "
            "lists all"
        )
    return BearingSearch({each.name: each.plate.frequencies for each in entries})


def search_in_run(
    run: Run | Path | str, search: BearingSearch, sensor: str = "", settings: MonitorSettings | None = None
) -> BearingSearchResult:
    """Search in the vibration of a run or a recording.

    Raises
    ------
    InputError
        It has no vibration with the speed of the shaft, or no such sensor.
    """
    run = run if isinstance(run, Run) else read_run(run)
    settings = settings or replace(SEARCH_SETTINGS, speed_uncertainty=recorded_uncertainty(run.measured))
    for _ in results_of(run, _ANY, search, settings, sensor):
        pass
    return search.conclude()


def search_in_files(
    survey: Survey,
    search: BearingSearch,
    settings: MonitorSettings | None = None,
    warnings: list[str] | None = None,
) -> BearingSearchResult:
    """Search in the vibration of measured files, the first accelerometer of them."""
    settings = settings or replace(SEARCH_SETTINGS, speed_uncertainty=uncertainty_of(survey))
    for _ in watch(survey, (Mounted("bearing", _ANY),), search, settings, warnings):
        pass
    return search.conclude()

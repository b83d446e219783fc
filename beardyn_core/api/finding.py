"""Find bearings: in the catalogue by dimensions, and those that fit a vibration."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from beardyn_core.bearing.catalogue_entry import CatalogueEntry
    from beardyn_core.monitor.bearing_search import BearingSearchResult
    from beardyn_core.monitor.chain import MonitorSettings
    from beardyn_core.record.run import Run


def catalogue(
    *,
    bore_mm: float | None = None,
    outside_mm: float | None = None,
    width_mm: float | None = None,
    kind: str = "",
    maker: str = "",
) -> tuple[CatalogueEntry, ...]:
    """List the bearings of the catalogue, all or those of some dimensions, kind and maker.

    Parameters
    ----------
    bore_mm : float, optional
        Bore of the bearings, to 0.05 mm; default any.
    outside_mm : float, optional
        Outside diameter of the bearings, to 0.05 mm; default any.
    width_mm : float, optional
        Width of their inner ring, to 0.05 mm; default any.
    kind : str
        Kind that a bearing must have, such as tapered roller, or a word of it; default any.
    maker : str
        Maker whose list or data sheet the numbers are from, or who lists the same; default any.

    Returns
    -------
    tuple of CatalogueEntry
        With data, dimensions [m], maker and sources.

    Raises
    ------
    InputError
        With every mistake.

    Examples
    --------
    >>> [entry.name for entry in catalogue(bore_mm=25, outside_mm=52, kind="cylindrical")]
    ['NU2205E', 'NU205E']
    """
    from beardyn_core.config.catalogue import search_catalogue

    sizes = [None if each is None else 1e-3 * each for each in (bore_mm, outside_mm, width_mm)]
    return search_catalogue(bore=sizes[0], outer_diameter=sizes[1], width=sizes[2], kind=kind, maker=maker)


def which_bearing(
    run: Run | Path | str,
    *,
    sensor: str = "",
    settings: MonitorSettings | None = None,
    bore_mm: float | None = None,
    outside_mm: float | None = None,
    width_mm: float | None = None,
    kind: str = "",
    maker: str = "",
) -> BearingSearchResult:
    """Find the bearings of the catalogue whose orders fit the combs of strikes in a vibration.

    Parameters
    ----------
    run : Run or Path
        With the speed of the shaft; which bearing it is of is not needed.
    sensor : str, optional
        Accelerometer to take; by default the first.
    settings : MonitorSettings, optional
    bore_mm, outside_mm, width_mm, kind, maker
        Which bearings are compared; see `catalogue`.

    Returns
    -------
    BearingSearchResult
        One fits, several fit equally, none fits, or cannot tell: a healthy bearing has no comb.

    Raises
    ------
    InputError
        With every mistake, or where no bearing of the catalogue has such dimensions.
    """
    from beardyn_core.study.fitting_bearing import bearing_search, search_in_run

    several = catalogue(bore_mm=bore_mm, outside_mm=outside_mm, width_mm=width_mm, kind=kind, maker=maker)
    return search_in_run(run, bearing_search(several), sensor, settings)

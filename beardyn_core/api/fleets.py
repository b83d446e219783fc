"""A fleet: recordings of many axleboxes in a store, ranked by who needs attention."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.fleet.health import HealthSettings
    from beardyn_core.fleet.intake import Intake
    from beardyn_core.fleet.ranking import FleetStatus
    from beardyn_core.follow.growth import GrowthLaw

Inputs = Path | str | Sequence[Path | str]


def fleet(store: Path | str) -> Fleet:
    """Keep recordings of many axleboxes in a store, and rank which one needs attention, since when and why.

    Parameters
    ----------
    store : Path
        File of the store. `add` makes it.

    Returns
    -------
    Fleet

    Examples
    --------
    >>> import beardyn_core as bd
    >>> boxes = bd.fleet("fleet.sqlite")
    >>> boxes.add("recordings", pattern="{vehicle}/{axle}_{side}/{date}.csv")  # doctest: +SKIP
    >>> boxes.status().standings[0].axlebox  # doctest: +SKIP
    """
    return Fleet(store)


class Fleet:
    """The axleboxes of a store.

    Parameters
    ----------
    store : Path
    """

    def __init__(self, store: Path | str) -> None:
        self.store = Path(store)

    def add(
        self,
        inputs: Inputs,
        *,
        manifest: Path | str | None = None,
        pattern: str = "",
        estimator: str = "shipped",
        workers: int | None = None,
        scheduler: str = "",
        tls: Mapping[str, str | Path] | None = None,
        progress: Callable[[int, int], None] | None = None,
        say: Callable[[str], None] = lambda _: None,
        warnings: list[str] | None = None,
        **defaults: Any,
    ) -> Intake:
        """Add recordings to the store: which axlebox each is of, and its verdict.

        Parameters
        ----------
        inputs : Path or sequence of Path
            Folders and files of any format that `read_measured` takes, and recordings of the twin.
        manifest : Path, optional
            CSV or YAML file with a line for each recording; default manifest.csv or manifest.yaml in each
            folder.
        pattern : str
            How the path names the axlebox of a file, such as {vehicle}/{axle}_{side}/{date}.csv;
            default none.
        estimator : str
            File of an estimator that reads load and width too, shipped for one of the user's own or a
            shipped one for the bearing, or none.
        workers : int, optional
            Processes of this machine that analyse recordings; default 1. One process writes the store.
        scheduler : str, optional
            Address of the Dask scheduler whose workers analyse them and read the files by the same paths,
            tcp://host:8786; default this machine.
        tls : mapping, optional
            ``ca``, ``cert`` and ``key``: files that a scheduler at ``tls://`` is reached with.
        progress : callable, optional
            Called with how many are done, and of how many there are.
        say : callable, optional
            Called with sentences about workers that come and go.
        warnings : list of str, optional
            Files that were left out are added to it, a sentence each.
        **defaults
            Columns of every line that does not have them, such as ``bearing`` or ``speed_rpm``.

        Raises
        ------
        InputError
            With every mistake and contradiction; then nothing is added.
        """
        from beardyn_core.api.sweeping import cluster_of
        from beardyn_core.fleet.intake import add_recordings
        from beardyn_core.fleet.manifest import list_recordings
        from beardyn_core.fleet.store import open_store

        cluster = cluster_of(workers, scheduler, tls, None)
        if problems := cluster.problems() if scheduler or tls else cluster.worker_problems():
            raise InputError(problems)
        if workers is None and not scheduler:
            cluster = replace(cluster, workers=1)
        paths = [inputs] if isinstance(inputs, str | Path) else list(inputs)
        listed = list_recordings(
            [Path(each) for each in paths],
            manifest=None if manifest is None else Path(manifest),
            pattern=pattern,
            defaults=defaults,
        )
        if warnings is not None:
            warnings += listed.warnings
        with open_store(self.store, write=True, make=True) as store:
            return add_recordings(
                store, listed.recordings, estimator=estimator, cluster=cluster, progress=progress, say=say
            )

    def status(
        self,
        *,
        as_of: str = "",
        settings: HealthSettings | None = None,
        law: GrowthLaw | None = None,
    ) -> FleetStatus:
        """Rank the axleboxes: which one needs attention, why, since when and what to do.

        Parameters
        ----------
        as_of : str
            Date or time that the list is of, or today; later recordings are left aside; default that of the
            latest recording.
        settings : HealthSettings, optional
        law : GrowthLaw, optional
            Of spalls; its rates are assumed, so give those of the fleet.
        """
        from beardyn_core.fleet.ranking import rank_fleet
        from beardyn_core.fleet.store import open_store

        at = None if not as_of else _time("as_of", as_of)
        with open_store(self.store) as store:
            return rank_fleet(store, as_of=at, settings=settings, law=law)

    def report(
        self,
        html: Path | str,
        *,
        as_of: str = "",
        law: GrowthLaw | None = None,
        pages: int = 100,
        force: bool = False,
    ) -> FleetStatus:
        """Write a page: the ranked list, and for each axlebox over `watch` the evidence.

        Parameters
        ----------
        html : Path
            HTML file to write; it needs no other file.
        as_of, law
            See `status`.
        pages : int
            Axleboxes at most that have a page of their own, the first of the list; default 100.
        force : bool
            Replace the file when it exists; default refuse.
        """
        from beardyn_core.base.optional import missing
        from beardyn_core.base.outputs import file_problems
        from beardyn_core.fleet.ranking import rank_fleet
        from beardyn_core.fleet.store import open_store

        path = Path(html)
        problems = missing("matplotlib", "--html", "plot")
        if pages < 0:
            problems.append(f"--pages is {pages}; it must be at least 0")
        problems += file_problems("--html", path, inputs=[self.store], force=force, ending=".html")
        if problems:
            raise InputError(problems)
        from beardyn_core.fleet.page import write_fleet_page

        at = None if not as_of else _time("as_of", as_of)
        with open_store(self.store) as store:
            status = rank_fleet(store, as_of=at, law=law)
            write_fleet_page(store, status, path, most=pages, force=force)
        return status

    def acknowledge(self, vehicle: str, axle: str, side: str, *, by: str, note: str = "") -> str:
        """Acknowledge the health of now of an axlebox: it stays in the list, after those that nobody has.

        Parameters
        ----------
        vehicle, axle, side : str
            Which axlebox.
        by : str
            Who acknowledges it.
        note : str
            What was found or will be done; default none.

        Returns
        -------
        str
            What was acknowledged, in a sentence.

        Raises
        ------
        InputError
            There is no such axlebox, or nothing to acknowledge.
        """
        from beardyn_core.fleet.health import ACT, PLAN, WATCH
        from beardyn_core.fleet.ranking import find_standing, rank_fleet
        from beardyn_core.fleet.store import ACKNOWLEDGED, Entry, open_store

        box = _axlebox(vehicle, axle, side)
        if not by.strip():
            raise InputError("--by is empty; give the name of who acknowledges")
        with open_store(self.store, write=True) as store:
            standing = find_standing(rank_fleet(store), box)
            health = standing.health
            if health.state not in (WATCH, PLAN, ACT):
                raise InputError(
                    f"{box.name}: is {health.state.replace('_', ' ')}; there is nothing to acknowledge"
                )
            store.enter(
                Entry(
                    ACKNOWLEDGED,
                    box,
                    _now(),
                    standing.last.mileage,
                    by.strip(),
                    note,
                    health.state,
                    health.raised,
                )
            )
        return f"{box.name}: {health.state} acknowledged by {by.strip()}; it counts until the state changes"

    def exchanged(
        self, vehicle: str, axle: str, side: str, *, time: str, mileage_km: float | None = None,
        by: str = "", note: str = "",
    ) -> str:  # fmt: skip
        """Enter the exchange of a bearing: its axlebox starts anew from then on.

        Parameters
        ----------
        vehicle, axle, side : str
            Which axlebox.
        time : str
            Date or time of the exchange.
        mileage_km : float, optional
            Mileage of the axlebox then, km; default not known.
        by, note : str
            Who did it, and what was found; default none.
        """
        from math import nan

        from beardyn_core.fleet.ranking import find_standing, rank_fleet
        from beardyn_core.fleet.store import EXCHANGED, Entry, open_store

        box, at = _axlebox(vehicle, axle, side), _time("time", time)
        if at > _now() + 86_400.0:
            raise InputError(f"time is {time}, in the future; give when the bearing was exchanged")
        with open_store(self.store, write=True) as store:
            find_standing(rank_fleet(store), box)
            mileage = nan if mileage_km is None else 1e3 * mileage_km
            store.enter(Entry(EXCHANGED, box, at, mileage, by, note))
        return f"{box.name}: bearing exchanged on {time}; recordings before that no longer count"


def _axlebox(vehicle: str, axle: str, side: str) -> Any:
    from beardyn_core.fleet.identity import SIDES, Axlebox

    if side.lower() not in SIDES:
        raise InputError(f"side is {side!r}; it must be left or right")
    return Axlebox(str(vehicle), str(axle), SIDES[side.lower()])


def _time(key: str, text: str) -> float:
    from beardyn_core.fleet.identity import read_time

    if text == "today":
        return _now()
    try:
        return read_time(text)
    except ValueError:
        raise InputError(f"{key} is {text!r}; write it as 2026-03-01 or 2026-03-01T14:05:00") from None


def _now() -> float:
    import time

    return time.time()

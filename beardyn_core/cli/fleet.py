"""``beardyn fleet``: recordings of many axleboxes in a store, and one ranked list."""

from __future__ import annotations

import argparse
import sys
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.api.fleets import Fleet, fleet
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.plain_json import keyed_fields
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.growth_option import add_growth, growth_of
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import add_reading
from beardyn_core.cli.options import add_force, add_json, add_tls, tls_of

if TYPE_CHECKING:
    from beardyn_core.fleet.ranking import FleetStatus, Standing

SOME_REFUSED = 3
_IDENTITY = {
    "vehicle": "name or number of the vehicle",
    "axle": "name or number of the axle",
    "side": "left or right",
    "time": "begin of the recording, as 2026-03-01 or 2026-03-01T14:05:00, UTC without a zone",
    "bearing": "designation of the catalogue, shipped bearing or YAML file",
    "sensor": "accelerometer in the file",
    "train": "whose axleboxes ride together",
}


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command and what it does."""
    more = "First `fleet add`, then `fleet status` or `fleet report`; docs/fleet.md explains all."
    parser = add_command(subparsers, "fleet", fleet, more)
    parts = parser.add_subparsers(metavar="ACTION", required=True, help="one of add, status, report, ...")
    _add_add(parts)
    _add_status(parts)
    _add_report(parts)
    _add_acknowledge(parts)
    _add_exchanged(parts)


def _add_store(parser: argparse.ArgumentParser) -> None:
    add_parameter(parser, fleet, "store", metavar="STORE", required=True, type=Path)


def _add_add(parts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = add_command(parts, "add", Fleet.add)
    add_parameter(parser, Fleet.add, "inputs", "inputs", metavar="FOLDER_OR_FILE", nargs="+", type=Path)
    _add_store(parser)
    add_parameter(parser, Fleet.add, "manifest", metavar="FILE")
    add_parameter(parser, Fleet.add, "pattern", metavar="PATTERN", type=str)
    add_parameter(parser, Fleet.add, "estimator", metavar="FILE", type=str)
    add_parameter(
        parser, Fleet.add, "workers", metavar="N", type=int, default=None, usual="as many as processors"
    )
    add_parameter(parser, Fleet.add, "scheduler", metavar="ADDR")
    add_tls(parser)
    group = parser.add_argument_group("identity", "of every file that neither manifest nor path names")
    for name, words in _IDENTITY.items():
        metavar = "TIME" if name == "time" else "NAME"
        group.add_argument(f"--{name}", metavar=metavar, default="", help=f"{words}; default none")
    add_json(parser)
    add_reading(parser)
    parser.set_defaults(run=run_add)


def _add_status(parts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = add_command(parts, "status", Fleet.status)
    _add_store(parser)
    add_parameter(parser, Fleet.status, "as_of", metavar="TIME", type=str)
    add_growth(parser)
    parser.add_argument("--all", action="store_true", help="list the axleboxes that are ok too; default not")
    add_json(parser)
    parser.set_defaults(run=run_status)


def _add_report(parts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = add_command(parts, "report", Fleet.report)
    _add_store(parser)
    add_parameter(parser, Fleet.report, "html", metavar="FILE.html", required=True)
    add_parameter(parser, Fleet.status, "as_of", metavar="TIME", type=str)
    add_growth(parser)
    add_parameter(parser, Fleet.report, "pages", metavar="N")
    add_force(parser, "replace the file when it exists; default refuse")
    parser.set_defaults(run=run_report)


def _add_who(parser: argparse.ArgumentParser) -> None:
    for name in ("vehicle", "axle"):
        parser.add_argument(name, metavar=name.upper(), help=f"name or number of the {name}, as in the list")
    parser.add_argument("side", metavar="SIDE", help="left or right")
    _add_store(parser)


def _add_acknowledge(parts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = add_command(parts, "acknowledge", Fleet.acknowledge)
    _add_who(parser)
    parser.add_argument("--by", metavar="NAME", required=True, help="who acknowledges it; no default")
    add_parameter(parser, Fleet.acknowledge, "note", metavar="TEXT", type=str)
    parser.set_defaults(run=run_acknowledge)


def _add_exchanged(parts: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = add_command(parts, "exchanged", Fleet.exchanged)
    _add_who(parser)
    add_parameter(parser, Fleet.exchanged, "time", metavar="TIME", required=True, type=str)
    add_parameter(parser, Fleet.exchanged, "mileage_km", metavar="KM")
    parser.add_argument("--by", metavar="NAME", default="", help="who did it; default none")
    parser.add_argument("--note", metavar="TEXT", default="", help="what was found; default none")
    parser.set_defaults(run=run_exchanged)


def run_add(args: argparse.Namespace) -> int:
    """Run ``fleet add``; gives the exit code."""
    from tqdm import tqdm

    from beardyn_core.base.edge import places
    from beardyn_core.cli.measured_options import reading_of
    from beardyn_core.experiments import core_count
    from beardyn_core.measured.options import Reading

    reading_of(args)  # with mistakes in the words of options
    given = {place.key: getattr(args, f"measured_{place.key}") for place in places(Reading)}
    defaults = {key: value for key, value in given.items() if value not in (None, [])}
    if "channels" in defaults:
        defaults["channels"] = ",".join(defaults["channels"])
    defaults |= {name: value for name in _IDENTITY if (value := getattr(args, name))}
    workers = core_count() if args.workers is None and not args.scheduler else args.workers
    warnings: list[str] = []
    kept = [0]
    with tqdm(total=None, desc="analysed", unit=" recordings", disable=None, leave=False) as bar:

        def progress(done: int, total: int) -> None:
            kept[0] = done
            bar.total = total
            bar.update(done - bar.n)

        with last_words(lambda: f"{kept[0]} recordings are done and kept; the same command goes on"):
            found = Fleet(args.store).add(
                args.inputs,
                manifest=args.manifest,
                pattern=args.pattern,
                estimator=args.estimator,
                workers=workers,
                scheduler=args.scheduler,
                tls=tls_of(args),
                say=lambda text: print(f"beardyn: {text}", file=sys.stderr, flush=True),
                progress=progress,
                warnings=warnings,
                **defaults,
            )
    for sentence in warnings:
        print(f"beardyn: warning: {sentence}", file=sys.stderr)
    for sentence in found.refused:
        print(f"beardyn: not added: {sentence}", file=sys.stderr)
    if args.json:
        content = {"store": args.store, "added": found.added, "known": found.known, "refused": found.refused}
        print(json_text("fleet add", {**content, "warnings": warnings}))
    else:
        print(
            f"{args.store}: {found.added} recordings added, {found.known} were there, "
            f"{len(found.refused)} refused"
        )
    return SOME_REFUSED if found.refused else 0


def run_status(args: argparse.Namespace) -> int:
    """Run ``fleet status``; gives the exit code, which the worst axlebox decides."""
    status = Fleet(args.store).status(as_of=args.as_of, law=growth_of(args))
    if args.json:
        print(json_text("fleet status", status_object(status)))
    else:
        print("\n".join(status_lines(status, everything=args.all)))
    return status.exit_code


def run_report(args: argparse.Namespace) -> int:
    """Run ``fleet report``; gives the exit code."""
    Fleet(args.store).report(
        args.html, as_of=args.as_of, law=growth_of(args), pages=args.pages, force=args.force
    )
    print(args.html)
    return 0


def run_acknowledge(args: argparse.Namespace) -> int:
    """Run ``fleet acknowledge``; gives the exit code."""
    print(Fleet(args.store).acknowledge(args.vehicle, args.axle, args.side, by=args.by, note=args.note))
    return 0


def run_exchanged(args: argparse.Namespace) -> int:
    """Run ``fleet exchanged``; gives the exit code."""
    told = Fleet(args.store).exchanged(
        args.vehicle, args.axle, args.side,
        time=args.time, mileage_km=args.mileage_km, by=args.by, note=args.note,
    )  # fmt: skip
    print(told)
    return 0


def status_lines(status: FleetStatus, *, everything: bool = False) -> list[str]:
    """Write the ranked list for a terminal."""
    from beardyn_core.fleet.identity import write_date, write_time

    told = ", ".join(
        f"{count} {state.replace('_', ' ')}" for state, count in status.counts().items() if count
    )
    lines = [f"{len(status.standings)} axleboxes on {write_time(status.as_of)} UTC: {told}"]
    shown = [each for each in status.standings if everything or each.health.state != "ok"]
    width = max((len(each.axlebox.name) for each in shown), default=0)
    for each in shown:
        health = each.health
        state = health.state.replace("_", " ").upper()
        mark = f", acknowledged by {each.acknowledged.made_by}" if each.acknowledged else ""
        since = ""
        if isfinite(health.since):
            since = f" since {write_date(health.since)}"
            since += f", {health.since_mileage / 1e3:,.0f} km" if isfinite(health.since_mileage) else ""
        lines.append(
            f"{each.rank:4}  {each.axlebox.name:{width}}  {state}{mark}{since}; "
            f"last recording {write_date(each.last.time)}"
        )
        lines += [f"{'':8}{sentence}" for sentence in (*health.why, *(f"note: {n}" for n in health.notes))]
        if health.part:
            lines += [f"{'':8}{sentence}" for sentence in each.left.sentences]
        if health.state != "ok":
            lines.append(f"{'':8}do: {each.advice}")
    if hidden := len(status.standings) - len(shown):
        lines.append(f"{hidden} axleboxes are ok; --all lists them")
    return lines


def status_object(status: FleetStatus) -> dict[str, Any]:
    """Gather what ``--json`` prints of the ranked list."""
    return {
        "as_of_s": status.as_of,
        "recordings": status.recordings,
        "counts": status.counts(),
        "axleboxes": [_standing_object(each) for each in status.standings],
    }


def _standing_object(standing: Standing) -> dict[str, Any]:
    health, last, left, entry = standing.health, standing.last, standing.left, standing.acknowledged
    return {
        "rank": standing.rank,
        **standing.axlebox._asdict(),
        "bearing": standing.bearing,
        "health": health.state,
        "part": health.part or None,
        "since_s": health.since,
        "since_mileage_m": health.since_mileage,
        "why": health.why,
        "notes": health.notes,
        "do": standing.advice,
        "level_rise_dB": health.rise,
        "recordings": standing.recordings,
        "last_recording_s": last.time,
        "last_mileage_m": last.mileage,
        "last_verdict": last.analysis.verdict,
        "spall_width_m": last.analysis.width,
        "mileage_left_m": left.distance if left.is_known else None,
        "mileage_left_dates_s": left.dates if left.is_known else None,
        "mileage_left": left.sentence if health.part else None,
        "mileage_left_span_m": left.span if health.part else None,
        "mileage_left_span_dates_s": left.span_dates if health.part else None,
        "growth_laws": [
            keyed_fields(each, distance="mileage_left_m", dates="mileage_left_dates_s") for each in left.laws
        ],
        "assumed": left.assumed,
        "acknowledged": None
        if entry is None
        else {"by": entry.made_by, "time_s": entry.time, "note": entry.note},
    }

"""Write docs/evidence/learner.md: ``python -m evidence.population.page FOLDER --measured DATA``.

FOLDER holds the set ``spalls`` (``beardyn sweep spalls -o FOLDER/spalls``; else it is made, with as many
runs as ``--trained`` says) and gets the sets that the learner is tested on besides; DATA is a folder with the
public records, which are not ours to give. Cut off, the same command goes on.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from beardyn_core.base.outputs import write_whole
from beardyn_core.config.automatic import AUTO
from beardyn_core.population.features import NAMES, TRANSFERABLE
from beardyn_core.population.labelled_set import TRAIN, LabelledSet
from beardyn_core.population.learner import Learner
from beardyn_core.study.table import Column, Table
from evidence.pages import PICTURES, REPORTS, render, save_small
from evidence.population import scale
from evidence.population.causes import causes
from evidence.population.measured import collection_of, features_of_records, records
from evidence.population.sets import OTHERS, TRAINED, other_set, trained_set
from evidence.runner import read_json, write_json

PAGE, PICTURE = REPORTS / "learner.md", PICTURES / "population.png"
MARK = "<!-- from here on written by python -m evidence.population.page -->"
FEATURES = {"all features": NAMES, "features that compare a signal with itself": TRANSFERABLE}
CHANCE = 0.25
LEARNER = "learner"


def main(words: Sequence[str] | None = None) -> int:
    """Measure, and write the page and its picture."""
    parser = argparse.ArgumentParser(prog="python -m evidence.population.page", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument(
        "--measured", type=Path, metavar="DATA", help="without it no measured record is judged"
    )
    parser.add_argument("--runs", type=int, default=96, metavar="N", help="of each further set (96)")
    parser.add_argument(
        "--trained", type=int, metavar="N", help=f"of {TRAINED}, where it is to be made (as its file says)"
    )
    parser.add_argument("--workers", type=int, metavar="N", help="default one for each core")
    parser.add_argument("--sets", default=",".join(OTHERS), help="further sets, with commas between")
    parser.add_argument(
        "--parts",
        default=",".join((LEARNER, *scale.PARTS)),
        help="what is measured, with commas between; the rest as FOLDER/population.json has it",
    )
    arguments = parser.parse_args(words)
    parts, known = arguments.parts.split(","), arguments.folder / "population.json"
    trained = trained_set(arguments.folder, arguments.trained, arguments.workers)
    names = [name for name in arguments.sets.split(",") if name]
    others = {name: other_set(name, arguments.folder, arguments.runs, arguments.workers) for name in names}
    found = {} if set(parts) >= {LEARNER, *scale.PARTS} else read_json(known)
    if LEARNER in parts:
        found["gap"] = judgements(trained, others, arguments.measured)
        found["causes"] = causes(trained)
        found["trained"] = len(trained.runs_of(TRAIN))
        base = trained.about["identity"]["base"]
        found["tier"], found["effects"] = base["tier"], base["effects"].get("name", AUTO)
    for name, measure in scale.PARTS.items():
        if name in parts:
            found[name] = measure(trained)
    write_json(known, found)
    write_page(found)
    return 0


def judgements(
    trained: LabelledSet, others: dict[str, LabelledSet], measured: Path | None
) -> list[dict[str, Any]]:
    """Judge the learner, with each choice of features, by all that it has not seen."""
    rigs = [] if measured is None else list(records(measured))
    known = {
        name: features_of_records([each for each in rigs if collection_of(each) == name])
        for name in dict.fromkeys(collection_of(each) for each in rigs)
    }
    rows = []
    for kind, names in FEATURES.items():
        learner = Learner(names).fit(trained)
        tests = [learner.judged("unseen bearings", trained)]
        tests += [learner.judged(name, runs, None) for name, runs in others.items()]
        tests += [
            learner.judged_by(f"measured: {name}", features, truth)
            for name, (features, truth) in known.items()
        ]
        rows += [{"features": kind, **asdict(test)} for test in tests]
    return rows


def write_page(found: dict[str, Any]) -> None:
    """Write the part of the page that is measured, and draw its picture."""
    text = PAGE.read_text(encoding="utf-8").partition(MARK)[0].rstrip()
    write_whole(PAGE, f"{text}\n\n{MARK}\n\n{section(found)}")
    draw(found, PICTURE)


def section(found: dict[str, Any]) -> str:
    """Write the part of the page that is measured."""
    gap, made, causes, cores = found["gap"], found["made"], found["causes"], found["cores"]
    measured = dict.fromkeys(row["name"] for row in gap if row["name"].startswith("measured"))
    matrices = [
        next(r for r in gap if r["name"] == name and r["features"] != "all features") for name in measured
    ]
    values = {
        "trained": found["trained"],
        "sweep": TRAINED,
        "tier": found["tier"],
        "effects": found["effects"],
        "chance": 100 * CHANCE,
        "judged": _gap_table(gap),
        "gaps": _gaps(gap),
        "unseen": 100 * next(row for row in gap if row["name"] == "unseen bearings")["balanced"],
        "tier_matters": _tier_matters(gap),
        "matrices": [(row["name"].partition(": ")[2], _matrix(row)) for row in matrices],
        "by_lines": ", ".join(f"{name}: {100 * share:.0f} %" for name, share in causes["lines"].items()),
        "by_size": ", ".join(
            f"{100 * share:.0f} % of {count} runs" for count, share in causes["sizes"].items()
        ),
        "widths": _widths(causes["widths"]),
        "made": made,
        "busy_min": made["worker_s"] / made["processes"] / 60.0,
        "megabytes": made["bytes_a_run"] / 1e6,
        "cores": _cores(cores),
        "efficiency": _efficiency(cores),
        "slow_s": scale.SLOW_S,
        "engine": _engine(found["engine"]),
        "a_run": _a_run(cores[0]),
        "least_busy": 100 * _least_busy(found),
        "most_cores": cores[0]["processor_s"] / cores[0]["besides_s"],
        "paper": _paper(found),
        "batch": scale.BATCH,
        "formats": _formats(found["formats"]),
    }
    return render(__file__, values)


def _widths(widths: list[dict[str, Any]]) -> Table:
    columns: list[Column] = [
        (
            "width of the spall",
            lambda row: f"{row['low']:g} to {row['high']:g} mm" if row["high"] else "healthy",
        ),
        ("runs", lambda row: str(row["runs"])),
        ("named right", lambda row: f"{100 * row['right']:.0f} %"),
    ]
    return Table.of("", widths, columns)


def _gaps(gap: list[dict[str, Any]]) -> Table | None:
    """Tell the gap between simulated and measured: what is lost of the balanced accuracy."""
    collections = dict.fromkeys(row["name"] for row in gap if row["name"].startswith("measured"))
    if not collections:
        return None
    shares = {(row["name"], row["features"]): 100.0 * row["balanced"] for row in gap}
    rows = []
    for kind in FEATURES:
        own = shares["unseen bearings", kind]
        lost = [f"**{own - shares[name, kind]:.0f} points**" for name in collections]
        rows.append((kind, f"{own:.0f} %", *lost))
    names = [f"gap to {name.partition(': ')[2]}" for name in collections]
    return Table("", ("features", "unseen simulated bearings", *names), tuple(rows))


def _tier_matters(gap: list[dict[str, Any]]) -> bool:
    """Tell whether another tier costs more than other speeds."""
    shares = {row["name"]: row["balanced"] for row in gap if row["features"] == "all features"}
    return bool(shares.get("another tier", 1.0) < shares.get("other speeds", 0.0))


def _gap_table(gap: list[dict[str, Any]]) -> Table:
    kinds = list(dict.fromkeys(row["features"] for row in gap))
    rows = []
    for name in dict.fromkeys(row["name"] for row in gap):
        own = {row["features"]: row for row in gap if row["name"] == name}
        cells = [
            f"{100 * own[kind]['balanced']:.0f} % ({100 * own[kind]['accuracy']:.0f} %)" for kind in kinds
        ]
        width = own[kinds[0]]["width_error"]
        told = "-" if width != width else f"{100 * width:.0f} %"
        rows.append((name, str(own[kinds[0]]["count"]), *cells, told))
    head = ("tested on", "runs", *kinds, "width of the spall, median error")
    return Table("", head, tuple(rows))


def _matrix(row: dict[str, Any]) -> Table:
    named = sorted({name for each in row["matrix"].values() for name in each})
    rows = tuple(
        (right, *(str(each.get(name, 0)) for name in named)) for right, each in row["matrix"].items()
    )
    return Table("", ("it is", *(f"named {name}" for name in named)), rows)


def _cores(cores: list[dict[str, Any]]) -> Table:
    columns: list[Column] = [
        ("processes", lambda row: f"{row['workers']}"),
        ("runs", lambda row: f"{row['runs']}"),
        ("processor time a run", lambda row: f"{row['processor_s']:.3f} s"),
        ("besides", lambda row: f"{row['besides_s']:.3f} s"),
        ("busy", lambda row: f"{100 * row['busy']:.0f} %"),
        ("runs an hour of a core", lambda row: f"{_an_hour(row):.0f}"),
        ("most memory", lambda row: f"{row['bytes'] / 1e6:.0f} MB"),
        ("by the clock", lambda row: f"{row['wall_s']:.0f} s"),
        ("load", lambda row: f"{row['load']:.0f}" if "load" in row else "-"),
    ]
    return Table.of("", cores, columns)


def _engine(engine: list[dict[str, Any]]) -> Table:
    columns: list[Column] = [
        ("workers", lambda row: f"{row['workers']}"),
        ("runs", lambda row: f"{row['runs']}"),
        ("time", lambda row: f"{row['wall_s']:.2f} s"),
        ("efficiency", lambda row: f"{100 * row['efficiency']:.0f} %"),
        ("memory", lambda row: f"{row['bytes'] / 1e6:.0f} MB"),
    ]
    return Table.of("", engine, columns)


def _formats(formats: list[dict[str, Any]]) -> Table:
    columns: list[Column] = [
        ("format", lambda row: row["format"]),
        ("of the raw size", lambda row: f"{100 * row['share']:.0f} %"),
        ("MB a run", lambda row: f"{row['bytes_a_run'] / 1e6:.2f}"),
        ("read", lambda row: f"{1e3 * row['read_s']:.0f} ms"),
    ]
    return Table.of("", formats, columns)


def _efficiency(rows: list[dict[str, Any]]) -> str:
    """Say what a second process brings, by processor time and by the clock."""
    one, two = rows[0], rows[-1]
    own = _an_hour(two) / _an_hour(one)
    clock = (two["runs"] / two["wall_s"]) / (one["runs"] / one["wall_s"]) / (two["workers"] / one["workers"])
    return (
        f"From {one['workers']} to {two['workers']} processes: {100 * own:.0f} % of the runs an hour of each "
        f"core are left, by processor time and waiting; by the clock {100 * clock:.0f} %, with "
        "other work of the machine (*load*: processes that wanted a core at the end of it)."
    )


def _a_run(row: dict[str, Any]) -> float:
    """Add up what a run takes of a core, [s]."""
    return float(row["processor_s"] + row["besides_s"])


def _an_hour(row: dict[str, Any]) -> float:
    """Work out the runs an hour of a core that has nothing else to do."""
    return 3600.0 * float(row["busy"]) / _a_run(row)


def _paper(found: dict[str, Any]) -> Table:
    """Work out what more runs would take, from what was measured."""
    rows = []
    one = found["cores"][0]
    for runs in (10_000, 1_000_000):

        def hours(cores: int, runs: int = runs) -> float:
            return runs * max(_a_run(one) / _least_busy(found) / cores, one["besides_s"]) / 3600.0

        size = runs * found["made"]["bytes_a_run"]
        rows.append(
            (
                f"{runs:,}".replace(",", " "),
                *(_hours(hours(cores)) for cores in (1, 8, 256)),
                f"{size / 1e9:.0f} GB",
                f"{size / hours(256) / 3600.0 / 1e6:.0f} MB/s",
            )
        )
    head = ("runs", "1 core", "8 cores", "256 cores", "size", "written, of 256 cores")
    return Table("", head, tuple(rows))


def _least_busy(found: dict[str, Any]) -> float:
    return float(min(row["busy"] for row in found["cores"]))


def _hours(hours: float) -> str:
    return f"{hours:.0f} h" if hours >= 10 else f"{hours:.1f} h" if hours >= 1 else f"{60 * hours:.1f} min"


def draw(found: dict[str, Any], path: Path) -> None:
    """Draw the gap: balanced accuracy over what the learner is tested on."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    gap = found["gap"]
    names = list(dict.fromkeys(row["name"] for row in gap))
    kinds = list(dict.fromkeys(row["features"] for row in gap))
    figure, axes = pyplot.subplots(figsize=(7.0, 0.9 + 0.5 * len(names)), layout="constrained")
    height = 0.8 / len(kinds)
    for k, kind in enumerate(kinds):
        own = {row["name"]: 100 * row["balanced"] for row in gap if row["features"] == kind}
        places = [place + (k - 0.5 * (len(kinds) - 1)) * height for place in range(len(names))]
        axes.barh(places, [own[name] for name in names], height, label=kind)
    axes.axvline(100 * CHANCE, color="black", linestyle=":", linewidth=1.0, label="chance")
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.set_xlim(0, 100)
    axes.set_xlabel("balanced accuracy [%]")
    figure.legend(fontsize="small", loc="outside lower center", ncols=3)
    figure.savefig(path, dpi=110)
    pyplot.close(figure)
    save_small(path, path, 32)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "--again":  # the page anew from what was measured
        write_page(read_json(Path(sys.argv[2])))
        sys.exit(0)
    sys.exit(main())

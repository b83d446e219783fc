"""`beardyn structure`: the modes of an axlebox, by finite elements or from another program."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words, may_be_left
from beardyn_core.base.optional import missing
from beardyn_core.cli.files import check_inputs
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_force, add_json

if TYPE_CHECKING:
    from beardyn_core.structure.build import Built
    from beardyn_core.structure.modes import Modes

_SHOWN = 12


def add_parser(subparsers: Any) -> None:
    """Add the command to the subparsers of the command line."""
    parser = subparsers.add_parser(
        "structure",
        help="compute the modes of an axlebox by finite elements, or read them",
        description="Mesh an axlebox with the cup in it, compute its free modes and the residual modes that "
        "make its static bending right, check them against the finite elements and write them as a table; or "
        "read the modes of a Universal file, or of Nastran, that BOX names and write them as the same table. "
        "Needs pip install beardyn[structure].",
    )
    parser.add_argument("box", metavar="BOX", help="name of a shipped box or path of a YAML file")
    parser.add_argument(
        "--bearing",
        metavar="NAME",
        help="shipped bearing or path of its file: fit the box to it, all sizes in proportion to its outer "
        "diameter and width; default the bearing of the box",
    )
    parser.add_argument("-o", "--output", metavar="FILE.csv", type=Path, help="table to write; default none")
    parser.add_argument(
        "--mesh",
        metavar="MM",
        type=float,
        help="largest edge of an element, mm; default 15, some 100 000 unknowns",
    )
    parser.add_argument(
        "--highest", metavar="KHZ", type=float, help="free modes up to here, kHz; default 12.8"
    )
    parser.add_argument(
        "--waves",
        metavar="N",
        type=int,
        help="residual modes answer loads of up to N waves around a row, 1 to 8; default 3",
    )
    parser.add_argument(
        "--save",
        metavar="FILE.rrd",
        type=Path,
        help="write the first modes in motion as a rerun file; default none",
    )
    parser.add_argument("--view", action="store_true", help="show the first modes in motion in a window")
    add_force(parser)
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.base.outputs import file_problems, write_whole
    from beardyn_core.config.nouns import box_for, load_any_bearing, load_box
    from beardyn_core.record.viewer import require_display
    from beardyn_core.structure.box import Box
    from beardyn_core.structure.build import HIGHEST, MESH, modes_of
    from beardyn_core.structure.imported import ModeFile, modes_of_file
    from beardyn_core.structure.modes import RESIDUAL_WAVES
    from beardyn_core.structure.table import table_text

    with check_inputs(
        lambda inputs: [
            *_problems(args),
            *file_problems("--output", args.output, inputs=inputs, force=args.force, ending=".csv"),
            *(missing("rerun", "a view", "view") if args.save or args.view else []),
            *file_problems("--save", args.save, inputs=inputs, force=args.force, ending=".rrd"),
        ]
    ):
        box = load_box(args.box)
        if isinstance(box, ModeFile) and {args.bearing, args.mesh, args.highest, args.waves} != {None}:
            raise InputError(f"{args.box} has its modes: leave --bearing, --mesh, --highest and --waves out")
        if isinstance(box, ModeFile) and (args.save or args.view):
            raise InputError(
                f"{args.box} has modes at nodes and no mesh, so no surface: leave --save and --view out"
            )
        if args.bearing is not None and isinstance(box, Box):
            box = box_for(box, args.bearing)
        bearing = load_any_bearing(box.bearing)
        if args.view:
            require_display()
    built: Built | None = None
    with may_be_left(), last_words(lambda: "nothing has been written"):
        if isinstance(box, Box):
            built = modes_of(
                box,
                bearing,
                mesh=MESH if args.mesh is None else 1e-3 * args.mesh,
                highest=HIGHEST if args.highest is None else 1e3 * args.highest,
                waves=RESIDUAL_WAVES if args.waves is None else args.waves,
                progress=lambda words: print(f"beardyn: {words}", file=sys.stderr),
            )
            modes = built.modes
        else:
            modes = modes_of_file(box, bearing)
    if args.json:
        print(json_text("structure", json_object(modes, built, args.output)))
    else:
        print(text(modes, built))
    if args.output is not None:
        try:
            write_whole(args.output, table_text(modes), replace=args.force)
        except OSError as error:
            raise InputError(f"--output {args.output}: cannot be written: {error.strerror}") from error
        print(f"beardyn: {args.output} written", file=sys.stderr)
    if built is not None and (args.save or args.view):
        _show(built, args.save, args.view, args.force)
    return 0


def _show(built: Built, target: Path | None, window: bool, force: bool) -> None:
    from beardyn_core.record.rerun_modes import save_modes
    from beardyn_core.record.viewer import open_window

    with tempfile.TemporaryDirectory(prefix="beardyn-modes-") as folder:
        file = save_modes(built, target or Path(folder) / "modes.rrd", replace=force)
        if target is not None:
            print(f"beardyn: {target} written; open it with: rerun {target}", file=sys.stderr)
        if window:
            open_window(file)


def _problems(args: argparse.Namespace) -> list[str]:
    limits = (
        ("--mesh", args.mesh, 8.0, 60.0, "mm"),
        ("--highest", args.highest, 2.0, 25.6, "kHz"),
        ("--waves", args.waves, 1, 8, ""),
    )
    return [
        f"{option} is {value:g}; it must be {low:g} to {high:g} {unit}".rstrip()
        for option, value, low, high, unit in limits
        if value is not None and not low <= value <= high
    ]


def zone_yield(modes: Modes) -> float:
    """Compute how far the raceway yields under a load zone on top, without rigid motion, [m/N]."""
    from beardyn_core.structure.build import load_zone

    zone = load_zone(modes.reads.shape[0])
    return modes.yielding(zone, zone)


def json_object(modes: Modes, built: Built | None, table: Path | None) -> dict[str, Any]:
    """Gather what ``--json`` prints; ``built`` is ``None`` for modes of another program."""
    return {
        "box": modes.name,
        "mass_kg": modes.mass,
        "centre_m": modes.centre,
        "inertia_kg_m2": modes.inertia,
        "element_count": built and built.elements,
        "unknown_count": built and built.unknowns,
        "frequency_Hz": modes.frequency,
        "free_mode_count": modes.free_count,
        "yield_finite_elements_m_per_N": built and built.yielding[0],
        "yield_modes_m_per_N": zone_yield(modes),
        "table": table,
    }


def text(modes: Modes, built: Built | None) -> str:
    """Write the result for the terminal; ``built`` is ``None`` for modes of another program."""
    free = [f"{each:.0f}" for each in modes.frequency[: modes.free_count]]
    shown = ", ".join(free[:_SHOWN]) + (f" ... {free[-1]}" if len(free) > _SHOWN else "")
    centre = ", ".join(f"{1e3 * each:.0f}" for each in modes.centre)
    lines = [
        f"{modes.name}: {modes.description}",
        f"  {modes.mass:.1f} kg with the cup, centre of mass ({centre}) mm",
        f"  {modes.free_count} free modes: {shown} Hz",
    ]
    yields = f"  under a load zone on top the raceway yields {1e9 * zone_yield(modes):.4g} um/kN"
    if built is not None:
        residual = modes.frequency[modes.free_count :]
        lines.insert(2, f"  {built.elements} elements, {built.unknowns} unknowns")
        lines.append(f"  {len(residual)} residual modes, {residual.min():.0f} to {residual.max():.0f} Hz")
        yields += f", {100.0 * built.static_error:+.2f} % of the finite elements"
    lines.append(yields)
    return "\n".join(lines)

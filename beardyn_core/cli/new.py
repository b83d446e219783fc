"""``beardyn new``: a copy of a shipped file with its comments, to start from."""

from __future__ import annotations

import argparse
import re
import textwrap
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import as_a_whole, file_problems
from beardyn_core.cli.catalogue_list import CATALOGUE
from beardyn_core.cli.options import add_force
from beardyn_core.cli.scenes import KINDS

if TYPE_CHECKING:
    from beardyn_core.bearing.catalogue_entry import CatalogueEntry

_NAME_KEY = {"scenes": "scene", "trials": "trial", "sweeps": "sweep"}
_HOW = {
    "scenes": "beardyn simulate {file}     what is computed, and why: beardyn explain {file}",
    "bearings": "beardyn bearing {file}     in a scene next to it: bearing: {file}",
    "lubricants": "in a scene next to it: lubricant: {file}",
    "vehicles": "in the operation of a scene next to it: vehicle: {file}",
    "effects": "beardyn simulate SCENE --effects {file}     in a scene next to it: effects: {file}",
    "trials": "beardyn trial {file}",
    "sweeps": "beardyn sweep {file} -o DIR",
    "structures": "beardyn structure {file}",
    "sensors": "in a sensor of a scene next to it: type: {file}",
    "backgrounds": "in a scene next to it: background: {file}",
    CATALOGUE: "beardyn monitor MEASURED_FILE --bearing {file}",
}
# What else a scene may say: shown as comments where the scene does not say it.
POSSIBLE = {
    "end_play_mm": "end_play_mm: 0.1   # total axial travel, negative: preload; else that of the bearing",
    "tier": "tier: quasistatic   # full (default), quasistatic or lumped: which bodies move by themselves",
    "effects": "effects: all    # one of `beardyn scenes effects`; else those that 5 % of accuracy need",
    "background": "background: {name: mine, knocks: {rate_Hz: 3, impulse_N_s: 0.1}}   "
    "# or one of `beardyn scenes backgrounds`",
    "defects": 'defects:\n  - {kind: spall, "on": cup, row: 0, azimuth_deg: 0, width_mm: 6, depth_um: 100}',
    "waviness": 'waviness:\n  - {"on": cup, row: 0, orders: [20], amplitude_um: 1}',
    "scatter": "scatter: {grade: G2, surface: typical, seed: 1}   # as made; grades none, G1, G2, G3, G5",
    "sensors": "sensors:\n  - {name: axlebox_top, position_mm: [0, 0, 170], type: iepe_100}",
    "numerics": "numerics: {laminae: 6}   # slices of each roller contact",
    "seed": "seed: 2   # of irregularity, background and sensor noise",
}
_WORD = re.compile(r"(?!(?:true|false|null|True|False|Null|TRUE|FALSE|NULL)$)[A-Za-z_][\w.-]{0,79}")


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "new",
        help="copy a shipped scene, bearing, ... with its comments, to change it",
        description="Copy a shipped scene with its comments to a file of your own; `beardyn simulate FILE` "
        "runs it. Bearings, lubricants and whatever else `beardyn scenes all` lists are copied in the same "
        "manner. Files that a scene refers to are copied next to it.",
    )
    parser.add_argument("name", metavar="NAME", help="shipped scene, bearing, lubricant, ...")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE.yaml",
        type=Path,
        help="file to write; default NAME.yaml in this folder",
    )
    parser.add_argument(
        "--kind", choices=(*KINDS, CATALOGUE), help="where to look for NAME; default everywhere, scenes first"
    )
    add_force(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.config.folders import find

    kind = args.kind or kind_of(args.name)
    if kind == CATALOGUE:
        return _copy_bearing_data(args)
    source = find(kind, args.name)
    target = args.output or Path(f"{args.name}.yaml")
    files = {target: copied_text(kind, source, target).encode()}
    for reference in referred_files(source) if kind == "scenes" else ():
        files[target.parent / reference.name] = reference.read_bytes()
    _refuse(files, target, source, args.force)
    try:
        for path, content in files.items():
            with as_a_whole(path, replace=args.force) as fresh:
                fresh.write_bytes(content)
            print(f"{path} written")
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror or error}") from None
    print(_HOW[kind].format(file=_show_path(target)))
    return 0


def _copy_bearing_data(args: argparse.Namespace) -> int:
    """Write a line of the catalogue as a file of bearing data."""
    from beardyn_core.config.catalogue import catalogue_file, find_bearing

    entry = find_bearing(args.name)
    target = args.output or Path(f"{re.sub(r'[^A-Za-z0-9.-]+', '_', entry.name)}.yaml")
    content = bearing_data_text(entry, target).encode()
    _refuse({target: content}, target, catalogue_file(), args.force)
    try:
        with as_a_whole(target, replace=args.force) as fresh:
            fresh.write_bytes(content)
    except OSError as error:
        raise InputError(f"{target}: cannot be written: {error.strerror or error}") from None
    print(f"{target} written")
    print(_HOW[CATALOGUE].format(file=_show_path(target)))
    return 0


def bearing_data_text(entry: CatalogueEntry, target: Path) -> str:
    """Write a bearing of the catalogue as a file of its own, every number with its source."""
    import yaml

    from beardyn_core.base.edge import write_noun

    keys = write_noun(entry.plate)
    keys.pop("sources", None)
    if _WORD.fullmatch(target.stem):
        keys["name"] = target.stem
    said = {key: {"value": value, "source": entry.place} for key, value in keys.items()}
    said |= {key: keys[key] for key in ("name", "description")}
    heading = [
        f"# {entry.name} of the catalogue of bearings. Units stand in the keys.",
        *textwrap.wrap(f"Source: {entry.source}.", 108, initial_indent="# ", subsequent_indent="# "),
        "# Every key with its meaning, unit, limits and default: docs/reference.md; for editors:",
        "# `beardyn schema bearing_data`.",
        f"# {_HOW[CATALOGUE].format(file=_show_path(target))}",
    ]
    text = yaml.safe_dump(said, sort_keys=False, allow_unicode=True, width=110)
    return "\n".join([*heading, "", text])


def kind_of(name: str) -> str:
    """Find the kind of the shipped thing of a name, scenes first, the catalogue of bearings last.

    Raises
    ------
    InputError
        When there is none, with the name that was probably meant.
    """
    from beardyn_core.base.spelling import closest
    from beardyn_core.config import shipped_names
    from beardyn_core.config.catalogue import find_bearing

    names = {kind: shipped_names(kind) for kind in KINDS}
    if found := [kind for kind in KINDS if name in names[kind]]:
        return found[0]
    with suppress(InputError):
        find_bearing(name)
        return CATALOGUE
    guess = closest(name, [each for members in names.values() for each in members])
    hint = f"did you mean {guess}? " if guess else ""
    raise InputError(f"nothing shipped is called {name!r}; {hint}`beardyn scenes all` lists the names")


def copied_text(kind: str, source: Path, target: Path) -> str:
    """Write the copy: a heading, the shipped text, and what else may be said.

    Its name is the stem of the target where that is a plain word.
    """
    text = source.read_text(encoding="utf-8")
    if _WORD.fullmatch(target.stem):
        key = _NAME_KEY.get(kind, "name")
        text = re.sub(rf"^{key}:\s*\S+", f"{key}: {target.stem}", text, count=1, flags=re.MULTILINE)
    singular = "effects" if kind == "effects" else kind[:-1]
    heading = [
        f"# Copied from the shipped {singular} {source.stem}. Units stand in the keys.",
        "# Every key with its meaning, unit, limits and default: docs/reference.md; for editors:",
        f"# `beardyn schema {singular}`.",
        f"# {_HOW[kind].format(file=_show_path(target))}",
    ]
    ending = []
    if kind == "scenes":
        others = [what for key, what in POSSIBLE.items() if not re.search(rf"^{key}:", text, re.MULTILINE)]
        comments = (f"# {line}" for what in others for line in what.split("\n"))
        ending = ["", "# Also possible; take the # away:", *comments]
    return "\n".join([*heading, "", text.rstrip("\n"), *ending]) + "\n"


def referred_files(source: Path) -> list[Path]:
    """List the files next to a scene that it refers to by their relative path."""
    from beardyn_core.config.yaml_text import read_file

    def texts(value: Any) -> list[str]:
        if isinstance(value, dict):
            return [text for each in value.values() for text in texts(each)]
        if isinstance(value, list):
            return [text for each in value for text in texts(each)]
        return [value] if isinstance(value, str) else []

    paths = [source.parent / text for text in texts(read_file(source).get("operation", {})) if "." in text]
    return [path for path in dict.fromkeys(paths) if path.is_file()]


def _show_path(target: Path) -> str:
    """Write a path so that it is taken for one, not for a shipped name."""
    return str(target) if target.suffix in (".yaml", ".yml") or "/" in str(target) else f"./{target}"


def _refuse(files: dict[Path, bytes], target: Path, source: Path, force: bool) -> None:
    """Raise `InputError` with everything that speaks against writing; nothing has been written yet."""
    problems = []
    if target.suffix not in (".yaml", ".yml"):
        problems.append(f"--output {target}: give it the ending .yaml, by which commands know a file")
    for path in files:
        if path.exists() and path.resolve().parent == source.resolve().parent:
            problems.append(f"{path}: is a shipped file and stays; choose another name or folder")
        else:
            problems += file_problems("--output" if path == target else "", path, force=force)
    if problems:
        raise InputError(problems)

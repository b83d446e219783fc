"""Options of commands that read measured files, made from their declaration; bearing data."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from beardyn_core.base.edge import places
from beardyn_core.base.errors import InputError
from beardyn_core.cli.generated_parser import add_field, flag

if TYPE_CHECKING:
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.measured.about import Mounted
    from beardyn_core.measured.options import Reading

_PLATE = (
    *("roller_count", "roller_diameter_mm", "pitch_diameter_mm", "contact_angle_deg"),
    *("bpfo", "bpfi", "bsf", "ftf"),
)


def add_reading(parser: argparse.ArgumentParser) -> None:
    """Declare how measured files are read."""
    from beardyn_core.measured.options import Reading

    group = parser.add_argument_group("measured files", "what the files lack, or have wrong")
    for place in places(Reading):
        several: dict[str, Any] = {"action": "append", "type": str} if place.field == "channels" else {}
        add_field(group, place, dest=f"measured_{place.key}", **several)


def add_plates(parser: argparse.ArgumentParser, default: str) -> None:
    """Declare the bearings on the shaft."""
    from beardyn_core.bearing.name_plate import NamePlate

    group = parser.add_argument_group("bearings", "their data")
    group.add_argument(
        "--bearing",
        metavar="[LABEL=]NAME[@SENSOR]",
        action="append",
        default=[],
        help="designation of the catalogue (`beardyn scenes catalogue`), with any endings of seals, cage and "
        "clearance, a shipped bearing (`beardyn scenes bearings`) or a YAML file; again for each bearing "
        "on the shaft, with a label, and with the accelerometer that measures it; "
        f"{default}",
    )
    for place in places(NamePlate):
        if place.key in _PLATE:
            add_field(group, place, "; these in place of --bearing", dest=f"measured_{place.key}")


def reading_of(args: argparse.Namespace) -> Reading:
    """Make the reading of the options; raises `InputError` with every mistake, as options are written."""
    from beardyn_core.measured.options import Reading

    given = {place.key: getattr(args, f"measured_{place.key}") for place in places(Reading)}
    return _in_words_of_options(lambda: Reading.of(**given), [place.key for place in places(Reading)])


def reading_options(args: argparse.Namespace) -> list[str]:
    """List the options of measured files that were given."""
    from beardyn_core.measured.options import Reading

    return [flag(place.key) for place in places(Reading) if _is_given(args, place.key)]


def misplaced_options(args: argparse.Namespace, recorded: bool) -> list[str]:
    """Say which options of measured files a recording leaves aside, and the other way round."""
    path = args.files[0]
    options = [each for each in reading_options(args) if each != "--channels"]
    if recorded and options:
        verb = "is" if len(options) == 1 else "are"
        what = f"{path} is a recording, which is taken as it is"
        return [f"{', '.join(options)} {verb} for measured files; {what}"]
    if not recorded and args.box:
        return [f"--box: is for recordings; {path} is a measured file, which has no axleboxes"]
    return []


def plate_options(args: argparse.Namespace) -> list[str]:
    """List the numbers of the bearing data that were given."""
    return [flag(key) for key in _PLATE if _is_given(args, key)]


def _is_given(args: argparse.Namespace, key: str) -> bool:
    return getattr(args, f"measured_{key}") is not None


def mounted_of(args: argparse.Namespace) -> tuple[Mounted, ...]:
    """List the bearings of the options; none when none is given.

    Raises
    ------
    InputError
        With every mistake.
    """
    from beardyn_core.config.plates import find_entry, load_plate
    from beardyn_core.measured.about import USUAL_LABEL, Mounted

    found: list[Mounted] = []
    problems: list[str] = []
    for text in args.bearing:
        match = re.fullmatch(r"(?:([A-Za-z]\w*)=)?([^=@]+)(?:@([A-Za-z]\w*))?", text)
        if match is None:
            problems.append(f"--bearing {text!r}: must be NAME, LABEL=NAME or LABEL=NAME@SENSOR")
            continue
        label = match[1] or (USUAL_LABEL if len(args.bearing) == 1 else match[2])
        try:
            found.append(Mounted(label, load_plate(match[2]), match[3] or "", find_entry(match[2])))
        except InputError as error:
            problems += [f"--bearing {text}: {each}" for each in error.problems]
    for label in {each.label for each in found}:
        if sum(each.label == label for each in found) > 1:
            problems.append(f"--bearing: two bearings are called {label}; write LABEL=NAME with two labels")
    try:
        if (plate := _plate_of(args)) is not None:
            if args.bearing:
                problems.append("--bearing and the numbers of a bearing are given; give one of both")
            found.append(Mounted(USUAL_LABEL, plate))
    except InputError as error:
        problems += error.problems
    if problems:
        raise InputError(problems)
    return tuple(found)


def _plate_of(args: argparse.Namespace) -> NamePlate | None:
    from beardyn_core.bearing.factors import SYMBOLS
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.config.nouns import read_noun

    given = {key: getattr(args, f"measured_{key}") for key in _PLATE}
    given = {key: value for key, value in given.items() if value is not None}
    if not given:
        return None
    try:
        made: NamePlate = read_noun(NamePlate, given, "bearing of the options")
    except InputError as error:
        factors = rf"\b({'|'.join(SYMBOLS)})\b"
        problems = [in_options(each, list(_PLATE)) for each in error.problems]
        problems = [re.sub(factors, r"--\1", each) for each in problems]
        raise InputError([each + _as_order(each, args) for each in problems]) from None
    return made


def _as_order(problem: str, args: argparse.Namespace) -> str:
    """Say what a frequency that was given as a factor is at the stated speed; empty where none is stated."""
    from beardyn_core.bearing.factors import PER_TURN

    match = re.search(r"--\w+ is (\S+);", problem)
    rpm = _stated_rpm(args)
    if not problem.endswith(PER_TURN) or match is None or not rpm > 0.0:
        return ""
    return f"; {match[1]} Hz at {rpm:.5g} rpm is {60.0 * float(match[1]) / rpm:.4g}"


def _stated_rpm(args: argparse.Namespace) -> float:
    """Give the speed of the shaft that the options state, 0 where they state none, [rpm]."""
    if args.measured_speed_rpm:
        return float(args.measured_speed_rpm)
    if args.measured_speed_kmh and args.measured_wheel_diameter_mm:
        around = math.pi * args.measured_wheel_diameter_mm / 1000.0  # [m]
        return float(args.measured_speed_kmh / 0.06 / around)
    return 0.0


def _in_words_of_options(make: Callable[[], Any], keys: list[str]) -> Any:
    try:
        return make()
    except InputError as error:
        raise InputError([in_options(each, keys) for each in error.problems]) from None


def in_options(sentence: str, keys: list[str]) -> str:
    """Write the keys in a sentence as the options that they are."""
    pattern = "|".join(sorted(map(re.escape, keys), key=len, reverse=True))
    plain = [key for key in keys if "_" not in key]
    found = re.sub(
        rf"(?<![\w-])({pattern})(?![\w])", lambda m: m[0] if m[0] in plain else flag(m[0]), sentence
    )
    if plain and (match := re.match(rf"measured files: ({'|'.join(plain)})\b", found)):
        found = found.replace(match[1], flag(match[1]), 1)
    return found

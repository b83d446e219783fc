"""Which code a picture of the documentation is of: ``python -m evidence.stamps``.

A picture carries, as text in its PNG or as the comment of its GIF, the command that made it and a digest of
every room of the simulator, and of its configuration, as they were when that command began. The command lists
the pictures, and which rooms have changed since; ``--check`` ends with 1 when one has. The room of the
commands' words, which draws and computes nothing, does not count; a room that few commands go through counts
for their pictures alone. That is a question for a release: a change in a room need not reach a picture, so no
test asks it of every commit.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated as A
from typing import Any, NamedTuple

from PIL import Image, PngImagePlugin

ROOT = Path(__file__).resolve().parents[1]
PICTURES = ROOT / "docs" / "pictures"
SIMULATOR, CONFIGURATION = "beardyn_core", "config/"
WORDS = "cli"  # the room that reads words and prints sentences
SOME_GO_THROUGH = {  # rooms, and how the commands begin whose pictures they may change
    "config/estimators": ("python -m evidence.follow",),
    "measured": ("python -m evidence.population", "python -m evidence.measured"),  # read files of other tools
}
BY, OF = "Made by", "Made of"
LISTED = 8  # rooms; more are counted
_LENGTH = 8
_COMMENT, _TRAILER = b"\x21\xfe", b"\x3b"  # of a GIF


class Stamp(NamedTuple):
    """What a picture says of its making."""

    command: A[str, "empty where it says nothing"]
    rooms: A[dict[str, str], "digests of the rooms of the simulator by name"]


def rooms_of(root: Path = ROOT) -> dict[str, str]:
    """Hash every room of the simulator, the modules beside them as one more, ``.``, and of `config`."""
    digests: dict[str, hashlib._Hash] = {}
    for path in sorted((root / SIMULATOR).rglob("*")):
        if path.suffix in (".py", ".json"):
            place = path.relative_to(root / SIMULATOR)
            digest = digests.setdefault(place.parts[0] if len(place.parts) > 1 else ".", hashlib.sha256())
            digest.update(f"\n{place.as_posix()}\n".encode() + path.read_bytes())
    for path in sorted((root / CONFIGURATION).rglob("*.*")):
        place = path.relative_to(root)
        digest = digests.setdefault("/".join(place.parts[:2]), hashlib.sha256())
        digest.update(f"\n{place.as_posix()}\n".encode() + path.read_bytes())
    return {room: digest.hexdigest()[:_LENGTH] for room, digest in digests.items()}


AT_START = rooms_of()  # an edit while a command runs is not in what it draws


def command_of_this_process() -> str:
    """Give the command that runs: ``python -m evidence.light.page``, ``python docs/write_scenes.py``."""
    main = sys.modules["__main__"]
    if main.__spec__ is not None:
        return f"python -m {main.__spec__.name.removesuffix('.__main__')}"
    script = Path(getattr(main, "__file__", None) or sys.argv[0]).resolve()
    return f"python {script.relative_to(ROOT).as_posix()}" if script.is_relative_to(ROOT) else ""


def png_text(command: str, rooms: dict[str, str]) -> PngImagePlugin.PngInfo:
    """Write a stamp as what Pillow's ``save(pnginfo=...)`` takes."""
    text = PngImagePlugin.PngInfo()
    text.add_text(BY, command)
    text.add_text(OF, json.dumps(rooms))
    return text


def stamp(path: Path, command: str = "", rooms: dict[str, str] | None = None) -> None:
    """Stamp a PNG or GIF in its place: by default with the command that runs and the code it began with."""
    command, rooms = command or command_of_this_process(), AT_START if rooms is None else rooms
    if path.suffix == ".gif":
        path.write_bytes(_with_comment(path.read_bytes(), json.dumps({BY: command, OF: rooms}).encode()))
        return
    with Image.open(path) as picture:
        picture.load()
    picture.save(path, format="png", optimize=True, pnginfo=png_text(command, rooms))


def _with_comment(gif: bytes, comment: bytes) -> bytes:
    """Put a comment in the place of the one at the end of a GIF; its frames stay as they are."""
    begin = _begin_of_comment(gif)
    whole = gif[:begin] if begin >= 0 else gif.removesuffix(_TRAILER)
    blocks = [comment[start : start + 255] for start in range(0, len(comment), 255)]
    return whole + _COMMENT + b"".join(bytes([len(block)]) + block for block in blocks) + b"\0" + _TRAILER


def _begin_of_comment(gif: bytes) -> int:
    """Find where the stamp of a GIF begins; -1 where it has none."""
    begin = gif.rfind(f'{{"{BY}"'.encode()) - len(_COMMENT) - 1
    return begin if begin >= 0 and gif.startswith(_COMMENT, begin) else -1


def _comment_of(gif: bytes) -> dict[str, Any]:
    """Read the stamp at the end of a GIF; empty where there is none."""
    place, text = _begin_of_comment(gif) + len(_COMMENT), b""
    if place < len(_COMMENT):
        return {}
    while gif[place]:
        text += gif[place + 1 : place + 1 + gif[place]]
        place += 1 + gif[place]
    return dict(json.loads(text))


def stamp_of(path: Path) -> Stamp:
    """Read what a picture states of its making."""
    if path.suffix == ".gif":
        found = _comment_of(path.read_bytes())
        return Stamp(found.get(BY, ""), found.get(OF, {}))
    with Image.open(path) as picture:
        picture.load()  # text may stand behind the pixels
        said = {key: str(value) for key, value in picture.info.items() if key in (BY, OF)}
    return Stamp(said.get(BY, ""), json.loads(said.get(OF, "{}")))


def changed_rooms(path: Path, now: dict[str, str]) -> list[str]:
    """Name the rooms that are others than when a picture was made; older stamps know nothing of `config`."""
    command, then = stamp_of(path)
    configured = any(room.startswith(CONFIGURATION) for room in then)
    asked = {room for room in {*then, *now} if configured or not room.startswith(CONFIGURATION)} - {WORDS}
    asked -= {room for room, begin in SOME_GO_THROUGH.items() if not command.startswith(begin)}
    return sorted(room for room in asked if then.get(room) != now.get(room))


def stamped_pictures() -> list[Path]:
    """List the pictures of the documentation."""
    return sorted([*PICTURES.rglob("*.png"), *PICTURES.rglob("*.gif")])


def main(words: Sequence[str] | None = None) -> int:
    """List the pictures, or check that they are of the present code."""
    parser = argparse.ArgumentParser(prog="python -m evidence.stamps", description=__doc__)
    parser.add_argument("--check", action="store_true", help="end with 1 when one is of other code")
    arguments = parser.parse_args(words)
    now, older = rooms_of(), 0
    pictures = stamped_pictures()
    for path in pictures:
        changed = changed_rooms(path, now)
        older += bool(changed)
        since = "of the present code"
        if changed:
            listed = ", ".join(changed) if len(changed) <= LISTED else f"{len(changed)} of {len(now)} rooms"
            since = f"changed since: {listed}"
        print(f"{path.relative_to(PICTURES).as_posix():<40} {stamp_of(path).command:<40} {since}")
    print(f"{len(pictures) - older} of {len(pictures)} pictures are of the present code")
    return 1 if arguments.check and older else 0


if __name__ == "__main__":
    sys.exit(main())

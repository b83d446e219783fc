"""Every picture of the documentation says which command and which code it is of."""

from __future__ import annotations

import shutil
import sys
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

import pytest
from PIL import Image

from evidence.pages import save_small
from evidence.stamps import (
    ROOT,
    SOME_GO_THROUGH,
    changed_rooms,
    command_of_this_process,
    main,
    rooms_of,
    stamp,
    stamp_of,
    stamped_pictures,
)

EVERY = stamped_pictures()


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    path = tmp_path / "some.png"
    Image.new("RGB", (8, 8), "#1f4e79").save(path)
    return path


def test_every_picture_names_a_command_that_there_is() -> None:
    assert len(EVERY) > 50
    for path in EVERY:
        words = stamp_of(path).command.split()
        assert words[:1] == ["python"], path
        place = Path(*words[2].split(".")).with_suffix(".py") if words[1] == "-m" else Path(words[1])
        assert (ROOT / place).is_file(), path
        assert len(stamp_of(path).rooms) > 10, path


def test_a_stamp_leaves_the_frames_of_a_gif_and_is_replaced_by_the_next(tmp_path: Path) -> None:
    path = tmp_path / "moving.gif"
    frames = [Image.new("P", (8, 8), number) for number in range(3)]
    for frame in frames:
        frame.putpalette([0, 0, 0, 255, 0, 0, 0, 255, 0])
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=100)
    assert stamp_of(path) == ("", {})
    before = path.read_bytes()
    for command, rooms in (
        ("python docs/one.py", {"rail": "a" * 300}),
        ("python docs/two.py", {"rail": "b"}),
    ):
        stamp(path, command, rooms)
        assert stamp_of(path) == (command, rooms)
        assert path.read_bytes().startswith(before[:-1])
    with Image.open(path) as moving:
        assert getattr(moving, "n_frames", 1) == 3
    assert len(path.read_bytes()) < len(before) + 100


def test_a_picture_is_of_the_present_code_until_a_room_changes(picture: Path, tmp_path: Path) -> None:
    code = tmp_path / "beardyn_core"
    (code / "rail").mkdir(parents=True)
    (code / "record").mkdir()
    (code / "cli").mkdir()
    for place in ("run.py", "rail/load.py", "record/reading.py", "cli/report.py"):
        (code / place).write_text("x = 1\n")
    stamp(picture, "python docs/some.py", rooms_of(tmp_path))
    assert stamp_of(picture).command == "python docs/some.py"
    (code / "cli/report.py").write_text("x = 2\n")
    assert changed_rooms(picture, rooms_of(tmp_path)) == []
    (code / "rail/load.py").write_text("x = 2\n")
    assert changed_rooms(picture, rooms_of(tmp_path)) == ["rail"]
    (tmp_path / "config/scenes").mkdir(parents=True)
    (tmp_path / "config/scenes/one.yaml").write_text("x: 1\n")
    (code / "rail/table.json").write_text("1")
    assert changed_rooms(picture, rooms_of(tmp_path)) == ["rail"]  # nothing is known of its configuration
    stamp(picture, "python docs/some.py", rooms_of(tmp_path))
    (tmp_path / "config/scenes/one.yaml").write_text("x: 2\n")
    assert changed_rooms(picture, rooms_of(tmp_path)) == ["config/scenes"]
    stamp(picture, "python docs/some.py", rooms_of(tmp_path))
    shutil.rmtree(code / "record")
    (code / "run.py").write_text("x = 2\n")
    assert changed_rooms(picture, rooms_of(tmp_path)) == [".", "record"]


@pytest.mark.parametrize(
    ("room", "command"),
    [(room, begin) for room, several in SOME_GO_THROUGH.items() for begin in several],
)
def test_a_room_that_few_commands_go_through_changes_their_pictures_alone(
    room: str, command: str, picture: Path
) -> None:
    before = {"rail": "one", room: "one"}
    after = {**before, room: "two"}
    stamp(picture, f"{command}.page", before)
    assert changed_rooms(picture, after) == [room]
    stamp(picture, "python -m evidence.heat.page", before)
    assert changed_rooms(picture, after) == []


def test_no_other_command_that_draws_reads_measured_files() -> None:
    """It holds while only the rooms of these commands name `beardyn_core.measured` or its reader."""
    commands = {stamp_of(path).command for path in EVERY} - {""}
    for command in commands:
        words = command.split()
        place = Path(*words[2].split(".")[:2]) if words[1] == "-m" else Path(words[1])
        files = sorted((ROOT / place).rglob("*.py")) if (ROOT / place).is_dir() else [ROOT / place]
        reads = any(
            name in file.read_text(encoding="utf-8")
            for file in files
            for name in ("beardyn_core.measured", "read_measured", "import_measured")
        )
        assert not reads or command.startswith(SOME_GO_THROUGH["measured"]), command


@pytest.mark.parametrize(
    ("spec", "file", "command"),
    [
        ("evidence.light.page", "", "python -m evidence.light.page"),
        ("evidence.hard.__main__", "", "python -m evidence.hard"),
        (None, str(ROOT / "docs" / "write_scenes.py"), "python docs/write_scenes.py"),
        (None, "/elsewhere/mine.py", ""),
    ],
)
def test_the_command_is_that_of_the_process(
    spec: str | None, file: str, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Modules that ``python -m`` starts have a specification, scripts have a file."""
    started = ModuleType("__main__")
    started.__spec__ = None if spec is None else ModuleSpec(spec, None)
    started.__file__ = file
    monkeypatch.setitem(sys.modules, "__main__", started)
    assert command_of_this_process() == command


def test_what_makes_a_picture_small_stamps_it(
    picture: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("evidence.pages.command_of_this_process", lambda: "python -m evidence.light.page")
    target = tmp_path / "small.png"
    save_small(picture, target, 4)
    assert stamp_of(picture).command == ""
    assert stamp_of(target).command == "python -m evidence.light.page"
    assert changed_rooms(target, rooms_of()) == []
    with Image.open(target) as small:
        assert small.mode == "P"


def test_the_list_has_every_picture_and_the_check_ends_with_1_when_one_is_older(
    picture: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([]) == 0
    assert len(capsys.readouterr().out.splitlines()) == len(EVERY) + 1
    monkeypatch.setattr("evidence.stamps.PICTURES", picture.parent)
    stamp(picture)
    assert main(["--check"]) == 0
    assert "1 of 1 pictures are of the present code" in capsys.readouterr().out
    stamp(picture, rooms={**rooms_of(), "rail": "other"})
    assert main(["--check"]) == 1
    assert "changed since: rail" in capsys.readouterr().out

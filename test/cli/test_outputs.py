"""What exists is not replaced unasked, an input never, and no two processes write one file."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import as_a_whole, file_problems, files_read, open_to_write, write_whole
from beardyn_core.cli import main as command
from beardyn_core.config import config_folder
from beardyn_core.rail.transfer_path import read_transfer_path
from beardyn_core.record.mcap_scanning import recover, recovered_name
from beardyn_core.record.reading import read_run
from beardyn_core.record.sinks import McapSink
from test.record.synthetic_run import SyntheticRun, description
from test.recordings import write_recording

ROOT = Path(__file__).resolve().parents[2]
SHORT = ("--duration", "0.02")


def start(*words: str, cwd: Path) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "beardyn_core.cli.main", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """A scene of one's own, with its own bearing file."""
    for kind, name in (("scenes", "static_5kN"), ("bearings", "HS130x230")):
        text = (config_folder() / kind / f"{name}.yaml").read_text(encoding="utf-8")
        (tmp_path / f"{name}.yaml").write_text(text.replace("bearing: HS130x230", "bearing: HS130x230.yaml"))
    return tmp_path / "static_5kN.yaml"


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    return write_recording(tmp_path / "recorded.mcap", 60)


@pytest.mark.parametrize("link", ["same", "other path", "symbolic", "hard", "bearing"])
@pytest.mark.parametrize("force", [(), ("--force",)])
def test_an_input_is_never_replaced(
    scene: Path, link: str, force: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    source = scene if link != "bearing" else scene.parent / "HS130x230.yaml"
    output = source
    if link == "other path":
        (scene.parent / "sub").mkdir()
        output = scene.parent / "sub" / ".." / scene.name
    elif link in ("symbolic", "hard"):
        output = scene.parent / "run.mcap"
        (output.symlink_to if link == "symbolic" else output.hardlink_to)(scene)
    before = source.read_bytes()
    assert command.main(["simulate", str(scene), "-o", str(output), *SHORT, *force]) == command.BAD_INPUT
    assert f"--output {output}: the command reads this file" in capsys.readouterr().err
    assert source.read_bytes() == before


def test_existing_files_are_replaced_only_with_force(
    tmp_path: Path, recording: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    notes, folder = tmp_path / "notes.txt", tmp_path / "results"
    notes.write_text("of last week")
    folder.mkdir()
    view = folder / "run.rrd"
    for name in ("ladder.json", "contacts_nine.png", "summary.png", view.name):
        (folder / name).write_text("of last week")
    for words, named in (
        (["simulate", "static_5kN", "-o", str(notes)], f"--output {notes}"),
        (["view", str(recording), "--save", str(view)], f"--save {view}"),
        (["view", str(recording), "--screenshot", str(notes)], f"--screenshot {notes}"),
        (["view", str(recording), "--gif", str(notes)], f"--gif {notes}"),
        (["contacts", "--rrd", str(notes)], f"--rrd {notes}"),
        (["contacts", "-o", str(folder)], f"--output {folder / 'contacts_nine.png'}"),
        (["ladder", "static_5kN", "-o", str(folder)], f"--output {folder / 'ladder.json'}"),
        (["demo", "--output", str(folder)], f"--output {folder / 'summary.png'}"),
    ):
        assert command.main(words) == command.BAD_INPUT
        assert f"{named}: the file exists; --force replaces it" in capsys.readouterr().err
    assert {path.read_text() for path in [notes, *folder.iterdir()]} == {"of last week"}
    assert command.main(["view", str(recording), "--save", str(view), "--force"]) == command.DONE
    assert view.stat().st_size > 10_000


@pytest.mark.parametrize("ending", ["csv", "db3", "PARQUET", "rrd"])
def test_a_recording_takes_no_name_of_another_format(
    ending: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"run.{ending}"
    assert command.main(["simulate", "static_5kN", "-o", str(path), *SHORT]) == command.BAD_INPUT
    assert f"--output {path}: a recording is an MCAP file, not .{ending}" in capsys.readouterr().err
    with pytest.raises(InputError, match="a recording is an MCAP file"):
        bd.simulate("static_5kN", duration=0.02, record=path, force=True)
    assert not path.exists()


def ended_by_a_full_disk(path: Path, words: list[str], room: int) -> None:
    """Run a command that may write no file of more than `room` bytes, in a process of its own.

    The limit holds for every thread of a process: those of the encoder and of the nodes of other tests too.
    """
    script = (
        "import resource, sys; from beardyn_core.cli import main\n"
        f"resource.setrlimit(resource.RLIMIT_FSIZE, ({room}, {room}))\n"
        "sys.exit(main.main(sys.argv[1:]))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, *words],
        # a compiled module that the limit cuts off would stay so
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == command.BAD_INPUT, done.stderr
    assert str(path) in done.stderr
    assert "be written" in done.stderr
    assert list(path.parent.iterdir()) == []


def test_a_full_disk_ends_view_and_new_in_a_sentence_and_leaves_no_part_of_a_file(
    tmp_path: Path, recording: Path
) -> None:
    folder = tmp_path / "full"
    folder.mkdir()
    view, copy = folder / "run.rrd", folder / "mine.yaml"
    # where not even the blueprint fits, rerun's own `save` may wait for ever for its thread
    ended_by_a_full_disk(view, ["view", str(recording), "--save", str(view)], 100_000)
    ended_by_a_full_disk(copy, ["new", "cup_spall", "-o", str(copy)], 512)


@pytest.mark.slow
@pytest.mark.parametrize(("ending", "room"), [("gif", 100_000), ("mp4", 50_000)])
def test_a_full_disk_ends_a_moving_picture_in_a_sentence(
    tmp_path: Path, recording: Path, ending: str, room: int
) -> None:
    folder = tmp_path / "full"
    folder.mkdir()
    path = folder / f"run.{ending}"
    ended_by_a_full_disk(path, ["view", str(recording), f"--{ending}", str(path)], room)


def test_a_recording_is_never_replaced_by_what_is_made_of_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recording = write_recording(tmp_path / "run.mcap", 5)
    before = recording.read_bytes()
    words = ["view", str(recording), "--save", str(recording), "--force"]
    assert command.main(words) == command.BAD_INPUT
    assert "the command reads this file" in capsys.readouterr().err
    assert recording.read_bytes() == before


def test_an_earlier_recovery_stays_unless_forced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cut = write_recording(tmp_path / "cut.mcap", 60)
    os.truncate(cut, cut.stat().st_size // 2)
    recovered_name(cut).write_text("edited since")
    assert command.main(["report", str(cut)]) == command.DONE
    told = capsys.readouterr().out
    assert f"{recovered_name(cut)}: is there already and stays as it is; --force" in told
    assert recovered_name(cut).read_text() == "edited since"
    with pytest.raises(InputError, match="the file exists"):
        recover(cut)
    assert command.main(["report", str(cut), "--force"]) == command.DONE
    assert read_run(recovered_name(cut)).complete


@pytest.mark.slow
def test_of_two_runs_to_one_file_the_second_is_refused_while_the_first_writes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The process of the test is the second one."""
    monkeypatch.chdir(tmp_path)
    words, recording = ["simulate", "static_5kN", "-o", "run.mcap"], tmp_path / "run.mcap"
    first = start(*words, "--duration", "600", cwd=tmp_path)
    try:
        deadline = time.monotonic() + 120.0
        while not (recording.exists() and recording.stat().st_size > 100_000):
            assert first.poll() is None
            assert time.monotonic() < deadline
            time.sleep(0.05)
        first.send_signal(signal.SIGSTOP)  # it has the file open, and leaves the processor to the others
        for force in ([], ["--force"]):
            assert command.main([*words, *SHORT, *force]) == command.BAD_INPUT
            assert "run.mcap: another process is writing this file" in capsys.readouterr().err
        assert command.main(["report", "run.mcap"]) == command.DONE
        told = capsys.readouterr().out
        assert "another process is writing this file; this is what it holds now" in told
        assert not recovered_name(recording).exists()
    finally:
        first.kill()
        first.communicate()
    # what a crash has left is readable and blocks nobody, but is not replaced unasked either
    assert read_run(recording).problem
    left = recording.read_bytes()
    assert command.main([*words, *SHORT]) == command.BAD_INPUT
    assert "the file exists; --force replaces it" in capsys.readouterr().err
    assert recording.read_bytes() == left
    assert command.main([*words, *SHORT, "--force", "--json"]) == command.DONE
    assert json.loads(capsys.readouterr().out)["recording"] == "run.mcap"
    assert read_run(recording).complete


def test_two_runs_that_begin_together_do_not_share_a_file(tmp_path: Path) -> None:
    """Both have found no file; the one that opens it second is refused, with or without force."""
    path = tmp_path / "run.mcap"
    first = McapSink(path)
    first.open(description())
    for replace in (False, True):
        with pytest.raises(InputError, match=r"another process is writing|the file exists"):
            McapSink(path, replace=replace).open(description())
    for block in SyntheticRun().blocks(5):
        first.write(block)
    first.close()
    assert read_run(path).complete


def test_a_device_is_no_file_that_could_be_lost(tmp_path: Path) -> None:
    assert file_problems("--output", Path(os.devnull)) == []
    open_to_write(Path(os.devnull)).close()
    dangling = tmp_path / "link"
    dangling.symlink_to(tmp_path / "nowhere")
    assert "link to a file that does not exist" in file_problems("--output", dangling)[0]


def test_a_text_file_is_written_as_a_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "trial.json"
    write_whole(path, "one")
    script = (
        "import resource, signal, sys; from pathlib import Path\n"
        "from beardyn_core.base.outputs import write_whole\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
        "write_whole(Path(sys.argv[1]), 'two' * 1000)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, str(path)],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert "File too large" in done.stderr
    assert path.read_text() == "one"
    assert list(tmp_path.iterdir()) == [path]


def test_files_of_other_programs_are_inputs_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("box.pch", "box.bdf", "path.unv"):
        (tmp_path / name).write_text("of another program")
    box = tmp_path / "box.yaml"
    box.write_text(
        "name: mine\nbearing: HS130x230\nmodes: box.pch\ngrid: box.bdf\nmass_kg: 90\n"
        "inertia_kg_m2: [1, 1, 1]\nproducts_kg_m2: [0, 0, 0]\n"
        "sensors: [{name: top, position_mm: [0, 0, 170], radius_mm: 10}]\n"
    )
    for name in ("box.pch", "box.bdf"):
        table = tmp_path / f"{name}.csv"
        table.symlink_to(tmp_path / name)
        assert command.main(["structure", str(box), "-o", str(table), "--force"]) == command.BAD_INPUT
        assert f"--output {table}: the command reads this file" in capsys.readouterr().err
        assert table.read_text() == "of another program"
    with files_read() as inputs, suppress(InputError):
        read_transfer_path(tmp_path / "path.unv")
    assert inputs == [tmp_path / "path.unv"]


def test_parts_of_a_recording_in_a_folder_are_inputs(tmp_path: Path) -> None:
    part = tmp_path / "bag" / "bag_0.mcap"
    part.parent.mkdir()
    part.write_bytes(b"a part")
    (problem,) = file_problems("", part, inputs=[part.parent], force=True)
    assert "the command reads this file" in problem


def test_the_measured_run_of_a_scene_made_before_is_not_written_over(tmp_path: Path) -> None:
    measured = write_recording(tmp_path / "measured.mcap", 60)
    before = measured.read_bytes()
    operation = {"kind": "mcap", "path": str(measured)}
    made = bd.scene({"scene": "again", "bearing": "HS130x230", "lubricant": "LGEP2", "operation": operation})
    with pytest.raises(InputError, match="the command reads this file"):
        bd.simulate(made, record=measured, force=True)
    demo = tmp_path / "demo"
    demo.mkdir()
    measured.rename(demo / "run.mcap")
    (tmp_path / "again.yaml").write_text(
        "scene: again\npurpose: once more\nbearing: HS130x230\nlubricant: LGEP2\n"
        "operation: {kind: mcap, path: demo/run.mcap}\n"
    )
    words = ["demo", "--scene", str(tmp_path / "again.yaml"), "--output", str(demo), "--force", "--no-view"]
    assert command.main(words) == command.BAD_INPUT
    assert (demo / "run.mcap").read_bytes() == before


def test_what_another_process_has_written_meanwhile_stays(tmp_path: Path) -> None:
    target = tmp_path / "ladder.json"
    writing = as_a_whole(target, replace=False)
    writing.__enter__().write_text("mine")
    target.write_text("theirs")
    with pytest.raises(InputError, match="another process has written this file meanwhile"):
        writing.__exit__(None, None, None)
    assert [each.name for each in tmp_path.iterdir()] == ["ladder.json"]
    assert target.read_text() == "theirs"
    with as_a_whole(target) as fresh:
        fresh.write_text("mine")
    write_whole(tmp_path / "new.json", "new", replace=False)
    assert [each.read_text() for each in sorted(tmp_path.iterdir())] == ["mine", "new"]


def test_an_output_has_the_ending_of_its_format_and_two_are_never_one_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for words, ending in (
        (["structure", "metro", "-o", str(tmp_path / "modes.rrd")], ".csv"),
        (["structure", "metro", "--save", str(tmp_path / "modes.csv")], ".rrd"),
        (["contacts", "-o", str(tmp_path / "found"), "--rrd", str(tmp_path / "contacts.json")], ".rrd"),
        (["view", "run.mcap", "--save", str(tmp_path / "run.txt")], ".rrd"),
        (["view", "run.mcap", "--screenshot", str(tmp_path / "run.txt")], ".png"),
        (["view", "run.mcap", "--gif", str(tmp_path / "run.png")], ".gif"),
        (["view", "run.mcap", "--mp4", str(tmp_path / "run.gif")], ".mp4"),
    ):
        assert command.main(words) == command.BAD_INPUT
        assert f"let its name end in {ending}" in capsys.readouterr().err


TRIAL = """\
trial: mine
purpose: two runs
scene: smooth_run
tier: lumped
faults: [cup]
sizes_mm: [6]
speeds_kmh: [200]
tracks: [german_low]
wheels: [{name: round}]
revolutions: 16
"""


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("trial.json", "the file exists; --force replaces it"),
        ("trial.png", "the file exists; --force replaces it"),
        ("runs.jsonl", "holds no runs of a trial"),
    ],
)
def test_a_trial_replaces_nothing_that_is_not_its_own(
    tmp_path: Path, name: str, sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    matrix = tmp_path / "mine.yaml"
    matrix.write_text(TRIAL)
    folder = tmp_path / "runs"
    folder.mkdir()
    (folder / name).write_text("something else\n")
    assert command.main(["trial", str(matrix), "-o", str(folder)]) == command.BAD_INPUT
    assert sentence in capsys.readouterr().err
    assert (folder / name).read_text() == "something else\n"
    assert len(list(folder.iterdir())) == 1


@pytest.mark.parametrize("force", [(), ("--force",)])
def test_no_set_goes_into_a_folder_of_something_else(
    force: tuple[str, ...],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is told before effects are chosen."""

    def too_late(*_: object, **__: object) -> None:
        raise AssertionError("the folder was looked at too late")

    monkeypatch.setattr("beardyn_core.population.request.make_plan", too_late)
    (tmp_path / "notes.txt").write_text("mine")
    assert command.main(["sweep", "fifty", "-o", str(tmp_path), *force]) == command.BAD_INPUT
    said = capsys.readouterr().err
    assert f"--output {tmp_path}: holds files and no set of runs; give a new folder" in said
    assert [each.name for each in tmp_path.iterdir()] == ["notes.txt"]


def test_the_matrix_in_its_own_folder_stays(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    matrix = tmp_path / "trial.json"
    matrix.write_text(TRIAL)
    assert command.main(["trial", str(matrix), "-o", str(tmp_path), "--force"]) == command.BAD_INPUT
    assert "the command reads this file" in capsys.readouterr().err
    assert matrix.read_text() == TRIAL

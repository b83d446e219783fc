"""The command line: exit codes, streams, messages."""

from __future__ import annotations

import argparse
import errno
import io
import json
import logging
import os
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest

from beardyn_core.api.statics import equilibrium
from beardyn_core.cli import main as command
from beardyn_core.cli import schema
from beardyn_core.cli.generated_parser import parameters_of
from beardyn_core.config import shipped_names
from beardyn_core.config.schema import SCHEMA_KINDS
from beardyn_core.physics.modal_body import RINGS
from beardyn_core.physics.statics import static


def beardyn(*words: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    root = str(Path(__file__).resolve().parents[2])
    environment = {**os.environ, "PYTHONPATH": root}
    return subprocess.run(
        [sys.executable, "-m", "beardyn_core.cli.main", *words],
        capture_output=True,
        text=True,
        timeout=120,
        cwd=cwd,
        env=environment,
        check=False,
    )


def test_help_has_one_line_for_each_command() -> None:
    done = beardyn("--help")
    assert done.returncode == 0
    for name in command.command_names():
        assert f"\n    {name} " in done.stdout
    assert {"simulate", "bearing", "view", "report", "schema", "warmup"} <= set(command.command_names())


def test_version() -> None:
    assert beardyn("--version").stdout.startswith("beardyn ")


def test_starting_imports_no_heavy_module() -> None:
    heavy = ("numpy", "pydantic", "numba", "scipy", "mcap", "rerun", "rosbags", "matplotlib", "rclpy")
    code = (
        "import sys; from beardyn_core.cli.main import build_parser; build_parser(); "
        f"print([name for name in {heavy} if name in sys.modules])"
    )
    root = str(Path(__file__).resolve().parents[2])
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
        env={**os.environ, "PYTHONPATH": root},
    )
    assert done.stdout.strip() == "[]"


def test_schema_is_one_json_object() -> None:
    done = beardyn("schema")
    assert done.returncode == 0
    assert json.loads(done.stdout)["title"] == "beardyn scene"


def test_there_is_a_schema_of_every_kind_of_file() -> None:
    assert set(schema.KINDS) == set(SCHEMA_KINDS)


@pytest.mark.parametrize(
    "words", [[], ["simulat"], ["simulate"], ["simulate", "cup_spall", "--duration", "long"]]
)
def test_a_wrong_command_line_is_exit_code_2_and_names_the_help(words: list[str]) -> None:
    done = beardyn(*words)
    assert done.returncode == 2
    assert "--help`" in done.stderr
    assert "Traceback" not in done.stderr


def test_bad_input_is_reported_all_at_once_and_writes_nothing(tmp_path: Path) -> None:
    scene = tmp_path / "bad.yaml"
    scene.write_text("scene: bad\nbearing: HS130\nlubricant: L055\nwidht: 3\noperation: {kind: constant}\n")
    done = beardyn("simulate", "bad.yaml", "-o", "missing/run.mcap", "--json", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stdout == ""
    assert "Traceback" not in done.stderr
    lines = done.stderr.strip().splitlines()
    assert all(line.startswith("beardyn: ") for line in lines)
    assert len(lines) == 5
    for words in ("'HS130'", "widht", "force_kN is missing", "speed_rpm is missing", "missing/run.mcap"):
        assert any(words in line for line in lines)
    assert list(tmp_path.iterdir()) == [scene]


def test_output_into_a_folder_is_refused_before_anything_starts(tmp_path: Path) -> None:
    done = beardyn("simulate", "static_5kN", "-o", str(tmp_path))
    assert done.returncode == 2
    assert "is a folder" in done.stderr


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_output_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    path.touch(mode=0o400)
    done = beardyn("simulate", "static_5kN", "-o", str(path))
    assert done.returncode == 2
    assert "cannot be written" in done.stderr


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_unknown_effects_of_a_shipped_scene_are_refused(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command.main(["simulate", name, "--effects", "standart"]) == command.BAD_INPUT
    assert "did you mean standard?" in capsys.readouterr().err


@pytest.mark.parametrize("module", ["argparse", "pkgutil", "beardyn_core.config", "tqdm"])
def test_ctrl_c_while_modules_load_ends_cleanly(module: str) -> None:
    code = (
        "import signal, sys\n"
        "from beardyn_core.cli.main import main\n"
        "class Impatient:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        f"        if name == {module!r}:\n"
        "            signal.raise_signal(signal.SIGINT)\n"
        f"sys.modules.pop({module!r}, None)\n"
        "sys.meta_path.insert(0, Impatient())\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "sys.exit(main(['simulate', 'static_5kN', '--duration', '0.1']))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[2])},
    )
    assert done.returncode == command.INTERRUPTED, done.stderr
    assert done.stderr.splitlines()[-1].startswith("beardyn: interrupted")
    assert "Traceback" not in done.stderr


def test_the_bearing_command_offers_the_tilts_that_the_solution_knows() -> None:
    known = parameters_of(equilibrium)
    assert get_args(known["tilt"].hint) == static.TILT_MODES
    assert get_args(known["rings"].hint) == RINGS


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no device that is always full")
def test_a_full_disk_is_exit_code_2_with_a_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["simulate", "static_5kN", "--duration", "0.02", "-o", "/dev/full", "--json"]
    assert command.main(words) == command.BAD_INPUT
    told = capsys.readouterr()
    assert told.out == ""
    assert "cannot write on /dev/full: No space left on device" in told.err
    assert "Traceback" not in told.err


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (
            OSError(errno.ENOSPC, "No space left on device", "run.mcap"),
            "run.mcap: No space left on device; free",
        ),
        (OSError(errno.ENOSPC, "No space left on device"), "the output: No space left on device; free space"),
        (OSError(errno.EROFS, "Read-only", "a"), "a: Read-only; choose another place"),
        (OSError(errno.ENAMETOOLONG, "File name too long", "aaa"), "aaa: File name too long\n"),
        (OSError(errno.EIO, "Input/output error"), "beardyn: Input/output error\n"),
    ],
)
def test_advice_about_space_is_given_only_where_space_is_the_matter(
    error: OSError, sentence: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refused(_: argparse.Namespace) -> int:
        raise error

    monkeypatch.setattr(schema, "run", refused)
    assert command.main(["schema"]) == command.BAD_INPUT
    assert sentence in capsys.readouterr().err


def test_a_letter_that_the_terminal_has_not_is_written_as_its_number(monkeypatch: pytest.MonkeyPatch) -> None:
    def warm(_: argparse.Namespace) -> int:
        print("5 °C")
        return 0

    monkeypatch.setattr(schema, "run", warm)
    for errors in ("strict", "surrogateescape"):  # the second is that of the locale C
        shown = io.BytesIO()
        monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(shown, "ascii", errors=errors))
        assert command.main(["schema"]) == command.DONE
        assert shown.getvalue() == b"5 \\xb0C\n"


@pytest.mark.skipif(os.name == "nt", reason="a shell closes the streams")
def test_a_command_runs_with_closed_streams() -> None:
    root = str(Path(__file__).resolve().parents[2])
    words = [sys.executable, "-m", "beardyn_core.cli.main", "schema", "bearing"]
    for closed in (">&-", "2>&-", ">&- 2>&-"):
        done = subprocess.run(
            ["sh", "-c", f'"$@" {closed}', "sh", *words],
            capture_output=True,
            text=True,
            timeout=120,
            env={**os.environ, "PYTHONPATH": root},
            check=False,
        )
        assert (done.returncode, done.stderr) == (command.DONE, "")


def options() -> list[tuple[str, argparse.Action]]:
    parser = command.build_parser()
    group = next(each for each in parser._actions if isinstance(each, argparse._SubParsersAction))
    return [(name, action) for name, each in group.choices.items() for action in each._actions]


@pytest.mark.parametrize(
    ("name", "action"), [pytest.param(*each, id=f"{each[0]} {each[1].dest}") for each in options()]
)
def test_every_option_says_what_it_is_and_its_default(name: str, action: argparse.Action) -> None:
    assert action.help, name
    takes_value = action.option_strings and action.nargs != 0
    assert ("default" in action.help) or not takes_value


@pytest.mark.parametrize("name", command.command_names())
def test_help_of_a_command_is_printed(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        command.main([name, "--help"])
    assert ended.value.code == 0
    assert f"usage: beardyn {name}" in capsys.readouterr().out


def test_a_program_that_calls_twice_is_told_on_the_stderr_of_each_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for _ in range(2):
        stream = io.StringIO()
        monkeypatch.setattr(sys, "stderr", stream)
        command.main(["schema", "lubricant"])
        logging.getLogger("beardyn").info("kernels ready")
        assert stream.getvalue() == "beardyn: kernels ready\n"
        stream.close()

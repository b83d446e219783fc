"""The desk part depends on nothing that only Linux has; what it takes from there has a way round.

A stand-in, no other system: a process in which what POSIX or Linux alone have is missing.
"""

from __future__ import annotations

import ast
from importlib.util import find_spec
from pathlib import Path

from test.commands import run_python

CORE = Path(__file__).parents[2] / "beardyn_core"
POSIX_MODULES = {"fcntl", "resource", "pwd", "grp", "termios", "pty", "syslog", "posix"}
LINUX_MEMBERS = {"os": {"sched_getaffinity", "killpg", "getuid", "uname", "fork", "setsid", "mkfifo"}}
MODULES = sorted(CORE.rglob("*.py"))
PRELUDE = f"""
import builtins, os
import psutil, rerun, distributed  # have their own ways on every system
for name in {sorted(LINUX_MEMBERS["os"])!r}:
    delattr(os, name)
whole = builtins.__import__
def without(name, globals=None, *rest):
    ours = (globals or {{}}).get("__name__", "").startswith("beardyn_core")
    if ours and name in {sorted(POSIX_MODULES)!r}:
        raise ModuleNotFoundError(name)
    return whole(name, globals, *rest)
builtins.__import__ = without
"""


def run(text: str, folder: Path) -> str:
    """Run a program as on a system that is not POSIX; what it printed."""
    return run_python(PRELUDE + text, folder)


def test_every_module_can_be_imported_elsewhere(tmp_path: Path) -> None:
    names = [".".join(path.relative_to(CORE.parent).with_suffix("").parts) for path in MODULES]
    absent = () if find_spec("torch") else ("beardyn_core.population.torch_data",)
    names = [name.removesuffix(".__init__") for name in names if not name.endswith(("__main__", *absent))]
    run(f"from importlib import import_module\nfor name in {names!r}: import_module(name)", tmp_path)


def test_a_bearing_is_answered_and_a_recording_refused_elsewhere(tmp_path: Path) -> None:
    said = run('from beardyn_core.cli.main import main\nassert main(["bearing", "HS130x230"]) == 0', tmp_path)
    assert "BPFO" in said
    run('from beardyn_core.cli.main import main\nassert main(["report", "none.mcap"]) == 2', tmp_path)


def test_files_are_whole_or_absent_elsewhere(tmp_path: Path) -> None:
    text = """
from pathlib import Path
from beardyn_core.base.outputs import as_a_whole
try:
    with as_a_whole(Path("kept.txt")) as fresh:
        fresh.write_text("half")
        raise ValueError
except ValueError:
    pass
assert not Path("kept.txt").exists()
with as_a_whole(Path("kept.txt")) as fresh:
    fresh.write_text("whole")
assert Path("kept.txt").read_text() == "whole"
"""
    run(text, tmp_path)


def test_what_posix_alone_has_is_asked_for_before_it_is_used() -> None:
    problems = []
    for path in MODULES:
        source = path.read_text(encoding="utf-8")
        for node in ast.walk(ast.parse(source)):
            if not (isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)):
                continue
            lonely = node.attr in LINUX_MEMBERS.get(node.value.id, ())
            if lonely and f'hasattr({node.value.id}, "{node.attr}")' not in source:
                problems.append(f"{path.name}:{node.lineno} {node.attr}")
            if node.attr == "SIGKILL" and 'hasattr(os, "killpg")' not in source:
                problems.append(f"{path.name}:{node.lineno} SIGKILL")
    assert not problems


def test_text_files_name_their_encoding() -> None:
    problems = []
    for path in MODULES:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
                name = node.func.attr
                named = any(keyword.arg == "encoding" for keyword in node.keywords)
                if name in ("read_text", "write_text") and not named:
                    problems.append(f"{path.name}:{node.lineno} {name}")
    assert not problems

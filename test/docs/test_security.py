"""What SECURITY.md says of code that is loaded and of ports that listen, held against the code."""

from __future__ import annotations

import ast
import contextlib
import re
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from mcap.records import Channel, Schema

from beardyn_core.base.errors import InputError
from beardyn_core.record import viewer
from beardyn_core.record.other_messages import _decoder

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "SECURITY.md").read_text(encoding="utf-8")
SOURCES = {
    path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
    for room in ("beardyn_core", "beardyn_ros")
    for path in (ROOT / room).rglob("*.py")
}


@cache
def calls() -> dict[str, list[ast.Call]]:
    """Calls of every module; read when a test asks, for each process collects all tests."""
    trees = {place: ast.parse(source) for place, source in SOURCES.items()}
    return {
        place: [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
        for place, tree in trees.items()
    }


@cache
def names_called() -> dict[str, set[str]]:
    """What every module calls, by name."""
    return {place: {ast.unparse(node.func) for node in found} for place, found in calls().items()}


def where(*names: str) -> set[str]:
    """Modules that call one of these."""
    return {place for place, called in names_called().items() if called & set(names)}


def test_pickles_are_read_from_the_cache_alone() -> None:
    assert where("pickle.loads", "pickle.load") == {"beardyn_core/choice/choice_cache.py"}
    assert "allow_pickle=True" not in "".join(SOURCES.values())


def test_yaml_is_read_by_the_safe_loader_alone() -> None:
    assert where("yaml.load") == {"beardyn_core/config/yaml_text.py"}
    assert "class _Loader(yaml.SafeLoader)" in SOURCES["beardyn_core/config/yaml_text.py"]
    assert not where("yaml.unsafe_load", "yaml.full_load", "yaml.load_all")


def test_nothing_is_evaluated_and_no_shell_is_started() -> None:
    assert not where("eval", "os.system", "os.popen", "marshal.loads", "__import__")
    assert where("exec") <= {"beardyn_core/cli/main.py"}  # of an empty text
    assert 'exec("")' in SOURCES["beardyn_core/cli/main.py"]
    assert "shell=True" not in "".join(SOURCES.values())


def test_modules_by_a_name_that_a_user_gives_are_monitors_alone() -> None:
    computed = set()
    for place, found in calls().items():
        for node in found:
            if ast.unparse(node.func).endswith("import_module"):
                first = ast.unparse(node.args[0])
                if not re.match(r"""f?['"]|f'\{__name__\}""", first):
                    computed.add((place, first))
    assert computed == {
        ("beardyn_core/monitor/chain/algorithm_by_name.py", "module_name"),  # --monitor, algorithm
        ("beardyn_core/experiments/code_digest.py", "name"),  # the same module again, for its digest
        ("beardyn_core/base/optional.py", "name"),  # libraries of an extra
        ("beardyn_core/cli/main.py", "module_of(name)"),  # the commands
    }


def test_a_monitor_comes_from_the_working_folder_or_the_path_and_by_name_only(tmp_path: Path) -> None:
    from beardyn_core.monitor.chain.algorithm_by_name import algorithm_named

    with pytest.raises(InputError, match="module:function"):
        algorithm_named(str(tmp_path / "monitor.py"))


class _StartedError(Exception):
    pass


HOSTILE = "__import__('pathlib').Path({here!r}).touch()"


@pytest.mark.parametrize("name", ["pkg/msg/Plain", "pkg/msg/Evil(int): {code} #", "pkg/msg/Evil\n{code}\n"])
@pytest.mark.parametrize(
    "definition",
    [
        "float64 x\n",
        "float64 x {code}\n",
        "float64 LIMIT={code}\n",
        "string LIMIT={code}\n",
        "string x '{code}'\n",
        "float64 x: {code}\n",
        "float64 x; {code}\n",
        "float64[{code}] x\n",
        "float64 x\n{code}\n",
    ],
)
def test_a_recorded_definition_of_a_message_runs_nothing(tmp_path: Path, name: str, definition: str) -> None:
    """Of other programs' recordings definitions become classes; none of these becomes a call."""
    here = tmp_path / "touched"
    code = HOSTILE.format(here=str(here))
    schema = Schema(
        id=1, name=name.format(code=code), encoding="ros2msg", data=definition.format(code=code).encode()
    )
    channel = Channel(id=1, topic="/x", message_encoding="cdr", metadata={}, schema_id=1)
    decode = _decoder(channel, schema)
    if decode is not None:
        with contextlib.suppress(Exception):
            decode(bytes(64))
    assert not here.exists()
    assert name != "pkg/msg/Plain" or definition != "float64 x\n" or decode is not None


@pytest.mark.parametrize("window", ["open_window", "waiting_window", "web_viewer", "screenshot"])
def test_the_viewer_listens_on_this_machine_only(
    window: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[str]] = []

    def note(words: list[str], **_: Any) -> None:
        asked.append([str(word) for word in words])
        raise _StartedError

    monkeypatch.setenv("DISPLAY", ":7")
    monkeypatch.setattr(subprocess, "run", note)
    monkeypatch.setattr(subprocess, "Popen", note)
    start = {
        "open_window": lambda: viewer.open_window(tmp_path / "a.rrd"),
        "waiting_window": viewer.waiting_window,
        "web_viewer": lambda: viewer.web_viewer().__enter__(),
        "screenshot": lambda: viewer.take_picture(tmp_path / "a.rrd", tmp_path / "a.png"),
    }
    with pytest.raises(_StartedError):
        start[window]()
    (words,) = asked
    assert words[words.index("--bind") + 1] == "127.0.0.1"


def test_a_live_view_starts_the_viewer_by_these_alone() -> None:
    rerun = {place for place, source in SOURCES.items() if "import rerun" in source}
    assert rerun
    for place in rerun:
        called = names_called()[place]
        assert not [name for name in called if re.search(r"(spawn|serve_grpc|serve_web\w*)$", name)], place


def test_dask_of_this_machine_listens_on_this_machine_only() -> None:
    (made,) = (
        node
        for node in calls()["beardyn_core/experiments/local.py"]
        if ast.unparse(node.func) == "LocalCluster"
    )
    said = {keyword.arg: ast.unparse(keyword.value) for keyword in made.keywords}
    assert said["host"] == "'127.0.0.1'"
    assert said["dashboard_address"] == "'127.0.0.1:0'"


def test_nothing_else_listens_or_calls_out() -> None:
    assert where("socket.socket") == {
        "beardyn_core/record/viewer.py",
        "beardyn_ros/processes.py",
    }  # free ports
    networks = (
        r"^\s*(?:import|from) (http|urllib|requests|socketserver|xmlrpc|ftplib|smtplib|aiohttp|websockets)\b"
    )
    assert not {place for place, source in SOURCES.items() if re.search(networks, source, re.MULTILINE)}


def test_the_page_names_what_loads_code_and_what_listens() -> None:
    for word in (
        "--monitor",
        "algorithm",
        "--scheduler",
        "BEARDYN_CACHE_DIR",
        "dashboard",
        "127.0.0.1",
        "DDS",
        "pickle",
    ):
        assert word in PAGE, word

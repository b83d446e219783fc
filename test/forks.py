"""Programs in processes of their own that begin with numba imported, which takes a second of a core."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType

_SERVER = """
import contextlib, importlib, io, json, os, sys, traceback
for name in sys.argv[1:]:
    importlib.import_module(name)
if "numba" in sys.modules:
    sys.modules["numba"].njit(lambda value: value + 1)(1)  # what numba imports when it first compiles
for line in sys.stdin:
    asked = json.loads(line)
    if child := os.fork():
        os.waitpid(child, 0)
        continue
    failed, printed = "", io.StringIO()
    try:
        os.environ.update(asked["environment"])
        os.chdir(asked["folder"])
        sys.path[:0] = asked["path"]
        sys.dont_write_bytecode = True  # an edit of the same second and length would not be seen
        with contextlib.redirect_stdout(printed):
            exec(compile(asked["program"], "<program>", "exec"), {"__name__": "__main__"})
    except BaseException:
        failed = traceback.format_exc()
    print(json.dumps([printed.getvalue(), failed]), flush=True)
    os._exit(0)
"""


class Forks:
    """A process that has imported some modules, and runs every program in a fork of itself.

    Parameters
    ----------
    modules : str
        What it imports; nothing that a program is to import anew.
    """

    def __init__(self, *modules: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-c", _SERVER, *modules],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def __enter__(self) -> Forks:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._process.communicate()

    def run(
        self, program: str, folder: Path, path: tuple[Path, ...], environment: Mapping[str, str] | None = None
    ) -> str:
        """Run a program; what it printed.

        Parameters
        ----------
        program : str
            Its text.
        folder : Path
            Where it runs.
        path : tuple of Path
            Where it looks for modules first.
        environment : mapping, optional
            Variables that differ from those here.
        """
        asked = {
            "program": program,
            "folder": str(folder),
            "path": [str(each) for each in path],
            "environment": dict(environment or {}),
        }
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(asked) + "\n")
        self._process.stdin.flush()
        printed, failed = json.loads(self._process.stdout.readline())
        assert not failed, failed
        return str(printed)

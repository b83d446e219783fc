"""Tests in several processes: a file stays in one, the longest begin, one that hangs costs only itself.

Without it every process makes the shared runs of a file again and compiles the same kernels, and one process
works alone at the end. Files that wait go to one process, so that the others have a core each meanwhile.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import LONG_FILES

pytest.importorskip("xdist", reason="pytest-xdist is not installed")

TESTS = """
import json, os, pathlib, time
import pytest

@pytest.mark.parametrize("number", range(4))
def test_it(number):
    time.sleep(0.02)
    with pathlib.Path(os.environ["SEEN"]).open("a") as seen:
        seen.write(json.dumps([os.environ["PYTEST_XDIST_WORKER"], __file__]) + "\\n")
"""


HANGS = """
import ctypes

def test_before():
    pass

def test_hangs():
    ctypes.PyDLL(None).pause()  # keeps the lock of the interpreter: nothing in Python can end it

def test_after():
    pass
"""

DIES = """
import os, time

if os.environ["PYTEST_XDIST_WORKER"] == "gw2":
    time.sleep(1.0)  # of the two new processes one collects its tests later

def test_before():
    pass

def test_dies():
    time.sleep(1.0)  # until the other process is there too
    os._exit(1)

def test_after():
    pass
"""


def test_a_file_has_one_process_the_longest_begin_and_one_process_has_those_that_wait(
    repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(repository / "conftest.py", tmp_path)
    (tmp_path / "pytest.ini").write_text("[pytest]\n")  # the root that names of tests begin at
    others = [f"test/{name}" for name in ("a/test_a.py", "b/test_b.py", "ros/test_c.py", "ros/test_d.py")]
    files = [tmp_path / name for name in (*others, LONG_FILES[0])]
    for path in files:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(TESTS)
    monkeypatch.setenv("SEEN", str(tmp_path / "seen"))
    words = [sys.executable, "-m", "pytest", "-q", "-n", "2", "-p", "no:cacheprovider", str(tmp_path)]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout
    seen = [json.loads(line) for line in (tmp_path / "seen").read_text().splitlines()]
    assert len(seen) == 4 * len(files)
    assert all(len({worker for worker, file in seen if file == str(path)}) == 1 for path in files)
    assert len({worker for worker, _ in seen}) == 2
    of_each = [list(dict.fromkeys(file for worker, file in seen if worker == w)) for w in ("gw0", "gw1")]
    waiting, computing = sorted(of_each, key=lambda each: str(files[4]) not in each)
    assert waiting[:2] == [str(files[4]), str(files[2])]
    assert computing[:2] == [str(files[0]), str(files[1])]


@pytest.mark.slow
def test_a_test_that_hangs_in_c_ends_its_process_and_every_other_test_is_run(
    repository: Path, tmp_path: Path
) -> None:
    shutil.copy(repository / "conftest.py", tmp_path)
    options = "faulthandler_timeout = 3\nfaulthandler_exit_on_timeout = true\n"
    (tmp_path / "pytest.ini").write_text(f"[pytest]\n{options}")
    for name, content in (("a", HANGS), ("b", "def test_b():\n    pass\n")):
        (tmp_path / f"test_{name}.py").write_text(content)
    words = [sys.executable, "-m", "pytest", "-rA", "-n", "2", "-p", "no:cacheprovider", str(tmp_path)]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert "1 failed, 3 passed" in done.stdout
    assert "FAILED test_a.py::test_hangs - worker" in done.stdout
    assert "in test_hangs" in done.stderr + done.stdout  # the traceback says where


@pytest.mark.slow
def test_when_all_processes_die_at_once_every_other_test_is_run(repository: Path, tmp_path: Path) -> None:
    """As when memory is short: the new processes collect their tests one after the other."""
    shutil.copy(repository / "conftest.py", tmp_path)
    (tmp_path / "pytest.ini").write_text("[pytest]\n")
    for name in "ab":
        (tmp_path / f"test_{name}.py").write_text(DIES)
    words = [sys.executable, "-m", "pytest", "-rA", "-n", "2", "-p", "no:cacheprovider", str(tmp_path)]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert "2 failed, 4 passed" in done.stdout


def test_files_that_begin_exist(repository: Path) -> None:
    assert [file for file in LONG_FILES if not (repository / file).is_file()] == []

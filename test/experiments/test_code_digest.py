"""The digests of code see every module that a monitor imports, and nothing else."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from beardyn_core.experiments.code_digest import simulator_digest

SCRIPT = (
    "import sys; sys.path.insert(0, '')\n"
    "from beardyn_core.experiments.code_digest import modules_of, monitor_digest\n"
    "files, packages = modules_of('watcher')\n"
    "print(monitor_digest('watcher:look'), sorted(files), sorted(packages))\n"
)
FILES = {
    "watcher.py": "import numpy as np\nfrom tools import level\nfrom tools.deep import LIMIT\n"
    "import plugins\ndef look(*_):\n    import late\n    return level(np, late, LIMIT)\n",
    "tools/__init__.py": "from .levels import level\n",
    "tools/levels.py": "from . import scale\nlevel = scale.SCALE.__mul__\n",
    "tools/scale.py": "SCALE = 2\n",
    "tools/deep/__init__.py": "from ..scale import SCALE\nLIMIT = 3 * SCALE\n",
    "late.py": "import json\n",
    "plugins.py": "import importlib\nchosen = importlib.import_module('by_name')\n",
    "by_name.py": "GAIN = 1\n",
    "unrelated.py": "NOTHING = 0\n",
}


def digest_in(folder: Path) -> str:
    root = str(Path(__file__).resolve().parents[2])
    done = subprocess.run(
        [sys.executable, "-B", "-c", SCRIPT],
        cwd=folder,
        env={"PYTHONPATH": root},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    return done.stdout.strip()


@pytest.fixture
def project(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path


def test_every_module_of_a_monitor_counts_and_no_other(project: Path) -> None:
    before = digest_in(project)
    assert before.endswith(
        "['by_name', 'late', 'plugins', 'tools', 'tools.deep', 'tools.levels', 'tools.scale', 'watcher'] "
        "['numpy']"
    )
    for name, text in FILES.items():
        (project / name).write_text(text + "# edited\n")
        assert (digest_in(project) != before) == (name != "unrelated.py"), name
        (project / name).write_text(text)
    assert digest_in(project) == before


def test_the_simulator_has_one_digest_of_all_its_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from beardyn_core.experiments import code_digest

    (tmp_path / "room").mkdir()
    (tmp_path / "room" / "force.py").write_text("A = 1\n")
    monkeypatch.setattr(code_digest, "_CORE", tmp_path)
    simulator_digest.cache_clear()
    one = simulator_digest()
    (tmp_path / "room" / "force.py").write_text("A = 2\n")
    simulator_digest.cache_clear()
    other = simulator_digest()
    monkeypatch.setattr(code_digest, "_package_version", lambda name: f"{name} 0")
    simulator_digest.cache_clear()
    third = simulator_digest()
    simulator_digest.cache_clear()
    assert len({one, other, third}) == 3

"""`pip install .` is enough for twin, load, recorder, monitor; what needs more says so before it begins."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

# all that an extra brings and nothing else does
EXTRAS = (
    *(
        "asammdf",
        "cma",
        "dask",
        "distributed",
        "gmsh",
        "h5py",
        "imageio_ffmpeg",
        "matplotlib",
        "nptdms",
        "pandas",
        "pyarrow",
    ),
    *("pyuff", "rerun", "skfem", "sklearn", "soundfile", "torch", "xarray", "zarr"),
)
WITHOUT = f"""
import sys
class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {EXTRAS!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Absent())
"""
MAIN = "from beardyn_core.cli.main import main\nsys.exit(main(sys.argv[1:]))\n"


def light(program: str, *arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a program where no extra is installed."""
    return subprocess.run(
        [sys.executable, "-c", WITHOUT + program, *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


def test_a_run_is_simulated_recorded_monitored_and_reported(tmp_path: Path) -> None:
    scene = ("cup_spall", "--tier", "lumped", "--effects", "standard", "--duration", "1.5", "-o", "run.mcap")
    done = light(MAIN, "simulate", *scene, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    received = light(MAIN, "monitor", "run.mcap", folder=tmp_path)
    assert "BPFO found" in received.stdout, received.stderr
    assert light(MAIN, "report", "run.mcap", folder=tmp_path).returncode == 0
    assert light(MAIN, "export", "run.mcap", "-o", "run.csv", folder=tmp_path).returncode == 0


@pytest.mark.skipif(find_spec("rclpy") is None, reason="ROS 2 is not installed")
@pytest.mark.parametrize("node", ["twin", "load", "recorder", "monitor", "follower", "car"])
def test_nodes_are_imported(node: str, tmp_path: Path) -> None:
    module = "car" if node == "car" else f"{node}_node"
    done = light(f"import beardyn_ros.{module}", folder=tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("library", "extra", "arguments"),
    [
        ("rerun", "view", ("view", "none.mcap")),
        ("matplotlib", "plot", ("view", "none.mcap", "--gif", "moving.gif")),
        ("imageio_ffmpeg", "mp4", ("view", "none.mcap", "--mp4", "moving.mp4")),
        ("rerun", "view", ("demo",)),
        ("matplotlib", "plot", ("demo",)),
        ("matplotlib", "plot", ("trial", "quick", "-o", "folder")),
        ("distributed", "sweep", ("trial", "quick")),
        ("distributed", "sweep", ("ladder", "cup_spall")),
        ("distributed", "sweep", ("sweep", "fifty", "-o", "folder")),
        ("matplotlib", "plot", ("contacts", "-o", "folder")),
        ("rerun", "view", ("contacts", "--rrd", "rolling.rrd")),
        ("matplotlib", "plot", ("monitor", "none.mcap", "--picture", "picture.png")),
        ("rerun", "view", ("structure", "high_speed", "--save", "modes.rrd")),
    ],
)
def test_what_is_missing_is_said_in_a_sentence_before_anything_begins(
    library: str, extra: str, arguments: tuple[str, ...], tmp_path: Path
) -> None:
    done = light(MAIN, *arguments, folder=tmp_path)
    assert done.returncode == 2, (done.stdout, done.stderr)
    (sentence,) = (line for line in done.stderr.splitlines() if f" needs {library}," in line)
    assert f"pip install 'beardyn[{extra}]'" in sentence
    assert "Traceback" not in done.stderr
    assert list(tmp_path.iterdir()) == []

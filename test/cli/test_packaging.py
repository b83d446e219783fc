"""What `pip install .` puts where: modules, configuration, the index entry and executables of ROS 2."""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

import pytest

from beardyn_core.config import shipped_names
from beardyn_core.config.folders import KINDS

EXECUTABLES = ("twin", "load", "recorder", "viewer", "monitor", "car_twin", "car_load", "car_recorder")
# no rosdep key
FROM_PIP = {
    "asammdf",
    "cma",
    "distributed",
    "gmsh",
    "mcap",
    "amqtt",
    "imageio-ffmpeg",
    "colcon-package-information",
    "colcon-ros",
    "colcon-test-result",
    "foxglove-sdk",
    "nptdms",
    "pyarrow",
    "pyuff",
    "rerun-sdk",
    "scikit-fem",
    "threadpoolctl",
    "xarray",
    "zarr",
    "zstandard",
}
LEFT_OUT = (".git", ".venv", "build", "__pycache__", "*.egg-info", "*.mcap", "*.rrd")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> zipfile.ZipFile:
    import shutil

    folder = tmp_path_factory.mktemp("packaging")
    source = folder / "beardyn"
    shutil.copytree(Path(__file__).resolve().parents[2], source, ignore=shutil.ignore_patterns(*LEFT_OUT))
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation"]
    command += ["--config-settings", "kernels=no"]  # two minutes of compiling
    subprocess.run([*command, "--wheel-dir", str(folder), str(source)], check=True, timeout=300, cwd=folder)
    (path,) = folder.glob("beardyn-*.whl")
    return zipfile.ZipFile(path)


def installed(wheel: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Data files by their place under the prefix."""
    marker = ".data/data/"
    return {info.filename.split(marker)[1]: info for info in wheel.infolist() if marker in info.filename}


def test_wheel_holds_the_whole_configuration(wheel: zipfile.ZipFile) -> None:
    files = installed(wheel)
    for kind in KINDS:
        for name in shipped_names(kind):
            assert f"share/beardyn/config/{kind}/{name}.yaml" in files


def test_wheel_holds_what_ros2_looks_for(wheel: zipfile.ZipFile, repository: Path) -> None:
    files = installed(wheel)
    assert "share/ament_index/resource_index/packages/beardyn" in files
    assert "share/beardyn/package.xml" in files
    for launch in (repository / "launch").glob("*.py"):
        assert f"share/beardyn/launch/{launch.name}" in files
    for bridge in (repository / "bridges").glob("*.yaml"):
        assert f"share/beardyn/bridges/{bridge.name}" in files
    for name in EXECUTABLES:
        assert files[f"lib/beardyn/{name}"].external_attr >> 16 & 0o111 == 0o111


def test_wheel_holds_every_module_and_data_file_of_the_packages(
    wheel: zipfile.ZipFile, repository: Path
) -> None:
    names = set(wheel.namelist())
    for package in ("beardyn_core", "beardyn_ros"):
        for path in (repository / package).rglob("*"):
            if path.is_file() and "__pycache__" not in path.parts:
                assert path.relative_to(repository).as_posix() in names
    assert not any(name.startswith(("test/", "evidence/", "benchmarks/")) for name in names)


def test_wheel_says_that_both_packages_are_typed(wheel: zipfile.ZipFile) -> None:
    assert {"beardyn_core/py.typed", "beardyn_ros/py.typed"} <= set(wheel.namelist())


def test_package_xml_and_setup_agree(repository: Path, wheel: zipfile.ZipFile) -> None:
    package = ElementTree.parse(repository / "package.xml").getroot()
    (metadata,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
    lines = wheel.read(metadata).decode().splitlines()
    assert f"Name: {package.findtext('name')}" in lines
    assert f"Version: {package.findtext('version')}" in lines
    assert package.get("format") == "3"
    assert package.findtext("export/build_type") == "ament_python"


def test_package_xml_names_every_requirement_that_rosdep_has(
    repository: Path, wheel: zipfile.ZipFile
) -> None:
    package = ElementTree.parse(repository / "package.xml").getroot()
    (metadata,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
    lines = wheel.read(metadata).decode().splitlines()
    wanted: dict[str, set[str]] = {"exec_depend": set(), "test_depend": set()}
    for line in lines:
        if line.startswith("Requires-Dist: ") and ("extra" not in line or "'test'" in line.replace('"', "'")):
            name = re.split(r"[ <>=;~!\[]", line.removeprefix("Requires-Dist: "))[0]
            wanted["test_depend" if "extra" in line else "exec_depend"].add(name.lower())
    assert {"numba", "pydantic"} <= wanted["exec_depend"]
    assert {"hypothesis", "pytest", "psutil"} <= wanted["test_depend"]
    for tag, names in wanted.items():
        keys = {str(element.text) for element in package.iter(tag)}
        for name in names - FROM_PIP:
            spelled = {"pyyaml": "yaml", "rosbags": "rosbags-pip", "scikit-learn": "sklearn"}.get(name, name)
            assert {f"python3-{spelled}", name} & keys, f"{name} is in setup.py and not in package.xml"


@pytest.mark.parametrize("name", EXECUTABLES)
def test_executables_start_the_node_of_their_name(repository: Path, name: str, tmp_path: Path) -> None:
    prefix = tmp_path / "prefix"
    (prefix / "bin").mkdir(parents=True)
    (prefix / "lib" / "beardyn").mkdir(parents=True)
    script = prefix / "lib" / "beardyn" / name
    script.symlink_to(repository / "scripts" / name)
    python = prefix / "bin" / "python3"
    python.write_text('#!/bin/sh\necho "$@"\n')
    python.chmod(0o755)
    done = subprocess.run([script, "--ros-args", "-p", "a:=b c"], capture_output=True, text=True, check=True)
    assert done.stdout == f"-m beardyn_ros {name} --ros-args -p a:=b c\n"

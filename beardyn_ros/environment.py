"""What must be there before a node starts: ROS 2 with its variables, and Python packages of the right age.

ROS 2 from wheels sets no variables, and rosdep installs the packages that the distribution has, such as numba
0.56 and pydantic 1.10 in Debian 12: either is said in a sentence instead of an import that fails somewhere.
"""

from __future__ import annotations

import importlib.util
import os
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from re import match

FASTDDS_PROFILE = Path(__file__).with_name("fastdds_profile.xml")
FASTDDS_2_PROFILE = Path(__file__).with_name("fastdds_2_profile.xml")
FASTDDS_LOCAL_PROFILE = Path(__file__).with_name("fastdds_local_profile.xml")
FASTDDS_2_DISTRIBUTIONS = ("humble", "iron", "jazzy")  # some names in a profile changed with Fast DDS 3
FASTDDS_MIDDLEWARE = ("rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp")
PROFILE_VARIABLES = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
MISSING_ROS = (
    "beardyn: rclpy is not importable, so there is no ROS 2 in this environment. Either install it with "
    "`pip install .[ros]` in a clean virtual environment, or source a ROS 2 installation "
    "(`source /opt/ros/<distro>/setup.bash`) and start again. The desk path (`beardyn demo`, "
    "`beardyn simulate`) needs no ROS 2."
)
# what the code cannot do without, from setup.py: first version, and the first that is too new
NEEDED: dict[str, tuple[str, str | None]] = {
    "numba": ("0.68", "0.69"),
    "numpy": ("1.26", None),
    "pydantic": ("2.7", None),
    "rosbags": ("0.11", "0.12"),
    "scipy": ("1.13", None),
}


def ros_available() -> bool:
    """Check whether rclpy can be found; nothing is imported."""
    return importlib.util.find_spec("rclpy") is not None


def prepare_environment() -> None:
    """Fill in what a sourced ROS 2 would have set; whatever is set already stays.

    Notes
    -----
    The wheels leave `AMENT_PREFIX_PATH` unset, a missing or read-only home stops the logger, and the
    announcements and acknowledgements of Fast DDS come up to 3 s apart unless a profile says otherwise: what
    is lost on the way is then sent again too late. The profile also leaves out shared memory, in which a
    killed process stops others. Where `RMW_IMPLEMENTATION` names another middleware nothing is set for
    Fast DDS; nothing ever sets `RMW_IMPLEMENTATION`.
    """
    if not (os.environ.get("ROS_LOG_DIR") or os.environ.get("ROS_HOME") or _home_is_writable()):
        folder = Path(tempfile.gettempdir()) / f"ros_log_{os.getuid()}"
        folder.mkdir(parents=True, exist_ok=True)
        os.environ["ROS_LOG_DIR"] = str(folder)
        os.environ.setdefault("HOME", str(folder))
    distribution = os.environ.get("ROS_DISTRO", "")
    if not distribution and not os.environ.get("AMENT_PREFIX_PATH"):
        os.environ["AMENT_PREFIX_PATH"] = str(_wheel_prefix())
    if any(os.environ.get(name) for name in PROFILE_VARIABLES):
        return
    if os.environ.get("RMW_IMPLEMENTATION", FASTDDS_MIDDLEWARE[0]) not in ("", *FASTDDS_MIDDLEWARE):
        return
    old = distribution in FASTDDS_2_DISTRIBUTIONS
    profile, variable = (FASTDDS_2_PROFILE if old else FASTDDS_PROFILE), PROFILE_VARIABLES[old]
    if profile.is_file():
        os.environ[variable] = str(profile)


def this_machine_only() -> dict[str, str]:
    """Choose the variables of nodes that talk to this machine only.

    Returns
    -------
    dict
        With Fast DDS 3 a profile of the loopback interface: ``LOCALHOST`` would add shared memory to any
        profile. ``LOCALHOST`` where that profile cannot serve: another middleware, Fast DDS 2, a profile of
        the user's own.
    """
    ours = ("", str(FASTDDS_PROFILE), str(FASTDDS_LOCAL_PROFILE))
    middleware = os.environ.get("RMW_IMPLEMENTATION") or _default_middleware()
    can_serve = (
        middleware in FASTDDS_MIDDLEWARE
        and os.environ.get("ROS_DISTRO", "") not in FASTDDS_2_DISTRIBUTIONS
        and all(os.environ.get(name, "") in ours for name in PROFILE_VARIABLES)
        and FASTDDS_LOCAL_PROFILE.is_file()
    )
    if not can_serve:
        return {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    return {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "SYSTEM_DEFAULT",
        PROFILE_VARIABLES[0]: str(FASTDDS_LOCAL_PROFILE),
    }


def _default_middleware() -> str:
    """Ask ROS which middleware it takes when nobody names one; '' when there is no ROS."""
    if not ros_available():
        return ""
    from rclpy.utilities import get_rmw_implementation_identifier

    return str(get_rmw_implementation_identifier())


def _wheel_prefix() -> Path:
    """Find the folder that holds `share/ament_index` of the wheels."""
    spec = importlib.util.find_spec("rclpy")
    if spec is not None and spec.origin:
        for folder in Path(spec.origin).parents:
            if (folder / "share" / "ament_index").is_dir():
                return folder
    return Path(sys.prefix)


def _home_is_writable() -> bool:
    home = os.environ.get("HOME")
    return bool(home) and os.access(str(home), os.W_OK)


def requirement(name: str) -> str:
    """Write what pip needs to install a package: ``numba>=0.68,<0.69``."""
    first, beyond = NEEDED[name]
    return f"{name}>={first}" + (f",<{beyond}" if beyond else "")


def missing_requirements(installed: Callable[[str], str] | None = None) -> list[str]:
    """List in sentences what is missing, too old or too new, and what to do.

    Parameters
    ----------
    installed : callable, optional
        Gives the version of a package by its name; `PackageNotFoundError` when there is none. ``None``: of
        the packages that are here.
    """
    from importlib.metadata import PackageNotFoundError, version

    installed = installed or version
    found = []
    for name, (first, beyond) in NEEDED.items():
        try:
            have = installed(name)
        except PackageNotFoundError:
            found.append(f"{name} is not installed")
            continue
        number = _number(have)
        if number < _number(first):
            found.append(f"{name} {have} is too old")
        elif beyond and number >= _number(beyond):
            found.append(f"{name} {have} is too new")
    if not found:
        return []
    needs = " ".join(f"'{requirement(name)}'" for name in NEEDED)
    return [
        *found,
        "the packages of this distribution do not do: make a virtual environment that sees the sourced ROS 2 "
        f"(python3 -m venv --system-site-packages DIR) and install there: DIR/bin/pip install {needs}; "
        "docs/quality.md has more",
    ]


def _number(text: str) -> tuple[int, ...]:
    found = match(r"\d+(\.\d+)*", text)
    return tuple(int(part) for part in found[0].split(".")) if found else (0,)

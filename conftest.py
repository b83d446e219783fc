"""Shared by all tests: no user configuration leaks in, nothing is written outside temporary folders."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import pytest

# With a process a core, threads of linear algebra only wait for each other: a quarter of the time of rides.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from hypothesis import settings

REPOSITORY = Path(__file__).resolve().parent

STANDARD_CONFIGURATION = REPOSITORY / ".pytest_cache" / "standard_config"
NO_DATA = REPOSITORY / ".pytest_cache" / "no_data"  # no estimators of whoever runs the tests
# Tests of nodes, browsers and signals leave their core idle for two thirds of their time.
WAITING = ("test/ros/", "test/browser/", "test/cli/test_interrupts.py")
# Files of these folders share what takes long to make.
TOGETHER = ("test/population/", "test/follow/")
# Files that take longer than about twenty seconds, once compiled or before, the longest first.
LONG_FILES = (
    "test/ros/test_load_stream.py",
    "test/analytic/test_symmetries_of_effects.py",
    "test/ros/test_recorder.py",
    "test/kernels/test_defect.py",
    "test/kernels/test_patch_power.py",
    "test/ros/test_twin_node.py",
    "evidence/hard/test_hard.py",
    "test/follow/test_estimator.py",
    "test/kernels/test_joint_lamina.py",
    "test/ros/test_wall_time.py",
    "test/ros/test_launch_files.py",
    "test/ros/test_workspace.py",
    "test/cli/test_interrupts.py",
    "test/ros/test_car.py",
    "test/ros/test_scene_with_axleboxes.py",
    "test/ros/test_load_control.py",
    "test/browser/test_web_viewer.py",
    "test/ros/test_bag_replay.py",
    "test/choice/test_choose.py",
    "test/ros/test_several_axleboxes.py",
    "test/ros/test_nothing_lost.py",
    "test/ros/test_enclaves.py",
    "test/population/test_sweeping.py",
    "test/experiments/test_engine.py",
    "test/analytic/test_dynamics_steady.py",
    "test/analytic/test_missing_rollers.py",
    "test/tiers/test_runs.py",
    "test/study/test_trial.py",
    "test/choice/test_robust.py",
    "test/face/test_examples.py",
    "test/ros/test_monitor.py",
    "test/ros/test_real_twin.py",
    "test/analytic/test_dynamics_free_flight.py",
)
# What `colcon test` runs when it is given no tests: a minute or two, with real nodes, and nothing compiled.
IN_A_WORKSPACE = (
    "test/ros/test_requirements.py",
    "test/ros/test_parameters.py",
    "test/ros/test_shared_parameters.py",
    "test/ros/test_launch_files.py",
    "test/ros/test_malformed.py",
    "test/cli/test_packaging.py",
    "test/test_package_tables.py",
    "test/test_no_circles.py",
)


def keep_bytecode(folder: Path) -> None:
    """Let the tests and the processes they start keep the bytecode of modules in a folder.

    Containers often forbid bytecode beside the sources. Each of some hundred processes would then translate
    every module that it imports again, a quarter of a second, and pytest every test, five seconds.

    Parameters
    ----------
    folder : Path
        Used only where the environment forbids bytecode.
    """
    if not sys.dont_write_bytecode:
        return
    sys.dont_write_bytecode = False
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    sys.pycache_prefix = os.environ["PYTHONPYCACHEPREFIX"] = str(folder)


keep_bytecode(REPOSITORY / ".pytest_cache" / "bytecode")


def use_standard_effects() -> None:
    """Read every scene that names no effects with the standard ones, here and in processes begun here."""
    from beardyn_core.config import automatic
    from test.standard import NAME, write_configuration

    automatic.UNNAMED = NAME
    os.environ["BEARDYN_CONFIG"] = str(write_configuration(STANDARD_CONFIGURATION))
    os.environ["BEARDYN_DATA_DIR"] = str(NO_DATA)


def pytest_configure(config: pytest.Config) -> None:
    """Take the standard effects, tests of `colcon test`, in the fast suite always the same examples."""
    if (REPOSITORY / "test" / "standard.py").is_file():  # not beside a copy of this file, in its own tests
        use_standard_effects()
    if "COLCON" in os.environ and config.args_source is pytest.Config.ArgsSource.TESTPATHS:
        config.args = [str(REPOSITORY / name) for name in IN_A_WORKSPACE]
    settings.register_profile("repeatable", derandomize=True)
    if config.getoption("markexpr") == "not slow":
        settings.load_profile("repeatable")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes longest, so that no process works alone at the end."""
    items.sort(key=lambda item: _rank(item.nodeid))


def _rank(nodeid: str) -> int:
    file = nodeid.partition("::")[0]
    return LONG_FILES.index(file) if file in LONG_FILES else len(LONG_FILES)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Hand whole files to the processes, for the tests of a file share runs, in the order of collection.

    As long as there are both, one process has files that wait and the others have files that compute.
    """
    from xdist.scheduler import LoadFileScheduling

    class ByFile(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.partition("::")[0]
            return next((folder for folder in TOGETHER if file.startswith(folder)), file)

        def _assign_work_unit(self, node: Any) -> None:
            """Give a process the next file of the kind that is wanted now."""
            elsewhere = [work for other, work in self.assigned_work.items() if other is not node]
            begun = [file for work in elsewhere for file, tests in work.items() if not all(tests.values())]
            computing = any(file.startswith(WAITING) for file in begun)
            wanted = (file for file in self.workqueue if file.startswith(WAITING) != computing)
            if (file := next(wanted, None)) is not None:
                self.workqueue.move_to_end(file, last=False)
            super()._assign_work_unit(node)

        def remove_node(self, node: Any) -> str | None:
            """Take back the work of a process that has died, without the test that it died in.

            pytest-xdist 3.8 would give that test to the next process, and the one after it, for ever.
            """
            work = self.assigned_work.pop(node)
            waiting = [(group, test) for group in work for test, done in work[group].items() if not done]
            if not waiting:
                return None
            group, died_in = waiting[0]
            work[group][died_in] = True
            self.workqueue.update({name: tests for name, tests in work.items() if not all(tests.values())})
            for other in self.assigned_work:
                self._reschedule(other)
            return died_in

        def _reschedule(self, node: Any) -> None:
            """Give a process two tests, or tell it that there are no more: else it does not begin one."""
            if node not in self.registered_collections:
                return  # it has taken the place of one that died, and is still collecting
            super()._reschedule(node)
            while not node.shutting_down and self._pending_of(self.assigned_work[node]) < 2:
                super()._reschedule(node)

    config.option.loadscopereorder = False
    return ByFile(config, log)


@pytest.fixture
def shipped_configuration(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take the configuration as it is shipped, and what is computed where a scene names no effects."""
    from beardyn_core.config import automatic

    monkeypatch.delenv("BEARDYN_CONFIG")
    monkeypatch.setattr(automatic, "UNNAMED", automatic.AUTO)


@pytest.fixture
def repository() -> Path:
    """Root of the checkout."""
    return REPOSITORY

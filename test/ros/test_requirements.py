"""Python packages of a distribution that are too old are told in a sentence."""

from __future__ import annotations

import ast
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest

from beardyn_ros.environment import NEEDED, missing_requirements, requirement

REPOSITORY = Path(__file__).parents[2]
DEBIAN_12 = {"numba": "0.56.4", "numpy": "1.24.2", "pydantic": "1.10.4", "scipy": "1.10.1"}


def in_debian_12(name: str) -> str:
    if name not in DEBIAN_12:
        raise PackageNotFoundError(name)
    return DEBIAN_12[name]


def test_what_is_needed_here_is_here_and_the_numbers_are_those_of_setup_py() -> None:
    assert missing_requirements() == []
    written = {
        node.value for node in ast.walk(ast.parse((REPOSITORY / "setup.py").read_text()))
        if isinstance(node, ast.Constant)
    }  # fmt: skip
    assert {requirement(name) for name in NEEDED} <= written


def test_every_package_that_does_not_do_is_named_with_what_to_do() -> None:
    sentences = missing_requirements(in_debian_12)
    assert sentences[:2] == ["numba 0.56.4 is too old", "numpy 1.24.2 is too old"]
    assert "rosbags is not installed" in sentences
    assert "--system-site-packages" in sentences[-1]
    assert "'numba>=0.68,<0.69'" in sentences[-1]
    assert (
        missing_requirements({**DEBIAN_12, "rosbags": "0.12.0"}.__getitem__)[3] == "rosbags 0.12.0 is too new"
    )


def test_a_node_says_it_and_ends_with_2(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("rclpy", reason="rclpy is not installed (pip install .[ros])")
    from beardyn_ros import __main__

    monkeypatch.setattr(__main__, "missing_requirements", lambda: missing_requirements(in_debian_12))
    assert __main__.main(["twin"]) == 2
    assert "beardyn: pydantic 1.10.4 is too old" in capsys.readouterr().err
    assert NEEDED["pydantic"] == ("2.7", None)

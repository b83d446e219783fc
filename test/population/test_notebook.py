"""The example notebook is that of its script, and its cells run."""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))
write_notebook = importlib.import_module("write_notebook")
sys.path.pop(0)


def test_the_notebook_is_that_of_the_script() -> None:
    assert write_notebook.main(["--check"]) == 0
    found = json.loads(write_notebook.NOTEBOOK.read_text(encoding="utf-8"))
    kinds = [cell["cell_type"] for cell in found["cells"]]
    assert kinds.count("code") >= 5
    assert kinds.count("markdown") >= 5


@pytest.mark.slow
def test_its_cells_run_with_fewer_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for kind, text in write_notebook.cells(write_notebook.SCRIPT.read_text(encoding="utf-8")):
        if kind == "code":
            exec(compile(text.replace("runs=50", "runs=24"), "notebook", "exec"), names)
    names["plt"].close("all")
    assert len(names["runs"]) == 24
    assert names["found"].count == len(names["runs"].runs_of("test"))

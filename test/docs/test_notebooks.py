"""The notebooks are those of their scripts, small, and their cells run."""

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

LARGEST = 150_000
SHORTER = (("runs=50", "runs=24"),)


@pytest.mark.parametrize("name", write_notebook.NAMES)
def test_a_notebook_is_that_of_its_script(name: str) -> None:
    assert write_notebook.main(["--check", name]) == 0
    path = write_notebook.EXAMPLES / f"{name}.ipynb"
    kinds = [cell["cell_type"] for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]]
    assert kinds.count("code") >= 5
    assert kinds.count("markdown") >= 5
    assert path.stat().st_size < LARGEST


@pytest.mark.parametrize("name", write_notebook.NAMES)
def test_a_notebook_shows_what_its_cells_answered(name: str) -> None:
    """It was run: there are texts and pictures, and no error among them."""
    whole = json.loads((write_notebook.EXAMPLES / f"{name}.ipynb").read_text(encoding="utf-8"))
    outputs = [each for cell in whole["cells"] for each in cell.get("outputs", ())]
    kinds = {each["output_type"] for each in outputs}
    assert kinds <= {"stream", "display_data", "execute_result"}
    assert "stream" in kinds
    pictures = [each for each in outputs if "image/png" in each.get("data", {})]
    drawn = sum("plt." in "".join(cell["source"]) for cell in whole["cells"] if cell["cell_type"] == "code")
    assert len(pictures) >= max(drawn - 1, 1)  # the first cell imports it


def test_an_output_goes_when_the_text_of_its_cell_is_another() -> None:
    """What a notebook shows is of the cells that it has: kept by their text, else dropped."""
    answer = [{"output_type": "stream", "name": "stdout", "text": ["1\n"]}]
    before = json.loads(write_notebook.notebook("# %%\nprint(1)\n", {"print(1)": answer}))
    after = json.loads(write_notebook.notebook("# %%\nprint(2)\n", {"print(1)": answer}))
    assert before["cells"][0]["outputs"] == answer
    assert after["cells"][0]["outputs"] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", write_notebook.NAMES)
def test_the_cells_of_a_notebook_run(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    script = (write_notebook.EXAMPLES / f"{name}.py").read_text(encoding="utf-8")
    for kind, text in write_notebook.cells(script):
        for before, after in SHORTER:
            text = text.replace(before, after)
        if kind == "code":
            exec(compile(text, "notebook", "exec"), names)
    names["plt"].close("all")
    if name == "sweep":
        assert len(names["runs"]) == 24
        assert names["found"].count == len(names["runs"].runs_of("test"))
    else:
        assert names["conclusion"].verdict == {"first_run": "cup", "own_data": "cone"}[name]

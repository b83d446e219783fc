"""Write the notebooks of docs/examples from the scripts beside them: ``python docs/write_notebook.py``.

Names may follow (``first_run``), else it is all of `NAMES`. The outputs of cells whose text is as it was
stay. ``--run`` executes the notebooks, each in a new folder, and keeps what they answer (needs the extras
``docs``, ``data`` and ``sweep``); ``--check`` writes nothing and ends with 1 when a notebook is not what its
script says.
"""

from __future__ import annotations

import base64
import io
import json
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

from PIL import Image

EXAMPLES = Path(__file__).parent / "examples"
NAMES = ("first_run", "own_data", "sweep")
COLOURS = 16
_MARK = re.compile(r"^# %%( \[markdown\])?\n", re.MULTILINE)


def cells(text: str) -> list[tuple[str, str]]:
    """Cut a script into cells: ``markdown`` or ``code``, and the text."""
    _, *parts = _MARK.split(text)
    found = []
    for mark, body in zip(parts[::2], parts[1::2], strict=True):
        if mark:
            body = "\n".join(line.removeprefix("#").removeprefix(" ") for line in body.strip().splitlines())
        found.append(("markdown" if mark else "code", body.strip()))
    return found


def notebook(text: str, kept: dict[str, Any]) -> str:
    """Write a notebook of a script, with the outputs that are kept of each text."""
    made = []
    for number, (kind, body) in enumerate(cells(text)):
        cell: dict[str, Any] = {"cell_type": kind, "id": f"cell{number}", "metadata": {}}
        if kind == "code":
            cell |= {"execution_count": None, "outputs": kept.get(body, [])}
        made.append({**cell, "source": body.splitlines(keepends=True)})
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    whole = {"cells": made, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


def outputs(path: Path) -> dict[str, Any]:
    """Find what the cells of a notebook have answered, by their text."""
    if not path.exists():
        return {}
    made = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return {"".join(cell["source"]): cell["outputs"] for cell in made if cell["cell_type"] == "code"}


def executed(text: str) -> dict[str, Any]:
    """Run the notebook of a script: what its cells answer, without bars and warnings."""
    import nbformat
    from nbclient import NotebookClient

    made = nbformat.reads(notebook(text, {}), as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(made, timeout=3600, resources={"metadata": {"path": folder}}).execute()
    for cell in made.cells:
        if cell.cell_type == "code":
            cell.outputs = [small(each) for each in cell.outputs if each.get("name") != "stderr"]
            if any(each.output_type == "display_data" for each in cell.outputs):  # the picture says it
                cell.outputs = [each for each in cell.outputs if each.output_type != "execute_result"]
    plain = json.loads(nbformat.writes(made))["cells"]
    return {"".join(cell["source"]): cell["outputs"] for cell in plain if cell["cell_type"] == "code"}


def small(output: Any) -> Any:
    """Leave the number of the run out of an answer, and draw a picture in few colours."""
    if "execution_count" in output:
        output["execution_count"] = None
    picture = output.get("data", {}).get("image/png")
    if picture:
        drawn = io.BytesIO()
        image = Image.open(io.BytesIO(base64.b64decode(picture))).convert("RGB")
        image.quantize(COLOURS).save(drawn, format="PNG", optimize=True)
        output["data"]["image/png"] = base64.b64encode(drawn.getvalue()).decode()
    return output


def main(arguments: list[str]) -> int:
    """Write, run, or check."""
    options = {each for each in arguments if each.startswith("--")}
    code = 0
    for name in [each for each in arguments if each not in options] or NAMES:
        path = EXAMPLES / f"{name}.ipynb"
        script = path.with_suffix(".py").read_text(encoding="utf-8")
        text = notebook(script, executed(script) if "--run" in options else outputs(path))
        if "--check" in options:
            code |= int(not path.exists() or path.read_text(encoding="utf-8") != text)
        else:
            path.write_text(text, encoding="utf-8")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Write docs/examples/sweep.ipynb from docs/examples/sweep.py: ``python docs/write_notebook.py``.

``--check`` writes nothing and ends with 1 when the notebook is not what the script says.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import Any

SCRIPT = Path(__file__).parent / "examples" / "sweep.py"
NOTEBOOK = SCRIPT.with_suffix(".ipynb")
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


def notebook(text: str) -> str:
    """Write a notebook of a script, without outputs."""
    made = []
    for number, (kind, body) in enumerate(cells(text)):
        cell: dict[str, Any] = {"cell_type": kind, "id": f"cell{number}", "metadata": {}}
        if kind == "code":
            cell |= {"execution_count": None, "outputs": []}
        made.append({**cell, "source": body.splitlines(keepends=True)})
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    whole = {"cells": made, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"


def main(arguments: list[str]) -> int:
    """Write, or check."""
    text = notebook(SCRIPT.read_text(encoding="utf-8"))
    if arguments == ["--check"]:
        return int(not NOTEBOOK.exists() or NOTEBOOK.read_text(encoding="utf-8") != text)
    NOTEBOOK.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

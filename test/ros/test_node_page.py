"""The node reference in docs/ is what the nodes declare."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"

pytestmark = pytest.mark.ros


def test_node_page_is_written_from_the_current_tables() -> None:
    written = runpy.run_path(str(DOCS / "write_nodes.py"))["page"]()
    assert (DOCS / "nodes.md").read_text(encoding="utf-8") == written, "run python docs/write_nodes.py"

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


def test_help_and_page_list_every_exit_code() -> None:
    from beardyn_ros.__main__ import usage
    from beardyn_ros.runtime import EXIT_CODES

    page = (DOCS / "nodes.md").read_text(encoding="utf-8")
    assert list(EXIT_CODES) == [0, 1, 2, 3, 4, 5, 130]
    for code, meaning in EXIT_CODES.items():
        assert f"| {code} | {meaning} |" in page
        assert f"  {code:<9} {meaning}" in usage()

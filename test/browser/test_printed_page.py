"""The page about an axlebox in a real browser: one sheet of A4 for one file and one box."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

import beardyn_core as bd
from test.browser.chromium import EXECUTABLE
from test.fault_signals import fault_signal
from test.recordings import import_signal

PATIENCE = 120.0

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(EXECUTABLE is None, reason="Chromium is not installed: apt-get install chromium"),
]
pytest.importorskip("matplotlib", reason="matplotlib, which draws the page, is not installed")


def test_the_page_prints_on_one_sheet(tmp_path: Path) -> None:
    run = import_signal(tmp_path / "run.mcap", fault_signal("cup", 1)[2], speed_rpm=60.0 * 19.2)
    page, paper = tmp_path / "page.html", tmp_path / "paper.pdf"
    bd.report(run, html=page, train="<b>train 7</b>", axlebox="轴箱 2")
    words = ["--headless", "--no-sandbox", "--disable-gpu", "--no-pdf-header-footer"]
    own = [f"--user-data-dir={tmp_path / 'profile'}", f"--print-to-pdf={paper}", page.as_uri()]
    subprocess.run([str(EXECUTABLE), *words, *own], check=True, capture_output=True, timeout=PATIENCE)
    assert len(re.findall(rb"/Type\s*/Page\b", paper.read_bytes())) == 1

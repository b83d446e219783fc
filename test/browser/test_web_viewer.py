"""The web viewer in a real browser: the 3-D view and the curves are drawn, not merely sent."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from test.browser.chromium import EXECUTABLE, Chromium
from test.recordings import write_recording

WIDTH, HEIGHT = 1120, 630
PATIENCE = 240.0

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(EXECUTABLE is None, reason="Chromium is not installed: apt-get install chromium"),
]
image = pytest.importorskip(
    "matplotlib.image", reason="matplotlib, which reads the pictures, is not installed"
)


@dataclass(frozen=True)
class Region:
    """Part of the page, as shares of its width and height."""

    left: float
    right: float
    top: float
    bottom: float

    def of(self, pixels: np.ndarray) -> np.ndarray:
        rows, columns = pixels.shape[:2]
        return pixels[
            int(self.top * rows) : int(self.bottom * rows),
            int(self.left * columns) : int(self.right * columns),
        ]


BEARING = Region(0.02, 0.52, 0.08, 0.84)
SCALE = Region(0.01, 0.28, 0.88, 0.95)
VIBRATION = Region(0.55, 0.96, 0.08, 0.33)
SPECTRUM = Region(0.54, 0.99, 0.38, 0.64)
ROLLER_LOAD = Region(0.55, 0.92, 0.70, 0.95)


def share_like(pixels: np.ndarray, colour: tuple[int, int, int], tolerance: float = 0.16) -> float:
    """Share of the pixels near a colour."""
    return float(np.mean(np.all(np.abs(pixels - np.array(colour) / 255.0) < tolerance, axis=-1)))


def shades(pixels: np.ndarray) -> int:
    """Different colours, 16 steps to a channel."""
    steps = (pixels * 15.999).astype(int)
    return len(np.unique(steps[..., 0] * 256 + steps[..., 1] * 16 + steps[..., 2]))


def colourful(pixels: np.ndarray) -> float:
    """Share of the pixels with a hue: neither background nor grid nor grey text."""
    return float(np.mean(np.ptp(pixels, axis=-1) > 0.25))


def drawn(pixels: np.ndarray) -> dict[str, bool]:
    """Which parts of the page show what they should."""
    bearing = BEARING.of(pixels)
    return {
        "bearing": shades(bearing) > 80 and float(np.mean(bearing.max(axis=-1) > 0.3)) > 0.12,
        "loaded rollers": share_like(bearing, (225, 60, 35), 0.2) > 0.001,
        "cage": share_like(bearing, (55, 130, 120), 0.12) > 0.005,
        "vibration": share_like(VIBRATION.of(pixels), (96, 156, 255)) > 0.01,
        "spectrum": share_like(SPECTRUM.of(pixels), (80, 145, 255)) > 0.001,
        "fault markers": share_like(SPECTRUM.of(pixels), (220, 70, 90), 0.25) > 0.0005,
        "scale of the colours": all(
            share_like(SCALE.of(pixels), colour) > 0.005 for colour in ((225, 40, 35), (245, 215, 60))
        ),
        "roller load": colourful(ROLLER_LOAD.of(pixels)) > 0.005,
    }


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("web")
    recording = write_recording(folder / "run.mcap", 50)
    root = Path(__file__).resolve().parents[2]
    command = (
        "import argparse; from beardyn_core.cli import view; "
        "parser = argparse.ArgumentParser(); view.add_parser(parser.add_subparsers()); "
        f"args = parser.parse_args(['view', {str(recording)!r}, '--web']); raise SystemExit(args.run(args))"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", command],
        cwd=root,
        env={**os.environ, "PYTHONPATH": str(root)},
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    line = process.stdout.readline()
    found = re.search(r"http://127\.0\.0\.1:\d+\S*", line)
    assert found is not None, line
    yield found.group(0)
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=20.0) == 0


@pytest.mark.slow
def test_bearing_and_curves_are_drawn_in_the_browser(page: str, tmp_path: Path) -> None:
    browser = Chromium(tmp_path / "profile", WIDTH, HEIGHT)
    try:
        browser.open(f"{page}&renderer=webgl")
        deadline = time.monotonic() + PATIENCE
        found: dict[str, bool] = {}
        while time.monotonic() < deadline:
            time.sleep(1.0)
            pixels = image.imread(browser.picture(tmp_path / "page.png"))[..., :3]
            found = drawn(pixels)
            if all(found.values()):
                break
    finally:
        browser.close()
    assert all(found.values()), f"not drawn: {[name for name, there in found.items() if not there]}"


@pytest.mark.slow
def test_an_empty_page_is_not_taken_for_a_drawing(tmp_path: Path) -> None:
    browser = Chromium(tmp_path / "profile", WIDTH, HEIGHT)
    try:
        browser.open("about:blank")
        pixels = image.imread(browser.picture(tmp_path / "blank.png"))[..., :3]
    finally:
        browser.close()
    assert not any(drawn(pixels).values())
    assert not any(drawn(np.full_like(pixels, 0.06)).values())


def test_the_server_listens_on_this_machine_only(page: str) -> None:
    port = int(re.search(r":(\d+)", page.removeprefix("http://127.0.0.1")).group(1))  # type: ignore[union-attr]
    listening = Path("/proc/net/tcp")
    if not listening.exists():
        pytest.skip("no /proc/net/tcp here")
    rows = [line.split() for line in listening.read_text().splitlines()[1:]]
    addresses = {
        row[1].split(":")[0] for row in rows if row[3] == "0A" and int(row[1].split(":")[1], 16) == port
    }
    assert addresses == {"0100007F"}

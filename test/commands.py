"""Programs in new processes that import this checkout."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def run_python(program: str, folder: Path = ROOT, timeout: float = 300.0) -> str:
    """Run a program in a new interpreter and take what it printed; it must end well.

    Parameters
    ----------
    program : str
        Its text.
    folder : Path
        Where it runs.
    timeout : float
        How long it may take, [s].
    """
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout

"""Build site, wheel and sdist; try both packages anew: ``python release/try_release.py [PYTHON ...]``.

PYTHON are interpreters to try them with, by default those of `SUPPORTED` that are here. Nothing of the
working tree is on their paths.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from pack_site import packed_site

ROOT = Path(__file__).parents[1]
DIST = ROOT / "dist"
SUPPORTED = ("python3.11", "python3.12", "python3.13")
TRIAL = """
import beardyn_core as bd
assert "site-packages" in bd.__file__, bd.__file__
run = bd.simulate("static_80kN", tier="lumped", effects="standard", duration=0.2, record="run.mcap")
assert run.vibration.values.shape[1] == 3 and bd.read("run.mcap").complete
"""


def call(*words: str | Path, folder: Path) -> str:
    """Run a program away from the working tree; what it printed. Its failure ends this one."""
    outside = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [*map(str, words)], cwd=folder, env=outside, text=True, capture_output=True, check=False
    )
    if done.returncode:
        sys.exit(f"{' '.join(map(str, words))}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def tried(python: str, package: Path) -> str:
    """Install a package in a new environment, ask it what a newcomer asks; its Python and version."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        call(python, "-m", "venv", folder / "venv", folder=folder)
        own = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
        call(own / "python", "-m", "pip", "install", "--quiet", package, folder=folder)
        version = call(own / "beardyn", "--version", folder=folder).strip()
        assert "BPFO" in call(own / "beardyn", "bearing", "HS130x230", folder=folder)
        assert "cup_spall" in call(own / "beardyn", "scenes", folder=folder)
        call(own / "python", "-c", TRIAL, folder=folder)
        assert "closed properly" in call(own / "beardyn", "report", "run.mcap", folder=folder)
        share = folder / "venv" / "share" / "beardyn"
        assert (share / "layouts" / "foxglove.json").is_file()
        assert (share / "launch").is_dir()
        return f"{call(own / 'python', '--version', folder=folder).strip()}, {version}"


def packages() -> list[Path]:
    """List wheel and sdist."""
    return [*DIST.glob("*.whl"), *DIST.glob("*.tar.gz")]


def is_here(python: str) -> bool:
    """Tell whether an interpreter runs; the name of one may stand for none."""
    found = shutil.which(python)
    return (
        found is not None
        and not subprocess.run([found, "--version"], capture_output=True, check=False).returncode
    )


def main(pythons: list[str]) -> None:
    """Build, then try each package with each interpreter."""
    for old in packages():
        old.unlink()
    packed_site(DIST)
    call(sys.executable, "-m", "build", "--outdir", DIST, ROOT, folder=ROOT)
    for package in packages():
        for python in pythons or [each for each in SUPPORTED if is_here(each)]:
            print(f"{package.name}: installed and tried, {tried(python, package)}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])

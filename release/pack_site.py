"""Build the documentation site and pack it for reading offline: ``python release/pack_site.py``.

A warning is an error. The archive is the same to the byte for the same pages and versions of Sphinx.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).parents[1]
DOCS, DIST = ROOT / "docs", ROOT / "dist"
VERSION = re.compile(r'version="([^"]+)"')
LEFT_OUT = (".buildinfo", ".doctrees", "objects.inv")
LINK = re.compile(r'(?:href|src)="([^"#?]+)[#?"]')
OUTSIDE = re.compile(r"[a-z][a-z+.-]*:|//")
DATE = (1980, 1, 1, 0, 0, 0)


def build(html: Path) -> None:
    """Build the pages; a warning ends this program."""
    options = ["--fail-on-warning", "--keep-going", "--quiet"]
    words = [sys.executable, "-m", "sphinx", *options, "-d", f"{html}.doctrees", str(DOCS), str(html)]
    if code := subprocess.run(words, check=False).returncode:
        sys.exit(code)


def dead_links(html: Path) -> list[str]:
    """List the links between pages that lead to no file of the site."""
    return [
        f"{page.relative_to(html)}: {target}"
        for page in sorted(html.rglob("*.html"))
        for target in LINK.findall(page.read_text(encoding="utf-8"))
        if not OUTSIDE.match(target) and not (page.parent / unquote(target)).exists()
    ]


def pack(html: Path, archive: Path) -> int:
    """Pack a site into one folder of a ZIP file; give the number of its files."""
    files = sorted(
        path
        for path in html.rglob("*")
        if path.is_file() and not any(part in LEFT_OUT for part in path.relative_to(html).parts)
    )
    archive.parent.mkdir(exist_ok=True)
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for path in files:
            place = zipfile.ZipInfo(f"{archive.stem}/{path.relative_to(html).as_posix()}", DATE)
            place.compress_type, place.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            packed.writestr(place, path.read_bytes())
    return len(files)


def packed_site(folder: Path = DIST) -> Path:
    """Build the site and pack it into a folder; give the archive."""
    version = VERSION.search((ROOT / "setup.py").read_text(encoding="utf-8"))
    assert version is not None
    archive = folder / f"beardyn-{version[1]}-site.zip"
    with tempfile.TemporaryDirectory() as place:
        html = Path(place) / "html"
        build(html)
        if dead := dead_links(html):
            sys.exit("links that lead to no file of the site:\n" + "\n".join(dead))
        count = pack(html, archive)
    print(
        f"{archive}: {count} files, {archive.stat().st_size / 1e6:.1f} MB; open index.html in it", flush=True
    )
    return archive


if __name__ == "__main__":
    packed_site()

"""What a release holds says the same version, licence and requirements everywhere."""

from __future__ import annotations

import ast
import importlib
import json
import re
import sys
import tomllib
import zipfile
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
import yaml

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "release"))
pack_site = importlib.import_module("pack_site")
sys.path.pop(0)


def setup_words() -> dict[str, Any]:
    """What setup.py gives to setuptools, as far as it is written out there, and its lists."""
    tree = ast.parse((ROOT / "setup.py").read_text(encoding="utf-8"))
    words: dict[str, Any] = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.List):
            with suppress(ValueError):
                words[ast.unparse(node.targets[0])] = ast.literal_eval(node.value)
    (call,) = (
        node for node in ast.walk(tree) if isinstance(node, ast.Call) and ast.unparse(node.func) == "setup"
    )
    for keyword in call.keywords:
        with suppress(ValueError):
            words[str(keyword.arg)] = ast.literal_eval(keyword.value)
    return words


SETUP = setup_words()


def requirements(lines: list[str]) -> dict[str, str]:
    """Packages, and which versions."""
    found = (re.fullmatch(r"([\w.-]+) ?(.*)", line) for line in lines)
    return {match[1]: match[2].replace(" ", "") for match in found if match}


def recipe() -> dict[str, Any]:
    loaded: dict[str, Any] = yaml.safe_load((ROOT / "release/conda/recipe.yaml").read_text(encoding="utf-8"))
    return loaded


def test_versions_are_one() -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == SETUP["version"]
    assert recipe()["context"]["version"] == SETUP["version"]
    assert citation["license"] == recipe()["about"]["license"] == SETUP["license"] == "Apache-2.0"
    assert citation["authors"] == [{"name": "beardyn developers"}]


def test_the_conda_recipe_asks_for_what_setup_asks_for() -> None:
    wanted = requirements(SETUP["INSTALL"])
    given = requirements(recipe()["requirements"]["run"])
    assert given.pop("python") == SETUP["python_requires"]
    assert given == wanted


def test_the_pixi_environment_allows_what_setup_asks_for() -> None:
    whole = tomllib.loads((ROOT / "release/pixi.toml").read_text(encoding="utf-8"))
    wanted = requirements(SETUP["INSTALL"])
    for package, versions in whole["dependencies"].items():
        if package not in ("python", "pip"):
            assert versions == wanted[package], package
    assert (ROOT / "release" / whole["pypi-dependencies"]["beardyn"]["path"] / "setup.py").is_file()


def test_the_container_installs_extras_that_there_are_and_is_no_root() -> None:
    text = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    (extras,) = re.findall(r'"/source\[([\w,]+)\]"', text)
    known = re.search(r"extras_require=\{(.*?)\}", (ROOT / "setup.py").read_text(encoding="utf-8"), re.DOTALL)
    assert known is not None
    for extra in extras.split(","):
        assert f'"{extra}":' in known[1], extra
    assert re.search(r"^USER \d+$", text, re.MULTILINE)


def test_the_dev_container_is_set_up_by_a_target_of_the_makefile() -> None:
    settings = json.loads((ROOT / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    (target,) = re.findall(r"make (\S+)", settings["postCreateCommand"].replace("make xvfb", ""))
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    assert re.search(rf"^{re.escape(target.replace('.venv', '$(VENV)'))}:", makefile, re.MULTILINE)


def test_the_site_is_packed_the_same_each_time_without_what_only_sphinx_reads(tmp_path: Path) -> None:
    html = tmp_path / "html"
    (html / ".doctrees").mkdir(parents=True)
    (html / "sub").mkdir()
    for name in ("index.html", "sub/page.html", ".buildinfo", ".doctrees/index.doctree"):
        (html / name).write_text(f"<p>{name}</p>", encoding="utf-8")
    archives = [tmp_path / name / "beardyn-1.2.3-site.zip" for name in ("one", "two")]
    assert [pack_site.pack(html, archive) for archive in archives] == [2, 2]
    assert archives[0].read_bytes() == archives[1].read_bytes()
    with zipfile.ZipFile(archives[0]) as packed:
        names = ["beardyn-1.2.3-site/index.html", "beardyn-1.2.3-site/sub/page.html"]
        assert packed.namelist() == names
        assert packed.read(names[1]) == b"<p>sub/page.html</p>"


def test_a_link_of_the_site_that_leads_nowhere_is_found(tmp_path: Path) -> None:
    (tmp_path / "a b.html").write_text("<p>b</p>", encoding="utf-8")
    links = ("a%20b.html#part", "index.html", "#here", "https://example.org/x", "mailto:a@b.c", "gone.html")
    page = "".join(f'<a href="{link}">x</a>' for link in links) + '<img src="lost.png">'
    (tmp_path / "index.html").write_text(page, encoding="utf-8")
    assert pack_site.dead_links(tmp_path) == ["index.html: gone.html", "index.html: lost.png"]


def test_a_release_has_the_site() -> None:
    """The script that makes wheel and sdist packs the site first, of the same version."""
    text = (ROOT / "release" / "try_release.py").read_text(encoding="utf-8")
    assert text.index("packed_site(DIST)") < text.index('"build"')
    version = pack_site.VERSION.search((ROOT / "setup.py").read_text(encoding="utf-8"))
    assert version is not None
    assert version[1] == SETUP["version"]


@pytest.mark.parametrize("extra", ["docs", "release"])
def test_the_makefile_sets_up_what_the_site_and_a_release_need(extra: str) -> None:
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    assert re.search(
        rf"^\$\(VENV\)/\.ready-{extra}:.*\n\t\$\(call install,\$\(call extras,{extra}\b",
        makefile,
        re.MULTILINE,
    )

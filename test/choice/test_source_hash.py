"""A choice is worked out anew after an edit of any source that it may come from."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from beardyn_core.choice import source_hash

CORE = Path(source_hash.__file__).parents[1]
RULES = "choice/choose.py"


@pytest.fixture
def hash_after(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., str]]:
    """Hash of the rules in a copy of the package, after a file of the copy is changed."""
    core = tmp_path / "beardyn_core"
    shutil.copytree(CORE, core, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(source_hash, "_CORE", core)

    def forget() -> None:
        for remembered in (source_hash.source_hash, source_hash._text, source_hash._imported_files):
            remembered.cache_clear()

    def changed(edited: str = "", new: str = "# changed\n") -> str:
        if edited:
            (core / edited).write_text((core / edited).read_text() + new)
        forget()
        return source_hash.source_hash(core / RULES)

    yield changed
    forget()


@pytest.mark.parametrize("edited", [RULES, "choice/losses.py", "choice/ringing.py", "bearing/geometry.py"])
def test_an_edit_of_what_the_rules_import_changes_the_hash(
    hash_after: Callable[..., str], edited: str
) -> None:
    assert hash_after() != hash_after(edited)


@pytest.mark.parametrize("edited", ["measured/wav.py", "cli/warmup.py"])
def test_an_edit_elsewhere_keeps_the_hash(hash_after: Callable[..., str], edited: str) -> None:
    assert hash_after() == hash_after(edited)


@pytest.mark.parametrize(
    ("statement", "changes"),
    [
        ("from beardyn_core.measured import wav", True),
        ("from beardyn_core.measured import npz, wav", True),
        ("from beardyn_core.measured import npz", False),
        (
            "from beardyn_core.measured import no_module",
            True,
        ),  # a name of the package may come from anywhere in it
        ("from beardyn_core.measured import (\n    npz,\n)", True),
    ],
)
def test_of_a_package_the_modules_count_that_are_imported_by_name(
    hash_after: Callable[..., str], statement: str, changes: bool
) -> None:
    before = hash_after(RULES, f"{statement}\n")
    assert (hash_after("measured/wav.py") != before) is changes

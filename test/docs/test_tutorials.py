"""Answers on the pages of the tutorial are those of the commands: words count, numbers do not."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

from test.docs.test_pages import load

PAGE = """# Page

```bash
echo "run 0.25 s, at 1.5e-3 on 2026-11-30T10:00:00 in {folder}, digest 4be0952c"
echo "refused: no runs yet"
```

```text
run {seconds} s, at 2 on 2025-01-01T09:30:00 in {other}, digest 99ab12cd
{answer}
```
"""


def check(folder: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> int:
    writer: Any = load("write_tutorials")
    monkeypatch.setattr(writer, "PAGES", folder)
    (folder / "page.md").write_text(text, encoding="utf-8")
    found = writer.main(["--check"])
    assert (folder / "page.md").read_text(encoding="utf-8") == text
    return int(found)


@pytest.mark.parametrize(
    ("answer", "code"),
    [
        ("refused: no runs yet", 0),
        ("refused:   no runs yet", 0),
        ("accepted: no runs yet", 1),
        ("refused: no runs yet\nand one line more", 1),
        ("", 1),
    ],
)
@pytest.mark.skipif(sys.platform == "win32", reason="blocks are of bash")
def test_another_word_is_found_and_another_number_is_not(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    answer: str,
    code: int,
) -> None:
    text = PAGE.format(folder="/data/one/run.mcap", other="/mnt/other/run.mcap", seconds=12, answer=answer)
    assert check(tmp_path, monkeypatch, text) == code
    told = capsys.readouterr().out
    assert ("+ refused: no runs yet" in told or "- and one line more" in told) == bool(code)


def test_a_refusal_that_no_longer_comes_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    code = "try:\n    if {}: raise ValueError('not possible yet')\n"
    code += "except ValueError as error:\n    print(error)\n"
    page = "```python\n" + code + "print('end')\n```\n\n```text\nnot possible yet\nend\n```\n"
    assert check(tmp_path, monkeypatch, page.format(True)) == 0
    assert check(tmp_path, monkeypatch, page.format(False)) == 1

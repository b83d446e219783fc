"""What is kept is not made again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from evidence.runner import KeptResults, kept_arrays, kept_json


class Maker:
    """Counts how often it is asked."""

    def __init__(self, result: Any) -> None:
        self.result, self.asked = result, 0

    def __call__(self) -> Any:
        self.asked += 1
        return self.result


def test_a_study_goes_on_with_the_cases_that_it_has_not(tmp_path: Path) -> None:
    path, first, second = tmp_path / "kept.json", Maker({"cup": 3}), Maker([1.5])
    assert KeptResults(path).get("one", first) == {"cup": 3}
    again = KeptResults(path)
    assert (again.get("one", first), again.get("two", second)) == ({"cup": 3}, [1.5])
    assert (first.asked, second.asked) == (1, 1)


def test_without_a_file_each_case_is_made_once() -> None:
    kept, maker = KeptResults(None), Maker(1)
    assert [kept.get("one", maker) for _ in range(2)] == [1, 1]
    assert maker.asked == 1


def test_a_file_of_something_else_is_refused(tmp_path: Path) -> None:
    (tmp_path / "other.json").write_text("[1, 2]")
    with pytest.raises(ValueError, match="has no results by key"):
        KeptResults(tmp_path / "other.json")


def test_results_and_arrays_of_a_file_are_made_once(tmp_path: Path) -> None:
    found, arrays = Maker({"a": [1]}), Maker({"levels": np.arange(3.0)})
    for _ in range(2):
        assert kept_json(tmp_path / "new" / "found.json", found) == {"a": [1]}
        kept = kept_arrays(tmp_path / "new" / "levels.npz", arrays)
        np.testing.assert_array_equal(kept["levels"], [0.0, 1.0, 2.0])
    assert (found.asked, arrays.asked) == (1, 1)
    assert kept_arrays(None, arrays)["levels"][2] == 2.0

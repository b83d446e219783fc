"""A mistyped option is answered with a sentence, not with the list of all options."""

from __future__ import annotations

import pytest

from beardyn_core.cli.main import main


@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (
            ["simulate", "wheel_flat", "--bearing", "METRO120x220"],
            "beardyn simulate: error: does not know --bearing METRO120x220; bearing, speed, load and faults "
            "stand in the scene: `beardyn new SCENE -o mine.yaml` copies it; `beardyn simulate --help` lists "
            "its options\n",
        ),
        (
            ["scenes", "--all"],
            "beardyn scenes: error: does not know --all; `beardyn scenes --help` lists its options\n",
        ),
        (
            ["monitor", "a.csv", "--speed", "9"],
            "beardyn monitor: error: ambiguous option: --speed could",
        ),
        (["fleet", "nothing"], "beardyn fleet: error: "),
        (["simulte"], "beardyn: error: "),
    ],
)
def test_a_mistyped_option_is_answered_by_its_command(
    words: list[str], answer: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as end:
        main(words)
    shown = capsys.readouterr().err
    assert end.value.code == 2
    assert shown.startswith(answer)
    assert shown.endswith(("lists its options\n", "lists what is possible\n"))
    assert "usage" not in shown
    assert shown.count("\n") == 1

"""``beardyn contacts`` makes the page of the contact laboratory."""

import json
import subprocess
import sys

import pytest

from beardyn_core.cli.main import DONE, main
from test.cli.json_page import check


@pytest.mark.slow
def test_quick_run_prints_writes_and_makes_the_page(tmp_path, capsys) -> None:
    folder = tmp_path / "out"
    assert main(["contacts", "--quick", "--json", "-o", str(folder), "--rrd", str(folder / "a.rrd")]) == DONE
    found = json.loads(capsys.readouterr().out)
    assert found == json.loads((folder / "contacts.json").read_text())
    check("contacts", found)
    assert found["row_difference_m"] < 1e-9
    time = {entry["method"]: entry["time_s"] for entry in found["whole_bearing"]}
    assert time["closed form, compiled"] < time["analytic Newton, compiled"] < time["analytic Newton, plain"]
    assert (folder / "a.rrd").stat().st_size > 10_000
    docs, page = tmp_path / "docs", tmp_path / "docs" / "evidence"
    docs.mkdir()
    write = [sys.executable, "-m", "evidence.contacts.page", str(folder), "--to", str(docs)]
    subprocess.run(write, check=True)
    (page / "contacts.md").write_text(
        (page / "contacts.md").read_text().replace("Not yet on this page.", "Kept.")
    )
    subprocess.run(write, check=True)
    text = (page / "contacts.md").read_text()
    assert text.count("<!-- the runs of Santos (2017) -->") == 1
    assert "\nKept.\n" in text
    for line in text.splitlines():
        if line.startswith("!["):
            assert (page / line.split("](")[1].rstrip(")")).stat().st_size > 5_000

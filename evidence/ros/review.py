"""The table of the review of the ROS graph, played again: ``python -m evidence.ros.review [--page]``.

Prints, fault by fault, what was measured when it was found and what is measured now; ends with 1 when a
line does not hold.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from evidence.pages import REPORTS
from evidence.ros.faults import FAULTS, Fault

PAGE = REPORTS / "ros.md"
HEAD = """# The ROS graph: faults found by outside clients, then and now

ros2cli, launch, rosbags and mcap found these faults in the nodes. `python -m
evidence.ros.review --page` plays each again with real processes and writes this page. Real time and memory
with recorder and monitor are measured by `python -m evidence.ros.costs --scene cup_spall --auto` and
`python -m evidence.ros.memory`; nodes that are killed, starved and fed nonsense by `make soak`.

| | fault | then | now | holds |
|---|---|---|---|---|
"""


@dataclass(frozen=True)
class Line:
    """What became of one fault."""

    fault: Fault
    now: str
    holds: bool

    @property
    def row(self) -> str:
        """Row of the table."""
        mark = "yes" if self.holds else "**no**"
        return f"| {self.fault.number} | {self.fault.what} | {self.fault.then} | {self.now} | {mark} |"


def line_of(fault: Fault, folder: Path) -> Line:
    """Play one fault again.

    Parameters
    ----------
    fault : Fault
    folder : Path
        Of logs and recordings.
    """
    try:
        return Line(fault, fault.scene(folder), True)
    except Exception as error:  # whatever breaks a scene, its line does not hold
        sentence = (str(error).strip() or type(error).__name__).splitlines()[0]
        return Line(fault, sentence[:200].replace("|", "/"), False)


def main(words: Sequence[str] | None = None) -> int:
    """Play the faults and print the table; gives 1 when a line does not hold."""
    parser = argparse.ArgumentParser(prog="python -m evidence.ros.review", description=__doc__)
    parser.add_argument("--only", type=int, nargs="+", help="numbers of faults; default all")
    parser.add_argument("--page", action="store_true", help=f"write {PAGE.name} too; needs all faults")
    args = parser.parse_args(words)
    if args.page and args.only:
        parser.error("--page needs all faults: leave out --only")
    lines = []
    for fault in FAULTS:
        if args.only and fault.number not in args.only:
            continue
        begin = time.monotonic()
        with tempfile.TemporaryDirectory(prefix="review-") as name:
            lines.append(line_of(fault, Path(name)))
        print(f"{lines[-1].row} {time.monotonic() - begin:.0f} s", flush=True)
    failed = [line.fault.number for line in lines if not line.holds]
    if args.page:
        PAGE.write_text(HEAD + "\n".join(line.row for line in lines) + "\n", encoding="utf-8")
    print(f"do not hold: {failed}" if failed else f"all {len(lines)} hold")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())

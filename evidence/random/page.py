"""Write docs/evidence/random.md from `make random`: ``python -m evidence.random.page random_runs``."""

from __future__ import annotations

import argparse
import re
from collections import Counter
from pathlib import Path

from beardyn_core.physics.tiers.status import SENTENCES, Status
from evidence.pages import REPORTS, render
from evidence.random.book import last_code, results
from evidence.random.scenes import BEARINGS, KERNELS
from evidence.random.trial import ENDS, FAILED, REFUSED, VERDICTS, Tried
from evidence.tables import markdown

PAGE = REPORTS / "random.md"


def main(words: list[str] | None = None) -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(prog="python -m evidence.random.page")
    parser.add_argument("folder", type=Path, help="folder of results")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args(words)
    every = [
        each
        for speed in KERNELS
        for each in results(arguments.folder, speed, arguments.seed, last_code(arguments.folder, speed))
    ]
    PAGE.write_text(page(every))
    print(f"{PAGE} is written")


def page(every: list[Tried]) -> str:
    """Write the page of some results."""
    tiers = sorted({each.tier for each in every if each.tier})
    total = Counter(each.verdict for each in every)
    counts = Counter((each.tier, each.verdict) for each in every)
    shown = [verdict for verdict in VERDICTS if any(counts[tier, verdict] for tier in tiers)]
    rows = []
    for tier in tiers:
        seconds = sorted(each.seconds for each in every if each.tier == tier)
        median = f"{1e3 * seconds[len(seconds) // 2]:.0f} ms (median)"
        rows.append((f"`{tier}`", len(seconds), *(counts[tier, verdict] for verdict in shown), median))
    finished = [Status(each.bits) for each in every if each.verdict not in (ENDS, FAILED)]
    values = {
        "kernels": sum(map(len, KERNELS.values())),
        "summary": f"{len(every)} scenes: {', '.join(f'{total[v]} {v}' for v in VERDICTS if total[v])}",
        "verdicts": list(VERDICTS.items()),
        "tiers": markdown(("tier", "scenes", *shown, "processor time of one"), rows, "lr"),
        "ends": Counter(plain(each.says) for each in every if each.verdict in (ENDS, REFUSED)).most_common(),
        "reports": [(sentence, sum(bit in bits for bits in finished)) for bit, sentence in SENTENCES.items()],
        "failed": [
            (f"{each.speed} {each.number}", plain(each.says)) for each in every if each.verdict == FAILED
        ],
    }
    return render(__file__, values)


def plain(sentence: str) -> str:
    """Put dots in place of the numbers of a sentence, so that alike ones are counted together."""
    words = re.sub(rf"\b({'|'.join(map(re.escape, BEARINGS))})\b", "the bearing", " ".join(sentence.split()))
    plain = re.sub(r"\[[-\d.e+ ]+\]|(?<![\w])[-+]?\d[\d.]*(e[-+]?\d+)?", "…", words)
    return plain.replace("|", "\\|")


if __name__ == "__main__":
    main()

"""Write docs/random.md from the results of `make random`: ``python -m evidence.random.page random_runs``."""

from __future__ import annotations

import argparse
import re
from collections import Counter
from pathlib import Path

from beardyn_core.physics.tiers.status import SENTENCES, Status
from evidence.pages import DOCS
from evidence.random.book import last_code, results
from evidence.random.scenes import BEARINGS, KERNELS
from evidence.random.trial import ENDS, FAILED, REFUSED, VERDICTS, Tried

PAGE = DOCS / "random.md"

HEAD = """# Random scenes

Written by `python -m evidence.random.page random_runs` from the results of `make random`, which draws legal
scenes and runs them: any number that the [keys of a scene](reference.md) allow, from their own declarations,
with a shipped bearing and lubricant, every kind of load, fault, sensor and background, and {kernels} sets
of effects. Loads go from none to the static rating in any direction, speeds from standing to 6000 rpm either
way, temperatures from -60 to 200 °C. **A run has to end finite or with a sentence that says why not**; a
traceback, or a number that is none without being told, is a failure. `make random ARGS="--show fast 17"`
prints a scene.

**{summary}.**

| verdict | means |
|---|---|
{verdicts}

Durations are one to four blocks of 20 ms: what is looked for is a scene that breaks at once, not one that
drifts. That is the matter of [the hard cases](hard.md). Left out are what `auto` chooses, recordings and
files as loads or paths, several axleboxes, and wheelsets that bend in the twin.
"""


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
    counts = Counter((each.tier, each.verdict) for each in every)
    shown = [verdict for verdict in VERDICTS if any(counts[tier, verdict] for tier in tiers)]
    total = Counter(each.verdict for each in every)
    lines = [
        HEAD.format(
            kernels=sum(map(len, KERNELS.values())),
            summary=f"{len(every)} scenes: {', '.join(f'{total[v]} {v}' for v in VERDICTS if total[v])}",
            verdicts="\n".join(f"| {verdict} | {means} |" for verdict, means in VERDICTS.items()),
        ),
        "## By tier",
        "",
        f"| tier | scenes | {' | '.join(shown)} | processor time of one |",
        f"|---|--:|{'--:|' * len(shown)}--:|",
    ]
    for tier in tiers:
        own = [each for each in every if each.tier == tier]
        middle = sorted(each.seconds for each in own)[len(own) // 2]
        cells = " | ".join(str(counts[tier, verdict]) for verdict in shown)
        lines.append(f"| `{tier}` | {len(own)} | {cells} | {1e3 * middle:.0f} ms (median) |")
    lines += ["", "## Why runs ended or were refused", "", "| sentence | scenes |", "|---|--:|"]
    ends = Counter(plain(each.says) for each in every if each.verdict in (ENDS, REFUSED))
    lines += [f"| {sentence} | {count} |" for sentence, count in ends.most_common()]
    lines += ["", "## What runs that went to their end reported", "", "| status | scenes |", "|---|--:|"]
    for status, sentence in SENTENCES.items():
        count = sum(status in Status(each.bits) for each in every if each.verdict not in (ENDS, FAILED))
        lines += [f"| {sentence} | {count} |"] if count else []
    failed = [each for each in every if each.verdict == FAILED]
    if failed:
        lines += ["", "## What failed", ""]
        lines += [f"- `{each.speed} {each.number}`: {plain(each.says)}" for each in failed]
    return "\n".join(lines) + "\n"


def plain(sentence: str) -> str:
    """Put dots in place of the numbers of a sentence, so that alike ones are counted together."""
    words = re.sub(rf"\b({'|'.join(map(re.escape, BEARINGS))})\b", "the bearing", " ".join(sentence.split()))
    plain = re.sub(r"\[[-\d.e+ ]+\]|(?<![\w])[-+]?\d[\d.]*(e[-+]?\d+)?", "…", words)
    return plain.replace("|", "\\|")


if __name__ == "__main__":
    main()

"""Neural posterior estimation beside the shipped way: ``python -m evidence.follow.neural``.

``--train runs --hidden hidden`` as for `evidence.follow.judged`; needs ``pip install sbi``, which is no extra
of this project. A normalising flow learns the posterior of each number from the descriptors of both sets
(sbi: ``NPE`` with each of `FLOWS` and its usual early stopping), and judges bearings of
the hidden set that it has not seen, part by part. The section goes into docs/evidence/estimator.md.

References
----------
Papamakarios, Murray (2016), NeurIPS 29; Greenberg, Nonnenmacher, Macke (2019), ICML: posterior estimation by
flows. Tejero-Cantero et al. (2020), J. Open Source Softw. 5, 2505: sbi.
"""

from __future__ import annotations

import argparse
import contextlib
import tempfile
import time
from collections.abc import Mapping
from functools import reduce
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.follow.conformal import LEVELS, Guess
from beardyn_core.follow.judging import Guessed, crosswise_parts, score_of
from beardyn_core.follow.labelled import Described, describe_runs, join_sets, select_runs
from beardyn_core.follow.learning import true_values
from beardyn_core.follow.quantities import BY_NAME, Quantity
from beardyn_core.population.labelled_set import LabelledSet
from evidence.follow.judged import SHOWN, judged
from evidence.pages import REPORTS, write_section

PAGE = REPORTS / "estimator.md"
TITLE, NEXT = "## Compared with a neural posterior\n", "## What a known load gives\n"
PARTS = 5  # of the hidden bearings; each is judged by what the others teach, in every way
KEPT = 80  # descriptors that go best with the number
DRAWS = 1000  # of a posterior
SEED = 1
FLOWS = {"maf": "flow, Gaussian", "nsf": "flow, splines"}  # by the names that sbi has for them


def received_best(descriptors: Float, values: Float) -> NDArray[np.int64]:
    """Find the descriptors that go best with a number."""
    centred = descriptors - descriptors.mean(axis=0)
    size = np.maximum(np.linalg.norm(centred, axis=0), 1e-9)
    return np.argsort(-np.abs(centred.T @ (values - values.mean())) / size)[:KEPT]


def draws(descriptors: Float, values: Float, asked: Float, flow: str) -> Float:
    """Learn a posterior from runs, and draw from it for others, shape [draw, run]."""
    torch, inference = import_module("torch"), import_module("sbi.inference")
    torch.manual_seed(SEED)
    with tempfile.TemporaryDirectory() as logs, contextlib.chdir(logs):  # sbi writes some where it is
        learner = inference.NPE(density_estimator=flow, show_progress_bars=False)
        learner.append_simulations(
            torch.as_tensor(values[:, None], dtype=torch.float32),
            torch.as_tensor(descriptors, dtype=torch.float32),
        )
        learnt = learner.train()
    with torch.no_grad():
        found = learnt.sample((DRAWS,), condition=torch.as_tensor(asked, dtype=torch.float32))
    return np.asarray(found.numpy()[..., 0], np.float64)


def guessed_by_flow(quantity: Quantity, train: Described, hidden: Described, flow: str) -> Guessed:
    """Guess every hidden run by what both sets without its bearing teach."""
    values, inside = true_values(quantity, hidden)
    pieces: list[tuple[NDArray[np.int64], Float]] = []
    for part in crosswise_parts(hidden.bearings, PARTS):
        both = join_sets([train, select_runs(hidden, ~part)])
        middle, spread = np.nanmean(both.descriptors, axis=0), np.nanstd(both.descriptors, axis=0)
        spread = np.where(spread > 1e-9, spread, 1.0)
        taught, has = true_values(quantity, both)
        standard = np.nan_to_num((both.descriptors[has] - middle) / spread)
        columns = received_best(standard, taught[has])
        asked = np.flatnonzero(part & inside)
        unseen = np.nan_to_num((hidden.descriptors[asked] - middle) / spread)
        pieces.append((asked, draws(standard[:, columns], taught[has], unseen[:, columns], flow)))
    places = np.concatenate([each for each, _ in pieces])
    found = np.concatenate([each for _, each in pieces], axis=1)
    ends = np.array([(0.5 - 0.5 * level, 0.5 + 0.5 * level) for level in LEVELS])
    low, high = (np.quantile(found, ends[:, k], axis=0) for k in (0, 1))
    return Guessed(Guess(np.median(found, axis=0), low, high), values[places], places)


def on_common_runs(ways: Mapping[str, Guessed]) -> dict[str, Guessed]:
    """Leave the runs that every way has guessed."""
    common = reduce(np.intersect1d, [each.places for each in ways.values()])
    return {way: each.taken(np.isin(each.places, common)) for way, each in ways.items()}


def section(ours: Mapping[str, Guessed], flows: Mapping[str, Mapping[str, Guessed]], seconds: float) -> str:
    """Write the section of the page."""
    heads = " | ".join(f"inside {100 * level:.0f} %" for level in LEVELS)
    lines = [
        TITLE,
        "Written by `python -m evidence.follow.neural --train runs --hidden hidden`: normalising flows "
        "(`sbi`, neural posterior estimation) compared with the shipped way. All learn from the runs of "
        f"`quasistatic` and, part by part, from {PARTS - 1} of {PARTS} parts of the hidden bearings, and "
        f"judge the rest; {seconds / 60:.0f} min of learning the flows.",
        "",
        f"| quantity | way | median error | {heads} |",
        f"|---|---|--:|{'--:|' * len(LEVELS)}",
    ]
    for name in SHOWN:
        quantity = BY_NAME[name]
        for way, each in by_way(name, ours, flows).items():
            score = score_of(quantity, each)
            error = f"{100 * score.error:.0f} %" if quantity.relative else quantity.width_text(score.error)
            shares = " | ".join(f"{100 * share:.0f} %" for share in score.coverage)
            lines.append(f"| {quantity.words} | {way} | {error} of {score.runs} | {shares} |")
        if name not in ours:
            lines.append(f"| {quantity.words} | shipped | says nothing | {' | '.join('-' for _ in LEVELS)} |")
    return "\n".join([*lines, "", verdict(ours, flows), "", ""])


def by_way(
    name: str, ours: Mapping[str, Guessed], flows: Mapping[str, Mapping[str, Guessed]]
) -> dict[str, Guessed]:
    """Give what each way guesses of a number, of the runs that all of them guess."""
    ways = {FLOWS[flow]: each[name] for flow, each in flows.items()}
    return on_common_runs({"shipped": ours[name], **ways} if name in ours else ways)


def verdict(ours: Mapping[str, Guessed], flows: Mapping[str, Mapping[str, Guessed]]) -> str:
    """Say where a flow errs less, and how often its intervals are right there."""
    better = []
    for name in SHOWN:
        found = {way: score_of(BY_NAME[name], each) for way, each in by_way(name, ours, flows).items()}
        best = min(found, key=lambda way: found[way].error)
        if best != "shipped":
            held = f"{100 * found[best].coverage[-1]:.0f} % of runs inside of {100 * LEVELS[-1]:.0f} %"
            better.append(f"{BY_NAME[name].words} ({best}, {held})")
    if not better:
        return "The flows err more in every number, so `sbi` and its PyTorch are not an extra."
    return f"A flow errs less in: {', '.join(better)}."


def main(argv: list[str] | None = None) -> int:
    """Learn both ways, print and write."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.neural", description=__doc__)
    parser.add_argument("--train", metavar="DIR", type=Path, required=True, help="set that is learnt from")
    parser.add_argument("--hidden", metavar="DIR", type=Path, required=True, help="set that judges")
    args = parser.parse_args(argv)
    if find_spec("sbi") is None:
        parser.error("sbi is not installed: pip install sbi")
    ours, hidden = judged(LabelledSet(args.train), LabelledSet(args.hidden), PARTS)
    train = describe_runs(LabelledSet(args.train), None)
    began = time.perf_counter()
    flows = {
        flow: {name: guessed_by_flow(BY_NAME[name], train, hidden, flow) for name in SHOWN} for flow in FLOWS
    }
    text = section(ours, flows, time.perf_counter() - began)
    print(text)
    write_section(PAGE, TITLE, text, NEXT)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

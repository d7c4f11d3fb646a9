"""What a reader should know in a few lines, computed from the content and from nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise

import numpy as np
from markupsafe import Markup

from workbench.files.numbers import counted, length, number
from workbench.paper.statistics import Bootstrap, holm, p_values
from workbench.proof.verdict import in_number
from workbench.report.claims import VERDICTS, ClaimView, charged, counts
from workbench.report.sources import SourcedValue
from workbench.report.tables import largest_error
from workbench.simulate.metrics import Metrics
from workbench.simulate.sweep_rows import SweepRow, SweepSummary
from workbench.trains.scenario import Scenario, Variant

NOTABLE = 1.1
# How a printed ranking is held against the runs.
RANKED = Bootstrap(2000, 1, 0.95)


def proof_line(claims: Sequence[ClaimView]) -> Markup | None:
    """The verdicts on the paper's lines in words, ours apart."""
    if not claims:
        return None
    paper = [claim for claim in claims if not claim.ours]
    line = Markup("<strong>Proof.</strong>")
    line += f" {counted(len(paper), 'line')} of the paper: {_verdicts(charged(paper))}."
    if readings := sum(claim.otherwise for claim in paper):
        line += (" One more fails only as extracted and holds in another reading." if readings == 1 else
                 f" {readings} more fail only as extracted and hold in another reading.")
    tainted = sum(claim.verdict == "proved" and bool(claim.tainted_by) for claim in paper)
    if tainted:
        line += Markup(" {} of the proved rest{} on a line that fails.").format(tainted, "s" * (tainted == 1))
    under = sum(bool(claim.proved_under) for claim in paper)
    if under:
        line += Markup(" {} of the proved hold{} only under lines that are not shown.").format(
            under, "s" * (under == 1))
    own = [claim for claim in claims if claim.ours]
    if own:
        line += f" {counted(len(own), 'question')} of ours: {_verdicts(own)}."
    return line


def _verdicts(claims: Sequence[ClaimView]) -> str:
    return ", ".join(f"{n} {in_number(verdict, n)}"
                     for verdict, n in sorted(counts(claims).items(), key=lambda item: _rank(item[0])) if n)


def nominal_line(scenario: Scenario, metrics: Sequence[Metrics], names: dict[str, str]) -> Markup | None:
    """Best and worst of the nominal runs, who leaves the band, who fails."""
    ranked = sorted((error, m.controller) for m in metrics if (error := largest_error(m)) is not None)
    if not metrics:
        return None
    text = ""
    if ranked:
        listed = ", ".join(f"{names[controller]} {length(error)}" for error, controller in ranked)
        text += f"Largest |position error| in the nominal run: {listed}."
        band = scenario.simulation.position_band_m
        leave = [names[controller] for error, controller in ranked if error > band]
        text += (f" {_and(leave)} {'leave' if len(leave) > 1 else 'leaves'} the band of ±{length(band)}."
                 if leave else f" All stay within the band of ±{length(band)}.")
    failed = [names[m.controller] for m in metrics if m.failed is not None]
    if failed:
        text += f" Failed: {_and(failed)}."
    return Markup("<strong>Tracking.</strong> {}").format(text.strip())


def table_line(scenario: Scenario, summaries: Sequence[SweepSummary], names: dict[str, str],
               rows: Sequence[SweepRow] = ()) -> Markup | None:
    """Whether the paper's ranking and sizes come out of the Monte Carlo runs, of which the rows are."""
    found = {s.controller: max(abs(s.position_error_min), abs(s.position_error_max)) for s in summaries
             if s.position_error_min is not None and s.position_error_max is not None}
    table = scenario.printed_table.rows if scenario.printed_table else ()
    printed = {r.controller: max(map(abs, r.position_error_m)) for r in table if r.controller in found}
    if len(printed) < 2 or not scenario.printed_table:
        return None
    by_paper = sorted(printed, key=printed.__getitem__)
    by_runs = sorted(printed, key=found.__getitem__)
    runs = max(s.runs for s in summaries)
    ratios = [found[name] / printed[name] for name in printed]
    ranking = " &lt; ".join("{}" for _ in by_runs)
    verdict = _ranking(by_paper, rows, names)
    line = Markup("<strong>{}.</strong> Over {} a controller the printed ranking by largest "
                  f"|position error| {{}}: {ranking}; the obtained errors are ").format(
        scenario.printed_table.source.removeprefix("paper, "), counted(runs, "run"), verdict,
        *(names[name] for name in by_runs))
    return line + f"{number(min(ratios), 2)} to {number(max(ratios), 2)} times the printed ones."


def _ranking(printed: Sequence[str], rows: Sequence[SweepRow], names: dict[str, str]) -> str:
    """Whether a printed order, the best first, is that of the runs, by paired differences of the largest errors.

    It is reproduced where every two who follow each other are told apart in that order, and is not where any two are
    told apart in the other; Holm's correction over all pairs.
    """
    errors: dict[str, dict[int, float]] = {name: {} for name in printed}
    for row in rows:
        if row.controller in errors and row.failed is None and None not in (row.position_error_min,
                                                                            row.position_error_max):
            errors[row.controller][row.run] = max(abs(row.position_error_min or 0.0),
                                                  abs(row.position_error_max or 0.0))
    pairs = list(combinations(printed, 2))
    how = RANKED.for_comparisons(len(pairs))
    differences = [np.array([errors[a][run] - errors[b][run] for run in errors[a] if run in errors[b]])
                   for a, b in pairs]
    known = [i for i, difference in enumerate(differences) if len(difference) > 1]
    chance = dict(zip(known, holm(p_values([differences[i] for i in known], how)), strict=True))
    apart = {pair: float(differences[i].mean()) for i, pair in enumerate(pairs)
             if chance.get(i, 1.0) <= 1 - how.confidence}
    if any(difference > 0 for difference in apart.values()):
        return "is not reproduced"
    level = [f"{names[a]} and {names[b]}" for a, b in pairwise(printed) if (a, b) not in apart]
    words = "; ".join(level)
    return f"is neither reproduced nor contradicted ({words} are not told apart)" if level else "is reproduced"


def variants_line(nominal: Sequence[Metrics], variants: Sequence[tuple[Variant, Sequence[Metrics]]],
                  names: dict[str, str], every: bool = True) -> Markup | None:
    """The change of an assumed value that matters most; every: False where some are left out, as that may be."""
    base = {m.controller: error for m in nominal if (error := largest_error(m)) is not None}
    if not variants:
        return None
    line = Markup("<strong>Sensitivity.</strong> {} of assumed data.").format(
        f"{len(variants)} changes" if len(variants) > 1 else "One change")
    broken = [(variant.title, failed) for variant, metrics in variants
              if (failed := [names.get(m.controller, m.controller) for m in metrics
                             if m.failed is not None and m.controller in base])]
    for title, failed in broken[:2]:
        line += Markup(" “{}” makes {} fail.").format(title, _and(failed))
    if len(broken) > 2:
        line += Markup(' <a href="#variants">{} more</a> make runs fail.').format(len(broken) - 2)
    if not every:
        return line
    changes = [(max(error / base[m.controller], base[m.controller] / error), variant, m.controller, error)
               for variant, metrics in variants for m in metrics
               if m.controller in base and (error := largest_error(m)) and base[m.controller]]
    most = max(changes, key=lambda change: change[0], default=None)
    if most and most[0] > NOTABLE:
        _, variant, controller, error = most
        line += Markup(" Where no run fails “{}” changes most: the largest |position error| of {} goes from "
                       "{} to {}.").format(variant.title, names.get(controller, controller),
                                        length(base[controller]), length(error))
    elif most:
        line += " No other changes a largest |position error| by more than 10 %."
    return line


def sources_line(values: Sequence[SourcedValue]) -> Markup | None:
    """How much of the data the paper does not give; None where no source is stated."""
    if not values:
        return None
    assumed = sum(value.kind == "assumed" for value in values)
    return Markup('<strong>Data.</strong> {} of {} stated values are <a href="#assumptions">assumed</a>: '
                  "no source gives them.").format(assumed, len(values))


CHANGES = "changes of assumed values"  # what a scenario's short report has fewer of


def shortened_line(parts: Mapping[str, str]) -> Markup | None:
    """What a short report has less of than a full one, and how to get the rest; None of a full one."""
    if not parts:
        return None
    words = "; ".join(f"{what}: {some}" for what, some in parts.items())
    return Markup("<strong>Short report.</strong> {}. <code>--full</code> makes the rest, too.").format(
        words[0].upper() + words[1:])


def _rank(verdict: str) -> int:
    """Proved first: the order of a sentence, where the table of counts has what needs attention first."""
    return -list(VERDICTS).index(verdict) if verdict in VERDICTS else 1


def _and(words: Sequence[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else "".join(words)

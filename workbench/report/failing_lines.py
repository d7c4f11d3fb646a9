"""How the lines of a paper that fail hang together: which fail by themselves, and on which the others rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from workbench.proof.places import place_of
from workbench.proof.premises import holds_in_other_reading
from workbench.proof.verdict import FAILED, Decision
from workbench.report.counterexample_cache import cached_kept
from workbench.report.premises_at_counterexample import Other


@dataclass(frozen=True)
class Way:
    """The lines that fail on the paper's way to one, by their ids: those that its own counterexample keeps, by which it
    does not fail; those that the counterexample breaks; those that hold in their other reading, with which the paper is
    not charged; and of the rest the causes, which rest on no other one of it. alone: whether the line fails by itself.
    """

    kept: tuple[str, ...] = ()
    broken: tuple[str, ...] = ()
    otherwise: tuple[str, ...] = ()
    causes: tuple[str, ...] = ()
    alone: bool = False


def ways(decisions: Sequence[Decision]) -> dict[str, Way]:
    """The way to every line that fails or that failing lines lead to, by its id; `judged` has left the decisions so."""
    by_id = {d.claim.id: d for d in decisions}
    first = {d.claim.id: _way(d, by_id) for d in decisions if d.tainted_by or d.verdict in FAILED}
    return {name: replace(way, causes=_causes(by_id[name], way, by_id, first)) for name, way in first.items()}


def _way(d: Decision, by_id: Mapping[str, Decision]) -> Way:
    otherwise = tuple(name for name in d.tainted_by if holds_in_other_reading(by_id[name], by_id))
    charged = [name for name in d.tainted_by if name not in otherwise]
    kept: tuple[str, ...] = ()
    broken: tuple[str, ...] = ()
    if d.certificate and d.verdict in FAILED:
        others = {name: Other(certificate, _can_be_obeyed(by_id[name])) for name in charged
                  if (certificate := by_id[name].certificate)}
        if others:
            kept, broken = map(tuple, cached_kept(d.certificate, others))
    fails = d.verdict in FAILED and not holds_in_other_reading(d, by_id)
    return Way(kept, broken, otherwise, (), fails and {*charged} <= {*kept})


def _can_be_obeyed(d: Decision) -> bool:
    """Whether a line that fails is no false calculation, but may hold of one system and not of another."""
    return d.verdict == "gap" or place_of(d.claim.equation).startswith("Assumption")


def _causes(d: Decision, way: Way, by_id: Mapping[str, Decision], found: Mapping[str, Way]) -> tuple[str, ...]:
    rest = [name for name in d.tainted_by if name not in {*way.kept, *way.otherwise}]
    return tuple(name for name in rest if found[name].alone or not (
        {*by_id[name].tainted_by} - {*found[name].kept}) & {*rest})

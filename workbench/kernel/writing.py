"""The Coq proof of one certificate as it is written, line by line, and what is established where it stands."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from workbench.kernel.normal import Normal
from workbench.kernel.theorem import Goal
from workbench.proof.checker import SUM, Context, Poly, Ratio, Relations, Sign, atoms_of


@dataclass
class Facts:
    """What is established where the proof stands; a copy serves one subproof."""

    atoms: set[str] = field(default_factory=set)
    calls: dict[str, str] = field(default_factory=dict)  # a call's text -> its equation
    sums: dict[str, tuple[str, str, Ratio]] = field(default_factory=dict)  # text -> (equation, its name, its term)
    totals: dict[str, tuple[str, ast.expr]] = field(default_factory=dict)  # text -> (equation, the sum by names)
    rates: dict[str, tuple[str, ast.expr]] = field(default_factory=dict)  # text of D(...) -> (equation, derivative)
    signs: dict[tuple[str, bool], str] = field(default_factory=dict)  # (polynomial, strictly positive) -> hypothesis
    nonzero: list[tuple[Poly, str, bool]] = field(default_factory=list)
    conditions: dict[str, str] = field(default_factory=dict)  # what an expression needs to be defined -> hypothesis
    each: list[str] = field(default_factory=list)  # hypotheses of every index

    def copied(self) -> Facts:
        """The same facts, for a subproof."""
        return Facts(set(self.atoms), dict(self.calls), dict(self.sums), dict(self.totals), dict(self.rates),
                     dict(self.signs), list(self.nonzero), dict(self.conditions), list(self.each))


class Writing:
    """Writes a proof. `given` are the assumptions in force and `names` their hypotheses."""

    def __init__(self, context: Context, goal: Goal) -> None:
        self.context, self.normal, self.goal, self.rates = context, Normal(context, goal.letters), goal, goal.rates
        self.given, self.names = Relations(context, []), list[str]()
        self.facts, self.lines, self.count = Facts(), list[str](), 0
        self.libraries: set[str] = set()

    # --- writing ---

    def say(self, line: str) -> None:
        """One more line."""
        self.lines.append(line)

    def fresh(self, letter: str) -> str:
        """A name that no hypothesis has yet."""
        self.count += 1
        return f"{letter}{self.count}_"

    def show(self, letter: str, statement: str, proof: str) -> str:
        """A hypothesis with its proof; its name."""
        name = self.fresh(letter)
        self.say(f"assert ({name} : {statement}).")
        self.say(f"{{ {proof} }}")
        return name

    @contextmanager
    def subproof(self) -> Iterator[None]:
        """What is established in it is forgotten after it."""
        facts, given, names, normal = self.facts, self.given, self.names, self.normal
        self.facts = facts.copied()
        self.say("{")
        yield
        self.say("}")
        self.facts, self.given, self.names, self.normal = facts, given, names, normal

    def every(self, indexed: bool) -> tuple[str, str]:
        """How a statement of each index begins, and its proof."""
        if not indexed:
            return "", ""
        return "forall i : nat, ", "intros i. " + "".join(f"pose proof ({name} i). " for name in self.facts.each)

    def agree(self, value: Ratio, opposite: bool = False) -> str:
        """The tactic that a value equals another one, or its opposite, which is written otherwise."""
        if SUM not in atoms_of(value):
            return "same"
        _, intros = self.every(True)
        lemma = "symmetry; apply opposite_sums" if opposite else "apply equal_sums"  # as `replace` asks for it
        return (f"({lemma}; [same | {joined_tactics(intros)}intros _; cbv beta; same])")

    def assume(self, relation: Sign, name: str) -> None:
        """One more assumption in force, and its hypothesis."""
        self.given, self.names = self.given.with_margins([*self.given.margins, relation]), [*self.names, name]

    def remember(self, poly: Poly, name: str) -> None:
        """A hypothesis that a polynomial is not zero."""
        self.facts.signs[self.normal.poly(poly), False] = name
        self.facts.nonzero.append((poly, name, False))


def conjunction(proofs: list[str]) -> str:
    """The Coq term of a conjunction, from those of its parts."""
    found = proofs[-1]
    for proof in reversed(proofs[:-1]):
        found = f"(conj {proof} {found})"
    return found


def joined_tactics(sentences: str) -> str:
    """Tactics of several sentences as they stand inside of one."""
    return sentences.replace(". ", "; ")

"""Proofs as errata tell them add up, by the formulas that a reader sees alone."""

import hashlib
import json
import re
from pathlib import Path

import pytest
from told_formulas import Formula, UnreadError, difference

from workbench.report.errata.proof_steps import proof_steps

PROOFS = Path(__file__).parents[2] / "proofs"
GIVEN = re.compile(r"\[(\d+)\]\\ (.*)")
LEMMA = re.compile(r"\[(\d+)\] \$(.*?)\$, since (.*)")
SUPPOSED = re.compile(r"\[(\d+)\] Suppose that \$(.*)\$\.")
CASE = re.compile(r"(?:\[(\d+)\] )?Where \$(.*) (\\ge|\\le|<|>|=) 0\$:")
EQUATION = re.compile(r"(?:Then )?\$([^$]*?) = ([^$]*)\$[.,](?: .*)?", re.DOTALL)
LESS = re.compile(r"[Tt]he (?:right side less the left one|left side less the right one) is \$([^$]*)\$.*", re.DOTALL)


class Reader:
    """Follows a proof at numbers for its letters, between 1/2 and 3/2, below zero in the cases that say so."""

    def __init__(self, seed):
        self.seed, self.turned, self.lines, self.read = seed, [], {}, 0

    def __getitem__(self, number):
        """What [number] stands for."""
        return difference(self.lines[number], self.letter, self)

    def letter(self, name):
        value = 0.5 + int(hashlib.sha256(f"{self.seed}{name}".encode()).hexdigest()[:8], 16) / 16**8
        return -value if name in [name for _, name in self.turned] else value

    def follow(self, told):
        """How many sums are equal to what they are said to be; a case that the numbers do not meet is left out."""
        wanted, left_out = "", None
        for text in told.given:
            if found := GIVEN.fullmatch(text):
                self.lines[int(found[1])] = found[2]
        for item in told.lines:
            self.turned = [pair for pair in self.turned if pair[0] < item.depth]
            left_out = None if left_out is not None and item.depth <= left_out else left_out
            if item.text.startswith("To show: "):
                wanted = item.text[len("To show: $"):-2]
            elif found := CASE.fullmatch(item.text):
                inside = left_out is not None  # of a case that is left out
                left_out = left_out if inside or self.meets(found, item.depth) else item.depth
            elif left_out is None:
                self.check(item.text, wanted)
        return self.read

    def meets(self, case, depth):
        number, of, sign = case.groups()
        if sign in (r"\le", "<") and re.fullmatch(r"\\?[A-Za-z]+(_\{\w+\})?", of):
            self.turned.append((depth, of.replace(" ", "")))
        value = Formula(of, self.letter, self).value()
        if number:
            self.lines[int(number)] = f"{of} {sign} 0"
        return {r"\ge": value >= 0, ">": value > 0, r"\le": value <= 0, "<": value < 0, "=": value == 0}[sign]

    def check(self, text, wanted):
        if found := SUPPOSED.fullmatch(text):
            self.lines[int(found[1])] = found[2]
            return
        if found := LEMMA.fullmatch(text):
            wanted, text = found[2], found[3]
            self.lines[int(found[1])] = wanted
        equation, less = EQUATION.fullmatch(text), LESS.fullmatch(text)
        if equation is None and less is None:
            return
        shown = difference(wanted, self.letter, self)
        if equation is not None:
            left = Formula(equation[1], self.letter, self).value()
            assert equation[1] == "0" or left == pytest.approx(shown, rel=1e-9, abs=1e-9), text
            shown = left
        assert Formula((equation or less)[2 if equation else 1], self.letter, self).value() == pytest.approx(
            shown, rel=1e-7, abs=1e-7), text
        self.read += 1


@pytest.mark.parametrize("paper", ["chen2019", "jiao2025", "liu2020", "mao2018", "yang2021"])
def test_every_sum_of_a_proof_is_what_it_is_said_to_be(paper):
    count = 0
    for path in sorted((PROOFS / paper / "certificates").glob("*.json")):
        certificate = json.loads(path.read_text(encoding="utf-8"))
        if certificate.get("verdict") != "proved" or "proofs" not in certificate or certificate["goal"].get("flow"):
            continue
        try:
            count += Reader(path.stem).follow(proof_steps(certificate))
        except (UnreadError, ValueError):  # sums over an index; a logarithm of what is negative at these numbers
            continue
    assert count >= 10, count

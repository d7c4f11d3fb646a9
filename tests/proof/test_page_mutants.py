"""A sample of benchmarks/page_mutants.py: a line that is printed otherwise is no longer the one that was decided."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
from page_mutants import CHANGES, STUDY, changed_lines, line_mutants, number_mutants  # noqa: E402


@pytest.fixture(scope="module")
def mutants():
    return line_mutants(ROOT / "proofs" / "mao2018", 40, 5)


def test_a_changed_line_is_noticed(mutants):
    assert len(mutants) == 40 and len({m.kind for m in mutants}) >= 4
    assert [m for m in mutants if not m.noticed] == []


def test_each_kind_of_change_is_made():
    line = r"\dot V_1 \le -\frac{1}{2} k e_1^2 + \hat c_2 x"
    assert {kind for kind, _ in changed_lines(line)} == set(CHANGES)
    assert (("power", r"\dot V_1 \le -\frac{1}{2} k e_1^{3} + \hat c_2 x")) in list(changed_lines(line))


def test_a_changed_number_that_a_claim_reads_is_noticed(tmp_path):
    """Of a paper of its own: one number stands in a claim, the other in none."""
    folder = tmp_path / "doe2026"
    (folder / "claims").mkdir(parents=True)
    (folder / "paper.py").write_text(
        '"""A paper."""\nfrom workbench.proof.paper import Paper\n\npaper = Paper("doe2026", "A. Doe, 2026")\n')
    (folder / STUDY).write_text('[stated]\nread = 2.5\nunread = 7\n# 3 = no number\ntext = "4"\n')
    (folder / "claims" / "section_1.py").write_text('''"""Section 1."""
import tomllib
from fractions import Fraction
from pathlib import Path

import sympy as sp

from workbench.proof.claim import Goal, at_least

from ..paper import paper

x = sp.Symbol("x", real=True)
STATED = tomllib.loads((Path(__file__).parents[1] / "study.toml").read_text())["stated"]


@paper.claim("1", "a square", "inequality", "x", "proved")
def square() -> Goal:
    """A square and a number."""
    return Goal((at_least(x**2 + sp.Rational(str(STATED["read"])), 0),))
''')
    from workbench.proof.document import places, write_certificates
    from workbench.proof.prove import prove
    from workbench.proof.selection import targets

    proof = prove(targets([str(folder)]), jobs=1, use_cache=False)
    write_certificates(proof.decisions, places(proof, None))
    found = number_mutants(folder, 5, 1)
    assert [(m.before, m.read, m.noticed) for m in found] == [("2.5", True, True), ("7", False, False)]

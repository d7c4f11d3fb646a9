"""Every claim of every proof file: decided as recorded, certified, and confirmed by other means."""

import hashlib
import json
import re
import tomllib
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from child_process import made_in_a_fork
from filelock import FileLock
from independent import Evaluated, model_breaks
from scenarios import PAPERS, PROOFS

from workbench.files.folders import CERTIFICATES
from workbench.files.own_files import MANIFEST
from workbench.proof.claim import FAILED
from workbench.proof.decide.engine import decide
from workbench.proof.document import (
    Places,
    certificate_text,
    claims_document,
    goal_digests,
    with_premises,
)
from workbench.proof.paper import collect_papers
from workbench.proof.prove import prove
from workbench.proof.selection import targets
from workbench.report.errata.content import errata
from workbench.report.errata.pdf import pdf_of
from workbench.report.errata.write import errata_texts
from workbench.report.formulas import formula

PLACES = Places(PROOFS, {paper: PROOFS / paper / CERTIFICATES for paper in PAPERS})
CLAIMS = [claim for paper in collect_papers([PROOFS]) for claim in paper.claims]
IDS = [claim.id for claim in CLAIMS]
CLAIM_OF = {claim.id: claim for claim in CLAIMS}
POINTS, EXACT_POINTS, MOST_DOUBTFUL = 4_000, 10, 10
KEYS = {"id", "paper", "equation", "kind", "statement", "verdict", "method", "scope", "certificate", "counterexample",
        "correction", "premises", "tainted_by", "trust", "seconds", "title", "note", "recorded", "computed", "origin",
        "match", "reading", "glyph", "glyph_claim", "severity", "rests_on", "mends", "fate", "fate_why", "fate_by",
        "goal", "section", "goal_digest", "proved_under", "besides"}


@pytest.fixture(scope="module")
def decisions(shared_folder):
    """Every claim decided, once for all test processes: the second to ask finds what the first has decided.

    The cache is the one beside the code; a clone decides everything, mostly by the committed certificates, which are
    checked again.
    """
    with FileLock(shared_folder / "decided.lock"):
        return {d.claim.id: d for d in prove(targets([str(PROOFS)]), jobs=2).decisions}


# Every thirtieth claim of each paper, one at least, is searched anew here; benchmarks/proof_speed.py searches them all.
SAMPLE = [claim for paper in PAPERS for claim in [c for c in CLAIMS if c.paper == paper and c.build][2::30]]


def test_a_search_finds_what_the_committed_certificates_show(decisions):
    """Without the cache and without the certificates: the deciders find the same today."""
    other = []
    for claim in SAMPLE:
        found, before = decide(claim), decisions[claim.id]
        same = ("verdict", "method", "certificate", "counterexample", "correction", "computed", "goal", "match")
        other += [(claim.id, name) for name in same if getattr(found, name) != getattr(before, name)]
    assert {claim.paper for claim in SAMPLE} == set(PAPERS)
    assert other == []


@pytest.mark.parametrize("paper", PAPERS)
def test_committed_certificates_are_those_of_the_decisions(paper, decisions):
    own = [d for d in decisions.values() if d.claim.paper == paper]
    digests, other = goal_digests(own), []
    for decision in own:
        path = PLACES.path(decision.claim)
        if decision.certificate is None:
            found = not path.exists() and decision.verdict in ("assumed", "undecided")
        else:
            found = decision.trust in ("exact", "kernel") and path.read_text(encoding="utf-8") == certificate_text(
                with_premises(decision, digests))
        other += [] if found else [decision.claim.id]
    assert other == []


@pytest.mark.parametrize("paper", PAPERS)
def test_the_committed_errata_are_what_is_made_now(paper, decisions):
    stated = next(found for found in collect_papers([PROOFS / paper]) if found.name == paper)
    own = [d for d in decisions.values() if d.claim.paper == paper]
    folder = PROOFS.parent / "docs" / "errata" / paper
    texts = errata_texts(own, stated.citation, stated.at_hand)
    assert texts["errata.md"] == (folder / "errata.md").read_text(encoding="utf-8")
    made = made_in_a_fork(pdf_of, errata(own, stated.citation, stated.at_hand))
    assert made == (folder / "errata.pdf").read_bytes()


@pytest.mark.parametrize("paper", PAPERS)
def test_a_report_cites_the_paper_as_its_errata_do(paper):
    """Which text was at hand is said on both."""
    stated = next(found for found in collect_papers([PROOFS / paper]) if found.name == paper)
    study = tomllib.loads((PROOFS / paper / "study.toml").read_text(encoding="utf-8"))
    assert study["citation"] == stated.citation.removesuffix(".")


def test_no_certificate_is_left_of_a_claim_that_is_no_longer_made(decisions):
    wanted = {PLACES.path(d.claim) for d in decisions.values() if d.certificate}
    assert {path for path in PROOFS.glob(f"*/{CERTIFICATES}/*.json") if path.name != MANIFEST} == wanted


@pytest.mark.parametrize("paper", PAPERS)
def test_the_manifest_names_all_claims_and_what_stands_beside_it(paper, decisions):
    folder = PROOFS / paper / CERTIFICATES
    manifest = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    found = {path.stem: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.glob("*.json")}
    del found[Path(MANIFEST).stem]
    assert (manifest["version"], manifest["paper"]) == (2, paper)
    assert {name: entry["certificate"] for name, entry in manifest["claims"].items() if entry["certificate"]} == found
    assert {name: entry["verdict"] for name, entry in manifest["claims"].items()} == {
        d.claim.equation: d.verdict for d in decisions.values() if d.claim.paper == paper}


def test_document_has_the_stable_keys(decisions):
    document = claims_document(list(decisions.values()), PLACES)
    assert set(document) == {"version", "claims", "summary", "totals", "fates", "proved_under", "papers"}
    assert document["version"] == 2
    assert all(set(row) == KEYS for row in document["claims"])
    assert sum(document["summary"].values()) == len(CLAIMS)
    assert set(document["summary"]) == {"proved", "refuted", "violated", "gap", "assumed", "undecided"}
    for paper, sums in document["papers"].items():
        own = [row for row in document["claims"] if row["paper"] == paper]
        printed = [row for row in own if row["origin"] == "printed"]
        for origin, counted in sums["rows"].items():
            assert counted == {verdict: sum((row["origin"], row["verdict"]) == (origin, verdict) for row in own)
                               for verdict in document["summary"]}
        assert sums["parsed"] == sum(row["match"] == "parsed" for row in printed) <= sums["formulas"]
        assert [row["equation"] for row in own if row["fate"]] == [one["equation"] for one in sums["theorems"]]


FALSE = [claim for claim in CLAIMS if claim.recorded in FAILED]


@pytest.mark.parametrize("claim", FALSE, ids=[claim.id for claim in FALSE])
def test_a_failed_claim_is_false_at_its_counterexample(claim, decisions):
    goal, point = claim.build(), decisions[claim.id].counterexample
    assert point
    roots = {name for name, value in point.items() if str(value).startswith("root near ")}
    if roots:  # whose equality no decimal meets: the statement is false near them, and the checker isolates them
        near = {name: str(value).removeprefix("root near ") for name, value in point.items()}
        assert not Evaluated(goal, neurons=1)._shown_at(near)
        assert {root["of"] for root in decisions[claim.id].certificate["roots"]} == roots
    elif goal.eventually is None:
        assumed, shown = Evaluated(goal, neurons=1).holds_at(point)
        assert assumed, "the counterexample breaks an assumption"
        assert not shown, "the statement holds at the counterexample"
    else:
        assert model_breaks(goal, point, point)


def holds_at_random_points(goal, example=None):
    """By floats at many points; to any digits at the first of them, and where floats are farthest from holding."""
    evaluated, rng, seen, exact, doubts = Evaluated(goal), np.random.default_rng(5), 0, 0, 0
    for _ in range(40):
        columns, outcomes = evaluated.points(rng, 5_000)
        count = min(len(outcomes[0]), POINTS - seen)
        doubtful = evaluated.doubtful([o[:count] for o in outcomes])[:MOST_DOUBTFUL - doubts]
        doubts += len(doubtful)
        for row in sorted({*range(min(count, EXACT_POINTS - exact)), *doubtful}):
            point = {str(s): Fraction(float(c[row])) for s, c in zip(evaluated.symbols, columns, strict=True)}
            for symbol, expr in evaluated.equations.items():
                point[str(symbol)] = expr.xreplace({s: sp.Rational(point[str(s)]) for s in expr.free_symbols})
            try:
                assumed, shown = evaluated.holds_at(point)
            except ZeroDivisionError:  # pragma: no cover - an assumption that only its rounding meets
                continue
            assert shown or not assumed, point
            exact += assumed
        seen += count
        if (seen >= POINTS and exact >= EXACT_POINTS) or not evaluated.symbols:
            return
    # Assumptions that random points hardly meet, such as a saturation's: a point that the checker accepted.
    assert example is not None
    assert Evaluated(goal, neurons=1).holds_at(example) == (True, True)


@pytest.mark.parametrize("claim", [c for c in CLAIMS if c.correction], ids=[c.id for c in CLAIMS if c.correction])
def test_correction_holds_at_random_points(claim, decisions):
    holds_at_random_points(claim.correction(), decisions[claim.id].certificate["correction"]["example"])


@pytest.mark.parametrize("claim", [c for c in CLAIMS if c.repair], ids=[c.id for c in CLAIMS if c.repair])
def test_repair_meets_the_condition(claim):
    evaluated = Evaluated(claim.build(), neurons=1)
    assert evaluated.holds_at({str(s): v for s, v in claim.repair.items()}) == (True, True)


@pytest.mark.parametrize("claim", [c for c in CLAIMS if c.recorded == "proved"],
                         ids=[c.id for c in CLAIMS if c.recorded == "proved"])
def test_proved_claim_is_not_broken_by_random_search(claim):
    goal = claim.build()
    if claim.at:
        assert Evaluated(goal, neurons=1).holds_at({str(s): v for s, v in claim.at.items()}) == (True, True)
    else:
        assert Evaluated(goal).falsifying_point(7, batches=2, count=4_000) is None


def test_formulas_become_mathml(decisions):
    for claim in CLAIMS:
        for latex in filter(None, (claim.printed, claim.corrected_statement, decisions[claim.id].correction)):
            shown = formula(latex)
            words = re.sub(r"<math.*?</math>", "", shown)  # sentences stand between formulas as words
            assert not re.search(r"[<$_\\{}]", words), f"{claim.id}: {latex}"
            assert "<math" in shown or words.strip(), f"{claim.id}: {latex}"


def test_ids_and_premises_are_well_formed():
    known = set(IDS)
    for claim in CLAIMS:
        name = claim.id
        assert re.fullmatch(r"[a-z]+\d{4}:[A-Za-z0-9]+(\.[A-Za-z0-9_]+)*", name), name
        assert name not in claim.premises, name
        assert len(set(claim.premises)) == len(claim.premises), name
        assert known.issuperset(claim.premises), name
        assert known.issuperset(claim.rests_on), name
        assert claim.glyph is None or CLAIM_OF[claim.glyph].glyph == name, f"{name}: the other reading points back"
        assert claim.mends is None or claim.origin == "ours", f"{name}: a mended line is no line of the paper"
        assert claim.title, name
        assert claim.printed, name
        assert not claim.title.endswith("."), name


def test_ids_are_unique():
    assert len(set(IDS)) == len(IDS)


def test_taint_is_what_the_chain_carries(decisions):
    """Fixed point of 'a failed line that something depends on, or what taints it', computed the slow way."""
    def fails(name):
        return decisions[name].verdict in ("refuted", "violated", "gap") and CLAIM_OF[name].severity != "cosmetic"

    tainted = {claim.id: set() for claim in CLAIMS}
    while True:
        before = {name: set(found) for name, found in tainted.items()}
        for claim in CLAIMS:
            for line in claim.rests_on:
                tainted[claim.id] |= tainted[line] | ({line} if fails(line) else set())
        if tainted == before:
            break
    assert {name: set(d.tainted_by) for name, d in decisions.items()} == tainted


def test_counterexamples_are_read_exactly():
    """The independent evaluation tells 1/3 from its float."""
    x = sp.Symbol("x", real=True)
    from workbench.proof.claim import Goal, equal

    goal = Goal((equal(3 * x, 1),))
    assert Evaluated(goal).holds_at({"x": "1/3"}) == (True, True)
    assert Evaluated(goal).holds_at({"x": f"{10**60 // 3}/{10**60}"}) == (True, False)

"""What Coq is asked is the goal, and Coq's kernel refuses what is not so."""

from __future__ import annotations

import copy
import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest

from workbench.files.own_files import sha256
from workbench.kernel import coqc
from workbench.kernel.coqc import _coqc, _look, axioms_in, check_folder, compile_library, missing
from workbench.kernel.export import document, export, files_of
from workbench.kernel.syntax import NotExportedError
from workbench.kernel.theorem import read
from workbench.kernel.vernacular import strange_sentence
from workbench.proof.checker import goal_digest

with_coq = pytest.mark.skipif(missing() is not None, reason=missing() or "")

PRODUCT = {"version": 2, "claim": "mine:1", "verdict": "proved", "example": {"k": "1", "x": "1"},
           "goal": {"assume": ["k > 0", "x >= 1"], "show": ["x*k >= k", "x/k >= 1/k"]},
           "proofs": [{"rule": "combination", "terms": [{"coefficient": "1", "factors": [first, {"assume": 1}]}]}
                      for first in ({"assume": 0}, {"inverse": 0})]}
SUMS = {"version": 2, "claim": "mine:2", "verdict": "proved", "example": {"a": "1"},
        "goal": {"assume": ["a > 0"], "indexed": ["w"], "show": ["a*Sum(w**2) >= 0", "Sum(a*w) == a*Sum(w)"]},
        "proofs": [{"rule": "combination", "terms": [{"coefficient": "1", "factors": [
            {"assume": 0}, {"sum_of_squares": "w"}]}]}, {"rule": "identity"}]}
OPPOSITES = {"version": 2, "claim": "mine:5", "verdict": "proved", "example": {"x": "1", "y": "2", "z": "0"},
             "goal": {"assume": ["x > 0", "y > 1", "z**2 == 0"], "show": ["x*y > x", "x*y >= x", "x != 0", "z == 0"]},
             "proofs": [{"rule": "contradiction", "terms": [{"coefficient": c, "factors": list(factors)}
                                                            for c, factors in terms]} for terms in (
                 [("1", [{"assume": 3}]), ("1", [{"assume": 0}, {"assume": 1}])],
                 [("1", [{"assume": 3}]), ("1", [{"assume": 0}, {"assume": 1}])],
                 [("1", [{"assume": 0}]), ("-1", [{"assume": 3}])],
                 [("1", [{"square_of": 3}]), ("-1", [{"assume": 2}])])]}
def fact(name: str, **of: str) -> dict[str, Any]:
    """A proof by one fact of a function."""
    return {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"fact": name, **of}]}]}


IDENTITY = {"rule": "identity"}
ANGLES = {"version": 2, "claim": "mine:7", "verdict": "proved", "example": {"x": "1", "y": "1", "z": "2"},
          "goal": {"assume": ["x >= 0", "y > 0", "z > 0"], "show": [
              "sin(x)**2 + cos(x)**2 == 1", "cos(x) >= 1 - x**2/2", "sin(x) <= x",
              "sin(x + y) == sin(x)*cos(y) + cos(x)*sin(y)", "cos(x - y) == cos(x)*cos(y) + sin(x)*sin(y)",
              "exp(x + y) == exp(x)*exp(y)", "log(y*z) == log(y) + log(z)", "sin(y - x) + sin(x - y) == 0",
              "cos(y - x) == cos(x - y)", "cos(x - x) == 1"]},
          "proofs": [fact("circle", of="x"), fact("cosine_parabola", of="x"), fact("sine_tangent", of="x"),
                     fact("sine_sum", of="x", **{"and": "y"}), fact("cosine_sum", of="x", **{"and": "-y"}),
                     fact("exp_sum", of="x", **{"and": "y"}), fact("log_product", of="y", **{"and": "z"}),
                     IDENTITY, IDENTITY, IDENTITY]}
# What is shown is defined by the lemmas that its proof shows first; those of one relation are none of the next.
DEFINED = {"version": 2, "claim": "mine:18", "verdict": "proved", "example": {"x": "1", "y": "1"},
           "goal": {"assume": ["x >= 1", "y >= x"], "show": ["log(y) - log(x) >= 0", "y >= 1"]},
           "proofs": [
               {"rule": "cut", "lemma": "x > 0", "proof": {"rule": "combination", "terms": [
                   {"coefficient": "1", "factors": []}, {"coefficient": "1", "factors": [{"assume": 0}]}]},
                "then": {"rule": "cut", "lemma": "y > 0", "proof": {"rule": "combination", "terms": [
                    {"coefficient": "1", "factors": [{"assume": place}]} for place in (2, 1)]},
                    "then": {"rule": "combination", "terms": [{"coefficient": "1", "factors": factors} for factors in (
                        [{"assume": 1}, {"positive": "1/y"}], [{"fact": "log_tangent", "of": "x/y"}],
                        [{"fact": "log_product", "of": "x", "and": "1/y"}])]}}},
               {"rule": "combination", "terms": [
                   {"coefficient": "1", "factors": [{"assume": place}]} for place in (0, 1)]}]}
# Every fact of arctan, tan by sin and cos, both along a flow, what is odd, and a number that is enclosed.
ARCTANS = {"version": 2, "claim": "mine:16", "verdict": "proved", "example": {"x": "1", "y": "1", "r": "1"},
           "goal": {"assume": ["y >= 0", "cos(y) > 0"], "flow": {"x": "r", "y": "r"}, "show": [
               "sin(arctan(x)) == x*cos(arctan(x))", "cos(arctan(x)) > 0", "arctan(x) < 2*arctan(1)", "arctan(y) <= y",
               "arctan(x)**2 <= x*arctan(x)", "x*arctan(x)*(1 + x**2) >= x**2", "arctan(-x) + arctan(x) == arctan(0)",
               "tan(y)*cos(y) == sin(y)", "4*arctan(1) >= 3", "D(arctan(x)) == r/(1 + x**2)",
               "D(tan(y))*cos(y)**2 == r"]},
           "proofs": [fact("arctan_sine", of="x"), fact("arctan_cosine", of="x"), fact("arctan_limit", of="x"),
                      fact("arctan_tangent", of="y"), fact("arctan_sector", of="x"), fact("arctan_slope", of="x"),
                      IDENTITY, IDENTITY, fact("enclosure", of="4*arctan(1) - 3"), IDENTITY,
                      {"rule": "combination", "terms": [{"coefficient": "1", "factors": [
                          {"fact": "circle", "of": "y"}, {"any": "r"}]}]}]}
PENDULUM = {"version": 2, "claim": "mine:8", "verdict": "proved", "example": {"a": "1", "w": "1"},
            "goal": {"flow": {"a": "w", "w": "-sin(a)"}, "show": ["D(w**2/2 - cos(a)) == 0"]}, "proofs": [IDENTITY]}
ANGLE = {"version": 2, "claim": "mine:9", "verdict": "refuted", "point": {"x": "1"},
         "goal": {"show": ["cos(x) <= 1/2"]}}
STEADY = {"version": 2, "claim": "mine:10", "verdict": "proved", "example": {"x": "1", "k": "1"},
          "goal": {"assume": ["k > 0"], "flow": {"x": "-k*x", "k": "0"}, "initial": {"x": "1", "k": "k"},
                   "show": ["x**2 <= 1"]},
          "proofs": [{"rule": "nonincreasing", "function": "x**2", "decrease": {"rule": "combination", "terms": [
              {"coefficient": "2", "factors": [{"assume": 0}, {"square": "x"}]}]}, "then": {
              "rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 1}]}]}}]}
ROOT = {"version": 2, "claim": "mine:6", "verdict": "refuted", "point": {"z": "7/5"},
        "goal": {"assume": ["z**2 == 2"], "show": ["z <= 1"]},
        "roots": [{"of": "z", "from": "7/5", "to": "3/2", "equality": "z**2 == 2"}]}
POINT = {"version": 2, "claim": "mine:3", "verdict": "refuted", "point": {"z": "1/2"},
         "goal": {"assume": ["z > 0"], "show": ["z**2 >= 1"]}}


CAUCHY = {"version": 2, "claim": "mine:11", "verdict": "proved", "example": {"x": "3", "y": "0"},
          "goal": {"indexed": ["x", "y"], "show": [
              "Sum(x*y)**2 <= Sum(x**2)*Sum(y**2)", "sqrt(Sum((x + y)**2)) == sqrt(Sum((y + x)**2))",
              "Sum(x*Sum(y)) == Sum(x)*Sum(y)"]},
          "proofs": [{"rule": "contradiction", "terms": [{"coefficient": "1", "factors": factors} for factors in (
              [{"sum_of_squares": "(Sum(y**2)*(Sum(x**2) + 1) + Sum(x*y)**2 - Sum(x**2)*Sum(y**2))*x "
                                  "- Sum(x*y)*(Sum(x**2) + 1)*y"}],
              [{"assume": 0}, {"assume": 0}, {"positive": "Sum(x**2) + 2"}],
              [{"assume": 0}, {"square": "Sum(x**2) + 1"}, {"sum_of_squares": "y"}])]},
                     IDENTITY, IDENTITY]}

# Written with exp(-g) here and exp(g) there, so that what stands first decides which of them is the atom.
TURNED = {"version": 2, "claim": "mine:12", "verdict": "proved",
          "example": {"a": "0", "b": "1", "g": "0", "h": "1", "z": "1"},
          "goal": {"indexed": ["a", "b", "g", "h"], "flow": {"b": "h", "z": "Sum(a*exp(b))"}, "show": [
              "D(z**2/2 + Sum(b**2*exp(-g)/2)) == z*Sum(a*exp(b)) + Sum(b*D(b)/exp(g))"]}, "proofs": [IDENTITY]}
RATES = {"version": 2, "claim": "mine:13", "verdict": "refuted", "point": {"h": "1", "w": "1", "z": "1"},
         "goal": {"indexed": ["h", "w"], "flow": {"w": "-w*h", "z": "Sum(w)"},
                  "show": ["D(z**2 + Sum(w**2)) <= Sum(h*D(w)) - Sum(h/w)"]}}

# The rates have a function, tanh, that what is shown has not.
SATURATED = {"version": 2, "claim": "mine:14", "verdict": "proved", "example": {"x": "0", "y": "0", "z": "0"},
             "goal": {"flow": {"x": "tanh(z)", "y": "(1 - exp(2*z))/(1 + exp(2*z))"}, "show": ["D(x + y) == 0"]},
             "proofs": [IDENTITY]}

# Coefficients of many digits, and many parts.
LONG = {"version": 2, "claim": "mine:15", "verdict": "proved", "example": {"x": "1", "y": "1"},
        "goal": {"assume": ["y > 0", "x/y >= 1/1000000000003"], "show": [
            " + ".join(f"x**2/{10**12 + k}" for k in range(25)) + " >= 0",
            "x**2/1000000000006000000000009 - 2*x*y/7000000000042000000000063 + y**2/49000000000294000000000441 >= 0",
            "x >= y/1000000000003"]},
        "proofs": [{"rule": "combination", "terms": [{"coefficient": c, "factors": f}]} for c, f in (
            (str(sum(Fraction(1, 10**12 + k) for k in range(25))), [{"square": "x"}]),
            ("1", [{"square": "x/1000000000003 - y/7000000000021"}]), ("1", [{"assume": 0}, {"assume": 1}]))]}


FALSE = "mine:17"
CERTIFICATES = (PRODUCT, SUMS, POINT, OPPOSITES, ANGLES, DEFINED, ARCTANS, PENDULUM, ANGLE, STEADY, CAUCHY, TURNED,
                RATES, SATURATED, LONG)


def digested(certificate: dict[str, Any]) -> dict[str, Any]:
    """The certificate with the digest of its goal."""
    return {**certificate, "goal_digest": goal_digest(certificate)}


def test_statement_is_the_goal_with_every_denominator_asked_for() -> None:
    """Each relation stands in it, in the goal's order; a division asks that its denominator is not zero."""
    assert read(PRODUCT["goal"]).statement().split() == (
        "forall (v_k v_x : R), (v_k > 0 -> (v_x >= 1 -> (v_x * v_k) >= v_k) /\\ (v_k <> 0) /\\ "
        "((v_x / v_k) >= (1 / v_k))))").replace("(v_x >= 1 -> (v_x * v_k) >= v_k)",
                                                "(v_x >= 1 -> ((v_x * v_k) >= v_k)").split()


def test_long_polynomials_are_printed_once_and_their_numbers_are_not_asked_for() -> None:
    """Beside the statement stand the signs alone: one open equation each, and no conjunct for a number below a bar."""
    said = document(digested(LONG))
    coefficient = str(10**12 + 7)
    assert f"{coefficient} <> 0" not in said and "v_y <> 0" in said
    statement, proof = said.partition("Definition claim_states")[2].split("Theorem claim_holds")
    assert statement.count(coefficient) == 1 and coefficient not in proof
    assert proof.count("(ge_of _ _ _ _ ") == 2
    assert read({"show": ["log(2)/3 >= 0"]}).statement().startswith("(0 < 2)")


def test_statement_of_a_rate_speaks_of_motions_with_that_rate() -> None:
    """D is Coquelicot's derivative of a function of time whose rate is the flow's, and there must be one."""
    said = read({"flow": {"x": "-k*x"}, "show": ["D(x**2) <= 0"]}).statement()
    assert "(v_x : R -> R)" in said and "(is_derive v_x t ((- v_k) * (v_x t))) ->" in said
    assert "(ex_derive (fun s => ((v_x s) ^ 2)) t) /\\ ((Derive (fun s => ((v_x s) ^ 2)) t) <= 0)" in said


def test_names_of_coqs_own_are_no_symbols() -> None:
    """A symbol called exp, R or forall is another one than Coq's."""
    said = read({"show": ["R + exp(forall1) >= in_"]}).statement()
    assert "(v_R + (exp v_forall1)) >= v_in_" in said


def test_comment_ends_where_it_should() -> None:
    """No text of a certificate leaves its comment."""
    said = document({**PRODUCT, "claim": "mine:1 *) Axiom a : False. (*"})
    assert "Axiom" in said.splitlines()[0] and said.splitlines()[0].count("*)") == 0


def test_what_has_no_coq_text_is_listed_with_its_reason() -> None:
    """Nothing is left out in silence."""
    certificate = digested({"version": 2, "claim": "mine:4", "verdict": "proved", "example": {"x": "2"},
                            "goal": {"assume": ["x >= 1"], "show": ["x**2 >= 1"]},
                            "proofs": [{"rule": "monotone", "variable": "x", "from": "1", "derivative": {
                                "rule": "combination", "terms": [{"coefficient": "2", "factors": [{"assume": 1}]},
                                                                 {"coefficient": "2", "factors": []}]},
                                "at_start": {"rule": "identity"}}]})
    found = export(certificate)
    assert found.text is None and found.reason == "the rule monotone"
    assert '"not_exported": "the rule monotone"' in files_of([found])["index.json"]
    root = export(digested(ROOT))
    assert root.text is None
    assert root.reason == "a point that is a root: no theorem of intermediate values is used in Coq"


def test_the_same_certificate_gives_the_same_text_in_every_process() -> None:
    """What is rewritten is in the order of its text, not of hashes, which differ from process to process."""
    calls = [f"exp({name})" for name in "abcdefg"]
    text = document({**SUMS, "goal": {"show": [f"{' + '.join(calls)} == {' + '.join(reversed(calls))}"]},
                     "proofs": [IDENTITY]})
    named = dict(re.findall(r"assert \((C\d+_) : \(exp v_(\w)\) =", text))
    rewritten = re.search(r"((?:rewrite \?C\d+_\. ){7})", text)
    assert rewritten is not None
    assert [named[name] for name in re.findall(r"C\d+_", rewritten[1])] == list("abcdefg")


@pytest.fixture(scope="module")
def exports(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of exports, and beside them what Coq would take for a module of its own."""
    folder = tmp_path_factory.mktemp("exports")
    (folder / "Lra.vo").write_bytes(b"nothing")
    found = [export(digested(one)) for one in CERTIFICATES]
    false = copy.deepcopy(PRODUCT)
    false["goal"]["assume"][0] = "k < 0"
    found.insert(2, replace(found[0], claim=FALSE, text=document(digested(false))))
    for name, text in files_of(found).items():
        (folder / name).write_text(text)
    return folder


@pytest.fixture(scope="module")
def library(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the library, compiled."""
    folder = tmp_path_factory.mktemp("library")
    compile_library(folder, 120)
    return folder


@with_coq
def test_kernel_accepts_proofs_sums_functions_motions_and_points(
        exports: Path, library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the axioms are those of the reals; a file that is not so is named, by what coqc says of it, and no other."""
    monkeypatch.setattr(coqc, "compile_library", lambda place, seconds: copytree(library, place, dirs_exist_ok=True))
    outcomes = {row.claim: row for row in check_folder(exports, 1, 120)}
    assert [claim for claim, row in outcomes.items() if row.outcome == "accepted"] == [
        one["claim"] for one in CERTIFICATES]
    assert outcomes[FALSE].outcome == "refused" and outcomes[FALSE].reason
    one = next(exports.glob("mine_3*.v")).name
    assert _look(exports, one, "0" * 64) == "the file is not the one that was exported"


@pytest.mark.parametrize("sentence", [
    "Axiom mine : False.", 'Redirect "here" Print nat.', "Declare ML Module \"x\".", "Load mine.", "Cd \"/\".",
    "Require Import Mine.", "#[local] Axiom mine : False.", "Time Qed.", "Extraction \"mine\" nat.", "(* a comment",
    "Proof. { Unset Guard Checking. }", "Module Lra.", "Definition x := 1.(* *) Axiom mine : False."])
def test_a_file_with_a_sentence_that_no_export_has_is_not_shown_to_coq(sentence: str, tmp_path: Path) -> None:
    """Coq's commands load programs and write files: what is called an export may be anybody's."""
    text = document(digested(PRODUCT))
    assert strange_sentence(text) is None
    for spoiled in (text + sentence, text.replace("\nProof.\n", f"\nProof.\n{sentence}\n")):
        (tmp_path / "mine.v").write_text(spoiled)
        assert str(_look(tmp_path, "mine.v", sha256(spoiled))).startswith("holds what no export does")


@with_coq
@pytest.mark.parametrize(("certificate", "old", "new"), [
    (PRODUCT, "x*k >= k", "x*k >= 2*k"), (PRODUCT, "k > 0", "k < 0"), (PRODUCT, "x >= 1", "x >= 0"),
    (SUMS, "Sum(a*w) == a*Sum(w)", "Sum(a*w) == Sum(w)"), (OPPOSITES, "y > 1", "y >= 1"),
    (DEFINED, "x >= 1", "x >= -1"), (POINT, "z**2 >= 1", "z**2 <= 1"), (ANGLES, "x >= 0", "x >= -1"),
    (ANGLES, "y > 0", "y != 0"),
    (ANGLES, "exp(x + y) == exp(x)*exp(y)", "exp(x + y) == exp(x) + exp(y)"),
    (PENDULUM, "D(w**2/2 - cos(a)) == 0", "D(w**2/2 + cos(a)) == 0"), (ANGLE, "cos(x) <= 1/2", "cos(x) <= 14/25"),
    (STEADY, "k > 0", "k < 0"), (CAUCHY, "Sum(x*y)**2 <= Sum(x**2)*Sum(y**2)", "Sum(x*y)**2 <= Sum(x**2)"),
    (TURNED, TURNED["goal"]["show"][0], "D(Sum(b**2*exp(-g)/2)) == Sum(b*h*exp(g))"),
    (RATES, RATES["goal"]["show"][0], "D(z**2 + Sum(w**2)) <= Sum(h*D(w)) + Sum(h/w)"),
    (CAUCHY, "Sum(x*Sum(y)) == Sum(x)*Sum(y)", "Sum(x*Sum(y)) == Sum(x*y)"),
    (LONG, "x >= y/1000000000003", "x >= y/1000000000002"),
    (LONG, LONG["goal"]["show"][1], LONG["goal"]["show"][1].replace("7000000000042", "7000000000041")),
])
def test_kernel_refuses_a_goal_that_is_not_so(library: Path, certificate: dict[str, Any], old: str, new: str) -> None:
    """A changed goal has no Coq text, or one that coqc refuses: the checker is not asked."""
    mutant = copy.deepcopy(certificate)
    for key in ("assume", "show"):
        mutant["goal"][key] = [new if text == old else text for text in mutant["goal"].get(key, [])]
    assert mutant["goal"] != certificate["goal"]
    try:
        text = document(mutant)
    except NotExportedError:
        return
    (library / "Mutant.v").write_text(text)
    assert _coqc(library, "Mutant.v", 120).trouble


def test_axioms_are_read_from_what_coq_prints() -> None:
    """A proof by an axiom of one's own would be seen."""
    said = "Axioms:\nClassicalDedekindReals.sig_forall_dec\n  : forall P\nmine : False\n"
    assert axioms_in(said) == ["mine"] or axioms_in(said) == ["ClassicalDedekindReals.sig_forall_dec", "mine"]

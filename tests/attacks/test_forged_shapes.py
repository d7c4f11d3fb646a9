"""Certificates whose shape lies: numbers that are none, names that are others, cases that leave one out, circles."""

import copy
import hashlib
import json

import pytest

from workbench.proof.checker import CertificateError, Manifest, check, check_file, check_folder, goal_digest

SQUARE = {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"square": "x"}]}]}
SOUND = {"claim": "doe2026:1", "version": 2, "verdict": "proved", "goal": {"assume": [], "show": ["x**2 >= 0"]},
         "example": {"x": "0"}, "proofs": [SQUARE]}


def of(show, proof, assume=(), example=None, **goal):
    """A certificate that names the digest of its goal."""
    made = SOUND | {"goal": {"assume": list(assume), "show": [show], **goal}, "proofs": [proof],
                    "example": {"x": "1", "y": "1"} if example is None else example}
    return made | {"goal_digest": goal_digest(made)}


def sums(*terms, **more):
    return {"rule": "combination", "terms": [{"coefficient": c, "factors": list(f)} for c, *f in terms], **more}


def cases(of_, **proofs):
    return {"rule": "cases", "of": of_, **proofs}


IDENTITY = {"rule": "identity"}
SIZE = sums(("1", {"fact": "abs_nonnegative", "of": "x"}))
FALSE = {
    # coefficients that are no rational numbers 'p/q'
    **{f"a coefficient {text!r}": of("x**2 >= 0", sums((text, {"square": "x"}))) for text in (
        1, 1.0, True, None, "1.0", "1e0", "+1", " 1", "1 ", "1/1/1", "1/0", "0x1", "1_0", "\u0661", "\uff11", "--1",
        "1/-1",
        "inf", "nan", "", "1\n", ["1"], {"p": "1"}, "9" * 5000)},
    # terms whose signs do not add up
    "a negative square": of("x**2 <= 0", sums(("-1", {"square": "x"}))),
    "a negative coefficient": of("x >= 0", sums(("-1", {"any": "-x"}))),
    "any sign": of("x >= 0", sums(("1", {"any": "x"}))),
    "an inequality as an equality": of("x == 0", sums(("1", {"assume": 0})), ["x >= 0"], {"x": "0"}),
    "no terms for what is positive": of("0 > 0", sums(), example={}),
    "no terms for an inequality": of("x >= 0", sums()),
    "a term of zero for what is positive": of("x - x > 0", sums(("0",))),
    "a square as positive": of("x**2 > 0", sums(("1", {"square": "x"}))),
    "an assumption as positive": of("x > 0", sums(("1", {"assume": 0})), ["x >= 0"]),
    "a multiplier that may be zero": of("x >= 0", sums(multiplier=[{"square": "y"}]), ["y == 0"], {"x": "1", "y": "0"}),
    "a multiplier of any sign": of("x >= 0", sums(("1", {"square": "x"}), multiplier=[{"any": "x"}])),
    "a multiplier that is negative": of("x >= 0", sums(multiplier=[{"assume": 0}]), ["x < 0"], {"x": "-1"}),
    "an assumption beyond the last": of("x >= 0", sums(("1", {"assume": 7})), ["x >= 0"]),
    "an assumption by a text": of("x >= 0", sums(("1", {"assume": "0"})), ["x >= 0"]),
    "an inverse of what may be zero": of("1/x >= 0", sums(("1", {"inverse": 0})), ["x >= 0"]),
    "a square of what may be zero": of("x**2 > 0", sums(("1", {"square_of": 0})), ["x >= 0"]),
    # what may be undefined
    "x over x": of("x/x == 1", IDENTITY), "x to the zeroth of an inverse": of("x**-1*x == 1", IDENTITY),
    "a negative exponent": of("x**(-2) > 0", sums(("1", {"square": "1/x"}))),
    "an inverse within a factor": of("x**2 >= 0", sums(("1", {"square": "x"}), ("0", {"any": "1/y"}))),
    "a difference below": of("(x - y)/(x - y) == 1", IDENTITY),
    "a logarithm of what may be negative": of("log(x) - log(x) >= 0", IDENTITY),
    "a root of what may be negative": of("sqrt(x)**2 == x", sums(("1", {"fact": "sqrt_square", "of": "x"}))),
    "a tangent anywhere": of("tan(x) - tan(x) >= 0", IDENTITY),
    "the tangent of a logarithm": of("log(x) <= x - 1", sums(("1", {"fact": "log_tangent", "of": "x"}))),
    "zero to the zeroth": of("0**(-1)*0 == 0", IDENTITY),
    # cases that do not cover
    "two of three cases": of("abs(x) > 0", cases("x", negative=SIZE, positive=SIZE)),
    "one case": of("x >= 0", cases("x", nonnegative=sums(("1", {"assume": 0})))),
    "no case": of("x >= 0", cases("x")), "a case of another name": of("x >= 0", cases("x", positive=SIZE, other=SIZE)),
    "mixed cases": of("x >= 0", cases("x", nonnegative=sums(("1", {"assume": 0})), negative=SIZE)),
    "a case of what is undefined": of("x**2 >= 0", cases("1/x", nonnegative=SQUARE, nonpositive=SQUARE)),
    "a case that is taken for all": of("x >= 0", cases("x", nonnegative=sums(("1", {"assume": 0})),
                                                       nonpositive=sums(("1", {"assume": 0})))),
    "the sign in a case of both": of("sign(x) == 1", cases("x", nonnegative=IDENTITY, nonpositive=IDENTITY)),
    # lemmas that use themselves, opposites that do not fail, values that fall
    "a lemma by itself": of("x >= 0", {"rule": "cut", "lemma": "x >= 0", "proof": sums(("1", {"assume": 0})),
                                       "then": sums(("1", {"assume": 0}))}),
    "a lemma undefined": of("x**2 >= 0", {"rule": "cut", "lemma": "1/x == 1/x", "proof": IDENTITY, "then": SQUARE}),
    "a contradiction of nothing": of("x >= 0", {"rule": "contradiction", "terms": [
        {"coefficient": "1", "factors": [{"assume": -1}]}]}),
    "a contradiction of zero": of("x >= 0", {"rule": "contradiction", "terms": []}),
    "a start that is not assumed": of("x >= 0", {"rule": "monotone", "variable": "x", "from": "0",
                                                 "derivative": sums(("1",)), "at_start": IDENTITY}),
    "a start at the variable": of("x >= 0", {"rule": "monotone", "variable": "x", "from": "x",
                                             "derivative": sums(("1",)), "at_start": IDENTITY}, ["x >= x"]),
    "two starts": of("x >= 0", {"rule": "monotone", "variable": "x", "from": "0", "to": "0", "derivative": sums(("1",)),
                                "at_start": IDENTITY}, ["x >= 0"]),
    "a pole on the way": of("-1/x >= 1", {"rule": "monotone", "variable": "x", "from": "-1", "derivative": sums(
        ("1", {"square": "1/x"})), "at_start": IDENTITY}, ["x >= -1", "x != 0"]),
    "what falls without a start": of("x <= 1", {"rule": "nonincreasing", "function": "x", "decrease": sums(("1",)),
                                                "then": sums(("1", {"assume": -1}))}, flow={"x": "-1"}),
    "what falls by an input": of("x <= 1", {"rule": "nonincreasing", "function": "x",
                                            "decrease": sums(("1", {"any": "w"})), "then": sums(("1", {"assume": -1}))},
                                 example={"x": "1", "w": "0"},
                                 flow={"x": "-w"}, inputs=["w"], initial={"x": "1"}),
    # names and functions that are others
    "a factor that is none": of("x >= 0", sums(("1", {"believe": "x"}))), "a factor with two": of(
        "x >= 0", sums(("1", {"square": "y", "assume": 0})), ["x + y**2 >= 0"]),
    "a fact that is none": of("x >= 0", sums(("1", {"fact": "identity", "of": "x"}))),
    "a fact of nothing": of("abs(x) >= 0", sums(("1", {"fact": "abs_nonnegative"}))),
    "a rule that is none": of("x >= 0", {"rule": "trust"}), "no rule": of("x >= 0", {}),
    "a proof that is a list": of("x**2 >= 0", [SQUARE]), "a text that is a proof": of("x**2 >= 0", "identity"),
    "an atom's name": of("exp#0 >= 0", IDENTITY), "a sum's name": of("x >= 0", sums(), flow={"Sum()": "1"}),
    "a hidden letter": of("x\u200b >= 0", IDENTITY), "a letter that looks alike": of("\u0445 - x == 0", IDENTITY),
    "another digit": of("x**\u00b2 >= 0", SQUARE), "two relations": of("x**2 >= 0 >= -1", SQUARE),
    "an assignment": of("(x := 1) >= 0", IDENTITY), "a comparison within": of("(x < 1) >= 0", IDENTITY),
    "a choice": of("1 if x else 0 >= 0", IDENTITY), "a call of another": of("max(x, 1) >= 0", IDENTITY),
    "a key of arguments": of("log(x=1) >= 0", IDENTITY), "a list": of("[x] >= 0", IDENTITY),
    "true": of("True >= 0", IDENTITY),
    "a rate given by a rate": of("D(x) >= 0", IDENTITY, flow={"x": "D(x)"}),
    "an input with a rate": of("D(x) >= 0", sums(("1",)), flow={"x": "1"}, inputs=["x"]),
    "a rate of a constant": of("D(y) == 0", IDENTITY, flow={"x": "1"}),
}
# Of a sound certificate, what is changed.
CHANGED = {
    "no proof": {"proofs": []}, "two proofs": {"proofs": [SQUARE, SQUARE]}, "no proofs": {"proofs": None},
    "nothing shown": {"goal": {"assume": [], "show": []}, "proofs": []},
    "a text shown": {"goal": {"assume": [], "show": "x"}},
    "another part of a goal": {"goal": {"assume": [], "show": ["x**2 >= 0"], "trust": ["x"]}},
    "an example with a number": {"example": {"x": 0}}, "no example": {"example": None},
    "an example that is a list": {"example": ["0"]}, "another version": {"version": 3},
    "a version of text": {"version": "2"},
    "a verdict of another kind": {"verdict": "assumed"}, "a verdict that is a list": {"verdict": ["proved"]},
    "refuted by a point where it holds": {"verdict": "refuted", "point": {"x": "0"}},
    "refuted by no point": {"verdict": "refuted"}, "a root of no equation": {"roots": [
        {"of": "x", "from": "-1", "to": "1", "equality": "x == 0"}]},
    "a correction that is false": {"correction": {"goal": {"assume": [], "show": ["x >= 0"]}, "example": {"x": "0"},
                                                  "proofs": [IDENTITY]}},
}


def bound(certificate):
    try:
        return certificate | {"goal_digest": goal_digest(certificate)}
    except (KeyError, TypeError, ValueError):
        return certificate


def accepted(certificate):
    try:
        check(copy.deepcopy(certificate))
    except CertificateError:
        return False
    return True


def test_the_sound_one_is_accepted_and_no_forged_one():
    assert accepted(bound(SOUND)) and accepted(of("abs(x) >= 0", SIZE))
    assert not [name for name, forged in FALSE.items() if accepted(forged)]
    assert not [name for name, changed in CHANGED.items() if accepted(bound(SOUND | changed))]


@pytest.mark.parametrize("digest", ["0" * 64, "", None, 0, bound(SOUND)["goal_digest"].upper(),
                                    bound(SOUND)["goal_digest"][:-1], [bound(SOUND)["goal_digest"]]])
def test_a_digest_that_is_another_is_refused(digest):
    assert not accepted(SOUND | {"goal_digest": digest})


def written(path, text):
    """What becomes of a file whose manifest names its very content."""
    path.write_text(text, encoding="utf-8")
    entry = {"verdict": "proved", "goal_digest": bound(SOUND)["goal_digest"],
             "certificate": hashlib.sha256(path.read_bytes()).hexdigest()}
    return check_file(path, Manifest("doe2026", {"1": entry}))[2]


def test_a_file_that_two_readers_read_otherwise_is_refused(tmp_path):
    text = json.dumps(bound(SOUND))
    assert written(tmp_path / "1.json", text) is None
    for name, forged in {
            "a key twice": text.replace('"version": 2', '"version": 2, "version": 2'),
            "a key twice within": text.replace('"assume": []', '"assume": [], "assume": ["x >= 0"]'),
            "a number that is none": text.replace('"version": 2', '"version": 2, "extra": NaN'),
            "an infinity": text.replace('"version": 2', '"version": 2, "extra": -Infinity'),
            "a decimal number": text.replace('"version": 2', '"version": 2.0'),
            "a number too long": text.replace('"version": 2', '"version": 2, "extra": ' + "9" * 5000),
            "what stands behind": text + " {}", "two in one": text + text, "a list": f"[{text}]", "nothing": "",
            "deep brackets": "[" * 100_000}.items():
        assert written(tmp_path / "1.json", forged), name


def test_premises_that_go_in_a_circle_and_a_similar_claim_are_refused(tmp_path):
    one, two = (SOUND | {"claim": f"doe2026:{name}"} for name in "12")
    digests = {name: goal_digest(part) for name, part in (("1", one), ("2", two))}
    made = {name: part | {"goal_digest": digests[name], "premises": {other: digests[other]}}
            for name, part, other in (("1", one, "2"), ("2", two, "1"))}

    def reasons(parts):
        entries = {}
        for name, part in parts.items():
            (tmp_path / f"{name}.json").write_text(json.dumps(part))
            entries[name] = {"verdict": "proved", "goal_digest": digests[name],
                             "certificate": hashlib.sha256((tmp_path / f"{name}.json").read_bytes()).hexdigest()}
        (tmp_path / "manifest.json").write_text(json.dumps({"version": 2, "paper": "doe2026", "claims": entries}))
        return {path.stem: reason for path, _, reason in check_folder(tmp_path)}

    assert all(reasons(made).values())
    assert not any(reasons({name: part | {"premises": {}} for name, part in made.items()}).values())
    assert reasons({"1": made["1"] | {"premises": {"1": digests["1"]}}, "2": made["2"] | {"premises": {}}})["1"]
    similar = made["1"] | {"premises": {}, "goal": {"assume": ["x == x"], "show": ["x**2 >= 0"]}}
    assert reasons({"1": similar | {"goal_digest": goal_digest(similar)}, "2": made["2"] | {"premises": {}}})["1"]

"""No forged root, and no forged contradiction to the opposite of what is shown, is accepted."""

import pytest

from workbench.proof.checker import CertificateError, check

CIRCLE = "x**2 + y**2 == 3"
ROOT = {"of": "y", "from": "7/5", "to": "71/50", "equality": CIRCLE}


def refuted(assume, show, point, *roots, **parts):
    """A certificate that a point with roots breaks a goal."""
    return {"version": 1, "verdict": "refuted", "goal": {"assume": assume, "show": [show]}, "point": point,
            "roots": list(roots)} | parts


def on_circle(*roots, assume=(CIRCLE,), show="x + y <= 1", **parts):
    return refuted(list(assume), show, {"x": "1", "y": "7/5"}, *roots, **parts)


def contradiction(assume, show, example, *terms, operator="contradiction"):
    """A certificate of a goal shown by what its opposite adds up to."""
    return {"version": 1, "verdict": "proved", "goal": {"assume": assume, "show": [show]}, "example": example,
            "proofs": [{"rule": operator, "terms": [
                {"coefficient": c, "factors": [{"assume": f} if isinstance(f, int) else f for f in factors]}
                for c, factors in terms]}]}


GENUINE = {
    "a root": on_circle(ROOT),
    "a root beside an inequality": on_circle(ROOT, assume=(CIRCLE, "y > 1")),
    "two roots": refuted(["x**2 == 2", "y**2 == 3"], "x + y <= 3", {"x": "7/5", "y": "7/4"},
                         {"of": "x", "from": "7/5", "to": "71/50", "equality": "x**2 == 2"},
                         {"of": "y", "from": "17/10", "to": "9/5", "equality": "y**2 == 3"}),
    "an example that is a root": contradiction(["x**2 == 2", "x > 0"], "x != 0", {"x": "1"}, ("1", [1]),
                                               ("-1", [2])) | {
        "roots": [{"of": "x", "from": "1", "to": "2", "equality": "x**2 == 2"}]},
    "weakly": contradiction(["x > 0", "y >= 1"], "x*y >= x", {"x": "1", "y": "1"}, ("1", [2]), ("1", [0, 1])),
    "strictly": contradiction(["x > 0", "y > 1"], "x*y > x", {"x": "1", "y": "2"}, ("1", [2]), ("1", [0, 1])),
    "equal": contradiction(["x**2 + y**2 == 0"], "x == 0", {"x": "0", "y": "0"}, ("1", [{"square_of": 1}]),
                           ("1", [{"square": "y"}]), ("-1", [0])),
}

FORGED = {
    "no change of sign": on_circle(ROOT | {"from": "1", "to": "7/5"}),
    "a value that is not near it": on_circle(ROOT) | {"point": {"x": "1", "y": "9"}},
    "ends changed round": on_circle(ROOT | {"from": "71/50", "to": "7/5"}),
    "a sign that does not change": refuted(["(y - 1)**2 == 0"], "y <= 0", {"y": "1"},
                                           {"of": "y", "from": "0", "to": "2", "equality": "(y - 1)**2 == 0"}),
    "never zero": refuted(["y**2 + 1 == 0"], "y <= 0", {"y": "1"},
                          {"of": "y", "from": "0", "to": "2", "equality": "y**2 + 1 == 0"}),
    "a pole": refuted(["1/y == 0"], "y >= 9", {"y": "1"}, {"of": "y", "from": "-1", "to": "1", "equality": "1/y == 0"}),
    "a pole that cancels": refuted(["y**2/y**3 == 0"], "y >= 9", {"y": "1"},
                                   {"of": "y", "from": "-1", "to": "1", "equality": "y**2/y**3 == 0"}),
    "undefined where it vanishes": refuted(["y**2/y == 0"], "y >= 9", {"y": "1"},
                                           {"of": "y", "from": "-1", "to": "1", "equality": "y**2/y == 0"}),
    "a jump": refuted(["sign(y) == 1/2"], "y >= 9", {"y": "1"},
                      {"of": "y", "from": "-1", "to": "1", "equality": "sign(y) == 1/2"}),
    "an inequality": refuted(["y >= 1"], "y >= 9", {"y": "1"},
                             {"of": "y", "from": "0", "to": "2", "equality": "y >= 1"}),
    "what is not assumed": on_circle(ROOT, {"of": "x", "from": "0", "to": "9", "equality": "x == 1"}),
    "of no symbol": on_circle(ROOT | {"of": "z"}),
    "one equality for two roots": on_circle(ROOT, ROOT | {"of": "x"}),
    "one symbol for two roots": on_circle(ROOT, ROOT, assume=(CIRCLE, CIRCLE)),
    "a line that misses the circle": refuted(
        ["x**2 + y**2 == 1", "x + y == 2"], "x <= -9", {"x": "0", "y": "0"},
        {"of": "x", "from": "0", "to": "2", "equality": "x**2 + y**2 == 1"},
        {"of": "y", "from": "0", "to": "2", "equality": "x + y == 2"}),
    "an assumption that fails between": on_circle(ROOT, assume=(CIRCLE, "y > 1415/1000")),
    "an assumption that holds at one end": on_circle(ROOT, assume=(CIRCLE, "y <= 7/5")),
    "another equality that fails": on_circle(ROOT, assume=(CIRCLE, "y == 7/5")),
    "what holds there": on_circle(ROOT, show="x + y <= 3"),
    "what holds there with equality": on_circle(ROOT, show="y**2 <= 2"),
    "undefined there": on_circle(ROOT, show="1/(y**2 - 2) <= -1"),
    "a root instead of a stated value": on_circle(ROOT) | {"verdict": "violated"},
    "a root of a motion": on_circle(ROOT) | {"goal": {"assume": [CIRCLE], "show": ["x + y <= 1"], "flow": {"y": "1"},
                                                      "initial": {"y": "5"}}},
    "a root of an input": on_circle(ROOT) | {"goal": {"assume": [CIRCLE], "show": ["x + y <= 1"], "inputs": ["y"]}},
    "a root of always": on_circle(ROOT) | {"goal": {"assume": [], "show": ["x + y <= 1"], "flow": {"y": "1"},
                                                    "always": [CIRCLE]}},
    "a root in sums": on_circle(ROOT, terms=[]) | {"goal": {"assume": [CIRCLE], "show": ["x + y <= 1"],
                                                            "indexed": ["w"]}},
    "an example that is none": contradiction(["x**2 == -1"], "x != 0", {"x": "1"}, ("1", []), ("1", [{"square": "x"}]),
                                             ("-1", [0])) | {"roots": [
        {"of": "x", "from": "-1", "to": "2", "equality": "x**2 == -1"}]},
    "weak for strict": contradiction(["x >= 0"], "x > 0", {"x": "1"}, ("1", [0]), ("1", [1])),
    "the opposite with the wrong sign": contradiction(["x > 0"], "x >= 1", {"x": "1"}, ("1", [0]), ("-1", [1])),
    "the opposite of an equality as a sign": contradiction(["x >= 0"], "x == 0", {"x": "0"}, ("-1", [0]), ("1", [1])),
    "the opposite of a difference as a sign": contradiction(["x >= 0"], "x != 0", {"x": "1"}, ("1", [1])),
    "what is to be shown itself": contradiction(["x >= 0"], "x >= 1", {"x": "1"}, ("1", []), ("-1", [0]), ("1", [2])),
    "beyond what is known": contradiction(["x > 0"], "x >= 1", {"x": "1"}, ("1", [7])),
    "not the assumptions alone, by a combination": contradiction(["x >= 0"], "x >= 1", {"x": "1"}, ("1", [1]),
                                                                operator="combination"),
}


@pytest.mark.parametrize("name", GENUINE)
def test_the_genuine_one_is_accepted(name):
    check(GENUINE[name])


@pytest.mark.parametrize("name", FORGED)
def test_the_forged_one_is_refused(name):
    with pytest.raises(CertificateError):
        check(FORGED[name])


@pytest.mark.parametrize("name", [name for name in GENUINE if "root" in name])
def test_without_its_roots_it_is_refused(name):
    with pytest.raises(CertificateError):
        check({key: value for key, value in GENUINE[name].items() if key != "roots"})

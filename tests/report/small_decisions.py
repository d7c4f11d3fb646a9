"""Decisions on a small paper, written by hand with certificates that the checker accepts."""

from dataclasses import replace

from workbench.proof.checker import check, goal_digest
from workbench.proof.fate import judged
from workbench.proof.verdict import Decision, Stated


def certificate(name, verdict, show, point=None, assume=(), **more):
    """A certificate, checked."""
    found = {"claim": name, "version": 2, "verdict": verdict, "goal": {"assume": list(assume), "show": [show]}, **more}
    found |= {"point": point} if point is not None else {}
    found["goal_digest"] = goal_digest(found)
    check(found)
    return found


def proof(name, show, terms, example, assume=()):
    """A certificate that proves a line by a combination."""
    return certificate(name, "proved", show, assume=assume, example=example,
                       proofs=[{"rule": "combination", "terms": terms}])


SQUARE = [{"coefficient": "1", "factors": [{"square": "z_1"}]}]


def paper():
    """A refuted step, a theorem on it that falls, its mended form, a slip, a gap, an open reading, violated numbers."""
    def stated(equation, printed, verdict, **more):
        return Stated(id=f"doe2026:{equation}", title=f"the line {equation}", kind="inequality", printed=printed,
                      recorded=verdict, section="3", **more)

    rows = [
        (stated("4", r"z_1^2 \ge 1", "refuted"),
         certificate("doe2026:4", "refuted", "z_1**2 >= 1", {"z_1": "1/2"}), r"z_1^2 \ge 0"),
        (stated("theorem1", r"\text{all of it is } z_1^2 \ge 2", "refuted", severity="result",
                rests_on=("doe2026:4",)),
         certificate("doe2026:theorem1", "refuted", "z_1**2 >= 2", {"z_1": "1/2"}), None),
        (stated("theorem1.mended", r"z_1^2 \ge 0", "proved", origin="ours", mends="doe2026:theorem1"),
         proof("doe2026:theorem1.mended", "z_1**2 >= 0", SQUARE, {"z_1": "0"}), None),
        (stated("5", "z_1 = 0", "refuted", severity="cosmetic"),
         certificate("doe2026:5", "refuted", "z_1 == 0", {"z_1": "3"}), None),
        (stated("6", "k > 0", "gap"),
         certificate("doe2026:6", "gap", "k > 0", {"k": "-2", "z_2": "-2"}, ("z_2 <= k",)), None),
        (stated("7", r"z_1 \ge 0", "refuted", glyph="doe2026:7.glyph"),
         certificate("doe2026:7", "refuted", "z_1 >= 0", {"z_1": "-1"}), None),
        (stated("7.glyph", r"z_1^2 \ge 0", "proved", origin="ours", glyph="doe2026:7"),
         proof("doe2026:7.glyph", "z_1**2 >= 0", SQUARE, {"z_1": "0"}), None),
        (stated("table1", r"k \ge 1", "violated", severity="data"),
         certificate("doe2026:table1", "violated", "k >= 1", {"k": "3/4"}), None),
        (stated("lemma2", r"z_1^2 \ge 0", "proved", severity="result"),
         proof("doe2026:lemma2", "z_1**2 >= 0", SQUARE, {"z_1": "0"}), None),
    ]
    return judged([Decision(claim, claim.recorded, "by hand", "exact", 0.0, found, found.get("point"), correction)
                   for claim, found, correction in rows])


def with_verdict(decisions, equation, verdict):
    """The same decisions, one with another verdict."""
    return [replace(d, verdict=verdict) if d.claim.equation == equation else d for d in decisions]

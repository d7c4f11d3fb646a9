"""The JSON documents of claims: what `prove`, `show` and `check` write, certificates and their manifests.

The types hold the functions that write them; their schemas are made from them.
"""

from __future__ import annotations

from typing import Any, Literal, NotRequired

from typing_extensions import TypedDict

from workbench.proof.oracle.opinion import OracleRow
from workbench.proof.verdict import FateWord, Kind, Match, Origin, Severity, Verdict


class LettersRow(TypedDict):
    """Letters of a goal that are not the paper's, by their LaTeX: written: those that stand for one symbol, as the
    paper writes it; told: what the others stand for, formulas between dollar signs."""

    written: dict[str, str]
    told: dict[str, str]


class ClaimRow(TypedDict):
    """A claim and what was decided of it.

    equation: its name within the paper; statement: the printed LaTeX; certificate: its file, null where none is
    written; premises: claims that the proof uses; rests_on: those that the paper uses; tainted_by: of these, on the
    whole way, the ones that fail; proved_under: what the proof uses and that is not shown; besides: what claims that
    it uses assume and it does not, as `x >= 1 (3)`; trust: how far the verdict
    is checked; recorded: the verdict that the paper's file states; glyph, glyph_claim: the other reading, and the row
    that decides it; goal_digest: sha256 of what was decided; fate: of a headline statement, with its reason and the
    rows that decide it; seconds: of processor time; oracle: where one was asked, what it says; letters: in a report's
    document and that of `show`.
    """

    id: str
    paper: str
    equation: str
    kind: Kind
    statement: str
    verdict: Verdict
    method: str
    scope: str
    certificate: str | None
    counterexample: dict[str, str] | None
    correction: str | None
    premises: list[str]
    tainted_by: list[str]
    proved_under: list[str]
    besides: list[str]
    trust: str | None
    seconds: float
    title: str
    note: str
    recorded: Verdict
    computed: str | None
    origin: Origin
    match: Match
    goal: str | None
    reading: str
    glyph: str | None
    glyph_claim: str | None
    severity: Severity | None
    rests_on: list[str]
    mends: str | None
    section: str
    goal_digest: str | None
    fate: FateWord | None
    fate_why: str | None
    fate_by: list[str]
    oracle: NotRequired[OracleRow]
    letters: NotRequired[LettersRow]


class OfPaperAndOurs(TypedDict):
    """A number of the paper's lines (printed and implied), and of our own questions."""

    paper: int
    ours: int


class Totals(TypedDict):
    """Verdicts counted, of the paper's lines and of our own questions apart."""

    paper: dict[Verdict, int]
    ours: dict[Verdict, int]


class TheoremRow(TypedDict):
    """What becomes of a headline statement of a paper."""

    equation: str
    title: str
    fate: FateWord
    why: str


class PaperSums(TypedDict):
    """A paper's rows counted.

    rows: by origin and verdict; formulas: printed ones that are decided, no words alone; parsed: those of them that
    were parsed and equal their goals; theorems: what becomes of each headline statement.
    """

    rows: dict[Origin, dict[Verdict, int]]
    formulas: int
    parsed: int
    theorems: list[TheoremRow]


class ClaimsDocument(TypedDict):
    """What `workbench prove --json` and `workbench show --json` write: a row a claim, and sums."""

    version: Literal[2]
    claims: list[ClaimRow]
    summary: dict[Verdict, int]
    proved_under: OfPaperAndOurs
    totals: Totals
    fates: dict[FateWord, int]
    papers: dict[str, PaperSums]


class AnswerGoal(TypedDict):
    """How a line was read: all LaTeX."""

    show: list[str]
    assume: list[str]
    flow: list[str]
    constant: list[str]
    inputs: list[str]


class AnswerDocument(TypedDict):
    """What `workbench check --json` writes of a pasted line."""

    version: Literal[1]
    line: str
    verdict: Verdict
    method: str
    trust: str | None
    goal: AnswerGoal
    counterexample: dict[str, str] | None
    certificate: dict[str, Any] | None


class CertificateGoal(TypedDict):
    """What was decided: for all values, `assume` implies `show`; all texts are in the checker's language."""

    assume: list[str]
    show: list[str]
    flow: NotRequired[dict[str, str]]
    indexed: NotRequired[list[str]]
    inputs: NotRequired[list[str]]
    initial: NotRequired[dict[str, str]]
    always: NotRequired[list[str]]
    eventually: NotRequired[str]


class Certificate(TypedDict):
    """A file that `checker.py` re-checks.

    proofs: of each relation shown, with an example that meets all assumptions; point: at which a relation does not
    hold; functions, always, fails: a motion as functions of time; correction, repair: the nearest true statement, or
    numbers that meet a violated condition, with their proof; premises: digests of the goals of the claims that are
    used; composition: of a whole theorem, the certificates of all that it uses; conditions, values, infeasible,
    points: of a certificate of gains.
    """

    version: Literal[2]
    claim: str
    verdict: Verdict
    goal: CertificateGoal
    goal_digest: str
    proofs: NotRequired[list[dict[str, Any]]]
    example: NotRequired[dict[str, Any]]
    premises: NotRequired[dict[str, str | None]]
    point: NotRequired[dict[str, Any]]
    functions: NotRequired[dict[str, str]]
    always: NotRequired[Any]
    fails: NotRequired[Any]
    path: NotRequired[Any]
    time: NotRequired[str]
    duration: NotRequired[str]
    correction: NotRequired[dict[str, Any]]
    repair: NotRequired[dict[str, Any]]
    composition: NotRequired[dict[str, Any]]
    conditions: NotRequired[Any]
    values: NotRequired[dict[str, str]]
    infeasible: NotRequired[Any]
    points: NotRequired[Any]


class ManifestEntry(TypedDict):
    """A claim: its verdict, the digest of its goal, and sha256 of its certificate's file; null where it has none."""

    verdict: Verdict
    goal_digest: str | None
    certificate: str | None


class Manifest(TypedDict):
    """manifest.json of a folder of certificates: all claims of a paper."""

    version: Literal[2]
    paper: str
    claims: dict[str, ManifestEntry]

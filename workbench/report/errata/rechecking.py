"""How a reader re-checks all of it: one command, and a table of certificates with what each must be for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from workbench.proof.checker import goal_digest
from workbench.proof.verdict import Decision
from workbench.report.errata.blocks import Block, Code, Heading, Paragraph
from workbench.report.finding import Finding

CHECKER = "checker.py"


def rechecking(decisions: Sequence[Decision], found: Sequence[Finding], proofs: Sequence[Decision],
               referred: Sequence[Decision], numbers: Mapping[str, int]) -> list[Block]:
    """The commands, and a row for each correction, open reading, proof and line referred to: its number, certificate
    and digest."""
    paper = decisions[0].claim.paper if decisions else ""
    ordered = sorted((f for f in found if f.digest), key=lambda f: numbers.get(f.equation, len(numbers) + 1))
    rows = [(str(numbers.get(f.equation, "reading")), f.equation, str(f.digest)) for f in ordered]
    rows += [(kind, d.claim.equation, goal_digest(d.certificate))
             for kind, told in (("proof", proofs), ("line", referred)) for d in told if d.certificate]
    wide = max((len(name) for _, name, _ in rows), default=0)
    table = "\n".join(f"{number:>7}  {name:<{wide}}  {digest}" for number, name, digest in rows)
    one: list[Block] = []
    if rows:
        one = [Paragraph("One of them, and that it is for the line named, is re-checked by:"),
               Code(f"python {CHECKER} certificates/NAME.json --claim-digest DIGEST"),
               Paragraph("with a name and a digest of this table, in which numbers are those of the corrections:"),
               Code(table)]
    return [Heading(2, "How to re-check"),
            Paragraph("checker.py is one file that imports Python's standard library alone and knows nothing of the "
                      "programs that found the proofs. With it and the folder of certificates, all of them are "
                      "re-checked by:"),
            Code(f"python {CHECKER} certificates"),
            *one,
            Paragraph("The workbench writes the certificates and these corrections by:"),
            Code(f"workbench prove {paper} --write\nworkbench errata {paper}")]

"""The mended headline statements with their proofs, and the proofs of the lines that these use."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from workbench.proof.verdict import Decision
from workbench.report.errata.blocks import Block, Formula, Heading, Items, Paragraph
from workbench.report.errata.conditions import ALWAYS, UNDER, listed_conditions, motion
from workbench.report.errata.letters import in_blocks, legend
from workbench.report.errata.names import listed_lines, name_of_line, noted
from workbench.report.errata.proof_steps import HOW_TO_READ, proof_steps
from workbench.report.letters import letters_of

MOST_STEPS = 120  # lines of a proof beyond which a reader is sent to the certificate


def mended_statements(decisions: Sequence[Decision], titles: Mapping[str, str]) -> tuple[list[Block], list[Decision]]:
    """Every headline statement that has a proved mended form, then each line that the proofs of these use; and all of
    which a proof is told."""
    by_id = {d.claim.id: d for d in decisions}
    headlines = {d.claim.id: d for d in decisions if d.fate is not None}
    mended = [d for d in decisions if d.claim.mends in headlines and _is_proof(d)]
    blocks: list[Block] = []
    for d in mended:
        shown, headline = not d.proved_under, headlines[str(d.claim.mends)]
        form = "what is proved beside it" if headline.verdict == "proved" and not headline.proved_under else "mended"
        blocks += [Heading(3, f"{name_of_line(headline)}, {form}"
                              f"{'' if shown else ', proved only where lines hold that are not shown'}"),
                   *_stated(d, by_id, titles), *proof_blocks(d)]
    found: list[Block] = [Heading(2, "The headline statements, mended and proved"), Paragraph(HOW_TO_READ),
                          *blocks] if blocks else []
    lemmas = _lemmas(mended, by_id)
    if lemmas:
        found.append(Heading(2, "The lines that these proofs use"))
    for d in lemmas:
        found += [Heading(3, name_of_line(d)), *_stated(d, by_id, titles), *proof_blocks(d)]
    return found, [*mended, *lemmas]


def _lemmas(mended: Sequence[Decision], by_id: Mapping[str, Decision]) -> list[Decision]:
    """The proved lines that the proofs use, and those that lines of ours among them use in turn: the paper's own
    lines have the paper's way there."""
    found = {d.claim.id: d for d in mended}
    waiting = list(mended)
    while waiting:
        for name in waiting.pop(0).claim.premises:
            if name not in found and name in by_id and _is_proof(by_id[name]):
                found[name] = by_id[name]
                waiting += [by_id[name]] if by_id[name].claim.origin == "ours" else []
    return list(found.values())[len(mended):]


def _is_proof(d: Decision) -> bool:
    return d.verdict == "proved" and d.certificate is not None and "proofs" in d.certificate


def _stated(d: Decision, by_id: Mapping[str, Decision], titles: Mapping[str, str]) -> list[Block]:
    """The statement, what is to be known of it, what its proof uses, and what of that is not shown."""
    blocks: list[Block] = [Formula(d.claim.printed, "Printed" if d.claim.origin == "printed" else "Statement")]
    used = [f"{name_of_line(by_id[name])} ({_verdict(by_id[name])})" for name in d.claim.premises if name in by_id]
    under = listed_lines([name_of_line(by_id[name]) for name in d.proved_under])
    for label, text in (("Note", noted(d.claim.note, titles)), ("It uses", f"{listed_lines(used)}." if used else ""),
                        ("Not shown", f"{under}: what rests on them is proved only where they hold." if under else "")):
        if text:
            blocks.append(Paragraph(text, label))
    return blocks


def _verdict(d: Decision) -> str:
    return f"{d.verdict} where lines hold that are not shown" if d.proved_under else d.verdict


def proof_blocks(d: Decision) -> list[Block]:
    """The proof of a line: what letters are, what is given, and the steps."""
    certificate = d.certificate or {}
    own, proof = letters_of(d), proof_steps(certificate)
    given = {UNDER: [*proof.signs, *proof.given], ALWAYS: proof.always}
    blocks: list[Block] = [*listed_conditions(given | motion(certificate["goal"])), Items(proof.lines[:MOST_STEPS])]
    if len(proof.lines) > MOST_STEPS:
        blocks.append(Paragraph(f"{len(proof.lines) - MOST_STEPS} more steps stand in the certificate."))
    told = legend(blocks, own)
    return [*([Paragraph(told, "Letters")] if told else []), *in_blocks(blocks, own)]

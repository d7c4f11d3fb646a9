"""What each row of a source is to the paper: a definition, dynamics, or a claim."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from workbench.paper.source.letters import values_and_rates
from workbench.paper.source.lines import continues
from workbench.paper.source.row import Row
from workbench.paper.source.shown import Standing
from workbench.proof.latex.rows import Role, RowEntry, text_of
from workbench.proof.latex.sides import moving_sides, valued_in


def with_roles(rows: list[RowEntry], standing: Mapping[str, Standing], shown: Mapping[str, Row],
               functions: Collection[str] = ()) -> list[RowEntry]:
    """The first line that gives a letter a value defines it, the first that gives it a rate moves it, where its
    sentence gives or defines something; one without a number where no other does. In the text of a theorem, remark or
    proof no line moves a letter, since a rate there is what the text claims, and no line without a number, or in a
    remark, defines one. Of what the text calls functions the rates are claimed."""
    unnumbered = {id_ for id_, row in shown.items() if not row.number}

    def gives(row: RowEntry) -> bool:
        known = standing.get(row.id)
        return known is None or (known.form in ("bare", "given", "defined") and not known.unread)

    def aside(row: RowEntry) -> bool:
        return row.id in shown and shown[row.id].aside

    def remark(row: RowEntry) -> bool:
        return row.id in shown and shown[row.id].remark

    given: set[str] = set()
    before: set[str] = set()  # letters that a line without a number moves: a later rate of theirs is claimed
    for row in rows:
        values, rates = values_and_rates(text_of(row)) if row.role == "claim" and gives(row) else ({}, {})
        if row.id not in unnumbered:
            given |= {*values, *rates} - before
        elif row.id in standing and standing[row.id].form != "bare" and not aside(row):
            before |= {*rates}
    defined: set[str] = set()
    moved: set[str] = set()
    hidden: set[str] = set()  # letters moved by lines that are not understood: a later rate may follow from those
    found = []
    given_values: set[str] = set()
    states: set[str] = set()
    for row in rows:  # what is printed first, its value or its rate, says what a letter is
        if not remark(row):
            given_values |= valued_in(text_of(row)) - states
            if row.role == "claim" and not aside(row) and gives(row):
                states |= {letter for letter, _ in moving_sides(text_of(row))} - given_values - {*functions}
    for row in rows:
        role: Role = row.role
        if role == "claim" and not continues(row.printed) and not (row.id in unnumbered and aside(row)) and (
                not remark(row)) and gives(row):
            values, rates = values_and_rates(row.line or row.printed)
            if row.id in unnumbered and {*values, *rates} & given:
                values, rates = {}, {}
            if values and not set(values) & (defined | states):
                role = "definition"
                defined |= set(values)
            elif rates and not aside(row) and set(rates) <= states - moved - hidden:
                role = "dynamics"
                moved |= set(rates)
        if row.id in standing and standing[row.id].unread:
            hidden |= {letter for letter, _ in moving_sides(text_of(row))}
        found.append(row.model_copy(update={"role": role}))
    return found

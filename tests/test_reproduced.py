"""A study that runs a paper again, as small as a newcomer's: what it declares, and what the package makes of it."""

import re
from dataclasses import dataclass

import numpy as np
import pytest
from refusals import changed

from workbench.errors import InputError
from workbench.files.toml import Positive, Record, read_toml, validate_record
from workbench.paper.comparison import TripComparison
from workbench.paper.drivers import Drivers
from workbench.paper.findings import LackingError, found, listed, needed, some, span
from workbench.paper.reproduced import STATED, ReproducedStudy, Results, one_of
from workbench.paper.reproduction import Reproduction
from workbench.paper.results import Curve, Plot, ResultTable

FILE = """
version = 1
kind = "study"
name = "tiny"
title = "Decay"
paper = "tiny"
citation = "A. Author, 2026"
decay = { rate_per_s = 0.5, printed_m = 0.14 }
starts_m = [1.0, 2.0]
shown = 1
[[changes]]
title = "twice the rate"
set = { "decay.rate_per_s" = 1.0 }
[[changes]]
title = "so fast that it fails"
set = { "decay.rate_per_s" = 99.0 }
"""


class Decay(Record):
    rate_per_s: Positive
    printed_m: Positive


class TinyStudy(ReproducedStudy):
    decay: Decay
    starts_m: tuple[Positive, ...]
    shown: int

    def check(self):
        one_of("shown", "start", self.shown, range(1, len(self.starts_m) + 1))


@dataclass(frozen=True)
class Case:
    start: int
    change: int = STATED


@dataclass(frozen=True)
class Left:
    end_m: float
    failed: str | None


def cases(study):
    return [Case(start, change) for change in range(STATED, len(study.changes)) for start in range(len(study.starts_m))]


def run(study, case):
    rate = study.changed(case.change).decay.rate_per_s
    return Left(study.starts_m[case.start] * float(np.exp(-4 * rate)), "diverged" if rate > 10 else None)


def table(results):
    stated = results.runs[Case(0)]
    return ResultTable("Ends", "paper, Table 1", ("printed", "obtained"),
                       ((results.study.decay.printed_m, stated.end_m),))


def plots(results):
    for change, title in enumerate(("as stated", "changed"), start=STATED):
        ends = np.array([run.end_m for run in results.select(change=change).values()])
        yield Plot(title, "paper, Figure 1", "start", "end (m)", (Curve("", np.arange(float(len(ends))), ends),))


def never_run(results):
    yield "What is said before stays."
    yield f"Never said: {needed(next(iter(results.changing('starts_m').values()), None))}."


def ended(results):
    twice = results.changing("decay.rate_per_s", start=0)
    return f"Ends of {span(run.end_m for run in twice.values() if run.failed is None)} m."


KIND = Reproduction(
    TinyStudy, cases, run, lambda study, case: f"start {case.start}, {study.change_title(case.change)}",
    lambda study, case, left: {"start": case.start, "end_m": left.end_m}, Results, (table,), (plots,),
    (never_run, ended), TripComparison(Drivers({}, lambda study: {}, lambda study, name: {}, run), "place",
                                       lambda *_: "", lambda *_: ([], "")), lambda study, curve: None).kind


def loaded(tmp_path, text=FILE):
    path = tmp_path / "study.toml"
    path.write_text(text, encoding="utf-8")
    return validate_record(read_toml(path), TinyStudy, path)


def test_a_study_of_one_file_runs_as_it_is_and_under_its_changes(tmp_path):
    told = []
    result = KIND.run(loaded(tmp_path), 1, lambda *step: told.append(step))
    ends = [row["end_m"] for row in result.rows[:4]]
    assert ends == pytest.approx([np.exp(-2), 2 * np.exp(-2), np.exp(-4), 2 * np.exp(-4)])
    assert result.tables[0].rows == ((0.14, result.rows[0]["end_m"]),)
    assert [plot.title for plot in result.plots] == ["as stated", "changed"]
    assert result.failures == tuple((f"start {i}, so fast that it fails", "diverged") for i in (0, 1))
    assert told[-1] == (6, 6, "start 1, so fast that it fails")


def test_a_finding_without_its_runs_is_left_out_and_the_others_stay(tmp_path):
    result = KIND.run(loaded(tmp_path), 1, lambda *_: None)
    assert result.findings == ("What is said before stays.", "Ends of 0.0183 m.")

    def mistaken(results):
        raise KeyError("a mistake in a maker is no missing run")

    with pytest.raises(KeyError):
        list(found((mistaken,), None))


@pytest.mark.parametrize(("before", "after", "message"), [
    ("shown = 1", "shown = 3", "shown: there is no start 3: choose one of 1, 2"),
    ('"decay.rate_per_s" = 1.0', '"decay.speed" = 1.0', "changes: 'twice the rate': decay.speed: no such key"),
    ('"decay.rate_per_s" = 1.0', '"decay.rate_per_s" = -1.0', "changes: 'twice the rate': decay.rate_per_s: Input")])
def test_a_file_that_does_not_fit_is_one_line(tmp_path, before, after, message):
    with pytest.raises(InputError, match=re.escape(message)):
        loaded(tmp_path, changed(FILE, before, after))


def test_a_mistake_of_the_file_is_not_blamed_on_a_change(tmp_path):
    with pytest.raises(InputError, match="shown: there is no start") as said:
        loaded(tmp_path, changed(FILE, "shown = 1", "shown = 0"))
    assert "changes:" not in str(said.value)


def test_runs_are_looked_up_by_case_and_by_what_their_change_sets(tmp_path):
    study = loaded(tmp_path)
    results = Results(study, {case: case for case in cases(study)})
    assert list(results.select(start=1)) == [Case(1), Case(1, 0), Case(1, 1)]
    assert list(results.changing()) == [case for case in cases(study) if case.change != STATED]
    assert list(results.changing("decay.rate_per_s", start=0)) == [Case(0, 0), Case(0, 1)]
    assert not results.changing("decay.printed_m") and not results.changing("decay.rate_per_s", "decay.printed_m")


def test_words_of_findings():
    assert [listed("a"), listed("ab"), listed("abc")] == ["a", "a and b", "a, b and c"]
    assert [span([2.0, 0.5, 1.0]), span([1.0, 1.00001])] == ["0.500 to 2.00", "1.00"]
    for lacking in (lambda: listed(()), lambda: span(()), lambda: some(()), lambda: needed(None)):
        with pytest.raises(LackingError):
            lacking()

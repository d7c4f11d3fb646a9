"""A study that runs a paper again, as small as a newcomer's: what it declares, and what the package makes of it."""

import re
from dataclasses import dataclass

import numpy as np
import pytest
from refusals import changed

from workbench.errors import InputError
from workbench.files.numbers import number
from workbench.files.toml import Number, Positive, Record, read_toml, validate_record
from workbench.paper.checks import one_of
from workbench.paper.findings import LackingError, found, listed, needed, required, some, span
from workbench.paper.gain_search import OwnRuns, Task
from workbench.paper.loading import Loaded
from workbench.paper.only_full import ExtraTable
from workbench.paper.reproduced import (
    STATED,
    ColumnTable,
    ReproducedStudy,
    Results,
    RunCase,
    stated_and_changed,
)
from workbench.paper.reproduction import Reproduction, case_title
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
    return stated_and_changed(study, map(Case, range(len(study.starts_m))))


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


KIND = Reproduction(TinyStudy, cases, run, tables=(table,), plots=(plots,), findings=(never_run, ended)).kind


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


def test_what_a_study_does_not_declare_is_made_of_its_cases_and_runs(tmp_path):
    study = loaded(tmp_path)
    assert cases(study) == [Case(start, change) for change in (STATED, 0, 1) for start in (0, 1)]
    bare = Reproduction(TinyStudy, stated_and_changed, lambda study, case: run(study, Case(0, case.change))).kind
    result = bare.run(study, 1, lambda *_: None)
    assert [row["change"] for row in result.rows] == [None, "twice the rate", "so fast that it fails"]
    assert result.rows[0] == {"change": None, "end_m": pytest.approx(np.exp(-2)), "failed": None}
    assert result.failures == (("so fast that it fails", "diverged"),)
    assert not result.tables and not result.plots and not result.findings and result.winners is None
    assert bare.run_one(study, {"change": 0})["end_m"] == pytest.approx(np.exp(-4))
    assert (case_title(study, RunCase()), case_title(study, Case(1, 0))) == ("as stated", "start 1, twice the rate")


def test_a_study_that_holds_no_law_against_mpc_refuses_to_tune_one(tmp_path):
    pairs = "draws = 2, seed = 1, spread = 0.1, resamples = 100, confidence = 0.95, places = ['all'], set = {}"
    study = loaded(tmp_path, changed(FILE, "shown = 1", f"shown = 1\npairs = {{ {pairs} }}"))
    with pytest.raises(InputError, match=r"pairs: is for studies that hold laws against MPC.*: remove it"):
        KIND.located(study, tmp_path / "study.toml")


def test_found_gains_run_in_the_studys_own_case_and_what_it_has_run_is_not_run_again(tmp_path):
    study, made = loaded(tmp_path), []

    def make(study, case):
        made.append(case)
        return run(study, case)

    own = OwnRuns(lambda study, task: Case(1), make, lambda study, left: (
        {"end_m": left.end_m, "rate": study.decay.rate_per_s}, left.failed))
    of_file = Loaded(tmp_path / "study.toml", {}, study)
    runs = {case: run(study, case) for case in cases(study)}
    for rate, change in ((0.5, STATED), (1.0, 0)):
        task = Task("found", "alone", {"decay.rate_per_s": rate})
        assert own.had(of_file, task, runs) == own.run(of_file, task) == (
            {"end_m": runs[Case(1, change)].end_m, "rate": rate}, None)
    assert made == [Case(1), Case(1)]
    other = Task("found", "alone", {"decay.rate_per_s": 0.7})
    assert own.had(of_file, other, runs) is None and own.had(of_file, task, {}) is None
    assert own.run(of_file, other)[0]["end_m"] == pytest.approx(2 * np.exp(-2.8))
    with pytest.raises(ValueError, match=r"found: decay.speed: no such key"):
        own.run(of_file, Task("found", "alone", {"decay.speed": 1.0}))


class Printed(ColumnTable):
    energy_J: tuple[Number, ...]
    error_m: tuple[Number, ...]
    time_s: tuple[Number, ...]


def test_a_table_by_columns_has_as_many_values_in_each():
    source = dict.fromkeys(("energy_J", "error_m", "time_s"), "paper, Table 1")
    whole = {"energy_J": (1.0, 2.0), "error_m": (3.0, 4.0), "time_s": (5.0, 6.0), "source": source}
    assert Printed.model_validate(whole).columns == 2
    with pytest.raises(ValueError, match="error_m has 1 values, others 2: give one value a column in each"):
        Printed.model_validate(whole | {"error_m": (3.0,)})


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
    twice, fails = study.changes
    assert results.changed_runs(start=0) == [(twice, Case(0, 0)), (fails, Case(0, 1))]
    assert [title for title, _ in results.by_change(start=1)] == [twice.title, fails.title]
    assert [list(runs) for _, runs in results.by_change(start=1)] == [[Case(1, 0)], [Case(1, 1)]]
    assert study.number_titled("so fast that it fails") == 1
    assert not results.changing("decay.printed_m") and not results.changing("decay.rate_per_s", "decay.printed_m")


def test_words_of_findings():
    assert [listed("a"), listed("ab"), listed("abc")] == ["a", "a and b", "a, b and c"]
    assert [span([2.0, 0.5, 1.0]), span([1.0, 1.00001])] == ["0.500 to 2.00", "1.00"]
    for lacking in (lambda: listed(()), lambda: span(()), lambda: some(()), lambda: needed(None)):
        with pytest.raises(LackingError):
            lacking()


SHORT = changed(FILE, 'title = "so fast that it fails"', 'title = "so fast that it fails"\nonly_full = true')


def by_change(results):
    rows = [(change.title, case.start, run.end_m) for (case, run), (change, _) in zip(
        results.changing().items(), results.changed_runs(), strict=True)]
    return ResultTable("Changes", "not in the paper", ("change", "start", "end"), tuple(rows), "In m.")


def failing(results):
    yield ResultTable("Failing", "not in the paper", ("end",), tuple(
        (run.end_m,) for _, run in results.under(lambda change: change.set["decay.rate_per_s"] > 50)))


def slowest(results):
    return f"Of one change: {number(results.runs[Case(1, 0)].end_m)} m."


def fastest(results):
    return f"Of the other: {results.runs[Case(1, 1)].failed}."


def counted(results):
    return f"{len(results.changing())} runs of changes."


LONG = Reproduction(TinyStudy, cases, run, tables=(table, by_change, failing), plots=(plots,), findings=(
    ended, slowest, fastest, counted))


def test_a_short_report_has_the_same_rows_cells_and_sentences_or_less(tmp_path):
    study, told = loaded(tmp_path, SHORT), []
    full = LONG.kind.run(study, 1, lambda *_: None)
    short = LONG.kind.run(study.shortened(), 1, lambda *step: told.append(step))
    assert len(told) == 4 and short.left_out == 2 and full.left_out == 0
    assert short.rows == full.rows[:4] and full.rows[4:] and all(row["failed"] for row in full.rows[4:])
    stated, changes, fails = full.tables
    assert short.tables[0] == stated, "a table that lacks nothing is the same"
    assert short.tables[1].rows == changes.rows[:2] and len(changes.rows) == 4
    assert short.tables[1].note == "In m. Shortened: 2 runs left out; all with --full."
    assert len(short.tables) == 2 and fails.title == "Failing", "of a table that lacks all runs nothing is left"
    assert [plot.title for plot in short.plots] == [plot.title for plot in full.plots]
    assert full.findings == ("Ends of 0.0183 m.", "Of one change: 0.0366 m.", "Of the other: diverged.",
                             "4 runs of changes.")
    assert short.findings == ("Of one change: 0.0366 m.",), "no sentence counts what is not there"


def test_only_full_is_for_rows_and_tables_of_runs_alone_and_comes_from_nowhere(tmp_path):
    for before, after, key in (('name = "tiny"', 'name = "tiny"\nonly_full = true', "only_full"),
                               ("rate_per_s = 0.5", "rate_per_s = 0.5, only_full = true", "decay.only_full")):
        with pytest.raises(InputError, match=rf"{key}: (is no key|unknown|.*not)"):
            loaded(tmp_path, changed(FILE, before, after))
    with pytest.raises(InputError, match=r"changes\[1\].only_full"):
        loaded(tmp_path, SHORT.replace("only_full = true", 'only_full = "yes"'))

    class Sweep(ExtraTable):
        rates: tuple[Positive, ...]

    table = {"rates": (1.0, 2.0), "only_full": True, "source": {"rates": "assumed: some"}}
    for source in (table["source"], "assumed: some"):
        assert validate_record(table | {"source": source}, Sweep, "f.toml", reproduction=True).only_full
    with pytest.raises(InputError, match=r"source\.only_full explains a value"):
        validate_record(table | {"source": {"rates": "assumed: some", "only_full": "x"}}, Sweep, "f.toml")


def test_a_run_is_found_by_the_values_of_its_change(tmp_path):
    study = loaded(tmp_path)
    results = Results(study, {case: run(study, case) for case in cases(study)})
    assert results.with_values(decay__rate_per_s=1.0) == run(study, Case(0, 0))
    assert results.with_values(decay__rate_per_s=2.0) is None is results.with_values(shown=1)


def test_a_finding_that_does_not_hold_is_left_out():
    def holds(results):
        required(results > 1)
        yield "More than one."

    assert [list(found((holds,), count)) for count in (1, 2)] == [[], ["More than one."]]

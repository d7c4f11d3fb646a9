"""What the command line shows: tables, single claims, progress."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.box import SIMPLE_HEAD
from rich.console import Group
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from workbench.cli.console import err_console
from workbench.files.numbers import counted
from workbench.files.units import KWH_J
from workbench.proof.verdict import verdict_words

if TYPE_CHECKING:
    from workbench.paper.contents import Contents

LINE_EVERY_S = 30.0
COLOURS = {"proved": "green", "refuted": "red", "violated": "red", "gap": "yellow", "assumed": "cyan",
           "undecided": "magenta"}


@contextmanager
def progress() -> Iterator[Any]:
    """A progress bar per stage on standard error; where that is no terminal a plain line per stage, and every
    LINE_EVERY_S seconds one that says how far it is."""
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
               TextColumn("{task.fields[pace]}", markup=False))
    terminal = err_console.is_terminal
    stages: dict[str, Stage] = {}
    ended = threading.Event()

    def tell() -> None:
        while not ended.wait(LINE_EVERY_S):
            for stage in [stage for stage in stages.values() if stage.done < stage.total][-1:]:
                _plain(stage.line())

    with Progress(*columns, console=err_console, disable=not terminal) as bar:
        tasks: dict[str, Any] = {}

        def show(what: str, done: int, total: int) -> None:
            if what not in stages or done < stages[what].done:  # another count: its rate is its own
                stages[what] = Stage(what, done, begun_s=time.monotonic())
                tasks[what] = bar.add_task(what, total=total, pace="")
            stage = stages[what]
            stage.at(done, total)
            if terminal:
                bar.update(tasks[what], completed=done, total=total, pace=stage.pace())
            elif done == total:
                _plain(f"{what}: {done} done")

        if not terminal:
            threading.Thread(target=tell, daemon=True).start()
        try:
            yield show
        finally:
            ended.set()


def _plain(line: str) -> None:
    err_console.print(line, soft_wrap=True, markup=False, highlight=False)


@dataclass
class Stage:
    """How far a stage of a command is, and how fast. first: what was done when it began, as by a run before it;
    begun_s: when that was, by `time.monotonic`."""

    what: str
    first: int
    begun_s: float
    done: int = 0
    total: int = 0

    def at(self, done: int, total: int) -> None:
        """Keep how far it is now."""
        self.done, self.total = done, total

    def pace(self) -> str:
        """Rate and time left, in words; empty where nothing can be said of them yet."""
        seconds, made = time.monotonic() - self.begun_s, self.done - self.first
        if made <= 0 or seconds <= 0:
            return ""
        rate = made / seconds
        return f"{rate:.3g}/s, {_duration((self.total - self.done) / rate)} left"

    def line(self) -> str:
        """A line for a log."""
        pace = self.pace()
        return f"{self.what}: {self.done} of {self.total}{', ' if pace else ''}{pace}"


def _duration(seconds: float) -> str:
    """As people say it: 40 s, 12 min, 3.5 h."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def answer_card(answer: Mapping[str, Any]) -> Table:
    """A pasted line decided: the verdict, the goal as it was read, and what shows it."""
    from workbench.report.plain_formulas import plain_formula

    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True, style="bold")
    table.add_column(overflow="fold")
    goal = {part: list(map(plain_formula, lines)) for part, lines in answer["goal"].items()}
    known = {"verdict": [answer["verdict"]], "the line as read": goal["show"], "given": goal["assume"],
             "along": goal["flow"], "constant": [", ".join(goal["constant"])],
             "may vary": [", ".join(goal["inputs"])],
             "counterexample": [", ".join(plain_formula(f"{name} = {value}")
                                          for name, value in (answer["counterexample"] or {}).items())],
             "shown by": [answer["method"]]}
    for what, texts in known.items():
        for number, text in enumerate(filter(None, texts)):
            table.add_row("" if number else what, Text(text, COLOURS[text] if what == "verdict" else ""))
    return table


def claim_card(row: Mapping[str, Any]) -> Table:
    """One claim with all that is known of it."""
    from workbench.report.certificate_latex import assignments_latex
    from workbench.report.letters import letters_from
    from workbench.report.plain_formulas import plain_formula, plain_told, plain_words

    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True, style="bold")
    table.add_column(overflow="fold")
    own = letters_from(row.get("letters"))
    goal = None if row["match"] == "parsed" else own.in_formula(row["goal"] or "")
    point = list(map(own.in_formula, assignments_latex(row["counterexample"] or {})))
    recorded = "" if row["recorded"] == row["verdict"] else f", but recorded {row['recorded']}"
    known = {
        "claim": f"{row['id']}: {plain_words(row['title'])}", "statement": plain_formula(row["statement"]),
        "verdict": verdict_words(row["verdict"], row["proved_under"]) + recorded,
        "shown by": row["method"], "value": plain_words(row["computed"] or "").replace("-", "−"),
        "counterexample": ", ".join(map(plain_formula, point)),
        "corrected": plain_formula(row["correction"] or ""), "fate": _fate(row), "holds for": row["scope"],
        "stands in the paper as": f"{ORIGIN_WORDS[row['origin']]}, {row['severity']}",
        "became a goal by": f"{MATCH_WORDS[row['match']]}{': ' if row['reading'] else ''}"
                            f"{plain_words(row['reading'] or '')}",
        "decided as": plain_formula(goal or ""),
        "letters": plain_told(own.legend([goal or "", *point])),
        "other reading": f"{row['glyph_claim']}: {plain_formula(row['glyph'])}" if row["glyph"] else None,
        "mends": row["mends"],
        "rests on": ", ".join(row["rests_on"]), "our proof uses": ", ".join(row["premises"]),
        "these assume besides": ", ".join(row["besides"]),
        "failed below": ", ".join(row["tainted_by"]), "note": plain_words(row["note"]),
        "certificate": row["certificate"] and _from_here(Path(row["certificate"])),
    }
    for what, text in known.items():
        if text:
            table.add_row(what, Text(text, verdict_colour(row["verdict"], row["proved_under"])
                                     if what == "verdict" else ""))
    table.add_row()
    return table


def verdict_colour(verdict: str, proved_under: Sequence[str]) -> str:
    """The colour of a verdict: what is proved from claims that are not shown has that of a gap."""
    return COLOURS["gap" if proved_under else verdict]


ORIGIN_WORDS = {"printed": "a printed line", "implied": "a step taken without words", "ours": "a question of ours"}
MATCH_WORDS = {"parsed": "a machine that parsed the line", "read": "a person who read the line", "words": "its words"}


def _fate(row: Mapping[str, Any]) -> str | None:
    from workbench.report.plain_formulas import plain_formula
    from workbench.report.worded import show, worded

    return f"{row['fate']}: {show(worded(row['fate_why']), plain_formula)}" if row["fate"] else None


def fate_lines(document: Mapping[str, Any]) -> list[Text]:
    """What becomes of each headline statement."""
    return [Text(f"{claim['id']} {_fate(claim)}") for claim in document["claims"] if claim["fate"]]


ERRORS = "Errors are measured minus desired, [least, largest] of"


def metrics_table(rows: Sequence[dict[str, Any]], title: str) -> Table:
    """The controllers of a comparison beside each other."""
    table = Table(title=title, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, caption_justify="left",
                  caption=f"{ERRORS} the run; step: the time that a command takes to compute.")
    _columns(table, "period\n(ms)", "position\nerror (mm)", "speed error\n(mm/s)", "stop\n(mm)", "energy\n(kWh)",
             "step\n(µs)")
    for r in rows:
        table.add_row(
            Text(r["controller"]).append(" failed" if r["failed"] else "", "red"), f"{r['period_s'] * 1e3:.3g}",
            _range(r["position_error_min"], r["position_error_max"]),
            _range(r["speed_error_min"], r["speed_error_max"]), _number(r["stopping_error"], 1e3),
            "–" if r["energy_J"] is None else f"{r['energy_J'] / KWH_J:.5g}", _number(r["step_us_median"]))
    return table


def summary_table(summaries: Sequence[Any], runs: int) -> Table:
    """The controllers of a Monte Carlo beside each other."""
    table = Table(title=f"Monte Carlo, {counted(runs, 'run')}", title_justify="left", box=SIMPLE_HEAD, pad_edge=False,
                  caption_justify="left", caption=f"{ERRORS} all runs.")
    _columns(table, "position\nerror (mm)", "speed error\n(mm/s)", "mean |stop|\n(mm)", "failed\nruns")
    for s in summaries:
        table.add_row(s.controller, _range(s.position_error_min, s.position_error_max),
                      _range(s.speed_error_min, s.speed_error_max), _number(s.mean_abs_stopping_error, 1e3),
                      f"{s.failed} of {s.runs}")
    return table


def print_failures(rows: Sequence[dict[str, Any]]) -> None:
    """A line on standard error for every run that failed."""
    for row in rows:
        if row["failed"]:
            err_console.print(f"{row['controller']}: {row['failed']}", style="red", soft_wrap=True)


def _columns(table: Table, *headings: str) -> None:
    table.collapse_padding = True  # seven columns on a screen of 80 characters
    table.add_column("controller", overflow="fold")
    for heading in headings:
        table.add_column(heading, justify="right", overflow="fold")


def _number(value: float | None, scale: float = 1.0) -> str:
    """A number with three digits, zeros at its end among them: a column's numbers are known equally well."""
    return "–" if value is None else "0" if value == 0 else f"{value * scale:#.3g}".rstrip(".").replace("-", "−")


def _range(low: float | None, high: float | None, scale: float = 1e3) -> str:
    """A range in thousandths of the SI unit, as the tables show errors."""
    return "–" if low is None or high is None else f"[{_number(low, scale)}, {_number(high, scale)}]"


def papers_table(papers: Sequence[Contents]) -> Table:
    """The papers found, the title of each, and below it what it has; folders as seen from the current one."""
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    table.add_column("paper", no_wrap=True, style="bold")
    table.add_column("what it has", overflow="fold")
    for paper in papers:
        certificates = counted(paper.certificates, "certificate") if paper.certificates else "no certificates"
        has = [", ".join(paper.parts) or "nothing yet", certificates, _from_here(paper.folder)]
        table.add_row(paper.name, Group(*filter(None, [paper.title]), Text("; ".join(has), "dim", overflow="fold")))
    return table


def _from_here(path: Path) -> str:
    """A path relative to the current folder where it lies below it."""
    here = Path.cwd()
    full = path.resolve()
    return str(full.relative_to(here) if full.is_relative_to(here) else full)

"""Matches kept in a folder: an interrupted contest goes on with them, another contest does not."""

from pathlib import Path

import pytest
from contests import COMMON, common, few, only
from scenarios import PROOFS
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.contest.journal import JOURNAL_NAME, matches_journal
from workbench.contest.record import Contest
from workbench.contest.study import run, run_kept
from workbench.errors import InputError

RUNNER = CliRunner()


@pytest.fixture(scope="module")
def contest() -> Contest:
    whole = common()
    return few(whole, "nominal", "ten").with_world(only(whole.world, "pid", "pocrac", "mpc_linear"))


class StopError(Exception):
    pass


def stop_after(count: int):
    def on_progress(done: int, _total: int, _what: str) -> None:
        if done == count:
            raise StopError
    return on_progress


def ignore(*_: object) -> None:
    pass


def lines(folder: Path) -> list[str]:
    return (folder / JOURNAL_NAME).read_text(encoding="utf-8").splitlines()


@pytest.fixture(scope="module")
def played(contest: Contest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a contest that was interrupted and went on."""
    folder = tmp_path_factory.mktemp("kept")
    with pytest.raises(StopError):
        run_kept(contest, 1, stop_after(7), folder, False)
    assert len(lines(folder)) == 1 + 7
    seen: list[int] = []
    found = run_kept(contest, 1, lambda done, total, what: seen.append(done), folder, True)
    assert seen[0] == 8, "the seven are not played again"
    assert found.rows == run(contest, 1, ignore).rows
    return folder


def test_what_is_finished_is_not_played_again(contest: Contest, played: Path) -> None:
    before = lines(played)
    found = run_kept(contest, 1, stop_after(1), played, True)
    assert lines(played) == before
    assert len(found.rows) * 3 == 2 * (len(before) - 1), "one match of the first condition, two of the second"


def test_more_draws_go_on_with_those_that_were_played(contest: Contest, played: Path) -> None:
    before, seen = lines(played), []
    more = contest.model_copy(update={"seeds": contest.seeds + 1})
    with pytest.raises(StopError):
        run_kept(more, 1, lambda *now: (seen.append(now[0]), stop_after(len(before))(*now)), played, True)
    assert seen == [len(before)]
    (played / JOURNAL_NAME).write_text("\n".join(before) + "\n", encoding="utf-8")


def test_another_contest_does_not_go_on_with_them(contest: Contest, played: Path) -> None:
    before = lines(played)
    others = contest.model_copy(update={"seed": contest.seed + 1}), contest.model_copy(update={
        "conditions": contest.conditions | {"ten": contest.conditions["ten"].model_copy(update={"spread": 0.11})}})
    for other, word in zip(others, ("seed", "values, line and code"), strict=True):
        with pytest.raises(InputError, match=rf"{word}.*without resume"):
            run_kept(other, 1, ignore, played, True)
    assert lines(played) == before


@pytest.mark.parametrize("record", [{}, {"condition": "ten"}, {"draw": "x"}])
def test_a_record_that_is_no_match_is_refused(contest: Contest, played: Path, tmp_path: Path, record: dict) -> None:
    (tmp_path / JOURNAL_NAME).write_text(lines(played)[0] + "\n", encoding="utf-8")
    with matches_journal(tmp_path, contest, True) as journal:
        journal.append(record | {"n": 1})
    with pytest.raises(InputError, match=r"no match of a contest.*without resume"):
        run_kept(contest, 1, ignore, tmp_path, True)


@pytest.mark.parametrize(("arguments", "words"), [
    ([COMMON, "--resume"], "needs the folder"),
    ([PROOFS / "liu2020", "--out", "x"], "--out: is for contests"),
    ([PROOFS / "yang2021", "--resume"], "--resume: is for contests"),
])
def test_where_nothing_is_kept_the_options_are_refused(arguments: list[object], words: str) -> None:
    asked = RUNNER.invoke(app, ["compare", *map(str, arguments)])
    assert isinstance(asked.exception, InputError)
    assert words in str(asked.exception)

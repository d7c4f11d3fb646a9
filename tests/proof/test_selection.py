"""One claim of a file: decided with what it rests on, shown alone."""

import json

import pytest
from small_papers import IDS, TEXT, document, proved, write_paper

from workbench.cli.app import app
from workbench.errors import InputError
from workbench.proof import cache as kept_module


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(kept_module, "engine_digest", lambda: "these deciders")


def command(capsys, *arguments):
    """The exit code of `workbench prove` in this process, and what it shows without the line breaks."""
    with pytest.raises(SystemExit) as left:
        app(["prove", *map(str, arguments), "--write", "--all", "--jobs", "1"])
    return left.value.code, " ".join(capsys.readouterr().out.split())


def test_one_claim_is_decided_with_what_it_rests_on_and_nothing_else(tmp_path):
    path = write_paper(tmp_path)
    alone = proved(f"{path}::2")
    assert [d.claim.id for d in alone.decisions] == [IDS[1]]
    assert set(alone.now) == {IDS[0], IDS[1]}
    tainted = proved(f"{path}::4")
    assert [d.tainted_by for d in tainted.decisions] == [(IDS[2],)]
    assert set(tainted.now) == {IDS[2], IDS[3]}
    whole = document(proved(path))["claims"]
    assert document(proved(f"{path}::4"))["claims"] == [whole[3]]


def test_a_pattern_names_several_and_files_are_decided_once(tmp_path):
    path = write_paper(tmp_path)
    assert [d.claim.id for d in proved(f"{path}::[23]").decisions] == IDS[1:3]
    assert [d.claim.id for d in proved(f"{path}::small2020:*").decisions] == IDS
    (tmp_path / "x").mkdir()
    same = tmp_path / "x" / ".." / "small2020.py"
    assert [d.claim.id for d in proved(f"{path}::5", f"{path}::1", f"{same}::1").decisions] == [IDS[0], IDS[4]]
    assert [d.claim.id for d in proved(path, path, f"{path}::1").decisions] == IDS


@pytest.mark.parametrize("equation", ["4[a]", "4*", "4?"])
def test_an_equation_that_looks_like_a_pattern_is_refused(tmp_path, equation):
    path = write_paper(tmp_path, TEXT.replace('paper.claim("4"', f'paper.claim("{equation}"').replace(
        '("4",)', f'("{equation}",)'))
    with pytest.raises(InputError, match="is no number of a claim: use letters, digits"):
        proved(path)


@pytest.mark.parametrize(("pattern", "near"), [("44", "such as 4"), ("small2020:33", "name one of its 5"), ("", "5")])
def test_an_unknown_claim_is_said_with_those_like_it(tmp_path, pattern, near):
    path = write_paper(tmp_path)
    with pytest.raises(InputError, match="no such claim") as caught:
        proved(f"{path}::{pattern}")
    assert near in str(caught.value)
    assert f"small2020.py::{pattern}" in str(caught.value)


def test_the_claim_is_shown_with_all_that_is_known_of_it(tmp_path, capsys):
    path = write_paper(tmp_path)
    code, shown = command(capsys, f"{path}::3", "--json", tmp_path / "out.json")
    assert code == 0
    for part in ("small2020:3: a false one", "statement z", "verdict refuted", "counterexample x = ",
                 "corrected x² ≥ 0", "rests on small2020:2", "The note of 3.", "1 line of the paper: 1 refuted"):
        assert part in shown
    assert "an identity" not in shown
    made = json.loads((tmp_path / "out.json").read_text())
    assert made["version"] == 2
    assert [row["id"] for row in made["claims"]] == [IDS[2]]
    assert made["summary"]["refuted"] == 1 and sum(made["summary"].values()) == 1


def test_certificates_of_other_claims_stay(tmp_path, capsys):
    path = write_paper(tmp_path)
    folder = tmp_path / "certificates" / "small2020"
    assert command(capsys, path)[0] == 0
    assert sorted(p.stem for p in folder.iterdir()) == ["1", "2", "3", "4", "manifest"]
    (folder / "1.json").write_text("something else")
    (folder / "stale.json").write_text("{}")
    assert command(capsys, f"{path}::2")[0] == 0
    assert (folder / "1.json").read_text() == "something else"
    assert (folder / "stale.json").exists()
    assert command(capsys, path)[0] == 0
    assert (folder / "1.json").read_text() != "something else"
    assert (folder / "stale.json").exists(), "no manifest of ours names it"
    write_paper(tmp_path, TEXT.replace('paper.claim("1"', 'paper.claim("9"').replace('("1",)', '("9",)'))
    assert command(capsys, f"{path}::2")[0] == 0
    assert (folder / "1.json").exists()
    assert command(capsys, path)[0] == 0
    assert not (folder / "1.json").exists()
    assert (folder / "9.json").exists() and (folder / "stale.json").exists()


def test_a_folder_that_cannot_be_written_is_said(tmp_path, capsys):
    path = write_paper(tmp_path)
    (tmp_path / "certificates").write_text("a file")
    with pytest.raises(InputError, match=r"certificates.*--certificates"):
        app(["prove", str(path), "--jobs", "1"], standalone_mode=False)


def test_text_of_the_paper_is_shown_as_it_is(tmp_path, capsys):
    path = write_paper(tmp_path, TEXT.replace('"a false one"', '"for t in [a] and [/b]"').replace('"z"', '"[red]z"'))
    assert "for t in [a] and [/b]" in command(capsys, path)[1]
    code, shown = command(capsys, f"{path}::3")
    assert code == 0
    assert "for t in [a] and [/b]" in shown and "statement [r e d] z" in shown

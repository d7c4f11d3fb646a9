"""A certificate is of its claim: of no other, in no other words, and of none that is not there."""

import hashlib
import json
from pathlib import Path

import pytest
from small_papers import TEXT, proved, write_paper
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.proof.checker import check_folder, goal_digest
from workbench.proof.claim_digest import stated_digest
from workbench.proof.document import Places, certificate_text, write_certificates
from workbench.proof.paper import collect_papers

RUN = CliRunner()


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A paper as a proof file, and its certificates as texts."""
    path = write_paper(tmp_path_factory.mktemp("small"))
    found = proved(path, use_cache=False)
    write_certificates(found.decisions, Places(path.parent / "certificates"))
    return path


@pytest.fixture
def place(small, tmp_path):
    """A copy of the folder of certificates."""
    folder = tmp_path / "certificates" / "small2020"
    folder.mkdir(parents=True)
    for path in (small.parent / "certificates" / "small2020").iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    return folder


def reasons(place: Path) -> dict[str, str]:
    return {path.name: reason for path, _, reason in check_folder(place.parent) if reason}


def checked(place: Path, *options: object) -> tuple[int, str]:
    done = RUN.invoke(app, ["check-certificates", str(place.parent), *map(str, options)])
    return done.exit_code, " ".join(done.output.split())


def load(path: Path) -> dict:
    return json.loads(path.read_text())


def save(path: Path, content: dict) -> None:
    path.write_text(json.dumps(content))


def forged_manifest(place: Path) -> None:
    """A manifest made again of whatever stands in the folder, as somebody who forges it would."""
    manifest = load(place / "manifest.json")
    for path in place.glob("*.json"):
        if path.name != "manifest.json":
            certificate = load(path)
            path.write_text(certificate_text(certificate))
            manifest["claims"][path.stem] = {
                "verdict": certificate["verdict"], "goal_digest": goal_digest(certificate),
                "certificate": hashlib.sha256(path.read_bytes()).hexdigest()}
    save(place / "manifest.json", manifest)


@pytest.fixture
def resting(place):
    """The same, of a claim that uses another one, as whoever writes into both files can make it."""
    def uses(name: str, premises: object) -> None:
        save(place / f"{name}.json", load(place / f"{name}.json") | {"premises": premises})
        forged_manifest(place)

    return uses


def test_a_premise_is_named_with_the_goal_that_it_has(place, resting):
    claims = load(place / "manifest.json")["claims"]
    assert load(place / "2.json")["premises"] == {"1": claims["1"]["goal_digest"]}
    resting("4", {"3": claims["3"]["goal_digest"], "5": None})
    assert reasons(place) == {}


@pytest.mark.parametrize("premises", [{"7": None}, {"2": "0" * 64}, {"2": None}, {"5": "0" * 64}, ["2"], "2", {"2": 1}])
def test_a_premise_that_is_missing_or_another_is_refused(place, resting, premises):
    resting("4", premises)
    assert list(reasons(place)) == ["4.json"]


def test_nothing_is_proved_by_itself_through_its_premises(place, resting):
    claims = load(place / "manifest.json")["claims"]
    resting("1", {"2": claims["2"]["goal_digest"]})
    resting("4", {"1": claims["1"]["goal_digest"]})
    assert reasons(place) == dict.fromkeys(("1.json", "2.json"), "uses itself through its premises")


def test_premises_other_than_the_claims_own_are_refused_where_the_paper_is_at_hand(place, small, resting):
    claims = load(place / "manifest.json")["claims"]
    resting("1", {"5": claims["5"]["goal_digest"]})
    code, said = checked(place, "--paper", small)
    assert code == 1 and "uses the premises 5, the claim" in said


def test_the_manifest_lists_every_claim(place):
    claims = load(place / "manifest.json")["claims"]
    assert {name: entry["verdict"] for name, entry in claims.items()} == {
        "1": "proved", "2": "proved", "3": "refuted", "4": "proved", "5": "assumed"}
    assert claims["5"] == {"verdict": "assumed", "goal_digest": None, "certificate": None}
    assert reasons(place) == {}


def test_the_digest_is_that_of_the_claims_own_goal(small, place):
    (paper,) = collect_papers([small])
    for claim in paper.claims:
        entry = load(place / "manifest.json")["claims"][claim.equation]
        assert stated_digest(claim, claim.recorded) == entry["goal_digest"]


def test_held_against_its_paper(small, place):
    code, said = checked(place, "--paper", small)
    assert code == 0 and said.endswith("4 of 4 certificates hold; held against the goals of their papers' claims: 4")
    code, said = checked(place)
    assert code == 0 and "their manifest alone, for no claims are at hand: 4" in said


def test_a_missing_an_extra_a_renamed_and_a_swapped_one(place):
    texts = {n: (place / f"{n}.json").read_text() for n in "1234"}
    (place / "1.json").unlink()
    (place / "6.json").write_text(texts["2"])
    (place / "3.json").write_text(texts["4"])
    (place / "4.json").write_text(texts["3"])
    found = reasons(place)
    assert "missing" in found["1.json"] and "no such certificate" in found["6.json"]
    assert "another claim's name" in found["3.json"] and "another claim's name" in found["4.json"]


@pytest.mark.parametrize("what", [
    {"verdict": "gap"}, {"goal": {"assume": [], "show": ["(x + y)**2 == x**2 + 2*x*y + y*y"]}}])
def test_another_goal_or_verdict_under_the_claims_name(place, what, small):
    certificate = load(place / "1.json")
    save(place / "1.json", certificate | what)
    assert reasons(place)["1.json"]
    (place / "1.json").write_text(certificate_text(certificate | what))
    assert "another goal or verdict" in reasons(place)["1.json"]


def test_a_forged_manifest_does_not_pass_where_the_paper_is(place, small):
    true = {"claim": "small2020:3", "version": 1, "verdict": "proved", "goal": {"assume": [], "show": ["x**2 >= 0"]},
            "example": {"x": "0"}, "proofs": [{"rule": "combination", "terms": [
                {"coefficient": "1", "factors": [{"square": "x"}]}]}]}
    save(place / "3.json", true)
    save(place / "4.json", load(place / "4.json") | {"premises": {"3": goal_digest(true)}})
    forged_manifest(place)
    assert checked(place)[0] == 0  # alone, it is only said that nothing but the manifest was looked at
    code, said = checked(place, "--paper", small)
    assert code == 1 and "the paper records 'refuted'" in said


def test_a_claim_that_the_manifest_leaves_out_or_makes_up(place, small):
    manifest = load(place / "manifest.json")
    del manifest["claims"]["3"]
    (place / "3.json").unlink()
    del manifest["claims"]["4"]  # which uses it
    (place / "4.json").unlink()
    manifest["claims"]["7"] = {"verdict": "undecided", "goal_digest": None, "certificate": None}
    save(place / "manifest.json", manifest)
    assert reasons(place) == {}
    code, said = checked(place, "--paper", small)
    assert code == 1 and "does not name this claim" in said and "states no such claim" in said


def test_an_edited_claim_is_not_what_was_proved(place, tmp_path):
    other = write_paper(tmp_path / "edited", TEXT.replace("at_least(x**2, bound)", "at_least(x**2, bound - 1)"))
    code, said = checked(place, "--paper", other)
    assert code == 1 and "2.json: proved: INVALID: is of another goal than the one that the paper's claim" in said


@pytest.mark.parametrize("change", [
    lambda m: m | {"version": 1}, lambda m: m | {"claims": {}}, lambda m: m | {"claims": []},
    lambda m: m | {"extra": 1}, lambda m: m | {"paper": None},
    lambda m: m | {"claims": m["claims"] | {"1": {"verdict": "proved", "goal_digest": None, "certificate": None}}},
    lambda m: m | {"claims": m["claims"] | {"1": {"verdict": "true", "goal_digest": None, "certificate": None}}},
    lambda m: m | {"claims": m["claims"] | {"../1": m["claims"]["1"]}},
    lambda m: m | {"claims": m["claims"] | {"1": m["claims"]["1"] | {"goal_digest": "0" * 63}}},
    lambda m: m | {"claims": m["claims"] | {"5": m["claims"]["1"] | {"verdict": "assumed"}}}])
def test_a_manifest_that_is_not_whole(place, change):
    save(place / "manifest.json", change(load(place / "manifest.json")))
    found = reasons(place)
    assert "manifest.json" in found
    assert all(name in found for name in ("1.json", "2.json", "3.json", "4.json"))


def test_no_manifest_is_no_claim(place):
    (place / "manifest.json").unlink()
    assert all("holds, bound to no claim" in reason for reason in reasons(place).values())
    assert len(reasons(place)) == 4


def test_one_file_needs_its_claims_digest(place):
    digest = load(place / "manifest.json")["claims"]["2"]["goal_digest"]
    for options, code in (((), 1), (("--claim-digest", digest), 0), (("--claim-digest", "0" * 64), 1)):
        assert RUN.invoke(app, ["check-certificates", str(place / "2.json"), *options]).exit_code == code


def test_a_paper_without_certificates_here_is_bad_input(place, tmp_path):
    other = write_paper(tmp_path / "other", TEXT.replace("small2020", "other2020"))
    assert RUN.invoke(app, ["check-certificates", str(place.parent), "--paper", str(other)]).exit_code != 0


def test_a_paper_whose_certificates_are_gone_fails(small, tmp_path):
    folder = tmp_path / "proofs" / "small2020"
    (folder / "claims").mkdir(parents=True)
    text = TEXT.replace("from helper import bound", "bound = -1").replace(
        'sp.Rational((Path(__file__).parent / "stated.txt").read_text())', "sp.Integer(1)")
    (folder / "claims" / "section_1.py").write_text(text)
    where = Places(tmp_path, {"small2020": folder / "certificates"})
    write_certificates(proved(folder, use_cache=False).decisions, where)
    assert checked(folder / "certificates")[0] == checked(folder)[0] == 0
    assert "claims: 4" in " ".join(checked(folder)[1].split())
    for path in (folder / "certificates").iterdir():
        path.unlink()
    code, told = checked(folder)
    assert code == 1 and "is missing: run 'workbench prove" in told

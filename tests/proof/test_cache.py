"""What is kept between runs: the same answers, for exactly as long as nothing that they depend on has changed."""

import hashlib
import json
import os
import shutil
import subprocess
import sys
import time

import pytest
from small_papers import IDS, TEXT, certificates, deciders_at_rest, document, proved, write_paper

from workbench.files.regular import sha256_of
from workbench.files.text import read_text
from workbench.proof import cache as kept_module
from workbench.proof import dependencies
from workbench.proof.engine_digest import engine_digest

DECIDED = set(IDS[:4])  # an axiom is decided by reading it


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    # So that nothing here depends on whether somebody edits a decider meanwhile.
    monkeypatch.setattr(kept_module, "engine_digest", lambda: "these deciders")
    return tmp_path / "cache" / "decided-claims"


@pytest.fixture(scope="module")
def decided(tmp_path_factory):
    """The small paper decided once: its folder, the cache that this filled, and what was decided."""
    place = tmp_path_factory.mktemp("decided")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("WORKBENCH_CACHE", str(place / "cache"))
        patch.setattr(kept_module, "engine_digest", lambda: "these deciders")
        return place / "paper", place / "cache", proved(write_paper(place / "paper"))


@pytest.fixture
def filled(decided, cache):
    """A paper that is in the cache, and what was decided of it."""
    folder, before, proof = decided
    shutil.copytree(before, cache.parent)
    return write_paper(folder), proof


def decided_now(proof):
    return set(proof.now) & DECIDED


def entries(cache, kind):
    return sorted((cache / kind).rglob("*.json"))


def test_a_second_run_gives_the_same_document_and_the_same_certificates(tmp_path):
    path = write_paper(tmp_path)
    first, second = proved(path), proved(path)
    assert decided_now(first) == DECIDED
    assert second.now == frozenset()
    assert document(first) == document(second)
    assert certificates(first, tmp_path / "one") == certificates(second, tmp_path / "two") != {}
    verdicts = [d.verdict for d in second.decisions]
    assert verdicts == ["proved", "proved", "refuted", "proved", "assumed"]
    assert second.decisions[2].correction and second.decisions[2].counterexample
    assert [d.tainted_by for d in second.decisions] == [(), (), (), (IDS[2],), (IDS[2],)]


def test_without_the_proof_file_s_entry_each_claim_is_found_by_itself(filled, cache):
    path, first = filled
    shutil.rmtree(cache / "files")
    second = proved(path)
    assert decided_now(second) == set()
    assert document(first, seconds=False)["claims"][:4] == document(second, seconds=False)["claims"][:4]


def test_a_second_run_needs_neither_sympy_nor_the_deciders(tmp_path):
    path = write_paper(tmp_path)
    code = ("import sys; sys.argv = ['workbench', 'prove', *sys.argv[1:]]; from workbench.cli.app import main\n"
            "try: main()\nfinally: sys.stdout.write('loaded: ' + ' '.join(sorted(sys.modules)))")
    with deciders_at_rest():
        for workers in (("--workers", "1"), ()):  # nobody need be started to decide so little
            done = subprocess.run([sys.executable, "-W", "error", "-c", code, str(path), *workers], cwd=tmp_path,
                                  capture_output=True, text=True, check=True)
        loaded = set(done.stdout.partition("loaded: ")[2].split())
        assert "workbench.proof.prove" in loaded
        assert not {"sympy", "numpy", "scipy", "numba", "casadi", "matplotlib", "workbench.proof.claim"} & loaded


CHANGES = {
    "one goal": (TEXT.replace("at_least(x**2, bound)", "at_least(x**2 + y**2, bound)"), {IDS[1]}),
    "one flow": (TEXT.replace("flow={x: -x}", "flow={x: -x, y: x}"), {IDS[3]}),
    "one correction": (TEXT.replace("return Goal((at_least(x**2, 0),))", "return Goal((at_least(x**2 + 1, 0),))"),
                       {IDS[2]}),
    "what sympy knows of a symbol": (TEXT.replace('"x y", real=True', '"x y", positive=True'), DECIDED),
    "a kind": (TEXT.replace('"a false one", "inequality"', '"a false one", "implication"'), {IDS[2]}),
    "stated values": (TEXT.replace('"y", "proved", premises=("1",)', '"y", "proved", at={x: 3}'), {IDS[1]}),
    "a remark": (TEXT + "# a remark\n", set()),
    "a title and a note": (TEXT.replace("with the helper's", "another").replace("note of 2", "note"), set()),
    "the recorded verdict": (TEXT.replace('"y", "proved"', '"y", "gap"'), set()),
    "a premise": (TEXT.replace('premises=("3",)', 'premises=("1",)'), set()),
    "the order": (TEXT.replace('paper.claim("1"', 'paper.claim("9"').replace('("1",)', '("9",)'), {"small2020:9"}),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_change_decides_again_what_it_touches_and_nothing_else(change, filled):
    text, touched = CHANGES[change]
    assert text != TEXT
    path = write_paper(filled[0].parent, text)
    again = proved(path)
    assert set(again.now) - {IDS[4]} == touched
    assert document(again, seconds=False) == document(proved(path, use_cache=False), seconds=False)


def test_a_module_beside_the_file_and_the_data_it_reads_count(tmp_path):
    path = write_paper(tmp_path)
    proved(path)
    write_paper(tmp_path, bound=-2)
    assert decided_now(proved(path)) == {IDS[1]}
    write_paper(tmp_path, bound=-2, stated="2")
    assert decided_now(proved(path)) == {IDS[2]}
    (tmp_path / "stated.txt").unlink()
    with pytest.raises(Exception, match=r"stated\.txt"):
        proved(path)


def test_a_file_that_was_missing_counts_when_it_appears(tmp_path):
    text = TEXT.replace('stated = sp.Rational(', 'try:\n    open(Path(__file__).parent / "more.txt").close()\n    '
                        'x = y\nexcept OSError:\n    pass\nstated = sp.Rational(')
    path = write_paper(tmp_path, text)
    proved(path)
    assert proved(path).now == frozenset()
    (tmp_path / "more.txt").write_text("")
    assert decided_now(proved(path)) == DECIDED


def test_a_file_that_was_read_before_and_has_gone_is_in_no_one_s_way(tmp_path):
    other = tmp_path / "other.toml"
    other.write_text("")
    read_text(other, "TOML")
    other.unlink()
    path = write_paper(tmp_path)
    assert decided_now(proved(path)) == DECIDED
    assert proved(path).now == frozenset()


def test_changed_deciders_decide_everything_again(filled, monkeypatch):
    path, _ = filled
    monkeypatch.setattr(kept_module, "engine_digest", lambda: "another")
    assert decided_now(proved(path)) == DECIDED
    assert proved(path).now == frozenset()


def sources(folder, **files):
    """A folder of deciders, written long ago."""
    for name, text in files.items():
        path = folder / "decide" / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        os.utime(path, (1e9, 1e9))
    return folder


def test_the_digest_of_the_deciders_is_of_every_byte_and_of_the_libraries(tmp_path, monkeypatch):
    digests = [engine_digest(sources(tmp_path, one="x = 1", two=""))]
    assert engine_digest(sources(tmp_path / "elsewhere", two="", one="x = 1")) == digests[0]
    digests.append(engine_digest(sources(tmp_path, one="x = 2")))
    digests.append(engine_digest(sources(tmp_path, one="", two="x = 2")))
    digests.append(engine_digest(sources(tmp_path, three="")))
    monkeypatch.setattr("workbench.proof.engine_digest._version", lambda name: "1000")
    digests.append(engine_digest(tmp_path))
    assert len(set(digests)) == len(digests)
    assert None not in digests


def test_deciders_that_change_under_a_running_process_have_no_digest(tmp_path):
    sources(tmp_path, one="")
    (tmp_path / "checker.py").write_text("# changed just now")
    assert engine_digest(tmp_path) is None


def test_a_file_is_read_again_once_anything_says_that_it_is_another(tmp_path, monkeypatch):
    read, path = [], tmp_path / "one.py"
    monkeypatch.setattr(dependencies, "sha256_of", lambda path: read.append(path) or sha256_of(path))

    def written(text, settled_ns):
        monkeypatch.setattr(dependencies, "SETTLED_NS", settled_ns)
        path.write_text(text)
        os.utime(path, (1e9, 1e9))
        time.sleep(0.05)  # longer than a tick of the clock of files
        found = {dependencies.known_sha256(path) for _ in range(3)}
        assert found == {hashlib.sha256(text.encode()).hexdigest()}
        return len(read)

    assert written("x = 1", 10**12) == 3  # written only just: the clock may not tell the next change
    assert written("x = 2", 0) == 4
    assert written("x = 3", 0) == 5  # as long as before, and as old by its date


def test_a_proof_file_that_changes_while_it_is_decided_is_not_kept(tmp_path, cache):
    text = TEXT.replace('"""The note of 4."""', 'Path(__file__).write_text(Path(__file__).read_text() + "#")')
    path = write_paper(tmp_path, text)
    proved(path)
    assert entries(cache, "files") == []
    assert len(entries(cache, "claims")) == len(DECIDED)


DAMAGES = {
    "cut off": lambda data: data[: len(data) // 2],
    "cut off at the end": lambda data: data[:-1],
    "empty": lambda data: b"",
    "no text": lambda data: b"\xff\xfe" + data,
    "another verdict": lambda data: data.replace(b'"refuted"', b'"proved"').replace(b'"proved"', b'"refuted"', 1),
    "another statement": lambda data: data.replace(b"an identity", b"a nonsense!"),
    "a line more": lambda data: data + b"{}\n",
    "another shape": lambda data: sealed(b'{"key": 1}'),
    "no object": lambda data: sealed(b"[]"),
}


def sealed(text):
    return hashlib.sha256(text).hexdigest().encode() + b"\n" + text + b"\n"


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_entry_is_ignored_and_written_anew(damage, filled, cache):
    path, first = filled
    for entry in [*entries(cache, "files"), *entries(cache, "claims")]:
        entry.write_bytes(DAMAGES[damage](entry.read_bytes()))
    again = proved(path)
    assert document(again, seconds=False) == document(first, seconds=False)
    assert decided_now(again) != set()
    assert proved(path).now == frozenset()


def test_an_entry_that_stands_for_another_claim_is_ignored(filled, cache):
    path, first = filled
    shutil.rmtree(cache / "files")
    one, *others = entries(cache, "claims")
    for other in others:
        shutil.copy(one, other)
    assert document(proved(path), seconds=False) == document(first, seconds=False)


def test_a_well_sealed_entry_needs_a_certificate_that_holds(filled, cache):
    path, first = filled
    shutil.rmtree(cache / "files")
    for entry in entries(cache, "claims"):
        record = json.loads(entry.read_text().splitlines()[1])
        record["content"]["verdict"] = "proved"
        record["content"]["certificate"]["verdict"] = "proved"
        record["content"]["certificate"]["proofs"] = []
        entry.write_bytes(sealed(json.dumps(record).encode()))
    again = proved(path)
    assert decided_now(again) == DECIDED
    assert document(again, seconds=False) == document(first, seconds=False)


def test_no_cache_reads_and_writes_nothing(tmp_path, cache):
    path = write_paper(tmp_path)
    proved(path, use_cache=False)
    assert not cache.exists()
    proved(path)
    before = {entry: entry.stat().st_mtime_ns for entry in cache.rglob("*")}
    assert decided_now(proved(path, use_cache=False)) == DECIDED
    assert before == {entry: entry.stat().st_mtime_ns for entry in cache.rglob("*")}


def test_a_cache_that_cannot_be_written_costs_nothing_but_time(tmp_path, monkeypatch):
    blocked = tmp_path / "a file"
    blocked.write_text("")
    monkeypatch.setenv("WORKBENCH_CACHE", str(blocked))
    path = write_paper(tmp_path)
    assert decided_now(proved(path)) == decided_now(proved(path)) == DECIDED


def test_an_error_is_found_again_and_the_other_claims_are_kept(tmp_path):
    path = write_paper(tmp_path, TEXT.replace("flow={x: -x}", "flow={x: -undeclared}"))
    for _ in range(2):
        found = proved(path)
        assert "small2020.py: claim small2020:4: " in found.misstated["small2020:4"]
        assert "'undeclared' is not defined" in found.misstated["small2020:4"]
    assert decided_now(proved(write_paper(tmp_path))) == {IDS[3]}


def test_what_former_deciders_left_does_not_grow_for_ever(tmp_path, cache, monkeypatch):
    path = write_paper(tmp_path)
    for number in range(kept_module.ENGINES_KEPT + 3):
        monkeypatch.setattr(kept_module, "engine_digest", lambda number=number: f"{number}".ljust(40, "0"))
        proved(path)
    assert len(list((cache / "claims").iterdir())) == kept_module.ENGINES_KEPT
    assert proved(path).now == frozenset()

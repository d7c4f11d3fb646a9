"""Counterexamples kept in the cache are what they would be anew, and what is cut off or forged there is made again."""

import pytest

from workbench.report import counterexample_cache
from workbench.report.counterexample import counterexample_of
from workbench.report.counterexample_cache import cached_counterexample

POINT = {"claim": "doe2026:1", "version": 2, "verdict": "refuted", "point": {"x": "-3/2", "k": "1"},
         "goal": {"assume": ["k > 0"], "show": ["x**2*k <= k + x"]}}
MOTION = {"claim": "doe2026:2", "version": 2, "verdict": "gap", "point": {"c": "1"}, "functions": {"x": "c + t"},
          "goal": {"assume": [], "show": ["x <= c"], "flow": {"t": "1", "x": "w"}, "inputs": ["w"], "eventually": "t"}}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    counterexample_cache._folder.cache_clear()
    yield counterexample_cache._folder()
    counterexample_cache._folder.cache_clear()


@pytest.mark.parametrize("certificate", [POINT, MOTION])
def test_what_is_kept_is_what_it_was(certificate, folder, monkeypatch):
    first = cached_counterexample(certificate)
    assert first == counterexample_of(certificate) is not None
    monkeypatch.setattr(counterexample_cache, "counterexample_of", lambda _: pytest.fail("was kept"))
    assert cached_counterexample(certificate) == first


@pytest.mark.parametrize("forge", [lambda text: "", lambda text: text[:-9], lambda text: text.replace("3", "4"),
                                   lambda text: "x\nnull\n", lambda text: text + "more\n"])
def test_what_is_cut_off_or_forged_is_made_again(forge, folder):
    first = cached_counterexample(POINT)
    (path,) = folder.iterdir()
    path.write_text(forge(path.read_text()))
    assert cached_counterexample(POINT) == first


def test_another_certificate_is_another_entry_and_a_proof_is_none(folder):
    cached_counterexample(POINT)
    other = POINT | {"point": {"x": "-5/2", "k": "1"}}
    assert cached_counterexample(other) == counterexample_of(other) != cached_counterexample(POINT)
    assert cached_counterexample({**POINT, "verdict": "proved"}) is None
    assert len(list(folder.iterdir())) == 2

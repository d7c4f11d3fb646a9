"""Named lemmas of the literature: what a lemma asks to be shown of a paper's system, as goals; one builder a lemma."""

from workbench.proof.lemmas.bounds import comparison, finite_time, input_to_state, ultimate_bound
from workbench.proof.lemmas.convergence import barbalat, lasalle_yoshizawa, razumikhin
from workbench.proof.lemmas.invariance import darboux, nagumo
from workbench.proof.lemmas.lemma import Hypothesis, Lemma

__all__ = ["Hypothesis", "Lemma", "barbalat", "comparison", "darboux", "finite_time", "input_to_state",
           "lasalle_yoshizawa", "nagumo", "razumikhin", "ultimate_bound"]

"""Section 1: what the introduction says of the method."""

from __future__ import annotations

from ..paper import paper

paper.axiom("intro", "MFAILC converges monotonically in the 2-norm",
            r"\text{MFAILC can control repetitive unknown nonlinear systems, needs no model, and guarantees monotone convergence in the 2-norm}",
            "the introduction's summary of the literature on MFAILC, without a source of its own", hypotheses=(), severity="cosmetic", match="words",
            note="Said of MFAILC for systems that repeat strictly; nothing in the paper is derived from it. What the train does under these laws is asked in intro.lift to "
                 "intro.tradeoff, which are questions of ours.")

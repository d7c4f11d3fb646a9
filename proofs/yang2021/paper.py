"""yang2021: RBFNN position output constrained robust adaptive control of an urban train, every claim of it.

J. Yang, Y. Zhang, Y. Jin, Fully Automatic Operation Algorithm of Urban Rail Train Based on RBFNN Position
Output Constrained Robust Adaptive Control, Algorithms 14 (2021) 264.

Its claims are those of sections 2 to 5 and of the stated gains of section 6. The plant and the laws are those that the
simulation runs; V is (38). Derivatives are written D(...) and derived along the closed loop. What stands on the right
of `equal` and `at_most` is what the paper prints.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("yang2021", " ".join((__doc__ or "").split("\n\n")[1].split()))

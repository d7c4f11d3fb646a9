"""krstic1992: adaptive backstepping with tuning functions, one estimate for a parameter that enters three steps off.

M. Krstic, I. Kanellakopoulos, P. V. Kokotovic, Adaptive nonlinear control without overparametrization, Systems & Control Letters 19(3) (1992) 177-185. Stated in
its common form: the text was not at hand.

The paper's text was not at hand: its lines stand here as the design is commonly stated, for the chain of three states
that the same authors' textbook uses (Nonlinear and Adaptive Control Design, 1995, chapter 4), so rows have names instead
of equation numbers, and `printed` is that common form. The rows hold for every smooth nonlinearity phi: it and its
derivatives are symbols of which the claims know only that each moves with the next. The plant that is simulated has
phi(x_1) = x_1^2.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("krstic1992", " ".join((__doc__ or "").split("\n\n")[1].split()), at_hand=False)

EVERY_PHI = "every smooth phi, all states, parameters and gains"

"""moreno2012: the super-twisting algorithm by a strict Lyapunov function, without and with perturbations.

J. A. Moreno, M. Osorio, Strict Lyapunov Functions for the Super-Twisting Algorithm, IEEE Transactions on Automatic Control 57(4) (2012) 1035-1040. Stated in
its common form: the text was not at hand.

The paper's text was not at hand: its lines stand here as the result is commonly stated, with the perturbed case in the
form that goes back to the same authors' conference paper of 2008 (A Lyapunov Approach to Second-Order Sliding Mode
Controllers and Observers). Rows have names instead of equation numbers, and `printed` is that common form. The
rows hold where x_1 is not zero, which is where V has a derivative, and are decided over |x_1|^(1/2) and
sign(x_1) x_2, in which they are rational.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("moreno2012", " ".join((__doc__ or "").split("\n\n")[1].split()), at_hand=False)

OFF_ZERO = "all states with x_1 not zero, all positive gains"
BY_SIGN = "Over r = |x_1|^(1/2) and y = sign(x_1) x_2: a quadratic form of zeta is the same of (r, y)."

"""goodwin1980: discrete-time adaptive control by the projection algorithm.

G. C. Goodwin, P. J. Ramadge, P. E. Caines, Discrete-Time Multivariable Adaptive Control, IEEE Transactions on Automatic Control 25(3) (1980) 449-456. Stated in
its common form: the text was not at hand.

The paper's text was not at hand: its lines stand here as the result is commonly stated, for one input and one output with
two unknown parameters, so rows have names instead of equation numbers, and `printed` is that common form. A step from one
sample to the next is two symbols, before and after, and the rows hold for every regressor. The plant that is simulated is
a tank in continuous time whose sampled values obey such an equation exactly.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("goodwin1980", " ".join((__doc__ or "").split("\n\n")[1].split()), at_hand=False)

EVERY_STEP = "every regressor of two values, all estimates, every step"

"""lavretsky2009: model reference adaptive control, and its composite form that learns from a prediction error too.

E. Lavretsky, Combined/Composite Model Reference Adaptive Control, IEEE Transactions on Automatic Control 54(11) (2009) 2692-2697. Stated in
its common form: the text was not at hand.

The paper's text was not at hand: its lines stand here as the result is commonly stated, for a plant of two states with
known input gain, so rows have names instead of equation numbers, and `printed` is that common form. The rows hold for
every regressor of three functions: those that are simulated are those of wing rock (roll angle, roll rate, their product
in absolute value), whose coefficients are assumed of a usual size.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("lavretsky2009", " ".join((__doc__ or "").split("\n\n")[1].split()), at_hand=False)

EVERY_REGRESSOR = "every regressor of three functions, every reference, all states, estimates and gains"

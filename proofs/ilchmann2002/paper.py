"""ilchmann2002: the funnel controller, an error that stays within a prescribed funnel by a gain that grows near its wall.

A. Ilchmann, E. P. Ryan, C. J. Sangwin, Tracking with prescribed transient behaviour, ESAIM: Control, Optimisation and Calculus of Variations 7 (2002) 471-493. Stated in
its common form: the text was not at hand.

The paper's text was not at hand: its lines stand here as the result is commonly stated, for a plant of one state with
positive gain, so rows have names instead of equation numbers, and `printed` is that common form. The paper's class of
systems, with internal dynamics of any kind, is wider: here what is not the input's is any function that stays within a
bound, which is what its proof uses of it.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("ilchmann2002", " ".join((__doc__ or "").split("\n\n")[1].split()), at_hand=False)

EVERY_FUNNEL = "every positive smooth phi, every bounded rest, all errors within the funnel"

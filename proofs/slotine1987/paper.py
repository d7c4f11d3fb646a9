"""slotine1987: the adaptive controller of a robot arm that needs no accelerations, on an arm of two links.

J.-J. E. Slotine, W. Li, On the Adaptive Control of Robot Manipulators, The International Journal of Robotics Research
6(3) (1987) 49-59. Stated in
its common form: the text was not at hand.

The paper's text was not at hand: its lines stand here as the result is commonly stated, so rows have names instead of
equation numbers, and `printed` is that common form. The arm, its parameters, gains and desired motion are those of the
same authors' textbook (Applied Nonlinear Control, 1991, section 9.2): two links in a horizontal plane, no friction.
Sine and cosine of the elbow are two symbols on the unit circle, so that every row is decided for all angles.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("slotine1987", " ".join((__doc__ or "").split("\n\n")[1].split()), at_hand=False)

EVERY_ARM = "every two-link arm of the form stated, all angles, rates and parameters"

"""yang2021: RBFNN position output constrained robust adaptive control of an urban train, every claim of it.

J. Yang, Y. Zhang, Y. Jin, Fully Automatic Operation Algorithm of Urban Rail Train Based on RBFNN Position
Output Constrained Robust Adaptive Control, Algorithms 14(9) (2021) 264, doi 10.3390/a14090264.

Its claims are those of sections 2 to 5 and of section 6, numbers and text. The plant and the laws are those that the
simulation runs; V is (38). Derivatives are written D(...) and derived along the closed loop. Lines that only name
something, (5) to (7), (9), (16), (18), (22), (23), (27), (30), (38), (49), (50), enter the goals as what they define;
what the text says of them has rows of its own.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

from .letters import LETTERS
from .notation import NOTATION

paper = Paper("yang2021", " ".join((__doc__ or "").split("\n\n")[1].split()), NOTATION, LETTERS)

"""mao2018: adaptive actuator compensation of position tracking for high-speed trains, every claim of it.

Z. Mao, G. Tao, B. Jiang, X.-G. Yan, Adaptive Actuator Compensation of Position Tracking for High-Speed Trains
with Disturbances, IEEE Transactions on Vehicular Technology 67(7) (2018) 5706-5717, doi
10.1109/TVT.2018.2808360, as the author's accepted manuscript has it (Kent Academic Repository 66273).

Its claims are those of sections II to VII and of the stated data of section VIII. s is sgn(z_2) as Filippov has it:
s z_2 = |z_2| and |s| <= 1, so that any value in [-1, 1] is met at z_2 = 0. Lines are decided as the extracted text has
them, letter by letter; another reading, or a mended line, is a row of its own.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

from .letters import LETTERS
from .notation import NOTATION

paper = Paper("mao2018", " ".join((__doc__ or "").split("\n\n")[1].split()), NOTATION, LETTERS)

"""liu2020: every claim of sections 1 to 6.

Y. Liu, W. Li, Adaptive Output Feedback Control for the Trajectory Tracking of High-Speed Trains with Disturbance
Uncertainties on the Basis of Neural Network Observers, Journal of Advanced Transportation (2020), article 7527294,
doi 10.1155/2020/7527294.

Plant, observer and laws are those that the simulation runs (plant.py, laws.py); the Lyapunov functions are stated once
(lyapunov.py). Derivatives are written D(...) and derived along the closed loop (error_dynamics.py). What stands on the
right of `equal` and `at_most` is what the paper prints.

In the extracted text hats and tildes are mixed up, and (62) to (68) are missing; an accent is read as the surrounding
equations force. Where a derivative, a fraction or a letter is open, the numbered row decides what the text shows and its
`.glyph` row the other reading. What mends a line is a row of its own, `.mended`. The laws are definitions; rows `.runs`
decide that the loop that is simulated has them.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

from .letters import LETTERS
from .notation import NOTATION

paper = Paper("liu2020", " ".join((__doc__ or "").split("\n\n")[1].split()), NOTATION, LETTERS)

# What claims hold for.
EVERY_NETWORK = "every number of neurons and every hidden function (term by term under the sum)"

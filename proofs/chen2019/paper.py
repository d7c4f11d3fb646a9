"""chen2019: the rewriting of the model, every claim of section III, and the stated numbers of section IV.

Y. Chen, D. Huang, T. Huang, N. Qin, Tracking Control via Iterative Learning for High-Speed Trains With Distributed
Input Constraints, IEEE Access 7 (2019) 84591-84601, doi 10.1109/ACCESS.2019.2924435.

Plant, auxiliary system, law and learning rules are the expressions that are simulated (plant.py, laws.py);
derivatives are written D(...) and derived along the closed loop. What stands on the right of `equal` and `at_most`
is what the paper prints. Only (7) ties the acceleration to the force, so the force is what (7) says for an
acceleration that stands as a symbol: all of section III holds for every acceleration that solves the loop through
(16) and (22); whether one does is claims/section_3_algebraic_loop.py.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

from .letters import LETTERS
from .notation import NOTATION

paper = Paper("chen2019", " ".join((__doc__ or "").split("\n\n")[1].split()), NOTATION, LETTERS)

# What claims hold for.
EVERY_TRAIN = "every number of cars, every A and phi (car by car under the sum)"
EACH_CAR = "every car; norms and traces are sums over the cars"

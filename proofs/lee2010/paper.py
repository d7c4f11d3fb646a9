"""lee2010: geometric tracking control of a quadrotor, its attitude as a rotation matrix.

T. Lee, M. Leok, N. H. McClamroch, Geometric Tracking Control of a Quadrotor UAV on SE(3), 49th IEEE Conference on Decision and Control (2010) 5420-5425. Stated
as readers' summaries transcribe it: the text was not at hand.

The paper itself was not at hand. Its equations stand here as two readers' published summaries of it transcribe them, one
of which gives the numbers. They differ in the matrix of (1), where one has signs that its own sentence on the rotors'
torques excludes, and in the sign of b_3d in (12), where the law takes the one that the thrust along -R e_3 needs. The first proposition, the quadrotor's values, gains and the second example are
those of the fuller summary. The proofs, which the paper leaves to a report, are ours: rows with names instead of numbers
are steps of them, `printed` is then our own line, and nothing here charges the paper. Of the second and third
propositions, on position, the summaries lack the conditions on gains, so these are not stated.
Attitude errors are decided over unit quaternions (eta, eps), which reach every rotation matrix.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

paper = Paper("lee2010", " ".join((__doc__ or "").split("\n\n")[1].split()), at_hand=False)

EVERY_ATTITUDE = "all attitudes, desired attitudes, angular velocities, inertias about principal axes and gains"
EVERY_MATRIX = "every matrix in place of R_d^T R, so every attitude"

"""yang2021, section 5.2: what the bound of e_2 makes of the errors of position and speed, for which (53)-(57) have no sets."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most

from ..error_dynamics import e_1, e_2, flow
from ..laws import alpha
from ..lyapunov import l_, mu
from ..paper import paper
from .section_5_2_decay import delta

most_square = sp.Symbol("Q", nonnegative=True)
since, error_start, reach = sp.symbols("s e_1_s C_1", real=True)  # the time from the moment on that (53) names, and what counts from there
share = sp.exp(-alpha * since)


@paper.claim("theorem1.follow", "The position error follows e_2", "implication",
             r"e_2^2 \le Q\ \text{from } s = 0 \text{ on} \Rightarrow e_1^2(s) \le \tfrac{Q}{\alpha^2} + \left[e_1^2(0) - \tfrac{Q}{\alpha^2}\right]e^{-\alpha s}", "proved", origin="ours",
             note="From e_1' = -alpha e_1 + e_2, by (24) and (27). The time s counts from the moment on at which |e_2| is bounded so.")
def position_follows() -> Goal:
    """exp(alpha s)(e_1^2 - Q/alpha^2) does not increase."""
    limit = most_square / alpha**2
    return Goal((at_most(e_1**2, limit + (error_start**2 - limit) * share),), (at_least(since, 0),), {since: sp.Integer(1), e_1: flow[e_1]},
                (at_most(e_2**2, most_square),), {since: sp.Integer(0), e_1: error_start},
                decreasing=sp.exp(alpha * since) * (e_1**2 - limit), inputs=(e_2,))


near = l_ / mu + delta


@paper.claim("theorem1.speed", "The errors of position and speed come below bounds that alpha does not enlarge", "limit",
             r"\limsup|e_1| \le \tfrac{1}{\alpha}\sqrt{\tfrac{2l}{\mu}},\quad \limsup|x_2 - \dot{x}_d| = \limsup|e_2 - \alpha e_1| \le 2\sqrt{\tfrac{2l}{\mu}}", "proved",
             origin="ours", premises=("theorem1.follow", "53"),
             reading="From a time on, and for every delta > 0, alpha^2 e_1^2 is at most 2(l/mu + delta) + delta, and (x_2 - x_d')^2 at most four times that: the time C_1/(delta alpha) after the one "
                     "from which (53) bounds e_2, with C_1 at least alpha^2 e_1^2 then.",
             note="The paper gives sets for e_2 and the estimates alone. By (22) to (27) the error of the speed is e_2 - alpha e_1.")
def speed_comes_near() -> Goal:
    """theorem1.follow with the bound of (53)."""
    bound, = paper.shown("53")
    follows, = paper.shown("theorem1.follow")
    late_enough = (at_least(since, reach / (delta * alpha)), at_least(reach, alpha**2 * error_start**2), at_least(reach, 0), at_least(since, 0))
    return Goal((at_most(alpha**2 * e_1**2, 2 * near + delta), at_most((e_2 - alpha * e_1) ** 2, 4 * (2 * near + delta))),
                (bound, follows.subs({most_square: bound.right}), *late_enough),
                lemmas=(at_most(share * reach, delta), at_most(alpha**2 * error_start**2 * share, delta), at_least(alpha**2 * bound.right / alpha**2 * share, 0),
                        at_most(alpha**2 * e_1**2, 2 * near + delta)))

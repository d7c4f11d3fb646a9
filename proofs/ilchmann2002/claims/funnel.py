"""ilchmann2002: why the error cannot reach the funnel's wall."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater

from ..laws import desired, e, funnel, psi
from ..paper import EVERY_FUNNEL, paper
from ..plant import a, b, d, plant, u, y

# Any funnel and any rest, over the error's share of the funnel, eta = phi e: phi moves at the relative rate l, and
# h = phi f is what is not the input's, times phi.
eta, h, rate = sp.symbols("eta h l", real=True)
H, L, b_0, K, g = sp.symbols("H L b_0 K g", positive=True)
gain = 1 / (1 - eta**2)
inside = greater(1 - eta**2, 0)
near_the_wall = (at_least(eta**2, sp.Rational(1, 2)), at_most(h, H), at_least(h, -H))
moving = {eta: rate * eta + h - b * gain * eta}
OVER_ETA = "Over eta = phi e, with l = phi'/phi <= L and phi |f| <= H."


@paper.claim("loop", "The closed loop", "identity", r"\dot e = f - b k e,\ k = \frac{1}{1 - \varphi^2 e^2}", "proved",
             reading="f = a y - y^3 + d - y_d', what is not the input's.")
def loop() -> Goal:
    """From the simulated plant and any law's command: the error's rate is affine in the input."""
    flow = {y: plant.flow[y], desired.value: desired.rate}
    return Goal((equal(D(e), a * y - y**3 + d - desired.rate + b * u),), flow=flow, inputs=(desired.rate, d, u))


@paper.claim("gain", "The gain is at least one", "inequality", r"k = \frac{1}{1 - \varphi^2 e^2} \ge 1", "proved",
             scope=EVERY_FUNNEL, reading=OVER_ETA)
def gain_at_least_one() -> Goal:
    """Within the funnel."""
    return Goal((at_least(gain, 1),), (inside,))


@paper.claim("share", "How the error moves within its funnel", "identity",
             r"\frac{d}{dt} (\varphi e)^2 = 2 \varphi \dot\varphi e^2 + 2 \varphi^2 e (f - b k e)", "proved",
             scope=EVERY_FUNNEL, reading=OVER_ETA)
def share() -> Goal:
    """By the product rule along the loop."""
    return Goal((equal(D(eta**2), 2 * rate * eta**2 + 2 * eta * h - 2 * b * gain * eta**2),), (inside,), flow=moving,
                inputs=(rate, h))


@paper.claim("rest", "What the rest can do near the wall", "implication",
             r"(\varphi e)^2 \ge \tfrac12 \Rightarrow \varphi^2 e f \le 2 H (\varphi e)^2", "proved", origin="implied",
             scope=EVERY_FUNNEL, reading=OVER_ETA)
def rest() -> Goal:
    """Young's inequality."""
    return Goal((at_most(eta * h, 2 * H * eta**2),), near_the_wall)


@paper.claim("wall", "Near the wall the error turns back", "implication",
             r"(\varphi e)^2 \ge \tfrac12,\ k \ge \frac{L + 2 H}{b_0} \Rightarrow \frac{d}{dt} (\varphi e)^2 \le 0",
             "proved", scope=EVERY_FUNNEL, premises=("share", "rest"), severity="result",
             reading=OVER_ETA + " g stands for the gain k, and b >= b_0.")
def turned_back() -> Goal:
    """The gain grows without bound at the wall, so somewhere before it the error turns back."""
    return Goal((at_most(2 * rate * eta**2 + 2 * eta * h - 2 * b * g * eta**2, 0),),
                (*near_the_wall, *paper.shown("rest"), at_most(rate, L), at_least(b, b_0), at_least(b_0 * g, L + 2 * H)))


@paper.claim("margin", "How near the wall it comes", "implication",
             r"k \le K \Rightarrow 1 - (\varphi e)^2 \ge \frac{1}{K}", "proved", scope=EVERY_FUNNEL, premises=("wall",),
             reading=OVER_ETA + " K is the larger of the gain at the start and that of the wall.")
def margin() -> Goal:
    """The distance that the gain's bound leaves."""
    return Goal((at_least(K * (1 - eta**2), 1),), (inside, at_most(gain, K)))


@paper.claim("simulated", "The simulated funnel", "identity", r"\varphi = \frac{1}{\psi},\ u = -\frac{e}{1 - \varphi^2 e^2}",
             "proved", origin="ours", reading="Multiplied by the denominator, with psi as a positive number.")
def simulated() -> Goal:
    """The law as it is compiled."""
    wide = sp.Symbol("psi", positive=True)
    command = funnel.commands[u].subs(psi, wide)
    return Goal((equal(command * (wide**2 - e**2), -e * wide**2),), (greater(wide**2 - e**2, 0),))


paper.axiom("global", "The solution stays within the funnel for all times", r"\sup_{t \ge 0} \varphi(t) |e(t)| < 1",
            "maximal solutions leave every compact set; the row of the wall keeps them from the funnel's wall",
            hypotheses=("wall", "margin"), severity="result")

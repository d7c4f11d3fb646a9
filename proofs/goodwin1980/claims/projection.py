"""goodwin1980: what a step of the projection algorithm does to the error of the estimates."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal, less

from ..laws import gain, guard, moved
from ..paper import EVERY_STEP, paper
from ..plant import a, b, tank, u, y

theta = sp.Matrix(sp.symbols("theta_1 theta_2", real=True))
hat = sp.Matrix(sp.symbols("theta_1_hat theta_2_hat", real=True))
phi = sp.Matrix(sp.symbols("phi_1 phi_2", real=True))
size = (phi.T * phi)[0]
error = (phi.T * (theta - hat))[0]  # y(t) - phi^T theta_hat, the prediction error
after = sp.Matrix([moved(one, value, error, size) for one, value in zip(hat, phi, strict=True)])
before_square, after_square = ((theta - one).dot(theta - one) for one in (hat, after))
step = gain * (-2 + gain * size / (guard + size)) * error**2 / (guard + size)


@paper.claim("step", "What a step does to the parameter error", "identity",
             r"\|\tilde\theta(t)\|^2 - \|\tilde\theta(t-1)\|^2 = a \left(-2 + \frac{a \varphi^T \varphi}{c + \varphi^T \varphi}\right) "
             r"\frac{e(t)^2}{c + \varphi^T \varphi}", "proved", scope=EVERY_STEP)
def one_step() -> Goal:
    """The square completed."""
    return Goal((equal(after_square - before_square, step),))


@paper.claim("decrease", "The parameter error does not grow", "implication",
             r"0 < a < 2,\ c > 0 \Rightarrow \|\tilde\theta(t)\| \le \|\tilde\theta(t-1)\|", "proved", scope=EVERY_STEP,
             premises=("step",), severity="result")
def decrease() -> Goal:
    """Both factors of the step have the sign that is needed."""
    return Goal((at_most(step, 0),), (less(gain, 2),))


@paper.claim("posterior", "The prediction error after the step", "identity",
             r"y(t) - \varphi^T \hat\theta(t) = \left(1 - \frac{a \varphi^T \varphi}{c + \varphi^T \varphi}\right) e(t)", "proved",
             scope=EVERY_STEP)
def posterior() -> Goal:
    """By the new estimate."""
    return Goal((equal((phi.T * (theta - after))[0], (1 - gain * size / (guard + size)) * error),))


@paper.claim("summable", "The normalised error is bounded by what the parameter error loses", "implication",
             r"0 < a < 2 \Rightarrow a (2 - a) \frac{e(t)^2}{c + \varphi^T \varphi} \le \|\tilde\theta(t-1)\|^2 - \|\tilde\theta(t)\|^2",
             "proved", scope=EVERY_STEP, premises=("step",))
def summable() -> Goal:
    """Summed over all steps: the normalised errors have a finite sum of squares."""
    return Goal((at_most(gain * (2 - gain) * error**2 / (guard + size), -step),), (less(gain, 2),))


@paper.claim("two", "A step of a = 2 does not increase it either", "inequality",
             r"a = 2 \Rightarrow \|\tilde\theta(t)\| \le \|\tilde\theta(t-1)\|", "proved", origin="ours", scope=EVERY_STEP,
             premises=("step",), note="With c > 0 the bound a < 2 is not sharp for this row; it is for the sum of errors.")
def at_two() -> Goal:
    """The guard c leaves a margin."""
    return Goal((at_most(step.subs(gain, 2), 0),))


@paper.claim("beyond", "Larger steps may increase it", "inequality", r"a = 3 \Rightarrow \|\tilde\theta(t)\| \le \|\tilde\theta(t-1)\|",
             "refuted", origin="ours", scope=EVERY_STEP, premises=("step",),
             note="The paper claims nothing for this case.")
def beyond() -> Goal:
    """As a question."""
    return Goal((at_most(step.subs(gain, 3), 0),))


y_0, U = sp.symbols("y_0 U", real=True)  # the sample before and the command held from it on
decay = sp.Symbol("q", positive=True)  # exp(-a t)


@paper.claim("sampled", "The tank's samples obey the equation", "identity",
             r"y(t + T) = e^{-a T} y(t) + \frac{b}{a} (1 - e^{-a T}) u(t)", "proved", origin="implied",
             reading="The right side, as a function of T, has the tank's rate, and is y(t) at T = 0; q = exp(-a T).")
def sampled() -> Goal:
    """The solution of the tank's equation under a held command."""
    solution = decay * y_0 + b / a * (1 - decay) * U
    rate = tank.flow[y].xreplace({y: solution, u: U})
    return Goal((equal(D(solution), rate), equal(solution.subs(decay, 1), y_0)), flow={decay: -a * decay})


paper.axiom("convergence", "The output error vanishes", r"\lim_{t \to \infty} (y(t) - y^*(t)) = 0",
            "the key technical lemma: the regressor grows no faster than the error, for a minimum-phase plant",
            hypotheses=("decrease", "summable"), severity="result")

"""lavretsky2009: the error dynamics, the direct law, the filters and the composite law."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal, greater
from workbench.systems.lyapunov import closed_loop

from ..laws import (
    A_m,
    P,
    V,
    cmrac,
    command_of,
    e,
    e_pb,
    f,
    filtered,
    filters,
    gamma,
    gamma_c,
    hat,
    hats,
    lambda_f,
    m_1,
    m_2,
    measured,
    mrac,
    prediction_error,
    r,
    u_f,
    x_f,
)
from ..paper import EVERY_REGRESSOR, paper
from ..plant import Phi, d, thetas, wing, x_1, x_2

tilde = hat - sp.Matrix(thetas)
# Any regressor: its functions are symbols that may vary as they like.
ANY = sp.symbols("phi_1 phi_2 phi_3", real=True)
OF_ANY = dict(zip(Phi, ANY, strict=True))
REGRESSOR = sp.Matrix(ANY)
INPUTS = (*ANY, r.value)
length = (e.T * e)[0]


def loop(adaptation: sp.Matrix, filtering: bool = False, disturbance: sp.Expr = sp.S.Zero) -> dict[sp.Expr, sp.Expr]:
    """The rates of plant, reference model, estimates and filters, for any regressor."""
    law = cmrac if filtering else mrac
    command = command_of(REGRESSOR)
    model = (law.flow[m_1], law.flow[m_2])
    moving = {x_1: x_2, x_2: command + (sp.Matrix(thetas).T * REGRESSOR)[0] + disturbance, m_1: model[0], m_2: model[1],
              **dict(zip(hats, adaptation, strict=True))}
    rates = (filters[0], lambda_f * (command - u_f), *(lambda_f * (one - g) for one, g in zip(ANY, f, strict=True)))
    return moving | (dict(zip((x_f, u_f, *f), rates, strict=True)) if filtering else {})


DIRECT, COMPOSITE = gamma * e_pb * REGRESSOR, gamma * e_pb * REGRESSOR - gamma * gamma_c * prediction_error * filtered


@paper.claim("P", "P solves the Lyapunov equation", "identity", r"A_m^T P + P A_m = -I,\ P > 0", "proved",
             scope="every reference model of two states")
def lyapunov_equation() -> Goal:
    """Q is the identity; P by its minors."""
    rows = A_m.T * P + P * A_m + sp.eye(2)
    return Goal((*(equal(one, 0) for one in rows), greater(P[0, 0], 0), greater(P.det(), 0)))


@paper.claim("error", "The error dynamics", "identity", r"\dot e = A_m e - B \tilde\theta^T \Phi(x)", "proved",
             scope=EVERY_REGRESSOR)
def error_dynamics() -> Goal:
    """Plant minus reference model."""
    right = A_m * e - sp.Matrix([0, (tilde.T * REGRESSOR)[0]])
    return Goal(tuple(equal(D(one), other) for one, other in zip(e, right, strict=True)), flow=loop(DIRECT), inputs=INPUTS)


@paper.claim("simulated", "The simulated loops are among them", "identity", r"\Phi = (x_1, x_2, |x_1| x_2)^T", "proved",
             origin="ours")
def simulated() -> Goal:
    """The plant's and the laws' own expressions, as they are compiled."""
    put = {phi: one for one, phi in OF_ANY.items()}
    rows = []
    for law, of_any in ((mrac, loop(DIRECT)), (cmrac, loop(COMPOSITE, filtering=True))):
        stated = closed_loop(wing, law)
        rows += [equal(stated[symbol].xreplace({d: sp.S.Zero}), rate.xreplace(put)) for symbol, rate in of_any.items()]
    return Goal(tuple(rows))


@paper.claim("decrease", "Direct adaptation: V decreases by the tracking error", "identity",
             r"\dot V = -e^T Q e \le 0,\ \dot{\hat\theta} = \Gamma \Phi e^T P B", "proved", scope=EVERY_REGRESSOR,
             premises=("P", "error"), severity="result", reading="With Q = I.")
def decrease() -> Goal:
    """V = e^T P e + (theta_hat - theta)^T (theta_hat - theta) / gamma."""
    return Goal((equal(D(V), -length), at_most(-length, 0)), flow=loop(DIRECT), inputs=INPUTS)


@paper.claim("filters", "What the filters measure", "identity",
             r"Y = \theta^T \Phi_f,\ Y = \lambda_f (x_2 - x_{2f}) - u_f", "proved", scope=EVERY_REGRESSOR,
             reading="For filters that start in accord: what is off has the rate -lambda_f times itself, so zero stays zero.")
def filter_error() -> Goal:
    """What is off decays with the filters' rate, whatever moves."""
    off = measured - (sp.Matrix(thetas).T * filtered)[0]
    return Goal((equal(D(off), -lambda_f * off),), flow=loop(COMPOSITE, filtering=True), inputs=INPUTS)


@paper.claim("filters.start", "The same from any start of the filters", "identity", r"Y = \theta^T \Phi_f", "refuted",
             origin="ours", scope=EVERY_REGRESSOR, correction=filter_error,
             corrected_statement=r"\frac{d}{dt} (Y - \theta^T \Phi_f) = -\lambda_f (Y - \theta^T \Phi_f)",
             note="The paper claims nothing for this case. A plant that starts with x_2 not zero needs its filter started "
                  "there too.")
def any_start() -> Goal:
    """As a question."""
    return Goal((equal(measured, (sp.Matrix(thetas).T * filtered)[0]),))


eta = sp.Symbol("eta", real=True)  # what is off at the filters: Y - theta^T Phi_f
excitation = (tilde.T * filtered)[0]


def with_error(share: sp.Expr, tail: sp.Expr) -> Goal:
    """V's rate under the composite law with the filters off by eta."""
    rate = -length - 2 * gamma_c * excitation * (excitation - eta)
    return Goal((at_most(rate, -length - share * gamma_c * excitation**2 + tail),))


@paper.claim("composite", "Composite adaptation: V decreases by the prediction error too", "identity",
             r"\dot V = -e^T Q e - 2 \gamma_c \varepsilon_Y^2,\ \varepsilon_Y = \tilde\theta^T \Phi_f", "proved",
             scope=EVERY_REGRESSOR + ", filters in accord", premises=("P", "error", "filters"),
             severity="result", reading="With Q = I; where Y = theta^T Phi_f.")
def composite_decrease() -> Goal:
    """The prediction error is the one of the estimates, seen through the filtered regressor."""
    moving = loop(gamma * e_pb * REGRESSOR - gamma * gamma_c * excitation * filtered)
    return Goal((equal(D(V), -length - 2 * gamma_c * excitation**2), at_most(-length - 2 * gamma_c * excitation**2, 0)),
                flow=moving, inputs=(*INPUTS, *f))


@paper.claim("composite.off", "The same with the filters off", "inequality",
             r"\dot V \le -e^T Q e - \gamma_c \varepsilon^2 + \gamma_c \eta^2", "proved", origin="ours",
             scope=EVERY_REGRESSOR, premises=("composite", "filters"),
             reading="eta = Y - theta^T Phi_f, epsilon = the error of the estimates times Phi_f.",
             note="eta decays exponentially by the row of the filters, so the integral of V's rate stays bounded.")
def composite_off() -> Goal:
    """A square less than the sum of squares."""
    return with_error(sp.Integer(1), gamma_c * eta**2)


def drift() -> Goal:
    """V's rate with a disturbance."""
    return Goal((equal(D(V), -length + 2 * e_pb * d),), flow=loop(DIRECT, disturbance=d), inputs=(*INPUTS, d))


@paper.claim("disturbed", "Under a disturbance V may grow", "inequality", r"\dot V \le 0", "refuted", origin="ours",
             scope=EVERY_REGRESSOR, premises=("decrease",), correction=drift,
             corrected_statement=r"\dot V = -e^T Q e + 2 e^T P B d",
             note="The paper claims nothing for this case. Near e = 0 the disturbance's term is the larger one, and V has "
                  "no term that pulls the estimates back.")
def disturbed() -> Goal:
    """As a question."""
    return Goal((at_most(-length + 2 * e_pb * d, 0),))


paper.axiom("convergence", "The tracking error vanishes", r"\lim_{t \to \infty} e(t) = 0",
            "Barbalat's lemma, for a bounded reference", hypotheses=("decrease", "P"), severity="result")

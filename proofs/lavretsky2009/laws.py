"""lavretsky2009: the adaptive laws, direct and composite, with the reference model and the filters as their states."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import LawState
from workbench.systems.law import Reference, StateLaw
from workbench.systems.lyapunov import Lyapunov

from .plant import Phi, thetas, u, x_1, x_2

r = Reference("r")
a_1, a_2, gamma, gamma_c, lambda_f = sp.symbols("a_1 a_2 gamma gamma_c lambda_f", positive=True)
m_1, m_2 = sp.symbols("m_1 m_2", real=True)  # the reference model's state
hats = sp.symbols("theta_1_hat theta_2_hat theta_3_hat", real=True)
x_f, u_f = sp.symbols("x_f u_f", real=True)  # filtered x_2 and u
f = sp.symbols("f_1 f_2 f_3", real=True)  # the filtered regressor

e = sp.Matrix([x_1 - m_1, x_2 - m_2])
A_m = sp.Matrix([[0, 1], [-a_1, -a_2]])
# The solution of A_m^T P + P A_m = -I.
P = sp.Matrix([[(a_1 + a_1**2 + a_2**2) / (2 * a_1 * a_2), 1 / (2 * a_1)], [1 / (2 * a_1), (1 + a_1) / (2 * a_1 * a_2)]])
e_pb = (e.T * P)[1]
hat, filtered = sp.Matrix(hats), sp.Matrix(f)


def command_of(regressor: sp.Matrix) -> sp.Expr:
    """The command with the estimates' part over a regressor."""
    return a_1 * (r.value - x_1) - a_2 * x_2 - (hat.T * regressor)[0]


command = command_of(Phi)
model = (m_2, a_1 * (r.value - m_1) - a_2 * m_2)
direct = gamma * e_pb * Phi
# What the filters say of theta^T Phi, and how wrong the estimates are about it.
measured = lambda_f * (x_2 - x_f) - u_f
prediction_error = (hat.T * filtered)[0] - measured
composite = direct - gamma * gamma_c * prediction_error * filtered
filters = (lambda_f * (x_2 - x_f), lambda_f * (command - u_f), *(lambda_f * (one - g) for one, g in zip(Phi, f, strict=True)))


def law_states(adaptation: sp.Matrix) -> tuple[LawState, ...]:
    """Reference model and estimates."""
    return (*(LawState(one, rate=rate) for one, rate in zip((m_1, m_2), model, strict=True)),
            *(LawState(one, rate=rate) for one, rate in zip(hats, adaptation, strict=True)))


mrac = StateLaw("lavretsky2009.mrac", title="model reference adaptive control", information="full state, coefficients unknown",
                source="the direct adaptation", references=(r,), commands={u: command}, states=law_states(direct),
                parameters=(a_1, a_2, gamma))

cmrac = StateLaw("lavretsky2009.cmrac", title="composite model reference adaptive control",
                 information="full state, coefficients unknown", source="the adaptation with the prediction error",
                 references=(r,), commands={u: command}, parameters=(a_1, a_2, gamma, gamma_c, lambda_f),
                 states=(*law_states(composite),
                         *(LawState(one, rate=rate) for one, rate in zip((x_f, u_f, *f), filters, strict=True))))

linear = StateLaw("lavretsky2009.linear", title="the same without adaptation", information="full state, coefficients unknown",
                  source="the law with its estimates at zero", references=(r,), parameters=(a_1, a_2),
                  commands={u: command.xreplace(dict.fromkeys(hats, sp.Integer(0)))})

V = sp.expand((e.T * P * e)[0]) + sum(((one - true) ** 2 for one, true in zip(hats, thetas, strict=True)), sp.Integer(0)) / gamma
lyapunov = Lyapunov("V", V, mrac)
lyapunov_composite = Lyapunov("V_composite", V, cmrac)

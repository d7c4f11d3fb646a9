"""slotine1987: the adaptive law and the function V of its proof, typed once."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import LawState
from workbench.systems.law import Reference, StateLaw
from workbench.systems.lyapunov import Lyapunov

from .plant import A, C, H, q_1, q_2, tau_1, tau_2, w

desired = (Reference("q_1d"), Reference("q_2d"))
lambda_1, lambda_2, k_1, k_2 = sp.symbols("lambda_1 lambda_2 k_1 k_2", positive=True)
gammas = sp.symbols("gamma_1:5", positive=True)
hats = sp.symbols("a_1_hat a_2_hat a_3_hat a_4_hat", real=True)

errors = sp.Matrix([q - d.value for q, d in zip((q_1, q_2), desired, strict=True)])
error_rates = w - sp.Matrix([d.rate for d in desired])
Lambda, K_D = sp.diag(lambda_1, lambda_2), sp.diag(k_1, k_2)
s = error_rates + Lambda * errors
reference_rates = w - s  # q_r' = q_d' - Lambda (q - q_d)
reference_accelerations = sp.Matrix([d.second_rate for d in desired]) - Lambda * error_rates


def regressor(rates: sp.Matrix, accelerations: sp.Matrix) -> sp.Matrix:
    """Y with Y a = H accelerations + C rates, which is linear in the parameters: the row `linear`."""
    return (H * accelerations + C * rates).jacobian(list(A))


Y = regressor(reference_rates, reference_accelerations)
torques = Y * sp.Matrix(hats) - K_D * s
adaptation = -sp.diag(*gammas) * Y.T * s

adaptive = StateLaw(
    "slotine1987.adaptive", title="adaptive law of Slotine and Li", information="angles and rates, arm unknown",
    source="the law and adaptation of Slotine and Li 1987", references=desired,
    commands={tau_1: torques[0], tau_2: torques[1]},
    states=tuple(LawState(hat, rate=rate) for hat, rate in zip(hats, adaptation, strict=True)),
    parameters=(lambda_1, lambda_2, k_1, k_2, *gammas))

pd = StateLaw(
    "slotine1987.pd", title="the same without adaptation", information="angles and rates, arm unknown",
    source="the law with its estimates at zero", references=desired,
    commands={tau_1: -k_1 * s[0], tau_2: -k_2 * s[1]}, parameters=(lambda_1, lambda_2, k_1, k_2))

V = (s.T * H * s)[0] / 2 + sum(((hat - a) ** 2 / (2 * gamma) for hat, a, gamma in zip(hats, A, gammas, strict=True)), sp.Integer(0))
lyapunov = Lyapunov("V", V, adaptive)

"""RBFNN-PID: an incremental PID whose gains follow the Jacobian of a radial-basis model of the plant.

yang2021 takes it from its reference [30], which is not reproduced in the paper; this is the textbook form,
whose network is updated by the gradient laws with momentum that yang2021 prints as (10)-(15).
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

from workbench.model.law import ControlLaw, LawState, desired_position, neuron, over_neurons, period, position

from .network import hidden_output, weight_step, width_step, with_momentum

eta, momentum = sp.symbols("eta varpi", positive=True)
eta_gain = sp.Symbol("eta_K", nonnegative=True)
K_p, K_i, K_d = sp.symbols("K_p K_i K_d", real=True)
u_prev, e_prev, e_prev2 = sp.symbols("u_prev e_prev e_prev2", real=True)

INPUTS = 3


def _per_neuron(name: str) -> sp.Indexed:
    return sp.IndexedBase(name, real=True)[neuron]


w, w_before = _per_neuron("w"), _per_neuron("w_before")
b = sp.IndexedBase("b_h", positive=True)[neuron]
b_before = _per_neuron("b_before")
c = tuple(_per_neuron(f"c_{i}") for i in range(1, INPUTS + 1))
c_before = tuple(_per_neuron(f"c_before_{i}") for i in range(1, INPUTS + 1))


def incremental_pid(law_id: str, title: str, source: str, center_step: Callable[..., sp.Expr]) -> ControlLaw:
    """The law with (14) as given: `center_step` or `center_step_as_printed` of the network."""
    error = desired_position - position
    inputs = (u_prev, error, e_prev)
    h = hidden_output(inputs, c, b)
    model_error = error - over_neurons(w * h)
    sensitivity = over_neurons(w * h * (c[0] - u_prev) / b**2)  # d(model output)/d(command)
    squared_distance = sum(((x - ci) ** 2 for x, ci in zip(inputs, c, strict=True)), sp.Integer(0))

    proportional, integral = error - e_prev, error * period
    derivative = (error - 2 * e_prev + e_prev2) / period
    gains = tuple(
        # Gradient of error^2/2 through the model's sensitivity; the model's output is the error itself,
        # so descent has the sign of -sensitivity.
        (gain, gain - eta_gain * error * sensitivity * signal)
        for gain, signal in ((K_p, proportional), (K_i, integral), (K_d, derivative))
    )
    command_next = u_prev + sum(
        (new * signal for (_, new), signal in zip(gains, (proportional, integral, derivative), strict=True)),
        sp.Integer(0),
    )
    neurons = (
        LawState(w, update=with_momentum(w, weight_step(eta, model_error, h), momentum, w_before)),
        LawState(w_before, update=w),
        LawState(b, update=with_momentum(
            b, width_step(eta, model_error, w, h, squared_distance, b), momentum, b_before)),
        LawState(b_before, update=b),
        *(LawState(ci, update=with_momentum(ci, center_step(eta, model_error, w, h, x, ci, b), momentum, before))
          for ci, before, x in zip(c, c_before, inputs, strict=True)),
        *(LawState(before, update=ci) for ci, before in zip(c, c_before, strict=True)),
    )
    return ControlLaw(
        id=law_id, title=title, source=source, information="full state, model unknown", command=u_prev,
        states=(*(LawState(gain, update=new) for gain, new in gains), LawState(u_prev, update=command_next),
                LawState(e_prev, update=error), LawState(e_prev2, update=e_prev), *neurons),
        parameters=(eta, momentum, eta_gain),
    )

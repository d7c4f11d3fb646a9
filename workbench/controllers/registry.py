"""All controllers by id: laws that are compiled whole, and controllers that are called once a sample."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import sympy as sp

from workbench.controllers import mao2018_laws
from workbench.controllers.base import ControlLaw
from workbench.controllers.mpc import TrackingMpc
from workbench.controllers.pid import pid
from workbench.controllers.rbf_pid import rbf_pid, rbf_pid_printed
from workbench.controllers.yang2021 import pocrac, rbfnn_pocrac
from workbench.mpc.controller import KINDS
from workbench.scenario import ControllerSpec, Scenario

LAWS: dict[str, ControlLaw] = {law.id: law for law in (
    rbfnn_pocrac, pocrac, pid, rbf_pid, rbf_pid_printed, *mao2018_laws.LAWS)}

_held = sp.Symbol("u_held", real=True)
held_command = ControlLaw(
    id="held", title="held command", source="zero-order hold", information="full state, nominal model",
    command=_held, parameters=(_held,),
)


class SampledController(Protocol):
    """A controller that is called once a sample; it counts its troubles in `counters` and never raises."""

    title: str
    information: str
    counters: dict[str, int]

    def command(self, time_s: float, position_m: float, speed_mps: float) -> float:
        """The command u = F/m in m/s^2 for the sample at time_s."""
        ...


SAMPLED: dict[str, Callable[[Scenario, ControllerSpec, str], SampledController]] = {
    "mpc.tracking": TrackingMpc,
    **KINDS,
}

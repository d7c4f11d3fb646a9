"""The search of gains for a folder's plant: a state feedback at a point of rest, proved, then run on the plant."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from math import exp, isfinite, sqrt
from typing import Any

import numpy as np
import sympy as sp

from workbench.errors import InputError
from workbench.files.numbers import number
from workbench.gains.enclosure import stated_number
from workbench.gains.exact import fraction
from workbench.gains.feedback import decaying
from workbench.gains.frequency import feedback_margins
from workbench.gains.linearised import LinearPlants, linearised, output_matrix
from workbench.gains.output_feedback import output_decaying
from workbench.gains.point import at_point
from workbench.gains.result import GainReport, GainSet, Quantity
from workbench.gains.stated import Stated
from workbench.paper.gain_search import GainSearch, Row, Task
from workbench.paper.loading import Loaded
from workbench.simulate.plants.run import Entrant
from workbench.simulate.plants.run import run as run_plant
from workbench.systems.law import StateLaw
from workbench.systems.plant import Plant
from workbench.systems.setting import Setting

SAMPLES, LENGTHS = 2000, 5  # of a run; how many of the proved time constants it takes


def feedback_search(paper: str, plant: Plant, rate: str, radius: Mapping[str, str],
                    at: Mapping[str, Any] | None = None) -> GainSearch:
    """The least feedback that is proved to decay by `rate` (1/s) from all states within `radius` of a point of rest.

    Where a plant does not measure all its states, an output feedback is sought by iteration, whose commands are not
    the least. rate and radius: decimals as text, a radius for each state; at: the point, by `at_point`, zero where
    none is given. Proved for every linearisation that the parameters' known intervals allow; the runs are
    of the plant itself, from the border of these radii, with all uncertain parameters at their least, then at their
    largest. The search raises InputError for what it cannot take.
    """
    name = f"{paper}:feedback"

    def report(stated: Stated) -> GainReport:
        point = at_point(plant, at)
        decay, radii = positive(plant, "rate", rate), _radii(plant, radius)
        plants = linearised(plant, point)
        room = _room(plant, point)
        if not measures_all(plant):
            return _of_outputs(paper, name, plant, point, plants, decay, radii)
        found = decaying(name, plants, decay, radii, room)
        bounds = ", ".join(f"{u} within {found.bound * float(room.get(u, 1)):.3g}" for u in plants.inputs)
        values = {f"K_{u}_{x}": fraction(found.K[i, j]) for i, u in enumerate(plants.inputs)
                  for j, x in enumerate(plants.states)}
        beyond = [u for u in room if found.bound > 1]
        return GainReport(
            paper, (), (Quantity("decay rate of the feedback", "1/s", None, float(decay), name,
                                 note=f"for {len(plants.extremes)} extreme plants; from the stated radii {bounds} of "
                                      "that at rest"),),
            (GainSet("feedback", "least command among those that decay so fast", values,
                     f"decay {float(decay):.3g} 1/s for every linear plant", name),), (found.found.certificate,),
            ("What is proved is of the plant linearised at the point, without limits; the runs are of the plant "
             "itself.", *margin_sentences(plants, found.K),
             *(f"The limits of {u} are less than its bound: where it saturates, nothing is proved." for u in beyond)),
            {name: found.found.seconds})

    def tasks(found: GainReport) -> list[Task]:
        box = {str(one.symbol): one.known for one in plant.parameters if one.known}
        ends = [{key: pair[side] for key, pair in box.items()} for side in (0, 1)] if box else [{}]
        values = {"K": {key: float(k) for key, k in found.found[0].values.items()}, "P": _function(found)}
        return [Task("feedback", ", ".join(f"{key} = {value:g}" for key, value in end.items()) or "as stated",
                     values={**values, "parameters": end}) for end in ends]

    def run(loaded: Loaded, task: Task) -> tuple[Row, str | None]:
        duration, radii, point = LENGTHS / float(Fraction(rate)), _radii(plant, radius), at_point(plant, at)
        K = {key: sp.Symbol(key, real=True) for key in task.values["K"]}
        fed = {y: y - _output_at(plant, point, y) for y in (plant.states if measures_all(plant) else plant.outputs)}
        law = StateLaw(name, {u: _at(point, u) + sum((K[f"K_{u}_{y}"] * off for y, off in fed.items()), sp.Integer(0))
                              for u in plant.inputs}, parameters=[*K.values()])
        start = {str(x): float(_at(point, x)) + float(radii[str(x)]) / sqrt(len(radii)) for x in plant.states}
        step = duration / SAMPLES
        done = run_plant(Setting(plant, duration, step, initial=start, parameters=task.values["parameters"]),
                         Entrant("feedback", step, law, task.values["K"]))
        off = np.array([done.column(str(x))[[0, -1]] - float(_at(point, x)) for x in plant.states])
        first, last = np.diag(off.T @ np.linalg.solve(np.array(task.values["P"]), off))
        largest = {f"{u}_largest": float(abs(done.column(str(u))).max()) for u in plant.inputs}
        return {"root_of_V_left": sqrt(last / first), "root_of_V_left_proved": exp(-LENGTHS), **largest}, done.failed

    return GainSearch(report, tasks, run)


def _function(found: GainReport) -> list[list[float]]:
    """P of V = x^T P^-1 x, as it stands in the certificate."""
    values = found.certificates[0]["values"]
    n = max(int(name.split("_")[1]) for name in values if name.startswith("P_"))
    return [[float(Fraction(values[f"P_{min(i, j)}_{max(i, j)}"])) for j in range(1, n + 1)] for i in range(1, n + 1)]


def _at(point: Mapping[str, sp.Expr], symbol: sp.Symbol) -> sp.Expr:
    return point.get(str(symbol), sp.Integer(0))


def _room(plant: Plant, point: Mapping[str, Any]) -> dict[str, Fraction]:
    """How far each limited input may move to both sides of where it is at rest."""
    found = {}
    for u, (low, high) in plant.input_limits.items():
        rest = float(_at(point, u))
        if not low < rest < high:
            raise InputError(plant.id, str(u), f"= {rest:g} is at or beyond its limits: give a point within them")
        if isfinite(room := min(rest - low, high - rest)):
            found[str(u)] = stated_number(room)
    return found


def positive(plant: Plant, key: str, written: str) -> Fraction:
    """A positive number written as a decimal; InputError naming plant and key."""
    try:
        value = Fraction(written)
    except (TypeError, ValueError, ZeroDivisionError):
        raise InputError(plant.id, key, f"{written!r} is no decimal as text: write one such as '0.5'") from None
    if value <= 0:
        raise InputError(plant.id, key, f"{written} is not positive: give a positive number")
    return value


def _radii(plant: Plant, radius: Mapping[str, str]) -> dict[str, Fraction]:
    names = [str(state) for state in plant.states]
    for name in {*names} ^ {*radius}:
        raise InputError(plant.id, f"radius.{name}", "is missing: give one for each state" if name in names else
                         f"is no state: name {', '.join(names)}")
    return {name: positive(plant, f"radius.{name}", radius[name]) for name in names}


def measures_all(plant: Plant) -> bool:
    """Whether every state is among the outputs."""
    return all(plant.outputs.get(state) == state for state in plant.states)


def _of_outputs(paper: str, name: str, plant: Plant, point: Mapping[str, Any], plants: LinearPlants, decay: Fraction,
                radii: Mapping[str, Fraction]) -> GainReport:
    """What is told of an output feedback."""
    C = output_matrix(plant, point)
    found = output_decaying(name, plants, C, decay, radii)
    values = {f"K_{u}_{y}": fraction(found.F[i, j]) for i, u in enumerate(plants.inputs)
              for j, y in enumerate(plant.outputs)}
    return GainReport(
        paper, (), (Quantity("decay rate of the output feedback", "1/s", None, float(decay), name,
                             note=f"for {len(plants.extremes)} extreme plants, found after {found.turns} turns of the "
                                  "iteration"),),
        (GainSet("feedback", "an output feedback that decays so fast, not that of least commands", values,
                 f"decay {float(decay):.3g} 1/s for every linear plant", name),), (found.found.certificate,),
        ("What is proved is of the plant linearised at the point, without limits; the runs are of the plant itself.",
         *margin_sentences(plants, found.F * C)), {name: found.found.seconds})


def margin_sentences(plants: LinearPlants, K: sp.Matrix) -> list[str]:
    """A sentence an input: the least margins among the extreme plants."""
    A_B = [[np.array(part.tolist(), dtype=float) for part in pair] for pair in plants.extremes]
    each = [feedback_margins(A, B, np.array(K.tolist(), dtype=float)) for A, B in A_B]
    told = []
    for k, u in enumerate(plants.inputs):
        own = [one[k] for one in each]
        least, most = max(one.least for one in own), min(one.most for one in own)
        phase, delay = min(one.phase_deg for one in own), min(one.delay_s for one in own)
        of = "the plant" if len(own) == 1 else f"{len(own)} extreme plants"
        if isfinite(most):
            gain = f"{number(least)} to {number(most)} times its gain"
        else:
            gain = f"{number(least)} times its gain or more" if least > 0 else "any gain"
        late = f", {number(phase)} degrees of phase and a delay of {number(delay)} s" if isfinite(delay) else (
            " and any delay")
        told.append(f"Opened at {u} the linear loop of {of} stands {gain}{late} (python-control; not proved).")
    return told


def _output_at(plant: Plant, point: Mapping[str, Any], output: sp.Symbol) -> sp.Expr:
    known = {state: _at(point, state) for state in plant.states}
    return plant.outputs[output].xreplace({**known, **{one.symbol: sp.Float(one.value) for one in plant.parameters}})

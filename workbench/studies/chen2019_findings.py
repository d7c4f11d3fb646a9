"""What a reader of chen2019's study should know, every number from its runs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.report.numbers import fixed, number
from workbench.simulate.cars_trials import CarsRun
from workbench.studies.chen2019_found import (
    Found,
    allowed_change,
    alternating_growth,
    cef_change,
    difference,
    exponent,
    needed_force,
    outcome,
    position_error,
    rises,
    speed_error,
    trailer_force,
)


def all_findings(found: Found) -> Iterator[str]:
    """A sentence or a few each; one whose runs the study does not have is left out."""
    yield from _learning(found)
    yield from _sampling(found)
    yield from _acceleration(found)
    yield from _gains(found)
    yield from _masses(found)
    yield from _trailers(found)
    yield from _energy(found)
    yield from _place(found)
    yield from _assumed(found)
    yield _speed(found)


def _ends(run: CarsRun) -> str:
    """Largest errors in the first and the last finished trial."""
    p, v = position_error(run), speed_error(run)
    return (f"{number(float(p[0]))} m → {number(float(p[-1]))} m and {number(float(v[0]))} m/s → "
            f"{number(float(v[-1]))} m/s")


def _learning(found: Found) -> Iterator[str]:
    run, last = found.stated, found.study.trials.count
    if run.failed is not None:
        yield f"The stated run ends early: {run.failed}."
    if not len(run.totals):
        return
    d = difference(run)
    up = rises(position_error(run)) + rises(speed_error(run))
    yield (f"Learning works{'' if run.failed is None else ' until then'}: over {len(run.totals)} of {last} iterations "
           f"the largest errors of all cars go {_ends(run)}, "
           f"{'in every single step' if up == 0 else f'rising in {up} steps'}; |Δu| goes "
           f"{number(d[0] / 1e3)} → {number(d[-1] / 1e3)} kN. That is what the paper says of its Figures 1-9; it "
           f"prints "
           "no numbers.")


def _sampling(found: Found) -> Iterator[str]:
    same = found.find(sampling__memory="same_sample")
    finer = found.find(sampling__memory="same_sample", sampling__period_s=found.study.sampling.period_s / 2)
    if same is None or finer is None or found.stated.failed or finer.failed:
        return
    fast, answered = alternating_growth(found.study, found.study.reference.cruise_mps)
    reached = min(len(found.stated.totals), len(same.totals))
    apart = abs(position_error(found.stated)[-1] / position_error(finer)[-1] - 1)
    yield (f"The learning rules are for continuous time. With the errors of the same sample, every "
           f"{1e3 * found.study.sampling.period_s:g} ms, the run {_did(same)}: |Δu| reaches "
           f"{number(float(difference(same)[reached - 1] / 1e3))} kN in trial {reached} (as stated "
           f"{number(float(difference(found.stated)[reached - 1] / 1e3))} kN). While the first car is at its limit, an "
           f"error that alternates from sample to sample can grow by up to {number(fast)} per trial at "
           f"{found.study.reference.cruise_mps:g} m/s (γ_a v⁴ in (18) is what feeds it), with the errors of the next "
           f"sample by {number(answered)}. Sampled twice as fast, the rules with the errors of the same sample learn "
           f"like the stated run: their last position error differs by {number(100 * apart, 2)} %.")


def _did(run: CarsRun) -> str:
    if run.failed is not None:
        return f"ends in trial {len(run.totals) + 1} ({outcome(run).partition(': ')[2]})"
    return outcome(run)


def _acceleration(found: Found) -> Iterator[str]:
    words = []
    for values, name in (({"sampling__acceleration": "sampled"}, "that of the sample before"),
                         ({"sampling__acceleration": "filtered", "sampling__filter_s": 0.01}, "filtered with 0.01 s"),
                         ({"sampling__acceleration": "filtered"}, f"filtered with "
                                                                  f"{found.study.sampling.filter_s:g} s")):
        run = found.find(**values)
        if run is not None and len(run.totals):
            words.append(f"{name}: {_ends(run)} ({outcome(run)})")
    if words:
        yield "Rules for the acceleration in (16), errors as stated otherwise. " + "; ".join(words) + "."


def _gains(found: Found) -> Iterator[str]:
    exact = found.find(gains__c_1=1.0)
    sampled = found.find(gains__c_1=1.0, sampling__acceleration="sampled")
    if exact is not None and sampled is not None and len(sampled.totals) and len(found.stated.totals):
        yield (f"The stated c_1 = {found.study.gains.c_1:g} breaks the paper's own condition c_λ > 0 (claim 49.stated) "
               f"and is why the errors begin at {number(float(position_error(found.stated)[0]))} m: with c_1 = 1 "
               f"and the "
               f"acceleration of the sample before they go {_ends(sampled)}. With the solution of the loop that run "
               f"{_did(exact)}.")
    for values, name in (({"gains__c_3": 0.01}, "c_3 = 1/100"),):
        run = found.find(**values)
        if run is not None and len(run.totals):
            yield (f"{name}, which makes the loop unique up to 100 kg above the mass (claim 16.stated): "
                   f"{_ends(run)}; it "
                   "begins better, since the feedback 1/c_3 is stronger, and learns more slowly, since every learning "
                   "gain is multiplied by c_3.")


def _masses(found: Found) -> Iterator[str]:
    ended = [(change.title, run) for change, run in found.group("masses") if run.failed is not None]
    if ended:
        words = "; ".join(f"{name}: {outcome(run)}" for name, run in ended)
        yield (f"The bounds of the mass, which the paper does not state, decide whether the loop through the "
               f"acceleration can be solved at all (claims 16.unique, 16.stated). {words}.")


def _trailers(found: Found) -> Iterator[str]:
    study, run = found.study, found.stated
    ref = study.reference
    motors, trailers = found.limits_of_cars
    need = needed_force(study, ref.cruise_mps, ref.acceleration_mps2)
    text = (f"The assumed reference asks for {number(need / 1e3)} of "
            f"{number(len(motors) * study.train.traction_n / 1e3)} "
            f"kN at {ref.cruise_mps:g} m/s, so the train as a whole can follow it")
    if not trailers:
        yield f"{text}."
        return
    alone = trailer_force(study, ref.cruise_mps, 0.0)
    text += (f"; no trailer can by itself, which needs {number(alone)} N forwards even at cruise (claim A2). The "
             "couplers give it")
    if len(run.totals):
        text += (f", stretched by up to {number(1e3 * float(run.total('coupler_stretch_m')[-1]))} mm in the last "
                 f"trial; "
                 f"what is left of |Δu| then, {number(float(difference(run)[-1] / 1e3))} kN, and of the speed error "
                 "stands where the reference changes its acceleration")
    yield f"{text}."


def _energy(found: Found) -> Iterator[str]:
    run = found.stated
    if not len(run.totals):
        return
    change, allowed = cef_change(run), allowed_change(found.study, run)
    kept = int(np.sum(change <= allowed))
    text = (f"The energy function (25) of the stated run falls by at least what (35) promises in {kept} of "
            f"{len(change)} trials")
    same = found.find(sampling__memory="same_sample", sampling__acceleration="sampled")
    if same is not None and len(same.totals):
        lost = np.flatnonzero(cef_change(same) > allowed_change(found.study, same))
        text += ("; with the errors of the same sample and the acceleration of the sample before, "
                 + (f"not from trial {lost[0] + 1} on" if len(lost) else "too"))
    yield f"{text}."


def _place(found: Found) -> Iterator[str]:
    time, place = (found.find(line__seen_by=by) for by in ("reference", "train"))
    if time is not None and place is not None and time.failed is None and place.failed is None:
        yield (f"Slopes act where the train is, while (31) takes them for a function of time alone (claim "
               f"31.place). With "
               f"{found.study.line.slope_permille:g} ‰ as a function of time: {_ends(time)}; where the car is: "
               f"{_ends(place)}. The law learns all the same, since the places of two trials at the same time come "
               "together.")


def _assumed(found: Found) -> Iterator[str]:
    runs = [run for _, run in found.group("assumed") if run.failed is None]
    early = [(change.title, run) for change, run in found.group("assumed") if run.failed is not None]
    if not runs:
        return
    firsts = [float(position_error(run)[0]) for run in runs]
    lasts = [float(position_error(run)[-1]) for run in runs]
    speeds = [float(speed_error(run)[-1]) for run in runs]
    text = (f"Other assumed references, slopes, coefficients and initial auxiliary states leave largest position "
            f"errors "
            f"of {number(min(firsts))} to {number(max(firsts))} m in the first trial and {number(min(lasts))} to "
            f"{number(max(lasts))} m in the last, speed errors of {number(min(speeds))} to {number(max(speeds))} "
            f"m/s in "
            "the last")
    if early:
        text += "; " + "; ".join(f"{name}: {outcome(run)}" for name, run in early)
    yield f"{text}."


def _speed(found: Found) -> str:
    run, study = found.stated, found.study
    step = float(np.median(run.step_us))
    return (f"A million samples of {study.train.cars} cars take {number(step)} s in the stated run, train and law "
            f"together; its learned estimates, one set per sample, take {number(run.memory_bytes / 1e6)} MB. From "
            f"{min(p.cars for p in found.cost)} to {max(p.cars for p in found.cost)} cars the time grows as the number "
            f"of cars to the power {fixed(exponent(found.cost), 2)}.")

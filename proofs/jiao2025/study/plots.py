"""The figures of jiao2025, and the transients along the trials."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.files.numbers import number
from workbench.paper.results import Curve, Plot

from ..laws import TRIAL_LAWS
from ..simulation.trials import Array, TrialRun
from .cases import PRINTED_LAWS, Case, Reading, desired_trip, lengths, plan
from .outcomes import Found, mse, outcome

FIGURE_OF = {"jiao2025.icfdl": "paper, Figure 5", "jiao2025.pd": "paper, Figure 6"}


def all_plots(found: Found) -> tuple[Plot, ...]:
    """All figures, the paper's first and in its order."""
    return (desired(found), drawn_lengths(found), additional(found), *speeds(found), errors(found),
            *transients(found), *estimates(found), units(found), *of_seeds(found))


def _samples(reading: Reading, count: int) -> Array:
    """The k of (16) for every sample of a trial."""
    return np.linspace(0.0, (count - 1) * reading.k_per_sample, count)


def _curve(run: TrialRun, column: str, label: str) -> Curve:
    values = run.column(column)
    return Curve(label, np.arange(len(values), dtype=float), values)


def desired(found: Found) -> Plot:
    """The desired speed (16)."""
    reading = next(iter(found.study.readings.values()))
    speed, _ = desired_trip(found.study, reading)
    return Plot("Desired speed", "paper, Figure 2", "k", "speed (m/s)",
                (Curve("v_d", _samples(reading, len(speed)), speed),), "(16); it is the same in every reading.")


def drawn_lengths(found: Found) -> Plot:
    """The lengths T_i of the trials."""
    trials = found.study.trials
    drawn = lengths(trials, trials.seed).astype(float)
    return Plot("Lengths of the trials", "paper, Figure 3", "trial i", "T_i (k)",
                (Curve("T_i", np.arange(len(drawn), dtype=float), drawn),),
                f"Drawn from {trials.shortest_length_k + 1} to {trials.desired_length_k}, seed {trials.seed}; "
                f"k = {trials.desired_length_k} is reached in {int(np.sum(drawn == trials.desired_length_k))} of "
                f"{len(drawn)} trials.")


def additional(found: Found) -> Plot:
    """f_a over M, in the desired trip and in the trials that the paper shows."""
    study, entry = found.study, found.study.shown[0]
    reading, case = study.readings[entry.reading], Case(entry.reading, entry.law, study.trials.seed)
    made, run = plan(study, case), found.runs[case]
    place = np.searchsorted(made.edges[1:-1], made.desired_positions, side="right")
    curves = [Curve("desired trip", _samples(reading, len(place)), made.additional_n[place] / made.mass_kg)]
    for trial in study.trials.line_shown:
        if trial in run.samples:
            force = run.sample(trial, "additional_n")[:-1] / made.mass_kg
            curves.append(Curve(f"trial {trial}", _samples(reading, len(force)), force))
    return Plot("Additional resistance per unit of mass", "paper, Figure 4", "k", "f_a / M (m/s²)", tuple(curves),
                f"The profile is assumed. Of {found.title(entry.reading, entry.law)}.")


def speeds(found: Found) -> list[Plot]:
    """Speeds in the trials that the paper compares."""
    plots = []
    for entry in found.study.shown:
        reading, run = found.study.readings[entry.reading], found.run(entry.reading, entry.law)
        wanted, _ = desired_trip(found.study, reading)
        curves = [Curve("desired", _samples(reading, len(wanted)), wanted)]
        for trial in found.study.trials.compared:
            if trial in run.samples:
                speed = run.sample(trial, "speed")
                curves.append(Curve(f"trial {trial}", _samples(reading, len(speed)), speed))
        plots.append(Plot(
            f"Speed: {found.title(entry.reading, entry.law)}", FIGURE_OF.get(entry.law, "not in the paper"), "k",
            "speed (m/s)", tuple(curves), f"Reading: {reading.title}; it {outcome(run)}."))
    return plots


def errors(found: Found) -> Plot:
    """MSE against the trial for the runs that are shown."""
    curves = tuple(_curve(found.run(entry.reading, entry.law), "mse", found.title(entry.reading, entry.law))
                   for entry in found.study.shown)
    return Plot("Mean squared error of the speed", "paper, Figure 7", "trial i", "MSE (m²/s²)", curves,
                "k in samples of 0.1 s; what diverges in trial 1 is left out.", log_y=True)


def transients(found: Found) -> list[Plot]:
    """MSE and largest error in every reading, on a logarithmic axis."""
    plots = []
    for law in (*PRINTED_LAWS, "jiao2025.fixed_estimate"):
        for column, label in (("mse", "MSE (m²/s²)"), ("largest_error", "largest |e| (m/s)")):
            runs = {name: found.run(name, law) for name in found.study.readings}
            curves = tuple(_curve(run, column, f"{found.study.readings[name].label}: {outcome(run)}")
                           for name, run in runs.items())
            plots.append(Plot(
                f"{'MSE' if column == 'mse' else 'Largest error'} along the trials: {TRIAL_LAWS[law].title}",
                "not in the paper: every reading", "trial i", label, curves,
                "Whether the error grows before it falls: claims intro.* and theorem1.*. A run ends where it diverges.",
                log_y=True))
    return plots


def estimates(found: Found) -> list[Plot]:
    """What (15) with (13) estimates, beside dv(k+1)/du(k)."""
    plots = []
    for entry in found.study.shown:
        reading, run = found.study.readings[entry.reading], found.run(entry.reading, entry.law)
        trial = found.study.trials.compared[-1]
        if entry.law not in ("jiao2025.icfdl", "jiao2025.cfdl") or trial not in run.samples:
            continue
        estimate = run.sample(trial, "estimate")[:-1]
        first = plan(found.study, Case(entry.reading, entry.law, found.study.trials.seed)).first_estimate
        k = _samples(reading, len(estimate))
        b = reading.step_s * reading.unit_n / found.study.train.mass_kg
        plots.append(Plot(
            f"Estimate of the pseudo partial derivative: {found.title(entry.reading, entry.law)}", "not in the paper",
            "k", f"m/s per {reading.unit}",
            (Curve("desired: (k + 1) T_s/M, all inputs so far changed alike", k, b * np.linspace(1.0, len(k), len(k))),
             Curve("dv(k+1)/du(k) = T_s/M", k, np.full(len(k), b, dtype=np.float64)),
             Curve(f"estimate in trial {trial}", k, estimate)),
            f"{_percent(estimate == first)} of the estimates are the first one, set by (13), and "
            f"{_percent(estimate > 10 * b)} are more than ten times the derivative that Assumption 1 speaks of: (15) "
            "estimates what the inputs before k do to v(k+1) as well (claims 5, A2, 10.lag).", log_y=True))
    return plots


def _percent(which: NDArray[np.bool_]) -> str:
    """The share of the values that are true, in per cent."""
    return f"{number(100 * float(np.mean(which)), 2)} %"


def units(found: Found) -> Plot:
    """MSE after all trials against the unit of u."""
    study = found.study
    curves = []
    for reading in study.unit_sweep.readings:
        for law in PRINTED_LAWS:
            pairs = []
            for unit in study.unit_sweep.units_mps2:
                run = found.runs[Case(reading, law, study.trials.seed, unit_mps2=float(unit))]
                if run.failed is None:
                    pairs.append((float(unit), float(mse(run)[-1] / mse(run)[0])))
            if pairs:
                label = f"{TRIAL_LAWS[law].title}, steps of {study.readings[reading].step_s:g} s"
                points = np.array(pairs)
                curves.append(Curve(label, points[:, 0], points[:, 1]))
    mass = study.train.mass_kg
    return Plot(f"MSE left after {study.trials.count} trials against the unit of u", "not in the paper",
                "acceleration per unit of u (m/s²)", "last MSE over first", tuple(curves),
                f"Units at which a run diverges are left out. 1 N is {number(1 / mass)} m/s², 1 kN is "
                f"{number(1000 / mass)}, 1 N/kg is 1.", log_y=True, log_x=True)


def of_seeds(found: Found) -> list[Plot]:
    """MSE along the trials over all seeds of the lengths."""
    plots = []
    for entry in found.study.shown:
        whole = [mse(run) for run in found.of_seeds(entry) if run.failed is None]
        if not whole:
            continue
        trials = np.arange(len(whole[0]), dtype=float)
        levels = np.quantile(np.array(whole), (0.0, 0.5, 1.0), axis=0)
        curves = tuple(Curve(label, trials, level)
                       for label, level in zip(("least", "median", "largest"), levels, strict=True))
        plots.append(Plot(
            f"MSE over the seeds: {found.title(entry.reading, entry.law)}", "not in the paper", "trial i",
            "MSE (m²/s²)", curves, f"{len(whole)} of {found.study.trials.seeds} draws of the lengths run to the end.",
            log_y=True))
    return plots

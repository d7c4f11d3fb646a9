"""The figures of jiao2025, and the transients along the trials."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import number
from workbench.paper.learning_comparison import trial_curve
from workbench.paper.results import Array, Curve, Plot

from ..laws import TRIAL_LAWS
from ..simulation.plans import Case, desired_trip, lengths, plan
from .record import Reading
from .runs import ICFDL, PD, PRINTED_LAWS, JiaoResults, outcome

FIGURE_OF = {ICFDL: "paper, Figure 5", PD: "paper, Figure 6"}


def _over_k(label: str, reading: Reading, values: Array) -> Curve:
    """Values at the samples of a trial, over the k of (16)."""
    return Curve(label, np.linspace(0.0, (len(values) - 1) * reading.k_per_sample, len(values)), values)


def _desired(results: JiaoResults) -> Plot:
    """The desired speed (16)."""
    reading = next(iter(results.study.readings.values()))
    return Plot("Desired speed", "paper, Figure 2", "k", "speed (m/s)",
                (_over_k("v_d", reading, desired_trip(results.study, reading)[0]),),
                "(16); it is the same in every reading.")


def _lengths(results: JiaoResults) -> Plot:
    """The lengths T_i of the trials."""
    trials = results.study.trials
    drawn = lengths(trials, trials.seed).astype(float)
    return Plot("Lengths of the trials", "paper, Figure 3", "trial i", "T_i (k)", (trial_curve("T_i", drawn, 0),),
                f"Drawn from {trials.shortest_length_k + 1} to {trials.desired_length_k}, seed {trials.seed}; "
                f"k = {trials.desired_length_k} is reached in {int(np.sum(drawn == trials.desired_length_k))} of "
                f"{len(drawn)} trials.")


def _additional(results: JiaoResults) -> Plot:
    """f_a over M, in the desired trip and in the trials that the paper shows."""
    study, entry = results.study, results.study.shown[0]
    reading, case = study.readings[entry.reading], Case(entry.reading, entry.law, study.trials.seed)
    made, run = plan(study, case), results.runs[case]
    place = np.searchsorted(made.edges[1:-1], made.desired_positions, side="right")
    curves = [_over_k("desired trip", reading, made.additional_n[place] / made.mass_kg)]
    curves += [_over_k(f"trial {trial}", reading, run.sample(trial, "additional_n")[:-1] / made.mass_kg)
               for trial in study.trials.line_shown if trial in run.samples]
    return Plot("Additional resistance per unit of mass", "paper, Figure 4", "k", "f_a / M (m/s²)", tuple(curves),
                f"The profile is assumed. Of {results.title(entry)}.")


def _speeds(results: JiaoResults) -> Iterator[Plot]:
    """Speeds in the trials that the paper compares."""
    for entry, run in results.shown():
        reading = results.study.readings[entry.reading]
        curves = [_over_k("desired", reading, desired_trip(results.study, reading)[0])]
        curves += [_over_k(f"trial {trial}", reading, run.sample(trial, "speed"))
                   for trial in results.study.trials.compared if trial in run.samples]
        yield Plot(f"Speed: {results.title(entry)}", FIGURE_OF.get(entry.law, "not in the paper"),
                   "k", "speed (m/s)", tuple(curves), f"Reading: {reading.title}; it {outcome(run)}.")


def _errors(results: JiaoResults) -> Plot:
    """MSE against the trial for the runs that are shown."""
    return Plot("Mean squared error of the speed", "paper, Figure 7", "trial i", "MSE (m²/s²)",
                tuple(trial_curve(results.title(entry), run.mse, 0) for entry, run in results.shown()),
                "k in samples of 0.1 s; what diverges in trial 1 is left out.", log_y=True)


def _transients(results: JiaoResults) -> Iterator[Plot]:
    """MSE and largest error in every reading, on a logarithmic axis."""
    for law in (*PRINTED_LAWS, "jiao2025.fixed_estimate"):
        for column, name, label in (("mse", "MSE", "MSE (m²/s²)"),
                                    ("largest_error", "Largest error", "largest |e| (m/s)")):
            runs = [(reading, results.run(key, law)) for key, reading in results.study.readings.items()]
            curves = (trial_curve(f"{reading.label}: {outcome(run)}", run.column(column), 0) for reading, run in runs)
            yield Plot(f"{name} along the trials: {TRIAL_LAWS[law].title}", "not in the paper: every reading",
                       "trial i", label, tuple(curves), "Whether the error grows before it falls: claims intro.* and "
                       "theorem1.*. A run ends where it diverges.", log_y=True)


def _estimates(results: JiaoResults) -> Iterator[Plot]:
    """What (15) with (13) estimates, beside dv(k+1)/du(k)."""
    study, trial = results.study, results.study.trials.compared[-1]
    for entry, run in results.shown():
        reading = study.readings[entry.reading]
        if entry.law not in (ICFDL, "jiao2025.cfdl") or trial not in run.samples:
            continue
        estimate = run.sample(trial, "estimate")[:-1]
        first = plan(study, Case(entry.reading, entry.law, study.trials.seed)).first_estimate
        b, count = reading.step_s * reading.unit_n / study.train.mass_kg, len(estimate)
        anew, large = (f"{number(100 * float(np.mean(which)), 2)} %" for which in (
            estimate == first, estimate > 10 * b))
        yield Plot(
            f"Estimate of the pseudo partial derivative: {results.title(entry)}", "not in the paper",
            "k", f"m/s per {reading.unit}",
            (_over_k("desired: (k + 1) T_s/M, all inputs so far changed alike", reading,
                     b * np.linspace(1.0, count, count)),
             _over_k("dv(k+1)/du(k) = T_s/M", reading, np.full(count, b, dtype=np.float64)),
             _over_k(f"estimate in trial {trial}", reading, estimate)),
            f"{anew} of the estimates are the first one, set by (13), and {large} are more than ten times the "
            "derivative that Assumption 1 speaks of: (15) estimates what the inputs before k do to v(k+1) as well "
            "(claims 5, A2, 10.lag).", log_y=True)


def _units(results: JiaoResults) -> Plot:
    """MSE after all trials against the unit of u."""
    study, curves = results.study, []
    for reading in study.unit_sweep.readings:
        for law in PRINTED_LAWS:
            runs = [(float(unit), results.run(reading, law, unit_mps2=float(unit)))
                    for unit in study.unit_sweep.units_mps2]
            points = np.array([(unit, run.mse[-1] / run.mse[0]) for unit, run in runs if run.failed is None])
            if len(points):
                label = f"{TRIAL_LAWS[law].title}, steps of {study.readings[reading].step_s:g} s"
                curves.append(Curve(label, points[:, 0], points[:, 1]))
    mass = study.train.mass_kg
    return Plot(f"MSE left after {study.trials.count} trials against the unit of u", "not in the paper",
                "acceleration per unit of u (m/s²)", "last MSE over first", tuple(curves),
                f"Units at which a run diverges are left out. 1 N is {number(1 / mass)} m/s², 1 kN is "
                f"{number(1000 / mass)}, 1 N/kg is 1.", log_y=True, log_x=True)


def _seeds(results: JiaoResults) -> Iterator[Plot]:
    """MSE along the trials over all seeds of the lengths."""
    for entry in results.study.shown:
        whole = [run.mse for run in results.of_seeds(entry) if run.failed is None]
        if whole:
            levels = np.quantile(np.array(whole), (0.0, 0.5, 1.0), axis=0)
            yield Plot(f"MSE over the seeds: {results.title(entry)}", "not in the paper", "trial i",
                       "MSE (m²/s²)", tuple(trial_curve(label, level, 0) for label, level in zip(
                           ("least", "median", "largest"), levels, strict=True)),
                       f"{len(whole)} of {results.study.trials.seeds} draws of the lengths run to the end.", log_y=True)


# The paper's figures first, in its order.
PLOTS = (_desired, _lengths, _additional, _speeds, _errors, _transients, _estimates, _units, _seeds)

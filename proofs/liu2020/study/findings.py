"""What the runs of liu2020 say, in sentences; every number in them comes from the runs or the printed tables."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from workbench.files.numbers import number
from workbench.paper.findings import needed, required, some, span

from ..laws import LAWS
from ..simulation.trip import desired_curve
from ..steady_run import eigenvalues, largest_step_s
from .record import COLUMNS
from .runs import BY_RATE, CORRECTED, FEEDBACK, RMS, SIGN_LAWS, LiuResults, RunResult, number_of
from .tables import ENERGY, QUANTITIES

CASE_1 = (1, 2, 3, 4, 5)
HIGH_GAIN = (4, 5, 6, 7, 8, 9)  # where the observer is fast against the reference
VIBRATING = 6  # "a slight vibration" in Figure 11


def _values(results: LiuResults, law: str, name: str, columns: Sequence[int]) -> list[float]:
    """A number of several columns' runs, none of which failed."""
    return [needed(results.rms(column, law, name)) for column in columns]


def _falls(numbers: list[float]) -> bool:
    return all(after < before for before, after in pairwise(numbers))


def _course(numbers: list[float]) -> str:
    word = "falls" if _falls(numbers) else "goes, not steadily,"
    return f"{word} from {number(numbers[0])} to {number(numbers[-1])}"


def _ratio(results: LiuResults, runs: list[RunResult], name: str) -> str:
    """Smallest and largest ratio of an obtained number to Table 3's, as text."""
    known = [value / results.printed(results.study.table_3, run.case.column, name) for run in runs
             if (value := number_of(run, name)) is not None]
    return f"{QUANTITIES[name].title} {span(known) if known else 'not at all'}"


def _ratios(results: LiuResults, runs: list[RunResult]) -> str:
    return ", ".join(_ratio(results, runs, name) for name in RMS)


def _table_3(results: LiuResults) -> str:
    runs = [results.table_3(column, CORRECTED) for column in HIGH_GAIN]
    return (f"Values 4 to 9 with their signs corrected, obtained over printed: {_ratios(results, runs)}. The "
            "estimation errors are near what Table 3 prints, the tracking errors far above it.")


def _observer_gain(results: LiuResults) -> str:
    by_error, by_rate = (_values(results, law, "v_tilde_mps", CASE_1) for law in (CORRECTED, BY_RATE))
    position, (last,) = (_values(results, law, name, columns) for law, name, columns in (
        (CORRECTED, "s_tilde_m", CASE_1), (BY_RATE, "v_tilde_mps", (COLUMNS,))))
    return (f"More observer gain, Values 1 to 5: with k₃ṽ, as (12) and (14) print, s̃ {_course(position)} m and ṽ "
            f"{_course(by_error)} m/s. With k₃s̃′, as (18) and (25) have it, ṽ {_course(by_rate)} m/s and is "
            f"{number(last)} m/s at Value 10: k₁ : k₂ : k₃ = 4 : 1 : 5 in all of Table 2, so the slow eigenvalue, near "
            f"k₂/(k₁ + k₃), stays where it is from Value 4 on.")


def _implied(results: LiuResults) -> str:
    high = [results.implied()[f"Table 3, Value {column}"] for column in (7, 8, 9)]
    by_estimates, ratio = [i.by_estimates for i in high], [i.ratio for i in high]
    time = np.linspace(0.0, desired_curve(results.study).trip_time_s, 100_001)
    wanted = float(np.sqrt(np.mean(desired_curve(results.study).at(time)[2] ** 2)))
    return (f"The printed s̃ and ṽ of Values 7 to 9 are those of (12) as printed with k₃ṽ and no adaptation at an RMS "
            f"acceleration of {number(min(by_estimates))} to {number(max(by_estimates))} m/s²; the desired curve here, "
            f"chosen by Figure 18 alone, has {number(wanted)}. Their s−s_d is {number(min(ratio))} to "
            f"{number(max(ratio))} times smaller than k₄k₅ lets it be.")


def _step(results: LiuResults) -> str:
    rows, study = results.implied(), results.study
    steps = [rows[f"Table 3, Value {column}"].step_s for column in HIGH_GAIN]
    tenth = rows[f"Table 4, Value {study.table_4_column}"].step_s
    limits = [largest_step_s(eigenvalues(study, study.table_4_column, damped)) for damped in ("v_tilde", "s_tilde'")]
    return (f"By the excess of s̃ over ṽ/k₁, Table 3 fits steps of {number(min(steps), 2)} to "
            f"{number(max(steps), 2)} s for Values 4 to 9 and of {number(tenth, 2)} s for Value 10, where Euler steps "
            f"must stay below {number(limits[0])} s with k₃ṽ; with k₃s̃′ they must stay below {number(limits[1])} s.")


def _inferred(results: LiuResults) -> str:
    by_column, study = {run.case.column: run for run in results.inferred()}, results.study
    runs = some(by_column[column] for column in HIGH_GAIN if column in by_column and column != VIBRATING)
    text = (f"With that ({'; '.join(study.runs.inferred_changes)}) and feedback alone, Values 4, 5 and 7 to 9 "
            f"give, over printed, {_ratios(results, runs)}: most of Table 3 can be had from the feedback loop, at a k₅ "
            "that Table 2 does not print; networks and robust terms are not to be seen in it.")
    lost = [column for column, run in by_column.items() if run.failed or (
        number_of(run, "v_tilde_mps") or 0.0) > 10 * results.printed(study.table_3, column, "v_tilde_mps")]
    if lost:
        text += (f" Not all of it: Values {' and '.join(map(str, lost))} diverge or oscillate, where the paper calls "
                 f"the input of Value 1 jittery")
        if VIBRATING in by_column:
            text += (f", and Value {VIBRATING} vibrates, {_ratio(results, [by_column[VIBRATING]], 'speed_mps')}, where "
                     "the paper sees a slight vibration")
        text += "."
    return text


def _value_10(results: LiuResults) -> str:
    study, rows, column = results.study, results.implied(), results.study.table_4_column
    third, fourth = rows[f"Table 3, Value {column}"], rows[f"Table 4, Value {column}"]
    printed = results.printed(study.table_3, column, "v_tilde_mps")
    shown = max(map(abs, study.figure_ranges.v_tilde_mps))
    text = (f"Value {column} under the same disturbance (claim table4): Table 3's ṽ = {printed:g} m/s implies "
            f"{number(third.by_estimates)} m/s², Table 4's a tenth of it {number(fourth.by_estimates)}, as Values 4 to "
            f"9 do")
    if printed > shown:
        text += f"; {printed:g} m/s is also above the largest |ṽ| of Figure 15, {shown:g}, so Table 4 is right"
    s_printed = [results.printed(table, column, "position_m") for table in (study.table_3, study.table_4)]
    range_16 = max(map(abs, study.figure_ranges.position_m))
    return (f"{text}. For s−s_d it is the other way round: Table 3's {s_printed[0]:g} m is "
            f"{third.by_position / fourth.by_estimates:.2f} times what the stated gains leave of that acceleration, "
            f"and the {range_16:g} m of Figure 16 are {range_16 / s_printed[0]:.0f} times it, but "
            f"{range_16 / s_printed[1]:.0f} times Table 4's.")


def _control_gain(results: LiuResults) -> str:
    said = []
    for columns in ((5, 6), (7, 8)):
        for name in ("position_m", "speed_mps"):
            pair, of = _values(results, CORRECTED, name, columns), QUANTITIES[name]
            required(_falls(pair))
            said.append(f"{of.title} from {number(pair[0])} to {number(pair[1])} {of.unit}")
    return f"More control gain tracks better, as the paper says: Values 5 to 6 and 7 to 8 take {', '.join(said)}."


def _energy(results: LiuResults) -> Iterator[str]:
    study, column = results.study, results.study.table_4_column
    both, traction = (needed(results.rms(column, CORRECTED, name)) for name in (ENERGY, "energy_J"))
    yield (f"Energy at Value {column}: {number(both / 1e11)}·10¹¹ J of traction and braking, "
           f"{number(traction / 1e11)} of traction alone, against {study.table_3.energy[column - 1] / 1e11:g} printed "
           f"without a unit.")
    others = [f"{change.title}: {number((number_of(run, ENERGY) or 0.0) / 1e11)}" for change, run in results.assumed(
        lambda change: bool({"train.davis_unit", "line.length_m"} & set(change.set)))
        if run.case.column == column and not run.failed]
    if others:
        yield f"That energy with other assumptions (10¹¹ J): {'; '.join(others)}."


def _slow_disturbance(results: LiuResults) -> str:
    """The energy that the slow disturbance can add at most, from its force and the way that is left."""
    study, names = results.study, list(results.study.disturbances)
    required({"none", "slow"} <= set(names))
    printed = study.table_4.energy[names.index("slow")] - study.table_4.energy[names.index("none")]
    push, curve = study.disturbances["slow"], desired_curve(study)
    force = push.largest_n / study.train.chi
    most = force * (curve.length_m - float(curve.at(np.array([push.from_s]))[0][0]))
    required(most < printed)
    return (f"Table 4 has the slow disturbance cost {number(printed / 1e11)}·10¹¹ more than none. It takes at most "
            f"{force / 1e6:.2f} MN to balance from {push.from_s:g} s on, at most {number(most / 1e11)}·10¹¹ J over the "
            f"way that is left here: the paper's trip must be far longer, or its energy another quantity.")


def _signs(results: LiuResults) -> str:
    required(bool(results.study.changes))
    runs = results.study.runs
    pairs = [(column, rate) for column in runs.divergence_columns for rate in runs.divergence_leak_rates_per_s]
    by_law = {law: [(rate, results.divergence(column, law, rate)) for column, rate in pairs] for law in SIGN_LAWS}
    lost = {law: [rate * run.row["end_s"] for rate, run in ended if run.failed] for law, ended in by_law.items()}
    text = (f"The signs, {runs.divergence_change}, over leak rates and columns, runs that diverge: "
            f"{'; '.join(f'{LAWS[law].title}: {len(lost[law])} of {len(pairs)}' for law in SIGN_LAWS)}.")
    times = [time for of_law in lost.values() for time in of_law]
    if times:
        text += (f" The printed leakage drives the estimates away within {min(times):.0f} to {max(times):.0f} times "
                 f"1/(Γσ).")
    both = zip(pairs, by_law["liu2020.wrong_learning"], by_law[CORRECTED], strict=True)
    known = [(wrong / right, column, rate, wrong, right) for (column, rate), (_, of_wrong), (_, of_right) in both
             if (wrong := number_of(of_wrong, "position_m")) and (right := number_of(of_right, "position_m"))]
    if known:
        _, column, rate, wrong, right = max(known)
        text += (f" The wrong sign of (32) costs tracking, most at Value {column} and {rate:g} 1/s, {number(wrong)} "
                 f"instead of {number(right)} m; the robust term, whose sign is right, hides the rest.")
    return text


def _position_only(results: LiuResults) -> str:
    laws = (CORRECTED, "liu2020.position_only_speed", BY_RATE, "liu2020.position_only")
    found = [needed(results.rms(COLUMNS, law, "v_tilde_mps")) for law in laws]
    return (f"(19) to (21), (30) and k₃ṽ need the speed that is not measured (claim 19.measured). With the position "
            f"alone, its difference filtered over {results.study.sampling.speed_filter_s:g} s, ṽ at Value {COLUMNS} is "
            f"{number(found[1])} m/s instead of {number(found[0])}; with k₃s̃′, which needs the speed in the adaptation "
            f"only, {number(found[3])} and {number(found[2])}.")


def _networks(results: LiuResults) -> str:
    said = []
    for column in (5, COLUMNS):
        bare, nets = (needed(results.rms(column, law, "position_m")) for law in (FEEDBACK, CORRECTED))
        said.append(f"{number(bare)} to {number(nets)} m at Value {column}")
    text = (f"The paper states no value of networks and adaptation. As assumed, slow enough for every column, they "
            f"take s−s_d from {', from '.join(said)}.")
    lost = [f"{change.title}, Value {run.case.column}" for change, run in results.assumed(
        lambda change: any(key.startswith("adaptation.") for key in change.set)) if run.failed]
    if lost:
        text += (f" Fast adaptation diverges with corrected signs too ({'; '.join(lost)}): e_v is made of the "
                 f"observer's own states (claim 27.input), which Theorem 2 does not see.")
    return text


def _stiff(results: LiuResults) -> str:
    lost = some(change.title for change, run in results.assumed(lambda change: "sampling.period_s" in change.set)
                if run.failed and run.case.column == COLUMNS)
    return f"Value {COLUMNS} is stiff: it diverges with {'; '.join(lost)}, as its eigenvalues say."


def _sensitivity(results: LiuResults) -> str:
    """Which assumed value moves the errors most, among the changes of the law as stated."""
    parts, assumed = [], results.assumed(lambda change: change.law is None)
    for column in results.study.runs.sensitivity_columns:
        for name in ("v_tilde_mps", "position_m"):
            before, of = results.rms(column, results.study.runs.sensitivity_law, name), QUANTITIES[name]
            moved = [(abs(np.log(value / before)), change.title, value) for change, run in assumed
                     if run.case.column == column and before and (value := number_of(run, name))]
            if moved and before:
                _, title, value = max(moved)
                parts.append(f"{of.title} at Value {column} most to '{title}' ({number(before)} to {number(value)} "
                             f"{of.unit})")
    return f"Of what is assumed, reacts {'; '.join(some(parts))}."


def _cost(results: LiuResults) -> str:
    cost = [sorted(some(run.row["step_us_median"] for run in results.select(law=law).values() if not run.failed))
            for law in (FEEDBACK, CORRECTED)]
    bare, nets = (times[len(times) // 2] for times in cost)
    return (f"A million control steps take {bare:.2f} s without and {nets:.2f} s with two networks of "
            f"{results.study.networks.neurons} neurons, train included (median of the runs of this report).")


FINDINGS = (_table_3, _observer_gain, _implied, _step, _inferred, _value_10, _control_gain, _energy, _slow_disturbance,
            _signs, _position_only, _networks, _stiff, _sensitivity, _cost)

"""What the runs of liu2020 say, in sentences; every number in them comes from the runs or the printed tables."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from workbench.files.numbers import number

from ..laws import LAWS
from .cases import SIGN_LAWS, Found
from .record import COLUMNS
from .runs import Outcome, desired_curve
from .steady import eigenvalues, largest_step_s
from .tables import ENERGY, RMS, SIGNS, UNITS, implied_columns, printed_at

CORRECTED, BY_RATE, PRINTED = "liu2020.corrected", "liu2020.corrected_rate", "liu2020.printed"
CASE_1 = (1, 2, 3, 4, 5)
HIGH_GAIN = (4, 5, 6, 7, 8, 9)  # where the observer is fast against the reference
VIBRATING = 6  # "a slight vibration" in Figure 11


def all_findings(found: Found) -> tuple[str, ...]:
    """Every finding; one whose runs failed or are not asked for is left out."""
    made = (_table_3(found), _observer_gain(found), _implied(found), _step(found), _inferred(found), _value_10(found),
            _control_gain(found), _energy(found), _slow_disturbance(found), _signs(found), _position_only(found),
            _networks(found), _stiff(found), _sensitivity(found), _cost(found))
    return tuple(text for text in made if text)


def values(found: Found, law: str, name: str, columns: tuple[int, ...]) -> list[float] | None:
    """A number of several columns' runs; None where one of them failed."""
    got = [found.table_3(column, law).numbers.get(name) for column in columns]
    return None if any(value is None for value in got) else [value for value in got if value is not None]


def falls(numbers: list[float]) -> bool:
    """Whether each is smaller than the one before."""
    return all(after < before for before, after in pairwise(numbers))


def ratios(found: Found, outcomes: list[Outcome], name: str) -> str:
    """Smallest and largest ratio of an obtained number to Table 3's, as text."""
    got = [(o.numbers.get(name), printed_at(found.study, found.study.table_3, o.case.column, name)) for o in outcomes]
    known = [value / printed for value, printed in got if value is not None]
    if not known:
        return f"{SIGNS[name]} not at all"
    low, high = number(min(known)), number(max(known))
    return f"{SIGNS[name]} {low}" if low == high else f"{SIGNS[name]} {low} to {high}"


def _table_3(found: Found) -> str:
    runs = [found.table_3(column, CORRECTED) for column in HIGH_GAIN]
    return (f"Values 4 to 9 with their signs corrected, obtained over printed: "
            f"{', '.join(ratios(found, runs, name) for name in RMS)}. The estimation errors are near what Table 3 "
            f"prints, the tracking errors far above it.")


def _observer_gain(found: Found) -> str:
    by_error, by_rate = (values(found, law, "v_tilde_mps", CASE_1) for law in (CORRECTED, BY_RATE))
    position = values(found, CORRECTED, "s_tilde_m", CASE_1)
    last = found.table_3(COLUMNS, BY_RATE).numbers.get("v_tilde_mps")
    if by_error is None or by_rate is None or position is None or last is None:
        return ""
    return (f"More observer gain, Values 1 to 5: with k₃ṽ, as (12) and (14) print, s̃ {_course(position)} m and ṽ "
            f"{_course(by_error)} m/s. With k₃s̃′, as (18) and (25) have it, ṽ {_course(by_rate)} m/s and is "
            f"{number(last)} m/s at Value 10: k₁ : k₂ : k₃ = 4 : 1 : 5 in all of Table 2, so the slow eigenvalue, near "
            f"k₂/(k₁ + k₃), stays where it is from Value 4 on.")


def _course(numbers: list[float]) -> str:
    word = "falls" if falls(numbers) else "goes, not steadily,"
    return f"{word} from {number(numbers[0])} to {number(numbers[-1])}"


def _implied(found: Found) -> str:
    rows = dict(implied_columns(found))
    high = [rows[f"Table 3, Value {column}"] for column in (7, 8, 9)]
    by_estimates, ratio = [i.by_estimates for i in high], [i.ratio for i in high]
    time = np.linspace(0.0, desired_curve(found.study).trip_time_s, 100_001)
    wanted = float(np.sqrt(np.mean(desired_curve(found.study).at(time)[2] ** 2)))
    return (f"The printed s̃ and ṽ of Values 7 to 9 are those of (12) as printed with k₃ṽ and no adaptation at an RMS "
            f"acceleration of {number(min(by_estimates))} to {number(max(by_estimates))} m/s²; the desired curve here, "
            f"chosen by Figure 18 alone, has {number(wanted)}. Their s−s_d is {number(min(ratio))} to "
            f"{number(max(ratio))} times smaller than k₄k₅ lets it be.")


def _step(found: Found) -> str:
    rows, study = dict(implied_columns(found)), found.study
    steps = [rows[f"Table 3, Value {column}"].step_s for column in HIGH_GAIN]
    tenth = rows[f"Table 4, Value {study.table_4_column}"].step_s
    limits = [largest_step_s(eigenvalues(study, study.table_4_column, damped)) for damped in ("v_tilde", "s_tilde'")]
    return (f"By the excess of s̃ over ṽ/k₁, Table 3 fits steps of {number(min(steps), 2)} to "
            f"{number(max(steps), 2)} s for Values 4 to 9 and of {number(tenth, 2)} s for Value 10, where Euler steps "
            f"must stay below {number(limits[0])} s with k₃ṽ; with k₃s̃′ they must stay below {number(limits[1])} s.")


def _inferred(found: Found) -> str:
    outcomes = {o.case.column: o for o in found.inferred()}
    runs = [outcomes[column] for column in HIGH_GAIN if column in outcomes and column != VIBRATING]
    if not runs:
        return ""
    text = (f"With that ({'; '.join(found.study.runs.inferred_changes)}) and feedback alone, Values 4, 5 and 7 to 9 "
            f"give, over printed, {', '.join(ratios(found, runs, name) for name in RMS)}: most of Table 3 can be had "
            f"from the feedback loop, at a k₅ that Table 2 does not print; networks and robust terms are not to be "
            f"seen in it.")
    lost = [column for column, o in outcomes.items() if o.failed or (o.numbers["v_tilde_mps"] or 0.0) > 10 * printed_at(
        found.study, found.study.table_3, column, "v_tilde_mps")]
    if lost:
        text += (f" Not all of it: Values {' and '.join(map(str, lost))} diverge or oscillate, where the paper calls "
                 f"the input of Value 1 jittery")
        if VIBRATING in outcomes:
            vibrates = ratios(found, [outcomes[VIBRATING]], "speed_mps")
            text += f", and Value {VIBRATING} vibrates, {vibrates}, where the paper sees a slight vibration"
        text += "."
    return text


def _value_10(found: Found) -> str:
    study, rows = found.study, dict(implied_columns(found))
    column = study.table_4_column
    third, fourth = rows[f"Table 3, Value {column}"], rows[f"Table 4, Value {column}"]
    printed = printed_at(study, study.table_3, column, "v_tilde_mps")
    shown = max(map(abs, study.figure_ranges.v_tilde_mps))
    text = (f"Value {column} under the same disturbance (claim table4): Table 3's ṽ = {printed:g} m/s implies "
            f"{number(third.by_estimates)} m/s², Table 4's a tenth of it {number(fourth.by_estimates)}, as Values 4 to "
            f"9 do")
    if printed > shown:
        text += f"; {printed:g} m/s is also above the largest |ṽ| of Figure 15, {shown:g}, so Table 4 is right"
    s_printed = [printed_at(study, table, column, "position_m") for table in (study.table_3, study.table_4)]
    range_16 = max(map(abs, study.figure_ranges.position_m))
    return (f"{text}. For s−s_d it is the other way round: Table 3's {s_printed[0]:g} m is "
            f"{third.by_position / fourth.by_estimates:.2f} times what the stated gains leave of that acceleration, "
            f"and the {range_16:g} m of Figure 16 are {range_16 / s_printed[0]:.0f} times it, but "
            f"{range_16 / s_printed[1]:.0f} times Table 4's.")


def _control_gain(found: Found) -> str:
    said = []
    for low, high in ((5, 6), (7, 8)):
        for name in ("position_m", "speed_mps"):
            pair = values(found, CORRECTED, name, (low, high))
            if pair is None or not falls(pair):
                return ""
            said.append(f"{SIGNS[name]} from {number(pair[0])} to {number(pair[1])} {UNITS[name]}")
    return f"More control gain tracks better, as the paper says: Values 5 to 6 and 7 to 8 take {', '.join(said)}."


def _energy(found: Found) -> str:
    study, column = found.study, found.study.table_4_column
    numbers = found.table_3(column, CORRECTED).numbers
    both, traction = numbers.get(ENERGY), numbers.get("energy_J")
    if both is None or traction is None:
        return ""
    others = [f"{change.title}: {number((o.numbers.get(ENERGY) or 0.0) / 1e11)}"
              for place, change in enumerate(study.changes) for o in found.change(place)
              if o.case.column == column and not o.failed and {"train.davis_unit", "line.length_m"} & set(change.set)]
    tail = f" With other assumptions: {'; '.join(others)}." if others else ""
    return (f"Energy at Value {column}: {number(both / 1e11)}·10¹¹ J of traction and braking, "
            f"{number(traction / 1e11)} of traction alone, against {study.table_3.energy[column - 1] / 1e11:g} printed "
            f"without a unit.{tail}")


def _slow_disturbance(found: Found) -> str:
    """The energy that the slow disturbance can add at most, from its force and the way that is left."""
    study = found.study
    names = list(study.disturbances)
    if not {"none", "slow"} <= set(names):
        return ""
    printed = study.table_4.energy[names.index("slow")] - study.table_4.energy[names.index("none")]
    push, curve = study.disturbances["slow"], desired_curve(study)
    force = push.largest_n / study.train.chi
    most = force * (curve.length_m - float(curve.at(np.array([push.from_s]))[0][0]))
    if most >= printed:
        return ""
    return (f"Table 4 has the slow disturbance cost {number(printed / 1e11)}·10¹¹ more than none. It takes at most "
            f"{force / 1e6:.2f} MN to balance from {push.from_s:g} s on, at most {number(most / 1e11)}·10¹¹ J over the "
            f"way that is left here: the paper's trip must be far longer, or its energy another quantity.")


def _signs(found: Found) -> str:
    runs = found.study.runs
    if not found.study.changes:
        return ""
    parts, times = [], []
    for law in SIGN_LAWS:
        ended = [(rate, found.divergence(column, law, rate)) for column in runs.divergence_columns
                 for rate in runs.divergence_leak_rates_per_s]
        failed = [(rate, o) for rate, o in ended if o.failed]
        times += [rate * o.end_s for rate, o in failed]
        parts.append(f"{LAWS[law].title}: {len(failed)} of {len(ended)}")
    text = f"The signs, {runs.divergence_change}, over leak rates and columns, runs that diverge: {'; '.join(parts)}."
    if times:
        text += (f" The printed leakage drives the estimates away within {min(times):.0f} to {max(times):.0f} times "
                 f"1/(Γσ).")
    pairs = [(column, rate, [found.divergence(column, f"liu2020.{law}", rate).numbers.get("position_m")
                             for law in ("wrong_learning", "corrected")])
             for column in runs.divergence_columns for rate in runs.divergence_leak_rates_per_s]
    known = [(wrong / right, column, rate, wrong, right) for column, rate, (wrong, right) in pairs if wrong and right]
    if known:
        _, column, rate, wrong, right = max(known)
        text += (f" The wrong sign of (32) costs tracking, most at Value {column} and {rate:g} 1/s, {number(wrong)} "
                 f"instead of {number(right)} m; the robust term, whose sign is right, hides the rest.")
    return text


def _position_only(found: Found) -> str:
    laws = (CORRECTED, "liu2020.position_only_speed", BY_RATE, "liu2020.position_only")
    got = [found.table_3(COLUMNS, law).numbers.get("v_tilde_mps") for law in laws]
    if any(value is None for value in got):
        return ""
    return (f"(19) to (21), (30) and k₃ṽ need the speed that is not measured (claim 19.measured). With the position "
            f"alone, its difference filtered over {found.study.sampling.speed_filter_s:g} s, ṽ at Value {COLUMNS} is "
            f"{number(got[1])} m/s instead of {number(got[0])}; with k₃s̃′, which needs the speed in the adaptation "
            f"only, {number(got[3])} and {number(got[2])}.")


def _networks(found: Found) -> str:
    said = []
    for column in (5, COLUMNS):
        pair = [found.table_3(column, law).numbers.get("position_m") for law in ("liu2020.feedback", CORRECTED)]
        if None in pair:
            return ""
        said.append(f"{number(pair[0])} to {number(pair[1])} m at Value {column}")
    text = (f"The paper states no value of networks and adaptation. As assumed, slow enough for every column, they "
            f"take s−s_d from {', from '.join(said)}.")
    lost = [f"{change.title}, Value {o.case.column}" for place, change in enumerate(found.study.changes)
            for o in found.change(place) if o.failed and any(key.startswith("adaptation.") for key in change.set)]
    if lost:
        text += (f" Fast adaptation diverges with corrected signs too ({'; '.join(lost)}): e_v is made of the "
                 f"observer's own states (claim 27), which Theorem 2 does not see.")
    return text


def _stiff(found: Found) -> str:
    lost = [change.title for place, change in enumerate(found.study.changes) for o in found.change(place)
            if o.failed and o.case.column == COLUMNS and "sampling.period_s" in change.set]
    if not lost:
        return ""
    return f"Value {COLUMNS} is stiff: it diverges with {'; '.join(lost)}, as its eigenvalues say."


def _sensitivity(found: Found) -> str:
    """Which assumed value moves the errors most, among the changes of the law as stated."""
    parts = []
    for column in found.study.runs.sensitivity_columns:
        stated = found.table_3(column, found.study.runs.sensitivity_law).numbers
        for name in ("v_tilde_mps", "position_m"):
            before = stated.get(name)
            moved = [(abs(np.log(value / before)), change.title, value)
                     for place, change in enumerate(found.study.changes) if change.law is None
                     for o in found.change(place)
                     if o.case.column == column and before and (value := o.numbers.get(name))]
            if moved and before:
                _, title, value = max(moved)
                parts.append(f"{SIGNS[name]} at Value {column} most to '{title}' ({number(before)} to {number(value)} "
                             f"{UNITS[name]})")
    return f"Of what is assumed, reacts {'; '.join(parts)}." if parts else ""


def _cost(found: Found) -> str:
    cost = [sorted(o.step_us for o in found.outcomes.values() if o.case.law == law and not o.failed)
            for law in ("liu2020.feedback", CORRECTED)]
    if not all(cost):
        return ""
    bare, nets = (times[len(times) // 2] for times in cost)
    return (f"A million control steps take {bare:.2f} s without and {nets:.2f} s with two networks of "
            f"{found.study.networks.neurons} neurons, train included (median of the runs of this report).")

"""Section 6: train, line and disturbances that the simulations take, (61), (69)-(71) and Table 1, against study.toml."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_most, less
from workbench.proof.printed_values import PrintedValues, as_printed
from workbench.proof.verdict import Match

from ..goal_forms import within
from ..paper import paper
from ..stated_values import exactly, stated

STUDY = "The values that the simulation takes for them, from the study's file."


def given(equation: str, title: str, printed: str, data: PrintedValues, match: Match = "read", note: str = "") -> None:
    """State data of the paper, taken as given, and that the simulation takes the same numbers."""
    paper.axiom(equation, title, printed, "data of the paper", hypotheses=(), severity="data", match=match, note=note)

    @paper.claim(f"{equation}.runs", f"{title}, as the simulation has it", "condition", printed, "proved", origin="ours",
                 match=match, at=data.at, reading=STUDY)
    def simulated() -> Goal:
        """The printed numbers against the study's."""
        return data.goal()


train = stated["train"]
of_train = as_printed({"M": (train["mass_kg"], "890000"), "chi": (train["chi"], "0.9")})
cruise = sp.Symbol("v_cruise", positive=True)


given("text.train", "Mass and chi of the train",
      r"\text{The total nominal mass of the train is}\ M = 890\ \text{tons} \ldots \chi = 0.9", of_train, "words",
      "890 t are 890,000 kg.")


@paper.claim("text.cruise", "The train runs at 350 km/h, below its largest speed", "condition",
             r"\text{the continuous operation time is 350 km/h, the maximum operation speed is 380 km/h}", "proved", match="words",
             at={cruise: exactly(stated["reference"]["cruise_mps"])},
             reading="350 km/h is the speed at which the desired curve of the study cruises, in m/s to ten digits.",
             note="350 km/h is no time: the continuous operation speed is meant. (62) to (68), the desired curve itself, are "
                  "not in the extracted text.")
def cruise_speed() -> Goal:
    """3.6 times the speed in m/s."""
    return Goal((*within(sp.Rational(36, 10) * cruise - 350, sp.Rational(1, 10**8)), less(sp.Rational(36, 10) * cruise, 380)))


of_61 = as_printed(dict(zip(("a", "b", "c"), zip(train["davis"], ("0.53", "0.00388", "0.000114"), strict=True), strict=True)))
given("61", "The general resistance of the train", r"f'_b = 0.53 + 0.00388v + 0.000114v^2", of_61,
      note="Neither f_b' nor v has a unit in print.")


first, second = stated["line"]["sections"]
of_table = as_printed({
    "s_1": (first["from_m"], "68300"), "s_2": (first["to_m"], "100800"), "p": (first["slope"], "10"),
    "s_3": (second["from_m"], "108300"), "s_4": (second["to_m"], "127500"), "R": (second["curve_radius_m"], "200"),
    "L_s": (second["tunnel_length_m"], "1000")})


PRINTED_TABLE_1 = (r"s \in [6.83 \times 10^4, 10.08 \times 10^4]: 10\ \%,\quad s \in [10.83 \times 10^4, 12.75 \times 10^4]: 200\ \text{m}, "
                   r"1000\ \text{m}")
given("table1", "Table 1: slope, curve and tunnel", PRINTED_TABLE_1, of_table, "words", "The runs take what is printed.")

curve_begins, curve_ends, radius = sp.symbols("s_begin s_end R_curve", positive=True)


@paper.claim("table1.curve", "The curve is at most one full circle", "condition", PRINTED_TABLE_1, "violated", match="words",
             origin="implied", severity="cosmetic", rests_on=(),
             at={curve_begins: exactly(second["from_m"]), curve_ends: exactly(second["to_m"]), radius: exactly(second["curve_radius_m"])},
             reading="If the entries of the table are as extracted. A curve turns by its length over its radius; a full circle is "
                     "less than 6.3 radians.",
             note="19.2 km at a radius of 200 m are 15 full circles, and 350 km/h there give 47 m/s^2 across the track. Nor does a "
                  "slope of 10 % for 32.5 km, a rise of 3250 m, fit such a railway, ten per mille may be meant; and where in "
                  "the 19.2 km the tunnel of 1000 m lies is not said.")
def curve_turns_once() -> Goal:
    """The angle of the second section."""
    return Goal((at_most((curve_ends - curve_begins) / radius, sp.Rational("6.3")),))


def _disturbance(equation: str, title: str, printed: str, name: str, numbers: tuple[str, str, str, str]) -> None:
    """Begin, sine and cosine in newtons, and frequency."""
    of_study = stated["disturbances"][name]
    keys = ("from_s", "sine_n", "cosine_n", "omega_rad_s")
    letters = ("t_0", "A_sin", "A_cos", "omega_d")
    given(equation, title, printed, as_printed({
        letter: (of_study[key], number) for letter, key, number in zip(letters, keys, numbers, strict=True)}))


_disturbance("69", "No disturbance", "d(t) = 0", "none", ("0", "0", "0", "0"))
_disturbance("70", "The fast disturbance", r"d(t) = \frac{10^5}{M}(\sin(0.08t) + \cos(0.08t))", "fast",
             ("0", "100000", "100000", "0.08"))
_disturbance("71", "The slow disturbance", r"d(t) = \begin{cases} 0, & t < 1000 \text{ (s)}, \\ \frac{10^6}{M}\sin(0.008t), & "
             r"t \geq 1000 \text{ (s)} \end{cases}", "slow", ("1000", "1000000", "0", "0.008"))

slow = stated["disturbances"]["slow"]
begins, amplitude, omega = sp.symbols("T_d A_d omega_d", positive=True)


@paper.claim("71.continuous", "The slow disturbance is continuous, as Assumption 3 has it", "condition",
             r"\text{external disturbance}\ d(t)\ \text{[is] unknown and continuously bounded}", "violated", match="words",
             origin="ours", severity="cosmetic", rests_on=("71", "assumption3"),
             at={begins: exactly(slow["from_s"]), amplitude: exactly(slow["sine_n"]), omega: exactly(slow["omega_rad_s"])},
             reading="Where (71) begins, at t = 1000 s, its value from there on is the 0 that it has before, within 1 N times 1/M.",
             note="At t = 1000 s the disturbance jumps from 0 to 10^6 sin(8)/M, 0.99 MN on the train of mass M, and with it theta of "
                  "(34), which the proof of Theorem 2 takes for constant (52.theta). 'Continuously bounded' may mean no more than "
                  "bounded at all times, which it is.")
def slow_disturbance_begins() -> Goal:
    """A sin(omega T) at the beginning."""
    return Goal((at_most(amplitude * sp.sin(omega * begins), 1),))

"""mao2018, section VIII: the numbers of train, modes, disturbances, failures and cases, against study.toml."""

from __future__ import annotations

from collections.abc import Mapping

from workbench.proof.claim import Goal
from workbench.proof.printed_values import as_printed

from ..paper import paper
from ..stated_values import cases, modes, stated

STUDY = "The values that the simulation takes for them, from the study's file."


def _row(name: str, title: str, printed: str, values: Mapping[str, tuple[float, str]], note: str = "", reading: str = "") -> None:
    data = as_printed(values)

    @paper.claim(name, title, "condition", printed, "proved", match="words", at=data.at, rests_on=(), severity="data",
                 reading=STUDY + reading, note=note)
    def simulated() -> Goal:
        """Each number as printed."""
        return data.goal()


_row("VIII.train", "Mass and motors of the train", r"M_i = M = 400 \text{ ton},\ n = 16",
     {"M": (stated["train"]["mass_t"], "400"), "n": (stated["train"]["motors"], "16")})
MODE = r"a_%d = 8.63 \times 10^{-3},\ b_%d = 7.295 \times 10^{-6},\ c_%d = %s \times 10^{-6},\ \theta_%d = %s, \text{ and } D_%d = %s"
for _i, (_title, _span, _start, _c, _theta, _D) in enumerate((
        ("Mode (i): the start", r"0 \le t < 400", "0", "1.12", "0", "0"),
        ("Mode (ii): the tunnel", r"400 \le t < 800", "400", "9.12", "0", "0"),
        ("Mode (iii): curve and slope", r"800 \le t < 1400", "800", "1.12", "0.018", "0.34"),
        ("Mode (iv): open air and level track", r"1400 \le t < 2000", "1400", "1.12", "0", "0")), 1):
    _mode = modes[_i - 1]
    _row(f"VIII.mode{_i}", _title, rf"{_span}:\ " + MODE % (_i, _i, _i, _c, _i, _theta, _i, _D),
         {"t_0": (_mode["start_s"], _start), "a": (_mode["a_kn"], "0.00863"), "b": (_mode["b_kn_s_per_m"], "7.295e-6"),
          "c": (_mode["c_kn_s2_per_m2"], f"{_c}e-6"), "theta": (_mode["theta_deg"], _theta), "D_i": (_mode["curve_deg"], _D)},
         note="For the units see VIII.units.")

sine, tunnel, last = stated["disturbances"]["known"]["terms"]
_row("66", "The disturbance of case 1",
     r"d(t) = \begin{cases} 100\sin(0.03t), & t \in [0, 400);\\ 200(1 - e^{-10t}), & t \in [400, 800);\\ 100, & t \in [800, 1400);\\ "
     r"0, & t \in [1400, 2000] \end{cases}",
     {"t_1": (sine["from_s"], "0"), "t_2": (sine["to_s"], "400"), "A_1": (sine["amplitude"], "100"), "omega": (sine["omega_rad_s"], "0.03"),
      "t_3": (tunnel["to_s"], "800"), "A_2": (tunnel["offset"], "200"), "t_4": (last["to_s"], "1400"), "A_3": (last["offset"], "100")},
     reading=" 200(1 - exp(-10 t)) runs as 200, see 66.transient.")
constant, wave, _stopped = stated["failure"]
_row("67", "The failure of case 2",
     r"F_{\alpha} = \begin{cases} 2 \times 10^5, & t \in [600, 1000); \\ 2 \times 10^5 (1 + \sin(0.05t - 30)), & t \in [1000, 1200); \\ 0, & "
     r"t \in [1200, 2000] \end{cases}",
     {"t_1": (constant["from_s"], "600"), "t_2": (constant["to_s"], "1000"), "F_1": (constant["offset"], "200000"),
      "t_3": (wave["to_s"], "1200"), "F_2": (wave["offset"], "200000"), "F_3": (wave["amplitude"], "200000"),
      "omega": (wave["omega_rad_s"], "0.05"), "phi": (wave["phase_rad"], "-30")},
     note="The failed motor pushes with 200 kN, half of what gives the train of 400 t an acceleration of 1 m/s^2.")
rest, (drag_b, drag_c) = stated["rest"][0], stated["drag"]
_row("VIII.rest", "What the failure of case 3 has besides", r"\bar{\delta}_j(t) = 3 \times 10^4\sin(0.07t)",
     {"A": (rest["amplitude"], "30000"), "omega": (rest["omega_rad_s"], "0.07")})
_wind = stated["disturbances"]["unknown"]["terms"][-1]
_row("VIII.case4", "What the disturbance of case 4 has besides", r"d(t) = 100\sin(0.03t) + 500\sin(0.09t), \ldots t \in [800, 1200)",
     {"A": (_wind["amplitude"], "500"), "omega": (_wind["omega_rad_s"], "0.09"), "t_1": (_wind["to_s"], "1200")},
     note="(66) ends at 1400 s, with mode (iii), this disturbance at 1200 s in the middle of it.")
_row("VIII.drag", "The uncertain parameters of case 5", r"\Delta b(t) = 0.001\sin(0.02t),\ \Delta c(t) = 0.001\sin(0.02t)",
     {"A_b": (drag_b["amplitude"], "0.001"), "omega_b": (drag_b["omega_rad_s"], "0.02"), "A_c": (drag_c["amplitude"], "0.001"),
      "omega_c": (drag_c["omega_rad_s"], "0.02")}, note="For their size see VIII.case5.")
_row("VIII.start", "Initial positions and estimates of the five cases",
     r"x(0) = [0.55\ 0]^T, [-0.55\ 0]^T, [0\ 0]^T, [-0.65\ 0]^T, [-0.45\ 0]^T;\quad 90\%, 80\%, 90\%, 90\%, 90\%",
     {f"{_letter}_{_case}": (_of_study[_key], _text) for _letter, _key, _texts in (
         ("x", "initial_position_m", ("0.55", "-0.55", "0", "-0.65", "-0.45")),
         ("p", "estimate_share", ("0.9", "0.8", "0.9", "0.9", "0.9")))
      for _case, (_of_study, _text) in enumerate(zip(cases, _texts, strict=True), 1)})
_row("VIII.gains", "The gains of (27)-(31)", r"\text{The gains of the adaptive laws in (27)-(31) are chosen as 2}",
     {"Gamma": (stated["law"]["gain"], "2")})

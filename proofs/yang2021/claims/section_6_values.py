"""yang2021, section 6: the numbers of train, line and controller, against study.toml and line.toml."""

from __future__ import annotations

from workbench.proof.claim import Goal
from workbench.proof.printed_values import as_printed

from ..paper import paper
from ..stated_values import scenario

STUDY = "The values that the simulation takes for them, from the study's files."
train, track, design = scenario.train, scenario.track, scenario.controllers["rbfnn_pocrac"]
RESISTANCE = as_printed({"a_star": (train.davis_a_mps2, "0.3"), "b_star": (train.davis_b_per_s, "4e-3"),
                         "c_star": (train.davis_c_per_m, "1.6e-4")})
GAINS = as_printed({
    "alpha": (design.parameters["alpha"], "0.5"), "beta": (design.parameters["beta"], "0.51"), "chi": (design.parameters["chi"], "0.1"),
    "k": (design.parameters["k"], "0.21"), **{f"lambda_{i}": (design.parameters[f"lambda_{i}"], "0.01") for i in (1, 2, 3)},
    **{f"sigma_{i}": (design.parameters[f"sigma_{i}"], "0.005") for i in (1, 2, 3)}, "a_0": (design.initial["a_hat"], "0.25"),
    "b_0": (design.initial["b_hat"], "0"), "c_0": (design.initial["c_hat"], "0")})
GRADES, CURVES = ("2", "-1.5", "0", "5", "2.5", "-3", "0", "1.2"), ("1000", "1200", "800", "1500", "700", "1300", "1200")
GRADE_ENDS = ("3800", "9200", "21400", "23900", "29900", "32300", "50000", "53880")
CURVE_ENDS = ("4600", "18000", "24200", "29300", "34000", "48000", "53880")
SECTIONS = {letter: (values, texts) for letter, values, texts in (
    ("p", [s.grade_permille for s in track.grade], GRADES), ("g", [s.end_m for s in track.grade], GRADE_ENDS),
    ("R", [s.radius_m for s in track.curve], CURVES), ("s", [s.end_m for s in track.curve], CURVE_ENDS))}
LINE = as_printed({  # of another line, too, which may have other numbers of sections
    **{f"n_{letter}": (len(values), str(len(texts))) for letter, (values, texts) in SECTIONS.items()},
    **{f"{letter}_{i}": pair for letter, (values, texts) in SECTIONS.items()
       for i, pair in enumerate(zip(values, texts, strict=False), 1)}})


@paper.claim("section6.resistance", "The train that is simulated here has the printed basic resistance", "condition",
             r"a^* = 0.3, b^* = 4 \times 10^{-3}, c^* = 1.6 \times 10^{-4}", "proved", match="words", severity="data", at=RESISTANCE.at,
             rests_on=(), reading=STUDY, note="By (33) they are per unit of mass: 0.3 N/kg at standstill is some ten times what trains have.")
def resistance_as_printed() -> Goal:
    """Three numbers."""
    return RESISTANCE.goal()


@paper.claim("section6.gains", "The controller that is simulated here has the printed gains and first estimates", "condition",
             r"\alpha = 0.5, \beta = 0.51, \lambda_1 = \lambda_2 = \lambda_3 = 0.01, \sigma_1 = \sigma_2 = \sigma_3 = 0.005, \chi = 0.1, k = 0.21, "
             r"\hat{a} = 0.25, \hat{b} = 0, \hat{c} = 0", "proved", match="words", severity="data", at=GAINS.at, rests_on=(), reading=STUDY)
def gains_as_printed() -> Goal:
    """Thirteen numbers of section 6.1."""
    return GAINS.goal()


@paper.claim("table1", "The line that is simulated here has the printed slopes, radii and borders", "condition",
             r"\text{Slope: 2, -1.5, 0, 5, 2.5, -3, 0, 1.2 up to 3800, 9200, 21,400, 23,900, 29,900, 32,300, 50,000, 53,880; curve: 1000, 1200, "
             r"800, 1500, 700, 1300, 1200 up to 4600, 18,000, 24,200, 29,300, 34,000, 48,000, 53,880}", "proved", match="words", severity="data",
             at=LINE.at, rests_on=(), reading=STUDY + " Slopes in per mille, the rest in metres.")
def line_as_printed() -> Goal:
    """Thirty numbers, and how many there are of each kind."""
    return LINE.goal()

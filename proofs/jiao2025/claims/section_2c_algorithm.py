"""Section 2, CFDL-MFAILC: the costs (7), (9), the laws (8), (10)-(12) from them, the reset (13)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, differ, equal, greater, less
from workbench.proof.typed import as_typed

from ..laws import (
    Delta_u,
    Delta_v,
    e_prev,
    epsilon,
    estimate_step,
    eta,
    input_step,
    lamda,
    mu,
    phi,
    phi_first,
    phi_i,
    phi_prev,
    rho,
)
from ..notation import phi_free, v_d, v_next_prev, xi
from ..paper import paper
from ..plant import M, T_s, u_i, u_prev
from ..stated_values import STATED, stated

input_cost = (e_prev - phi * (u_i - u_prev)) ** 2 + lamda * (u_i - u_prev) ** 2
error_before, error_after = v_d - v_next_prev, v_d - (v_next_prev + phi * (u_i - u_prev))  # e(k+1,i-1), and by (6) e(k+1,i)


@paper.claim("7", "Cost of the input", "identity",
             r"J(u_f(k, i)) = |e(k+1, i)|^2 + \lambda |u_f(k, i) - u_f(k, i-1)|^2", "proved", premises=("6",),
             where={"J(u_f(k, i))": input_cost.xreplace({e_prev: error_before}), "e(k+1, i)": error_after},
             reading="J is the cost that is minimised below, written by (6) for the error of the last trial.",
             note="With e(k+1,i) = e(k+1,i-1) - phi_c Delta u(k,i) by (6), the form in which it is minimised.")
def cost_of_input() -> Goal:
    """(7) with e = v_d - v and (6)."""
    speed = v_next_prev + phi * (u_i - u_prev)
    return Goal((equal(input_cost.xreplace({e_prev: error_before}), (v_d - speed) ** 2 + lamda * (u_i - u_prev) ** 2),))


best_input, best_estimate = sp.symbols("u_best phi_best", real=True)


def input_law(error: sp.Expr, given: tuple[Relation, ...] = ()) -> Goal:
    """rho times the step to the minimiser of (7) with the estimate for phi_c, against the printed law."""
    minimal = equal((lamda + phi_i**2) * (best_input - u_prev), phi_i * error)
    return Goal((equal(u_i, u_prev + rho * phi_i / (lamda + phi_i**2) * error),), (minimal, equal(u_i, u_prev + rho * (best_input - u_prev)), *given))


def estimation_law(innovation: sp.Expr, given: tuple[Relation, ...]) -> Goal:
    """eta times the step to the minimiser of (9), against the printed law."""
    minimal = equal((mu + Delta_u**2) * (best_estimate - phi_prev), Delta_u * innovation)
    return Goal((equal(phi_i, phi_prev + eta * Delta_u / (mu + Delta_u**2) * innovation),),
                (minimal, equal(phi_i, phi_prev + eta * (best_estimate - phi_prev)), *given))


def _stationary_input(printed: bool) -> Goal:
    step = input_step(phi_i, e_prev) if printed else input_step(phi, e_prev).xreplace({rho: sp.Integer(1)})
    return Goal((equal(D(input_cost), 0),), (at_most(rho, 1), equal(phi_i, phi), equal(u_i, u_prev + step)), {u_i: sp.Integer(1)})


@paper.claim("8.minimum", "The stationary input is the minimum", "identity",
             r"J(u) - J(u^*) = (\lambda + \phi_c^2)(u - u^*)^2", "proved",
             premises=("7",), origin="ours", note="For rho = 1 and the true phi_c; so (lambda + phi_c^2)(u* - u(k,i-1)) = phi_c e(k+1,i-1), from which (8), (11) and (14) are read.")
def stationary_is_minimum() -> Goal:
    """J(u) against J at the corrected input."""
    best = u_prev + phi / (lamda + phi**2) * e_prev
    return Goal((equal(input_cost - input_cost.xreplace({u_i: best}), (lamda + phi**2) * (u_i - best) ** 2),))


LAW_8 = (r"u_f(k, i) = u_f(k, i-1) + \frac{\rho \hat{\phi}_c(k, i)}{\lambda + |\hat{\phi}_c(k, i)|^2} e(k+1, i-1)")


@paper.claim("8", "(8) from dJ/du = 0", "identity", LAW_8, "proved", premises=("8.minimum",), rests_on=("7",),
             reading="As the text goes on to say: rho is put in afterwards, so the step is rho times that to the minimiser of (7); the estimate stands for phi_c.",
             note="That dJ/du = 0 at (8) itself holds for rho = 1 and a true estimate alone: 8.stationary.")
def stationary_input_law() -> Goal:
    """The minimiser with the estimate, and rho times its step."""
    return input_law(e_prev)


@paper.claim("8.stationary", "dJ/du is zero at (8)", "identity", r"\frac{\partial J}{\partial u_f(k, i)} = 0\ \text{at (8)}", "refuted",
             premises=("7",), origin="ours", severity="cosmetic", correction=lambda: _stationary_input(printed=False),
             corrected_statement=r"u_f(k,i) = u_f(k,i-1) + \frac{\phi_c(k,i)}{\lambda + |\phi_c(k,i)|^2}e(k+1,i-1)",
             note="The derivation to the letter. Even for phi_hat = phi_c the derivative is not zero when rho < 1; the cost falls all the same (8.descent).")
def stationary_input() -> Goal:
    """The derivative of (7) at the input (8)."""
    return _stationary_input(printed=True)


@paper.claim("8.descent", "With the step factor the cost does not rise", "inequality",
             r"0 < \rho \le 1 \Rightarrow J(u_f(k,i)) \le J(u_f(k,i-1))", "proved", premises=("7",), origin="ours",
             note="With the true phi_c in (8). So rho does no harm to (7).")
def step_factor_descends() -> Goal:
    """J at (8) with phi_hat = phi against J without a step."""
    moved = input_cost.xreplace({u_i: u_prev + input_step(phi, e_prev)})
    return Goal((at_most(moved, input_cost.xreplace({u_i: u_prev})),), (at_most(rho, 1),))


estimate_cost = (Delta_v - phi * Delta_u) ** 2 + mu * (phi - phi_prev) ** 2  # (9), differences of trials i-1 and i-2
innovation = Delta_v - phi_prev * Delta_u
prediction_cost = (innovation - (phi - phi_prev) * Delta_u) ** 2 + mu * (phi - phi_prev) ** 2


@paper.claim("9", "Cost of the estimate", "identity",
             r"J(\phi_c(k, i)) = |\Delta v(k+1, i-1) - \phi_c(k, i) \Delta u_f(k, i-1)|^2 + \mu |\phi_c(k, i) - \hat{\phi}_c(k, i-1)|^2", "proved",
             where={r"J(\phi_c(k, i))": prediction_cost}, reading="J is written for the innovation xi of (12), the error of the last estimate's prediction.")
def cost_of_estimate() -> Goal:
    """The prediction's error about the last estimate."""
    return Goal((equal(prediction_cost, (Delta_v - phi * Delta_u) ** 2 + mu * (phi - phi_prev) ** 2),))


@paper.claim("9.minimum", "The stationary estimate is the minimum", "identity",
             r"J(\phi) - J(\phi^*) = (\mu + |\Delta u_f(k,i-1)|^2)(\phi - \phi^*)^2", "proved", premises=("9",), origin="ours",
             note="So (mu + Delta u^2)(phi* - phi_hat(k,i-1)) = Delta u times the innovation, from which (10), (12) and (15) are read.")
def estimate_minimum() -> Goal:
    """J against J at the stationary estimate."""
    best = phi_prev + Delta_u / (mu + Delta_u**2) * (Delta_v - phi_prev * Delta_u)
    other = estimate_cost.xreplace({phi: phi_free})
    return Goal((equal(other - estimate_cost.xreplace({phi: best}), (mu + Delta_u**2) * (phi_free - best) ** 2),))


def _stationary_estimate(printed: bool) -> Goal:
    step = estimate_step(Delta_u, Delta_v - phi_prev * Delta_u)
    step = step if printed else step.xreplace({eta: sp.Integer(1)})
    return Goal((equal(D(estimate_cost), 0),), (at_most(eta, 1), equal(phi, phi_prev + step)), {phi: sp.Integer(1)})


@paper.claim("10", "(10) from the derivative of (9)", "identity",
             r"\hat{\phi}_c(k, i) = \hat{\phi}_c(k, i-1) + \frac{\eta \Delta u_f(k, i-1)}{\mu + |\Delta u_f(k, i-1)|^2} \times "
             r"(\Delta v(k+1, i-1) - \hat{\phi}_c(k, i-1) \Delta u_f(k, i-1))", "proved", premises=("9.minimum",), rests_on=("9",),
             reading="The step is eta times that to the minimiser of (9); eta is put in afterwards, as the text goes on to say. Table 1 has eta = 1.",
             note="The text derives J by phi_hat(k,i), while J is a function of phi_c(k,i).")
def estimate_law() -> Goal:
    """The minimiser of (9), and eta times its step."""
    return estimation_law(innovation, ())


@paper.claim("10.stationary", "dJ/dphi is zero at (10)", "identity", r"\frac{\partial J}{\partial\hat\phi_c(k,i)} = 0\ \text{at (10)}", "refuted",
             premises=("9",), origin="ours", severity="cosmetic", correction=lambda: _stationary_estimate(printed=False),
             corrected_statement=r"\hat\phi_c(k,i) = \hat\phi_c(k,i-1) + \frac{\Delta u_f(k,i-1)}{\mu + "
                                 r"|\Delta u_f(k,i-1)|^2}(\Delta v(k+1,i-1) - \hat\phi_c(k,i-1)\Delta u_f(k,i-1))",
             note="The derivation to the letter holds for eta = 1 alone.")
def stationary_estimate() -> Goal:
    """The derivative of (9) at the estimate (10)."""
    return _stationary_estimate(printed=True)


share_of_new = sp.Symbol("omega", real=True)


@paper.claim("10.lag", "What (10) estimates", "identity",
             r"\hat\phi_c(k,i) - \phi_c(k,i-1) = (1-\omega)(\hat\phi_c(k,i-1) - \phi_c(k,i-1)),\ "
             r"\omega = \frac{\eta\Delta u^2}{\mu + \Delta u^2}", "proved", premises=("5",), origin="ours",
             note="(10) moves towards phi_c of the trial before, while (8) uses it as that of this trial. For the train "
                  "the two differ without bound, since phi_c contains Delta v(k)/Delta u(k).")
def estimate_lags() -> Goal:
    """(10) with Delta v(k+1,i-1) = phi_c(k,i-1) Delta u(k,i-1)."""
    new = phi_prev + estimate_step(Delta_u, phi * Delta_u - phi_prev * Delta_u)
    share = eta * Delta_u**2 / (mu + Delta_u**2)
    return Goal((equal(new - phi, (1 - share) * (phi_prev - phi)),))


@paper.claim("11", "The input law of CFDL-MFAILC", "identity", LAW_8, "proved", premises=("8.minimum",), rests_on=("8",),
             reading="The law is rho times the step to the minimiser of (7) with the estimate for phi_c.", note="(8) once more.")
def algorithm_input() -> Goal:
    """(11) from the minimiser of (7)."""
    return input_law(e_prev)


@paper.claim("12", "The estimation law with the innovation xi", "identity",
             r"\hat{\phi}_c(k, i) = \hat{\phi}_c(k, i-1) + \frac{\eta \Delta u_f(k, i-1)}{\mu + |\Delta u_f(k, i-1)|^2} \times \xi(k+1, i-1)",
             "proved", premises=("10",), reading="(10) with its bracket named xi, as the text below (13) defines it.")
def algorithm_estimate() -> Goal:
    """(10) and the definition of xi."""
    return Goal((equal(phi_i, phi_prev + eta * Delta_u / (mu + Delta_u**2) * xi),), (*paper.shown("10"), equal(xi, innovation)))


with as_typed():  # which keeps that the input has changed
    solved_innovation = estimate_step(Delta_u, innovation) * (mu + Delta_u**2) / (eta * Delta_u)


@paper.claim("12.innovation", "The innovation xi", "identity",
             r"\xi(k+1, i-1) = \Delta v(k+1, i-1) - \hat{\phi}_c(k, i-1) \times \Delta u_f(k, i-1)", "proved", premises=("10",),
             where={r"\xi(k+1, i-1)": solved_innovation},
             reading="A definition; decided as what xi must be for (12) to be the law (10), where the input has changed.")
def innovation_named() -> Goal:
    """(12) solved for xi, with the step of (10)."""
    return Goal((equal(solved_innovation, innovation),), (differ(Delta_u, 0),))


fires, updated, after_reset = sp.symbols("fires phi_updated phi_reset", real=True)


@paper.claim("13", "The reset of the estimate", "implication",
             r"\hat{\phi}_c(k, i) = \hat{\phi}_c(k, 1), \begin{cases} |\hat{\phi}_c(k, i)| \leq \varepsilon, \text{ or} \\ |\Delta u_f(k, i-1)| \leq \varepsilon, \text{ or} \\ "
             r"\text{sign}(\hat{\phi}_c(k, i)) \neq \text{sign}(\hat{\phi}_c(k, 1)), \end{cases}", "proved",
             where={r"\hat{\phi}_c(k, i)": after_reset},
             reading="An assignment: where one of the three tests fires the first estimate is put in the place of that of (12). As an equation for one and the same number it could not hold.",
             note="A definition. What it is for is 13.keeps.")
def reset_law() -> Goal:
    """The estimate in use after a test has fired."""
    return Goal((equal(after_reset, phi_first),), (equal(after_reset, fires * phi_first + (1 - fires) * updated), equal(fires, 1)))


least_estimate = sp.Symbol("m", positive=True)  # min(epsilon, phi_hat(k,1))
small_epsilon = equal(epsilon, sp.Rational(STATED[epsilon].numerator, STATED[epsilon].denominator))  # that of Table 1


def _kept(shown: Relation, *first: Relation) -> Goal:
    """The estimate in use: the first one where a test of (13) has fired, else one that has passed all three."""
    passed = (at_least((1 - fires) * (updated - epsilon), 0), at_least((1 - fires) * updated * phi_first, 0))
    return Goal((shown,), (equal(after_reset, fires * phi_first + (1 - fires) * updated), at_least(fires, 0), at_most(fires, 1), *passed, *first))


KEPT = r"\hat\phi_c(k,i) \ge \min(\varepsilon, \hat\phi_c(k,1)) > 0"


@paper.claim("13.keeps", "After (13) the estimate is positive and away from zero", "implication", KEPT, "gap",
             premises=("13",), origin="implied", reading="What Theorem 1 needs of (13), with phi_c > 0; decided as the least of it, that the estimate is positive. An estimate in use is the first one, where a test fires, or has passed the three tests. epsilon is that of Table 1.",
             note="It holds when the first estimate is positive, 13.mended, which the paper does not ask for: the control direction is known, by Remark 4, but phi_hat(k,1) is stated nowhere, not in section 4 "
                  "either. With phi_hat(k,1) = 0 the estimate is 0 for ever; with a negative one it stays negative. The Conclusion needs it too, as its analysis is Theorem 1 and its mended form asks for phi_hat(k,1) > 0; it is not named above because it fails with a positive estimate as well.")
def reset_keeps_away() -> Goal:
    """A reset to a first estimate of any size and sign."""
    return _kept(greater(after_reset, 0), small_epsilon)


@paper.claim("13.mended", "A positive first estimate keeps the estimate positive and away from zero", "implication",
             r"\hat\phi_c(k,1) > 0 \Rightarrow " + KEPT, "proved", premises=("13",), origin="ours", mends="13.keeps",
             reading="m is at most epsilon and at most phi_hat(k,1). An estimate in use is the first one, where a test fires, or has passed the three tests; fires is 1 or 0.")
def reset_mended() -> Goal:
    """A reset to a positive first estimate."""
    return _kept(at_least(after_reset, least_estimate), at_most(least_estimate, epsilon), at_least(phi_first, least_estimate))


@paper.claim("13.keeps.N", "An estimate that is dv(k+1)/du(k) would not pass (13) (u in N)", "condition",
             r"\frac{\partial v(k+1,i)}{\partial u_f(k,i)} = \frac{T_s}{M} \le \varepsilon", "proved", premises=("A1",), at=stated(T_s, M, epsilon), origin="ours", severity="data", section="4",
             note="With u in N dv(k+1)/du(k) is 2.9e-7 and epsilon 1e-5, one number for |phi_hat|, in m/s per N, and for |Delta u|, in N. It concerns the first samples: phi_hat estimates phi_c, which is T_s/M at "
                  "the first sample and grows with k where inputs change alike, beyond epsilon from about k = 35 on.")
def derivative_is_dropped() -> Goal:
    """T_s/M against epsilon."""
    return Goal((at_most(T_s / M, epsilon),))


other_weight = sp.Symbol("lamda_smaller", positive=True)


@paper.claim("lambda.response", "Section 4: the smaller lambda, the further an error moves the input", "inequality",
             r"\lambda' < \lambda \Rightarrow \frac{\rho\hat\phi_c}{\lambda' + \hat\phi_c^2}e > \frac{\rho\hat\phi_c}{\lambda + \hat\phi_c^2}e,\quad \hat\phi_c, e > 0", "proved", premises=("8",), origin="ours",
             note="At the same estimate. It is no faster response where the input already moves too far: the error falls slower from there on.")
def smaller_weight_moves_more() -> Goal:
    """The step of (8) for two weights, a positive estimate and error."""
    positive = (greater(phi_i, 0), greater(e_prev, 0))
    return Goal((greater(input_step(phi_i, e_prev).xreplace({lamda: other_weight}), input_step(phi_i, e_prev)),), (less(other_weight, lamda), *positive))


@paper.claim("lambda.zero", "Section 4: without lambda the learning may oscillate and diverge", "implication",
             r"\lambda = 0,\ \hat\phi_c \le \tfrac{\rho}{2}\phi_c \Rightarrow e(k+1,i) = (1 - g)\,e(k+1,i-1),\ 1 - g \le -1", "proved", premises=("6", "8"), origin="ours",
             note="The text: with lambda = 0 the system mostly oscillates or even loses stability. For the data model it does where the estimate is below rho phi_c/2; with "
                  "a true estimate and rho <= 1 it does not.")
def no_weight() -> Goal:
    """The factor of the error at lambda = 0."""
    factor = 1 - rho * phi / phi_i
    return Goal((at_most(factor, -1),), (greater(phi_i, 0), at_least(rho * phi, 2 * phi_i)))


paper.axiom("lambda.overshoot", "Section 4: the smaller lambda, the larger the overshoot; without it the learning oscillates or diverges",
            r"\text{the smaller } \lambda, \text{ the faster the response of the system, but its overshoot grows [...]. With } \lambda = 0 "
            r"\text{ the system oscillates in most cases or even loses stability.}",
            "the paper's [5], Hou and Jin 2013", hypotheses=(), match="words", severity="cosmetic",
            note="Said 'in general', of model-free adaptive control. What of it can be decided for the laws here: lambda.response and lambda.zero.")

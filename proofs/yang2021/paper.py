"""yang2021: every claim of sections 3 to 5, and the stated gains of section 6.

J. Yang, Y. Zhang, Y. Jin, Fully Automatic Operation Algorithm of Urban Rail Train Based on RBFNN Position
Output Constrained Robust Adaptive Control, Algorithms 14 (2021) 264.

The plant and the laws come from the workbench, where the simulation takes them from; V is (38). Derivatives
are written D(...) and derived along the closed loop. What stands on the right of `equal` and `at_most` is
what the paper prints.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import sympy as sp

from workbench.model.desired_curve import DavisCruise, davis_cruise_speed
from workbench.model.law import desired_acceleration as xddot_d
from workbench.model.law import desired_position as x_d
from workbench.model.law import desired_speed as xdot_d
from workbench.model.law import neuron, over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, differ, equal, greater, less
from workbench.proof.derive import lie_derivative
from workbench.proof.paper import Paper
from workbench.trains.scenario import load_scenario
from workbench.trains.track import additional_specific_resistance, curvature_per_m, grade_permille, tunnel_n_per_kn
from workbench.trains.train import (
    F,
    a_0,
    a_star,
    b_0,
    b_star,
    c_0,
    c_star,
    f,
    f_add,
    m,
    single_particle,
    single_particle_per_mass,
    u,
    v,
)

from . import laws as law
from . import rbf_pid as gradient
from .laws import alpha, beta, chi, k, x_1, x_2

paper = Paper("yang2021", " ".join((__doc__ or "").split("\n\n")[1].split()))

EVERY_NETWORK = "every number of neurons and every hidden function (term by term under the sum)"
scenario = load_scenario(Path(__file__).with_name("study.toml"))
assert isinstance(scenario.reference, DavisCruise)


def rational(value: float) -> Fraction:
    """A stated decimal as the exact number that is printed."""
    return Fraction(str(value))


# --- the closed loop in error coordinates -----------------------------------------------------------------

lambdas = (law.lambda_1, law.lambda_2, law.lambda_3)
sigmas = (law.sigma_1, law.sigma_2, law.sigma_3)
stars = (a_star, b_star, c_star)
hats = (law.a_hat, law.b_hat, law.c_hat)
tildes = sp.symbols("a_tilde b_tilde c_tilde", real=True)
e_1, e_2, epsilon, y_f = sp.symbols("e_1 e_2 epsilon y_f", real=True)
eps_star = sp.Symbol("epsilon_star", nonnegative=True)
W_tilde = sp.IndexedBase("W_tilde", real=True)[neuron]
W_star = sp.IndexedBase("W_star", real=True)[neuron]
h = sp.IndexedBase("h", real=True)[neuron]  # any hidden function, the Gaussian (5) among them

plant = single_particle_per_mass()
f_true = over_neurons(W_star * h) + epsilon  # (7)
rates = {x_1: plant.rates[x_1], x_2: plant.rates[x_2].xreplace({u: law.rbfnn_pocrac.command, f: f_true}),
         x_d: xdot_d, xdot_d: xddot_d}
rates |= {s.symbol: s.rate for s in law.rbfnn_pocrac.states}
to_errors = {x_1: e_1 + x_d, x_2: e_2 - alpha * e_1 + xdot_d, law.W_hat: W_tilde + W_star}
to_errors |= {hat: tilde + star for hat, tilde, star in zip(hats, tildes, stars, strict=True)}


def in_errors(expr: sp.Expr) -> sp.Expr:
    """An expression of the closed loop in e_1, e_2 and the estimation errors."""
    return sp.expand(expr.xreplace({law.h: h}).xreplace(to_errors))


x_2_errors = in_errors(x_2)
flow = {e_1: in_errors(lie_derivative(law.e_1, rates)), e_2: in_errors(lie_derivative(law.e_2, rates))}
flow |= {tilde: in_errors(rates[hat]) for tilde, hat in zip(tildes, hats, strict=True)}
flow[W_tilde] = in_errors(rates[law.W_hat])

inside = greater(k**2 - e_1**2, 0)
barrier = k**2 / (k**2 - e_1**2)
V_1 = sp.log(barrier) / 2  # (20)
V_2 = V_1 + e_2**2 / 2  # (30)
V_weights = over_neurons(W_tilde**2 / (2 * chi))
V_estimates = sum((tilde**2 / (2 * lam) for tilde, lam in zip(tildes, lambdas, strict=True)), sp.Integer(0))
V = V_2 + V_weights + V_estimates  # (38)

# Before the control law is put in, u is free: (26)-(32).
open_rates = {x_1: x_2, x_2: plant.rates[x_2], x_d: xdot_d, xdot_d: xddot_d}
speed_error_rate_printed = u - a_star - b_star * x_2 - c_star * x_2**2 + f - law.rdot  # the right side of (25)

# --- section 2 ------------------------------------------------------------------------------------------------


@paper.claim("4", "The train per unit of mass", "identity",
             r"\dot x_2 = u + g + f(x),\ u = \tfrac{F}{m},\ g = -\tfrac{g(x_2)}{m},\ f(x) = -\tfrac{f(x_1,x_2,t)}{m}",
             "proved")
def newton_per_mass() -> Goal:
    """(1) with (2), divided by m, is (4)."""
    newton = single_particle().rates[v].xreplace({v: x_2})
    per_mass = plant.rates[x_2].xreplace({
        u: F / m, f: -f_add / m, a_star: a_0 / m, b_star: b_0 / m, c_star: c_0 / m})
    return Goal((equal(newton, per_mass),))


stated_davis = {s: rational(value) for s, value in zip(
    stars, (scenario.train.davis_a_mps2, scenario.train.davis_b_per_s, scenario.train.davis_c_per_m), strict=True)}


@paper.claim("A1", "Assumption 1: (4) is input-to-state stable, so the origin is an equilibrium", "condition",
             r"u = 0,\ f = 0:\quad \dot x_2 = 0\ \text{at}\ x_1 = x_2 = 0", "violated",
             at={**stated_davis, x_2: Fraction(0), u: Fraction(0), f: Fraction(0)},
             note="Input-to-state stability needs the origin to be an equilibrium without input. By (2) the "
                  "resistance does not vanish at standstill, so the train of (4) starts to roll backwards at "
                  "0.3 m/s^2. The proof of Theorem 1 does not use Assumption 1.")
def origin_is_equilibrium() -> Goal:
    """The origin is an equilibrium of (4) without input."""
    return Goal((equal(D(x_2), 0),), flow={x_2: plant.rates[x_2]})


# --- section 3: the network -----------------------------------------------------------------------------------

error_f, weight, rest_f, eta, varpi = sp.symbols("f w f_rest eta varpi", real=True)
width = sp.Symbol("b_j", positive=True)
x_i, c_ji, q_rest, squared = sp.symbols("x_i c_ji q_rest q", real=True)


def loss(hidden: sp.Expr) -> sp.Expr:
    """(9) with the other neurons' output gathered in f_rest."""
    return (error_f - weight * hidden - rest_f) ** 2 / 2


def residual(hidden: sp.Expr) -> sp.Expr:
    """f - f_hat."""
    return error_f - weight * hidden - rest_f


@paper.claim("10", "Gradient step of a weight", "identity", r"\Delta w_j = \eta\,[f - \hat f]\,h_j", "proved",
             scope="every number of neurons and inputs")
def weight_gradient() -> Goal:
    """-eta dE/dw_j of (9), the other neurons gathered in one term."""
    hidden = sp.Symbol("h_j", real=True)
    step = gradient.weight_step(eta, residual(hidden), hidden)
    return Goal((equal(-eta * D(loss(hidden)), step),), flow={weight: sp.Integer(1)})


@paper.claim("12", "Gradient step of a width", "identity",
             r"\Delta b_j = \eta\,[f - \hat f]\,w_j h_j \frac{\|x - c_j\|^2}{b_j^3}", "proved",
             scope="every number of neurons and inputs")
def width_gradient() -> Goal:
    """-eta dE/db_j of (9) with (5); q is the squared distance, of any dimension."""
    hidden = sp.exp(-squared / (2 * width**2))
    step = gradient.width_step(eta, residual(hidden), weight, hidden, squared, width)
    return Goal((equal(-eta * D(loss(hidden)), step),), (greater(width, 0),), {width: sp.Integer(1)})


def _center_goal(printed: bool) -> Goal:
    hidden = sp.exp(-((x_i - c_ji) ** 2 + q_rest) / (2 * width**2))
    step = gradient.center_step_as_printed if printed else gradient.center_step
    stated = step(eta, residual(hidden), weight, hidden, x_i, c_ji, width)
    return Goal((equal(-eta * D(loss(hidden)), stated),), flow={c_ji: sp.Integer(1)})


@paper.claim("14", "Gradient step of a center", "identity",
             r"\Delta c_{ji} = \eta\,[f - \hat f]\,w_j h_j \frac{x_i - c_{ji}^2}{b_j^2}", "refuted",
             scope="every number of neurons and inputs",
             correction=lambda: _center_goal(printed=False),
             corrected_statement=r"\Delta c_{ji} = \eta\,[f - \hat f]\,w_j h_j \frac{x_i - c_{ji}}{b_j^2}",
             note="The square on c_ji is an error: it adds metres to square metres.")
def center_gradient() -> Goal:
    """-eta dE/dc_ji of (9) with (5), the other inputs' distance gathered in one term."""
    return _center_goal(printed=True)


def _momentum(equation: str, quantity: str, step_of: str) -> None:
    value, step = sp.symbols(f"{quantity} Delta", real=True)

    @paper.claim(equation, f"Momentum update of {step_of} (a definition)", "identity",
                 rf"{quantity}(t) = {quantity}(t-1) + \Delta {quantity} + \varpi[{quantity}(t-1) - {quantity}(t-2)]",
                 "proved", premises=({"11": "10", "13": "12", "15": "14"}[equation],),
                 note="Decided: a parameter at rest, (t-1) = (t-2), moves by exactly the gradient step, so it "
                      "rests just where the gradient vanishes, whatever the momentum factor.")
    def at_rest() -> Goal:
        moved = gradient.with_momentum(value, step, varpi, value)
        return Goal((equal(moved - value, step),))


_momentum("11", "w_j", "a weight")
_momentum("13", "b_j", "a width")
_momentum("15", "c_ji", "a center")


@paper.claim("17", "Approximation error", "identity",
             r"\tilde f = W^{*T}h + \varepsilon - \hat W^T h = -\tilde W^T h + \varepsilon", "proved",
             scope=EVERY_NETWORK)
def approximation_error() -> Goal:
    """f - f_hat with (7), (16) and W_tilde = W_hat - W_star."""
    f_hat = law.f_hat.xreplace({law.h: h}).xreplace({law.W_hat: W_tilde + W_star})
    return Goal((equal(f_true - f_hat, -over_neurons(W_tilde * h) + epsilon),))


def _section_resistances() -> list[Fraction]:
    """Additional resistance (N per kg) of the sections of Table 1 in their order, exact."""
    def at(position: float) -> Fraction:
        grade = next(s.grade_permille for s in scenario.track.grade if s.start_m <= position < s.end_m)
        radius = next(s.radius_m for s in scenario.track.curve if s.start_m <= position < s.end_m)
        value = additional_specific_resistance().subs({
            grade_permille: sp.Rational(str(grade)), curvature_per_m: 1 / sp.Rational(str(radius)),
            tunnel_n_per_kn: 0})
        return Fraction(int(value.p), int(value.q))

    borders = sorted({s.start_m for s in (*scenario.track.grade, *scenario.track.curve)})
    return [at(border) for border in borders]


def _largest_jump() -> tuple[Fraction, Fraction]:
    """Resistance just before and after the border with the largest jump in Table 1."""
    return max(pairwise(_section_resistances()), key=lambda pair: abs(pair[0] - pair[1]))


before_jump, after_jump = _largest_jump()
f_star = sp.Symbol("f_star", positive=True)


@paper.claim("A2", "Assumption 2: f is bounded on the line of Table 1", "condition",
             r"|f(x)| \le f^*", "proved", at={f_star: Fraction(6, 100)},
             note="With f* = 0.06 m/s^2, on every section of Table 1; the disturbance that the paper adds is not described.")
def resistance_bounded() -> Goal:
    """Grade and curve resistance of every section against f*."""
    values = [sp.Rational(x.numerator, x.denominator) for x in _section_resistances()]
    return Goal((at_most(max(values), f_star), at_least(min(values), -f_star)))


f_before, f_after = sp.symbols("f_before f_after", real=True)

paper.axiom("7", "Universal approximation by the network",
            r"f(x) = W^{*T}h(x) + \varepsilon(x),\ |\varepsilon(x)| \le \varepsilon^*\ \text{on the compact}\ \Theta_x",
            "Park and Sandberg 1991, for f continuous on a compact set", hypotheses=("7.continuous", "7.inside"))


@paper.claim("7.continuous", "f is continuous in x on the line of Table 1", "condition",
             r"\lim_{x_1 \uparrow s} f = \lim_{x_1 \downarrow s} f", "violated",
             at={f_before: before_jump, f_after: after_jump},
             note="At the border with the largest jump. Grade and curve change in steps in Table 1, so f is not "
                  "continuous and eps* cannot be made small.")
def resistance_is_continuous() -> Goal:
    """The additional resistance on both sides of a section border agrees."""
    return Goal((equal(f_before, f_after),))


@paper.claim("7.error", "What a step in f costs the approximation", "inequality",
             r"|f(s^\pm) - y| \le \varepsilon^* \Rightarrow \varepsilon^* \ge \tfrac12 |f(s^+) - f(s^-)|", "proved")
def step_costs_half() -> Goal:
    """A continuous output y misses one side of a step by half of it."""
    near = tuple(rel for side in (f_before, f_after)
                 for rel in (at_most(side - y_f, eps_star), at_most(y_f - side, eps_star)))
    return Goal((at_most(f_after - f_before, 2 * eps_star), at_most(f_before - f_after, 2 * eps_star)), near)


x_out, theta = sp.symbols("x theta", real=True)


@paper.claim("7.inside", "The state stays in the set on which (7) holds", "implication",
             r"|\varepsilon(x)| \le \varepsilon^*\ \text{for}\ x \in \Theta_x \Rightarrow "
             r"|\varepsilon(x(t))| \le \varepsilon^*\ \text{for all}\ t", "gap",
             note="The proof uses |eps(x(t))| <= eps* for all t, which holds only while x(t) stays in Theta_x; that "
                  "it does is not shown, and cannot be concluded afterwards from a bound that uses it. In the "
                  "model: Theta_x = [-theta, theta], eps(x) = eps* x^2/theta^2.")
def state_stays_inside() -> Goal:
    """An error that is bounded inside a set may be larger outside."""
    inside_theta = (greater(theta, 0), equal(epsilon, eps_star * x_out**2 / theta**2))
    return Goal((at_most(epsilon, eps_star),), inside_theta)


# --- section 4: the barrier -----------------------------------------------------------------------------------


@paper.claim("20", "V_1 is positive definite", "inequality",
             r"V_1(0) = 0,\quad V_1(e_1) > 0\ (0 < |e_1| < k)", "proved")
def barrier_positive() -> Goal:
    """V_1 > 0 away from zero."""
    return Goal((greater(V_1, 0),), (inside, differ(e_1, 0)))


@paper.claim("20.zero", "V_1 vanishes at zero", "identity", r"V_1(0) = 0", "proved")
def barrier_zero() -> Goal:
    """V_1 at e_1 = 0."""
    return Goal((equal(V_1.xreplace({e_1: sp.Integer(0)}), 0),))


level = sp.Symbol("B", nonnegative=True)


@paper.claim("20.barrier", "V_1 grows beyond every bound at the constraint", "limit",
             r"e_1 \to \pm k \Rightarrow V_1(e_1) \to \infty", "proved",
             note="Decided with the distance named: V_1 >= B as soon as e_1^2 >= k^2 (1 - exp(-2B)), for every B.")
def barrier_unbounded() -> Goal:
    """V_1 >= B close enough to the constraint, for every B."""
    close = at_least(e_1**2, k**2 * (1 - sp.exp(-2 * level)))
    return Goal((at_least(V_1, level),), (inside, close), facts=(2 * level - sp.log(barrier),))


@paper.claim("20.band", "k = 0.21 constrains the position error to 0.2 m", "implication",
             r"|e_1| < k = 0.21 \Rightarrow |e_1| \le 0.2", "gap",
             note="The text constrains the error to 0.2 m 'due to |e_1| < k; taking k = 0.21'. The barrier at k "
                  "only keeps the error below 0.21 m.")
def band_from_barrier() -> Goal:
    """|e_1| < 0.21 does not bring |e_1| <= 0.2."""
    given = (equal(k, sp.Rational(21, 100)), less(e_1, k), greater(e_1, -k))
    return Goal((at_most(e_1**2, sp.Rational(1, 25)),), given)


def _lemma_2(strict: bool) -> Goal:
    relation = less if strict else at_most
    return Goal((relation(sp.log(barrier), e_1**2 / (k**2 - e_1**2)),), (inside,))


@paper.claim("21", "Lemma 2", "inequality",
             r"\log\frac{k^2}{k^2 - e_1^2} < \frac{e_1^2}{k^2 - e_1^2}", "refuted",
             correction=lambda: _lemma_2(strict=False),
             corrected_statement=r"\log\frac{k^2}{k^2 - e_1^2} \le \frac{e_1^2}{k^2 - e_1^2}",
             note="Both sides are 0 at e_1 = 0, which the lemma's domain contains. The non-strict form holds and is "
                  "all that the proof needs.")
def lemma_2() -> Goal:
    """The strict inequality as printed."""
    return _lemma_2(strict=True)


c_low, c_high = sp.symbols("chi_low chi_high", positive=True)
V_rest = e_2**2 / 2 + V_weights + V_estimates
all_squares = e_2**2 + over_neurons(W_tilde**2) + sum((s**2 for s in tildes), sp.Integer(0))


@paper.claim("lemma1.2", "Hypothesis 2 of Lemma 1: V_2 lies between class K-infinity functions", "inequality",
             r"\chi_1(\|e_2\|) \le V_2(e_2) \le \chi_2(\|e_2\|)", "proved", scope=EVERY_NETWORK,
             note="In Theorem 1 V_2 is all of V but V_1, and e_2 stands for (e_2, W_tilde, a_tilde, b_tilde, "
                  "c_tilde). Decided for chi_1 = c_low |.|^2 and chi_2 = c_high |.|^2 with the smallest and "
                  "largest weight.")
def between_comparison_functions() -> Goal:
    """Quadratic bounds of V - V_1."""
    weights = (chi, *lambdas)
    low = (at_most(c_low, sp.Rational(1, 2)), *(at_most(2 * c_low * w, 1) for w in weights))
    high = (at_least(c_high, sp.Rational(1, 2)), *(at_least(2 * c_high * w, 1) for w in weights))
    return Goal((at_least(V_rest, c_low * all_squares), at_most(V_rest, c_high * all_squares)), (*low, *high))


start_error = sp.Symbol("e_1_0", real=True)
stated_k = rational(scenario.controllers["rbfnn_pocrac"].parameters["k"])


@paper.claim("lemma1.0", "The stated initial state is inside the constraint", "condition", r"|e_1(0)| < k", "proved",
             at={start_error: Fraction(0), k: stated_k},
             note="x_1(0) = 0 is stated, and the desired curve starts at 0.")
def starts_inside() -> Goal:
    """At the stated initial state and k."""
    return Goal((less(start_error, k), greater(start_error, -k)))


paper.axiom("lemma1", "Lemma 1: a barrier function that obeys (19) keeps the constraint",
            r"|e_1(0)| < k,\ \dot V \le -\mu V + l \Rightarrow |e_1(t)| < k\ \forall t \ge 0",
            "Ren, Ge, Tee and Lee 2010 (the paper's [28])", hypotheses=("lemma1.0", "20.barrier", "lemma1.2", "51"),
            note="It supposes that solutions exist; with the steps of Table 1 in f they do in Caratheodory's sense.")

# --- section 5.1: design --------------------------------------------------------------------------------------


@paper.claim("24", "Rate of the position error", "identity", r"\dot e_1 = x_2 - \dot x_d", "proved")
def position_error_rate() -> Goal:
    """D(e_1) of (22) along (4)."""
    return Goal((equal(D(law.e_1), x_2 - xdot_d),), flow={x_1: x_2, x_d: xdot_d})


@paper.claim("25", "Rate of the speed error", "identity",
             r"\dot e_2 = u - \tfrac{a_0}{m} - \tfrac{b_0}{m}x_2 - \tfrac{c_0}{m}x_2^2 + f(x) - \dot r", "proved",
             premises=("4", "28"))
def speed_error_rate() -> Goal:
    """D(e_2) of (23) along (4), with r of (27) and its rate (28)."""
    return Goal((equal(D(law.e_2), speed_error_rate_printed),), flow=open_rates)


@paper.claim("26", "Rate of V_1", "identity",
             r"\dot V_1 = \frac{e_1\dot e_1}{k^2 - e_1^2} = \frac{e_1(e_2 + r - \dot x_d)}{k^2 - e_1^2}", "proved",
             premises=("20", "24"))
def barrier_rate() -> Goal:
    """D(V_1) with e_1' = e_2 + r - x_d' for any virtual law r."""
    virtual = sp.Symbol("r", real=True)
    return Goal((equal(D(V_1), e_1 * D(e_1) / (k**2 - e_1**2)),
                 equal(D(V_1), e_1 * (e_2 + virtual - xdot_d) / (k**2 - e_1**2))), (inside,),
                {e_1: e_2 + virtual - xdot_d})


@paper.claim("28", "Rate of the virtual law", "identity", r"\dot r = -\alpha\dot e_1 + \ddot x_d", "proved",
             premises=("24",))
def virtual_law_rate() -> Goal:
    """D(r) of (27)."""
    return Goal((equal(D(law.r), -alpha * (x_2 - xdot_d) + xddot_d),),
                flow={x_1: x_2, x_d: xdot_d, xdot_d: xddot_d})


V_1_rate = -alpha * e_1**2 / (k**2 - e_1**2) + e_1 * e_2 / (k**2 - e_1**2)


@paper.claim("29", "Rate of V_1 under the virtual law", "identity",
             r"\dot V_1 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2}", "proved",
             premises=("26",))
def barrier_rate_closed() -> Goal:
    """D(V_1) along the closed loop."""
    return Goal((equal(D(V_1), V_1_rate),), (inside,), {e_1: flow[e_1]})


e_2_rate = sp.Symbol("edot_2", real=True)


@paper.claim("31", "Rate of V_2", "identity",
             r"\dot V_2 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2} + e_2\dot e_2", "proved",
             premises=("29",))
def v2_rate() -> Goal:
    """D(V_2) with e_2' free."""
    return Goal((equal(D(V_2), V_1_rate + e_2 * e_2_rate),), (inside,), {e_1: flow[e_1], e_2: e_2_rate})


@paper.claim("32", "Rate of V_2 with the plant", "identity",
             r"\dot V_2 = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2} + e_2\left[u - "
             r"\tfrac{a_0}{m} - \tfrac{b_0}{m}x_2 - \tfrac{c_0}{m}x_2^2 + f(x) - \dot r\right]", "proved",
             premises=("25", "31"))
def v2_rate_plant() -> Goal:
    """D(V_2) along (4) with u free."""
    along = {e_1: flow[e_1], e_2: in_errors(lie_derivative(law.e_2, open_rates))}
    return Goal((equal(D(V_2), V_1_rate + e_2 * in_errors(speed_error_rate_printed)),), (inside,), along)


# --- section 5.2: stability -----------------------------------------------------------------------------------



@paper.claim("38", "V is not negative", "inequality", r"V \ge 0", "proved", premises=("20",), scope=EVERY_NETWORK)
def lyapunov_not_negative() -> Goal:
    """The barrier and squares with positive weights."""
    return Goal((at_least(V, 0),), (inside,))


estimate_rates = sp.symbols("adot_hat bdot_hat cdot_hat", real=True)
W_rate = sp.IndexedBase("Wdot_hat", real=True)[neuron]


@paper.claim("39", "Rate of V before the laws are put in", "identity",
             r"\dot V = -\frac{\alpha e_1^2}{k^2 - e_1^2} + \frac{e_1 e_2}{k^2 - e_1^2} + e_2\dot e_2 + "
             r"\tfrac1\chi\tilde W^T\dot{\tilde W} + \tfrac1{\lambda_1}\tilde a\dot{\tilde a} + "
             r"\tfrac1{\lambda_2}\tilde b\dot{\tilde b} + \tfrac1{\lambda_3}\tilde c\dot{\tilde c}", "proved",
             premises=("31",), scope=EVERY_NETWORK)
def v_rate_open() -> Goal:
    """D(V) with free rates of e_2 and of the estimates."""
    along = {e_1: flow[e_1], e_2: e_2_rate, W_tilde: W_rate, **dict(zip(tildes, estimate_rates, strict=True))}
    stated = V_1_rate + e_2 * e_2_rate + over_neurons(W_tilde * W_rate / chi) + sum(
        (x * rate / lam for x, rate, lam in zip(tildes, estimate_rates, lambdas, strict=True)), sp.Integer(0))
    return Goal((equal(D(V), stated),), (inside,), along)


resistance_error = tildes[0] + tildes[1] * x_2_errors + tildes[2] * x_2_errors**2


@paper.claim("40", "Rate of the speed error in closed loop", "identity",
             r"\dot e_2 = \tilde a + \tilde b x_2 + \tilde c x_2^2 - \beta e_2 - \frac{e_1}{k^2 - e_1^2} - "
             r"\tilde W^T h(x) + \varepsilon(x)", "proved", premises=("17", "25"), scope=EVERY_NETWORK)
def speed_error_rate_closed() -> Goal:
    """D(e_2) with (33) put in."""
    stated = resistance_error - beta * e_2 - e_1 / (k**2 - e_1**2) - over_neurons(W_tilde * h) + epsilon
    return Goal((equal(D(e_2), stated),), (inside,), flow)


leak = [sigma * tilde * (tilde + star) for sigma, tilde, star in zip(sigmas, tildes, stars, strict=True)]
V_rate = (-alpha * e_1**2 / (k**2 - e_1**2) - beta * e_2**2 + e_2 * epsilon
          - over_neurons(W_tilde * (W_tilde + W_star)) - sum(leak, sp.Integer(0)))


@paper.claim("41", "Rate of V in closed loop", "identity",
             r"\dot V = -\frac{\alpha e_1^2}{k^2 - e_1^2} - \beta e_2^2 + e_2\varepsilon(x) - \tilde W^T\hat W - "
             r"\sigma_1\tilde a\hat a - \sigma_2\tilde b\hat b - \sigma_3\tilde c\hat c", "proved",
             premises=("39", "40"), scope=EVERY_NETWORK,
             note="The text has a dotted W-tilde in the last terms of (41) and on the left of (44); (37), and the "
                  "middle of (44), force W-hat, which is read here.")
def v_rate_closed() -> Goal:
    """D(V) along the whole closed loop, from (38), (4), (33)-(37)."""
    return Goal((equal(D(V), V_rate),), (inside,), flow)


def _step_42(strict: bool) -> Goal:
    relation = less if strict else at_most
    return Goal((relation(-alpha * e_1**2 / (k**2 - e_1**2), -alpha * sp.log(barrier)),), (inside,))


@paper.claim("42", "Lemma 2 applied", "inequality",
             r"-\frac{\alpha e_1^2}{k^2 - e_1^2} < -\alpha\log\frac{k^2}{k^2 - e_1^2}", "refuted", premises=("21",),
             correction=lambda: _step_42(strict=False),
             corrected_statement=r"-\frac{\alpha e_1^2}{k^2 - e_1^2} \le -\alpha\log\frac{k^2}{k^2 - e_1^2}",
             note="As Lemma 2: equality at e_1 = 0.")
def step_42() -> Goal:
    """The strict inequality as printed."""
    return _step_42(strict=True)


error_bound = (at_most(epsilon, eps_star), at_least(epsilon, -eps_star))


@paper.claim("43", "Young's inequality for the approximation error", "inequality",
             r"e_2\varepsilon(x) \le \tfrac12 e_2^2 + \tfrac12\varepsilon^{*2}", "proved", premises=("7",))
def young_error() -> Goal:
    """With |epsilon| <= epsilon*."""
    return Goal((at_most(e_2 * epsilon, e_2**2 / 2 + eps_star**2 / 2),), error_bound)


@paper.claim("44", "Young's inequality for the weights", "inequality",
             r"-\tilde W^T\hat W = -\tilde W^T\tilde W - \tilde W^T W^* \le -\tfrac12\tilde W^T\tilde W + "
             r"\tfrac12 W^{*2}", "proved", scope=EVERY_NETWORK,
             note="W-hat is read on the left, see (41).")
def young_weights() -> Goal:
    """Term by term under the sum; both the equality and the bound."""
    left = -over_neurons(W_tilde * (W_tilde + W_star))
    middle = -over_neurons(W_tilde**2) - over_neurons(W_tilde * W_star)
    return Goal((equal(left, middle),
                 at_most(left, -over_neurons(W_tilde**2) / 2 + over_neurons(W_star**2) / 2)))


def _young_estimate(equation: str, i: int, name: str) -> None:
    sigma, tilde, star = sigmas[i], tildes[i], stars[i]
    n = i + 1

    @paper.claim(equation, f"Young's inequality for the estimate of {name}", "inequality",
                 rf"-\sigma_{n}\tilde {name}\hat {name} \le -\tfrac12\sigma_{n}\tilde {name}^2 + "
                 rf"\tfrac12\sigma_{n} {name}^{{*2}}", "proved")
    def young() -> Goal:
        return Goal((at_most(-leak[i], -sigma * tilde**2 / 2 + sigma * star**2 / 2),))


_young_estimate("45", 0, "a")
_young_estimate("46", 1, "b")
_young_estimate("47", 2, "c")

W_star_square = over_neurons(W_star**2)
l_stated = eps_star**2 / 2 + W_star_square / 2 + sum(
    (sigma * star**2 / 2 for sigma, star in zip(sigmas, stars, strict=True)), sp.Integer(0))  # (50)
bound_48 = (-alpha * sp.log(barrier) - (beta - sp.Rational(1, 2)) * e_2**2 - over_neurons(W_tilde**2) / 2
            - sum((s * x**2 / 2 for s, x in zip(sigmas, tildes, strict=True)), sp.Integer(0)) + l_stated)


@paper.claim("48", "Bound of the rate of V", "implication",
             r"\dot V \le -\alpha\log\frac{k^2}{k^2-e_1^2} - (\beta-\tfrac12)e_2^2 - \tfrac12\tilde W^T\tilde W - "
             r"\tfrac12\sigma_1\tilde a^2 - \tfrac12\sigma_2\tilde b^2 - \tfrac12\sigma_3\tilde c^2 + "
             r"\tfrac12\varepsilon^{*2} + \tfrac12 W^{*2} + \tfrac12\sigma_1a^{*2} + \tfrac12\sigma_2b^{*2} + "
             r"\tfrac12\sigma_3c^{*2}", "proved", premises=("41", "42", "43", "44", "45", "46", "47"),
             scope=EVERY_NETWORK,
             note="The non-strict form of (42) suffices, so this bound stands although (42) as printed is false.")
def rate_bound() -> Goal:
    """The right side of (41), by the tangent of the logarithm and completed squares."""
    return Goal((at_most(V_rate, bound_48),), (inside, *error_bound))


mu, l_ = sp.symbols("mu l", positive=True)
slowest = (at_most(mu, 2 * alpha), at_most(mu, 2 * beta - 1), at_most(mu, chi),
           *(at_most(mu, lam * sigma) for lam, sigma in zip(lambdas, sigmas, strict=True)))  # (49)


def _positive_minimum(*extra: Relation) -> Goal:
    return Goal(tuple(greater(r.right, 0) for r in slowest), extra)


@paper.claim("49", "Positive gains make mu positive", "implication",
             r"\alpha, \beta, \chi, \lambda_i, \sigma_i > 0 \Rightarrow \mu = \min[2\alpha, 2\beta-1, \chi, "
             r"\lambda_1\sigma_1, \lambda_2\sigma_2, \lambda_3\sigma_3] > 0", "gap",
             correction=lambda: _positive_minimum(greater(beta, sp.Rational(1, 2))),
             corrected_statement=r"\alpha, \chi, \lambda_i, \sigma_i > 0,\ \beta > \tfrac12 \Rightarrow \mu > 0",
             note="The paper asks for beta > 0 below (37); (52) divides by mu and needs mu > 0, hence beta > 1/2. The "
                  "paper leaves mu > 0 to the choice of gains, and the stated beta = 0.51 meets it, by little.")
def positive_minimum() -> Goal:
    """Every entry of the minimum, for all positive gains."""
    return _positive_minimum()


@paper.claim("50", "l is positive, as Lemma 1 asks, for a train with resistance", "implication",
             r"a^* \ne 0 \Rightarrow l = \tfrac12\varepsilon^{*2} + \tfrac12W^{*2} + \tfrac12\sigma_1a^{*2} + \tfrac12\sigma_2b^{*2} + "
             r"\tfrac12\sigma_3c^{*2} > 0", "proved", scope=EVERY_NETWORK,
             note="Without any resistance, weights and error l = 0, and Lemma 1 does not apply as printed.")
def offset_positive() -> Goal:
    """Squares, one of them not zero."""
    return Goal((greater(l_stated, 0),), (differ(a_star, 0),))


@paper.claim("51", "V decays up to l", "implication",
             r"\mu = \min[2\alpha, 2\beta-1, \chi, \lambda_1\sigma_1, \lambda_2\sigma_2, \lambda_3\sigma_3] "
             r"\Rightarrow \dot V \le -\mu V + l", "proved", premises=("48", "50"), scope=EVERY_NETWORK,
             note="With (49) and (50), for mu > 0; see 49 for when it is.")
def decay() -> Goal:
    """The right side of (48): every term of V decays at least at the rate mu."""
    return Goal((at_most(bound_48, -mu * V + l_stated),), (inside, *slowest))



@paper.claim("51.whole", "V decays up to l: the whole argument in one certificate", "implication",
             r"\dot V \le -\mu V + l\ \text{along (4), (27), (33)-(37) with (7)}", "proved",
             premises=("7",), scope=EVERY_NETWORK,
             note="The checker derives V' from (38), the plant and the laws by itself and re-checks every step "
                  "down to (51), without resting on the paper's intermediate lines.")
def decay_whole() -> Goal:
    """D(V) along the closed loop against -mu V + l."""
    return Goal((at_most(D(V), -mu * V + l_stated),), (inside, *error_bound, *slowest), flow,
                lemmas=(at_most(epsilon**2, eps_star**2), at_most(D(V), bound_48)))


zeta, V_now = sp.symbols("zeta V", real=True)


def _invariant(numerator: sp.Expr) -> Goal:
    return Goal((less(-mu * V_now + l_, 0),),
                (greater(zeta, 0), greater(mu, numerator / zeta), greater(V_now, zeta)))


@paper.claim("51.zeta.l", "mu > l/zeta makes V <= zeta invariant", "inequality",
             r"\mu > \frac{l}{\zeta},\ V > \zeta \Rightarrow \dot V \le -\mu V + l < 0", "proved", premises=("51",),
             note="With the letter l in the numerator, which (51) forces; see 51.zeta. Later claims rest on this one.")
def invariant_set() -> Goal:
    """-mu V + l < 0 above zeta."""
    return _invariant(l_)


@paper.claim("51.zeta", "mu > 1/zeta makes V <= zeta invariant", "inequality",
             r"\mu > \frac{1}{\zeta},\ V > \zeta \Rightarrow \dot V \le -\mu V + l < 0", "refuted", premises=("51",),
             correction=lambda: _invariant(l_),
             corrected_statement=r"\mu > \frac{l}{\zeta},\ V > \zeta \Rightarrow -\mu V + l < 0",
             note="As the extracted text has it, with the digit 1. It tells l from 1 in (52) to (57), so the digit is "
                  "taken as printed; should the page show the letter l, this is no erratum, and 51.zeta.l holds.")
def invariant_set_digit() -> Goal:
    """-mu V + l may be positive above zeta when l is large."""
    return _invariant(sp.Integer(1))


t, V_t, w, V_0 = sp.symbols("t V_t w V_0", real=True)
decaying = (at_most(w, -mu * V_t + l_), at_least(t, 0))
along_v = {t: sp.Integer(1), V_t: w}
from_zero = {t: sp.Integer(0), V_t: V_0}


@paper.claim("52", "Bound of V", "implication",
             r"0 \le V(t) \le \frac{l}{\mu} + \left[V(0) - \frac{l}{\mu}\right]e^{-\mu t}", "proved",
             premises=("51", "38"),
             note="For mu > 0: exp(mu t)(V - l/mu) does not increase. 0 <= V is 38.")
def comparison() -> Goal:
    """For every V with V' <= -mu V + l at all times."""
    return Goal((at_most(V_t, l_ / mu + (V_0 - l_ / mu) * sp.exp(-mu * t)),), (), along_v, decaying, from_zero,
                decreasing=sp.exp(mu * t) * (V_t - l_ / mu))


@paper.claim("52.T", "From some time on V is at most l/mu", "limit",
             r"\exists T\ \forall t > T:\ 0 \le V(t) \le \frac{l}{\mu}", "gap", premises=("52",),
             correction=lambda: _converges(V_t, sp.Integer(1), V_t),
             corrected_statement=r"\forall\delta>0\ \exists T\ \forall t > T:\ V(t) \le \frac{l}{\mu} + \delta",
             note="(52) lets V stay above l/mu for ever: V = 1 + exp(-t) obeys V' <= -V + 1 and never comes down "
                  "to 1. True is the limit: V comes below l/mu + delta, for every delta > 0.")
def reached_in_finite_time() -> Goal:
    """V(t) = 1 + exp(-t) with mu = l = 1."""
    one = sp.Integer(1)
    return Goal((at_most(V_t, l_ / mu),), (), along_v, decaying, from_zero, eventually=t,
                model={V_t: 1 + sp.exp(-t), mu: one, l_: one, V_0: sp.Integer(2)})


C, delta = sp.symbols("C delta", positive=True)


def _converges(whole: sp.Expr, factor: sp.Expr, bounded: sp.Expr) -> Goal:
    """bounded <= factor l/mu + delta once t >= factor C/(delta mu), when whole <= l/mu + C exp(-mu t)."""
    late = at_least(t, factor * C / (delta * mu))
    below = at_most(whole, l_ / mu + C * sp.exp(-mu * t))
    domain = (inside,) if whole.has(e_1) else ()
    return Goal((at_most(bounded, factor * l_ / mu + delta),), (*domain, late, below))


def _ultimate_bound(equation: str, name: str, factor: sp.Expr, square: sp.Expr, latex: str) -> None:
    @paper.claim(equation, f"Compact set of {name}", "limit",
                 rf"{latex} \to \left\{{|{latex}| \le \sqrt{{\tfrac{{{sp.latex(factor)} l}}{{\mu}}}}\right\}}", "proved",
                 premises=("52",), scope=EVERY_NETWORK,
                 note="Decided in squares and as a limit with the time named: |.|^2 <= (bound)^2 + delta for all "
                      "t >= T(delta). The paper argues through the finite T of (52), which is not needed.")
    def ultimate() -> Goal:
        return _converges(V, factor, square)


_ultimate_bound("53", "e_2", sp.Integer(2), e_2**2, "e_2")
_ultimate_bound("54", "the weights", 2 * chi, over_neurons(W_tilde**2), r"\tilde W")
_ultimate_bound("55", "the estimate of a", 2 * lambdas[0], tildes[0] ** 2, r"\tilde a")
_ultimate_bound("56", "the estimate of b", 2 * lambdas[1], tildes[1] ** 2, r"\tilde b")
_ultimate_bound("57", "the estimate of c", 2 * lambdas[2], tildes[2] ** 2, r"\tilde c")

# --- Theorem 1 ------------------------------------------------------------------------------------------------


@paper.claim("theorem1.bounded", "All error signals are bounded", "implication",
             r"V(t) \le V(0) + \frac{l}{\mu}\ \forall t \ge 0", "proved", premises=("52",))
def bounded() -> Goal:
    """From (52), uniformly in t."""
    bound = at_most(V_t, l_ / mu + (V_0 - l_ / mu) * sp.exp(-mu * t))
    return Goal((at_most(V_t, V_0 + l_ / mu),), (at_least(V_0, 0), at_least(t, 0), bound))


@paper.claim("theorem1.zeta", "V(0) <= zeta keeps V <= zeta", "implication",
             r"V(0) \le \zeta,\ \mu > \frac{l}{\zeta} \Rightarrow V(t) \le \zeta\ \forall t \ge 0", "proved",
             premises=("52", "51.zeta.l"))
def stays_below_zeta() -> Goal:
    """From (52)."""
    bound = at_most(V_t, l_ / mu + (V_0 - l_ / mu) * sp.exp(-mu * t))
    return Goal((at_most(V_t, zeta),), (greater(mu * zeta, l_), at_most(V_0, zeta), at_least(t, 0), bound))


@paper.claim("theorem1.barrier", "The position error stays inside the constraint", "implication",
             r"V_1(t) \le B \Rightarrow e_1^2 \le k^2(1 - e^{-2B}) < k^2", "proved",
             premises=("theorem1.bounded", "lemma1"),
             note="Lemma 1 gives |e_1(t)| < k; a bound B of V names the distance that is kept.")
def distance_from_barrier() -> Goal:
    """A bound of V_1 is a bound of e_1 strictly inside k."""
    return Goal((at_most(e_1**2, k**2 * (1 - sp.exp(-2 * level))), less(k**2 * (1 - sp.exp(-2 * level)), k**2)),
                (inside, at_most(V_1, level)), facts=(2 * level - sp.log(barrier),))


@paper.claim("A4", "Assumption 4 follows: the barrier term of the input is bounded when V is", "implication",
             r"V_1 \le B \Rightarrow \frac{|e_1|}{k^2 - e_1^2} \le \frac{e^{2B}}{k}", "proved",
             premises=("theorem1.bounded",),
             note="Assumption 4 supposes a bounded input, which is for the proof to show: with all signals bounded the "
                  "other terms of (33) are, and this bounds the last one. At the stated gains B is above l/mu, "
                  "so the bound is of no use for choosing an actuator, and a saturated input voids (41).")
def input_bounded() -> Goal:
    """The last term of (33) against a bound of V_1."""
    inverse = 1 / (k**2 - e_1**2)
    most = sp.exp(2 * level) / k
    return Goal((at_most(e_1 * inverse, most), at_least(e_1 * inverse, -most)), (inside, at_most(V_1, level)),
                facts=(2 * level - sp.log(barrier),),
                lemmas=(at_most(inverse, most / k), at_most(e_1, k), at_least(e_1, -k)))


wanted = sp.Symbol("rho", positive=True)


@paper.claim("theorem1.small", "The bound of e_2 can be made arbitrarily small by the gains", "implication",
             r"\forall\rho > 0\ \exists\,\alpha,\beta,\chi,\lambda_i,\sigma_i:\ \frac{2l}{\mu} \le \rho", "proved",
             premises=("53",), scope=EVERY_NETWORK,
             note="Witness: sigma_i = 1, mu = 2l/rho, alpha = mu/2, beta = (1 + mu)/2, chi = lambda_i = mu. It does "
                  "not extend to the estimates: by (54)-(57) their bounds contain chi/mu >= 1 and "
                  "lambda_i/mu >= 1/sigma_i.")
def arbitrarily_small() -> Goal:
    """mu meets (49) with equality, and 2 l/mu = rho."""
    one = sp.Integer(1)
    l_one = l_stated.xreplace(dict.fromkeys(sigmas, one))
    rate = 2 * l_one / wanted
    gains = {alpha: rate / 2, beta: (1 + rate) / 2, chi: rate, **dict.fromkeys(lambdas, rate),
             **dict.fromkeys(sigmas, one), mu: rate}
    return Goal((*(equal(r.left.xreplace(gains), r.right.xreplace(gains)) for r in slowest),
                 equal(2 * l_one, wanted * rate), greater(rate, 0)), (differ(a_star, 0),))


first_error, lambda_any = sp.symbols("a_tilde_0 lambda_0", real=True)


@paper.claim("theorem1.initial", "The influence of the initial estimation errors can be made arbitrarily small",
             "implication",
             r"\forall\rho > 0\ \exists\lambda_1 > 0:\ \tfrac{1}{2\lambda_1}\tilde a(0)^2 \le \rho", "proved",
             premises=("52",),
             note="Their influence enters through V(0) in (52), where a large lambda_1 (lambda_2, lambda_3, chi alike) "
                  "makes their share small. Witness: any lambda_1 of at least a_tilde(0)^2/(2 rho). The initial "
                  "errors themselves, which the sentence also names, do not depend on the gains.")
def initial_errors() -> Goal:
    """The share of an initial error in V(0), for every large enough gain."""
    return Goal((at_most(first_error**2 / (2 * lambda_any), wanted),),
                (greater(lambda_any, 0), at_least(lambda_any, first_error**2 / (2 * wanted))))


# --- section 6: the stated gains ------------------------------------------------------------------------------

stated_gains = {s: rational(scenario.controllers["rbfnn_pocrac"].parameters[str(s)])
                for s in (alpha, beta, chi, k, *lambdas, *sigmas)}
W_square = sp.Symbol("W_star_square", nonnegative=True)
least_error = abs(after_jump - before_jump) / 2
smallest_rate = min(2 * stated_gains[alpha], 2 * stated_gains[beta] - 1, stated_gains[chi],
                    *(stated_gains[lam] * stated_gains[s] for lam, s in zip(lambdas, sigmas, strict=True)))
best_case = {**{s: v for s, v in stated_gains.items() if s != k}, **stated_davis, mu: smallest_rate,
             eps_star: least_error, W_square: Fraction(0)}
l_numbers = l_stated.xreplace({W_star_square: W_square})
ultimate_speed_bound = float(sp.sqrt((2 * l_numbers / mu).subs(best_case)))


@paper.claim("49.stated", "mu is positive at the stated gains", "condition",
             r"\mu = \min[2\alpha, 2\beta-1, \chi, \lambda_i\sigma_i] > 0", "proved", premises=("51",),
             at={s: v for s, v in stated_gains.items() if s != k},
             note=f"mu = {smallest_rate}: a time constant of {1 / smallest_rate} s, against a run of "
                  f"{scenario.desired_curve().trip_time_s:.0f} s.")
def positive_rate() -> Goal:
    """Every entry of the minimum; the last one decides."""
    return _positive_minimum()


repaired_gains = {alpha: Fraction(1, 2), beta: Fraction(1), chi: Fraction(1), mu: Fraction(1),
                  **dict.fromkeys(lambdas, Fraction(20)), **dict.fromkeys(sigmas, Fraction(1, 20)),
                  **stated_davis, eps_star: least_error, W_square: Fraction(1, 20)}


@paper.claim("53.stated", "The proven bound explains the reported speed error of 0.26 m/s", "condition",
             r"|e_2| \le |\dot e_1| + \alpha|e_1|:\quad \sqrt{\tfrac{2l}{\mu}} \le 0.26 + \alpha k", "violated", premises=("53",),
             at={**best_case, k: stated_gains[k]}, repair={**repaired_gains, k: stated_gains[k]},
             note="The paper prints no such condition; it is what (53) would have to give for the reported accuracy to "
                  "follow from the theorem. In the paper's favour: W* = 0 and the smallest eps* that Table 1 allows (7.error). 2l/mu is then "
                  f"the left value over mu, a bound of {ultimate_speed_bound:.1f} m/s: the theorem says nothing about the reported "
                  "accuracy. The repair meets the bound for W*^2 <= 1/20, at the price of lambda_3 v^4 beyond any "
                  "usual sampling rate.")
def bound_explains_speed_error() -> Goal:
    """2 l <= (0.26 + alpha k)^2 mu."""
    return Goal((at_most(2 * l_numbers, (sp.Rational(26, 100) + alpha * k) ** 2 * mu),), slowest)


@paper.claim("theorem1.stated", "The proven bound explains the position error below 0.2 m", "condition",
             r"k\sqrt{1 - e^{-2l/\mu}} \le 0.2", "violated", premises=("theorem1.barrier", "52"),
             at={**best_case, k: stated_gains[k]}, repair={**repaired_gains, k: stated_gains[k]},
             note="The paper prints no such condition. The ultimate bound of V keeps e_1 only below k itself, to more "
                  "digits than the paper prints.")
def bound_explains_position_error() -> Goal:
    """k^2 (1 - exp(-2 l/mu)) <= 0.2^2."""
    return Goal((at_most(k**2 * (1 - sp.exp(-2 * l_numbers / mu)), sp.Rational(1, 25)),), slowest)


reach, rate_reach, estimate_reach, curve_reach, u_max, u_brake = sp.symbols(
    "e_max edot_max g_max a_max u_max u_brake", positive=True)


def _command(error: sp.Expr, error_rate: sp.Expr, estimates: sp.Expr, acceleration: sp.Expr) -> sp.Expr:
    """u of (33) with its estimates gathered in one number."""
    put = {x_1: error, x_d: sp.Integer(0), x_2: error_rate, xdot_d: sp.Integer(0), xddot_d: acceleration}
    return estimates + law.feedback.xreplace(put)


barrier_at_printed = 0.142 / (float(stated_gains[k]) ** 2 - 0.142**2)


@paper.claim("33.figures", "Figures 8 and 9 fit (33): an error of 0.142 m with an input of at most 0.48 m/s^2",
             "condition",
             r"e_1 = -0.142: u \le 0.48;\quad e_1 = 0.142: u \ge -3\ \tfrac{m}{s^2}", "violated",
             at={reach: Fraction(142, 1000), rate_reach: Fraction(26, 100), estimate_reach: Fraction(1),
                 curve_reach: Fraction(1), u_max: Fraction(48, 100), u_brake: Fraction(3),
                 **{s: stated_gains[s] for s in (alpha, beta, k)}},
             note="The sign of the printed error is not stated. If it is negative, (33) commands several times the "
                  "largest input printed; if positive, a braking that no train has. Taken in the paper's favour: "
                  "estimates between 0 and 1 m/s^2, a desired acceleration of up to 1 m/s^2, the printed speed error of "
                  f"0.26 m/s in the helpful direction. The barrier term alone is {barrier_at_printed:.1f} m/s^2 at 0.142 m.")
def printed_figures_fit() -> Goal:
    """The smallest command at the negative error, the largest at the positive one."""
    behind = _command(-reach, rate_reach, sp.Integer(0), -curve_reach)
    ahead = _command(reach, -rate_reach, estimate_reach, curve_reach)
    return Goal((at_most(behind, u_max), at_least(ahead, -u_brake)), (greater(k**2 - reach**2, 0),))


# --- the laws sampled -----------------------------------------------------------------------------------------

period, v_c = sp.symbols("T_s v_c", positive=True)


def _speed_and_estimate_loop() -> sp.Matrix:
    """Jacobian of (40), (36) in (e_2, c_tilde) at zero error, desired speed v_c, constant desired curve."""
    states = (e_2, tildes[2])
    at_rest = {e_1: 0, e_2: 0, **dict.fromkeys(tildes, 0), epsilon: 0, xdot_d: v_c, c_star: 0}
    without_network = {total: sp.Integer(0) for total in flow[e_2].atoms(sp.Sum)}
    return sp.Matrix([[sp.diff(flow[row].xreplace(without_network), column).subs(at_rest) for column in states]
                      for row in states])


def _sampled_goal(corrected: bool) -> Goal:
    """Jury's conditions: a 2 x 2 update M is stable when det M < 1 and |trace M| < 1 + det M."""
    rate = _speed_and_estimate_loop()
    if corrected:  # the estimate moves first, the speed error answers to the new estimate
        estimate_first = sp.Matrix([[1, 0], [period * rate[1, 0], 1 + period * rate[1, 1]]])
        speed_then = sp.Matrix([[1 + period * rate[0, 0], period * rate[0, 1]], [0, 1]])
        update = speed_then * estimate_first
    else:
        update = sp.eye(2) + period * rate
    det, trace = sp.expand(update.det()), sp.expand(update.trace())
    return Goal((less(det, 1), less(trace, 1 + det), less(-trace, 1 + det)))


cruise = davis_cruise_speed(scenario.reference.cruise_mps2, *(float(stated_davis[s]) for s in stars))
at_cruise = {beta: stated_gains[beta], lambdas[2]: stated_gains[lambdas[2]], sigmas[2]: stated_gains[sigmas[2]],
             v_c: Fraction(round(cruise * 100), 100)}
JURY = (r"\det M < 1,\ |\mathrm{tr}\,M| < 1 + \det M,\quad M = \partial(e_2, \tilde c)(t + T_s)/"
        r"\partial(e_2, \tilde c)(t)")


@paper.claim("36.sampling", "(36) and the speed error, sampled at 1 ms by explicit Euler, are stable", "condition",
             JURY, "violated", at={**at_cruise, period: Fraction(1, 1000)},
             repair={**at_cruise, period: Fraction(1, 25000)},
             note="The paper states no sampling, so this is a condition on an implementation. Linearised at cruise speed: the estimate of c works through v^2 and is corrected through v^2, so "
                  "the pair oscillates at sqrt(lambda_3) v^2 rad/s, and an explicit step feeds the oscillation more "
                  "than beta damps it. The paper states no step. The simulation leaves the barrier with this order.")
def explicit_sampling() -> Goal:
    """Jury's conditions of the explicit update."""
    return _sampled_goal(corrected=False)


@paper.claim("36.sampling.corrected", "The same with the estimate corrected before it is used", "condition",
             JURY, "proved", at={**at_cruise, period: Fraction(1, 1000)},
             note="The order the simulation uses. It stays stable up to about 2/(sqrt(lambda_3) v^2), that is "
                  f"{2000 / (float(stated_gains[lambdas[2]]) ** 0.5 * cruise**2):.1f} ms at cruise speed.")
def corrected_sampling() -> Goal:
    """Jury's conditions when the estimate moves first."""
    return _sampled_goal(corrected=True)

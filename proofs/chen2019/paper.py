"""chen2019: the rewriting of the model, every claim of section III, and the stated numbers of section IV.

Y. Chen, D. Huang, T. Huang, N. Qin, Tracking Control via Iterative Learning for High-Speed Trains With Distributed
Input Constraints, IEEE Access 7 (2019) 84591-84601.

Plant, auxiliary system, law and learning rules are the expressions that are simulated (`workbench.multi_particle`,
`workbench.controllers.chen2019`); derivatives are written D(...) and derived along the closed loop. What stands on the right of `equal` and `at_most` is what the paper prints. Only (7) ties the
acceleration to the force, so the force is what (7) says for an acceleration that stands as a symbol: all of
section III holds for every acceleration that solves the loop through (16) and (22); whether one does is the
section on the loop.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater, less, name_of
from workbench.proof.derive import lie_derivative
from workbench.proof.paper import Paper
from workbench.trains.multi_particle import (
    basic_resistance,
    c_0,
    c_a,
    c_d,
    c_k,
    c_v,
    coupler_pull,
    each_car,
    over_cars,
    s,
    v,
)

from .laws import (
    As,
    Av,
    Delta_u,
    M,
    M_hat,
    M_tilde,
    Theta,
    Theta_tilde,
    alpha,
    alpha_dot,
    any_gains,
    auxiliary,
    c_1,
    c_2,
    c_3,
    c_lambda_candidates,
    compact_force,
    compact_parameters,
    driven_by,
    errors,
    estimates,
    eta,
    gains,
    gamma_a,
    gamma_eta,
    gamma_mass,
    gamma_v,
    halved,
    lambda_1,
    lambda_2,
    learning_gains,
    learning_steps,
    limited,
    loop_force,
    mass_step,
    mu,
    mu_law,
    mu_of,
    phi,
    q_sums,
    q_values,
    s_r,
    squares,
    theta,
    tildes,
    true_parameters,
    v_dot,
    v_r,
    v_r_dot,
    z_1,
    z_2,
)

paper = Paper("chen2019", " ".join((__doc__ or "").split("\n\n")[1].split()))

EVERY_TRAIN = "every number of cars, every A and phi (car by car under the sum)"
EACH_CAR = "every car; norms and traces are sums over the cars"
INT_Z = r"\int_0^T(\|z_{1,i}\|^2 + \|z_{2,i}\|^2)d\tau"
INT_LAMBDA = r"\int_0^T(\|\lambda_{1,i}\|^2 + \|\lambda_{2,i}\|^2)d\tau"
INT_U = r"\int_0^T\|\Delta u_i\|^2d\tau"
half, zero = sp.Rational(1, 2), sp.Integer(0)

# --- symbols ------------------------------------------------------------------------------------------------


def both(one: sp.Expr, other: sp.Expr) -> tuple[Relation, Relation]:
    """Equality as two inequalities, for a proof by cases that touch."""
    return at_most(one, other), at_least(one, other)


def one_car(expr: sp.Expr) -> sp.Expr:
    """The expression for one car: sums have that one term."""
    single = expr.replace(sp.Sum, lambda term, *_: term)
    return single.xreplace({s: sp.Symbol(name_of(s), real=True) for s in single.atoms(sp.Indexed)})


# --- section II: the train (1)-(3) and its compact form (7) -------------------------------------------------

def train(n: int) -> tuple[list[sp.Expr], list[sp.Expr], dict[str, tuple[sp.Symbol, ...]]]:
    """M v' - u of a train of n cars: by (1)-(3), by (7), and the symbols of its cars."""
    cars_of = {name: sp.symbols(f"{name}_1:{n + 1}", real=True) for name in ("s", "v", "f_a")}
    cars_of["m"] = sp.symbols(f"m_1:{n + 1}", positive=True)
    S, V, F, masses = (cars_of[name] for name in ("s", "v", "f_a", "m"))
    total = sp.Add(*masses)
    places = list(zip(S, V, strict=True))
    pulls = [zero, *(coupler_pull(places[j], places[j + 1]) for j in range(n - 1)), zero]
    newton = [basic_resistance(masses[j], V[j], total if j == 0 else zero) + pulls[j] - pulls[j + 1] + F[j]
              for j in range(n)]
    A = sp.Matrix(n, n, lambda i, j: (1 if i in (0, n - 1) else 2) if i == j else -1 if abs(i - j) == 1 else 0)
    air = [V[0] ** 2, *[zero] * (n - 1)]
    compact = [compact_force(compact_parameters(masses[j], total, F[j]), V[j], air[j], (A * sp.Matrix(S))[j],
                             (A * sp.Matrix(V))[j]) for j in range(n)]
    return newton, compact, cars_of


@paper.claim("7", "The model of six cars in compact form", "identity",
             r"(1), (2), (3) \Leftrightarrow M\dot v_i = u_i + \Theta_v v_i + \theta_a\phi(v_i) + \theta_k A s_i + "
             r"\theta_d A v_i + \eta", "proved", scope="the six cars of section IV; 7.n for every n",
             note="The definition of phi is lost in the extracted text; (2) forces phi(v) = [v_1^2, 0, ..., 0]^T.")
def compact_form() -> Goal:
    """Six rows of (7), with the matrix A, against (1)-(3)."""
    newton, compact, _ = train(6)
    return Goal(tuple(equal(a, b) for a, b in zip(newton, compact, strict=True)))


@paper.claim("7.n", "The compact form of the first, an inner and the last car", "identity",
             r"(2), (3) \Leftrightarrow \text{rows } 1,\ j,\ n \text{ of (7)}", "proved",
             scope="every number of cars n >= 2")
def compact_form_of_every_train() -> Goal:
    """The three kinds of rows of (7); the mass of the whole train is one number."""
    total, mass, f_a = sp.symbols("m_total m_j f_a", real=True)
    ahead, own, behind = ((sp.Symbol(f"s_{k}", real=True), sp.Symbol(f"v_{k}", real=True)) for k in "abc")
    stated = compact_parameters(mass, total, f_a)
    front, rear = coupler_pull(ahead, own), coupler_pull(own, behind)
    first = compact_force(stated, own[1], own[1] ** 2, own[0] - behind[0], own[1] - behind[1])
    inner = compact_force(stated, own[1], zero, -ahead[0] + 2 * own[0] - behind[0],
                          -ahead[1] + 2 * own[1] - behind[1])
    last = compact_force(stated, own[1], zero, -ahead[0] + own[0], -ahead[1] + own[1])
    rolling = basic_resistance(mass, own[1]) + f_a
    return Goal((equal(basic_resistance(mass, own[1], total) + f_a - rear, first),
                 equal(rolling + front - rear, inner), equal(rolling + front, last)))


# --- section IV: stated numbers ----------------------------------------------------------------------------

stated_gains = {c_1: Fraction(1, 100), c_2: Fraction(100), c_3: Fraction(4, 100)}
table_1 = {c_0: Fraction(775, 10**5), c_v: Fraction(228, 10**6), c_a: Fraction(166, 10**7), c_k: Fraction(2 * 10**6),
           c_d: Fraction(10**5)}
mass_stated, limit_stated, cruise_stated = Fraction(5 * 10**4), Fraction(4 * 10**4), Fraction(835, 10)
MOTOR_CARS = (1, 3, 5)


def _forces_at_reference() -> tuple[list[sp.Expr], dict[str, tuple[sp.Symbol, ...]]]:
    """The forces u that hold six cars at the reference speed v_r, car j at the place s_j, on level track."""
    newton, _, symbols = train(6)
    level = dict.fromkeys(symbols["f_a"], zero) | dict.fromkeys(symbols["v"], v_r)
    return [m_j * v_r_dot - force.xreplace(level) for m_j, force in zip(symbols["m"], newton, strict=True)], symbols


needed, six = _forces_at_reference()
u_most = sp.Symbol("u_max", positive=True)
at_cruise = {**table_1, **dict.fromkeys(six["m"], mass_stated), v_r: cruise_stated, v_r_dot: Fraction(0),
             u_most: limit_stated}
behind_motors = dict(zip(six["s"], (Fraction(-7 * k, 10**4) for k in (0, 1, 1, 2, 2, 3)), strict=True))
trailer_force = float(mass_stated * (table_1[c_0] + table_1[c_v] * cruise_stated))


@paper.claim("A2", "Assumption 2: an input within the limits keeps six cars on the reference", "condition",
             r"s_j = s_r,\ v_j = v_r = 83.5:\quad u_r = M\dot v_r - \Theta_v v_r - \theta_a\phi(v_r) - "
             r"\theta_k A s_r - \theta_d A v_r - \eta \in [\underline u, \overline u]", "violated",
             at={**at_cruise, **dict.fromkeys(six["s"], Fraction(0))}, repair={**at_cruise, **behind_motors},
             note="With one reference for all cars A s_r = 0: no coupler pulls, and a trailer, which has no traction, "
                  f"cannot make up for its own {trailer_force:.0f} N of resistance at 83.5 m/s on level track. Exact "
                  "tracking of all cars is thus impossible at the stated numbers, whatever the law. The proof of "
                  "Theorem 1 does not use Assumption 2. The repair lets every trailer run 0.7 mm behind its motor car.")
def reference_can_be_tracked() -> Goal:
    """The six forces at cruise against the limits of motor cars (1, 3, 5) and trailers."""
    most = [u_most if j in MOTOR_CARS else zero for j in range(1, 7)]
    return Goal((*(at_most(u, high) for u, high in zip(needed, most, strict=True)),
                 *(at_least(u, -u_most) for u in needed)))


# --- Property 1 -----------------------------------------------------------------------------------------------

g, h, g_low, g_high = sp.symbols("g h g_low g_high", real=True)
weight = sp.Symbol("gamma", nonnegative=True)
within = (at_most(g_low, g), at_most(g, g_high))


def _property_1(inner: sp.Expr, own: sp.Expr) -> Relation:
    left = (weight + 1) * g - (weight * own + limited(inner, g_low, g_high))
    return at_most(left * (own - limited(own, g_low, g_high)), 0)


@paper.claim("6", "Property 1, for the projection of any number", "inequality",
             r"\underline g \le g \le \overline g,\ \gamma \ge 0 \Rightarrow [(\gamma+1)g - (\gamma h + "
             r"\mathrm{sat}(h,\underline g,\overline g))][h - \mathrm{sat}(h,\underline g,\overline g)] \le 0",
             "proved", note="Read with sat(h, .) in the first bracket and any h, as (33) uses it. The extracted text "
                            "has sat(g, .) there, and h = sat(g, .), which is 6.text.")
def projection_property() -> Goal:
    """Case by case of h below, within and above the bounds."""
    return Goal((_property_1(h, h),), within)


@paper.claim("6.text", "Property 1 letter by letter", "inequality",
             r"[(\gamma+1)g - (\gamma h + \mathrm{sat}(g,\underline g,\overline g))][h - "
             r"\mathrm{sat}(h,\underline g,\overline g)] \le 0,\quad h = \mathrm{sat}(g,\underline g,\overline g)",
             "proved", note="True, and of no use: h lies within the bounds, so the second bracket vanishes.")
def projection_property_text() -> Goal:
    """With h = sat(g) put in."""
    return Goal((_property_1(g, limited(g, g_low, g_high)),), within)


# --- section III: law, learning rules, Lyapunov functions ---------------------------------------------------

u_of_7 = M * v_dot - compact_force(true_parameters, v, phi, As, Av)  # the force that (7) says


def rates_with(input_mu: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The rates of (7) and (9) for an unsaturated input mu."""
    saturated = {x: rate.xreplace({Delta_u: u_of_7 - input_mu}) for x, rate in auxiliary.items()}
    return {s: v, v: v_dot, s_r: v_r, v_r: v_r_dot, **saturated}


sums_named = tuple(equal(x, value) for x, value in zip(q_sums, q_values, strict=True))


def V_of(z: sp.Expr) -> sp.Expr:
    """Half the squared norm, as V_1 and V_2."""
    return over_cars(z**2) / 2


V = V_of(z_1) + V_of(z_2)  # (23)
J = sp.symbols("J_v J_a J_k J_d J_eta J_M", nonnegative=True)  # the integrals of (25)
E = V + sp.Add(*halved(J))  # (25)


def in_errors(expr: sp.Expr) -> sp.Expr:
    """An expression of the closed loop in z_1, z_2 and the estimation errors."""
    pairs = zip((*estimates, M_hat), tildes, (*true_parameters, M), strict=True)
    expr = expr.xreplace({hat: tilde + true for hat, tilde, true in pairs})
    expr = expr.xreplace({lambda_2: v - v_r - alpha - z_2})
    return sp.expand(expr.xreplace({s: z_1 + s_r + lambda_1}))


flow = {z: in_errors(lie_derivative(expr, rates_with(mu_law))) for z, expr in errors.items()}
cef_flow = flow | dict(zip(J, squares, strict=True))


@paper.claim("25", "The CEF is not negative", "inequality", r"E_i \ge 0", "proved", scope=EVERY_TRAIN)
def cef_not_negative() -> Goal:
    """Squares and integrals of squares, with positive gains."""
    return Goal((at_least(E, 0),))


@paper.claim("11", "Rate of z_1", "identity",
             r"\dot z_{1,i} = v_i - v_r - \lambda_{2,i} + c_1\lambda_{1,i} = z_{2,i} + \alpha_i + c_1\lambda_{1,i}",
             "proved", scope=EACH_CAR)
def z_1_rate() -> Goal:
    """D(z_1) along (7), (9), for any mu; alpha by (12)."""
    rates = {one_car(x): one_car(r) for x, r in rates_with(mu).items()}
    z = {x: one_car(expr) for x, expr in errors.items()}
    return Goal((equal(D(z[z_1]), one_car(v - v_r - lambda_2 + c_1 * lambda_1)),
                 equal(D(z[z_1]), z[z_2] + one_car(alpha + c_1 * lambda_1))), flow=rates)


@paper.claim("13", "Rate of V_1", "identity", r"\dot V_{1,i} = -c_1\|z_{1,i}\|^2 + z_{1,i}^T z_{2,i}", "proved",
             premises=("11",), scope=EVERY_TRAIN)
def v_1_rate() -> Goal:
    """D(V_1) with (10) put in, along (7), (9) with any mu."""
    stated = -c_1 * over_cars(z_1**2) + over_cars(z_1 * z_2)
    return Goal((equal(D(V_of(errors[z_1])), stated.xreplace(errors)),), flow=rates_with(mu))


delta_u = u_of_7 - mu
missing = v_dot - v_r_dot - alpha_dot + c_2 * lambda_2
bracket_14 = c_3 * mu + c_3 * (compact_force(true_parameters, v, phi, As, Av) - M * v_dot) + missing


@paper.claim("14", "Rate of z_2", "identity",
             r"\dot z_{2,i} = c_3\mu_i + c_3(\Theta_v v_i + \theta_a\phi(v_i) + \theta_k A s_i + \theta_d A v_i + "
             r"\eta - M\dot v_i) + \dot v_i - \dot v_r - \dot\alpha_i + c_2\lambda_{2,i}", "proved", premises=("7",),
             scope=EACH_CAR, note="'Theta_3' in the first line of (14) is Theta_v. The line adds c_3 times (7), so c_3 "
                                  "has the unit 1/kg; factors 1/s^2 and 1/s of value 1 before z_1 are left out.")
def z_2_rate() -> Goal:
    """D(z_2) along (7), (9), for any mu; both lines of (14)."""
    first_line = (c_3 * (u_of_7 + compact_force(true_parameters, v, phi, As, Av)) - c_3 * M * v_dot + missing
                  - c_3 * delta_u)
    rate = D(one_car(errors[z_2]))
    return Goal((equal(rate, one_car(first_line)), equal(rate, one_car(bracket_14))),
                flow={one_car(x): one_car(r) for x, r in rates_with(mu).items()})


def estimation_terms(z: sp.Expr, wrong: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
    """The last six terms of (15) and (24), for the errors of Theta_v, theta_a, theta_k, theta_d, eta, M."""
    rolling, aerodynamic, spring, damper, rest, inertia = wrong
    return (-c_3 * over_cars(z * rolling * v), -c_3 * aerodynamic * over_cars(z * phi),
            -c_3 * spring * over_cars(z * As), -c_3 * damper * over_cars(z * Av), -c_3 * over_cars(z * rest),
            c_3 * over_cars(z * inertia * v_dot))


@paper.claim("15", "Rate of V_2, with the estimates put in", "identity",
             r"\dot V_{2,i} = z_{2,i}^T[c_3\mu_i + c_3(\hat\Theta_{v,i}v_i + \dots - \hat M_i\dot v_i) + \dot v_i - "
             r"\dot v_r - \dot\alpha_i + c_2\lambda_{2,i}] - c_3z_{2,i}^T\tilde\Theta_{v,i}v_i - \dots + "
             r"c_3z_{2,i}^T\tilde M_i\dot v_i", "proved", premises=("14",), scope=EVERY_TRAIN,
             note="With tilde = hat minus true for all of them; the extracted text has a hat on the error of Theta_v.")
def v_2_rate() -> Goal:
    """D(V_2) along (7), (9), for any mu: both sides of the second equality."""
    with_hats = c_3 * mu + c_3 * (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot) + missing
    wrong = tuple(hat - true for hat, true in zip((*estimates, M_hat), (*true_parameters, M), strict=True))
    z = errors[z_2]
    return Goal((equal(D(V_of(z)), over_cars(z * bracket_14)),
                 equal(D(V_of(z)), over_cars(z * with_hats) + sp.Add(*estimation_terms(z, wrong)))),
                flow=rates_with(mu))


decay = -c_1 * over_cars(z_1**2) - c_2 * over_cars(z_2**2)


@paper.claim("24", "Rate of V in closed loop", "identity",
             r"\dot V_i = -c_1\|z_{1,i}\|^2 - c_2\|z_{2,i}\|^2 - c_3z_{2,i}^T\tilde\Theta_{v,i}v_i - "
             r"c_3z_{2,i}^T\tilde\theta_{a,i}\phi(v_i) - c_3z_{2,i}^T\tilde\theta_{k,i}As_i - "
             r"c_3z_{2,i}^T\tilde\theta_{d,i}Av_i - c_3z_{2,i}^T\tilde\eta_i + c_3z_{2,i}^T\tilde M_i\dot v_i",
             "proved", premises=("13", "15"), scope=EVERY_TRAIN,
             note="For every acceleration that solves the loop, saturated or not; see 16.loop for when one does.")
def v_rate() -> Goal:
    """D(V) along (7), (9), (16)."""
    return Goal((equal(D(V), decay + sp.Add(*estimation_terms(z_2, tildes))),), flow=flow)


# --- the loop through the acceleration ----------------------------------------------------------------------

kappa, rest, a, b, u_a, u_b, u_low, u_high = sp.symbols("kappa rho a b u_a u_b u_low u_high", real=True)
mass, mass_hat = sp.symbols("M M_hat", positive=True)
limits = (at_most(u_low, u_high),)
room = sp.Symbol("w", positive=True)  # m + 1/c_3 - m_hat, where the estimate is below the singular one


@paper.claim("16.loop", "The input depends on the acceleration that it causes", "identity",
             r"\mu_{i,j} = \kappa_{i,j} + \left(\hat m_{i,j} - \tfrac{1}{c_3}\right)\dot v_{i,j}", "proved",
             scope=EACH_CAR,
             note="kappa gathers all terms of (16) without the acceleration, with the estimates given. The paper does "
                  "not mention the loop. With 1/c_3 = 25 kg it feeds nearly the whole inertia force of a car back.")
def input_needs_acceleration() -> Goal:
    """(16) is affine in the acceleration when the estimates are given."""
    law, free = one_car(mu_law), one_car(v_dot)
    stated = mu_of(law.xreplace({free: zero}), free, one_car(M_hat))
    return Goal((equal(law, stated),))


@paper.claim("8.slope", "The saturation does not decrease and does not expand", "inequality",
             r"(\mathrm{sat}(\mu_a) - \mathrm{sat}(\mu_b))^2 \le (\mathrm{sat}(\mu_a) - \mathrm{sat}(\mu_b))(\mu_a - "
             r"\mu_b)", "proved", scope=EACH_CAR, note="Not printed; 16.unique leans on it.")
def saturation_slope() -> Goal:
    """Case by case of the two arguments."""
    step = limited(a, u_low, u_high) - limited(b, u_low, u_high)
    return Goal((at_most(step**2, step * (a - b)),), limits)


def _one_acceleration() -> Goal:
    inputs = zip((a, b), (u_a, u_b), strict=True)
    mu_a, mu_b = (mu_of(kappa, x, mass + 1 / c_3 - room) for x in (a, b))
    slope = at_most((u_a - u_b) ** 2, (u_a - u_b) * (mu_a - mu_b))
    return Goal((at_most((a - b) ** 2, 0),), (*(equal(u, mass * x - rest) for x, u in inputs), slope))


@paper.claim("16.unique", "(7), (8), (16) determine the acceleration, for any estimate of the mass", "implication",
             r"m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b", "gap",
             premises=("16.loop", "8.slope"), scope=EACH_CAR, correction=_one_acceleration,
             corrected_statement=r"\hat m_{i,j} < m_j + \tfrac{1}{c_3},\ m a = \mathrm{sat}(\mu(a)) + \rho,\ "
                                 r"m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b",
             note="A step the paper takes without words: (16) must define an input. rho gathers the other forces. At "
                  "m_hat = m + 1/c_3 every acceleration within the limits solves the equations (the counterexample: "
                  "both unsaturated), above it up to three do.")
def acceleration_unique() -> Goal:
    """Two solutions of the loop of one car, both within the limits, agree."""
    within_limits = [(at_least(mu_of(kappa, x, mass_hat), u_low), at_most(mu_of(kappa, x, mass_hat), u_high),
                      equal(mass * x, mu_of(kappa, x, mass_hat) + rest)) for x in (a, b)]
    return Goal((equal(a, b),), tuple(r for group in within_limits for r in group))


@paper.claim("16.exists", "Below m + 1/c_3 the loop has a solution, in closed form", "implication",
             r"\hat m_{i,j} < m_j + \tfrac{1}{c_3},\ u = \mathrm{sat}\left(\tfrac{m(\kappa + \rho)}{m + 1/c_3 - "
             r"\hat m} - \rho, \underline u, \overline u\right),\ m\dot v = u + \rho \Rightarrow u = "
             r"\mathrm{sat}(\mu(\dot v), \underline u, \overline u)", "proved", premises=("16.loop",), scope=EACH_CAR,
             note="Not in the paper: the rule by which the loop can be solved when the estimate of the mass is given.")
def acceleration_exists() -> Goal:
    """The force of the unsaturated equation, saturated, solves the saturated one."""
    force = loop_force(mass, kappa, rest, room, u_low, u_high)
    law = mu_of(kappa, (force + rest) / mass, mass - room + 1 / c_3)
    return Goal(both(force, limited(law, u_low, u_high)), limits)


m_high = sp.Symbol("m_high", positive=True)


@paper.claim("16.stated", "Every estimate that Assumption 1 allows leaves the loop unique", "condition",
             r"\overline m_j < m_j + \tfrac{1}{c_3}", "violated", premises=("16.unique",),
             at={mass: mass_stated, m_high: mass_stated + 80, c_3: stated_gains[c_3]},
             repair={mass: mass_stated, m_high: mass_stated + 80, c_3: Fraction(1, 100)},
             note="Not a condition of the paper, which does not mention the loop. The mass bounds are not stated "
                  "(assumed: the mass of Table 1 and one passenger of 80 kg more). 1/c_3 = 25 kg is less than a "
                  "passenger, while full load (Remark 1) is tonnes above the self-weight.")
def loop_unique_as_stated() -> Goal:
    """The upper mass bound against the singular estimate."""
    return Goal((less(m_high, mass + 1 / c_3),))


deviation_left = float(1 - 1 / (stated_gains[c_3] * mass_stated))


@paper.claim("16.sampled", "With the acceleration of the sample before, the loop settles", "condition",
             r"|\hat m_{i,j} - \tfrac{1}{c_3}| < m_j", "proved", premises=("16.loop",),
             at={mass: mass_stated, mass_hat: mass_stated, c_3: stated_gains[c_3]},
             note="Not a condition of the paper. An unsaturated car then has m a(k+1) = kappa + (m_hat - 1/c_3) a(k) "
                  f"+ rho. With the true mass a deviation shrinks to {deviation_left:.4f} of itself per sample, so a "
                  "car answers to its control law only after thousands of samples; with m_hat > m + 1/c_3 deviations "
                  "grow.")
def sampled_loop_settles() -> Goal:
    """The factor of a deviation of the acceleration from one sample to the next."""
    return Goal((less((mass_hat - 1 / c_3) ** 2, mass**2),))


m_before, z_car, a_car = sp.symbols("M_hat_prev z_2 v_dot", real=True)


@paper.claim("16.learning", "With (22) in the loop the acceleration is unique at the stated gains", "condition",
             r"\hat m = \mathrm{sat}(\hat m_{i-1} - \gamma_M c_3 z_2\dot v, \underline m, \overline m):\ "
             r"m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b", "violated",
             premises=("16.loop",), scope="one motor car in the first iteration",
             at={mass: mass_stated, m_before: mass_stated, g_low: mass_stated, g_high: mass_stated + 1000,
                 c_3: stated_gains[c_3], gamma_mass: Fraction(8000), z_car: Fraction(-2), u_low: -limit_stated,
                 u_high: limit_stated, kappa: Fraction(1339), rest: Fraction(-1339), a: Fraction(0),
                 b: Fraction(25, 640)},
             note="Not a condition of the paper. (22) uses the acceleration of the same instant, so (16) is quadratic "
                  "in it: a car that rolls at constant speed against 1339 N with z_2 = -2 m/s may as well accelerate "
                  "at 0.039 m/s^2 (and at 0.77 m/s^2, saturated), already from the initial estimate. With the "
                  "acceleration of the sample before in (22) the estimate is given, and 16.unique decides. The mass "
                  "bounds are not stated (assumed: the mass of Table 1 and 1 t more).")
def loop_with_learning() -> Goal:
    """Two accelerations that solve (7), (8), (16), (22) of one car."""
    def balance(x: sp.Expr) -> Relation:
        estimate = limited(m_before + mass_step(z_car, x), g_low, g_high)
        return equal(mass * x, limited(mu_of(kappa, x, estimate), u_low, u_high) + rest)

    return Goal(both(a, b), (balance(a), balance(b)))


# --- Theorem 1, step 1: the CEF does not increase -----------------------------------------------------------

A3_known = tuple(equal(one_car(x), y) for x, y in ((s, s_r), (v, v_r)))
V_start = one_car(V.xreplace(errors))


lambda_zero = (equal(one_car(lambda_1), 0), equal(one_car(lambda_2), 0))


def _starts_at_zero(*extra: Relation) -> Goal:
    return Goal((equal(V_start, 0),), (*A3_known, *extra))


@paper.claim("A3", "Assumption 3 makes V_i start at zero", "implication",
             r"s_i(0) = s_r(0),\ v_i(0) = v_r(0) \Rightarrow V_i(t) = \int_0^t\dot V_i(\tau)\,d\tau", "gap",
             scope=EACH_CAR, correction=lambda: _starts_at_zero(*lambda_zero),
             corrected_statement=r"s_i(0) = s_r(0),\ v_i(0) = v_r(0),\ \lambda_{1,i}(0) = \lambda_{2,i}(0) = 0 "
                                 r"\Rightarrow V_i(0) = 0",
             note="z contains lambda, whose initial value Assumption 3 does not name. It must be zero in every "
                  "iteration; before (51) the paper uses just that, so this is an omission, and later claims rest on "
                  "A3.lambda.")
def starts_at_zero() -> Goal:
    """V at the initial state that Assumption 3 names."""
    return _starts_at_zero()


@paper.claim("A3.lambda", "With the auxiliary state at zero V_i starts at zero", "implication",
             r"s_i(0) = s_r(0),\ v_i(0) = v_r(0),\ \lambda_{1,i}(0) = \lambda_{2,i}(0) = 0 \Rightarrow V_i(0) = 0",
             "proved", scope=EACH_CAR)
def starts_at_zero_with_lambda() -> Goal:
    """V at the initial state, lambda included."""
    return _starts_at_zero(*lambda_zero)


def integrated(rates: dict[sp.Expr, sp.Expr], bound: Relation, always: tuple[Relation, ...] = (),
               constant: tuple[sp.Expr, ...] = (), start: dict[sp.Expr, sp.Expr] | None = None,
               decreasing: sp.Expr | None = None) -> Goal:
    """`bound` at every time for integrals that start at zero (or at `start`), since its margin does not decrease."""
    begin = dict.fromkeys(rates, zero) | (start or {}) | {c: c for c in constant}
    signs = tuple(greater(c, 0) for c in constant if c.is_positive)
    return Goal((bound,), signs, rates | dict.fromkeys(constant, zero), always, begin,
                decreasing=-bound.margin if decreasing is None else decreasing)


left, right, tilde_before, hat_before = sp.symbols("L R tilde_prev hat_prev", real=True)
# Equations of the change over an iteration and of the first iteration; the gain's index, the squared error, what drives
# it, the squared true parameter.
LEARNED = (
    ("27", "39", "v", r"\mathrm{tr}(\tilde\Theta_{v,i}^2)", r"z_{2,i}^T\tilde\Theta_{v,i}v_{i}",
     r"\mathrm{tr}(\Theta_v^2)", EACH_CAR),
    ("28", "40", "a", r"\tilde\theta_{a,i}^2", r"z_{2,i}^T\phi(v_{i})\tilde\theta_{a,i}", r"\theta_a^2", EVERY_TRAIN),
    ("29", "41", "k", r"\tilde\theta_{k,i}^2", r"z_{2,i}^TAs_{i}\tilde\theta_{k,i}", r"\theta_k^2", EVERY_TRAIN),
    ("30", "42", "d", r"\tilde\theta_{d,i}^2", r"z_{2,i}^TAv_{i}\tilde\theta_{d,i}", r"\theta_d^2", EVERY_TRAIN),
    ("31", "43", r"\eta", r"\|\tilde\eta_{i}\|^2", r"z_{2,i}^T\tilde\eta_{i}", r"\|\eta\|^2", EACH_CAR),
)


def _learning_bound(number: int) -> None:
    """(27)-(31): the change of an integral of squared errors of one estimate over an iteration."""
    equation, _, index, square, term, _, scope = LEARNED[number]
    gain, step = learning_gains[number], one_car(learning_steps[number])
    before = square.replace("i}", "i-1}")

    @paper.claim(equation, f"Change of the squared error with gain {gain}", "inequality",
                 rf"\tfrac1{{2\gamma_{index}}}\int_0^t({square} - {before})d\tau \le c_3\int_0^t{term}\,d\tau",
                 "proved", scope=scope,
                 note="With the equalities that (27) prints on the way. What is dropped is the square of the step. It "
                      "supposes the same true parameter in both iterations; see 31.place.")
    def change() -> Goal:
        tilde, hat = tilde_before + step, hat_before + step
        true = hat_before - tilde_before
        squared = (tilde**2 - tilde_before**2) / (2 * gain)
        goal = integrated({left: squared, right: step / gain * tilde}, at_most(left, right), constant=(gain,))
        lines = (equal(squared, (hat_before - hat) * (2 * true - hat - hat_before) / (2 * gain)),
                 equal(squared, (hat - hat_before) * tilde / gain - (hat_before - hat) ** 2 / (2 * gain)))
        return replace(goal, show=(*lines, *goal.show))


for number in range(5):
    _learning_bound(number)

place, place_before, slope = sp.symbols("s s_prev f_slope", real=True)


@paper.claim("31.place", "The additional resistance is the same in two iterations", "implication",
             r"f^a_{i,j}(t) = f^a(s_{i,j}(t)) \Rightarrow \text{(31)}", "gap",
             scope=EACH_CAR,
             note="The paper ascribes f^a to slopes, tunnels and bridges and takes it for a function of time alone. "
                  "These depend on the place, and two iterations are at different places at the same time, so eta "
                  "differs between them and (31) fails; in the counterexample f^a is linear in the place. (31) itself "
                  "stands for an f^a of time alone.")
def same_place_in_every_iteration() -> Goal:
    """(31) at one instant with f^a = f_slope s."""
    hat = tilde_before + slope * place_before + gamma_eta * c_3 * z_car
    tilde = hat - slope * place
    return Goal((at_most((tilde**2 - tilde_before**2) / (2 * gamma_eta), c_3 * z_car * tilde),))


unbounded_step = m_before + mass_step(z_car, a_car)
estimate = limited(unbounded_step, g_low, g_high)  # (22) of one car
mass_within = (at_most(g_low, mass), at_most(mass, g_high))
mass_change = ((estimate - mass) ** 2 - (m_before - mass) ** 2) / (2 * gamma_mass)
mass_bound = -c_3 * z_car * (estimate - mass) * a_car


@paper.claim("32", "Change of the integral for the mass", "inequality",
             r"\tfrac{1}{2\gamma_M}\mathrm{tr}(\tilde M_i^2 - \tilde M_{i-1}^2) \le \tfrac1{\gamma_M}\mathrm{tr}((\hat "
             r"M_{i-1} - \hat M_i)(M - \hat M_i)) = \tfrac1{\gamma_M}\mathrm{tr}((\hat M_{i-1} - \gamma_Mc_3"
             r"\mathcal D(z_{2,i})\mathcal D(\dot v_i) - \hat M_i)(M - \mathrm{sat}(\dots))) - c_3\mathrm{tr}("
             r"\mathcal D(z_{2,i})\mathcal D(\dot v_i)\tilde M_i)", "proved",
             scope=f"{EACH_CAR}; at every instant, hence for the integrals")
def mass_step_limited() -> Goal:
    """The dropped square, and (22) put in."""
    middle = (m_before - estimate) * (mass - estimate) / gamma_mass
    return Goal((at_most(mass_change, middle),
                 equal(middle, (unbounded_step - estimate) * (mass - estimate) / gamma_mass + mass_bound)))


@paper.claim("33", "Property 1 applied to the estimate of the mass", "inequality",
             r"\mathrm{tr}((\hat M_{i-1} - \gamma_Mc_3\mathcal D(z_{2,i})\mathcal D(\dot v_i) - \hat M_i)(M - "
             r"\mathrm{sat}(\dots, \underline M, \overline M))) \le 0", "proved", premises=("6",), scope=EACH_CAR)
def mass_projection() -> Goal:
    """With Assumption 1."""
    return Goal((at_most((unbounded_step - estimate) * (mass - estimate), 0),), mass_within)


@paper.claim("34", "Bound of the change for the mass", "inequality",
             r"\tfrac{1}{2\gamma_M}\int_0^t\mathrm{tr}(\tilde M_i^2 - \tilde M_{i-1}^2)d\tau \le -c_3\int_0^t "
             r"z_{2,i}^T\tilde M_i\dot v_i\,d\tau", "proved", premises=("32", "33"), scope=EACH_CAR)
def mass_integral() -> Goal:
    """Between integrals, with (22) as it stands and Assumption 1 at every instant."""
    return integrated({left: mass_change, right: mass_bound}, at_most(left, right),
                      (*mass_within, greater(mass, 0)), (gamma_mass,))


@paper.claim("22.form", "The saturation of (22), without cases", "identity",
             r"\hat m = \mathrm{sat}(h,\underline m,\overline m),\ p = \max(h - \overline m, 0),\ q = "
             r"\max(\underline m - h, 0) \Rightarrow \hat m = h - p + q,\ p(\overline m - \hat m) = q(\hat m - "
             r"\underline m) = 0",
             "proved", scope=EACH_CAR,
             note="The form in which (22) enters 35.whole and 45.gain, where it stands under a sum.")
def saturation_form() -> Goal:
    """Complementarity of the projection on an interval."""
    sat, p, q_ = limited(h, g_low, g_high), sp.Max(h - g_high, 0), sp.Max(g_low - h, 0)
    return Goal((*both(sat, h - p + q_), *both(p * (g_high - sat), zero), *both(q_ * (sat - g_low), zero)),
                (at_most(g_low, g_high),))


# (22) under the sums: M_hat_i = M_hat_prev - gamma_M c_3 z_2 v_dot - P^2 + Q^2 with P^2 (M_high - M_hat_i) = 0 =
# Q^2 (M_hat_i - M_low), and Assumption 1: M_high = M + A^2, M_low = M - B^2 (22.form).
P, Q, room_above, room_below, M_step = each_car("P Q A B M_step")


def mass_rule(step: sp.Expr) -> tuple[Relation, ...]:
    """(22) times M_tilde, for a step M_hat_i - M_hat_prev, and its complementarity, which hold car by car."""
    return (equal(over_cars(M_tilde * (step + gamma_mass * c_3 * z_2 * v_dot + P**2 - Q**2)), 0),
            equal(over_cars(P**2 * (room_above**2 - M_tilde)), 0),
            equal(over_cars(Q**2 * (M_tilde + room_below**2)), 0))


def each_estimate(left_sides: tuple[sp.Expr, ...], wrong: tuple[sp.Expr, ...]) -> tuple[Relation, ...]:
    """Lemmas: Property 1 under the sum, and each left side against minus its term of `estimation_terms`."""
    terms = zip(left_sides, estimation_terms(z_2, wrong), strict=True)
    return (at_least(over_cars(M_tilde * (P**2 - Q**2)), 0), *(at_most(x, -term) for x, term in terms))


rolling_before, *scalars_before, rest_before = (x - step for x, step in zip(tildes, learning_steps, strict=False))
squares_before = (over_cars(rolling_before**2), *(x**2 for x in scalars_before), over_cars(rest_before**2),
                  over_cars((M_tilde - M_step) ** 2))


@paper.claim("35.whole", "The CEF does not increase: the whole argument in one certificate", "implication",
             r"\frac{d}{dt}(E_i - E_{i-1} + V_{i-1}) \le -c_1\|z_{1,i}\|^2 - c_2\|z_{2,i}\|^2\ \text{along (7), (9), "
             r"(16) with (17)-(22)}", "proved", premises=("22.form",), scope=EVERY_TRAIN,
             note="The checker derives V' from (23), the plant and the law by itself and puts the learning rules in, "
                  "without resting on the paper's intermediate lines. Integrated in 35 and 35.kept.")
def cef_whole() -> Goal:
    """D(V) along the closed loop, and the change of all squares by the learning rules."""
    changes = tuple(now - before for now, before in zip(halved(squares), halved(squares_before), strict=True))
    return Goal((at_most(D(V) + sp.Add(*changes), decay),), (*sums_named, *mass_rule(M_step)), flow,
                lemmas=each_estimate(changes, tildes))


V_now, V_before, changes, Z_1, Z_2 = sp.symbols("V_i V_prev C Z_1 Z_2", real=True)
V_rate, C_rate = sp.symbols("w_V w_C", real=True)
z_1_square, z_2_square = sp.symbols("z_1_square z_2_square", nonnegative=True)


def _cef_step(kept: bool) -> Goal:
    """E_i - E_{i-1} = V_i - V_{i-1} + C, C being the changes of the integrals (27)-(31), (34)."""
    rates = {V_now: V_rate, changes: C_rate, Z_1: z_1_square, Z_2: z_2_square}
    bound = -c_1 * Z_1 - c_2 * Z_2 - (V_before if kept else 0)
    always = (at_most(V_rate + C_rate, -c_1 * z_1_square - c_2 * z_2_square), at_least(z_1_square, 0),
              at_least(z_2_square, 0), at_least(V_before, 0))
    goal = integrated(rates, at_most(V_now - V_before + changes, bound), always, (c_1, c_2),
                      decreasing=V_now + changes + c_1 * Z_1 + c_2 * Z_2)
    return replace(goal, assume=(*goal.assume, at_least(V_before, 0)))


def _cef_claim(equation: str, title: str, kept: str, note: str) -> None:
    @paper.claim(equation, title, "implication",
                 rf"\Delta E_i \le {kept}-c_1\int_0^t\|z_{{1,i}}\|^2d\tau - c_2\int_0^t\|z_{{2,i}}\|^2d\tau", "proved",
                 premises=("24", "27", "28", "29", "30", "31", "34", "A3.lambda"), note=note)
    def cef_step() -> Goal:
        return _cef_step(kept=bool(kept))


_cef_claim("35", "The CEF does not increase", "",
           "Under A3.lambda, on which V_i(0) = 0 rests. The term -V_{i-1}(t) is dropped; see 35.kept.")
_cef_claim("35.kept", "The same with the term that (35) drops", "-V_{i-1} ",
           "What the paper's own steps give; the convergence at every instant needs this term.")


# --- Theorem 1, step 2: E_1 is bounded, the errors z converge -----------------------------------------------


def _first_rate(printed: bool) -> Goal:
    factors = [half, 1 if printed else half, *[half] * 4]
    terms = sum((f * x / gain for f, x, gain in zip(factors, squares, learning_gains, strict=True)), zero)
    stated = sp.Add(*estimation_terms(z_2, tildes)) + terms + (0 if printed else decay)
    return Goal((equal(D(E), stated),), flow=cef_flow)


@paper.claim("36", "Rate of the CEF in the first iteration", "identity",
             r"\dot E_1 = -c_3z_{2,1}^T\tilde\Theta_{v,1}v_1 + \tfrac1{2\gamma_v}\mathrm{tr}(\tilde\Theta_{v,1}^2) - "
             r"c_3z_{2,1}^T\tilde\theta_{a,1}\phi(v_1) + \tfrac1{\gamma_a}\tilde\theta_{a,1}^2 - \dots + "
             r"c_3z_{2,1}^T\tilde M_1\dot v_1 + \tfrac1{2\gamma_M}\mathrm{tr}(\tilde M_1^2)", "refuted",
             premises=("24",), scope=EVERY_TRAIN, correction=lambda: _first_rate(printed=False),
             corrected_statement=r"\dot E_1 = -c_1\|z_{1,1}\|^2 - c_2\|z_{2,1}\|^2 - c_3z_{2,1}^T\tilde\Theta_{v,1}v_1 "
                                 r"+ \tfrac1{2\gamma_v}\mathrm{tr}(\tilde\Theta_{v,1}^2) - "
                                 r"c_3z_{2,1}^T\tilde\theta_{a,1}\phi(v_1) + \tfrac1{2\gamma_a}\tilde\theta_{a,1}^2 - "
                                 r"\dots",
             note="Cosmetic: the two squares of (24) are missing, and 1/gamma_a should be 1/(2 gamma_a), as in (25) "
                  "and (40). With <= instead of = the printed line is true, which is all (45) needs. An index i for 1 "
                  "and a missing transpose are read as glyphs.")
def first_rate() -> Goal:
    """D(E_1) of (25) along the closed loop."""
    return _first_rate(printed=True)


first_errors = tuple(step - true for step, true in zip(learning_steps, true_parameters, strict=True))  # from hat_0 = 0
Theta_1 = first_errors[0]


@paper.claim("37", "The first estimate against the initial one", "identity",
             r"\tfrac1{2\gamma_v}\mathrm{tr}(\tilde\Theta_{v,1}^2) = \tfrac1{2\gamma_v}\mathrm{tr}("
             r"\tilde\Theta_{v,1}^2 - \tilde\Theta_{v,0}^2) + \tfrac1{2\gamma_v}\mathrm{tr}(\Theta_v^2)", "proved",
             scope=EVERY_TRAIN)
def first_estimate() -> Goal:
    """With the initial estimate 0 of (17)."""
    initial_error = 0 - Theta
    now, before, true = (over_cars(x**2) / (2 * gamma_v) for x in (Theta_tilde, initial_error, Theta))
    return Goal((equal(now, now - before + true),))


@paper.claim("38", "(27) without the integrals, in the first iteration", "inequality",
             r"\tfrac1{2\gamma_v}\mathrm{tr}(\tilde\Theta_{v,1}^2 - \tilde\Theta_{v,0}^2) \le "
             r"c_3z_{2,1}^T\tilde\Theta_{v,1}v_1", "proved", premises=("27",), scope=EVERY_TRAIN,
             note="(27) compares integrals; its proof holds at every instant, which is used here.")
def first_change() -> Goal:
    """With (17) from the initial estimate 0."""
    change = (over_cars(Theta_1**2) - over_cars(Theta**2)) / (2 * gamma_v)
    return Goal((at_most(change, c_3 * over_cars(z_2 * Theta_1 * v)),))


def _first_bound(equation: str, gain: sp.Symbol, latex: str, bound: tuple[sp.Expr, sp.Expr], scope: str,
                 premises: tuple[str, ...], assume: tuple[Relation, ...] = ()) -> None:
    """(39)-(44): what one estimate adds to the rate of E_1, against its true parameter."""

    @paper.claim(equation, f"The estimate with gain {gain} in the rate of the first CEF", "inequality",
                 latex, "proved", premises=premises, scope=scope)
    def first_bound() -> Goal:
        return Goal((at_most(*bound),), assume)


for number, (change, equation, index, square, term, at_true, scope) in enumerate(LEARNED):
    gain, error = learning_gains[number], one_car(first_errors[number])
    driven, true = one_car(driven_by[number]), one_car(true_parameters[number])
    added = rf"-c_3{term} + \tfrac1{{2\gamma_{index}}}{square}".replace("i}", "1}")
    _first_bound(equation, gain, rf"{added} \le \tfrac1{{2\gamma_{index}}}{at_true}",
                 (error**2 / (2 * gain) - c_3 * driven * error, true**2 / (2 * gain)), scope,
                 ("37", "38") if equation == "39" else (change,))
from_lowest = {m_before: g_low}  # M_hat_0 is the lower bound
_first_bound("44", gamma_mass, r"c_3z_{2,1}^T\tilde M_1\dot v_1 + \tfrac1{2\gamma_M}\mathrm{tr}(\tilde M_1^2) \le "
             r"\tfrac1{2\gamma_M}\mathrm{tr}((\underline M - M)^2)",
             ((-mass_bound + (estimate - mass) ** 2 / (2 * gamma_mass)).xreplace(from_lowest),
              (g_low - mass) ** 2 / (2 * gamma_mass)), EACH_CAR, ("32", "33"), mass_within)

at_start = halved((over_cars(Theta**2), *(x**2 for x in theta), over_cars(eta**2), over_cars(room_below**4)))


def _first_energy() -> Goal:
    """(45) with 1/(2 gamma_v), for every train; the first step of the mass starts from M_low = M - B^2."""
    wrong = (*first_errors, M_tilde)
    first = dict(zip(tildes, wrong, strict=True))
    added = tuple(now.xreplace(first) - true for now, true in zip(halved(squares), at_start, strict=True))
    return Goal((at_most(D(E), sp.Add(*at_start)),), (*sums_named, *mass_rule(M_tilde + room_below**2)),
                {x: rate.xreplace(first) for x, rate in cef_flow.items()}, lemmas=each_estimate(added, wrong))


REST_OF_45 = (r"\tfrac1{2\gamma_a}\theta_a^2 + \tfrac1{2\gamma_k}\theta_k^2 + \tfrac1{2\gamma_d}\theta_d^2 + "
              r"\tfrac1{2\gamma_\eta}\|\eta\|^2 + \tfrac1{2\gamma_M}\mathrm{tr}((\underline M - M)^2)")
GAIN_45 = rf"\dot E_1 \le \tfrac1{{2\gamma_v}}\mathrm{{tr}}(\Theta_v^2) + {REST_OF_45}"


@paper.claim("45", "The rate of the first CEF is bounded", "inequality",
             rf"\dot E_1 \le \tfrac12\mathrm{{tr}}(\Theta_v^2) + {REST_OF_45}", "refuted",
             premises=("36", "39", "40", "41", "42", "43", "44"), correction=_first_energy, corrected_statement=GAIN_45,
             scope="refuted for a train of one car at an instant with z_2 = 0; corrected for every train",
             note="A slip: 1/gamma_v is missing before tr(Theta_v^2), see (39). For gamma_v < 1 the printed bound is "
                  "false; at the stated gamma_v = 10 it holds. That E_1 is bounded follows either way, see 45.bounded.")
def first_energy() -> Goal:
    """D(E_1) along the closed loop where z_2 = 0, so that all first estimates are the initial ones."""
    car_M, car_tilde = (sp.Symbol(name_of(x), real=True) for x in (M, M_tilde))
    initial = {one_car(x): -one_car(true) for x, true in zip(tildes, true_parameters, strict=False)}
    rates = {one_car(x): one_car(rate).xreplace(initial | {car_tilde: g_low - car_M}) for x, rate in cef_flow.items()}
    bound = one_car(over_cars(Theta**2) / 2 + sp.Add(*at_start[1:5])) + (g_low - car_M) ** 2 / (2 * gamma_mass)
    return Goal((at_most(D(one_car(E)), bound),), (equal(one_car(z_2), 0), at_most(g_low, car_M)), rates)


@paper.claim("45.gain", "(45) with 1/gamma_v", "inequality", GAIN_45, "proved", premises=("22.form",),
             scope=EVERY_TRAIN, note="From (25), the plant and the laws in one certificate; later claims rest on this "
                                     "one.")
def first_energy_with_gain() -> Goal:
    """D(E_1) along the closed loop with the first estimates."""
    return _first_energy()


bound_rate, E_1, clock = sp.symbols("beta E_1 t", real=True)
E_rate = sp.Symbol("w_E", real=True)


@paper.claim("45.bounded", "E_1 is bounded on [0, T]", "implication",
             r"\dot E_1 \le \beta,\ E_1(0) = 0 \Rightarrow E_1(t) \le \beta t", "proved",
             premises=("45.gain", "A3.lambda"),
             note="beta is the largest value of the right side of 45.gain on [0, T]. It rests on solutions that "
                  "exist on [0, T]; bounded parameters suffice, the paper asks for continuous ones.")
def first_energy_bounded() -> Goal:
    """(45) integrated."""
    return integrated({clock: sp.Integer(1), E_1: E_rate}, at_most(E_1, bound_rate * clock),
                      (at_most(E_rate, bound_rate),), (bound_rate,))


E_now, E_before, S_1, S_2 = sp.symbols("E_i E_prev S_1 S_2", real=True)


def _telescoped(kept: bool) -> Goal:
    """From i-1 to i; at i = 1 the sums are empty."""
    S_V = sp.Symbol("S_V", real=True)
    tail = S_V if kept else zero
    step = -c_1 * Z_1 - c_2 * Z_2 - (V_before if kept else 0)
    return Goal((at_most(E_now, E_1 - c_1 * (S_1 + Z_1) - c_2 * (S_2 + Z_2) - (tail + V_before if kept else 0)),),
                (at_most(E_now - E_before, step), at_most(E_before, E_1 - c_1 * S_1 - c_2 * S_2 - tail)))


SUMS_46 = r"c_1\sum_{k=2}^i\int_0^t\|z_{1,k}\|^2d\tau - c_2\sum_{k=2}^i\int_0^t\|z_{2,k}\|^2d\tau"
LIMITS_47 = rf"\lim_{{i\to\infty}}({SUMS_46.replace(' - ', ' + ')})"


def _telescoped_claim(equation: str, title: str, kept: str, premise: str) -> None:
    @paper.claim(equation, title, "implication", rf"E_i \le E_1 - {kept}{SUMS_46}", "proved", premises=(premise,),
                 note="The step of the induction over i; S_1, S_2 (and S_V) are the sums up to i - 1, empty at the "
                      "start.")
    def telescoped() -> Goal:
        return _telescoped(kept=bool(kept))


_telescoped_claim("46", "The CEF after i iterations", "", "35")
_telescoped_claim("46.kept", "The same with the term that (35) drops", r"\sum_{k=1}^{i-1}V_k(t) - ", "35.kept")


E_limit = sp.Symbol("E_limit", real=True)


def _limit(relation: Relation) -> Goal:
    return Goal((relation,), (at_most(E_limit, E_1 - c_1 * S_1 - c_2 * S_2), at_least(E_limit, 0), at_least(S_1, 0),
                              at_least(S_2, 0)))


@paper.claim("47", "The limit of (46)", "limit",
             rf"\lim_{{i\to\infty}}E_i = E_1 - {LIMITS_47}", "gap", premises=("46",),
             correction=lambda: _limit(at_most(E_limit, E_1 - c_1 * S_1 - c_2 * S_2)),
             corrected_statement=rf"\lim_{{i\to\infty}}E_i \le E_1 - {LIMITS_47}",
             note="Cosmetic: the limit of the inequality (46) is an inequality; the dropped squares and V_{i-1} make "
                  "up the difference. E_i does not increase and is not negative, so the limits exist, and (48) needs "
                  "<= alone.")
def cef_limit() -> Goal:
    """Equality of the limits from (46)."""
    return _limit(equal(E_limit, E_1 - c_1 * S_1 - c_2 * S_2))


iteration, iterations = sp.symbols("k i", integer=True, positive=True)
large_1, rest_1, large_2, rest_2 = (sp.IndexedBase(x, real=True)[iteration] for x in ("b_1", "r_1", "b_2", "r_2"))
delta = sp.Symbol("delta", positive=True)


def over_iterations(summand: sp.Expr) -> sp.Expr:
    """Sum over the iterations."""
    return sp.Sum(summand, (iteration, 1, iterations))


# A term >= 0 is b^2 delta + r^2 with b = 1 where it is at least delta, else b = 0: the sum of b^2 counts those.
terms_1, terms_2 = (over_iterations(b_k**2 * delta + r_k**2) for b_k, r_k in ((large_1, rest_1), (large_2, rest_2)))
count_1, count_2 = over_iterations(large_1**2), over_iterations(large_2**2)


@paper.claim("48", "The integrals of the errors z converge to zero", "limit",
             r"\lim_{i\to\infty}\int_0^t\|z_{1,i}\|^2d\tau = 0,\quad \lim_{i\to\infty}\int_0^t\|z_{2,i}\|^2d\tau = 0",
             "proved", premises=("25", "46", "45.bounded"),
             note="Decided with the number named: at most E_1/(c_1 delta) iterations have an integral of z_1 of at "
                  "least delta, for every delta > 0; likewise E_1/(c_2 delta) for z_2. It does not need (47).")
def integrals_converge() -> Goal:
    """The count of iterations with a large integral, from (46) and E_i >= 0."""
    shown = (at_most(c_1 * delta * count_1, E_1), at_most(c_2 * delta * count_2, E_1))
    return Goal(shown, (at_least(E_now, 0), at_most(E_now, E_1 - c_1 * terms_1 - c_2 * terms_2)))


def along_iterations(shown: Relation, always: tuple[Relation, ...], model: dict[sp.Symbol, sp.Expr],
                     constants: dict[sp.Symbol, sp.Expr]) -> Goal:
    """`shown` from some iteration on; the iteration i runs as a real number, and `model` shall break the claim."""
    rates = {x: sp.Symbol(f"w_{x}", real=True) for x in model}
    first = {x: sp.Symbol(f"{x}_0", real=True) for x in model}
    at_first = {first[x]: value.xreplace({i_axis: zero} | constants) for x, value in model.items()}
    return Goal((shown,), (), {i_axis: sp.Integer(1), **rates}, always, {i_axis: zero, **first}, eventually=i_axis,
                model=model | constants | at_first)


i_axis, J_i, y_i = sp.symbols("i J y", real=True)
level = sp.Symbol("B", positive=True)


def _instants_converge() -> Goal:
    """The count of iterations with V_k(t) >= delta, from 46.kept."""
    return Goal((at_most(delta * count_1, E_1),), (at_least(E_now, 0), at_most(E_now, E_1 - terms_1)))


@paper.claim("55.pointwise", "(48) makes z converge at every instant", "limit",
             r"\int_0^t\|z_i\|^2d\tau \to 0 \Rightarrow z_i(t) \to 0\ \text{(pointwisely)}", "gap", premises=("48",),
             correction=_instants_converge,
             corrected_statement=r"\#\{k: V_k(t) \ge \delta\} \le \tfrac{E_1(t)}{\delta}\ \text{for every } t, \delta "
                                 r"> 0",
             note="Integrals do not control instants: z_i(tau) = tau^(i+1) on [0, 1] has the integral 1/(2i+3) of its "
                  "square and z_i(1) = 1 in every iteration. The conclusion is nevertheless true: the term V_{i-1}(t) "
                  "that (35) drops gives it, see theorem1.2.")
def pointwise_from_integrals() -> Goal:
    """y = |z_i(1)|^2 from the integral J of |z_i|^2, which tends to zero."""
    always = (at_most(J_i, 1 / (2 * i_axis + 3)), at_least(J_i, 0), at_least(y_i, 0), at_least(i_axis, 0))
    return along_iterations(at_most(y_i, half), always, {J_i: 1 / (2 * i_axis + 3), y_i: sp.Integer(1)}, {})


@paper.claim("theorem1.2", "Theorem 1, part 2: z_1 and z_2 converge to 0 along the iteration axis", "limit",
             r"\lim_{i\to\infty}z_{1,i}(t) = 0,\ \lim_{i\to\infty}z_{2,i}(t) = 0", "proved",
             premises=("25", "46.kept", "45.bounded"),
             note="At every instant, not only as integrals: at most E_1(t)/delta iterations have V_k(t) >= delta. By "
                  "35.kept, not by the printed way over (48). It supposes that iterations differ in nothing but the "
                  "estimates (31.place) and that the loop through the acceleration is solved.")
def z_converges() -> Goal:
    """The count of iterations with a large V at an instant."""
    return _instants_converge()


# --- the auxiliary system -----------------------------------------------------------------------------------

c_z = sp.Symbol("c_z", positive=True)
minimum_z = (at_most(c_z, c_1), at_most(c_z, c_2))
lam_1, lam_2, delta_car = sp.symbols("lambda_1 lambda_2 Delta_u", real=True)
V_lambda = V_of(lambda_1) + V_of(lambda_2)
c_lambda = sp.Symbol("c_lambda", real=True)
minimum_lambda = tuple(at_most(c_lambda, x) for x in c_lambda_candidates)


@paper.claim("49.rate", "Rate of V_lambda", "identity",
             r"\dot V_{\lambda,i} = -c_1\|\lambda_{1,i}\|^2 + \lambda_{1,i}^T\lambda_{2,i} - c_2\|\lambda_{2,i}\|^2 + "
             r"c_3\lambda_{2,i}^T\Delta u_i", "proved", scope=EVERY_TRAIN)
def auxiliary_rate() -> Goal:
    """D(V_lambda) along (9)."""
    stated = (-c_1 * over_cars(lambda_1**2) + over_cars(lambda_1 * lambda_2) - c_2 * over_cars(lambda_2**2)
              + c_3 * over_cars(lambda_2 * Delta_u))
    return Goal((equal(D(V_lambda), stated),), flow=auxiliary)


def _young(sign: int) -> Goal:
    bound = (-(c_1 + sign * half) * over_cars(lambda_1**2) - (c_2 - half - c_3 / 2) * over_cars(lambda_2**2)
             + c_3 * over_cars(Delta_u**2) / 2)
    return Goal((at_most(D(V_lambda), bound),), flow=auxiliary)


@paper.claim("49", "Young's inequality for V_lambda", "inequality",
             r"\dot V_{\lambda,i} \le -(c_1 + \tfrac12)\|\lambda_{1,i}\|^2 - (c_2 - \tfrac12 - "
             r"\tfrac{c_3}2)\|\lambda_{2,i}\|^2 + \tfrac{c_3}2\|\Delta u_i\|^2", "refuted", premises=("49.rate",),
             scope=EVERY_TRAIN, correction=lambda: _young(-1),
             corrected_statement=r"\dot V_{\lambda,i} \le -(c_1 - \tfrac12)\|\lambda_{1,i}\|^2 - (c_2 - \tfrac12 - "
                                 r"\tfrac{c_3}2)\|\lambda_{2,i}\|^2 + \tfrac{c_3}2\|\Delta u_i\|^2",
             note="As the extracted text has it, with c_1 + 1/2. The next line and c_lambda use c_1 - 1/2, so this is "
                  "a slip of one sign; should the page show a minus, it is none.")
def auxiliary_young() -> Goal:
    """D(V_lambda) along (9) against the printed bound."""
    return _young(1)


@paper.claim("49.last", "The last line of (49)", "inequality",
             r"\dot V_{\lambda,i} \le -c_\lambda(\|\lambda_{1,i}\|^2 + \|\lambda_{2,i}\|^2) + "
             r"\tfrac{c_3}2\|\Delta u_i\|^2,\ c_\lambda = \min(c_1 - \tfrac12, c_2 - \tfrac12 - \tfrac{c_3}2)",
             "proved", premises=("49.rate",), scope=EVERY_TRAIN,
             note="From (9) itself, so it does not rest on the printed 49.")
def auxiliary_decay() -> Goal:
    """D(V_lambda) along (9) against the bound with c_lambda."""
    bound = -c_lambda * over_cars(lambda_1**2 + lambda_2**2) + c_3 * over_cars(Delta_u**2) / 2
    return Goal((at_most(D(V_lambda), bound),), minimum_lambda, auxiliary)


@paper.claim("49.stated", "c_lambda is a positive constant at the stated gains", "condition",
             r"c_\lambda = \min(c_1 - \tfrac12, c_2 - \tfrac12 - \tfrac{c_3}2) > 0", "violated", at=stated_gains,
             repair={**stated_gains, c_1: Fraction(1)},
             note="The paper's own condition below (49). c_1 = 0.01 gives c_lambda = -0.49, so (51), (54), (55) and "
                  "part 3 of Theorem 1 say nothing about the simulation. Besides c_1 > 1/2 there is another way out: "
                  "51.any_gains holds for all positive gains.")
def auxiliary_gain_positive() -> Goal:
    """Both entries of the minimum."""
    return Goal(tuple(greater(r.right, 0) for r in minimum_lambda))


X, Y, V_aux, V_aux_0, rate_aux, x_rate, y_rate = sp.symbols("X Y V_lambda V_lambda_0 w_lambda x y", real=True)


@paper.claim("50", "(49) integrated", "implication",
             rf"V_{{\lambda,i}}(T) - V_{{\lambda,i}}(0) \le -c_\lambda{INT_LAMBDA} + \tfrac{{c_3}}2{INT_U}",
             "proved", premises=("49.last",))
def auxiliary_integrated() -> Goal:
    """For any sign of c_lambda."""
    always = (at_most(rate_aux, -c_lambda * x_rate + c_3 * y_rate / 2),)
    return integrated({V_aux: rate_aux, X: x_rate, Y: y_rate}, at_most(V_aux - V_aux_0, -c_lambda * X + c_3 * Y / 2),
                      always, (c_lambda, c_3), {V_aux: V_aux_0}, V_aux + c_lambda * X - c_3 * Y / 2)


c_lambda_positive = sp.Symbol("c_lambda", positive=True)


@paper.claim("51", "The auxiliary state against the saturation", "implication",
             rf"c_\lambda > 0 \Rightarrow {INT_LAMBDA} \le \tfrac{{c_3}}{{2c_\lambda}}{INT_U}", "proved",
             premises=("50",),
             note="With V_lambda(0) = 0, which the paper takes for a fact, and c_lambda > 0; see 49.stated.")
def auxiliary_bound() -> Goal:
    """(50) with V_lambda(0) = 0 <= V_lambda(T)."""
    integrated_50 = at_most(V_aux, -c_lambda_positive * X + c_3 * Y / 2)
    return Goal((at_most(X, c_3 * Y / (2 * c_lambda_positive)),), (integrated_50, at_least(V_aux, 0)))


@paper.claim("51.any_gains", "A bound in place of (51) for all positive gains", "implication",
             rf"{INT_LAMBDA} \le \left(\tfrac{{c_3}}{{c_2}}\right)^2\left(1 + \tfrac{{1}}{{c_1^2}}\right){INT_U}",
             "proved", scope=EACH_CAR,
             note="Not in the paper. It needs no c_lambda > 0; at the stated gains the factor is 0.0016.")
def auxiliary_bound_any_gains() -> Goal:
    """From (9): int lambda_2^2 <= (c_3/c_2)^2 int Delta_u^2 and int lambda_1^2 <= int lambda_2^2 / c_1^2."""
    rates = {one_car(x): one_car(rate) for x, rate in auxiliary.items()}
    storage = lam_1**2 / c_1 + (1 + 1 / c_1**2) * lam_2**2 / c_2
    return integrated({**rates, X: lam_1**2 + lam_2**2, Y: delta_car**2}, at_most(X, any_gains * Y), (), gains,
                      decreasing=X + storage - any_gains * Y)


@paper.claim("remark5", "Remark 5: the auxiliary state decays when the saturation ends", "implication",
             r"\Delta u_i = 0 \Rightarrow \dot W \le -\min(c_1, c_2)W,\ W = \lambda_1^2 + \tfrac{1}{c_1c_2}\lambda_2^2",
             "proved", scope=EACH_CAR,
             note="The remark is printed in words. It holds for all positive gains, exponentially, at the stated gains "
                  "with a time constant of 1/c_1 = 100 s for lambda_1.")
def auxiliary_forgets() -> Goal:
    """A decreasing function of the state of (9) without input; c_z <= c_1, c_2."""
    W = lam_1**2 + lam_2**2 / (c_1 * c_2)
    rates = {one_car(x): one_car(rate).xreplace({delta_car: zero}) for x, rate in auxiliary.items()}
    return Goal((at_most(D(W), -c_z * W),), minimum_z, rates)


# --- Theorem 1, part 3: the bounds of the tracking errors ---------------------------------------------------


@paper.claim("52.stated", "c_z is positive at the stated gains", "condition", r"c_z = \min(c_1, c_2) > 0", "proved",
             at={g_: x for g_, x in stated_gains.items() if g_ != c_3}, note="c_z = 0.01.")
def z_gain_positive() -> Goal:
    """Both entries of the minimum."""
    return Goal(tuple(greater(r.right, 0) for r in minimum_z))


@paper.claim("52", "The integrals of z against the CEF", "implication",
             rf"{INT_Z} \le \tfrac1{{c_z}}(E_{{i-1}} - E_i) \le \tfrac1{{c_z}}E_{{i-1}}", "proved",
             premises=("25", "35"))
def z_against_cef() -> Goal:
    """(35) at t = T, with E_i >= 0."""
    given = (at_most(E_now - E_before, -c_1 * Z_1 - c_2 * Z_2), at_least(E_now, 0), at_least(Z_1, 0), at_least(Z_2, 0))
    return Goal((at_most(Z_1 + Z_2, (E_before - E_now) / c_z), at_most((E_before - E_now) / c_z, E_before / c_z)),
                (*minimum_z, *given))


path_a, path_b, tau = sp.symbols("a_0 b_0 tau", real=True)


e_s, e_v, S_e, W_e, Z_e, L_e = sp.symbols("e_s e_v S W Z L", real=True)
z_in_errors = tuple(one_car(expr.xreplace({v: e_v + v_r}).xreplace({s: e_s + s_r})) for expr in errors.values())  # (10)


def _on_a_path() -> Goal:
    """(53) for one car on e_s = tau^2 (a_0 + b_0 tau), T = 1, where z = lambda: the right side is |z + lambda|^2."""
    path = tau**2 * (path_a + path_b * tau)
    put = {e_s: path, e_v: sp.diff(path, tau), lam_1: zero, lam_2: zero}  # z + lambda is z with lambda left out
    sides = ((1 + c_1) * e_s**2 + e_v**2, sum((z**2 for z in z_in_errors), zero))
    return Goal((at_most(*(sp.integrate(sp.expand(side.xreplace(put)), (tau, 0, 1)) for side in sides)),))


def _integrals_of_errors() -> Goal:
    """(53) with 1 + c_1^2 for every path from e_s = 0: (1 + c_1^2) S + W - 2Z - 2L + c_1 e_s^2 does not increase."""
    rates = {e_s: e_v, S_e: e_s**2, W_e: e_v**2, Z_e: sum((z**2 for z in z_in_errors), zero),
             L_e: lam_1**2 + lam_2**2}
    bound = at_most((1 + c_1**2) * S_e + W_e, 2 * Z_e + 2 * L_e)
    return integrated(rates, bound, (), (c_1,), decreasing=c_1 * e_s**2 - bound.margin)


SQUARED_53 = rf"\int_0^T[(1 + c_1^2)\|e_{{s,i}}\|^2 + \|e_{{v,i}}\|^2]d\tau \le 2{INT_Z} + 2{INT_LAMBDA}"


@paper.claim("53", "The tracking errors against z and lambda", "inequality",
             rf"\int_0^T[(1 + c_1)\|e_{{s,i}}\|^2 + \|e_{{v,i}}\|^2]d\tau \le 2{INT_Z} + 2{INT_LAMBDA}", "refuted",
             scope="refuted for one car; corrected for every car and every path", correction=_integrals_of_errors,
             corrected_statement=SQUARED_53,
             note="False for c_1 < 1 (stated: 0.01), with c_1^2 in place of c_1 true for every c_1. Decided on paths "
                  "with e_s(0) = e_v(0) = 0 that obey (10) and (12) with z = lambda; e_s = tau^2 (1 - tau), which "
                  "comes back to 0, breaks it for every c_1 < 1. Cosmetic: (54) and (55) follow from the corrected "
                  "form as well.")
def errors_against_z() -> Goal:
    """A path that returns to the reference."""
    return _on_a_path()


@paper.claim("53.squared", "(53) with 1 + c_1^2", "implication",
             SQUARED_53, "proved", scope=EACH_CAR,
             note="Later claims rest on this one. It needs e_s(0) = 0 (Assumption 3): the cross term of e_s and e_v "
                  "integrates to c_1 |e_s(T)|^2.")
def errors_against_z_squared() -> Goal:
    """For every path, by a function that does not increase."""
    return _integrals_of_errors()


def _tracking_bound(bound_of_lambda: sp.Expr) -> Goal:
    """Both bounds, from 53.squared, (52) and a bound of the integral L of lambda."""
    given = (at_most((1 + c_1**2) * S_e + W_e, 2 * Z_e + 2 * L_e), at_most(Z_e, E_before / c_z),
             at_most(L_e, bound_of_lambda * Y), at_least(S_e, 0), at_least(W_e, 0))
    bound = 2 * E_before / c_z + 2 * bound_of_lambda * Y
    return Goal((at_most(S_e, bound), at_most(W_e, bound)), given)


PART_3 = rf"\tfrac{{2}}{{c_z}}E_{{i-1}} + \tfrac{{c_3}}{{c_\lambda}}{INT_U}"


def _tracking(equation: str, error: str, which: int) -> None:
    @paper.claim(equation, f"Bound of the error {error}", "implication",
                 rf"\int_0^T\|{error}\|^2d\tau \le {PART_3}", "proved", premises=("51", "52", "53.squared"),
                 note="For c_lambda > 0; see 49.stated. The paper goes over (53), which is false; 53.squared serves.")
    def tracking() -> Goal:
        goal = _tracking_bound(c_3 / (2 * c_lambda_positive))
        return Goal((goal.show[which],), goal.assume)


_tracking("54", "e_{s,i}", 0)
_tracking("55", "e_{v,i}", 1)


@paper.claim("theorem1.3", "Theorem 1, part 3: the tracking errors remain within the bounds", "implication",
             rf"c_\lambda > 0 \Rightarrow \int_0^T\|s_i - s_r\|^2d\tau \le {PART_3},\ \int_0^T\|v_i - "
             rf"v_r\|^2d\tau \le {PART_3}", "proved", premises=("54", "55"),
             note="True for c_lambda > 0. The bound does not shrink with the iterations: E_{i-1} need not tend to "
                  "zero, nor does the saturation (A2). See theorem1.3.stated for the stated gains.")
def tracking_errors_bounded() -> Goal:
    """(54) and (55) together."""
    return _tracking_bound(c_3 / (2 * c_lambda_positive))


at_stated = {symbol: sp.Rational(x.numerator, x.denominator) for symbol, x in stated_gains.items()}


def _tracking_at_stated_gains() -> Goal:
    goal = _tracking_bound(any_gains)
    put = at_stated | {c_z: at_stated[c_1]}
    return Goal(tuple(r.subs(put) for r in goal.show), tuple(r.subs(put) for r in goal.assume))


@paper.claim("theorem1.3.stated", "At the stated gains part 3 bounds integrals of squares by what is not negative",
             "inequality", rf"0 \le {PART_3}\quad (c_1 = 0.01,\ c_2 = 100,\ c_3 = 0.04)", "refuted",
             premises=("49.stated",), correction=_tracking_at_stated_gains,
             corrected_statement=r"\int_0^T\|e_{s,i}\|^2d\tau,\ \int_0^T\|e_{v,i}\|^2d\tau \le 200E_{i-1} + "
                                 r"2\left(\tfrac{c_3}{c_2}\right)^2\left(1 + \tfrac1{c_1^2}\right)" + INT_U,
             note="With c_lambda = -0.49 the second term is negative, so the printed bound would demand errors with "
                  "negative integrals once the saturation is large. Corrected with 51.any_gains.")
def tracking_bound_not_negative() -> Goal:
    """The printed right side for any E_{i-1} and saturation."""
    c_lambda_stated = at_stated[c_1] - half
    bound = 2 * E_before / at_stated[c_1] + at_stated[c_3] / c_lambda_stated * Y
    return Goal((at_least(bound, 0),), (at_least(E_before, 0), at_least(Y, 0)))


# --- Theorem 1, part 1: boundedness -------------------------------------------------------------------------


@paper.claim("theorem1.1.z", "z_1 and z_2 are bounded, uniformly in the iterations", "implication",
             r"\|z_{1,i}(t)\|^2 + \|z_{2,i}(t)\|^2 \le 2E_1(t)", "proved",
             premises=("46", "45.bounded"), scope=EVERY_TRAIN)
def z_bounded() -> Goal:
    """V_i <= E_i <= E_1."""
    return Goal((at_most(over_cars(z_1**2 + z_2**2), 2 * E_1),), (at_most(E, E_1),))


@paper.claim("theorem1.1.mass", "The estimate of the mass is bounded", "implication",
             r"\underline M \le \hat M_i \le \overline M", "proved", scope=EACH_CAR)
def mass_estimate_bounded() -> Goal:
    """(22)."""
    return Goal((at_least(estimate, g_low), at_most(estimate, g_high)), (at_most(g_low, g_high),))


@paper.claim("theorem1.1.estimates", "E_i bounded makes the other estimates bounded", "implication",
             r"E_i \le E_1 \Rightarrow \tilde\theta_i(t)\ \text{bounded}", "gap", premises=("46", "45.bounded"),
             note="E_i holds integrals of the squared errors, which do not bound their values: theta_tilde_i(tau)^2 = "
                  "(B+i+1) tau^(B+i) on [0, 1] has the integral 1 and ends above B, for every B. In each iteration the "
                  "estimates are bounded when v is, by (17)-(21), but no bound for all iterations is shown.")
def estimates_bounded() -> Goal:
    """y = theta_tilde_i(1)^2 from the integral J of theta_tilde_i^2, which is bounded."""
    return along_iterations(at_most(y_i, level), (at_most(J_i, 1), at_least(J_i, 0), at_least(y_i, 0)),
                            {J_i: sp.Integer(1), y_i: level + i_axis + 1}, {level: sp.Integer(1)})


def _train_energy() -> Goal:
    """Kinetic and coupler energy of six cars under forces F_j = u_j + f^a_j - c_0 m_j, named f_a_j."""
    newton, _, symbols = train(6)
    S, Vs, masses = symbols["s"], symbols["v"], symbols["m"]
    spring, damper, rolling, air = (sp.Symbol(str(x), nonnegative=True) for x in (c_k, c_d, c_v, c_a))
    put = {c_k: spring, c_d: damper, c_v: rolling, c_a: air, c_0: zero}
    kinetic = sum((m_j * v_j**2 / 2 for m_j, v_j in zip(masses, Vs, strict=True)), zero)
    stretch = sum((spring * (S[j] - S[j + 1]) ** 2 / 2 for j in range(5)), zero)
    rates = dict(zip(S, Vs, strict=True)) | {v_j: force.xreplace(put) / m_j
                                             for v_j, force, m_j in zip(Vs, newton, masses, strict=True)}
    forced = sum((f_j**2 / (2 * m_j) for f_j, m_j in zip(symbols["f_a"], masses, strict=True)), zero)
    return Goal((at_most(D(kinetic + stretch), kinetic + stretch + forced),), (at_least(Vs[0], 0),), rates)


@paper.claim("theorem1.1.state", "s and v are bounded according to (54) and (55)", "implication",
             rf"\int_0^T\|e_{{s,i}}\|^2d\tau \le {PART_3} \Rightarrow s_i\ \text{{bounded}}", "gap",
             premises=("54", "55"), correction=_train_energy,
             corrected_statement=r"v_1 \ge 0 \Rightarrow \dot K \le K + \sum_j\tfrac{F_j^2}{2m_j},\ K = "
                                 r"\sum_j\tfrac{m_j}2v_j^2 + \sum_j\tfrac{c_k}2(s_j - s_{j+1})^2,\ F_j = u_j + f^a_j - "
                                 r"c_0m_j",
             scope="corrected for six cars",
             note="The bounds contain the saturation, of which nothing is shown: mu is not bounded anywhere, so Delta "
                  "u, lambda and s may grow with the iterations while z stays small (the model; and integrals do not "
                  "bound values). The train itself helps out: with limited forces its energy stays bounded on [0, T] "
                  "while it does not run backwards (then (2) would push instead of resist), and with it lambda = e - "
                  "z.")
def state_bounded() -> Goal:
    """The integral J of e_s^2 from E_{i-1} <= E_1 and the saturation y, both constants of (54) taken as 1."""
    always = (at_most(J_i, 1 + y_i), at_least(J_i, 0), at_least(y_i, 0))
    return along_iterations(at_most(J_i, level), always, {J_i: level + i_axis + 1, y_i: level + i_axis + 1},
                            {level: sp.Integer(1)})


# --- section IV: what is concluded, and the laws with numbers ----------------------------------------------

@paper.claim("section4.converge", "z = 0 means no tracking error", "implication",
             r"z_{1,i} = z_{2,i} = 0 \Rightarrow e_{s,i} = e_{v,i} = 0", "gap",
             premises=("theorem1.2", "A2"), scope=EACH_CAR,
             note="Section IV expects the tracking errors to converge further with more iterations. What converges is "
                  "z; e_s = z_1 + lambda_1, and lambda vanishes only if the saturation does, which A2 excludes at the "
                  "stated numbers.")
def z_is_not_the_error() -> Goal:
    """From (10) and (12)."""
    given = tuple(equal(one_car(expr), 0) for expr in errors.values())
    return Goal((equal(one_car(s) - s_r, 0), equal(one_car(v) - v_r, 0)), given)


stated_learning = {gamma_v: Fraction(10), gamma_a: Fraction(2, 100),
                   **dict.fromkeys(learning_gains[2:], Fraction(8000))}
factors = sp.symbols("k_v k_a k_k k_d k_eta k_M", real=True)
printed_factors = (Fraction(4, 10), Fraction(8, 10**4), *[Fraction(320)] * 4)


@paper.claim("section4.learning", "The printed learning factors are gamma times c_3", "condition",
             r"0.4 = \gamma_v c_3,\ 0.0008 = \gamma_a c_3,\ 320 = \gamma_k c_3 = \gamma_d c_3 = \gamma_\eta c_3 = "
             r"\gamma_M c_3", "proved",
             at={**stated_learning, c_3: stated_gains[c_3], **dict(zip(factors, printed_factors, strict=True))})
def learning_factors() -> Goal:
    """(17)-(22) with the stated gains."""
    return Goal(tuple(equal(k, gain * c_3) for k, gain in zip(factors, learning_gains, strict=True)))


@paper.claim("section4.law", "The printed control law is (16) at the stated gains", "identity",
             r"\mu_i = -25[100(v_i - v_r + 0.01s_i - 0.01s_r) + \dot v_i - \dot v_r + 0.01v_i - 0.01v_r + s_i - s_r - "
             r"\lambda_{1,i}] - (\hat\Theta_{v,i}v_i + \dots - \hat M_i\dot v_i)", "proved", premises=("16.loop",),
             scope=EACH_CAR)
def printed_law() -> Goal:
    """(16) with (12) and c_1 = 0.01, c_2 = 100, c_3 = 0.04."""
    hundredth = sp.Rational(1, 100)
    inner = (100 * (v - v_r + hundredth * s - hundredth * s_r) + v_dot - v_r_dot + hundredth * v - hundredth * v_r
             + s - s_r - lambda_1)
    printed = -25 * inner - (compact_force(estimates, v, phi, As, Av) - M_hat * v_dot)
    return Goal((equal(one_car(mu_law.xreplace(at_stated)), one_car(printed)),))

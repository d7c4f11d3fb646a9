"""Section 3: the observer (12)-(21) and Remark 1."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater

from ..error_dynamics import W_f_star, W_f_tilde, delta, delta_tilde, eps_f, h_z, in_errors, observer_loop, w_f
from ..goal_forms import within
from ..laws import (
    D_1,
    W_f_0,
    W_f_hat,
    alpha_1,
    beta_1,
    delta_0,
    delta_hat,
    e_v,
    f_hat,
    gamma_1,
    h_f,
    k_1,
    k_2,
    k_3,
    kappa_1,
    observer_laws,
    robust_1,
    s_error,
    s_hat,
    s_hat_rate,
    sigma_f,
    tracking_laws,
    update_signal,
    v_error,
    v_hat,
    v_hat_rate,
    v_tilde,
)
from ..lyapunov import V_f
from ..paper import EVERY_NETWORK, paper
from ..plant import acceleration, d, s, v
from ..smooth_sign import constant_suffices, smooth_sign, smooth_sign_facts

along_plant = {s: v, v: acceleration, s_hat: s_hat_rate, v_hat: v_hat_rate}


@paper.claim("12", "The term -k_3 s_tilde' of the observer needs no differentiation", "identity",
             r"\frac{d}{dt}(\hat v + k_3\tilde s) = \hat f - k_2\tilde s + D_1", "proved", scope=EVERY_NETWORK,
             note="(12) is read as v_hat' = f_hat - k_2 s_tilde - k_3 s_tilde' + D_1: (18) and (25) force the derivative "
                  "where the extracted text has k_3 v_tilde. So read, the term can be had by integration, though v is "
                  "not measured.")
def observer_without_derivative() -> Goal:
    """D(v_hat + k_3 s_tilde) along (12)."""
    return Goal((equal(D(v_hat + k_3 * s_error), f_hat - k_2 * s_error + D_1),), flow=along_plant)


@paper.claim("13", "Rate of the position estimate's error", "identity",
             r"\dot{\tilde s} = \tilde v - k_1\tilde s", "proved")
def position_estimate_rate() -> Goal:
    """D(s_hat - s) along (9), (12)."""
    return Goal((equal(D(s_error), v_error - k_1 * s_error),), flow=along_plant)


@paper.claim("14", "Rate of the speed estimate's error", "identity",
             r"\dot{\tilde v} = \hat f - f - k_2\tilde s - k_3\dot{\tilde s} + D_1", "proved", scope=EVERY_NETWORK,
             note="With k_3 s_tilde' where the extracted text has k_3 v_tilde, see 12.")
def speed_estimate_rate() -> Goal:
    """D(v_hat - v) along (9), (12)."""
    return Goal((equal(D(v_error), f_hat - acceleration - k_2 * s_error - k_3 * D(s_error) + D_1),), flow=along_plant)


d_now, d_later = sp.symbols("d_now d_later", real=True)

paper.axiom("15", "Universal approximation of f by the network",
            r"f = W_f^{*T}h_f(z_1) + \varepsilon_f(z_1),\ |\varepsilon_f(z_1)| \le \varepsilon_{f,N}\ "
            r"\text{on the compact}\ \Omega", "Park and Sandberg 1991, for f continuous on a compact set",
            hypotheses=("15.function", "15.inside"))


@paper.claim("15.function", "f is a function of z_1 = [s, v, u]", "implication",
             r"z_1(t_1) = z_1(t_2) \Rightarrow f(t_1) = f(t_2)", "gap",
             note="f contains d(t), and a_i(t), l(t): two instants with the same z_1 have different f, and then "
                  "eps_f can be no smaller than half the difference, however large the network.")
def f_depends_on_z1() -> Goal:
    """f of (9) at two instants with the same position, speed and input."""
    return Goal((equal(acceleration.xreplace({d: d_now}), acceleration.xreplace({d: d_later})),))


size, theta_z, eps_limit = sp.symbols("z theta_z epsilon_N", real=True)


@paper.claim("15.inside", "The input of the network stays in the set on which (15) holds", "implication",
             r"|\varepsilon_f(z)| \le \varepsilon_{f,N}\ \text{for}\ z \in \Omega \Rightarrow |\varepsilon_f(z(t))| \le "
             r"\varepsilon_{f,N}\ \text{for all}\ t", "gap",
             note="Both theorems use the bound for all t, but that z stays in Omega is not shown, and cannot be concluded "
                  "afterwards from bounds that use it. In the model: Omega = [-theta_z, theta_z], eps_f(z) = eps_N "
                  "z^2/theta_z^2.")
def input_stays_inside() -> Goal:
    """An error that is bounded inside a set may be larger outside."""
    grows = equal(eps_f, eps_limit * size**2 / theta_z**2)
    return Goal((at_most(eps_f, eps_limit),), (greater(theta_z, 0), at_least(eps_limit, 0), grows))


eps_tilde_stated = over_neurons(W_f_star * (h_f - h_z)) - eps_f


@paper.claim("18", "Rate of the speed estimate's error with the networks", "identity",
             r"\dot{\tilde v} = -k_3\tilde v - (k_2 - k_1k_3)\tilde s + \tilde W_f^Th_f(\hat z_1) + D_1 + "
             r"\tilde\varepsilon_f,\ \tilde\varepsilon_f = W_f^{*T}(h_f(\hat z_1) - h_f(z_1)) - \varepsilon_f", "proved",
             premises=("13", "14", "15"), scope=EVERY_NETWORK)
def speed_estimate_rate_networks() -> Goal:
    """D(v_hat - v) with (15) and (17)."""
    along = {**along_plant, v: over_neurons(W_f_star * h_z) + eps_f}
    stated = (-k_3 * v_error - (k_2 - k_1 * k_3) * s_error + over_neurons((W_f_hat - W_f_star) * h_f) + D_1
              + eps_tilde_stated)
    return Goal((equal(D(v_error), stated),), flow=along)


W_one, W_N, h_1, h_2 = sp.symbols("W W_N h_1 h_2", real=True)


@paper.claim("18.bounded", "The error of the networks is bounded", "inequality",
             r"|\tilde\varepsilon_f| \le \|W_{f,N}\| + \varepsilon_{f,N}", "proved", premises=("15",),
             scope="one neuron; the bounds of several add up",
             note="By 0 < h <= 1, so the Lipschitz inequality of the text is not needed for it.")
def network_error_bounded() -> Goal:
    """W (h_1 - h_2) - eps for hidden functions between 0 and 1."""
    error = W_one * (h_1 - h_2) - eps_f
    hidden = tuple(relation for value in (h_1, h_2) for relation in (at_least(value, 0), at_most(value, 1)))
    return Goal(within(error, W_N + eps_limit), (*within(W_one, W_N), *within(eps_f, eps_limit), *hidden))


@paper.claim("19", "(19) cancels the weights in the rate of V_1", "identity",
             r"\tilde v\tilde W_f^Th_f(\hat z_1) + \tilde W_f^T\Gamma_f^{-1}\cdot\Gamma_f(-h_f(\hat z_1)\tilde v) = 0",
             "proved", scope=EVERY_NETWORK, note="Without the leakage, for which see 19.leakage.")
def weights_cancel() -> Goal:
    """D of the weights' part of V_1 without leakage."""
    rate = observer_loop()[w_f].xreplace({sigma_f: sp.Integer(0)})
    return Goal((equal(v_tilde * over_neurons(W_f_tilde * h_f) + D(V_f), 0),), flow={w_f: sp.expand(rate)})


@paper.claim("19.signal", "The signal of the update laws is the speed estimate's error", "identity",
             r"\dot{\tilde s} + k_1\tilde s = \tilde v", "proved", premises=("13",))
def update_signal_is_error() -> Goal:
    """s_tilde' + k_1 s_tilde along (12)."""
    return Goal((equal(D(s_error) + k_1 * s_error, v_error),), flow=along_plant)


v_other = sp.Symbol("v_other", real=True)


@paper.claim("19.measured", "The update laws need the measured position only", "implication",
             r"s, \hat s, \hat v\ \text{given} \Rightarrow \dot{\tilde s} + k_1\tilde s\ \text{given}", "gap",
             premises=("19.signal",),
             note="The signal of (19), (20), (21) is v_hat - v: two trains with the same measured position and estimates "
                  "but different speeds give different signals. It can be had only by differentiating the measured "
                  "position, that is, by measuring the speed that the method claims not to need. Unlike in (12), no "
                  "integration hides it: D_1 takes its tanh.")
def measured_position_suffices() -> Goal:
    """The update signal for two speeds."""
    return Goal((equal(update_signal, update_signal.xreplace({v: v_other})),))


def _leakage(square: sp.Expr, leak: int) -> Goal:
    """The distance of an estimate from its prior does not grow while the errors that drive it are zero."""
    laws = observer_laws(leak) | tracking_laws(leak)
    moving = {estimate: sp.expand(rate.xreplace({v_hat: v, e_v: sp.Integer(0)})) for estimate, rate in laws.items()
              if square.has(estimate)}
    return Goal((at_most(D(square), 0),), flow=moving)


def leakage_claim(equation: str, name: str, square: sp.Expr, latex: str, corrected: str) -> None:
    """State that an estimate's leakage draws it to its prior, as printed, with the corrected law."""

    @paper.claim(equation, f"The leakage draws {name} to its prior", "inequality", latex, "refuted",
                 scope=EVERY_NETWORK if square.has(sp.Sum) else "all values of the domain",
                 correction=lambda: _leakage(square, -1), corrected_statement=corrected,
                 note="What a sigma-correction, as the paper calls the term, is for. With the printed plus sign the "
                      "estimate leaves its prior exponentially. The sign is no slip of the pen: (39), (42), (53) and (54) "
                      "carry it on and rely on Lemma 1, which holds only for the opposite estimation error, see 41.")
    def leakage() -> Goal:
        return _leakage(square, 1)


leakage_claim("19.leakage", "the weights", over_neurons((W_f_hat - W_f_0) ** 2),
              r"\tilde v = 0,\ \dot{\hat W}_f = \Gamma_f\sigma_f(\hat W_f - W_{f0}) \Rightarrow "
              r"\frac{d}{dt}\|\hat W_f - W_{f0}\|^2 \le 0",
              r"\dot{\hat W}_f = \Gamma_f(-h_f(\hat z_1)\tilde v - \sigma_f(\hat W_f - W_{f0}))")


@paper.claim("20", "(20) and (21) cancel the estimate of delta in the rate of V_1", "identity",
             r"\tilde v D_1 + \tfrac1{\alpha_1}\tilde\delta\cdot\alpha_1\gamma(\tilde v)\tilde v = "
             r"-\tilde v\gamma(\tilde v)\delta", "proved",
             note="Without the leakage, for which see 21.leakage, and for a constant delta, see 38.")
def robust_term_cancels() -> Goal:
    """D of the part of V_1 with delta_tilde, without leakage."""
    rate = observer_loop()[delta_tilde].xreplace({beta_1: sp.Integer(0)})
    return Goal((equal(v_tilde * in_errors(robust_1) + D(delta_tilde**2 / (2 * alpha_1)),
                       -v_tilde * gamma_1(v_tilde) * delta),), flow={delta_tilde: rate})


leakage_claim("21.leakage", "the estimate of delta", (delta_hat - delta_0) ** 2,
              r"\tilde v = 0,\ \dot{\hat\delta} = \alpha_1\beta_1(\hat\delta - \delta_0) \Rightarrow "
              r"\frac{d}{dt}(\hat\delta - \delta_0)^2 \le 0",
              r"\dot{\hat\delta} = \alpha_1(\gamma(\tilde v)\tilde v - \beta_1(\hat\delta - \delta_0))")


@paper.claim("remark1", "Remark 1: the smooth sign", "inequality",
             r"|\tilde v| \le \tilde v\gamma(\tilde v) + \kappa_1", "proved")
def remark_1() -> Goal:
    """With tanh."""
    bound = v_tilde * gamma_1(v_tilde) + kappa_1
    return Goal((at_most(sp.Abs(v_tilde), bound),), facts=smooth_sign_facts(v_tilde, kappa_1),
                lemmas=(constant_suffices, *smooth_sign(v_tilde, kappa_1)))


@paper.claim("remark1.linear", "Remark 1: the linear choice of gamma", "inequality",
             r"|\tilde v| \le \tilde v\frac{\tilde v}{4\kappa_1} + \kappa_1", "proved",
             note="With this gamma the constant 0.2785 of (42), (43) has to be 1.")
def remark_1_linear() -> Goal:
    """A square: (|v_tilde| - 2 kappa_1)^2 >= 0."""
    return Goal((at_most(sp.Abs(v_tilde), v_tilde * v_tilde / (4 * kappa_1) + kappa_1),))

"""Theorem 1, step 2: z_1 and z_2 converge along the iterations, (46)-(48)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal

from ..energy_function import E_1, S_1, S_2, Z_1, Z_2, E_before, E_now, V_before
from ..goal_forms import J_i, along_iterations, i_axis, y_i
from ..laws import c_1, c_2
from ..paper import paper


def _telescoped(with_v_before: bool) -> Goal:
    """From i-1 to i; at i = 1 the sums are empty."""
    S_V = sp.Symbol("S_V", real=True)
    tail = S_V if with_v_before else sp.S.Zero
    step = -c_1 * Z_1 - c_2 * Z_2 - (V_before if with_v_before else 0)
    whole_tail = tail + V_before if with_v_before else 0
    return Goal((at_most(E_now, E_1 - c_1 * (S_1 + Z_1) - c_2 * (S_2 + Z_2) - whole_tail),),
                (at_most(E_now - E_before, step), at_most(E_before, E_1 - c_1 * S_1 - c_2 * S_2 - tail)))


SUMS_46 = r"c_1\sum_{k=2}^i\int_0^t\|z_{1,k}\|^2d\tau - c_2\sum_{k=2}^i\int_0^t\|z_{2,k}\|^2d\tau"
LIMITS_47 = rf"\lim_{{i\to\infty}}({SUMS_46.replace(' - ', ' + ')})"


def _telescoped_claim(equation: str, title: str, term: str, premise: str) -> None:
    @paper.claim(equation, title, "implication", rf"E_i \le E_1 - {term}{SUMS_46}", "proved", premises=(premise,),
                 note="The step of the induction over i; S_1, S_2 (and S_V) are the sums up to i - 1, empty at the "
                      "start.")
    def telescoped() -> Goal:
        return _telescoped(with_v_before=bool(term))


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
    return along_iterations(at_most(y_i, sp.S.Half), always, {J_i: 1 / (2 * i_axis + 3), y_i: sp.Integer(1)}, {})


@paper.claim("theorem1.2", "Theorem 1, part 2: z_1 and z_2 converge to 0 along the iteration axis", "limit",
             r"\lim_{i\to\infty}z_{1,i}(t) = 0,\ \lim_{i\to\infty}z_{2,i}(t) = 0", "proved",
             premises=("25", "46.kept", "45.bounded"),
             note="At every instant, not only as integrals: at most E_1(t)/delta iterations have V_k(t) >= delta. By "
                  "35.kept, not by the printed way over (48). It supposes that iterations differ in nothing but the "
                  "estimates (31.place) and that the loop through the acceleration is solved.")
def z_converges() -> Goal:
    """The count of iterations with a large V at an instant."""
    return _instants_converge()

"""Random expressions for tests of LaTeX, over letters with accents, indices and marks, and over vectors."""

import sympy as sp
from hypothesis import strategies as st

from workbench.proof.claim import D

x, y = sp.symbols("x_1 y", real=True)
k = sp.Symbol("k", positive=True)
theta = sp.Symbol("theta_hat_2", real=True)
V = sp.Symbol("V_star", real=True)
LETTERS = {"x_1": x, "y": y, "k": k, r"\hat\theta_2": theta, "V^*": V}
j, n = sp.symbols("j n", integer=True, positive=True)
W, h = (sp.IndexedBase(name, real=True)[j] for name in ("W_tilde", "h"))
VECTORS = {r"\tilde W": W, r"\tilde W_j": W, "h": h, "h_j": h, "n": n}


def over(summand):
    return sp.Sum(summand, (j, 1, n))


numbers = st.fractions(-9, 9, max_denominator=9).map(lambda q: sp.Rational(q.numerator, q.denominator))
atoms = st.one_of(st.sampled_from([x, y, k, theta, V]), numbers,
                  st.sampled_from([over(W * h), over(W**2), over(2 * W + h)]))


def _grown(inner):
    return st.one_of(
        st.tuples(inner, inner).map(lambda p: p[0] + p[1]),
        st.tuples(inner, inner).map(lambda p: p[0] * p[1]),
        st.tuples(inner, st.integers(2, 3)).map(lambda p: p[0] ** p[1]),
        inner.map(lambda e: e / (k + e**2)),
        inner.map(sp.tanh), inner.map(lambda e: sp.log(1 + e**2)), inner.map(sp.Abs), inner.map(sp.sign),
        inner.map(lambda e: sp.exp(-e)), inner.map(lambda e: sp.sqrt(1 + e**2)),
        st.tuples(inner, inner).map(lambda p: sp.Max(p[0], p[1])),
        st.tuples(inner, inner).map(lambda p: sp.Min(p[0], p[1])),
        inner.filter(lambda e: e.free_symbols and not e.has(sp.Abs, sp.sign, sp.Max, sp.Min, D)).map(D),
    )


expressions = st.recursive(atoms, _grown, max_leaves=6)

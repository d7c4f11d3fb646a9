"""The parts of an expression, each once: sympy goes through what is shared again at every place where it stands, of the
law of a quadrotor through a million parts instead of a thousand."""

from __future__ import annotations

import sympy as sp


def parts(expr: sp.Basic) -> dict[sp.Basic, None]:
    """The expression and all that stands in it, in the order in which it is first met."""
    found: dict[sp.Basic, None] = {}
    waiting = [expr]
    while waiting:
        part = waiting.pop()
        if part not in found:
            found[part] = None
            waiting += [one for one in reversed(part.args) if isinstance(one, sp.Basic)]
    return found


def free_symbols(expr: sp.Basic) -> frozenset[sp.Basic]:
    """As sympy's attribute of that name: what is bound, as the index of a sum, is left out."""
    return _free(expr, {})


def _free(expr: sp.Basic, known: dict[sp.Basic, frozenset[sp.Basic]]) -> frozenset[sp.Basic]:
    if type(expr).free_symbols is not sp.Basic.free_symbols:  # a symbol, or what binds one
        return frozenset(expr.free_symbols)
    if expr not in known:
        known[expr] = frozenset().union(*(_free(one, known) for one in expr.args if isinstance(one, sp.Basic)))
    return known[expr]

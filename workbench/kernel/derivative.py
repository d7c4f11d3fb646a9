"""The derivative of an expression along its flow: as an expression, and the Coq term that proves it."""

from __future__ import annotations

import ast
from dataclasses import dataclass

from workbench.kernel.syntax import Letters, NotExportedError, call, names_in, operation, tangent, text_of


@dataclass(frozen=True)
class Rate:
    """A derivative: its expression, the Coq term that proves it, None where the expression does not move."""

    value: ast.expr | None
    proof: str


@dataclass(frozen=True)
class Differentiation:
    """What it takes to differentiate along a flow: the rates by name, and the letters at the instant."""

    rates: dict[str, ast.expr]
    letters: Letters

    def of(self, node: ast.expr) -> Rate:  # noqa: PLR0911, PLR0912 - a case a kind
        """The derivative; NotExportedError where the library has no lemma. The Coq term speaks of hypotheses `rate_x`,
        and has a hole for every side condition."""
        if not names_in(node) & self.rates.keys():
            return Rate(None, f"(D_const {self._now(node)} {self.letters.instant})")
        match node:
            case ast.Name(id=name):
                return Rate(self.rates[name], f"(rate_{name} i)" if name in self.letters.indexed else f"rate_{name}")
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                below = self.of(inner)
                return Rate(ast.UnaryOp(ast.USub(), _value(below)), self._lemma("D_opp", [inner], [below]))
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return self._power(left, right)
            case ast.BinOp(left=left, op=op, right=right):
                return self._operation(left, op, right)
            case ast.Call(func=ast.Name(id="Sum"), args=[inner]):
                below = self.of(inner)
                f = f"(fun i s => {self._soon(inner)})"
                d = f"(fun i => {self._now(_value(below))})"
                return Rate(call("Sum", _value(below)),
                            f"(D_bigsum n {f} {self.letters.instant} {d} (fun i => {below.proof}))")
            case ast.Call(func=ast.Name(id="exp"), args=[inner]):
                below = self.of(inner)
                return Rate(operation(node, ast.Mult(), _value(below)), self._lemma("D_exp", [inner], [below]))
            case ast.Call(func=ast.Name(id="log"), args=[inner]):
                below = self.of(inner)
                return Rate(operation(_value(below), ast.Div(), inner), self._lemma("D_ln", [inner], [below], "_"))
            case ast.Call(func=ast.Name(id="sin"), args=[inner]):
                below = self.of(inner)
                return Rate(operation(call("cos", inner), ast.Mult(), _value(below)),
                            self._lemma("D_sin", [inner], [below]))
            case ast.Call(func=ast.Name(id="cos"), args=[inner]):
                below = self.of(inner)
                return Rate(operation(ast.UnaryOp(ast.USub(), call("sin", inner)), ast.Mult(), _value(below)),
                            self._lemma("D_cos", [inner], [below]))
            case ast.Call(func=ast.Name(id="tan"), args=[inner]):
                return self.of(tangent(inner))
            case ast.Call(func=ast.Name(id="arctan"), args=[inner]):
                below = self.of(inner)
                slope = operation(ast.Constant(1), ast.Add(), operation(inner, ast.Mult(), inner))
                return Rate(operation(_value(below), ast.Div(), slope), self._lemma("D_arctan", [inner], [below]))
            case ast.Call(func=ast.Name(id="tanh"), args=[inner]):
                below = self.of(inner)
                slope = operation(ast.Constant(1), ast.Sub(), operation(node, ast.Pow(), ast.Constant(2)))
                return Rate(operation(slope, ast.Mult(), _value(below)), self._lemma("D_tanh", [inner], [below]))
        raise NotExportedError(f"the derivative of {ast.unparse(node)[:60]}")

    def _operation(self, left: ast.expr, op: ast.operator, right: ast.expr) -> Rate:
        a, b = self.of(left), self.of(right)
        match op:
            case ast.Add() | ast.Sub():
                name = "D_plus" if isinstance(op, ast.Add) else "D_minus"
                return Rate(operation(_value(a), op, _value(b)), self._lemma(name, [left, right], [a, b]))
            case ast.Mult():
                if a.value is None:
                    return Rate(operation(left, op, _value(b)), self._lemma("D_scale", [right], [b], scale=left))
                value = operation(operation(_value(a), op, right), ast.Add(), operation(left, op, _value(b)))
                return Rate(value, self._lemma("D_mult", [left, right], [a, b]))
            case ast.Div():
                if b.value is None:
                    return Rate(operation(_value(a), op, right),
                                self._lemma("D_divide_const", [left], [a], scale=right))
                over = operation(operation(_value(a), ast.Mult(), right), ast.Sub(),
                                 operation(left, ast.Mult(), _value(b)))
                return Rate(operation(over, op, operation(right, ast.Mult(), right)),
                            self._lemma("D_divide", [left, right], [a, b], "_"))
        raise NotExportedError("the derivative of an unknown operation")

    def _power(self, base: ast.expr, exponent: ast.expr) -> Rate:
        match exponent:
            case ast.Constant(value=int(power)) if power >= 1:
                below = self.of(base)
                lower = operation(base, ast.Pow(), ast.Constant(power - 1))
                value = operation(operation(ast.Constant(power), ast.Mult(), lower), ast.Mult(), _value(below))
                proof = (f"(D_power {power - 1} {power} (fun s => {self._soon(base)}) {self.letters.instant} "
                         f"{self._now(_value(below))} _ {below.proof})")
                return Rate(value, proof)
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant() as positive):
                return self._operation(ast.Constant(1), ast.Div(), operation(base, ast.Pow(), positive))
        raise NotExportedError(f"the derivative of a power {ast.unparse(exponent)}")

    def _now(self, node: ast.expr) -> str:
        return text_of(node, self.letters)

    def _soon(self, node: ast.expr) -> str:
        return text_of(node, self.letters.at("s"))

    def _lemma(self, name: str, parts: list[ast.expr], below: list[Rate], condition: str = "",
               scale: ast.expr | None = None) -> str:
        functions = " ".join(f"(fun s => {self._soon(part)})" for part in parts)
        constant = f"{self._now(scale)} " if scale is not None else ""
        values = " ".join(self._now(_value(rate)) for rate in below)
        return (f"({name} {functions} {constant}{self.letters.instant} {values} "
                f"{' '.join(rate.proof for rate in below)} {condition})")


def _value(rate: Rate) -> ast.expr:
    return rate.value if rate.value is not None else ast.Constant(0)

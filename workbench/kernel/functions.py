"""What log, exp, abs, sign, sqrt, sin, cos and arctan of an argument are worth, each an equation with its lemma."""

from __future__ import annotations

import ast
from fractions import Fraction

from workbench.kernel.normal import is_number, number_text
from workbench.kernel.signs import Signs
from workbench.kernel.syntax import NotExportedError, text_of
from workbench.kernel.writing import joined_tactics
from workbench.proof.checker import SUM, Ratio, atoms_of, constant, same, symbol


class Functions(Signs):
    """Writes the equations of functions' values."""

    def _calls(self, node: ast.expr) -> str:
        """Show what every call in an expression is worth; the rewriting that puts the values in their place."""
        found: list[str] = []
        for part in reversed(list(ast.walk(node))):
            if isinstance(part, ast.Call):
                text = text_of(part, self.normal.letters)
                if text not in self.facts.calls:
                    self.facts.calls[text] = self._call(part, text)
                found.append(text)
        outermost_first = sorted(set(found), key=lambda text: (-len(text), text))  # the same in every process
        return "".join(f"rewrite ?{self.facts.calls[text]}. " for text in outermost_first)

    def _call(self, node: ast.Call, text: str) -> str:
        kind, inner = node.func.id, node.args[0]  # type: ignore[attr-defined]
        inside = self._calls(inner)
        return self.function(kind, text, text_of(inner, self.normal.letters), self.context.node(inner), inside)

    def function(self, kind: str, text: str, inner: str, argument: Ratio, inside: str = "") -> str:
        """The equation of a function's value, `argument` being the value of its argument, which stands as `inner`."""
        value = self.context.call(kind, argument)
        if SUM in atoms_of(value):
            raise NotExportedError(f"{kind} of a sum")
        self.prepare(argument)
        self.prepare(value)
        start, intros = self.every(self.normal.indexed(argument))
        statement = f"{start}{text} = {self.normal.ratio(value)}"
        number = is_number(value)
        shown = f"{inside}same."
        if number is not None:
            proof = {"log": "apply ln_one. ", "exp": "apply exp_zero. ", "sin": "apply sin_zero. ",
                     "cos": "apply cos_zero. ", "arctan": "apply arctan_zero. "}.get(kind)
            if proof is None or (kind, number) not in (("log", 0), ("exp", 1), ("sin", 0), ("cos", 1),
                                                        ("arctan", 0)):
                proof = self._of_number(kind, inner, is_number(argument), number, inside)
                return self.show("C", statement, f"{intros}{proof}")
            return self.show("C", statement, f"{intros}{proof}{shown}")
        atoms = sorted(atoms_of(value))
        if len(atoms) != 1 or self.context.functions.get(atoms[0], ("",))[0] != kind:
            return self._shifted(statement, intros, inner, argument, value, inside, kind)
        atom = atoms[0]
        known = self.context.functions[atom][1]
        named = f"rewrite {self.normal.name(atom)}_is. "
        if same(value, symbol(atom)):
            turned = not same(known, argument)
            proof = f"{named}apply {kind}_turned. " if turned else f"{named}apply f_equal. "
        elif kind == "log" and same(value, -symbol(atom)):
            positive = self.positive(argument)
            worth = f"replace {inner} with {self.normal.ratio(argument)} by (symmetry; {joined_tactics(inside)}same)"
            return self.show("C", statement,
                             f"{intros}transitivity (- {self.normal.atom(atom)}); [|ring]. {named}apply ln_reciprocal. "
                             f"{{ {worth}. "
                             f"exact {positive}. }} {shown}")
        elif kind in ("sign", "sin", "arctan") and same(value, -symbol(atom)):
            lemma = "sgn_turned" if kind == "sign" else f"{kind}_turned"
            proof = f"transitivity (- {self.normal.atom(atom)}); [|ring]. {named}apply {lemma}. "
        elif kind == "exp" and same(value, symbol(atom).inverse()):
            proof = f"transitivity (/ {self.normal.atom(atom)}); [|same]. {named}apply exp_minus_inv. "
        else:
            return self._shifted(statement, intros, inner, argument, value, inside, kind)
        return self.show("C", statement, f"{intros}{proof}{shown}")

    def _of_number(self, kind: str, inner: str, argument: Fraction | None, value: Fraction, inside: str) -> str:
        if argument is None:
            raise NotExportedError(f"{kind} of {inner[:40]}")
        change = f"replace {inner} with {number_text(argument)} by (symmetry; {joined_tactics(inside)}same). "
        if kind == "abs":
            return f"{change}rewrite {'Rabs_right' if argument >= 0 else 'Rabs_left'} by linear. linear."
        if kind == "sign":
            lemma = "sgn_pos" if argument > 0 else "sgn_neg" if argument < 0 else "sgn_zero"
            return f"{change}apply {lemma}. linear."
        if kind == "sqrt":
            return f"{change}apply sqrt_number; linear."
        raise NotExportedError(f"{kind} of the number {argument}")

    def _shifted(self, statement: str, intros: str, inner: str, argument: Ratio, value: Ratio, inside: str,
                 kind: str) -> str:
        """exp of a sum of logarithms, a number and a rest: the product of their exps."""
        if kind != "exp" or len(argument.den) != 1:
            raise NotExportedError(f"{kind} of {inner[:40]}")
        (below, _), = argument.den.items()
        parts, rest = list[tuple[str, str]](), argument
        for monomial, coefficient in list(argument.num.items()):
            term = Ratio({monomial: coefficient}, {below: Fraction(1)})
            atoms = [atom for m in term.num for atom, power in m if power == 1 and len(m) == 1]
            logarithm = atoms and self.context.functions.get(atoms[0], ("",))[0] == "log" and term.den == constant(1)
            if logarithm and coefficient.denominator == 1:
                atom, power = atoms[0], abs(int(coefficient))
                positive = self.positive(self.context.functions[atom][1])
                lemma = "exp_log_power" if coefficient > 0 else "exp_log_inverse_power"
                of = self.normal.ratio(self.context.functions[atom][1])
                exponent = f"INR {power} * ln {of}" if coefficient > 0 else f"- (INR {power} * ln {of})"
                parts.append((f"({exponent})", f"rewrite ({lemma} {of} {power}) by exact {positive}. "))
                parts[-1] = parts[-1][0], parts[-1][1]
                rest = rest + -term
                inside += f"rewrite ?{self.normal.name(atom)}_is. "
            elif term.den == constant(1) and not monomial and len(argument.num) > 1:
                parts.append(self._exp_of(term))
                rest = rest + -term
        if not parts:
            raise NotExportedError(f"exp of {inner[:40]}")
        if not rest.is_zero():
            parts.append(self._exp_of(rest))
        total = " + ".join(text for text, _ in parts)
        proof = (f"{intros}replace {inner} with ({total}) by (symmetry; {joined_tactics(inside)}simpl INR; same). "
                 f"rewrite ?exp_plus. {''.join(step for _, step in parts)}")
        logs = "".join(f"rewrite ?{name}_is. " for name in sorted(self.facts.atoms)
                       if f"rewrite ?{name}_is" in inside)
        return self.show("C", statement, f"{proof}{logs if 'ln' in statement else ''}same.")

    def _exp_of(self, part: Ratio) -> tuple[str, str]:
        text = self.normal.ratio(part)
        equation = self.function("exp", f"(exp {text})", text, part)
        return text, f"rewrite ?{equation}. "

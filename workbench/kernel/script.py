"""The proof's script: what is assumed, that it is defined, and the equation of every expression with its value."""

from __future__ import annotations

import ast

from workbench.kernel.derivative import Differentiation
from workbench.kernel.functions import Functions
from workbench.kernel.normal import joined
from workbench.kernel.syntax import (
    NAMED,
    RELATIONS,
    NotExportedError,
    called,
    names_in,
    plain,
    replaced,
    split_margin,
    text_of,
)
from workbench.kernel.totals import Closed, Total, total, tree_of, written
from workbench.proof.checker import SUM, Ratio, atoms_of, constant, margin, same, split_relation

MARGINS = {"<=": "le", "<": "lt", ">=": "ge", ">": "gt", "==": "eq", "!=": "ne"}  # names of lemmas


class Script(Functions):
    """Writes the proof of one goal."""

    # --- what is assumed, and that it is defined ---

    def defined(self, text: str) -> None:
        """Show all that an expression or relation needs to be defined, innermost first."""
        for condition, part, wanted in self.goal.places(text, self.normal.letters):
            if condition in self.facts.conditions:
                continue
            if wanted == "derivative":
                self.rate(part)
                self.facts.conditions[condition] = self.facts.rates[f"ex {text_of(part, self.normal.letters)}"][0]
                continue
            each = condition.startswith("forall")
            equation, value = self.evaluate(part, each)
            shown = self._signed(part, value, wanted, equation)
            if wanted != "non-negative":
                self.sign(value.num, strict=False)
            _, intros = self.every(each)
            name = self.show("W", condition, f"{intros}rewrite ?{equation}. exact {shown}.")
            self.facts.conditions[condition] = name
            if each:
                self.facts.each.append(name)

    def assumption(self, text: str, hypothesis: str) -> None:
        """An assumption in force, as the checker reads it, from the hypothesis that says it as it is written."""
        equation, _ = self.evaluate(split_margin(text))
        relation = margin(self.context, text)
        operator = split_relation(text)[1]
        name = self.show("M", f"{self.normal.value(relation[0])} {RELATIONS[relation[1]]} 0",
                         f"exact ({MARGINS[operator]}_margin _ _ _ {hypothesis} {equation}).")
        self.assume(relation, name)

    # --- equations: an expression as it is written, and its value ---

    def evaluate(self, node: ast.expr, each: bool = False) -> tuple[str, Ratio]:
        """The hypothesis that an expression equals its value, and the value; `each`: as it stands inside a sum."""
        rewrites: list[str] = []

        def rated(part: ast.expr) -> ast.expr | None:
            if called(part, "Sum"):
                return part
            if called(part, "D"):
                equation, derivative = self.rate(part)
                rewrites.append(equation)
                return derivative
            return None

        sums: dict[str, tuple[str, str, Ratio]] = {}

        def summed(part: ast.expr) -> ast.expr | None:
            if called(part, "Sum") and isinstance(self.context, Closed):
                equation, tree = self._total(part.args[0])  # type: ignore[attr-defined]
                rewrites.append(equation)
                return tree
            if called(part, "Sum"):
                found = self._sum(part.args[0])  # type: ignore[attr-defined]
                sums[f"{NAMED}{found[1]}"] = found
                return ast.Name(f"{NAMED}{found[1]}", ast.Load())
            return None

        carried = replaced(node, rated)  # its rates may have functions that it has not
        bare = plain(replaced(carried, summed))
        rewrites += [equation for equation, _, _ in sums.values()]
        calls = self._calls(bare)
        linear = self.context.node(bare)
        self.prepare(linear)
        start, intros = self.every(each)
        change = "".join(f"rewrite ?{name}. " for name in rewrites)
        text = text_of(node, self.normal.letters)
        equation = self.show("E", f"{start}{text} = {self.normal.ratio(linear)}",
                             f"{intros}{change}{unfolding(carried)}{calls}same.")
        if not sums:
            if not same(linear, self.context.node(node)):
                raise NotExportedError("an expression reads differently here and in the checker")
            return equation, linear
        return self._beside_sums(node, equation, linear, sums)

    def _beside_sums(self, node: ast.expr, equation: str, linear: Ratio, sums: dict[str, tuple[str, str, Ratio]],
                     ) -> tuple[str, Ratio]:
        """The same where sums have names in `linear`: what stands outside of the sum over the index, and its term."""
        text = text_of(node, self.normal.letters)
        if linear.den != constant(1) and atoms_of(Ratio(linear.den)) & sums.keys():
            raise NotExportedError("a sum below a fraction bar")
        outside = Ratio({m: c for m, c in linear.num.items() if not {a for a, _ in m} & sums.keys()}, linear.den)
        weights: dict[str, Ratio] = {}
        for name in sums:
            weights[name] = Ratio({tuple(f for f in m if f[0] != name): c for m, c in linear.num.items()
                                   if (name, 1) in m}, linear.den)
        inside = Ratio({})
        for name, weight in weights.items():
            inside = inside + weight * sums[name][2]
        if any(atoms_of(weight) & sums.keys() for weight in weights.values()):
            raise NotExportedError("a product of sums")
        value = joined(outside, inside)
        if SUM not in atoms_of(value):
            inside = Ratio({})
        if not same(value, self.context.node(node)):
            raise NotExportedError("a sum reads differently here and in the checker")
        outside, whole = self.normal.split(value)  # both over one denominator, as the value is written
        inside = whole if whole is not None else inside
        self.prepare(outside)
        self.prepare(inside)
        for weight in weights.values():
            self.prepare(weight)
        weighed = " + ".join(f"{self.normal.ratio(w)} * {name[1:]}" for name, w in weights.items())
        named = "".join(f"rewrite {name[1:]}_is. " for name in weights)
        _, intros = self.every(True)
        summed_up = f"({self.normal.ratio(outside)} + bigsum n (fun i => {self.normal.ratio(inside)}))"
        equation = self.show(
            "E", f"{text} = {summed_up}",
            f"rewrite ?{equation}. transitivity ({self.normal.ratio(outside)} + ({weighed})); [same|]. {named}"
            f"rewrite <- ?bigsum_scal. rewrite <- ?bigsum_plus. apply f_equal. apply bigsum_ext. "
            f"{intros}intros _. cbv beta. same.")
        if SUM not in atoms_of(value):
            equation = self.show("E", f"{text} = {self.normal.ratio(outside)}",
                                 f"rewrite {equation}. rewrite bigsum_zero by reflexivity. ring.")
        return equation, value

    def _sum(self, inner: ast.expr) -> tuple[str, str, Ratio]:
        text = text_of(inner, self.normal.letters)
        if text in self.facts.sums:
            return self.facts.sums[text]
        equation, term = self.evaluate(inner, each=True)
        name = self.fresh("s")
        self.say(f"destruct (named (bigsum n (fun i => {self.normal.ratio(term)}))) as [{name} {name}_is].")
        whole = self.show("S", f"(bigsum n (fun i => {text})) = {name}",
                          f"rewrite {name}_is. apply bigsum_ext. intros i _. apply {equation}.")
        self.facts.sums[text] = whole, name, term
        return whole, name, term

    def _total(self, inner: ast.expr) -> tuple[str, ast.expr]:
        """The equation of a sum that is a number of its own, and that number by the names of the totals in it."""
        text = text_of(inner, self.normal.letters)
        if text in self.facts.totals:
            return self.facts.totals[text]
        equation, term = self.evaluate(inner, each=True)
        found = self.total(term)
        tree = tree_of(found.value, self.normal)
        _, intros = self.every(True)
        whole = self.show("S", f"(bigsum n (fun i => {text})) = {text_of(tree, self.normal.letters)}",
                          f"transitivity {found.text}; [|same]. rewrite {found.proof}. apply bigsum_ext. {intros}"
                          f"intros _. refine (eq_trans ({equation} i) _). cbv beta. same.")
        self.facts.totals[text] = whole, tree
        return whole, tree

    def total(self, term: Ratio) -> Total:
        """The sum of a term over the index, by totals that have their names."""
        parts = total(term, self.normal)
        for part in parts:
            for value in part:
                self.prepare(value)
        return written(parts, self.normal)

    def _signed(self, part: ast.expr, value: Ratio, wanted: str, equation: str) -> str:
        """The Coq term of the sign of an expression's value: by its terms, or as the expression is written."""
        try:
            return self.positive(value, wanted)
        except NotExportedError:
            if wanted != "non-negative" or not isinstance(self.context, Closed):
                raise
            return self.show("F", f"0 <= {self.normal.value(value)}",
                             f"rewrite <- {equation}. exact {self.squares(part)}.")

    def squares(self, node: ast.expr) -> str:
        """The Coq term that what is written as even powers, and sums of them, is not negative."""
        match node:
            case ast.BinOp(left=base, op=ast.Pow(), right=ast.Constant(value=int(power))) if power % 2 == 0:
                return f"(even_power {text_of(base, self.normal.letters)} {power // 2})"
            case ast.BinOp(left=left, op=ast.Add(), right=right):
                return f"(Rplus_le_le_0_compat _ _ {self.squares(left)} {self.squares(right)})"
            case ast.Call(func=ast.Name(id="Sum"), args=[inner]):
                return f"(bigsum_nonneg n _ (fun i _ => {self.squares(inner)}))"
        raise NotExportedError("a sign that is not seen as it is written")

    def rate(self, node: ast.expr) -> tuple[str, ast.expr]:
        """The equation of a derivative D(...), and its expression."""
        inner: ast.expr = node.args[0]  # type: ignore[attr-defined]
        letters = self.normal.letters
        text = text_of(node, letters)
        if text in self.facts.rates:
            return self.facts.rates[text]
        if any(called(part, "D") for part in ast.walk(inner)):
            raise NotExportedError("a derivative of a derivative")
        self.libraries.add("WorkbenchFlow")
        found = Differentiation(self.rates, letters).of(inner)
        value = found.value if found.value is not None else ast.Constant(0)
        start, intros = self.every(bool(names_in(inner) & letters.indexed) and not called(inner, "Sum")
                                   and _outside_sums(inner, letters.indexed))
        function = f"(fun s => {text_of(inner, letters.at('s'))})"
        derives = self.show("X", f"{start}is_derive {function} {letters.instant} {text_of(value, letters)}",
                            f"{intros}refine {found.proof}; cbv beta; "
                            "solve [assumption | reflexivity | simpl; linear | nonzero].")
        at = " i" if start else ""
        exists = self.show("Y", f"{start}ex_derive {function} {letters.instant}",
                           f"{'intros i. ' if start else ''}exists {text_of(value, letters)}. exact ({derives}{at}).")
        equation = self.show("D", f"{start}{text} = {text_of(value, letters)}",
                             f"{'intros i. ' if start else ''}apply is_derive_unique. exact ({derives}{at}).")
        self.facts.rates[text] = equation, value
        self.facts.rates[f"ex {text}"] = exists, value
        return equation, value


def _outside_sums(node: ast.AST, names: frozenset[str]) -> bool:
    """Whether an indexed symbol stands outside of every sum."""
    if called(node, "Sum"):
        return False
    if isinstance(node, ast.Name) and node.id in names:
        return True
    return any(_outside_sums(part, names) for part in ast.iter_child_nodes(node))


def unfolding(node: ast.expr) -> str:
    """The rewriting of tanh, Max and Min, where an expression has them."""
    lemmas = {"tanh": "tanh_exp", "Max": "max_abs", "Min": "min_abs"}
    return "".join(f"rewrite ?{lemma}. " for name, lemma in lemmas.items()
                   if any(called(part, name) for part in ast.walk(node)))

"""The Coq proof of one certificate as it is written: names for values, equations, facts of sign, line by line."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction

from ..proof.checker import (
    SUM,
    Context,
    Poly,
    Ratio,
    Relations,
    Sign,
    atoms_of,
    constant,
    divide_exactly,
    margin,
    same,
    split_relation,
    symbol,
)
from .derivative import Differentiation
from .normal import Normal, is_number, joined, number_text
from .syntax import NAMED, RELATIONS, NotExported, called, names_in, plain, replaced, split_margin, text_of
from .theorem import Goal

MARGINS = {"<=": "le", "<": "lt", ">=": "ge", ">": "gt", "==": "eq", "!=": "ne"}  # names of lemmas


@dataclass
class Facts:
    """What is established where the proof stands; a copy serves one subproof."""

    atoms: set[str] = field(default_factory=set)
    calls: dict[str, str] = field(default_factory=dict)  # a call's text -> its equation
    sums: dict[str, tuple[str, str, Ratio]] = field(default_factory=dict)  # text -> (equation, its name, its term)
    rates: dict[str, tuple[str, ast.expr]] = field(default_factory=dict)  # text of D(...) -> (equation, derivative)
    signs: dict[tuple[str, bool], str] = field(default_factory=dict)  # (polynomial, strictly positive) -> hypothesis
    nonzero: list[tuple[Poly, str, bool]] = field(default_factory=list)
    conditions: dict[str, str] = field(default_factory=dict)  # what an expression needs to be defined -> hypothesis
    each: list[str] = field(default_factory=list)  # hypotheses of every index

    def copied(self) -> Facts:
        """The same facts, for a subproof."""
        return Facts(set(self.atoms), dict(self.calls), dict(self.sums), dict(self.rates), dict(self.signs),
                     list(self.nonzero), dict(self.conditions), list(self.each))


class Script:
    """Writes a proof. `given` are the assumptions in force and `names` their hypotheses."""

    def __init__(self, context: Context, goal: Goal) -> None:
        self.context, self.normal, self.goal, self.rates = context, Normal(context, goal.letters), goal, goal.rates
        self.given, self.names = Relations(context, []), list[str]()
        self.facts, self.lines, self.count = Facts(), list[str](), 0
        self.libraries: set[str] = set()

    # --- writing ---

    def say(self, line: str) -> None:
        """One more line."""
        self.lines.append(line)

    def fresh(self, letter: str) -> str:
        """A name that no hypothesis has yet."""
        self.count += 1
        return f"{letter}{self.count}_"

    def show(self, letter: str, statement: str, proof: str) -> str:
        """A hypothesis with its proof; its name."""
        name = self.fresh(letter)
        self.say(f"assert ({name} : {statement}).")
        self.say(f"{{ {proof} }}")
        return name

    @contextmanager
    def subproof(self) -> Iterator[None]:
        """What is established in it is forgotten after it."""
        facts, given, names, normal = self.facts, self.given, self.names, self.normal
        self.facts = facts.copied()
        self.say("{")
        yield
        self.say("}")
        self.facts, self.given, self.names, self.normal = facts, given, names, normal

    def every(self, indexed: bool) -> tuple[str, str]:
        """How a statement of each index begins, and its proof."""
        if not indexed:
            return "", ""
        return "forall i : nat, ", "intros i. " + "".join(f"pose proof ({name} i). " for name in self.facts.each)

    # --- names for values ---

    def prepare(self, value: Ratio) -> None:
        """Name the functions that a value mentions, and show its denominator not to be zero."""
        for atom in sorted(atoms_of(value) & self.context.functions.keys(), key=lambda a: int(a.partition("#")[2])):
            self._introduce(atom)
        if value.den != constant(1):
            self.sign(value.den, strict=False)

    def prepare_all(self, value: Ratio) -> None:
        """The same of a value that may have a sum over the index."""
        outside, inside = self.normal.split(value)
        self.prepare(outside)
        if inside is not None:
            self.prepare(inside)

    def assume(self, relation: Sign, name: str) -> None:
        """One more assumption in force, and its hypothesis."""
        self.given, self.names = self.given.with_margins([*self.given.margins, relation]), [*self.names, name]

    def remember(self, poly: Poly, name: str) -> None:
        """A hypothesis that a polynomial is not zero."""
        self.facts.signs[self.normal.poly(poly), False] = name
        self.facts.nonzero.append((poly, name, False))

    def _introduce(self, atom: str) -> None:
        name = self.normal.name(atom)
        if name in self.facts.atoms:
            return
        kind, argument = self.context.functions[atom]
        if SUM in atoms_of(argument):
            raise NotExported(f"{kind} of a sum")
        self.prepare(argument)
        function = {"log": "ln", "abs": "Rabs", "sign": "sgn"}.get(kind, kind)
        indexed = self.normal.indexed(symbol(atom))
        text = f"{function} {self.normal.ratio(argument)}"
        if indexed:
            self.say(f"destruct (named_each (fun i => {text})) as [{name} {name}_is].")
        else:
            self.say(f"destruct (named ({text})) as [{name} {name}_is].")
        self.facts.atoms.add(name)
        sign = {"exp": ("<", "apply exp_pos"), "abs": ("<=", "apply Rabs_pos"), "sqrt": ("<=", "apply sqrt_pos")}
        if kind in sign:
            relation, proof = sign[kind]
            start = "forall i : nat, " if indexed else ""
            self.say(f"assert ({name}_sign : {start}0 {relation} {self.normal.atom(atom)}).")
            self.say(f"{{ {'intros i. ' if indexed else ''}rewrite {name}_is. {proof}. }}")
            if indexed:
                self.facts.each.append(f"{name}_sign")

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
            shown = self.positive(value, wanted)
            if wanted != "non-negative":
                self.sign(value.num, strict=False)
            start, intros = self.every(each)
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

    # --- signs ---

    def sign(self, poly: Poly, strict: bool = True) -> str:
        """The hypothesis that a polynomial is positive, or (not strict) not zero, as the checker finds it."""
        text = self.normal.poly(poly)
        if (text, strict) in self.facts.signs:
            return self.facts.signs[text, strict]
        known = self._known_factors(strict)
        rest, factors, changed = poly, list[tuple[Poly, str]](), True
        while changed and set(rest) != {()}:
            changed = False
            for factor, proof in known:
                quotient = divide_exactly(rest, factor) if set(factor) != {()} else None
                if quotient is not None:
                    rest, changed = quotient, True
                    factors.append((factor, proof))
        if set(rest) == {()} and (rest[()] > 0 or not strict):
            proofs = ["lra"]
        else:
            proofs = [f"{'' if strict else 'apply pos_ne; '}exact {self.terms(rest, strictly=True)}"]
        indexed = self.normal.indexed(Ratio(poly))
        start, intros = self.every(indexed)
        product = " * ".join([self.normal.poly(rest), *(self.normal.poly(factor) for factor, _ in factors)])
        lemma, last = ("Rmult_lt_0_compat", "exact {}") if strict else ("product_ne", "exact {}")
        tree = proofs[0]
        for _, proof in factors:
            tree = f"apply {lemma}; [{tree} | {last.format(proof)}]"
        relation = f"0 < {text}" if strict else f"{text} <> 0"
        change = f"replace {text} with ({product}) by ring. " if factors else ""
        name = self.show("N", f"{start}{relation}", f"{intros}{change}{tree}.")
        self.facts.signs[text, strict] = name
        if indexed:
            self.facts.each.append(name)
        if not strict:
            self.facts.nonzero.append((poly, name, indexed))
        return name

    def _known_factors(self, strict: bool) -> list[tuple[Poly, str]]:
        found: list[tuple[Poly, str]] = []
        for (value, operator), name in zip(self.given.margins, self.names, strict=True):
            if value.den == constant(1) and SUM not in atoms_of(value):
                if operator == ">":
                    found.append((value.num, name if strict else f"(pos_ne _ {name})"))
                elif operator == "!=" and not strict:
                    found.append((value.num, name))
        for atom in self._positive_functions():
            proof = self._of_index(atom, f"{self.normal.name(atom)}_sign")
            found.append((symbol(atom).num, proof if strict else f"(pos_ne _ {proof})"))
        if not strict:
            found += [(poly, f"({name} i)" if indexed else name) for poly, name, indexed in self.facts.nonzero]
        return found

    def _of_index(self, atom: str, name: str) -> str:
        return f"({name} i)" if self.normal.indexed(symbol(atom)) else name

    def _positive_functions(self) -> list[str]:
        return [atom for atom, (kind, _) in self.context.functions.items()
                if kind == "exp" and self.normal.name(atom) in self.facts.atoms]

    def terms(self, poly: Poly, strictly: bool) -> str:
        """The Coq term that shows a polynomial positive, or not negative, term by term."""
        proof, strict_so_far = "", False
        for number, monomial in enumerate(sorted(poly)):
            one, strict = self._term(monomial, poly[monomial])
            if not number:
                proof, strict_so_far = one, strict
                continue
            lemma = {(True, True): "Rplus_lt_0_compat", (True, False): "Rplus_lt_le_0_compat",
                     (False, True): "Rplus_le_lt_0_compat", (False, False): "Rplus_le_le_0_compat"}
            proof = f"({lemma[strict_so_far, strict]} _ _ {proof} {one})"
            strict_so_far = strict_so_far or strict
        if strictly and not strict_so_far:
            raise NotExported(f"the sign of {self.normal.poly(poly)[:60]}")
        return f"(pos_ge _ {proof})" if strict_so_far and not strictly else proof

    def _term(self, monomial: tuple[tuple[str, int], ...], coefficient: Fraction) -> tuple[str, bool]:
        parts: list[tuple[str, bool]] = []
        if coefficient <= 0:
            raise NotExported("a sign that is not seen term by term")
        if coefficient != 1 or not monomial:
            parts.append((f"(ltac:(lra) : 0 < {number_text(coefficient)})", True))
        for atom, power in monomial:
            text, sign = self.normal.atom(atom), self._sign_of(atom)
            if sign is not None and (sign[1] or power % 2):
                proof, strict = sign
                if power == 1:
                    parts.append((proof, strict))
                else:
                    parts.append((f"({'pow_lt' if strict else 'pow_le'} {text} {power} {proof})", strict))
            elif power % 2 == 0:
                parts.append((f"(even_power {text} {power // 2})", False))
            else:
                raise NotExported(f"the sign of {text}")
        strict = all(strict for _, strict in parts)
        proofs = [proof if strict or not positive else f"(pos_ge _ {proof})" for proof, positive in parts]
        found = proofs[0]
        for proof in proofs[1:]:
            found = f"({'Rmult_lt_0_compat' if strict else 'Rmult_le_pos'} _ _ {found} {proof})"
        return found, strict

    def _sign_of(self, atom: str) -> tuple[str, bool] | None:
        if atom in self.context.functions:
            kind = self.context.functions[atom][0]
            if kind in ("exp", "abs", "sqrt"):
                return self._of_index(atom, f"{self.normal.name(atom)}_sign"), kind == "exp"
            return None
        weak = None
        for (value, operator), name in zip(self.given.margins, self.names, strict=True):
            if value.den == constant(1) and len(value.num) == 1 and operator in (">", ">="):
                (monomial, coefficient), = value.num.items()
                if monomial == ((atom, 1),) and coefficient > 0:
                    text = self.normal.atom(atom)
                    if operator == ">":
                        return f"(ltac:(generalize {name}; lra) : 0 < {text})", True
                    weak = f"(ltac:(generalize {name}; lra) : 0 <= {text})", False
        return weak

    def positive(self, value: Ratio, wanted: str = "positive") -> str:
        """The Coq term that a value is positive, non-zero or not negative, as the checker knows it."""
        if wanted == "non-negative":
            for (known, operator), name in zip(self.given.margins, self.names, strict=True):
                if operator in (">", ">=") and same(value, known):
                    goal = f"0 <= {self.normal.value(value)}"
                    return self.show("F", goal, f"replace {self.normal.value(value)} with {self.normal.value(known)} "
                                                f"by same. generalize {name}. lra.")
            try:
                over = f"(pos_ge _ {self.sign(value.num)})"
            except NotExported:
                over = self.terms(value.num, strictly=False)
            return over if value.den == constant(1) else f"(quotient_nonneg _ _ {over} {self.sign(value.den)})"
        strict = wanted == "positive"
        indexed = self.normal.indexed(value)

        def part(poly: Poly) -> str:
            name = self.sign(poly, strict)
            return f"({name} i)" if indexed and self.normal.indexed(Ratio(poly)) else name

        over = part(value.num)
        if value.den == constant(1):
            return over
        return f"({'quotient_pos' if strict else 'quotient_ne'} _ _ {over} {part(value.den)})"

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
            if called(part, "Sum"):
                found = self._sum(part.args[0])  # type: ignore[attr-defined]
                sums[f"{NAMED}{found[1]}"] = found
                return ast.Name(f"{NAMED}{found[1]}", ast.Load())
            return None

        bare = plain(replaced(replaced(node, rated), summed))
        rewrites += [equation for equation, _, _ in sums.values()]
        calls = self._calls(bare)
        linear = self.context.node(bare)
        self.prepare(linear)
        start, intros = self.every(each)
        change = "".join(f"rewrite ?{name}. " for name in rewrites)
        text = text_of(node, self.normal.letters)
        equation = self.show("E", f"{start}{text} = {self.normal.ratio(linear)}",
                             f"{intros}{change}{unfolding(node)}{calls}same.")
        if not sums:
            if not same(linear, self.context.node(node)):
                raise NotExported("an expression reads differently here and in the checker")
            return equation, linear
        if linear.den != constant(1) and atoms_of(Ratio(linear.den)) & sums.keys():
            raise NotExported("a sum below a fraction bar")
        outside = Ratio({m: c for m, c in linear.num.items() if not {a for a, _ in m} & sums.keys()}, linear.den)
        weights: dict[str, Ratio] = {}
        for name in sums:
            weights[name] = Ratio({tuple(f for f in m if f[0] != name): c for m, c in linear.num.items()
                                   if (name, 1) in m}, linear.den)
        inside = Ratio({})
        for name, weight in weights.items():
            inside = inside + weight * sums[name][2]
        if any(atoms_of(weight) & sums.keys() for weight in weights.values()):
            raise NotExported("a product of sums")
        value = joined(outside, inside)
        if SUM not in atoms_of(value):
            inside = Ratio({})
        if not same(value, self.context.node(node)):
            raise NotExported("a sum reads differently here and in the checker")
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

    def rate(self, node: ast.expr) -> tuple[str, ast.expr]:
        """The equation of a derivative D(...), and its expression."""
        inner: ast.expr = node.args[0]  # type: ignore[attr-defined]
        letters = self.normal.letters
        text = text_of(node, letters)
        if text in self.facts.rates:
            return self.facts.rates[text]
        if any(called(part, "D") for part in ast.walk(inner)):
            raise NotExported("a derivative of a derivative")
        self.libraries.add("WorkbenchFlow")
        found = Differentiation(self.rates, letters).of(inner)
        value = found.value if found.value is not None else ast.Constant(0)
        start, intros = self.every(bool(names_in(inner) & letters.indexed) and not called(inner, "Sum")
                                   and _outside_sums(inner, letters.indexed))
        function = f"(fun s => {text_of(inner, letters.at('s'))})"
        derives = self.show("X", f"{start}is_derive {function} {letters.instant} {text_of(value, letters)}",
                            f"{intros}refine {found.proof}; cbv beta; "
                            "solve [assumption | reflexivity | simpl; lra | nonzero].")
        at = " i" if start else ""
        exists = self.show("Y", f"{start}ex_derive {function} {letters.instant}",
                           f"{'intros i. ' if start else ''}exists {text_of(value, letters)}. exact ({derives}{at}).")
        equation = self.show("D", f"{start}{text} = {text_of(value, letters)}",
                             f"{'intros i. ' if start else ''}apply is_derive_unique. exact ({derives}{at}).")
        self.facts.rates[text] = equation, value
        self.facts.rates[f"ex {text}"] = exists, value
        return equation, value

    # --- functions ---

    def _calls(self, node: ast.expr) -> str:
        """Show what every call in an expression is worth; the rewriting that puts the values in their place."""
        found: list[str] = []
        for part in reversed(list(ast.walk(node))):
            if isinstance(part, ast.Call):
                text = text_of(part, self.normal.letters)
                if text not in self.facts.calls:
                    self.facts.calls[text] = self._call(part, text)
                found.append(text)
        outermost_first = sorted(set(found), key=lambda text: -len(text))
        return "".join(f"rewrite ?{self.facts.calls[text]}. " for text in outermost_first)

    def _call(self, node: ast.Call, text: str) -> str:
        kind, inner = node.func.id, node.args[0]  # type: ignore[attr-defined]
        inside = self._calls(inner)
        return self.function(kind, text, text_of(inner, self.normal.letters), self.context.node(inner), inside)

    def function(self, kind: str, text: str, inner: str, argument: Ratio, inside: str = "") -> str:
        """The equation of a function's value, `argument` being the value of its argument, which stands as `inner`."""
        value = self.context.call(kind, argument)
        if SUM in atoms_of(value):
            raise NotExported(f"{kind} of a sum")
        self.prepare(argument)
        self.prepare(value)
        start, intros = self.every(self.normal.indexed(argument))
        statement = f"{start}{text} = {self.normal.ratio(value)}"
        number = is_number(value)
        shown = f"{inside}same."
        if number is not None:
            proof = {"log": "apply ln_one. ", "exp": "apply exp_zero. "}.get(kind)
            if proof is None or (kind, number) not in (("log", 0), ("exp", 1)):
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
            proof = f"{named}apply abs_turned. " if turned else f"{named}apply f_equal. "
        elif kind == "log" and same(value, -symbol(atom)):
            positive = self.positive(argument)
            return self.show("C", statement,
                             f"{intros}transitivity (- {self.normal.atom(atom)}); [|ring]. {named}apply ln_reciprocal. "
                             f"{{ replace {inner} with {self.normal.ratio(argument)} by (symmetry; {joined_tactics(inside)}same). "
                             f"exact {positive}. }} {shown}")
        elif kind == "sign" and same(value, -symbol(atom)):
            proof = f"transitivity (- {self.normal.atom(atom)}); [|ring]. {named}apply sgn_turned. "
        elif kind == "exp" and same(value, symbol(atom).inverse()):
            proof = f"transitivity (/ {self.normal.atom(atom)}); [|same]. {named}apply exp_minus_inv. "
        else:
            return self._shifted(statement, intros, inner, argument, value, inside, kind)
        return self.show("C", statement, f"{intros}{proof}{shown}")

    def _of_number(self, kind: str, inner: str, argument: Fraction | None, value: Fraction, inside: str) -> str:
        if argument is None:
            raise NotExported(f"{kind} of {inner[:40]}")
        change = f"replace {inner} with {number_text(argument)} by (symmetry; {joined_tactics(inside)}same). "
        if kind == "abs":
            return f"{change}rewrite {'Rabs_right' if argument >= 0 else 'Rabs_left'} by lra. lra."
        if kind == "sign":
            lemma = "sgn_pos" if argument > 0 else "sgn_neg" if argument < 0 else "sgn_zero"
            return f"{change}apply {lemma}. lra."
        if kind == "sqrt":
            return f"{change}apply sqrt_number; lra."
        raise NotExported(f"{kind} of the number {argument}")

    def _shifted(self, statement: str, intros: str, inner: str, argument: Ratio, value: Ratio, inside: str,
                 kind: str) -> str:
        """exp of a sum of logarithms, a number and a rest: the product of their exps."""
        if kind != "exp" or len(argument.den) != 1:
            raise NotExported(f"{kind} of {inner[:40]}")
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
            raise NotExported(f"exp of {inner[:40]}")
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

def conjunction(proofs: list[str]) -> str:
    """The Coq term of a conjunction, from those of its parts."""
    found = proofs[-1]
    for proof in reversed(proofs[:-1]):
        found = f"(conj {proof} {found})"
    return found


def joined_tactics(sentences: str) -> str:
    """Tactics of several sentences as they stand inside of one."""
    return sentences.replace(". ", "; ")

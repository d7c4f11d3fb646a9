"""Names for the values of functions, and facts of sign: why a polynomial is positive, or not zero."""

from __future__ import annotations

from workbench.kernel.normal import number_text
from workbench.kernel.syntax import FUNCTIONS, NotExportedError
from workbench.kernel.writing import Writing
from workbench.proof.checker import SUM, TOTAL, Number, Poly, Ratio, atoms_of, constant, divide_exactly, same, symbol


class Signs(Writing):
    """Writes what a proof knows of signs, found as the checker finds it."""

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

    def _introduce(self, atom: str) -> None:
        name = self.normal.name(atom)
        if name in self.facts.atoms:
            return
        kind, argument = self.context.functions[atom]
        if SUM in atoms_of(argument):
            raise NotExportedError(f"{kind} of a sum")
        self.prepare(argument)
        indexed = self.normal.indexed(symbol(atom))
        of = self.normal.ratio(argument)
        text = f"bigsum n (fun i => {of})" if kind == TOTAL else f"{FUNCTIONS[kind]} {of}"
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

    # --- signs ---

    def sign(self, poly: Poly, strict: bool = True) -> str:
        """The hypothesis that a polynomial is positive, or (not strict) not zero, as the checker finds it."""
        text = self.normal.poly(poly)
        if (text, strict) in self.facts.signs:
            return self.facts.signs[text, strict]
        known = self._known_factors(strict)
        try:
            return self._sign_by_factors(poly, strict, known)
        except NotExportedError:  # x*y by x leaves y, of no known sign
            return self._sign_by_factors(poly, strict, known[::-1])

    def _sign_by_factors(self, poly: Poly, strict: bool, known: list[tuple[Poly, str]]) -> str:
        """The same, by what is known in that order."""
        text = self.normal.poly(poly)
        rest, factors, changed = poly, list[tuple[Poly, str]](), True
        while changed and set(rest) != {()}:
            changed = False
            for factor, proof in known:
                quotient = divide_exactly(rest, factor) if set(factor) != {()} else None
                if quotient is not None:
                    rest, changed = quotient, True
                    factors.append((factor, proof))
        if set(rest) == {()} and (rest[()] > 0 or not strict):
            proofs = ["linear"]
        elif factors:  # what is left is known by a name too: `field` asks for it
            inner = self.sign(rest, strict)
            proofs = [f"exact {f'({inner} i)' if self.normal.indexed(Ratio(rest)) else inner}"]
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
        change = f"replace {text} with ({product}) by same. " if factors else ""
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
            raise NotExportedError(f"the sign of {self.normal.poly(poly)[:60]}")
        return f"(pos_ge _ {proof})" if strict_so_far and not strictly else proof

    def _term(self, monomial: tuple[tuple[str, int], ...], coefficient: Number) -> tuple[str, bool]:
        parts: list[tuple[str, bool]] = []
        if coefficient <= 0:
            raise NotExportedError("a sign that is not seen term by term")
        if coefficient != 1 or not monomial:
            parts.append((f"(ltac:(linear) : 0 < {number_text(coefficient)})", True))
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
                raise NotExportedError(f"the sign of {text}")
        strict = all(strict for _, strict in parts)
        proofs = [proof if strict or not positive else f"(pos_ge _ {proof})" for proof, positive in parts]
        found = proofs[0]
        for proof in proofs[1:]:
            found = f"({'Rmult_lt_0_compat' if strict else 'Rmult_le_pos'} _ _ {found} {proof})"
        return found, strict

    def _sign_of(self, atom: str) -> tuple[str, bool] | None:
        if atom in self.context.functions:
            kind = self.context.functions[atom][0]
            if kind == TOTAL:
                return self._sign_of_total(atom)
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
                        return f"(ltac:(generalize {name}; linear) : 0 < {text})", True
                    weak = f"(ltac:(generalize {name}; linear) : 0 <= {text})", False
        return weak

    def _sign_of_total(self, atom: str) -> tuple[str, bool] | None:
        """A sum of terms that are not negative, None of others."""
        term = self.context.functions[atom][1]
        if term.den != constant(1):
            return None
        try:
            each = self.terms(term.num, strictly=False)
        except NotExportedError:
            return None
        name = self.normal.name(atom)
        return self.show("F", f"0 <= {name}", f"rewrite {name}_is. apply bigsum_nonneg. intros i _. exact {each}."
                         ), False

    def positive(self, value: Ratio, wanted: str = "positive") -> str:
        """The Coq term that a value is positive, non-zero or not negative, as the checker knows it."""
        if wanted == "non-negative":
            for (known, operator), name in zip(self.given.margins, self.names, strict=True):
                if operator in (">", ">=") and same(value, known):
                    goal = f"0 <= {self.normal.value(value)}"
                    return self.show("F", goal, f"replace {self.normal.value(value)} with {self.normal.value(known)} "
                                                f"by {self.agree(value)}. generalize {name}. linear.")
            try:
                over = f"(pos_ge _ {self.sign(value.num)})"
            except NotExportedError:
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

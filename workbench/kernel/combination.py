"""The rule combination: a value is, but for a positive multiplier, a sum of products whose factors have known signs."""

from __future__ import annotations

import ast
from typing import Any

from workbench.kernel.factors import factor_of
from workbench.kernel.normal import number_text
from workbench.kernel.script import MARGINS, Script
from workbench.kernel.syntax import NotExportedError
from workbench.proof.checker import SUM, Ratio, atoms_of, constant, nodes, read_rational, split_relation

# Text, sign, proof, and what stands outside of the sum, the sum's term, the equation that says so.
Term = tuple[str, str, str, tuple[str, "str | None", str]]


def combination(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    """The proof that a value has the sign that its sum of products has."""
    scale, positive = "1", "Rlt_0_1"
    for item in proof.get("multiplier", []):
        factor = factor_of(script, item)
        if factor.sign != ">" or SUM in atoms_of(factor.value):
            raise NotExportedError("a multiplier with a sum")
        positive = f"(Rmult_lt_0_compat _ _ {positive} {factor.proof})"
        scale = f"({scale} * {factor.text})"
    terms = [_product(script, term) for term in proof["terms"]]
    total, sign = _total(terms), _sign(terms, operator)
    lemma = {"==": "combination_eq", ">": "combination_gt", ">=": "combination_ge"}[operator]
    outside, inside = script.normal.split(value)
    script.prepare_all(value)
    whole = script.normal.value(value)
    summed = any(sums is not None for _, _, _, (_, sums, _) in terms)
    if inside is None and not summed:
        adds_up = script.show("Q", f"{scale} * {whole} = {total}", "same.")
    else:
        adds_up = _adds_up_with_sums(script, scale, outside, inside, whole, total, terms)
    script.say(f"exact ({lemma} _ _ _ {positive} {sign} {adds_up}).")


def at_once(script: Script, text: str, operator: str, proof: dict[str, Any]) -> str | None:
    """The Coq term of a relation between polynomials whose sides differ by a combination of some, None of others.

    The equation is left open in it, for `same`: Coq finds both sides in what is to be shown and in the signs, where a
    proof through the margin's normal form would have to print both, and show two equations.
    """
    items = [item for term in proof.get("terms", []) for item in term["factors"]]
    if proof["rule"] != "combination" or proof.get("multiplier") or not items or any(
            isinstance(node, ast.Call) for node in nodes(text)) or not all(_is_polynomial(script, i) for i in items):
        return None
    sign = _sign([_product(script, term) for term in proof["terms"]], operator)
    if operator == ">=":
        sign = f"(Rle_ge _ _ {sign})"
    return f"({MARGINS[split_relation(text)[1]]}_of _ _ _ _ {sign})"


def _is_polynomial(script: Script, item: dict[str, Any]) -> bool:
    match item:
        case {"assume": int(place)}:
            value = script.given.margins[place][0]
        case {"square": str(text)}:
            value = script.context.read(text)
        case _:
            return False
    return value.den == constant(1) and not atoms_of(value) & (script.context.functions.keys() | {SUM})


def _total(terms: list[Term]) -> str:
    """The sum of terms as Coq text."""
    total = terms[0][0] if terms else "0"
    for text, _, _, _ in terms[1:]:
        total = f"({total} + {text})"
    return total


def _sign(terms: list[Term], operator: str) -> str:
    """The Coq term that a sum of terms has the sign that an operator says."""
    if operator == "==":
        sign = "eq_refl" if not terms else terms[0][2]
        for _, _, zero, _ in terms[1:]:
            sign = f"(zero_plus _ _ {sign} {zero})"
        return sign
    sign, strict = _sum_of_signs(terms)
    if operator == ">" and not strict:
        raise NotExportedError("a combination without a strictly positive term")
    return f"(pos_ge _ {sign})" if operator == ">=" and strict else sign


def _sum_of_signs(terms: list[Term]) -> tuple[str, bool]:
    """The Coq term that a sum of terms is positive or not negative, and which of them."""
    if not terms:
        return "(Rle_refl 0)", False
    found, strict = terms[0][2], terms[0][1] == ">"
    if terms[0][1] == "==":
        found = f"(eq_nonneg _ {found})"
    lemmas = {(True, True): "Rplus_lt_0_compat", (True, False): "Rplus_lt_le_0_compat",
              (False, True): "Rplus_le_lt_0_compat", (False, False): "Rplus_le_le_0_compat"}
    for _, sign, proof, _ in terms[1:]:
        one = f"(eq_nonneg _ {proof})" if sign == "==" else proof
        found = f"({lemmas[strict, sign == '>']} _ _ {found} {one})"
        strict = strict or sign == ">"
    return found, strict


def _product(script: Script, term: dict[str, Any]) -> Term:
    coefficient = read_rational(term["coefficient"])
    factors = [factor_of(script, item) for item in term["factors"]]
    sums = [factor for factor in factors if SUM in atoms_of(factor.value)]
    if len(sums) > 1:
        raise NotExportedError("a product of sums")
    factors = [factor for factor in factors if factor not in sums] + sums
    text = number_text(coefficient)
    if any(factor.sign == "==" for factor in factors):
        sign, proof = "==", ""
        for factor in factors:
            if factor.sign == "==":
                proof = f"(zero_last {text} _ {factor.proof})"
            elif proof:
                proof = f"(zero_first _ {factor.text} {proof})"
            text = f"({text} * {factor.text})"
    else:
        strict = coefficient > 0 and all(factor.sign == ">" for factor in factors)
        sign = ">" if strict else ">="
        proof = f"(ltac:(linear) : 0 {'<' if strict else '<='} {text})"
        for factor in factors:
            one = factor.proof if strict or factor.sign != ">" else f"(pos_ge _ {factor.proof})"
            proof = f"({'Rmult_lt_0_compat' if strict else 'Rmult_le_pos'} _ _ {proof} {one})"
            text = f"({text} * {factor.text})"
    if not sums:
        return text, sign, proof, (text, None, f"(no_split n {text})")
    before = number_text(coefficient)
    for factor in factors[:-1]:
        before = f"({before} * {factor.text})"
    outside, inside = script.normal.split(sums[0].value)
    assert inside is not None
    here, each = script.normal.ratio(outside), script.normal.ratio(inside)
    return text, sign, proof, (f"({before} * {here})", f"({before} * {each})",
                               f"(scale_split n {before} {here} (fun i => {each}))")


def _adds_up_with_sums(script: Script, scale: str, outside: Ratio, inside: Ratio | None, whole: str, total: str,
                       terms: list[Term]) -> str:
    """scale * value = total where sums over the index stand in them."""
    beyond, each, equation = "0", "0", "(no_split n 0)"
    for number_, (_, _, _, (apart, summed, one)) in enumerate(terms):
        term = summed or "0"
        if number_:
            equation = f"(add_split n _ {beyond} (fun i => {each}) _ {apart} (fun i => {term}) {equation} {one})"
            beyond, each = f"({beyond} + {apart})", f"({each} + {term})"
        else:
            equation, beyond, each = one, apart, term
    split = script.show("Q", f"{total} = {beyond} + bigsum n (fun i => {each})", f"exact {equation}.")
    here, inner = script.normal.ratio(outside), script.normal.ratio(inside) if inside is not None else "0"
    _, intros = script.every(True)
    # a value without a sum is one with a sum of zeros
    start = f"transitivity ({scale} * ({here} + bigsum n (fun i => 0))); [f_equal; apply no_split|]. "
    return script.show(
        "Q", f"{scale} * {whole} = {total}",
        f"{start if inside is None else ''}refine (eq_trans (combined_sum n {scale} {here} (fun i => {inner}) {beyond} "
        f"(fun i => {each}) _ _) (eq_sym {split})). {{ same. }} "
        f"{intros}intros _. cbv beta. same.")

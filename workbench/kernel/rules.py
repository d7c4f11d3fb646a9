"""The checker's rules as Coq proofs: each rule is a lemma of the library, each step of a certificate its use."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..proof.checker import (
    CASES,
    SUM,
    Ratio,
    atoms_of,
    constant,
    margin,
    number,
    read_rational,
    same,
    substitute,
    symbol,
)
from .motion import nonincreasing
from .normal import is_number, number_text
from .script import Script, joined_tactics
from .syntax import NotExported

COQ = {">": ">", ">=": ">=", "==": "=", "!=": "<>"}


@dataclass(frozen=True)
class Factor:
    """A factor of a product: text, sign, the Coq term of its sign (0 <, 0 <=, = 0), and its sum over the index."""

    text: str
    sign: str
    proof: str
    value: Ratio


def stated(script: Script, value: Ratio, operator: str) -> str:
    """A value's relation to zero as Coq text."""
    script.prepare_all(value)
    return f"{script.normal.value(value)} {COQ[operator]} 0"


def prove(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    """The proof of what `stated` says of a value, at the goal where the script stands."""
    rules = {"identity": _identity, "combination": _combination, "cut": _cut, "cases": _cases,
             "contradiction": _contradiction, "nonincreasing": _nonincreasing}
    rule = str(proof.get("rule"))
    if rule not in rules:
        raise NotExported(f"the rule {rule[:40]}")
    rules[rule](script, value, operator, proof)


def _identity(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    if not value.is_zero():
        raise NotExported("an identity whose sides differ")
    script.say("apply Rge_refl." if operator == ">=" else "reflexivity.")


def _cut(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    lemma = margin(script.context, proof["lemma"])
    name = script.fresh("M")
    script.say(f"assert ({name} : {stated(script, *lemma)}).")
    with script.subproof():
        prove(script, *lemma, proof["proof"])
    script.assume(lemma, name)
    prove(script, value, operator, proof["then"])


def _contradiction(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    script.say("exfalso. assert (absurd : 0 > 0).")
    with script.subproof():
        _combination(script, number(0), ">", proof)
    script.say("exact (Rgt_irrefl _ absurd).")


def _nonincreasing(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    drop, name = nonincreasing(script, proof, prove)
    script.assume(drop, name)
    prove(script, value, operator, proof["then"])


def _cases(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    context = script.context
    names = tuple(sorted(proof.keys() - {"rule", "of"}))
    inspected = context.read(proof["of"])
    script.prepare_all(inspected)
    text = script.normal.value(inspected)
    if len(names) == 2:
        script.say(f"destruct (two_cases {text}) as [case_|case_].")
    else:
        script.say(f"destruct (three_cases {text}) as [case_|[case_|case_]].")
    for name, (direction, relation, sign) in zip(names, CASES[names], strict=True):
        with script.subproof():
            _case(script, value, operator, proof[name], inspected, direction, relation, sign)


def _case(script: Script, value: Ratio, operator: str, proof: dict[str, Any], inspected: Ratio, direction: int,
          relation: str, sign: int | None) -> None:
    context = script.context
    size = number(direction) * inspected
    text = script.normal.value(inspected)
    hypothesis = script.fresh("M")
    # the cases of the library speak of x and - x
    script.say(f"assert ({hypothesis} : {stated(script, size, relation)}).")
    script.say(f"{{ replace {script.normal.value(size)} with ({text if direction > 0 else '- ' + text}) by same. "
               "exact case_. }")
    known: dict[str, Ratio] = {}
    rewrites: list[str] = []
    for atom, (kind, argument) in list(context.functions.items()):
        turned = same(argument, -inspected)
        if kind == "abs" and (turned or same(argument, inspected)):
            known[atom] = size
        elif kind == "sign" and sign is not None and (turned or same(argument, inspected)):
            known[atom] = number(-sign if turned else sign)
        else:
            continue
        if script.normal.name(atom) not in script.facts.atoms:
            script.prepare(symbol(atom))
        script.prepare(known[atom])
        inner = script.normal.ratio(argument)
        step = f"rewrite {script.normal.name(atom)}_is. "
        if kind == "abs":
            positive = same(argument, size)
            step += (f"replace {inner} with ({'' if positive else '- '}{script.normal.ratio(size)}) by same. "
                     f"{'' if positive else 'rewrite Rabs_Ropp. '}apply Rabs_right. generalize {hypothesis}. lra.")
        else:
            lemma = {1: "sgn_pos", -1: "sgn_neg", 0: "sgn_zero"}[int(is_number(known[atom]) or 0)]
            step += (f"replace {inner} with ({'- ' if turned else ''}{text}) by same. apply {lemma}. "
                     "generalize case_. lra.")
        rewrites.append(script.show("K", f"{script.normal.atom(atom)} = {script.normal.ratio(known[atom])}", step))
    change = "".join(f"rewrite ?{name}. " for name in rewrites)

    def case_of(old: Ratio) -> Ratio:
        done = dict(known)
        new = substitute(context, old, known, done)
        if done.keys() != known.keys():
            deeper = [a for a in done.keys() - known.keys() if not same(done[a], symbol(a))]
            if deeper:
                raise NotExported("a case inside of a function's argument")
        return new

    margins, names = [], []
    for (old, op), name in zip(script.given.margins, script.names, strict=True):
        new = case_of(old)
        if not same(new, old):
            script.prepare_all(new)
            name = script.show("M", f"{script.normal.value(new)} {COQ[op]} 0",
                               f"replace {script.normal.value(new)} with {script.normal.value(old)} "
                               f"by ({joined_tactics(change)}same). exact {name}.")
        margins.append((new, op))
        names.append(name)
    script.given, script.names = script.given.with_margins([*margins, (size, relation)]), [*names, hypothesis]
    new = case_of(value)
    if not same(new, value):
        script.prepare_all(new)
        script.say(f"replace {script.normal.value(value)} with {script.normal.value(new)} by ({joined_tactics(change)}same).")
    elif script.normal.value(new) != script.normal.value(value):
        script.say(f"replace {script.normal.value(value)} with {script.normal.value(new)} by same.")
    prove(script, new, operator, proof)


# --- combination ---


def _combination(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    scale, scale_value, positive = "1", number(1), "Rlt_0_1"
    for item in proof.get("multiplier", []):
        factor = _factor(script, item)
        if factor.sign != ">" or SUM in atoms_of(factor.value):
            raise NotExported("a multiplier with a sum")
        positive = f"(Rmult_lt_0_compat _ _ {positive} {factor.proof})"
        scale, scale_value = f"({scale} * {factor.text})", scale_value * factor.value
    terms = [_product(script, term) for term in proof["terms"]]
    total = terms[0][0] if terms else "0"
    for text, _, _, _ in terms[1:]:
        total = f"({total} + {text})"
    if operator == "==":
        sign = "eq_refl" if not terms else terms[0][2]
        for _, _, zero, _ in terms[1:]:
            sign = f"(zero_plus _ _ {sign} {zero})"
        lemma = "combination_eq"
    else:
        sign, strict = _sum_of_signs(terms)
        if operator == ">" and not strict:
            raise NotExported("a combination without a strictly positive term")
        if operator == ">=" and strict:
            sign = f"(pos_ge _ {sign})"
        lemma = "combination_gt" if operator == ">" else "combination_ge"
    outside, inside = script.normal.split(value)
    script.prepare_all(value)
    whole = script.normal.value(value)
    summed = any(sums is not None for _, _, _, (_, sums, _) in terms)
    if inside is None and not summed:
        adds_up = script.show("Q", f"{scale} * {whole} = {total}", "same.")
    else:
        adds_up = _adds_up_with_sums(script, scale, outside, inside, whole, total, terms)
    script.say(f"exact ({lemma} {scale} {whole} {total} {positive} {sign} {adds_up}).")


# Text, sign, proof, and what stands outside of the sum, the sum's term, the equation that says so.
Term = tuple[str, str, str, tuple[str, "str | None", str]]


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
    factors = [_factor(script, item) for item in term["factors"]]
    sums = [factor for factor in factors if SUM in atoms_of(factor.value)]
    if len(sums) > 1:
        raise NotExported("a product of sums")
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
        proof = f"(ltac:(lra) : 0 {'<' if strict else '<='} {text})"
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


def _factor(script: Script, item: dict[str, Any]) -> Factor:
    given, context, normal = script.given, script.context, script.normal
    match item:
        case {"assume": int(i)}:
            value, sign = given.margins[i]
            script.prepare_all(value)
            proof = {">": "(gt_pos _ {})", ">=": "(ge_nonneg _ {})", "==": "{}"}[sign].format(script.names[i])
            return Factor(normal.value(value), sign, proof, value)
        case {"positive": str(text)}:
            value = context.read(text)
            script.prepare_all(value)
            return Factor(normal.value(value), ">", script.positive(value), value)
        case {"inverse": int(i)}:
            value, name = given.margins[i][0], script.names[i]
            script.prepare_all(value)
            below = normal.value(value)
            if value.den == constant(1):
                script.sign(value.num, strict=False)
            else:
                over = normal.poly(value.num)
                script.remember(value.num, script.show(
                    "N", f"{over} <> 0", f"intro zero_. generalize {name}. unfold Rdiv. rewrite zero_, Rmult_0_l. lra."))
            return Factor(f"(/ {below})", ">", f"(inverse_pos _ {name})", value.inverse())
        case {"square_of": int(i)}:
            value = given.margins[i][0]
            below = normal.value(value)
            return Factor(f"({below} * {below})", ">", f"(square_pos _ {script.names[i]})", value * value)
        case {"square": str(text)}:
            root = context.read(text)
            if SUM in atoms_of(root):
                raise NotExported("a square of a sum")
            script.prepare_all(root)
            below = normal.value(root)
            return Factor(f"({below} * {below})", ">=", f"(square_nonneg {below})", root * root)
        case {"sum_of_squares": str(text)}:
            root = context.term(text)
            script.prepare(root)
            value = root * root * symbol(SUM)
            script.prepare_all(value)
            _, inside = normal.split(value)
            assert inside is not None
            one = normal.ratio(root)
            _, intros = script.every(True)
            name = script.show("F", f"0 <= {normal.value(value)}",
                               f"rewrite Rplus_0_l. apply bigsum_nonneg. {intros}intros _. "
                               f"replace {normal.ratio(inside)} with ({one} * {one}) by same. apply square_nonneg.")
            return Factor(normal.value(value), ">=", name, value)
        case {"any": str(text)}:
            value = context.read(text)
            script.prepare_all(value)
            return Factor(normal.value(value), "any", "", value)
        case {"fact": str(name), "of": str(text)}:
            return _fact(script, name, text)
    raise NotExported(f"the factor {str(item)[:60]}")


def _fact(script: Script, name: str, text: str) -> Factor:
    context, normal = script.context, script.normal
    inner = context.read(text)
    if name == "enclosure":
        script.prepare_all(inner)
        unfold = "".join(f"rewrite ?{atom}_is. " for atom in sorted(script.facts.atoms, reverse=True))
        script.libraries.add("Interval")
        proof = script.show("F", f"0 <= {normal.value(inner)}", f"{unfold}interval with (i_prec 120).")
        return Factor(normal.value(inner), ">=", proof, inner)
    kind = name.partition("_")[0]
    if SUM in atoms_of(inner):
        raise NotExported(f"{kind} of a sum")
    script.prepare_all(inner)
    argument = normal.ratio(inner)
    function = {"log": "ln", "abs": "Rabs"}.get(kind, kind)
    equation = script.function(kind, f"({function} {argument})", argument, inner)
    worth = context.call(kind, inner)
    call, here = f"({function} {argument})", normal.ratio(worth)
    match name:
        case "log_tangent":
            value, sign = inner + number(-1) + -worth, ">="
            bare, lemma = f"({argument} - 1 - {call})", f"apply log_tangent. exact {script.positive(inner)}."
        case "exp_tangent":
            value, sign = worth + number(-1) + -inner, ">="
            bare, lemma = f"({call} - 1 - {argument})", "apply exp_tangent."
        case "exp_positive":
            value, sign, bare, lemma = worth, ">", call, "apply exp_pos."
        case "abs_square":
            value, sign = worth * worth + -(inner * inner), "=="
            bare, lemma = f"({call} * {call} - {argument} * {argument})", "apply abs_square."
        case "abs_nonnegative":
            value, sign, bare, lemma = worth, ">=", call, "apply Rabs_pos."
        case "sqrt_nonnegative":
            value, sign, bare, lemma = worth, ">=", call, "apply sqrt_pos."
        case "sqrt_square":
            value, sign = worth * worth + -inner, "=="
            bare = f"({call} * {call} - {argument})"
            lemma = f"apply sqrt_squared. exact {script.positive(inner, 'non-negative')}."
        case "sqrt_positive":
            value, sign, bare = worth, ">", call
            lemma = f"apply sqrt_lt_R0. exact {script.positive(inner)}."
        case _:
            raise NotExported(f"the fact {name[:40]}")
    script.prepare_all(value)
    relation = {">": "0 < {}", ">=": "0 <= {}", "==": "{} = 0"}[sign]
    proof = script.show("F", relation.format(normal.value(value)),
                        f"replace {normal.value(value)} with {bare} by (rewrite {equation}; same). {lemma}")
    return Factor(normal.value(value), sign, proof, value)

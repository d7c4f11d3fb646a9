"""The factors of a combination: assumptions, squares, inverses and facts, each with the Coq term of its sign."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from workbench.kernel.script import Script
from workbench.kernel.syntax import NotExportedError
from workbench.proof.checker import SUM, Ratio, atoms_of, constant, number, symbol


@dataclass(frozen=True)
class Factor:
    """A factor of a product: text, sign, the Coq term of its sign (0 <, 0 <=, = 0), and its sum over the index."""

    text: str
    sign: str
    proof: str
    value: Ratio


def factor_of(script: Script, item: dict[str, Any]) -> Factor:  # noqa: PLR0911 - a case a kind
    """A factor with the proof of its sign, as the checker reads it; what it needs is written into the script."""
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
                    "N", f"{over} <> 0", f"intro zero_. generalize {name}. unfold Rdiv. "
                    "rewrite zero_, Rmult_0_l. lra."))
            return Factor(f"(/ {below})", ">", f"(inverse_pos _ {name})", value.inverse())
        case {"square_of": int(i)}:
            value = given.margins[i][0]
            below = normal.value(value)
            return Factor(f"({below} * {below})", ">", f"(square_pos _ {script.names[i]})", value * value)
        case {"square": str(text)}:
            root = context.read(text)
            if SUM in atoms_of(root):
                raise NotExportedError("a square of a sum")
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
    raise NotExportedError(f"the factor {str(item)[:60]}")


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
        raise NotExportedError(f"{kind} of a sum")
    script.prepare_all(inner)
    argument = normal.ratio(inner)
    function = {"log": "ln", "abs": "Rabs"}.get(kind, kind)
    equation = script.function(kind, f"({function} {argument})", argument, inner)
    worth = context.call(kind, inner)
    call = f"({function} {argument})"
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
            raise NotExportedError(f"the fact {name[:40]}")
    script.prepare_all(value)
    relation = {">": "0 < {}", ">=": "0 <= {}", "==": "{} = 0"}[sign]
    proof = script.show("F", relation.format(normal.value(value)),
                        f"replace {normal.value(value)} with {bare} by (rewrite {equation}; same). {lemma}")
    return Factor(normal.value(value), sign, proof, value)

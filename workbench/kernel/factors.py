"""The factors of a combination: assumptions, squares, inverses and facts, each with the Coq term of its sign."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from workbench.kernel.script import Script
from workbench.kernel.syntax import FUNCTIONS, NotExportedError
from workbench.kernel.totals import Closed
from workbench.proof.checker import ARCTAN, SUM, Ratio, atoms_of, constant, number, symbol


@dataclass(frozen=True)
class Factor:
    """A factor of a product: text, sign, the Coq term of its sign (0 <, 0 <=, = 0), and its sum over the index."""

    text: str
    sign: str
    proof: str
    value: Ratio


def factor_of(script: Script, item: dict[str, Any]) -> Factor:  # noqa: PLR0911, PLR0912 - a case a kind
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
                    "rewrite zero_, Rmult_0_l. linear."))
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
            if isinstance(context, Closed):
                return _sum_of_squares(script, root)
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
        case {"fact": "sine_sum" | "cosine_sum" | "exp_sum" | "log_product" as name, "of": str(one), "and": str(two)}:
            return _addition(script, name, context.read(one), context.read(two))
        case {"fact": "circle" | "cosine_parabola" | "sine_tangent" as name, "of": str(text)}:
            return _angle(script, name, context.read(text))
        case {"fact": str(name), "of": str(text)} if name in ARCTAN:
            return _arctan(script, name, context.read(text))
        case {"fact": str(name), "of": str(text)}:
            return _fact(script, name, text)
    raise NotExportedError(f"the factor {str(item)[:60]}")


def _sum_of_squares(script: Script, root: Ratio) -> Factor:
    """A sum of squares where sums are numbers of their own."""
    one, found = script.normal.ratio(root), script.total(root * root)
    script.prepare(found.value)
    text = script.normal.value(found.value)
    _, intros = script.every(True)
    name = script.show("F", f"0 <= {text}", f"replace {text} with {found.text} by same. rewrite {found.proof}. "
                       f"apply bigsum_nonneg. {intros}intros _. cbv beta. replace {found.each} with ({one} * {one}) "
                       "by same. apply square_nonneg.")
    return Factor(text, ">=", name, found.value)


def _fact(script: Script, name: str, text: str) -> Factor:
    context, normal = script.context, script.normal
    inner = context.read(text)
    if name == "enclosure":
        script.prepare_all(inner)
        unfold = "".join(f"rewrite ?{atom}_is. " for atom in sorted(script.facts.atoms, reverse=True))
        script.libraries.add("Interval")
        proof = script.show("F", f"0 <= {normal.value(inner)}", f"{unfold}interval with (i_prec 120).")
        return Factor(normal.value(inner), ">=", proof, inner)
    call, equation, worth = _call(script, name.partition("_")[0], inner)
    argument = normal.ratio(inner)
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
    return _shown(script, value, sign, bare, equation, lemma)


def _angle(script: Script, name: str, angle: Ratio) -> Factor:
    """A fact of sin and cos of one angle."""
    text = script.normal.ratio(angle)
    if name == "sine_tangent":
        call, equation, worth = _call(script, "sin", angle)
        sign = script.positive(angle, "non-negative")
        return _shown(script, angle + -worth, ">=", f"({text} - {call})", equation,
                      f"apply sine_tangent. exact {sign}.")
    call, equation, worth = _call(script, "cos", angle)
    if name == "cosine_parabola":
        return _shown(script, worth + number(-1) + angle * angle * number(Fraction(1, 2)), ">=",
                      f"({call} - 1 + {text} * {text} * (1 / 2))", equation, "apply cosine_parabola.")
    other, change, sine = _call(script, "sin", angle)
    return _shown(script, sine * sine + worth * worth + number(-1), "==",
                  f"({other} * {other} + {call} * {call} - 1)", f"{change}, ?{equation}", "apply circle.")


# The checker's facts of a = arctan x as the library's lemmas have them; c and s are the cosine and the sine of a, q is
# arctan 1.
OF_ARCTAN = {"arctan_sine": "{s} - {x} * {c}", "arctan_cosine": "{c}", "arctan_limit": "2 * {q} - {a}",
             "arctan_tangent": "{x} - {a}", "arctan_sector": "{a} * ({x} - {a})",
             "arctan_slope": "{x} * ({a} * (1 + {x} * {x}) - {x})"}


def _arctan(script: Script, name: str, argument: Ratio) -> Factor:
    """A fact of arctan, and of the sine and cosine of that angle."""
    say, sign, wanted = ARCTAN[name]
    text, changes = OF_ARCTAN[name], list[str]()
    angle, equation, worth = _call(script, "arctan", argument)
    written = {"x": script.normal.ratio(argument), "a": angle}
    for letter, kind, of in (("s", "sin", worth), ("c", "cos", worth), ("q", "arctan", number(1))):
        if f"{{{letter}}}" in text:
            called, change, _ = _call(script, kind, of)
            changes.append(change)
            written[letter] = called if letter == "q" else f"({kind} {angle})"
    proof = f"exact {script.positive(argument, wanted)}." if wanted else ""
    return _shown(script, say(script.context, argument, worth), sign, f"({text.format(**written)})",
                  ", ?".join([equation, *changes]), f"apply {name}. {proof}")


def _call(script: Script, kind: str, argument: Ratio) -> tuple[str, str, Ratio]:
    """A function of a value as Coq text, the equation of what it is worth, and that."""
    if SUM in atoms_of(argument):
        raise NotExportedError(f"{kind} of a sum")
    script.prepare_all(argument)
    text = script.normal.ratio(argument)
    call = f"({FUNCTIONS[kind]} {text})"
    return call, script.function(kind, call, text, argument), script.context.call(kind, argument)


def _addition(script: Script, name: str, a: Ratio, b: Ratio) -> Factor:
    """What is 0 by the addition theorem of a function."""
    whole = a * b if name == "log_product" else a + b
    kinds = {"log_product": ("log",), "exp_sum": ("exp",)}.get(name, ("sin", "cos"))
    parts = {(kind, place): _call(script, kind, value) for kind in kinds for place, value in (("a", a), ("b", b))}
    main = "cos" if name == "cosine_sum" else kinds[0]
    call, equation, worth = _call(script, main, whole)
    joined = {"log_product": "{0} - {log_a} - {log_b}", "exp_sum": "{0} - {exp_a} * {exp_b}",
              "sine_sum": "{0} - {sin_a} * {cos_b} - {cos_a} * {sin_b}",
              "cosine_sum": "{0} - {cos_a} * {cos_b} + {sin_a} * {sin_b}"}[name]
    bare = joined.format(call, **{f"{kind}_{place}": text for (kind, place), (text, _, _) in parts.items()})
    one, two = ({kind: parts[kind, place][2] for kind in kinds} for place in "ab")
    match name:
        case "log_product":
            value = worth + -one["log"] + -two["log"]
        case "exp_sum":
            value = worth + -(one["exp"] * two["exp"])
        case "sine_sum":
            value = worth + -(one["sin"] * two["cos"]) + -(one["cos"] * two["sin"])
        case _:
            value = worth + -(one["cos"] * two["cos"]) + one["sin"] * two["sin"]
    signs = f"exact {script.positive(a)}. exact {script.positive(b)}. " if name == "log_product" else ""
    changes = ", ?".join([equation, *(change for _, change, _ in parts.values())])
    return _shown(script, value, "==", f"({bare})", changes, f"apply {name}. {signs}same.")


def _shown(script: Script, value: Ratio, sign: str, bare: str, equations: str, lemma: str) -> Factor:
    """A factor whose sign a lemma says of it as it is written, `bare`."""
    script.prepare_all(value)
    text = script.normal.value(value)
    relation = {">": "0 < {}", ">=": "0 <= {}", "==": "{} = 0"}[sign]
    proof = script.show("F", relation.format(text),
                        f"replace {text} with {bare} by (rewrite ?{equations}; same). {lemma}")
    return Factor(text, sign, proof, value)

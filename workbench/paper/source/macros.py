"""An author's own commands put in, so that what follows reads plain LaTeX."""

from __future__ import annotations

import re
from dataclasses import dataclass

from workbench.proof.latex.commands import ACCENTS

MOST_EXPANSIONS = 100_000
LONGEST_SOURCE = 10_000_000

_COMMENT = re.compile(r"(?<!\\)((?:\\\\)*)%.*")
_CONDITION = re.compile(r"\\(?:if(?!f(?![A-Za-z]))[A-Za-z@]*|else|fi)(?![A-Za-z])")
_DEFINED = re.compile(r"\\(?:(?:re)?new|provide)command\*?|\\DeclareMathOperator\*?|"
                      r"\\DeclarePairedDelimiter(?![A-Za-z])|\\(?:re)?newenvironment\*?|\\(?:def|let)(?![A-Za-z])")
_COMMAND = re.compile(r"\\(?:[A-Za-z@]+|.)", re.DOTALL)
_COUNT = re.compile(r"\s*\[(\d)\]")
_NESTING = re.compile(r"\\(?:begin|end)\s*\{(?!document\})[^{}]*\}|\\.|[{}]", re.DOTALL)
_ACCENTED = "|".join(sorted((*ACCENTS, "sqrt")))
_BRACED = r"\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\}"
_TAKES_ONE = re.compile(rf"\\(?:{_ACCENTED}|[tdc]?frac\s*(?:{_BRACED}|\\[A-Za-z]+|[^\\{{}}\s])?)\s*\Z")
_PARAMETER = re.compile(r"#(\d)")


class SourceError(ValueError):
    """LaTeX that cannot be read, in one line."""


@dataclass(frozen=True)
class Macro:
    """A command of the author's: how many arguments it takes, the first one's default, and what it stands for.

    sized: whether a star or a size in square brackets, which only change its look, may stand before its argument.
    """

    count: int
    default: str | None
    body: str
    sized: bool = False


def without_comments(text: str) -> str:
    """The source without what stands behind a percent sign."""
    return _COMMENT.sub(r"\1", text)


def decided(text: str) -> str:
    r"""The source without what `\\iffalse` leaves out, or stands behind the `\\else` of `\\iftrue`."""
    out: list[str] = []
    kept: list[bool] = []  # of each condition that is open, whether its text counts
    at, deeper = 0, 0  # how many other conditions are open within
    for found in _CONDITION.finditer(text):
        sign = found.group()
        if all(kept):
            out.append(text[at:found.start()])
        at = found.end()
        if sign in (r"\iffalse", r"\iftrue") and not deeper:
            kept.append(sign == r"\iftrue")
        elif kept and not deeper and sign in (r"\else", r"\fi"):
            kept[-1:] = [not kept[-1]] if sign == r"\else" else []
        else:
            deeper += (sign.startswith(r"\if") and bool(kept)) - (sign == r"\fi" and deeper > 0)
            if all(kept):
                out.append(sign)
    if kept:
        raise SourceError(r"an \iffalse or \iftrue has no \fi: write it")
    return "".join((*out, text[at:]))


def expanded(text: str) -> str:
    r"""The source with \\newcommand, \\def and \\DeclareMathOperator taken out and what they define put in.

    Raises SourceError for a definition without braces, and for commands that never end.
    """
    macros: dict[str, Macro] = {}
    environments: dict[str, tuple[str, str]] = {}
    plain: list[str] = []
    done: list[str] = []
    at = depth = 0

    def put() -> str:
        whole = "".join(plain)
        for name, (first, last) in environments.items():
            whole = whole.replace(rf"\begin{{{name}}}", first).replace(rf"\end{{{name}}}", last)
        return _put(whole, macros)

    for found in _DEFINED.finditer(text):
        if found.start() < at:  # within a definition
            continue
        plain.append(text[at:found.start()])
        depth += _deeper(plain[-1])
        if "environment" in found.group():
            name, begun = group(text, found.end())
            if _COUNT.match(text, begun) is None:  # one with arguments stays as it is
                first, begun = group(text, begun)
                last, at = group(text, begun)
                environments[name.strip()] = (first, last)
                continue
            plain.append(found.group())
            at = found.end()
            continue
        name, macro, at = _definition(text, found)
        if name not in macros:
            macros[name] = macro
        elif "provide" not in found.group() and macros[name] != macro:
            if depth > 0:
                raise SourceError(f"line {text.count(chr(10), 0, found.start()) + 1}: {name} is defined anew within "
                                  "braces or an environment: give it one meaning")
            done.append(put())  # so far it means what it did
            plain.clear()
            macros[name] = macro
    plain.append(text[at:])
    return "".join((*done, put()))


def _deeper(text: str) -> int:
    """By how much more braces and environments are open behind a text than before it."""
    signs = [found.group() for found in _NESTING.finditer(text)]
    return sum(sign == "{" or sign.startswith(r"\begin") for sign in signs) - sum(
        sign == "}" or sign.startswith(r"\end") for sign in signs)


def group(text: str, at: int) -> tuple[str, int]:
    """What stands in the braces that open at a place, or the single piece there, and where it ends."""
    while at < len(text) and text[at].isspace():
        at += 1
    if at >= len(text):
        raise SourceError("an argument is missing at the end of the source")
    if text[at] != "{":
        piece = _COMMAND.match(text, at)
        return (piece.group(), piece.end()) if piece else (text[at], at + 1)
    depth, end = 0, at
    while end < len(text):
        if text[end] == "\\":
            end += 2
            continue
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        end += 1
        if depth == 0:
            return text[at + 1:end - 1], end
    raise SourceError(f"line {text.count(chr(10), 0, at) + 1}: a brace '{{' is not closed")


def optional(text: str, at: int) -> tuple[str | None, int]:
    """What stands in square brackets at a place, None where there are none, and where it ends."""
    found = re.compile(r"\s*\[").match(text, at)
    if found is None:
        return None, at
    depth, end = 0, found.end()
    while end < len(text) and (depth or text[end] != "]"):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        end += 1
    return text[found.end():end], end + 1


def _definition(text: str, found: re.Match[str]) -> tuple[str, Macro, int]:
    name, at = group(text, found.end())
    if found.group().startswith("\\def"):
        body_at = text.find("{", at)
        count = len(_PARAMETER.findall(text[at:body_at]))
        body, end = group(text, max(at, body_at))
        return name.strip(), Macro(count, None, body), end
    if found.group() == r"\let":
        sign = re.compile(r"\s*=?").match(text, at)
        meaning, end = group(text, sign.end() if sign else at)
        return name.strip(), Macro(0, None, meaning), end
    if "Delimiter" in found.group():
        opening, end = group(text, at)
        closing, end = group(text, end)
        return name.strip(), Macro(1, None, f"{opening} #1{closing}", sized=True), end
    if "Operator" in found.group():
        body, end = group(text, at)
        return name.strip(), Macro(0, None, rf"\operatorname{{{body}}}"), end
    counted = _COUNT.match(text, at)
    count, at = (int(counted[1]), counted.end()) if counted else (0, at)
    default, at = optional(text, at) if count else (None, at)
    body, end = group(text, at)
    return name.strip(), Macro(count, default, body), end


def _put(text: str, macros: dict[str, Macro]) -> str:
    """Every command of the author's replaced, what stands in its place read again."""
    out: list[str] = []
    at = expansions = 0
    while found := _COMMAND.search(text, at):
        out.append(text[at:found.start()])
        macro = macros.get(found.group())
        if macro is None:
            out.append(found.group())
            at = found.end()
            continue
        expansions += 1
        if expansions > MOST_EXPANSIONS or len(text) > LONGEST_SOURCE:
            raise SourceError(f"the command {found.group()} stands for itself, or for too much: define it otherwise")
        body, end = _applied(text, found.end(), macro)
        rest = text[end:]
        if len(body.strip()) > 1 and _COMMAND.fullmatch(body.strip()) is None and _TAKES_ONE.search(
                "".join(out[-8:])[-200:]):
            body = f"{{{body}}}"  # of \sqrt\al, \al is the argument, whatever it stands for
        # A command's name ends where no letter follows: \al x, with \al for \alpha, is not \alphax.
        apart = " " if re.search(r"\\[A-Za-z]+$", body) and rest[:1].isalpha() else ""
        text, at = body + apart + rest, 0
    return "".join((*out, text[at:]))


def _applied(text: str, at: int, macro: Macro) -> tuple[str, int]:
    values: list[str] = []
    if macro.sized:
        at = optional(text, at + text[at:].startswith("*"))[1]
    if macro.default is not None:
        first, at = optional(text, at)
        values.append(macro.default if first is None else first)
    while len(values) < macro.count:
        value, at = group(text, at)
        values.append(value)

    def value_of(found: re.Match[str]) -> str:
        number = int(found[1])
        return values[number - 1] if 0 < number <= len(values) else found.group()

    return _PARAMETER.sub(value_of, macro.body), at

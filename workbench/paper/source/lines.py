"""Which lines of a displayed formula are one."""

from __future__ import annotations

import re
from collections.abc import Iterator

from workbench.paper.source.vocabulary import CONNECTIVES

_SIGN = r"(?:[=<>+\-/]|\\(?:leq?|geq?|leqslant|geqslant|cdot|times|in|pm|quad|qquad|Rightarrow|implies)(?![A-Za-z]))"
_AT_START, _AT_END = re.compile(_SIGN), re.compile(rf"{_SIGN}$")
_RELATION = re.compile(r"(?:[=<>]|\\(?:leq?|geq?|leqslant|geqslant|lt|gt|equiv|triangleq)(?![A-Za-z]))")
ENDS_WITH_RELATION = re.compile(rf"{_RELATION.pattern}\s*\Z")
_STEP = re.compile(rf"{_RELATION.pattern}|\\[A-Za-z]+|\\.|[(){{}}\[\],;]|.", re.DOTALL)
_SYSTEM = re.compile(
    r"(?:(?:\\left)?\s*(?:\\\{|\\lbrace)\s*\\begin\s*\{(?P<name>array|aligned|split|matrix|gathered)\}|"
    r"\\begin\s*\{(?P<cases>cases)\})(?:\s*\[[a-z]\])?(?:\s*\{[lcr@{}\s]*\})?(?P<lines>.*?)"
    r"\\end\s*\{(?:(?P=name)|(?P=cases))\}\s*(?:\\right\s*\.)?\s*", re.DOTALL)
DISPLAYS = ("equation", "align", "gather", "multline", "eqnarray", "flalign", "alignat", "IEEEeqnarray", "dmath",
            "displaymath")
LABEL = re.compile(r"\\label\s*\{([^{}]*)\}")
TAG = re.compile(r"\\(?:tag\*?\s*\{|l?eqno(?![A-Za-z])\s*\{?\(?)([^{}()\\]*)[)}]*")
_REFERENCE = re.compile(r"\\(?:eqref|[cC]ref|autoref|ref)\s*\{([^{}]*)\}")
WITHOUT_NUMBER = re.compile(r"\\(?:nonumber|notag|IEEEnonumber)(?![A-Za-z])")
_LAYOUT = re.compile(r"\\(?:IEEEyesnumber|IEEEeqnarraynumspace|displaybreak)(?![A-Za-z])\*?|"
                     rf"\\(?:short)?intertext\s*\{{\s*(?:(?:{'|'.join(sorted(CONNECTIVES))})[\s,]*)+\}}", re.IGNORECASE)
_SPLIT = re.compile(r"\\\\(?:\s*\[[^\]]*\])?")
_INNER = re.compile(r"\\begin\s*\{(\w+)\*?\}.*?\\end\s*\{\1\*?\}", re.DOTALL)
_NESTED = re.compile(r"\\(begin|end)\s*\{[^{}]*\}|[{}]|\\.", re.DOTALL)
COLUMN = "\0"  # stands for the & between two columns
_MARKS = rf" ?(?:{COLUMN} ?)+"
_JOINED = re.compile(rf"\A{_MARKS}|{_MARKS}\Z|(?<=[=<>+\-]){_MARKS}|(?<=\\(?:le|ge|in)){_MARKS}|"
                     rf"(?<=\\(?:leq|geq)){_MARKS}|{_MARKS}(?={_RELATION.pattern}|\\in(?![A-Za-z]))")
_PARTED = re.compile(_MARKS)
_BREAK = re.compile(r"\\\\(?:\s*\[[^\]]*\])?")


def system_lines(printed: str) -> list[str]:
    """The lines of a system of equations behind one brace, each a relation; none of another formula."""
    found = _SYSTEM.fullmatch(printed)
    lines = [without_columns(line.replace("&", COLUMN)) for line in _BREAK.split(found["lines"])] if found else []
    return [without_end(line) for line in lines if line] if all(map(_RELATION.search, filter(None, lines))) else []


def without_columns(line: str) -> str:
    r"""A line with its columns in one: those that no sign joins are parted by a wide space, and so are no product."""
    line = _JOINED.sub(" ", " ".join(line.split()))
    return " ".join(_PARTED.sub(r" \\quad ", line).split())


def without_end(line: str) -> str:
    r"""A line without the full stop or comma that ends its sentence; the dot of `\\right.` stays."""
    return re.sub(r"(?<!\\right)[ .,;]+\Z", "", line)


def goes_on(first: str, second: str) -> bool:
    """Whether a line goes on in the next one: by a sign at its end or at the start of that, or by an open bracket."""
    return bool(_AT_START.match(second) or _AT_END.search(first)) or any(
        first.count(one) > first.count(other) for one, other in ("()", "[]", "{}"))


def continues(line: str) -> bool:
    """Whether a line begins with a relation sign."""
    return _RELATION.match(line) is not None


def chained(first: str, second: str) -> str:
    """A numbered line that begins with a relation sign, as what it says: from the last side of the line before it on.

    Empty where it begins with none, or the line before it is no single chain.
    """
    if not continues(second):
        return ""
    depth, start = 0, None
    for found in _STEP.finditer(first):
        sign = found.group()
        depth += (sign in ("(", "[", "{", r"\{")) - (sign in (")", "]", "}", r"\}"))
        if depth == 0 and _RELATION.fullmatch(sign):
            start = found.end()
        elif depth == 0 and sign in (",", ";", r"\quad", r"\qquad", r"\text", r"\Rightarrow", r"\implies"):
            return ""
    return "" if start is None else f"{first[start:].strip()} {second}"


def lines_of(text: str) -> Iterator[str]:
    r"""The lines that \\\\ parts, but not those within braces or an inner environment."""
    depth = start = at = 0
    while at < len(text):
        split = _SPLIT.match(text, at)
        if split and depth == 0:
            yield text[start:at]
            start = at = split.end()
            continue
        found = _NESTED.match(text, at)
        if found is None:
            at += 1
            continue
        depth += 1 if found.group() == "{" or found[1] == "begin" else -1 if found.group() == "}" or found[1] else 0
        at = found.end()
    yield text[start:]


def cleaned(line: str) -> str:
    """A line without what numbers and aligns it; what stands in an inner environment stays as it is."""
    for pattern in (LABEL, TAG, WITHOUT_NUMBER, _LAYOUT):
        line = pattern.sub("", line)
    inner = [found.span() for found in _INNER.finditer(line)]
    kept = "".join(sign if sign != "&" or line[at - 1:at] == "\\" or any(start <= at < end for start, end in inner)
                   else COLUMN for at, sign in enumerate(line))
    return without_end(without_columns(kept))


def without_marks(text: str) -> str:
    """A display without its labels and numbers, for how its sentence goes on."""
    return re.sub(r"\\(?:nonumber|notag|IEEEnonumber)(?![A-Za-z])", "", TAG.sub("", LABEL.sub("", text)))


def references(text: str) -> list[str]:
    """The labels that a text refers to, in order."""
    return [label.strip() for labels in _REFERENCE.findall(text) for label in labels.split(",")]


def without_displays(text: str) -> str:
    """A text without its displayed formulas."""
    names = "|".join((*DISPLAYS, "subequations"))
    return re.sub(rf"\\begin\s*\{{({names})\*?\}}.*?\\end\s*\{{\1\*?\}}", "", text, flags=re.DOTALL)

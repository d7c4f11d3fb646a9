"""Which lines of a displayed formula are one."""

from __future__ import annotations

import re

_SIGN = r"(?:[=<>+\-/]|\\(?:leq?|geq?|leqslant|geqslant|cdot|times|in|pm|quad|qquad|Rightarrow|implies)(?![A-Za-z]))"
_AT_START, _AT_END = re.compile(_SIGN), re.compile(rf"{_SIGN}$")
_RELATION = re.compile(r"(?:[=<>]|\\(?:leq?|geq?|leqslant|geqslant|lt|gt|equiv|triangleq)(?![A-Za-z]))")
ENDS_WITH_RELATION = re.compile(rf"{_RELATION.pattern}\s*\Z")
_STEP = re.compile(rf"{_RELATION.pattern}|\\[A-Za-z]+|\\.|[(){{}}\[\],;]|.", re.DOTALL)
_SYSTEM = re.compile(
    r"(?:(?:\\left)?\s*(?:\\\{|\\lbrace)\s*\\begin\s*\{(?P<name>array|aligned|split|matrix|gathered)\}|"
    r"\\begin\s*\{(?P<cases>cases)\})(?:\s*\[[a-z]\])?(?:\s*\{[lcr@{}\s]*\})?(?P<lines>.*?)"
    r"\\end\s*\{(?:(?P=name)|(?P=cases))\}\s*(?:\\right\s*\.)?\s*", re.DOTALL)
COLUMN = "\0"  # stands for the & between two columns
_MARKS = rf" ?(?:{COLUMN} ?)+"
_JOINED = re.compile(rf"\A{_MARKS}|{_MARKS}\Z|(?<=[=<>+\-]){_MARKS}|(?<=\\(?:le|ge|in)){_MARKS}|(?<=\\(?:leq|geq)){_MARKS}"
                     rf"|{_MARKS}(?={_RELATION.pattern}|\\in(?![A-Za-z]))")
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


_SPOKEN = r"(?:[^.;$]|\$[^$]*\$)*?"
_RELATED = (r"\$[^$]*(?:[=<>]|\\(?:leq?|geq?|leqslant|geqslant|ne|neq|in)(?![A-Za-z])"
            r"(?!\s*\\mathbb\s*\{R\}(?:\^[^$\s]*)?\s*\$))[^$]*\$")
_SIGN_ONLY = r"\$[^$<>=]*(?:>|\\geq?(?![A-Za-z]))\s*0\s*\$"
FOR = re.compile(rf"\b(?:for|on)\s+(?:(?:all|every|any|each|some)\s*)?{_RELATED}", re.IGNORECASE | re.DOTALL)
_TIED = (r"(?:\b(?:if|when|whenever|while|until|unless|suppose|assume|otherwise|provided|as\s+long\s+as)\b"
         rf"{_SPOKEN}{_RELATED}|{FOR.pattern})")
_BEFORE, _BEHIND = re.compile(_TIED, re.IGNORECASE | re.DOTALL), re.compile(rf"[\s,]*{_TIED}", re.DOTALL)
_NOT_CLAIMED = re.compile(r"\b(?:should\s+(?:read|be)|instead|incorrect\w*|wrong\w*|erroneous\w*|misprint\w*|not\s+true"
                          r"|not\s+hold|fails?\s+to\s+hold|contrary)\b", re.IGNORECASE)
_WANTED = re.compile(r"\b(?:goals?|aims?|objectives?|wish|want|false|never|cannot|impossible|contradict\w*)\b", re.IGNORECASE)
_SIZE = r"(?:small|large|positive|negative|non-?negative|non-?zero)"
_SUPPOSED = re.compile(
    r"\b(?:if|when|whenever|while|until|unless|provided|suppos\w+|assum(?:e|es|ed|ing)|require[sd]?|must|should|there\s+"
    r"(?:is|are|exists?)|exists?|choose|select|pick|such\s+that|so\s+that|near|neighbou?rhood|vicinity|locally|sufficiently|"
    rf"enough|not|only|let\b[^.]*\b(?:satisfy|obey|fulfil|meet)|for\s+(?:all\s+|any\s+)?{_SIZE}\s+\$)\b"
    rf"|\bfor\s+(?:all\s+|any\s+)?{_SIZE}\s+\$|\A[^$]*\blet\s*\Z"
    rf"|\b(?:since|as|because(?:\s+of)?|(?:set|region|domain|interval|case|condition)s?(?:\s+(?:that|where))?)\s*{_RELATED}"
    rf"|\b(?:letting|setting|choosing|taking|putting|with|at|using)\s+(?!{_SIGN_ONLY}){_RELATED}", re.IGNORECASE | re.DOTALL)
_SUPPOSED_BEHIND = re.compile(
    rf"[\s,]*\b(?:(?:since|as|because(?:\s+of)?|provided(?:\s+that)?|whenever|if|when)\s*{_RELATED}"
    rf"|with\s+(?!{_SIGN_ONLY}){_RELATED}|where\s+(?!{_SIGN_ONLY}|\$[^$<>]*=){_RELATED})", re.IGNORECASE | re.DOTALL)
_HYPOTHESIS = re.compile(r"\b(?:suppos|assum|let|given)(?!\w*\s*~?\\)\w*\b(?!.*\b(?:then|we\s+have|holds?|be|denotes?)\b).*\Z",
                         re.IGNORECASE | re.DOTALL)
_NAME = re.compile(r"\A\s*\{[^{}]*\}")
_LET = re.compile(rf"\b(?:let|suppose|assume|if|given|with|where|for|case)\b{_SPOKEN}{_RELATED}", re.IGNORECASE | re.DOTALL)
_GOES_ON = re.compile(r"\s*(?:Then|In\s+(?:this|that)\s+case)\b")
PARAGRAPH = re.compile(r"\n\s*\n|\\(?:sub)*section|\\(?:begin|end)\s*\{(?!(?:aligned|split|cases|array)\b)")
_SENTENCE = re.compile(r"(?<=[.!?])\s|\\(?:begin|end|item|section|\[|\])|\n\s*\n|\$\$")
_ENDED = re.compile(r"[.!?](?=\s|\Z)")
_LABELS = re.compile(r"\\(?:label|[A-Za-z]*ref)\s*\{[^{}]*\}")
_OF_TIME = re.compile(r"\bfor\s+(?:all|every|any|each)\s*(?:times?\b|\$\s*t\s*(?:(?:\\geq?|\\geqslant|>)\s*0\s*)?\$)|"
                      r"\$\s*\\forall\s*t[^$]*\$", re.IGNORECASE)
REACH = 600  # letters before and behind a display that its sentence is looked for in


def on_condition_around(before: str, display: str, behind: str) -> bool:
    """Whether the sentence in which a display stands ties it to a relation: `if $x = 0$, then`, or behind it `for
    $x > 0$`, or does not claim it: `(3) should read`. Without that it would be decided for more than it says."""
    before, behind = (_LABELS.sub("", text) for text in (before[-REACH:], behind[:REACH]))
    *_, earlier, last = "", *_SENTENCE.split(before)
    sentence = _OF_TIME.sub(" ", f"{earlier} {last}" if _GOES_ON.match(last) else last)
    if _BEFORE.search(sentence) or _NOT_CLAIMED.search(sentence) or _WANTED.search(sentence):
        return True
    rest = _rest(display, behind)
    return (_BEHIND.match(rest) or _NOT_CLAIMED.search(rest) or _WANTED.search(rest)) is not None


def supposed_around(before: str, display: str, behind: str) -> bool:
    """Whether the sentence in which a display stands may suppose what it says, or say it of some values alone: `suppose
    that`, `there is`, `near the origin`. A definition or a rate may be given so, but nothing is claimed."""
    before, behind = (_LABELS.sub("", text) for text in (before[-REACH:], behind[:REACH]))
    sentence = _OF_TIME.sub(" ", _last(before))
    return (_SUPPOSED.search(sentence) or _SUPPOSED_BEHIND.match(_rest(display, behind))) is not None


def introduces_hypothesis(before: str) -> bool:
    """Whether a display is itself what a sentence supposes, for what follows it."""
    return _HYPOTHESIS.search(_last(before[-REACH:])) is not None


def _last(before: str) -> str:
    """The sentence that has begun before a place, without the name of the environment that ended before it."""
    return _NAME.sub("", _SENTENCE.split(before)[-1])


def lets(text: str) -> bool:
    """Whether the text of a theorem or proof supposes a relation, which holds for what follows in it."""
    return _LET.search(_OF_TIME.sub(" ", _LABELS.sub("", text))) is not None


def _rest(display: str, behind: str) -> str:
    """What follows a display in its sentence."""
    ended = re.search(r"\.[\s\\,]*\Z", display) is not None
    return "" if ended else _OF_TIME.sub(" ", _SENTENCE.split(_ENDED.split(behind)[0])[0])

"""What the sentence around a displayed formula says of it: a condition, a supposition, a wish, that it is false."""

from __future__ import annotations

import re

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
_WANTED = re.compile(r"\b(?:goals?|aims?|objectives?|wish|want|false|never|cannot|impossible|contradict\w*)\b",
                     re.IGNORECASE)
_SIZE = r"(?:small|large|positive|negative|non-?negative|non-?zero)"
# What no sentence says of all values, whether it claims a formula or gives a letter a value by it.
_SOMEWHERE = re.compile(
    r"\$[^$<>=]*=\s*-?[\d.]+\s*\$|\b(?:when|whenever|unless|until|while)\b"
    r"|\bif\b(?!.*\b(?:choose|chosen|choosing|select\w*|law|control\w*|input|design\w*)\b)"
    rf"|\b(?:on|in|at|inside|outside|within)\s+(?:the|this|that|a|an)\s+(?:[\w-]+\s+){{0,3}}{_RELATED}",
    re.IGNORECASE | re.DOTALL)
_SUPPOSED = re.compile(
    r"\b(?:if|when|whenever|while|until|unless|provided|suppos\w+|assum(?:e|es|ed|ing)|require[sd]?|must|should|there\s+"
    r"(?:is|are|exists?)|exists?|choose|select|pick|such\s+that|near|neighbou?rhood|vicinity|locally|sufficiently|"
    rf"enough|not|only|let\b[^.]*\b(?:satisfy|obey|fulfil|meet)|for\s+(?:all\s+|any\s+)?{_SIZE}\s+\$)\b"
    rf"|\bfor\s+(?:all\s+|any\s+)?{_SIZE}\s+\$|\A[^$]*\blet\s*\Z"
    rf"|\b(?:since|as|because(?:\s+of)?|(?:set|region|domain|interval|case|condition)s?(?:\s+(?:that|where))?)\s*"
    rf"{_RELATED}|\b(?:letting|setting|choosing|taking|putting|with|at|using)\s+(?!{_SIGN_ONLY}){_RELATED}",
    re.IGNORECASE | re.DOTALL)
_SUPPOSED_BEHIND = re.compile(
    rf"[\s,]*\b(?:(?:since|as|because(?:\s+of)?|provided(?:\s+that)?|whenever|if|when)\s*{_RELATED}"
    rf"|with\s+(?!{_SIGN_ONLY}){_RELATED}|where\s+(?!{_SIGN_ONLY}|\$[^$<>]*=){_RELATED})", re.IGNORECASE | re.DOTALL)
_HYPOTHESIS = re.compile(r"\b(?:suppos|assum|let|given|if|provided|choice)(?!\w*\s*~?\\)\w*\b"
                         r"(?!.*\b(?:then|we\s+have|holds?|be|denotes?)\b).*\Z", re.IGNORECASE | re.DOTALL)
_NAME = re.compile(r"\A\s*\{[^{}]*\}")
_LET = re.compile(rf"\b(?:let|suppose|assume|if|given|with|where|for|case)\b{_SPOKEN}{_RELATED}",
                  re.IGNORECASE | re.DOTALL)
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
    if any(pattern.search(sentence) for pattern in (_BEFORE, _NOT_CLAIMED, _WANTED)) or _SOMEWHERE.search(
            _OF_TIME.sub(" ", _last(before))):
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

"""LaTeX formulas as MathML, which browsers draw without any script or font from elsewhere."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from functools import cache
from itertools import groupby
from xml.etree import ElementTree

from markupsafe import Markup, escape

from workbench.report.typography import set_words
from workbench.report.worded import show, worded

# What a formula may consist of: a claim file is a stranger's, and \href, \style and \text can carry anything.
ELEMENTS = frozenset((
    "math", "mrow", "mi", "mo", "mn", "mtext", "mspace", "mfrac", "msqrt", "mroot", "msub", "msup", "msubsup",
    "munder", "mover", "munderover", "mtable", "mtr", "mtd", "mstyle", "mpadded", "mphantom", "menclose",
))
ATTRIBUTES = frozenset((
    "accent", "accentunder", "columnalign", "columnspacing", "display", "displaystyle", "fence", "form",
    "largeop", "linethickness", "lspace", "mathvariant", "maxsize", "minsize", "movablelimits", "notation",
    "rowspacing", "rspace", "scriptlevel", "separator", "stretchy", "symmetric", "width",
))
ACCENTS = frozenset("˙¨^~¯ˇ´`→˘")
BREAKS = frozenset("=≤≥<>+−⟹⇒⇔⟺∧∨∈")
ENDS = frozenset(",;")  # behind which a line may break
LONG = 40
WORD = 4  # letters of a text from which on it is a word
BRACKETED = 3  # pieces of a row from which on it may be a bracket with something in it
# Converting takes time in proportion to the square of the length: beyond this, seconds of what nobody reads.
MOST_CHARACTERS = 20_000
OPERATORS = frozenset("⟹⟸⟺⟶⟵⟷⇒⇐⇔→←↔↦:")
LIMITS = frozenset(("lim", "max", "min", "sup", "inf", "lim sup", "lim inf", "∑", "∏"))
_SENTENCE = re.compile(r"[A-Za-z]{2,} [a-z]+ [a-z]+ ")
_PHRASE = re.compile(r"(?<![\\\w])(?:[A-Za-z]{2,}[ -]){3,}[A-Za-z]{2,}")
# The last formula before a mark of punctuation, and the mark.
_BEFORE_MARK = re.compile(r"(<math\b(?:(?!<math\b).)*</math>[.,;:)”]+)", re.DOTALL)
# Two primes behind an index, which the converter raises above each other.
_TWICE_DERIVED = re.compile(r"(_(?:\{[^{}]*\}|\w))''(?!')")
UNDER = {"msub": "munder", "msup": "mover", "msubsup": "munderover"}


def formula(latex: str) -> Markup:
    """A LaTeX formula as inline MathML with display-style fractions; outer dollar signs are taken off.

    Whatever cannot be converted comes back as the escaped LaTeX in a `code` element; this never raises.
    """
    return _convert(latex.strip().strip("$").strip())


def in_html(text: str) -> Markup:
    """A text whose formulas stand between dollar signs as HTML; no line breaks between a formula and the punctuation
    behind it."""
    found = show(text, formula, lambda words: str(set_words(words)))
    return Markup(_BEFORE_MARK.sub(r'<span class="unbroken">\1</span>', found))


def formula_tree(latex: str) -> ElementTree.Element | None:
    """The MathML of a formula as a tree, of which nothing but harmless elements is left; None where it cannot be
    converted, or is longer than MOST_CHARACTERS."""
    from latex2mathml.converter import convert_to_element  # noqa: PLC0415 - most of what is told has no formula

    if len(latex) > MOST_CHARACTERS:
        return None
    try:
        root = convert_to_element(_words_apart(_as_text(latex.strip().strip("$").strip())))
        for element in root.iter():
            _clean(element)
    except Exception:  # the converter raises many kinds on input it does not know, some of them its own bugs
        return None
    return root


@cache
def _convert(latex: str) -> Markup:
    try:
        root = formula_tree(latex)
        if root is None:
            raise ValueError(latex)
        return Markup("").join(escape(piece) if isinstance(piece, str) else _serialise(piece)
                               for piece in _flowing(root))
    except Exception:  # the converter raises many kinds on input it does not know, some of them its own bugs
        return Markup("<code>{}</code>").format(escape(latex)) if latex else Markup("")


def _as_text(latex: str) -> str:
    """A sentence that was printed without a mark that it is text, marked, the letters in it as formulas."""
    if r"\text" in latex:
        return latex
    if not _SENTENCE.match(latex):
        return _PHRASE.sub(r"\\text{ \g<0> }", latex)
    return rf"\text{{{latex if '$' in latex else worded(latex)}}}"


def _words_apart(latex: str) -> str:
    r"""`\text{a $x$ b}` as `\text{a }x\text{ b}`, and braces and signs as the converter knows them."""
    def parts(found: re.Match[str]) -> str:
        pieces = found[1].replace(r"\%", "%").split("$")
        return "".join((f"{{}}{piece}" if piece[0] in "^_" else piece) if i % 2 else rf"\text{{{piece}}}"
                       for i, piece in enumerate(pieces) if piece)

    latex = _TWICE_DERIVED.sub(r"\1^{″}", latex)
    apart = re.sub(r"\\text\{((?:[^{}$]|\$[^$]*\$)*)\}", parts, latex)
    return apart.replace(r"\left\{", r"\{").replace(r"\right\}", r"\}").replace(r"\arg \min", r"\mathrm{arg}\min")


def _serialise(root: ElementTree.Element) -> Markup:
    root.set("displaystyle", "true")
    return Markup(ElementTree.tostring(root, encoding="unicode"))


def _flowing(root: ElementTree.Element) -> list[ElementTree.Element | str]:
    """The formula in pieces between which lines may break: its sentences as words, what lies between as formulas."""
    top = root[0] if len(root) == 1 and root[0].tag == "mrow" else root
    pieces: list[ElementTree.Element | str] = []
    for is_sentence, group in groupby(top, lambda child: child.tag == "mtext" and len(child.text or "") > LONG):
        children = list(group)
        if is_sentence:
            pieces += [f" {' '.join((child.text or '').split())} " for child in children]
        elif len(children) == len(top):
            pieces += _parts(root)
        else:
            part = ElementTree.Element("math", root.attrib)
            ElementTree.SubElement(part, "mrow").extend(children)
            pieces += _parts(part)
    return pieces


def _parts(root: ElementTree.Element) -> list[ElementTree.Element]:
    """A long formula cut before its operators and behind its commas: browsers break lines only between formulas."""
    if len(root) != 1 or root[0].tag != "mrow" or sum(1 for _ in root.iter()) < LONG:
        return [root]
    rows: list[list[ElementTree.Element]] = [[]]
    for child in _opened(root[0]):
        # An operator after an operator is a sign, and a sign stays with what it belongs to.
        if child.tag == "mo" and child.text in BREAKS and rows[-1] and rows[-1][-1].tag != "mo":
            child.set("form", "infix")
            rows.append([])
        elif child.tag == "mtext" and rows[-1] and rows[-1][-1].tag != "mo" and _is_word(child.text or ""):
            rows.append([])
        rows[-1].append(child)
        if child.tag == "mo" and child.text in ENDS:
            rows.append([])
    parts = []
    for row in filter(None, rows):
        part = ElementTree.Element("math", root.attrib)
        ElementTree.SubElement(part, "mrow").extend(row)
        parts.append(part)
    return parts


def _is_word(text: str) -> bool:
    """Whether a text begins a line as well as it goes on with one: words, not the name of a function."""
    return text[:1].isspace() or len(text.strip()) >= WORD


def _opened(row: ElementTree.Element) -> Iterator[ElementTree.Element]:
    """The pieces of a row, long brackets in it opened: a line may break within them too."""
    for child in row:
        inside = child[0] if child.tag == "msup" and len(child) == 2 else child
        if inside.tag != "mrow" or len(inside) < BRACKETED or sum(1 for _ in inside.iter()) < LONG:
            yield child
            continue
        *within, last = _opened(inside)
        yield from within
        if inside is not child:  # the power stands at the closing bracket
            child[0] = last
            last = child
        yield last


def _clean(element: ElementTree.Element) -> None:
    """Keep what is known to be harmless; raises ValueError for what the converter did not understand."""
    if element.tag not in ELEMENTS:
        raise ValueError(f"unknown element {element.tag}")
    for name in element.attrib.keys() - ATTRIBUTES:
        del element.attrib[name]
    # The converter leaves symbols as character references and text as it was: both become plain characters.
    element.text = html.unescape(element.text or "")
    if "\\" in element.text:
        raise ValueError(f"unknown command {element.text}")
    if element.tag == "mo" and element.text == "|" and "fence" not in element.attrib:
        element.set("lspace", "0")  # bars stand close to what is between them
        element.set("rspace", "0")
    if element.tag == "mi" and element.text in OPERATORS:
        element.tag = "mo"  # an operator gets space around it
    if element.tag in UNDER and len(element) and html.unescape(element[0].text or "") in LIMITS:
        element.tag = UNDER[element.tag]
    elif element.tag == "mover" and len(element) == 2 and html.unescape(element[1].text or "") in ACCENTS:
        element.set("accent", "true")

"""Sentences that say of signs and marks themselves what they mean, as `all angles are in degrees`.

By these a formula says something else than is read of it, wherever they stand.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_RATE = re.compile(r"\\d+ot(?![A-Za-z])|\\frac\s*\{(?:\\mathrm\s*\{d\}|d)")
_ORDER = re.compile(r"[<>]|\\(?:l|g)(?:eq?|eqslant|t)(?![A-Za-z])")
_ANY = re.compile("")
_WHAT = _words("variables variable numbers scalars quantities letters states signals phasors entries plane")
# Words that must all occur, one of each set, and the formulas that then mean something else.
_CONVENTIONS = (
    ((_words("degrees degree revolutions revolution gradians turns"),
      _words("angles angle sine cosine sines cosines trigonometric measured arguments argument expressed")),
     re.compile(r"\\(?:sin|cos|tan|cot|arc)")),
    ((_words("superscript superscripts"),), re.compile(r"\^")),
    ((_words("upper raised"), _words("index indices")), re.compile(r"\^")),
    ((_words("subscript subscripts"),), re.compile("_")),
    ((_words("repeated"), _words("index indices")), re.compile("_")),
    ((_words("bar bars overbar overbars overline"),), re.compile(r"\\(?:bar|overline|[lr]?vert)(?![A-Za-z])|\|")),
    ((_words("hat hats caret carets"),), re.compile(r"\\(?:wide)?hat(?![A-Za-z])")),
    ((_words("tilde tildes"),), re.compile(r"\\(?:wide)?tilde(?![A-Za-z])")),
    ((_words("prime primes"),), re.compile(r"'|\\prime(?![A-Za-z])")),
    ((_words("dot dots overdot"),), _RATE),
    ((_words("time"), _words("backwards backward reversed rescaled scaled stretched normalized new reverse")), _RATE),
    ((_words("derivatives derivative"), _words("respect along"),
      _words("distance position path arc space travelled traveled length mileage angle index")), _RATE),
    ((_words("resets reset jumps jump impulse impulses impulsive wiener brownian itô ito stratonovich"),), _RATE),
    ((_words("bracket brackets"), _words("denote denotes mean means part floor integer rounding jump average")),
     re.compile(r"[\[(|]")),
    ((_words("logarithm logarithms"), _words("base decimal binary common ten two")), re.compile(r"\\l(?:n|og)")),
    ((_words("complex"), _WHAT), _ANY),
    ((_words("complex-valued quaternion-valued matrix-valued vector-valued"),), _ANY),
    ((_words("modulo mod congruent congruence"),), _ANY),
    ((_words("are is"), _words("matrices vectors quaternions operators"), _words("all variables letters symbols")),
     _ANY),
    ((_words("elementwise entrywise componentwise element-wise loewner"),), _ORDER),
    ((_words("inequalities inequality order ordering"), _words("understood interpreted meant sense")), _ORDER),
    ((_words("equalities equality equations relations identities"), _words("understood interpreted meant sense")),
     _ANY),
)
_DEGREES_OF = re.compile(r"\bdegrees? of\b|\brelative degree\b")
# Words by which a letter is said to be no number.
NO_NUMBER = _words("""
    complex complex-valued imaginary phasor phasors matrix matrices vector vectors quaternion quaternions operator
    operators tensor tensors array arrays tuple set-valued
""")
_COMPONENT = _words("component components entry entries element elements coordinate coordinates")
_SPACE = re.compile(r"\\in\s*\\math(?:bb|bf|cal|rm)\s*\{?\s*(?!R\}?\s*\Z|[RZNQ]\}?\s*(?:_|\Z|\^\s*\{?\+))[A-Z]")
_EVERY = _words("any every all each arbitrary")
_KINDS = _words("real reals number numbers scalar scalars value values")
_SIGNS = _words("positive nonnegative non-negative")
CALLS = _words("write writes call calls")
DENOTES = _words("denotes denote stands represents represent designates means")
_PARTS = _words("term terms part parts square squares sum difference product half alone only summand first second last")
_NO_RATES = _words("measured filtered estimated commanded desired sampled delayed approximate reference nominal")
_MANNERS = _words("convention conventions opposite reversed inverse")
# By these words what was printed before is taken back or changed, wherever that stands.
TAKES_BACK = _words("""
    wrong misprint misprints misprinted typo typos typographical erratum errata corrigendum correct corrected correction
    corrections incorrect mistake mistakes mistaken should sign signs minus plus instead replaced replace replaces
    redefine redefined redefines redefinition reversed reverses opposite flawed invalid false exchanged interchanged
    swapped negated
""")
# By a word of each kind what moves is said to be another, or moved by more.
_PLANTS = _words("""
    plant plants system systems subsystem model models dynamics force forces torque torques friction drag input inputs
    actuator actuators disturbance disturbances delay delays feedback loop motion motor perturbation perturbations
    controller law nonlinearity saturation noise reference cart train vehicle robot
""")
_ANOTHER = _words("""
    addition additional additionally another other second new different instead include includes including included
    also extra further extended extension inverse opposite sign reversed unstable faulty fails failed failure lost loss
    delayed modified changed without longer half twice replaced more neglected ignored dropped absent absence vanishes
    added add adds subtracted appears appear account accounted switched off perturbed generalized variant alternative
""")
# Under a heading with one of these another plant may be meant than before.
OTHER_PART = _words("""
    extension extensions generalization generalizations generalisation variant variants alternative alternatives other
    another discrete-time digital sampled unstable delay delays faults failures uncertain perturbed disturbed
    undisturbed nominal ideal
""")
# By these an assumption is taken back.
DROPS = TAKES_BACK | _words("""
    not no without drop dropped drops relax relaxed relaxes remove removed removes violated longer lifted lift weakened
    weaken invalidate invalidates invalidated violate violates break breaks fail fails failed may might cannot could
    would if unless only beyond outside exceed exceeds until
""")


def means_otherwise(texts: Sequence[str], printed: str) -> bool:
    """Whether a sentence says that a sign of a formula means something else than usual."""
    plain = _DEGREES_OF.sub(" ", " ".join(texts)).split()
    return any(all(words & {*plain} for words in needed) and sign.search(printed) for needed, sign in _CONVENTIONS)


def turns(texts: Collection[str]) -> bool:
    """Whether a sentence may turn the signs of what is given."""
    return bool(_MANNERS & {*texts})


def moves_otherwise(texts: Collection[str]) -> bool:
    """Whether a sentence may say that the plant is another one, or that more acts on it."""
    return bool(_PLANTS & {*texts}) and bool((_ANOTHER | TAKES_BACK) & {*texts})


def of_another(heading: Collection[str]) -> bool:
    """Whether another plant may be meant under a heading."""
    return bool(OTHER_PART & {*heading})


def shows_rate(printed: str) -> bool:
    """Whether a formula has a rate."""
    return _RATE.search(printed) is not None


def any_number(texts: Collection[str]) -> bool:
    """Whether a sentence may say of its letters that they are any numbers."""
    return bool(_EVERY & {*texts}) and bool(_KINDS & {*texts}) and not _SIGNS & {*texts}


def a_part(texts: Collection[str]) -> bool:
    """Whether a sentence may say of a letter that it denotes a part of what it did before."""
    return bool(DENOTES & {*texts}) and bool(_PARTS & {*texts})


def no_rate(formula: str, texts: Collection[str]) -> bool:
    """Whether a sentence may call a rate something else than the rate, as `$\\dot x$ denotes the measured speed`."""
    return shows_rate(formula) and bool(_NO_RATES & {*texts})


def no_number(texts: Collection[str], formulas: Sequence[str]) -> bool:
    r"""Whether a sentence may say of its letters that they are no numbers, or that `x^2` is a component."""
    return bool(NO_NUMBER & {*texts}) or any(_SPACE.search(one) for one in formulas) or (
        bool(_COMPONENT & {*texts}) and any("^" in one for one in formulas))

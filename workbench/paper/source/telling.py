"""What a sentence may tell without changing what was given, and of which sentences what they claim may be of a motion.

Any other, as `The amplifier inverts its input`, may say that what was given is not what acts.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from workbench.paper.source import moving, things, understood, vocabulary
from workbench.paper.source.given import letter_of
from workbench.paper.source.idioms import plainly
from workbench.paper.source.naming import of_another_value
from workbench.paper.source.narrowing import words_of
from workbench.paper.source.passages import Sentence, Word
from workbench.paper.source.reading import GIVING, Reading

# What authors do with formulas, and what they look for.
_TELLING = words_of("""
    analyse analyze study prove show derive compute calculate expand differentiate estimate bound verify investigate
    establish design recall note see discuss present simplify complete completes concludes ends begin turn proceed
    proved proven shown derived computed analysed analyzed studied investigated established presented verified
    obtained summarized used needed proofs claim claims statement statements result results
    stability boundedness convergence performance passivity derivative derivatives inequality inequalities
    identity lemma lemmas theorem theorems proposition corollary remark definition section sections subsection
    appendix figure
    table paper note lecture main following next last previous above below tool tools young young's lyapunov
    lyapunov's square squares rule chain time trajectories solutions stable asymptotically exponentially globally
    uniformly converges converge bounded origin zero tends positive definite semidefinite nonnegative smooth
    continuous differentiable analysis purpose goal aim objective end formulation description problem preliminaries
    conclusion conclusions now here finally first second third step steps therefore this that these it they all we
    us let easily readily directly immediately done more one each well important useful elementary standard
    available measured state states parameters parameter gains gain constant constants known unknown real
    number numbers model block diagram shows literature reader ready
    compact form notation is are will be can has have to of in on at for by with from as and or the a an its our
    uses gets yields gives yield give equals
    assumption assumptions every under square obviously clearly evidently good one switching
    consider then reached finite signals closed-loop lies rests relies based basis method approach technique
""")
_LISTED = _TELLING | things.HEADS | things.OF_THEM | vocabulary.GERUNDS
_FALLING = words_of("decreases decrease decays decay")  # of a function that is what is shown of it
# A claim of such a thing may be of its motion, and not of all values.
_MOVING = moving.PLANTS | moving.LOOPS | moving.QUANTITIES | moving.BESIDE | moving.FILTERS | things.LAWS
_DEDUCING = vocabulary.GERUNDS | words_of("derivative derivatives inequality")
_HARMLESS = ("math", "display", "mark", "reference", "cite", "table")


def as_told(sentence: Sentence, said: Reading, giving: Mapping[int, Collection[str]],
            known: Collection[str]) -> Reading:
    """What a sentence says; nothing where it gives something and then describes a letter as another value, as an
    estimate; what it claims of a motion is said of some values alone. giving: the letters that displays give; known:
    all that the text gives something."""
    if said.unknown or sentence.words[0].kind == "table":
        return said
    words = plainly(sentence.words)
    gifts = any(giving.get(number) for number, form in said.shown.items() if form in GIVING)
    if gifts:
        other = of_another_value(words, {letter_of(letter) for letter in known})
        return Reading(dict.fromkeys(said.shown, ""), letters=said.letters, unknown=other) if other else said
    if said.shown:
        return replace(said, tied=said.tied | {*said.shown}) if of_a_motion(words) else said
    return said if said.facts or said.limits else replace(said, beyond=untold(words))


def untold(words: Sequence[Word]) -> tuple[str, ...]:
    """The words of a sentence without a display that are on no list of what is told harmlessly."""
    texts = [word.text if word.kind == "word" else "" for word in words]
    falls = _FALLING if {*texts} & things.HEADS <= things.FUNCTIONS else frozenset[str]()
    return understood.one_of_several(texts) or tuple(dict.fromkeys(
        word.text for word in words if word.kind not in _HARMLESS and word.text not in _LISTED | falls))


def of_a_motion(words: Sequence[Word]) -> bool:
    """Whether a sentence claims something of a thing that moves, which may hold along its motion alone."""
    texts = {word.text for word in words if word.kind == "word"}
    return bool(texts & _MOVING) and not texts & _DEDUCING

r"""The forms of sentences that are read, and how formulas stand in them.

In rules, LETTERS is a formula of letters alone, `$k, c$`; REAL one that only says what numbers they are, `$x \in
\mathbb{R}$`; SIGN one that says their sign, `$k > 0$`; BOUND one between which numbers they lie, `$0 < a < 1$`, and a
RELATION too, as any other; VALUE any other expression; TIME one of the time alone; DISPLAY a displayed formula.
"""

from __future__ import annotations

import re

from workbench.paper.source import things, vocabulary, words
from workbench.paper.source.phrases import Grammar

DISPLAY, REFERENCE = "$$", "#"
LETTERS, REAL, SIGN, DEFINES, RELATION = "$letters", "$real", "$sign", "$defines", "$relation"
MOVES, TENDS, NONZERO, BOUND = "$moves", "$tends", "$nonzero", "$bound"
VALUE, TIME = "$value", "$time"
KINDS = {"LETTERS": (LETTERS,), "REAL": (REAL,), "SIGN": (SIGN,),
         "RELATION": (RELATION, DEFINES, MOVES, NONZERO, BOUND), "LIMIT": (RELATION, BOUND), "BOUND": (BOUND,),
         "MOVES": (MOVES,), "TENDS": (TENDS,), "NONZERO": (NONZERO,), "VALUE": (VALUE,),
         "DEFINES": (DEFINES,), "TIME": (TIME,), "DISPLAY": (DISPLAY,), "REF": (REFERENCE,),
         "VALUES": (LETTERS, VALUE, REFERENCE)}
# What is told of a sentence: where it states facts, what it claims, gives, defines or supposes, and what restricts it.
KEPT = ("fact", "claimed", "stated", "given", "defined", "supposed", "restricts", "restricts_bare", "then", "held",
        "value", "clause", "unsigned", "judged", "inset", "holds",
        "laid", "bounded", "suits", "limit", "moved",
        "quantified", "both")
_RULES = r"""
sentence = <lets> <after>* | <aims> | <moves_plant> | <suits> | <bare> | <lays> | <declares> | <if_then> | <supposes> |
    <leads> :? | <asserts> | <concerns> | <invites> |
    [<declares> [and | , and | ;]]? <clause> [<joint>? <clause>]*
lets = CONNECTIVE* ,? let <part>? <value> [[, | and | , and] <part>? <value>]* ,? and <things>? :? <defined>
# a plant within the text
moves_plant = [we | let us | us]? [consider | study] <thing> [MADE <as>? | [that | which] [is | are] MADE <as>?]? :?
    <moved> [,? [where | with | in which] <declared> [<andmore> <declared>]*]? | <subject> <is> :? <moved> [,? [where
    | with | in which] <declared> [<andmore> <declared>]*]?
moved = MOVES [[, | and | , and] MOVES]*
joint = , | ; | : | and | , and | ; and | , while
clause = <opener>* <taking>? <saying> <after>*
# a formula with no word before it, letters said first and then a formula
bare = <laid> [,? [where | with | in which] <declared> [<andmore> <declared>]*]+
lays = [with | let | where] <declared> [<andmore> <declared>]* ,? <laid>
laid = <shown>
# what a claim begins with
opener = CONNECTIVE ,? | in this [paper | section | note | work | article] ,? | in addition ,? | as a [result |
    consequence] ,? | in [particular | turn | fact | total] ,? | in [matrix | compact | vector | component] [form |
    notation] ,? | in [the | this | our] [first | second | third | next | last | final | following]? [step | stage] ,?
    | at this [point | stage | step] ,? | as [a | the] [first | second | third | next | last | final] step ,? | on the
    other hand ,? | <reason> ,? | for [this | the] [purpose | end | reason] ,? | to this end ,? | [note | observe |
    recall | notice] that | of course ,? | so that | this way ,? | that is , | namely ,? | for [simplicity | brevity |
    convenience | clarity] ,? | in what follows ,? | [in order]? to AIM <things> ,? | to see this ,? | <sure_of>
reason = [by | from | using | via | through | with | under | upon | along | considering | according to] <things> | [in
    view of | in light of | due to | because of | thanks to | owing to | by virtue of | motivated by | by means of |
    with the help of | with the aid of | based on | on the basis of | as a consequence of | on account of | by use of
    | by using of? | by applying | making use of | in accordance with] <things> | by? <doing> [and <doing>]* | <used>
    | <quantified> | <restricted> | [by | from] inspection | by? [a | some]? [direct | simple | elementary |
    straightforward] [computation | calculation | algebra | manipulation | manipulations] | by [definition |
    construction | substitution | design | assumption] | taking <things> into account
doing = GERUND <things>? [[along | with | by | using | into | in | from | to | for | and | with respect to | as]
    <things>]*
used = [by | using | from] the? [inequality | identity | fact that | relation | equality]? <claimed> | [by | using |
    by using | from | with] [of? the? [well-known | elementary | basic | simple]? [inequality | identity | fact that |
    relation | equality]]? <restricts_bare>
restricted = <restricts> ,? [then | so]?
restricts = [since | because | as | noting that | observing that | recalling that | knowing that] [the | all]?
    [VALUENOUN]* <relates_to> [[, | and | , and] <relates_to>]* [holds | hold]? | [with | for | if | when | whenever |
    where | provided that? | for all | for every | for each | for any | on | at | given] [the | all]? [VALUENOUN]*
    <related> [[, | and | , and] <related>]* [holds | hold]?
relates_to = <related> | <list> [is | are] [<adjectives> | <kind>]
related = RELATION | SIGN
quantified = for [all | every | each | any] [times | instants | real | VALUENOUN]* [time | TIME | LETTERS | REAL |
    SIGN] [[, | and | , and] [all | every | each | any]? [TIME | LETTERS | REAL | SIGN]]* | for REAL [[, | and | ,
    and] [REAL | SIGN]]*
# what is spoken of
things = <thing> [[, | and | , and | as well as | together with | with | , with] <thing>]*
thing = <part> [[of | for | along | to | with respect to | in | on] <part>]*
part = DETERMINER? [MODIFIER | NOUN | NAME]* [NOUN | NAME | LETTERS | VALUE | REAL | REF | TIME] [LETTERS | VALUE |
    REAL | <sure>]? REF? | both sides | this | these | REF [, REF]* [, ]? and REF | REF [to | - | - - | –] REF
derived = DETERMINER? FOLLOWING* DERIVED VALUES? [[of | for | along | to | with respect to | in | on] <part>]*
# what is claimed
saying = <claimed> | <stated> | <given> | <concludes> | <defines> | <named>
claimed = <shown> <holds>?
holds = [holds | hold | follows | follow] [true | as well | too]? [from <things> | by <things>]?
shown = DISPLAY [[, | and | , and | ; | , that is ,? | or equivalently]? DISPLAY]*
concludes = <say> [that | :]? <reason>? ,? [the | a | an]? FOLLOWING* :? <claimed>
say = we can? ADVERB* [HAVE at? | use | used | have used] | one can? ADVERB* [HAS at? | HAVE at?] | <sure_of> | it
    ADVERB* [follows | holds | results] ADVERB* [[from | by | with] [<things> | SIGN]]? | there [holds | hold |
    follows | results] | [which | this | these] ADVERB* GIVES [to | in | at]? | by? <doing> ,? ADVERB* GIVES [to | in
    | at]? | [by | using] the? [inequality | identity | fact that | relation | equality]? <claimed> ADVERB* GIVES [to
    | in]? | <things> ADVERB* GIVES [to | in | at]? | that is ,? | [which | this] is equivalent to | so that | [this |
    which] [follows from | is due to] | our starting point is | [the? [following]? [inequality | identity | bound |
    estimate | relation | equality | inequalities | bounds | relations | identities | estimates | equation |
    equations] | the following] [holds | hold | is true | are true | is valid | is satisfied | are satisfied |
    follows]? | we can [write | rewrite | bound | estimate | express] <things> as | [it | which | <things>] [is | are]
    [[positive | negative] [definite | semidefinite | semi-definite] | nonnegative | bounded from below | bounded] ,
    that is ,? | where we [have used | used | use] | [we | let us]? [complete | expand | rearrange | differentiate |
    compute | square] <things>
sure_of = it is ADVERB* [clear | easy | obvious | immediate | evident | straightforward | simple | obviously | readily
    | known | well-known | noted | worth noting] [to [see | verify | check | show | note]]? that | it can ADVERB* be
    ADVERB* SEEN ADVERB* that | it is ADVERB* SEEN that | it follows that
named = the? [inequality | identity | bound | estimate | relation | equality] <claimed>
# a quantity that follows, and one that is given
stated = [whose | its]? <derived> <is> [, <quantified> ,]? :? <shown>
given = [<subject> | it | they] <is> [, <quantified> ,]? :? <shown> | <part>? <value> [[, | and | , and] <value>]* ,?
    <is> :? <shown>
subject = <subjects> [[, | and | , and | together with] <subjects>]*
subjects = DETERMINER? [MODIFIER | NOUN | NAME]* [QUANTITY | LETTERS | VALUE | REF] [LETTERS | VALUE | <inset>]? REF?
    [[of | for | in | along | with respect to | with] <part>]*
inset = REAL | SIGN
is = ADVERB* [IS | [has | have | takes | take] the following? form | [is | are] ADVERB* MADE | can ADVERB* be ADVERB*
    MADE | is then | [was | were | been] MADE] <as>?
as = [as | by | from | in the form | to be | to | of the form | in terms of] [follows | above | below | <thing> as]?
defines = [we | let us | us | one]? ADVERB* DEFINE [<part>? <value> [[, | and | , and] <part>? <value>]* ,? and]?
    <things>? <being>? <as>? :? <defined> | let <things>? [be ADVERB*
    MADE? | be MADE]? <as>? :? <defined> [be <kind> | denote <kind>]? | DEFINING <things>? <as>? <defined> ,? | [with
    | where | and | under] <things>? <being>? <as>? <defined> | <things> <defined> [is | are] [introduced | considered
    | used | chosen | defined | employed | proposed | selected] | [the | our] [error | errors] [is | are] <defined>
being = [MADE | obeying | satisfying] | [that | which] [is | are] MADE | whose [dynamics | motion | state] [is | are]
    MADE?
defined = <shown>
supposes = CONNECTIVE* ,? [let us]? [assume | suppose] [now | first]? that? [[<things> <is>]? <supposed> | <held>] |
    let <held>
supposed = <shown>
held = <heldone> [[, | and | , and] <heldone>]*
heldone = <related> [holds | hold]? | <things>? <list> [<be> [<kind> | <adjectives>]]?
if_then = if <related> [and <related>]* ,? then? <then>
then = <related> [and <related>]*
# what stands behind a formula
after = ,? <quantified> | ,? with <things> :? <defined> | ,? [which is]? MADE [by | from | via | through | according
    to | using] <things>? :? <defined> | ,? [where | with | in which] [<declared> | <bound>] [<andmore> [<declared> |
    <bound>]]* | ,? <restricts> | ,? where <part> uses <things> | ,? which [completes | concludes | ends] [the | our]
    proof | , which [is | are] [negative | positive] [definite | semidefinite | semi-definite] | ,? as [claimed |
    desired | required | stated] | [by | from | due to | because of] <things> | , where we [have]? used <things> | ,
    where [the last | the | use] [inequality | step | is] [follows from | uses | made of | due to] <things> | ,
    [respectively]
andmore = [, | ; | and | , and | ; and] [where | with | let]? | with
# what letters are
declares = [throughout [the | this] [paper | note | section | work | thesis]? ,?]? [CONNECTIVE ,? | in this [paper |
    section | chapter] ,?]? [[let | where | with | in which | we assume that | it is assumed that | we denote by |
    denote by | we write]? <declared> [<andmore> <declared>]* | [it | one | this] has <fact> [<andmore> <fact>]* |
    <opener>* <inline> [<andmore> [<inline> | <declared> | <given>]]* <after>* | let <declared> [<andmore>
    <declared>]* <andmore> <inline>]
taking = [for | with] <part>? <value> ,?
inline = [let | we? ADVERB* DEFINE]? [<thing> | the error | the errors]? [be | as | by | is | are | <is>]? <value>
    [[of | for | with] <fact> | [be | denote | denotes | represent]? <kind>]?
value = DEFINES
declared = <fact> [, respectively]? | <both> | <unsigned> | <bounded> | <value> <be> <kind>
bounded = <fact> [satisfying | obeying | that satisfies | which satisfies | with | [that is]? bounded by] <limit>
bound = [<things> [satisfies | satisfy | is bounded by | are bounded by]]? <limit>
suits = the [ideal | matching | true | unknown | control | feedback]? [gains | parameters | constants | coefficients]
    <list> [satisfy | fulfil | fulfill | obey] [the [matching]? [condition | conditions | equations]]? <limit>
limit = LIMIT [and LIMIT]*
unsigned = <list> <be> not <adjectives> | <list> <be> <kind>? [positive | negative] [definite | semidefinite]
fact = <list> <be> <kind> | <kind> <list> | <kind> <list> <be> <kind> | <kind> <list> vary | <kind> <be> <list> |
    <kind> <be> <adjectives> | <list> <be> <adjectives> | <list> | <list> <kind> | <list> vary | <list> [as | for]
    <kind> | <kind> <list> <be> <adjectives> | <kind> <ranged> |
    BOUND <be> <kind> | <ranged> [are | be | being | denote | represent | designate] <kind>
ranged = [<letter> [, | and | , and]]* BOUND [[, | and | , and] [BOUND | <letter>]]*
both = <list> <be> <kind> [, <kind>]* ,? and <kind> , respectively
list = <letter> [[, | and | , and] <letter>]*
letter = LETTERS | REAL | SIGN | TIME | NONZERO
sure = SIGN
be = [is | are | be | being | denotes | denote | denoting | represents | represent | stands for | stand for | means |
    designates]
kind = DETERMINER? [MODIFIER [but]? | NOUN]* NOUN [[, | and | , and] DETERMINER? [MODIFIER | NOUN]* NOUN]* [[of |
    for | in | on | to] <part>]* [to be [chosen | designed | determined | selected | tuned | estimated | tracked]]?
    [respectively]?
adjectives = [[ADJECTIVE | MODIFIER] [, | and | but | , and]?]* [ADJECTIVE | MODIFIER]
# what an assumption says
assumes = <assumed> [[, | and | ; | , and] <assumed>]*
assumed = [we assume that | it is assumed that | assume that | suppose that | there [exists | exist | is | are]
    <kind>? <fact> such that]? [<quantified> ,?]? [[<things> | it] <is>]? [, that is ,]? <relates> [holds | hold]? ,?
    [with <fact>]? [,? <quantified>]? | <things> [is | are] bounded [by <things>]? | <things> [is
    | are] [bounded | limited] [by | as] <relates> | <fact> | <sentence>
relates = RELATION | <fact> | <shown>
# a relation that is claimed within the text, what is said of a motion, what is going to be done
asserts = <opener>* [<say> that?]? <held> [<holds> | [by | from | since | for] <things>]?
concerns = <opener>* [[<signals> | TENDS [as TIME]? | <things> <moves>] [[, | and | , and] CONNECTIVE? [<things>?
    <moves> | TENDS [as TIME]?]]* | <judged> [,? <because>]?] | DETERMINER [MODIFIER | NOUN]* [of | with] [MODIFIER |
    NOUN]* NOUN <inset> <travels>
travels = [moves | runs | travels | slides | rolls | rotates | swings] [on | along | in | over | about | around]
    <things>
judged = <things> [is | are] ADVERB* <adjectives> | [this | it | which] is ADVERB* [immediate | clear | obvious |
    evident | straightforward] [from <things>]?
because = [since | because | as | by] [<related> [and <related>]* | <things> [[is | are] <adjectives>]?]
signals = [all | the]? [all | of]? [the]? [signals | states | variables] [[in | of] <things>]? [are | remain] MANNER*
    bounded
moves = [is | are] [nonincreasing | non-increasing | decreasing] | [is | are] reached in [finite | fixed] time | [does
    | do] not [increase | grow] MANNER* | [is | are] MANNER* [STABLE | attractive | bounded | invariant | passive] |
    [converge | converges | tend | tends] MANNER* to [zero | the origin | <things>] MANNER* [as TIME]? | [decreases |
    increases | decrease | increase | vary | decays] MANNER*
invites = consider [now | again]? <things> | [let us | we] ADVERB* [compute | calculate | expand | differentiate |
    analyse | analyze | study | estimate | bound] <things>? | this [completes | concludes | ends | proves |
    establishes] [the | our] [proof | lemma | theorem | result | statement]
aims = [the | our] [control | design | main]? [objective | goal | aim | task | problem] is to [track | follow] <fact>
leads = CONNECTIVE* ,? [we ADVERB* HAVE]? the following MODIFIER? [inequalities | identities | bounds | relations |
    properties | estimates | equations | statements]? [hold | are true]?
restricts_bare = RELATION
"""


def _rules(text: str) -> dict[str, str]:
    """The rules of a text: each begins at the start of a line, and goes on in those that are indented."""
    lines = re.sub(r"\n\s+", " ", re.sub(r"(?m)^#.*\n", "", text)).strip().splitlines()
    return {name.strip(): rule for name, _, rule in (line.partition("=") for line in lines)}


ERROR = "error-signal"  # an error that is the difference of two signals
NOUNS = (vocabulary.GIVEN | vocabulary.DERIVED | vocabulary.TEXT | things.HEADS | {ERROR}) - {"error", "errors"}
MODIFIERS = vocabulary.MODIFIERS | things.OF_THEM - NOUNS
# A quantity that an author may give, and a noun that stands before a relation.
QUANTITIES = (vocabulary.GIVEN | things.HEADS | {ERROR}) - {"error", "errors"}
GRAMMAR = Grammar(_rules(_RULES), {
    **{name: frozenset(kinds) for name, kinds in KINDS.items()},
    "CONNECTIVE": vocabulary.CONNECTIVES, "HAVE": vocabulary.HAVE, "HAS": vocabulary.HAS, "SEEN": vocabulary.SEEN,
    "GIVES": vocabulary.GIVES, "IS": vocabulary.IS, "MADE": vocabulary.MADE, "DEFINE": vocabulary.DEFINE,
    "DEFINING": vocabulary.DEFINING, "AIM": vocabulary.AIM, "GERUND": vocabulary.GERUNDS, "NOUN": NOUNS,
    "NAME": vocabulary.NAMES, "MODIFIER": MODIFIERS, "DETERMINER": vocabulary.DETERMINERS,
    "DERIVED": vocabulary.DERIVED, "ADVERB": vocabulary.ADVERBS, "MANNER": vocabulary.MANNER,
    "STABLE": vocabulary.STABLE,
    "ADJECTIVE": vocabulary.ADJECTIVES, "VALUENOUN": QUANTITIES | MODIFIERS, "QUANTITY": QUANTITIES,
    "FOLLOWING": (NOUNS | vocabulary.NAMES | MODIFIERS) - vocabulary.WISHED - things.LAWS}, KEPT)
# Every word that a sentence of some form may have, for telling which ones were not understood.
KNOWN = (NOUNS | vocabulary.NAMES | MODIFIERS | vocabulary.DETERMINERS | vocabulary.CONNECTIVES
         | vocabulary.HAVE | vocabulary.GIVES | vocabulary.IS | vocabulary.MADE | vocabulary.GERUNDS
         | vocabulary.ADJECTIVES | vocabulary.ADVERBS | vocabulary.MANNER | vocabulary.STABLE)
_UNCLEAR = {"error", "errors"}
PROSE = words.VERBS | words.QUALITIES | words.MATTERS
# What a sentence without a displayed formula is made of, and what one that claims some in a form of its own.
NEUTRAL = (NOUNS | vocabulary.NAMES | MODIFIERS | vocabulary.DETERMINERS | vocabulary.PLAIN
           | vocabulary.TELLING | vocabulary.CLAIMING | PROSE | words.STORY) - _UNCLEAR
LOOSE = (vocabulary.CLAIMING | NOUNS | vocabulary.NAMES | MODIFIERS | vocabulary.DETERMINERS
         | vocabulary.MADE | vocabulary.CONNECTIVES | vocabulary.GERUNDS | PROSE | {"let"}
         ) - vocabulary.WISHED - _UNCLEAR | {"given"}
# Words by which a formula follows from what was said, so that it gives nothing.
FOLLOWS = vocabulary.DERIVED | vocabulary.GIVES | vocabulary.HAVE | vocabulary.HAS | vocabulary.SEEN

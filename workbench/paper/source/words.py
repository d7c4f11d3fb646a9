"""The words of prose: verbs with their forms, adjectives and nouns by which formulas are spoken of.

As in `vocabulary`, none takes back, restricts or doubts a formula.
"""

from __future__ import annotations

_IRREGULAR = {"get": "got", "find": "found", "see": "saw seen", "write": "wrote written", "rewrite": "rewritten",
              "give": "gave given", "take": "taken", "make": "made", "build": "built", "mean": "meant", "lead": "led",
              "come": "came", "become": "became", "put": "put putting", "set": "setting", "split": "split splitting",
              "choose": "chosen", "hold": "held", "keep": "kept", "draw": "drawn", "rise": "risen", "arise": "arisen",
              "stem": "stemming", "plug": "plugged plugging", "run": "running", "begin": "begun beginning",
              "grow": "grown", "show": "shown", "drive": "driven driving", "bring": "brought", "meet": "met",
              "let": "letting", "say": "saying", "fit": "fits fitted fitting", "sum": "summed summing",
              "map": "mapped mapping", "drop": "drops", "admit": "admitted admitting"}


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


def _forms(verbs: str) -> frozenset[str]:
    """The verbs with their regular forms, and the irregular ones that are listed."""
    found: set[str] = set()
    for verb in verbs.split():
        stem = verb.removesuffix("e")
        if verb.endswith("y") and verb[-2] not in "aeou":
            found |= {verb, f"{verb[:-1]}ies", f"{verb[:-1]}ied", f"{verb}ing"}
        else:
            found |= {verb, verb + ("es" if verb.endswith(("s", "x", "ch", "sh")) else "s"), f"{stem}ed", f"{stem}ing"}
        found |= {*_IRREGULAR.get(verb, "").split()}
    return frozenset(found)


# What is done with formulas, and what they do.
VERBS = _forms("""
    add subtract multiply divide square cube expand factor factorize factorise collect group gather rearrange reorder
    regroup combine merge cancel complete compare estimate bound majorize majorise dominate control absorb split
    decompose separate isolate integrate differentiate derive deduce infer conclude obtain get gain achieve attain
    reach arrive yield give provide deliver produce generate create form build construct make find see observe notice
    note recognize recognise realize recall remember express describe characterize represent write rewrite restate
    reformulate formulate summarize summarise list record show prove establish verify check confirm demonstrate
    illustrate justify guarantee ensure assure imply entail mean lead result follow emerge arise stem originate come
    become turn reduce simplify shorten condense transform convert map translate rotate scale normalize substitute
    insert plug put place apply use employ utilize exploit invoke adopt introduce study analyze analyse investigate
    examine inspect explore handle evaluate compute calculate determine present discuss explain interpret relate
    connect link couple correspond satisfy fulfil obey hold remain keep preserve contribute depend rely rest base
    motivate reveal involve include comprise consist enter occur act move track steer stabilize converge decay decrease
    increase grow facilitate ease help assist allow enable permit serve perform execute conduct implement run proceed
    continue start begin finish conclude recast rephrase read sum total equate linger amount draw bring admit
    rationalize symmetrize telescope accumulate minimize maximize optimize sketch visualize
    weight measure count label number index limit denote
""")
# What formulas and steps are like.
QUALITIES = _words("""
    short brief long quick simple elementary easy straightforward routine standard direct immediate obvious clear
    evident trivial plain explicit implicit exact precise rigorous careful detailed complete full total whole entire
    final last first next subsequent previous above below algebraic analytic analytical arithmetic arithmetical
    geometric geometrical pointwise componentwise termwise elementwise squared cubed summed scaled weighted
    normalized quadratic cubic quartic bilinear linear nonlinear convex concave monotone monotonic increasing
    decreasing even odd symmetric homogeneous polynomial rational trigonometric exponential logarithmic hyperbolic
    nonpositive non-positive nonnegative positive useful helpful handy crucial key central important fundamental
    essential basic main principal new novel classical celebrated famous popular usual customary similar analogous
    equivalent identical same equal related corresponding respective auxiliary intermediate preliminary resulting
    remaining mixed cross diagonal upper lower left right inner outer sharp tight strict weaker stronger crude
    uniform two-sided one-sided dissipative passive absolute relative overall combined additional further extra own
    several various both two three four multiple neat elegant nice compact concise convenient suitable appropriate
    instructive illustrative insightful well-known well-established so-called afterwards thereby therein herein
    hereafter henceforth thereafter eventually altogether together alike jointly separately successively repeatedly
    twice anew algebraically analytically explicitly exactly precisely carefully briefly quickly easily readily
    plainly simply directly immediately clearly obviously evidently trivially similarly analogously likewise
    equivalently correspondingly accordingly finally lastly ultimately conveniently pleasantly neatly elegantly
    automatically naturally basically after again moreover besides additionally furthermore well thus hence
""")
# What is spoken of beside formulas, and the forms of "be" and "have".
MATTERS = _words("""
    due relationship relationships relation ratio ratios magnitude magnitudes size sizes modulus value values amount
    amounts abbreviation abbreviations shorthand symbol symbols notation notations polynomial polynomials parabola
    hyperbola ellipse circle line lines form forms binomial trinomial monomial monomials discriminant root roots
    power powers exponent sum sums total contribution contributions summand summands factor factors product products
    quotient quotients fraction fractions numerator denominator integrand integral integrals derivative gradient
    hessian jacobian increment decrement dissipation decay growth convexity concavity monotonicity homogeneity
    polarization polarisation symmetry positivity parity linearity orthogonality calculation calculations
    computation computations manipulation manipulations operation operations step steps argument arguments reasoning
    trick tricks technique techniques device ingredient ingredients recipe idea ideas insight insights observation
    observations comment comments hint picture illustration consequence consequences implication implications
    outcome upshot conclusion conclusions finding findings rearrangement rearrangements simplification
    simplifications substitution substitutions insertion expansion expansions multiplication division addition
    subtraction summation squaring differentiation integration elimination evaluation estimation inspection
    comparison combination combinations decomposition splitting way ways manner means help aid virtue light view
    basis sake spirit fashion mind word words piece pieces part parts bit half halves middle start beginning end
    energy work heat mass charge fuel balance budget is are was be been being has have it they them itself
    themselves one ones us our ours its their whose which who that this these those there here where and as at by
    for from in into of on onto out over per to toward towards up upon via with within through throughout along
    across
""")
# What a text tells besides where it shows no formula.
STORY = _words("""
    before after since while during again often now today soon later early synthesised synthesized synthesis reader
    readers students teacher lecturer audience chapter chapters thesis section sections appendix appendices book
    books article articles journal conference proceedings volume page pages remind keep keeps kept mind look looks
    looking turn turns take takes give gives go goes going say says tell tells recap recapitulate warm-up motivation
    motivating background history historical context picture pictures intuition physics physically mathematically
    geometrically how let us start machine machines engine engines vehicle vehicles aircraft helicopter rocket
    missile submarine robot robots manipulator manipulators arm arms leg legs wheel wheels hand gripper camera radar
    lidar gps plant plants factory process processes reactor reactors furnace boiler pump pumps valve valves pipe
    pipes tank tanks circuit circuits transistor inverter inverters converter converters transformer grid microgrid
    load loads patient patients glucose insulin drug population species epidemic economy market price cyber security
    network networks communication packet packets bandwidth server servers cloud freedom degree degrees flexible
    rigid soft
""")

"""The commands of LaTeX that lines of control papers use, by what they are."""

from __future__ import annotations

GREEK = frozenset((
    "alpha", "beta", "gamma", "delta", "epsilon", "varepsilon", "zeta", "eta", "theta", "vartheta", "iota", "kappa",
    "varkappa", "lambda", "mu", "nu", "xi", "pi", "varpi", "rho", "varrho", "sigma", "varsigma", "tau", "upsilon",
    "phi", "varphi", "chi", "psi", "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma", "Upsilon",
    "Phi", "Psi", "Omega", "ell", "hbar", "nabla", "partial", "infty", "Re", "Im", "imath", "jmath", "wp", "aleph",
))
ACCENTS = frozenset((
    "dot", "ddot", "dddot", "hat", "widehat", "tilde", "widetilde", "bar", "overline", "underline", "check",
    "breve", "vec", "acute", "grave", "mathring",
))
SAME_ACCENT = {"widehat": "hat", "widetilde": "tilde", "bar": "overline"}
FONTS = frozenset(["mathcal", "mathbf", "mathbb", "mathfrak", "mathscr", "mathsf", "boldsymbol", "bm"])
UPRIGHT = frozenset(["mathrm", "operatorname", "mathit", "mathop", "mathtt"])
FUNCTIONS = frozenset((
    "sat", "sgn", "sign", "tanh", "exp", "ln", "log", "max", "min", "sup", "inf", "tr", "det", "diag", "sin", "cos",
    "tan", "cosh", "sinh", "arctan", "arg", "dim", "rank",
))
# What letters without a backslash must not spell; shorter names are products of letters too.
SPELLED = FUNCTIONS - {"tr", "arg", "dim", "rank"} | {"abs"}
SAME_FUNCTION = {"sign": "sgn", "log": "ln"}
FRACTIONS = frozenset(["frac", "tfrac", "dfrac", "cfrac"])
BIG = frozenset(["sum", "prod", "int", "iint", "oint", "lim", "limsup", "liminf", "bigcup", "bigcap"])
RELATIONS = {
    "le": "<=", "leq": "<=", "leqslant": "<=", "leqq": "<=", "ge": ">=", "geq": ">=", "geqslant": ">=", "geqq": ">=",
    "lt": "<", "gt": ">", "ne": "!=", "neq": "!=", "in": "in", "to": "to", "rightarrow": "to", "longrightarrow": "to",
    "uparrow": "up", "downarrow": "down", "equiv": "equiv", "approx": "approx", "triangleq": "=", "coloneqq": "=",
    "propto": "propto", "subset": "subset", "subseteq": "subset", "ll": "<<", "gg": ">>", "notin": "notin",
    "sim": "sim", "mapsto": "mapsto",
}
IMPLIES = frozenset(["Rightarrow", "implies", "Longrightarrow"])
EQUIVALENT = frozenset(["Leftrightarrow", "iff", "Longleftrightarrow"])
QUANTIFIERS = frozenset(("forall", "exists"))
ELLIPSES = frozenset(["dots", "ldots", "cdots", "vdots", "ddots", "dotsc", "dotsb", "dotsm"])
# Several lines as one: those of a system are parted by commas, those of an aligned formula go on.
ENVIRONMENTS = frozenset(("cases", "aligned", "align", "align*", "split", "gathered", "equation", "equation*"))
TIMES = frozenset(("cdot", "times"))
OPENING = {"lbrace": "{", "lbrack": "[", "{": "{"}
CLOSING = {"rbrace": "}", "rbrack": "]", "}": "}"}
BARS = {"lvert": "|", "rvert": "|", "vert": "|", "lVert": "||", "rVert": "||", "Vert": "||", "|": "||"}
OPENS_BAR = frozenset(("lvert", "lVert", "left", "bigl", "Bigl", "biggl", "Biggl"))
CLOSES_BAR = frozenset(("rvert", "rVert", "right", "bigr", "Bigr", "biggr", "Biggr"))
# Spaces that part two formulas, and what ends a row.
WIDE = frozenset(("quad", "qquad", "enspace", " ", ";", ":", ">", "nonumber", "notag"))
# What changes the look of a line only.
DROPPED = frozenset((
    ",", ";", ":", "!", ">", "quad", "qquad", "enspace", "thinspace", "left", "right", "middle", "big", "Big",
    "bigg", "Bigg", "bigl", "bigr", "Bigl", "Bigr", "biggl", "biggr", "Biggl", "Biggr", "textstyle", "displaystyle",
    "scriptstyle", "limits", "nolimits", "mathstrut", "strut", "nonumber", "notag", " ",
))
TEXTS = frozenset(["text", "textrm", "textit", "mbox", "textnormal", "textup"])
SILENT = frozenset(("label", "tag", "tag*"))  # with what stands in their braces
STAR = frozenset(("*", "star", "ast"))
# All that may stand in an index.
KNOWN = (GREEK | ACCENTS | FONTS | UPRIGHT | FUNCTIONS | FRACTIONS | BIG | RELATIONS.keys() | ELLIPSES | TIMES
         | OPENING.keys() | CLOSING.keys() | BARS.keys() | DROPPED | TEXTS | STAR | {"pm", "mp", "prime", "top", "sqrt",
                                                                                    "dagger", "mid"})

r"""Sentences of papers around a displayed formula that say something else of it than the formula by itself.

In each, Z stands for a letter of its own. Every text has displays; the last one is false, or says nothing, as it
stands in the paper (FALSE), or true there (TRUE), though by itself it is the opposite.
"""

SHOWN = r"\begin{equation} Z^3 > 0 \end{equation}"
FALSE = (
    # what is said of a letter somewhere is no sign everywhere
    *(rf"{said}. {SHOWN}" for said in (
        "If $Z = 1$ and $Z > 0$, it is simple", "On the set where $Z > 0$ it grows", "In the region $Z > 0$ it grows",
        "Either $Z > 0$ or $Z < 0$", "Suppose first that $Z > 0$", "It may happen that $Z > 0$",
        "It does not follow that $Z > 0$", "We ask whether $Z > 0$", "Since $Z > 0$ there", "For instance, $Z > 0$",
        r"\begin{lemma} Let $Z > 0$. It holds that $Z + 1 > 0$. \end{lemma} Now", "Near the origin $Z > 0$",
        r"\begin{proof} Assume $Z > 0$. Done. \end{proof} Now",
        r"\begin{remark} The value $Z > 0$ is usual. \end{remark} Now",
        "The positive definite function $Q_Z$ of $Z$", "It is a positive function of $Z$", "It is positive if $Z$ is",
        "The positive or negative constant $Z$", "Neither $D$ nor $Z$ is a positive constant",
        "For positive $Z$ more is known")),
    # a formula that is true, and that the sentence does not claim
    r"It is false that \begin{equation} Z^2 \ge 0 \end{equation}",
    r"The inequality \begin{equation} Z^2 \ge 0 \end{equation} never holds.",
    r"One cannot have \begin{equation} Z^2 \ge 0 \end{equation}",
    # columns, cases and macros
    r"\begin{align} D &\ge D + Z^2 & -Z^2 &\le Z^2 + D \end{align}",
    r"\begin{align} Z^2 &\ge D & D &\ge 0 \end{align}",
    r"\begin{equation} \left\{\begin{array}{ll} Z^2 \ge Z - D & D > 0 \\ Z \le Z + D^2 & Z > 0 \end{array}\right. "
    r"\end{equation}",
    r"\begin{equation} 2|Z| + 1 = 2 \begin{cases} Z + 1 & Z \ge 0 \\ -Z + 1 & Z < 0 \end{cases} \end{equation}",
    r"\begin{equation} -|Z| - 1 = -\begin{cases} Z - 1 & Z \ge 0 \\ -Z - 1 & Z < 0 \end{cases} \end{equation}",
    r"\newcommand{\power}[1]{#1^2} \renewcommand{\power}[1]{#1^3} \begin{equation} \power{Z} \ge 0 \end{equation}",
    r"\newcommand{\ck}{c k} \begin{equation} \frac 1\ck \le \frac{k}{c} + Z^2 \end{equation}",
    # what holds somewhere gives no letter its value
    r"\begin{equation} \dot Z = -k Z \end{equation} On the sliding surface $x = 0$, "
    r"\begin{equation} Z = -k x \end{equation} \begin{equation} Z + k x \ge 0 \end{equation}",
    r"\begin{equation} \dot Z = -k Z \end{equation} This holds. \begin{equation} Z = -k x \end{equation} "
    r"\begin{equation} Z + k x \ge 0 \end{equation}",
    r"When the vehicle stands still, \begin{equation} Z = 0 \end{equation} \begin{equation} Z^3 \ge 0 \end{equation}",
    r"\begin{remark} The usual choice is \begin{equation} Z = 2 k \end{equation} \end{remark} "
    r"\begin{equation} Z > k \end{equation}",
    # what moves is no constant, and a rate that is derived is claimed
    r"The time-varying parameter $Z(t)$ enters. \begin{equation} \hat{Z} = x^2 Z \end{equation} "
    r"\begin{equation} \dot{\hat{Z}} = -2 k x^2 Z \end{equation}",
    r"It is constant on intervals of $Z$. \begin{equation} \hat{Z} = x^2 Z \end{equation} "
    r"\begin{equation} \dot{\hat{Z}} = -2 k x^2 Z \end{equation}",
    r"\begin{equation} Z = \begin{pmatrix} x & 1 \end{pmatrix} \begin{pmatrix} x \\ 1 \end{pmatrix} \end{equation} "
    r"\begin{equation} \dot Z = -2 k x^2 \end{equation} \begin{equation} \dot Z \le 0 \end{equation}",
    r"The energy is $Z$. It follows that \begin{equation} \dot Z = -x^2 \end{equation} "
    r"\begin{equation} \dot Z \le 0 \end{equation}",
)
TRUE = (
    *(rf"{said} \begin{{equation}} Z^3 \ge 0 \end{{equation}}" for said in (
        "In the set $Z \\ge 0$ we have", "Under the condition $Z \\ge 0$,", "Letting $Z = x^2$ yields",
        "For nonnegative $Z$,",
        "For positive $Z$,", "There is a constant $Z$ with", "Near $Z = 1$,", "For sufficiently large $Z$,")),
    *(rf"\begin{{lemma}} {said} \begin{{equation}} Z^3 \ge 0. \end{{equation}} \end{{lemma}}" for said in (
        "Let $Z \\ge 0$. Then", "Let $Z = x^2$. We have", "If $Z \\ge 0$, then")),
    *(rf"We have \begin{{equation}} Z^3 \ge 0 \end{{equation}} {said} {{}}." for said in (
        "with $Z = x^2$", "since $Z \\ge 0$", "because of $Z \\ge 0$", "whenever $Z \\ge 0$")),
    r"Choose $Z$ such that \begin{equation} Z > 2 k \end{equation}",
    r"Let the gain $Z$ satisfy \begin{equation} Z > 2 k \end{equation} \begin{equation} Z > k \end{equation}",
    r"Suppose that \begin{equation} |Z| \le c. \end{equation} Then \begin{equation} Z \le c \end{equation}",
    r"If the gain satisfies \begin{equation} Z > k \end{equation} then \begin{equation} Z x^2 \ge k x^2 \end{equation}",
    r"In the absence of it, that is, with $Z = 0$, \begin{equation} x Z = 0 \end{equation}",
    r"The function $Z$ with $Z = x^2$ obeys \begin{equation} Z \ge 0 \end{equation}. "
    r"\begin{equation} x^2 Z \ge 0 \end{equation}",
    r"\begin{remark} The choice \begin{equation} Z = 2 k \end{equation} is usual. Then \begin{equation} Z > k "
    r"\end{equation} \end{remark}",
    r"We assume that \begin{equation} |Z| \le c \end{equation} \begin{equation} Z \le c \end{equation}",
    r"\begin{lemma} Let \begin{equation} Z \ge 1. \end{equation} Then \begin{equation} Z^2 \ge 1. \end{equation} "
    r"\end{lemma}",
    r"\newcommand{\cube}[1]{#1^2}\begin{equation} \cube{Z} \ge 0 \end{equation} \renewcommand{\cube}[1]{#1^3}",
)
CLAIMED = (
    r"Hence \begin{equation} Z^2 \ge 0 \end{equation}",
    r"It follows with $c > 0$ that \begin{equation} c Z^2 \ge 0 \end{equation}",
    r"Let $Z \ge 0$ denote a mass. \begin{equation} Z^3 \ge 0 \end{equation}",
    r"where $Z > 0$ is a gain. \begin{equation} Z^3 > 0 \end{equation}",
    r"\begin{equation} |Z| = \begin{cases} Z & Z \ge 0 \\ -Z & Z < 0 \end{cases} \end{equation}",
    r"\begin{align} (Z - D)^2 &= Z^2 - 2 Z D \nonumber \\ &\quad + D^2, & & \end{align}",
    r"The unknown but constant parameter $Z$. \begin{equation} \hat{Z} = x^2 Z \end{equation} "
    r"\begin{equation} \dot{\hat{Z}} = -2 k x^2 Z \end{equation}",
)

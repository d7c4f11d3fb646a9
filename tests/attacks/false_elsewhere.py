r"""Texts that say elsewhere, far from a formula, by which it means something else than it says by itself.

In each the formula in [[ ]] stands. UNPROVED: it does not follow, since a letter gets another value, rate or kind, a
sign another meaning, or an assumption is dropped. UNREFUTED: it holds for the values of which the paper speaks. KEPT:
the same said harmlessly, so that it is decided.
"""

_W = r"Consider the function \begin{equation} W = x^2 + y^2 . \label{W} \end{equation} It is smooth." "\n\n"
_LAW = r"The control law is \begin{equation} u = -a x - k x . \end{equation}" "\n\n"
_PLANT = r"\begin{equation} \dot y = -k y . \end{equation}" "\n"
_FALLS = r"Let $U = \frac12 y^2$. Then [[\dot U = -k y^2]]"
_BOUND = r"\begin{assumption} \label{bound} The disturbance satisfies $|d| \le k$. \end{assumption} "
_HOLDS = "\n\nWe have [[W \\ge 0]]"

UNPROVED = (
    # another value
    f"{_W}In the sequel the last square enters with the opposite sign, and the function is $x^2 - y^2$.{_HOLDS}",
    rf"{_W}\subsection{{Second loop}} In this section we write $W$ for $x^2 - y^2$.{_HOLDS}",
    f"{_W}In the second step the function becomes $x^2 - y^2$.{_HOLDS}",
    rf"{_W}We have [[W \ge 0]] where now $W = x^2 - y^2$.",
    f"{_W}The energy of the spring enters through the term $-y^2$.{_HOLDS}",
    f"{_W}{_HOLDS}" r" \section{Corrections} Equation \eqref{W} should read $W = x^2 - y^2$.",
    f"{_W}{_HOLDS}" r" \section{Erratum} In the printed version of \eqref{W} the last sign was wrong.",
    f"{_W}{_HOLDS}" "\n\nThe plus sign in the definition of $W$ is a misprint.",
    f"{_W}Elsewhere the opposite convention is common, and we follow it.{_HOLDS}",
    r"The gains are $k$ and $-\gamma$. We write $\gamma$ for both. We have [[\gamma x^2 \ge 0]]",
    r"\begin{proof} Put \begin{equation} W = x^2 . \end{equation} \end{proof} \begin{lemma} For every function $W$ we "
    r"have [[W \ge 0]] \end{lemma}",
    *(rf"{_W}{said}.{_HOLDS}" for said in ("Subsequently, $W$ denotes the second term alone", "Next, we pass to $-W$")),
    *(f"{said}. \n\n We have [[k x^2 \\ge 0]]" for said in ("Let $k$ be any real number", "We write $k$ for $-c$")),
    *(rf"\begin{{lemma}} {said}, it holds that [[k x^2 \ge 0]] \end{{lemma}}" for said in (
        "For every real $k$", r"For every $k \in \mathbb{R}$", "For all real numbers $x$ and $k$")),
    # another meaning
    "Superscripts denote components. \n\n We have [[x^2 \\ge 0]]",
    "Upper indices number the components. \n\n We have [[x^2 \\ge 0]]",
    "All angles are given in degrees. \n\n We have [[|\\sin x| \\le |x|]]",
    "In this section the variables are complex. \n\n We have [[x^2 \\ge 0]]",
    "Let now $x \\in \\mathbb{C}$ be the phasor of the current. \n\n We have [[x^2 \\ge 0]]",
    "The matrices $x$ and $y$ collect the outputs. \n\n We have [[(x + y)^2 = x^2 + 2 x y + y^2]]",
    rf"{_PLANT} Here the dot denotes the difference quotient. {_FALLS}",
    r"We have \begin{align} x^2 &\ge 0 \tag{T} \\ \intertext{is not true for matrices, and so} y^2 &\ge 0 \end{align}",
    # another plant
    *(rf"{_PLANT}\section{{Analysis}} {said} {_FALLS}" for said in (
        "The sign of the feedback is positive here.", "The plant is the inverse of the one above.",
        "In addition, a second disturbance $z$ acts on the plant.", "Let us include the friction force in the model.",
        r"The plant is now given by \begin{equation} \ddot y = -k y . \end{equation}",
        r"We turn to the plant $\dot y = k y$.")),
    rf"{_PLANT}\section{{Extension}} {_FALLS}",
    f"{_LAW}The actuator of the second axis is faulty.\n\nThe closed loop is [[\\dot x = -k x + d]]",
    rf"{_PLANT} A second motor adds its torque, which has to be added on the right-hand side of the model." "\n\n"
    rf"{_FALLS}",
    # another kind
    *(rf"Let $c \in \mathbb{{R}}$ be the constant set-point. {_PLANT} Put $e = y - c$." "\n\n" f"{said}"
      "\n\nThen [[\\dot e = -k y]]" for said in ("Now the set-point rises.", "Now let $c$ be a function of time.")),
    "In this section $k$ is an arbitrary real number. \n\n We have [[k x^2 \\ge 0]]",
    r"Let $c, \hat c \in \mathbb{R}$. The law is \begin{equation} u = -a x - c x . \end{equation}" "\n\n"
    r"Here the term is computed with $\hat c$ for $c$." "\n\n" r"The closed loop is [[\dot x = -c x + d]]",
    *(f"{_LAW}{said}." "\n\nThe closed loop is [[\\dot x = -k x + d]]" for said in (
        "The actuator has a dead zone", "The wires of the motor have the wrong polarity",
        "The measured state is $x + z$")),
    *(rf"{_PLANT} {said}. {_FALLS}" for said in (
        "The pivot is now shaken vertically", "In what follows time runs backwards",
        "Derivatives are taken with respect to the distance")),
    # what is assumed no longer
    rf"{_BOUND} In this section $d$ may grow without bound." "\n\nWe have [[d^2 \\le k^2]]",
    rf"{_BOUND} Heavy rain may invalidate Assumption~\ref{{bound}}." "\n\nWe have [[d^2 \\le k^2]]",
    rf"{_BOUND} In this section Assumption~\ref{{bound}} is not needed." "\n\nWe have [[d^2 \\le k^2]]",
)
UNREFUTED = (
    "The choice of the gains gives [[k \\ge 2 \\gamma]]",
    *(rf"{said} \section{{Analysis}} We have [[x^3 \ge 0]]" for said in (
        "The states are positive, as they are concentrations.", "The tank levels cannot fall below zero.",
        "The train moves forward only.", "The motion takes place within the first quadrant.",
        r"\begin{tabular}{l} $x \ge 0$ \end{tabular}")),
    r"We have [[x^3 \ge 0]] \begin{remark} Negative values are excluded here. \end{remark}",
)
KEPT = (
    rf"{_W}It is used in the analysis.{_HOLDS}", rf"{_W}{_HOLDS} \section{{Conclusion}} A controller was presented.",
    rf"{_PLANT}\section{{Analysis}} Let us recall the model. {_FALLS}",
    rf"{_BOUND} By Assumption~\ref{{bound}}, we have [[d^2 \le k^2]]",
    r"The motion is described by \begin{equation} \dot y = - k y + z , \end{equation} where $y \in \mathbb{R}$ is the "
    r"slip of the wheelset and $z \in \mathbb{R}$ is the traction torque. We have "
    r"[[\frac{d}{dt} y^2 = - 2 k y^2 + 2 y z]]",
    r"We propose the control law \begin{equation} u = -k x - a x + z , \end{equation} where $z \in \mathbb{R}$ is an "
    r"input generated by \begin{equation} \dot z = - k z . \end{equation} Then [[\dot x = -k x + z + d]]",
    r"The DC motor obeys \begin{equation} \dot y = -k y . \end{equation} Then "
    r"[[\frac{d}{dt} y^2 = -2 k y^2]]",
    r"Let $c \in \mathbb{R}$ be the constant set-point and $e = x - c$ the control error. "
    r"We have [[e^2 = x^2 - 2 c x + c^2]]",
    r"Let $e = x - y$ denote the tracking error. We have [[e^2 = x^2 - 2 x y + y^2]]",
    r"The analysis is based on the function \begin{equation} W = x^2 . \end{equation} We have [[W \ge 0]]",
)

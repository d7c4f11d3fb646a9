r"""Texts whose words are all plain, and that give a value, a rate or a sign for a part of the motion or letters alone.

In NARROWED the formula in [[ ]] follows only where what is given is taken for more than it says. In SIGNED it holds by
the sign that the words say, which no table of letters takes over; in WHOLE it follows, however much is said besides.
"""

_LAW = r"\begin{equation} u = -a x - k x . \end{equation} Then [[\dot x = -k x + d]]"
_STILL = r"\begin{equation} u = -a x - d . \end{equation} We have [[\dot x = 0]]"
_MOVES = r"\begin{equation} \dot y = -y . \end{equation} We have [[\frac{d}{dt} y^2 = -2 y^2]]"
_W = r"\begin{equation} W = x^2 . \end{equation} "
_HOLDS = r"We have [[W \ge 0]]"
_TWICE = (r"\begin{equation} \dot y = -y %s\end{equation} %s \begin{equation} \dot y = -2 y . \end{equation} We have "
          r"[[\frac{d}{dt} y^2 = -2 y^2]]")

NARROWED = (
    *(f"{words} {_W}{_HOLDS}" for words in (
        "Up to a constant,", "Adding up to the third term,", "At high speed,", "The maximum of the energy is",
        "The contribution of friction to $W$ is", "The last summand of $W$ is", "The numerator of $W$ is",
        "The growth of $W$ is given by", "The coefficient of $W$ is", "The standard form is", "A half of the energy is",
        "Half of the energy is given by", "Twice the energy is given by", "Two of the three functions are",
        "The weight of the energy is", "Compare the energy with")),
    r"On the sliding surface, \begin{equation} y = x . \end{equation} Then [[x y \ge 0]]",
    *(f"{words} {_STILL}" for words in (
        "For constant speed the force is", "The average input is", "The mean value of $u$ is",
        "During the first period the control law is")),
    *(f"{words} {_MOVES}" for words in (
        "The equation of motion at the start is", "The open-loop system is",
        "The dynamics of the second subsystem in the second mode are")),
    f"The input is the sampled value of {_LAW}", f"The feedforward is given by {_LAW}",
    "The switched system is given by " + _TWICE % (". ", "and by"),
    "The linear model is " + _TWICE % (". ", "The nonlinear model is"),
    "The model of the first machine is " + _TWICE % (". ", "The model of the second machine is"),
    f"Let us start with the function {_W} Next we subtract the square of $y$. {_HOLDS}",
    f"Take {_W} Scale it by a number. {_HOLDS}",
    f"Let {_W} Adding $-y^2$ to $W$ gives the final function. {_HOLDS}",
    _LAW.replace("Then", "The actuator adds friction to the input. Then"),
    r"The gains $k$, $\gamma$ change at each step. Consider \begin{equation} \dot y = -y . \end{equation} We have "
    r"[[\frac{d}{dt} (k y) = -k y]]",
    r"\begin{assumption}[relaxed below] $|d| \le k$. \end{assumption} We have [[d^2 \le k^2]]",
)
SIGNED = (
    r"Throughout the first experiment $z$ is a positive constant. We obtain [[z k > 0]]",
    r"The signal $z$ is the positive square root of $x$. We have [[z^3 k > 0]]",
    r"\footnote{The constant $z$ is positive.} We have [[z k > 0]]",
    r"\caption{The constant $z$ is positive.} We have [[z k > 0]]",
    r"The product $z k$ is positive. We have [[z^3 > 0]]",
    r"One of $y$ and $z$ is positive and so is the other. We have [[y z > 0]]",
    r"In the second mode, the gain $z$ is a positive constant. We have [[z k > 0]]",
)
WHOLE = (
    f"The energy of the plant is given by {_W}{_HOLDS}", f"As a first step, consider the function {_W}{_HOLDS}",
    f"For the stability analysis, we introduce the function {_W}{_HOLDS}",
    f"In the second step, we choose the control law {_LAW}", f"The dynamics of the filter are {_MOVES}",
    r"\begin{assumption}[Matching condition] The disturbance obeys $|d| \le k$. \end{assumption} Then [[d^2 \le k^2]]",
    r"Define $U = x^2 + \ldots$. We have [[x^2 \ge 0]]",
)

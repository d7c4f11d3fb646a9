r"""Plants of second order as papers print them, with a law, a function and its rate in [[ ]].

In TRUE it follows from the motion that is printed, in FALSE it does not, in NEITHER the motion is not known.
"""


def _cart(motion, said="The cart is modelled by"):
    return (rf"{said} \begin{{equation}} {motion} , \end{{equation}} where $x \in \mathbb{{R}}$ is the position, $u$ "
            r"is the input and $m, d, k > 0$ are constants. ")


_V = r"Let \begin{equation} V = \frac12 m \dot x^2 + \frac12 k x^2 . \end{equation} "
_DAMPING = r"The control law is \begin{equation} u = -c \dot x \end{equation} with a constant $c > 0$. "
_SPRING = r"The control law is \begin{equation} u = -k x - c \dot x \end{equation} with a constant $c > 0$. "
_RATE = r"Then [[\dot V = -(d + c) \dot x^2]]"
_ERROR = (r"\begin{equation} \ddot e + a \dot e + b e = 0 , \end{equation} where $e \in \mathbb{R}$ and $a, b > 0$ are "
          r"constants. Let \begin{equation} W = \frac12 \dot e^2 + \frac12 b e^2 . \end{equation} ")
TRUE = (
    *(_cart(motion) + _SPRING + _V + _RATE for motion in (
        r"m \ddot x + d \dot x = u", r"m \ddot{x} = u - d \dot{x}", r"\ddot x = \frac{u - d \dot x}{m}")),
    *(_cart(motion) + _DAMPING + _V + _RATE for motion in (
        r"m \ddot x + d \dot x + k x = u", r"- k x + m \ddot x = u - d \dot x - 2 k x",
        r"k x + m \ddot x + d \dot x = u", r"m \ddot x + d \dot x + k x - u = 0", r"-m \ddot x = d \dot x + k x - u",
        r"u - m \ddot x = d \dot x + k x", r"m \ddot x(t) + d \dot x(t) + k x(t) = u(t)")),
    rf"The error dynamics are {_ERROR}Then [[\dot W = -a \dot e^2]]",
)
FALSE = (
    *(_cart(motion) + _SPRING + _V + _RATE for motion in (
        r"m \ddot x - d \dot x = u", r"m \ddot x + d |\dot x| \dot x = u")),
    *(_cart(motion) + _DAMPING + _V + _RATE for motion in (
        r"- k x + m \ddot x = u - d \dot x", r"m \ddot x + d \dot x - k x = u", r"m \ddot x + d \dot x + k x + u = 0",
        r"m \ddot x = d \dot x + k x - u", r"2 m \ddot x + d \dot x + k x = u", r"m \ddot x + d \dot x + k x^3 = u",
        r"\frac{m}{2} \ddot x + d \dot x + k x = u")),
)
NEITHER = (
    *(_cart(motion) + _DAMPING + _V + _RATE for motion in (
        r"m \ddot x + d \dot x + k x = u + \ddot x", r"m \ddot x + d \dot x + k x \approx u",
        r"m \ddot x \dot x + d \dot x + k x = u", r"m \ddot x + d \dot x + k x = u \quad (x > 0)")),
    *(_cart(r"m \ddot x + d \dot x + k x = u", said) + _DAMPING + _V + _RATE for said in (
        "The reference model is", "The load is modelled by")),
    _cart(r"m \ddot x + d \dot x + k x = u") + r"Let $\dot x$ denote the measured speed. " + _DAMPING + _V + _RATE,
    r"The position obeys \begin{equation} \dot x = w . \end{equation} " + _cart(
        r"m \ddot x + d \dot x + k x = u") + _DAMPING + _V + _RATE,
    rf"The aim is the closed loop {_ERROR}Then [[\dot W = -a \dot e^2]]",
    rf"The model without friction is {_ERROR}Then [[\dot W = -a \dot e^2]]",
)

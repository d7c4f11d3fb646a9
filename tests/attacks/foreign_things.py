r"""Plain short papers whose formula in [[ ]] is given, or told, of something else than the plant and its own law.

In FOREIGN it follows only where a subject, a word beside it or a sentence between counts as the plant's by its shape.
In CONSTRAINED it holds for the motion that words tell of, and for other values not. In PLAIN it follows, in FALSE not.
"""

_LETTERS = r"Let $x, u, d \in \mathbb{R}$ and let $k, c$ be positive constants. "
_PLANT = rf"{_LETTERS}The plant is \begin{{equation}} \dot x = c x + u . \end{{equation}} "
_LAW = r"\begin{equation} u = -c x - k x . \end{equation} "
_LOOP = r"Then [[\dot x = -k x]]"
_W = r"\begin{equation} W = x^2 + d^2 . \end{equation} "

SUBJECTS = (
    "The controller of the leader is", "The static controller is", "The desired input is", "The measured force is",
    "The filtered command is", "The virtual control is", "The previous controller was", "The leader is",
    "The nominal input is", "The ideal controller is", "The controller of the competitor is given by",
    "The thermostat is", "Our baseline is", "A possible controller is", "The feedback of the inner loop is",
    "The control law for the second input is", "The input of the filter is", "The input of the linear model is",
    "The proportional part of the controller is", "The equivalent control is", "In the first case, the controller is",
    "If the battery is full, the controller is", "Approximately, the controller is", "The mean control input is",
    "The driver chooses", "The reference input is",
)
BETWEEN = (
    "The controller acts on the estimate.", "All signals of this paper are filtered.", "The input rate is limited.",
    "Here $u$ denotes the estimate of the input.", "The control law is used for the second train.",
    "The law holds in the left half of the plane.", "The position of the second car is $x$.",
    "Here $x$ is the deviation of the sensor.", "This law is applied during braking.",
    "The model neglects the drag.", "The controller is the one of the leader.",
)
FOREIGN = (
    *(f"{_PLANT}{subject} {_LAW}{_LOOP}" for subject in SUBJECTS),
    *(f"{_PLANT}The control law is {_LAW}{said} {_LOOP}" for said in BETWEEN),
    rf"{_LETTERS}The model of the observer is \begin{{equation}} \dot x = -c x . \end{{equation}} We have "
    r"[[x \dot x = -c x^2]]",
    rf"{_LETTERS}The reference model is \begin{{equation}} \dot x = -c x . \end{{equation}} We have "
    r"[[x \dot x = -c x^2]]",
    rf"{_LETTERS}The Lyapunov function is {_W}The supply voltage $W$ is unknown. We get [[W \ge 0]]",
    rf"{_LETTERS}The Lyapunov function is {_W}In what follows $W$ stands for the voltage. We get [[W \ge 0]]",
    rf"{_LETTERS}The storage function of the first link is {_W}For the second link we have [[W \ge 0]]",
    rf"{_LETTERS}The rocket obeys \begin{{equation}} c \dot x = u . \end{{equation}} Its mass decreases. Let "
    r"$p = c x$. Then [[\dot p = u]]",
    *(rf"{_LETTERS}{motion} \begin{{equation}} \dot x = -c x . \end{{equation}} Let \begin{{equation}} W = x^2 . "
      rf"\end{{equation}} {said} [[\dot W = -2 c x^2]]" for motion, said in (
          ("The filter is", "Along the plant,"), ("The error dynamics are", "Along the plant, we get"),
          ("The system is", "To first order,"), ("The system is", "In the new coordinates,"))),
    rf"{_PLANT}The control law is {_LAW}The state is measured every second. {_LOOP}",
)
CONSTRAINED = (
    *(rf"Let $x \in \mathbb{{R}}$. {said} [[x^3 \ge x]]" for said in (
        "Under Assumption 3,", "By (A1),", "With the numbers of Table 1,")),
    *(rf"Let $x, y \in \mathbb{{R}}$. {said} [[x > y]]" for said in (
        "By design,", "Kirchhoff's law gives", "The level is kept above the outlet. Thus", "The controller guarantees",
        "The loop is stable. Hence", "The pump is the stronger one. Hence", "Consequently the gain satisfies")),
    *(rf"{said} We have [[h \ge 0]]" for said in (
        r"Let $h \in \mathbb{R}$ be the level of the tank.", r"Let $h \in \mathbb{R}$ be the kinetic energy.",
        r"The distance $h \in \mathbb{R}$ is available.", r"The variable $h \in \mathbb{R}$ is a density.",
        r"The coefficient of friction is $h \in \mathbb{R}$.")),
    r"Let $F, a \in \mathbb{R}$ and let $m$ be a positive constant. We have [[F = m a]]",
    rf"{_PLANT}The previous controller was {_LAW}{_LOOP}",
    rf"{_PLANT}The proportional part of the controller is {_LAW}{_LOOP}",
    rf"{_PLANT}The control law is \begin{{equation}} u = -c x - k x \end{{equation}} for the left wheel. {_LOOP}",
    rf"{_LETTERS}The gain is $k = 1 + x^2$. Let $V = k x$. Then [[V = x]]",
)
PLAIN = (
    r"The system is \begin{equation} m \dot v = u - b v , \end{equation} where $v \in \mathbb{R}$ is the speed, $u$ is "
    r"the force, and $m, b > 0$ are constants. Let $v_r \in \mathbb{R}$ be the reference speed and define the error "
    r"\begin{equation} e = v - v_r . \end{equation} The controller is \begin{equation} u = m \dot v_r + b v - k e "
    r"\end{equation} with $k > 0$ constant. Let \begin{equation} V = \frac12 m e^2 . \end{equation} Then "
    r"[[\dot V = -k e^2]]",
    f"{_PLANT}The control law is {_LAW}{_LOOP}", f"{_PLANT}The PD controller is given by {_LAW}{_LOOP}",
    f"{_PLANT}We propose the following control law: {_LAW}Substituting the control law into the plant yields "
    r"[[\dot x = -k x]]",
    r"Let $i, v, u \in \mathbb{R}$ and let $L, C, G$ be positive constants. The converter is described by "
    r"\begin{equation} L \dot i = -v + u, \quad C \dot v = i - G v . \end{equation} The total stored energy is "
    r"\begin{equation} H = \frac12 L i^2 + \frac12 C v^2 . \end{equation} Its derivative is [[\dot H = -G v^2 + u i]]",
    r"Let $z, w, T \in \mathbb{R}$ and let $m, g, k$ be positive constants. The altitude dynamics of the quadrotor are "
    r"\begin{equation} \dot z = w, \quad m \dot w = T - m g . \end{equation} The thrust is chosen as "
    r"\begin{equation} T = m g - k z - w . \end{equation} Hence [[m \dot w = -k z - w]]",
    r"Let $T, q \in \mathbb{R}$ and let $C, h, k$ be positive constants. The room temperature obeys \begin{equation} "
    r"C \dot T = -h T + q . \end{equation} The control input is \begin{equation} q = -k T . \end{equation} So "
    r"[[C \dot T = -(h + k) T]]",
    r"Let $x, \hat x \in \mathbb{R}$ and let $a, l$ be positive constants. The plant is \begin{equation} \dot x = -a x "
    r"\end{equation} The observer is \begin{equation} \dot{\hat x} = -a \hat x + l (x - \hat x) . \end{equation} The "
    r"observation error is \begin{equation} e = x - \hat x . \end{equation} Then [[\dot e = -(a + l) e]]",
)
FALSE = (
    f"{_PLANT}The control law is {_LAW}" r"Then [[\dot x = -2 k x]]",
    r"Let $x, y \in \mathbb{R}$. We have [[x^2 + y^2 \ge 3 x y]]",
)

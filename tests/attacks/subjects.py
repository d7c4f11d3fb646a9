r"""Texts that give a plant, a law or a function by words, of which one makes another thing of it, and plain ones.

In each a formula follows that is true where what is given counts for the plant of the paper. In OTHER it does not:
it is of another thing, of a part, of some values, or is taken back; in PLAIN it does.
"""

MODEL = r"%s \begin{equation} \dot x = -a x, \end{equation} where $a > 0$ is a constant and $x \in \mathbb{R}$. "
PLANT = (r"The system is \begin{equation} \dot x = -a x + u, \end{equation} where $x \in \mathbb{R}$ is the state, $u$ "
         r"is the input, and $a, k > 0$ are constants. ")
LAW = r"\begin{equation} u = -k x. \end{equation} "
FALLS = r"Let $V = \frac12 x^2$. Then [[\dot V = -a x^2.]]"
LOOP = r"The closed loop is [[\dot x = -(a + k) x.]]"
SQUARES = (r"Let $x, y \in \mathbb{R}$. %s \begin{equation} W = x^2 + y^2. \end{equation} %s We have [[W \ge 0.]]")

_PLANTS = (
    "The model of the observer is", "The desired error dynamics are", "The leader is described by",
    "The healthy plant is", "The virtual system is", "The mean state obeys", "The speed of the wind obeys",
    "The second train obeys",
    "The system without friction is", "Approximately, the system obeys", "In the rotating frame the machine is",
    "The plant model used by the controller is", "The plant is replaced by", "The plant for $x > 0$ is")
_LAWS = (
    "The controller of the leader is", "The static controller is", "The desired input is", "The measured input is",
    "The previous controller is", "The filtered control is", "The control of the observer is",
    "The second control law is", "The usual feedback is", "On average, the control law is",
    "In the first case the control law is",
    "At equilibrium the input is", "The control law is bounded by", "We reject the control law",
    "The control law for $x > 0$ is", "Let us look at the leader. The control law is", "Leader. The control law is",
    "The desired behaviour is as follows.", r"\section{Static control} The control law is",
    r"\subsection{Observer} The control law is", r"\begin{itemize} \item[Leader] \end{itemize} The control law is")
_BEHIND = (
    "It holds for the leader.", "It is used in the first mode.", "The input is rate limited.", "Its mean is applied.",
    "The output $x$ is filtered.", "Here $u$ is the output of the actuator.", "The observer provides $x$.",
    "An integrator is inserted before the plant.", "A lag of the actuator is present.", "Our own law comes later.")
_WITH = ("where $x$ is the state of the observer", "where $x$ is the measured state", "with the estimate $x$",
         "where $k$ is the gain of the leader")
OTHER = (
    *(MODEL % words + FALLS for words in _PLANTS), *(f"{PLANT}{words} {LAW}{LOOP}" for words in _LAWS),
    *(f"{PLANT}The control law is {LAW}{words} {LOOP}" for words in _BEHIND),
    *(f"{PLANT}The control law is {LAW.replace('x.', 'x')}{words}. {LOOP}" for words in _WITH),
    *(f"{PLANT}{words} {LOOP}" for words in (
        "The desired input is $u = -k x$.", "Let $u = -k x$ be the input of the leader.",
        "Denote by $u = -k x$ the measured input.", rf"\begin{{proof}} Put {LAW} \end{{proof}}")),
    *(MODEL % "The system is" + FALLS.replace("Then", words) for words in (
        "Along the observer,", "Along the reference trajectory we have", "In the mean,", "For the plant with delay")),
    *(SQUARES % pair for pair in (
        ("The negative of the energy is", ""), ("The energy of the leader is", ""), ("For $x > y$ the energy is", ""),
        ("The energy is", "In the sequel $W$ is the voltage of the source."),
        ("The energy is", "The symbol $W$ is also used for the elastic modulus of the beam."))),
)
# What holds by what the words say, and is false by itself.
HELD = tuple(rf"Let $x, y \in \mathbb{{R}}$. {words} [[{line}]]" for words, line in (
    ("By symmetry,", "x = y."), ("The coupling gives", "x = y."), ("By design we have", r"x y \ge 0."),
    ("The level satisfies", r"x \ge 0."), ("The hull is safe. We have", r"x^2 + y^2 \le 1.")))
PLAIN = (
    *(MODEL % words + FALLS for words in (
        "The plant is", "The dynamics of the system are", "The temperature of the oven satisfies",
        "The cart moves according to", "The concentration in the reactor obeys", "The error dynamics are",
        "The motor current satisfies")),
    *(f"{PLANT}{words} {LAW}{LOOP}" for words in (
        "The control law is", "We use the controller", "The controller reads", "The proposed controller is",
        "A linear controller is given by", r"\section{Controller design} We choose the control input")),
    *(SQUARES % pair for pair in (
        ("The energy is", ""), ("The Lyapunov function candidate is", "Here $W$ is the storage function."))),
)

r"""Texts in which a bound, a plant, a value or a gain is of another: for who overlooks that the line T follows.

Of each the verdicts that T must not get.
"""

PLANT = r"""Consider the system
\begin{equation} \dot x = a x + u + d, \label{p} \end{equation}
where $x\in\mathbb{R}$ is the state, $u$ is the input, $a$ is an unknown constant and $d(t)$ is a disturbance[[bound]].
The control law is
\begin{equation} u = -k x - \hat a x, \label{u} \end{equation}
where $k>0$ and $\hat a$ is the estimate of $a$, updated by
\begin{equation} \dot{\hat a} = \gamma x^2, \label{ad} \end{equation}
with $\gamma>0$. Let $\tilde a = a - \hat a$ and
\begin{equation} V = \frac12 x^2 + \frac{1}{2\gamma}\tilde a^2. \label{V} \end{equation}
"""

BOUNDED = PLANT.replace("[[bound]]", r" satisfying $|d(t)| \le D$ with a constant $D > 0$")
FREE = PLANT.replace("[[bound]]", "")

ATTACKS = {
    "bound_example": (FREE + r"""
Let $D>0$ be a constant. In this example, $d(t)$ is a disturbance satisfying $|d(t)|\le D$. In general,
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_if": (FREE + r"""
Let $D>0$ be a constant. If $d$ is a disturbance satisfying $|d(t)|\le D$, the loop is stable. For all disturbances
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_not": (FREE + r"""
Let $D>0$ be a constant. Earlier papers need that $d(t)$ is a disturbance satisfying $|d(t)|\le D$. We have
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_rem": (FREE + r"""
Let $D>0$ be a constant.
\begin{remark} If wished, $d(t)$ is a disturbance satisfying $|d(t)|\le D$. \end{remark}
We have
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_rem2": (FREE + r"""
Let $D>0$ be a constant.
\begin{remark} Here $d(t)$ is a disturbance satisfying $|d(t)|\le D$. \end{remark}
We have
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_drop": (BOUNDED + r"""
The bound on $d$ is now dropped. Then
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_drop2": (BOUNDED + r"""
\section{Unbounded disturbances}
We have
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_conf": (BOUNDED + r"""
The bound holds for half of the time. Then
\begin{equation} \dot V \le -k x^2 + D |x|. \tag{T} \end{equation}
""", ("proved",)),
    "bound_later": (FREE + r"""
Then
\begin{equation} \dot V \le -k x^2 + D|x|, \tag{T} \end{equation}
where $D>0$ is a constant. In the second experiment, $d(t)$ is a disturbance satisfying $|d(t)| \le D$.
""", ("proved",)),
    "bound_two": (BOUNDED + r"""
Then
\begin{equation} \dot V \le -k x^2 + \frac12 D|x|. \tag{T} \end{equation}
\section{Another plant}
There, $d(t)$ is a disturbance satisfying $|d(t)| \le \frac12 D$.
""", ("proved",)),
    "bound_lemma": (FREE + r"""
\begin{lemma} Let $D$ be a positive constant and let $z$ be a constant with $|z|\le 1$. Then $z^2 \le 1$.
\end{lemma}
Let $z\in\mathbb{R}$. We have
\begin{equation} z^2 \le 1. \tag{T} \end{equation}
""", ("proved",)),
    "where_claim": (FREE + r"""
Let $z\in\mathbb{R}$. We have
\begin{equation} z^2 \le z, \tag{T} \end{equation}
where $z \le 1$.
""", ("proved", "refuted")),
    "where_claim2": (FREE + r"""
Let $w, z\in\mathbb{R}$. We have
\begin{equation} w \le z, \tag{T} \end{equation}
where $w^3 \le z^3$. The auxiliary signal is
\begin{equation} y = w^2. \end{equation}
""", ("refuted",)),
    "gain_cond_late": (BOUNDED + r"""
Then
\begin{equation} \dot V \le -k x^2 + D |x| - x^2. \tag{T} \end{equation}
""", ("proved",)),
    "scalar_vec": (r"""
Consider the system
\begin{equation} \dot x = A x + u, \label{p}\end{equation}
where $x\in\mathbb{R}^n$ is the state, $u$ is the input and $A$ is a constant matrix. Let $y\in\mathbb{R}$ and let
$\phi$ be the regressor and $W$ the constant weights. We have $y = 1$. Then
\begin{equation} W\phi = \phi W. \tag{T} \end{equation}
""", ("proved", "refuted")),
    "int": (r"""
Let $x\in\mathbb{R}$ be a number and let $n$ be an integer. Let $y = x + n$. Then
\begin{equation} n \le n^2. \tag{T} \end{equation}
""", ("refuted",)),
    "tv_gain": (r"""
Consider the system
\begin{equation} \dot x = -k x + u, \label{p}\end{equation}
where $x\in\mathbb{R}$ is the state, $u\in\mathbb{R}$ is the input and $k>0$ varies. The function
\begin{equation} V = \frac{k}{2} x^2 \end{equation}
is used. The derivative is
\begin{equation} \dot V = -k^2 x^2 + k x u. \tag{T} \end{equation}
""", ("proved",)),
    "tv_gain2": (r"""
Consider the system
\begin{equation} \dot x = -k x + u, \label{p}\end{equation}
where $x\in\mathbb{R}$ is the state, $u\in\mathbb{R}$ is the input and $k>0$. Here $k$ is a time-varying gain. The
function
\begin{equation} V = \frac{k}{2} x^2 \end{equation}
is introduced. The derivative is
\begin{equation} \dot V = -k^2 x^2 + k x u. \tag{T} \end{equation}
""", ("proved",)),
    "tv_gain3": (r"""
Consider the system
\begin{equation} \dot x = -k x + u, \label{p}\end{equation}
where $x\in\mathbb{R}$ is the state, $u\in\mathbb{R}$ is the input and $k>0$. The function
\begin{equation} V = \frac{k}{2} x^2 \end{equation}
is introduced. The derivative is
\begin{equation} \dot V = -k^2 x^2 + k x u, \tag{T} \end{equation}
since the stiffness $k$ changes slowly.
""", ("proved",)),
    "V_two": (r"""
Consider the system $\dot x = -x + w$, where $x\in\mathbb{R}$ is the state and $w\in\mathbb{R}$ is an input. Let
\begin{equation} V(x) = \frac12 x^2. \end{equation}
At the reference we have $V(r)$ with $r \in \mathbb{R}$. The derivative of $V$ along the trajectories of the system
is
\begin{equation} \dot V = -x^2. \tag{T} \end{equation}
""", ("proved",)),
    "inline2": (r"""
Consider the system $\dot x = -x$, where $x\in\mathbb{R}$ is the state. Consider the system $\dot x = x$. Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V = -x^2. \tag{T} \end{equation}
""", ("proved", "refuted")),
    "inline_nominal": (r"""
Consider the nominal system $\dot x = -x$, where $x\in\mathbb{R}$ is the state. The true plant has friction. Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V = -x^2. \tag{T} \end{equation}
""", ("proved",)),
    "inline_desired": (r"""
We want the system $\dot x = -x$, where $x\in\mathbb{R}$ is the state. Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V = -x^2. \tag{T} \end{equation}
""", ("proved",)),
    "proofV": (FREE + r"""
\begin{theorem} $x$ is bounded. \end{theorem}
\begin{proof} Consider the function $W = x^2$. \end{proof}
Let $W\in\mathbb{R}$. Then
\begin{equation} W \ge 0. \tag{T} \end{equation}
""", ("proved",)),
    "proofV2": (FREE + r"""
\begin{lemma} True. \end{lemma}
\begin{proof} Consider the function $W = x^2$. \end{proof}
\begin{lemma} False. \end{lemma}
\begin{proof} Let $W$ be a real constant. We have
\begin{equation} W \ge 0. \tag{T} \end{equation}\end{proof}
""", ("proved",)),
    "suits": (FREE + r"""
The ideal gains $c$ and $q$ satisfy $c = 2 q$. Let $c, q\in\mathbb{R}$. In practice the gains differ. Then
\begin{equation} c - 2 q = 0. \tag{T} \end{equation}
""", ("proved",)),
    "suits_not": (FREE + r"""
The gains $c$ and $q$ do not satisfy the matching conditions $c = 2 q$. Let $c, q\in\mathbb{R}$. Then
\begin{equation} c - 2 q = 0. \tag{T} \end{equation}
""", ("proved", "refuted")),
    "obs_heading": (r"""
\section{Observer design}
The observer is
\begin{equation} \dot x = -x + y, \end{equation}
where $x\in\mathbb{R}$ is the estimate and $y\in\mathbb{R}$ is the output. Consider
\begin{equation} V = \frac12 x^2. \end{equation}
Then along the plant
\begin{equation} \dot V = -x^2 + x y. \tag{T} \end{equation}
""", ("proved",)),
    "const_sign_moves": (r"""
Consider the system
\begin{equation} \dot x = -p x, \label{p}\end{equation}
where $x\in\mathbb{R}$ is the state and $p>0$. The adaptive parameter $p$ is increased by the supervisor. The
function
\begin{equation} V = p x^2 \end{equation}
is introduced. The derivative is
\begin{equation} \dot V = -2 p^2 x^2. \tag{T} \end{equation}
""", ("proved",)),
    "bounded_state": (FREE + r"""
Here $x$ is a state satisfying $|x| \le 1$. Then
\begin{equation} x^4 \le x^2. \tag{T} \end{equation}
""", ("proved", "refuted")),
    "sat": (r"""
Consider the system
\begin{equation} \dot x = u, \label{p}\end{equation}
where $x\in\mathbb{R}$ is the state and $u$ is the input satisfying $|u| \le 1$. The control law is
\begin{equation} u = -k x, \end{equation}
with $k>0$. Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V = -k x^2. \tag{T} \end{equation}
""", ("proved",)),
    "quant_int": (r"""
\begin{lemma} For any $n\in\mathbb{R}$, we have $n^2 \ge 0$. \end{lemma}
Let $n$ be the number of cars. Then
\begin{equation} n^2 \ge n. \tag{T} \end{equation}
""", ("refuted",)),
    "quant_other2": (r"""
\begin{lemma} For any $a\in\mathbb{R}$ and any $\epsilon>0$, we have $a \le a + \epsilon$. \end{lemma}
The fault $\epsilon$ acts on the sensor. Let $c\in\mathbb{R}$. Then
\begin{equation} c + \epsilon \ge c. \tag{T} \end{equation}
""", ("proved",)),
    "taking3": (r"""
Let $x\in\mathbb{R}$ and let $V\in\mathbb{R}$. For $V = x^2$ we obtain
\begin{equation} V + 1 \ge 1. \end{equation}
Also,
\begin{equation} V \ge 0. \tag{T} \end{equation}
""", ("proved",)),
    "for_equil": (r"""
Consider the system
\begin{equation} \dot x = -x + u, \end{equation}
where $x\in\mathbb{R}$ is the state and $u\in\mathbb{R}$ is the input. For $u = -x$ we obtain
\begin{equation} \dot x = -2x. \end{equation}
Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V = -2x^2. \tag{T} \end{equation}
""", ("proved",)),
    "fun_two": (r"""
Consider the system
\begin{equation} \dot x = f(x) + u, \end{equation}
where $x\in\mathbb{R}$ is the state, $u$ is the input and $f(x)$ is an unknown function. The input is
\begin{equation} u = -\hat f(x) - k x, \end{equation}
where $k>0$ and $\hat f(x)$ is the approximation of $f(x)$. Then
\begin{equation} \dot x = -k x. \tag{T} \end{equation}
""", ("proved",)),
    "fun_rate": (r"""
Consider the system
\begin{equation} \dot x = f(x) + u, \end{equation}
where $x\in\mathbb{R}$ is the state, $u\in\mathbb{R}$ is the input and $f(x)$ is a smooth function. Let
\begin{equation} z = x + f(x). \end{equation}
Then
\begin{equation} \dot z = f(x) + u. \tag{T} \end{equation}
""", ("proved",)),
    "fun_prop": (r"""
Consider the system
\begin{equation} \dot x = -f(x), \end{equation}
where $x\in\mathbb{R}$ is the state and $f(x)$ is a smooth function. The function lies in the first and third
quadrant. Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V \le 0. \tag{T} \end{equation}
""", ("refuted", "proved")),
    "fun_prop3": (r"""
Consider the system
\begin{equation} \dot x = -f(x), \end{equation}
where $x\in\mathbb{R}$ is the state and $f(x)$ is an odd increasing function. Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V \le 0. \tag{T} \end{equation}
""", ("refuted",)),
    "fun_pos": (r"""
Consider the system
\begin{equation} \dot x = -g(x) x, \end{equation}
where $x\in\mathbb{R}$ is the state and $g(x)$ is a positive function. Let
\begin{equation} V = \frac12 x^2. \end{equation}
Then
\begin{equation} \dot V \le 0. \tag{T} \end{equation}
""", ("refuted",)),
    "mode": (r"""
Consider the system
\begin{equation} \dot x = -\sigma x, \end{equation}
where $x\in\mathbb{R}$ is the state and $\sigma$ is the switching signal. Then
\begin{equation} \sigma^2 = \sigma. \tag{T} \end{equation}
""", ("refuted",)),
    "prob": (r"""
Let $y\in\mathbb{R}$ and let $p$ be the probability of a loss. Let $z = y + p$. Then
\begin{equation} p \le 1. \tag{T} \end{equation}
""", ("refuted",)),
    "mass": (r"""
Consider the car
\begin{equation} m \dot v = u - c v, \end{equation}
where $v\in\mathbb{R}$ is the speed, $u\in\mathbb{R}$ is the force, $m$ is the mass and $c$ is the friction
coefficient. Let
\begin{equation} V = \frac{m}{2} v^2. \end{equation}
Then
\begin{equation} \dot V \le u v. \tag{T} \end{equation}
""", ("refuted",)),
    "nonzero": (r"""
Consider the system
\begin{equation} \dot x = b u, \end{equation}
where $x\in\mathbb{R}$ is the state, $u\in\mathbb{R}$ is the input and $b\neq 0$ is a known constant. Let
$c\in\mathbb{R}$. Then
\begin{equation} b > 0. \tag{T} \end{equation}
""", ("proved",)),
}

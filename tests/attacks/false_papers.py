r"""Six manners to write the same paper, texts that claim nothing or something false, and true ones that claim.

In FALSE the formula in [[ ]] is taken back, doubted, wanted, said of some values alone, or rests on what is so; who
reads single words takes it, or what it needs, for claimed. In TRUE it is claimed, and true.
"""

HEADS = {
    "journal": r"""\documentclass[journal]{IEEEtran}\usepackage{amsmath,amsthm}
\newtheorem{theorem}{Theorem}\newtheorem{lemma}{Lemma}\newtheorem{remark}{Remark}\newtheorem{assumption}{Assumption}
\begin{document}
\section{Problem Formulation}
Consider the nonlinear system
\begin{equation} \dot x = a x + u + d \label{sys} \end{equation}
where $x \in \mathbb{R}$ is the state, $u$ denotes the control input, $a \in \mathbb{R}$ is an unknown constant
parameter and
$d \in \mathbb{R}$ is an external disturbance. The positive constants $k$ and $\gamma$ are design parameters. Let $y,
z \in \mathbb{R}$.
\section{Main Results}
""",
    "thesis": r"""\documentclass{report}\usepackage{amsmath}
\newtheorem{theorem}{Theorem}[chapter]\newtheorem{lemma}[theorem]{Lemma}\newtheorem{remark}{Remark}\newtheorem{assumption}{Assumption}
\begin{document}
\chapter{Introduction}
Adaptive control of vehicles has attracted the attention of many researchers over the last decades.
\chapter{Adaptive Control}
\section{System Description}
The motion of the vehicle is described by
\begin{equation} \dot x = a x + u + d \label{sys} \end{equation}
in which $x \in \mathbb{R}$ is the speed and $u$ is the input. Here $a \in \mathbb{R}$ is a constant, and $d \in
\mathbb{R}$ is the disturbance.
The gains $k > 0$ and $\gamma > 0$ are constants, and $y, z \in \mathbb{R}$ are real.
\section{Stability Analysis}
""",
    "notes": r"""\documentclass{article}\usepackage{amsmath}
\newtheorem{theorem}{Theorem}\newtheorem{lemma}{Lemma}\newtheorem{remark}{Remark}\newtheorem{assumption}{Assumption}
\begin{document}
\section{Lecture 4: backstepping}
Let $x, y, z, a, d \in \mathbb{R}$ and let $k, \gamma$ be positive constants. We study the system
\begin{equation} \dot x = a x + u + d . \label{sys} \end{equation}
""",
    "nonnative": r"""\documentclass{article}\usepackage{amsmath}
\newtheorem{theorem}{Theorem}\newtheorem{lemma}{Lemma}\newtheorem{remark}{Remark}\newtheorem{assumption}{Assumption}
\begin{document}
\section{The controlled system}
We consider following system
\begin{equation} \dot x = a x + u + d \label{sys} \end{equation}
where $x \in \mathbb{R}$ is state, $u$ is input, $a \in \mathbb{R}$ is unknown constant, $d \in \mathbb{R}$ is the
disturbance. The constants $k$, $\gamma$ are positive gains.
The variables $y, z \in \mathbb{R}$ are auxiliary.
\section{Analysis of the stability}
""",
    "twocolumn": r"""\documentclass[twocolumn]{article}\usepackage{amsmath}
\newcommand{\R}{\mathbb{R}}\newcommand{\beq}{\begin{equation}}\newcommand{\eeq}{\end{equation}}\def\half{\tfrac12}
\newtheorem{theorem}{Theorem}\newtheorem{lemma}{Lemma}\newtheorem{remark}{Remark}\newtheorem{assumption}{Assumption}
\begin{document}
\section{Preliminaries}
Throughout the paper, $x \in \R$ denotes the state, $y, z \in \R$ are signals, $a \in \R$ is a constant parameter,
$d \in \R$ is a disturbance and $k, \gamma > 0$ are constant gains.
\beq \dot x = a x + u + d \label{sys} \eeq
\section{Controller design}
""",
    "arxiv": r"""\documentclass[11pt]{amsart}
\newtheorem{theorem}{Theorem}[section]\newtheorem{lemma}[theorem]{Lemma}\newtheorem{remark}{Remark}\newtheorem{assumption}{Assumption}
\begin{document}
\section{Setup}
We write $x \in \mathbb{R}$ for the state and consider
$$ \dot x = a x + u + d, \leqno{(1)} $$
where $a \in \mathbb{R}$ is a constant and $d \in \mathbb{R}$ is the disturbance. Let $k$ and $\gamma$ be positive
constants and let $y, z \in \mathbb{R}$.
\section{Proof of the main theorem}
""",
}
FALSE = {
    "journal": (
        r"If the valve sticks, $z > 0$. Hence [[z^3 > 0]]",
        r"It would be a mistake to infer [[x^2 + z^2 \ge 2 x z]]",
        r"Were $z$ a positive constant, the proof would be shorter. We have [[z > -k]]",
        r"Smith \cite{s} asserts that $z > 0$. Therefore [[z k > 0]]",
        r"It is far from true that $z \ge 0$. Then [[z^3 + k > 0]]",
        r"Only for $y = z$ one has $y - z = 0$. It follows that [[y = z]]",
        r"Contrary to common belief, [[(x - z)^2 \ge 0]]",
        r"There are trajectories along which $z > 0$. Moreover, [[z + k > 0]]",
        r"\begin{lemma} Let $z$ be a positive constant. Then $z + k > 0$. \end{lemma} In view of this, [[z \gamma "
        r"> 0]]",
        r"From now on let $k$ stand for a negative number. Then [[k x^2 \ge 0]]",
        r"Suppose that \begin{equation} z > 0 . \end{equation} By this, [[z \gamma > 0]]",
        r"Let \begin{equation} V = x^2 . \end{equation} Now let \begin{equation} V = - x^2 . \end{equation} We "
        r"have [[V \ge 0]]",
        r"Let \begin{equation} V = x^2 . \end{equation} Further, let $V = - x^2$. We have [[V \ge 0]]",
        r"The desired inequality is [[x^2 \ge 0]]",
        r"The control objective is [[x^2 \ge 0]]",
        r"\[ z \ge 0 \] implies [[z^3 \ge 0]]",
        r"Under the condition \[ z \ge 0 \] we have [[z^3 \ge 0]]",
        r"Let \[ z \ge 0 . \] Then [[z^3 \ge 0]]",
        r"This is an error: [[x^2 \ge 0]]",
        r"\begin{align} x^2 &\ge 0 \\ \intertext{The next line is false.} \tag{T} y^2 &\ge 0 \end{align}",
        r"We obtain [[x^2 \ge 0]]"
        "\n"
        "\n"
        r"This is false.",
        r"\verb|It is false that| [[x^2 \ge 0]]",
        r"It is \sout{true} wrong that [[x^2 \ge 0]]",
        r"Let $z$ satisfy \begin{equation} z \ge 0 . \end{equation} Then [[z^3 \ge 0]]",
        r"The result holds for $z > 0$ and $z < 0$, respectively. Hence [[z^3 > 0]]",
    ),
    "thesis": (
        r"A tempting but flawed inequality is [[x^2 + 1 > 0]]",
        r"\section{Counterexamples} [[x^2 + z^2 \ge 0]]",
        r"Imagine that $z \ge 0$. We obtain [[z^3 \ge 0]]",
        r"The sign of $z$ is not known, though $z > 0$ at first. Hence [[z + \gamma > 0]]",
        r"In the simulations of the last chapter $z > 0$. Thus [[z^5 > 0]]",
        r"Had we chosen $z > 0$, then [[z^3 > 0]]",
        r"Let $z > 0$ in this paragraph alone."
        "\n"
        "\n"
        r"In general, [[z > -\gamma]]",
        r"\begin{proof} Let $z = x^2$. It is clear. \end{proof} Therefore [[z \ge 0]]",
        r"The following bound, claimed in the literature, breaks down. [[2 x z \le x^2 + z^2]]",
        r"One can hardly expect $z > 0$. Then [[z > -1]]",
    ),
    "notes": (
        r"True or false? [[x^2 \ge 0]]",
        r"Exercise. Show that the next line is nonsense. [[x^2 + y^2 \ge 2 x y]]",
        r"Say $z > 0$ for the sake of the argument. So [[z k > 0]]",
        r"Students often write [[(x + y)^2 \ge 0]]",
        r"Wrong: [[|x| \ge 0]]",
        r"$z>0$? We do not know. But then [[z + k > 0]]",
        r"Warning! The constant $z > 0$ of last week has another sign today. We have [[z k > 0]]",
        r"Pretend that $z$ is a positive constant. Then [[z \gamma > 0]]",
        r"``Clearly'', [[x^2 + \gamma > 0]]",
        r"We get [[x^2 \ge 0]] Oops, this cannot be.",
    ),
    "nonnative": (
        r"It has been not proved that [[x^2 + k > 0]]",
        r"In case of $z > 0$ is more easy. We have [[z + k > 0]]",
        r"By mistake of authors in earlier version stood [[k x^2 \ge 0]]",
        r"It lacks the condition that $z > 0$. Then [[z k > 0]]",
        r"We doubt the inequality [[y^2 + z^2 \ge 0]]",
        r"The variable $z > 0$ only in start. Hence [[z + 2 k > 0]]",
        r"It exists $z > 0$ with this property. So [[z^3 > -k]]",
        r"Such $z > 0$ is forbidden. It follows [[z k \ge 0]]",
        r"We get the contradiction [[x^2 \ge 0]]",
        r"Is wrong the next formula. [[(y - z)^2 \ge 0]]",
    ),
    "twocolumn": (
        r"\newcommand{\nope}{Nobody should believe that} \nope [[x^2 \ge 0]]",
        r"\textit{Fallacy.} [[y^2 \ge 0]]",
        r"Positive $z > 0$ will be excluded. Now [[z + k > 0]]",
        r"As \cite{r} erroneously has it, [[y^2 + k > 0]]",
        r"\footnote{The formula below is incorrect.} We have [[x^2 + y^2 \ge 0]]",
        r"We have [[x^2 + k \ge 0]]\footnote{Which is not so.} and this is all.",
        r"Assume the opposite, $z > 0$. Then [[z \ge 0]]",
        r"Equation (T) is due to a typo. We have [[z^2 \ge 0]]",
        r"\begin{quote} We have [[z^2 + y^2 \ge 0]] \end{quote}",
        r"\begin{remark} It is tempting to set $z = y^2$. \end{remark} It holds that [[z \ge 0]]",
    ),
    "arxiv": (
        r"A priori one might hope for $z>0$; this hope is vain. We have [[z > -k]]",
        r"Denote by $z > 0$ any number such that $z < y$ whenever there is one. Then [[z y \ge 0]]",
        r"\begin{itemize} \item[(a)] The following are fallacies: \item[(b)] [[x^2 \ge 0]] \end{itemize}",
        r"Everything below is conditional on a conjecture. We have [[x^2 + y^2 \ge 0]]",
        r"Arguing by contradiction, suppose $z > 0$. Then [[z + \gamma > 0]]",
        r"Unless $y = 0$, the constant $z > 0$ is useless. Hence [[z k > 0]]",
        r"We will disprove [[x^2 + \gamma > 0]]",
        r"In a parallel universe with $z \ge 0$, we obtain [[z^3 \ge 0]]",
        r"\begin{theorem} Suppose $z > 0$. Then $k z > 0$. \end{theorem} Consequently, [[k z > 0]]",
        r"We have [[k + \gamma > 0]] Alas, no.",
    ),
}
TRUE = {
    "journal": (
        r"By Young's inequality, we have [[x d \le \frac{k}{2} x^2 + \frac{1}{2k} d^2]]",
        r"Consider the Lyapunov function candidate \begin{equation} V = \frac12 x^2 \end{equation} It follows that "
        r"[[V \ge 0]]",
        r"Consider the Lyapunov function candidate \begin{equation} V = \frac12 x^2 \label{V}\end{equation} The "
        r"time derivative of $V$ along the trajectories of (\ref{sys}) is given by [[\dot V = a x^2 + x u + x d]]",
        r"The control law is designed as \begin{equation} u = -k x - a x . \label{u} \end{equation} Substituting "
        r"\eqref{u} into \eqref{sys} yields [[\dot x = -k x + d]]",
        r"Then, we can obtain that [[(x - y)^2 \ge 0]]",
        r"Noting that $k > 0$, it is easy to see that [[k x^2 \ge 0]]",
        r"\begin{lemma} For any $x, y \in \mathbb{R}$, the following inequality holds: [[2 x y \le x^2 + "
        r"y^2]]\end{lemma}",
        r"\begin{proof} Completing the squares, one obtains [[-k x^2 + x d \le \frac{1}{4k} d^2]] which completes "
        r"the proof. \end{proof}",
        r"Moreover, the cross term satisfies [[|x y| \le \frac12 x^2 + \frac12 y^2]]",
        r"Using the triangle inequality, we get [[|x + y| \le |x| + |y|]]",
    ),
    "thesis": (
        r"The tracking error is defined as \begin{equation} e = x - y . \end{equation} Squaring both sides gives "
        r"[[e^2 = x^2 - 2 x y + y^2]]",
        r"In order to prove stability, the energy function \begin{equation} W = x^2 + \gamma y^2 \end{equation} is "
        r"introduced. It is positive semidefinite, that is, [[W \ge 0]]",
        r"From the Cauchy--Schwarz inequality it follows immediately that [[(x + y)^2 \le 2 x^2 + 2 y^2]]",
        r"Since $k$ is positive, one finds [[-k x^2 \le 0]]",
        r"An upper bound of the mixed term is [[2 x y \le k x^2 + \frac{1}{k} y^2]]",
        r"Expanding the brackets, we arrive at [[(x + y)(x - y) = x^2 - y^2]]",
        r"This leads to the estimate [[x y \le \frac12 x^2 + \frac12 y^2]]",
        r"Next, a simple calculation shows that [[(x - k y)^2 = x^2 - 2 k x y + k^2 y^2]]",
        r"Hence the last term can be bounded as [[-k x^2 - \gamma y^2 \le 0]]",
        r"The function satisfies, for all $x \in \mathbb{R}$, [[x^2 + k > 0]]",
    ),
    "notes": (
        r"Clearly [[x^2 + y^2 \ge 0]]",
        r"So we have [[k x^2 \ge 0]]",
        r"Put \[ V = \tfrac12 x^2 + \tfrac12 y^2 . \] Then [[V \ge 0]]",
        r"Now complete the square: [[x^2 + 2 x y + y^2 = (x + y)^2]]",
        r"Recall that [[2 |x| |y| \le x^2 + y^2]]",
        r"Let us compute. [[(x + 1)^2 = x^2 + 2 x + 1]]",
        r"Note that [[|x|^2 = x^2]]",
        r"Take $V = \frac12 x^2$. Along solutions of (1), [[\dot V = x (a x + u + d)]]",
        r"By the binomial formula, [[(x + k)^2 = x^2 + 2 k x + k^2]]",
        r"And since $k, \gamma > 0$ we see that [[k x^2 + \gamma y^2 \ge 0]]",
    ),
    "nonnative": (
        r"We choose Lyapunov function as follows: \begin{equation} V = \frac12 x^2 . \end{equation} Then its "
        r"derivative is [[\dot V = a x^2 + x u + x d]]",
        r"According to Young inequality we have [[x y \le \frac12 x^2 + \frac12 y^2]]",
        r"It is obviously that [[k x^2 \ge 0]]",
        r"So, it can be got that [[x^2 + y^2 \ge 2 x y]]",
        r"Therefore, following inequality is obtained: [[|x y| \le x^2 + y^2]]",
        r"By using of the inequality $2ab \le a^2 + b^2$, one has [[2 x y \le x^2 + y^2]]",
        r"From above equation, we can get [[(x - y)^2 = x^2 - 2 x y + y^2]]",
        r"The control input is chosen as \begin{equation} u = - a x - k x \end{equation} then we can get [[\dot x "
        r"= -k x + d]]",
        r"Because $k > 0$, so [[-k x^2 \le 0]]",
        r"Based on the above analysis, we know [[\gamma y^2 \ge 0]]",
    ),
    "twocolumn": (
        r"Define \beq V = \half x^2 . \label{V} \eeq Differentiating \eqref{V} along \eqref{sys} gives [[\dot V = "
        r"a x^2 + x u + x d]]",
        r"With \beq u = -(a + k) x \eeq we have [[\dot x = -k x + d]]",
        r"where we have used [[2 x y \le x^2 + y^2]]",
        r"Hence, [[k x^2 + \gamma y^2 \ge 0]]",
        r"Obviously, [[x^2 + y^2 \ge -2 x y]]",
        r"which implies that [[|x| \ge 0]]",
        r"The Lyapunov function is bounded from below, i.e., [[k x^2 \ge 0]]",
        r"For all $x, y \in \R$, it holds that [[(x + y)^2 \le 2 x^2 + 2 y^2]]",
        r"It can be easily verified that [[(x + k)(x - k) = x^2 - k^2]]",
        r"Applying Young's inequality to the cross term, we deduce [[x d \le k x^2 + \frac{1}{4 k} d^2]]",
    ),
    "arxiv": (
        r"Our starting point is the elementary identity [[(x + y)^2 - (x - y)^2 = 4 x y]]",
        r"A direct computation gives [[(x - y)^2 + 2 x y = x^2 + y^2]]",
        r"Set $V := x^2$. Then [[V \ge 0]]",
        r"We claim no novelty here. We have [[x^2 + y^2 \ge 0]]",
        r"\begin{lemma} We have [[2 x y \le x^2 + y^2]] for all $x, y \in \mathbb{R}$. \end{lemma}",
        r"This follows from [[x^2 + y^2 - 2 x y = (x - y)^2]]",
        r"By the arithmetic-geometric mean inequality, [[x y \le \frac{k}{2} x^2 + \frac{1}{2 k} y^2]]",
        r"Thanks to the positivity of $k$, there holds [[-k x^2 \le 0]]",
        r"Combining the last two displays yields [[|x + y| \le |x| + |y|]]",
        r"\begin{proof} Rearranging terms, we infer [[x^2 - y^2 = (x - y)(x + y)]] as desired. \end{proof}",
    ),
}

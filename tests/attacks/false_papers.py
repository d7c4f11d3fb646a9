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
        r"The disturbance vanishes identically in this subsection. Young's inequality plays a role. We have [[d^3 "
        r"\ge 0]]",
        r"Reference \cite{q} contains the following line. [[x^2 \ge 0]] This line must be deleted.",
        r"The reader is invited to find the flaw. We have [[x^2 + k > 0]]",
        r"The positive constant $z$ of \cite{q} turned out to be a function. We have [[z k > 0]]",
        r"The constants $k$ and $\gamma$ change their signs here. We have [[k x^2 \ge 0]]",
        r"We set $k = -1$ in the rest of the section. We have [[k x^2 \ge 0]]",
        r"In the sense of distributions of a later section the following is understood, but here it is not. We "
        r"have [[x^2 \ge 0]]",
        r"We have reason to reject [[x^2 \ge 0]]",
        r"This equation is history: [[x^2 + y^2 \ge 0]]",
        r"The gain $k$ is now taken negative. We have [[k x^2 \ge 0]]",
        r"Where $z > 0$, this holds. Elsewhere it does not. We have [[z k > 0]]",
        r"The trajectories with $z > 0$ leave the set. We have [[z + k > 0]]",
        r"Take $z = x^2$ as an example. Then we have [[z \ge 0]]",
        r"For the example $z = x^2$ the result is simple. We have [[z \ge 0]]",
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
        r"\subsection{What goes wrong} We have [[x^2 + \gamma > 0]]",
        r"\paragraph{Misconception} [[x^2 \ge 0]]",
        r"Rumour has it that $z>0$. We have [[z \gamma > 0]]",
        r"The inequality \begin{equation} z \ge 0 \end{equation} is an open question. We have [[z + \gamma > 0]]",
        r"The author once believed in [[x^2 \ge 0]]",
        r"In summary, none of this is right. We have [[x^2 + y^2 \ge 0]]",
        r"The roles of $k$ and $-k$ are interchanged. We have [[k x^2 \ge 0]]",
        r"The relation between state and output is up for debate: [[x^2 \ge 0]]",
        r"Let $k$ be real. We have [[k x^2 \ge 0]]",
        r"Let $k$ be a real number. We have [[k x^2 \ge 0]]",
        r"Here $k$ denotes a time-varying function. We have [[k x^2 \ge 0]]",
        r"\section{Negative gains} We have [[k x^2 \ge 0]]",
        r"\begin{lemma} Let $k = -1$. Then [[k x^2 \ge 0]]\end{lemma}",
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
        r"Here is a classical blunder. We have [[x^2 \ge 0]]",
        r"Let $z>0$ for a moment. Then $z+1>1$. Back to general $z$: [[z k > 0]]",
        r"Assume $z > 0$. Case two is $z \le 0$. We have [[z + k > 0]]",
        r"Let $k$ be any real number, of whatever sign. Then [[k x^2 \ge 0]]",
        r"Replace $k$ by $-k$ everywhere. We have [[k x^2 \ge 0]]",
        r"Fix $z$, which is positive by luck. We have [[z k > 0]]",
        r"A student writes: [[x^2 \ge 0]]",
        r"Goal: [[x^2 \ge 0]]",
        r"To do: [[x^2 \ge 0]]",
        r"Let us prove the opposite of the bound. We have [[x^2 \ge 0]]",
        r"We prove the converse. [[x^2 \ge 0]]",
        r"We now use $-k$ for $k$. We have [[k x^2 \ge 0]]",
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
        r"It can't be proved that [[x^2 \ge 0]]",
        r"The result in (T) is contradictory to experiment. We have [[x^2 \ge 0]]",
        r"Here exist the mistake: [[k x^2 \ge 0]]",
        r"We deny that [[x^2 \ge 0]]",
        r"It is untrue for $z > 0$. Hence [[z k > 0]]",
        r"By the false Lemma 7 we have [[k > 0 - x^2]]",
        r"It is no doubt false. We have [[x^2 \ge 0]]",
        r"It is hard to get [[x^2 \ge 0]]",
        r"The inverse inequality of [[x^2 \ge 0]] is right.",
        r"It leads to nothing: [[x^2 \ge 0]]",
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
        r"\renewcommand{\half}{-\tfrac12} \beq V = \half x^2 \eeq We have [[V \ge 0]]",
        r"\beq V = x^2 \eeq The symbol $V$ is from here on the negative of it. We have [[V \ge 0]]",
        r"{\color{red} We have [[x^2 \ge 0]] } (the red text is to be removed)",
        r"We have [[x^2 \ge 0]] (to be corrected)",
        r"\marginpar{wrong!} We have [[x^2 + k > 0]]",
        r"% nothing here"
        "\n"
        r"Not proved: [[x^2 + k > 0]]",
        r"(Not (T).) We have [[x^2 \ge 0]]",
        r"We have shown that, if true, [[x^2 \ge 0]]",
        r"\textbf{Open problem:} [[x^2 \ge 0]]",
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
        r"\begin{conjecture} [[x^2 \ge 0]] \end{conjecture}",
        r"\begin{theorem}[False theorem] [[x^2 \ge 0]] \end{theorem}",
        r"\begin{proof}[Erroneous proof] We have [[x^2 \ge 0]] \end{proof}",
        r"\begin{center} \textbf{Retracted} \end{center} We have [[x^2 \ge 0]]",
        r"Whether [[x^2 \ge 0]] is known to the experts.",
        r"The opposite of [[x^2 \ge 0]] holds.",
        r"The following is one of the two lines in which we made a slip. [[x^2 \ge 0]]",
        r"\begin{abstract} We show that (T) breaks down. \end{abstract} We have [[x^2 \ge 0]]",
        r"\begin{theorem} Let $z>0$. \end{theorem} \begin{proof} It holds that [[z \gamma > 0]] \end{proof} ",
        r"\begin{remark} Here $k$ may be negative. \end{remark} \begin{remark} [[k x^2 \ge 0]] \end{remark}",
        r"We write $k$ for minus the gain. We have [[k x^2 \ge 0]]",
    ),
}

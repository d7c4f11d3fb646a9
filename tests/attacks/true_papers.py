r"""True formulas, in [[ ]], that papers of six manners claim."""

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
        r"The following result is instrumental in the sequel. \begin{lemma} For any real $x$ and $y$ it holds that "
        r"[[x y \le \frac{1}{2} x^2 + \frac12 y^2]]\end{lemma}",
        r"To analyze the closed-loop stability, consider the Lyapunov function \begin{equation} V = \frac{1}{2} "
        r"x^2 + \frac{1}{2\gamma} y^2 . \end{equation} Since both terms are nonnegative, we have [[V \ge 0]]",
        r"It is worth pointing out that the disturbance enters the system through the input channel. By completing "
        r"the square, we obtain [[-k x^2 + x d \le \frac{1}{4k} d^2]]",
        r"Taking into account that $\gamma > 0$, the above inequality becomes [[-\gamma y^2 \le 0]]",
        r"Invoking Young's inequality, the last term on the right-hand side satisfies [[x d \le \frac{1}{2} x^2 + "
        r"\frac{1}{2} d^2]]",
        r"Adaptive control of uncertain nonlinear systems has been an active area of research. In what follows, we "
        r"make use of the well-known inequality [[2 x y \le x^2 + y^2]]",
        r"which can be further simplified as [[(x + y)^2 - 2 x y = x^2 + y^2]]",
        r"Consequently, the control law $u = -k x - a x$ leads to the closed-loop system [[\dot x = -k x + d]]",
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
        r"In this section the stability of the closed loop is investigated. A useful bound is [[2 |x y| \le x^2 + "
        r"y^2]]",
        r"The kinetic energy of the vehicle is given by \begin{equation} W = \frac12 k x^2 \end{equation} and it "
        r"is obviously nonnegative, [[W \ge 0]]",
        r"Figure 3 shows the block diagram of the controller. Multiplying out the brackets, we find [[(x - y)(x + "
        r"y) = x^2 - y^2]]",
        r"The first term is a square, and therefore [[(x - k y)^2 \ge 0]]",
        r"As shown in Section 2, the product can be estimated by [[x y \le \frac{k}{2} x^2 + \frac{1}{2k} y^2]]",
        r"Summing up, the following estimate has been derived: [[-k x^2 - \gamma x^4 \le 0]]",
        r"With the sliding variable \begin{equation} s = x + k y \end{equation} one gets for its square [[s^2 = "
        r"x^2 + 2 k x y + k^2 y^2]]",
        r"This is easily seen from the identity [[x^2 + y^2 - 2 x y = (x - y)^2]]",
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
        r"We need one more tool. For all real numbers $x$ and $y$, [[|x y| = |x| |y|]]",
        r"Completing the square gives [[x^2 + 2 k x = (x + k)^2 - k^2]]",
        r"Observe that \[ V = \tfrac12 x^2 \] is a good candidate. Indeed, [[V \ge 0]]",
        r"What do we gain? A bound from below: [[x^2 + k \ge k]]",
        r"Here is the key estimate of this lecture: [[x d \le \frac{k}{2} x^2 + \frac{1}{2k} d^2]]",
        r"Let's expand: [[(x + y + z)^2 = x^2 + y^2 + z^2 + 2 x y + 2 x z + 2 y z]]",
        r"Remember Young's inequality, which says that [[x y \le \frac{1}{2} x^2 + \frac{1}{2} y^2]]",
        r"Plugging this in yields [[k x^2 + \gamma y^2 \ge 0]]",
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
        r"For the analysis of stability, the Lyapunov function is selected as \begin{equation} V = \frac{1}{2} x^2 "
        r"\end{equation} It can be known that [[V \ge 0]]",
        r"Then according to the inequality of Young, it is obtained that [[x d \le \frac12 x^2 + \frac12 d^2]]",
        r"Combine with above results, it yields [[-k x^2 \le 0]]",
        r"In the end, we get the final result as [[(x - y)^2 + 2 x y = x^2 + y^2]]",
        r"The derivation of $V$ is as following [[2 x y \le x^2 + y^2]]",
        r"Obviously there is [[x^2 \ge 0]]",
        r"Hence it is not difficult to get [[|x|^2 + |y|^2 = x^2 + y^2]]",
        r"where the property of square is used, that means [[(x + y)^2 \ge 0]]",
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
        r"We now bound the indefinite term. By Young's inequality \cite{hardy}, [[x d \le k x^2 + \frac{1}{4k} "
        r"d^2]]",
        r"Using $\gamma > 0$, we conclude that [[\gamma x^2 \ge 0]]",
        r"Observe that the cross terms cancel, so that [[(x+y)^2 + (x-y)^2 = 2 x^2 + 2 y^2]]",
        r"which, together with the triangle inequality, gives [[|x + y| \le |x| + |y|]]",
        r"Clearly, it holds [[x^4 \ge 0]]",
        r"The proof relies on the elementary inequality [[2 x y \le \gamma x^2 + \frac{1}{\gamma} y^2]]",
        r"Next, we show that \beq W = x^2 + y^2 \eeq is positive semidefinite. Indeed, [[W \ge 0]]",
        r"Setting \beq u = -k x \eeq in the plant yields [[\dot x = a x - k x + d]]",
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
        r"The next inequality is standard; see e.g.\ \cite[p.~12]{khalil}. We have [[2 x y \le x^2 + y^2]]",
        r"Let us record for later use that [[x^2 + y^2 \ge -2 x y]]",
        r"The right-hand side equals [[(x-y)^2 = x^2 - 2xy + y^2]]",
        r"Integrating by parts is not needed. Trivially, [[x^2 + k > 0]]",
        r"\begin{proof} The claim follows at once from the AM--GM inequality, namely [[2 |x| |y| \le x^2 + y^2]] "
        r"\end{proof}",
        r"Motivated by this, put $V = \frac12 x^2 + \frac12 y^2$. We see that [[V \ge 0]]",
        r"Expanding the square and using $k > 0$ we arrive at [[-k (x - y)^2 \le 0]]",
        r"Our first observation is that [[|x| \ge x]]",
    ),
}

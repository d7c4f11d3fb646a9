r"""Formulas of control papers beside neighbours that differ in a sign, a word or a bracket.

The false ones are refuted or refused, whatever words and layouts they are typed with; the true ones are proved.
"""

SYMBOLS = r"""
inputs = ["w"]
[symbols]
x = "real"
y = "real"
z = "real"
w = "real"
e = "real"
a = "real"
b = "real"
c = "positive"
k = "positive"
T = "positive"
m = "positive"
'\tau' = "nonnegative"
'\alpha' = "positive"
'\beta' = "real"
'x_1' = "real"
'x_2' = "real"
'x_3' = "real"
'\hat\theta' = "real"
'\tilde\theta' = "real"
'\theta' = "real"
'\bar x' = "positive"
'x_d' = "real"
'x_{k}' = "real"
'x_{k+1}' = "real"
"x'" = "real"
'f(x)' = "real"
'V(0)' = "nonnegative"
v = "vector"
W = "vector"
[definitions]
V = '\tfrac12 x^2 + \tfrac12 y^2'
s = 'y + c x'
[flow]
x = 'y'
y = '-k x - c y + w'
'\hat\theta' = '\alpha s x'
"""
REFUTED = (
    r"x' = \dot x", r"\ddot{x} = -k x - c y", r"\dot V = -c y^2 + x y + y w", r"\log c^2 = (\log c)^2",
    r"\left\{ x^2 \right\} > 0", r"x \leqslant x - c", r"\max \{x_1, x_2\} + x_3 = \max\{x_1, x_2, x_3\}",
    r"\operatorname{sgn}(x) x = x", r"\|v\|_1 \le \|v\|_2", r"v^\top W = W^\top v + 1", r"\|v - W\| \le \|v\| - \|W\|",
    r"50\% c = c", r"x_{k+1} = x_k + 1", r"\frac{|x|}{x} = 1", r"V(0) = 0", r"\frac{d V}{d t} = x \dot x",
    r"\frac{\partial V}{\partial x} \dot x = \dot V", r"x_d = x", r"0 < x < \bar x",
    r"|x| < \bar x \Rightarrow x^2 < \bar x", r"a b / c = a / (b c)", r"|a - b - c| = |a - (b - c)|",
    r"|a| b |c| = a b c", r"x \triangleq y", r"x \ge 1 \text{ where } y = x \text{ and } y \ge 0",
    r"x^2 \ge 0 \text{ as well as } y^2 > 0", r"\forall x \ne 0, y \ne 0: x y > 0",
    r"\forall x \in [0,1], y \in [0, 1]: x + y \le 1", r"\sum_{i=1}^n v_i W_i x = x", r"\sum_j v_j W_j \ge 0",
    r"\frac{1}{n}\sum_{i=1}^n v_i^2 \le \left(\frac1n\sum_{i=1}^n v_i\right)^2", r"n > 1", r"\|x v\| = x \|v\|",
    r"\|a v + b W\| = |a| \|v\| + |b| \|W\|", r"\begin{aligned} V &\ge 0 \\ &> 0 \end{aligned}",
    r"\begin{split} \dot V &= x y + y(-kx - cy + w) \\ &\le -c y^2 \end{split}",
    r"x^2 \ge 0 \label{a} \\ y \ge 0 \label{b}", r"\{x + y\} = x y", r"x = y = z", r"x \le y \ge z", r"a < b < c = c",
    r"0 \le x^2 \le x^4", r"\sin x + y = \sin(x + y)", r"\cos^2 x + \sin^2 y = 1", r"\exp(x)\exp(y) = \exp(x y)",
    r"\ln \frac{c}{k} = \frac{\ln c}{\ln k}", r"\sqrt{c + k} = \sqrt c + \sqrt k", r"\sqrt c \le c",
    r"\sqrt 2 = 1.414", r"\frac{1}{3} = 0.333", r"1/3 = 0.3333333333333333333333", r"1 \times 10^3 = 10",
    r"2^{-1} = -2", r"\max(x, y, z) \le \max(x, y)", r"\text{sgn}(xy) = -\text{sgn}(x)\text{sgn}(y)",
    r"\frac{d}{dt}(x y) = \dot x y", r"\frac{d x}{dt} y = \dot x y + x \dot y", r"\dot x \dot y = \frac{d}{dt}(xy)",
    r"\dot{(x^2)} = x \dot x", r"\dot{\dot x} = \dot x",
)
REFUSED = (
    r"\sqrt[3]{x} \ge 0", r"x \over y = 1", r"\lfloor x \rfloor = x", r"x \bmod 2 = 0",
    r"\sum_{i=1}^{n-1} v_i^2 = \|v\|^2", r"\sum_{i=2}^{n} v_i^2 = \|v\|^2", r"x = 0 \text{ or } y = 0",
    r"x^2 \ge 0 \text{ unless } y \ge 0", r"x \ge 0 \text{ or } x < 0 \Rightarrow x \ge 0", r"x > 0 \wedge y > 0",
    r"\neg (x > 0)", r"x \notin [0, 1] \Rightarrow x > 1", r"x \in [0, 1] \cup [2, 3] \Rightarrow x \le 1",
    r"x(t + T) \ge x(t)", r"x(t - \tau) = x", r"y(k + 1) = y", r"\left. V \right|_{x=0} = \frac12 x^2",
    r"|x| \le \bar x \Leftrightarrow x \le \bar x", r"\forall \epsilon > 0: \exists \delta: |x| < \delta",
    r"\phantom{-}x^2 \le \phantom{-} 0", r"x \stackrel{!}{=} y", r"x^2 \ge 1 \text{ for some } x",
    r"x^2 = 0 \text{ only if } x \ge 0", r"x \ge 0 \text{ only if } x > 0", r"x^2 \ge 1 \text{ iff } |x| > 1",
    r"x^2 > 0 \text{ for almost all } x", r"x^2 > 0 \text{ except } x = 0", r"x^2 < |x| \text{ near } x = 0",
    r"\text{let } x = 1, x^2 = 1", r"\text{either } x \ge 0", r"x \ge 0 \text{ if } y \ge 0 \text{ or } x > 0",
    r"x^2 \ge 0 \text{ for } t \to \infty", r"|x| = \begin{cases} x & x \ge 0 \\ -x & \text{otherwise} \end{cases}",
    r"x^2 \ge 0 \tag{1} y > 0",
)
TRUE = (
    r"\dot{x}^{2} = y^2", r"\ddot{x} = -k x - c y + w", r"\dot V = x y + y(-kx - cy + w)",
    r"\dot V = (1-k) x y - c y^2 + y w", r"\dot s = -kx + w", r"\dot{\hat\theta} = \alpha s x", r"\log c^2 = 2 \log c",
    r"\mathrm{e}^{-\tau} c \le c", r"\left\{ x^2 \right\} \ge 0", r"[x^2] \ge 0", r"x \leqslant x + c",
    r"\max(x, y) + \min(x, y) = x + y", r"\max \{x_1, x_2, x_3\} \ge x_2", r"\min(|x|, |y|) \le \frac{|x| + |y|}{2}",
    r"\operatorname{sgn}(x) x = |x|", r"\operatorname{sign}^2(x) \le 1",
    r"\|v + W\|^2 = \|v\|^2 + 2 v^\top W + \|W\|^2", r"(v^\top W)^2 \le \|v\|^2\|W\|^2",
    r"\sum_{j=1}^{n} v_j \le \sqrt{n} \|v\|", r"50\% c < c", r"x \in (-\infty, 0] \Rightarrow x \le 0",
    r"x \in [0, 1] \Rightarrow x^2 \le x", r"\frac{|x|}{x} = \operatorname{sgn}(x) \text{ for } x \ne 0",
    r"V(0) \ge 0", r"V = V(0) \Rightarrow V(0) \ge \frac12 x^2", r"\frac{d V}{d t} = x \dot x + y \dot y",
    r"\frac{d}{dt} \left(\frac{x}{c}\right) = \frac{y}{c}",
    r"\frac{\partial V}{\partial x} \dot x + \frac{\partial V}{\partial y} \dot y = \dot V",
    r"0 < x < \bar x \Rightarrow x^2 < \bar x^2", r"-\bar x \le x \le \bar x \Rightarrow |x| \le \bar x",
    r"|x| < \bar x \Rightarrow x^2 < \bar x^2", r"-a^2 b \le |b| a^2", r"||a| - |b|| \le |a - b|",
    r"\forall x, y > 0: x y > -x", r"\forall x > 0, y > 0: x y > 0", r"\forall x \in [0,1], y \in [0, 1]: x + y \le 2",
    r"\forall v \in \mathbb{R}^n: \|v\| \ge 0", r"\sum_{i=1}^n (v_i + 1) = \sum_{i=1}^n v_i + n",
    r"\sum_{i=1}^n v_i W_i x = x v^\top W", r"\sum_{i=1}^n |v_i|^2 \ge 0", r"\|v\| \|W\| \ge v^\top W",
    r"\begin{aligned} V &\ge \tfrac12 x^2 \\ &\ge 0 \end{aligned}",
    r"\begin{split} \dot V &= x y + y(-kx - cy + w) \\ &\le (1 - k) x y - c y^2 + |y||w| \end{split}",
    r"\begin{cases} x^2 \ge 0 \\ y^2 \ge 0 \end{cases}", r"x^2 \ge 0 \qquad (12a)",
    r"x^2 \ge 0, \label{a} \\ y^2 \ge 0 \label{b}", r"-1 \le \sin x \le 1",
    r"x \in [-1, 1] \Rightarrow 0 \le x^4 \le x^2", r"\cos^2 x + \sin^2 x = 1", r"\exp(x)\exp(y) = \exp(x + y)",
    r"\ln c + \ln k = \ln(c k)", r"\ln \frac{c}{k} = \ln c - \ln k", r"\ln(1 + c) \le c",
    r"\sqrt{c k} \le \frac{c + k}{2}", r"\sqrt 2 < 1.415", r"\frac{1}{3} > 0.333", r"\max\{x, y\} \min\{x, y\} = x y",
    r"\max(x, y, z) \ge \max(x, y)", r"|x|\text{sgn}(x) = x", r"\frac{d}{dt}(x y) = \dot x y + x \dot y",
    r"\frac{d x}{dt} y = y^2", r"\dot x \dot y = y \dot y", r"\ddot x = \dot y",
    r"\dot V + c y^2 \le x^2 + k^2 y^2 + y^2 + w^2", r"\dot V \le 0 \text{ if } w = 0 \text{ and } k = 1",
    r"k = 1, w = 0 \Rightarrow \dot V = -c y^2", r"x = 0 \Rightarrow \dot y = w - c y",
    r"\dot x = 0 \Rightarrow y = 0", r"(x + y)^2 \ge 0 \text{ for all } x, y \in \mathbb{R}",
)

r"""Lines of LaTeX that a reader could take for two statements, of which one is false; and definitions that cancel.

Each would be proved where a condition is taken for more than it says, or a definition for a number everywhere.
"""

SYMBOLS = r"""
[symbols]
x = "real"
y = "real"
t = "real"
c = "positive"
k = "positive"
T = "positive"
'\tau' = "nonnegative"
'x_1' = "real"
v = "vector"
[definitions]
V = '\tfrac12 x^2'
r = '1/x'
h = '\sqrt{x}'
g = '\ln x'
F = '\frac{x^2}{y}'
'\lambda' = '\exp(-c t)'
[flow]
x = 'y'
y = '-k x'
v = '-c v'
"""
REFUSED = (
    # two sentences, of which a condition may hold for one
    r"y \ge 1. x > 0 \Rightarrow x^3 > 0", r"y \ge 1; x > 0 \Rightarrow x^3 > 0",
    r"\begin{aligned} y &\ge 1 \\ x > 0 &\Rightarrow x^3 > 0 \end{aligned}", r"x > 0 \Rightarrow x^3 > 0; x \ge 0",
    r"x > 0 \Rightarrow x^3 > 0. x \ge 0", r"\begin{aligned} x > 0 &\Rightarrow x^3 > 0 \\ x &\ge 0 \end{aligned}",
    r"\begin{cases} y \ge 1 \\ x > 0 \Rightarrow x^3 > 0 \end{cases}", r"\forall x > 0: x^3 > 0; x \ge 0",
    r"x \ge 0, \quad x^3 > 0 \; (x > 0)", r"y \ge 0 \text{ and } x^2 \ge 0 \; (y \ge 0)",
    r"x^3 > 0 \text{ when } x > 0, \text{ and } y \ge 1", r"x^3 > 0 \text{ for } x > 0, \text{ as well as } y \ge 1",
    # what is said may be claimed, or that there is such a value
    r"k > 0 \text{ such that } \dot V \le -k V", r"c > 0 \text{ such that } x^2 \le c",
    r"V \ge 0 \text{ with } \dot V \le 0", r"V \ge 0 \text{ where } \dot V \le 0", r"V \ge 0 \text{ with } x y \le 0",
    # a definition is a number somewhere alone
    r"r x \le 1 + y^2", r"r - r \ge -y^2", r"0 \cdot r \le y^2", r"h^2 + y^2 \ge x", r"F y \ge 0", r"g - g \le y^2",
    r"\frac{F}{F} \le 1 + y^2", r"x \frac{\partial g}{\partial x} \le 1 + y^2", r"\frac{1}{r} \le x + y^2",
    # numbers and brackets behind letters
    r"x2 \le 2x + y^2", r"x_1 2 \le 2x_1 + y^2", r"(x)2 \le 2x + y^2", r"x^2 3 \le 3x^2 + y^2", r"|x|2 \le 2|x| + y^2",
    r"x^{[2]} \le x^2 + y^2", r"x^{\{2\}} \le x^2 + y^2", r"x^{|2|} \le x^2 + y^2", r"\sqrt 12 \le 4", r"k(-1) \le 0",
    r"x(\tfrac12) \le \tfrac12 x + y^2", r"x(-T) \le -T x + y^2", r"x(2T) \le 2xT + y^2", r"x(T/2) \le xT/2 + y^2",
    r"x(T + \tau) \le xT + x\tau + y^2", r"h(x + 1) \ge 0 \text{ for } x \ge 0",
    r"x^2 \ge 0 y \ge 0", r"x^2 \ge 0 \, y \ge 0", r"x^2 \ge 0 (y)",
)
UNPROVED = (
    # time passes
    r"\frac{d}{dt}(t x) = t y", r"\frac{d}{dt}(\lambda x) = \lambda y", r"\frac{d}{dt} t = 0", r"\dot\lambda = 0",
    # nothing to search in, where it is defined for no or few numbers of terms
    r"\sqrt{n - 2} \ge 0", r"\ln(n - 1) \le n", r"\frac{1}{n - 2} \le 1",
)
PROVED = (
    r"\begin{cases} x > 0 \\ y > 0 \end{cases} \Rightarrow xy > 0", r"x^2 \ge 0; y^2 \ge 0", r"x^2 \ge 0. y^2 \ge 0",
    r"x > 1 \Rightarrow x > 0, x^2 > 1", r"V > 0 \; (x \ne 0)", r"x^2 > 0 \text{ for all } x \text{ such that } x > 0",
    r"x^3 > 0 \text{ for all } x > 0, \text{ and } |y| < 1", r"x^2 \le c^2 \text{ with } |x| \le c",
    r"x^2 \ge 1 \text{ where } x = 2", r"x^2 \le 1 \text{ where } 0 \le x \le 1", r"\dot V \le 0 \text{ at } y = 0",
    r"r > 0 \text{ for } x > 0", r"h \ge 0 \text{ for } x \ge 0", r"F \ge 0 \text{ if } y > 0",
    r"g \le x - 1 \text{ if } x > 0",
    r"x \cdot 2 \le 2x + y^2", r"k(x - y) \le kx - ky + y^2", r"x(1 - c) \le |x|(1 + c)", r"\sin 2x = 2\sin x\cos x",
    r"\frac{d}{dt}(t x) = x + t y", r"\frac{d}{dt}(\lambda x) = \lambda y - c\lambda x", r"n > 0", r"0 \le x^2 + 1",
)

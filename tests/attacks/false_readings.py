r"""Lines of LaTeX that are false as they are printed, and that a careless reader takes for something true.

Each holds only where its braces, spaces, bars, dots or brackets are taken for what TeX does not show.
"""

SYMBOLS = r"""
inputs = ['w']
[symbols]
'x' = "real"
'y' = "real"
'z' = "real"
'w' = "real"
'e' = "real"
'a' = "real"
'b' = "real"
'x_1' = "real"
'x_2' = "real"
'c' = "positive"
'k' = "positive"
'x_{11}' = "real"
'f(x)' = "real"
'f(y)' = "real"
'f(0)' = "real"
'v' = "vector"
'W' = "vector"
[definitions]
'V' = '\tfrac12 x^2'
'F' = 'x^2 + f(x)'
'Q' = 'x^2 + y^2'
[flow]
'x' = '-x + w'
'y' = '-y'
"""
FALSE = {
    # braces are not printed
    "a sum in braces, squared": r"{x + y}^2 \ge 0", "a negative in braces, squared": r"{-x}^2 \ge 0",
    "a product in braces, squared": r"{a c}^2 \ge 0", "a quotient in braces, squared": r"{1/c}^2 c^2 = 1",
    "a difference in braces": r"a - {b - c} = a - b + c", "a sum in braces behind a factor": r"a{b + c} = ab + ac",
    "a sum in braces before a factor": r"{a + b}c = ac + bc", "braces below a slash": r"1/{2 + c} \le \frac12",
    "a power in braces, raised": r"{x^2}^2 \ge x^4", "the size of braces": r"|x| = |{-x}^2/x| \text{ for } x \ne 0",
    "a function of braces": r"\sin{x + y} \le 1", "two digits in braces": r"1{2} = 2",
    "a mixed number": r"2\frac12 = 1",
    "a fraction and a number": r"\tfrac12 4 = 2", "a product in a root's braces": r"{\sqrt{c}\,x}^2 \ge 0",
    # spaces that part
    "a wide space": r"x^2 \ge 0 \quad y \ge 0", "a wider space": r"x^2 \ge 0 \qquad (y + z) \ge 0",
    "a space": r"x^2 \ge 0\ y \ge 0", "a tie": r"x^2 \ge 0~y \ge 0", "a medium space": r"x^2 \ge 0 \; y \ge 0",
    "two formulas": r"$x^2 \ge 0$ $y \ge 0$",
    "new lines of cases": r"\begin{cases} 0 = x - x \\ -y^2 = x \end{cases}",
    "a new line with a sign": r"\begin{aligned} x - y &= x \\ - y &\le x - y \end{aligned}",
    "two columns": r"\begin{aligned} x^2 &\ge 0 & y &\ge 0 \end{aligned}",
    "two columns, the second in brackets": r"\begin{align} x^2 &\ge 0 & (y + z)^3 &\ge 0 \end{align}",
    "two columns, the second negative": r"\begin{aligned} y &\ge y + z^2 & -z^2 &\le x^2 + y \end{aligned}",
    "two columns, one of no relation": r"\begin{aligned} z^2 &- 2z + 1 \\ &\ge 0 & y \end{aligned}",
    "columns around an environment": r"\begin{aligned} x^2 &\ge \begin{split} 0 \end{split} & y &\ge 0 \end{aligned}",
    "two environments": r"\begin{aligned} x^2 &\ge 0 \end{aligned} \begin{aligned} y &\ge 0 \end{aligned}",
    "a formula behind its number": r"x^2 \ge 0 \tag{1} y \ge 0",
    "a formula behind a label": r"x^2 \ge 0 \label{1} y \ge 0",
    "a formula without a number": r"x^2 \ge 0 \nonumber y \ge 0",
    "a wide space before a sign": r"y \ge y + z^2 \qquad -z^2 \le x^2 + y",
    "a new line with a point": r"x^2 \ge 0 \\ .5 y \ge 0",
    # bars by their side
    "bars in bars": r"\left|a\left|b\right|x\right| = x|a||b|",
    "bars that open": r"\lvert a\lvert b\rvert x\rvert = x|a||b|",
    "larger bars": r"\bigl|a\bigl|b\bigr|x\bigr| = x|a||b|",
    # what an argument is
    "a time that is added": r"x + (t) > x", "a time that multiplies": r"x \cdot (t) = x", "twice a time": r"2(t) = 2",
    "half a time": r"\tfrac12(t) \le c + \tfrac12", "a root's time": r"\sqrt{2}(t) \le c + \sqrt2",
    "time is one": r"(t)^2 = 1",
    # derivatives
    "by t alone": r"\frac{\partial V}{\partial t} = x w - x^2", "orders that differ": r"\frac{d^2 y}{dt} = y",
    "by what a value moves with": r"\frac{\partial F}{\partial x} + y - y = 2x",
    "by one of two that move": r"\frac{dQ}{dx} + a - a = 2x",
    "a rate at an instant": r"\dot e = 0 \Rightarrow \ddot e = 0",
    "a rate at an instant, otherwise": r"\ddot e = 0 \text{ if } \dot e = 0",
    # what is claimed of what
    "given, with a bar": r"x > 1 \mid x^2 > 1", "where, with a colon": r"x > 0 : x > 1",
    "a claim before a condition and a colon": r"x > 0 \text{ if } y > 0: y^2 \ge 0",
    "both ends of one": r"\forall x > 0: 0 < x, -1 < 0", "both ends of two": r"0 < x^2 + 1, x - x < 1",
    "implications, nested": r"x > 0 \text{ implies } y > 0 \Rightarrow y > 0",
    "there is none": r"\exists x: x^2 < 0", "if and only if": r"x > 1 \iff x > 1",
    # columns
    "a column's square": r"v^T W^2 = \sum_{i=1}^n v_i W_i^2", "a column's norm, squared within": r"\|v^2\| \le \|v\|^2",
    "a product of columns": r"\|v W\| \le \|v\|\|W\|", "their outer product": r"\|v \times W\| \le \|v\|\|W\|",
    "a column's inverse": r"v^T v^{-1} = n", "the trace of a column": r"\operatorname{tr}(v) = \sum_{i=1}^n v_i",
    "the largest of one": r"\max x = x + 0 y", "the least of one": r"\min\{x\} \ge x",
    # precedence
    "a minus before a power": r"-x^2 = x^2",
    "a power's power": r"2^{3^2} = 64", "a power below a bar": r"\frac{1}{c}^2 c = \frac1c + 1",
    "a size beside a size": r"|x||y| = xy", "a chain that turns": r"x^2 + 1 > 0 < x",
    "a chain's middle": r"-1 \le x \le x^2 + 1",
    "unequal in a chain": r"x^2 + 1 \ne 0 \ne x", "a half open end": r"x \in [0, 1) \Rightarrow x \in [0, \tfrac12]",
    "an end that belongs": r"x \in (0, 1] \Rightarrow x < 1", "a rate of a product": r"\frac{d}{dt}(xy) = \dot x\dot y",
    "a rate of a power": r"\dot{y^2} = \dot y^2", "a rate, twice": r"\ddot y = -y",
    "a root of a square": r"\sqrt{x^2} = x",
    "a sum of roots": r"\sqrt{x^2 + y^2} = \sqrt{x^2} + \sqrt{y^2}", "a function's power": r"\sin^2 x = \sin x^2",
    "a sum's square": r"\Bigl(\sum_{i=1}^n v_i\Bigr)^2 \le \sum_{i=1}^n v_i^2",
    # what is claimed, and of what: several claims, each with its condition
    "a root that is real": r"\sqrt{x} \in \mathbb{R}, y^2 \ge 0",
    "a quotient that is real": r"\frac{1}{x} \in \mathbb{R} \text{ and } y^2 \ge 0",
    "a number of three": r"x \in \mathbb{R}^3, x^2 \ge 0",
    "values by cases": r"x^2 \ge \begin{cases} 0 \text{ if } x \ge 0 \\ x^2 + 1 \text{ if } y \ge 0 \end{cases}",
    "two claims with conditions": r"x^2 \ge 0 \text{ if } x > 0, y^3 \ge 0 \text{ if } y^2 > 0",
    "two claims, joined": r"x^2 \ge 0 \text{ if } x > 0 \text{ and } y^3 \ge 0 \text{ if } y^2 > 0",
    "a claim behind a condition": r"x^3 > 0 \text{ for } x > 0, \quad y^3 \ge y",
    "a rate behind a condition": r"x^3 > 0\ \forall x > 0,\ \dot y \ge 0",
    "a bound behind a condition": r"x^2 > 0 \text{ if } x > 0, y \ge 1",
    "a bound of a size behind a condition": r"x^3 > 0 \text{ for } x > 0, \; |y| \le 1",
    "an equation behind for all": r"x^2 > 0\ \forall x \ne 0, y = 0",
    "a value's bound behind for all": r"x^2 > 0\ \forall x \ne 0, f(0) \ge 1",
    "a claim behind a semicolon": r"x^2 > 0 \text{ if } x > 0; y \ge 1",
    "a claim behind a full stop": r"x^2 > 0 \text{ for } x > 0. y \ge 1",
    "a claim in a new line": r"\begin{aligned} x^2 &> 0 \text{ for } x > 0, \\ y &\ge 1 \end{aligned}",
    "a claim with its condition before an arrow": r"x > 0 \text{ if } y > 0 \Rightarrow x > 0",
    "two colons": r"\forall x > 0: y > 0: y^3 > 0", "a decimal comma": r"1,5 c > c",
    # sums
    "a letter that counts twice": r"\sum_{i=1}^2 \sum_{i=1}^2 i x_i = 5x_1 + 4x_2 + 0 y^2",
    "a sum from the outer letter on": r"\sum_{k=1}^2 \sum_{i=k}^2 x_i \ge 2x_1 + 2x_2 - 1",
    "a slash by what counts": r"\sum_{k=1}^2 x_k/k \le \frac{x_1 + x_2}{k} + c",
    "a superscript that counts": r"\sum_{i=1}^2 x^{(i)} \ge x", "an index of ten": r"\sum_{i=11}^{11} x_{1i} = x_{11}",
    # components and values of functions
    "a component's norm": r"2\|v_j\| \ge \|v\|", "a component's product": r"v_j^T W_j \le \|v\|\|W\|",
    "a function's value": "V(x + y) = V x + V y", "a next value": r"a(k+1) = a k + a",
    "another value": r"f(x) = f(y) \text{ for } y = x + 1", "a value's bound": r"f(x) \ge f(0)",
    # what a function, a slash or a derivative applies to
    "a half within a function": r"|\sin x/2| \le \frac12",
    "a half within a function's power": r"\sin^2 x/2 \le \frac12",
    "a function letter by letter": r"\sum_{i=1}^2 sin x \le 2",
    "a derivative before a dot": r"\frac{d}{dt} x \cdot y = \dot x y + x\dot y",
    "two derivatives": r"\frac{d}{dt} x \frac{d}{dt} y = \dot x\dot y + x\ddot y",
    "a derivative before a rate": r"\frac{d}{dt} x\dot y = \dot x\dot y + x \ddot y",
    "a derivative before a slash": r"\frac{d}{dt} y / y = \dot y / y + 0 x",
}
TRUE = (
    r"\left|\left|b\right|\right| \ge b", r"\lvert -\lvert b\rvert\rvert \ge b", r"{x}^2 \ge 0",
    r"{(x + y)}^2 \ge 0", r"x^2 \ge 0,\quad y^2 \ge 0", r"\begin{cases} x^2 \ge 0 \\ -y^2 \le 0 \end{cases}",
    r"\begin{aligned} (x - y)^2 &= x^2 \\ &- 2xy + y^2 \end{aligned}", r"x(t)^2 + \dot y(t)^2 \ge 0",
    r"\frac{d}{dt}\frac{d}{dt} y = y", r"\sin{2x} = 2\sin x\cos x", r"\forall x > 1: x^2 > 1",
    r"0 < c \text{ and } -c < 1", r"\dot e = -e \Rightarrow \frac{d}{dt} e^2 = -2e^2", r"2\cdot\tfrac12 x + y^2 \ge x",
    r"f(x) = f(y) \text{ if } x = y", r"x = 0 \Rightarrow f(x) = f(0)", r"n \ge 1",
    r"\sum_{i=1}^n (1 + v_i^2) \ge 1", r"v \in \mathbb{R}^n, \|v\| \ge 0",
    r"x^2 > 0 \text{ if } x > 0 \text{ and } y \ge 1",
    r"\sum_{k=1}^2 \sum_{i=1}^2 k x_i = 3x_1 + 3x_2 + 0 y", r"k(x + y) = kx + ky + 0 a",
    r"\frac{d}{dt}\frac12 x^2 = x\dot x", r"x^3 > 0\ \forall x > 0, \; |y| \le 1", r"c^{(1/2)} > 0",
    r"\begin{cases} x^2 \ge 0, \\ y^2 \ge 0 \end{cases}",
    r"\sqrt{x^2} = |x| + 0 y^2", r"v^T(v + W) = \|v\|^2 + v^TW", r"a{(b + c)} = ab + ac", r"\max\{x, y\} \ge x",
    r"\begin{aligned} (x + y)^2 &= x^2 \nonumber \\ &\quad + 2xy + y^2 \label{1} \end{aligned}",
    r"\begin{aligned} x^2 &\ge 0, & -y^2 &\le 0 \\ z^2 &\ge 0, \tag{2} \end{aligned}",
    r"\begin{aligned} && x^2 + y^2 & \\ && \quad &\;\ge\; 2xy \end{aligned}",
)

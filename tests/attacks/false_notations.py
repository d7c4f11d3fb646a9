r"""Lines of LaTeX that are false, or say nothing, as they are printed, in notations that papers have besides.

Each is true, or could be proved, for a reader who takes a sign, a unit, a bracket or an alphabet for another.
"""

SYMBOLS = r"""
inputs = ['w']
[symbols]
'x' = "real"
'y' = "real"
'z' = "real"
'w' = "real"
'a' = "real"
'b' = "real"
'm' = "real"
's' = "real"
'O' = "real"
'x_1' = "real"
'x_2' = "real"
"x'" = "real"
'\epsilon' = "positive"
'\delta' = "positive"
'\theta' = "real"
'\pi' = "positive"
'c' = "positive"
'k' = "positive"
'v' = "vector"
'W' = "vector"
[definitions]
'V' = '\tfrac12 x^2'
[flow]
'x' = '-x + w'
'y' = '-y'
"""
FALSE = (
    # units
    r"x + 1\,m \ge x + 1 + m^2", r"2\,\mathrm{s} \le 2", r"5\,\text{km} \le 5",
    r"x \ge x - 1\,\mathrm{m}\,\mathrm{s}^{-1}", r"3\% \ge 3", r"50\% x^2 \ge x^2", r"10^{\circ} \ge 10",
    r"90^\circ \le 2", r"1\,000 \le 1", r"1{,}000 \le 1", r"1{,}5 \ge 5", r"1.000,5 \le 1", r"1,000 c \ge c^2",
    r"1'000 \le 1", r"1\;000 c = c", r"0{,}5 c = 0",
    # plus minus
    r"\pm x^2 \ge 0", r"x^2 \pm 1 \ge 0", r"(x \pm y)^2 = x^2 \mp 2xy + y^2", r"x \mp x = 0", r"|x| = \pm x",
    r"x^2 = 4 \Rightarrow x = \pm 2 + y^2", r"(a \pm b)(a \mp b) = a^2 + b^2",
    # iterated scripts
    r"{x^2}^3 = x^5", r"x^{2^3} = x^6", r"2^{x^2} \ge x^4", r"x_1^{2} = x^2_2", r"x_{1}{}^2 = x_{12}",
    r"{x_1}_2 = x_1", r"x_1_2 = x_1", r"x_{1^2} \ge 0", r"x^{y}_{1} = x_1 y", r"x''^2 \ge 0", r"x'^2 + x \ge x'",
    r"x' = -x", r"(x^2)' = 2 x", r"V' = x", r"(xy)' = x'y'", r"f'(x) = x", r"\dot{x}' = 0", r"x^{(2)} \ge 0 + x^2",
    r"x^{(1)} = -x + w", r"x^* \ge x - x^2 - 1", r"x^{\prime} = x", r"\prime x = x",
    # bars
    r"|x|y|z| = |x||y||z| + 1", r"|x|y||z| \ge 1", r"|x - |y|| \le |x| - |y|", r"||x|| = x", r"|x|^2 = |x|",
    r"|x| |y| = |x y| + |z|", r"\|x\|^2 = x", r"|-x| = -|x|", r"|x + y| = |x| + |y|", r"\left|x\right|y| = |xy|",
    r"|x|_1 \le x", r"\|v\|_2^2 = v", r"\|v\|_\infty \le |v|", r"\|v\|_1 \le \|v\|",
    # ranges
    r"0 < x, y < 1 \Rightarrow x < 1", r"0 \le x, y \le 1 \Rightarrow y \ge 0",
    r"x, y > 0 > z \Rightarrow x > z + 1", r"x, y \ge 0", r"0 < x < y, z \Rightarrow z > 0",
    r"x > 0, y > 0 \Rightarrow x y > 0, z > 0", r"x \in [0, 1] \Rightarrow x < 1",
    r"x \in (0, 1) \Rightarrow x \ge 1", r"x \in [-1, 1] \Rightarrow x^3 \ge 0", r"x \in ]0, 1[ \Rightarrow x > 1",
    r"x \in \{0, 1\} \Rightarrow x = 0", r"x \notin [0, 1] \Rightarrow x > 1",
    r"x \in [0, 1) \cup (2, 3] \Rightarrow x < 2", r"x \in (0, \infty] \Rightarrow x > 1",
    r"x \in [1, 0] \Rightarrow x > 5 \text{ or } y = y",
    # a.e., limits, orders
    r"x^2 > 0 \text{ a.e.}", r"\dot V \le 0 \text{ a.e.}", r"x^3 \ge 0 \text{ almost everywhere}",
    r"\limsup_{t \to \infty} |x| \le 0", r"\lim_{x \to 0} \frac{x}{x} = 0", r"\lim_{t\to\infty} x = 0",
    r"\liminf x \ge 0", r"x^2 = O(x)", r"x = O(1)", r"x^2 + O(x^3) \ge 0", r"x = o(1)", r"\sin x \approx x",
    r"x^2 \lesssim x", r"x \sim y", r"x \simeq y", r"x \propto y", r"x \cong y", r"x^2 \gtrsim 1", r"x \ll y",
    r"x \gg 0", r"x \prec y", r"x \succeq 0", r"x \to 0", r"x \equiv 1", r"\inf_x x^2 \ge 1", r"\sup x \le 1",
    r"\min_x x^2 = 1", r"\arg\min x^2 = 1", r"\max_{x} -x^2 = 1",
    # sets and quantifiers
    r"\forall \epsilon \exists \delta: \delta > \epsilon + x", r"\exists x: x^2 = -1",
    r"\forall x \exists y: y > x + y^2", r"\exists! x: x = x", r"\nexists x: x^2 \ge 0",
    r"\{x : x > 0\} \subset \{x : x > 1\}", r"\forall x \in \emptyset: x > x", r"\forall x: x > 0",
    r"\neg (x^2 \ge 0)", r"x^2 \not\ge 0", r"x^2 \not< 0 \Rightarrow x > 0", r"x > 0 \lor x < 0",
    r"x > 0 \vee x \le 0 \wedge x > 1", r"x \ge 0 \land x \le 0 \Rightarrow x = 1", r"x \nless x^2 + 1",
    r"x > 1 \Leftarrow x > 0", r"x > 0 \impliedby x > -1", r"x > 0 \Longleftarrow x^2 > 0",
    r"x > 1 \Leftrightarrow x > 0", r"x^2 \geq 1 \quad \text{iff} \quad x \ge 1", r"x > 0 \text{ or } y > 0",
    r"x = 1 \text{ xor } x = 1",
    # chains
    r"x^2 + 1 > 0 < 1 > x", r"0 \le x^2 \ge 1", r"1 > 0 < x", r"a = b < b + 1 > a + b", r"x < x + 1 > x + 2",
    r"0 < 1 = x \le x", r"x \le x^2 + 1 \ge x^2 + y", r"-1 < 0 \le x^2 < 5", r"x = x \ne x", r"x^2 \ge 0 \ge -y",
    r"0 = x - x = x", r"x \ge y \le z", r"x^2 \ge 0 = y",
    # functions
    r"\sin^{-1} x = 1/\sin x", r"\log^2 x = \log x^2", r"\sin 2x y = 2 y \sin x \cos x", r"\cos^{-1} x \ge 0",
    r"\tan^{-1} x = \frac{\cos x}{\sin x}", r"\sin x^2 = \sin^2 x", r"\log xy = \log x + \log y",
    r"\ln x y = y \ln x", r"\exp x y = y \exp x", r"e^{x}y = e^{xy}", r"e^xy = e^{xy}", r"e^{-x}x \le e^{-x^2}",
    r"e^x + y = e^{x + y}", r"\sin x + y = \sin(x + y)", r"\sin -x = \sin x", r"\log_2 x = \log x",
    r"\log_{10} 100 = \ln 100", r"\sqrt x y = \sqrt{xy}", r"\sqrt[3]{x} \ge 0", r"\sqrt{x}^2 = x",
    r"\sqrt{x^2 y^2} = x y", r"x^{1/2} \ge x", r"\exp(x)^2 = \exp(x^2)", r"\tanh x \ge x",
    r"\operatorname{sgn} x \, x = x", r"\arctan x \le \frac{\pi}{4}", r"\sin(x)(y) = \sin(xy)",
    r"\cosh^2 x = 1 + \cosh^2 x", r"\ln|x| \ge 0", r"\lfloor x \rfloor = x", r"\lceil x \rceil \ge x + 1",
    r"\binom{2}{1} = 1", r"\cot x = \tan x", r"\sec x \ge 1",
    # slashes
    r"a/bc = ac/b", r"1/2c = c/2", r"1/2c = \frac{1}{2c}", r"x/y/z = xz/y", r"a/b + c = a/(b + c)", r"x/2y = xy/2",
    r"1/c k = k/c", r"a \div b = b/a", r"c^{-1/2} = -\frac{c}{2}", r"c^-1 = \frac1c", r"1/c^2 = (1/c)^2 + 1",
    r"\frac ab c = \frac{a}{bc}", r"\frac12c = \frac{1}{2c}", r"\tfrac xyz = \frac{x}{yz}", r"a : b = a/b",
    r"a \over b = b",
    # factorials
    r"3! = 3", r"x! \ge 1", r"x!! = x", r"2! \ge 3", r"n! \ge n",
    # dots
    r"1.2.3 = 6", r"2 . 3 = 6", r"2 \cdot . 5 = 1 + y^2", r"x . y = x y", r"1 \cdot 000 = 1000",
    r"x \cdot y \cdot = x y", r"\cdot x = x", r"2 \cdot -3 = -1", r"x \ldots y = x y", r"1 + \cdots + 3 = 4",
    r"x_1 + \dots + x_2 = x_1", r"5..3 = 5",
    # delimiters
    r"(x] = x", r"[x) \ge x", r"\{x\} = x - 1", r"[x]_+ = x", r"\langle x, y \rangle = x y + 1", r"(x)^+ \ge x^2",
    r"\left( x \right] \ge x", r"\left. x \right| \ge x", r"\left. x^2 \right|_{x=1} = x^2", r"V|_{x = 0} = V",
    r"x|_{t=0} = x", r"(x, y) = x", r"(x; y) \ge x", r"[x, y] = 0", r"\lfloor x \rceil = x", r"\overline{x} = x",
    r"\bar x = x", r"\underline{x} \le \overline{x}", r"\widehat{xy} = \hat x \hat y", r"\tilde{x}^2 = \tilde{x^2}",
    r"\bold x = x", r"\mathbf{x} = x", r"\mathcal{V} = V", r"\boldsymbol{x} \ge x - x^2 - 1",
    # unicode
    "x\u200b2 \\ge x", "x^2\u200b \\ge 1", "\uff12 x = x", "x \u2212 1 \\ge x", "\u0445 = x", "x^\uff12 \\ge 1 + x",
    "x\u00b2 \\ge 1 + x^2", "x \u2265 x^2 + 1", "x \u2264 x^2", "\u03b5 \\le 0", "x \u00b7 y = 0", "1\u20442 = 2",
    "\u00bd = 2", "x \u202e0 < 1-", "x\u0338= x", "2\u00d73 = 5", "x \u2260 x", "\u221a4 = 4", "\u0661 = 2",
    "x\u0307 = x", "c\u0327 = c", "x\u00a0y = x + y", "x \u2013 y = x + y", "\u2211 x = 0", "x \u2248 y",
    "x \u2208 y", "x\u2032 = x", "\u2223x\u2223 = x", "\u2225x\u2225 = x", "\u2016x\u2016 = -x", "\ufeffx = x + 1",
    "x\u00ad y = x", "\u2070 = 1",
    # matrices
    r"\begin{pmatrix} 1 & x \\ x & 1 \end{pmatrix} \ge 0", r"\det \begin{pmatrix} 1 & 2 \\ 3 & 4 \end{pmatrix} = 2",
    r"\begin{vmatrix} 1 & 2 \\ 3 & 4 \end{vmatrix} = 2", r"\begin{bmatrix} x \\ y \end{bmatrix} = x + y",
    r"v v^T \ge 0", r"W^T v^T v W \ge 0", r"v > 0", r"v \ge W", r"v^T v = v", r"v + 1 = v", r"I v = v + 1",
    r"v^2 = v^T v + 1", r"\|v\| \ge v_1 + 1", r"v W = W v + 1", r"v \cdot W = \|v\|\|W\|", r"|v| = v", r"v/W = 1",
    r"v \otimes W = W \otimes v",
    # comments, commands
    r"x^2 \ge 0 % + x", "x^2 \\ge %\n1", r"x \ge 0 \\", r"\def\x{y} \x = x", r"\text{not } x^2 \ge 0",
    r"\text{It is false that } x^2 \ge 0", r"x^2 \ge 0 \text{ fails}", r"x^2 \ge 0 \text{ is wrong}",
    r"x^2 \overset{?}{\ge} 0", r"x^2 \stackrel{!}{=} 0", r"x^2 \ge 0 \; ?", r"\cancel{x} y = y",
    r"\phantom{x} y = y + x", r"\sout{x} = y", r"\require{x} x = y", r"x^2 \ge^* 0", r"x^2 \ge_2 1",
    r"x \overset{\text{def}}{=} y", r"\color{red} x = y", r"x \mathrel{=} y", r"\mathop{x} = y",
    r"x \hspace{1cm} y = xy", r"x \!\! y = x", r"x \mod 2 = 0", r"x \bmod 2 = 0", r"\Re x = x", r"\Im x = x",
    r"\mathrm{i}^2 = 1", r"x \circ y = x y", r"x \ast y = x y", r"x * y = x + y", r"x \star y = xy",
    r"x \oplus y = x + y", r"\nabla x = x", r"\Delta x = x", r"\Delta x^2 = (\Delta x)^2", r"\partial x = x",
    r"dx = x", r"\int x = x", r"\oint x = 0", r"\prod_{i=1}^2 x_i = x_1 + x_2", r"\sum x = x",
    r"\sum_{i=1}^{2} x = x", r"\sum_{i=1}^0 x = x", r"\sum_{i=2}^1 x_i = x_1 + x_2",
)
TRUE = (
    r"x^2 \ge 0", r"|x| \ge x", r"1.5 c \ge c", r"x \in [0, 1] \Rightarrow x^2 \le x",
    r"x \in (0, 1) \Rightarrow x^2 < x", r"\forall x \in [0, 1]: x^2 \le x", r"x > 0, y > 0 \Rightarrow x + y > 0",
    r"\forall \epsilon > 0: x y \le \frac{\epsilon}{2} x^2 + \frac{1}{2\epsilon} y^2", r"x^2 \ge 0 \ge -y^2",
    r"-1 < 0 \le x^2", r"x < x + 1 < x + 2", r"\sin^2 x + \cos^2 x = 1", r"\sin 2x = 2 \sin x \cos x",
    r"e^{-c} \le 1", r"\exp(x) > 0", r"\frac{1}{c} > 0", r"(a + b)/c = \frac{a}{c} + \frac{b}{c}",
    r"\left[ x + y \right]^2 = x^2 + 2xy + y^2", r"\bigl( x - y \bigr)^2 \ge 0", r"\{ x + y \} (x - y) = x^2 - y^2",
    r"V \ge 0", r"\dot V = -x^2 + x w", r"\dot V \le -\tfrac12 x^2 + \tfrac12 w^2", r"\frac{d}{dt} V = x \dot x",
    r"\frac{dV}{dt} = -x^2 + x w", r"\dot y = -y", r"\frac{d}{dt} y^2 = -2y^2", r"\sum_{i=1}^n v_i^2 \ge 0",
    r"x^3 \ge 0 \text{ if } x \ge 0", r"x = 1, y = 2 \Rightarrow x + y = 3",
    r"(x + y + z)^2 \le 3 (x^2 + y^2 + z^2)", r"x^{2} \geqslant 0", r"-x^2 \leqslant 0", r"1 + x \le e^x",
)
SAME = (
    r"50\% x = \tfrac12 x", r"0.5 c + .5 c = c", r"(x^2)^3 = x^6", r"x^{2^2} = x^4", r"|x|^2 = x^2",
    r"\ln(e^{x}) = x", r"\sqrt{x^2} = |x|", r"\frac{a}{c} c = a", r"a/c = \frac{a}{c}", r"\frac12 c + \frac12 c = c",
    r"2 \cdot 3 = 6", r"x \cdot y = y x", r"\|v\|^2 = v^T v", r"v^T W = W^T v", r"\sum_{i=1}^{2} x_i = x_1 + x_2",
    r"x\,y\;=\;y\,x", r"10^{2} = 100",
)

"""jiao2025: every equation, assumption and theorem, and what the stated numbers make of them.

S. Jiao, Z. Hou, Model-free adaptive iterative learning control for subway train with variable operation time
interval, Control Theory & Applications 42(3) (2025) 642-648, doi 10.7641/CTA.2024.30465 (in Chinese; sentences are quoted in
translation).

k counts samples and i trials; `_i`, `_prev`, `_prev2` stand for trials i, i-1, i-2 at the same sample, Delta for
the difference of two successive trials. The paper states no unit of u and uses k as sample and as second, so what
depends on it is asked by us for several readings. Its proof of Theorem 1 is cited; the steps here are ours, those
that its equations force. Printed sentences are given in English.
"""

from __future__ import annotations

from workbench.proof.paper import Paper

from .letters import LETTERS
from .notation import NOTATION

paper = Paper("jiao2025", " ".join((__doc__ or "").split("\n\n")[1].split()), NOTATION, LETTERS)

"""mao2018, section III: what (18)-(25) and (36) name."""

from __future__ import annotations

from ..paper import paper

paper.definition("18", "The tracking error", r"z_1(t) = x_1(t) - x_m(t)")
paper.definition("19", "The error of the speed", r"z_2(t) = x_2(t) - \alpha_1(t)")
paper.definition("21", "The design function", r"\alpha_1(t) = -r_1z_1(t) + \dot{x}_m(t),\ r_1 > 0")
paper.definition("22", "The function of the first step", r"V_1 = \frac{1}{2}z_1^2")
paper.definition("25.definition", "The Lyapunov function of section III",
            r"V_2 = V_1 + \frac{1}{2}z_2^2 + \sum_{i=1}^{l}\frac{1}{2}\left(\Gamma_{ai}^{-1}\tilde{a}_i^2 + \Gamma_{bi}^{-1}\tilde{b}_i^2 + "
            r"\Gamma_{ci}^{-1}\tilde{c}_i^2 + \Gamma_{\vartheta i}^{-1}\tilde{\vartheta}_i^2 + \Gamma_{Di}^{-1}\tilde{D}_i^2"
            r" + \frac{m_i}{\Gamma_{mi}}\tilde{\rho}_i^2\right)")

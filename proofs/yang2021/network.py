"""The radial-basis network of yang2021: its hidden output (5) and its gradient laws with momentum (10)-(15)."""

from __future__ import annotations

import sympy as sp


def hidden_output(inputs: tuple[sp.Expr, ...], centers: tuple[sp.Expr, ...], b: sp.Expr) -> sp.Expr:
    """Gaussian output of one hidden neuron, yang2021 (5)."""
    squared_distance = sum(((x - c) ** 2 for x, c in zip(inputs, centers, strict=True)), sp.Integer(0))
    return sp.exp(-squared_distance / (2 * b**2))


# The gradient laws of yang2021 (10)-(15). `error` stands for f(x) - f_hat(x).
def weight_step(rate: sp.Expr, error: sp.Expr, h: sp.Expr) -> sp.Expr:
    """Step of an output weight, yang2021 (10)."""
    return rate * error * h


def width_step(rate: sp.Expr, error: sp.Expr, weight: sp.Expr, h: sp.Expr, squared_distance: sp.Expr,
               width: sp.Expr) -> sp.Expr:
    """Step of a neuron's width, yang2021 (12)."""
    return rate * error * weight * h * squared_distance / width**3


def center_step(rate: sp.Expr, error: sp.Expr, weight: sp.Expr, h: sp.Expr, x: sp.Expr, center: sp.Expr,
                width: sp.Expr) -> sp.Expr:
    """Step of one coordinate of a neuron's center: the gradient (yang2021 (14) prints center**2 in it)."""
    return rate * error * weight * h * (x - center) / width**2


def center_step_as_printed(rate: sp.Expr, error: sp.Expr, weight: sp.Expr, h: sp.Expr, x: sp.Expr,
                           center: sp.Expr, width: sp.Expr) -> sp.Expr:
    """Step of one coordinate of a neuron's center exactly as yang2021 (14) prints it."""
    return rate * error * weight * h * (x - center**2) / width**2


def with_momentum(value: sp.Expr, step: sp.Expr, factor: sp.Expr, before: sp.Expr) -> sp.Expr:
    """Next value of an adapted parameter, yang2021 (11), (13), (15)."""
    return value + step + factor * (value - before)

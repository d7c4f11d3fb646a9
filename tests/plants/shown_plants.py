"""Plants and laws that the tests share."""

import sympy as sp

from workbench.systems.law import Reference, StateLaw
from workbench.systems.plant import Parameter, Plant

theta, omega, torque, push = sp.symbols("theta omega tau d", real=True)
mass, length, gravity, friction = sp.symbols("m l g b", positive=True)

PENDULUM = Plant(
    "pendulum", (theta, omega),
    (omega, -gravity / length * sp.sin(theta) - friction * omega + torque / (mass * length**2) + push),
    inputs=(torque,), disturbances=(push,),
    parameters=(Parameter(mass, 1.0, "kg", (0.8, 1.2)), Parameter(length, 0.5, "m"), Parameter(gravity, 9.81, "m/s^2"),
                Parameter(friction, 0.1, "1/s")),
    input_limits={torque: (-5.0, 5.0)}, units={theta: "rad", omega: "rad/s", torque: "N m"})

wanted = Reference("theta_d")
k_p, k_d = sp.symbols("k_p k_d", positive=True)
COMPUTED_TORQUE = StateLaw(
    "arm.computed_torque",
    {torque: mass * length**2 * (wanted.second_rate - k_p * (theta - wanted.value) - k_d * (omega - wanted.rate)
                                 + friction * omega) + mass * gravity * length * sp.sin(theta)},
    parameters=(k_p, k_d, mass, length, gravity, friction), references=(wanted,))
GAINS = {"k_p": 25.0, "k_d": 10.0}

x, v, u = sp.symbols("x v u", real=True)
CART = Plant("cart", (x, v), (v, u), inputs=(u,), units={x: "m"})
FREE = StateLaw("free", {torque: 0})

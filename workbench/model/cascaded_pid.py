"""What a practitioner builds: a position loop around a speed loop, with everything that is known fed forward."""

from __future__ import annotations

from functools import lru_cache

import sympy as sp

from workbench.model.law import (
    ControlLaw,
    LawState,
    desired_acceleration,
    desired_position,
    desired_speed,
    position,
    speed,
)

# Position loop (1/s), speed loop at rest and at v_fast (1/s), its integral (1/s^2), and its release at limits (s).
K_x, K_slow, K_fast, v_fast, K_i, T_t = sp.symbols("K_x K_slow K_fast v_fast K_i T_t", positive=True)
# Davis resistance per unit of mass, and the limits of traction, brakes (m/s^2) and power (W/kg).
davis_a, davis_b, davis_c = sp.symbols("davis_a davis_b davis_c", nonnegative=True)
u_traction, u_brake, power_w_per_kg = sp.symbols("u_traction u_brake power_w_per_kg", positive=True)
speed_integral = sp.Symbol("eta_v", real=True)

SLOWEST_MPS = sp.Rational(1, 10)  # below it power is no limit

asked_speed = desired_speed + K_x * (desired_position - position)
speed_error = asked_speed - speed
gain = K_slow + (K_fast - K_slow) * sp.Min(desired_speed / v_fast, 1)


def _share_beyond(at_m: float, length_m: float) -> sp.Expr:
    """The share of a train that is beyond a place of the line, of the measured position of its front."""
    way = position - sp.Float(at_m)
    return sp.Min(sp.Max(way / sp.Float(length_m), 0), 1) if length_m else (1 + sp.sign(way)) / 2


@lru_cache(maxsize=16)
def cascaded_pid(steps: tuple[tuple[float, float], ...] = (), length_m: float = 0.0) -> ControlLaw:
    """The law; steps: where the line's resistance changes (m) and by how much (N/kg), where the law is told of it;
    length_m: of the train, over which it meets them.

    Fed forward are the planned acceleration, the Davis resistance at the planned speed and the line's resistance at the
    measured position. The integral is released by what the limits cut off (back calculation), at the rate 1/T_t.
    """
    line = sum((sp.Float(change) * _share_beyond(at, length_m) for at, change in steps), sp.Integer(0))
    resistance = davis_a + davis_b * desired_speed + davis_c * desired_speed**2
    asked = desired_acceleration + resistance + line + gain * speed_error + speed_integral
    highest = sp.Min(u_traction, power_w_per_kg / sp.Max(speed, SLOWEST_MPS))
    command = sp.Min(sp.Max(asked, -u_brake), highest)
    return ControlLaw(
        id="cascaded_pid.told" if steps else "cascaded_pid",
        title=f"cascaded PID with feed-forward{', told the line' if steps else ''}",
        source="textbook: cascaded loops, gain scheduling, anti-windup by back calculation (Åström and Hägglund, "
               "Advanced PID Control, 2006)",
        information="full state, nominal model, the line" if steps else "full state, nominal model",
        command=command,
        states=(LawState(speed_integral, rate=K_i * speed_error + (command - asked) / T_t),),
        parameters=(K_x, K_slow, K_fast, v_fast, K_i, T_t, davis_a, davis_b, davis_c, u_traction, u_brake,
                    power_w_per_kg),
    )

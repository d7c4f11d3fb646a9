"""What moves, as far as a text may give its motion in a formula that is taken: closed lists of words.

A word that names a part, another one of the same kind or a device beside the plant stands in none: `leader`, `spring`,
`actuator`. What such a word is said of is left to the author.
"""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


# A plant, by what it is called or by what it is.
PLANTS = _words("""
    plant plants system systems process processes dynamics model models equation equations motion
    train trains vehicle vehicles car cars locomotive tram bus truck bicycle elevator lift crane cart cart-pole pendulum
    robot manipulator motor motors machine generator reactor tank tanks vessel satellite spacecraft rocket aircraft
    airplane helicopter quadrotor quadcopter drone ship boat submarine turbine battery circuit converter inverter
    rectifier oscillator beam ball plate mass integrator mass-spring-damper heater room building
    house boiler furnace oven exchanger incubator greenhouse freezer refrigerator column bioreactor fermenter chemostat
    population epidemic microgrid grid gyroscope telescope disk disc hovercraft unicycle
    regression segway maglev levitation ball-and-beam drivetrain powertrain drive arm
""")
# What is said of a plant that is still the same one: what it is made of, and what its equation looks like.
LIKE = _words("""
    nonlinear linear scalar first-order second-order third-order dynamical dynamic time-invariant continuous-time
    mathematical controlled following mechanical electrical electric thermal hydraulic electromechanical chemical
    longitudinal lateral vertical horizontal rotational translational planar inverted simple damped undamped
    dc ac permanent-magnet synchronous induction brushless boost buck buck-boost lc rc rl rlc double single spring-mass
    mass-spring strict-feedback control-affine affine integrator water liquid heat stirred well-stirred batch
    underactuated wheeled mobile magnetic rigid bilinear autonomous nonautonomous time-varying uncertain
    two-tank coupled-tank single-input single-state two-state stirred-tank cascade freight passenger high-speed
    railway lumped electronic interconnected
    state-space input-output governing
""")
# The loop of the plant and its law.
LOOPS = _words("loop closed-loop")
OF_LOOPS = _words("closed resulting closed-loop overall whole entire complete")
# What a plant has, by which its motion may be named, and where that is.
QUANTITIES = _words("""
    position speed velocity acceleration angle temperature level pressure current voltage concentration altitude height
    depth yaw roll pitch heading attitude displacement distance state states output outputs charge flux rate biomass
    glucose population mass density humidity frequency volume elevation
""")
OF_QUANTITIES = _words("""
    angular armature inductor capacitor stator rotor shaft coil winding air output state water liquid
    input supply source forward longitudinal lateral vertical angle pitch roll yaw lead substrate phase
""")
# What follows the plant beside it. Its motion counts where its letters bear a mark, as in `\\hat x`; a filter's always.
BESIDE = _words("observer observers estimator estimators predictor reference references")
FILTERS = _words("filter filters integrator compensator")
# A solution, along which something is claimed.
ALONG = _words("trajectories trajectory solutions solution")

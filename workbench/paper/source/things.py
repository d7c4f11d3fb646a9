"""What a text may give in a formula that is taken: closed lists of the things, beside what moves, and of their kinds.

A qualifier that makes another thing of it stands in none: `static`, `desired`, `measured`, `nominal`, `previous`.
"""

from __future__ import annotations

from workbench.paper.source import moving


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


# A control law, by its name or by what the plant is driven with.
LAWS = _words("""
    law laws controller controllers control controls input inputs feedback torque force thrust regulator
    power inflow stabilizer
""")
OF_LAWS = _words("""
    linear nonlinear proportional pd pid pi proportional-derivative proportional-integral
    proportional-integral-derivative p adaptive robust state-feedback feedback tracking backstepping sliding-mode
    sliding mode proposed following smooth cascade speed position velocity level temperature current voltage angle
    altitude heading cruise linearizing stabilizing state passivity-based energy-based traction braking motor heating
    input drive driving scalar continuous bounded super-twisting supertwisting lyapunov-based cascaded model-based
    full-state armature control cooling pump heater hovering hover pole-placement output
""")
# A function that is looked at along the motion.
FUNCTIONS = _words("""
    function functions functional functionals candidate candidates energy storage hamiltonian lyapunov entropy power
""")
OF_FUNCTIONS = _words("""
    lyapunov lyapunov's quadratic candidate control energy storage positive definite radially unbounded smooth
    total kinetic potential mechanical stored electrical magnetic energy-like following barrier composite scalar
    differentiable continuously overall logarithmic augmented common nonnegative good suitable
""")
# What a law makes small, and other values with a name of their own.
ERRORS = _words("error errors error-signal deviation deviations variable variables surface surfaces manifold manifolds "
                "coordinates coordinate transformation")
OF_ERRORS = _words("""
    tracking regulation estimation observation observer parameter position speed velocity level temperature current
    voltage angle altitude heading attitude state output formation spacing synchronization sliding switching new
    filtered filtered-error combined integral control following sliding-mode adaptation input approximation scalar
    normalized normalised transformed scaled weighted consensus compensated
""")
# Numbers that a formula may give.
NUMBERS = _words("gain gains parameter parameters constant constants coefficient coefficients number numbers scalar "
                 "matrix ratio product sum difference square")
OF_NUMBERS = _words(
    "positive real time scalar control controller design following damping feedback adaptive adaptation")
# What a law says that moves an estimate.
UPDATES = _words("adaptation update learning tuning adaptive parameter estimation weight gradient")

# What acts from outside.
SIGNALS = _words("disturbance disturbances uncertainty uncertainties perturbation perturbations noise signal signals")
OF_SIGNALS = _words("external exogenous lumped matched bounded unknown constant known scalar load parametric input new "
                    "compensating")

HEADS = (moving.PLANTS | moving.LOOPS | moving.QUANTITIES | moving.BESIDE | moving.FILTERS | moving.ALONG | LAWS
         | FUNCTIONS | ERRORS | NUMBERS | SIGNALS)
KINDS = (
    (moving.PLANTS, moving.PLANTS | moving.LIKE | moving.OF_LOOPS | moving.QUANTITIES | moving.OF_QUANTITIES | ERRORS
     | OF_ERRORS | moving.BESIDE | moving.FILTERS),
    (moving.LOOPS, moving.OF_LOOPS), (moving.ALONG, moving.PLANTS | moving.OF_LOOPS | moving.LIKE),
    (moving.QUANTITIES, moving.QUANTITIES | moving.OF_QUANTITIES | moving.PLANTS | moving.LIKE),
    (LAWS, LAWS | OF_LAWS | moving.PLANTS | UPDATES | {"lyapunov"}),
    (FUNCTIONS, FUNCTIONS | OF_FUNCTIONS), (ERRORS, ERRORS | OF_ERRORS | moving.PLANTS),
    (NUMBERS, NUMBERS | OF_NUMBERS), (SIGNALS, SIGNALS | OF_SIGNALS),
    (moving.BESIDE, OF_ERRORS | moving.LIKE | _words(
        "luenberger linear high-gain disturbance gradient least-squares adaptive")),
    (moving.FILTERS, moving.LIKE | {"low-pass", "command"}))
OF_THEM = frozenset().union(*(kinds for _, kinds in KINDS))

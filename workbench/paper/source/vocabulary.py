"""The words that sentences of papers are read by. A sentence with any other word is left to the author.

A word may stand here only if no sentence made of these words takes back, restricts or doubts a formula: neither "not"
nor "small", neither "assumed" nor "ideal".
"""

from __future__ import annotations


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


# What a formula is called that follows from others.
DERIVED = _words("""
    derivative derivatives rate inequality inequalities identity identities equality estimate estimates expression
    relation relations bound bounds term terms product sum integral difference side sides result increment expansion
    square squares part
""")
# What an author may give: a system, a law, a quantity.
GIVEN = _words("""
    system systems subsystem subsystems plant plants model models dynamics equation equations motion law laws
    controller controllers control controls input inputs observer observers filter filters estimator differentiator
    compensator regulator predictor function functions candidate functional energy storage variable variables
    surface manifold manifolds reference references output outputs state states signal signals trajectory
    trajectories quantity quantities parameter parameters gain gains constant constants coefficient coefficients
    number numbers scalar scalars integer integers weight weights real reals position positions speed velocity
    acceleration force torque thrust current voltage charge flux temperature level pressure concentration flow mass
    inertia length angle angles height distance time period frequency friction damping stiffness resistance
    capacitance inductance gravity drag load moment power disturbance disturbances uncertainty uncertainties noise
    perturbation perturbations estimation adaptation update rule algorithm scheme mechanism feedback feedforward
    backstepping tracking stabilization regulation synchronization transformation change coordinates coordinate
    notation definition vehicle train car robot arm link joint pendulum cart motor rotor drive machine converter
    circuit generator reactor tank satellite spacecraft aircraft quadrotor drone ship vessel turbine battery
    actuator actuators sensor sensors agent agents node nodes leader follower followers platoon network oscillator
    spring damper body wheel wheels tyre engine pump valve beam rod string chain grid cell cells reservoir axle
    shaft gear gearbox bus line track rail road wind wave waves field coil magnet plate ball mirror laser process
    vector vectors matrix norm set-point setpoint path curve slope weighting learning memory buffer delay lag
    bandwidth leakage projection deadzone kernel basis regressor neuron neurons layer layers ratio factor factors
    unit units exponent index error errors mean average maximum minimum closed-loop loop sliding-mode mode modes
    stored armature winding dc ac permanent-magnet on-board
    traction braking adhesion propulsion steering suspension chassis tire tires yaw pitch roll heading rudder keel hull
    altitude depth azimuth attitude rotation rotations curvature radius diameter width area volume density viscosity
    conductivity permeability enthalpy entropy heater cooler evaporator condenser compressor fan blade propeller
    rotors wing fin flap valve piston cylinder lever crank belt clutch brake brakes bearing hinge crane hoist cable
    rope payload cart-pole exoskeleton endoscope microphone loudspeaker electrode membrane cantilever beam piezo
    photovoltaic panel grid-side substation feeder busbar resistor capacitor inductor diode duty ripple reactance
    impedance admittance susceptance conductance electron photon concentration reagent substrate biomass nutrient
    enzyme ph stock inventory queue demand supply price tax interest rate rates speeds velocities accelerations forces
    torques currents voltages pressures temperatures masses lengths heights periods frequencies norms errors
    inflow outflow inlet outlet bias offset ramp deflection elongation strain stress sway tension thrusters sampling
    Lyapunov lyapunov barrier
""")
# What a text names besides.
TEXT = _words("""
    lemma lemmas theorem theorems corollary proposition propositions definition definitions remark remarks
    assumption assumptions property properties fact facts equation equations eq eqs section sections proof paper
    appendix chapter rule rules chain calculus triangle mean value step steps argument analysis computation
    calculation substitution inspection construction choice design method approach stability convergence boundedness
    passivity performance objective problem structure form compact matrix figure table display displays lecture
    course notes bracket brackets parentheses solution solutions point formula formulas algebra manipulation
    manipulations nonnegativity positivity monotonicity continuity convexity skew-symmetry symmetry linearity
    rearrangement differentiation integration
""")
NAMES = _words("""
    young young's cauchy schwarz cauchy-schwarz cauchy–schwarz hölder's holder's jensen's gronwall's minkowski's
    taylor's leibniz newton's newton kirchhoff's euler lagrange euler-lagrange lipschitz barbalat's barbalat lasalle
    lasalle's bellman's davis davis' riccati kalman luenberger lyapunov lyapunov's peter-paul bernoulli's hooke's
    ohm's faraday's riemann grönwall's coulomb stribeck nussbaum
""")
MODIFIERS = _words("""
  positive nonnegative non-negative strictly real real-valued scalar known unknown constant bounded design control
  tuning feedback observer adaptation learning adaptive nonlinear linear quadratic cubic dynamic dynamical static
  smooth continuous differentiable time-varying time-invariant measured measurable available external exogenous
  lumped matched internal virtual auxiliary filtered estimated total kinetic potential mechanical electrical
  thermal hydraulic angular longitudinal lateral vertical horizontal radial viscous aerodynamic rotational
  translational following first second third fourth last final main basic classical standard usual well-known
  elementary direct simple resulting corresponding composite augmented overall whole entire full complete closed
  closed-loop open-loop regulation tracking estimation observation prediction synchronization formation
  position speed velocity attitude output state input parameter parametric time upper lower same new given desired
  prescribed sampled switched hybrid uncertain coupled cascaded second-order first-order third-order single-input
  continuous-time lyapunov control-lyapunov energy storage candidate sliding cross definite semidefinite left-hand
  right-hand left right proportional integral derivative reference two three four finite physical mathematical
  dimensionless interconnected normalized inertial magnetic electric switching standing nonholonomic underactuated
  planar unmeasured unmeasurable unmodelled unmodeled manipulated commanded applied
  one-dimensional inverted rigid flexible elastic robust optimal exponential asymptotic global uniform ultimate
  practical symmetric discontinuous supertwisting above preceding previous foregoing mixed binomial
  arithmetic-geometric geometric arithmetic starting super-twisting backstepping barrier triangle
""")
DETERMINERS = _words("the a an our its their this these each his")
CONNECTIVES = _words("""
    hence thus therefore consequently moreover furthermore also then finally accordingly clearly obviously evidently
    similarly likewise indeed further next so additionally and here now first second again altogether equivalently
    however where besides subsequently immediately directly trivially
""")
HAVE = _words("""
    have get obtain find see conclude deduce derive compute observe note arrive infer establish write calculate
    reach verify know
""")
HAS = _words("""
    has gets obtains finds sees concludes deduces derives computes observes notes arrives infers
""")
SEEN = _words("""
    known
    seen verified shown got obtained checked proved proven deduced concluded found noted noticed established
    observed inferred derived
""")
AIM = _words("""
    prove show analyse analyze establish study ensure guarantee investigate bound estimate simplify verify
""")
GIVES = _words("""
    gives give yields yield implies imply produces leads lead results provides shows show becomes become ensures
    guarantees equals means reads gave yielded
""")
IS = _words("""
    is are becomes become reads read equals equal satisfies satisfy obeys obey fulfils fulfills follows follow
""")
MADE = _words("""
    given written rewritten expressed described bounded estimated computed obtained represented modelled modeled
    governed calculated found derived stated defined chosen designed selected proposed constructed updated taken
    introduced generated formed posed used implemented denoted reduced simplified dominated majorized upper-bounded
    lower-bounded formulated
""")
DEFINE = _words("""
    put define introduce consider choose select propose set take design denote use adopt pick construct employ study
    let apply formulate
""")
DEFINING = _words("defining introducing choosing selecting taking denoting letting designing")
GERUNDS = _words("""
    squaring considering bounding differentiating substituting inserting plugging replacing taking computing
    calculating expanding completing adding subtracting combining rearranging integrating multiplying collecting
    grouping factoring simplifying summing applying using recalling comparing writing rewriting invoking exploiting
    employing evaluating putting
""")
# What a sentence without a displayed formula may say besides, where it says nothing of a formula.
PLAIN = _words("""
    we the of and in to for with by is are on from be has have been will as at its our their which whose where here
    describes describe governs models uses use used moves drives acts act enters enter vary varies move
    tracks track converges converge tends goes stabilizes stabilize measured measures estimates estimate study
    studies consider considers considered present presents presented propose proposed design designed designs derive
    derived develop developed give given gives introduce introduced analyse analyze prove proved proves show shows
    ensure ensures guarantee guarantees obtain obtained summarize summarizes organized follows recall recalls
    completes finished complete ends done begin begins start starts turn now next then finally first second third
    also moreover furthermore thus hence therefore so however both between through into over under against along
    during after before around called denoted known unknown available driven mounted connected attached powered
    equipped subject due acting such well depends depend related equivalent equal application applications
    engineering practice theory literature work contribution contributions idea review overview outline introduction
    conclusion conclusions summary preliminaries results simulation simulations experiment experiments
    implementation comparison discussion background formulation statement statements notations nomenclature
    appendices acknowledgment abstract keywords concluding numerical experimental extension class family kind type
    interest importance role aim goal purpose task reader key point points remaining transport industry technology
    research researchers years attention many decades widely often several various important practical efficient
    safe reliable modern autonomous electric comfort safety efficiency quality accuracy operation operators
    passengers high fast quick better larger higher faster increases increase decreases reduces improves improve
    decay decays transient response responses speed-up origin equilibrium solution solutions can easily
    straightforward details detail standing long together
""")
# Behind these "error" is the difference of two signals; by itself it may be a mistake.
BEFORE_ERROR = _words("""
    squared absolute tracking estimation position velocity speed parameter observation regulation approximation
    state output control
    formation synchronization prediction learning modelling attitude closed-loop angular heading angle input
    filtered level temperature current voltage spacing adaptation normalized normalised transformed scaled weighted
    consensus compensated
""")
ADVERBS = _words("""
    also then now thus therefore hence further easily directly immediately finally first next clearly readily again
""")
# What a letter may be called.
ADJECTIVES = _words("""
    positive nonnegative non-negative real known unknown constant bounded measured measurable available continuous
    differentiable smooth scalar given external uncertain fixed
""")
MANNER = _words("""
    globally uniformly asymptotically exponentially ultimately monotonically semi-globally semiglobally practically
""")
STABLE = _words("stable")
# Names of environments that hold what is around them together, and say nothing.
LAYOUT = _words("""
    center itemize enumerate abstract minipage small document subequations IEEEkeywords keywords flushleft
    flushright footnotesize normalsize description spacing singlespace doublespace quote-free sloppypar paragraph
    frontmatter mainmatter multicols large
""")
# Pronouns and words like them, by which a sentence may speak of what stands before it.
POINTERS = _words("""
    this that these those it its they them both neither none such which so not no nor above last latter former
    preceding
    previous here there all each either one everything nothing something what formula formulas claim claims statement
    statements assertion mistake mistakes error errors flaw flaws fallacy fallacies blunder trap
""")
# What no formula is that follows from others, though a signal may be it.
WISHED = _words("desired prescribed given objective problem assumption assumptions performance choice")
# Words of sentences that claim a formula in a form of their own. None denies, doubts, wants, quotes, or says when.
CLAIMING = _words("""
    since because good candidate known remaining setting inserting both
    it that this these its which there here we one us let's both all any every each who whose where is are was
    be been has have made makes make a an the of and in on for with by to as at from into over under along between
    through via upon among within together so then thus hence therefore also now next finally first second third
    again too moreover furthermore note notes noted notice noticing noting observe observed observing recall recalls
    recalled remember say says state states record recorded summarize summarizes summarizing show shows shown
    showing prove proves proved proven establish establishes established verify verifies verified check checked
    demonstrate demonstrates demonstrated confirm confirms confirmed see sees seen find finds found follow follows
    followed following obtain obtains obtained obtaining get gets got getting gain gains gained derive derives
    derived deduce deduced conclude concludes concluded concluding infer inferred arrive arrives arrived reach
    reached come comes read reads reading yield yields yielded yielding give gives given giving imply implies
    implied implying lead leads leading result results resulting produce produces produced mean means meaning ensure
    ensures ensuring guarantee guarantees hold holds holding become becomes became turn turns equal equals amount
    amounts rely relies relying rests use uses used using useful apply applies applied applying employ employs
    employed exploit exploiting invoke invoking invoked help helps write written rewrite rewritten rewriting express
    expressed simplify simplified simplifies simplifying expand expanded expanding rearrange rearranged rearranging
    collect collecting group grouping factor factoring combine combined combining combines add adding added subtract
    subtracting sum summing multiply multiplying multiplied divide dividing divided integrate integrating
    differentiate differentiating differentiated complete completing completed substitute substituting substituted
    insert inserting inserted plug plugging plugged put putting take taking taken bound bounding bounded estimate
    estimating estimated majorize majorizing evaluate evaluating evaluated compute computing computed calculate
    calculating calculated cancel cancels cancelling square squaring analyze analyse analyzed analysing analyzing
    investigate investigated study studied handle immediate immediately obvious obviously clear clearly evident
    evidently trivial trivially easy easily simple simply direct directly straightforward readily elementary basic
    standard classical usual well-known famous known key main important crucial central fundamental helpful
    instrumental convenient compact final last suitable above below previous preceding foregoing same sequel later
    calculation computation algebra manipulation manipulations arithmetic derivation derivations argument arguments
    reasoning observation observations fact facts tool tools step steps consequence consequences conclusion
    conclusions property properties inequality inequalities identity identities equality equalities equation
    equations relation relations formula formulas expression expressions bounds estimates term terms factors product
    products sums difference differences squares quotient ratio side sides bracket brackets parenthesis parentheses
    quantity quantities numbers number reals pair proof lemma theorem proposition corollary definition remark
    section subsection chapter appendix figure table lecture end account addition particular order view light virtue
    basis aid sake stability boundedness convergence analysis design real nonnegative positive semidefinite definite
    quadratic indefinite cross mixed left right left-hand right-hand upper lower type form forms two three four five
    six up out more further namely indeed precisely exactly depend depends depending involve involves involved
    interpretation physical geometric perform performing performed proceed proceeds proceeding start starts starting
    begin begins beginning tend tends tending enter enters entering channel constant constants point points pointing
    pointed motivate motivated motivating binomial arithmetic-geometric am-gm selected
""")
# What a text may say besides where it shows no formula: of a field, a design, a figure.
TELLING = _words("""
    area areas active activity field fields research topic topics interest concept concepts idea ideas framework
    structure structures architecture architectures technique techniques strategy strategies procedure procedures
    technology technologies industry industries science mathematics physics biology chemistry medicine economics
    robotics automation aerospace automotive marine maritime railway railways traffic transport transportation
    logistics manufacturing aerial unmanned autonomous vehicle vehicles drones ships buildings bridge bridges cranes
    crane need needs tool tools ingredient ingredients more today nowadays recent recently decade decades year years
    century past attract attracted attracting receive received receiving find found become became attention
    considerable significant growing increasing great much wide widespread broad vast huge works publications papers
    book books monograph textbook textbooks survey surveys overview investigated addressed tackled considered
    treated discussed described explained illustrated depicted sketched collected listed recalled reviewed organized
    structured divided arranged devoted dedicated diagram diagrams block blocks picture pictures photograph
    schematic implementation implemented hardware software computer processor code laboratory bench setup test tests
    measured comfort safety efficiency performance quality accuracy precision reliability robustness cost costs
    passengers operators engineers practitioners users channel channels enters passes carried performed conducted
    mounted rigidly suspended temperature wind weather terrain surface surfaces water air sea ground road gravity
    friction inertia mass energy work heat north south east west left right front rear top bottom red green blue
    solid dashed dotted line lines axis axes it they them who whom also often frequently commonly widely mainly
    chiefly largely motivated inspired standard later sequel below above parts part needed
""")
# Before these a formula is no claim of its own.
HELD = _words("""
    replacing given taking with for in on at under putting put take let over within into among along of considering
    setting
""")
# Of how many something is said.
ALL = _words("all every any each some both")

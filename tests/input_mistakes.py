"""Mistakes in a scenario's and a line's file, each with what must be said about it."""

from scenarios import YANG

LINE = YANG.parent / "line.toml"
TEXT, LINE_TEXT = YANG.read_text(encoding="utf-8"), LINE.read_text(encoding="utf-8")
GRADES = LINE_TEXT[LINE_TEXT.index("grade = ["):LINE_TEXT.index("curve = [")]

# What is written instead of what, the key that must be named, and words of the problem and of its remedy.
SCENARIO_MISTAKES = {
    "unit typo": ("mass_kg = 200000.0", "mass_t = 200.0", "train.mass_t", "did you mean 'mass_kg'"),
    "spelling": (
        "max_traction_n = 2", "max_tration_n = 2", "train.max_tration_n", "did you mean 'max_traction_n'",
    ),
    "unknown key": ("[train]", "[train]\ncolour = 1.0", "train.colour", "unknown key: remove it"),
    "a delay that no memory holds": ("[train]", "[sensing]\nmeasurement_delay_s = 1e300\n[train]",
                                     "sensing.measurement_delay_s", "less than or equal to 60"),
    "unknown table": ("[train]", "[wagons]\na = 1\n[train]", "wagons", "unknown key"),
    "missing key": ("dwell_s = 5.0\n", "", "simulation.dwell_s", "is missing: add it"),
    "missing in the reference": ("braking_mps2 = 0.5\n", "", "reference.braking_mps2", "is missing: add it"),
    "missing name": ('name = "yang2021"\n', "", "name", "is missing: add it"),
    "a name for no number": ('name = "yang2021"\n', 'name = "nan"\n', "name", "choose another name"),
    "missing version": ("version = 1\n", "", "version", "is missing: add it"),
    "negative mass": ("mass_kg = 200000.0", "mass_kg = -200000.0", "train.mass_kg", "greater than 0"),
    "mass in tonnes": ("mass_kg = 200000.0", "mass_kg = 200.0", "train", "is it in tonnes?"),
    "traction in kN": ("max_traction_n = 200000.0", "max_traction_n = 200.0", "train", "is it in kN?"),
    "braking in kN": ("max_braking_n = 240000.0", "max_braking_n = 240.0", "train", "is it in kN?"),
    "resistance in N": ("davis_a_mps2 = 0.3", "davis_a_mps2 = 2160.0", "train", "divide by mass_kg"),
    "power in kW": (
        "max_braking_n = 240000.0\n\n[train.source]",
        "max_braking_n = 240000.0\nmax_power_w = 3000.0\n[train.source]\nmax_power_w = 'assumed: x'", "train",
        "is it in kW?",
    ),
    "NaN": ("davis_a_mps2 = 0.3", "davis_a_mps2 = nan", "train.davis_a_mps2", "give a number"),
    "infinity": (
        "davis_a_mps2 = 0.3", "davis_a_mps2 = inf", "train.davis_a_mps2",
        "inf is not a finite number: give a number",
    ),
    "infinite step": (
        "plant_step_s = 0.001", "plant_step_s = inf", "simulation.plant_step_s",
        "inf is not a finite number: give a number",
    ),
    "text for a number": (
        "cruise_mps2 = 0.6", 'cruise_mps2 = "0.6"', "reference.cruise_mps2", "valid number",
    ),
    "boolean for a number": (
        "dwell_s = 5.0", "dwell_s = true", "simulation.dwell_s", "valid number, not True",
    ),
    "boolean for a count": ("runs = 100", "runs = true", "uncertainty.runs", "valid integer"),
    "fraction for a count": ("runs = 100", "runs = 10.5", "uncertainty.runs", "valid integer"),
    "number for text": ('title = "RBFNN', 'title = 3 # "', "title", "valid string"),
    "a huge number": ("mass_kg = 200000.0", f"mass_kg = 1{'0' * 400}", "train.mass_kg", "finite number that fits"),
    "version 2": ("version = 1", "version = 2", "version", "this workbench reads version = 1"),
    "version true": ("version = 1", "version = true", "version", "this workbench reads version = 1"),
    "version as text": ("version = 1", 'version = "1"', "version", "this workbench reads version = 1"),
    "missing source": (
        'ramp_s = "assumed: accel', 'x = "assumed: accel', "reference", "source.ramp_s is missing",
    ),
    "source of nothing": (
        'dwell_s = "assumed', 'wait_s = "assumed: x"\ndwell_s = "assumed', "simulation",
        "source.wait_s explains a value that is not stated: remove it",
    ),
    "source without its kind": (
        'seed = "assumed: any"', 'seed = "who knows"', "uncertainty", "must start with",
    ),
    "no sources": ("[train.source]", "[train.sources]", "train.sources", "did you mean 'source'"),
    "unknown law": (
        'law = "pid"', 'law = "lqr"', "controllers.pid.law", "choose one of pid, ",
    ),
    "missing parameter": (
        "eta = 0.2, varpi = 0.04", "eta = 0.2", "controllers.rbf_pid.parameters", "'varpi' is missing: add it",
    ),
    "unknown parameter": (
        "chi = 0.1,", "chi = 0.1, xi = 0.1,", "controllers.rbfnn_pocrac.parameters",
        "unknown 'xi': choose among alpha",
    ),
    "negative gain": (
        "beta = 0.51, chi", "beta = -0.51, chi", "controllers.rbfnn_pocrac.parameters",
        "beta = -0.51 must be positive",
    ),
    "parameter not a number": (
        "eta = 0.2", "eta = nan", "controllers.rbf_pid.parameters.eta", "give a number",
    ),
    "missing initial value": (
        "c_hat = 0.0, W_hat = 0.0", "c_hat = 0.0", "controllers.rbfnn_pocrac.initial",
        "'W_hat' is missing: add it",
    ),
    "unknown initial value": (
        "{ eta_e = 0.0 }", "{ eta_e = 0.0, x = 1.0 }", "controllers.pid.initial",
        "unknown 'x': choose among eta_e",
    ),
    "initial value for MPC": (
        "observer_gain = 0.3 }", "observer_gain = 0.3 }\ninitial = { x = 1.0 }", "controllers.mpc",
        "source.initial is missing",
    ),
    "missing MPC parameter": (
        "horizon = 25, ", "", "controllers.mpc.parameters", "'horizon' is missing: add it",
    ),
    "too few centers": (
        "other_centers = [16.0]", "other_centers = []", "controllers.rbfnn_pocrac.neurons.other_centers",
        "give one for each",
    ),
    "too many centers": (
        "other_centers = [16.0]", "other_centers = [16.0, 1.0]",
        "controllers.rbfnn_pocrac.neurons.other_centers", "give one for each",
    ),
    "no neurons counted": (
        "count = 55", "count = 0", "controllers.rbfnn_pocrac.neurons.count", "or equal to 1",
    ),
    "more neurons than memory": (
        "count = 55", "count = 1000000000000", "controllers.rbfnn_pocrac.neurons.count",
        "less than or equal to",
    ),
    "unknown estimates": (
        'estimates = "corrected"', 'estimates = "guessed"', "controllers.rbfnn_pocrac.estimates",
        "'corrected' or 'explicit'",
    ),
    "period between two steps": (
        "period_s = 0.001", "period_s = 0.0015", "controllers.rbfnn_pocrac.period_s", "choose a multiple",
    ),
    "period shorter than a step": (
        "period_s = 0.001", "period_s = 0.0004", "controllers.rbfnn_pocrac.period_s", "choose a multiple",
    ),
    "tiny step": ("plant_step_s = 0.001", "plant_step_s = 1e-300", "simulation.plant_step_s", "greater than"),
    "endless dwell": ("dwell_s = 5.0", "dwell_s = 1e300", "simulation.dwell_s", "less than or equal to"),
    "endless log": ("log_every_s = 0.1", "log_every_s = 1e-5", "simulation.log_every_s", "log less often"),
    "cruise below the resistance": ("cruise_mps2 = 0.6", "cruise_mps2 = 0.2", "reference", "raise it"),
    "start below the resistance": ("start_mps2 = 0.48", "start_mps2 = 0.2", "reference", "raise it"),
    "resistance without speed": (
        "davis_b_per_s = 4e-3\ndavis_c_per_m = 1.6e-4", "davis_b_per_s = 0.0\ndavis_c_per_m = 0.0",
        "reference", "use kind = 'cruise_speed'",
    ),
    "unknown reference": (
        'kind = "davis_cruise"', 'kind = "sine"', "reference", "'davis_cruise', 'cruise_speed'",
    ),
    "no reference": ('kind = "davis_cruise"\n', "", "reference", "discriminator 'kind'"),
    "duplicated key": ("version = 1", "version = 1\nversion = 1", "", "is not valid TOML: Cannot overwrite"),
    "duplicated table": ("[train]", "[reference]\n[train]", "", "is not valid TOML"),
    "unclosed bracket": ("factors = [", "factors = [[", "", "is not valid TOML"),
    "an integer without end": ("seed = 2021", f"seed = {'9' * 5000}", "", "is not valid TOML"),
    "brackets without end": ("seed = 2021", f"seed = {'[' * 5000}", "", "nested too deeply"),
    "track is no name": ('track = "line.toml"', "track = 3", "track", "name the line's TOML file"),
    "no track": ('track = "line.toml"\n', "", "track", "name the line's TOML file"),
    "a name that is no file name": (
        'name = "yang2021"', 'name = "../yang"', "name", "is no name: use letters",
    ),
    "a controller that is no file name": (
        "[controllers.pid]", '[controllers."../pid"]', "controllers", "is no name",
    ),
    "a key of two lines": ("[train]", '[train]\n"a\\nb" = 1', "train.a b", "unknown key"),
    "printed for nobody": (
        '{ controller = "pid", pos', '{ controller = "pit", pos', "", "'pit' is no controller",
    ),
    "a pair of three": (
        "speed_error_mps = [-0.28, 0.32]", "speed_error_mps = [-0.28, 0.32, 1.0]",
        "printed_table.rows[0].speed_error_mps", "correct it",
    ),
}

# What is written instead of what, and the words that must follow the name of the line's file.
LINE_MISTAKES = {
    "gap": (
        "start_m = 3800.0, end_m = 9200.0", "start_m = 3900.0, end_m = 9200.0",
        "grade[1]: gap from 3800 m to 3900 m: let each section start where the one before ends",
    ),
    "overlap": (
        "start_m = 4600.0", "start_m = 4500.0",
        "curve[1]: overlap from 4500 m to 4600 m: let each section start where the one before ends",
    ),
    "not sorted": (
        "start_m = 9200.0, end_m = 21400.0", "start_m = 100.0, end_m = 21400.0",
        "grade[2]: positions must increase, but 100 m comes after 3800 m: sort the sections",
    ),
    "gap at the start": (
        "start_m = 0.0, end_m = 3800.0", "start_m = 10.0, end_m = 3800.0", "grade[0]: gap from 0 m to 10 m",
    ),
    "gap at the end": (
        "end_m = 53880.0, grade", "end_m = 53000.0, grade",
        "grade: gap from 53000 m to the end of the line at 53880 m: lengthen",
    ),
    "beyond the end": (
        "end_m = 53880.0, radius", "end_m = 54000.0, radius",
        "curve[6]: ends at 54000 m, beyond length_m = 53880: shorten it",
    ),
    "a section of no length": (
        "start_m = 0.0, end_m = 3800.0", "start_m = 3800.0, end_m = 3800.0",
        "grade[0]: end_m = 3800 must be greater than start_m = 3800",
    ),
    "backwards": (
        "start_m = 0.0, end_m = 3800.0", "start_m = 3800.0, end_m = 0.5",
        "grade[0]: end_m = 0.5 must be greater than start_m = 3800",
    ),
    "negative position": (
        "start_m = 0.0, end_m = 3800.0", "start_m = -1.0, end_m = 3800.0", "grade[0].start_m: ",
    ),
    "grade in parts of one": ("grade_permille = 5.0", "grade_permille = 500.0", "grade[3].grade_permille: "),
    "grade without end": ("grade_permille = 5.0", "grade_permille = inf", "grade[3].grade_permille: "),
    "radius of zero": ("radius_m = 700.0", "radius_m = 0.0", "curve[4].radius_m: "),
    "radius in kilometres": (
        "radius_m = 700.0", "radius_m = 0.7",
        "curve[4]: radius_m = 0.7 is not a railway curve: give at least 50 (metres), or inf",
    ),
    "radius that is no number": ("radius_m = 700.0", "radius_m = nan", "curve[4].radius_m: "),
    "radius as a boolean": ("radius_m = 700.0", "radius_m = true", "curve[4].radius_m: "),
    "radius with another unit": (
        "radius_m = 700.0", "radius_km = 0.7", "curve[4].radius_km: unknown key; did you mean 'radius_m'",
    ),
    "infinite length": ("length_m = 53880.0", "length_m = inf", "length_m: "),
    "no grades": (
        GRADES, "grade = []\n",
        "grade: no section given: cover the line from 0 to 53880 m",
    ),
    "no source": ('grade = "paper, Table 1"\n', "", "source.grade is missing: say where"),
}

"""A report of a tiny scenario with claims of every verdict, some of them hostile."""

from scenarios import variant_of
from short_sweep import write_scenario

from workbench.report.claims import VERDICTS
from workbench.report.page import ReportContent
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.simulate.sweep import sweep
from workbench.trains.scenario import load_scenario

HOSTILE = "<script>alert('x')</script><img src=x onerror=alert(1)>\"'&"

EXTRA = """
[[printed_values]]
source = "paper, section 6.1"
controller = "pid"
metric = "command_max"
value = 0.48
unit = "m/s^2"
[[printed_values]]
source = "paper, section 6.2"
controller = "narrow"
metric = "no_such_metric"
value = 158.0
unit = "s"
[[variants]]
title = "a weak motor & a hostile <b>title</b>"
set = { "train.max_traction_n" = 20000.0 }
"""


def small_content(folder):
    """Two controllers, one of them twice; a claim a verdict, a hostile one and one without anything but its id."""
    path = write_scenario(folder, EXTRA)
    scenario = load_scenario(path)
    runs = [simulate(scenario, name) for name in scenario.controllers]
    changed = variant_of(path, scenario.variants[0])
    claims = [
        {"id": f"yang2021:{number}", "paper": "yang2021", "equation": str(number), "kind": "identity",
         "statement": rf"e_{{{number}}} = \frac{{a}}{{b}}", "verdict": verdict, "method": "a method",
         "scope": "all", "certificate": None, "counterexample": {"x": "1/2"}, "correction": "a = b",
         "premises": ["yang2021:1"], "tainted_by": [], "trust": "exact", "seconds": 0.1}
        for number, verdict in enumerate(VERDICTS, start=1)
    ]
    claims.append({"id": f"yang2021:{HOSTILE}", "statement": HOSTILE, "title": HOSTILE, "note": HOSTILE,
                   "verdict": HOSTILE, "method": HOSTILE, "counterexample": [HOSTILE], "premises": [HOSTILE],
                   "tainted_by": [HOSTILE], "correction": rf"\text{{{HOSTILE}}}"})
    claims.append({"id": "yang2021:bare"})
    return ReportContent(
        scenario=scenario, claims={"version": 1, "claims": claims, "summary": {}}, runs=runs,
        metrics=[measure(run, scenario) for run in runs], sweep=sweep(scenario, path, 2, 7, workers=1), sweep_seed=7,
        variants=[(scenario.variants[0],
                   [measure(simulate(changed, name), changed) for name in changed.controllers])],
        timings={"proof": 1.5}, commands=["workbench report a<b"],
    )

"""Facts of functions, forged: used where they do not hold, or for more than they say."""

import pytest

from workbench.proof.checker import CertificateError, check


def certificate(show: str, factors: list[dict], assume: tuple[str, ...] = (), coefficient: str = "1",
                multiplier: tuple[dict, ...] = ()) -> dict:
    names = {name: "1" for name in ("x", "y") if name in show}
    proof = {"rule": "combination", "terms": [{"coefficient": coefficient, "factors": factors}]}
    return {"claim": "forged2020:1", "version": 1, "verdict": "proved", "example": names,
            "goal": {"assume": list(assume), "show": [show]},
            "proofs": [proof | ({"multiplier": list(multiplier)} if multiplier else {})]}


GENUINE = {
    "circle": certificate("sin(x)**2 + cos(x)**2 == 1", [{"fact": "circle", "of": "x"}]),
    "parabola": certificate("cos(x) >= 1 - x**2/2", [{"fact": "cosine_parabola", "of": "x"}]),
    "tangent": certificate("sin(x) <= x", [{"fact": "sine_tangent", "of": "x"}], ("x >= 0",)),
    "sine of a sum": certificate("sin(x + y) == sin(x)*cos(y) + cos(x)*sin(y)",
                                 [{"fact": "sine_sum", "of": "x", "and": "y"}]),
    "cosine of a sum": certificate("cos(x + y) == cos(x)*cos(y) - sin(x)*sin(y)",
                                   [{"fact": "cosine_sum", "of": "x", "and": "y"}]),
    "exp of a sum": certificate("exp(x + y) == exp(x)*exp(y)", [{"fact": "exp_sum", "of": "x", "and": "y"}]),
    "log of a product": certificate("log(x*y) == log(x) + log(y)", [{"fact": "log_product", "of": "x", "and": "y"}],
                                    ("x > 0", "y > 0")),
}
FORGED = {
    "an angle that may be negative": certificate("sin(x) <= x", [{"fact": "sine_tangent", "of": "x"}]),
    "an angle that is negative": certificate("-sin(x) <= -x", [{"fact": "sine_tangent", "of": "-x"}], ("x >= 0",)),
    "log of what may be negative": certificate("log(x*y) == log(x) + log(y)",
                                               [{"fact": "log_product", "of": "x", "and": "y"}], ("x*y > 0",)),
    "log of one that may be negative": certificate("log(x*y) == log(x) + log(y)",
                                                   [{"fact": "log_product", "of": "x", "and": "y"}], ("x > 0",)),
    "another angle": certificate("sin(x)**2 + cos(y)**2 == 1", [{"fact": "circle", "of": "x"}]),
    "a smaller circle": certificate("sin(x)**2 + cos(x)**2 == 1/2", [{"fact": "circle", "of": "x"}]),
    "more than a parabola": certificate("cos(x) >= 1 - x**2/4", [{"fact": "cosine_parabola", "of": "x"}]),
    "a parabola turned": certificate("cos(x) <= 1 - x**2/2", [{"fact": "cosine_parabola", "of": "x"}], (), "-1"),
    "a sum taken for a difference": certificate("sin(x - y) == sin(x)*cos(y) + cos(x)*sin(y)",
                                                [{"fact": "sine_sum", "of": "x", "and": "-y"}]),
    "a cosine of a sum as of a sine": certificate("cos(x + y) == cos(x)*cos(y) + sin(x)*sin(y)",
                                                  [{"fact": "cosine_sum", "of": "x", "and": "y"}]),
    "exp of a product": certificate("exp(x*y) == exp(x)*exp(y)", [{"fact": "exp_sum", "of": "x", "and": "y"}]),
    "a sum without its second part": certificate("exp(x + y) == exp(x)*exp(y)", [{"fact": "exp_sum", "of": "x"}]),
    "parts that are no texts": certificate("exp(x + y) == exp(x)*exp(y)", [{"fact": "exp_sum", "of": ["x"], "and": 1}]),
    "an angle divided by zero": certificate("sin(1/x)**2 + cos(1/x)**2 == 1", [{"fact": "circle", "of": "1/x"}]),
    "a sine used as positive": certificate("sin(x) > 0", [{"positive": "sin(x)"}]),
    "a cosine below a fraction bar": certificate("1 >= 0", [], (), "1", ({"positive": "1/cos(x)**2"},)),
    "an angle enclosed without a value": certificate("sin(x) <= 2", [{"fact": "enclosure", "of": "2 - sin(x)"}]),
    "a sum of angles": certificate("sin(Sum(x)) <= 1", [{"fact": "circle", "of": "Sum(x)"}]),
}


@pytest.mark.parametrize("name", GENUINE)
def test_the_fact_itself_is_accepted(name):
    check(GENUINE[name])


@pytest.mark.parametrize("name", FORGED)
def test_what_it_does_not_say_is_refused(name):
    with pytest.raises(CertificateError):
        check(FORGED[name])

import numpy as np
import pytest

from benchmarks.bank import Spec, make_stage, make_table, read_on
from benchmarks.experiments import Outcome, _longer, _outcomes, report
from tumble.calibrations.methods.dividing_head.probes import PROBES

SPEC = Spec(design="bfd", realisations=3, effects=(("k_xxx", 15.0),))


def test_a_longer_run_begins_as_the_table_does_and_goes_on_with_the_probe():
    case, stage = make_table(SPEC, 5), make_stage(SPEC, 5)
    (probe,) = [probe for probe in PROBES if probe.programme == "probe-end"]
    quiet_v = read_on(SPEC, 5, stage, _longer(stage.run, probe.after(case.observations)))
    assert quiet_v[: len(case.observations)] == pytest.approx(case.truth.noise_free_v, abs=1e-12)
    assert np.ptp(quiet_v[-240:]) < 0.1  # ax is level


def test_an_experiment_tells_about_as_much_as_it_promises():
    told = list(_outcomes(SPEC, 5, draws=3))
    assert {outcome.rival for outcome in told} >= {"head_second_harmonic"}
    assert all(0.6 < outcome.realised / outcome.predicted < 1.7 for outcome in told)


def test_the_ratio_is_reported_for_every_rival_and_over_all():
    same = {"seed": 1, "design": "bf", "true": "k_xx", "programme": "probe-end"}
    told = [
        Outcome(rival="k_yy", predicted=20.0, realised=18.0, **same),
        Outcome(rival="k_zz", predicted=10.0, realised=11.0, **same),
    ]
    assert "| k_xx | k_yy | bf | probe-end | 20.0 | 18.0 | 0.90 |" in report(told)
    assert report(told).endswith("1 tables, 2 rivals: median ratio 1.00, mean 1.00")

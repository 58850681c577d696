"""Rows held out of a table of the blind bank: five errors of a head, of which the other rows tell no alpha0."""

from benchmarks.blind import tables
from benchmarks.blind.files import write_table
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.held_out import held_out_parts, held_out_rms
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.table import read_table
from tumble.calibrations.tracing import held_out
from tumble.calibrations.tracing.noise import WHITE
from tumble.calibrations.tracing.trace import Trace, Tracer


def test_what_another_alpha0_could_stand_for_does_not_predict(tmp_path):
    _, _, made, rng = next(tables("stands", 14, 7101, 8))
    write_table(tmp_path / "head.csv", made, rng)
    joint = fit_jointly(read_table(tmp_path / "head.csv"))
    tracer = Tracer(dividing_head_table(joint, CATALOGUE))
    parts = list(held_out_parts(joint.observations))
    after = held_out.held_out_rms(tracer, Trace(found=(), noise=WHITE, deviance=0.0), parts)

    assert after <= held_out_rms(joint.observations, joint.basis, joint.weights, joint.fit.alpha0_fitted)

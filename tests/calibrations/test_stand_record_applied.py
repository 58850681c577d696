from dataclasses import replace

import numpy as np
import pytest
from report_examples import page_of
from stand_examples import ANOTHER, PARTS, UNIT, UP, rows, run_on
from stand_record_examples import FOUND, learned, record_of

from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.stand.applying import corrected
from tumble.calibrations.stand_records.contradicting import contradictions
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.terms import Term


def test_a_corrected_table_has_the_parameters_of_the_unit():
    table, record = rows(7, ANOTHER), learned()
    before, after = (
        analyse(table, trials=0),
        analyse(corrected(table, record), StandUncertainty(record=record), trials=0),
    )

    assert before.residual_rms_v > 3e-4
    assert after.residual_rms_v == pytest.approx(1e-4, rel=0.15)
    for name in ("u0", "kx", "ky", "kxy"):
        found = after.parameters[name]
        assert abs(found.value - ANOTHER[name]) < 3.5 * found.standard_uncertainty, name


def test_the_angle_as_reported_stays_beside_the_correction():
    table = rows()
    done = corrected(table, record_of(FOUND))

    assert done.angle_deg is table.angle_deg
    assert done.correction_deg == pytest.approx(0.05 * np.sin(np.deg2rad(table.angle_deg)))
    assert done.voltage_v is table.voltage_v


def test_backlash_is_corrected_after_moves_back_alone():
    table = rows()
    play = Corrections(terms=(Term(effect="backlash"),), values=np.array([0.02]), covariance=np.eye(1) * 1e-6)

    assert corrected(table, record_of(play)).correction_deg == pytest.approx(np.where(table.direction < 0, 0.02, 0.0))


def test_a_tilt_and_a_step_of_the_voltmeter_are_taken_off_the_voltage():
    terms = (Term(effect="axis_tilt"), Term(effect="range_step", scanned={"threshold_V": 2.7}))
    known = Corrections(terms=terms, values=np.array([0.2, 5e-4]), covariance=np.eye(2) * 1e-12)
    along_axis = {"face-up": 0.002, "face-down": -0.002, "face-up-90": 0.002, "end": 1.0}  # kz, -kz, kz, kx
    parts = (*PARTS, ("sweep", "end", UP))

    def added_v(volts, mounts):
        tilted_v = np.deg2rad(0.2) * np.array([along_axis[str(mount)] for mount in mounts])
        return tilted_v + np.where(volts > 2.7, 5e-4, 0.0)

    unit = {**UNIT, "kxy": 0.0}  # which adds to the product of ax and ay as well what a tilt adds to each
    disturbed = corrected(rows(unit=unit, added_v=added_v, parts=parts), record_of(known))

    assert disturbed.correction_deg is None
    assert np.abs(disturbed.output_v - rows(unit=unit, parts=parts).output_v).max() < 3e-6


def test_what_a_record_does_not_know_is_a_line_of_the_budget():
    table, record = rows(7, ANOTHER), learned()

    (line,) = [
        line
        for line in analyse(corrected(table, record), StandUncertainty(record=record), trials=0).budget
        if line.kind == "B"
    ]

    assert (line.name, line.symbol) == ("stand record 3", "2 coefficients of 1 term, correlated")
    assert line.contributions["u0"] > 0


def test_errors_of_a_record_that_hang_together_stay_together():
    table = rows()
    alone = np.array([[1e-6, 0.0], [0.0, 1e-6]])
    together = np.array([[1e-6, 9.9e-7], [9.9e-7, 1e-6]])
    size = {}
    for name, covariance in {"alone": alone, "together": together}.items():
        record = record_of(replace(FOUND, covariance=covariance))
        (line,) = analyse(corrected(table, record), StandUncertainty(record=record), trials=0).budget[1:]
        size[name] = line.contributions["u0"]

    # u0 moves by kx/2 times the sine coefficient seen in face-up and by its cosine in the turned mount
    assert size["together"] != pytest.approx(size["alone"], rel=0.05)


def test_a_result_says_by_which_record_it_was_corrected():
    table, record = rows(), record_of(FOUND, content_sha256="cd" * 32)

    said = analyse(corrected(table, record), StandUncertainty(record=record), trials=0).as_json()["stand_record"]

    assert said == {"id": record.id, "version": 3, "content_sha256": "cd" * 32}
    assert "stand_record" not in analyse(table, trials=0).as_json()


def test_a_run_that_the_record_corrects_contradicts_nothing():
    record = learned()
    run = run_on(corrected(rows(7, ANOTHER), record), StandUncertainty(record=record))

    assert list(contradictions(run, record)) == []


def test_a_head_that_changed_is_reported_with_numbers():
    record = learned()
    changed = corrected(rows(7, ANOTHER, lambda angle: 0.08 * np.sin(np.deg2rad(angle + 90.0))), record)

    (sentence,) = contradictions(run_on(changed, StandUncertainty(record=record)), record)

    assert sentence.startswith("stand record 3 says head_eccentricity amplitude 0.0")
    assert "phase 30°, this run says head_eccentricity amplitude 0.08" in sentence
    assert "phase 91°" in sentence
    assert sentence.endswith("; derive it anew with tumble stand learn")


def test_an_effect_that_a_record_does_not_have_is_reported():
    record = learned()
    more = corrected(rows(7, ANOTHER, backlash_deg=0.05), record)

    sentences = list(contradictions(run_on(more, StandUncertainty(record=record)), record))

    assert [sentence.split()[3] for sentence in sentences] == ["backlash"]
    assert "which stand record 3 does not have" in sentences[0]


def test_a_report_shows_the_map_and_what_contradicts_it():
    table, record = rows(), learned()
    corrected_table = corrected(table, record)
    calibration = analyse(corrected_table, StandUncertainty(record=record), trials=0)
    origin = Provenance(serial_number="SN 3", stand={}, sources=(), program_version="", packages={})

    page = page_of(calibration, origin, loop=close_loop(corrected_table), contradictions=["It moved"])

    assert "corrected by stand record 3 of bench-1" in page
    assert "rests on SN 1 and SN 2; the units agree (p = 0.41)" in page
    assert "eccentricity of the head&#39;s circle amplitude 0.0" in page
    assert "It moved." in page
    assert 'aria-label="Error of the head over a turn with its uncertainty"' in page


def test_a_report_without_a_record_says_so():
    origin = Provenance(serial_number="SN 3", stand={}, sources=(), program_version="", packages={})

    assert "No stand record was applied." in page_of(analyse(rows(), trials=0), origin)

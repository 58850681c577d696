"""What is said of tables and records that cannot be used, read in German and Ukrainian."""

from dataclasses import replace

import pytest
from languages import plain_sentences
from records_examples import calibration, provenance, raw_source

from tumble.calibrations.core.known_tables import recognised
from tumble.calibrations.core.table import read_rows
from tumble.calibrations.methods.dividing_head.entry import entry
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.head_reference.method import METHOD as HEAD_REFERENCE
from tumble.calibrations.methods.temperature.method import METHOD as TEMPERATURE
from tumble.calibrations.methods.temperature.table import read_runs
from tumble.calibrations.records.compare import compare
from tumble.calibrations.records.errors import StoreError
from tumble.calibrations.records.store import Store
from tumble.calibrations.records.verify import verify
from tumble.messages import Language, Message

OTHERS = (Language.UKRAINIAN, Language.GERMAN)


def said_in_no_other_language(said):
    """What cannot be read in another language: no message, or one with plain words in it."""
    unread = [] if isinstance(said, Message) else [said]
    return unread + plain_sentences(said) + [said for each in OTHERS if said and said.in_language(each) == said]


def recognise(path):
    return recognised(path, [HEAD_REFERENCE, TEMPERATURE]).close_loop([path])


def observe(path):
    return read_rows(path, Observations)


TABLES = [
    (recognise, ""),
    (recognise, "angle_deg,reference_deg\n"),
    (recognise, "angle_deg,reference_deg\n0,1\n1\n"),
    (recognise, "angle_deg,angle_deg\n0,1\n"),
    (recognise, "angle_deg,reference_deg,\n0,1,2\n"),
    (recognise, "angle_deg;reference_deg\n0,5;1\n0.5;2\n"),
    (recognise, "angle_deg,reference_deg\n0,\0\n"),
    (recognise, 'angle_deg,reference_deg\n0,"1\n'),
    (observe, "angle_deg,voltage_V\n0,one\n"),
    (observe, "angle_deg,voltage_V,realisation\n0,1,0.5\n"),
    (observe, "angle_deg,voltage_V\n0,\n"),
    (observe, "angle_deg,voltage_V,mount\n0,1,sideways\n"),
    (recognise, "angle_degs,reference_deg\n0,1\n"),
    (recognise, "u_x_V,u_y_V,u_z_V\n0,1,2\n"),
    (recognise, "humidity\n0\n"),
    (recognise, "name\nx\n"),
    (recognise, "oven_degC,bias,scale\n0,1,2\n"),
    (recognise, "bias_mV\n0\n"),
    (recognise, "angle_deg,reference_deg\nnan,1\n"),
    (read_runs, "oven_degC\n0\n"),
    (read_runs, "bias_mV\n0\n"),
    (read_runs, "oven_degC,bias_mV\n0,1\n1,2\n"),
    (read_runs, "oven_degC,bias_mV\n300,1\n310,2\n320,3\n330,4\n"),
    (read_runs, "oven_degC,bias_mV\n0,1\n10,2\n20,3\n900,4\n"),
    (read_runs, "oven_degC,bias_mV\n0,1\n10,2\n20,3\n30,1e9\n"),
    (read_runs, "oven_degC,bias_mV,time_s\n0,1,0\n10,2,1\n20,3,2\n30,4,3\n"),
    (read_runs, "oven_degC,bias_mV\n0,1\n10,x\n20,3\n30,4\n"),
    (read_runs, "oven_degC,bias_mV\n0,1\n10,nan\n20,3\n30,4\n"),
    (observe, "angle_deg\n0\n"),
    (observe, "voltage_V\n0\n"),
]


@pytest.mark.parametrize(("read", "content"), TABLES)
def test_a_refused_table_is_refused_in_every_language(tmp_path, read, content):
    path = tmp_path / "table.csv"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ValueError) as refusal:
        read(path)
    assert said_in_no_other_language(str(refusal.value)) == []


@pytest.mark.parametrize("content", [b"angle_deg,voltage_V\n0,\xff\n", None])
def test_a_file_that_cannot_be_read_is_refused_in_every_language(tmp_path, content):
    path = tmp_path / "table.csv"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(ValueError) as refusal:
        recognise(path)
    assert said_in_no_other_language(str(refusal.value)) == []


def test_what_is_warned_of_in_a_table_is_said_in_every_language(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("angle_deg,voltage_V,temperature_degC,head_deg,realisation\n0,1,20,,1\n1,,,,1\n2,3,,,", "utf-8")
    rows = read_rows(path, Observations)
    said = [*rows.warnings, *(entry.reason for entry in rows.set_aside)]
    assert len(said) > 1
    assert [found for each in said for found in said_in_no_other_language(each)] == []


@pytest.mark.parametrize("name", ["records.sqlite", "absent"])
def test_a_store_that_cannot_be_opened_is_refused_in_every_language(tmp_path, name):
    (tmp_path / name).write_bytes(b"no database\n" * 100)
    with pytest.raises(StoreError) as refusal:
        Store.existing(tmp_path)
    assert said_in_no_other_language(str(refusal.value)) == []


def test_records_are_verified_and_compared_in_every_language(tmp_path):
    store = Store(tmp_path)
    first, second = (
        store.add(entry(made), provenance(sources=(raw_source(sha256=f"{number}a" * 32),)))
        for number, made in enumerate((calibration(), calibration(seed=2)))
    )
    said = [
        *replace(verify(first, store, None, "0.3"), altered=(Message("content"),)).sentences,
        *(difference.sentence for difference in compare(first, second)),
    ]
    assert [found for each in said for found in said_in_no_other_language(each)] == []

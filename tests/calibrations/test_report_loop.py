"""The section of the report on what the model left unexplained."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from loop_examples import clean, found, misread, timed, with_k_xx
from report_examples import chapter, provenance
from test_report_page import parsed, text_of

from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.loop.table import scene_of
from tumble.calibrations.methods.dividing_head.report import traces
from tumble.calibrations.methods.dividing_head.report.abscissa import BY_EFFECT, BY_VARIABLE
from tumble.calibrations.methods.dividing_head.report.outlooks import outlook_figure
from tumble.calibrations.methods.dividing_head.report.results import notices
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.methods.dividing_head.report.traces import MOST_FIGURES, abscissae, trace_figure
from tumble.calibrations.report.figure import Marks
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.findings import Unexplained
from tumble.calibrations.tracing.link import Link
from tumble.calibrations.tracing.separation import Difference, Outlook
from tumble.calibrations.tracing.stage import Stage

UNEXPLAINED = Unexplained(depends_on="angle", description="a bump of 18 arcsec near 141 deg on the head")


def subject(loop):
    return Subject(calibration=clean().declared, provenance=provenance(), loop=loop)


def section(loop):
    return chapter("loop", subject(loop))


@pytest.fixture(scope="module")
def k_xx_section():
    return section(with_k_xx())


def test_the_section_names_the_effect_its_owner_and_its_size(k_xx_section):
    text = text_of(k_xx_section)
    assert "What the declared model leaves was traced to second-order nonlinearity k_xx." in text
    assert re.search(r"k_xx .* unit 2\.\d+\(\d+\) mV/g² < 0\.0001", text)


def test_before_and_after_stand_side_by_side(k_xx_section):
    text = text_of(k_xx_section)
    assert "Declared model With what was found Change" in text
    assert re.search(r"residual, r\.m\.s\. \d+ µV \d+(\.\d+)? µV × 0\.\d+", text)


def test_the_residual_is_drawn_against_what_explains_it_before_and_after(k_xx_section):
    plot, *_ = re.findall(r"<svg.*?</svg>", k_xx_section, flags=re.DOTALL)
    assert ET.fromstring(plot).get("aria-label") == "Residual against ax (g): declared model, with what was found"
    assert "Where second-order nonlinearity k_xx shows." in text_of(k_xx_section)


def test_every_element_of_the_section_is_closed(k_xx_section):
    assert parsed(k_xx_section).open == []


def test_why_a_parameter_is_withheld_is_said_once_with_the_results():
    parameters = dict(with_k_xx().augmented.parameters)
    parameters["kz"] = replace(parameters["kz"], value=None, reason="it differs between k_xx and k_yy")
    loop = replace(with_k_xx(), augmented=replace(with_k_xx().augmented, parameters=parameters))
    reason = "kz is not identifiable: it differs between k_xx and k_yy."
    assert reason in text_of(chapter("results", subject(loop)))
    assert reason not in text_of(section(loop))


def test_where_nothing_was_found_the_section_says_so_and_shows_nothing():
    page = section(clean())
    assert text_of(page).startswith("Nothing is left that the scatter of the data does not explain")
    assert "<table" not in page
    assert "<svg" not in page


def test_where_nobody_asked_the_section_says_so():
    assert text_of(section(None)) == "What the residual comes from was not asked."


def test_misread_rows_are_listed_without_a_plot():
    page = section(misread())
    assert "Read or set wrong by a round amount: row 21 by 10°." in text_of(page)
    assert "<svg" not in page


def test_unexplained_structure_is_located_and_drawn():
    page = section(replace(clean(), unexplained=UNEXPLAINED))
    assert "a bump of 18″ near 141 deg on the head" in text_of(page)
    assert "Where what is unexplained shows." in text_of(page)


def test_an_effect_that_differs_at_every_repeat_is_drawn_before_and_after_too():
    page = section(replace(clean(), effects=(found("realisation_bias", realisation_bias=(1e-4, 1e-5, "V")),)))
    assert 'aria-label="Residual against realisation: declared model, with what was found"' in page


def experiment(left_v=5e-4):
    """A probe of the last 54 of the 162 rows of `clean`, in which k_yy would be off by `left_v`."""
    rows = clean().declared.observations
    outlook = Outlook(
        rows=rows,
        probed=np.arange(len(rows)) >= 108,
        dwell_v=1e-4,
        differences=(Difference(true="k_xx", other="k_yy", left_v=np.full(len(rows), left_v)),),
    )
    fields = {"separates": ("k_xx", "k_yy"), "programme": "probe-edge", "why": "probe-edge puts Oz in the place of Oy"}
    return Experiment(
        **fields, command="tumble run --programme probe-edge", separation=20.0, stand_time_s=1.0, outlook=outlook
    )


def test_what_to_measure_next_stands_with_its_command_and_what_it_would_show():
    page = section(replace(with_k_xx(), next_experiment=(experiment(),)))
    assert "What to measure next probe-edge puts Oz in the place of Oy. tumble run --programme" in text_of(page)
    _, plot = re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL)
    label = "What the experiment would show against head angle: k_yy if k_xx is true"
    assert ET.fromstring(plot).get("aria-label") == label
    assert parsed(page).open == []


def test_where_no_programme_helps_the_page_says_so_without_a_plot():
    none = replace(experiment(), why="no programme that comes along tells them apart", command="", outlook=None)
    page = section(replace(with_k_xx(), next_experiment=(none,)))
    assert text_of(page).endswith("What to measure next no programme that comes along tells them apart.")
    assert page.count("<svg") == 1


@pytest.mark.parametrize(("left_v", "drawn", "label"), [(5e-4, 500.0, "(µV)"), (-2e-3, -2.0, "(mV)")])
def test_only_the_rows_of_the_probe_are_drawn_beside_two_standard_deviations(left_v, drawn, label):
    (panel,) = outlook_figure(experiment(left_v).outlook, "next").panels
    band, _, line, _ = panel.layers
    assert line.y[~np.isnan(line.y)] == pytest.approx([drawn] * 54)
    assert np.isnan(line.y).any()  # from one sweep to the next there is no line
    assert (band.high - band.low) / abs(drawn) == pytest.approx(4e-4 / abs(left_v))
    assert panel.y.label.endswith(label)


def with_chain(chain):
    return chapter("loop", replace(subject(with_k_xx()), chain=chain))


def test_every_experiment_stands_with_its_rivals_its_decision_and_the_error_before_and_after():
    rivals, alone = (replace(with_k_xx().effects[0], also_possible=names) for names in (("k_yy",), ()))
    first = Stage(loop=replace(with_k_xx(), effects=(rivals,)), behind={"k_xx": 0.0, "k_yy": 1.0})
    after = Stage(loop=replace(with_k_xx(), effects=(alone,)), behind={"k_xx": 0.0, "k_yy": 25.0})
    done = Link(experiment=experiment(), recording="x.mcap", stand_time_s=480.0, before=first, after=after)
    page = with_chain(Chain(first=first, links=(done,), why="Everything that was found is distinguished."))
    text = text_of(page)
    told = (
        r"second-order nonlinearity k_xx or [a-z -]*k_yy probe-edge 8 4.5 5.0 against [a-z -]*k_yy: "
        r"second-order nonlinearity k_xx remains \d+ µV → [\d.]+ µV"
    )
    assert re.search(told, text)
    assert "Everything that was found is distinguished." in text
    labels = [ET.fromstring(plot).get("aria-label") for plot in re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL)]
    assert any(label.startswith("Explanations after each experiment: second-order") for label in labels)
    assert parsed(page).open == []


def test_the_head_of_the_page_says_what_was_found():
    assert any("traced to k_xx" in notice for notice in notices(subject(with_k_xx())))
    assert not any("traced" in notice for notice in notices(subject(clean())))


def test_where_what_was_found_describes_the_data_no_doubt_of_the_declared_model_stands_in_front():
    *others, notice = notices(replace(subject(with_k_xx()), calibration=with_k_xx().declared))
    assert not any("does not describe" in each for each in others)
    assert "With that taken into account the poses agree with the model" in notice
    assert "uncertainties" not in notice


def test_a_doubt_of_the_model_with_what_was_found_stands_in_front():
    doubted = replace(with_k_xx(), augmented=replace(with_k_xx().augmented, lack_of_fit_p=1e-3))
    *_, notice = notices(subject(doubted))
    assert "still disagree with the model (lack of fit: p = 0.0010). The uncertainties rest on that" in notice


def test_every_effect_of_the_catalogue_has_something_to_be_drawn_against():
    assert {effect.name for effect in CATALOGUE} <= set(BY_EFFECT)


def test_an_effect_of_ones_own_is_drawn_against_its_variable(monkeypatch):
    lamp = replace(CATALOGUE[0], name="lamp", depends_on="order")
    monkeypatch.setattr(traces, "CATALOGUE", (*CATALOGUE, lamp))

    assert abscissae(replace(clean(), effects=(found("lamp"),))) == {BY_VARIABLE["order"]: ["lamp"]}


def test_effects_of_one_variable_share_a_figure_and_figures_are_few():
    names = ("k_xx", "k_xxx", "bias_drift", "settling", "range_step", "k_yy", "misreading")
    loop = replace(clean(), effects=tuple(found(name) for name in names), unexplained=UNEXPLAINED)
    wanted = abscissae(loop)
    assert list(wanted.values())[:2] == [["k_xx", "k_xxx"], ["bias_drift"]]
    assert len(wanted) == MOST_FIGURES


EVERY = {abscissa.name: abscissa for abscissa in (*BY_EFFECT.values(), *BY_VARIABLE.values())}


@pytest.mark.parametrize("name", sorted(set(EVERY) - {"ay-az"}))
def test_every_variable_can_be_drawn(name):
    figure = trace_figure({"declared model": timed(clean()).declared}, EVERY[name])
    element = ET.fromstring(figure.__html__())
    assert element.get("aria-label") == f"Residual against {EVERY[name].label}: declared model"


@pytest.mark.parametrize(
    "name", ["time", "temperature", "temperature-ax", "time-ax", "variance", "time-angle", "velocity", "ay-az"]
)
def test_what_the_table_does_not_say_or_never_varies_is_not_drawn(name):
    assert trace_figure({"declared model": clean().declared}, EVERY[name]) is None


def test_an_error_of_the_angle_needs_a_slope():
    parameters = {name: replace(parameter, value=None) for name, parameter in clean().declared.parameters.items()}
    assert trace_figure({"x": replace(clean().declared, parameters=parameters)}, EVERY["angle"]) is None


def test_an_error_of_the_angle_stands_in_seconds_of_arc():
    """0.01° on every row is 36 seconds of arc, whatever the slope there."""
    rows = clean().declared.observations
    slope_v_per_deg = np.deg2rad(1.0) * -np.cos(np.deg2rad(rows.angle_deg + 0.1121))
    shifted = replace(clean().declared, residual_v=0.01 * slope_v_per_deg)
    (panel,) = trace_figure({"declared model": shifted}, EVERY["angle"]).panels
    drawn = next(layer.y for layer in panel.layers if isinstance(layer, Marks))
    assert drawn == pytest.approx([36.0] * len(drawn), rel=0.05)
    assert len(rows) / 2 < len(drawn) < len(rows)


def test_places_within_a_realisation_count_from_zero():
    rows = clean().declared.observations
    place = EVERY["place"].values(scene_of(rows, np.array([2.5, 1.0, 0.01, 0.0, 0.0, 0.1])))
    assert place.tolist() == [*range(54), *range(54), *range(54)]

"""A method that the window does not know: two axes, three channels, and a base that somebody levels."""

from dataclasses import dataclass

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel
from test_any_stand import DRIVERS, PROGRAMME, STAND
from two_axes import CHANNELS, MADE

from tumble.app.running import Job, run
from tumble.app.stand import load_stand
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.experiments import Experiment
from tumble.drivers.clock import VirtualClock
from tumble.procedures.programmes import load_programme, programme_from_text
from tumble.window import registry
from tumble.window.look.conditions import ConditionWords
from tumble.window.method import WindowPart
from tumble.window.parts import Figures, Overview, ResultTab
from tumble.window.screens.run import Phase
from tumble.window.work.activity import Concluded
from tumble.window.work.presentation import Presentation


@pytest.fixture(autouse=True)
def installed(monkeypatch, install):
    install("tumble.procedures", "two_axes", "two_axes:TWO_AXES")
    monkeypatch.setattr("tumble.app.wiring.SystemClock", lambda: VirtualClock(0))
    registry.window_part.cache_clear()
    yield
    registry.window_part.cache_clear()


@dataclass(frozen=True)
class Bias:
    """The mean of a channel, and nothing behind it."""

    points: tuple
    warnings: tuple = ("three points are few",)
    provenance: Provenance = Provenance(  # noqa: RUF009  # frozen
        serial_number="T-1", stand={}, sources=(), program_version="0", packages={}
    )

    @property
    def parameters(self):
        value = self.points[0].readings["u_x_v"].mean
        told = Parameter(name="bias", unit="V", value=value, standard_uncertainty=0.001, interval_95=(-0.002, 0.002))
        return {"bias": told, "scale": Parameter(name="scale", unit="V/g", value=None, reason="there is one position")}

    limits = (LimitCheck(name="bias", minimum=None, maximum=-1.0, inside=False),)
    next_experiment = ()
    verdict = Verdict(
        judged=Model.DECLARED,
        parameters=(Judgement(name="bias", outcome=Outcome.FAIL, reason="it lies outside"),),
    )

    def sections(self):
        yield Section(title="Means", lines=("As they came",), headings=("channel", "mean"), rows=[("u_x_v", "0 V")])


@dataclass(frozen=True, kw_only=True)
class Measured:
    """A run, and what is made of it, as the window has it carried out."""

    job: Job
    recording: object
    points_done: int = 0
    past: tuple = ()

    def measure(self, connected, listeners, tell):
        outcome = run(self.job, connected, self.recording, listeners)
        return lambda tell: Concluded(method="two_axes", traced=Bias(outcome.points), recordings=(self.recording,))


@pytest.fixture
def driver(lent_driver, tmp_path, write):
    """A window at a stand with two axes."""
    write("mine.py", DRIVERS)
    lent_driver.window.stand.open(write("bench.toml", STAND))
    lent_driver.window.open(lent_driver.run)
    return lent_driver


def begin(driver, tmp_path):
    job = Job(
        stand=driver.window.worker.session.loaded,
        programme=programme_from_text(PROGRAMME, "four.toml"),
        serial_number="T-1",
    )
    driver.window.result.presentation = None
    assert driver.run.begin(Measured(job=job, recording=tmp_path / "run.mcap"))
    driver.wait(lambda: driver.run.view.asks or driver.complaints)


def measure(driver, tmp_path):
    begin(driver, tmp_path)
    driver.press(Qt.Key.Key_F9)
    driver.wait(lambda: driver.run.phase is Phase.IDLE)
    return driver.wait_for_result()


def test_a_condition_is_asked_for_in_the_words_of_its_method(driver, tmp_path):
    begin(driver, tmp_path)
    prompt = driver.run.view.prompt
    assert prompt.value == "level"
    assert prompt.unit.text == "T-1"
    driver.wait(
        lambda: (
            prompt.words.text == "Bring the base to level. Outer axis is at 0° and turns by itself once you confirm. "
            "Inner axis is at 0° and turns by itself once you confirm."
        )
    )
    assert driver.run.view.points == []
    driver.press(Qt.Key.Key_F9)
    driver.wait_for_points(4)
    assert "Set: base level." in driver.log


def test_points_are_listed_and_every_channel_is_drawn(driver, tmp_path):
    measure(driver, tmp_path)
    view = driver.run.view
    headings = [view.overview.table.horizontalHeaderItem(place).text() for place in range(7)]
    assert headings == ["point", "base", "Outer axis (°)", "Inner axis (°)", "u_x (V)", "u_y (V)", "u_z (V)"]
    assert [row[:4] for row in view.overview.table.texts()] == [
        ["4", "level", "-90.0000", "30.0000"],
        ["3", "level", "0.0000", "45.0000"],
        ["2", "level", "90.0000", "45.0000"],
        ["1", "level", "90.0000", "0.0000"],
    ]
    driver.window.open(driver.run)
    assert view.overview.table.texts()[2][4:] == ["-0.70711", "-0.70711", "0.00000"]
    (plot,) = view.figures.plots.values()
    driver.wait(lambda: [plot.drawn(channel) for channel in CHANNELS] == [4, 4, 4])
    assert view.overview.done == 4


def test_channels_are_drawn_against_time_and_position_too(driver, tmp_path):
    measure(driver, tmp_path)
    driver.window.open(driver.run)
    figures = driver.run.view.figures
    driver.wait(lambda: figures.plots["V"].drawn("u_z_v") == 4)
    choices = [figures.against.itemText(place) for place in range(figures.against.count())]
    assert choices == ["point", "time (min)", "Outer axis (°)", "Inner axis (°)"]
    figures.against.setCurrentText("Inner axis (°)")
    series = figures.plots["V"]._series["u_z_v"]
    driver.wait(lambda: list(series.getData()[0]) == [0.0, 45.0, 45.0, 30.0])


def test_every_axis_has_a_dial_and_its_place_beside_stop(driver, tmp_path):
    measure(driver, tmp_path)
    driver.wait(lambda: driver.run.view.dials.of("inner").accessibleName() == "30.0000°")
    assert driver.window.stand.dials.of("outer").accessibleName() == "-90.0000°"
    driver.wait(lambda: driver.window.stop_bar._angle.text() == "outer -90° 00′ 00″\ninner 30° 00′ 00″")
    shown = driver.window.stand.cards.cards
    assert [shown[name].text("model") for name in ("outer", "inner", "triad")] == ["fake head"] * 2 + ["fake triad"]


def test_either_axis_is_turned_by_hand(driver):
    stand = driver.window.stand
    stand._worker.connect_to(stand.attendant())
    driver.wait(lambda: not driver.window.busy)
    stand.jog.positioner.setCurrentIndex(1)
    stand.jog.angle.setText("20")
    stand.jog.go.click()
    driver.wait(lambda: stand.dials.of("inner").accessibleName() == "20.0000°")
    assert stand.dials.of("outer").accessibleName() == "0.0000°"


def test_stop_brings_every_axis_to_rest(driver):
    stand = driver.window.stand
    stand._worker.connect_to(stand.attendant())
    driver.wait(lambda: not driver.window.busy)
    axes = driver.window.worker.session.connected.stand.positioners
    driver.window.stop_bar.button.click()
    driver.wait(lambda: not driver.window.busy)
    assert all(axis.stops for axis in axes.values())


def test_a_standstill_that_is_not_read_back_names_the_axes(driver):
    stand = driver.window.stand
    stand._worker.connect_to(stand.attendant())
    driver.wait(lambda: not driver.window.busy)
    inner = MADE[-1]
    inner.coasting = True
    driver.window.worker.stop()
    driver.wait(lambda: driver.complaints)
    assert driver.complaints[0].startswith("outer or inner: its standstill could not be read back")
    assert "not read back" in driver.run.controls.state.text()
    inner.coasting = False
    driver.wait(lambda: "not read back" not in driver.run.controls.state.text())


def test_its_result_is_shown_by_parameters_and_sections(driver, tmp_path):
    measure(driver, tmp_path)
    result = driver.window.result
    bias, scale = result.table.texts()
    assert bias[2:] == [bias[2], "up to -1000 mV", "fail", "", "-2.0 to 2.0 mV", "1.0 mV", "", ""]
    assert (scale[0], scale[2]) == ("scale", "not identifiable")
    assert result.table.reasons.text() == "scale is not identifiable: there is one position"
    assert result.verdict.text() == "✗ Outside the limits: bias"
    assert [result.tabs.tabText(place) for place in range(result.tabs.count()) if result.tabs.isTabVisible(place)] == [
        "Parameters",
        "Details",
    ]
    (tab,) = result._own
    assert tab.widget.tables[0].texts() == [["u_x_v", "0 V"]]


def test_the_next_experiment_of_any_method_may_be_run(driver, tmp_path, monkeypatch):
    wanted = Experiment(
        separates=("bias", "scale"),
        programme="four",
        why="one more position tells the scale",
        command="",
        separation=3.0,
        stand_time_s=60.0,
    )
    monkeypatch.setattr(Bias, "next_experiment", (wanted,))
    measure(driver, tmp_path)
    loop = driver.window.result.loop
    driver.window.result.tabs.setCurrentWidget(loop)
    assert loop.experiments.item(0).text() == "four (1:00): one more position tells the scale"
    assert loop.run_button.isEnabled()


def test_the_tabs_of_another_method_take_their_places(driver, tmp_path):
    result = driver.window.result
    measure(driver, tmp_path)
    result._take_tabs_of("dividing_head")
    assert [result.tabs.tabText(place) for place in range(3)] == ["Parameters", "Fit", "Residuals"]


class Places(Overview):
    """How many dwells are done."""

    done = 0

    def __init__(self, layout):
        super().__init__()
        self.conditions = tuple(layout.conditions)

    def show_plan(self, dwells, points=()):
        self.planned, self.done = len(dwells), len(points)

    def begin(self, dwell):
        self.now = dwell

    def complete(self, dwell, point):
        self.done += 1


class Means(Figures):
    """Every mean of the first channel."""

    def __init__(self, layout, background):
        super().__init__()

    def begin(self, points):
        self.means = []

    def add(self, point):
        self.means.append(point.readings["u_x_v"].mean)


class BaseWords(ConditionWords):
    """How the base stands."""

    def confirmed(self, condition, value):
        return f"The base is {value}."


def as_bias(concluded):
    return Presentation(
        concluded=concluded, verdict=Verdict(judged=Model.DECLARED, parameters=()), notices=(), table=()
    )


def label_tab():
    label = QLabel()

    def show(presentation):
        label.setText(str(len(presentation.concluded.traced.points)))

    return (ResultTab(title="Points", widget=label, show=show),)


PART = WindowPart(words=BaseWords(), overview=Places, figures=Means, present=as_bias, tabs=label_tab)


@pytest.fixture
def own_parts(install):
    """The method brings its own parts, as one that is installed does."""
    install(registry.GROUP, "two_axes", "test_any_method:PART")
    registry.window_part.cache_clear()


def test_a_method_is_shown_by_the_parts_that_it_brings_along(own_parts, driver, tmp_path):
    measure(driver, tmp_path)
    view = driver.run.view
    assert isinstance(view.overview, Places)
    assert (view.overview.planned, view.overview.done) == (4, 4)
    assert len(view.figures.means) == 4
    assert "The base is level." in driver.log
    assert driver.window.result.tabs.tabText(1) == "Points"
    assert driver.window.result._own[0].widget.text() == "4"


def test_the_parts_of_the_next_run_are_those_of_its_method(own_parts, driver, tmp_path, tiny):
    measure(driver, tmp_path)
    job = Job(stand=load_stand(), programme=load_programme(str(tiny)), serial_number="SN-1")
    driver.run.view.begin(job, job.plan())
    assert driver.run.view.overview.mounts == ["face-up"]
    assert driver.run.view.figures.points == []

# Two targets set everything up: `make demo` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
WORKERS ?= 2
RELATIVE ?= 1e-9
CATALOGUES := $(wildcard tumble/locales/*/LC_MESSAGES/tumble.po)

unexport PYTHONDONTWRITEBYTECODE  # what was compiled once need not be compiled by every process

.DEFAULT_GOAL := help
.PHONY: help setup gui texts demo test tests coverage test-screen docs frozen check endurance lock clean

help:
	@echo "make demo   run the main job on the simulated stand: recording, record and report in tumble-store/"
	@echo "make gui    open the operator's window"
	@echo "make test   style, types, import contracts and all tests"
	@echo "make coverage  the same, and which lines no test reaches; takes half as long again"
	@echo "make test-screen   tests of the window on a real X11 screen that nobody sees (needs xvfb)"
	@echo "make docs   the documentation as a site in docs/_site/html, notebooks run; nothing is fetched"
	@echo "make frozen RELATIVE=1e-6   results of all tables and recordings against the frozen ones"
	@echo "make endurance   kills, cuts, flips, runs through the wire, faults at every step, a soak, mutated frames (two hours)"
	@echo "make texts  collect the messages for the translators of tumble/locales, and compile what they wrote"
	@echo "make lock   pin the dependencies anew"

$(VENV)/.ready: requirements.lock pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --editable .
	touch $@

%.mo: %.po | $(VENV)/.ready
	$(BIN)/python setup.py --quiet compile_catalogues

setup: $(VENV)/.ready $(CATALOGUES:.po=.mo)

demo: setup
	$(BIN)/tumble calibrate --programme seed --serial DEMO-1 --operator demo --store tumble-store
	$(BIN)/tumble records verify --store tumble-store

test: setup
	@$(MAKE) --no-print-directory --jobs=2 check tests  # one core has time while the types are looked at

tests: setup
	$(BIN)/python -m pytest -n $(WORKERS) --dist loadfile $(COVERAGE)

coverage:
	$(MAKE) test COVERAGE="--cov --cov-report=term:skip-covered"

test-screen: setup
	xvfb-run --auto-servernum --server-args="-screen 0 1280x800x24" env QT_QPA_PLATFORM=xcb \
	    $(BIN)/python -m pytest tests/window/test_whole_run.py tests/window/test_stand_screen.py \
	    tests/window/test_stop_everywhere.py
	xvfb-run --auto-servernum --server-args="-screen 0 1280x800x24" env QT_QPA_PLATFORM=xcb \
	    $(BIN)/python -m benchmarks.window_streaming --minutes 0.25

docs: setup
	$(BIN)/sphinx-build --fail-on-warning --keep-going --quiet --jobs auto docs docs/_site/html
	@! grep -rlE "<(script|link|img)[^>]*(src|href)=.https?:" docs/_site/html --include="*.html"  # nothing is fetched from elsewhere
	@echo "docs/_site/html/index.html"

frozen: setup
	$(BIN)/python -m benchmarks.frozen --relative $(RELATIVE) --workers $(WORKERS)

check: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/mypy docs/examples/mercury.py docs/examples/own.py
	$(BIN)/lint-imports

endurance: setup
	$(BIN)/python -m benchmarks.endurance.cuts
	$(BIN)/python -m benchmarks.endurance.flips
	$(BIN)/python -m benchmarks.endurance.kills
	$(BIN)/python -m benchmarks.endurance.peers
	$(BIN)/python -m benchmarks.endurance.pairs
	$(BIN)/python -m benchmarks.endurance.zaber_frames
	$(BIN)/python -m benchmarks.endurance.scpi_frames
	$(BIN)/python -m benchmarks.endurance.scpi_dialogues
	$(BIN)/python -m benchmarks.endurance.can_frames
	$(BIN)/python -m benchmarks.endurance.faults
	$(BIN)/python -m benchmarks.endurance.soak

lock:
	uv pip compile --universal --python-version 3.11 --generate-hashes --no-emit-index-url --no-header \
	    --extra test --extra check --extra docs pyproject.toml -o requirements.lock

texts: $(VENV)/.ready
	$(BIN)/python setup.py --quiet extract_messages update_catalog compile_catalogues

gui: setup
	$(BIN)/tumble gui

clean:
	rm -rf $(VENV) docs/_site tumble-store $(CATALOGUES:.po=.mo)

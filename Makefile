# Two commands: `make run` drives a robot in the browser, `make test` checks everything.

PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check
SOURCES := pyproject.toml tests/constraints.txt
CODE := $(CURDIR)/build/machine_code
# The tests start hundreds of programs, which read bytecode faster than they compile it.
PYTEST := env -u PYTHONDONTWRITEBYTECODE $(BIN)/python -m pytest

.DEFAULT_GOAL := help
.PHONY: help run test quick docs docs-serve ros2-nodes bench fidelity soak wheel clean

help:
	@echo "make run    install into $(VENV) and drive Simpleton in the browser"
	@echo "make test   install the test tools too, then run every check and test"
	@echo "make quick  run the quick tests: no browser, no builds of ROS packages, nothing that takes seconds"
	@echo "make docs   build the documentation site into build/site; broken links and misspelt words are errors"
	@echo "make docs-serve  serve the site at http://127.0.0.1:8000 and rebuild it after each save"
	@echo "make fidelity  measure us and the peers beside closed forms, into docs/fidelity.md"
	@echo "make bench  run us and the peers side by side and print ratios"
	@echo "make soak   compare both engines on 1,000 states of each robot, then drive each for 30 minutes in the house"
	@echo "make wheel  build a wheel with machine code for processors with and without AVX2, into dist/"
	@echo "make clean  remove $(VENV) and caches"

run: $(VENV)/.run
	@$(BIN)/urdfkit sim teleop simpleton $(ARGS)

test: $(VENV)/.test
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/urdfkit sim warmup
ifeq ($(ARGS),)
	$(PYTEST) -n 2 --dist worksteal -m "not browser"
	$(PYTEST) -m browser
else
	$(PYTEST) $(ARGS)
endif

quick: $(VENV)/.test
	$(PYTEST) -q -n 2 --dist worksteal -m "not slow and not browser and not catkin and not colcon and not sdformat" $(ARGS)

docs: $(VENV)/.test
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --strict --config-file docs/site/mkdocs.yml
	@echo "the site: build/site/index.html (the search works when it is served: make docs-serve)"

docs-serve: $(VENV)/.test
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs serve --config-file docs/site/mkdocs.yml

bench: $(VENV)/.bench
	$(BIN)/python tests/bench/bench_lint.py
	$(BIN)/python tests/bench/bench_lsp.py
	$(BIN)/python tests/bench/bench_reads.py
	$(BIN)/python -m tests.bench.peers $(ARGS)

fidelity: $(VENV)/.bench
	$(BIN)/python tests/bench/fidelity --write

soak: $(VENV)/.test
	$(BIN)/python tests/bench/agreement.py; agreed=$$?; $(BIN)/python tests/bench/soak $(ARGS) && exit $$agreed

# rclpy with Fast DDS in environments of their own: the tests of --ros2 run real nodes with them.
ros2-nodes: $(VENV)/ros2-kilted/.done $(VENV)/ros2-jazzy/.done

$(VENV)/ros2-kilted/.done: PREFIX := ros
$(VENV)/ros2-jazzy/.done: PREFIX := ros-jazzy
$(VENV)/ros2-%/.done: $(VENV)/bin/python
	$(PYTHON) -m venv $(@D)
	$(@D)/bin/python -m pip --disable-pip-version-check install --quiet \
	  $(addprefix $(PREFIX)-,rclpy rmw-fastrtps-cpp geometry-msgs nav-msgs rosgraph-msgs sensor-msgs std-msgs std-srvs \
    trajectory-msgs)
	@touch $@

wheel: $(VENV)/.run
	rm -rf $(CODE) urdfkit/machine_code
	NUMBA_CACHE_DIR=$(CODE) $(BIN)/urdfkit sim warmup
	NUMBA_CACHE_DIR=$(CODE) NUMBA_ENABLE_AVX=0 $(BIN)/urdfkit sim warmup
	mv $(CODE)/urdfkit urdfkit/machine_code
	$(PIP) wheel --quiet --no-deps --wheel-dir dist .

$(VENV)/bin/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' || { echo "urdfkit needs Python 3.10 or newer; name one: make PYTHON=python3.11 $(MAKECMDGOALS)"; exit 2; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.run: $(VENV)/bin/python $(SOURCES)
	$(PIP) install --quiet --constraint tests/constraints.txt --editable '.[sim]'
	@touch $@

$(VENV)/.test: $(VENV)/bin/python $(SOURCES)
	$(PIP) install --quiet --constraint tests/constraints.txt --editable '.[test]'
	@touch $@ $(VENV)/.run

$(VENV)/.bench: $(VENV)/bin/python $(SOURCES)
	$(PIP) install --quiet --constraint tests/constraints.txt --editable '.[bench]'
	@touch $@ $(VENV)/.run $(VENV)/.test

clean:
	rm -rf $(VENV) artifacts build dist urdfkit/machine_code .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find urdfkit tests -name __pycache__ -type d -prune -exec rm -rf {} +

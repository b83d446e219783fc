# beardyn: set up, demonstrate, test. `make help` lists the targets.
# Variables: PYTHON (interpreter for the environment), VENV (its folder), ARGS (passed on to demo or pytest),
# JOBS (processes of the tests), BASE (commit that `make same` compares with).

PYTHON ?= python3
VENV ?= .venv
ARGS ?=
BASE ?= HEAD
# one a core, and one for the tests that wait
JOBS ?= $(shell expr $$(nproc) + 1)
PARALLEL = $(if $(filter-out 1,$(JOBS)),-n $(JOBS))

BIN := $(VENV)/bin
PIP_INSTALL = $(BIN)/python -m pip install --disable-pip-version-check
METADATA := setup.py setup.cfg pyproject.toml package.xml
# Inside a sourced ROS 2 its own rclpy is used; the wheels would bring a second one.
ROS := $(if $(ROS_DISTRO),,ros)
VENV_OPTIONS := $(if $(ROS_DISTRO),--system-site-packages)
# what the demo draws with, and its scene
DRAWING := view plot
DEMO_SCENE := cup_spall
COMMA := ,
EMPTY :=
extras = $(subst $(EMPTY) $(EMPTY),$(COMMA),$(strip $(ROS) $(1)))

.DEFAULT_GOAL := help
.PHONY: help demo follow test same slow hard random bench performance costs soak step light damping service heat structure impact monitor-measured ladder automatic validation lint docs site links dist sbom format clean
.DELETE_ON_ERROR:

help: ## what there is to make
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "make %-16s %s\n", $$1, $$2}' $(firstword $(MAKEFILE_LIST))

demo: $(VENV)/.ready ## set up, then the main job: wheel-rail load, spalled cup, recording, monitor, view (again: into demo_2, demo_3, ...)
	@$(BIN)/python -m beardyn_ros demo $(ARGS)

follow: $(VENV)/.ready-test ## set up, then a train played in full, followed from vibration and shaft alone: follow.png (again: ARGS=--force)
	@$(BIN)/python -m evidence.follow.demo $(ARGS)

test: $(VENV)/.ready-test ## set up, then the tests, on JOBS processes (one more than cores)
	@$(BIN)/python -m pytest $(PARALLEL) $(ARGS)

same: $(VENV)/.ready-test ## short runs of every tier beside those of commit BASE (default: the last one): same to the bit, or where not
	@$(BIN)/python -m test.golden.same $(BASE) $(ARGS)

slow: $(VENV)/.ready-test $(VENV)/.ready-docs ## set up, then the long tests as well
	@$(BIN)/python -m pytest -m "slow or not slow" $(PARALLEL) $(ARGS)

hard: $(VENV)/.ready-test ## set up, then the battery of hard cases side by side: table, hard.json; goes on where it was interrupted
	@$(BIN)/python -m evidence.hard $(ARGS)

random: $(VENV)/.ready-test ## set up, then random legal scenes, each finite or ended with a sentence, ARGS="--fast 10000 --full 300"; goes on where it was interrupted
	@$(BIN)/python -m evidence.random $(ARGS)

bench: $(VENV)/.ready-test ## set up, then every speed in one run: tables, and bench.json
	@$(BIN)/python -m benchmarks $(ARGS)

performance: ## write docs/performance.md and docs/evidence/speed.md from bench.json
	@$(BIN)/python -m evidence.performance.page bench.json

costs: $(VENV)/.ready ## set up, then what every effect costs in the time step (compiles 30 sets the first time)
	@$(BIN)/python benchmarks/effect_costs.py $(ARGS)

soak: $(VENV)/.ready-test ## set up, then nodes killed, fed nonsense, on a full disk, for ARGS="--minutes 60" (default 5)
	@$(BIN)/python -m evidence.ros.soak $(ARGS)

step: $(VENV)/.ready-test ## set up, then time steps against an explicit reference of 0.1 us: tables, step.json, docs/evidence/step.md
	@$(BIN)/python -m evidence.step $(ARGS)
	@$(BIN)/python -m evidence.step.page step.json

light: $(VENV)/.ready-test ## set up, then cages under light loads in every shipped set: docs/evidence/light.md
	@$(BIN)/python -m evidence.light.page $(ARGS)

service: $(VENV)/.ready-test ## set up, then what sensors in service measure: docs/evidence/sensors.md
	@$(BIN)/python -m evidence.service.page $(ARGS)

damping: $(VENV)/.ready-test ## set up, then damping times over their quoted range: docs/evidence/damping.md
	@$(BIN)/python -m evidence.damping.page $(ARGS)

heat: $(VENV)/.ready-test ## set up, then torque and steady temperatures beside published ones: docs/evidence/heat.md
	@$(BIN)/python -m evidence.heat.page $(ARGS)

structure: $(VENV)/.ready-test ## set up, then the modes of a box beside its finite elements: docs/evidence/structure.md
	@$(BIN)/python -m evidence.structure.page $(ARGS)

impact: $(VENV)/.ready-test ## set up, then impacts of spalls in a ringing box beside published ones: docs/evidence/impact.md
	@$(BIN)/python -m evidence.impact.page $(ARGS)

monitor-measured: $(VENV)/.ready-test ## set up, then the monitor over public records in ARGS="--cwru FOLDER --mfpt FOLDER": docs/evidence/monitor_measured.md
	@$(BIN)/python -m evidence.measured.page $(ARGS)

ladder: $(VENV)/.ready-test ## set up, then climb the ladders of three scenes and write docs/evidence/ladder.md
	@$(BIN)/python -m evidence.ladder.page $(ARGS)

automatic: $(VENV)/.ready-test ## set up, then try the automatic choices of twenty scenes and write docs/evidence/automatic.md
	@$(BIN)/python -m evidence.automatic.page $(ARGS)

validation: $(VENV)/.ready-test ## set up, then run every anchor and write docs/evidence/validation.md
	@$(BIN)/python -m evidence.validation.page $(ARGS)

lint: $(VENV)/.ready-dev ## style, types and the direction of imports
	@failed=; \
	for tool in "ruff check ." "ruff format --check ." mypy lint-imports; do \
		echo "== $$tool"; $(BIN)/$$tool || failed="$$failed, $$tool"; \
	done; \
	test -z "$$failed" || { echo "lint failed:$${failed#,}"; exit 1; }

docs: $(VENV)/.ready-docs ## set up, then the documentation site: docs/site/html/index.html
	@$(BIN)/sphinx-build --fail-on-warning --keep-going --quiet -d $(VENV)/doctrees docs docs/site/html $(ARGS)
	@echo "docs/site/html/index.html is written"

site: $(VENV)/.ready-docs ## set up, then the site as an archive to read offline: dist/beardyn-VERSION-site.zip
	@$(BIN)/python release/pack_site.py

links: $(VENV)/.ready-docs ## set up, then try the links of the pages to the world outside
	@$(BIN)/sphinx-build -b linkcheck --quiet -d $(VENV)/doctrees docs docs/site/links $(ARGS)

dist: $(VENV)/.ready-release ## set up, then lint the Dockerfile, and site, wheel and sdist in dist/, the packages tried in new environments of every Python 3.11 to 3.13 here; are the pictures of the present code?
	@$(BIN)/hadolint Dockerfile
	@$(BIN)/python release/try_release.py $(ARGS)
	@$(BIN)/python -m evidence.stamps --check

sbom: $(VENV)/.ready-release ## set up, then what an installation consists of: sbom.json (CycloneDX)
	@$(BIN)/cyclonedx-py environment --output-file sbom.json $(VENV)
	@echo "sbom.json is written"

format: $(VENV)/.ready-dev ## write the style instead of checking it
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

clean: ## remove the environment and everything that was built
	rm -rf $(VENV) build install log dist *.egg-info beardyn_core/shipped .mypy_cache .ruff_cache .pytest_cache .hypothesis \
		.import_linter_cache .coverage htmlcov docs/site
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# Editable, so that an edit is seen at once. pip leaves out the data files of an editable install, by which ROS 2
# finds the package (share/ and lib/beardyn): links do for them.
define install
	@echo "Installing beardyn$(if $(1),[$(1)]) into $(VENV)"
	@$(PIP_INSTALL) -e '.$(if $(1),[$(1)])'
	@mkdir -p $(VENV)/share/ament_index/resource_index/packages $(VENV)/lib/beardyn
	@ln -sfn "$(CURDIR)" $(VENV)/share/beardyn
	@ln -sf "$(CURDIR)/resource/beardyn" $(VENV)/share/ament_index/resource_index/packages/beardyn
	@ln -sf "$(CURDIR)"/scripts/* $(VENV)/lib/beardyn/
	@touch $@ $(VENV)/.ready-core
endef

$(VENV)/.ready-core: $(METADATA) | $(BIN)/python
	$(call install,)

# The kernels that the demo measures this machine with are compiled while pip brings the rest; where that fails, the
# demo compiles them.
$(VENV)/.ready: $(METADATA) | $(VENV)/.ready-core
	@echo "Installing beardyn[$(call extras,$(DRAWING))] into $(VENV)"
	@$(BIN)/beardyn warmup $(DEMO_SCENE) --tier quasistatic >/dev/null 2>&1 & \
	compiling=$$!; trap 'kill $$compiling 2>/dev/null' INT TERM; \
	if $(PIP_INSTALL) -e '.[$(call extras,$(DRAWING))]'; then wait $$compiling || true; \
	else kill $$compiling 2>/dev/null; exit 1; fi
	@touch $@

$(VENV)/.ready-test: $(METADATA) | $(BIN)/python
	$(call install,$(call extras,test))
	@touch $(VENV)/.ready

$(VENV)/.ready-dev: $(METADATA) | $(BIN)/python
	$(call install,$(call extras,test dev))
	@touch $(VENV)/.ready $(VENV)/.ready-test

$(VENV)/.ready-release: $(METADATA) | $(BIN)/python
	$(call install,$(call extras,release docs sweep $(DRAWING)))
	@touch $(VENV)/.ready

$(VENV)/.ready-docs: $(METADATA) | $(BIN)/python
	$(call install,$(call extras,docs sweep $(DRAWING)))
	@touch $(VENV)/.ready

$(BIN)/python:
	@command -v $(PYTHON) >/dev/null || { \
		echo "There is no $(PYTHON): install Python 3.11 or newer (sudo apt-get install python3 python3-venv)."; exit 2; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
		echo "$(PYTHON) is $$($(PYTHON) -V), too old: give a Python 3.11 to 3.13 with make PYTHON=/path/to/python3."; \
		exit 2; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || { \
		echo "$(PYTHON) cannot make virtual environments: sudo apt-get install python3-venv, then again."; exit 2; }
	@test -n "$(ROS_DISTRO)" || test "$$(uname -sm)" = "Linux x86_64" || { \
		echo "The ROS 2 wheels exist for Linux on x86_64 only: source a ROS 2 installation first, or use the desk"; \
		echo "commands alone: $(PYTHON) -m venv $(VENV) && $(BIN)/pip install '.[view,plot]' && $(BIN)/beardyn demo"; exit 2; }
	$(PYTHON) -m venv $(VENV_OPTIONS) $(VENV)

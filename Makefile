# `make demo` and `make test` need nothing but Debian, Python 3.11 or later, git, make and gcc:
# .ci/setup installs what is missing and keeps .venv/ up to date with the sources.

BIN := .venv/bin
SANITIZE ?= address,undefined
comma := ,
# A test asks for more memory than there is: the allocator says no, as it does without a sanitizer.
ASAN := halt_on_error=1:abort_on_error=1:print_summary=1:allocator_may_return_null=1
SANITIZE_BUILD := build/sanitize-$(subst $(comma),-,$(SANITIZE))
C_FILES = $(shell find kernel tests/kernel wrapper/fmu -name '*.[ch]')

export PATH := $(CURDIR)/$(BIN):$(PATH)

# In the order written, whatever -j says: pytest's closing line comes last. Ninja counts the cores itself.
.NOTPARALLEL:
unexport MAKEFLAGS

.PHONY: help setup demo bench bench-long calibrate gallery test test-kernel test-python test-browser lint format sanitize faults stress docs wheel wheel-test clean

help:
	@echo 'make demo         run the study studies/sphere_over_bars.toml; its files go to build/demo'
	@echo 'make test         check style and types, test the kernel, test the package'
	@echo 'make setup        install or update planemotion in .venv/'
	@echo 'make lint         style and types only'
	@echo 'make test-kernel  the C tests only'
	@echo 'make test-python  the Python tests only'
	@echo 'make test-browser animations and reports in Chromium, which it installs'
	@echo 'make format       rewrite the sources in the house style'
	@echo 'make sanitize     the C tests under ASan and UBSan (SANITIZE=thread: under TSan)'
	@echo 'make faults       plant faults in a copy of the kernel: the C tests must catch each'
	@echo 'make stress       changed scenes and tables, contacts beside their laws, pulses and waves (an hour)'
	@echo 'make calibrate    estimated errors against true ones, and what they cost (some minutes)'
	@echo 'make bench        speed beside error, against the peers: build/bench (about ten minutes)'
	@echo 'make bench-long   sweeps of a million cases: time, memory, workers of Dask, killed ones'
	@echo 'make docs         the pages of docs/: build/docs/index.html'
	@echo 'make wheel        wheels with the libraries in them, for each Python or PYTHONS="...": dist/'
	@echo 'make wheel-test   install them into clean environments and use them there'
	@echo 'make gallery      the index page of studies/chapter17, and how many of its answers are right'
	@echo 'make clean        remove build/, dist/ and .venv/'

setup:
	@.ci/setup

demo: setup
	@rm -rf build/demo
	$(BIN)/planemotion sweep studies/sphere_over_bars.toml --out build/demo

test: lint test-kernel test-python

test-kernel: setup
	$(BIN)/meson test -C build/python --print-errorlogs

# A file's tests stay together: they share what their fixtures make.
test-python: setup
	$(BIN)/python -m pytest --numprocesses auto --dist loadfile

test-browser:
	@.ci/setup --browser
	PLANEMOTION_BROWSER=required $(BIN)/python -m pytest tests/animation/test_browser.py tests/report/test_browser.py tests/animation/test_widget.py

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	@# The type checker reads the generated module of constants as a stub beside its users.
	@$(BIN)/python kernel/layout.py kernel/planemotion.h wrapper/planemotion/_layout.pyi
	$(BIN)/mypy
	@$(BIN)/planemotion schema --out build/scene.schema.json
	$(BIN)/tombi lint --offline --error-on-warnings studies/*.toml studies/chapter17 wrapper/planemotion/examples
	@echo clang-format --dry-run --Werror '<the C files>'
	@$(BIN)/clang-format --dry-run --Werror $(C_FILES)

format: setup
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .
	$(BIN)/clang-format -i $(C_FILES)

sanitize:
	@.ci/setup --tools
	@test -f $(SANITIZE_BUILD)/build.ninja || $(BIN)/meson setup $(SANITIZE_BUILD) -Dpython=false \
	    -Dbuildtype=debug -Doptimization=1 -Dwerror=false -Db_sanitize=$(SANITIZE) -Db_lundef=false
	ASAN_OPTIONS=$(ASAN) $(BIN)/meson test -C $(SANITIZE_BUILD) --print-errorlogs

stress: setup
	$(BIN)/python -m tests.stress $(STRESS)
	$(BIN)/python -m tests.stress.contacts $(CONTACTS)
	$(BIN)/python -m tests.stress.misses $(MISSES)
	$(BIN)/python -m tests.stress.kinds $(KINDS)
	$(BIN)/python -m tests.stress.tables $(TABLES)
	$(BIN)/python -m tests.stress.tables --valid
	$(BIN)/python -m tests.stress.tables --threads
	$(BIN)/python -m tests.stress.files $(FILES)
	$(BIN)/python -m tests.stress.drift $(DRIFT)
	$(BIN)/python -m tests.stress.routes $(ROUTES)
	$(BIN)/python -m tests.stress.values $(VALUES)

faults:
	@.ci/setup --tools
	$(BIN)/python -m tests.faults

bench:
	@.ci/setup --peers
	$(BIN)/python -m studies.benchmarks --out build/bench --keep

bench-long:
	@.ci/setup --peers
	$(BIN)/python -m studies.benchmarks --out build/bench-long --only memory_long,executors_long

calibrate: setup
	$(BIN)/python -m studies.benchmarks.calibration

gallery: setup
	$(BIN)/python -m tests.chapter17.gallery

docs:
	@.ci/setup --docs
	$(BIN)/sphinx-build -q -E -W --keep-going -b html docs build/docs

wheel:
	@.ci/setup --wheel
	@.ci/wheel

wheel-test:
	@.ci/setup --wheel
	@.ci/wheel-test $(WHEEL)

clean:
	rm -rf build dist .venv wrapper/planemotion/_layout.pyi

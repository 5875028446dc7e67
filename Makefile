# Thin wrappers; `make check` is what CI does.
.PHONY: test explore check-torch check-added doctest lint docs native wasm page benchmarks campaigns mutants check
test:
	pytest -m 'slow or not slow'
# the same tests with all the cases that they can draw, and new examples of Hypothesis
explore:
	CAROM_EXPLORE=1 pytest
doctest:
	pytest --doctest-modules --pyargs carom
lint:
	ruff check . && ruff format --check . && mypy && lint-imports
docs:
	sphinx-build -q -j 4 -W --keep-going -b html docs docs/_build/html
# the loops that lie ready in the package: those whose kernels have changed (all of them, with --all: a few minutes)
native:
	python -m carom.cli.build_loops
# the explorer's WebAssembly module, from today's kernels (extra wasm)
wasm:
	python -m carom.explorer.module
# the explorer's page: types, lint, and the bundle of web/ with three.js (Node 20 or later)
page:
	cd web && npm install --no-package-lock --no-audit --no-fund && npm run check && npm run build
# speed, also against other programs (those that are installed): one table, and build/benchmarks.json
benchmarks:
	python benchmarks/rows.py
# derivatives through PyTorch, where it is installed (extra torch)
check-torch:
	pytest -n0 tests/interop/check_torch.py
# a law and shapes that are added as files are in the page, whose module is built anew
check-added:
	pytest -n0 tests/explorer/check_added_files.py
# what takes minutes to hours to count; results go to campaigns/results.md
campaigns: explore check-added
	python campaigns
# changes of one place that the tests should notice: make mutants N=8
N = 25
mutants:
	python campaigns/mutants.py $(N) --rows build/mutants.jsonl
check:
	bash .ci/run

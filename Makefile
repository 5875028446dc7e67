# Thin wrappers; `make check` is what CI does.
.PHONY: test lint docs bench check
test:
	pytest
lint:
	ruff check . && ruff format --check . && mypy && lint-imports
docs:
	sphinx-build -q -W --keep-going -b html docs docs/_build/html
bench:
	python benchmarks/arrays.py
check:
	bash .ci/run

# Thin: each target is a script, so that each can be read and run by itself.
.PHONY: help demo test check format lint

help:
	@echo "make demo    install packages, build, convert and render the Stanford Dragon"
	@echo "make test    install packages, build, run all tests"
	@echo "make check   formatting, include cycles, documentation, clang-tidy, fuzzing with sanitizers"
	@echo "make format  format all C++ files in place"
	@echo "make lint    list C++ files that are not formatted"

demo:
	@scripts/demo.sh

test:
	@scripts/test.sh

check:
	@scripts/check.sh

format:
	@scripts/format.sh

lint:
	@scripts/format.sh --check

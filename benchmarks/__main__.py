"""Run every benchmark: ``python -m benchmarks``."""

from benchmarks import derive

if __name__ == "__main__":
    derive.main()

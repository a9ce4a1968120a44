"""Run every benchmark: ``python -m benchmarks``."""

from benchmarks import derive, prove

if __name__ == "__main__":
    derive.main([])
    prove.main([])

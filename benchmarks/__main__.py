"""Run every benchmark: ``python -m benchmarks``."""

from benchmarks import catalogue, derive, prove

if __name__ == "__main__":
    derive.main([])
    catalogue.main([])
    prove.main([])

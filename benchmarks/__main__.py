"""Run every benchmark: ``python -m benchmarks``."""

from benchmarks import catalogue, derive, linear, modal, prove, simulate

if __name__ == "__main__":
    derive.main([])
    catalogue.main([])
    prove.main([])
    linear.main([])
    modal.main([])
    simulate.main([])

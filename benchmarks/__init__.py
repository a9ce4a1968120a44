"""Side by side with other tools, in one interleaved run: ``python -m benchmarks``."""

"""How far a long run has come, told on a terminal or in a notebook; silent where a machine reads the output."""

from __future__ import annotations

import os
import sys
import time

__all__ = ["Progress"]

PATIENCE, PAUSE = 3.0, 0.5
"""Seconds before anything is said, and between two messages."""


class Progress:
    """Percents of a run, on the stream of errors.

    Silent in scripts whose output goes to a file, under pytest and nbval, and with ``ENGDYN_PROGRESS=0``.
    """

    def __init__(self, what: str):
        self._what, self._shown = what, False
        self._next = time.monotonic() + PATIENCE
        people = sys.stderr.isatty() or "ipykernel" in sys.modules
        quiet = os.environ.get("ENGDYN_PROGRESS") == "0" or "PYTEST_CURRENT_TEST" in os.environ
        self._talks = people and not quiet

    def tell(self, share: float) -> None:
        """Say how much is done, 0 to 1, if somebody waits."""
        if self._talks and time.monotonic() > self._next:
            self._next = time.monotonic() + PAUSE
            self._shown = True
            print(f"\r{self._what}: {100 * share:.0f} %", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        """Take the message away."""
        if self._shown:
            print("\r" + " " * (len(self._what) + 10) + "\r", end="", file=sys.stderr, flush=True)

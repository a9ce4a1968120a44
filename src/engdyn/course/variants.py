"""Every student's own numbers: parameters drawn from a hash of course, exercise and student.

The same three names give the same numbers on every machine and with every version of Python: all
arithmetic is on integers taken from SHA-256 digests, and a value becomes a float only at the end, from
its decimal digits.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any

from engdyn.errors import EngdynError

__all__ = ["course_code", "draw_values", "student_name"]

#: Half of the range in which a parameter is drawn, as a share of its default.
SPREAD = Fraction(1, 5)
#: Significant digits of a drawn value.
DIGITS = 3
#: Draws before an exercise is declared impossible; a bank's test keeps it far from this.
ATTEMPTS = 400


def course_code() -> str:
    """The course in which numbers are drawn: the environment variable ENGDYN_COURSE, else "engdyn".

    An instructor who sets it (to "ME342-2027", say) gives a new year new numbers.
    """
    return os.environ.get("ENGDYN_COURSE", "").strip() or "engdyn"


def student_name(student: Any) -> str:
    """A student id as it enters the hash: text without outer spaces, in lower case.

    Raises
    ------
    EngdynError
        Neither text nor a whole number, empty, or longer than 200 characters.
    """
    if isinstance(student, int) and not isinstance(student, bool) and 0 <= student < 10**30:
        return str(student)
    if not isinstance(student, str):
        kind = type(student).__name__
        raise EngdynError(f"student is a {kind}: give your student id as text, such as 'ab123', or None")
    name = student.strip().casefold()
    if not name or len(name) > 200:
        raise EngdynError("student is empty or longer than 200 characters: give your student id, or None")
    return name


def draw_values(
    defaults: Mapping[str, float],
    varied: Iterable[str],
    accepted: Callable[[dict[str, float]], bool],
    exercise: str,
    student: str,
    course: str | None = None,
) -> dict[str, float]:
    """Parameter values of one student.

    Parameters
    ----------
    defaults : mapping of str to float
        All parameters [SI].
    varied : iterable of str
        Names of those that differ from student to student; the others keep their default.
    accepted : callable
        Whether a set of values makes a clear-cut exercise; where not, the next draw is tried.
    exercise, student : str
        What the hash is made of, with `course` (default: `course_code`).

    Returns
    -------
    dict of str to float
        In the order of `defaults`; drawn values lie within ±20 % of the default, rounded to 3
        significant digits.

    Raises
    ------
    EngdynError
        No draw was accepted: the exercise is ill-posed.
    """
    varied = set(varied)
    course = course_code() if course is None else course
    for attempt in range(ATTEMPTS):
        values = {
            name: _draw(default, (course, exercise, student, name, str(attempt)))
            if name in varied
            else default
            for name, default in defaults.items()
        }
        if accepted(values):
            return values
    raise EngdynError(
        f"exercise {exercise}: none of {ATTEMPTS} draws of its parameters is clear-cut; report this"
    )


def _draw(default: float, names: tuple[str, ...]) -> float:
    """One value around a default, from the digest of some names."""
    # a length before every name keeps ("ab", "c") and ("a", "bc") apart
    text = "".join(f"{len(name)}:{name}" for name in names)
    number = int.from_bytes(hashlib.sha256(text.encode("utf-8")).digest()[:8], "big")
    factor = 1 - SPREAD + 2 * SPREAD * Fraction(number, 2**64)
    return _rounded(Fraction(repr(default)) * factor)


def _rounded(value: Fraction) -> float:
    """A fraction rounded half up to three significant digits, as the float of those digits."""
    if value == 0:
        return 0.0
    size, exponent = abs(value), 0
    while size >= 10**DIGITS:
        size, exponent = size / 10, exponent + 1
    while size < 10 ** (DIGITS - 1):
        size, exponent = size * 10, exponent - 1
    digits = (2 * size.numerator + size.denominator) // (2 * size.denominator)
    return float(f"{'-' if value < 0 else ''}{digits}e{exponent}")

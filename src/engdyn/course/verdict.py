"""What the check of an answer says.  Course exercises of all chapters."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape

__all__ = ["Verdict", "not_yet", "right", "unanswered"]


@dataclass(frozen=True)
class Verdict:
    """The verdict on one answer; truthy only when the answer is right.

    Attributes
    ----------
    right : bool
        Whether the answer is right.
    answered : bool
        False while the answer still is ``...``.
    hint : str
        What to look at next; for a right answer a remark, where there is one.
    exercise : str
        Id of the exercise.
    """

    right: bool
    answered: bool
    hint: str
    exercise: str = ""

    def __bool__(self) -> bool:
        return self.right

    @property
    def headline(self) -> str:
        """The verdict in two or three words."""
        if not self.answered:
            return "not answered yet"
        return "right" if self.right else "not right yet"

    def __repr__(self) -> str:
        name = f"Exercise {self.exercise}: " if self.exercise else ""
        return f"{name}{self.headline}.{' ' + self.hint if self.hint else ''}"

    def _repr_html_(self) -> str:
        sign = "✓" if self.right else "✗" if self.answered else "…"
        color = "#1a7f37" if self.right else "#9a3412" if self.answered else "#57606a"
        name = f"Exercise {escape(self.exercise)}: " if self.exercise else ""
        remark = f" {escape(self.hint)}" if self.hint else ""
        return (
            f'<div style="border-left: 4px solid {color}; padding: 0.3em 0.8em">'
            f"<strong>{sign} {name}{self.headline}.</strong>{remark}</div>"
        )


def right(remark: str = "") -> Verdict:
    """The verdict on a right answer."""
    return Verdict(True, True, remark)


def not_yet(hint: str) -> Verdict:
    """The verdict on an answer that is not right, with the hint that it deserves."""
    return Verdict(False, True, hint)


def unanswered() -> Verdict:
    """The verdict on ``...``."""
    return Verdict(False, False, "Put your answer in place of the three dots and run the cell again.")

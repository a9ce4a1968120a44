from .checking import check
from .registry import exercise, exercises, variant
from .verdict import Verdict

__all__ = ["Verdict", "check", "exercise", "exercises", "variant"]

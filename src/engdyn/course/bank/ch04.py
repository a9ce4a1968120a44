"""The exercises of chapter 4, equilibrium solutions."""

from __future__ import annotations

from engdyn.course.bank.ch04_crane import CRANE, CRANE_ANGLE, CRANE_STORY
from engdyn.course.bank.ch04_governor import GOVERNOR, GOVERNOR_COSINE, GOVERNOR_ROOTS, GOVERNOR_SPEED
from engdyn.course.bank.ch04_half_car import HALF_CAR, PITCH, TIRE_LOAD
from engdyn.course.bank.ch04_lamp import LAMP, LAMP_EQUATION, LAMP_ROOTS, LAMP_STIFFNESS
from engdyn.course.bank.ch04_magnet import MAGNET, MAGNET_CURRENT, MAGNET_EQUATION, MAGNET_ROOTS
from engdyn.course.registry import Exercise

__all__ = ["EXERCISES"]

EXERCISES = (
    Exercise("4.3", ("S03",), "How far does the governor open?", "4.3", 10, 2, GOVERNOR, GOVERNOR_COSINE),
    Exercise(
        "4.3b", ("S03",), "When does the governor begin to open?", "4.3", 5, 2, GOVERNOR, GOVERNOR_SPEED
    ),
    Exercise("4.3c", ("S03",), "All steady angles at your speed", "4.3", 5, 1, GOVERNOR, GOVERNOR_ROOTS),
    Exercise(
        "4.7", ("S07",), "The container behind an accelerating trolley", "4.3", 10, 2, CRANE, CRANE_ANGLE
    ),
    Exercise("4.7b", ("S07",), "The same force, but with a brake", "4.4", 5, 2, CRANE, CRANE_STORY),
    Exercise("4.13", ("S23",), "What the front tire carries", "4.2", 5, 1, HALF_CAR, TIRE_LOAD),
    Exercise("4.13b", ("S23",), "Nose up or nose down?", "4.2", 15, 2, HALF_CAR, PITCH),
    Exercise("4.14", (), "A desk lamp: your equation of motion", "4.1", 10, 2, LAMP, LAMP_EQUATION),
    Exercise("4.14b", (), "A desk lamp: every angle at which it rests", "4.1", 10, 2, LAMP, LAMP_ROOTS),
    Exercise(
        "4.14c", (), "A desk lamp: the stiffness that holds it upright", "4.2", 10, 3, LAMP, LAMP_STIFFNESS
    ),
    Exercise("4.15", (), "A holding magnet: your equation of motion", "4.1", 5, 1, MAGNET, MAGNET_EQUATION),
    Exercise(
        "4.15b", (), "A holding magnet: where the armature can rest", "4.1", 10, 2, MAGNET, MAGNET_ROOTS
    ),
    Exercise("4.15c", (), "A holding magnet: the pull-in current", "4.2", 10, 3, MAGNET, MAGNET_CURRENT),
)

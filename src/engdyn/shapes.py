r"""Drawings as data: the small vocabulary in which a system describes its picture (Appendix A).

A system returns a list of these shapes for a pose and a set of parameter values; ``engdyn.plots`` turns them
into a picture. As the geometry comes from the parameters of the model, drawing and model cannot disagree.

Points are tuples of 2 or 3 coordinates in meters (X right, Y up; in space Z up), angles are in radians,
labels are mathtext (``"$\theta$"``). A shape says what it *is*, its ``role`` decides the color. Sizes that
only serve reading (arrow heads, hatching, the width of a spring) are left to the picture unless given.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from engdyn.errors import EngdynError

# fmt: off
__all__ = [
    "ROLES", "AngleArrow", "Box", "CenterLine", "CenterOfMass", "CoordinateArrow", "Curve", "Damper",
    "Dimension", "Disc", "ForceArrow", "GravityArrow", "Ground", "Label", "Link", "MomentArrow", "Particle",
    "Pin", "Polygon", "Shape", "Spring", "Support", "TorsionalDamper", "TorsionalSpring", "Triad",
    "VectorArrow", "Wheel",
]

Point = tuple[float, ...]
Points = tuple[Point, ...]

#: What a shape stands for; the style of a picture gives each role its color.
ROLES = ("body", "link", "spring", "damper", "joint", "ground",
         "reference", "parameter", "coordinate", "input",
         "position", "velocity", "acceleration", "momentum", "force", "reaction")
# fmt: on


def _numbers(value, sizes: tuple[int, ...], owner: str) -> Point:
    """Return ``value`` as a tuple of finite floats, or say what is wrong with it."""
    try:
        numbers = tuple(float(item) for item in value)
    except (TypeError, ValueError):
        numbers = ()
    if len(numbers) not in sizes:
        raise EngdynError(
            f"{owner}: {value!r} is no point; give 2 (plane) or 3 (space) coordinates in meters."
        )
    if not all(map(math.isfinite, numbers)):
        raise EngdynError(f"{owner}: {value!r} is not finite; check the pose and the parameter values.")
    return numbers


@dataclass(frozen=True)
class Shape:
    """Common to all shapes: points, numbers, texts and the role are checked once, when the shape is made.

    Raises
    ------
    EngdynError
        What is wrong, with the name of the field.
    """

    def __post_init__(self) -> None:
        for field in fields(self):
            value, owner = getattr(self, field.name), f"{type(self).__name__}.{field.name}"
            if value is None:
                continue
            if field.type.startswith("Points"):
                value = tuple(_numbers(point, (2, 3), owner) for point in value)
                if len(value) < 2:
                    raise EngdynError(f"{owner} needs at least two points; {len(value)} given.")
            elif field.type.startswith("Point"):
                value = _numbers(value, (2, 3), owner)
            elif field.type.startswith("float"):
                value = _numbers((value,), (1,), owner)[0]
            elif field.type == "str" and not isinstance(value, str):
                raise EngdynError(f"{owner} is {value!r}, not text; give further arguments by name.")
            elif field.name == "role" and value not in ROLES:
                raise EngdynError(f"{owner} {value!r} is unknown; choose from {', '.join(ROLES)}.")
            object.__setattr__(self, field.name, value)


@dataclass(frozen=True)
class _Between(Shape):
    """A shape that runs from ``start`` to ``end``."""

    start: Point
    end: Point
    label: str = ""


@dataclass(frozen=True)
class _Around(Shape):
    """A shape along the arc ``center + radius*(x_axis*cos + y_axis*sin)`` from angle ``start`` to ``end``;
    the axes span its plane; a shortened ``y_axis`` shows a turn about an axis in the plane of the picture.
    """

    center: Point
    radius: float
    start: float
    end: float
    label: str = ""
    x_axis: Point = (1.0, 0.0)
    y_axis: Point = (0.0, 1.0)


@dataclass(frozen=True)
class _At(Shape):
    """A mark at one point, of fixed size on paper."""

    point: Point
    label: str = ""


@dataclass(frozen=True)
class Polygon(Shape):
    """A rigid body with straight edges (or any closed outline given by many points)."""

    points: Points
    label: str = ""
    role: str = "body"


@dataclass(frozen=True)
class Box(Shape):
    """A rectangle (width, height) turned by ``angle``; with three sizes a box along the unit ``axes``."""

    center: Point
    size: Point
    angle: float = 0.0
    label: str = ""
    role: str = "body"
    axes: Points = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Disc(Shape):
    """A round body in the plane of its axes; ``angle``, if given, shows its rotation by a radius."""

    center: Point
    radius: float
    angle: float | None = None
    label: str = ""
    role: str = "body"
    x_axis: Point = (1.0, 0.0)
    y_axis: Point = (0.0, 1.0)


@dataclass(frozen=True)
class Particle(_At):
    """A point mass: a dot."""

    role: str = "body"


@dataclass(frozen=True)
class Wheel(Shape):
    """A wheel with tire, seen from the side; below the height ``flat`` (the road) the tire is flattened."""

    center: Point
    radius: float
    angle: float | None = None
    flat: float | None = None
    label: str = ""
    role: str = "body"


@dataclass(frozen=True)
class CenterOfMass(_At):
    """The quartered circle that marks a center of mass."""

    role: str = "reference"


@dataclass(frozen=True)
class Link(_Between):
    """A massless rigid rod or shaft."""

    role: str = "link"


@dataclass(frozen=True)
class Curve(Shape):
    """A line through many points: a track, a wire, an elastic shaft."""

    points: Points
    label: str = ""
    role: str = "link"


@dataclass(frozen=True)
class Spring(_Between):
    """A helical spring; ``width`` in meters, or None for a width that suits the picture."""

    coils: int = 5
    width: float | None = None
    role: str = "spring"


@dataclass(frozen=True)
class Damper(_Between):
    """A dashpot: cylinder at ``start``, piston rod to ``end``; ``width`` as for a spring."""

    width: float | None = None
    role: str = "damper"


@dataclass(frozen=True)
class TorsionalSpring(_Around):
    """A spiral spring about ``center`` between the directions ``start`` and ``end``."""

    role: str = "spring"


@dataclass(frozen=True)
class TorsionalDamper(_Around):
    """A rotary dashpot about ``center`` between the directions ``start`` and ``end``."""

    role: str = "damper"


@dataclass(frozen=True)
class Pin(_At):
    """A pin joint: a small open circle."""

    role: str = "joint"


@dataclass(frozen=True)
class Support(_At):
    """A fixed pin bearing; its triangle stands on ground in the direction ``angle`` from the pin."""

    angle: float = -math.pi / 2
    role: str = "ground"


@dataclass(frozen=True)
class Ground(_Between):
    """A fixed surface, hatched on the right-hand side of the way from ``start`` to ``end``."""

    role: str = "ground"


@dataclass(frozen=True)
class CenterLine(_Between):
    """A dash-dotted center line, or with ``arrow`` a reference axis with its arrow at ``end``."""

    arrow: bool = False
    role: str = "reference"


@dataclass(frozen=True)
class Dimension(_Between):
    """A dimension line, set off by ``offset`` meters to the left of the way from ``start`` to ``end``."""

    offset: float = 0.0
    role: str = "parameter"


@dataclass(frozen=True)
class Label(Shape):
    """Text near a point; ``side`` is the direction in which it would rather stand, (0, 0) is on the point."""

    point: Point
    text: str
    side: Point = (0.0, 0.0)
    role: str = "parameter"


@dataclass(frozen=True)
class CoordinateArrow(_Between):
    """A coordinate counted from ``start``, now at ``end``; too short to see, it points along ``positive``."""

    positive: Point = (1.0, 0.0)
    role: str = "coordinate"


@dataclass(frozen=True)
class AngleArrow(_Around):
    """An angle counted from direction ``start``, now at ``end``; ``positive`` is +1 or -1 in its plane."""

    positive: float = 1.0
    role: str = "coordinate"


@dataclass(frozen=True)
class ForceArrow(_Between):
    """An applied force; the head is at ``end``."""

    role: str = "input"


@dataclass(frozen=True)
class MomentArrow(_Around):
    """An applied couple, or with role reference a rotation kept up from outside; head at ``end``."""

    role: str = "input"


@dataclass(frozen=True)
class GravityArrow(_Between):
    """The direction in which gravity acts; the head is at ``end``."""

    role: str = "reference"


@dataclass(frozen=True)
class VectorArrow(_Between):
    """A vector drawn from ``start`` to ``end``; ``double`` gives it the two heads of a rotation or a moment.

    A vector without length is not drawn.
    """

    double: bool = False
    role: str = "velocity"


@dataclass(frozen=True)
class Triad(Shape):
    """Unit vectors of a frame; a third label of two axes belongs to the one that points at the reader."""

    origin: Point
    axes: Points = ((1.0, 0.0), (0.0, 1.0))
    labels: tuple[str, ...] = ("$x$", "$y$")
    length: float = 0.2
    role: str = "reference"

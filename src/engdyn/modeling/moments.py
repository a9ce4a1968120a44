"""Angular momentum, and the moment balance of a body about any point, term by term.

Course sections 2.8 to 2.10; L. Euler, *Nova methodus motum corporum rigidorum determinandi* (1775).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import sympy as sm
from sympy.physics.mechanics import Force, Particle, RigidBody
from sympy.physics.vector import Point, ReferenceFrame, Vector

from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError
from engdyn.modeling.free_body import FreeBody, load_vector
from engdyn.modeling.model_motion import center_of, frames_of, inertial_frame, motion_of, place, readable
from engdyn.modeling.motion import Motion, Triple, cross, dot, measure_numbers, path_of_point

__all__ = ["MomentBalance", "angular_momentum", "moment_balance"]

Body: TypeAlias = Particle | RigidBody | FreeBody


def angular_momentum(
    bodies: Body | Sequence[Body],
    point: Point,
    frame: ReferenceFrame,
    *,
    axes: ReferenceFrame | None = None,
) -> Vector:
    """Angular momentum about a point, H = Σ (I_G ω + r_PG × m v_G).

    Parameters
    ----------
    bodies : Particle, RigidBody, FreeBody or a sequence of them
    point : Point
        P, placed from the mass centers.  It may move: the velocities are absolute all the same.
    frame : ReferenceFrame
        The inertial frame.
    axes : ReferenceFrame, optional
        In whose axes the result is written; those of the inertia of a single rigid body, else those
        of `frame`, where not given.

    Returns
    -------
    Vector
        [kg m²/s], factored.

    Raises
    ------
    EngdynError
        Not a body, points that are not connected, a frame that is not oriented.

    Notes
    -----
    Course sections 2.8 and 2.9.  About G itself only I_G ω is left; H and ω are parallel only where
    ω lies along a principal axis.
    """
    frame = inertial_frame(frame)
    found = [bodies] if isinstance(bodies, Particle | RigidBody | FreeBody) else list(bodies)
    found = [_plain(body) for body in found]
    if axes is None:
        axes = _inertia_axes(found[0], frame) if len(found) == 1 else frame
    arms = [place(center_of(body), point, "a mass center") for body in found]
    motion = _motion(found, [point], arms, axes, frame)
    total = [motion.state.ring.zero] * 3
    for body, arm in zip(found, arms, strict=True):
        path = path_of_point(center_of(body), frame)
        velocity = motion.turned(motion.velocity(path), frame, axes)
        total = _sum(total, central_momentum(body, motion, axes))
        total = _sum(total, cross(motion.components(arm, axes), _times_mass(body, velocity, motion)))
    return vector_of(total, axes)


@dataclass(frozen=True)
class MomentBalance:
    """ΣM_A = dH_A/dt + r_AG × m a_A of one free body, every term by its name.

    H_A is the angular momentum of the motion *relative to A* (I_G ω + r_AG × m (v_G − v_A)), which
    for a point A of the body is I_A ω.

    Attributes
    ----------
    body : str
        Name of the body.
    about : Point
        The reference point A.
    kind : {"mass center", "fixed point", "accelerating point"}
        About the first two there is no extra term.  A point in uniform motion counts as fixed.
    moments : Vector
        ΣM_A of all loads, applied ones and reactions [N m].
    angular_momentum : Vector
        H_A [kg m²/s].
    component_derivative, turning : Vector
        Derivative of the components of H_A in :attr:`axes`, and ω_axes × H_A [N m].
    extra : Vector
        r_AG × m a_A, the term that an accelerating reference point brings in [N m].
    equation : tuple of three expressions
        dH_A/dt + r_AG × m a_A − ΣM_A along the three :attr:`axes`; each must vanish.
    axes : ReferenceFrame
        In whose axes everything is written.
    """

    body: str
    about: Point
    kind: str
    moments: Vector
    angular_momentum: Vector
    component_derivative: Vector
    turning: Vector
    extra: Vector
    equation: tuple[sm.Expr, ...]
    axes: ReferenceFrame

    @property
    def rate_of_change(self) -> Vector:
        """dH_A/dt seen from the inertial frame: change of the components plus ω_axes × H_A."""
        return self.component_derivative + self.turning

    def __repr__(self) -> str:
        return f"MomentBalance({self.body} about {self.about}, {self.kind})"

    def _repr_latex_(self) -> str:
        from sympy.physics.vector.printing import vlatex

        name = self.about.name
        terms = [(rf"\sum \mathbf{{M}}_{{{name}}}", self.moments)]
        terms.append((rf"\dot{{\mathbf{{H}}}}_{{{name}}}", self.rate_of_change))
        if self.kind == "accelerating point":
            terms.append((rf"\mathbf{{r}}_{{{name}G}} \times m\,\mathbf{{a}}_{{{name}}}", self.extra))
        rows = [rf"{left} &= {vlatex(term) if term != 0 else 0}" for left, term in terms]
        return "$\\displaystyle \\begin{aligned}" + r"\\".join(rows) + r"\end{aligned}$"


def moment_balance(
    free_body: FreeBody, about: Point, frame: ReferenceFrame, *, axes: ReferenceFrame | None = None
) -> MomentBalance:
    """Moment balance of a free body about its mass center, a fixed point, or any accelerating point.

    Parameters
    ----------
    free_body : FreeBody
    about : Point
        The reference point A; on the body or not, at rest or not.
    frame : ReferenceFrame
        The inertial frame.
    axes : ReferenceFrame, optional
        In whose axes everything is written; those of the body's inertia where not given.

    Returns
    -------
    MomentBalance

    Raises
    ------
    EngdynError
        Not a free body, points that are not connected, a torque on a particle.

    Notes
    -----
    Course section 2.8.  Sum up r × m a over the particles of the body with a = a_A + (a − a_A): the
    first part gives r_AG × m a_A, the second the change of the angular momentum relative to A.

    Examples
    --------
    >>> import engdyn as ed, sympy as sm
    >>> from sympy.physics.mechanics import Force, Point, ReferenceFrame, RigidBody, dynamicsymbols, inertia
    >>> x, theta = dynamicsymbols("x theta")
    >>> m, l = sm.symbols("m l")
    >>> N, B, O = ReferenceFrame("N"), ReferenceFrame("B"), Point("O")
    >>> O.set_vel(N, 0)
    >>> B.orient_axis(N, theta, N.z)
    >>> A = O.locatenew("A", x * N.x)  # the hinge moves
    >>> G = A.locatenew("G", -l / 2 * B.y)
    >>> bar = RigidBody("bar", G, B, m, (inertia(B, 0, 0, m * l**2 / 12), G))
    >>> balance = ed.moment_balance(ed.FreeBody(bar), A, N)
    >>> balance
    MomentBalance(bar about A, accelerating point)
    >>> balance.extra
    l*m*cos(theta(t))*Derivative(x(t), (t, 2))/2*B.z
    """
    if not isinstance(free_body, FreeBody):
        raise EngdynError(f"{free_body!r} is not a FreeBody: wrap the body and its loads in engdyn.FreeBody")
    frame = inertial_frame(frame)
    body, axes = free_body.body, axes or _inertia_axes(free_body.body, frame)
    loads = _loads_about(free_body, about)
    to_center = place(free_body.center, about, "the mass center")
    vectors = [to_center, *(v for pair in loads for v in pair if v is not None)]
    motion = _motion([body], [about], vectors, axes, frame)
    own = motion.velocity(path_of_point(about, frame))
    relative = _difference(motion.velocity(path_of_point(free_body.center, frame)), own)
    relative, acceleration = (
        _times_mass(body, motion.turned(part, frame, axes), motion)
        for part in (relative, motion.derivative(own))
    )
    r = motion.components(to_center, axes)
    momentum = _sum(central_momentum(body, motion, axes), cross(r, relative))
    changing = motion.derivative(momentum)
    turning = cross(motion.angular_velocity(axes, axes), momentum)
    extra = cross(r, acceleration)
    moments = [motion.state.ring.zero] * 3
    for arm, load in loads:
        part = motion.components(load, axes)
        moments = _sum(moments, part if arm is None else cross(motion.components(arm, axes), part))
    residual = _difference(_sum(_sum(changing, turning), extra), moments)
    center, fixed = (all(e.is_zero() for e in part) for part in (r, acceleration))
    return MomentBalance(
        free_body.name,
        about,
        "mass center" if center else "fixed point" if fixed else "accelerating point",
        *(vector_of(part, axes) for part in (moments, momentum, changing, turning, extra)),
        tuple(readable(e) for e in residual),
        axes,
    )


def _loads_about(free_body: FreeBody, about: Point) -> list[tuple[Vector | None, Vector]]:
    """Arm (None for a torque) and vector of every load."""
    found = []
    for load in (*free_body.applied, *free_body.reactions):
        if not isinstance(load, Force) and not free_body.turns:
            raise EngdynError(
                f"a torque acts on the particle {free_body.name}: particles do not turn, use a RigidBody"
            )
        arm = place(load.point, about, "the point of a force") if isinstance(load, Force) else None
        found.append((arm, load_vector(load)))
    return found


def central_momentum(body: Particle | RigidBody, motion: Motion, axes: ReferenceFrame) -> Triple:
    """I_G ω, components in `axes` (zero for a particle)."""
    momentum = [motion.state.ring.zero] * 3
    if isinstance(body, RigidBody):
        spin = motion.angular_velocity(body.frame, axes)
        for measure, left, right in body.central_inertia.args:
            value = motion.state.convert(as_expression(measure)) * dot(motion.components(right, axes), spin)
            momentum = _sum(momentum, [value * e for e in motion.components(left, axes)])
    return momentum


def vector_of(components: Triple, frame: ReferenceFrame) -> Vector:
    """A sympy vector from ring components, factored."""
    parts = [(readable(c), axis) for c, axis in zip(components, frame, strict=True)]
    return sum((p * axis for p, axis in parts if p != 0), Vector(0))


def _motion(
    bodies: Sequence[Particle | RigidBody],
    points: Sequence[Point],
    vectors: Sequence[Vector],
    axes: ReferenceFrame,
    ground: ReferenceFrame,
) -> Motion:
    """A ring in which all that moves can be differentiated, and the vectors can be converted."""
    paths = [path_of_point(p, ground) for p in (*points, *map(center_of, bodies))]
    rigid = [body for body in bodies if isinstance(body, RigidBody)]
    units = [unit for body in rigid for part in body.central_inertia.args for unit in part[1:]]
    scalars = measure_numbers(
        *(body.mass for body in bodies), *(body.central_inertia for body in rigid), *vectors
    )
    return motion_of(
        ground, paths, [axes, *(body.frame for body in rigid)], scalars, frames_of(*units, *vectors)
    )


def _plain(body: Any) -> Particle | RigidBody:
    body = body.body if isinstance(body, FreeBody) else body
    if not isinstance(body, Particle | RigidBody):
        raise EngdynError(f"{body!r} is neither a Particle nor a RigidBody of sympy.physics.mechanics")
    return body


def _inertia_axes(body: Particle | RigidBody, otherwise: ReferenceFrame) -> ReferenceFrame:
    """The axes in which the inertia of a body is written."""
    parts = body.central_inertia.args if isinstance(body, RigidBody) else ()
    return parts[0][1].args[0][1] if parts else otherwise


def _times_mass(body: Particle | RigidBody, components: Triple, motion: Motion) -> Triple:
    mass = motion.state.convert(as_expression(body.mass))
    return [mass * c for c in components]


def _sum(a: Triple, b: Triple) -> Triple:
    return [x + y for x, y in zip(a, b, strict=True)]


def _difference(a: Triple, b: Triple) -> Triple:
    return [x - y for x, y in zip(a, b, strict=True)]

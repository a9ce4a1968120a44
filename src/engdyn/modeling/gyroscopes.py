"""Steady motions of axisymmetric bodies: free precession, and the slow and the fast one of a top.

Course sections 2.12 and 2.14.  Closed forms; the equations of motion behind them come from
:func:`engdyn.euler_equations`, :func:`engdyn.newton_euler` and :func:`engdyn.lagrange`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import sympy as sm

from engdyn.algebra.expressions import as_expression
from engdyn.errors import EngdynError
from engdyn.modeling.inertia import check_positive, is_symbolic

__all__ = ["FreePrecession", "SteadyPrecession", "free_precession", "steady_precession"]

#: A cosine of the nutation angle below this is zero: the axis is square to the vertical.
SQUARE = 1e-12


@dataclass(frozen=True)
class FreePrecession:
    """Torque-free motion of an axisymmetric body; every rate in rad/s.

    Attributes
    ----------
    precession : float or sympy.Expr
        Rate at which the axis of symmetry goes around the fixed H, seen by an observer at rest.
    wobble : float or sympy.Expr
        Rate at which ω goes around the axis of symmetry, seen from the body; positive in the sense
        of the spin.
    relative_spin : float or sympy.Expr
        Rate ψ̇ at which the body turns about its axis relative to axes that precess with it; −wobble.
    angular_momentum : float or sympy.Expr
        Magnitude of H [kg m²/s].
    """

    precession: Any
    wobble: Any
    relative_spin: Any
    angular_momentum: Any

    def __repr__(self) -> str:
        if is_symbolic(self.precession, self.wobble):
            return f"FreePrecession(precession={self.precession}, wobble={self.wobble})"
        return f"FreePrecession(precession {self.precession:.5g} rad/s, wobble {self.wobble:.5g} rad/s)"


def free_precession(transverse: Any, axial: Any, spin: Any, nutation: Any = 0) -> FreePrecession:
    """Wobble and precession of an axisymmetric body on which no moment acts.

    Parameters
    ----------
    transverse, axial : float or sympy.Expr
        Moments of inertia A and C about G [kg m²].
    spin : float or sympy.Expr
        *Total* axial component ω₃ of the angular velocity [rad/s], what a sensor in the body reads.
    nutation : float or sympy.Expr
        Angle ϑ between the axis of symmetry and H [rad], 0 ≤ ϑ < π/2.

    Returns
    -------
    FreePrecession

    Raises
    ------
    EngdynError
        Moments that no body has (C > 2 A), an axis square to H.

    Notes
    -----
    Course section 2.12.  In body axes ω₁ and ω₂ turn at (C − A) ω₃/A; H cos ϑ = C ω₃ and the
    transverse part H sin ϑ = A φ̇ sin ϑ give the precession φ̇ = C ω₃/(A cos ϑ).

    Examples
    --------
    >>> import engdyn as ed
    >>> ed.free_precession(0.0032, 0.0020, spin=50.0, nutation=0.2)
    FreePrecession(precession 31.886 rad/s, wobble -18.75 rad/s)
    """
    _check_moments(transverse, axial)
    if is_symbolic(transverse, axial, spin, nutation):
        A, C, rate, angle = (as_expression(x) for x in (transverse, axial, spin, nutation))
        cosine: Any = sm.cos(angle)
    else:
        A, C = float(transverse), float(axial)
        rate, angle = _number(spin, "spin"), _number(nutation, "nutation")
        cosine = math.cos(angle)
        if cosine < SQUARE:
            raise EngdynError(
                f"the nutation angle is {angle:g} rad: between 0 and π/2 the axis leans from H; at π/2 the body "
                "turns about a transverse axis and spins not at all, beyond it the spin is opposite: count ϑ from "
                "the other end of the axis"
            )
    wobble = (C - A) / A * rate
    return FreePrecession(C * rate / (A * cosine), wobble, -wobble, C * abs(rate) / cosine)


@dataclass(frozen=True)
class SteadyPrecession:
    """Steady precession rates of a symmetric top at a given nutation angle.

    Attributes
    ----------
    rates : tuple of float
        None, one or two rates φ̇ [rad/s], the slow one first; one at the limiting spin counts twice.
    limiting_spin : float
        Least magnitude of the spin at which the top can precess steadily at this angle [rad/s], of
        the kind of spin that was given; zero where every spin will do.
    spin, nutation : float
        As given [rad/s, rad].
    """

    rates: tuple[float, ...]
    limiting_spin: float
    spin: float
    nutation: float

    @property
    def slow(self) -> float:
        """The slow rate, near M = Ω × H: Ω ≈ m g l/(C ω₃) [rad/s]."""
        if not self.rates:
            raise EngdynError(f"there is no steady precession: {self}")
        return self.rates[0]

    @property
    def fast(self) -> float:
        """The fast rate, near that of the free body: Ω ≈ C ω₃/(A cos ϑ) [rad/s]."""
        if len(self.rates) < 2:
            raise EngdynError(f"there is no fast precession: {self}")
        return self.rates[1]

    def __repr__(self) -> str:
        at = f"at spin {self.spin:.5g} rad/s and nutation {self.nutation:.5g} rad"
        if not self.rates and abs(self.spin) < self.limiting_spin:
            return f"SteadyPrecession(none {at}: the limiting spin is {self.limiting_spin:.5g} rad/s)"
        found = " and ".join(f"{rate:.5g}" for rate in self.rates)
        return f"SteadyPrecession({found + ' rad/s' if found else 'none'} {at})"


def steady_precession(
    transverse: float,
    axial: float,
    spin: float,
    nutation: float,
    torque_coefficient: float,
    *,
    relative: bool = False,
) -> SteadyPrecession:
    """Slow and fast precession of a heavy symmetric top, or none below the limiting spin.

    Parameters
    ----------
    transverse, axial : float
        Moments of inertia A and C about the fixed point O [kg m²].
    spin : float
        *Total* axial component ω₃ = ψ̇ + φ̇ cos ϑ of the angular velocity [rad/s]; it is the constant
        of the motion.
    nutation : float
        Angle ϑ of the axis from the upward vertical [rad], 0 < ϑ < π.
    torque_coefficient : float
        m g l, weight times the distance of G from O [N m]; the moment is m g l sin ϑ.
    relative : bool
        Whether `spin` is the relative spin ψ̇, what a motor between axle and rotor would hold.

    Returns
    -------
    SteadyPrecession
        ``.rates`` is empty where no steady precession exists; ``.limiting_spin`` says what is needed.

    Raises
    ------
    EngdynError
        Values that are not finite, moments that no body has, an axis that is vertical.

    Notes
    -----
    Course section 2.14.  A cos ϑ Ω² − C ω₃ Ω + m g l = 0; with the relative spin
    (A − C) cos ϑ Ω² − C ψ̇ Ω + m g l = 0.  With the axis horizontal one root is left, Ω = m g l/(C ω₃)
    exactly (F. Klein and A. Sommerfeld, *Über die Theorie des Kreisels*, 1897–1910).

    Examples
    --------
    >>> import engdyn as ed
    >>> ed.steady_precession(2.9e-4, 9.2e-5, spin=200.0, nutation=0.4, torque_coefficient=0.059)
    SteadyPrecession(3.3715 and 65.515 rad/s at spin 200 rad/s and nutation 0.4 rad)
    >>> ed.steady_precession(2.9e-4, 9.2e-5, spin=60.0, nutation=0.4, torque_coefficient=0.059).rates
    ()
    """
    _check_moments(transverse, axial)
    A, C = float(transverse), float(axial)
    spin, angle = _number(spin, "spin"), _number(nutation, "nutation")
    weight = _number(torque_coefficient, "torque_coefficient")
    if not 0 < angle < math.pi or math.sin(angle) < SQUARE:
        raise EngdynError(
            f"the nutation angle is {angle:g} rad: give one between 0 and π, with the axis vertical the top sleeps "
            "and precession and spin are one"
        )
    cosine = math.cos(angle) if abs(math.cos(angle)) > SQUARE else 0.0
    square = ((A - C) if relative else A) * cosine
    limit = 2 * math.sqrt(max(square * weight, 0.0)) / C
    return SteadyPrecession(_roots(square, C * spin, weight), limit, spin, angle)


def _roots(a: float, b: float, c: float) -> tuple[float, ...]:
    """Real roots of a x² − b x + c = 0, the smaller magnitude first, without loss of digits."""
    if a == 0:
        return (c / b,) if b != 0 else ()
    discriminant = b * b - 4 * a * c
    if discriminant < -1e-14 * b * b:  # at the limit rounding decides its sign
        return ()
    q = (b + math.copysign(math.sqrt(max(discriminant, 0.0)), b)) / 2
    if q == 0:
        return (0.0, 0.0)
    return (c / q, q / a) if abs(c / q) <= abs(q / a) else (q / a, c / q)


def _check_moments(transverse: Any, axial: Any) -> None:
    check_positive(transverse=transverse, axial=axial)
    if not is_symbolic(transverse, axial) and float(axial) > 2 * float(transverse) * (1 + 1e-9):
        raise EngdynError(
            f"no body has the axial moment {float(axial):.4g} and the transverse moment {float(transverse):.4g} kg m²: "
            "the axial one is at most twice the transverse one"
        )


def _number(value: Any, name: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError) as error:
        raise EngdynError(f"{name} is {value!r}: give a number") from error
    if not math.isfinite(number):
        raise EngdynError(f"{name} is {number}: it must be finite")
    return number

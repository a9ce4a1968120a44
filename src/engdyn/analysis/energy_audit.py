"""The books of a simulated motion: where its energy came from and went to, and what does not add up.  Section 8.9."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engdyn.analysis.observation import Observer

__all__ = ["EnergyAudit", "audited"]

NODES, WEIGHTS = np.polynomial.legendre.leggauss(5)


@dataclass(frozen=True, eq=False, repr=False)
class EnergyAudit:
    """Energies and work along a motion, each an array over its times [J].

    Attributes
    ----------
    time : ndarray, shape (N,)
    kinetic, potential : ndarray
    dissipated : ndarray
        By what Rayleigh's function holds, since the start.
    work_of_forces : ndarray
        Of the generalized forces.
    work_of_motions : ndarray
        Of whatever prescribes motions: drives, moving ground, the speed inside a rolling condition.
    """

    time: np.ndarray
    kinetic: np.ndarray
    potential: np.ndarray
    dissipated: np.ndarray
    work_of_forces: np.ndarray
    work_of_motions: np.ndarray

    @property
    def energy(self) -> np.ndarray:
        """Kinetic and potential energy."""
        return self.kinetic + self.potential

    @property
    def imbalance(self) -> np.ndarray:
        """Energy that came from nowhere: zero but for the errors of the integration."""
        gained = self.energy - self.energy[0]
        return gained - self.work_of_forces - self.work_of_motions + self.dissipated

    @property
    def error(self) -> float:
        """Largest imbalance as a share of the energy that moved about."""
        parts = (self.kinetic, self.potential, self.dissipated, self.work_of_forces, self.work_of_motions)
        moved = max(float(np.ptp(part)) for part in parts)
        scale = max(moved, 1e-12 * float(np.max(np.abs(self.energy))))
        return float(np.max(np.abs(self.imbalance))) / scale if scale else 0.0

    def __repr__(self) -> str:
        closed = f"closed to {self.error:.0e}" if self.error > 1e-14 else "closed"
        return f"EnergyAudit({closed} of the energy that moved)"

    def _repr_html_(self) -> str:
        rows = {
            "gain of kinetic energy": self.kinetic[-1] - self.kinetic[0],
            "gain of potential energy": self.potential[-1] - self.potential[0],
            "dissipated": self.dissipated[-1],
            "work of forces": self.work_of_forces[-1],
            "work of prescribed motions": self.work_of_motions[-1],
        }
        body = "".join(
            f"<tr><td>{name}</td><td>{value + 0.0:.4g} J</td></tr>" for name, value in rows.items()
        )
        caption = f"balance of energy up to t = {self.time[-1]:.4g} s"
        return f"<table><caption>{caption}</caption><tbody>{body}</tbody></table>"


def audited(
    observe: Observer, times: np.ndarray, steps: np.ndarray, dense: Callable[[np.ndarray], np.ndarray]
) -> EnergyAudit:
    """Draw up the balance: powers are integrated step by step, by Gauss's rule of order 10.

    Parameters
    ----------
    observe : Observer
    times, steps : ndarray
        When the balance is wanted; ends of the steps.
    dense : callable
        States at any times.
    """
    eom = observe.plan.eom
    powers = eom.energies.powers(eom)
    kinetic, potential, moved = observe.several(
        [powers.kinetic, powers.potential, powers.moved], times, dense(times)
    )
    edges = np.union1d(times, steps[(steps > times[0]) & (steps < times[-1])])
    half = np.diff(edges)[:, None] / 2
    at = (edges[:-1, None] + half * (1 + NODES)).ravel()
    work = []
    for power in observe.several([powers.dissipated, powers.forces, powers.motions], at, dense(at)):
        portions = np.sum(power.reshape(-1, len(NODES)) * WEIGHTS * half, axis=1)
        work.append(np.append(0.0, np.cumsum(portions))[np.searchsorted(edges, times)])
    return EnergyAudit(times, kinetic, potential, work[0], work[1], work[2] + moved - moved[0])

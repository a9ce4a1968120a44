"""Checks that several tests of the analyses share."""

from __future__ import annotations

import numpy as np

import engdyn as ed


def kinds(found):
    return sorted(p.kind for p in found.points)


def assert_all_are_equilibria(case, found):
    """Every point of every branch, by the derivative of the energies."""
    for branch in found:
        for at, q in zip(branch.parameter[::7], branch.q[::7], strict=True):
            force = case.generalized_force({**case.values, found.parameter: at})
            scale = 1e-9 * (1 + max(map(abs, case.values.values()), default=1.0))
            assert np.max(np.abs(force(q))) < scale


def assert_no_branch_twice(found):
    """No point of one branch lies inside another one, but for the points where they meet."""
    width = np.array([*np.ptp(np.vstack([b.q for b in found]), axis=0), np.ptp(found.range)])
    curves = [np.column_stack([b.q, b.parameter]) / np.where(width > 0, width, 1) for b in found]
    meetings = [np.append(p.q, p.parameter) / np.where(width > 0, width, 1) for p in found.points]
    for i, a in enumerate(curves):
        for j, b in enumerate(curves):
            if i == j:
                continue
            for point in a:
                if not any(np.linalg.norm(point - m) < 0.05 for m in meetings):
                    assert np.min(np.linalg.norm(b - point, axis=1)) > 1e-3


def judged(case, at=None, values=None):
    return ed.stability(ed.linearize(case.eom, at or {}, case.values | (values or {})))


def at_equilibria(case, values=None, **options):
    answer = ed.equilibria(case.eom, case.values | (values or {}), case.bounds, **options)
    return [ed.stability(ed.linearize(case.eom, e)) for e in answer]


def is_steady(eom, e, eps=1e-6):
    """The accelerations are those claimed, now and a moment later: q moved by its rates."""
    q, u = np.array(e.q), np.array(e.speeds)
    now = eom.accelerations(q, u, e.values, e.inputs)
    later = eom.accelerations(q + eps * u, u + eps * e.accelerations, e.values, e.inputs)
    scale = 1 + np.max(np.abs(e.accelerations)) + np.max(np.abs(u))
    return np.allclose(now, e.accelerations, atol=1e-9 * scale) and np.allclose(later, now, atol=1e-9 * scale)

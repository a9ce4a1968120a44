"""Jacobians of the complete residual R = M u̇ − f and of the kinematics: the blocks of small motion.

Exact as ring elements, compiled for numbers, arrays and balls.  Course section 5.3.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from engdyn.analysis.slopes import Products, as_products, compile_products, slopes
from engdyn.errors import EngdynError
from engdyn.modeling.equations import EquationsOfMotion

__all__ = ["BLOCKS", "assemble", "block_shapes", "compiled_blocks", "motion_keys", "small_motion", "unpacked"]

Key = tuple[Any, ...]

BLOCKS = ("M", "C", "K", "B0", "B1", "B2", "Gq", "G")


def motion_keys(eom: EquationsOfMotion) -> tuple[list[Key], list[Key], list[Key]]:
    """Keys of coordinates, speeds and accelerations."""
    speeds = [("function", u.expr, 1) if u.is_Derivative else ("function", u, 0) for u in eom.speeds]
    return (
        [("function", q, 0) for q in eom.coordinates],
        speeds,
        [(kind, function, order + 1) for kind, function, order in speeds],
    )


def small_motion(eom: EquationsOfMotion) -> dict[str, list[list[Products]]]:
    """Jacobians of the residual and of the kinematics, exact, as rows of sums of products."""
    cache = eom.__dict__.setdefault("_small_motion", {})
    if cache:
        return cache
    ring = eom.ring
    q_keys, u_keys, a_keys = motion_keys(eom)
    residuals = []
    for line, force in zip(eom.mass, eom.force, strict=True):
        total = -force
        for entry, key in zip(line, a_keys, strict=True):
            if not entry.is_zero():
                total = total + entry * ring.generator(key)
        residuals.append(total)
    inputs = [[("function", w, k) for w in eom.inputs] for k in (0, 1, 2)]
    by = {"K": q_keys, "C": u_keys, "B0": inputs[0], "B1": inputs[1], "B2": inputs[2]}
    for name, keys in by.items():
        cache[name] = [slopes(ring, row, keys) for row in residuals]
    cache["M"] = [[as_products(entry) for entry in line] for line in eom.mass]
    cache["Gq"] = [slopes(ring, rate, q_keys) for rate in eom.rates]
    cache["G"] = [slopes(ring, rate, u_keys) for rate in eom.rates]
    return cache


def compiled_blocks(eom: EquationsOfMotion, target: str) -> Any:
    """A function of (q, u, parameters, inputs, t, u̇) that returns all entries of all blocks, flat."""
    cache = eom.__dict__.setdefault("_compiled_blocks", {})
    if target not in cache:
        blocks = small_motion(eom)
        flat = [entry for name in BLOCKS for row in blocks[name] for entry in row]
        cache[target] = compile_products(flat, [*eom.arguments, *motion_keys(eom)[2]], target)
    return cache[target]


def block_shapes(eom: EquationsOfMotion) -> dict[str, tuple[int, int]]:
    """Shape of every block, in the order in which compiled code returns them."""
    n, m, w = len(eom.coordinates), len(eom.speeds), len(eom.inputs)
    return {
        "M": (m, m),
        "C": (m, m),
        "K": (m, n),
        "B0": (m, w),
        "B1": (m, w),
        "B2": (m, w),
        "Gq": (n, n),
        "G": (n, m),
    }


def unpacked(eom: EquationsOfMotion, flat: np.ndarray) -> dict[str, np.ndarray]:
    """Blocks by name from what compiled code returned, shape (..., number of entries)."""
    blocks, start = {}, 0
    for name, (rows, columns) in block_shapes(eom).items():
        part = flat[..., start : start + rows * columns]
        blocks[name] = part.reshape(*flat.shape[:-1], rows, columns)
        start += rows * columns
    return blocks


def assemble(blocks: Mapping[str, np.ndarray]) -> np.ndarray:
    """State matrices from blocks, which may be stacked: shape (..., n + m, n + m)."""
    try:
        lower = -np.linalg.solve(blocks["M"], np.concatenate([blocks["K"], blocks["C"]], axis=-1))
    except np.linalg.LinAlgError as error:
        raise EngdynError("singular mass matrix: the state matrix does not exist there") from error
    upper = np.concatenate([blocks["Gq"], blocks["G"]], axis=-1)
    return np.concatenate([upper, lower], axis=-2)

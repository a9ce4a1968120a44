"""Linear algebra with residues modulo a prime: exact, and as fast as integers are."""

from __future__ import annotations

from engdyn.errors import EngdynError

__all__ = ["Matrix", "rank", "solve", "trailing_zeros"]

Matrix = list[list[int]]


def solve(matrix: Matrix, right: Matrix, prime: int) -> Matrix:
    """Gauss–Jordan elimination modulo the prime."""
    n = len(matrix)
    rows = [[*a, *b] for a, b in zip(matrix, right, strict=True)]
    for column in range(n):
        pivot = next((i for i in range(column, n) if rows[i][column]), None)
        if pivot is None:
            raise EngdynError("singular mass matrix: stability cannot be judged there")
        rows[column], rows[pivot] = rows[pivot], rows[column]
        inverse = pow(rows[column][column], -1, prime)
        rows[column] = [x * inverse % prime for x in rows[column]]
        for i in range(n):
            factor = rows[i][column]
            if i != column and factor:
                rows[i] = [(x - factor * y) % prime for x, y in zip(rows[i], rows[column], strict=True)]
    return [row[n:] for row in rows]


def trailing_zeros(matrix: Matrix, prime: int) -> int:
    """How often λ divides the characteristic polynomial: n − rank(Aⁿ)."""
    n, power, before = len(matrix), matrix, rank(matrix, prime)
    while True:
        columns = list(zip(*power, strict=True))
        power = [[sum(map(int.__mul__, row, column)) % prime for column in columns] for row in power]
        if (now := rank(power, prime)) == before:
            return n - before
        before = now


def rank(matrix: Matrix, prime: int) -> int:
    """Number of independent rows."""
    rows, found = [list(row) for row in matrix], 0
    for column in range(len(matrix[0]) if matrix else 0):
        pivot = next((i for i in range(found, len(rows)) if rows[i][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        inverse = pow(rows[found][column], -1, prime)
        for i in range(found + 1, len(rows)):
            factor = rows[i][column] * inverse % prime
            if factor:
                rows[i] = [(x - factor * y) % prime for x, y in zip(rows[i], rows[found], strict=True)]
        found += 1
    return found

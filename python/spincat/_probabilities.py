"""Probabilities of all categories from the confidence in one."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

_STEPS = 60  # of halving; no double is told apart after them


def with_confidence(
    scores: npt.NDArray[np.float64], winners: npt.NDArray[np.int64], confidences: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    """N x n probabilities: in each row the softmax of t times the scores, t such that the winner gets its confidence.

    So the winner's is the highest, and the others keep their order. No confidence is taken for less than 1 / n. Where
    others have the winner's score, what t cannot do the last step does: the winner gets its confidence, and the others
    share the rest.
    """
    rows = np.arange(len(scores))
    if len(rows) == 0:
        return scores
    wanted = np.maximum(confidences, np.nextafter(1 / scores.shape[1], 1))
    gaps = np.maximum(scores[rows, winners][:, None] - scores, 0)
    low, high = np.zeros(len(rows)), np.full(len(rows), 1e6)
    for _ in range(_STEPS):
        middle = (low + high) / 2
        reached = 1 / np.exp(-middle[:, None] * gaps).sum(axis=1) >= wanted
        high, low = np.where(reached, middle, high), np.where(reached, low, middle)
    shares = np.exp(-high[:, None] * gaps)
    shares[rows, winners] = 0
    rest = shares.sum(axis=1, keepdims=True)
    result = np.zeros_like(scores)
    np.divide(shares, rest, out=result, where=rest > 0)
    result *= (1 - wanted)[:, None]
    result[rows, winners] = wanted
    return result

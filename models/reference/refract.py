"""Transmitted rays (book, 8.2.5)."""

import numpy as np

from models.reference.shade import Hits
from models.reference.vectors import Floats, dot, normalise


def transmitted(at: Hits, index: Floats) -> Floats:
    """Unit directions (3, n) of the transmitted rays; `index` (n,) is the refractive index of each object.

    eta is n_from / n_to: 1 / n on entering, n on leaving. Where Snell's law has no solution, total internal
    reflection, the ray leaves along the reflected one.
    """
    eta = np.where(at.leaving, index, 1 / index)
    cosine = -dot(at.normal, at.incoming)
    root = 1 - eta * eta * (1 - cosine * cosine)
    bent = (eta * cosine - np.sqrt(np.maximum(root, 0.0))) * at.normal + eta * at.incoming
    return normalise(np.where(root >= 0, bent, at.reflected))

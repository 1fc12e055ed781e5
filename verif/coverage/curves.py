"""Plots how coverage grows with the clocks, closed and at random."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from verif.coverage.close import Closed, Curve

mpl.use("Agg")
from matplotlib import pyplot as plt

_POINTS = 400


def share(found: Sequence[Closed], clocks: NDArray[np.float64], undirected: bool) -> NDArray[np.float64]:
    """Percent of all bins hit where every unit has had so many clocks."""
    bins = sum(one.bins for one in found)
    hit = sum(_at(one.undirected if undirected else one.directed, clocks) for one in found)
    return np.asarray(100 * hit / max(1, bins))


def _at(curve: Curve, clocks: NDArray[np.float64]) -> NDArray[np.float64]:
    if not curve:
        return np.zeros_like(clocks)
    at, bins = np.array(curve, dtype=np.float64).T
    index = np.searchsorted(at, clocks, side="right") - 1
    return np.asarray(np.where(index < 0, 0.0, np.maximum.accumulate(bins)[index]))


def plot(found: Sequence[Closed], folder: Path) -> Path:
    """Both curves over all units, clocks a unit on a logarithmic axis; the picture's path."""
    most = max(max(one.clocks, one.undirected_clocks) for one in found)
    clocks = np.geomspace(10, max(most, 100), _POINTS)
    figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
    axes.semilogx(clocks, share(found, clocks, undirected=False), label="closure", color="#0b6e4f", lw=2)
    axes.semilogx(
        clocks, share(found, clocks, undirected=True), label="undirected random", color="#b5651d", lw=2
    )
    axes.set(xlabel="clocks of each unit", ylabel="bins hit, percent", ylim=(0, 101))
    axes.set_title(f"{len(found)} designs, {sum(one.bins for one in found)} bins")
    axes.grid(alpha=0.3)
    axes.legend(loc="lower right")
    path = folder / "closure.svg"
    figure.savefig(path)
    figure.savefig(path.with_suffix(".png"), dpi=120)
    plt.close(figure)
    return path

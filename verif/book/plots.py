"""Plots of the experiments."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from verif.book.experiments import INFINITY_NUMBER, Depth, Precision, Vanishing

_STYLES = ("o-", "s--", "^:")


def _save(figure: Figure, path: Path) -> None:
    figure.tight_layout()
    # No date and no version inside: the same figures give the same file.
    figure.savefig(path, dpi=100, metadata={"Software": None})


def _axes(title: str, x: str, y: str) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(6.4, 4.0))
    axes = figure.subplots()
    axes.set(title=title, xlabel=x, ylabel=y)
    axes.grid(alpha=0.3)
    return figure, axes


def precision(rows: Sequence[Precision], path: Path) -> None:
    """PSNR and other hits over the number of fraction bits."""
    figure = Figure(figsize=(9.0, 4.0))
    quality, hits = figure.subplots(1, 2)
    for style, scene in zip(_STYLES, dict.fromkeys(row.scene for row in rows), strict=False):
        own = [row for row in rows if row.scene == scene]
        bits = [row.bits for row in own]
        quality.plot(bits, [row.psnr_db for row in own], style, label=scene)
        hits.semilogy(bits, [max(row.hit_mismatch_percent, 1e-4) for row in own], style, label=scene)
    quality.axhline(40, color="grey", linewidth=0.8)
    hits.axhline(0.05, color="grey", linewidth=0.8)
    quality.set(title="picture against the reference", xlabel="fraction bits everywhere", ylabel="PSNR [dB]")
    hits.set(title="other objects hit", xlabel="fraction bits everywhere", ylabel="share of pixels [%]")
    for axes in (quality, hits):
        axes.grid(alpha=0.3)
        axes.legend()
    _save(figure, path)


def vanishing(rows: Sequence[Vanishing], path: Path) -> None:
    """Pixels over distance."""
    figure, axes = _axes(
        "a sphere that goes away, 512 x 512", "distance of its center", "pixels that show it"
    )
    for style, radius in zip(_STYLES, dict.fromkeys(row.radius for row in rows), strict=False):
        own = [row for row in rows if row.radius == radius]
        axes.loglog(
            [row.distance for row in own], [max(row.pixels, 0.5) for row in own], style, label=f"r = {radius}"
        )
    axes.axvline(INFINITY_NUMBER, color="grey", linewidth=0.8, label="infinity of [9.10]")
    axes.legend()
    _save(figure, path)


def depths(rows: Sequence[Depth], path: Path) -> None:
    """Clocks a pixel over depth."""
    figure, axes = _axes("cost of depth, 256 x 256", "depth of the deepest ray", "clocks a pixel")
    for style, scene in zip(_STYLES, dict.fromkeys(row.scene for row in rows), strict=False):
        own = [row for row in rows if row.scene == scene]
        axes.plot(
            [row.depth for row in own], [row.summary.cycles_per_pixel for row in own], style, label=scene
        )
    axes.set_xticks(sorted({row.depth for row in rows}))
    axes.set_ylim(bottom=0)
    axes.legend()
    _save(figure, path)

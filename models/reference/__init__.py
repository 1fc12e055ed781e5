"""The float64 reference renderer: the whole rule of the picture (book, 8.2), without the core's rounding.

It shares no arithmetic with the bit-exact model, so that each can be checked against the other.
"""

from models.reference.render import Rendering, render, sample

__all__ = ["Rendering", "render", "sample"]

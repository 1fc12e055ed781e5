"""What `core_watch` looks at in every clock: promises of the core, and places where it may have to wait."""

from models.limits import MAX_DEPTH

BREACHES = (
    "the ray store holds more rays than it has places",
    "a place of the ray store was used or given back that was not reserved",
    "a queue was given an item that it had no room for",
    "a place was not given back at the end of a frame",
)
"""Promises that `core_watch` saw broken, from its lowest bit on."""

WAITS = (
    *(f"places for rays of depth {depth}" for depth in range(2, MAX_DEPTH + 1)),
    "room for primary rays",
    "room for steps",
    "room for hits",
    "room for terms",
    "free pixels",
)
"""What `core_tb` saw waited for, from the lowest bit of its `waits` on."""

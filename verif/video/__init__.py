"""Benches of the screen: a monitor that knows only the sync pulses, a recorder, and `make video`."""

"""Tests of the regressions."""

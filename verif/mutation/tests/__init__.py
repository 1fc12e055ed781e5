"""Tests of the qualification by mutation."""

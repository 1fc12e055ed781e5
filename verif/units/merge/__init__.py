"""Bench of the fair merge of streams."""

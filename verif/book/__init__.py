"""`make book`: the experiments of the project book, repeated with this core."""

"""What is run over the whole project and reported."""

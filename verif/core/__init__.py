"""Benches of the whole core: end-to-end pixels, stages of one pixel, faults, stalls, resets."""

"""`make render`: one scene through the RTL, compared with the bit-exact model and with the reference."""

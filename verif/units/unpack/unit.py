"""The unpacker: the loader's field width, and the widest."""

from verif.env.unit import Unit

UNIT = Unit(name="unpack", parameters={"FIELD_W": 19}, sets={"widest": {"FIELD_W": 32}})

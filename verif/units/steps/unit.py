"""The steps of a hit: the core's size, and many lights with the least room."""

from verif.env.unit import Break, Unit

_FILE = "shade/steps.v"

UNIT = Unit(
    name="steps",
    parameters={"ITEM_W": 64, "LIGHT_W": 2, "ROOM": 256},
    sets={"small": {"ITEM_W": 8, "LIGHT_W": 4, "ROOM": 2}},
    breaks=(
        # How many steps: of a miss, without lights, of a hit with two children.
        Break(_FILE, "in_hit ? for_hit : {LIGHT_W{1'b0}};", "for_hit;"),
        Break(_FILE, "lights == {LIGHT_W{1'b0}} ? {LIGHT_W{1'b0}} : lights - ONE", "lights - ONE"),
        Break(_FILE, "for_lights > for_children ? for_lights : for_children", "for_lights"),
        # Room: of shadow rays not asked for, of direct terms not asked for, given back one at a time.
        Break(_FILE, "direct_room_reg != {ROOM_W{1'b0}} &&", ""),
        Break(_FILE, "&& shadow_room_reg != {ROOM_W{1'b0}};", ";", "small"),
        Break(
            _FILE,
            "shadow_room_reg + {{ROOM_W - 2{1'b0}}, shadow_back}",
            "shadow_room_reg + {{ROOM_W - 1{1'b0}}, shadow_back != 2'd0}",
        ),
        Break(_FILE, "shadow_room_reg <= ALL;", "shadow_room_reg <= ALL - 1'b1;"),
        # The next hit: only behind an idle clock, before the last step has gone.
        Break(_FILE, "assign in_ready = !valid_reg || step && last;", "assign in_ready = !valid_reg;"),
        Break(
            _FILE, "assign in_ready = !valid_reg || step && last;", "assign in_ready = !valid_reg || last;"
        ),
        Break(_FILE, "if (rst) valid_reg <= 1'b0;", "if (1'b0) valid_reg <= 1'b0;"),
    ),
)

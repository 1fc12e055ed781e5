"""The camera: one build, within a harness that has a normaliser."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="camera",
    parameters={"SIZE_W": 12, "WIDE_W": 40},
    top="camera_harness",
    breaks=(
        Break(
            "scene/camera.v",
            "wire cross_zero = product_reg == {3 * WIDE_W{1'b0}};",
            "wire cross_zero = product_reg[3*WIDE_W-1:1] == 0;",
        ),
        Break(
            "scene/camera.v", "2'd1: {first, second} = {2'd0, 2'd2};", "2'd1: {first, second} = {2'd2, 2'd0};"
        ),
        Break(
            "scene/camera.v",
            "wire no_size = width == {SIZE_W{1'b0}} || height == {SIZE_W{1'b0}};",
            "wire no_size = width == {SIZE_W{1'b0}};",
        ),
        Break("scene/camera.v", "if (!dividing) divided_reg", "if (rst) divided_reg"),
        Break(
            "scene/camera.v",
            "wire view_zero = view_reg == {3 * VIEW_W{1'b0}};",
            "wire view_zero = view_reg[3*VIEW_W-3:0] == 0;",
        ),
    ),
)

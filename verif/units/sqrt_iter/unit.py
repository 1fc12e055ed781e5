"""The iterative square root: ports, parameter sets and model."""

from models.arith import sqrt_iter
from verif.env.fields import Operands
from verif.env.unit import Break, Parameters, StreamUnit
from verif.units.sqrt.unit import near_squares, radicand, root_and_remainder


def _model(p: Parameters, operands: Operands) -> Operands:
    return sqrt_iter(operands["radicand"], p["D_W"])._asdict()


UNIT = StreamUnit(
    name="sqrt_iter",
    parameters={"D_W": 40},
    sets={"narrow": {"D_W": 10}},
    exhaustive="narrow",
    inputs=radicand,
    outputs=root_and_remainder,
    model=_model,
    directed=near_squares,
    breaks=(
        # A result that is given up after 512 clocks of waiting.
        Break(
            "arith/iterate.v",
            "else out_valid_reg <= finish || (out_valid_reg && !out_ready);\n    end",
            "else out_valid_reg <= finish || (out_valid_reg && !out_ready && !(&age_reg));\n    end\n"
            "    reg [8:0] age_reg;\n"
            "    always @(posedge clk) age_reg <= out_valid_reg ? age_reg + 1'b1 : 9'd0;",
        ),
        Break("arith/sqrt_iter.v", "d_reg <= d << 2;", "d_reg <= d << 1;"),
        Break("arith/iterate.v", "(!out_valid_reg || out_ready)", "1'b1"),
        Break("arith/iterate.v", "if (rst) out_valid_reg <=", "if (1'b0) out_valid_reg <="),
        Break("arith/iterate.v", "if (rst) count_reg <=", "if (1'b0) count_reg <="),
    ),
)

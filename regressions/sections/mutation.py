"""Qualification by mutants: the results that lie in `build/mutation`."""

import json
from dataclasses import replace
from pathlib import Path

from regressions.record import Mutant, Mutation, Record
from regressions.sections.notes import noted, older
from verif.mutation import record as mutants
from verif.mutation.explained import ExplanationError, Explanations


def added(record: Record, _root: Path) -> Record:
    """The record with the mutants of every unit that has some."""
    paths = sorted(mutants.FOLDER.glob("*.json"))
    found = [result for path in paths if (result := mutants.read(path.stem)) is not None]
    if not found:
        return noted(record, ["no unit's mutants were judged"])
    try:
        explanations = Explanations.read()
    except ExplanationError as error:
        return noted(record, [str(error)])
    notes = [*explanations.stale(found), *older(record, paths, "mutation")]
    units = tuple(_unit(result, explanations) for result in found)
    return noted(replace(record, mutation=units), notes)


def _unit(result: mutants.Result, explanations: Explanations) -> Mutation:
    return Mutation(
        result.unit,
        len(result.mutants),
        result.killed,
        result.count(mutants.Verdict.EQUIVALENT),
        result.count(mutants.Verdict.UNDECIDED),
        tuple(_survivor(result.unit, one, explanations) for one in result.survivors),
    )


def _survivor(unit: str, one: mutants.Judged, explanations: Explanations) -> Mutant:
    file, _, line = one.mutant.source.rpartition(":")
    undecided = one.verdict is mutants.Verdict.UNDECIDED
    return Mutant(
        one.mutant.number,
        file,
        int(line) if line.isdecimal() else 0,
        f"{one.mutant.mode} at {one.mutant.place}: {one.mutant.text}",
        "undecided" if undecided else "survived",
        json.dumps(list(map(dict, one.witness))) if one.witness else "",
        explanations.of(unit, one),
    )

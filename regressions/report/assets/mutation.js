/* Qualification by mutation: each unit's score, and each mutant that nobody noticed. */

function mutationView(open) {
  const units = rows("mutation");
  if (!units.length) return [h("h1", {}, "Mutation"), absent("mutation")];
  return [
    h("h1", {}, "Mutation"),
    table({
      name: "mutation",
      caption: "Units",
      rows: units,
      columns: [
        { title: "Unit", value: (row) => row.unit },
        {
          title: "Score",
          value: (row) => row.score,
          left: true,
          cell: (row) => meter(row.killed, row.mutants - row.equivalent),
        },
        { title: "Mutants", value: (row) => row.mutants },
        { title: "Killed", value: (row) => row.killed, wide: true },
        { title: "Equivalent", value: (row) => row.equivalent, wide: true },
        { title: "Undecided", value: (row) => row.undecided },
        {
          title: "Undecided share",
          value: (row) => row.undecided / row.mutants,
          cell: (row) => `${((100 * row.undecided) / row.mutants).toFixed(1)} %`,
          wide: true,
        },
      ],
    }),
    table({
      name: "survivors",
      caption: "Survivors and undecided",
      rows: rows("survivors"),
      open,
      key: (row) => `${row.unit}.${row.number}`,
      facet: { value: (row) => row.verdict, order: ["survived", "undecided"] },
      columns: [
        { title: "Mutant", value: (row) => `${row.unit}.${row.number}` },
        { title: "Verdict", value: (row) => row.verdict, cell: (row) => badge(row.verdict) },
        {
          title: "Change",
          value: (row) => row.change,
          cell: (row) => h("code", { class: "short" }, row.change),
        },
        { title: "Source", value: (row) => row.place.join(":"), cell: (row) => place(row.place) },
        {
          title: "Shown by",
          value: (row) => row.witness,
          cell: (row) => h("span", { class: "short" }, row.witness),
          wide: true,
        },
        { title: "Accepted because", value: (row) => row.reason, wide: true },
      ],
      detail: mutantDetail,
    }),
  ];
}

function mutantDetail(mutant) {
  return facts([
    [
      "mutant",
      h(
        "a",
        { href: link("mutation", `${mutant.unit}.${mutant.number}`) },
        `${mutant.unit}.${mutant.number}`,
      ),
    ],
    ["verdict", badge(mutant.verdict)],
    ["change", h("code", {}, mutant.change)],
    ["source", place(mutant.place)],
    ["shown by", mutant.witness ? witness(mutant.witness) : "no operand is known"],
    ["accepted because", mutant.reason],
  ]);
}

/** Inputs clock by clock, where that is what the text says; a port that stays 0 is left out. */
function witness(text) {
  const clocks = parsed(text);
  if (!clocks) return h("pre", {}, text);
  const ports = Object.keys(clocks[0]).filter((port) => clocks.some((clock) => clock[port]));
  const lines = clocks.map((clock, index) =>
    h(
      "tr",
      {},
      [index, ...ports.map((port) => clock[port])].map((value) =>
        h("td", { class: "number" }, String(value)),
      ),
    ),
  );
  return h("table", { class: "inner witness" }, headRow("clock", ...ports), h("tbody", {}, lines));
}

function parsed(text) {
  try {
    const found = JSON.parse(text);
    return Array.isArray(found) && typeof found[0] === "object" && found[0] ? found : null;
  } catch {
    return null;
  }
}

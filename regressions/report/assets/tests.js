/* Every run: how it ended, the command that repeats it, and what it adds to what the others hit. */

function testsView(open) {
  const results = rows("results");
  return [
    h("h1", {}, "Tests"),
    h(
      "p",
      { class: "quiet" },
      "Only it: what no other run hits. More: what no run before it hits, in the order of the list.",
    ),
    table({
      name: "tests",
      caption: "Runs",
      rows: results,
      open,
      key: (row) => row.id,
      facet: { value: (row) => row.status, order: ["failed", "timed_out", "killed", "not_run", "passed"] },
      search: (row) => `${row.message} ${row.checks.map(([name]) => name).join(" ")}`,
      columns: [
        { title: "Run", value: (row) => row.id },
        { title: "Status", value: (row) => row.status, cell: (row) => badge(row.status) },
        { title: "Seed", value: (row) => row.seed, cell: (row) => String(row.seed), wide: true },
        { title: "Seconds", value: (row) => row.seconds, cell: (row) => row.seconds.toFixed(1) },
        {
          title: "Simulated ms",
          value: (row) => row.simulated / 1e6,
          cell: (row) => (row.simulated / 1e6).toFixed(3),
          wide: true,
        },
        ...adds("bins", "Bins"),
      ],
      detail: resultDetail,
    }),
    rows("runs").length ? codeRuns() : null,
  ];
}

function codeRuns() {
  return table({
    name: "runs",
    caption: "Runs that count code coverage",
    rows: rows("runs"),
    columns: [{ title: "Run", value: (row) => row.name }, ...adds("lines", "Lines")],
  });
}

/** Columns of what a run hits of something, and of how much of it nobody else does. */
function adds(key, title) {
  return [
    { title, value: (row) => row[key] },
    { title: `${title} only it`, value: (row) => row[`${key}Only`] },
    { title: `${title} more`, value: (row) => row[`${key}More`], wide: true },
  ];
}

function resultDetail(result) {
  const bad = result.checks.filter(([, message]) => message);
  return h(
    "div",
    {},
    h("p", {}, "Shown again by"),
    command(result.command),
    facts([
      ["test", result.test],
      ["seed", h("code", {}, String(result.seed))],
      ["entry", result.entry],
      ["kind", result.kind],
      ["unit", result.unit],
      ["simulator", result.simulator],
      ["parameter set", result.set],
      ["build", result.build],
      ["folder", h("code", {}, result.folder)],
      ["waves", result.waves && h("code", {}, result.waves)],
    ]),
    result.message ? h("pre", { tabindex: "0" }, result.message) : null,
    result.checks.length
      ? h("h4", {}, `${number(result.checks.length)} tests inside, ${number(bad.length)} failed`)
      : null,
    h(
      "ul",
      { class: "plain" },
      result.checks.map(([name, message, skipped]) =>
        h(
          "li",
          {},
          badge(message ? "failed" : skipped ? "skipped" : "passed"),
          " ",
          h("code", {}, name),
          skipped ? ` ${skipped}` : "",
        ),
      ),
    ),
  );
}

/* The verification plan: each promise and whether what ran holds it up, each rule and what fulfils it. */

const STANDINGS = ["failed", "hole", "not run", "passed"];

function planView(open) {
  const promises = rows("plan");
  if (!promises.length) return [h("h1", {}, "Plan"), absent("the verification plan")];
  return [
    h("h1", {}, "Plan"),
    table({
      name: "plan",
      caption: "Promises",
      rows: promises,
      open,
      key: (row) => row.name,
      facet: { value: (row) => row.standing, order: STANDINGS },
      search: (row) => [...row.tests, ...row.points].map(([name]) => name).join(" "),
      columns: [
        { title: "Promise", value: (row) => row.name, cell: (row) => h("code", {}, row.name) },
        { title: "Standing", value: (row) => row.standing, cell: (row) => badge(row.standing) },
        { title: "What", value: (row) => row.what, wide: true },
        { title: "Tests", value: (row) => row.tests.length },
        { title: "Bins hit", value: (row) => sum(row.points, 1), wide: true },
        { title: "Bins needed", value: (row) => sum(row.points, 2), wide: true },
      ],
      detail: promise,
    }),
    table({
      name: "rules",
      caption: "Rules and faults of the specification",
      rows: rows("rules"),
      key: (row) => row.name,
      facet: { value: (row) => row.standing, order: STANDINGS },
      search: (row) => row.promises.join(" "),
      columns: [
        { title: "Entry", value: (row) => row.name, cell: (row) => h("code", {}, row.name) },
        { title: "Standing", value: (row) => row.standing, cell: (row) => badge(row.standing) },
        { title: "Kind", value: (row) => row.kind },
        { title: "Section", value: (row) => row.section, wide: true },
        { title: "Text", value: (row) => row.text, wide: true },
        { title: "Promises", value: (row) => row.promises.length },
      ],
      detail: rule,
    }),
  ];
}

function sum(found, place) {
  return found.reduce((total, row) => total + row[place], 0);
}

function promise({ what, tests, points, place: where }) {
  const ends = tests.map(([name, status]) => h("li", {}, badge(status), " ", h("code", {}, name)));
  const shares = points.map(([name, hit, needed]) =>
    h("li", {}, meter(hit, needed), " ", h("a", { href: link("functional", name) }, name)),
  );
  return h(
    "div",
    {},
    h("p", {}, what),
    where.length ? h("p", {}, "Declared in ", place(where)) : null,
    h("h4", {}, "Tests"),
    h("ul", { class: "plain" }, ends),
    points.length ? h("h4", {}, "Cover points") : null,
    h("ul", { class: "plain" }, shares),
  );
}

function rule({ text, promises }) {
  const names = promises.map((name) => h("li", {}, h("a", { href: link("plan", name) }, name)));
  return h("div", {}, h("p", {}, text), h("h4", {}, "Fulfilled by"), h("ul", { class: "plain" }, names));
}

function absent(what) {
  return h("p", { class: "quiet" }, `This regression has not measured ${what}.`);
}

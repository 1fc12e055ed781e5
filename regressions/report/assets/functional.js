/* Functional coverage: holes with what would reach them, units with their points, every bin. */

function functionalView(open) {
  const units = rows("units");
  if (!units.length) return [h("h1", {}, "Functional coverage"), absent("functional coverage")];
  const holes = bins().filter((bin) => bin.state === "hole");
  const { unit, bin } = named(open);
  return [
    h("h1", {}, "Functional coverage"),
    holes.length
      ? holesTable(holes)
      : h("p", {}, badge("passed"), " No holes: every bin is hit or excluded with a reason."),
    unitsTable(units, unit),
    table({
      name: "bins",
      caption: "Bins",
      rows: bins(),
      key: (row) => row.full,
      open: bin,
      facet: { value: (row) => row.state, order: ["hole", "excluded", "hit"] },
      columns: [
        { title: "Bin", value: (row) => row.full, cell: (row) => h("code", {}, row.full) },
        { title: "State", value: (row) => row.state, cell: (row) => badge(row.state) },
        { title: "Hits", value: (row) => row.hits },
        { title: "Runs", value: (row) => row.by.length },
        { title: "Recipe", value: (row) => row.recipe, wide: true },
        {
          title: "Declared",
          value: (row) => row.place.join(":"),
          cell: (row) => place(row.place),
          wide: true,
        },
      ],
      detail: binDetail,
    }),
  ];
}

/** What a fragment names: a unit, a point of it, or a bin. */
function named(name) {
  if (!name) return {};
  const bin = bins().find((found) => found.full === name || found.full.startsWith(`${name}.`));
  if (bin && name !== bin.unit.name)
    return { unit: name === bin.full ? null : bin.unit.name, bin: name === bin.full ? name : null };
  return { unit: name.split(".")[0] };
}

function holesTable(holes) {
  return table({
    name: "holes",
    caption: "Holes",
    rows: holes,
    columns: [
      {
        title: "Bin",
        value: (row) => row.full,
        cell: (row) => h("a", { href: link("functional", row.full) }, row.full),
      },
      { title: "Recipe", value: (row) => row.recipe },
      { title: "Declared", value: (row) => row.place.join(":"), cell: (row) => place(row.place) },
      { title: "Point", value: (row) => row.point.doc, wide: true },
    ],
  });
}

function unitsTable(units, open) {
  return table({
    name: "units",
    caption: "Units",
    rows: units,
    open,
    key: (row) => row.name,
    columns: [
      { title: "Unit", value: (row) => row.name },
      {
        title: "Hit",
        value: (row) => (row.needed ? row.good / row.needed : 1),
        left: true,
        cell: (row) => meter(row.good, row.needed),
      },
      { title: "Holes", value: (row) => row.needed - row.good },
      { title: "Points", value: (row) => row.points, wide: true },
      { title: "Bins", value: (row) => row.needed + row.excluded },
      { title: "Excluded", value: (row) => row.excluded, wide: true },
      { title: "Module", value: (row) => row.place.join(":"), cell: (row) => place(row.place), wide: true },
    ],
    detail: unitDetail,
  });
}

function unitDetail(unit) {
  const points = rows("points").filter((point) => point.unit === unit.index);
  return h(
    "div",
    {},
    points.map((point) => {
      const own = bins().filter((bin) => bin.point.index === point.index);
      const needed = own.filter((bin) => !bin.excluded);
      return h(
        "details",
        { open: needed.some((bin) => !bin.hits) },
        h(
          "summary",
          {},
          h("code", {}, point.name),
          " ",
          meter(needed.filter((bin) => bin.hits).length, needed.length, own.length - needed.length),
        ),
        h("p", {}, point.doc, " ", place(point.place)),
        h(
          "table",
          { class: "inner" },
          headRow("bin", "state", "hits", "recipe, or why it is excluded"),
          h(
            "tbody",
            {},
            own.map((bin) =>
              h(
                "tr",
                {},
                h("td", {}, h("a", { href: link("functional", bin.full) }, bin.name)),
                h("td", {}, badge(bin.state)),
                h("td", { class: "number" }, number(bin.hits)),
                h("td", {}, bin.excluded || bin.recipe),
              ),
            ),
          ),
        ),
      );
    }),
  );
}

function binDetail(bin) {
  return h(
    "div",
    {},
    facts([
      ["point", bin.point.doc],
      ["recipe", bin.recipe],
      ["excluded", bin.excluded],
      ["declared", place(bin.place)],
      ["closes it", bin.state === "hole" ? command(`make close UNIT=${bin.unit.name}`) : ""],
    ]),
    bin.by.length
      ? table({
          name: `by-${bin.index}`,
          caption: "Hit by",
          rows: bin.by.map(([result, hits], index) => ({ index, result, hits })),
          columns: [
            {
              title: "Run",
              value: (row) => rows("results")[row.result].id,
              cell: (row) => testLink(row.result),
            },
            { title: "Hits", value: (row) => row.hits },
          ],
        })
      : null,
  );
}

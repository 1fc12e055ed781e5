/* Code coverage by file and kind, and the list of all sources. */

const KINDS = ["line", "branch", "expression", "toggle"];

function codeView() {
  const files = rows("files");
  if (!files.length) return [h("h1", {}, "Code coverage"), absent("code coverage"), sourcesList()];
  return [
    h("h1", {}, "Code coverage"),
    table({
      name: "files",
      caption: "Files",
      rows: files,
      columns: [
        {
          title: "File",
          value: (row) => row.path,
          cell: (row) => h("a", { href: link("source", row.path) }, row.path),
        },
        ...KINDS.map((kind) => ({
          title: kind,
          left: true,
          value: (row) => (row[`${kind}Needed`] ? row[kind] / row[`${kind}Needed`] : null),
          cell: (row) =>
            row[`${kind}Needed`] + row[`${kind}Excluded`]
              ? meter(row[kind], row[`${kind}Needed`], row[`${kind}Excluded`])
              : "–",
        })),
        {
          title: "Missing",
          value: (row) => KINDS.reduce((total, kind) => total + row[`${kind}Needed`] - row[kind], 0),
        },
      ],
    }),
    sourcesList(),
  ];
}

function sourcesList(open = false) {
  const paths = Object.keys(section("texts"));
  return h(
    "details",
    { open },
    h("summary", {}, `All ${number(paths.length)} sources`),
    h(
      "ul",
      { class: "plain" },
      paths.map((path) => h("li", {}, h("a", { href: link("source", path) }, path))),
    ),
  );
}

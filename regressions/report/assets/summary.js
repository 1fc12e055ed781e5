/* What the regression was, how it ended, its totals, its failures and what shows them again. */

const RUNS_SHOWN = 5;

function summaryView() {
  const summary = section("summary");
  const revision = summary.revision
    ? summary.revision.slice(0, 12) + (summary.dirty ? " and changes that are not committed" : "")
    : "unknown";
  const counts = Object.entries(summary.counts)
    .filter(([, count]) => count)
    .map(([status, count]) => [badge(status), ` ${number(count)} `]);
  return [
    h("h1", {}, `${summary.list} `, badge(summary.verdict)),
    facts([
      ["revision", h("code", {}, revision)],
      ["root seed", h("code", {}, String(summary.seed))],
      ["started", summary.started],
      ["took", `${duration(summary.seconds)}, ${number(summary.jobs)} runs at a time`],
      ["runs", h("span", {}, counts)],
      ["id", h("code", {}, summary.id)],
      [
        "tools",
        Object.entries(summary.tools)
          .map(([name, version]) => `${name} ${version}`)
          .join(", "),
      ],
    ]),
    summary.notes.length
      ? h(
          "ul",
          { class: "notes" },
          summary.notes.map((note) => h("li", {}, note)),
        )
      : null,
    h("div", { class: "cards" }, rows("cards").map(card)),
    h("h2", {}, "Failures"),
    rows("buckets").length
      ? rows("buckets").map(bucket)
      : h("p", { class: "quiet" }, "None: nothing failed."),
  ];
}

function card({ title, view, good, needed, excluded }) {
  const there = needed + excluded > 0;
  const out = excluded ? `, ${number(excluded)} ${view === "mutation" ? "equivalent" : "excluded"}` : "";
  const missing = there ? `${number(good)} of ${number(needed)}${out}` : "not measured";
  return h(
    "a",
    {
      class: `card ${!there ? "absent" : good === needed ? "all" : view === "tests" ? "bad" : "some"}`,
      href: link(view),
    },
    h("span", { class: "title" }, title),
    h("span", { class: "big" }, there ? percent(good, needed) : "–"),
    bar(good, needed),
    h("span", { class: "quiet" }, missing),
  );
}

function bucket({ message, example, results, command: words, waves }) {
  const first = results.slice(0, RUNS_SHOWN).map((index) => h("li", {}, testLink(index)));
  const rest =
    results.length > RUNS_SHOWN
      ? h("li", { class: "quiet" }, `and ${number(results.length - RUNS_SHOWN)} more`)
      : null;
  return h(
    "article",
    { class: "bucket" },
    h(
      "h3",
      {},
      h("span", { class: "times" }, `${number(results.length)} ×`),
      " ",
      badge(rows("results")[results[0]].status),
      " ",
      message || "no message",
    ),
    h("p", {}, "Shown again by"),
    command(words),
    waves ? h("p", {}, "Waves: ", h("code", {}, waves)) : null,
    h("details", {}, h("summary", {}, "The first one in full"), h("pre", { tabindex: "0" }, example)),
    h("ul", { class: "runs" }, first, rest),
  );
}

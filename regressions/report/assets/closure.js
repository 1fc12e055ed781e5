/* How coverage grew with the clocks: closure, which plays the recipes of holes, beside undirected random. */

function closureView(open) {
  const curves = rows("curves");
  if (!curves.length) return [h("h1", {}, "Closure"), absent("closure")];
  const units = [...new Set(curves.map((curve) => curve.unit))];
  const chosen = units.includes(open) ? open : "";
  const of = (strategy, unit) => curves.filter((curve) => curve.strategy === strategy && curve.unit === unit);
  const both = units.filter((unit) => of("closure", unit).length && of("random", unit).length);
  const series = (drawn) =>
    ["closure", "random"].map((name) => ({ name, curves: drawn.flatMap((unit) => of(name, unit)) }));
  const select = h(
    "select",
    {
      onchange: () => {
        location.hash = link("closure", select.value);
      },
    },
    h("option", { value: "" }, `all ${number(both.length)} that have both`),
    units.map((unit) => h("option", { value: unit, selected: unit === chosen }, unit)),
  );
  return [
    h("h1", {}, "Closure"),
    h("p", {}, h("label", {}, "Curves of ", select)),
    chart(
      series(chosen ? [chosen] : both),
      `Bins hit by closure and by undirected random, ${chosen || "all units"}`,
    ),
    table({
      name: "closure",
      caption: "Units",
      rows: units.map((unit, index) => race(unit, index, of("closure", unit)[0], of("random", unit)[0])),
      columns: [
        {
          title: "Unit",
          value: (row) => row.unit,
          cell: (row) => h("a", { href: link("closure", row.unit) }, row.unit),
        },
        { title: "Bins", value: (row) => row.bins, wide: true },
        {
          title: "Closure hits",
          value: (row) => row.closed,
          left: true,
          cell: (row) => meter(row.closed, row.bins),
        },
        { title: "in clocks", value: (row) => row.clocks },
        { title: "Random hits by then", value: (row) => row.then, wide: true },
        {
          title: "Random hits",
          value: (row) => row.random,
          left: true,
          cell: (row) => (row.random === null ? "–" : meter(row.random, row.bins)),
        },
        {
          title: "Factor",
          value: (row) => row.factor,
          cell: (row) => (row.factor === null ? "–" : `${row.reached ? "" : "> "}${row.factor.toFixed(1)}`),
        },
      ],
    }),
    h(
      "p",
      { class: "quiet" },
      "Factor: clocks that random takes to hit every bin, over closure's; > where it never does.",
    ),
  ];
}

/** One unit's two curves in numbers; factor: null where closure has not hit every bin, or one was not run. */
function race(unit, index, closure, random) {
  const end = (curve) => curve?.steps.at(-1) ?? [0, 0];
  const whole = closure?.bins ?? random.bins;
  const [clocks, closed] = end(closure);
  const reached = random?.steps.find(([, hit]) => hit >= whole);
  const factor = closure && random && closed >= whole && clocks ? (reached ?? end(random))[0] / clocks : null;
  return {
    index,
    unit,
    bins: whole,
    closed,
    clocks,
    then: random ? at(random.steps, clocks) : null,
    random: random ? end(random)[1] : null,
    factor,
    reached: Boolean(reached),
  };
}

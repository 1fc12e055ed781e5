/* Curves over clocks, drawn as SVG from their steps. */

const HEIGHT = 300,
  LEFT = 46,
  RIGHT = 14,
  TOP = 14,
  BOTTOM = 38;

const SHORT = new Intl.NumberFormat("en", { notation: "compact" });

/** Bins hit at a clock, of steps that grow. */
function at(steps, clock) {
  let low = 0,
    high = steps.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (steps[middle][0] <= clock) low = middle + 1;
    else high = middle;
  }
  return low ? steps[low - 1][1] : 0;
}

/** Share of all bins of some curves that are hit where each unit has had so many clocks, 0 to 1. */
function share(curves, clock) {
  const whole = curves.reduce((sum, curve) => sum + curve.bins, 0);
  return whole ? curves.reduce((sum, curve) => sum + at(curve.steps, clock), 0) / whole : 0;
}

/** Closure and random on a logarithmic axis of clocks; series: {name, curves}. */
function chart(series, title) {
  const width = Math.max(320, Math.min(760, innerWidth - 60));
  const last = Math.max(
    100,
    ...series.flatMap(({ curves }) => curves.map(({ steps }) => (steps.length ? steps.at(-1)[0] : 0))),
  );
  const decades = Math.ceil(Math.log10(last));
  const x = (clock) => LEFT + ((width - LEFT - RIGHT) * Math.log10(Math.max(1, clock))) / decades;
  const y = (part) => HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * part;
  const picture = svg("svg", {
    viewBox: `0 0 ${width} ${HEIGHT}`,
    class: "chart",
    role: "img",
    "aria-label": title,
  });
  for (let tenth = 0; tenth <= 10; tenth += 2) {
    picture.append(
      svg("line", { x1: LEFT, x2: width - RIGHT, y1: y(tenth / 10), y2: y(tenth / 10), class: "grid" }),
      svg("text", { x: LEFT - 6, y: y(tenth / 10) + 4, class: "tick end" }, `${tenth * 10} %`),
    );
  }
  for (let power = 0; power <= decades; power += 1) {
    picture.append(
      svg("line", { x1: x(10 ** power), x2: x(10 ** power), y1: y(0), y2: y(1), class: "grid" }),
      svg(
        "text",
        { x: x(10 ** power), y: y(0) + 16, class: power === decades ? "tick end" : "tick middle" },
        SHORT.format(10 ** power),
      ),
    );
  }
  picture.append(
    svg(
      "text",
      { x: (LEFT + width - RIGHT) / 2, y: HEIGHT - 4, class: "tick middle" },
      "clocks of each unit",
    ),
  );
  for (const { name, curves } of series)
    picture.append(svg("path", { d: path(curves, x, y), class: `curve ${name}` }));
  const legend = h("figcaption", { class: "legend" });
  const marker = svg("line", { y1: y(0), y2: y(1), class: "marker" });
  picture.append(marker);
  const write = (clock) =>
    legend.replaceChildren(
      ...series.map(({ name, curves }) =>
        h(
          "span",
          { class: `key ${name}` },
          `${name} ${(Math.floor(1000 * share(curves, clock)) / 10).toFixed(1)} %`,
        ),
      ),
      h("span", { class: "quiet" }, `of the bins after ${number(clock)} clocks`),
    );
  picture.addEventListener("pointermove", (event) => {
    const box = picture.getBoundingClientRect();
    const inside = ((event.clientX - box.left) / box.width) * width;
    const clock = Math.round(
      10 ** Math.min(decades, Math.max(0, ((inside - LEFT) / (width - LEFT - RIGHT)) * decades)),
    );
    marker.setAttribute("x1", x(clock));
    marker.setAttribute("x2", x(clock));
    write(clock);
  });
  write(last);
  return h("figure", {}, picture, legend);
}

/** Steps of the sum of curves: across to each clock where one grows, then up. */
function path(curves, x, y) {
  const clocks = [...new Set(curves.flatMap(({ steps }) => steps.map(([clock]) => clock)))].sort(
    (one, other) => one - other,
  );
  // Not more steps than can be told apart.
  const seen = clocks.filter(
    (clock, index) => index === clocks.length - 1 || x(clocks[index + 1]) - x(clock) > 0.4,
  );
  const parts = seen.map((clock) => `H${x(clock).toFixed(1)}V${y(share(curves, clock)).toFixed(1)}`);
  const end = curves.reduce((most, { steps }) => Math.max(most, steps.length ? steps.at(-1)[0] : 0), 1);
  return `M${x(1)} ${y(0)}${parts.join("")}H${x(end).toFixed(1)}`;
}

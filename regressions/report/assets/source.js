/* One source file: hits of each line, what is missing on it, what is excluded and why, which runs hit it. */

const [LINE, BRANCH, , TOGGLE] = [0, 1, 2, 3];
const LETTERS = ["L", "B", "E", "T"];
const POINTS_SHOWN = 40;

function sourceView(rest) {
  const [, path, line] = /^(.*?)(?::(\d+))?$/.exec(rest);
  if (!Object.hasOwn(section("texts"), path)) {
    const why = path ? `${path} is not on this page.` : "Choose a file.";
    return [h("h1", {}, "Source"), h("p", {}, why), sourcesList(true)];
  }
  const body = h("tbody", {}, sourceLines(path));
  const target = body.children[Number(line) - 1];
  target?.classList.add("target");
  requestAnimationFrame(() => target?.scrollIntoView({ block: "center" }));
  const head = headRow("line", "hits", "points", "source");
  const frame = { class: "scroll", role: "region", tabindex: "0", "aria-label": `Source of ${path}` };
  return [
    h("h1", { class: "path" }, path),
    picker(path),
    fileTotals(path),
    sourceTools(body),
    h("div", frame, h("table", { class: "source" }, head, body)),
  ];
}

function sourceLines(path) {
  const lines = covered(path);
  const mutants = survivorsOf(path);
  const pattern = language(path);
  const texts = section("texts")[path].replace(/\n$/, "").split("\n");
  return texts.map((text, index) => {
    const number = index + 1;
    return sourceLine(path, number, coloured(text, pattern), lines.get(number), mutants.get(number));
  });
}

function sourceTools(body) {
  const move = (key, title, way) =>
    h(
      "button",
      { type: "button", "data-key": key, onclick: () => step(body, way) },
      `${title} missing (${key})`,
    );
  const samples = { hit: "hit", part: "in part", miss: "not hit", out: "excluded" };
  const legend = Object.entries(samples).map(([state, title]) =>
    h("span", { class: `sample ${state}` }, title),
  );
  const letters = "B branches, E expressions, T toggles, M mutants that survived";
  return h(
    "div",
    { class: "tools sticky" },
    move("p", "Previous", -1),
    move("n", "Next", 1),
    h("span", { class: "legend" }, legend, h("span", { class: "quiet wide" }, letters)),
  );
}

function picker(path) {
  const select = h(
    "select",
    {
      "aria-label": "File",
      onchange: () => {
        location.hash = link("source", select.value);
      },
    },
    Object.keys(section("texts")).map((name) => h("option", { value: name, selected: name === path }, name)),
  );
  return h("p", {}, select);
}

function fileTotals(path) {
  const file = rows("files").find((found) => found.path === path);
  if (!file) return h("p", { class: "quiet" }, "No code coverage was measured of this file.");
  return facts(
    KINDS.filter((kind) => file[`${kind}Needed`] + file[`${kind}Excluded`]).map((kind) => [
      kind,
      meter(file[kind], file[`${kind}Needed`], file[`${kind}Excluded`]),
    ]),
  );
}

/** Points of a file by line, and the hits of each line that a line or branch point is about. */
function covered(path) {
  const { points, reasons, sets } = section("code");
  const lines = new Map();
  const on = (line) => {
    if (!lines.has(line)) lines.set(line, { points: [], hits: null, runs: new Set(), excluded: "" });
    return lines.get(line);
  };
  for (const [line, kind, name, hits, set, reason, about] of points[path] ?? []) {
    const point = { kind, name, hits, runs: sets[set], excluded: reasons[reason] };
    on(line).points.push(point);
    if (kind > BRANCH) continue;
    for (const own of about.length ? about : [line]) {
      const found = on(own);
      found.hits = Math.max(found.hits ?? 0, hits);
      if (point.excluded) found.excluded = point.excluded;
      point.runs.forEach((run) => found.runs.add(run));
    }
  }
  toggles(path).forEach(([line, point]) => on(line).points.push(point));
  return lines;
}

/** Toggles of a file, each with its line: signals hold them by turns of bit and edge, and hits. */
function toggles(path) {
  const { toggles: signals, reasons, sets } = section("code");
  return (signals[path] ?? []).flatMap(([line, signal, set, reason, found]) => {
    const points = [];
    for (let place = 0; place < found.length; place += 2) {
      const bit = found[place] >> 1;
      const name = `${signal}${bit < 0 ? "" : `[${bit}]`}:${found[place] & 1 ? "1->0" : "0->1"}`;
      points.push([
        line,
        { kind: TOGGLE, name, hits: found[place + 1], runs: sets[set], excluded: reasons[reason] },
      ]);
    }
    return points;
  });
}

function survivorsOf(path) {
  const found = new Map();
  for (const mutant of rows("survivors")) {
    const [file, line] = mutant.place;
    if (file === path) found.set(line, [...(found.get(line) ?? []), mutant]);
  }
  return found;
}

/** hit, part, miss or out of a line; nothing where no point is on it. */
function stateOf({ points, hits, excluded }) {
  if (hits === 0 && !excluded) return "miss";
  if (points.some((point) => !point.hits && !point.excluded)) return "part";
  if (excluded || points.some((point) => point.excluded)) return "out";
  return hits === null && !points.length ? "" : "hit";
}

function sourceLine(path, line, words, found, mutants) {
  const state = found ? stateOf(found) : "";
  const element = h("tr", { class: state || null, "data-line": line });
  const why = found?.excluded || found?.points.find((point) => point.excluded)?.excluded;
  const cross = state === "miss" ? h("span", { class: "cross", "aria-label": "not hit" }, "✗") : null;
  element.append(
    h("th", { scope: "row" }, h("a", { href: link("source", `${path}:${line}`) }, String(line))),
    h("td", { class: "hits" }, found && found.hits !== null ? [cross, number(found.hits)] : ""),
    h("td", {}, found || mutants ? marks(element, line, found, mutants) : null),
    h(
      "td",
      { class: "code" },
      h("code", {}, words),
      why ? h("span", { class: "why" }, `excluded: ${why}`) : null,
    ),
  );
  return element;
}

/** The button that says in short what is on a line, and opens it below. */
function marks(element, line, found, mutants) {
  const mutant = mutants ? h("span", { class: "mutant" }, "M") : null;
  const named = {
    type: "button",
    class: "marks",
    "aria-expanded": "false",
    "aria-label": `Points of line ${line}`,
  };
  const button = h("button", named, tallies(found), mutant);
  button.addEventListener("click", () => unfold(element, button, found, mutants));
  return button;
}

/** Hit of needed points by kind: `B 1/2`; lines are in the column of hits. */
function tallies(found) {
  if (!found) return null;
  return LETTERS.map((letter, kind) => {
    const needed = found.points.filter((point) => point.kind === kind && !point.excluded);
    if (!needed.length || kind === LINE) return null;
    const hit = needed.filter((point) => point.hits).length;
    return h(
      "span",
      { class: hit === needed.length ? "tally" : "tally short" },
      `${letter} ${hit}/${needed.length}`,
    );
  });
}

function unfold(element, button, found, mutants) {
  const opened = button.getAttribute("aria-expanded") === "true";
  button.setAttribute("aria-expanded", String(!opened));
  if (opened) element.nextElementSibling.remove();
  else
    element.after(
      h(
        "tr",
        { class: "detail" },
        h("td", { colspan: 4 }, found ? lineDetail(found) : null, (mutants ?? []).map(mutantDetail)),
      ),
    );
}

function lineDetail({ points, runs }) {
  const order = [...points].sort((one, other) => missing(other) - missing(one));
  const list = h("tbody");
  const draw = (from, until) => list.append(...order.slice(from, until).map(pointRow));
  draw(0, POINTS_SHOWN);
  const left = order.length - POINTS_SHOWN;
  const more =
    left > 0
      ? h(
          "button",
          {
            type: "button",
            onclick: () => {
              draw(POINTS_SHOWN);
              more.remove();
            },
          },
          `${number(left)} more points`,
        )
      : null;
  return h(
    "div",
    {},
    points.length
      ? h("table", { class: "inner" }, headRow("kind", "point", "hits", "runs", "excluded"), list)
      : null,
    more,
    runs.size ? h("p", {}, `The line is hit by ${number(runs.size)} runs: `, runsNamed([...runs])) : null,
  );
}

function missing(point) {
  return Number(!point.hits) * (point.excluded ? 1 : 2);
}

function pointRow({ kind, name, hits, runs, excluded }) {
  return h(
    "tr",
    { class: hits ? null : excluded ? "out" : "miss" },
    h("td", {}, KINDS[kind]),
    h("td", {}, h("code", {}, name)),
    h("td", { class: "number" }, number(hits)),
    h("td", {}, runsNamed(runs)),
    h("td", {}, excluded),
  );
}

/** The first few by name, and how many there are besides. */
function runsNamed(runs) {
  const names = runs.slice(0, 6).map((run) => rows("runs")[run].name);
  const rest = runs.slice(6).map((run) => rows("runs")[run].name);
  if (!rest.length) return names.join(", ");
  const more = h(
    "button",
    { type: "button", class: "quiet", onclick: () => more.replaceWith(`, ${rest.join(", ")}`) },
    `and ${number(rest.length)} more`,
  );
  return [`${names.join(", ")} `, more];
}

/** Goes to the next line, or the one before, on which something is missing. */
function step(body, way) {
  const lines = [...body.querySelectorAll("tr[data-line]")];
  const current = lines.findIndex((line) => line.classList.contains("target"));
  const order = way > 0 ? lines.slice(current + 1) : lines.slice(0, Math.max(0, current)).reverse();
  const next = order.find((line) => line.matches(".miss, .part"));
  if (!next) return tell(way > 0 ? "Nothing more is missing below" : "Nothing is missing above");
  lines[current]?.classList.remove("target");
  next.classList.add("target");
  next.scrollIntoView({ block: "center" });
  next.querySelector("a").focus({ preventScroll: true });
}

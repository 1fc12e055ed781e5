/* A table that is sorted by its headers, filtered by one text, and drawn as far as it is looked at. */

const PORTION = 100;

/**
 * name: of the table, in the address. columns: {title, value(row), cell(row), left, wide}: value is what
 * is sorted and searched and, without cell, shown; numbers are on the right unless it says left; wide
 * columns are left out on narrow screens. detail(row): what a row opens to. key(row): name of a row, in the
 * address. open: key of the row that is open at first. facet: {value(row), order}, by whose values rows can
 * be chosen. search(row): more text that the filter looks at.
 */
function table({ name, caption, columns, rows: all, detail, key, open, facet, search }) {
  const state = settings(name, columns);
  const texts = new Map();
  const kinds = new Map(columns.map((column) => [column, kindOf(column, all)]));
  const body = h("tbody");
  const count = h("output", { class: "count" });
  let shown = [];
  let drawn = 0;

  function text(row) {
    if (!texts.has(row)) {
      const words = [...columns.map((column) => column.value(row)), search ? search(row) : ""];
      texts.set(row, words.join(" ").toLowerCase());
    }
    return texts.get(row);
  }

  function choose() {
    const words = state.filter.toLowerCase().split(/\s+/).filter(Boolean);
    shown = all.filter(
      (row) =>
        (!state.only || facet.value(row) === state.only) && words.every((word) => text(row).includes(word)),
    );
    if (state.column) {
      const way = state.down ? -1 : 1;
      shown.sort(
        (one, other) =>
          way * compare(state.column.value(one), state.column.value(other)) || one.index - other.index,
      );
    }
    count.textContent =
      shown.length === all.length ? number(all.length) : `${number(shown.length)} of ${number(all.length)}`;
    body.replaceChildren();
    drawn = 0;
    more();
  }

  function more(least = PORTION) {
    last.remove();
    const until = Math.min(shown.length, drawn + Math.max(least, PORTION));
    for (; drawn < until; drawn += 1) body.append(line(shown[drawn]));
    if (!shown.length)
      body.append(h("tr", {}, h("td", { colspan: columns.length, class: "none" }, "Nothing matches.")));
    if (drawn < shown.length) body.append(last);
  }

  function line(row) {
    const cells = columns.map((column) => {
      const value = column.value(row);
      return h(
        "td",
        { class: kinds.get(column) },
        column.cell ? column.cell(row) : typeof value === "number" ? number(value) : (value ?? "–"),
      );
    });
    const element = h("tr", { "data-key": key ? key(row) : null }, cells);
    if (detail) opens(element, row);
    return element;
  }

  function opens(element, row) {
    const button = h("button", {
      type: "button",
      class: "opener",
      "aria-expanded": "false",
      "aria-label": `Details of ${key ? key(row) : columns[0].value(row)}`,
    });
    const first = element.firstElementChild;
    first.classList.add("first");
    first.prepend(button);
    button.addEventListener("click", () => {
      const opened = button.getAttribute("aria-expanded") === "true";
      button.setAttribute("aria-expanded", String(!opened));
      if (opened) element.nextElementSibling.remove();
      else element.after(h("tr", { class: "detail" }, h("td", { colspan: columns.length }, detail(row))));
    });
  }

  function heads() {
    return columns.map((column) => {
      const head = h("th", { scope: "col", class: kinds.get(column) });
      head.append(h("button", { type: "button", onclick: () => sort(column) }, column.title));
      mark(head, column);
      return head;
    });
  }

  function mark(head, column) {
    if (state.column === column) head.setAttribute("aria-sort", state.down ? "descending" : "ascending");
    else head.removeAttribute("aria-sort");
  }

  function sort(column) {
    state.down = state.column === column && !state.down;
    state.column = column;
    remember(`${name}.sort`, (state.down ? "-" : "") + column.title);
    [...titles.children].forEach((head, at) => mark(head, columns[at]));
    choose();
  }

  /** The row of a key, drawn and opened; whether there is one. */
  function show(wanted) {
    const at = shown.findIndex((row) => key(row) === wanted);
    if (at < 0) return false;
    if (at >= drawn) more(at + 1 - drawn);
    const element = [...body.children].find((child) => child.dataset.key === wanted);
    element.querySelector(".opener")?.click();
    element.classList.add("target");
    requestAnimationFrame(() => element.scrollIntoView({ block: "center" }));
    return true;
  }

  const titles = h("tr", {}, heads());
  const last = h(
    "tr",
    { class: "last" },
    h("td", { colspan: columns.length }, h("button", { type: "button", onclick: () => more() }, "More rows")),
  );
  const watcher = new IntersectionObserver((found) => found.some((entry) => entry.isIntersecting) && more(), {
    rootMargin: "800px",
  });
  const filter = h("input", {
    type: "search",
    placeholder: "Filter",
    "aria-label": `Filter ${caption}`,
    value: state.filter,
    oninput: () => {
      state.filter = filter.value;
      remember(`${name}.q`, state.filter);
      choose();
    },
  });
  const head = h(
    "div",
    { class: "tools" },
    h("h3", {}, caption, " ", count),
    facet ? chips(all, facet, state, name, choose) : null,
    filter,
  );
  const frame = h(
    "div",
    { class: "scroll", role: "region", tabindex: "0", "aria-label": caption },
    h("table", {}, h("thead", {}, titles), body),
  );
  choose();
  watcher.observe(last);
  if (open && !show(open) && all.some((row) => key(row) === open)) {
    Object.assign(state, { filter: "", only: "" });
    filter.value = "";
    choose();
    show(open);
  }
  return h("section", { class: "table", id: `table-${name}` }, head, frame);
}

/** Classes of a column's cells. */
function kindOf(column, all) {
  const numbers = !column.left && all.some((row) => typeof column.value(row) === "number");
  return [numbers && "number", column.wide && "wide"].filter(Boolean).join(" ") || null;
}

function settings(name, columns) {
  const { query } = route();
  const sorted = query.get(`${name}.sort`) ?? "";
  const column = columns.find((found) => found.title === sorted.replace(/^-/, ""));
  return {
    filter: query.get(`${name}.q`) ?? "",
    only: query.get(`${name}.only`) ?? "",
    column,
    down: sorted.startsWith("-"),
  };
}

/** Numbers before texts before nothing; numbers in texts count as numbers. */
function compare(one, other) {
  const rank = (value) =>
    value === null || value === undefined || value === "" ? 2 : typeof value === "number" ? 0 : 1;
  if (rank(one) !== rank(other)) return rank(one) - rank(other);
  return rank(one) === 0 ? one - other : rank(one) === 1 ? ORDER.compare(one, other) : 0;
}

const ORDER = new Intl.Collator("en", { numeric: true });

/** A button for each value of a column; pressed, it leaves only its rows. */
function chips(all, facet, state, name, choose) {
  const values = facet.order.filter((value) => all.some((row) => facet.value(row) === value));
  const buttons = values.map((value) =>
    h(
      "button",
      {
        type: "button",
        class: "chip",
        "aria-pressed": String(state.only === value),
        onclick: () => {
          state.only = state.only === value ? "" : value;
          remember(`${name}.only`, state.only);
          buttons.forEach((button, at) =>
            button.setAttribute("aria-pressed", String(values[at] === state.only)),
          );
          choose();
        },
      },
      badge(value),
      ` ${number(all.filter((row) => facet.value(row) === value).length)}`,
    ),
  );
  return h("div", { class: "chips" }, buttons);
}

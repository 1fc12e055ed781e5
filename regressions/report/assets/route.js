/* Where the reader is: #view/rest?name=value. The view and what it shows are the path; how tables are
   sorted and filtered are the names and values, so that any state of the page can be linked to. */

function route() {
  const [path, query = ""] = location.hash.slice(1).split("?");
  const [view, ...rest] = path.split("/");
  return {
    view: view || "summary",
    rest: rest.map(decodeURIComponent).join("/"),
    query: new URLSearchParams(query),
  };
}

/** The fragment of a view, and of one thing in it. */
function link(view, rest = "") {
  return `#${view}${rest ? `/${rest.split("/").map(encodeURIComponent).join("/")}` : ""}`;
}

/** Keeps a setting in the address without a new entry in the history. */
function remember(name, value) {
  const { view, rest, query } = route();
  if (value) query.set(name, value);
  else query.delete(name);
  const words = query.toString();
  history.replaceState(null, "", link(view, rest) + (words ? `?${words}` : ""));
}

/** A link to a line of a source; plain text where the source is not on the page. */
function place([path, line] = []) {
  if (!path) return "";
  const text = `${path}:${line}`;
  if (!Object.hasOwn(section("texts"), path)) return text;
  return h("a", { href: link("source", text), class: "place" }, text);
}

function testLink(index) {
  const result = rows("results")[index];
  return h("a", { href: link("tests", result.id) }, result.id);
}

/* The views by name, and which one is shown. */

const VIEWS = {
  summary: ["Summary", summaryView],
  plan: ["Plan", planView],
  functional: ["Functional", functionalView],
  closure: ["Closure", closureView],
  code: ["Code", codeView],
  source: ["Source", sourceView],
  mutation: ["Mutation", mutationView],
  tests: ["Tests", testsView],
};

let drawnAt = null;

function draw() {
  const { view, rest } = route();
  const [title, render] = VIEWS[view] ?? VIEWS.summary;
  const main = document.getElementById("main");
  main.className = `view-${view}`;
  main.replaceChildren(...render(rest).filter(Boolean).flat());
  document.title = `${title}: ${section("summary").list} ${section("summary").verdict}`;
  document.querySelectorAll("#nav a").forEach((found) => {
    if (found.hash === `#${view}`) found.setAttribute("aria-current", "page");
    else found.removeAttribute("aria-current");
  });
  if (drawnAt !== null) main.focus({ preventScroll: true });
  if (drawnAt !== view && !rest) scrollTo(0, 0);
  drawnAt = view;
}

/** Keys: / goes to the filter; n and p press the buttons that say so. */
function press(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("input, select, textarea"))
    return;
  const wanted =
    event.key === "/"
      ? document.querySelector("main input[type=search]")
      : document.querySelector(`main button[data-key="${CSS.escape(event.key)}"]`);
  if (!wanted) return;
  event.preventDefault();
  if (event.key === "/") wanted.focus();
  else wanted.click();
}

document
  .getElementById("nav")
  .append(...Object.entries(VIEWS).map(([name, [title]]) => h("a", { href: link(name) }, title)));
document.querySelector(".brand").textContent = section("summary").list;
addEventListener("hashchange", draw);
addEventListener("keydown", press);
draw();

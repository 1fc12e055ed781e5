"use strict";

/* Elements made by hand. Texts become text nodes and attributes: nothing is ever parsed as HTML. */

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(
    ...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false),
  );
  return element;
}

/** An HTML element: h("a", {href: "#summary"}, "Summary"). */
function h(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** An SVG element. */
function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

/** 1,234 of 1234; a dash where there is no number. */
function number(value) {
  return value === null || value === undefined ? "–" : value.toLocaleString("en");
}

/** A percentage, rounded down, so that only all is 100 %. */
function percent(good, whole) {
  if (!whole) return "–";
  return good === whole ? "100 %" : `${(Math.floor((1000 * good) / whole) / 10).toFixed(1)} %`;
}

/** Seconds as a person says them. */
function duration(seconds) {
  if (seconds < 90) return `${seconds.toFixed(1)} s`;
  const minutes = Math.round(seconds / 60);
  return minutes < 90 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** A bar that is good/whole full. */
function bar(good, whole) {
  const share = whole ? good / whole : 0;
  const inner = h("span", { class: "fill" });
  inner.style.width = `${100 * share}%`;
  return h("span", { class: `bar ${good === whole ? "all" : "some"}`, "aria-hidden": "true" }, inner);
}

/** A bar with its numbers. */
function meter(good, whole, excluded = 0) {
  const out = excluded ? h("span", { class: "quiet" }, ` (${number(excluded)} excluded)`) : null;
  const text = h(
    "span",
    {},
    `${percent(good, whole)} `,
    h("span", { class: "quiet" }, `${number(good)}/${number(whole)}`),
    out,
  );
  return h("span", { class: "meter" }, bar(good, whole), text);
}

/** A word in the colour of what it means. */
function badge(word) {
  return h("span", { class: `badge ${word.replaceAll(/[ _]/g, "-")}` }, word.replaceAll("_", " "));
}

function tell(text) {
  const line = document.getElementById("told");
  line.textContent = text;
  setTimeout(() => {
    if (line.textContent === text) line.textContent = "";
  }, 2500);
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    tell("Copied");
  } catch {
    tell("The browser does not let the page copy: select the text by hand");
  }
}

/** A command line with a button that copies it. */
function command(text) {
  const button = h(
    "button",
    { type: "button", class: "copy", "aria-label": `Copy: ${text}`, onclick: () => copy(text) },
    "Copy",
  );
  return h("div", { class: "command" }, h("code", { tabindex: "0" }, text), button);
}

/** Names and values, those that are there. */
function facts(pairs) {
  const there = pairs.filter(
    ([, value]) => value !== "" && value !== null && value !== undefined && value !== false,
  );
  return h(
    "dl",
    { class: "facts" },
    there.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))),
  );
}

/** The head of a table that is not sorted. */
function headRow(...titles) {
  const cells = titles.map((title) => h("th", { scope: "col" }, title));
  return h("thead", {}, h("tr", {}, cells));
}

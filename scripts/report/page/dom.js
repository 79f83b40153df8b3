// Elements and numbers. Text from files only ever becomes text, never markup.

const DASH = "–";

/** An element with attributes (null leaves one out) and children, elements or text. */
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {}))
    if (value !== null) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** The part of a scene, or of the page, that the template calls `name`; null if it is not there. */
function part(root, name) {
  return root.querySelector(`[data-part="${name}"]`);
}

/** A number with so many digits, whole numbers without any; a dash for what is none. */
function formatValue(value, digits) {
  if (!Number.isFinite(value)) return DASH;
  return Number.isInteger(value) ? String(value) : value.toFixed(digits);
}

/** Fills a table: header texts, and rows whose first cell, a text or a list of what stands in it,
    is their heading. */
function fillTable(table, header, rows) {
  const head = make("tr", {}, ...header.map((text) => make("th", { scope: "col" }, text)));
  const body = rows.map((row) =>
    make("tr", {}, make("th", { scope: "row" }, ...[row[0]].flat()),
         ...row.slice(1).map((text) => make("td", {}, text))));
  table.replaceChildren(make("thead", {}, head), make("tbody", {}, ...body));
}

/** Fills a <select> with [value, text] pairs. */
function fillSelect(select, options) {
  select.replaceChildren(...options.map(([value, text]) => make("option", { value }, text)));
}

/** Sets an image, or takes it away together with its alternative text. */
function setPicture(image, uri, alternative) {
  image.hidden = !uri;
  image.alt = uri ? alternative : "";
  if (uri) image.src = uri;
  else image.removeAttribute("src");
}

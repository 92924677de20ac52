"use strict";
// Tables sort by a click on their head, and copy as text with tabs. Without scripts the page shows all the same.
const spoken = document.getElementById("spoken");
const say = (words) => { spoken.textContent = words; };
const content = (cell) => cell.dataset.value ?? cell.textContent;

function compare(a, b) {
  const [x, y] = [content(a), content(b)];
  if ((x === "") !== (y === "")) return { unknown: x === "" ? 1 : -1 }; // what is unknown stays below
  const both = "value" in a.dataset && "value" in b.dataset;
  return { order: both ? Number(x) - Number(y) : x.localeCompare(y, undefined, { numeric: true }) };
}

function sort(head) {
  const table = head.closest("table"), column = head.cellIndex;
  const up = head.getAttribute("aria-sort") !== "ascending";
  const rows = [...table.tBodies[0].rows];
  rows.sort((a, b) => {
    const found = compare(a.cells[column], b.cells[column]);
    return found.unknown ?? (up ? found.order : -found.order);
  });
  table.tBodies[0].append(...rows);
  for (const other of head.parentNode.cells) other.setAttribute("aria-sort", "none");
  head.setAttribute("aria-sort", up ? "ascending" : "descending");
  say(`sorted by ${head.textContent}, ${up ? "ascending" : "descending"}`);
}

// A spreadsheet takes a text that begins with one of these for a formula; an apostrophe makes it a text.
function field(cell) {
  if (cell.dataset.value) return cell.dataset.value;
  const text = content(cell).replace(/\s+/g, " ").trim();
  return /^[=+\-@]/.test(text) ? `'${text}` : text;
}

const tsv = (table) => [...table.rows].map((row) => [...row.cells].map(field).join("\t")).join("\n") + "\n";

function copyByHand(text) {
  const area = document.createElement("textarea");
  area.value = text;
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  return done;
}

async function copy(table, button) {
  const text = tsv(table);
  let done = true;
  try { await navigator.clipboard.writeText(text); } catch { done = copyByHand(text); }
  button.focus();
  say(done ? "table copied" : "the browser did not allow a copy");
  button.textContent = done ? "Copied" : "Not copied";
  setTimeout(() => { button.textContent = "Copy table"; }, 2000);
}

for (const box of document.querySelectorAll(".table")) {
  const table = box.querySelector("table");
  for (const head of table.tHead.rows[0].cells) head.firstChild.addEventListener("click", () => sort(head));
  const button = document.createElement("button");
  button.type = "button";
  button.className = "copy";
  button.textContent = "Copy table";
  button.setAttribute("aria-describedby", table.caption.id);
  button.addEventListener("click", () => copy(table, button));
  box.after(button);
}

// Evidence is folded: a link to a section opens it, and paper shows all of it.
function unfold() {
  const found = location.hash && document.getElementById(location.hash.slice(1))?.querySelector(":scope > details");
  if (found) found.open = true;
}
addEventListener("hashchange", unfold);
unfold();
for (const link of document.querySelectorAll("nav a")) link.addEventListener("click", () => setTimeout(unfold));
addEventListener("beforeprint", () => { for (const each of document.querySelectorAll("details")) each.open = true; });

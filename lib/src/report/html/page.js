// Sorting and filtering of the table of files; nothing else on the page depends on it.
"use strict";
(() => {
  const table = document.querySelector(".files");
  const body = table.tBodies[0], rows = [...body.rows];
  const text = document.getElementById("filter-text"), outcome = document.getElementById("filter-outcome");
  const warned = document.getElementById("filter-warnings"), count = document.getElementById("shown");
  const names = rows.map(row => row.cells[1].dataset.value.toLowerCase());

  function filter() {
    const wanted = text.value.trim().toLowerCase();
    let shown = 0;
    rows.forEach((row, i) => {
      const hit = names[i].includes(wanted) && (!outcome.value || row.dataset.outcome === outcome.value) &&
        (!warned.checked || Number(row.dataset.warnings) > 0);
      row.hidden = !hit;
      shown += hit;
    });
    count.textContent = `${shown} of ${rows.length} files shown`;
  }

  function sort(header) {
    const column = header.cellIndex, numeric = header.classList.contains("number");
    const descending = header.getAttribute("aria-sort") === (numeric ? "none" : "ascending");
    for (const other of header.parentNode.cells) if (other.hasAttribute("aria-sort")) other.setAttribute("aria-sort", "none");
    header.setAttribute("aria-sort", descending ? "descending" : "ascending");
    const key = row => row.cells[column].dataset.value;
    const order = numeric ? (a, b) => Number(key(a)) - Number(key(b)) : (a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0);
    body.append(...[...rows].sort((a, b) => (descending ? order(b, a) : order(a, b))));
  }

  for (const control of [text, outcome, warned]) control.addEventListener("input", filter);
  for (const header of table.tHead.rows[0].cells) header.querySelector("button")?.addEventListener("click", () => sort(header));
  document.querySelector(".filters").hidden = rows.length < 2;
  filter();
})();

// Shows the filter, which is of no use without scripts, and opens before printing what is no evidence.
const filter = document.getElementById("filter");
const claims = [...document.querySelectorAll("tbody[data-verdict]")];
const folds = [...document.querySelectorAll("details.paper-section")];
const START = "#show?";
function chosen() {
  return [...filter.querySelectorAll("select, input")].filter(field => field.value);
}
function show(keep) {
  const fields = chosen();
  let count = 0;
  for (const claim of claims) {
    claim.hidden = fields.some(field => field.name === "q"
      ? !claim.textContent.toLowerCase().includes(field.value.toLowerCase())
      : claim.dataset[field.name] !== field.value);
    count += claim.hidden ? 0 : 1;
  }
  for (const fold of folds) {
    const left = fold.querySelector("tbody[data-verdict]:not([hidden])");
    fold.hidden = !left;
    if (fields.length && left) fold.open = true;
  }
  document.getElementById("shown").textContent = count + " of " + claims.length + " claims";
  if (keep && fields.length)
    history.replaceState(null, "", START + new URLSearchParams(fields.map(field => [field.name, field.value])));
  else if (keep && location.hash.startsWith(START)) history.replaceState(null, "", "#proof");
}
function follow() {
  if (location.hash.startsWith(START)) {
    const asked = new URLSearchParams(location.hash.slice(START.length));
    for (const field of filter.querySelectorAll("select, input")) field.value = asked.get(field.name) || "";
    show(false);
    document.getElementById("proof").scrollIntoView();
    return;
  }
  const name = location.hash.slice(1);
  const claim = document.getElementById(decodeURIComponent(name)) || document.getElementById(name);
  if (!claim) return;
  if (claim.closest("tbody[hidden]")) {  // a link to a claim that is filtered away shows all again
    for (const field of filter.querySelectorAll("select, input")) field.value = "";
    show(false);
  }
  const fold = claim.closest("details.paper-section");
  if (fold && !fold.open) { fold.open = true; claim.scrollIntoView(); }
}
if (filter) {
  filter.hidden = false;
  filter.addEventListener("input", () => show(true));
  document.getElementById("unfold").addEventListener("click", () => { for (const fold of folds) fold.open = true; });
  addEventListener("hashchange", follow);
  show(false);
  follow();
}
// A display that is wider than its place is scrolled by keys, too; one that is not needs no stop on the way.
const measured = new ResizeObserver(entries => {
  for (const { target } of entries) {
    const scrolls = target.scrollWidth > target.clientWidth;
    for (const [name, value] of [["tabindex", "0"], ["role", "group"], ["aria-label", "Formula, wider than the page"]])
      if (scrolls) target.setAttribute(name, value);
      else target.removeAttribute(name);
  }
});
for (const display of document.querySelectorAll(".math, details p")) measured.observe(display);
// Findings and tables are printed whole; evidence where it was open. What was opened for that is closed again.
let opened = [];
addEventListener("beforeprint", () => {
  opened = [...document.querySelectorAll("details:is(.group, .more, .long):not([open])")]
    .filter(fold => !fold.closest("#graph"));
  for (const fold of opened) fold.open = true;
});
addEventListener("afterprint", () => { for (const fold of opened) fold.open = false; });

// Draws each figure's chart as it comes near the screen, in the page's colours, and its table when that is opened.
// Without scripts and in print the drawn figures stand.
const SERIES = 6, DASHES = ["solid", "dash", "dot", "dashdot"], ROWS = 60;
const narrow = matchMedia("(max-width: 46rem)"), dark = matchMedia("(prefers-color-scheme: dark)");
const charts = new Map([...document.querySelectorAll("figure.charted")].map(
  figure => [figure, JSON.parse(figure.querySelector("script").textContent)]));
const hue = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// A letter with an index that Unicode has no small sign for, as v_d, as the chart's own marks have it; names of several
// letters before the line, as mpc_linear, stay as they are.
function lettered(text) {
  return text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;")
    .replace(/(?<![\p{L}\p{N}_])(\p{L}\p{M}*)_([\p{L}\p{N}]{1,3})(?![\p{L}\p{N}_])/gu, "$1<sub>$2</sub>");
}

function traces(chart) {
  const named = new Set();
  return chart.panels.flatMap((panel, at) => panel.curves.map(curve => {
    const beneath = curve.series === undefined, first = curve.label && !named.has(curve.label);
    named.add(curve.label);
    return {
      x: curve.x, y: curve.y, name: lettered(curve.label), legendgroup: curve.label, yaxis: at ? "y" + (at + 1) : "y",
      showlegend: Boolean(first) && !panel.title, mode: curve.marked ? "lines+markers" : "lines",
      line: { color: beneath ? hue("--faint") : hue("--series-" + curve.series % SERIES), width: beneath ? 5 : 1.6,
              dash: beneath ? "solid" : DASHES[Math.floor(curve.series / SERIES) % DASHES.length] },
      marker: { size: 6 }, hovertemplate: "%{y:.4g}",
    };
  }));
}

// A logarithmic axis has numbers at powers of ten alone: one that holds fewer than two of them is drawn as a linear one.
function logarithmic(values) {
  const powers = values.filter(value => value > 0).map(Math.log10);
  const low = powers.reduce((a, b) => Math.min(a, b), Infinity), high = powers.reduce((a, b) => Math.max(a, b), -Infinity);
  return Math.floor(high) > Math.ceil(low);
}

// Trials and other things that are counted have no halves between them.
function counted(values) {
  return values.every(Number.isInteger) && Math.max(...values) - Math.min(...values) <= 12;
}

function layout(chart) {
  const ink = hue("--ink"), line = hue("--line"), panels = chart.panels.length;
  const one = panels > 1 ? (panels > 3 ? 105 : 170) : 330;
  const axis = { gridcolor: line, zerolinecolor: hue("--faint"), linecolor: line, exponentformat: "power" };
  const titled = chart.panels.some(panel => panel.title);
  const found = {
    height: one * panels + 120, margin: { l: narrow.matches ? 48 : 66, r: narrow.matches ? 12 : 34, t: 34, b: 48 },
    paper_bgcolor: hue("--paper"), plot_bgcolor: hue("--paper"), font: { color: ink, size: 12, family: "inherit" },
    hoverlabel: { bgcolor: hue("--panel"), bordercolor: line, font: { color: ink }, namelength: narrow.matches ? 14 : 40 },
    hovermode: chart.panels.some(panel => panel.curves.length > 10) ? "closest" : "x unified",
    dragmode: matchMedia("(pointer: coarse)").matches ? false : "zoom", modebar: { orientation: narrow.matches ? "h" : "v" },
    legend: { orientation: "h", y: 1, yanchor: "bottom", x: 0, font: { size: 12 } },
    xaxis: { ...axis, title: { text: lettered(chart.x) }, type: chart.log ? "log" : "linear",
             ...(!chart.log && counted(chart.panels.flatMap(panel => panel.curves.flatMap(curve => curve.x.slice(0, 20)))) ?
               { dtick: 1 } : {}),
             anchor: panels > 1 ? "y" + panels : "y" },
    annotations: chart.panels.filter(panel => panel.title).map(panel => ({
      text: lettered(panel.title), xref: "paper", x: 0, xanchor: "left", yref: "paper", yanchor: "bottom", showarrow: false,
      y: 1 - chart.panels.indexOf(panel) / panels - (titled ? 0.22 / panels : 0), font: { size: 11 } })),
  };
  chart.panels.forEach((panel, at) => {
    const log = panel.log && logarithmic(panel.curves.flatMap(curve => curve.y));
    const top = 1 - at / panels, gap = panels > 1 ? (titled ? 0.24 : 0.12) / panels : 0;
    found[at ? "yaxis" + (at + 1) : "yaxis"] = {
      ...axis, title: { text: lettered(panel.y), font: { size: 12 }, standoff: 6 }, type: log ? "log" : "linear",
      domain: [top - 1 / panels + (titled ? 0.02 / panels : gap), titled ? top - gap : top], 
      nticks: panels > 1 ? 4 : 8, ...(log ? { minor: { showgrid: false, ticks: "" }, dtick: 1 } : {}) };
  });
  return found;
}

function draw(figure) {
  const box = figure.querySelector(".chart"), wanted = layout(charts.get(figure));
  box.hidden = false;
  box.style.height = wanted.height + "px";  // a chart that is drawn again takes its box's height, else none at all
  figure.classList.add("drawn");
  Plotly.react(box, traces(charts.get(figure)), wanted, {
    responsive: true, displaylogo: false, showTips: false, showSendToCloud: false, plotlyServerURL: "",
    modeBarButtonsToRemove: ["toImage", "select2d", "lasso2d", "autoScale2d", "zoomIn2d", "zoomOut2d"] });
}

function cell(row, kind, text) {
  const made = document.createElement(kind);
  made.textContent = text;
  if (kind === "th") made.scope = "col";
  row.append(made);
}

// A number as the page's tables write it; the CSV file has all its digits.
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
function shown(value) {
  if (typeof value !== "number" || !isFinite(value)) return value;
  const rounded = Number(value.toPrecision(6)), tiny = rounded && Math.abs(rounded) < 1e-4;
  const [digits, power] = (tiny ? rounded.toExponential() : String(rounded)).replaceAll("-", "−").split("e");
  if (!power) return digits;
  return digits + "\u202f×\u202f10" + power.replace("+", "").replace("−", "⁻").replace(/\d/g, digit => RAISED[digit]);
}

function table(figure, fold) {
  if (fold.querySelector("table")) return;
  const chart = charts.get(figure), several = chart.panels.length > 1, made = document.createElement("table");
  made.className = "numbers";
  const head = made.createTHead().insertRow();
  const y = several ? "value" : chart.panels[0].y;
  for (const text of ["curve", ...(several ? ["quantity"] : []), chart.x, y || "value"]) cell(head, "th", text);
  const body = made.createTBody();
  let points = 0, listed = 0;
  for (const panel of chart.panels) for (const curve of panel.curves) {
    points += curve.points;
    const step = Math.max(1, Math.ceil(curve.x.length / ROWS));
    for (let at = 0; at < curve.x.length; at += step) {
      const row = body.insertRow();
      for (const text of [curve.label || chart.title, ...(several ? [panel.y] : []), shown(curve.x[at]), shown(curve.y[at])])
        cell(row, "td", text);
      listed += 1;
    }
  }
  made.createCaption().textContent = listed === points ? points + " points" :
    listed + " of " + points + " points, evenly drawn; the CSV file has more";
  const box = document.createElement("div");
  box.className = "scroll";
  box.tabIndex = 0;
  box.setAttribute("role", "region");
  box.setAttribute("aria-label", "Table of " + chart.title);
  box.append(made);
  fold.append(box);
}

const near = new IntersectionObserver(entries => {
  for (const entry of entries) if (entry.isIntersecting) { near.unobserve(entry.target); draw(entry.target); }
}, { rootMargin: "400px" });
for (const figure of charts.keys()) {
  near.observe(figure);
  const fold = figure.querySelector("details.points");
  fold.hidden = false;
  fold.addEventListener("toggle", () => { if (fold.open) table(figure, fold); });
}
for (const change of [narrow, dark])
  change.addEventListener("change", () => document.querySelectorAll("figure.drawn").forEach(draw));

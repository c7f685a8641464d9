// The trust map (TRUST, see docs/explorer.py): its error, contours, signals, and a study of a cell.
"use strict";

const $ = (id) => document.getElementById(id);
const SCHEMES = Object.keys(TRUST.runs);
const BOUNDS = [0.5, 1, 2, 5, 10, 20, 50, 100];
// viridis, from small errors (light) to large ones (dark)
const PALETTE = [
  "#fde725", "#addc30", "#5ec962", "#28ae80", "#21918c", "#2c728e", "#3b528b", "#472d7b", "#440154",
];
const COLOURS = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const colour = (k) => (k ? COLOURS[(k - 1) % COLOURS.length] : "#808080");
const KMH = 3.6;

const text = (v, digits = 3) => (v === null ? "–" : String(+v.toPrecision(digits)));
const percent = (v) => (v === null ? "–" : `${text(v, v < 1 ? 2 : 3)} %`);
const length = (v) => (v < 0.9995 ? `${text(1e3 * v)} mm` : `${text(v)} m`);
const waveText = (v) => length(v);
const amplitudeText = (v) => (v < 0.9995e-3 ? `${text(1e6 * v)} µm` : `${text(1e3 * v)} mm`);

function nearest(values, wanted, of = Math.log) {
  const off = values.map((v) => Math.abs(of(v) - of(wanted)));
  return off.indexOf(Math.min(...off));
}

// Indices of the values on both sides of the wanted one; the ends where it lies outside.
function around(values, wanted) {
  const above = values.findIndex((v) => v >= wanted * (1 - 1e-9));
  if (above <= 0) return [above === 0 ? 0 : values.length - 1];
  return values[above] <= wanted * (1 + 1e-9) ? [above] : [above - 1, above];
}

// --- what is chosen -------------------------------------------------------------------------

function chosen() {
  const wave = Math.max(+$("wavelength").value / 1e3, 1e-6);
  const amplitude = Math.max(+$("amplitude").value / 1e6, 1e-9);
  const speed = Math.max(+$("speed").value / KMH, 1e-3);
  return {
    scheme: SCHEMES.indexOf($("scheme").value), wave, amplitude, speed,
    v: nearest(TRUST.speeds, speed, (s) => s),
    a: nearest(TRUST.amplitudes, amplitude),
    w: nearest(TRUST.wavelengths, wave),
  };
}

function choose(wave, amplitude) {
  $("wavelength").value = text(1e3 * wave, 4);
  $("amplitude").value = text(1e6 * amplitude, 4);
  show();
}

// --- plots ----------------------------------------------------------------------------------

const sources = {};
function source(name, data) {
  sources[name] = new Bokeh.ColumnDataSource({ data });
  return sources[name];
}

function plot(place, options) {
  const made = Bokeh.Plotting.figure({
    sizing_mode: "stretch_width", height: 420, toolbar_location: "above", output_backend: "canvas",
    ...options,
  });
  made.toolbar.logo = null;
  return { made, place };
}

function marks(axis, values, named) {
  axis.ticker = new Bokeh.FixedTicker({ ticks: values });
  axis.major_label_overrides = new Map(values.map((v) => [v, named(v)]));
}

function round(low, high) {
  const found = [];
  for (let d = -9; d < 3; d++) {
    for (const step of [1, 3]) found.push(step * 10 ** d);
  }
  return found.filter((v) => v >= low * 0.999 && v <= high * 1.001);
}

function makeMap() {
  const [x, y] = TRUST.edges;
  const { made, place } = plot("map", {
    x_axis_type: "log", y_axis_type: "log", tools: "tap,save",
    x_range: [x[0], x[x.length - 1]], y_range: [y[0], y[y.length - 1]],
    x_axis_label: "wavelength", y_axis_label: "amplitude",
  });
  const cells = source("cells", { left: [], right: [], bottom: [], top: [], colour: [], told: [] });
  const sides = Object.fromEntries(["left", "right", "bottom", "top"].map((n) => [n, { field: n }]));
  const quads = made.quad({
    ...sides, source: cells, fill_color: { field: "colour" }, line_color: { field: "colour" },
    nonselection_fill_alpha: 1, nonselection_line_alpha: 1,
  });
  const doubtful = source("doubtful", { left: [], right: [], bottom: [], top: [] });
  made.quad({
    ...sides, source: doubtful, fill_color: null, line_color: null,
    hatch_pattern: "/", hatch_color: "#ffffff", hatch_alpha: 0.8, hatch_scale: 9, hatch_weight: 1,
  });
  const lost = source("lost", { x: [], y: [] });
  const field = { x: { field: "x" }, y: { field: "y" } };
  made.scatter(field.x, field.y, {
    source: lost, marker: "x", size: 9, line_color: "#d55e00", line_width: 2,
    nonselection_line_alpha: 1,
  });
  const xs = { field: "xs" }, ys = { field: "ys" };
  const lines = source("contours", { xs: [], ys: [] });
  made.multi_line(xs, ys, { source: lines, line_color: "#ffffff", line_width: 3.2 });
  made.multi_line(xs, ys, { source: lines, line_color: "#000000", line_width: 1.4 });
  made.text({
    ...field, text: { field: "text" }, source: source("levels", { x: [], y: [], text: [] }),
    text_font_size: "11px", text_color: "#000000", background_fill_color: "#ffffff", padding: 1,
    text_align: "center", text_baseline: "middle",
  });
  for (const [data, color, dash] of [[TRUST.limit, "#ffffff", []], [TRUST.paper, "#ffffff", [6, 3]]]) {
    const own = new Bokeh.ColumnDataSource({ data: { x: data[0], y: data[1] } });
    made.line(field.x, field.y, { source: own, line_color: "#000000", line_width: 4, line_dash: dash });
    made.line(field.x, field.y, { source: own, line_color: color, line_width: 2, line_dash: dash });
  }
  made.scatter(field.x, field.y, {
    source: source("here", { x: [], y: [] }), marker: "circle_cross", size: 15, line_width: 2,
    line_color: "#000000", fill_color: "#ffffff", fill_alpha: 0.8,
  });
  marks(made.below[0], round(x[0], x[x.length - 1]), waveText);
  marks(made.left[0], round(y[0], y[y.length - 1]), amplitudeText);
  made.add_tools(new Bokeh.HoverTool({ renderers: [quads], tooltips: "@told" }));
  for (const grid of made.center) grid.visible = false;
  made.on_event("tap", (event) => choose(event.x, event.y));
  const steps = new Bokeh.LinearColorMapper({ low: 0, high: PALETTE.length, palette: PALETTE });
  const bar = new Bokeh.ColorBar({
    color_mapper: steps, title: "error (%)", height: 12, title_text_font_style: "normal",
    ticker: new Bokeh.FixedTicker({ ticks: BOUNDS.map((_, k) => k + 1) }),
    major_label_overrides: new Map(BOUNDS.map((b, k) => [k + 1, String(b)])),
    background_fill_alpha: 0,
  });
  made.add_layout(bar, "below");
  return { made, place, bar };
}

function makeSignals() {
  const { made, place } = plot("signals", {
    height: 360, tools: "pan,wheel_zoom,box_zoom,reset,save",
    x_axis_label: "X (m)", y_axis_label: "force by the irregularity (kN)",
  });
  // the page scrolls over it
  made.toolbar.active_scroll = null;
  if (matchMedia("(pointer: coarse)").matches) made.toolbar.active_drag = null;
  const runs = [Object.keys(TRUST.reference)[0], ...SCHEMES];
  const lines = runs.map((run, k) =>
    made.line({ field: "x" }, { field: "y" }, {
      source: source(`run ${run}`, { x: [], y: [] }), visible: k === 0,
      line_color: colour(k), line_width: k ? 1.8 : 4,
    }),
  );
  made.add_tools(new Bokeh.HoverTool({ tooltips: [["X", "@x{0.0000} m"], ["force", "@y{0.000} kN"]] }));
  return { made, place, lines, runs };
}

// Dark or light as the page is.
function paint(shown) {
  const style = getComputedStyle(document.body);
  const ink = style.getPropertyValue("--color-foreground-primary").trim() || "#000";
  const paper = style.getPropertyValue("--color-background-primary").trim() || "#fff";
  for (const { made, bar } of shown) {
    made.background_fill_color = made.border_fill_color = paper;
    made.outline_line_color = ink;
    for (const axis of [made.below[0], made.left[0]]) {
      axis.axis_label_text_color = axis.major_label_text_color = ink;
      axis.axis_line_color = axis.major_tick_line_color = ink;
      axis.minor_tick_line_color = null;
    }
    for (const grid of made.center.filter((one) => one instanceof Bokeh.Grid)) {
      grid.grid_line_color = ink;
      grid.grid_line_alpha = 0.15;
    }
    if (bar) bar.title_text_color = bar.major_label_text_color = ink;
  }
}

// --- showing --------------------------------------------------------------------------------

function showMap({ scheme, v, wave, amplitude }) {
  const [x, y] = TRUST.edges;
  const cells = { left: [], right: [], bottom: [], top: [], colour: [], told: [] };
  const doubtful = { left: [], right: [], bottom: [], top: [] };
  const lost = { x: [], y: [] };
  TRUST.errors[scheme][v].forEach((row, a) =>
    row.forEach((error, w) => {
      if (error === null) return;
      const sides = { left: x[w], right: x[w + 1], bottom: y[a], top: y[a + 1] };
      const own = TRUST.own && TRUST.own[v][w];
      for (const side in sides) cells[side].push(sides[side]);
      cells.colour.push(PALETTE[BOUNDS.filter((b) => b <= error).length]);
      cells.told.push(`${length(TRUST.wavelengths[w])}, ${amplitudeText(TRUST.amplitudes[a])}: ${percent(error)}`);
      if (own && own > error / 3) for (const side in sides) doubtful[side].push(sides[side]);
      if (TRUST.lost[v][a][w]) {
        lost.x.push(TRUST.wavelengths[w]);
        lost.y.push(TRUST.amplitudes[a]);
      }
    }),
  );
  sources.cells.data = cells;
  sources.doubtful.data = doubtful;
  sources.lost.data = lost;
  const lines = { xs: [], ys: [] }, levels = { x: [], y: [], text: [] };
  for (const [level, found] of Object.entries(TRUST.contours[scheme][v])) {
    for (const [xs, ys] of found) {
      const middle = Math.floor(xs.length / 2);
      lines.xs.push(xs);
      lines.ys.push(ys);
      levels.x.push(xs[middle]);
      levels.y.push(ys[middle]);
      levels.text.push(`${+level} %`);
    }
  }
  sources.contours.data = lines;
  sources.levels.data = levels;
  sources.here.data = { x: [wave], y: [amplitude] };
}

function showSignals({ v, a, w }, plotted) {
  const found = TRUST.signals[v][a][w];
  plotted.runs.forEach((run, k) => {
    const counts = found ? found.counts[k] : [];
    sources[`run ${run}`].data = {
      x: counts.map((_, i) => found.x[0] + i * found.x[1]),
      y: counts.map((c) => (c * found.count) / 1e3),
    };
  });
}

function showText({ scheme, v, a, w, wave, amplitude, speed }) {
  const error = TRUST.errors[scheme][v][a][w], own = TRUST.own && TRUST.own[v][w];
  const name = Object.values(TRUST.runs)[scheme];
  const told = `${length(TRUST.wavelengths[w])}, ${amplitudeText(TRUST.amplitudes[a])}, ${text(KMH * TRUST.speeds[v])} km/h`;
  const outside = [[TRUST.wavelengths, wave], [TRUST.amplitudes, amplitude], [TRUST.speeds, speed]]
    .some(([all, one]) => one < all[0] * 0.999 || one > all[all.length - 1] * 1.001);
  const near = [];
  for (const i of around(TRUST.speeds, speed)) {
    for (const j of around(TRUST.amplitudes, amplitude)) {
      for (const k of around(TRUST.wavelengths, wave)) {
        if (TRUST.errors[scheme][i][j][k] !== null) near.push(TRUST.errors[scheme][i][j][k]);
      }
    }
  }
  const parts = [];
  if (error === null) {
    const why = document.createElement("span");
    why.textContent = TRUST.failures[v][a][w];
    parts.push(`Nothing is computed in the nearest cell (${told}): ${why.innerHTML || "it failed"}.`);
  } else {
    parts.push(`<b>${name}: ${percent(error)}</b> in the nearest computed cell (${told}).`);
    if (near.length > 1) {
      const [low, high] = [Math.min(...near), Math.max(...near)];
      parts.push(`The computed cells around your values have ${percent(low)} to ${percent(high)}.`);
    }
    if (own !== null) {
      const doubt = own > error / 3 ? ", more than a third of the error, which is uncertain by as much" : "";
      parts.push(`The reference's own error there is about ${percent(own)}${doubt}.`);
    }
    if (TRUST.lost[v][a][w]) parts.push("The reference loses contact there.");
  }
  if (outside) parts.push("<b>Your values lie outside the map.</b>");
  $("answer").innerHTML = parts.join(" ");
  $("cell").textContent = `${told}: the last three waves of the journey, the contact force less that of the same run on a smooth rail.`;
  $("schemes").querySelectorAll("tr[data-run]").forEach((row, k) => {
    row.classList.toggle("chosen", k - 1 === scheme);
    if (k) row.lastChild.textContent = percent(TRUST.errors[k - 1][v][a][w]);
  });
  const study = TRUST.study
    .replace("WAVELENGTH", TRUST.wavelengths[w])
    .replace("AMPLITUDE", TRUST.amplitudes[a])
    .replace("SPEED", TRUST.speeds[v]);
  $("study").textContent = study;
  $("download").href = `data:application/toml;charset=utf-8,${encodeURIComponent(study)}`;
}

// A row a run: its curve shown or not, its name, its error.
function makeTable({ runs, lines }) {
  const names = { ...TRUST.reference, ...TRUST.runs };
  const rows = runs.map((run, k) => {
    const row = document.createElement("tr");
    row.dataset.run = run;
    row.innerHTML = "<td><label><input type=checkbox><svg width=24 height=8><path d='M0 4H24'/></svg></label></td><td></td>";
    const path = row.querySelector("path");
    path.setAttribute("stroke", colour(k));
    path.setAttribute("stroke-width", k ? 2 : 4);
    row.querySelector("label").append(names[run]);
    row.lastChild.textContent = k ? "" : "reference";
    const box = row.querySelector("input");
    box.checked = lines[k].visible;
    box.addEventListener("change", () => { lines[k].visible = box.checked; });
    return row;
  });
  $("schemes").tBodies[0].replaceChildren(...rows);
}

function showCurve(run) {
  const box = $("schemes").querySelector(`tr[data-run="${run}"] input`);
  if (!box.checked) box.click();
}

function showOrigin() {
  const count = TRUST.errors[0].flat(2).filter((e) => e !== null).length;
  const all = [TRUST.wavelengths, TRUST.amplitudes, TRUST.speeds];
  const versions = Object.entries(TRUST.versions).map(([k, v]) => `${k} ${v}`).join(", ");
  const own = TRUST.own ? ` The reference's own error is the sum of its differences from finer ${TRUST.refined.join(", ")}.` : "";
  const left = TRUST.not_refined.length ? ` It is not yet computed for ${TRUST.not_refined.join(", ")}.` : "";
  $("about-map").innerHTML =
    "Black: contours of equal error. White: limit of ISO 3095; dashed: amplitude of a third octave of the " +
    "paper's Table 1. Red crosses: the reference loses contact. Hatched: the reference's own error is more " +
    "than a third of the difference. Empty: not computed, a wheel cannot follow such waves. " +
    `Click the map to choose a cell.${own}${left}`;
  $("origin").textContent =
    `Data: ${count} computed cells of a grid of ${all.map((v) => v.length).join(" × ")} ` +
    `(wavelengths ${length(all[0][0])} to ${length(all[0][all[0].length - 1])}, amplitudes ` +
    `${amplitudeText(all[1][0])} to ${amplitudeText(all[1][all[1].length - 1])}, speeds ` +
    `${all[2].map((v) => text(KMH * v)).join(", ")} km/h), computed by “${TRUST.command}” with ` +
    `${versions}; code ${TRUST.code}. Sinusoids have no seed.`;
}

let map, signals;
function show() {
  const now = chosen();
  showMap(now);
  showSignals(now, signals);
  showText(now);
}

async function start() {
  for (const [run, name] of Object.entries(TRUST.runs)) $("scheme").add(new Option(name, run));
  const middle = (values) => values[Math.floor(values.length / 2)];
  $("scheme").value = SCHEMES[0];
  $("speed").value = text(KMH * middle(TRUST.speeds), 4);
  $("wavelength").value = text(1e3 * middle(TRUST.wavelengths), 4);
  $("amplitude").value = text(1e6 * TRUST.amplitudes[0], 4);
  map = makeMap();
  signals = makeSignals();
  paint([map, signals]);
  makeTable(signals);
  showOrigin();
  show();
  showCurve($("scheme").value);
  for (const one of [map, signals]) await Bokeh.Plotting.show(one.made, `#${one.place}`);
  for (const id of ["wavelength", "amplitude", "speed"]) $(id).addEventListener("input", show);
  $("scheme").addEventListener("change", () => {
    show();
    showCurve($("scheme").value);
  });
  document.querySelector("#explorer form").addEventListener("submit", (event) => event.preventDefault());
  const repaint = () => paint([map, signals]);
  new MutationObserver(repaint).observe(document.body, { attributeFilter: ["data-theme"] });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
  $("explorer").dataset.ready = "yes";
}
start();

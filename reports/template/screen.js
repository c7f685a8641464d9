// Draws the figures of report.html from their data with BokehJS, each when it comes into view.
"use strict";

const data = JSON.parse(document.getElementById("figures").textContent);
const arrays = data.arrays.map((text) => {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Float32Array(bytes.buffer);
});
const values = (k) => Array.from(arrays[k]);
const digits = (v) => (Number.isFinite(v) ? String(+v.toPrecision(6)) : "–").replace("-", "−");
const pixels = (points) => (4 * points) / 3;

// Of a panel whose width is that of the page, with its toolbar and labels.
const height = (own) => Math.max(1.2 * own.height + 80, 230) + (own.above.length ? 30 : 0);

function axis(scale) {
  const range = new Bokeh.Range1d({ start: scale.low, end: scale.high });
  range.reset_start = scale.low;
  range.reset_end = scale.high;
  return range;
}

function ticks(axis, marks) {
  axis.ticker = new Bokeh.FixedTicker({ ticks: marks.map((mark) => mark[0]) });
  axis.major_label_overrides = new Map(marks);
}

function line(shape) {
  const dash = Array.isArray(shape.dash) ? shape.dash.map((v) => v * pixels(shape.width)) : [];
  return {
    line_color: shape.color,
    line_width: 1.2 * pixels(shape.width),
    line_dash: dash,
    line_alpha: shape.alpha ?? 1,
  };
}

function filling(shape) {
  return {
    fill_color: shape.fill,
    fill_alpha: shape.fill ? shape.alpha : 0,
    line_color: shape.color,
    line_width: pixels(shape.width),
    line_alpha: shape.color ? 1 : 0,
    ...(shape.hatch ? { hatch_pattern: "/", hatch_color: shape.color, hatch_scale: 8 } : {}),
  };
}

function mapper(colours) {
  const { palette, bounds } = colours;
  if (bounds) {
    return new Bokeh.LinearColorMapper({ low: 0, high: palette.length, palette });
  }
  const kind = colours.log ? Bokeh.LogColorMapper : Bokeh.LinearColorMapper;
  return new kind({ low: colours.low, high: colours.high, palette, nan_color: "rgba(0,0,0,0)" });
}

// Values as the mapper takes them: of steps their number.
function mapped(colours, found) {
  if (!colours.bounds) return found;
  return found.map((v) => (v === v ? colours.bounds.filter((b) => b <= v).length + 0.5 : NaN));
}

const draw = {
  line(plot, shape) {
    const source = new Bokeh.ColumnDataSource({
      data: { x: values(shape.x), y: values(shape.y) },
    });
    return plot.line({ field: "x" }, { field: "y" }, { source, ...line(shape) });
  },
  points(plot, shape) {
    const source = new Bokeh.ColumnDataSource({
      data: { x: values(shape.x), y: values(shape.y) },
    });
    return plot.scatter({ field: "x" }, { field: "y" }, {
      source, marker: shape.marker, size: 1.2 * shape.size, line_color: shape.color,
      fill_color: shape.fill, fill_alpha: shape.fill ? shape.alpha : 0, line_alpha: shape.alpha,
    });
  },
  areas(plot, shape) {
    const xs = shape.polygons.map((p) => values(p[0]));
    const ys = shape.polygons.map((p) => values(p[1]));
    const source = new Bokeh.ColumnDataSource({ data: { xs, ys } });
    return plot.patches({ field: "xs" }, { field: "ys" }, { source, ...filling(shape) });
  },
  bars(plot, shape, own) {
    const names = ["left", "right", "bottom", "top"];
    const columns = Object.fromEntries(names.map((name) => [name, values(shape[name])]));
    // on a logarithmic scale they begin below all that is seen
    if (shape.upright && own.y.logarithmic) columns.bottom.fill(own.y.low / 1e9);
    if (!shape.upright && own.x.logarithmic) columns.left.fill(own.x.low / 1e9);
    const source = new Bokeh.ColumnDataSource({ data: columns });
    const fields = Object.fromEntries(names.map((name) => [name, { field: name }]));
    return plot.quad({ ...fields, source, ...filling(shape) });
  },
  cells(plot, shape) {
    const [x, y, v] = [values(shape.x), values(shape.y), mapped(shape.colours, values(shape.values))];
    const columns = { left: [], right: [], bottom: [], top: [], v: [] };
    for (let k = 0; k < v.length; k++) {
      const [i, j] = [k % (x.length - 1), Math.floor(k / (x.length - 1))];
      if (!Number.isFinite(v[k])) continue;
      columns.left.push(x[i]);
      columns.right.push(x[i + 1]);
      columns.bottom.push(y[j]);
      columns.top.push(y[j + 1]);
      columns.v.push(v[k]);
    }
    const fields = Object.fromEntries(["left", "right", "bottom", "top"].map((n) => [n, { field: n }]));
    const color = { field: "v", transform: mapper(shape.colours) };
    const source = new Bokeh.ColumnDataSource({ data: columns });
    return plot.quad({ ...fields, source, fill_color: color, line_color: color });
  },
  image(plot, shape) {
    const [x, y] = [values(shape.x), values(shape.y)];
    const flat = mapped(shape.colours, values(shape.values));
    const rows = y.length - 1;
    const image = Bokeh.require("core/util/ndarray").ndarray(Float64Array.from(flat), {
      dtype: "float64", shape: [rows, x.length - 1],
    });
    return plot.image({
      image: [image], x: [x[0]], y: [y[0]], dw: [x[x.length - 1] - x[0]], dh: [y[rows] - y[0]],
      color_mapper: mapper(shape.colours),
    });
  },
  across(plot, shape) {
    const dimension = shape.along === "x" ? "height" : "width";
    plot.add_layout(new Bokeh.Span({ location: shape.at, dimension, ...line(shape) }));
  },
  stretch(plot, shape) {
    const ends = shape.along === "x"
      ? { left: shape.low, right: shape.high } : { bottom: shape.low, top: shape.high };
    const line_dash = shape.fill ? "solid" : "dotted";
    const own = { ...ends, ...filling(shape), line_dash, level: "underlay" };
    plot.add_layout(new Bokeh.BoxAnnotation(own));
  },
  text(plot, shape) {
    plot.add_layout(new Bokeh.Label({
      x: shape.at[0], y: shape.at[1], text: shape.text, text_color: shape.color,
      text_font_size: `${1.3 * shape.size}px`, text_align: shape.align,
      text_baseline: { center: "middle", center_baseline: "middle", baseline: "alphabetic" }[shape.baseline] ?? shape.baseline,
    }));
  },
};

function bar(plot, shape) {
  const { palette, bounds } = shape.colours;
  const made = new Bokeh.ColorBar({
    color_mapper: mapper(shape.colours), title: shape.name, title_text_font_style: "normal", width: 12,
  });
  if (bounds) {
    made.ticker = new Bokeh.FixedTicker({ ticks: bounds.map((_, k) => k + 1) });
    made.major_label_overrides = new Map(bounds.map((v, k) => [k + 1, String(v)]));
  }
  plot.add_layout(made, "right");
}

// One panel; `drawn` are the plots before it, whose ranges it may share.
function panel(own, drawn, element) {
  const range = (which) => drawn[own.shares[which === "x" ? 0 : 1]]?.[`${which}_range`] ?? axis(own[which]);
  const equal = Math.abs((own.y.high - own.y.low) / (own.x.high - own.x.low));
  const beside = own.shapes.some((shape) => shape.bar) ? 160 : 95; // labels and colour bar
  const frame = Math.min(element.clientWidth - beside, 480);
  const size = own.equal
    ? { frame_width: frame, frame_height: Math.round(frame * equal) }
    : { sizing_mode: "stretch_width", height: height(own), min_border_left: 75, min_border_right: 15 };
  const plot = Bokeh.Plotting.figure({
    tools: [], title: own.title || null, toolbar_location: "above", output_backend: "canvas",
    x_range: range("x"), y_range: range("y"), x_axis_label: own.x.label, y_axis_label: own.y.label,
    x_axis_type: own.x.logarithmic ? "log" : "linear",
    y_axis_type: own.y.logarithmic ? "log" : "linear",
    background_fill_color: null, border_fill_color: null, ...size,
  });
  const zoom = new Bokeh.BoxZoomTool();
  const pan = new Bokeh.PanTool();
  const tools = [zoom, pan, new Bokeh.WheelZoomTool(), new Bokeh.ResetTool(), new Bokeh.SaveTool()];
  const hair = new Bokeh.CrosshairTool({ dimensions: "height", line_alpha: 0.3, visible: false });
  plot.add_tools(...tools, hair);
  plot.toolbar.active_drag = matchMedia("(pointer: coarse)").matches ? null : zoom;
  plot.toolbar.active_scroll = null;
  plot.toolbar.logo = null;
  for (const axis of [...plot.below, ...plot.left]) {
    axis.axis_label_text_font_style = "normal";
    axis.axis_label_text_font_size = "12px";
  }
  for (const [scale, axis] of [[own.x, plot.below[0]], [own.y, plot.left[0]]]) {
    const few = scale.logarithmic && Math.abs(Math.log10(scale.high / scale.low)) < 2;
    if (few) axis.ticker.num_minor_ticks = 0; // between them they would be a black bar
  }
  if (own.x.ticks) ticks(plot.below[0], own.x.ticks);
  if (own.y.ticks) ticks(plot.left[0], own.y.ticks);
  if (own.above.length) {
    const kind = own.x.logarithmic ? Bokeh.LogAxis : Bokeh.LinearAxis;
    const second = new kind({ axis_label: own.above_label, axis_label_text_font_style: "normal",
      axis_label_text_font_size: "12px" });
    ticks(second, own.above);
    plot.add_layout(second, "above");
  }
  const made = own.shapes.map((shape) => draw[shape.kind](plot, shape, own));
  own.shapes.filter((shape) => shape.bar).forEach((shape) => bar(plot, shape));
  return [plot, made];
}

// Numbers of a shape at a place of the pointer, [] where it has none.
function read(shape, own, x, y) {
  const to = (v) => (own.x.logarithmic ? Math.log(v) : v);
  if (shape.kind === "line" || shape.kind === "points") {
    const [xs, ys] = [arrays[shape.x], arrays[shape.y]];
    let best = -1, least = 0.02 * Math.abs(to(own.plot.x_range.end) - to(own.plot.x_range.start));
    for (let k = 0; k < xs.length; k++) {
      const far = Math.abs(to(xs[k]) - to(x));
      if (!(ys[k] === ys[k]) || far > least) continue;
      if (far < least || Math.abs(ys[k] - y) < Math.abs(ys[best] - y)) [best, least] = [k, far];
    }
    return best < 0 ? [] : [xs[best], ys[best]];
  }
  if (shape.kind === "bars") {
    const side = shape.upright ? ["left", "right", "top"] : ["bottom", "top", "right"];
    const [low, high, end] = side.map((name) => arrays[shape[name]]);
    const at = shape.upright ? x : y;
    const k = low.findIndex((v, i) => v <= at && at <= high[i]);
    return k < 0 ? [] : [at, end[k]];
  }
  if (shape.values !== undefined) {
    const [xs, ys] = [arrays[shape.x], arrays[shape.y]];
    const place = (edges, v) => edges.findIndex((e, i) => i + 1 < edges.length && e <= v && v < edges[i + 1]);
    const [i, j] = [place(xs, x), place(ys, y)];
    const v = i < 0 || j < 0 ? NaN : arrays[shape.values][j * (xs.length - 1) + i];
    return v === v ? [x, v] : [];
  }
  return [];
}

function swatch(entry) {
  const dash = Array.isArray(entry.dash) ? entry.dash.map((v) => 1.6 * v) : [];
  const path = `<path d="M0 5H28" stroke="${entry.color}" stroke-width="2" stroke-dasharray="${dash}"/>`;
  const dot = `<circle cx="14" cy="5" r="3.5" stroke="${entry.color}" fill="${entry.fill ?? "none"}"/>`;
  return `<svg width="28" height="10">${entry.dash === "none" ? dot : path}</svg>`;
}

function show(box, figure) {
  const legend = document.createElement("div");
  const grid = document.createElement("div");
  const told = document.createElement("output");
  legend.className = "legend";
  grid.className = "panels";
  const columns = Math.max(...figure.panels.map((p) => p.place[1] + p.place[3]));
  grid.style.setProperty("--columns", columns);
  grid.classList.toggle("many", columns > 2);
  box.replaceChildren(legend, grid, told);
  const renderers = new Map();
  const [plots, elements] = [[], []];
  for (const own of figure.panels) {
    const element = document.createElement("div");
    const [row, column, rows, wide] = own.place;
    const above = figure.panels.find((p) => p.place[1] === column && p.title);
    if (columns > 1) own.title ||= above?.title ?? ""; // on a phone it is far above
    element.style.setProperty("--area", `${row + 1} / ${column + 1} / span ${rows} / span ${wide}`);
    grid.append(element);
    const [plot, made] = panel(own, plots, element);
    own.plot = plot;
    plots.push(plot);
    elements.push(element);
    own.shapes.forEach((shape, k) => {
      if (!shape.label || !made[k]) return;
      renderers.set(shape.label, [...(renderers.get(shape.label) ?? []), made[k]]);
    });
    const tell = (event) => {
      const rows = new Map();
      for (const shape of own.shapes) {
        if (shape.label && renderers.get(shape.label)?.[0].visible === false) continue;
        const [at, v] = read(shape, own, event.x, event.y);
        const name = shape.label ?? shape.name ?? own.y.label;
        if (v !== undefined && !rows.has(name)) rows.set(name, [at, v, shape.color]);
      }
      const parts = [...rows].map(([name, [at, v, color]]) => {
        const part = document.createElement("span");
        part.textContent = `${name}: ${digits(v)}`;
        part.style.borderColor = color ?? "transparent";
        part.title = `at ${digits(at)}`;
        return part;
      });
      const place = document.createElement("span");
      place.textContent = `${own.x.label || "x"}: ${digits(event.x)}`;
      if (own.shapes.some((shape) => shape.colours)) place.textContent += `, ${own.y.label || "y"}: ${digits(event.y)}`;
      told.replaceChildren(place, ...parts);
    };
    plot.on_event("mousemove", tell);
    plot.on_event("tap", tell);
  }
  for (const entry of figure.legend) {
    const own = renderers.get(entry.label);
    const button = document.createElement(own ? "button" : "span");
    button.innerHTML = swatch(entry);
    button.append(entry.label);
    if (own) {
      button.setAttribute("aria-pressed", "true");
      button.onclick = () => {
        const on = !own[0].visible;
        own.forEach((renderer) => { renderer.visible = on; });
        button.setAttribute("aria-pressed", String(on));
      };
    }
    legend.append(button);
  }
  const doc = new Bokeh.Document();
  plots.forEach((plot) => doc.add_root(plot));
  return Bokeh.embed.add_document_standalone(doc, grid, elements);
}

const watch = new IntersectionObserver((seen) => {
  for (const { target, isIntersecting } of seen) {
    if (!isIntersecting) continue;
    watch.unobserve(target);
    show(target, data.figures[target.dataset.figure]).then(() => { target.dataset.drawn = "yes"; });
  }
}, { rootMargin: "400px" });
document.querySelectorAll("[data-figure]").forEach((box) => {
  const tall = data.figures[box.dataset.figure].panels.map(height);
  box.style.minHeight = `${Math.max(...tall)}px`; // so that the page moves little when it is drawn
  watch.observe(box);
});

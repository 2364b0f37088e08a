"use strict";
// The pictures as Vega-Lite specifications. Colours are those of the style sheet, so that they follow the light or dark mode.

const COLOURS = ["var(--sky)", "var(--blue)", "var(--green)", "var(--orange)", "var(--red)"];
const NARROW = window.innerWidth < 700;
/// Between the outermost point and the end of an axis, in pixels.
const MARGIN = 8;

const CONFIG = {
  background: null,
  font: "system-ui, sans-serif",
  axis: {
    labelColor: "currentColor",
    titleColor: "currentColor",
    gridColor: "currentColor",
    gridOpacity: 0.13,
    domainColor: "currentColor",
    tickColor: "currentColor",
    domainOpacity: 0.5,
    tickOpacity: 0.5,
    labelFontSize: 12,
    titleFontSize: 12.5,
    titleFontWeight: "normal",
    titlePadding: 8,
  },
  legend: {
    labelColor: "currentColor",
    titleColor: "currentColor",
    labelFontSize: 12,
    titleFontSize: 12,
    titleFontWeight: "normal",
    orient: "top",
    direction: "horizontal",
    symbolStrokeWidth: 3,
    columns: NARROW ? 3 : 0,
  },
  text: { color: "currentColor", fontSize: 12 },
  view: { stroke: null },
};

const quantity = (field, title, more = {}) => ({
  field,
  type: "quantitative",
  title,
  axis: { tickCount: 6 },
  scale: { nice: true, zero: false, padding: MARGIN },
  ...more,
});
const shown = (field, title, format = ".4~g") => ({ field, type: "quantitative", title, format });
const within = (...domain) => ({ scale: { domain, nice: false, zero: false } });
const framed = (height, description, spec) => ({
  $schema: "https://vega.github.io/schema/vega-lite/v6.json",
  width: "container",
  height,
  description,
  autosize: { type: "fit-x", contains: "padding" },
  config: CONFIG,
  ...spec,
});

function loopsPicture(loops) {
  const amplitudes = [...new Set(loops.lines.map((row) => row.theta))];
  const amplitude = {
    field: "theta",
    type: "nominal",
    title: "amplitude U₀ / u_max",
    scale: { domain: amplitudes, range: COLOURS },
    legend: { symbolType: "stroke", symbolSize: 300 },
  };
  const picked = (yes, no) => ({ condition: { param: "picked", value: yes }, value: no });
  const axes = (force) => ({ x: quantity("u", "displacement (µm)"), y: quantity(force, "tangential force (N)") });
  return framed(
    380,
    "Friction loops, tangential force against displacement, for five amplitudes between a quarter and one and a half times the displacement " +
      "at which gross slip begins. Small amplitudes give narrow loops, the largest one is cut off at plus and minus 60 newtons. Circles of the closed form lie on the lines.",
    {
      layer: [
        {
          data: { values: [{ t: loops.limit }, { t: -loops.limit }] },
          mark: { type: "rule", strokeDash: [5, 4], color: "var(--soft)" },
          encoding: { y: { field: "t", type: "quantitative" } },
        },
        {
          data: { values: loops.lines },
          params: [{ name: "picked", select: { type: "point", fields: ["theta"] }, bind: "legend" }],
          mark: { type: "line", strokeWidth: 2.2 },
          encoding: { ...axes("t"), color: amplitude, order: { field: "n" }, opacity: picked(1, 0.12) },
        },
        {
          data: { values: loops.points },
          mark: { type: "point", filled: false, size: 34, color: "currentColor", strokeWidth: 1 },
          encoding: {
            ...axes("e"),
            opacity: picked(0.9, 0.05),
            tooltip: [shown("theta", "amplitude U₀ / u_max"), shown("u", "U (µm)"), shown("e", "T (N)")],
          },
        },
      ],
    },
  );
}

function varyingPicture(rows) {
  const picked = (yes, no) => ({ condition: { param: "phase", value: yes }, value: no });
  return framed(
    380,
    "Friction loops of one amplitude, tangential force against displacement, under a load that varies in three phases with the motion. " +
      "In phase and in anti-phase the loops are slanted against each other; a quarter cycle ahead the loop is rounded.",
    {
      data: { values: rows },
      params: [{ name: "phase", select: { type: "point", fields: ["phase"] }, bind: "legend" }],
      mark: { type: "line", strokeWidth: 2.2 },
      encoding: {
        x: quantity("u", "displacement (µm)"),
        y: quantity("t", "tangential force (N)"),
        order: { field: "n" },
        opacity: picked(1, 0.12),
        color: {
          field: "phase",
          type: "nominal",
          title: "load",
          scale: { domain: [...new Set(rows.map((row) => row.phase))], range: ["var(--blue)", "var(--orange)", "var(--green)"] },
          legend: { symbolType: "stroke", symbolSize: 300 },
        },
        tooltip: [
          shown("u", "displacement (µm)"),
          shown("t", "tangential force (N)"),
          shown("load", "normal force (N)"),
          { field: "phase", title: "load" },
        ],
      },
    },
  );
}

function lifePicture(life) {
  const stops = [...new Set(life.curves.map((row) => row.stop))];
  return framed(250, `Worn profile at six numbers of cycles: height against radius. ${life.name}.`, {
    data: { values: life.curves },
    mark: { type: "line", strokeWidth: 2 },
    encoding: {
      x: quantity("r", "radius (µm)", { scale: { nice: true, zero: true } }),
      y: quantity("h", "height (µm)", { scale: { nice: true, zero: true } }),
      order: { field: "r" },
      color: {
        field: "stop",
        type: "ordinal",
        title: "Ñ",
        scale: { domain: stops, scheme: { name: "viridis", extent: [0.2, 0.88] } },
        sort: null,
        legend: { symbolType: "stroke", symbolSize: 200, columns: NARROW ? 3 : 0 },
      },
      tooltip: [
        { field: "stop", title: "Ñ" },
        shown("r", "radius (µm)"),
        shown("h", "height (µm)"),
        shown("w", "worn depth (µm)"),
        shown("p", "pressure (GPa)"),
      ],
    },
  });
}

// The film's pictures have data sets "state" (a row) and "frame" (rows over r), which the slider fills.

/// Scalars of a frame.
const stateOf = ({ cycles, volume, stick }) => [{ cycles, volume, left: -stick, right: stick }];

/// Rows over -r ... r of a frame.
function rowsOf(frame) {
  const half = frame.r.map((r, k) => ({ r, f: frame.f[k], h: frame.h[k], p: frame.p[k] }));
  return half
    .slice(1)
    .reverse()
    .map((row) => ({ ...row, r: -row.r }))
    .concat(half);
}

const filmed = (life) => ({ datasets: { state: stateOf(life.frames[0]), frame: rowsOf(life.frames[0]) } });

const STICKS = {
  data: { name: "state" },
  mark: { type: "rect", color: "var(--band)", opacity: 0.18 },
  encoding: { x: { field: "left", type: "quantitative" }, x2: { field: "right" } },
};

function profilePicture(life) {
  const top = Math.max(...life.unworn.map((row) => row.f));
  const x = quantity("r", "radius (µm)", within(-life.reach, life.reach));
  const y = (field) => quantity(field, "height (µm)", { ...within(0, 1.04 * top), axis: { tickCount: 5 } });
  const unworn = life.unworn.flatMap((row) => [{ r: -row.r, f: row.f }, row]).sort((a, b) => a.r - b.r);
  return framed(
    260,
    `Section of the tip with an amplitude of ${life.amplitude} micrometres: height against radius, the unworn outline and what has worn away by the chosen cycle.`,
    {
      ...filmed(life),
      layer: [
        STICKS,
        {
          data: { name: "frame" },
          mark: { type: "area", color: "var(--worn)", opacity: 0.45, clip: true },
          encoding: { x, y: y("f"), y2: { field: "h" } },
        },
        {
          data: { values: unworn },
          mark: { type: "line", strokeDash: [5, 4], strokeWidth: 1.3, color: "var(--soft)", clip: true },
          encoding: { x, y: y("f") },
        },
        {
          data: { name: "frame" },
          mark: { type: "line", strokeWidth: 2.5, color: "var(--blue)", clip: true },
          encoding: { x, y: y("h"), tooltip: [shown("r", "radius (µm)"), shown("h", "height (µm)")] },
        },
        {
          data: { values: [{ r: 0, f: 0.72 * top }] },
          mark: { type: "text", text: "tip", color: "var(--soft)", fontSize: 14 },
          encoding: { x, y: y("f") },
        },
      ],
    },
  );
}

function pressurePicture(life) {
  const x = quantity("r", "radius (µm)", within(-life.reach, life.reach));
  const y = quantity("p", "pressure (GPa)", within(0, life.top));
  return framed(230, `Contact pressure against radius at the chosen cycle, amplitude of ${life.amplitude} micrometres.`, {
    ...filmed(life),
    layer: [
      STICKS,
      {
        data: { name: "frame" },
        mark: {
          type: "area",
          color: "var(--blue)",
          opacity: 0.25,
          clip: true,
          line: { color: "var(--blue)", strokeWidth: 2.2, clip: true },
        },
        encoding: { x, y, tooltip: [shown("r", "radius (µm)"), shown("p", "pressure (GPa)")] },
      },
    ],
  });
}

function volumePicture(life) {
  const axes = {
    x: quantity("cycles", "cycles (thousand)", { axis: { tickCount: 4, labelExpr: "format(datum.value / 1000, ',~g')" } }),
    y: quantity("volume", "worn volume (10⁻⁶ mm³)", { axis: { tickCount: 5 } }),
  };
  const values = life.frames.map(({ cycles, volume }) => ({ cycles, volume }));
  return framed(
    230,
    `Worn volume against cycles with an amplitude of ${life.amplitude} micrometres, and a dot at the chosen cycle.`,
    {
      ...filmed(life),
      layer: [
        { data: { values }, mark: { type: "line", strokeWidth: 2, color: "var(--soft)" }, encoding: axes },
        {
          data: { name: "state" },
          mark: { type: "point", filled: true, size: 110, color: "var(--blue)", opacity: 1 },
          encoding: { ...axes, tooltip: [shown("cycles", "cycles", ",.0f"), shown("volume", "volume (10⁻⁶ mm³)")] },
        },
      ],
    },
  );
}

function mapPicture(map) {
  const volumes = map.fields.map((row) => row.v).sort((a, b) => a - b);
  const edge = (key, pick) => pick(...map.fields.map((row) => row[key]));
  const loads = [edge("n1", Math.min), edge("n2", Math.max)],
    amplitudes = [edge("u1", Math.min), edge("u2", Math.max)];
  const log = (domain) => ({ type: "log", domain, nice: false });
  const x = (field) => ({
    field,
    type: "quantitative",
    title: "displacement amplitude (µm)",
    scale: log(amplitudes),
    axis: { values: [0.1, 0.2, 0.5, 1, 2, 5], format: "~g", grid: false },
  });
  const y = (field) => ({
    field,
    type: "quantitative",
    title: "normal force (N)",
    scale: log(loads),
    axis: { values: [10, 20, 50, 100, 200], format: "~g", grid: false },
  });
  const place = { x: x("u"), y: y("n") };
  const middle = (rows, key) => Math.exp(rows.reduce((sum, row) => sum + Math.log(row[key]), 0) / rows.length);
  const names = [...new Set(map.fields.map((row) => row.regime))].map((regime) => {
    const rows = map.fields.filter((row) => row.regime === regime);
    return { regime, u: middle(rows, "u"), n: middle(rows, "n") };
  });
  return framed(
    380,
    "Fretting map: normal force against displacement amplitude, both logarithmic. Two parallel lines rise from left to right between stick, " +
      "partial slip and gross slip. The worn volume grows from left to right by five orders of magnitude, fastest on the way into gross slip.",
    {
      layer: [
        {
          data: { values: map.fields },
          mark: { type: "rect", strokeWidth: 0 },
          encoding: {
            x: x("u1"),
            x2: { field: "u2" },
            y: y("n1"),
            y2: { field: "n2" },
            color: {
              field: "v",
              type: "quantitative",
              title: "worn volume (10⁻⁶ mm³)",
              scale: {
                type: "log",
                scheme: "viridis",
                domain: [volumes[Math.floor(0.02 * volumes.length)], volumes.at(-1)],
                clamp: true,
                nice: false,
              },
              legend: { gradientLength: 240, gradientThickness: 12, tickCount: 4, format: ",~g" },
            },
            tooltip: [
              { field: "regime", title: "first cycle" },
              shown("n", "load (N)"),
              shown("u", "amplitude (µm)"),
              shown("v", "worn volume (10⁻⁶ mm³)"),
              shown("d", "wear depth (µm)"),
            ],
          },
        },
        {
          data: { values: map.bounds },
          mark: { type: "line", color: "white", strokeWidth: 4, opacity: 0.75 },
          encoding: { ...place, detail: { field: "line" } },
        },
        {
          data: { values: map.bounds },
          mark: { type: "line", color: "#111", strokeWidth: 1.6 },
          encoding: {
            ...place,
            strokeDash: {
              field: "line",
              type: "nominal",
              scale: {
                domain: ["5 % of the radius slips", "gross slip"],
                range: [
                  [5, 4],
                  [1, 0],
                ],
              },
              legend: null,
            },
          },
        },
        ...[{ stroke: "white", strokeWidth: 5, strokeJoin: "round" }, {}].map((halo) => ({
          data: { values: names },
          mark: { type: "text", fontSize: 14, fontWeight: 600, color: "#111", ...halo },
          encoding: { ...place, text: { field: "regime" } },
        })),
      ],
    },
  );
}

function swingPicture(mass) {
  const x = quantity("t", "time (s)");
  const y = (field) => quantity(field, "displacement (µm)");
  return framed(250, "Range of the unit's displacement against time: it grows to about three times its first value.", {
    data: { values: mass.swing },
    layer: [
      { mark: { type: "area", color: "var(--blue)", opacity: 0.3 }, encoding: { x, y: y("low"), y2: { field: "high" } } },
      ...["low", "high"].map((field) => ({
        mark: { type: "line", color: "var(--blue)", strokeWidth: 2 },
        encoding: {
          x,
          y: y(field),
          tooltip: [
            shown("t", "time (s)"),
            shown("high", "to (µm)"),
            shown("low", "from (µm)"),
            shown("load", "normal force (N)"),
          ],
        },
      })),
    ],
  });
}

function jointPicture(mass) {
  return framed(
    250,
    "Force of the joint against displacement over one period at five times: narrow slanting loops become wide flat ones.",
    {
      data: { values: mass.loops },
      mark: { type: "line", strokeWidth: 2.2 },
      encoding: {
        x: quantity("u", "displacement (µm)"),
        y: quantity("t", "tangential force (N)"),
        order: { field: "n" },
        color: {
          field: "after",
          type: "ordinal",
          title: "after",
          scale: { range: COLOURS },
          legend: { symbolType: "stroke", symbolSize: 300 },
        },
      },
    },
  );
}

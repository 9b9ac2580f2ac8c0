"use strict";
// The map of lengths: an image of one length over the theory's, and a slice at the chosen weakening.
const WEAKENINGS = [0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4, 6, 8, 10, 15, 20, 30, 50]; // that axes name

function makeMap({ height, weakening, theory, fields, ratios }) {
  const pick = element("map-weakening");
  pick.max = weakening.length - 1;
  pick.value = Math.floor(weakening.length / 2);

  // Plotly draws the same arrays again without looking for their range: axes get theirs from here.
  const lengths = [theory, ...fields.map((one) => one.length)].flat(2).filter((length) => length !== null);
  const seen = [0.9 * Math.min(...lengths), 1.1 * Math.max(...lengths)].map(Math.log10);

  // The logarithms of the ends of an axis, half a cell beyond the values.
  function ends(values) {
    const [low, high] = [values[0], values[values.length - 1]].map(Math.log10);
    const half = values.length > 1 ? (0.5 * (high - low)) / (values.length - 1) : 0.1;
    return [low - half, high + half];
  }

  const field = () => fields[Number(element("map-field").value)];
  const over = (lengths) => lengths.map((row, j) => row.map((length, i) =>
    (length === null || theory[j][i] === null ? null : length / theory[j][i])));

  function drawImage() {
    const ratio = over(field().length);
    const j = Number(pick.value);
    const words = theory.map((row, k) => row.map((length, i) => {
      const own = field().length[k][i];
      return `H = ${height[i].toPrecision(3)} m, ζ/a = ${weakening[k].toPrecision(3)}<br>`
        + `theory ${length === null ? "none" : `${length.toPrecision(3)} m`}<br>`
        + (own === null ? "no event" : `${own.toPrecision(3)} m, ${ratio[k][i].toPrecision(3)} of it`);
    }));
    const image = {
      type: "heatmap", x: height, y: weakening, z: ratio, text: words, hovertemplate: "%{text}<extra></extra>",
      zmin: ratios[0], zmax: ratios[1], colorscale: "Viridis", colorbar: { thickness: 12, outlinewidth: 0 },
    };
    const chosen = {
      x: [height[0], height[height.length - 1]], y: [weakening[j], weakening[j]], mode: "lines",
      line: { color: colour("ink"), width: 1.5, dash: "dot" }, hoverinfo: "skip", showlegend: false,
    };
    Plotly.react("map-image", [image, chosen], layout({
      title: heading("Weakening ζ/a; colours: length over theory"),
      plot_bgcolor: colour("line"), // what is seen where there is no length
      xaxis: axis("Block height H (m)", { type: "log", dtick: "D2", range: ends(height) }),
      yaxis: axis("", { type: "log", tickvals: WEAKENINGS, range: ends(weakening) }),
    }), SETTINGS);
  }

  function drawSlice() {
    const j = Number(pick.value);
    element("map-chosen").textContent = weakening[j].toPrecision(3);
    pick.setAttribute("aria-valuetext", weakening[j].toPrecision(3));
    const symbols = ["circle-open", "circle", "square", "triangle-up", "diamond"];
    const colours = ["ink", "mark", "field-2", "field-3"];
    const traces = [
      {
        name: "theory", x: height, y: theory[j], mode: "lines", line: { color: colour("theory"), width: 2 },
        hovertemplate: "H = %{x:.3g} m<br>theory %{y:.3g} m<extra></extra>",
      },
      ...fields.map((one, i) => ({
        name: one.label, x: height, y: one.length[j], mode: "markers",
        marker: { symbol: symbols[i % symbols.length], size: 7, color: colour(colours[i % colours.length]) },
        hovertemplate: "H = %{x:.3g} m<br>%{y:.3g} m<extra></extra>",
      })),
    ];
    Plotly.react("map-slice", traces, layout({
      title: heading(`Length (m) at ζ/a = ${weakening[j].toPrecision(3)}`),
      xaxis: axis("Block height H (m)", { type: "log", dtick: "D2", range: ends(height) }),
      yaxis: axis("", { type: "log", dtick: "D2", range: seen }),
      legend: legend(),
    }), SETTINGS);
  }

  function draw() {
    drawImage();
    drawSlice();
  }

  element("map-form").addEventListener("submit", (event) => event.preventDefault());
  element("map-field").addEventListener("change", draw);
  pick.addEventListener("input", draw);
  draw();
  element("map-image").on("plotly_click", ({ points }) => {
    const j = weakening.indexOf(points[0].y);
    if (j >= 0) {
      pick.value = j;
      draw();
    }
  });
  redrawn.push(draw);
}

if (data.map) makeMap(data.map);

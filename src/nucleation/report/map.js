"use strict";
// The map of lengths: an image of one length over the theory's, and a slice at the chosen weakening.
function makeMap({ height, weakening, theory, fields, ratios }) {
  const pick = element("map-weakening");
  pick.max = weakening.length - 1;
  pick.value = Math.floor(weakening.length / 2);

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
      line: { color: colour("ink"), width: 1, dash: "dot" }, hoverinfo: "skip", showlegend: false,
    };
    Plotly.react("map-image", [image, chosen], layout({
      title: heading("Length over the theory's"),
      xaxis: axis("Block height H (m)", { type: "log" }),
      yaxis: axis("Weakening ζ/a", { type: "log" }),
    }), SETTINGS);
  }

  function drawSlice() {
    const j = Number(pick.value);
    element("map-chosen").textContent = weakening[j].toPrecision(3);
    const symbols = ["circle-open", "circle", "square", "triangle-up", "diamond"];
    const traces = [
      { name: "theory", x: height, y: theory[j], mode: "lines", line: { color: colour("theory"), width: 2 } },
      ...fields.map((one, i) => ({
        name: one.label, x: height, y: one.length[j], mode: "markers",
        marker: { symbol: symbols[i % symbols.length], size: 7, color: colour(i ? "mark" : "ink") },
      })),
    ];
    Plotly.react("map-slice", traces, layout({
      title: heading(`Lengths at ζ/a = ${weakening[j].toPrecision(3)}`),
      xaxis: axis("Block height H (m)", { type: "log" }),
      yaxis: axis("Length (m)", { type: "log" }),
      legend: {
        orientation: "h", x: 0, xref: "container", y: 0, yref: "container", yanchor: "bottom",
        font: { size: 12 },
      },
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

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/eval/detail/report_style.hpp"

namespace waylode::eval::detail {

// The method colours follow [OkabeIto2008], told apart with any colour vision; beyond four methods
// dashes help.
std::string_view report_style() {
  return R"css(
:root {
  color-scheme: light dark;
  --bg: #f7f8fa; --card: #ffffff; --fg: #1b2330; --dim: #5d6878; --line: #dfe3ea; --grid: #edf0f4;
  --guide: #8a94a3; --best: #e3f1ea; --best-fg: #0b5c3f; --accent: #1f5fa8;
  --void: #eef0f4; --walkable: #fbfcfd; --obstacle: #e2e5ea; --room: #c9ced7; --wall: #98a1ae;
  --m0: #0072b2; --m1: #d55e00; --m2: #009e73; --m3: #b5579a; --m4: #b98000; --m5: #3a9fd8;
  --m6: #7a5230; --m7: #5b6470;
}
@media (prefers-color-scheme: dark) {
  :root {
    --bg: #12161c; --card: #1a2029; --fg: #e4e8ee; --dim: #97a2b2; --line: #303946; --grid: #252d38;
    --guide: #6d7889; --best: #17382c; --best-fg: #8fe0bd; --accent: #7db8f0;
    --void: #151a21; --walkable: #212935; --obstacle: #2f3947; --room: #44505f; --wall: #66727f;
    --m0: #56a8e8; --m1: #ff8b45; --m2: #2ec79a; --m3: #e29bc9; --m4: #f0b83c; --m5: #9ad6f7;
    --m6: #c99b6c; --m7: #aab4c0;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--fg);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif; }
main { max-width: 1280px; margin: 0 auto; padding: 28px 24px 56px; }
h1 { font-size: 27px; line-height: 1.2; margin: 0 0 6px; letter-spacing: -0.01em; }
h2 { font-size: 18px; margin: 36px 0 10px; }
h3 { font-size: 15px; margin: 0 0 8px; }
p { margin: 0 0 10px; max-width: 78ch; }
.dim, .note { color: var(--dim); }
.note { font-size: 13.5px; }
.command { font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace;
  background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 8px 12px;
  margin: 12px 0 0; white-space: pre-wrap; overflow-wrap: anywhere; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 12px;
  margin: 20px 0 4px; }
.tile, .card, figure.track { background: var(--card); border: 1px solid var(--line);
  border-radius: 10px; }
.tile { padding: 12px 16px; }
.tile b { display: block; font-size: 24px; line-height: 1.25; font-weight: 650;
  font-variant-numeric: tabular-nums; }
.tile span { color: var(--dim); font-size: 13px; }
.lead { margin: 14px 0 0; font-size: 16px; }
.legend { position: sticky; top: 0; z-index: 2; display: flex; flex-wrap: wrap; gap: 6px 18px;
  background: var(--bg); border-bottom: 1px solid var(--line); padding: 9px 0; margin-top: 28px; }
.legend label { display: inline-flex; align-items: center; gap: 6px; cursor: pointer; }
.legend input { margin: 0; accent-color: var(--accent); }
.scroll { overflow-x: auto; background: var(--card); border: 1px solid var(--line);
  border-radius: 10px; }
table { border-collapse: collapse; width: 100%; font-size: 13px;
  font-variant-numeric: tabular-nums; }
th, td { padding: 7px; text-align: right; white-space: nowrap; vertical-align: top;
  border-bottom: 1px solid var(--grid); }
th:first-child { padding-left: 14px; }
th:last-child, td:last-child { padding-right: 14px; }
tbody tr:last-child > * { border-bottom: 0; }
thead th { color: var(--dim); font-weight: 600; font-size: 12px; vertical-align: bottom;
  white-space: normal; border-bottom: 1px solid var(--line); line-height: 1.3; }
thead th[title] { cursor: help; }
thead th .swatch { vertical-align: 0; }
.groups th, .groups td { white-space: nowrap; }
.name { text-align: left; position: sticky; left: 0; background: var(--card); font-weight: 600; }
.unit, .small { display: block; font-weight: 400; font-size: 11.5px; color: var(--dim); }
.best { font-weight: 700; color: var(--best-fg); background: var(--best); }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 480px), 1fr));
  gap: 16px; }
.card { padding: 14px 16px 10px; min-width: 0; }
.tracks { display: grid; gap: 16px;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 360px), 1fr));
  grid-auto-flow: dense; align-items: start; }
figure.track { margin: 0; overflow: hidden; }
.floors { display: flex; flex-wrap: wrap; }
.floors svg { flex: 1 1 300px; min-width: 0; }
.floors svg + svg { box-shadow: -1px 0 0 var(--line); }
@media (min-width: 860px) { figure.wide { grid-column: span 2; } }
figcaption { padding: 9px 14px 12px; font-size: 13.5px; overflow-wrap: anywhere; }
.pair { white-space: nowrap; margin: 0 10px 0 4px; }
svg { display: block; width: 100%; height: auto; font-size: 12px; }
svg.definitions { position: absolute; width: 0; height: 0; }
.c0 { --c: var(--m0); } .c1 { --c: var(--m1); } .c2 { --c: var(--m2); } .c3 { --c: var(--m3); }
.c4 { --c: var(--m4); } .c5 { --c: var(--m5); } .c6 { --c: var(--m6); } .c7 { --c: var(--m7); }
.k1 { --d: 7 3; } .k2 { --d: 2 3; }
.swatch { display: inline-block; width: 11px; height: 11px; border-radius: 3px; margin-right: 6px;
  background: var(--c); vertical-align: -0.5px; }
.off { display: none; }
text { fill: var(--dim); } .mid { text-anchor: middle; } .end { text-anchor: end; }
.label { font-size: 12.5px; } .guidelabel { font-size: 11px; }
.grid { stroke: var(--grid); } .axis { stroke: var(--guide); }
.guide { stroke: var(--guide); stroke-dasharray: 4 4; }
.cursor { stroke: var(--fg); opacity: 0; pointer-events: none; } .cursor.on { opacity: 0.45; }
.line { fill: none; stroke: var(--c); stroke-width: 2; stroke-linejoin: round;
  stroke-dasharray: var(--d, none); }
.dots { fill: none; stroke: var(--c); stroke-width: 6.5; stroke-linecap: round; }
svg.plan { background: var(--void); border-bottom: 1px solid var(--line); }
.floor path { vector-effect: non-scaling-stroke; fill-rule: evenodd; }
.walkable { fill: var(--walkable); stroke: var(--room); stroke-width: 1; }
.obstacle { fill: var(--obstacle); stroke: var(--room); stroke-width: 1; }
.room { fill: none; stroke: var(--room); stroke-width: 1; }
.wall { fill: none; stroke: var(--wall); stroke-width: 1.4; }
.truthline { fill: none; stroke: var(--fg); stroke-width: 1.6; opacity: 0.75; }
.waypoint { fill: none; stroke: var(--fg); stroke-width: 5; stroke-linecap: round; }
.waypoint.before { opacity: 0.4; }
.startring { stroke: var(--fg); stroke-width: 13; stroke-linecap: round; }
.startdisc { stroke: var(--walkable); stroke-width: 9.5; stroke-linecap: round; }
.ellipse { fill: var(--c); fill-opacity: 0.06; stroke: var(--c); stroke-opacity: 0.4; }
.errorline { fill: none; stroke: var(--c); stroke-width: 0.9; opacity: 0.75;
  stroke-dasharray: 2 2; }
.fixline { fill: none; stroke: var(--c); stroke-width: 1.6; opacity: 0.65;
  stroke-dasharray: var(--d, none); }
.cross { fill: none; stroke: var(--c); stroke-width: 1.8; }
.scalebar { fill: none; stroke: var(--fg); stroke-width: 1.5; }
.plan text { fill: var(--fg); paint-order: stroke; stroke: var(--void); stroke-width: 3px;
  stroke-linejoin: round; }
.readout { position: fixed; z-index: 3; pointer-events: none; background: var(--card);
  color: var(--fg); border: 1px solid var(--line); border-radius: 8px; padding: 6px 10px;
  font-size: 12.5px; font-variant-numeric: tabular-nums;
  box-shadow: 0 3px 12px rgb(0 0 0 / 0.18); }
details { margin-top: 10px; } summary { cursor: pointer; color: var(--accent); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 4px 16px; font-size: 13.5px; }
dt { font-weight: 600; } dd { margin: 0; color: var(--dim); }
@media (max-width: 600px) { main { padding: 18px 14px 40px; } dl { display: block; } }
@media print { .legend { position: static; } .card, figure.track { break-inside: avoid; } }
)css";
}

std::string_view report_script() {
  return R"js(
(function () {
  "use strict";
  document.querySelectorAll("input[data-toggle]").forEach(function (box) {
    function show() {
      document.querySelectorAll('[data-m="' + box.dataset.toggle + '"]').forEach(function (part) {
        part.classList.toggle("off", !box.checked);
      });
    }
    box.disabled = false;
    box.addEventListener("change", show);
    show();
  });

  var readout = document.createElement("div");
  readout.className = "readout off";
  document.body.appendChild(readout);

  function heightAt(line, x) {
    var points = line.points;
    for (var i = 1; i !== points.numberOfItems; i += 1) {
      var a = points.getItem(i - 1), b = points.getItem(i);
      if (x >= a.x && b.x >= x) {
        return b.x === a.x ? b.y : a.y + ((b.y - a.y) * (x - a.x)) / (b.x - a.x);
      }
    }
    return null;
  }

  function addLine(text, colour) {
    var row = document.createElement("div");
    if (colour) {
      var swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.style.background = colour;
      row.appendChild(swatch);
    }
    row.appendChild(document.createTextNode(text));
    readout.appendChild(row);
  }

  document.querySelectorAll("svg.chart").forEach(function (chart) {
    var d = chart.dataset, cursor = chart.querySelector(".cursor");
    function hide() {
      readout.classList.add("off");
      cursor.classList.remove("on");
    }
    chart.addEventListener("pointerleave", hide);
    chart.addEventListener("pointermove", function (event) {
      var box = chart.getBoundingClientRect();
      var x = ((event.clientX - box.left) * chart.viewBox.baseVal.width) / box.width;
      if (d.x0 - x > 0 || x - d.x1 > 0) { hide(); return; }
      cursor.setAttribute("x1", x);
      cursor.setAttribute("x2", x);
      cursor.classList.add("on");
      readout.textContent = "";
      addLine((+d.xmin + ((x - d.x0) / (d.x1 - d.x0)) * (d.xmax - d.xmin)).toFixed(1) + " " + d.xunit);
      chart.querySelectorAll("g[data-m]:not(.off)").forEach(function (series) {
        var line = series.querySelector("polyline"), y = line === null ? null : heightAt(line, x);
        if (y === null) { return; }
        var value = +d.ymin + ((y - d.y0) / (d.y1 - d.y0)) * (d.ymax - d.ymin);
        addLine(series.dataset.name + " " + value.toFixed(1) + " " + d.yunit,
                getComputedStyle(line).stroke);
      });
      readout.classList.remove("off");
      readout.style.left =
          Math.min(event.clientX + 16, window.innerWidth - readout.offsetWidth - 8) + "px";
      readout.style.top = event.clientY + 16 + "px";
    });
  });
})();
)js";
}

}  // namespace waylode::eval::detail

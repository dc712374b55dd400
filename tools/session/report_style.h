#pragma once

namespace sparsight {

// The style sheet of report.html. Inks are the names that chart series use.
inline constexpr const char* kReportStyle = R"css(
:root { color-scheme: light dark; --page: #ffffff; --panel: #f6f7f9; --text: #1d2430; --quiet: #667085;
  --grid: #e3e6eb; --axis: #98a1af; --estimate: #2563eb; --truth: #16a34a; --keyframe: #ea8a0c;
  --fault: #dc2626; }
@media (prefers-color-scheme: dark) { :root { --page: #14171c; --panel: #1c2027; --text: #e6e9ee;
  --quiet: #98a2b3; --grid: #2b313b; --axis: #5b6575; --estimate: #6ea0ff; --truth: #4ade80;
  --keyframe: #fbb040; --fault: #f87171; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1000px; padding: 24px 20px 48px; background: var(--page);
  color: var(--text); font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
h1 { margin: 0; font-size: 26px; } h2 { margin: 36px 0 12px; font-size: 18px; }
p { margin: 4px 0; color: var(--quiet); overflow-wrap: anywhere; }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(148px, 1fr)); gap: 10px;
  margin: 18px 0; }
.figures div { background: var(--panel); border-radius: 8px; padding: 10px 12px; }
.figures b { display: block; font-size: 21px; font-weight: 600; white-space: nowrap; }
.figures span { color: var(--quiet); font-size: 13px; }
.note { border-left: 3px solid var(--keyframe); padding-left: 10px; }
figure { margin: 0 0 22px; background: var(--panel); border-radius: 8px; padding: 12px 12px 6px; }
figcaption { display: flex; flex-wrap: wrap; gap: 2px 18px; margin: 0 4px 6px; font-size: 13px;
  color: var(--quiet); }
figcaption b { color: var(--text); font-size: 14px; }
figcaption span { white-space: nowrap; }
figure > svg { display: block; width: 100%; height: auto; }
.sample { width: 18px; height: 12px; margin-right: 6px; vertical-align: -1px; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(340px, 1fr)); gap: 0 16px; }
text { fill: var(--quiet); font-size: 12px; font-variant-numeric: tabular-nums; }
.below { text-anchor: middle; } .before { text-anchor: end; }
line.grid { stroke: var(--grid); } line.axis { stroke: var(--axis); }
.stroke { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
.dots { fill: none; stroke-width: 4.5; stroke-linecap: round; }
.stroke.estimate, .dots.estimate { stroke: var(--estimate); }
.stroke.truth, .dots.truth { stroke: var(--truth); }
.stroke.truth { stroke-width: 3.2; opacity: 0.65; }
.stroke.keyframe, .dots.keyframe { stroke: var(--keyframe); }
.stroke.fault, .dots.fault { stroke: var(--fault); }
.dots.loop { stroke: var(--truth); stroke-width: 5; }
.dots.keyframe { stroke-width: 3.4; }
.dots.lost { stroke: var(--fault); stroke-width: 8; }
.stroke.apart { stroke: var(--keyframe); }
.dots.start { stroke: var(--text); stroke-width: 9; }
.stroke.dashed { stroke: var(--text); stroke-dasharray: 6 4; stroke-width: 1.2; }
.stroke.dotted { stroke: var(--fault); stroke-dasharray: 2 3; stroke-width: 1.4; }
.bar.estimate { fill: var(--estimate); }
table { border-collapse: collapse; width: 100%; font-size: 14px; }
th, td { text-align: left; padding: 5px 10px 5px 0; border-bottom: 1px solid var(--grid);
  vertical-align: top; overflow-wrap: anywhere; }
td:first-child, th:first-child { white-space: nowrap; }
pre { background: var(--panel); border-radius: 8px; padding: 12px; overflow-x: auto; font-size: 13px; }
summary { cursor: pointer; margin-top: 24px; }
footer { margin-top: 36px; color: var(--quiet); font-size: 13px; }
)css";

}  // namespace sparsight

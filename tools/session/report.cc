#include "tools/session/report.h"

#include <fmt/format.h>

#include "tools/configuration/profile.h"
#include "tools/session/report_charts.h"
#include "tools/session/report_style.h"
#include "tools/session/session_folder.h"
#include "tools/session/svg_chart.h"

namespace sparsight {
namespace {

std::string card(const std::string& value, const std::string& name) {
  return fmt::format("<div><b>{}</b><span>{}</span></div>\n", value, name);
}

std::string accuracy_cards(const Evaluation& evaluation) {
  std::string cards;
  if (evaluation.kitti.t_rel_percent) {
    cards += card(fmt::format("{:.2f} %", *evaluation.kitti.t_rel_percent), "t_rel, translation");
  }
  if (evaluation.kitti.r_rel_deg_per_m) {
    cards += card(fmt::format("{:.4f} °/m", *evaluation.kitti.r_rel_deg_per_m), "r_rel, rotation");
  }
  return cards + card(fmt::format("{:.3f} m", evaluation.ate.rmse_m), "ATE, rmse");
}

std::string cards_of(const Session& session, const SessionSummary& summary) {
  std::string cards = card(fmt::format("{:.1f} m", summary.path_length_m), "path length");
  cards += card(fmt::format("{:.1f} s", summary.recorded_s), "recorded");
  if (session.truth) cards += accuracy_cards(session.truth->evaluation);
  cards += card(fmt::format("{} of {}", summary.tracked, summary.frames), "frames tracked");
  cards += card(fmt::format("{}", summary.predicted), "predicted only");
  if (summary.lost > 0) cards += card(fmt::format("{}", summary.lost), "lost");
  cards += card(fmt::format("{}", summary.keyframes), "keyframes");
  cards += card(fmt::format("{:.2f} ms", summary.tracking.median_ms), "tracking, median");
  cards += card(fmt::format("{:.2f} ms", summary.tracking.p99_ms), "tracking, p99");
  cards += card(fmt::format("{:.1f} ×", summary.realtime_factor), "real time");
  cards += card(fmt::format("{:.1f}", summary.frames_per_s), "frames per second");
  return fmt::format("<div class=\"figures\">\n{}</div>\n", cards);
}

std::string heading_of(const Session& session) {
  const SessionDescription& description = session.description;
  const std::string rays =
      description.rays ? fmt::format("{} rays", *description.rays) : "all rays";
  std::string heading =
      fmt::format("<h1>{}</h1>\n<p>profile {}, {}, camera {} ({} × {})</p>\n<p>{}</p>\n",
                  escaped(source_name(description.source)), escaped(description.profile_name), rays,
                  description.camera, description.calibration.camera.width,
                  description.calibration.camera.height, escaped(description.source.string()));
  if (session.truth) {
    heading += fmt::format("<p>ground truth {}</p>\n", escaped(session.truth->file.string()));
  }
  if (session.broke_off) {
    heading += fmt::format("<p class=\"note\">Not complete: {}</p>\n", escaped(*session.broke_off));
  }
  for (const std::string& note : session.notes) {
    heading += fmt::format("<p class=\"note\">{}</p>\n", escaped(note));
  }
  return heading;
}

std::string accuracy_section(const GroundTruth& truth) {
  std::string section = "<h2>Drift</h2>\n";
  for (const std::string& note : truth.evaluation.notes) {
    section += fmt::format("<p class=\"note\">{}</p>\n", escaped(note));
  }
  if (!truth.evaluation.kitti.per_length.empty()) {
    section += "<div class=\"pair\">\n";
    for (const Chart& chart : segment_charts(truth.evaluation)) section += figure_of(chart);
    section += "</div>\n";
  }
  return section + figure_of(position_error_chart(truth));
}

std::string fault_section(const FaultLog& faults) {
  if (faults.count() == 0) return "<h2>Faults</h2>\n<p>None.</p>\n";
  std::string rows = "<tr><th>frame</th><th>kind</th><th>fault</th></tr>\n";
  for (const FaultLog::Entry& entry : faults.entries()) {
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", entry.sequence,
                        name_of(entry.error.code), escaped(entry.error.message));
  }
  const std::size_t more = faults.count() - faults.entries().size();
  return fmt::format("<h2>Faults: {}</h2>\n<table>\n{}</table>\n{}", faults.count(), rows,
                     more == 0 ? "" : fmt::format("<p>and {} more</p>\n", more));
}

}  // namespace

std::string report_html(const Session& session, const SessionSummary& summary) {
  std::string page = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{} · Sparsight</title>\n<style>{}</style>\n</head>\n<body>\n",
      escaped(source_name(session.description.source)), kReportStyle);
  page += heading_of(session) + cards_of(session, summary);
  page += "<h2>Path</h2>\n" + figure_of(path_chart(session)) + figure_of(height_chart(session));
  if (session.truth) page += accuracy_section(*session.truth);
  page += "<h2>Speed</h2>\n" + figure_of(tracking_time_chart(session, summary)) +
          figure_of(window_time_chart(session, summary));
  page += "<h2>Tracking</h2>\n" + figure_of(points_chart(session)) +
          figure_of(sigma_chart(session)) + figure_of(visibility_chart(session)) +
          figure_of(attempts_chart(session));
  page += fault_section(session.faults);
  page += fmt::format("<details><summary>Profile</summary><pre>{}</pre></details>\n",
                      escaped(describe_profile(session.description.config)));
  return page + "<footer>Sparsight " SPARSIGHT_VERSION "</footer>\n</body>\n</html>\n";
}

}  // namespace sparsight

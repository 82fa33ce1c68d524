#include "convergence_report.hpp"

#include "common/measure.hpp"
#include "mesh/describe.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;

/// A difference over the size of what differs.
double relative(double value, const QuantityResult& quantity) {
  return quantity.size > 0 ? value / quantity.size : 0;
}

std::string seconds_or_dash(const std::optional<double>& seconds) {
  return seconds ? rounded_text(*seconds, 3) + " s" : "-";
}

/// One column of the table, as wide as its widest cell.
void append_column(std::vector<std::string>& lines, std::vector<std::string> cells, bool left) {
  std::size_t width = 0;
  for (const std::string& cell : cells) width = std::max(width, cell.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string room(width - cells[i].size(), ' ');
    lines[i] += (lines[i].empty() ? "" : "  ") + (left ? cells[i] + room : room + cells[i]);
  }
}

/// A run in a table, with what varies beside it.
struct Row {
  std::string group;
  std::size_t run;
};

std::vector<Row> rows_of(const StudyReport& report) {
  std::vector<Row> rows;
  const auto add = [&](const char* name, const std::optional<SeriesResult>& series) {
    if (!series) return;
    for (std::size_t run : series->runs)
      rows.push_back({std::string(name) + (run == 0 ? " (scene)" : ""), run});
  };
  add("mesh", report.result.all.position.mesh);
  add("time step", report.result.all.position.time);
  const StudyLevel& last = report.runs.back().level;
  if (last.mesh != 0 && last.time != 0) rows.push_back({"both", report.runs.size() - 1});
  return rows;
}

std::string table_text(const StudyReport& report) {
  const std::vector<Row> rows = rows_of(report);
  std::vector<std::string> lines(rows.size() + 1);
  const auto add = [&](const char* name, bool left, const auto& cell) {
    std::vector<std::string> cells = {name};
    for (const Row& row : rows) cells.push_back(cell(row));
    append_column(lines, std::move(cells), left);
  };
  add("varied", true, [](const Row& row) { return row.group; });
  add("nodes", false, [&](const Row& row) { return to_text(report.runs[row.run].nodes); });
  add("step [s]", false, [&](const Row& row) { return to_text(report.runs[row.run].time_step); });
  add("precomputed", false,
      [&](const Row& row) { return seconds_or_dash(report.costs[row.run].precompute_seconds); });
  add("simulated", false,
      [&](const Row& row) { return seconds_or_dash(report.costs[row.run].simulation_seconds); });
  add("archives", false,
      [&](const Row& row) { return bytes_text(report.costs[row.run].archive_bytes); });
  const MotionResult& all = report.result.all;
  for (const auto& [quantity, difference, error] :
       {std::tuple(&all.position, "positions differ", "error"),
        std::tuple(&all.deformation, "deformations differ", "error")}) {
    const QuantityResult& q = *quantity;
    add(difference, false,
        [&q](const Row& row) { return percent_text(relative(q.from_finest[row.run], q)); });
    add(error, false, [&q](const Row& row) {
      return q.converges() ? percent_text(relative(q.error[row.run], q)) : std::string("-");
    });
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string order_text(const Trend& trend) {
  return trend.order ? rounded_text(*trend.order, 2) : "-";
}

/// What is to be said of one series and one quantity.
std::string series_text(const std::string& what, const SeriesResult& series,
                        const QuantityResult& quantity, double expected_order) {
  if (series.same) return what + ": the same in all runs, to rounding\n";
  constexpr double kNothing = 1e-6;
  const Trend& trend = series.trend;
  if (trend.converges && relative(series.scene_error, quantity) < kNothing)
    return what + ": no error\n";
  std::string text = what + ": order " + order_text(trend) + ", ";
  if (!trend.converges)
    return text +
           "no convergence: differences between neighbouring runs do not shrink, or go to and fro; "
           "these runs are too coarse for the motion, or small causes decide on it, as "
           "after contacts\n";
  text += "error of the scene " + percent_text(relative(series.scene_error, quantity));
  if (series.runs.size() < 3)
    text += " (of order " + to_text(expected_order) + ", as is assumed: two runs show no order)";
  else if (!trend.order)
    text += " (differences shrink, but by no one power; order " + to_text(expected_order) +
            " is assumed)";
  return text + "\n";
}

std::string quantity_text(const std::string& name, const QuantityResult& quantity,
                          double time_order) {
  if (quantity.size == 0 && quantity.same()) return name + ": none in any run\n";
  std::string text;
  if (quantity.mesh)
    text += series_text(name + " and meshes", *quantity.mesh, quantity, kExpectedMeshOrder);
  if (quantity.time)
    text += series_text(name + " and time steps", *quantity.time, quantity, time_order);
  return text;
}

/// When the first contact was, in the scene's own run.
std::string touch_text(const StudyReport& report) {
  const MotionResult& all = report.result.all;
  const std::optional<double>& touch = report.runs[0].first_touch;
  if (!touch || (all.position.converges() && all.deformation.converges())) return "";
  return "bodies touch from t = " + rounded_text(*touch, 4) +
         " s on, and motions after contacts need not converge; --duration up to there shows those "
         "before\n";
}

std::string advice_text(const StudyReport& report) {
  const QuantityResult& q = report.result.all.position;
  if (!q.converges() || !q.mesh || !q.time || q.same()) return "";
  constexpr double kMore = 2;
  const double mesh = q.mesh->scene_error, time = q.time->scene_error;
  if (mesh > kMore * time)
    return "most of the error of positions is that of the mesh: finer meshes help (\"precompute\": "
           "{\"nodes\": N})\n";
  if (time > kMore * mesh)
    return "most of the error of positions is that of the time step: shorter ones help\n";
  return "mesh and time step have about the same part in the error of positions\n";
}

/// The worst bodies of several.
std::string bodies_text(const StudyReport& report) {
  constexpr std::size_t kMost = 8;
  const std::vector<MotionResult>& bodies = report.result.bodies;
  if (bodies.size() < 2) return "";
  std::vector<std::size_t> order(bodies.size());
  for (std::size_t b = 0; b < order.size(); ++b) order[b] = b;
  const auto difference = [&](std::size_t b) { return bodies[b].position.from_finest[0]; };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return difference(a) > difference(b); });
  order.resize(std::min(order.size(), kMost));
  std::string text = "differences of the scene from the finest run, by body:\n";
  for (std::size_t b : order)
    text += "  " + report.scene.bodies[b].name + ": positions " +
            percent_text(relative(difference(b), bodies[b].position)) + ", deformation " +
            percent_text(relative(bodies[b].deformation.from_finest[0], bodies[b].deformation)) +
            "\n";
  return text;
}

Json trend_json(const std::optional<SeriesResult>& series) {
  if (!series) return nullptr;
  Json out{{"runs", series->runs}, {"same", series->same}};
  out["converges"] = series->same ? Json(nullptr) : Json(series->trend.converges);
  out["order"] = series->trend.order ? Json(*series->trend.order) : Json(nullptr);
  out["scene_error"] = series->trend.converges ? Json(series->scene_error) : Json(nullptr);
  return out;
}

Json quantity_json(const QuantityResult& q) {
  return {{"size", q.size},
          {"from_finest", q.from_finest},
          {"error", q.converges() ? Json(q.error) : Json(nullptr)},
          {"mesh", trend_json(q.mesh)},
          {"time_step", trend_json(q.time)}};
}

Json motion_json(const MotionResult& motion) {
  return {{"position", quantity_json(motion.position)},
          {"rigid", quantity_json(motion.rigid)},
          {"deformation", quantity_json(motion.deformation)}};
}

Json run_json(const StudyRun& run, const StudyCost& cost) {
  const auto or_null = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  return {{"mesh_level", run.level.mesh},
          {"time_level", run.level.time},
          {"nodes", run.nodes},
          {"time_step", run.time_step},
          {"steps", run.steps},
          {"precompute_cpu_seconds", or_null(cost.precompute_seconds)},
          {"simulation_cpu_seconds", cost.simulation_seconds},
          {"archive_bytes", cost.archive_bytes},
          {"steps_with_unmet_constraints", run.unmet_steps},
          {"first_contact", or_null(run.first_touch)}};
}

}  // namespace

std::string report_text(const StudyReport& report) {
  const MotionResult& all = report.result.all;
  const double time_order = expected_time_order(report.scene);
  std::string text = table_text(report);
  text += "\nroot mean squares over the surface and " + std::to_string(report.times.count + 1) +
          " times, of differences from the finest run; positions over the motion, " +
          rounded_text(all.position.size, 3) + " m, deformation over its own size, " +
          rounded_text(all.deformation.size, 3) + " m; precomputed, simulated: processor time\n\n";
  if (all.position.size == 0 && all.position.same())
    return text + "nothing moves in any run: there is nothing to compare\n";
  text += quantity_text("positions", all.position, time_order);
  text += quantity_text("deformation", all.deformation, time_order);
  return text + touch_text(report) + advice_text(report) + bodies_text(report);
}

Json report_json(const StudyReport& report) {
  Json out{{"program", report.program}};
  out["scene"] = report.scene.files.empty() ? "" : report.scene.files.front();
  out["compared"] = {
      {"times", report.times.count + 1},
      {"interval", static_cast<double>(report.times.interval) * report.scene.time_step}};
  out["runs"] = Json::array();
  for (std::size_t k = 0; k < report.runs.size(); ++k)
    out["runs"].push_back(run_json(report.runs[k], report.costs[k]));
  out["all"] = motion_json(report.result.all);
  out["bodies"] = Json::object();
  for (std::size_t b = 0; b < report.result.bodies.size(); ++b)
    out["bodies"][report.scene.bodies[b].name] = motion_json(report.result.bodies[b]);
  return out;
}

LogPlot report_plot(const StudyReport& report) {
  const QuantityResult& q = report.result.all.position;
  LogPlot plot;
  plot.title = q.same()
                   ? "Positions: the same in all runs"
                   : "Positions: " +
                         std::string(q.converges() ? "error" : "difference from the finest run") +
                         " against processor time";
  plot.x_name = "precomputation and simulation [s]";
  plot.y_name = "% of the motion";
  const auto point = [&](std::size_t k, const std::string& label) {
    const StudyCost& cost = report.costs[k];
    return PlotSeries::Point{
        cost.precompute_seconds ? *cost.precompute_seconds + cost.simulation_seconds : 0,
        100 * relative(q.converges() ? q.error[k] : q.from_finest[k], q), label};
  };
  const auto add = [&](const char* name, const char* colour,
                       const std::optional<SeriesResult>& series, const auto& label) {
    if (!series) return;
    plot.series.push_back({name, colour, {}});
    for (std::size_t k : series->runs)
      plot.series.back().points.push_back(point(k, k == 0 ? "" : label(report.runs[k])));
  };
  add("other meshes", "#1f6fb4", q.mesh,
      [](const StudyRun& run) { return to_text(run.nodes) + " nodes"; });
  add("other time steps", "#d1600f", q.time,
      [](const StudyRun& run) { return to_text(run.time_step) + " s"; });
  plot.series.push_back({"the scene", "#222", {point(0, "")}});
  plot.series.back().points[0].marked = true;
  const StudyRun& last = report.runs.back();
  if (last.level.mesh != 0 && last.level.time != 0)
    plot.series.push_back({"both", "#3b8a3b", {point(report.runs.size() - 1, "both")}});
  return plot;
}

}  // namespace bem

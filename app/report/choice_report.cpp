#include "app/report/choice_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include "app/report/table.h"
#include "experiments/chart.h"
#include "experiments/pareto.h"

namespace twinshade {
namespace {

constexpr std::size_t kRowsShown = 10;

bool same(const Choice& a, const Choice& b) {
  return a.shading.technique == b.shading.technique && a.shading.map == b.shading.map && a.place == b.place &&
         a.lightmap == b.lightmap && a.volume == b.volume && a.map_width == b.map_width && a.storage == b.storage;
}

std::string in_percent(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", 100 * value) : "-"; }

Table table_of_choices() {
  Table table;
  for (const char* heading : {"", "technique", "light", "size", "map", "storage"}) table.column(heading);
  for (const char* heading : {"memory", "shade ns", "error %", "bias %", "worst %"})
    table.column(heading, Table::Align::right);
  return table;
}

void add_row(Table& table, const std::string& mark, const Choice& choice) {
  table.row({mark, choice.shading.technique, choice.shading.light, choice.size(),
             choice.map_width > 0 ? fmt::format("{} {}", choice.shading.map, choice.map_width) : "-",
             std::string(texel_storage_name(choice.storage)), memory_words(choice.bytes),
             choice.timing.shaded_pixels > 0 ? fmt::format("{:.2f}", choice.shade_ns()) : "-",
             in_percent(choice.error.rms), in_percent(choice.error.bias), in_percent(choice.error.worst)});
}

// Those that have an error, the least first.
std::vector<std::size_t> by_error(const SearchResult& found) {
  std::vector<std::size_t> order(found.tried.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::erase_if(order, [&](std::size_t i) { return !std::isfinite(found.tried[i].error.rms); });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return found.tried[a].error.rms < found.tried[b].error.rms; });
  return order;
}

}  // namespace

std::string memory_words(std::uint64_t bytes) {
  if (bytes < 1024) return fmt::format("{} B", bytes);
  return bytes < 1024 * 1024 ? fmt::format("{:.1f} KiB", double(bytes) / 1024)
                             : fmt::format("{:.1f} MiB", double(bytes) / (1024 * 1024));
}

std::string words(const Choice& choice) {
  std::string where = choice.shading.light;
  if (choice.size() != "-") where += " " + choice.size();
  if (choice.map_width > 0) where += fmt::format(", {} {}", choice.shading.map, choice.map_width);
  return fmt::format("{} ({}, {})", choice.shading.technique, where, texel_storage_name(choice.storage));
}

Ranking rank(const SearchResult& found, Cost by) {
  Ranking ranking;
  ranking.order.resize(found.best.size());
  std::iota(ranking.order.begin(), ranking.order.end(), std::size_t(0));
  const auto cost = [&](std::size_t i) {
    const Choice& choice = found.best[i];
    const double bytes = double(choice.bytes), ns = choice.shade_ns();
    return by == Cost::memory ? std::tuple(bytes, choice.error.rms, ns) : std::tuple(ns, bytes, choice.error.rms);
  };
  std::stable_sort(ranking.order.begin(), ranking.order.end(),
                   [&](std::size_t a, std::size_t b) { return cost(a) < cost(b); });
  std::vector<double> bytes, ns;
  for (const Choice& choice : found.best) bytes.push_back(double(choice.bytes)), ns.push_back(choice.shade_ns());
  ranking.frontier = pareto_frontier(bytes, ns);
  return ranking;
}

std::string within_table(const SearchResult& found, const Ranking& ranking) {
  Table table = table_of_choices();
  std::size_t left_out = 0;
  for (std::size_t place = 0; place < ranking.order.size(); ++place) {
    const std::size_t i = ranking.order[place];
    const bool frontier = std::find(ranking.frontier.begin(), ranking.frontier.end(), i) != ranking.frontier.end();
    if (place < kRowsShown || frontier)
      add_row(table, place == 0 ? "chosen" : frontier ? "frontier" : "", found.best[i]);
    else
      ++left_out;
  }
  return table.text() + (left_out > 0 ? fmt::format("... and {} more within the error\n", left_out) : "");
}

std::string closest_table(const SearchResult& found) {
  Table table = table_of_choices();
  std::set<std::string> shown;
  for (const std::size_t i : by_error(found))
    if (const Choice& choice = found.tried[i];
        shown.size() < kRowsShown && shown.insert(choice.shading.technique).second)
      add_row(table, shown.size() == 1 ? "closest" : "", choice);
  return table.text();
}

std::optional<std::size_t> closest(const SearchResult& found) {
  const std::vector<std::size_t> order = by_error(found);
  return order.empty() ? std::nullopt : std::optional(order.front());
}

Rows choice_rows(const SearchResult& found, const Ranking& ranking, double max_error) {
  Rows rows({"technique", "light", "lightmap", "volume", "map", "map_width", "storage", "truth", "bytes",
             "shade_ns_per_pixel", "error", "bias", "worst", "within", "best", "on_frontier", "chosen"});
  const auto flag = [](bool value) { return Cell(std::int64_t(value)); };
  for (const Choice& choice : found.tried) {
    std::size_t i = 0;  // among the best
    while (i < found.best.size() && !same(found.best[i], choice)) ++i;
    const bool best = i < found.best.size();
    rows.add({Cell(choice.shading.technique), Cell(choice.shading.light),
              choice.lightmap > 0 ? Cell(std::int64_t(choice.lightmap)) : Cell(),
              choice.volume.x > 0 ? Cell(choice.size()) : Cell(),
              choice.map_width > 0 ? Cell(choice.shading.map) : Cell(),
              choice.map_width > 0 ? Cell(std::int64_t(choice.map_width)) : Cell(),
              Cell(std::string(texel_storage_name(choice.storage))),
              Cell(std::string(choice.bounced() ? "bounced" : "direct")), Cell(std::int64_t(choice.bytes)),
              best ? number_cell(found.best[i].shade_ns()) : Cell(), number_cell(choice.error.rms),
              number_cell(choice.error.bias), number_cell(choice.error.worst), flag(choice.error.rms <= max_error),
              flag(best),
              flag(best && std::find(ranking.frontier.begin(), ranking.frontier.end(), i) != ranking.frontier.end()),
              flag(best && ranking.order.front() == i)});
  }
  return rows;
}

std::vector<Picture> choice_pictures(const SearchResult& found, double max_error, const std::string& what) {
  ScatterChart chart;
  chart.title = "Accuracy against memory";
  chart.subtitle = what;
  chart.x = {"light that is stored, KiB", true, {}, {}, {}, false};
  chart.y = {"error: RMS of the difference to traced light, % of its RMS", true, {}, {}, {}, false};
  chart.line = "frontier: nothing is both smaller and closer";
  chart.limit = 100 * max_error;
  chart.limit_label = fmt::format("--max-error {:g} %", 100 * max_error);
  std::vector<double> memory, error;
  for (const Choice& choice : found.tried) {
    memory.push_back(double(choice.bytes) / 1024);
    error.push_back(100 * choice.error.rms);
    const std::string group = choice.bounced() ? choice.shading.light : "visibility, " + choice.shading.light;
    const std::size_t place =
        std::size_t(std::find(chart.groups.begin(), chart.groups.end(), group) - chart.groups.begin());
    if (place == chart.groups.size()) chart.groups.push_back(group);
    chart.points.push_back({"", memory.back(), error.back(), place});
  }
  chart.on_line = pareto_frontier(memory, error);
  for (const std::size_t i : chart.on_line) {
    const Choice& choice = found.tried[i];
    chart.points[i].label = choice.shading.technique;
    if (choice.size() != "-") chart.points[i].label += " " + choice.size();
    if (choice.storage != TexelStorage::float32)
      chart.points[i].label += fmt::format(" {}", texel_storage_name(choice.storage));
  }
  return {{"choose", draw(chart)}};
}

}  // namespace twinshade

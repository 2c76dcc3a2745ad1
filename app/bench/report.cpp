#include "app/bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/report/rows_output.h"
#include "app/report/table.h"
#include "experiments/chart.h"

namespace twinshade::bench {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

Cell text_cell(const std::string& text) { return text.empty() ? Cell() : Cell(text); }
std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

std::string number_text(double value, int digits = 2) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

// Two decimals; three significant digits where these are less: frames of hundredths of a millisecond.
std::string milliseconds_text(double value) {
  return number_text(value, value > 0 && value < 1 ? std::min(6, 2 - int(std::floor(std::log10(value)))) : 2);
}

double ratio_to(const Timing* other, const Timing* timing) {
  return other && timing ? ratio(*other, *timing).median : kMissing;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? kMissing : std::exp(sum / double(values.size()));
}

}  // namespace

Report::Report(std::vector<Limits> limits)
    : limits_(std::move(limits)),
      rows_({"technique",
             "light",
             "map",
             "renderer",
             "isa",
             "number",
             "attributes",
             "depth_prepass",
             "ms",
             "ms_q1",
             "ms_q3",
             "ns_per_pixel",
             "shaded_pixels",
             "ratio_to_llvmpipe",
             "ratio_q1",
             "ratio_q3",
             "vertex_ms",
             "bin_ms",
             "raster_ms",
             "interpolate_ms",
             "shade_ms",
             "store_ms",
             "peak_memory",
             "flops_per_pixel",
             "texel_bytes_per_pixel",
             "input_bytes_per_pixel",
             "roofline_ns_per_pixel",
             "roofline_fraction",
             "error"}) {}

const Timing* Report::Technique::cpu(Isa isa, AttributeMode mode) const {
  for (const Timing& timing : timings)
    if (timing.way.is_cpu() && timing.drawn() && *timing.way.cpu.isa == isa && timing.way.attributes == mode)
      return &timing;
  return nullptr;
}

const Timing* Report::Technique::widest() const {
  for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native})
    for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::baseline})
      if (const Timing* timing = cpu(isa, mode)) return timing;
  return nullptr;
}

const Limits* Report::limits(Isa isa) const {
  for (const Limits& of : limits_)
    if (of.isa == isa) return &of;
  return nullptr;
}

void Report::add(const Shading& shading, const ShaderCost& cost, const std::vector<Timing>& timings) {
  techniques_.push_back({shading, cost, timings});
  for (const Timing& timing : timings)
    if (!timing.impossible) add_row(techniques_.back(), timing);
}

void Report::add_row(const Technique& technique, const Timing& timing) {
  const Way& way = timing.way;
  const Shading& shading = technique.shading;
  std::vector<Cell> cells{Cell(shading.technique),
                          text_cell(shading.light),
                          text_cell(shading.map),
                          Cell(way.renderer),
                          way.is_cpu() ? Cell(std::string(isa_name(*way.cpu.isa))) : Cell(),
                          way.is_cpu() ? Cell(std::string(number_name(*way.cpu.number))) : Cell(),
                          Cell(std::string(attribute_mode_name(way.attributes))),
                          Cell(std::int64_t(way.depth_prepass))};
  if (!timing.drawn()) {
    failures_ += fmt::format("failed {} on {}: {}\n", shading.label(), way.name(), timing.failure);
    cells.resize(rows_.columns().size());
    cells.back() = timing.failure;
    rows_.add(std::move(cells));
    return;
  }
  const Quartiles ms = quartiles(timing.milliseconds);
  cells.insert(cells.end(), {Cell(ms.median), Cell(ms.q1), Cell(ms.q3), number_cell(timing.ns_per_pixel()),
                             Cell(std::int64_t(timing.shaded_pixels))});
  if (const Timing* llvmpipe = technique.llvmpipe()) {
    const Quartiles ratios = ratio(*llvmpipe, timing);
    cells.insert(cells.end(), {Cell(ratios.median), Cell(ratios.q1), Cell(ratios.q3)});
  } else {
    cells.resize(cells.size() + 3);
  }
  for (std::size_t s = 0; s < kStageCount; ++s)
    cells.push_back(timing.stages[s].empty() ? Cell() : Cell(timing.stage(s)));
  cells.push_back(way.is_cpu() ? Cell(std::int64_t(timing.peak_memory)) : Cell());
  const ShaderCost& cost = technique.cost;
  cells.insert(cells.end(), {Cell(cost.flops), Cell(cost.texel_bytes), Cell(cost.input_bytes)});
  const Limits* roof = way.is_cpu() ? limits(*way.cpu.isa) : nullptr;
  if (roof && timing.shaded_pixels > 0) {
    const double ns = roofline_ns(cost, *roof);
    cells.insert(cells.end(),
                 {Cell(ns), number_cell(ns * double(timing.shaded_pixels) / (timing.stage(Stage::shade) * 1e6))});
  }
  cells.resize(rows_.columns().size());
  rows_.add(std::move(cells));
}

std::string Report::speed_table() const {
  Table table;
  for (const char* heading : {"technique", "light", "map"}) table.column(heading);
  table.column("llvmpipe ms", Table::Align::right);
  for (const Limits& of : limits_) table.column(fmt::format("x {}", isa_name(of.isa)), Table::Align::right);
  for (const char* heading : {"ms", "q1", "q3", "ns/pixel", "exact/native", "peak MiB"})
    table.column(heading, Table::Align::right);
  for (const Technique& technique : techniques_) {
    const Timing *llvmpipe = technique.llvmpipe(), *best = technique.widest();
    std::vector<std::string> cells{technique.shading.technique, or_dash(technique.shading.light),
                                   or_dash(technique.shading.map),
                                   llvmpipe ? milliseconds_text(llvmpipe->median()) : "-"};
    for (const Limits& of : limits_) {
      const Timing* exact = technique.cpu(of.isa, AttributeMode::exact);
      cells.push_back(number_text(ratio_to(llvmpipe, exact ? exact : technique.cpu(of.isa, AttributeMode::native))));
    }
    if (best) {
      const Quartiles ms = quartiles(best->milliseconds);
      const double native = best->way.attributes == AttributeMode::exact
                                ? ratio_to(best, technique.cpu(*best->way.cpu.isa, AttributeMode::native))
                                : kMissing;
      for (const double value : {ms.median, ms.q1, ms.q3, best->ns_per_pixel()})
        cells.push_back(milliseconds_text(value));
      cells.push_back(number_text(native));
      cells.push_back(number_text(double(best->peak_memory) / (1 << 20), 0));
    }
    table.row(std::move(cells));
  }
  return table.text();
}

std::string Report::stage_table() const {
  Table table;
  for (const char* heading : {"technique", "light", "map"}) table.column(heading);
  for (const char* stage : kStageNames) table.column(stage, Table::Align::right);
  for (const char* heading : {"flops/pixel", "bytes/pixel", "roofline ms", "reached"})
    table.column(heading, Table::Align::right);
  for (const Technique& technique : techniques_) {
    const Timing* best = technique.widest();
    if (!best) continue;
    std::vector<std::string> cells{technique.shading.technique, or_dash(technique.shading.light),
                                   or_dash(technique.shading.map)};
    for (std::size_t s = 0; s < kStageCount; ++s) cells.push_back(milliseconds_text(best->stage(s)));
    const std::string least = technique.cost.loops ? ">= " : "";
    cells.push_back(least + number_text(technique.cost.flops, 0));
    cells.push_back(least + number_text(technique.cost.bytes(), 0));
    if (const Limits* roof = limits(*best->way.cpu.isa)) {
      const double ms = roofline_ns(technique.cost, *roof) * double(best->shaded_pixels) * 1e-6;
      cells.push_back(milliseconds_text(ms));
      cells.push_back(fmt::format("{:.0f} %", 100 * ms / best->stage(Stage::shade)));
    }
    table.row(std::move(cells));
  }
  return table.text();
}

std::vector<Report::Mean> Report::means() const {
  std::vector<Mean> means;
  for (const Limits& of : limits_)
    for (const AttributeMode mode : {AttributeMode::exact, AttributeMode::native}) {
      std::vector<double> ratios;
      for (const Technique& technique : techniques_)
        if (const double value = ratio_to(technique.llvmpipe(), technique.cpu(of.isa, mode)); std::isfinite(value))
          ratios.push_back(value);
      if (!ratios.empty()) means.push_back({of.isa, mode, ratios.size(), geometric_mean(ratios)});
    }
  return means;
}

std::string Report::text() const {
  const Timing* best = techniques_.empty() ? nullptr : techniques_.front().widest();
  std::string text = text_of(limits_) + "\n" + speed_table();
  if (best)
    text += fmt::format("\nmilliseconds of {}, {} attributes, by stage; the roofline is of shading\n",
                        isa_name(*best->way.cpu.isa), attribute_mode_name(best->way.attributes)) +
            stage_table();
  text += "\n";
  for (const Mean& mean : means())
    text += fmt::format("{}, {} attributes: {:.2f} times as fast as llvmpipe (geometric mean of {})\n",
                        isa_name(mean.isa), attribute_mode_name(mean.mode), mean.ratio, mean.techniques);
  return text + failures_;
}

Json Report::rows_json() const {
  Json rows = json_rows(rows_);
  for (Json& row : rows) {
    row["depth_prepass"] = row["depth_prepass"] == 1;
    if (row["error"].is_null()) row.erase("error");
  }
  return rows;
}

Json Report::summary_json() const {
  Json summary = Json::array();
  for (const Mean& mean : means())
    summary.push_back({{"isa", isa_name(mean.isa)},
                       {"attributes", attribute_mode_name(mean.mode)},
                       {"techniques", mean.techniques},
                       {"geometric_mean_ratio_to_llvmpipe", mean.ratio}});
  return summary;
}

std::vector<Picture> Report::pictures() const {
  BarChart speed;
  speed.title = "Speed against llvmpipe";
  AttributeMode drawn = AttributeMode::exact;
  for (const Technique& technique : techniques_)
    if (const Timing* best = technique.widest()) drawn = best->way.attributes;
  speed.subtitle =
      fmt::format("llvmpipe's milliseconds over ours, median of paired rounds; {} attributes against its own varyings",
                  attribute_mode_name(drawn));
  speed.value = {"times as fast", false, 0.0};
  speed.dots = true;
  HeatMap stages;
  stages.title = "Where a frame's time goes";
  stages.columns.assign(std::begin(kStageNames), std::end(kStageNames));
  stages.logarithmic = true;
  for (const Limits& of : limits_) speed.bars.push_back({isa_name(of.isa), {}});
  for (const Technique& technique : techniques_) {
    const Timing* best = technique.widest();
    if (!best) continue;
    stages.subtitle = fmt::format("milliseconds by stage, {}, {} attributes", isa_name(*best->way.cpu.isa),
                                  attribute_mode_name(best->way.attributes));
    speed.rows.push_back(technique.shading.label());
    stages.rows.push_back(technique.shading.label());
    for (std::size_t s = 0; s < kStageCount; ++s) stages.values.push_back(best->stage(s));
    for (std::size_t i = 0; i < limits_.size(); ++i) {
      const Timing* exact = technique.cpu(limits_[i].isa, AttributeMode::exact);
      speed.bars[i].values.push_back(
          ratio_to(technique.llvmpipe(), exact ? exact : technique.cpu(limits_[i].isa, AttributeMode::native)));
    }
  }
  std::vector<Picture> pictures;
  bool any = false;
  for (const BarChart::Bars& bars : speed.bars)
    for (const double value : bars.values) any = any || std::isfinite(value);
  if (any) pictures.push_back({"bench", twinshade::draw(speed)});
  if (!stages.rows.empty()) pictures.push_back({"bench-stages", twinshade::draw(stages)});
  return pictures;
}

}  // namespace twinshade::bench

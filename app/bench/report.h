// Timings of many techniques as tables, CSV, JSON and charts.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/bench/limits.h"
#include "app/bench/race.h"
#include "app/bench/roofline.h"
#include "app/subject.h"
#include "experiments/experiment.h"

namespace twinshade::bench {

class Report {
 public:
  explicit Report(std::vector<Limits> limits);

  void add(const Shading& shading, const ShaderCost& cost, const std::vector<Timing>& timings);

  // For people: the machine's limits, a line a technique, the stages and the roofline of the widest way, means.
  std::string text() const;
  std::string csv() const { return rows_.csv(); }
  Json rows_json() const;     // a row for each way of drawing each technique
  Json summary_json() const;  // geometric means over techniques
  Json limits_json() const { return json_of(limits_); }
  // "bench": speed against llvmpipe; "bench-stages": milliseconds of the widest way. Each only where there is any.
  std::vector<Picture> pictures() const;
  static std::vector<std::string> picture_names() { return {"bench", "bench-stages"}; }
  bool failed() const { return !failures_.empty(); }

 private:
  struct Technique {
    Shading shading;
    ShaderCost cost;
    std::vector<Timing> timings;
    const Timing* llvmpipe() const { return faster_llvmpipe(timings); }
    const Timing* cpu(Isa isa, AttributeMode mode) const;
    // The widest instruction set's exact attributes, or what there is instead.
    const Timing* widest() const;
  };
  // Mean ratios against llvmpipe and of native to exact attributes; over how many techniques.
  struct Mean {
    Isa isa;
    AttributeMode mode;
    std::size_t techniques;
    double ratio;
  };

  void add_row(const Technique& technique, const Timing& timing);
  std::string speed_table() const;
  std::string stage_table() const;
  std::vector<Mean> means() const;
  const Limits* limits(Isa isa) const;

  std::vector<Limits> limits_;
  std::vector<Technique> techniques_;
  Rows rows_;
  std::string failures_;
};

}  // namespace twinshade::bench

// HTML: the living standard (html.spec.whatwg.org). Pictures stand in it once, as SVG's image, of which whole and
// enlarged views are made by `use` (SVG 2, 5.6).
#include "app/report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/base64.h"
#include "base/error.h"
#include "base/file.h"
#include "base/utf8.h"

namespace twinshade {
namespace {

constexpr int kLinesAround = 4;          // of GLSL, above and below
constexpr std::uint32_t kEnlarged = 24;  // pixels across an enlarged view

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --back: #fff; --text: #1c1f23; --dim: #667; --line: #d8dbe0; --panel: #f5f6f8;
  --good: #1a7f37; --bad: #c22; --odd: #a15c00; }
@media (prefers-color-scheme: dark) { :root { --back: #14171b; --text: #dfe3e8; --dim: #99a; --line: #333a43;
  --panel: #1c2127; --good: #4ac26b; --bad: #ff6b63; --odd: #e0a040; } }
body { margin: 2rem auto; max-width: 84rem; padding: 0 1.5rem; background: var(--back); color: var(--text);
  font: 15px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.5rem; margin: 0; } h2 { font-size: 1.1rem; margin: 0 0 .4rem; overflow-wrap: anywhere; }
a { color: inherit; } .dim { color: var(--dim); }
span.passed, td.passed { color: var(--good); } span.failed, td.failed { color: var(--bad); } span.error, td.error { color: var(--odd); }
.counts { font-size: 1.1rem; font-weight: 600; margin: .3rem 0 1rem; } .counts span { margin-right: 1.2rem; }
table { border-collapse: collapse; width: 100%; margin: 1rem 0 2rem; }
td, th { text-align: left; padding: .25rem .8rem .25rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
td { overflow-wrap: anywhere; } td.number, th.number { text-align: right; white-space: nowrap; }
td.result { white-space: nowrap; font-weight: 600; width: 4rem; } td.case { min-width: 14rem; }
section { color: var(--text); border: 1px solid var(--line); border-left: 5px solid var(--bad); border-radius: 4px; padding: 1rem 1.2rem;
  margin: 0 0 1.5rem; } section.error { border-left-color: var(--odd); }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(16rem, 1fr)); gap: .8rem; margin: .8rem 0; }
figure { margin: 0; } figcaption { color: var(--dim); font-size: .85rem; }
svg { width: 100%; height: auto; display: block; background: #000; border-radius: 3px; }
svg.enlarged { image-rendering: pixelated; margin-top: .4rem; }
pre { background: var(--panel); padding: .7rem .9rem; border-radius: 4px; margin: .6rem 0; white-space: pre-wrap; overflow-wrap: anywhere;
  font: 13px/1.45 ui-monospace, monospace; tab-size: 2; }
pre b { display: inline-block; min-width: 100%; background: color-mix(in srgb, var(--bad) 22%, transparent);
  font-weight: inherit; }
details { margin: 2rem 0; } summary { cursor: pointer; color: var(--dim); }
)";

const char* result_word(CaseResult::Result result) {
  switch (result) {
    case CaseResult::Result::passed:
      return "passed";
    case CaseResult::Result::failed:
      return "failed";
    case CaseResult::Result::error:
      return "error";
  }
  return "";
}

// A view of the picture `id`, whose upper left pixel is (x, y).
std::string view(const std::string& id, std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
                 const char* kind, const std::string& mark) {
  return fmt::format("<svg{} viewBox=\"{} {} {} {}\"><use href=\"#{}\"/>{}</svg>", kind, x, y, width, height, id, mark);
}

// The first pixel of a view that many wide about `middle`, within the picture.
std::uint32_t begin_about(std::uint32_t middle, std::uint32_t wide, std::uint32_t size) {
  return std::min(middle > wide / 2 ? middle - wide / 2 : 0, size - wide);
}

std::string pictures_html(const CaseResult::Pictures& pictures, std::size_t index) {
  std::string html = "<div class=\"pictures\">\n";
  for (std::size_t k = 0; k < pictures.list.size(); ++k) {
    const CaseResult::Picture& picture = pictures.list[k];
    const std::string id = fmt::format("p{}-{}", index, k);
    std::string ring, frame;
    if (pictures.x) {
      const double pen = pictures.width / 200.0;
      for (const auto& [color, width] : {std::pair("#000", 2.0), std::pair("#fff", 1.0)}) {  // to be seen on anything
        ring += fmt::format(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{:.2f}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"/>",
            *pictures.x + 0.5, *pictures.y + 0.5, pen * 5, color, pen * width);
        frame += fmt::format(
            "<rect x=\"{}\" y=\"{}\" width=\"1\" height=\"1\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"/>",
            *pictures.x, *pictures.y, color, width * 0.1);
      }
    }
    html += fmt::format(
        "<figure><svg viewBox=\"0 0 {0} {1}\"><image id=\"{2}\" width=\"{0}\" height=\"{1}\" "
        "href=\"data:image/png;base64,{3}\"/>{4}</svg>",
        pictures.width, pictures.height, id, base64(picture.png), ring);
    if (pictures.x) {
      const std::uint32_t wide = std::min(kEnlarged, pictures.width), high = std::min(kEnlarged / 2, pictures.height);
      html += view(id, begin_about(*pictures.x, wide, pictures.width), begin_about(*pictures.y, high, pictures.height),
                   wide, high, " class=\"enlarged\"", frame);
    }
    html += fmt::format("<figcaption>{}</figcaption></figure>\n", xml_escaped(picture.label));
  }
  return html + "</div>\n";
}

// The lines about `line` of a file, that one marked; empty where there are none.
std::string source_html(const std::string& file, int line) {
  std::string text;
  try {
    std::istringstream in(read_file(file));
    int number = 0;
    for (std::string each; std::getline(in, each) && number < line + kLinesAround;) {
      if (++number < line - kLinesAround) continue;
      if (!each.empty() && each.back() == '\r') each.pop_back();
      const std::string shown = fmt::format("{:5}  {}", number, xml_escaped(each));
      text += number == line ? "<b>" + shown + "</b>\n" : shown + "\n";
    }
    if (number < line) return "";
  } catch (const UserError&) {  // the case says itself what is wrong with its file
    return "";
  }
  return fmt::format("<div class=\"dim\">{}, line {}</div>\n<pre>{}</pre>\n", xml_escaped(file), line, text);
}

std::string section_html(const CaseResult& c, std::size_t index) {
  std::string html =
      fmt::format("<section id=\"case-{}\" class=\"{}\">\n<h2><span class=\"{}\">{}</span> {}</h2>\n", index,
                  result_word(c.result), result_word(c.result), result_word(c.result), xml_escaped(c.name));
  if (!c.message.empty()) html += "<p>" + xml_escaped(c.message) + "</p>\n";
  if (!c.pictures.list.empty()) html += pictures_html(c.pictures, index);
  const std::size_t first = c.text.find_first_not_of('\n');
  if (first != std::string::npos) html += "<pre>" + xml_escaped(c.text.substr(first)) + "</pre>\n";
  if (const auto [file, line] = place_of(c); !file.empty() && line > 0) html += source_html(file, line);
  return html + "</section>\n";
}

std::string row_html(const CaseResult& c, std::size_t index, bool timed) {
  const bool passed = c.result == CaseResult::Result::passed;
  const std::string name = xml_escaped(c.name);
  return fmt::format("<tr><td class=\"result {}\">{}</td><td class=\"case\">{}</td><td>{}</td>{}</tr>\n",
                     result_word(c.result), result_word(c.result),
                     passed ? name : fmt::format("<a href=\"#case-{}\">{}</a>", index, name), xml_escaped(c.message),
                     timed ? fmt::format("<td class=\"number\">{:.2f}</td>", c.seconds) : "");
}

}  // namespace

std::string html_report(const HtmlReport& report) {
  std::vector<const CaseResult*> cases;
  for (const CaseResult& c : report.cases) cases.push_back(&c);
  std::stable_partition(cases.begin(), cases.end(),
                        [](const auto* c) { return c->result != CaseResult::Result::passed; });
  std::string counts, rows, sections;
  for (const CaseResult::Result result :
       {CaseResult::Result::passed, CaseResult::Result::failed, CaseResult::Result::error}) {
    const auto count = std::count_if(cases.begin(), cases.end(), [&](const auto* c) { return c->result == result; });
    const char* word = result_word(result);
    const bool plural = result == CaseResult::Result::error && count > 1;
    if (count > 0) counts += fmt::format("<span class=\"{}\">{} {}{}</span>", word, count, word, plural ? "s" : "");
  }
  const bool timed = std::any_of(cases.begin(), cases.end(), [](const auto* c) { return c->seconds > 0; });
  for (std::size_t i = 0; i < cases.size(); ++i) {
    rows += row_html(*cases[i], i, timed);
    if (cases[i]->result != CaseResult::Result::passed) sections += section_html(*cases[i], i);
  }
  const std::string title = xml_escaped(report.title);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<div class=\"counts\">{2}</div>\n{3}"
      "<table>\n<thead><tr><th>result</th><th>case</th><th>what</th>{4}</tr></thead>\n"
      "<tbody>\n{5}</tbody>\n</table>\n{6}<details><summary>Provenance</summary><pre>{7}</pre></details>\n"
      "</body>\n</html>\n",
      title, kStyle, counts, report.summary.empty() ? "" : "<p class=\"dim\">" + xml_escaped(report.summary) + "</p>\n",
      timed ? "<th class=\"number\">seconds</th>" : "", rows, sections,
      xml_escaped(report.provenance.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
}

}  // namespace twinshade

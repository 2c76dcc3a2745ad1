#include "app/report/html_report.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

namespace twinshade {
namespace {

using Result = CaseResult::Result;

std::string page(const std::vector<CaseResult>& cases, const std::string& summary = "") {
  return html_report({"twinshade check", summary, cases, {{"seed", 1}}});
}

CaseResult failure(const std::string& name) { return {name, Result::failed, "differs", "details", 0, "", 0}; }

// Tags that are opened and not closed, or closed and not opened; <meta> has no end, and images of SVG close themselves.
std::vector<std::string> unbalanced(const std::string& html) {
  std::vector<std::string> open, wrong;
  const std::regex tag("<(/?)([a-z0-9]+)((?:\"[^\"]*\"|[^\">])*?)(/?)>");
  for (std::sregex_iterator at(html.begin(), html.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if (name == "meta" || (*at)[4] == "/") continue;
    if ((*at)[1] == "") {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      wrong.push_back("/" + name);
    } else {
      open.pop_back();
    }
  }
  wrong.insert(wrong.end(), open.begin(), open.end());
  return wrong;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("a report of any results closes its tags and reads nothing from elsewhere") {
  CaseResult pictured = failure("c");
  pictured.pictures = {4, 3, 1, 2, {{"cpu", "abc"}, {"egl", "ab"}}};
  for (const std::vector<CaseResult>& cases :
       {std::vector<CaseResult>{},
        {{"a", Result::passed, "", "", 1.5, "", 0}},
        {failure("b"), pictured, {"d", Result::error, "no backend", "", 0, "", 0}}}) {
    const std::string html = page(cases, "all of it");
    CHECK(html.find("<!DOCTYPE html>") == 0);
    CHECK_MESSAGE(unbalanced(html.substr(15)).empty(), unbalanced(html.substr(15)).front());
    for (const char* outside : {"<script", "<link", "http:", "https:", "src=", "@import"})
      CHECK_MESSAGE(html.find(outside) == std::string::npos, outside);
    CHECK(html.find("&quot;seed&quot;: 1") != std::string::npos);
  }
}

TEST_CASE("what did not pass comes first, in its order, and is linked to") {
  const std::string html = page({{"fine", Result::passed, "", "", 0, "", 0},
                                 failure("first"),
                                 {"also fine", Result::passed, "", "", 0, "", 0},
                                 {"second", Result::error, "no backend", "", 0, "", 0}});
  CHECK(html.find("2 passed") != std::string::npos);
  CHECK(html.find("1 failed") != std::string::npos);
  CHECK(html.find("1 error<") != std::string::npos);
  CHECK(html.find(">first<") < html.find(">second<"));
  CHECK(html.find(">second<") < html.find(">fine<"));
  CHECK(html.find(">fine<") < html.find(">also fine<"));
  CHECK(html.find("href=\"#case-0\">first") != std::string::npos);
  CHECK(count(html, "<section") == 2);
  CHECK(html.find("id=\"case-1\"") != std::string::npos);
  CHECK(html.find("seconds") == std::string::npos);  // nothing was timed
}

TEST_CASE("names, messages and details are text, whatever is in them") {
  CaseResult c = failure("\"><script>alert(1)</script>.frag");
  c.message = "a < b && c";
  c.text = "\n<pre>\xff</pre>";
  c.pictures = {1, 1, {}, {}, {{"<b>", "x"}}};
  const std::string html = page({c});
  CHECK(html.find("<script") == std::string::npos);
  CHECK(html.find("&lt;script&gt;alert(1)&lt;/script&gt;.frag") != std::string::npos);
  CHECK(html.find("a &lt; b &amp;&amp; c") != std::string::npos);
  CHECK(html.find("&lt;pre&gt;\xef\xbf\xbd&lt;/pre&gt;") != std::string::npos);
  CHECK(html.find("<figcaption>&lt;b&gt;</figcaption>") != std::string::npos);
  CHECK(unbalanced(html.substr(15)).empty());
}

TEST_CASE("a picture stands in the page once, as base64 of its bytes (RFC 4648, 10), enlarged about the pixel") {
  CaseResult c = failure("a");
  c.pictures = {
      100, 50, 99, 0, {{"1", "f"}, {"2", "fo"}, {"3", "foo"}, {"4", "foob"}, {"5", std::string("\0\xff", 2)}}};
  const std::string html = page({c});
  for (const char* data : {"Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "AP8="})
    CHECK_MESSAGE(count(html, std::string("data:image/png;base64,") + data + "\"") == 1, data);
  CHECK(count(html, "viewBox=\"0 0 100 50\"") == 5);
  CHECK(count(html, "viewBox=\"76 0 24 12\"") == 5);  // at the corner, and within the picture
  CHECK(count(html, "<rect x=\"99\" y=\"0\"") == 10);
  c.pictures = {5, 2, 0, 1, {{"small", "f"}}};
  CHECK(count(page({c}), "viewBox=\"0 0 5 2\"") == 2);  // smaller than an enlarged view
  c.pictures = {100, 50, {}, {}, {{"no pixel", "f"}}};
  CHECK(count(page({c}), "class=\"enlarged\"") == 0);
}

TEST_CASE("the lines of GLSL about the one that a case names are shown, and none where there are none") {
  std::string folder = std::filesystem::temp_directory_path() / "twinshade-report-XXXXXX";
  REQUIRE(mkdtemp(folder.data()) != nullptr);
  const std::string file = folder + "/a.frag";
  std::ofstream(file) << "1\n2\nin vec2 <uv>;\r\n4\n5\n6\n7\n8\n";
  CaseResult c = failure("a");
  c.file = file, c.line = 3;
  const std::string html = page({c});
  CHECK(html.find("a.frag, line 3</div>") != std::string::npos);
  CHECK(html.find("<b>    3  in vec2 &lt;uv&gt;;</b>\n") != std::string::npos);
  CHECK(html.find("    1  1\n") != std::string::npos);
  CHECK(html.find("    7  7\n") != std::string::npos);
  CHECK(html.find("    8  8\n") == std::string::npos);
  c.line = 9;
  CHECK(page({c}).find("line 9") == std::string::npos);
  c.line = 1, c.file = folder + "/missing.frag";
  CHECK(page({c}).find("line 1") == std::string::npos);
  c.message = file + ":5: 'x' : undeclared identifier";  // what the message says is meant
  c.files = {file};
  CHECK(page({c}).find("<b>    5  5</b>\n") != std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace twinshade

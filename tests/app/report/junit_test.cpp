#include "app/report/junit.h"

#include <doctest/doctest.h>

using twinshade::CaseResult;
using twinshade::github_annotations;
using twinshade::junit_xml;
using Result = CaseResult::Result;

TEST_CASE("an annotation stands at the line that the message begins with, else at the shader") {
  CHECK(github_annotations({{"fine", Result::passed, "", "", 0, "fine.frag", 3}}) == "");
  CHECK(github_annotations(
            {{"a", Result::error, "lib/noise.glsl:12: 'x' : undeclared identifier", "", 0, "a.frag", 0}}) ==
        "::error file=lib/noise.glsl,line=12,title=a::lib/noise.glsl:12: 'x' : undeclared identifier\n");
  CHECK(github_annotations({{"b on egl", Result::failed, "2 of 3 rows differ", "", 0, "b.frag", 0}}) ==
        "::error file=b.frag,title=b on egl::2 of 3 rows differ\n");
  CHECK(github_annotations({{"c", Result::failed, "differs", "", 0, "c.frag", 7}}) ==
        "::error file=c.frag,line=7,title=c::differs\n");
}

TEST_CASE("an annotation's file may have colons, blanks and commas in its name, and so may an included one") {
  const auto place = [](const CaseResult& c) {
    const std::string line = github_annotations({c});
    return line.substr(8, line.find(",title=") - 8);
  };
  const CaseResult colons{"n", Result::error, "a:7:b.frag:2: 'x' : undeclared identifier", "", 0, "a:7:b.frag", 0};
  CHECK(place(colons) == "file=a%3A7%3Ab.frag,line=2");
  CHECK(place({"n", Result::error, "err]]>%0A::x,y.frag:3: no", "", 0, "err]]>%0A::x,y.frag", 0}) ==
        "file=err]]>%250A%3A%3Ax%2Cy.frag,line=3");
  CHECK(place({"n", Result::error, "a:7:b.frag: cannot be read", "", 0, "a:7:b.frag", 0}) == "file=a%3A7%3Ab.frag");
  CHECK(place({"n", Result::error, "my lib:1:x.glsl:4: no", "", 0, "a.frag", 0, {"a.frag", "my lib:1:x.glsl"}}) ==
        "file=my lib%3A1%3Ax.glsl,line=4");
}

TEST_CASE("services know ./a.frag as a.frag") {
  const std::vector<CaseResult> cases{{"./a.frag", Result::failed, "differs", "", 0, "./a.frag", 7}};
  CHECK(github_annotations(cases) == "::error file=a.frag,line=7,title=a.frag::differs\n");
  CHECK(junit_xml("s", cases).find("name=\"a.frag\"") != std::string::npos);
}

TEST_CASE("what no XML document may hold becomes U+FFFD, all else stays") {
  const auto written = [](const std::string& message) {
    const std::string xml = junit_xml("s", {{"n", Result::error, message, "", 0, "", 0}});
    const std::size_t from = xml.find("message=\"") + 9;
    return xml.substr(from, xml.find('"', from) - from);
  };
  const std::string bad = "\xef\xbf\xbd";
  CHECK(written("caf\xe9(x)") == "caf" + bad + "(x)");
  CHECK(written("caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80") == "caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80");
  CHECK(written("\xc0\x80") == bad + bad);            // too long
  CHECK(written("\xed\xa0\x80") == bad + bad + bad);  // a surrogate
  CHECK(written("\xef\xbf\xbf") == bad + bad + bad);  // U+FFFF
  CHECK(written("\xf4\x90\x80\x80") == bad + bad + bad + bad);
  CHECK(written("end \xe2\x82") == "end " + bad + bad);
  CHECK(written("a\x01\x7f\tb\r\n") == "a" + bad + "\x7f\tb&#13;\n");
  CHECK(written("<a & \"b\">") == "&lt;a &amp; &quot;b&quot;&gt;");
}

TEST_CASE("what would end a workflow command is escaped") {
  CHECK(github_annotations({{"a,b: 100%", Result::failed, "x\ny", "50%\r", 0, "", 0}}) ==
        "::error title=a%2Cb%3A 100%25::x%0Ay%0A50%25%0D\n");
}

#include "convergence/log_plot.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("Points are drawn where both numbers are positive", "[plot]") {
  const LogPlot plot{
      "<&> title",
      "x",
      "y",
      {{"a", "#123456", {{1, 10, "p"}, {100, 0.1, "q", true}, {3, 0, "r"}, {NAN, 1, "s"}}}}};
  const std::string svg = svg_of(plot);
  CHECK(svg.rfind("<svg xmlns=", 0) == 0);
  CHECK(count(svg, "r=\"3.5\"") == 1);
  CHECK(count(svg, "r=\"6\"") == 1);
  CHECK(count(svg, ">p</text>") == 1);
  CHECK(count(svg, ">r</text>") == 0);
  CHECK(count(svg, "&lt;&amp;&gt; title") == 1);
  CHECK(count(svg, ">0.1</text>") == 1);
  CHECK(count(svg, ">10</text>") == 2);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("A plot without points, or with one, is a plot", "[plot]") {
  for (const std::vector<PlotSeries>& series :
       {std::vector<PlotSeries>{}, {{"a", "#000", {{5, 5, "only"}}}}}) {
    const std::string svg = svg_of({"t", "x", "y", series});
    CHECK(svg.find("</svg>") != std::string::npos);
    CHECK(svg.find("nan") == std::string::npos);
  }
}

#include "convergence/log_plot.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Heights of the texts with a label.
std::vector<double> heights(const std::string& svg, const std::string& label) {
  std::vector<double> out;
  for (std::size_t at = svg.find('>' + label); at != std::string::npos;
       at = svg.find('>' + label, at + 1)) {
    const std::size_t y = svg.find(" y=\"", svg.rfind("<text", at));
    out.push_back(std::stod(svg.substr(y + 4)));
  }
  return out;
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

TEST_CASE("Labels of points at one place do not lie on each other", "[plot]") {
  std::vector<PlotSeries> series(2);
  for (PlotSeries& one : series)
    for (int k = 0; k < 4; ++k) one.points.push_back({5, 5 + 0.01 * k, "label"});
  std::vector<double> all = heights(svg_of({"t", "x", "y", series}), "label");
  REQUIRE(all.size() == 8);
  std::sort(all.begin(), all.end());
  for (std::size_t k = 1; k < all.size(); ++k) CHECK(all[k] - all[k - 1] > 10);
}

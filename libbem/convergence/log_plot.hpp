#pragma once

#include <string>
#include <vector>

namespace bem {

/// Points that a line connects in their order.
struct PlotSeries {
  struct Point {
    double x = 0, y = 0;  ///< > 0
    std::string label;
    bool marked = false;  ///< drawn larger
  };
  std::string name;
  std::string colour;  ///< of SVG
  std::vector<Point> points;
};

struct LogPlot {
  std::string title, x_name, y_name;
  std::vector<PlotSeries> series;
};

/// A self-contained SVG image of a plot with logarithmic axes. Points without a positive finite
/// place are left out.
std::string svg_of(const LogPlot& plot);

}  // namespace bem

#include "convergence/log_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bem {
namespace {

constexpr double kWidth = 720, kHeight = 440;
constexpr double kLeft = 70, kRight = 20, kTop = 46, kBottom = 56;

/// Two decimals, whatever the locale.
std::string coordinate(double value) {
  const long hundredths = std::lround(100 * value);
  char text[32];
  std::snprintf(text, sizeof text, "%s%ld.%02ld", hundredths < 0 ? "-" : "",
                std::abs(hundredths) / 100, std::abs(hundredths) % 100);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string text_at(double x, double y, const std::string& text, const std::string& attributes) {
  return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\"" + attributes + ">" +
         escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour) {
  return "<line x1=\"" + coordinate(x1) + "\" y1=\"" + coordinate(y1) + "\" x2=\"" +
         coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\" stroke=\"" + colour + "\"/>\n";
}

bool is_drawn(const PlotSeries::Point& p) {
  return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// The range of values in powers of ten, and where it lies in the image.
class Axis {
 public:
  Axis(double from, double to) : from_(from), to_(to) {}

  void include(double value) {
    low_ = std::min(low_, std::log10(value));
    high_ = std::max(high_, std::log10(value));
  }
  /// Leaves some room around the values.
  void finish() {
    if (low_ > high_) low_ = high_ = 0;
    constexpr double kLeast = 0.5, kRoom = 0.12;
    const double missing = std::max(kLeast - (high_ - low_), 0.0) / 2 + kRoom;
    low_ -= missing;
    high_ += missing;
  }
  double place(double value) const {
    return from_ + (to_ - from_) * (std::log10(value) - low_) / (high_ - low_);
  }
  /// Values with ticks: 1, 2 and 5 times powers of ten, or powers alone where that is many.
  std::vector<std::pair<double, std::string>> ticks() const;

 private:
  double from_, to_;
  double low_ = 300, high_ = -300;
};

/// 0.002, 500, 1e-05.
std::string tick_text(int digit, int power) {
  if (power < -4 || power > 4)
    return std::to_string(digit) + "e" + (power < 0 ? "-" : "+") +
           (std::abs(power) < 10 ? "0" : "") + std::to_string(std::abs(power));
  if (power >= 0) return std::to_string(digit) + std::string(static_cast<std::size_t>(power), '0');
  return "0." + std::string(static_cast<std::size_t>(-power - 1), '0') + std::to_string(digit);
}

std::vector<std::pair<double, std::string>> Axis::ticks() const {
  constexpr double kMany = 2.5;
  std::vector<std::pair<double, std::string>> out;
  for (int power = static_cast<int>(std::floor(low_)); power <= high_; ++power)
    for (int digit : {1, 2, 5}) {
      if (digit > 1 && high_ - low_ > kMany) continue;
      const double value = digit * std::pow(10, power);
      if (std::log10(value) >= low_ && std::log10(value) <= high_)
        out.emplace_back(value, tick_text(digit, power));
    }
  return out;
}

/// Finds places for labels, in the order in which they come, where they overlap no other one.
class LabelPlaces {
 public:
  /// The base line of a label of which one end is at `x`: `y`, or as few lines as possible below it
  /// or above it. Where all is full: `y`.
  double base_line(double x, double y, const std::string& label, bool ends_there, bool below) {
    constexpr double kCharacter = 6.2, kLine = 12;
    constexpr int kMostLines = 12;
    const double width = kCharacter * static_cast<double>(label.size());
    const double left = ends_there ? x - width : x;
    for (int k = 0; k <= 2 * kMostLines; ++k) {
      const double lines = (k % 2 == 1 ? 1 : -1) * ((k + 1) / 2) * (below ? 1.0 : -1.0);
      const double at = y + kLine * lines;
      const Box box{left, left + width, at - kLine, at};
      if (at < kTop + kLine || at > kHeight - kBottom || is_taken(box)) continue;
      taken_.push_back(box);
      return at;
    }
    return y;
  }

 private:
  struct Box {
    double left, right, top, bottom;
  };

  bool is_taken(const Box& box) const {
    return std::any_of(taken_.begin(), taken_.end(), [&](const Box& other) {
      return box.left < other.right && other.left < box.right && box.top < other.bottom &&
             other.top < box.bottom;
    });
  }

  std::vector<Box> taken_;
};

class Drawing {
 public:
  explicit Drawing(const LogPlot& plot)
      : plot_(plot), x_(kLeft, kWidth - kRight), y_(kHeight - kBottom, kTop) {
    for (const PlotSeries& series : plot.series)
      for (const PlotSeries::Point& p : series.points)
        if (is_drawn(p)) {
          x_.include(p.x);
          y_.include(p.y);
        }
    x_.finish();
    y_.finish();
  }

  std::string text() {
    out_ =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 440\" width=\"720\" "
        "height=\"440\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222\">\n"
        "<rect width=\"720\" height=\"440\" fill=\"#fff\"/>\n";
    axes();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) draw(plot_.series[i], i % 2 == 1);
    legend();
    return out_ + "</svg>\n";
  }

 private:
  void axes() {
    for (const auto& [value, text] : x_.ticks()) {
      out_ += line(x_.place(value), kTop, x_.place(value), kHeight - kBottom, "#ddd");
      out_ += text_at(x_.place(value), kHeight - kBottom + 17, text, " text-anchor=\"middle\"");
    }
    for (const auto& [value, text] : y_.ticks()) {
      out_ += line(kLeft, y_.place(value), kWidth - kRight, y_.place(value), "#ddd");
      out_ += text_at(kLeft - 6, y_.place(value) + 4, text, " text-anchor=\"end\"");
    }
    out_ += line(kLeft, kHeight - kBottom, kWidth - kRight, kHeight - kBottom, "#222");
    out_ += line(kLeft, kTop, kLeft, kHeight - kBottom, "#222");
    out_ += text_at(kWidth / 2, kHeight - 14, plot_.x_name, " text-anchor=\"middle\"");
    const std::string middle = coordinate((kTop + kHeight - kBottom) / 2);
    out_ += text_at(16, (kTop + kHeight - kBottom) / 2, plot_.y_name,
                    " text-anchor=\"middle\" transform=\"rotate(-90 16 " + middle + ")\"");
    out_ += text_at(kLeft, 20, plot_.title, " font-size=\"14\"");
  }

  /// Labels are above their points or below them, as near as there is room.
  void draw(const PlotSeries& series, bool below) {
    std::string path;
    for (const PlotSeries::Point& p : series.points)
      if (is_drawn(p)) path += coordinate(x_.place(p.x)) + "," + coordinate(y_.place(p.y)) + " ";
    out_ += "<polyline points=\"" + path + "\" fill=\"none\" stroke=\"" + series.colour +
            "\" stroke-width=\"1.5\"/>\n";
    for (const PlotSeries::Point& p : series.points) {
      if (!is_drawn(p)) continue;
      const double x = x_.place(p.x), y = y_.place(p.y);
      out_ += "<circle cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) + "\" r=\"" +
              (p.marked ? "6" : "3.5") + "\" fill=\"" + series.colour + "\"/>\n";
      if (!p.label.empty()) label(p, series.colour, below);
    }
  }

  void label(const PlotSeries::Point& p, const std::string& colour, bool below) {
    const bool turns = x_.place(p.x) > kWidth - 130;
    const double x = x_.place(p.x) + (turns ? -9 : 9);
    const double y = labels_.base_line(x, y_.place(p.y) + (below ? 15 : -6), p.label, turns, below);
    out_ += text_at(x, y, p.label,
                    std::string(" font-size=\"11\" text-anchor=\"") + (turns ? "end" : "start") +
                        "\" fill=\"" + colour + "\"");
  }

  void legend() {
    double x = kLeft;
    for (const PlotSeries& series : plot_.series) {
      out_ += "<circle cx=\"" + coordinate(x + 4) + "\" cy=\"34\" r=\"4\" fill=\"" + series.colour +
              "\"/>\n" + text_at(x + 13, 38, series.name, "");
      x += 30 + 6.6 * static_cast<double>(series.name.size());
    }
  }

  const LogPlot& plot_;
  Axis x_, y_;
  LabelPlaces labels_;
  std::string out_;
};

}  // namespace

std::string svg_of(const LogPlot& plot) {
  return Drawing(plot).text();
}

}  // namespace bem

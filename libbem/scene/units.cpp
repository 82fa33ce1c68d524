#include "scene/units.hpp"

#include "base/error.hpp"
#include "base/nearest_name.hpp"
#include "base/types.hpp"
#include "scene/location.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace bem {
namespace {

/// One of a unit is `numerator` / `denominator` in SI units. Decimal units have integers there, so
/// that "9 mm" is the double next to 0.009.
struct Unit {
  const char* name;
  double numerator, denominator;
  Dimension dimension;
};

constexpr Dimension kForce{1, 1, -2, 0};
constexpr Dimension kMass{0, 1, 0, 0};

constexpr std::array kUnits = {
    Unit{"m", 1, 1, dimension::length},
    Unit{"km", 1e3, 1, dimension::length},
    Unit{"dm", 1, 10, dimension::length},
    Unit{"cm", 1, 100, dimension::length},
    Unit{"mm", 1, 1e3, dimension::length},
    Unit{"um", 1, 1e6, dimension::length},
    Unit{"µm", 1, 1e6, dimension::length},
    Unit{"nm", 1, 1e9, dimension::length},
    Unit{"in", 254, 1e4, dimension::length},
    Unit{"ft", 3048, 1e4, dimension::length},
    Unit{"kg", 1, 1, kMass},
    Unit{"g", 1, 1e3, kMass},
    Unit{"mg", 1, 1e6, kMass},
    Unit{"t", 1e3, 1, kMass},
    Unit{"s", 1, 1, dimension::time},
    Unit{"ms", 1, 1e3, dimension::time},
    Unit{"us", 1, 1e6, dimension::time},
    Unit{"µs", 1, 1e6, dimension::time},
    Unit{"min", 60, 1, dimension::time},
    Unit{"h", 3600, 1, dimension::time},
    Unit{"N", 1, 1, kForce},
    Unit{"kN", 1e3, 1, kForce},
    Unit{"mN", 1, 1e3, kForce},
    Unit{"Pa", 1, 1, dimension::pressure},
    Unit{"hPa", 100, 1, dimension::pressure},
    Unit{"kPa", 1e3, 1, dimension::pressure},
    Unit{"MPa", 1e6, 1, dimension::pressure},
    Unit{"GPa", 1e9, 1, dimension::pressure},
    Unit{"bar", 1e5, 1, dimension::pressure},
    Unit{"mbar", 100, 1, dimension::pressure},
    Unit{"rad", 1, 1, dimension::angle},
    Unit{"mrad", 1, 1e3, dimension::angle},
    Unit{"deg", kPi / 180, 1, dimension::angle},
    Unit{"°", kPi / 180, 1, dimension::angle},
    Unit{"rev", 2 * kPi, 1, dimension::angle},
    Unit{"rpm", kPi / 30, 1, dimension::angular_velocity},
    Unit{"%", 1, 100, dimension::none},
};

struct NamedDimension {
  Dimension dimension;
  const char *name, *si, *example;
};

constexpr std::array kNamedDimensions = {
    NamedDimension{dimension::none, "a number", "", "40 %"},
    NamedDimension{dimension::length, "a length", "m", "12 mm"},
    NamedDimension{dimension::time, "a time", "s", "1.5 ms"},
    NamedDimension{dimension::angle, "an angle", "degrees", "30 deg"},
    NamedDimension{dimension::velocity, "a velocity", "m/s", "20 km/h"},
    NamedDimension{dimension::acceleration, "an acceleration", "m/s^2", "9.81 m/s^2"},
    NamedDimension{dimension::angular_velocity, "an angular velocity", "rad/s", "120 rpm"},
    NamedDimension{dimension::density, "a density", "kg/m^3", "1 g/cm^3"},
    NamedDimension{dimension::pressure, "a pressure", "Pa", "2 MPa"},
    NamedDimension{kMass, "a mass", "kg", "3 g"},
    NamedDimension{kForce, "a force", "N", "5 N"},
};

const NamedDimension* named(const Dimension& dimension) {
  for (const NamedDimension& known : kNamedDimensions)
    if (known.dimension == dimension) return &known;
  return nullptr;
}

/// "kg m^2 s^-1"
std::string si_unit(const Dimension& d) {
  std::string out;
  for (const auto& [name, power] : {std::pair{"kg", d.mass}, std::pair{"m", d.length},
                                    std::pair{"s", d.time}, std::pair{"rad", d.angle}})
    if (power != 0)
      out += (out.empty() ? "" : " ") + std::string(name) +
             (power == 1 ? "" : "^" + std::to_string(power));
  return out;
}

/// Reads a text from its beginning to its end.
class QuantityParser {
 public:
  explicit QuantityParser(const std::string& text) : text_(text), rest_(text) {}

  std::optional<Quantity> parse() {
    if (!take_number() || rest_.empty()) return std::nullopt;
    take_spaces();
    if (!take_factor(1)) return std::nullopt;
    while (!rest_.empty()) {
      const bool spaced = take_spaces();
      const bool divided = take("/");
      if (!divided && !take("*") && !take("·") && !spaced) return std::nullopt;
      take_spaces();
      if (!take_factor(divided ? -1 : 1)) return std::nullopt;
    }
    quantity_.value = in_si_units();
    if (!std::isfinite(quantity_.value)) throw out_of_range();
    return quantity_;
  }

 private:
  bool take(std::string_view token) {
    if (rest_.substr(0, token.size()) != token) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  bool take_spaces() {
    bool any = false;
    while (take(" ")) any = true;
    return any;
  }

  bool take_number() {
    const std::size_t sign = rest_.substr(0, 1) == "-" ? 1 : 0;
    if (rest_.find_first_of("0123456789.") != sign) return false;  // no infinity
    const auto [end, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number_);
    if (code == std::errc::result_out_of_range) throw out_of_range();
    if (code != std::errc()) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

  /// "m", "cm^3", "s^-2", "m²"
  bool take_factor(int sign) {
    std::size_t length = 0;
    while (length < rest_.size() && !is_end_of_name(rest_.substr(length))) ++length;
    if (length == 0) return false;
    const Unit& unit = unit_named(std::string(rest_.substr(0, length)));
    rest_.remove_prefix(length);
    const auto power = take_power();
    if (power) multiply(unit, sign * *power);
    return power.has_value();
  }

  static bool is_end_of_name(std::string_view rest) {
    for (std::string_view token : {" ", "*", "/", "^", "·", "²", "³"})
      if (rest.substr(0, token.size()) == token) return true;
    return false;
  }

  /// A digit from 1 to 9, and its sign.
  std::optional<int> take_power() {
    if (take("²")) return 2;
    if (take("³")) return 3;
    if (!take("^")) return 1;
    const int sign = take("-") ? -1 : 1;
    if (rest_.empty() || rest_[0] < '1' || rest_[0] > '9') return std::nullopt;
    const int digit = rest_[0] - '0';
    rest_.remove_prefix(1);
    return sign * digit;
  }

  const Unit& unit_named(const std::string& name) const {
    std::vector<std::string> names;
    for (const Unit& unit : kUnits) {
      if (unit.name == name || (name.substr(0, 2) == "μ" && unit.name == "µ" + name.substr(2)))
        return unit;
      names.emplace_back(unit.name);
    }
    const std::string nearest = nearest_name(name, names);
    std::string known;
    for (const std::string& other : names) known += (known.empty() ? "" : ", ") + other;
    throw Error(ErrorCode::invalid_input,
                "unknown unit " + in_quotes(name) + " in " + in_quotes(text_) +
                    (nearest.empty() ? "" : "; did you mean " + in_quotes(nearest) + "?") +
                    " (known: " + known + ")");
  }

  void multiply(const Unit& unit, int power) {
    for (int k = 0; k < std::abs(power); ++k) {
      numerator_ *= power > 0 ? unit.numerator : unit.denominator;
      denominator_ *= power > 0 ? unit.denominator : unit.numerator;
    }
    Dimension& d = quantity_.dimension;
    d.length += power * unit.dimension.length;
    d.mass += power * unit.dimension.mass;
    d.time += power * unit.dimension.time;
    d.angle += power * unit.dimension.angle;
  }

  double in_si_units() const {
    if (numerator_ >= denominator_ || denominator_ == 1)
      return number_ * (numerator_ / denominator_);
    return number_ / (denominator_ / numerator_);
  }

  Error out_of_range() const {
    return Error(ErrorCode::invalid_input, in_quotes(text_) + " is out of range");
  }

  const std::string& text_;
  std::string_view rest_;
  double number_ = 0, numerator_ = 1, denominator_ = 1;
  Quantity quantity_;
};

}  // namespace

std::string dimension_name(const Dimension& dimension) {
  if (const NamedDimension* known = named(dimension)) return known->name;
  return "a quantity in " + si_unit(dimension);
}

std::string dimension_help(const Dimension& dimension) {
  const NamedDimension* known = named(dimension);
  require(known != nullptr, "what scenes ask for has a name");
  return std::string("a number") + (*known->si ? " in " : "") + known->si +
         ", or a string such as \"" + known->example + '"';
}

std::optional<Quantity> parse_quantity(const std::string& text) {
  return QuantityParser(text).parse();
}

std::string quantity_pattern(bool non_negative) {
  std::string names;
  for (const Unit& unit : kUnits) names += (names.empty() ? "" : "|") + std::string(unit.name);
  const std::string factor = "(" + names + "|μm|μs)(\\^-?[1-9]|²|³)?";
  return std::string("^") + (non_negative ? "" : "-?") +
         "([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)? *" + factor + "(( *(\\*|/|·) *| +)" +
         factor + ")*$";
}

}  // namespace bem

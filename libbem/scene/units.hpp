#pragma once

#include <optional>
#include <string>

namespace bem {

/// What a quantity measures: the powers of metre, kilogram, second and radian of its SI unit.
struct Dimension {
  int length = 0, mass = 0, time = 0, angle = 0;

  constexpr bool operator==(const Dimension& other) const {
    return length == other.length && mass == other.mass && time == other.time &&
           angle == other.angle;
  }
};

/// Those of scenes and materials.
namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension angle{0, 0, 0, 1};
inline constexpr Dimension velocity{1, 0, -1, 0};
inline constexpr Dimension acceleration{1, 0, -2, 0};
inline constexpr Dimension angular_velocity{0, 0, -1, 1};
inline constexpr Dimension density{-3, 1, 0, 0};
inline constexpr Dimension pressure{-1, 1, -2, 0};
}  // namespace dimension

/// A dimension as messages name it: "a length", "a pressure", "a number" for none, and the SI unit
/// of those that have no name: "a quantity in kg m^2".
std::string dimension_name(const Dimension& dimension);

/// How one writes such a quantity: `a number in m, or a string such as "12 mm"`.
std::string dimension_help(const Dimension& dimension);

/// A number with its unit, in SI units (angles in radians).
struct Quantity {
  double value = 0;  ///< finite
  Dimension dimension;
};

/// Reads "12 mm", "9.81 m/s^2", "1 g/cm^3", "3 kg m^-3", "120 rpm": a number as JSON has them and
/// units (docs/scene-format.md, "Units"), of which * or a space multiply and / divides by the one
/// that follows. Nothing if the text is no number with a unit. The value is that of the decimal
/// number in SI units, as exactly as one division or multiplication gives it. Throws
/// ErrorCode::invalid_input for a unit that nobody knows, with the nearest one, and for a value
/// beyond the range of double.
std::optional<Quantity> parse_quantity(const std::string& text);

/// Regular expression (ECMA-262) of the texts that parse_quantity() accepts, but for values out of
/// range; without a minus sign before the number if `non_negative`.
std::string quantity_pattern(bool non_negative);

}  // namespace bem

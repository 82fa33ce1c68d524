#include "base/types.hpp"
#include "scene/material_json.hpp"
#include "scene/units.hpp"
#include "scene_examples.hpp"

#include <cmath>
#include <regex>

#include <catch2/catch.hpp>

using bem::Dimension;
using bem::parse_quantity;
namespace dimension = bem::dimension;

namespace {

void check_value(const std::string& text, double value, const Dimension& dimension) {
  INFO(text);
  const auto read = parse_quantity(text);
  REQUIRE(read);
  CHECK(read->value == value);
  CHECK(read->dimension == dimension);
}

/// The error of a scene whose body has these members.
std::string unit_error(const std::string& members) {
  return bem::test::scene_error(bem::test::scene_with_body(members));
}

}  // namespace

TEST_CASE("a quantity is the decimal number in SI units, to the last bit") {
  check_value("12 mm", 0.012, dimension::length);
  check_value("9 mm", 0.009, dimension::length);
  check_value("9mm", 0.009, dimension::length);
  check_value("-0.3 cm", -0.003, dimension::length);
  check_value("7 um", 7e-6, dimension::length);
  check_value("7 µm", 7e-6, dimension::length);
  check_value("7 μm", 7e-6, dimension::length);  // the Greek letter
  check_value("1 in", 0.0254, dimension::length);
  check_value("2 MPa", 2e6, dimension::pressure);
  check_value("1.5 ms", 0.0015, dimension::time);
  check_value("9.81 m/s^2", 9.81, dimension::acceleration);
  check_value("9.81 m/s²", 9.81, dimension::acceleration);
  check_value("9.81 m s^-2", 9.81, dimension::acceleration);
  check_value("7850 kg/m^3", 7850, dimension::density);
  check_value("1 g/cm^3", 1000, dimension::density);
  check_value("1.2 g / cm³", 1200, dimension::density);
  check_value("3e2 N/m^2", 300, dimension::pressure);
  check_value("3 kN/m/m", 3000, dimension::pressure);
  check_value("36 km/h", 10, dimension::velocity);
  check_value("30 deg", 30 * (bem::kPi / 180), dimension::angle);
  check_value("30°", 30 * (bem::kPi / 180), dimension::angle);
  check_value("120 rpm", 120 * (bem::kPi / 30), dimension::angular_velocity);
  check_value("2 rad/s", 2, dimension::angular_velocity);
  check_value("5 %", 0.05, dimension::none);
  check_value("2 N·m", 2, {2, 1, -2, 0});
}

TEST_CASE("a text without number or unit is no quantity") {
  for (const char* text : {"", "12", "mm", "inf m", "nan m", "+1 m", " 1 m", "1 m ", "1 m/", "1 m^",
                           "1 m^0", "1 m^x", "1 m//s", "1 /s", "--1 m"}) {
    INFO(text);
    CHECK(!parse_quantity(text));
  }
}

TEST_CASE("unknown units and values out of range are told of") {
  const auto complaint = [](const std::string& text) {
    return bem::test::message_of([&] { parse_quantity(text); });
  };
  CHECK(complaint("12 mmm").find("unknown unit \"mmm\" in \"12 mmm\"; did you mean \"mm\"? "
                                 "(known: m, km, dm, ") == 0);
  CHECK(complaint("2 mPa").find("did you mean \"MPa\"?") != std::string::npos);
  CHECK(complaint("1 parsec/s").find("unknown unit \"parsec\" in \"1 parsec/s\" (known") == 0);
  CHECK(complaint("1e400 m") == "\"1e400 m\" is out of range");
  CHECK(complaint("1e300 km^9") == "\"1e300 km^9\" is out of range");
}

TEST_CASE("the pattern of quantities accepts what the parser accepts") {
  const std::regex any(bem::quantity_pattern(false)), no_sign(bem::quantity_pattern(true));
  for (const char* text :
       {"12 mm",     "9mm",    "-.3 cm",  "3. m",   "1e-3 m", "9.81 m/s^2", "1 g / cm³",
        "3 kg m^-3", "2 N·m",  "2 N * m", "30°",    "7 μm",   "5 %",        "",
        "12",        "mm",     "1e m",    "1 m ",   " 1 m",   "1 m/",       "1 m^",
        "1 m^0",     "1 m//s", "1 m  s",  "1 m *s", "1 mm m", "1 mmm"}) {
    bool parsed = false;
    bem::test::message_of([&] { parsed = parse_quantity(text).has_value(); });
    INFO(text);
    CHECK(std::regex_search(text, any) == parsed);
    CHECK(std::regex_search(text, no_sign) == (parsed && text[0] != '-'));
  }
}

TEST_CASE("a scene means the same in numbers and in units") {
  const bem::Scene scene =
      bem::parse_scene("s.json", R"({"version": 1, "time_step": "10 ms", "duration": "1 min",
    "gravity": [0, "-981 cm/s^2", 0],
    "bodies": [{"name": "a", "archive": "a.bem", "position": ["1 mm", 2, "3 cm"], "velocity": ["36 km/h", 0, 0],
      "angular_velocity": [0, "60 rpm", "90 deg/s"], "rotation": {"axis": [0, 1, 0], "angle_deg": "0.5 rad"},
      "friction": "40 %",
      "handles": [{"select": {"box": {"min": ["-1 mm", 0, 0], "max": [1, 1, 1]}, "normal": [1, 0, 0],
                              "normal_tolerance_deg": "0.1 rad"},
                   "motion": [{"time": "1 ms", "translate": ["1 mm", 0, 0], "about": ["2 mm", 0, 0],
                               "rotate": {"axis": [1, 0, 0], "angle_deg": "30 deg"}}],
                   "release_time": "2 s"}],
      "tractions": [{"select": "all", "pressure": "1 kPa", "profile": [["1 ms", "50 %"]]},
                    {"select": "all", "traction": ["1 MPa", 0, 0]}]}],
    "obstacles": [{"name": "o", "plane": {"point": ["1 cm", 0, 0], "normal": [0, 1, 0]}},
                  {"name": "p", "mesh": "p.obj", "position": ["1 cm", 0, 0]}],
    "joints": [{"type": "point", "a": {"body": "a", "point": ["4 mm", 0, 0]}, "tolerance": "1 um"}],
    "contact": {"tolerance": "2 um"}})");
  CHECK(scene.time_step == 0.01);
  CHECK(scene.duration == 60);
  CHECK(scene.gravity == bem::Vec3(0, -9.81, 0));
  const bem::BodySpec& body = scene.bodies[0];
  CHECK(body.position == bem::Vec3(0.001, 2, 0.03));
  CHECK(body.velocity == bem::Vec3(10, 0, 0));
  CHECK((body.angular_velocity - bem::Vec3(0, 2 * bem::kPi, bem::kPi / 2)).norm() < 1e-15);
  CHECK(body.rotation.angle == 0.5);
  CHECK(body.friction == 0.4);
  const bem::HandleSpec& handle = body.handles[0];
  CHECK(handle.select.box_min[0] == -0.001);
  CHECK(handle.select.normal_tolerance == 0.1);
  CHECK(handle.motion[0].time == 0.001);
  CHECK(handle.motion[0].translate[0] == 0.001);
  CHECK(handle.motion[0].about[0] == 0.002);
  CHECK(handle.motion[0].rotate.angle == 30 * (bem::kPi / 180));
  CHECK(*handle.release_time == 2);
  CHECK(std::get<double>(body.tractions[0].load) == 1000);
  CHECK(body.tractions[0].profile[0].time == 0.001);
  CHECK(body.tractions[0].profile[0].factor == 0.5);
  CHECK(std::get<bem::Vec3>(body.tractions[1].load)[0] == 1e6);
  CHECK(std::get<bem::PlaneObstacle>(scene.obstacles[0].shape).point[0] == 0.01);
  CHECK(std::get<bem::MeshObstacle>(scene.obstacles[1].shape).position[0] == 0.01);
  CHECK(scene.joints[0].a.point[0] == 0.004);
  CHECK(scene.joints[0].tolerance == 1e-6);
  CHECK(scene.contact.tolerance == 2e-6);
}

TEST_CASE("a material means the same in numbers and in units") {
  const bem::Material material = bem::parse_material(
      "m.json", R"({"name": "x", "density": "1.07 g/cm^3", "youngs_modulus": "0.1 GPa",
                                        "poisson_ratio": "25 %", "time_step": "2 ms"})");
  CHECK(material.density == 1070);
  CHECK(material.shear_modulus == 0.1e9 / 2.5);
  CHECK(material.poisson_ratio == 0.25);
  CHECK(*material.time_step == 0.002);
}

TEST_CASE("a unit of another dimension is an error that names both") {
  CHECK(unit_error(",\"position\": [0, \"3 s\", 0]") ==
        "s.json:4:18: /bodies/0/position/1: expected a length, found a time, \"3 s\"");
  CHECK(unit_error(",\"friction\": \"3 m\"") ==
        "s.json:4:14: /bodies/0/friction: expected a number >= 0, found a length, \"3 m\"");
  CHECK(unit_error(",\"angular_velocity\": [\"3 s^-1\", 0, 0]") ==
        "s.json:4:23: /bodies/0/angular_velocity/0: expected an angular velocity, found a quantity "
        "in s^-1, "
        "\"3 s^-1\"");
  CHECK(unit_error(",\"position\": [0, \"3 mmm\", 0]")
            .find("s.json:4:18: /bodies/0/position/1: unknown unit \"mmm\" in \"3 mmm\"; did you "
                  "mean \"mm\"?") == 0);
  CHECK(unit_error(",\"position\": [0, \"3\", 0]") ==
        "s.json:4:18: /bodies/0/position/1: expected a length (a number in m, or a string such as "
        "\"12 mm\"), "
        "found the string \"3\"");
  CHECK(unit_error(",\"rotation\": {\"axis\": [0,0,1], \"angle_deg\": \"1 m\"}")
            .find("expected an angle, found a length, \"1 m\"") != std::string::npos);
  CHECK(bem::test::scene_error(bem::test::scene_with(",\"contact\": {\"tolerance\": \"-1 mm\"}")) ==
        "s.json:2:27: /contact/tolerance: expected a length > 0, found the string \"-1 mm\"");
}

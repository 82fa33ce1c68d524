#include "scene/material_json.hpp"
#include "scene_examples.hpp"

#include <catch2/catch.hpp>

using bem::Material;
using bem::parse_material;

namespace {

std::string material_error(const std::string& text) {
  return bem::test::message_of([&] { parse_material("m.json", text); });
}

std::string material_text(const std::string& ratio, const std::string& modulus) {
  return "{\"name\": \"rubber\", \"density\": 1000,\n \"poisson_ratio\": " + ratio + ",\n " +
         modulus + "}";
}

}  // namespace

TEST_CASE("a material is read in SI units") {
  const Material m = parse_material("m.json", material_text("0.25", "\"shear_modulus\": 4e3"));
  REQUIRE(m.name == "rubber");
  REQUIRE(m.density == 1000);
  REQUIRE(m.poisson_ratio == 0.25);
  REQUIRE(m.shear_modulus == 4000);
  REQUIRE_FALSE(m.time_step.has_value());
  REQUIRE(m.shear_speed() == 2);
  REQUIRE(m.kappa() == Approx(1. / 3).epsilon(1e-15));  // c1 = sqrt(3) c2 at nu = 1/4
}

TEST_CASE("Young's modulus is converted, a time step kept") {
  const Material m = parse_material(
      "m.json", material_text("0.5", "\"youngs_modulus\": 3e4, \"time_step\": 0.01"));
  REQUIRE(m.shear_modulus == Approx(1e4).epsilon(1e-15));
  REQUIRE(m.time_step.value() == 0.01);
  REQUIRE(m.kappa() == 0);
  REQUIRE(parse_material("m.json", material_text("0", "\"youngs_modulus\": 3e4")).shear_modulus ==
          1.5e4);
}

TEST_CASE("a wrong material is refused at its place") {
  const std::string mu = "\"shear_modulus\": 1";
  REQUIRE(material_error(material_text("0.3", mu)) == "");
  REQUIRE(material_error(material_text("0.51", mu)) ==
          "m.json:2:19: /poisson_ratio: expected a number from 0 to 0.5, found the number 0.51");
  REQUIRE(material_error(material_text("-0.1", mu)) ==
          "m.json:2:19: /poisson_ratio: expected a number from 0 to 0.5, found the number -0.1");
  REQUIRE(material_error(material_text("0.3", "\"shear_modulus\": 0")) ==
          "m.json:3:19: /shear_modulus: expected a pressure > 0, found the number 0");
  REQUIRE(material_error(material_text("0.3", "\"youngs_modulus\": -1")) ==
          "m.json:3:20: /youngs_modulus: expected a pressure > 0, found the number -1");
  REQUIRE(material_error(material_text("0.3", mu + ", \"youngs_modulus\": 1")) ==
          "m.json:3:22: /youngs_modulus: \"youngs_modulus\" is not allowed beside "
          "\"shear_modulus\"");
  REQUIRE(material_error(material_text("0.3", "\"time_step\": 1")) ==
          "m.json:1:1: one of the keys shear_modulus, youngs_modulus is required");
  REQUIRE(material_error(material_text("0.3", mu + ", \"time_step\": 0")) ==
          "m.json:3:35: /time_step: expected a time > 0, found the number 0");
  REQUIRE(material_error(material_text("0.3", mu + ", \"colour\": 0")) ==
          "m.json:3:22: /colour: unknown key (allowed: name, density, poisson_ratio, "
          "shear_modulus, youngs_modulus, time_step)");
  REQUIRE(material_error(material_text("0.3", "\"youngs_modulus\": 5e-324")) ==
          "m.json:1:1: the speed of shear waves, sqrt(shear modulus / density), is out of range");
  REQUIRE(material_error("{\"nmae\": \"x\"}") ==
          "m.json:1:2: /nmae: unknown key; did you mean \"name\"?");
  REQUIRE(material_error("[]") ==
          "m.json:1:1: expected a material (an object), found an empty array");
}

#include "scene/material_json.hpp"
#include "scene/named_materials.hpp"
#include "scene_examples.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

bem::Material material_of(const std::string& file, const std::string& json) {
  const bem::JsonDocument document = bem::JsonDocument::parse(file, json);
  return bem::read_material_value(bem::JsonValue(document, document.root()));
}

std::string named_material_error(const std::string& json) {
  return bem::test::message_of([&] { material_of("s.json", json); });
}

}  // namespace

TEST_CASE("named materials are valid, have a source, and stand in the documentation") {
  std::ifstream file(BEM_DOCS "/scene-format.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  REQUIRE(bem::named_materials().size() >= 8);
  for (const bem::NamedMaterial& named : bem::named_materials()) {
    INFO(named.name);
    const bem::Material material = bem::named_material(named.name);
    CHECK(material.name == named.name);
    CHECK(material.density > 500);
    CHECK(material.shear_modulus == named.youngs_modulus / (2 * (1 + named.poisson_ratio)));
    CHECK(material.poisson_ratio <= 0.5);
    CHECK(std::string(named.source).size() > 10);
    const auto row = text.find("| `" + std::string(named.name) + "` | ");
    REQUIRE(row != std::string::npos);
    std::istringstream cells(text.substr(text.find("| ", row + 5) + 2, 100));
    double density = 0, modulus = 0, ratio = 0;
    std::string bar;
    cells >> density >> bar >> modulus >> bar >> ratio;
    CHECK(density == named.density);
    CHECK(modulus == named.youngs_modulus);
    CHECK(ratio == named.poisson_ratio);
  }
}

TEST_CASE("a material is a name, a path or an object") {
  const fs::path folder = fs::temp_directory_path() / "bem_named_materials";
  fs::create_directories(folder);
  std::ofstream(folder / "rubber")
      << R"({"name": "mine", "density": 7, "youngs_modulus": 1, "poisson_ratio": 0})";
  fs::copy_file(folder / "rubber", folder / "own", fs::copy_options::overwrite_existing);
  const std::string scene = (folder / "scene.json").string();
  CHECK(material_of(scene, "\"rubber\"").density == 925);
  CHECK(material_of(scene, "\"./rubber\"").density == 7);
  CHECK(material_of(scene, "\"own\"").density == 7);
  CHECK(bem::find_material((folder / "own").string()).density == 7);
  CHECK(bem::find_material("steel").density == 7850);
  CHECK(
      material_of(
          scene, R"({"name": "x", "density": "2 g/cm^3", "youngs_modulus": 1, "poisson_ratio": 0})")
          .density == 2000);
  fs::remove_all(folder);
}

TEST_CASE("a misspelt material is answered with the names") {
  CHECK(named_material_error("\"ruber\"")
            .find("s.json:1:1: there is no material \"ruber\"; did you mean \"rubber\"? "
                  "(materials: soft silicone, ") == 0);
  CHECK(named_material_error("\"unobtainium\"")
            .find("there is no material \"unobtainium\" (materials: ") != std::string::npos);
  CHECK(named_material_error("\"no/rubber\"").find("no/rubber: cannot be opened") !=
        std::string::npos);
  CHECK(named_material_error("\"ruber.json\"").find("ruber.json: cannot be opened") !=
        std::string::npos);
  CHECK(named_material_error("7") ==
        "s.json:1:1: expected a material (a name, a path, or an object), found the number 7");
  CHECK(named_material_error("{\"name\": \"x\"}") ==
        "s.json:1:1: the required key \"density\" is missing");
}

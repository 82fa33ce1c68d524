#include "base/error.hpp"
#include "settings/precompute_settings.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

PrecomputeSettings with(std::vector<std::pair<std::string, std::string>> values) {
  PrecomputeSettings settings;
  for (const auto& [name, text] : values)
    for (const Setting& setting : precompute_settings())
      if (setting.name == name) setting.set(settings, "--" + name, text);
  return settings;
}

}  // namespace

TEST_CASE("Settings without values are the defaults of bemprecomp", "[settings]") {
  CHECK(with({}).canonical_text() ==
        "--scheme radau2 --discretisation galerkin --window auto --quadrature-tol 1e-06 --model "
        "dynamic --codec lowrank --codec-tol 1e-04 --corner-angle-deg 40");
  CHECK(with({{"discretisation", "collocation"}}).corner_angle() == std::nullopt);
  CHECK(with({{"model", "static"}}).scheme_name() == "bdf1");
}

TEST_CASE("Every setting that determines matrices is in the canonical text", "[settings]") {
  const std::vector<std::pair<std::string, std::string>> values = {
      {"scheme", "bdf2"},         {"discretisation", "collocation"},
      {"window", "0.5"},          {"model", "static"},
      {"history-tol", "0.001"},   {"history", "7"},
      {"quadrature-tol", "1e-5"}, {"codec", "none"},
      {"codec-tol", "0.01"},      {"inverse", "dense"},
      {"energies", "true"},       {"loads", "none"},
      {"corner-angle-deg", "33"}, {"damping", "kelvin_voigt:0.1"}};
  for (const auto& value : values) {
    INFO(value.first);
    CHECK(with({value}).canonical_text() != with({}).canonical_text());
  }
}

TEST_CASE("A value that a setting cannot have is refused by the setting's name", "[settings]") {
  const std::vector<std::pair<std::string, std::string>> wrong = {{"dt", "-1"},
                                                                  {"dt", "nan"},
                                                                  {"dt", "0.1x"},
                                                                  {"history", "1.5"},
                                                                  {"history", "0"},
                                                                  {"codec", "zip"},
                                                                  {"codec-tol", "1"},
                                                                  {"window", "1.1"},
                                                                  {"window", "-1"},
                                                                  {"damping", "0.1"},
                                                                  {"precision", "half"},
                                                                  {"inverse", "fast"},
                                                                  {"corner-angle-deg", "180"},
                                                                  {"discretisation", "fem"}};
  for (const auto& value : wrong) {
    INFO(value.first << " " << value.second);
    CHECK_THROWS_WITH(with({value}), Catch::Contains("--" + value.first));
  }
}

TEST_CASE("Settings that do not belong together are refused in the reader's words", "[settings]") {
  const PrecomputeSettings settings = with({{"codec", "none"}, {"codec-tol", "0.01"}});
  CHECK_THROWS_WITH(check_settings(settings, SettingStyle::option),
                    "--codec-tol belongs to --codec haar or --codec lowrank");
  CHECK_THROWS_WITH(check_settings(settings, SettingStyle::key),
                    "\"codec_tol\" belongs to \"codec\": \"haar\" or \"codec\": \"lowrank\"");
}

TEST_CASE("Energies need the Galerkin method and a dense inverse", "[settings]") {
  CHECK_THROWS_WITH(check_settings(with({{"energies", "true"}, {"discretisation", "collocation"}}),
                                   SettingStyle::option),
                    "--energies needs --discretisation galerkin");
  CHECK_THROWS_WITH(
      check_settings(with({{"energies", "true"}, {"inverse", "iterative"}}), SettingStyle::key),
      "\"energies\" needs \"inverse\": \"dense\"");
  CHECK_NOTHROW(
      check_settings(with({{"energies", "true"}, {"model", "static"}}), SettingStyle::key));
}

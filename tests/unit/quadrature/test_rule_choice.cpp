#include "quadrature/rule_choice.hpp"

#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

using bem::RuleChoice;

TEST_CASE("rules are chosen by distance as measured") {
  // 1e-6: 6 points beyond 7.5 diameters, 7 beyond 4.8, 12 beyond 2.3, 16 beyond 1.5, split below
  // 0.75
  const RuleChoice choice(1e-6);
  for (const auto& [ratio, beyond, within] : std::vector<std::tuple<double, int, int>>{
           {7.5, 2, 3}, {4.8, 3, 4}, {2.3, 4, 5}, {0.75, 7, -1}}) {
    CHECK(choice.choose(1.1 * ratio, 0) == beyond);
    CHECK(choice.choose(0.9 * ratio, 0) == within);
  }
  CHECK(choice.choose(0.5, 0) == -1);
  CHECK(choice.choose(1.0, 0) == 6);
  CHECK(choice.choose(30.0, 0) == 2);
}

TEST_CASE("tighter tolerances and oscillation never choose a smaller rule") {
  for (double ratio : {0.3, 0.6, 1.0, 3.0, 10.0, 40.0})
    for (double z : {0.0, 2.0, 5.0, 9.0}) {
      int last = 0;
      for (double tolerance : {1e-3, 1e-5, 1e-7, 1e-9}) {
        int rule = RuleChoice(tolerance).choose(ratio, z);
        if (rule < 0) rule = bem::kTriangleRuleCount;
        CHECK(rule >= last);
        last = rule;
      }
    }
  CHECK(RuleChoice(1e-6).choose(30, 8) > RuleChoice(1e-6).choose(30, 0));
  CHECK(RuleChoice(1e-8).choose(30, 100) == -1);
}

TEST_CASE("the oscillation limits every rule as measured") {
  // degree 6 (rule 4) leaves 5e-5 at Z = 8 and, by its sixth power, 1.05e-6 at Z = 4.2
  CHECK(RuleChoice(6e-5).choose(30, 8) == 4);
  CHECK(RuleChoice(4e-5).choose(30, 8) == 5);
  CHECK(RuleChoice(1.2e-6).choose(30, 4.2) == 4);
  CHECK(RuleChoice(0.9e-6).choose(30, 4.2) == 5);
}

#pragma once

#include "archive/archive_reader.hpp"
#include "common/archive_info.hpp"
#include "common/measure.hpp"
#include "model/time_estimate.hpp"
#include "plan.hpp"

#include <iosfwd>

#include <nlohmann/json.hpp>

namespace bem {

/// What is in an archive, for people; info_json() has the same.
void print_info(std::ostream& out, const Archive& archive);

/// What --dry-run prints.
void print_plan(std::ostream& out, const Plan& plan, const TimeEstimate& time);

/// What --stats writes.
nlohmann::ordered_json stats_json(const BodyModel& model, const std::string& archive,
                                  const PhaseTimer& timer,
                                  const std::vector<std::string>& warnings);

}  // namespace bem

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/sim/scenario.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "waylode/sim/detail/option_fields.hpp"

namespace waylode::sim {

namespace {

using core::ErrorCode;

/// Keeps the first complaint.
class RangeCheck {
 public:
  explicit RangeCheck(std::string where) : where_(std::move(where)) {}

  void operator()(const char* key, double value, double lowest, double highest) {
    if ((value >= lowest && value <= highest) || !complaint_.empty()) return;
    complaint_ = std::string(key) + " is out of range; give " + std::to_string(lowest) + " to " +
                 std::to_string(highest);
  }
  void operator()(const char* key, const std::optional<double>& value, double lowest,
                  double highest) {
    if (value) (*this)(key, *value, lowest, highest);
  }
  template <typename T>
  void operator()(const char*, const T&) {}

  core::Result<void> result() const {
    if (complaint_.empty()) return {};
    return core::fail(ErrorCode::kScenarioInvalid, complaint_, where_);
  }

 private:
  std::string where_;
  std::string complaint_;
};

core::Result<void> validate_walker(const Walker& walker, const Building& building) {
  const std::string where = "walker '" + walker.name + "'";
  const bool is_plain =
      !walker.name.empty() && std::all_of(walker.name.begin(), walker.name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
      });
  if (!is_plain) {
    return core::fail(ErrorCode::kScenarioInvalid,
                      "a walker's name becomes a file name; use letters, digits, '_' and '-'",
                      where);
  }
  if (walker.route.size() < 2) {
    return core::fail(ErrorCode::kScenarioInvalid, "the route needs at least two places", where);
  }
  for (const std::string& place : walker.route) {
    auto point = building.find_point(place);
    if (!point) return core::fail(ErrorCode::kScenarioInvalid, point.error().message, where);
  }
  RangeCheck check(where);
  detail::visit_gait(walker.gait, check);
  detail::visit_phone(walker.phone, check);
  check("start_s", walker.start_s, 0.0, 1e7);
  check("truth_interval_s", walker.truth_interval_s, 0.0, 3600.0);
  if (walker.truth_interval_s > 0.0)
    check("truth_interval_s", walker.truth_interval_s, 0.02, 3600.0);
  return check.result();
}

}  // namespace

core::Result<void> validate(const Scenario& scenario) {
  const std::size_t floor_count = scenario.building.floors.size();
  const bool is_whole = floor_count > 0 && scenario.building.radio_walls.size() == floor_count;
  if (!is_whole) {
    return core::fail(ErrorCode::kScenarioInvalid,
                      "the building has no floor; make it with parse_ascii_building or "
                      "building_from_plans");
  }
  RangeCheck check("scenario '" + scenario.name + "'");
  detail::visit_radio(scenario.radio, check);
  detail::visit_magnetic(scenario.magnetic, check);
  detail::visit_air(scenario.air, check);
  if (auto ranges = check.result(); !ranges) return ranges;
  std::set<std::string> names;
  for (const Walker& walker : scenario.walkers) {
    if (!names.insert(walker.name).second) {
      return core::fail(ErrorCode::kScenarioInvalid,
                        "two walkers are named '" + walker.name + "'; rename one");
    }
    if (auto valid = validate_walker(walker, scenario.building); !valid) return valid;
  }
  return {};
}

}  // namespace waylode::sim

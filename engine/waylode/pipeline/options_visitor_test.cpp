// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/options_visitor.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>

namespace waylode::pipeline {
namespace {

/// Converts to anything: counts the members of an aggregate by how many it can be made from.
struct Anything {
  template <typename T>
  operator T() const;  // NOLINT(google-explicit-constructor)
};
template <typename T, typename... Args>
constexpr std::size_t member_count() {
  if constexpr (requires { T{Args{}..., Anything{}}; }) {
    return member_count<T, Args..., Anything>();
  } else {
    return sizeof...(Args);
  }
}

double value_of(const OptionRef& option) {
  return std::visit(
      [](const auto& target) -> double {
        if constexpr (requires { target.get(); }) {
          return static_cast<double>(target.get());
        } else {
          return static_cast<double>(*target);
        }
      },
      option.target);
}

TEST(ForEachOption, VisitsEveryMemberOfEveryComponent) {
  Options options;
  std::map<std::string, std::size_t> visited;
  for_each_option(options, [&](const OptionRef& option) { ++visited[std::string(option.table)]; });
  const std::map<std::string, std::size_t> expected = {
      {"scan", member_count<radio::ScanAssembler::Options>() + 1},  // And bluetooth_alone_after_s.
      {"matcher", member_count<radio::Matcher::Options>()},
      {"wknn", member_count<radio::WknnEstimator::Options>()},
      {"pdr", member_count<pdr::DeadReckoning::Options>() - 4},  // Less its four components.
      {"pdr.gravity", member_count<pdr::GravityFilter::Options>()},
      {"pdr.heading", member_count<pdr::HeadingFilter::Options>()},
      {"pdr.step", member_count<pdr::StepDetector::Options>()},
      {"pdr.stride", member_count<pdr::StrideModel::Options>()},
      {"fused.planar", member_count<fusion::PlanarTracker::Options>()},
      {"fused.floor", member_count<fusion::FloorFilter::Options>()},
      {"fused.state", member_count<fusion::StateRules>()},
      {"smoothing", member_count<smoothing::TrackSmoother::Options>() - 1},  // Less `fused`.
      {"labels", member_count<survey::LabelledPath::Options>()},
      {"moving", member_count<survey::MovingTransmitterFilter::Options>()}};
  EXPECT_EQ(visited, expected);
  EXPECT_EQ(member_count<Options>(), 9U);
}

TEST(ForEachOption, DefaultsLieInTheirRanges) {
  Options options;
  for_each_option(options, [](const OptionRef& option) {
    if (std::holds_alternative<Choice>(option.target)) return;
    EXPECT_GE(value_of(option), option.smallest) << option.table << "." << option.name;
    EXPECT_LE(value_of(option), option.largest) << option.table << "." << option.name;
  });
}

TEST(ForEachOption, NamesAreUniqueAndCommentsAreWholeSentences) {
  Options options;
  std::set<std::pair<std::string, std::string>> names;
  for_each_option(options, [&](const OptionRef& option) {
    EXPECT_TRUE(names.emplace(option.table, option.name).second) << option.name;
    EXPECT_TRUE(option.comment.ends_with('.')) << option.name;
  });
}

TEST(ForEachOption, WritesThroughToTheOptions) {
  Options options;
  for_each_option(options, [](const OptionRef& option) {
    if (option.name == "distance") std::get<Choice>(option.target).set(1);
    if (option.name == "rounds") *std::get<int*>(option.target) = 7;
  });
  EXPECT_EQ(options.matcher.distance, radio::Distance::kManhattan);
  EXPECT_EQ(options.smoothing_rounds, 7);
  options.smoothing_rounds = Options{}.smoothing_rounds;
  options.matcher.distance = Options{}.matcher.distance;
  EXPECT_EQ(options, Options{});
}

}  // namespace
}  // namespace waylode::pipeline

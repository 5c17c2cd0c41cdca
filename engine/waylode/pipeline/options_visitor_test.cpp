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

/// Options per table.
using Counts = std::map<std::string, std::size_t>;

Counts expected_radio() {
  constexpr std::size_t kNearest = member_count<radio::RegionWknn::Options>();
  return {
      {"scan", member_count<radio::ScanAssembler::Options>() + 1},  // And bluetooth_alone_after_s.
      {"matcher", member_count<radio::Matcher::Options>()},
      {"wknn", member_count<radio::WknnEstimator::Options>()},
      {"places", member_count<radio::PlaceLikelihood::Options>() - 1},  // Less its component.
      {"response", member_count<radio::DeviceResponse::Options>()},
      {"places.signal", member_count<radio::SignalField::Options>()},
      {"references",
       member_count<radio::ReferenceMap::Options>() - 1 +  // Less `filter`, which is here too.
           member_count<radio::DomainFilter::Options>()},
      {"knn", member_count<radio::KnnPositioner::Options>()},
      {"region", kNearest},
      {"window",
       member_count<radio::WindowKnn::Options>() - 1 +  // Less `windows`, four rows of it.
           4 * member_count<radio::WindowKnn::Window>()},
      {"circle", member_count<radio::CircleKnn::Options>()},
      // Less the recipe's `kind` and three components, one of which is here too, without its
      // optional gauss_rate.
      {"regression", member_count<radio::RegressionPositioner::Options>() - 4 +
                         member_count<learn::SupportVectorRegression::Options>() - 1},
      {"regression.kernel", member_count<learn::Kernel::Options>()},
      // Relevance vectors without the kernel; the fit without its optional noise_variance.
      {"regression.relevance", member_count<learn::RelevanceVectorRegression::Options>() - 2 +
                                   member_count<learn::SparseBayesFit::Options>() - 1},
      {"regression.scaler", member_count<learn::InputScaler::Options>()},
      {"field", member_count<Options::FieldMatch>() - 3},  // Less its three components.
      {"field.grid", member_count<magnetic::FieldGrid::Options>()},
      {"field.sequence", member_count<magnetic::SequenceMatcher::Options>()},
      {"field.guesses", member_count<magnetic::FieldLikelihood::Options>()},
  };
}

Counts expected_pdr() {
  return {
      // Less ten components and three choices of the recipe.
      {"pdr", member_count<pdr::DeadReckoning::Options>() - 13},
      {"pdr.pressure", member_count<pdr::PressureClimb::Options>()},
      {"pdr.gravity", member_count<pdr::GravityFilter::Options>()},
      {"pdr.heading", member_count<pdr::HeadingFilter::Options>()},
      {"pdr.compass", member_count<pdr::CompassHeadingFilter::Options>()},
      {"pdr.step", member_count<pdr::StepDetector::Options>()},
      {"pdr.cadence", member_count<pdr::CadenceStepDetector::Options>()},
      {"pdr.adaptive_peaks",
       member_count<pdr::AdaptivePeakDetector::Options>() - 1 +
           pdr::AdaptivePeakDetector::kGaitCount * member_count<pdr::AdaptivePeakDetector::Band>()},
      {"pdr.gaussian_peaks", member_count<pdr::GaussianPeakDetector::Options>()},
      {"pdr.extrema", member_count<pdr::ExtremumStepDetector::Options>() - 1 +
                          member_count<pdr::Decimator::Options>()},
      // Less the recipe's rule and one component.
      {"pdr.step_validity", member_count<pdr::StepValidity::Options>() - 2},
      {"pdr.excursion", member_count<pdr::ExcursionJudge::Options>()},
  };
}

Counts expected_fusion() {
  constexpr std::size_t kFilter =
      member_count<fusion::StepPositionFilter::Options>() - 1 + member_count<fusion::SigmaSpread>();
  return {
      {"fused.planar", member_count<fusion::PlanarTracker::Options>()},
      {"fused.floor", member_count<fusion::FloorFilter::Options>()},
      {"fused.state", member_count<fusion::StateRules>()},
      {"particles", member_count<fusion::ParticleFilter::Options>()},
      // Both smoothers' less their trackers.
      {"smoothing", member_count<smoothing::TrackSmoother::Options>() - 1 +
                        member_count<smoothing::ParticleSmoother::Options>() - 1},
      {"plan", member_count<site::Walkability::Options>()},
      {"decision", member_count<fusion::DecisionFlow::Options>() - 2},  // Less mode and filter.
      {"decision.filter", kFilter},
      // Less the recipe's robust_filter and filter_blend, and four components.
      {"interval", member_count<fusion::ZhouTracker::Options>() - 6},
      {"interval.weighting", member_count<fusion::IntervalWeighting::Options>()},
      {"interval.velocity_filter", member_count<fusion::ConstantVelocityFilter::Options>()},
      {"interval.blend", member_count<fusion::VelocityBlend::Options>() - 2 +
                             2 * member_count<fusion::VelocityBlend::Shares>()},
      {"interval.filter", kFilter},
      {"feedback", member_count<fusion::FeedbackTracker::Options>() - 1},  // Less its filter.
      {"feedback.filter", kFilter},
  };
}

Counts expected_survey() {
  return {
      {"labels", member_count<survey::LabelledPath::Options>()},
      {"moving", member_count<survey::MovingTransmitterFilter::Options>() + 1},  // And evidence.
      // The components' members are here too.
      {"magnetic_survey", member_count<survey::MagneticSurvey::Options>() - 2 +
                              member_count<site::MagneticMapBuilder::Options>() +
                              member_count<pdr::GravityFilter::Options>()},
  };
}

TEST(ForEachOption, VisitsEveryMemberOfEveryComponent) {
  Options options;
  Counts visited;
  for_each_option(options, [&](const OptionRef& option) { ++visited[std::string(option.table)]; });
  Counts expected = expected_radio();
  expected.merge(expected_pdr());
  expected.merge(expected_fusion());
  expected.merge(expected_survey());
  // stride=three_term has a table of its own; the recipe chooses the model.
  EXPECT_EQ(visited["pdr.stride"] + visited["pdr.stride_laws"],
            member_count<pdr::StrideModel::Options>() - 2 + member_count<pdr::StrideGains>());
  visited.erase("pdr.stride");
  visited.erase("pdr.stride_laws");
  for (const auto& [table, count] : expected) EXPECT_EQ(visited[table], count) << table;
  EXPECT_EQ(visited.size(), expected.size());
  EXPECT_EQ(member_count<Options>(), 28U);
}

TEST(ForEachOption, VisitsNothingTwice) {
  Options options;
  std::set<const void*> seen;
  for_each_option(options, [&](const OptionRef& option) {
    std::visit(
        [&](const auto& target) {
          if constexpr (!requires { target.get(); }) {
            EXPECT_TRUE(seen.insert(target).second) << option.table << "." << option.name;
          }
        },
        option.target);
  });
}

TEST(ForEachOption, ChoicesKeepWhatIsSet) {
  Options options;
  for_each_option(options, [](const OptionRef& option) {
    const auto* choice = std::get_if<Choice>(&option.target);
    if (choice == nullptr) return;
    const std::size_t before = choice->get();
    EXPECT_LT(before, choice->names.size()) << option.table << "." << option.name;
    for (std::size_t i = 0; i < choice->names.size(); ++i) {
      choice->set(i);
      EXPECT_EQ(choice->get(), i) << option.table << "." << option.name;
    }
    choice->set(before);
  });
  EXPECT_EQ(options, Options{});
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

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/method.hpp"

#include <algorithm>
#include <vector>

namespace waylode::pipeline {
namespace {

using std::chrono::seconds;
using Stride = pdr::StrideModel::Model;

Recipe with_fusion(FusionPart fusion) {
  Recipe recipe;
  recipe.fusion = fusion;
  return recipe;
}

/// By particles, who feel the magnetic field as well.
Recipe by_particles(FusionPart fusion) {
  Recipe recipe = with_fusion(fusion);
  recipe.magnetic = MagneticPart::kGuesses;
  return recipe;
}

Recipe plain_pdr() {
  Recipe recipe = with_fusion(FusionPart::kDeadReckoning);
  recipe.radio = RadioPart::kNone;
  return recipe;
}

Recipe wu2019() {
  Recipe recipe;
  recipe.steps = pdr::DeadReckoning::Detector::kAdaptivePeaks;
  recipe.stride = Stride::kImproved;
  recipe.learns_stride = true;
  recipe.heading = pdr::DeadReckoning::HeadingSource::kCompass;
  recipe.radio = RadioPart::kRegionWknn;
  recipe.fusion = FusionPart::kUnscented;
  return recipe;
}

Recipe zhou2016() {
  Recipe recipe;
  recipe.stride = Stride::kWeinberg;
  recipe.heading = pdr::DeadReckoning::HeadingSource::kCompass;
  recipe.radio = RadioPart::kWindowKnn;
  recipe.magnetic = MagneticPart::kSequence;
  recipe.fusion = FusionPart::kRawTerms;
  return recipe;
}

Recipe zhao2019() {
  Recipe recipe;
  recipe.steps = pdr::DeadReckoning::Detector::kGaussianPeaks;
  recipe.stride = Stride::kImproved;
  recipe.heading = pdr::DeadReckoning::HeadingSource::kCompass;
  recipe.radio = RadioPart::kRelevanceVectors;
  recipe.fusion = FusionPart::kFeedback;
  return recipe;
}

Recipe zhong2017() {
  Recipe recipe = plain_pdr();
  recipe.steps = pdr::DeadReckoning::Detector::kExtrema;
  recipe.validity = pdr::DeadReckoning::Validity::kExcursion;
  recipe.stride = Stride::kChen;
  recipe.heading = pdr::DeadReckoning::HeadingSource::kCompass;
  return recipe;
}

std::vector<Method> make_methods() {
  return {
      {"wknn",
       with_fusion(FusionPart::kNewestScan),
       {},
       "weighted k nearest fingerprints of the newest scan",
       "[TorresSospedra2015]",
       "radio map, Wi-Fi"},
      {"pdr",
       plain_pdr(),
       {},
       "steps, step length and heading from a known start",
       "[Weinberg2002]",
       "a start, accelerometer, gyroscope, compass"},
      {"wu2019",
       wu2019(),
       {},
       "region WKNN, adaptive peaks, two-term stride, UKF",
       "[Wu2019]",
       "radio map, Wi-Fi, motion sensors"},
      {"zhou2016",
       zhou2016(),
       {},
       "filtered KNN, magnetic matching, KF of all terms",
       "[Zhou2016]",
       "radio and magnetic map, Wi-Fi, motion sensors"},
      {"zhao2019",
       zhao2019(),
       {},
       "relevance vectors, KNN around the steps, guard",
       "[Zhao2019]",
       "radio map, Wi-Fi, motion sensors"},
      {"zhong2017",
       zhong2017(),
       {},
       "steps that move, stride by height and frequency",
       "[Zhong2017]",
       "a start, accelerometer, gyroscope, compass"},
      {"fused",
       by_particles(FusionPart::kParticles),
       {},
       "particle filter of scans, steps, magnetic field and plan",
       "own",
       "radio map, Wi-Fi; plan, magnetic map, motion sensors if there"},
      {"smoothed_lag5", by_particles(FusionPart::kFixedLag), seconds(5),
       "fused, answering 5 s late", "[Kitagawa1996]", "as fused"},
      {"smoothed_lag10", by_particles(FusionPart::kFixedLag), seconds(10),
       "fused, answering 10 s late", "[Kitagawa1996]", "as fused"},
      {"smoothed_lag30", by_particles(FusionPart::kFixedLag), seconds(30),
       "fused, answering 30 s late", "[Kitagawa1996]", "as fused"},
      {"smoothed",
       by_particles(FusionPart::kWholeTrack),
       {},
       "fused, each instant knowing its future",
       "[Kitagawa1996]",
       "as fused, the whole recording"},
  };
}

/// What no choice of options can mend.
core::Result<void> check_mixture(const Method& method) {
  const auto refuse = [&](const char* message) {
    return core::fail(core::ErrorCode::kInvalidArgument, message, method.name);
  };
  const Recipe& recipe = method.recipe;
  const bool lagging = recipe.fusion == FusionPart::kFixedLag;
  if (lagging != (method.lag > core::Duration{})) {
    return refuse("fusion=fixed_lag comes with the methods smoothed_lag5, _lag10 and _lag30 alone");
  }
  if (recipe.radio == RadioPart::kNone && recipe.fusion != FusionPart::kDeadReckoning) {
    return refuse("without radio only fusion=dead_reckoning works; choose a radio part");
  }
  const bool feels =
      recipe.fusion == FusionPart::kMagnetic || recipe.fusion == FusionPart::kIntervals ||
      recipe.fusion == FusionPart::kIntervalsUnfiltered || recipe.fusion == FusionPart::kRawTerms;
  if (recipe.magnetic == MagneticPart::kSequence && !feels) {
    return refuse(
        "magnetic places are used by fusion=magnetic, intervals, intervals_unfiltered and "
        "raw_terms alone");
  }
  return {};
}

}  // namespace

std::span<const Method> methods() {
  static const std::vector<Method> all = make_methods();
  return all;
}

core::Result<Method> find_method(std::string_view name) {
  const std::size_t plus = name.find('+');
  const auto found = std::ranges::find(methods(), name.substr(0, plus), &Method::name);
  if (found == methods().end()) {
    std::string known;
    for (const Method& method : methods()) known += (known.empty() ? "" : ", ") + method.name;
    return core::fail(core::ErrorCode::kMethodUnknown, "no such method; known are " + known,
                      std::string(name));
  }
  Method method = *found;
  if (plus == std::string_view::npos) return method;
  method.name = name;
  method.summary = found->name + " with other parts";
  for (std::size_t from = plus; from != std::string_view::npos;) {
    const std::size_t to = name.find('+', from + 1);
    if (auto chosen = choose_part(method.recipe, name.substr(from + 1, to - from - 1)); !chosen) {
      return tl::unexpected(chosen.error());
    }
    from = to;
  }
  if (auto sensible = check_mixture(method); !sensible) return tl::unexpected(sensible.error());
  return method;
}

}  // namespace waylode::pipeline

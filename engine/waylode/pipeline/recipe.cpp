// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/recipe.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "waylode/core/assert.hpp"

namespace waylode::pipeline {
namespace {

using Detector = pdr::DeadReckoning::Detector;
using Validity = pdr::DeadReckoning::Validity;
using Stride = pdr::StrideModel::Model;
using Heading = pdr::DeadReckoning::HeadingSource;

constexpr void choose_stride(Recipe& recipe, Stride model, bool learns) {
  recipe.stride = model;
  recipe.learns_stride = learns;
}

// The lambdas do not capture: they are plain functions.
constexpr std::array kParts = {
    Part{"steps", "threshold", "peaks above a share of the walker's own", "own",
         [](Recipe& r) { r.steps = Detector::kThreshold; }},
    Part{"steps", "cadence", "peaks expected by the running rhythm, any placement", "own",
         [](Recipe& r) { r.steps = Detector::kCadence; }},
    Part{"steps", "adaptive_peaks", "peak threshold by state of motion, weight decaying in time",
         "[Wu2019]", [](Recipe& r) { r.steps = Detector::kAdaptivePeaks; }},
    Part{"steps", "gaussian_peaks", "one peak of the Gaussian-smoothed signal, one step",
         "[Zhao2019]", [](Recipe& r) { r.steps = Detector::kGaussianPeaks; }},
    Part{"steps", "extrema", "maximum above p, then minimum below q, at 25 Hz", "[Zhong2017]",
         [](Recipe& r) { r.steps = Detector::kExtrema; }},

    Part{"validity", "off", "every step moves", "own",
         [](Recipe& r) { r.validity = Validity::kOff; }},
    Part{"validity", "dispersion", "no steps while the direction is scattered", "[Zhong2017]",
         [](Recipe& r) { r.validity = Validity::kLiteral; }},
    Part{"validity", "three_way", "walking, turning while walking, stepping on the spot",
         "[Zhong2017]", [](Recipe& r) { r.validity = Validity::kThreeWay; }},

    Part{"validity", "excursion", "no steps while aside of the course and soon back on it", "own",
         [](Recipe& r) { r.validity = Validity::kExcursion; }},

    Part{"stride", "three_term", "constant, swing and cadence", "own",
         [](Recipe& r) { choose_stride(r, Stride::kThreeTerm, false); }},
    Part{"stride", "weinberg", "K (a_max - a_min)^(1/4)", "[Weinberg2002]",
         [](Recipe& r) { choose_stride(r, Stride::kWeinberg, false); }},
    Part{"stride", "scarlett", "K (a_avg - a_min) / (a_max - a_min)", "[Wu2019]",
         [](Recipe& r) { choose_stride(r, Stride::kScarlett, false); }},
    Part{"stride", "kim", "K (mean |a|)^(1/3)", "[Wu2019]",
         [](Recipe& r) { choose_stride(r, Stride::kKim, false); }},
    Part{"stride", "improved", "K1 mean|a| T + K2 (a_max - a_min)^(1/4)", "[Wu2019]",
         [](Recipe& r) { choose_stride(r, Stride::kImproved, false); }},
    Part{"stride", "improved_learnt", "the same, K1 and K2 corrected on line by scans", "[Wu2019]",
         [](Recipe& r) { choose_stride(r, Stride::kImproved, true); }},
    Part{"stride", "chen", "height and step frequency", "[Zhong2017]",
         [](Recipe& r) { choose_stride(r, Stride::kChen, false); }},
    Part{"stride", "proportional", "a share of the height", "[Zhong2017]",
         [](Recipe& r) { choose_stride(r, Stride::kProportional, false); }},
    Part{"stride", "table", "height by steps in two seconds", "[Zhong2017]",
         [](Recipe& r) { choose_stride(r, Stride::kTable, false); }},

    Part{"heading", "rotation_vector", "gyroscope held to the phone's own attitude", "own",
         [](Recipe& r) { r.heading = Heading::kRotationVector; }},
    Part{"heading", "compass", "gyroscope held to the levelled field where it is undisturbed",
         "[Wu2019]", [](Recipe& r) { r.heading = Heading::kCompass; }},

    Part{"radio", "none", "no radio", "own", [](Recipe& r) { r.radio = RadioPart::kNone; }},
    Part{"radio", "wknn", "weighted k nearest scans, Sorensen and cosine", "[TorresSospedra2015]",
         [](Recipe& r) { r.radio = RadioPart::kWknn; }},
    Part{"radio", "knn", "k nearest reference points by signal distance", "[Zhao2019]",
         [](Recipe& r) { r.radio = RadioPart::kKnn; }},
    Part{"radio", "region_wknn", "weighted nearest in the region of the strongest transmitter",
         "[Wu2019]", [](Recipe& r) { r.radio = RadioPart::kRegionWknn; }},
    Part{"radio", "window_knn", "nearest of the points that most transmitters accept", "[Zhou2016]",
         [](Recipe& r) { r.radio = RadioPart::kWindowKnn; }},
    Part{"radio", "relevance_vectors", "regression with spline, Gauss and Laplace kernels",
         "[Zhao2019]", [](Recipe& r) { r.radio = RadioPart::kRelevanceVectors; }},
    Part{"radio", "support_vectors", "epsilon support vector regression", "[Zhao2019]",
         [](Recipe& r) { r.radio = RadioPart::kSupportVectors; }},

    Part{"magnetic", "none", "no magnetic matching", "own",
         [](Recipe& r) { r.magnetic = MagneticPart::kNone; }},
    Part{"magnetic", "sequence", "mean square difference along the way walked", "[Zhou2016]",
         [](Recipe& r) { r.magnetic = MagneticPart::kSequence; }},
    Part{"magnetic", "guesses", "how the field along each step fits each particle's way", "own",
         [](Recipe& r) { r.magnetic = MagneticPart::kGuesses; }},

    Part{"fusion", "newest_scan", "the newest scan alone", "own",
         [](Recipe& r) { r.fusion = FusionPart::kNewestScan; }},
    Part{"fusion", "dead_reckoning", "steps from a start: one told, else the first scan",
         "[Wu2019]", [](Recipe& r) { r.fusion = FusionPart::kDeadReckoning; }},
    Part{"fusion", "particles",
         "particle filter on the plan; radio bias, heading, stride as states", "[Kitagawa1996]",
         [](Recipe& r) { r.fusion = FusionPart::kParticles; }},
    Part{"fusion", "fixed_lag", "the same, each instant knowing the next seconds", "[Kitagawa1996]",
         [](Recipe& r) { r.fusion = FusionPart::kFixedLag; }},
    Part{"fusion", "whole_track", "the same, each instant knowing the next minute",
         "[Kitagawa1996]", [](Recipe& r) { r.fusion = FusionPart::kWholeTrack; }},
    Part{"fusion", "robust", "robust causal Kalman tracker, without a plan", "own",
         [](Recipe& r) { r.fusion = FusionPart::kRobust; }},
    Part{"fusion", "robust_whole", "the same, forwards and back over the recording", "[Rauch1965]",
         [](Recipe& r) { r.fusion = FusionPart::kRobustWhole; }},
    Part{"fusion", "unscented", "unscented Kalman filter, a correction at every scan", "[Wu2019]",
         [](Recipe& r) { r.fusion = FusionPart::kUnscented; }},
    Part{"fusion", "unscented_when_large", "the same, only where steps and scan differ much",
         "[Wu2019]", [](Recipe& r) { r.fusion = FusionPart::kUnscentedWhenLarge; }},
    Part{"fusion", "pairs", "the last pairs of step and scan positions shift the track (literal)",
         "[Wu2019]", [](Recipe& r) { r.fusion = FusionPart::kPairs; }},
    Part{"fusion", "magnetic", "the newest magnetic place, carried on by the steps", "[Zhou2016]",
         [](Recipe& r) { r.fusion = FusionPart::kMagnetic; }},
    Part{"fusion", "intervals_unfiltered", "as intervals, without the Kalman filter behind",
         "[Zhou2016]", [](Recipe& r) { r.fusion = FusionPart::kIntervalsUnfiltered; }},
    Part{"fusion", "intervals", "weights by interval, blended speed and heading, Kalman filter",
         "[Zhou2016]", [](Recipe& r) { r.fusion = FusionPart::kIntervals; }},
    Part{"fusion", "raw_terms", "one Kalman filter with radio, field and steps as they are",
         "[Zhou2016]", [](Recipe& r) { r.fusion = FusionPart::kRawTerms; }},
    Part{"fusion", "feedback", "scans matched around the steps, guarded by whole-map fixes",
         "[Zhao2019]", [](Recipe& r) { r.fusion = FusionPart::kFeedback; }},
    Part{"fusion", "feedback_literal", "the same without guard, each step from the last match",
         "[Zhao2019]", [](Recipe& r) { r.fusion = FusionPart::kFeedbackLiteral; }},
};

/// Whether `part` is what fills its slot: choosing it again changes nothing.
bool is_chosen(const Recipe& recipe, const Part& part) {
  Recipe again = recipe;
  part.choose(again);
  return again == recipe;
}

/// The names for which `member` is wanted, each once, in order.
template <typename Select>
std::string list_names(const Select& select) {
  std::string text;
  std::string_view last;
  for (const Part& part : kParts) {
    const std::string_view name = select(part);
    if (name.empty() || name == last) continue;
    text += (text.empty() ? "" : ", ") + std::string(name);
    last = name;
  }
  return text;
}

}  // namespace

std::span<const Part> parts() { return kParts; }

core::Result<void> choose_part(Recipe& recipe, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string_view slot = assignment.substr(0, equals);
  const std::string_view name =
      equals == std::string_view::npos ? std::string_view() : assignment.substr(equals + 1);
  const auto chosen = std::ranges::find_if(
      kParts, [&](const Part& part) { return part.slot == slot && part.name == name; });
  if (chosen != kParts.end()) {
    chosen->choose(recipe);
    return {};
  }
  const std::string known =
      list_names([slot](const Part& part) { return part.slot == slot ? part.name : ""; });
  const std::string message =
      known.empty() ? "no such slot; write SLOT=PART with a slot of " +
                          list_names([](const Part& part) { return part.slot; })
                    : "no such part for " + std::string(slot) + "; known are " + known;
  return core::fail(core::ErrorCode::kMethodUnknown, message, std::string(assignment));
}

std::string_view part_name(const Recipe& recipe, std::string_view slot) {
  for (const Part& part : kParts) {
    if (part.slot == slot && is_chosen(recipe, part)) return part.name;
  }
  WAYLODE_ASSERT(false);
  return {};
}

}  // namespace waylode::pipeline

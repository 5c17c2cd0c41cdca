// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/method.hpp"

#include <algorithm>
#include <array>

namespace waylode::pipeline {
namespace {

using std::chrono::seconds;

constexpr std::array kMethods = {
    Method{"wknn",
           MethodKind::kWknn,
           {},
           "weighted k nearest fingerprints of the newest scan",
           "[TorresSospedra2015]",
           "radio map, Wi-Fi"},
    Method{"pdr",
           MethodKind::kPdr,
           {},
           "steps, step length and heading from a known start",
           "[Weinberg2002]",
           "a start, accelerometer, gyroscope, compass"},
    Method{"fused",
           MethodKind::kFused,
           {},
           "robust causal Kalman tracker of scans and steps",
           "own",
           "radio map, Wi-Fi; motion sensors if there"},
    Method{"smoothed_lag5", MethodKind::kFixedLag, seconds(5), "fused, answering 5 s late",
           "[Rauch1965]", "as fused"},
    Method{"smoothed_lag10", MethodKind::kFixedLag, seconds(10), "fused, answering 10 s late",
           "[Rauch1965]", "as fused"},
    Method{"smoothed_lag30", MethodKind::kFixedLag, seconds(30), "fused, answering 30 s late",
           "[Rauch1965]", "as fused"},
    Method{"smoothed",
           MethodKind::kWholeTrack,
           {},
           "fused over the whole track, forwards and back",
           "[Rauch1965]",
           "as fused, the whole recording"},
};

}  // namespace

std::span<const Method> methods() { return kMethods; }

core::Result<Method> find_method(std::string_view name) {
  const auto found = std::ranges::find(kMethods, name, &Method::name);
  if (found != kMethods.end()) return *found;
  std::string known;
  for (const Method& method : kMethods) {
    known += (known.empty() ? "" : ", ") + std::string(method.name);
  }
  return core::fail(core::ErrorCode::kMethodUnknown, "no such method; known are " + known,
                    std::string(name));
}

}  // namespace waylode::pipeline

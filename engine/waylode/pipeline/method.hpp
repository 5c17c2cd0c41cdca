// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"

namespace waylode::pipeline {

enum class MethodKind { kWknn, kPdr, kFused, kFixedLag, kWholeTrack };

/// A named, configured way to positions; `waylode methods` lists them.
struct Method {
  std::string_view name;
  MethodKind kind = MethodKind::kFused;
  core::Duration lag{};  ///< How late an answer comes; only for kFixedLag.
  std::string_view summary;
  std::string_view source;
  std::string_view needs;

  bool whole_track() const { return kind == MethodKind::kWholeTrack; }
};

std::span<const Method> methods();
/// kMethodUnknown, naming the known ones.
core::Result<Method> find_method(std::string_view name);

}  // namespace waylode::pipeline

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/core/time.hpp"
#include "waylode/pipeline/recipe.hpp"

namespace waylode::pipeline {

/// A named, configured way to positions; `waylode methods` lists them.
struct Method {
  std::string name;
  Recipe recipe;
  core::Duration lag{};  ///< How late an answer comes; above zero for fusion=fixed_lag alone.
  std::string summary;
  std::string source;
  std::string needs;

  bool whole_track() const {
    return recipe.fusion == FusionPart::kWholeTrack || recipe.fusion == FusionPart::kRobustWhole;
  }
  /// Cannot find a start by itself.
  bool needs_start() const { return recipe.radio == RadioPart::kNone; }
};

/// The named methods, in the order they are listed.
std::span<const Method> methods();

/// A named method, or a mixture: a named method with parts replaced, such as
/// "wu2019+stride=kim+fusion=pairs". kMethodUnknown, naming what is known; kInvalidArgument for a
/// mixture that makes no sense.
core::Result<Method> find_method(std::string_view name);

}  // namespace waylode::pipeline

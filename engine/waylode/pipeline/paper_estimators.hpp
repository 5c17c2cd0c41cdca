// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "waylode/pipeline/estimator.hpp"
#include "waylode/pipeline/recipe.hpp"

namespace waylode::pipeline {

/// The fusion of one of the papers, or null when `part` is none of them.
std::unique_ptr<Estimator> make_paper_estimator(FusionPart part, const Model& model,
                                                const SessionOptions& options);

}  // namespace waylode::pipeline

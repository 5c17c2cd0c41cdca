// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "waylode/pipeline/estimator.hpp"

namespace waylode::pipeline {

/// The particle filter: causal, late by the method's lag, or over the whole track. `method` has one
/// of these fusions.
std::unique_ptr<Estimator> make_particle_estimator(const Model& model, const Method& method,
                                                   const SessionOptions& options);

}  // namespace waylode::pipeline

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/input_scaler.hpp"

#include <algorithm>
#include <cmath>

namespace waylode::learn {

core::Result<void> InputScaler::Options::validate() const {
  if (!(clip_low >= -10.0 && clip_low <= 0.0 && clip_high >= 1.0 && clip_high <= 10.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "clip_low must be in [-10, 0] and clip_high in [1, 10]", "input scaler");
  }
  return {};
}

core::Result<InputScaler> InputScaler::learn(const Eigen::MatrixXd& inputs,
                                             const Options& options) {
  if (inputs.size() == 0 || !inputs.allFinite()) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the training inputs are empty or not finite; leave such samples out");
  }
  const double low = inputs.minCoeff();
  const double span = inputs.maxCoeff() - low;
  return from_range(low, span > 0.0 ? span : 1.0, options);
}

core::Result<InputScaler> InputScaler::from_range(double low, double span, const Options& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  // A span that has no reciprocal would turn inputs into infinities.
  if (!std::isfinite(low) || !(span > 0.0) || !std::isfinite(span) || !std::isfinite(1.0 / span)) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the range of the inputs must be finite and not vanish");
  }
  return InputScaler(low, span, options);
}

Eigen::MatrixXd InputScaler::scale(const Eigen::MatrixXd& inputs) const {
  return inputs.unaryExpr([this](double value) {
    return std::clamp((value - low_) / span_, options_.clip_low, options_.clip_high);
  });
}

}  // namespace waylode::learn

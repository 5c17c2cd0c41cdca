// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "waylode/core/result.hpp"

namespace waylode::learn {

/// Maps inputs to [0, 1] by one affine map for all columns, which are of one unit (signal
/// strengths of several transmitters), so that distances keep their proportions. Later inputs
/// beyond what was learnt from are clipped: a kernel model is not to be asked far outside.
class InputScaler {
 public:
  struct Options {
    double clip_low = -0.2;  ///< In scaled units, in [-10, 0].
    double clip_high = 1.2;  ///< In scaled units, in [1, 10].

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// From the smallest to the largest value of the training inputs. Equal values all map to 0.
  /// kInvalidArgument for an empty or non-finite matrix.
  static core::Result<InputScaler> learn(const Eigen::MatrixXd& inputs, const Options& options);
  /// Input `low` maps to 0 and `low + span` to 1. kInvalidArgument unless span > 0, all finite.
  static core::Result<InputScaler> from_range(double low, double span, const Options& options);

  /// NaN stays NaN.
  Eigen::MatrixXd scale(const Eigen::MatrixXd& inputs) const;

  double low() const { return low_; }
  double span() const { return span_; }
  const Options& options() const { return options_; }
  bool operator==(const InputScaler&) const = default;

 private:
  InputScaler(double low, double span, const Options& options)
      : low_(low), span_(span), options_(options) {}

  double low_;
  double span_;
  Options options_;
};

}  // namespace waylode::learn

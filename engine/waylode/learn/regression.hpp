// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/learn/input_scaler.hpp"
#include "waylode/learn/relevance_vector_regression.hpp"
#include "waylode/learn/support_vector_regression.hpp"

namespace waylode::learn {

/// Several values of one input, such as the two coordinates of a place: one regressor each, behind
/// a common scaling of the inputs. Samples are rows.
class Regression {
 public:
  using Regressor = std::variant<RelevanceVectorRegression, SupportVectorRegression>;

  struct Options {
    InputScaler::Options scaler{};
    /// Which kind of regressor, and how it is trained.
    std::variant<RelevanceVectorRegression::Options, SupportVectorRegression::Options> regressor{};

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  struct Estimate {
    Eigen::MatrixXd mean;  ///< A row per input, a column per output.
    /// As mean; nullopt if a regressor knows no sigma.
    std::optional<Eigen::MatrixXd> sigma;
  };

  /// A row of `targets` per row of `inputs`, a column per output. kInvalidOptions, or
  /// kInvalidArgument for what the regressors refuse or no output.
  static core::Result<Regression> train(const Eigen::MatrixXd& inputs,
                                        const Eigen::MatrixXd& targets, const Options& options);
  /// kInvalidArgument unless there are outputs, all of the same dimensions.
  static core::Result<Regression> from_parts(const InputScaler& scaler,
                                             std::vector<Regressor> outputs);

  /// kInvalidArgument for another number of columns than trained with, or non-finite inputs.
  core::Result<Estimate> predict(const Eigen::MatrixXd& inputs) const;

  const InputScaler& scaler() const { return scaler_; }
  const std::vector<Regressor>& outputs() const { return outputs_; }
  /// Columns of an input.
  Eigen::Index dimensions() const;

 private:
  Regression(const InputScaler& scaler, std::vector<Regressor> outputs)
      : scaler_(scaler), outputs_(std::move(outputs)) {}

  InputScaler scaler_;
  std::vector<Regressor> outputs_;
};

struct PlaceEstimate {
  core::Vector2 position_m;
  core::Matrix2 covariance_m2;  ///< Diagonal: the coordinates are learnt apart.
};

/// Of one input, for a regression of x and y in metres. kInvalidArgument when it has not two
/// outputs, knows no sigma, or cannot predict.
core::Result<PlaceEstimate> predict_place(const Regression& regression,
                                          const Eigen::VectorXd& input);

}  // namespace waylode::learn

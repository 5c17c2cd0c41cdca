// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "waylode/core/result.hpp"

namespace waylode::learn {

/// Epsilon support vector regression with a Gaussian kernel, trained by libsvm. [Smola2004]
/// It is the baseline of [Zhao2019] and, other than relevance vectors, has no sigma.
class SupportVectorRegression {
 public:
  struct Options {
    double cost = 1.0;     ///< C in (0, 1e6]: what a unit of error beyond epsilon costs.
    double epsilon = 0.1;  ///< Errors below cost nothing; not negative, in the targets' unit.
    /// Of exp(-rate |x-y|^2), positive. nullopt: 1 over columns times variance of all inputs.
    std::optional<double> gauss_rate = std::nullopt;
    double tolerance = 1e-3;  ///< Of the optimality conditions; in [1e-9, 1].

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  struct Model {
    double gauss_rate = 1.0;
    double bias = 0.0;
    Eigen::MatrixXd vectors;  ///< Support vectors, one a row.
    Eigen::VectorXd weights;  ///< One per vector: alpha_i - alpha_i*.
  };

  /// Samples are rows of `inputs`. kInvalidOptions, or kInvalidArgument for no samples, sizes that
  /// do not match, no column, and values that are not finite. The same input gives the same model.
  static core::Result<SupportVectorRegression> train(const Eigen::MatrixXd& inputs,
                                                     const Eigen::VectorXd& targets,
                                                     const Options& options);
  /// kInvalidArgument when sizes do not match, a value is not finite or the rate not positive.
  static core::Result<SupportVectorRegression> from_model(Model model);

  /// kInvalidArgument for another number of columns than trained with, or non-finite inputs.
  core::Result<Eigen::VectorXd> predict(const Eigen::MatrixXd& inputs) const;

  const Model& model() const { return model_; }
  std::size_t vector_count() const { return static_cast<std::size_t>(model_.vectors.rows()); }
  /// Columns of an input.
  Eigen::Index dimensions() const { return model_.vectors.cols(); }

 private:
  explicit SupportVectorRegression(Model model) : model_(std::move(model)) {}

  Model model_;
};

}  // namespace waylode::learn

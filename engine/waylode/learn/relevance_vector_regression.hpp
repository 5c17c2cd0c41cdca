// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "waylode/core/result.hpp"
#include "waylode/learn/kernel.hpp"
#include "waylode/learn/sparse_bayes.hpp"

namespace waylode::learn {

/// Values at several inputs, and how sure: the regressor's sigma*, noise included. It takes the
/// vectors and precisions kept for certain, so it is too small where samples are few: about right
/// for 200 of a curve, but of 48 places with 8 transmitters half of the errors exceed it, not a
/// third.
struct Prediction {
  Eigen::VectorXd mean;
  Eigen::VectorXd sigma;
};

/// Relevance vector regression: z = sum_i w_i k(x, x_i) + w_0 + noise, where the evidence decides
/// which few training inputs x_i keep a weight. [Zhao2019] eq. (1)-(8)
class RelevanceVectorRegression {
 public:
  struct Options {
    Kernel::Options kernel{};
    SparseBayesFit::Options fit{};
    bool bias = true;  ///< The column of ones, w_0, with a precision of its own.
    /// The targets' mean is taken off first, and put back: w_0 has not to reach far from zero.
    bool centre_targets = true;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// What a trained model consists of, to be saved.
  struct Model {
    Kernel::Options kernel{};
    double offset = 0.0;         ///< Added to every mean.
    bool has_bias = false;       ///< Whether the first weight is w_0.
    Eigen::MatrixXd vectors;     ///< Relevance vectors, one a row, as scaled for training.
    Eigen::VectorXd weights;     ///< mu: w_0 if there is one, then one per vector.
    Eigen::MatrixXd covariance;  ///< Sigma of the weights.
    double noise_variance = 0.0;
  };

  /// Samples are rows of `inputs`, at least two. kInvalidOptions, or kInvalidArgument for too few
  /// samples, sizes that do not match, no column, and values that are not finite.
  static core::Result<RelevanceVectorRegression> train(const Eigen::MatrixXd& inputs,
                                                       const Eigen::VectorXd& targets,
                                                       const Options& options);
  /// kInvalidArgument when sizes do not match, a value is not finite, there is no noise, or the
  /// covariance is not symmetric and positive semidefinite.
  static core::Result<RelevanceVectorRegression> from_model(Model model);

  /// [Zhao2019] eq. (6). kInvalidArgument for another number of columns than trained with, or an
  /// input that is not finite or so far out that its kernel is not.
  core::Result<Prediction> predict(const Eigen::MatrixXd& inputs) const;

  const Model& model() const { return model_; }
  std::size_t vector_count() const { return static_cast<std::size_t>(model_.vectors.rows()); }
  /// Columns of an input.
  Eigen::Index dimensions() const { return model_.vectors.cols(); }

 private:
  RelevanceVectorRegression(Kernel kernel, Model model)
      : kernel_(kernel), model_(std::move(model)) {}

  Kernel kernel_;
  Model model_;
};

/// How training went; a model read from a file knows no more of it.
struct RelevanceVectorTraining {
  RelevanceVectorRegression regression;
  SparseBayesFit fit;
};

/// As RelevanceVectorRegression::train, with the fit told.
core::Result<RelevanceVectorTraining> train_relevance_vectors(
    const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets,
    const RelevanceVectorRegression::Options& options);

/// The kernel under which the targets are most probable after training; the first of equals.
/// kInvalidArgument without kernels, and the first failure to train. [Zhao2019] leaves the weights
/// and rates of eq. (9)-(12) open.
core::Result<Kernel::Options> choose_kernel(const Eigen::MatrixXd& inputs,
                                            const Eigen::VectorXd& targets,
                                            std::span<const Kernel::Options> kernels,
                                            RelevanceVectorRegression::Options options);

}  // namespace waylode::learn

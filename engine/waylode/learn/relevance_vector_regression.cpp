// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/relevance_vector_regression.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::learn {
namespace {

using core::ErrorCode;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Model = RelevanceVectorRegression::Model;

core::Result<void> check(const MatrixXd& inputs, const VectorXd& targets) {
  const auto refuse = [](const char* message) {
    return core::fail(ErrorCode::kInvalidArgument, message);
  };
  if (inputs.rows() < 2) {
    return refuse("relevance vectors need two samples or more: one shows no noise");
  }
  if (inputs.cols() == 0) return refuse("the inputs have no column; give at least one");
  if (inputs.rows() != targets.size()) return refuse("there must be one target per sample");
  if (!inputs.allFinite() || !targets.allFinite()) {
    return refuse("a sample is not finite; leave it out");
  }
  return {};
}

/// phi of every input, as a row: 1 if there is a bias, then a kernel value per vector.
/// [Zhao2019] eq. (4)
MatrixXd design_matrix(const Kernel& kernel, const MatrixXd& inputs, const MatrixXd& vectors,
                       bool bias) {
  MatrixXd design(inputs.rows(), vectors.rows() + (bias ? 1 : 0));
  if (bias) design.col(0).setOnes();
  design.rightCols(vectors.rows()) = kernel.matrix(inputs, vectors);
  return design;
}

Model model_of(const SparseBayesFit& fit, const MatrixXd& inputs, double offset,
               const RelevanceVectorRegression::Options& options) {
  Model model;
  model.kernel = options.kernel;
  model.offset = offset;
  model.has_bias = options.bias && !fit.columns.empty() && fit.columns.front() == 0;
  const Index first_kernel = options.bias ? 1 : 0;
  std::vector<Index> rows;
  for (const Index column : fit.columns) {
    if (column >= first_kernel) rows.push_back(column - first_kernel);
  }
  model.vectors = inputs(rows, Eigen::all);
  model.weights = fit.posterior.mean;
  model.covariance = fit.posterior.covariance;
  model.noise_variance = fit.noise_variance;
  return model;
}

/// Rounding may leave an eigenvalue this far below zero, relative to the largest entry.
constexpr double kCovarianceTolerance = 1e-9;

bool is_covariance(const MatrixXd& matrix) {
  if (matrix.rows() != matrix.cols() || !matrix.allFinite()) return false;
  if (matrix.size() == 0) return true;
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!std::isfinite(static_cast<double>(matrix.rows()) * largest)) return false;
  if (((matrix - matrix.transpose()).cwiseAbs().array() > kCovarianceTolerance * largest).any()) {
    return false;
  }
  if (largest == 0.0) return true;
  MatrixXd raised = matrix / largest;
  raised.diagonal().array() += kCovarianceTolerance;
  return raised.llt().info() == Eigen::Success;
}

}  // namespace

core::Result<void> RelevanceVectorRegression::Options::validate() const {
  if (const auto valid = kernel.validate(); !valid) return valid;
  return fit.validate();
}

core::Result<RelevanceVectorTraining> train_relevance_vectors(
    const MatrixXd& inputs, const VectorXd& targets,
    const RelevanceVectorRegression::Options& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (const auto valid = check(inputs, targets); !valid) return tl::unexpected(valid.error());
  const auto kernel = Kernel::create(options.kernel);
  const double offset = options.centre_targets ? targets.mean() : 0.0;
  auto fit = fit_sparse_bayes(design_matrix(*kernel, inputs, inputs, options.bias),
                              targets.array() - offset, options.fit);
  if (!fit) return tl::unexpected(fit.error());
  auto regression = RelevanceVectorRegression::from_model(model_of(*fit, inputs, offset, options));
  if (!regression) return tl::unexpected(regression.error());
  return RelevanceVectorTraining{*std::move(regression), *std::move(fit)};
}

core::Result<RelevanceVectorRegression> RelevanceVectorRegression::train(const MatrixXd& inputs,
                                                                         const VectorXd& targets,
                                                                         const Options& options) {
  auto training = train_relevance_vectors(inputs, targets, options);
  if (!training) return tl::unexpected(training.error());
  return std::move(training->regression);
}

core::Result<RelevanceVectorRegression> RelevanceVectorRegression::from_model(Model model) {
  const auto refuse = [](const char* message) {
    return core::fail(ErrorCode::kInvalidArgument, message, "relevance vector model");
  };
  const auto kernel = Kernel::create(model.kernel);
  if (!kernel) return tl::unexpected(kernel.error());
  if (model.vectors.cols() == 0 ||
      model.weights.size() != model.vectors.rows() + (model.has_bias ? 1 : 0) ||
      model.covariance.rows() != model.weights.size()) {
    return refuse("its vectors, weights and covariance do not match");
  }
  if (!model.vectors.allFinite() || !model.weights.allFinite() || !std::isfinite(model.offset)) {
    return refuse("a value is not finite");
  }
  if (!(model.noise_variance > 0.0) || !std::isfinite(model.noise_variance)) {
    return refuse("its noise variance is not positive");
  }
  if (!is_covariance(model.covariance)) return refuse("its covariance is none");
  return RelevanceVectorRegression(*kernel, std::move(model));
}

core::Result<Prediction> RelevanceVectorRegression::predict(const MatrixXd& inputs) const {
  if (inputs.cols() != dimensions()) {
    return core::fail(ErrorCode::kInvalidArgument,
                      "an input must have as many columns as those trained with");
  }
  const MatrixXd design = design_matrix(kernel_, inputs, model_.vectors, model_.has_bias);
  Prediction prediction;
  prediction.mean = (design * model_.weights).array() + model_.offset;
  const MatrixXd spread = design * model_.covariance;
  prediction.sigma =
      (model_.noise_variance + spread.cwiseProduct(design).rowwise().sum().array().max(0.0)).sqrt();
  // Without vectors, an input that is not finite leaves no trace in the result.
  if (!inputs.allFinite() || !prediction.mean.allFinite() || !prediction.sigma.allFinite()) {
    return core::fail(ErrorCode::kInvalidArgument,
                      "an input is not finite or far outside of what was trained with; scale it");
  }
  return prediction;
}

core::Result<Kernel::Options> choose_kernel(const MatrixXd& inputs, const VectorXd& targets,
                                            std::span<const Kernel::Options> kernels,
                                            RelevanceVectorRegression::Options options) {
  if (kernels.empty()) {
    return core::fail(ErrorCode::kInvalidArgument, "there is no kernel to choose from; give some");
  }
  const Kernel::Options* best = nullptr;
  double best_log_evidence = 0.0;
  for (const Kernel::Options& kernel : kernels) {
    options.kernel = kernel;
    const auto training = train_relevance_vectors(inputs, targets, options);
    if (!training) return tl::unexpected(training.error());
    const double log_evidence = training->fit.posterior.log_evidence;
    if (best == nullptr || log_evidence > best_log_evidence) {
      best = &kernel;
      best_log_evidence = log_evidence;
    }
  }
  return *best;
}

}  // namespace waylode::learn

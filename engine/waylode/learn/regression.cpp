// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/regression.hpp"

#include <algorithm>

namespace waylode::learn {
namespace {

using core::ErrorCode;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Regressor = Regression::Regressor;

core::Result<Regressor> train_one(const MatrixXd& inputs, const VectorXd& targets,
                                  const RelevanceVectorRegression::Options& options) {
  auto trained = RelevanceVectorRegression::train(inputs, targets, options);
  if (!trained) return tl::unexpected(trained.error());
  return Regressor(*std::move(trained));
}

core::Result<Regressor> train_one(const MatrixXd& inputs, const VectorXd& targets,
                                  const SupportVectorRegression::Options& options) {
  auto trained = SupportVectorRegression::train(inputs, targets, options);
  if (!trained) return tl::unexpected(trained.error());
  return Regressor(*std::move(trained));
}

struct OneEstimate {
  VectorXd mean;
  std::optional<VectorXd> sigma;
};

core::Result<OneEstimate> predict_one(const RelevanceVectorRegression& regressor,
                                      const MatrixXd& inputs) {
  return regressor.predict(inputs).map([](Prediction&& prediction) {
    return OneEstimate{std::move(prediction.mean), std::move(prediction.sigma)};
  });
}

core::Result<OneEstimate> predict_one(const SupportVectorRegression& regressor,
                                      const MatrixXd& inputs) {
  return regressor.predict(inputs).map(
      [](VectorXd&& mean) { return OneEstimate{std::move(mean), std::nullopt}; });
}

Index dimensions_of(const Regressor& regressor) {
  return std::visit([](const auto& one) { return one.dimensions(); }, regressor);
}

}  // namespace

core::Result<void> Regression::Options::validate() const {
  if (const auto valid = scaler.validate(); !valid) return valid;
  return std::visit([](const auto& options) { return options.validate(); }, regressor);
}

core::Result<Regression> Regression::train(const MatrixXd& inputs, const MatrixXd& targets,
                                           const Options& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  const auto scaler = InputScaler::learn(inputs, options.scaler);
  if (!scaler) return tl::unexpected(scaler.error());
  const MatrixXd scaled = scaler->scale(inputs);
  std::vector<Regressor> outputs;
  for (Index column = 0; column < targets.cols(); ++column) {
    const VectorXd values = targets.col(column);
    auto regressor = std::visit([&](const auto& how) { return train_one(scaled, values, how); },
                                options.regressor);
    if (!regressor) return tl::unexpected(regressor.error());
    outputs.push_back(*std::move(regressor));
  }
  return from_parts(*scaler, std::move(outputs));
}

core::Result<Regression> Regression::from_parts(const InputScaler& scaler,
                                                std::vector<Regressor> outputs) {
  if (outputs.empty()) {
    return core::fail(ErrorCode::kInvalidArgument, "a regression needs an output; give targets");
  }
  const bool equal = std::ranges::all_of(outputs, [&](const Regressor& regressor) {
    return dimensions_of(regressor) == dimensions_of(outputs.front());
  });
  if (!equal) {
    return core::fail(ErrorCode::kInvalidArgument,
                      "the outputs of a regression must be of the same inputs");
  }
  return Regression(scaler, std::move(outputs));
}

Index Regression::dimensions() const { return dimensions_of(outputs_.front()); }

core::Result<Regression::Estimate> Regression::predict(const MatrixXd& inputs) const {
  // Clipping would take an infinite input for the limit.
  if (!inputs.allFinite()) {
    return core::fail(ErrorCode::kInvalidArgument, "an input is not finite; leave it out");
  }
  const MatrixXd scaled = scaler_.scale(inputs);
  const auto size = static_cast<Index>(outputs_.size());
  Estimate estimate{MatrixXd(inputs.rows(), size), MatrixXd(inputs.rows(), size)};
  for (Index column = 0; column < size; ++column) {
    const auto one =
        std::visit([&](const auto& regressor) { return predict_one(regressor, scaled); },
                   outputs_[static_cast<std::size_t>(column)]);
    if (!one) return tl::unexpected(one.error());
    estimate.mean.col(column) = one->mean;
    if (!one->sigma) estimate.sigma.reset();
    if (estimate.sigma) estimate.sigma->col(column) = *one->sigma;
  }
  return estimate;
}

core::Result<PlaceEstimate> predict_place(const Regression& regression, const VectorXd& input) {
  if (regression.outputs().size() != 2) {
    return core::fail(ErrorCode::kInvalidArgument, "a place has two outputs, x and y");
  }
  const auto estimate = regression.predict(input.transpose());
  if (!estimate) return tl::unexpected(estimate.error());
  if (!estimate->sigma) {
    return core::fail(ErrorCode::kInvalidArgument,
                      "support vectors have no sigma; use relevance vectors for places");
  }
  PlaceEstimate place;
  place.position_m = estimate->mean.row(0).transpose();
  place.covariance_m2 = estimate->sigma->row(0).transpose().cwiseAbs2().asDiagonal();
  return place;
}

}  // namespace waylode::learn

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/support_vector_regression.hpp"

#include <libsvm/svm.h>

#include <cmath>
#include <memory>
#include <vector>

#include "waylode/core/assert.hpp"
#include "waylode/learn/kernel.hpp"

namespace waylode::learn {
namespace {

using core::ErrorCode;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Model = SupportVectorRegression::Model;

constexpr double kMaxMagnitude = 1e50;  // Squares stay finite.

struct FreeModel {
  void operator()(svm_model* model) const { svm_free_and_destroy_model(&model); }
};
using ModelHandle = std::unique_ptr<svm_model, FreeModel>;

/// libsvm prints to stdout unless told otherwise, once for the whole process.
void silence() {
  static const bool silenced = [] {
    svm_set_print_string_function([](const char*) {});
    return true;
  }();
  static_cast<void>(silenced);
}

/// Samples as libsvm wants them. Its model points into this, so it must outlive the model.
struct Samples {
  std::vector<svm_node> nodes;
  std::vector<svm_node*> rows;
  std::vector<double> targets;

  Samples(const MatrixXd& inputs, const VectorXd& targets_in)
      : targets(targets_in.begin(), targets_in.end()) {
    nodes.reserve(static_cast<std::size_t>(inputs.rows() * (inputs.cols() + 1)));
    for (Index i = 0; i < inputs.rows(); ++i) {
      for (Index d = 0; d < inputs.cols(); ++d) {
        nodes.push_back({static_cast<int>(d) + 1, inputs(i, d)});
      }
      nodes.push_back({-1, 0.0});
    }
    for (Index i = 0; i < inputs.rows(); ++i) {
      rows.push_back(nodes.data() + i * (inputs.cols() + 1));
    }
  }
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;
};

double default_rate(const MatrixXd& inputs) {
  const double variance = (inputs.array() - inputs.mean()).square().mean();
  constexpr double kNone = 1e-100;
  return variance > kNone ? 1.0 / (static_cast<double>(inputs.cols()) * variance) : 1.0;
}

svm_parameter parameters_of(const SupportVectorRegression::Options& options, double gauss_rate) {
  constexpr double kCache_megabytes = 64.0;
  svm_parameter parameters{};
  parameters.svm_type = EPSILON_SVR;
  parameters.kernel_type = RBF;
  parameters.gamma = gauss_rate;
  parameters.cache_size = kCache_megabytes;
  parameters.eps = options.tolerance;
  parameters.C = options.cost;
  parameters.p = options.epsilon;
  parameters.shrinking = 1;
  return parameters;
}

Model model_of(const svm_model& trained, double gauss_rate, Index dimensions) {
  Model model;
  model.gauss_rate = gauss_rate;
  model.bias = -trained.rho[0];
  model.vectors.resize(trained.l, dimensions);
  model.weights.resize(trained.l);
  for (int i = 0; i < trained.l; ++i) {
    model.weights(i) = trained.sv_coef[0][i];
    for (Index d = 0; d < dimensions; ++d) model.vectors(i, d) = trained.SV[i][d].value;
  }
  return model;
}

core::Result<void> check(const MatrixXd& inputs, const VectorXd& targets) {
  const auto refuse = [](const char* message) {
    return core::fail(ErrorCode::kInvalidArgument, message);
  };
  if (inputs.rows() == 0) return refuse("there is nothing to learn from; give samples");
  if (inputs.cols() == 0) return refuse("the inputs have no column; give at least one");
  if (inputs.rows() != targets.size()) return refuse("there must be one target per sample");
  if (!(inputs.cwiseAbs().maxCoeff() <= kMaxMagnitude &&
        targets.cwiseAbs().maxCoeff() <= kMaxMagnitude && inputs.allFinite() &&
        targets.allFinite())) {
    return refuse("a sample is not finite; leave it out");
  }
  return {};
}

}  // namespace

core::Result<void> SupportVectorRegression::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(ErrorCode::kInvalidOptions, message, "support vectors");
  };
  if (!(cost > 0.0 && cost <= 1e6)) return refuse("cost must be in (0, 1e6]");
  if (!(epsilon >= 0.0) || !std::isfinite(epsilon)) {
    return refuse("epsilon must be finite and not negative");
  }
  if (gauss_rate && (!(*gauss_rate > 0.0) || !std::isfinite(*gauss_rate))) {
    return refuse("gauss_rate must be positive and finite");
  }
  if (!(tolerance >= 1e-9 && tolerance <= 1.0)) return refuse("tolerance must be in [1e-9, 1]");
  return {};
}

core::Result<SupportVectorRegression> SupportVectorRegression::train(const MatrixXd& inputs,
                                                                     const VectorXd& targets,
                                                                     const Options& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (const auto valid = check(inputs, targets); !valid) return tl::unexpected(valid.error());
  silence();
  Samples samples(inputs, targets);
  svm_problem problem{static_cast<int>(inputs.rows()), samples.targets.data(), samples.rows.data()};
  const double gauss_rate = options.gauss_rate.value_or(default_rate(inputs));
  const svm_parameter parameters = parameters_of(options, gauss_rate);
  WAYLODE_ASSERT(svm_check_parameter(&problem, &parameters) == nullptr);
  const ModelHandle trained(svm_train(&problem, &parameters));
  return from_model(model_of(*trained, gauss_rate, inputs.cols()));
}

core::Result<SupportVectorRegression> SupportVectorRegression::from_model(Model model) {
  const auto refuse = [](const char* message) {
    return core::fail(ErrorCode::kInvalidArgument, message, "support vector model");
  };
  if (model.vectors.cols() == 0 || model.weights.size() != model.vectors.rows()) {
    return refuse("its vectors and weights do not match");
  }
  if (!model.vectors.allFinite() || !model.weights.allFinite() || !std::isfinite(model.bias)) {
    return refuse("a value is not finite");
  }
  if (!(model.gauss_rate > 0.0) || !std::isfinite(model.gauss_rate)) {
    return refuse("its rate is not positive");
  }
  return SupportVectorRegression(std::move(model));
}

core::Result<VectorXd> SupportVectorRegression::predict(const MatrixXd& inputs) const {
  if (inputs.cols() != dimensions() || !inputs.allFinite()) {
    return core::fail(ErrorCode::kInvalidArgument,
                      "an input is not finite, or has not as many columns as those trained with");
  }
  VectorXd values = VectorXd::Constant(inputs.rows(), model_.bias);
  for (Index i = 0; i < inputs.rows(); ++i) {
    for (Index j = 0; j < model_.vectors.rows(); ++j) {
      const double distance2 = (inputs.row(i) - model_.vectors.row(j)).squaredNorm();
      values(i) += model_.weights(j) * gauss_kernel(distance2, model_.gauss_rate);
    }
  }
  return values;
}

}  // namespace waylode::learn

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/kernel.hpp"

#include <algorithm>
#include <cmath>

#include "waylode/core/assert.hpp"

namespace waylode::learn {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Samples as columns, so that a sample is contiguous.
using Columns = MatrixXd;

/// Sign and logarithm of the magnitude.
struct LogValue {
  double sign;
  double log_magnitude;
};

LogValue log_spline(const Columns& a, Index i, const Columns& b, Index j) {
  LogValue value{1.0, 0.0};
  for (Index d = 0; d < a.rows(); ++d) {
    const double factor = spline_kernel(a(d, i), b(d, j));
    if (factor < 0.0) value.sign = -value.sign;
    value.log_magnitude += std::log(std::abs(factor));
  }
  return value;
}

double plain_spline(const Columns& a, Index i, const Columns& b, Index j) {
  double product = 1.0;
  for (Index d = 0; d < a.rows(); ++d) product *= spline_kernel(a(d, i), b(d, j));
  return product;
}

Eigen::VectorXd log_diagonal(const Columns& a) {
  Eigen::VectorXd logs(a.cols());
  for (Index i = 0; i < a.cols(); ++i) logs(i) = log_spline(a, i, a, i).log_magnitude;
  return logs;
}

MatrixXd spline_matrix(const Columns& a, const Columns& b, bool normalise) {
  MatrixXd result(a.cols(), b.cols());
  if (!normalise) {
    for (Index j = 0; j < b.cols(); ++j) {
      for (Index i = 0; i < a.cols(); ++i) result(i, j) = plain_spline(a, i, b, j);
    }
    return result;
  }
  const Eigen::VectorXd log_a = log_diagonal(a);
  const Eigen::VectorXd log_b = log_diagonal(b);
  for (Index j = 0; j < b.cols(); ++j) {
    for (Index i = 0; i < a.cols(); ++i) {
      const LogValue value = log_spline(a, i, b, j);
      result(i, j) = value.sign * std::exp(value.log_magnitude - 0.5 * (log_a(i) + log_b(j)));
    }
  }
  return result;
}

double combine(double distance2, double spline, const Kernel::Options& options) {
  const double gauss = gauss_kernel(distance2, options.gauss_rate);
  const double laplace = laplace_kernel(distance2, options.laplace_rate);
  if (options.combination == Kernel::Combination::kSum) {
    return options.spline_weight * spline + options.gauss_weight * gauss +
           options.laplace_weight * laplace;
  }
  // A fractional power keeps the sign of S.
  return std::copysign(std::pow(std::abs(spline), options.spline_weight), spline) *
         std::pow(gauss, options.gauss_weight) * std::pow(laplace, options.laplace_weight);
}

}  // namespace

core::Result<void> Kernel::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "kernel");
  };
  constexpr double kMaxWeight = 1e6;
  for (const double weight : {spline_weight, gauss_weight, laplace_weight}) {
    if (!(weight >= 0.0 && weight <= kMaxWeight)) {
      return refuse("the kernel weights must be in [0, 1e6]");
    }
  }
  if (!(spline_weight + gauss_weight + laplace_weight > 0.0)) {
    return refuse("one of the kernel weights must be positive");
  }
  if (!(gauss_rate > 0.0 && laplace_rate > 0.0 && std::isfinite(gauss_rate) &&
        std::isfinite(laplace_rate))) {
    return refuse("gauss_rate and laplace_rate must be positive and finite");
  }
  return {};
}

core::Result<Kernel> Kernel::create(const Options& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  return Kernel(options);
}

// [Zhao2019] eq. (9)
MatrixXd Kernel::matrix(const MatrixXd& a, const MatrixXd& b) const {
  WAYLODE_ASSERT(a.cols() == b.cols());
  const Columns columns_a = a.transpose();
  const Columns columns_b = b.transpose();
  MatrixXd result = options_.spline_weight > 0.0
                        ? spline_matrix(columns_a, columns_b, options_.normalise_spline)
                        : MatrixXd::Ones(a.rows(), b.rows());
  for (Index j = 0; j < b.rows(); ++j) {
    for (Index i = 0; i < a.rows(); ++i) {
      // By differences: |x|^2 + |y|^2 - 2 xy would lose the digits of near neighbours.
      const double distance2 = (columns_a.col(i) - columns_b.col(j)).squaredNorm();
      result(i, j) = combine(distance2, result(i, j), options_);
    }
  }
  return result;
}

double gauss_kernel(double distance2, double gauss_rate) {
  return std::exp(-gauss_rate * distance2);
}

double laplace_kernel(double distance2, double laplace_rate) {
  return std::exp(-std::sqrt(laplace_rate * distance2));
}

double spline_kernel(double x, double y) {
  const double knots_to = std::max(0.0, std::min(x, y));
  return 1.0 + x * y + x * y * knots_to - 0.5 * (x + y) * knots_to * knots_to +
         knots_to * knots_to * knots_to / 3.0;
}

}  // namespace waylode::learn

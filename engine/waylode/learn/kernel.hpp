// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "waylode/core/result.hpp"

namespace waylode::learn {

/// The composite kernel of [Zhao2019] eq. (9): likeness of two inputs. Samples are rows.
/// Inputs are best scaled to [0, 1] (InputScaler), which the spline is made for.
class Kernel {
 public:
  enum class Combination : std::uint8_t {
    kSum,      ///< l1 S + l2 G + l3 L: a kernel again, for any weights.
    kProduct,  ///< S^l1 G^l2 L^l3; whole weights keep it a kernel where S is one.
  };
  struct Options {
    Combination combination = Combination::kSum;
    double spline_weight = 1.0 / 3.0;   ///< l1, not negative; some weight must be positive.
    double gauss_weight = 1.0 / 3.0;    ///< l2.
    double laplace_weight = 1.0 / 3.0;  ///< l3.
    double gauss_rate = 10.0;           ///< delta > 0, per square of the input's unit.
    double laplace_rate = 10.0;         ///< eta > 0, per square of the input's unit.
    /// S(x,y) / sqrt(S(x,x) S(y,y)), worked out in logarithms. A factor of S reaches 7/3, so S
    /// drowns the other parts from some 5 dimensions on, and overflows at some 800: switch it on
    /// for such inputs.
    bool normalise_spline = false;

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  /// kInvalidOptions unless the options are valid.
  static core::Result<Kernel> create(const Options& options);

  /// k(a_i, b_j), as many rows as `a`, columns as `b`. Both have the same number of columns
  /// (asserted). Finite inputs give finite values, but for the overflow named above.
  Eigen::MatrixXd matrix(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const;

  const Options& options() const { return options_; }

 private:
  explicit Kernel(const Options& options) : options_(options) {}

  Options options_;
};

/// exp(-delta |x-y|^2) from the squared distance. [Zhao2019] eq. (11)
double gauss_kernel(double distance2, double gauss_rate);
/// exp(-sqrt(eta |x-y|^2)) from the squared distance. [Zhao2019] eq. (12)
double laplace_kernel(double distance2, double laplace_rate);
/// One dimension of the linear spline kernel with knots all over t >= 0; that of several
/// dimensions is the product. [Zhao2019] eq. (10). Below zero no knot is left and 1 + xy remains,
/// so that it stays a kernel for every input.
double spline_kernel(double x, double y);

}  // namespace waylode::learn

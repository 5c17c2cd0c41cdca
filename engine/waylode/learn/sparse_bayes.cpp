// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/sparse_bayes.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "waylode/core/assert.hpp"

namespace waylode::learn {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What of the design the weights' posterior needs; picked by columns as these are pruned.
struct Problem {
  MatrixXd design;
  VectorXd targets;
  MatrixXd gram;         ///< Phi^T Phi.
  VectorXd projections;  ///< Phi^T z.
};

Problem make_problem(MatrixXd design, VectorXd targets) {
  Problem problem{std::move(design), std::move(targets), {}, {}};
  problem.gram = MatrixXd::Zero(problem.design.cols(), problem.design.cols());
  problem.gram.selfadjointView<Eigen::Lower>().rankUpdate(problem.design.transpose());
  problem.gram = MatrixXd(problem.gram.selfadjointView<Eigen::Lower>());
  problem.projections = problem.design.transpose() * problem.targets;
  return problem;
}

Problem pick(const Problem& problem, const std::vector<Index>& kept) {
  return {problem.design(Eigen::all, kept), problem.targets, problem.gram(kept, kept),
          problem.projections(kept)};
}

/// B = I + A^-1/2 Phi^T Phi A^-1/2 / sigma^2 has no eigenvalue below 1, so its factor is found
/// however ill the design, unless rounding in a huge Phi^T Phi / sigma^2 outweighs the 1. Then this
/// share of the largest entry, raised as needed, goes on the diagonal.
constexpr double kJitterRatio = 1e-14;
constexpr double kMaxJitterRatio = 1e-2;

Eigen::LLT<MatrixXd> factorise(MatrixXd matrix) {
  Eigen::LLT<MatrixXd> factor(matrix);
  const double largest = matrix.diagonal().size() > 0 ? matrix.diagonal().maxCoeff() : 0.0;
  for (double ratio = kJitterRatio; factor.info() != Eigen::Success && ratio <= kMaxJitterRatio;
       ratio *= 10.0) {
    MatrixXd raised = matrix;
    raised.diagonal().array() += ratio * largest;
    factor.compute(raised);
  }
  WAYLODE_ASSERT(factor.info() == Eigen::Success);
  return factor;
}

/// The posterior but for its covariance, and what makes that.
struct Solution {
  VectorXd mean;
  VectorXd gamma;
  MatrixXd root;  ///< Covariance = root^T root.
  double residual2 = 0.0;
  double log_evidence = 0.0;
};

// [Zhao2019] eq. (6), (8): mu, Sigma, gamma
Solution solve(const Problem& problem, const VectorXd& precisions, double noise_variance) {
  const VectorXd scale = precisions.cwiseSqrt().cwiseInverse();
  const Index size = precisions.size();
  MatrixXd matrix = scale.asDiagonal() * problem.gram * scale.asDiagonal() / noise_variance;
  matrix.diagonal().array() += 1.0;
  const Eigen::LLT<MatrixXd> factor = factorise(std::move(matrix));
  const VectorXd scaled = scale.cwiseProduct(problem.projections) / noise_variance;

  Solution solution;
  solution.mean = scale.cwiseProduct(factor.solve(scaled));
  const MatrixXd inverse_factor = factor.matrixL().solve(MatrixXd::Identity(size, size));
  // gamma_i = 1 - alpha_i Sigma_ii, and alpha_i Sigma_ii is the diagonal of B^-1.
  solution.gamma =
      (1.0 - inverse_factor.colwise().squaredNorm().transpose().array()).max(0.0).min(1.0);
  solution.root = inverse_factor * scale.asDiagonal();
  solution.residual2 = (problem.targets - problem.design * solution.mean).squaredNorm();

  // log|C| = N log sigma^2 + log|B|; z^T C^-1 z = |z - Phi mu|^2 / sigma^2 + mu^T A mu.
  double log_determinant = 0.0;
  for (Index i = 0; i < size; ++i) log_determinant += 2.0 * std::log(factor.matrixLLT()(i, i));
  const auto rows = static_cast<double>(problem.targets.size());
  const double penalty = precisions.dot(solution.mean.cwiseAbs2());
  solution.log_evidence = -0.5 * (rows * std::log(2.0 * std::numbers::pi * noise_variance) +
                                  log_determinant + solution.residual2 / noise_variance + penalty);
  return solution;
}

/// Symmetric to the last digit.
MatrixXd covariance_of(const MatrixXd& root) {
  MatrixXd covariance = MatrixXd::Zero(root.cols(), root.cols());
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(root.transpose());
  covariance = MatrixXd(covariance.selfadjointView<Eigen::Lower>());
  return covariance;
}

/// Magnitudes beyond are refused, magnitudes below taken for zero: all squares stay finite.
constexpr double kMaxMagnitude = 1e50;
constexpr double kMinMagnitude = 1e-50;

/// Units in which columns have a largest magnitude, and targets a mean square, of 1.
struct Units {
  VectorXd columns;
  double targets = 1.0;
};

Units units_of(const MatrixXd& design, const VectorXd& targets) {
  Units units;
  units.columns = design.cwiseAbs().colwise().maxCoeff().transpose();
  units.columns = (units.columns.array() > kMinMagnitude).select(units.columns, 1.0);
  if (targets.cwiseAbs().maxCoeff() > kMinMagnitude) {
    units.targets = std::sqrt(targets.squaredNorm() / static_cast<double>(targets.size()));
  }
  return units;
}

core::Result<void> check(const MatrixXd& design, const VectorXd& targets) {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidArgument, message);
  };
  if (targets.size() == 0) return refuse("there is nothing to learn from; give samples");
  if (design.rows() != targets.size()) return refuse("there must be one target per sample");
  if (!design.allFinite() || !targets.allFinite() ||
      targets.cwiseAbs().maxCoeff() > kMaxMagnitude ||
      (design.size() > 0 && design.cwiseAbs().maxCoeff() > kMaxMagnitude)) {
    return refuse("a sample or its kernel is not finite; leave it out or scale the inputs");
  }
  return {};
}

/// alpha_i = gamma_i / mu_i^2. [Zhao2019] eq. (7)
VectorXd update_precisions(const Solution& solution) {
  // A weight of zero, or one the data say nothing of, is pruned by its precision.
  constexpr double kTiny = 1e-30;
  constexpr double kLeastGamma = 1e-12;
  constexpr double kLeastPrecision = 1e-9;
  return (solution.gamma.array().max(kLeastGamma) / solution.mean.array().square().max(kTiny))
      .max(kLeastPrecision);
}

/// sigma^2 = |z - Phi mu|^2 / (N - sum gamma). [Zhao2019] eq. (8)
double update_noise(const Solution& solution, Index rows, double least) {
  // As many well determined weights as targets leave no residual to judge the noise by.
  constexpr double kLeastFreedom = 1e-3;
  const double freedom = static_cast<double>(rows) - solution.gamma.sum();
  return std::max(least, solution.residual2 / std::max(freedom, kLeastFreedom));
}

/// Leaves out the columns of precisions above `limit`. Whether there were any.
bool prune(SparseBayesFit& fit, Problem& problem, double limit) {
  std::vector<Index> kept;
  std::vector<Index> columns;
  for (Index i = 0; i < fit.precisions.size(); ++i) {
    if (fit.precisions(i) > limit) continue;
    kept.push_back(i);
    columns.push_back(fit.columns[static_cast<std::size_t>(i)]);
  }
  if (kept.size() == fit.columns.size()) return false;
  problem = pick(problem, kept);
  fit.precisions = VectorXd(fit.precisions(kept));
  fit.columns = std::move(columns);
  return true;
}

/// Noise variances in the units of the problem.
struct NoiseBounds {
  double least;
  std::optional<double> known;
};

NoiseBounds noise_bounds(const SparseBayesFit::Options& options, double target_unit) {
  // Keeps sigma^-2 Phi^T Phi within what rounding allows.
  constexpr double kLeastRatio = 1e-10;
  const double sigma = options.min_noise_sigma / target_unit;
  NoiseBounds bounds{std::max(kLeastRatio, sigma * sigma), std::nullopt};
  if (options.noise_variance) {
    bounds.known = std::max(kLeastRatio, *options.noise_variance / target_unit / target_unit);
  }
  return bounds;
}

/// Updates precisions and noise in turn until they rest; the posterior for the last of them.
Solution iterate(SparseBayesFit& fit, Problem problem, const NoiseBounds& noise,
                 const SparseBayesFit::Options& options) {
  Solution solution = solve(problem, fit.precisions, fit.noise_variance);
  while (!fit.converged && fit.iterations < options.max_iterations) {
    ++fit.iterations;
    fit.log_evidences.push_back(solution.log_evidence);
    const VectorXd before = fit.precisions;
    fit.precisions = update_precisions(solution);
    if (!noise.known) {
      fit.noise_variance = update_noise(solution, problem.targets.size(), noise.least);
    }
    if (!prune(fit, problem, options.prune_above)) {
      const VectorXd moves = (fit.precisions.array() / before.array()).log().abs();
      fit.converged = moves.size() == 0 || moves.maxCoeff() <= options.tolerance;
    }
    solution = solve(problem, fit.precisions, fit.noise_variance);
  }
  return solution;
}

/// Back to the units of the caller.
void restore_units(SparseBayesFit& fit, const Solution& solution, const Units& units, Index rows) {
  const double variance_unit = units.targets * units.targets;
  const VectorXd columns = units.columns(fit.columns);
  const VectorXd weight_unit = units.targets * columns.cwiseInverse();
  fit.precisions = fit.precisions.cwiseQuotient(weight_unit.cwiseAbs2());
  fit.noise_variance *= variance_unit;
  fit.posterior.mean = solution.mean.cwiseProduct(weight_unit);
  fit.posterior.gamma = solution.gamma;
  fit.posterior.covariance = covariance_of(solution.root * weight_unit.asDiagonal());
  const double log_unit = static_cast<double>(rows) * std::log(units.targets);
  fit.posterior.log_evidence = solution.log_evidence - log_unit;
  for (double& log_evidence : fit.log_evidences) log_evidence -= log_unit;
}

}  // namespace

SparseBayesPosterior sparse_bayes_posterior(const MatrixXd& design, const VectorXd& targets,
                                            const VectorXd& precisions, double noise_variance) {
  WAYLODE_ASSERT(design.rows() == targets.size() && design.cols() == precisions.size());
  WAYLODE_ASSERT(noise_variance > 0.0 && (precisions.array() > 0.0).all());
  const Solution solution = solve(make_problem(design, targets), precisions, noise_variance);
  return {solution.mean, covariance_of(solution.root), solution.gamma, solution.log_evidence};
}

core::Result<void> SparseBayesFit::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "sparse Bayes");
  };
  if (max_iterations < 1) return refuse("max_iterations must be at least 1");
  if (!(tolerance > 0.0 && tolerance <= 1.0)) return refuse("tolerance must be in (0, 1]");
  if (!(prune_above > 1.0 && prune_above <= 1e12))
    return refuse("prune_above must be in (1, 1e12]");
  if (!(start_precision >= 1e-9 && start_precision <= 1e3 && start_precision < prune_above)) {
    return refuse("start_precision must be in [1e-9, 1e3] and below prune_above");
  }
  if (!(start_noise_ratio > 0.0 && start_noise_ratio <= 10.0)) {
    return refuse("start_noise_ratio must be in (0, 10]");
  }
  if (!(min_noise_sigma >= 1e-9 && min_noise_sigma <= 1e9)) {
    return refuse("min_noise_sigma must be in [1e-9, 1e9]");
  }
  if (noise_variance && !(*noise_variance >= 1e-18 && *noise_variance <= 1e18)) {
    return refuse("noise_variance must be in [1e-18, 1e18]");
  }
  return {};
}

core::Result<SparseBayesFit> fit_sparse_bayes(const MatrixXd& design, const VectorXd& targets,
                                              const SparseBayesFit::Options& options) {
  if (const auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (const auto valid = check(design, targets); !valid) return tl::unexpected(valid.error());
  const Units units = units_of(design, targets);
  const NoiseBounds noise = noise_bounds(options, units.targets);
  SparseBayesFit fit;
  for (Index i = 0; i < design.cols(); ++i) fit.columns.push_back(i);
  fit.precisions = VectorXd::Constant(design.cols(), options.start_precision);
  fit.noise_variance = noise.known.value_or(std::max(options.start_noise_ratio, noise.least));
  const Solution solution = iterate(
      fit,
      make_problem(design * units.columns.cwiseInverse().asDiagonal(), targets / units.targets),
      noise, options);
  restore_units(fit, solution, units, targets.size());
  return fit;
}

}  // namespace waylode::learn

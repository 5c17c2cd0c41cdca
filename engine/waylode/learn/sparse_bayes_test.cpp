// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/learn/sparse_bayes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "waylode/core/rng.hpp"

namespace waylode::learn {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTwoPi = 2.0 * std::numbers::pi;

struct Example {
  MatrixXd design{
      {1.0, 0.3, -2.0}, {1.0, 1.7, 0.4}, {1.0, -0.6, 1.1}, {1.0, 2.2, 0.9}, {1.0, 0.1, -0.5}};
  VectorXd targets{{2.1, -0.7, 3.3, 0.4, 1.9}};
  VectorXd precisions{{0.2, 5.0, 1.3}};
  double noise_variance = 0.7;
};

TEST(SparseBayesPosterior, IsThatOfTheTextbookFormulas) {
  const Example e;
  const auto posterior =
      sparse_bayes_posterior(e.design, e.targets, e.precisions, e.noise_variance);
  const MatrixXd covariance =
      (e.design.transpose() * e.design / e.noise_variance + MatrixXd(e.precisions.asDiagonal()))
          .inverse();
  const VectorXd mean = covariance * e.design.transpose() * e.targets / e.noise_variance;
  EXPECT_TRUE(posterior.covariance.isApprox(covariance, 1e-12));
  EXPECT_TRUE(posterior.mean.isApprox(mean, 1e-12));
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(posterior.gamma(i), 1.0 - e.precisions(i) * covariance(i, i), 1e-12);
  }
}

TEST(SparseBayesPosterior, HasTheTargetsDensityAsItsEvidence) {
  const Example e;
  const MatrixXd covariance =
      e.noise_variance * MatrixXd::Identity(5, 5) +
      e.design * e.precisions.cwiseInverse().asDiagonal() * e.design.transpose();
  const double expected = -0.5 * (5.0 * std::log(kTwoPi) + std::log(covariance.determinant()) +
                                  e.targets.dot(covariance.inverse() * e.targets));
  EXPECT_NEAR(
      sparse_bayes_posterior(e.design, e.targets, e.precisions, e.noise_variance).log_evidence,
      expected, 1e-12);
}

TEST(SparseBayesPosterior, OfOneWeightByHand) {
  // Sigma = 1 / (2*2/4 + 1/2); mu = Sigma * 2*3/4; z ~ N(0, 4 + 2*2/0.5).
  const auto posterior =
      sparse_bayes_posterior(MatrixXd{{2.0}}, VectorXd{{3.0}}, VectorXd{{0.5}}, 4.0);
  EXPECT_NEAR(posterior.covariance(0, 0), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(posterior.mean(0), 1.0, 1e-15);
  EXPECT_NEAR(posterior.gamma(0), 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(posterior.log_evidence, -0.5 * (std::log(kTwoPi * 12.0) + 0.75), 1e-14);
}

TEST(SparseBayesPosterior, WithoutWeightsIsTheDensityOfNoise) {
  const auto posterior =
      sparse_bayes_posterior(MatrixXd(2, 0), VectorXd{{1.0, -2.0}}, VectorXd(0), 4.0);
  EXPECT_EQ(posterior.mean.size(), 0);
  EXPECT_NEAR(posterior.log_evidence, -0.5 * (2.0 * std::log(kTwoPi * 4.0) + 1.25), 1e-14);
}

TEST(SparseBayesPosterior, BearsADesignWhoseFactorNeedsJitter) {
  core::Rng rng(5);
  MatrixXd design(40, 30);
  VectorXd targets(40);
  for (int i = 0; i < 40; ++i) {
    const double value = rng.uniform(0.5, 1.5);
    for (int j = 0; j < 30; ++j) design(i, j) = value * (1.0 + 1e-9 * rng.normal());
    targets(i) = 3.0 * value;
  }
  constexpr double kPrecision = 1e-9;
  constexpr double kNoise = 1e-10;
  const MatrixXd unraised =
      MatrixXd::Identity(30, 30) + design.transpose() * design / (kPrecision * kNoise);
  ASSERT_NE(unraised.llt().info(), Eigen::Success) << "this design needs no jitter";
  const auto posterior =
      sparse_bayes_posterior(design, targets, VectorXd::Constant(30, kPrecision), kNoise);
  EXPECT_TRUE(posterior.covariance.allFinite());
  EXPECT_TRUE(std::isfinite(posterior.log_evidence));
  EXPECT_NEAR((design * posterior.mean - targets).cwiseAbs().maxCoeff(), 0.0, 1e-3);
}

/// Of one column, noise known: [TippingFaul2003] eq. (20), (21) with s, q of eq. (19).
struct OneColumn {
  MatrixXd design{{1.0}, {0.5}, {-1.5}, {2.0}};
  double noise_variance = 0.8;

  double sparsity() const { return design.squaredNorm() / noise_variance; }
  double quality(const VectorXd& targets) const {
    return design.col(0).dot(targets) / noise_variance;
  }
  core::Result<SparseBayesFit> fit(const VectorXd& targets) const {
    SparseBayesFit::Options options{.tolerance = 1e-10};
    options.noise_variance = noise_variance;
    return fit_sparse_bayes(design, targets, options);
  }
};

TEST(FitSparseBayes, ReachesTheClosedFormOfOneColumn) {
  const OneColumn one;
  const VectorXd targets{{1.1, 1.3, -0.4, 2.2}};
  const double s = one.sparsity();
  const double q = one.quality(targets);
  ASSERT_GT(q * q, s);
  const auto fit = one.fit(targets);
  ASSERT_TRUE(fit);
  ASSERT_TRUE(fit->converged);
  ASSERT_EQ(fit->columns, std::vector<Eigen::Index>{0});
  EXPECT_NEAR(fit->precisions(0), s * s / (q * q - s), 1e-7);
}

TEST(FitSparseBayes, LeavesOutAColumnThatTheEvidenceDoesWithout) {
  const OneColumn one;
  const VectorXd targets{{1.1, 1.3, 0.9, 0.2}};
  ASSERT_LT(one.quality(targets) * one.quality(targets), one.sparsity());
  const auto fit = one.fit(targets);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->columns.empty());
  EXPECT_TRUE(fit->converged);
}

/// Three of ten random columns make up the targets.
struct Sparse {
  MatrixXd design{60, 10};
  VectorXd targets{60};

  explicit Sparse(std::uint64_t seed = 11) {
    core::Rng rng(seed);
    for (double& value : design.reshaped()) value = rng.normal();
    for (int i = 0; i < 60; ++i) {
      targets(i) =
          2.0 * design(i, 1) - 3.0 * design(i, 4) + 0.8 * design(i, 7) + 0.5 * rng.normal();
    }
  }
};

SparseBayesFit fit_to_rest(const MatrixXd& design, const VectorXd& targets) {
  auto fit = fit_sparse_bayes(design, targets, {.max_iterations = 100'000, .tolerance = 1e-9});
  EXPECT_TRUE(fit && fit->converged);
  return *fit;
}

TEST(FitSparseBayes, FindsTheColumnsThatMatter) {
  const Sparse sparse;
  const auto fit = fit_to_rest(sparse.design, sparse.targets);
  VectorXd weights = VectorXd::Zero(10);
  for (std::size_t i = 0; i < fit.columns.size(); ++i) {
    weights(fit.columns[i]) = fit.posterior.mean(static_cast<Eigen::Index>(i));
  }
  EXPECT_LT(fit.columns.size(), 9U);
  EXPECT_NEAR(weights(1), 2.0, 0.3);
  EXPECT_NEAR(weights(4), -3.0, 0.3);
  EXPECT_NEAR(weights(7), 0.8, 0.3);
  EXPECT_NEAR(std::sqrt(fit.noise_variance), 0.5, 0.12);
}

TEST(FitSparseBayes, RestsWhereTheUpdatesChangeNothing) {
  const Sparse sparse;
  const auto fit = fit_to_rest(sparse.design, sparse.targets);
  const auto& posterior = fit.posterior;
  for (Eigen::Index i = 0; i < fit.precisions.size(); ++i) {
    EXPECT_NEAR(fit.precisions(i) * posterior.mean(i) * posterior.mean(i) / posterior.gamma(i), 1.0,
                1e-6);
  }
  const VectorXd residual =
      sparse.targets - MatrixXd(sparse.design(Eigen::all, fit.columns)) * posterior.mean;
  EXPECT_NEAR(fit.noise_variance, residual.squaredNorm() / (60.0 - posterior.gamma.sum()), 1e-7);
}

TEST(FitSparseBayes, RestsAtAMaximumOfTheEvidence) {
  const Sparse sparse;
  const auto fit = fit_to_rest(sparse.design, sparse.targets);
  const MatrixXd design = sparse.design(Eigen::all, fit.columns);
  const auto evidence = [&](const VectorXd& precisions, double noise_variance) {
    return sparse_bayes_posterior(design, sparse.targets, precisions, noise_variance).log_evidence;
  };
  const double best = evidence(fit.precisions, fit.noise_variance);
  EXPECT_NEAR(fit.posterior.log_evidence, best, 1e-9);
  for (const double factor : {0.9, 1.1}) {
    EXPECT_LT(evidence(fit.precisions, factor * fit.noise_variance), best);
    for (Eigen::Index i = 0; i < fit.precisions.size(); ++i) {
      VectorXd moved = fit.precisions;
      moved(i) *= factor;
      EXPECT_LT(evidence(moved, fit.noise_variance), best);
    }
  }
}

TEST(FitSparseBayes, TellsThePosteriorOfItsOwnPrecisions) {
  const Sparse sparse;
  // Stopped early: precisions and posterior must belong together nevertheless.
  const auto fit = fit_sparse_bayes(sparse.design, sparse.targets, {.max_iterations = 3});
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->converged);
  EXPECT_EQ(fit->iterations, 3U);
  const auto posterior =
      sparse_bayes_posterior(sparse.design(Eigen::all, fit->columns), sparse.targets,
                             fit->precisions, fit->noise_variance);
  EXPECT_TRUE(fit->posterior.mean.isApprox(posterior.mean, 1e-10));
  EXPECT_TRUE(fit->posterior.covariance.isApprox(posterior.covariance, 1e-10));
  EXPECT_TRUE(fit->posterior.gamma.isApprox(posterior.gamma, 1e-10));
  EXPECT_NEAR(fit->posterior.log_evidence, posterior.log_evidence, 1e-9);
}

TEST(FitSparseBayes, RaisesTheEvidence) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Sparse sparse(seed);
    const auto fit = fit_to_rest(sparse.design, sparse.targets);
    ASSERT_EQ(fit.log_evidences.size(), fit.iterations);
    EXPECT_GT(fit.posterior.log_evidence, fit.log_evidences.front());
    EXPECT_NEAR(fit.posterior.log_evidence, fit.log_evidences.back(), 1e-3);
  }
}

TEST(FitSparseBayes, DoesNotMindUnits) {
  const Sparse sparse;
  const auto fit = fit_to_rest(sparse.design, sparse.targets);
  const VectorXd units{{1e3, 1e-3, 7.0, 1e5, 0.02, 1.0, 3e-6, 40.0, 1e8, 0.3}};
  const auto other = fit_to_rest(sparse.design * units.asDiagonal(), 250.0 * sparse.targets);
  ASSERT_EQ(other.columns, fit.columns);
  for (std::size_t k = 0; k < fit.columns.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double unit = 250.0 / units(fit.columns[k]);
    EXPECT_NEAR(other.posterior.mean(i) / unit, fit.posterior.mean(i), 1e-6);
    EXPECT_NEAR(other.precisions(i) * unit * unit / fit.precisions(i), 1.0, 1e-6);
    EXPECT_NEAR(std::sqrt(other.posterior.covariance(i, i)) / unit,
                std::sqrt(fit.posterior.covariance(i, i)), 1e-6);
  }
  EXPECT_NEAR(other.noise_variance / (250.0 * 250.0), fit.noise_variance, 1e-6);
  EXPECT_NEAR(other.posterior.log_evidence, fit.posterior.log_evidence - 60.0 * std::log(250.0),
              1e-5);
}

TEST(FitSparseBayes, BearsEqualAndEmptyColumns) {
  const Sparse sparse;
  MatrixXd design(60, 6);
  design << sparse.design.col(1), sparse.design.col(1), VectorXd::Zero(60), sparse.design.col(4),
      sparse.design.col(4), sparse.design.col(7);
  const auto fit = fit_sparse_bayes(design, sparse.targets, {});
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->posterior.covariance.allFinite());
  EXPECT_TRUE(std::ranges::find(fit->columns, 2) == fit->columns.end());
  EXPECT_NEAR(std::sqrt(fit->noise_variance), 0.5, 0.12);
}

TEST(FitSparseBayes, KeepsSomeNoiseWhereTheColumnsExplainAll) {
  const Sparse sparse;
  const VectorXd targets = sparse.design.col(2) - 2.0 * sparse.design.col(3);
  const auto fit = fit_sparse_bayes(sparse.design, targets, {.min_noise_sigma = 0.01});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->noise_variance, 1e-4, 1e-12);
  EXPECT_TRUE(fit->posterior.mean.allFinite());
  const auto exact = fit_sparse_bayes(sparse.design, targets, {});
  ASSERT_TRUE(exact);
  EXPECT_GT(exact->noise_variance, 0.0);
}

TEST(FitSparseBayes, NeedsNoColumnForTargetsOfZero) {
  const Sparse sparse;
  const auto fit = fit_sparse_bayes(sparse.design, VectorXd::Zero(60), {.min_noise_sigma = 0.25});
  ASSERT_TRUE(fit);
  EXPECT_TRUE(fit->columns.empty());
  EXPECT_NEAR(fit->noise_variance, 0.0625, 1e-15);
}

TEST(FitSparseBayes, LearnsTheNoiseWithoutColumns) {
  const auto fit = fit_sparse_bayes(MatrixXd(3, 0), VectorXd{{1.0, -2.0, 4.0}}, {});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->noise_variance, 7.0, 1e-12);
}

TEST(FitSparseBayes, BearsMagnitudesFarFromOne) {
  const Sparse sparse;
  for (const double unit : {1e-40, 1e40}) {
    const auto fit = fit_sparse_bayes(unit * sparse.design, sparse.targets / unit, {});
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->posterior.mean.allFinite());
    EXPECT_TRUE(fit->posterior.covariance.allFinite());
    EXPECT_TRUE(std::isfinite(fit->noise_variance));
    EXPECT_TRUE(std::isfinite(fit->posterior.log_evidence));
  }
}

TEST(FitSparseBayes, RefusesSamplesItCannotLearnFrom) {
  const Sparse sparse;
  const auto code = [](const MatrixXd& design, const VectorXd& targets) {
    const auto fit = fit_sparse_bayes(design, targets, {});
    return fit ? core::ErrorCode::kInternal : fit.error().code;
  };
  EXPECT_EQ(code(MatrixXd(0, 2), VectorXd(0)), core::ErrorCode::kInvalidArgument);
  EXPECT_EQ(code(sparse.design, sparse.targets.head(59)), core::ErrorCode::kInvalidArgument);
  for (const double bad : {kNan, kInf, -kInf, 1e60}) {
    MatrixXd design = sparse.design;
    design(3, 2) = bad;
    EXPECT_EQ(code(design, sparse.targets), core::ErrorCode::kInvalidArgument) << bad;
    VectorXd targets = sparse.targets;
    targets(5) = bad;
    EXPECT_EQ(code(sparse.design, targets), core::ErrorCode::kInvalidArgument) << bad;
  }
}

TEST(FitSparseBayes, RefusesOptionsOutOfRange) {
  using Options = SparseBayesFit::Options;
  for (const Options& options :
       {Options{.max_iterations = 0}, Options{.tolerance = 0.0}, Options{.tolerance = kNan},
        Options{.prune_above = 1.0}, Options{.prune_above = kInf}, Options{.start_precision = 0.0},
        Options{.prune_above = 2.0, .start_precision = 3.0}, Options{.start_noise_ratio = 0.0},
        Options{.min_noise_sigma = 0.0}, Options{.min_noise_sigma = kNan},
        Options{.noise_variance = 0.0}, Options{.noise_variance = kInf}}) {
    const auto fit = fit_sparse_bayes(MatrixXd{{1.0}}, VectorXd{{1.0}}, options);
    ASSERT_FALSE(fit);
    EXPECT_EQ(fit.error().code, core::ErrorCode::kInvalidOptions);
  }
}

}  // namespace
}  // namespace waylode::learn

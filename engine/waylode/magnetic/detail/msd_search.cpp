// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/magnetic/detail/msd_search.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace waylode::magnetic::detail {
namespace {

using core::Matrix2;
using core::Vector2;

/// [Zhou2016] eq. (10) of the pairs (H, Z), the constant part weighted by `bias_share`; nullopt
/// where too little of the path is on the map.
std::optional<double> mean_square_difference(std::span<const PathField> path, const FieldGrid& grid,
                                             const Vector2& end_m, std::size_t least_known,
                                             double bias_share) {
  std::size_t known = 0;
  Vector2 sum_ut = Vector2::Zero();
  double square_sum_ut2 = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (known + (path.size() - i) < least_known) return std::nullopt;
    const auto mapped = grid.at(end_m + path[i].from_end_m);
    if (!mapped) continue;
    const Vector2 difference_ut =
        path[i].field_ut - Vector2(mapped->horizontal_ut, mapped->vertical_ut);
    ++known;
    sum_ut += difference_ut;
    square_sum_ut2 += difference_ut.squaredNorm();
  }
  if (known == 0 || known < least_known) return std::nullopt;
  const auto count = static_cast<double>(known);
  const double squared_mean_ut2 = (sum_ut / count).squaredNorm();
  return std::max(0.0, square_sum_ut2 / count - squared_mean_ut2) + bias_share * squared_mean_ut2;
}

const Trial& best_of(std::span<const Trial> trials, const Vector2& centre_m) {
  return *std::ranges::min_element(trials, [&](const Trial& a, const Trial& b) {
    if (a.mean_square_ut2 != b.mean_square_ut2) return a.mean_square_ut2 < b.mean_square_ut2;
    return (a.end_m - centre_m).squaredNorm() < (b.end_m - centre_m).squaredNorm();
  });
}

struct Spread {
  Vector2 mean_m = Vector2::Zero();
  Matrix2 covariance_m2 = Matrix2::Zero();
};

/// `weight_of(trial)` is positive for one trial at least.
template <typename WeightOf>
Spread spread_of(std::span<const Trial> trials, const SearchArea& area, WeightOf&& weight_of) {
  double weight_sum = 0.0;
  Vector2 sum_m = Vector2::Zero();
  Matrix2 square_sum_m2 = Matrix2::Zero();
  for (const Trial& trial : trials) {
    const double weight = weight_of(trial);
    const Vector2 offset_m = trial.end_m - area.centre_m;
    weight_sum += weight;
    sum_m += weight * offset_m;
    square_sum_m2 += weight * offset_m * offset_m.transpose();
  }
  const Vector2 mean_m = sum_m / weight_sum;
  // Each trial stands for a square of its own.
  const Matrix2 of_squares_m2 = area.step_m * area.step_m / 12.0 * Matrix2::Identity();
  return {area.centre_m + mean_m,
          square_sum_m2 / weight_sum - mean_m * mean_m.transpose() + of_squares_m2};
}

/// What the field alone says: the spread with it, less the spread without it (which only tells how
/// far was searched). nullopt where no direction is known better than `widest_m2`.
std::optional<Matrix2> without_the_search(const Matrix2& with_field_m2,
                                          const Matrix2& without_field_m2, double widest_m2) {
  const Matrix2 information = with_field_m2.inverse() - without_field_m2.inverse();
  const Eigen::SelfAdjointEigenSolver<Matrix2> axes(0.5 * (information + information.transpose()));
  const Vector2 known = axes.eigenvalues().cwiseMax(1.0 / widest_m2);
  if (known.maxCoeff() <= 1.0 / widest_m2) return std::nullopt;
  return axes.eigenvectors() * known.cwiseInverse().asDiagonal() * axes.eigenvectors().transpose();
}

/// A best fit on the rim may just lead outside.
Matrix2 doubt_of_the_rim(const Vector2& best_m, const SearchArea& area) {
  const Vector2 offset_m = best_m - area.centre_m;
  if (offset_m.norm() <= area.radius_m - 1.5 * area.step_m) return Matrix2::Zero();
  return offset_m * offset_m.transpose();
}

}  // namespace

std::vector<Trial> try_area(std::span<const PathField> path, const FieldGrid& grid,
                            const SearchArea& area, std::size_t least_known, double bias_share) {
  std::vector<Trial> trials;
  const int reach = static_cast<int>(std::floor(area.radius_m / area.step_m));
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      if (row * row + column * column > reach * reach) continue;
      const Vector2 end_m = area.centre_m + area.step_m * Vector2(column, row);
      const auto difference = mean_square_difference(path, grid, end_m, least_known, bias_share);
      if (difference) trials.push_back({end_m, *difference});
    }
  }
  return trials;
}

std::optional<Fit> fit_trials(std::span<const Trial> trials, const SearchArea& area,
                              const FitDoubt& doubt) {
  if (trials.empty()) return std::nullopt;
  const Trial& best = best_of(trials, area.centre_m);
  // A poor best fit says that map and phone differ more than was thought.
  const double variance_ut2 =
      std::max(doubt.field_sigma_ut * doubt.field_sigma_ut, 0.5 * best.mean_square_ut2);
  const double per_ut2 = 0.5 * doubt.independent_count / variance_ut2;
  const double per_m2 = 2.0 / (area.radius_m * area.radius_m);  // The rim is two sigmas out.
  const auto nearness = [&](const Trial& trial) {
    return std::exp(-per_m2 * (trial.end_m - area.centre_m).squaredNorm());
  };
  const Spread searched = spread_of(trials, area, nearness);
  const Spread fitting = spread_of(trials, area, [&](const Trial& trial) {
    return nearness(trial) * std::exp(-per_ut2 * (trial.mean_square_ut2 - best.mean_square_ut2));
  });
  const auto covariance_m2 = without_the_search(fitting.covariance_m2, searched.covariance_m2,
                                                doubt.widest_sigma_m * doubt.widest_sigma_m);
  if (!covariance_m2) return std::nullopt;
  const Vector2 off_m = best.end_m - fitting.mean_m;
  return Fit{best, *covariance_m2 + off_m * off_m.transpose() + doubt_of_the_rim(best.end_m, area)};
}

}  // namespace waylode::magnetic::detail

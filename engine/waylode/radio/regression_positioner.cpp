// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/radio/regression_positioner.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "waylode/radio/detail/neighbourhood.hpp"

namespace waylode::radio {
namespace {

constexpr std::size_t kFewestPoints = 5;

/// The transmitters whose strength varies the most over the points of a floor, ascending.
std::vector<std::uint32_t> most_telling(const ReferenceMap& map,
                                        const ReferenceMap::FloorRange& range, std::size_t most) {
  struct Sums {
    double excess = 0.0;
    double square = 0.0;
  };
  std::map<std::uint32_t, Sums> sums;
  for (std::uint32_t point = range.first; point < range.last; ++point) {
    for (const ReferenceMap::Reading& reading : map.readings_of(point)) {
      const double excess = static_cast<double>(reading.mean_dbm - map.options().fill_dbm);
      sums[reading.transmitter].excess += excess;
      sums[reading.transmitter].square += excess * excess;
    }
  }
  const auto count = static_cast<double>(range.last - range.first);
  std::vector<std::pair<double, std::uint32_t>> ranked;  // Negative variation, transmitter.
  for (const auto& [transmitter, sum] : sums) {
    ranked.emplace_back(sum.excess * sum.excess / count - sum.square, transmitter);
  }
  std::ranges::sort(ranked);
  ranked.resize(std::min(ranked.size(), most));
  std::vector<std::uint32_t> transmitters;
  for (const auto& [variation, transmitter] : ranked) transmitters.push_back(transmitter);
  std::ranges::sort(transmitters);
  return transmitters;
}

struct Samples {
  Eigen::MatrixXd inputs;
  Eigen::MatrixXd places_m;
};

Samples samples_of(const ReferenceMap& map, const ReferenceMap::FloorRange& range,
                   std::span<const std::uint32_t> transmitters) {
  const auto rows = static_cast<Eigen::Index>(range.last - range.first);
  Samples samples{Eigen::MatrixXd::Constant(rows, static_cast<Eigen::Index>(transmitters.size()),
                                            static_cast<double>(map.options().fill_dbm)),
                  Eigen::MatrixXd(rows, 2)};
  for (std::uint32_t point = range.first; point < range.last; ++point) {
    const auto row = static_cast<Eigen::Index>(point - range.first);
    samples.places_m.row(row) = map.points()[point].position_m.transpose();
    for (const ReferenceMap::Reading& reading : map.readings_of(point)) {
      const auto column = std::ranges::lower_bound(transmitters, reading.transmitter);
      if (column == transmitters.end() || *column != reading.transmitter) continue;
      samples.inputs(row, column - transmitters.begin()) = static_cast<double>(reading.mean_dbm);
    }
  }
  return samples;
}

/// Means over the cells of a grid.
Samples merged(const Samples& samples, double cell_m) {
  std::map<std::pair<double, double>, std::vector<Eigen::Index>> cells;
  for (Eigen::Index row = 0; row < samples.places_m.rows(); ++row) {
    cells[{std::floor(samples.places_m(row, 0) / cell_m),
           std::floor(samples.places_m(row, 1) / cell_m)}]
        .push_back(row);
  }
  const auto rows = static_cast<Eigen::Index>(cells.size());
  Samples result{Eigen::MatrixXd(rows, samples.inputs.cols()), Eigen::MatrixXd(rows, 2)};
  Eigen::Index row = 0;
  for (const auto& [cell, members] : cells) {
    result.inputs.row(row) = samples.inputs(members, Eigen::all).colwise().mean();
    result.places_m.row(row) = samples.places_m(members, Eigen::all).colwise().mean();
    ++row;
  }
  return result;
}

Samples thinned(Samples samples, std::size_t most) {
  constexpr double kFirstCell_m = 1.0;
  constexpr double kCoarser = 1.25;
  double cell_m = kFirstCell_m;
  Samples result = samples;
  while (static_cast<std::size_t>(result.places_m.rows()) > most) {
    result = merged(samples, cell_m);
    cell_m *= kCoarser;
  }
  return result;
}

learn::Regression::Options regression_options(const RegressionPositioner::Options& options) {
  learn::Regression::Options result;
  result.scaler = options.scaler;
  if (options.kind == RegressionPositioner::Kind::kRelevanceVectors) {
    result.regressor = options.relevance;
  } else {
    result.regressor = options.support;
  }
  return result;
}

/// Row 0 is the scan; then, for each column, the scan with that reading raised and lowered.
Eigen::MatrixXd with_noise(const Eigen::RowVectorXd& input, double sigma_db) {
  Eigen::MatrixXd rows = input.replicate(1 + 2 * input.size(), 1);
  for (Eigen::Index column = 0; column < input.size(); ++column) {
    rows(1 + 2 * column, column) += sigma_db;
    rows(2 + 2 * column, column) -= sigma_db;
  }
  return rows;
}

/// Of the mean of row 0, from the rows of with_noise.
core::Matrix2 noise_covariance_m2(const Eigen::MatrixXd& places_m) {
  core::Matrix2 covariance_m2 = core::Matrix2::Zero();
  for (Eigen::Index row = 1; row + 1 < places_m.rows(); row += 2) {
    const core::Vector2 slope_m = 0.5 * (places_m.row(row) - places_m.row(row + 1)).transpose();
    covariance_m2 += slope_m * slope_m.transpose();
  }
  return covariance_m2;
}

/// Of training, per coordinate.
core::Vector2 residual_m(const learn::Regression& regression, const Samples& samples) {
  const auto estimate = regression.predict(samples.inputs);
  if (!estimate) return core::Vector2::Zero();
  const Eigen::MatrixXd error_m = estimate->mean - samples.places_m;
  return error_m.colwise().squaredNorm().transpose().cwiseSqrt() /
         std::sqrt(static_cast<double>(error_m.rows()));
}

}  // namespace

core::Result<void> RegressionPositioner::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "regression_positioner");
  };
  if (auto valid = regression_options(*this).validate(); !valid) return valid;
  if (max_transmitters < 1 || max_transmitters > 1000) {
    return refuse("max_transmitters must be in [1, 1000]");
  }
  if (!(rate_transmitters > 0.0)) return refuse("rate_transmitters must be positive");
  if (max_points < kFewestPoints || max_points > 2000) {
    return refuse("max_points must be in [5, 2000]");
  }
  if (floor_neighbours < 1 || floor_neighbours > 1000) {
    return refuse("floor_neighbours must be in [1, 1000]");
  }
  if (!(scan_sigma_db >= 0.0 && scan_sigma_db <= 30.0)) {
    return refuse("scan_sigma_db must be in [0, 30]");
  }
  if (!(unknown_sigma_m >= 0.0 && unknown_sigma_m <= 1000.0 && min_sigma_m > 0.0 &&
        min_sigma_m <= 1000.0 && margin_m >= 0.0 && margin_m <= 1000.0)) {
    return refuse("sigmas and margin must not be negative nor above 1000, min_sigma_m positive");
  }
  return {};
}

core::Result<RegressionPositioner> RegressionPositioner::create(const ReferenceMap& map,
                                                                const Options& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (map.points().empty()) {
    return core::fail(core::ErrorCode::kMapMissing, "there is nothing to learn from; survey first",
                      "regression_positioner");
  }
  RegressionPositioner result(map, options);
  for (const ReferenceMap::FloorRange& range : map.floors()) {
    auto model = result.learn_floor(range);
    if (!model) return tl::unexpected(model.error());
    if (!model->transmitters.empty()) result.models_.push_back(std::move(*model));
  }
  return result;
}

core::Result<RegressionPositioner::FloorModel> RegressionPositioner::learn_floor(
    const ReferenceMap::FloorRange& range) const {
  FloorModel model;
  model.floor = range.floor;
  model.transmitters = most_telling(*map_, range, options_.max_transmitters);
  if (model.transmitters.empty()) return model;
  const Samples all = samples_of(*map_, range, model.transmitters);
  const core::Vector2 margin_m = core::Vector2::Constant(options_.margin_m);
  model.bounds_m.min_m = all.places_m.colwise().minCoeff().transpose() - margin_m;
  model.bounds_m.max_m = all.places_m.colwise().maxCoeff().transpose() + margin_m;
  model.mean_m = all.places_m.colwise().mean().transpose();
  const Eigen::MatrixXd off_m = all.places_m.rowwise() - model.mean_m.transpose();
  model.scatter_m2 = off_m.transpose() * off_m / static_cast<double>(off_m.rows());

  const Samples samples = thinned(all, options_.max_points);
  if (static_cast<std::size_t>(samples.places_m.rows()) < kFewestPoints) return model;
  Options options = options_;
  const double shrink =
      std::min(1.0, options.rate_transmitters / static_cast<double>(model.transmitters.size()));
  options.relevance.kernel.gauss_rate *= shrink;
  options.relevance.kernel.laplace_rate *= shrink;
  auto regression =
      learn::Regression::train(samples.inputs, samples.places_m, regression_options(options));
  if (!regression) return tl::unexpected(regression.error());
  if (options_.kind == Kind::kSupportVectors) model.residual_m = residual_m(*regression, samples);
  model.regression = std::move(*regression);
  return model;
}

std::optional<observation::FloorHypothesis> RegressionPositioner::locate(
    const FloorModel& model, const ReferenceQuery& heard) const {
  Eigen::RowVectorXd input(static_cast<Eigen::Index>(model.transmitters.size()));
  bool knows_any = false;
  for (std::size_t i = 0; i < model.transmitters.size(); ++i) {
    const double excess_db = heard.excess_db[model.transmitters[i]];
    knows_any = knows_any || (std::isfinite(excess_db) && excess_db != 0.0);
    input(static_cast<Eigen::Index>(i)) = static_cast<double>(map_->options().fill_dbm) +
                                          (std::isfinite(excess_db) ? excess_db : 0.0);
  }
  if (!knows_any) return std::nullopt;

  observation::FloorHypothesis hypothesis;
  hypothesis.floor = model.floor;
  const double least_m2 = options_.min_sigma_m * options_.min_sigma_m;
  hypothesis.position_m = model.mean_m;
  hypothesis.covariance_m2 = model.scatter_m2 + least_m2 * core::Matrix2::Identity();
  if (model.regression) {
    const auto estimate = model.regression->predict(with_noise(input, options_.scan_sigma_db));
    if (!estimate || !estimate->mean.allFinite()) return std::nullopt;
    hypothesis.position_m = estimate->mean.row(0).transpose();
    core::Vector2 variance_m2;
    if (estimate->sigma) {  // [Zhao2019] eq. (6)
      variance_m2 = estimate->sigma->row(0).transpose().cwiseAbs2();
    } else {
      variance_m2 = model.residual_m.cwiseAbs2().array() +
                    options_.unknown_sigma_m * options_.unknown_sigma_m;
    }
    if (!variance_m2.allFinite()) return std::nullopt;
    hypothesis.covariance_m2 = noise_covariance_m2(estimate->mean);
    hypothesis.covariance_m2 += variance_m2.cwiseMax(least_m2).asDiagonal();
  }
  hypothesis.position_m =
      hypothesis.position_m.cwiseMax(model.bounds_m.min_m).cwiseMin(model.bounds_m.max_m);
  hypothesis.candidates = {{hypothesis.position_m, 1.0}};
  return hypothesis;
}

std::optional<Positioning> RegressionPositioner::estimate(
    const Query& query, std::optional<core::FloorId> known_floor,
    const std::optional<core::Belief>&) const {
  const ReferenceQuery heard = map_->prepare(query.readings);
  if (heard.heard.empty()) return std::nullopt;
  Positioning result;
  result.observation.measured = query.measured;
  result.observation.delivered = query.delivered;
  result.observation.known_share_ratio = heard.known_share_ratio;
  std::vector<observation::FloorHypothesis>& floors = result.observation.floors;
  for (const FloorModel& model : models_) {
    if (known_floor && model.floor != *known_floor) continue;
    if (auto hypothesis = locate(model, heard)) floors.push_back(std::move(*hypothesis));
  }
  if (floors.empty()) return std::nullopt;
  result.comparisons = vector_count();
  if (floors.size() == 1) return result;

  const auto vote =
      detail::position_by_nearest(*map_, query, heard, detail::all_points(*map_, std::nullopt),
                                  {.neighbours = options_.floor_neighbours});
  if (!vote) return std::nullopt;
  result.comparisons += vote->comparisons;
  for (observation::FloorHypothesis& floor : floors) {
    const auto& voted = vote->observation.floors;
    const auto same = std::ranges::find(voted, floor.floor, &observation::FloorHypothesis::floor);
    if (same != voted.end()) floor.log_likelihood = same->log_likelihood;
  }
  std::ranges::stable_sort(floors, std::ranges::greater{},
                           &observation::FloorHypothesis::log_likelihood);
  return result;
}

std::size_t RegressionPositioner::vector_count() const {
  std::size_t count = 0;
  for (const FloorModel& model : models_) {
    if (!model.regression) continue;
    for (const learn::Regression::Regressor& output : model.regression->outputs()) {
      count += std::visit([](const auto& regressor) { return regressor.vector_count(); }, output);
    }
  }
  return count;
}

}  // namespace waylode::radio

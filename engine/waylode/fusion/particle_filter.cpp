// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/fusion/particle_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "waylode/core/assert.hpp"
#include "waylode/fusion/detail/sound.hpp"

namespace waylode::fusion {
namespace {

core::Vector2 direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

double plan_penalty(const Ground& ground, const core::Vector2& from_m, const core::Vector2& to_m) {
  if (ground.walkability == nullptr) return 0.0;
  return ground.walkability->log_penalty(ground.floor_from_site * from_m,
                                         ground.floor_from_site * to_m);
}

/// How the field along a step fits the way from `from_m` to where the particle is.
double field_fit(Particle& particle, const observation::MotionDelta& motion, const Ground& ground,
                 const core::Vector2& from_m) {
  if (ground.field == nullptr || !motion.level_field_ut) return 0.0;
  if (!particle.field_bias) particle.field_bias = ground.field->start();
  const core::Vector2 midway_m = ground.floor_from_site * (0.5 * (from_m + particle.position_m));
  return ground.field->update(*particle.field_bias,
                              {motion.level_field_ut->x(), motion.level_field_ut->y()}, midway_m,
                              (particle.position_m - from_m).norm());
}

/// Systematic resampling [Kitagawa1996]: a comb of `count` teeth over the weights.
std::vector<std::uint32_t> comb(const std::vector<double>& weights, std::size_t count,
                                double first_tooth) {
  std::vector<std::uint32_t> chosen;
  chosen.reserve(count);
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * static_cast<double>(count);
    while (chosen.size() < count && static_cast<double>(chosen.size()) + first_tooth < sum) {
      chosen.push_back(static_cast<std::uint32_t>(i));
    }
  }
  const auto last = static_cast<std::uint32_t>(weights.size() - 1);
  while (chosen.size() < count) chosen.push_back(last);  // What rounding left.
  return chosen;
}

/// The likelihood itself at each node of a raster, and where none lies.
struct RasterMass {
  std::vector<double> sums;  ///< Running, node by node, in units of the best node's likelihood.
  double log_best = 0.0;
};

RasterMass mass_of(const observation::LikelihoodRaster& raster, double trust) {
  RasterMass mass;
  mass.sums.reserve(raster.log_likelihood.size());
  mass.log_best = trust * static_cast<double>(*std::ranges::max_element(raster.log_likelihood));
  double sum = 0.0;
  for (const float log_likelihood : raster.log_likelihood) {
    sum += std::exp(trust * static_cast<double>(log_likelihood) - mass.log_best);
    mass.sums.push_back(sum);
  }
  return mass;
}

double log_mean_likelihood(const observation::LikelihoodRaster& raster, double trust) {
  const RasterMass mass = mass_of(raster, trust);
  return mass.log_best + std::log(mass.sums.back() / static_cast<double>(mass.sums.size()));
}

/// A place at random, by a raster's likelihood. Floor frame.
core::Vector2 place_from(const observation::LikelihoodRaster& raster, const RasterMass& mass,
                         core::Rng& rng) {
  const auto found = std::ranges::upper_bound(mass.sums, mass.sums.back() * rng.uniform());
  const auto node =
      static_cast<std::size_t>(std::min(found, mass.sums.end() - 1) - mass.sums.begin());
  const core::Vector2 jitter(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5));
  return raster.node_at(node / raster.columns, node % raster.columns) + raster.node_m * jitter;
}

}  // namespace

core::Vector2 Particle::walked_m(const core::Vector2& pdr_m) const {
  const core::Vector2 axis = std::exp(log_scale) * direction(heading_offset_rad);
  return {axis.x() * pdr_m.x() - axis.y() * pdr_m.y(), axis.y() * pdr_m.x() + axis.x() * pdr_m.y()};
}

core::Vector2 spatial_median(const std::vector<core::Vector2>& places_m,
                             const std::vector<double>& weights, const core::Vector2& guess_m) {
  constexpr int kRounds = 15;
  constexpr double kNearest_m = 0.1;  // Keeps the step defined on top of a place.
  core::Vector2 median_m = guess_m;
  for (int round = 0; round < kRounds; ++round) {
    core::Vector2 sum_m = core::Vector2::Zero();
    double total = 0.0;
    for (std::size_t i = 0; i < places_m.size(); ++i) {
      const double pull = weights[i] / std::max(kNearest_m, (places_m[i] - median_m).norm());
      sum_m += pull * places_m[i];
      total += pull;
    }
    median_m = sum_m / total;
  }
  return median_m;
}

core::Result<void> ParticleFilter::Options::validate() const {
  const auto refuse = [](const char* message) {
    return core::fail(core::ErrorCode::kInvalidOptions, message, "particle_filter");
  };
  if (particles < 50 || particles > 100000) return refuse("particles must be in [50, 100000]");
  const bool sigmas = heading_offset_sigma_rad > 0.0 && log_scale_sigma >= 0.0 &&
                      heading_offset_walk_rad_per_sqrt_step >= 0.0 &&
                      log_scale_walk_per_sqrt_step >= 0.0 && position_walk_m_per_sqrt_s > 0.0 &&
                      radio_bias_sigma_m >= 0.0 && radio_bias_tau_s > 0.0 && base_sigma_m > 0.0 &&
                      sigma_scale > 0.0;
  if (!sigmas) return refuse("sigmas and times must be positive, walks not negative");
  if (!(radio_trust > 0.0 && radio_trust <= 1.0 && plan_trust >= 0.0)) {
    return refuse("radio_trust must be in (0, 1], plan_trust not negative");
  }
  if (!(jump_probability >= 0.0 && jump_probability < 1.0 && resample_ratio >= 0.0 &&
        resample_ratio <= 1.0)) {
    return refuse("jump_probability must be in [0, 1), resample_ratio in [0, 1]");
  }
  return {};
}

ParticleFilter::ParticleFilter(const Options& options, std::uint64_t seed, bool keep_history)
    : options_(options), rng_(seed), keep_history_(keep_history) {}

Particle ParticleFilter::random_particle() {
  Particle particle;
  particle.heading_offset_rad = rng_.normal(0.0, options_.heading_offset_sigma_rad);
  particle.log_scale = rng_.normal(0.0, options_.log_scale_sigma);
  const double bias_m = options_.radio_bias_sigma_m;
  particle.radio_bias_m = {rng_.normal(0.0, bias_m), rng_.normal(0.0, bias_m)};
  return particle;
}

void ParticleFilter::start(core::DeviceTime time, const core::Vector2& position_m, double sigma_m) {
  time_ = stands_at_ = time;
  particles_.assign(options_.particles, {});
  for (Particle& particle : particles_) {
    particle = random_particle();
    particle.position_m =
        position_m + core::Vector2(rng_.normal(0.0, sigma_m), rng_.normal(0.0, sigma_m));
  }
  log_weights_.assign(particles_.size(), 0.0);
  parents_.assign(particles_.size(), kNoParent);
  history_.clear();
  normalise();
  record();
}

void ParticleFilter::add(const observation::MotionDelta& motion, const Ground& ground) {
  if (!detail::is_sound(motion) || !path_.is_in_order(motion.end)) return;
  path_.add(motion);
  if (!started()) return;
  let_time_pass(motion.end);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Particle& particle = particles_[i];
    particle.heading_offset_rad += rng_.normal(0.0, options_.heading_offset_walk_rad_per_sqrt_step);
    particle.log_scale += rng_.normal(0.0, options_.log_scale_walk_per_sqrt_step);
    const double heading_rad = motion.heading_rad + particle.heading_offset_rad +
                               rng_.normal(0.0, motion.heading_sigma_rad);
    const double length_m =
        std::exp(particle.log_scale) * rng_.normal(motion.length_m, motion.length_sigma_m);
    const core::Vector2 from_m = particle.position_m;
    particle.position_m += length_m * direction(heading_rad);
    log_weights_[i] += options_.plan_trust * plan_penalty(ground, from_m, particle.position_m) +
                       field_fit(particle, motion, ground, from_m);
  }
  stands_at_ = motion.end;
  normalise();
  resample_if_few();
  record();
}

void ParticleFilter::add(const ScanLikelihood& scan, const Ground& ground) {
  WAYLODE_ASSERT(scan.raster != nullptr && !scan.raster->empty());
  if (!started()) return start_from(scan, ground);
  let_time_pass(scan.delivered);
  const double log_fit = weigh(scan, ground);
  // Bayes' rule for "carried off to anywhere since the last scan" against "not". In logarithms: a
  // scan may fit the guesses, or all places, less than a double can tell from 0.
  const double jump = options_.jump_probability;
  const double log_anywhere = log_mean_likelihood(*scan.raster, options_.radio_trust);
  const double likelihood_ratio = std::exp(log_fit - log_anywhere);
  const double jumped = jump > 0.0 ? jump / (jump + (1.0 - jump) * likelihood_ratio) : 0.0;
  const auto count =
      static_cast<std::size_t>(std::lround(jumped * static_cast<double>(particles_.size())));
  if (count > 0) {
    resample(particles_.size() - count);
    redraw(scan, ground, particles_.size() - count);
  } else {
    resample_if_few();
  }
  record();
}

/// The logarithm of the scan's mean likelihood over the guesses.
double ParticleFilter::weigh(const ScanLikelihood& scan, const Ground& ground) {
  const core::Vector2 since_m = path_.offset_m(scan.measured);
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const Particle& particle = particles_[i];
    const core::Vector2 heard_m =
        particle.position_m + particle.walked_m(since_m) + particle.radio_bias_m;
    log_weights_[i] += options_.radio_trust * scan.raster->at(ground.floor_from_site * heard_m);
  }
  return normalise();
}

void ParticleFilter::start_from(const ScanLikelihood& scan, const Ground& ground) {
  time_ = stands_at_ = scan.delivered;
  particles_.assign(options_.particles, {});
  log_weights_.assign(particles_.size(), 0.0);
  parents_.assign(particles_.size(), kNoParent);
  redraw(scan, ground, 0);
  record_way_here();
}

PlanarEstimate ParticleFilter::at(core::DeviceTime time) const {
  const core::Vector2 beyond_m = path_.offset_m(std::max(time, time_));
  std::vector<core::Vector2> places_m;
  places_m.reserve(particles_.size());
  core::Vector2 mean_m = core::Vector2::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    places_m.push_back(particles_[i].position_m + particles_[i].walked_m(beyond_m));
    mean_m += weights_[i] * places_m.back();
  }
  PlanarEstimate estimate{time, spatial_median(places_m, weights_, mean_m), core::Matrix2::Zero()};
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const core::Vector2 off_m = places_m[i] - estimate.position_m;
    estimate.covariance_m2 += weights_[i] * off_m * off_m.transpose();
  }
  const double waited_s = std::max(0.0, core::to_seconds(time - time_));
  const double untold_m2 = options_.base_sigma_m * options_.base_sigma_m +
                           std::pow(options_.position_walk_m_per_sqrt_s, 2) * waited_s;
  estimate.covariance_m2 = options_.sigma_scale * options_.sigma_scale * estimate.covariance_m2 +
                           untold_m2 * core::Matrix2::Identity();
  return estimate;
}

void ParticleFilter::forget_before(core::DeviceTime time) {
  while (history_.size() > 1 && history_.front().time < time) history_.pop_front();
}

void ParticleFilter::let_time_pass(core::DeviceTime time) {
  const double dt_s = core::to_seconds(time - time_);
  if (!(dt_s > 0.0)) return;
  time_ = time;
  const double walk_m = options_.position_walk_m_per_sqrt_s * std::sqrt(dt_s);
  const double kept = std::exp(-dt_s / options_.radio_bias_tau_s);
  const double fresh_m = options_.radio_bias_sigma_m * std::sqrt(1.0 - kept * kept);
  for (Particle& particle : particles_) {
    particle.position_m += core::Vector2(rng_.normal(0.0, walk_m), rng_.normal(0.0, walk_m));
    particle.radio_bias_m = kept * particle.radio_bias_m +
                            core::Vector2(rng_.normal(0.0, fresh_m), rng_.normal(0.0, fresh_m));
  }
}

/// Particles from `first` on, at places where the scan was heard and people can be.
void ParticleFilter::redraw(const ScanLikelihood& scan, const Ground& ground, std::size_t first) {
  constexpr int kTries = 12;  // Plans leave a tenth of the ground free, or more.
  const RasterMass mass = mass_of(*scan.raster, options_.radio_trust);
  const core::Vector2 since_m = path_.offset_m(scan.measured);
  for (std::size_t i = first; i < particles_.size(); ++i) {
    Particle particle;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      particle = random_particle();
      const core::Vector2 heard_m =
          ground.site_from_floor * place_from(*scan.raster, mass, rng_) - particle.radio_bias_m;
      particle.position_m = heard_m - particle.walked_m(since_m);
      const double penalty = plan_penalty(ground, particle.position_m, particle.position_m);
      if (rng_.uniform() < std::exp(options_.plan_trust * penalty)) break;
    }
    particles_[i] = particle;
    parents_[i] = kNoParent;
  }
  std::ranges::fill(log_weights_, 0.0);
  normalise();
}

/// The first `count` particles become a draw from all; the rest is left to the caller.
void ParticleFilter::resample(std::size_t count) {
  const auto chosen = comb(weights_, count, rng_.uniform());
  std::vector<Particle> particles(particles_.size());
  std::vector<std::uint32_t> parents(particles_.size(), kNoParent);
  for (std::size_t i = 0; i < count; ++i) {
    particles[i] = particles_[chosen[i]];
    parents[i] = parents_[chosen[i]];
  }
  particles_ = std::move(particles);
  parents_ = std::move(parents);
  std::ranges::fill(log_weights_, 0.0);
}

void ParticleFilter::resample_if_few() {
  double squares = 0.0;
  for (const double weight : weights_) squares += weight * weight;
  if (1.0 >= options_.resample_ratio * static_cast<double>(particles_.size()) * squares) return;
  resample(particles_.size());
  normalise();
}

/// Makes the weights sum to one; the logarithm of what they summed to.
double ParticleFilter::normalise() {
  const double largest = *std::ranges::max_element(log_weights_);
  weights_.resize(log_weights_.size());
  double total = 0.0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    weights_[i] = std::exp(log_weights_[i] - largest);
    total += weights_[i];
  }
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    weights_[i] /= total;
    log_weights_[i] -= largest + std::log(total);
  }
  return largest + std::log(total);
}

void ParticleFilter::record() {
  if (!keep_history_) return;
  // Between steps the places are those of the last one; who stands is where he is now.
  const bool in_step = path_.offset_m(time_) != core::Vector2::Zero();
  Node node{in_step ? stands_at_ : time_, {}, parents_, {}};
  if (!history_.empty()) node.time = std::max(node.time, history_.back().time);
  for (const Particle& particle : particles_) {
    node.places_m.push_back(particle.position_m.cast<float>());
  }
  for (const double weight : weights_) node.weights.push_back(static_cast<float>(weight));
  history_.push_back(std::move(node));
  std::iota(parents_.begin(), parents_.end(), 0U);
}

/// The way to the first place, as each guess sees it.
void ParticleFilter::record_way_here() {
  if (!keep_history_) return;
  constexpr double kSpacing_s = 0.5;
  const double way_s = core::to_seconds(time_ - path_.oldest().value_or(time_));
  for (double back_s = way_s; back_s > kSpacing_s; back_s -= kSpacing_s) {
    const core::DeviceTime time = time_ - core::from_seconds(back_s);
    Node node{time, {}, parents_, std::vector<float>(weights_.begin(), weights_.end())};
    for (const Particle& particle : particles_) {
      const core::Vector2 place_m = particle.position_m + particle.walked_m(path_.offset_m(time));
      node.places_m.push_back(place_m.cast<float>());
    }
    history_.push_back(std::move(node));
    std::iota(parents_.begin(), parents_.end(), 0U);
  }
  record();
}

}  // namespace waylode::fusion

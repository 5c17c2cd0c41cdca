// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/result.hpp"
#include "waylode/core/rng.hpp"
#include "waylode/core/time.hpp"
#include "waylode/fusion/path_memory.hpp"
#include "waylode/fusion/planar_estimate.hpp"
#include "waylode/magnetic/biased_field_state.hpp"
#include "waylode/magnetic/field_likelihood.hpp"
#include "waylode/observation/observation.hpp"
#include "waylode/site/walkability.hpp"

namespace waylode::fusion {

/// The floor that the particles walk on: how it lies in their plane (the site frame), where on it
/// people can be and what the magnetic field is like.
struct Ground {
  core::Affine2 floor_from_site;
  core::Affine2 site_from_floor;
  const site::Walkability* walkability = nullptr;    ///< Null: not known.
  const magnetic::FieldLikelihood* field = nullptr;  ///< Null: not known.
};

/// How well a scan fits each place of the ground's floor.
struct ScanLikelihood {
  core::DeviceTime measured;  ///< Not after `delivered`.
  core::DeviceTime delivered;
  std::shared_ptr<const observation::LikelihoodRaster> raster;  ///< Not null nor empty.
};

/// One guess of everything.
struct Particle {
  core::Vector2 position_m = core::Vector2::Zero();    ///< Site frame, at the end of the last step.
  double heading_offset_rad = 0.0;                     ///< Walking direction less PDR heading.
  double log_scale = 0.0;                              ///< Of the step length.
  core::Vector2 radio_bias_m = core::Vector2::Zero();  ///< Where scans point, less where one is.
  std::optional<magnetic::BiasedFieldState> field_bias{};  ///< Of the phone, since its first step.

  /// A displacement that PDR tells, as this particle sees it.
  core::Vector2 walked_m(const core::Vector2& pdr_m) const;
};

/// Several places held for possible at once. Steps move the guesses, the plan and the scans weigh
/// them. Scans of one walk share their error: each guess has a radio bias that changes slowly.
/// At every scan some guesses may be drawn anew from it, as many as it speaks for the person's
/// having been carried off since the last one: no wrong belief lasts. Causal; seeded, so that the
/// same input gives the same answer.
class ParticleFilter {
 public:
  struct Options {
    std::size_t particles = 1000;  ///< 50 to 100000; time and memory are in proportion.
    double heading_offset_sigma_rad = 0.25;
    double heading_offset_walk_rad_per_sqrt_step = 0.03;
    double log_scale_sigma = 0.10;
    double log_scale_walk_per_sqrt_step = 0.005;
    double position_walk_m_per_sqrt_s = 0.2;  ///< Movement that no step tells, per axis.
    double radio_bias_sigma_m = 3.0;          ///< Per axis; 0: scans share no error.
    double radio_bias_tau_s = 30.0;           ///< How long a radio error persists.
    double radio_trust = 1.0;                 ///< Power on a scan's likelihood, above 0 to 1.
    double jump_probability = 0.01;           ///< That between two scans the belief became void.
    double plan_trust = 1.0;                  ///< Power on the plan's penalty; 0: no plan.
    double resample_ratio = 0.5;              ///< Redrawn when fewer than this share are effective.
    double base_sigma_m = 1.2;  ///< Error per axis that no guess tells of: marks, model.
    double sigma_scale = 1.0;   ///< On the guesses' own spread, fitted so that regions hold.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  static constexpr std::uint32_t kNoParent = std::numeric_limits<std::uint32_t>::max();

  /// The guesses after one event, for smoothers.
  struct Node {
    core::DeviceTime time;  ///< That the places are of.
    std::vector<Eigen::Vector2f> places_m;
    std::vector<std::uint32_t> parents;  ///< Into the node before; kNoParent: drawn anew.
    std::vector<float> weights;          ///< Sum to one.
  };

  ParticleFilter(const Options& options, std::uint64_t seed, bool keep_history);

  /// Begins at a position known to `sigma_m` per axis; forgets all else but the way walked.
  void start(core::DeviceTime time, const core::Vector2& position_m, double sigma_m);
  /// By start(), or by the first scan.
  bool started() const { return !particles_.empty(); }

  /// A step, its heading on the site frame up to the offset. What is not finite or not in order of
  /// time is passed over.
  void add(const observation::MotionDelta& motion, const Ground& ground);
  void add(const ScanLikelihood& scan, const Ground& ground);

  /// Where the walker is, in mid-step if need be: the spatial median of the guesses, which is what
  /// makes the expected distance least [Weiszfeld1937], and their scatter about it. Started.
  PlanarEstimate at(core::DeviceTime time) const;

  const std::vector<Particle>& particles() const { return particles_; }
  const std::vector<double>& weights() const { return weights_; }  ///< Sum to one.

  /// With keep_history: by time, from the oldest way known at the start.
  const std::deque<Node>& history() const { return history_; }
  void forget_before(core::DeviceTime time);

 private:
  void let_time_pass(core::DeviceTime time);
  void start_from(const ScanLikelihood& scan, const Ground& ground);
  double weigh(const ScanLikelihood& scan, const Ground& ground);
  void redraw(const ScanLikelihood& scan, const Ground& ground, std::size_t first);
  void resample(std::size_t count);
  void resample_if_few();
  double normalise();
  void record();
  void record_way_here();
  Particle random_particle();

  Options options_;
  core::Rng rng_;
  bool keep_history_;
  core::DeviceTime time_;       ///< Of the newest event.
  core::DeviceTime stands_at_;  ///< The instant that the particles' places are of.
  std::vector<Particle> particles_;
  std::vector<double> log_weights_;
  std::vector<double> weights_;
  std::vector<std::uint32_t> parents_;  ///< Into the newest node.
  PathMemory path_;
  std::deque<Node> history_;
};

/// The point with the least weighted sum of distances to `places_m`, from a first guess.
core::Vector2 spatial_median(const std::vector<core::Vector2>& places_m,
                             const std::vector<double>& weights, const core::Vector2& guess_m);

}  // namespace waylode::fusion

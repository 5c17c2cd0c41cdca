// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace waylode::core {

/// Seeded random numbers, the same on every platform: the standard fixes mt19937_64 but not the
/// distributions, so those are ours. Passed in by reference; there is no global one.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), 53 random bits.
  double uniform();
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [0, count). `count` > 0. Unbiased.
  std::uint64_t below(std::uint64_t count);
  /// Standard normal, Marsaglia's polar method.
  double normal();
  double normal(double mean, double sigma) { return mean + sigma * normal(); }
  /// An independent generator for a part of the work, so that parts can change without each other.
  Rng fork() { return Rng(engine_()); }

 private:
  std::mt19937_64 engine_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace waylode::core

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/collate/collator.hpp"

#include <algorithm>
#include <utility>

namespace waylode::collate {

core::Result<void> Collator::Options::validate() const {
  if (max_lateness < core::Duration::zero() || max_lateness > std::chrono::seconds(60)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "collate.max_lateness must be from 0 to 60 seconds");
  }
  if (max_held == 0) {
    return core::fail(core::ErrorCode::kInvalidOptions, "collate.max_held must be at least 1");
  }
  return {};
}

core::Result<Collator> Collator::create(Options options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(std::move(valid.error()));
  return Collator(options);
}

bool Collator::leaves_after(const Held& a, const Held& b) {
  return std::pair(a.time, a.sequence) > std::pair(b.time, b.sequence);
}

void Collator::push(sample::Sample&& sample) {
  const core::DeviceTime time = sample::time_of(sample);
  if (time < last_left_) {
    ++dropped_count_;
    return;
  }
  newest_ = std::max(newest_, time);
  held_.push_back({time, next_sequence_++, std::move(sample)});
  std::push_heap(held_.begin(), held_.end(), leaves_after);
}

std::vector<sample::Sample> Collator::take_ready() {
  std::vector<sample::Sample> ready;
  while (!held_.empty() && (held_.size() > options_.max_held ||
                            held_.front().time <= newest_ - options_.max_lateness)) {
    ready.push_back(pop_oldest());
  }
  return ready;
}

std::vector<sample::Sample> Collator::flush() {
  std::vector<sample::Sample> rest;
  rest.reserve(held_.size());
  while (!held_.empty()) rest.push_back(pop_oldest());
  return rest;
}

sample::Sample Collator::pop_oldest() {
  std::pop_heap(held_.begin(), held_.end(), leaves_after);
  last_left_ = held_.back().time;
  sample::Sample sample = std::move(held_.back().sample);
  held_.pop_back();
  return sample;
}

}  // namespace waylode::collate

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/session.hpp"

#include <algorithm>
#include <utility>

#include "waylode/core/assert.hpp"
#include "waylode/pipeline/estimator.hpp"

namespace waylode::pipeline {

Model::Model(std::shared_ptr<const site::Site> site, const Options& options, radio::Matcher matcher)
    : site_(std::move(site)), options_(options), matcher_(std::move(matcher)) {}

core::Result<std::shared_ptr<const Model>> Model::create(std::shared_ptr<const site::Site> site,
                                                         const Options& options) {
  if (auto valid = options.validate(); !valid) return tl::unexpected(valid.error());
  if (site->radio_map().empty()) {
    return core::fail(core::ErrorCode::kMapMissing,
                      "the site has no radio map; build it from surveyed logs", site->name());
  }
  auto matcher = radio::Matcher::create(site->radio_map(), options.matcher);
  if (!matcher) return tl::unexpected(matcher.error());
  return std::shared_ptr<const Model>(new Model(std::move(site), options, *std::move(matcher)));
}

struct Session::Pipeline {
  std::shared_ptr<const Model> model;
  Method method;
  SessionOptions options;
  pdr::DeadReckoning reckoning;
  radio::ScanAssembler assembler;
  radio::WknnEstimator wknn;
  std::unique_ptr<Estimator> estimator;
  std::optional<core::DeviceTime> last_scan;
  std::optional<core::DeviceTime> quiet_since;  ///< No scan, and no try with Bluetooth alone.

  void hear(const radio::Query& query) {
    const auto observation = wknn.estimate(query, options.known_floor);
    if (!observation) {
      if (wknn.is_foreign(query)) estimator->hear_unknown(query.delivered);
      return;
    }
    estimator->add(*observation);
    last_scan = query.delivered;
  }

  /// Advertisements wait for the next Wi-Fi scan; when none comes they are matched by themselves.
  void hear(const sample::BleReading& advertisement) {
    assembler.add(advertisement);
    quiet_since = std::max(quiet_since.value_or(advertisement.time),
                           last_scan.value_or(core::DeviceTime::min()));
    const double quiet_s = core::to_seconds(advertisement.time - *quiet_since);
    if (quiet_s < model->options().bluetooth_alone_after_s) return;
    quiet_since = advertisement.time;
    hear(assembler.assemble_bluetooth(advertisement.time));
  }
};

Session::Session(std::unique_ptr<Pipeline> pipeline) : pipeline_(std::move(pipeline)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

core::Result<Session> Session::create(std::shared_ptr<const Model> model, const Method& method,
                                      const SessionOptions& options) {
  if (method.kind == MethodKind::kPdr && !options.start) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "this method needs a known start (floor, x, y)", std::string(method.name));
  }
  const std::size_t floor_count = model->site()->floors().size();
  for (const auto& floor :
       {options.known_floor, options.start ? std::optional(options.start->floor) : std::nullopt}) {
    if (floor && floor->index >= floor_count) {
      return core::fail(core::ErrorCode::kInvalidArgument, "the site has no such floor",
                        model->site()->name());
    }
  }
  const Options& tunables = model->options();
  auto pipeline = std::unique_ptr<Pipeline>(new Pipeline{
      model, method, options, pdr::DeadReckoning(tunables.pdr), radio::ScanAssembler(tunables.scan),
      radio::WknnEstimator(model->matcher(), tunables.wknn),
      make_estimator(*model, method, options), std::nullopt, std::nullopt});
  return Session(std::move(pipeline));
}

void Session::push(const sample::Sample& sample) {
  if (const auto* scan = std::get_if<sample::WifiScan>(&sample)) {
    pipeline_->hear(pipeline_->assembler.assemble(*scan));
  } else if (const auto* advertisement = std::get_if<sample::BleReading>(&sample)) {
    pipeline_->hear(*advertisement);
  } else if (const auto motion = pipeline_->reckoning.add(sample)) {
    pipeline_->estimator->add(*motion);
  }
}

core::Fix Session::fix_at(core::DeviceTime time) const {
  core::Fix fix;
  fix.time = time;
  fix.belief = pipeline_->estimator->belief_at(time);
  if (fix.belief) fix.state = pipeline_->estimator->state_at(time, *fix.belief);
  fix.provenance = {std::string(pipeline_->method.name), pipeline_->model->site()->version(),
                    pipeline_->last_scan};
  return fix;
}

std::vector<core::Fix> replay(Session& session, const Method& method,
                              std::span<const sample::Sample> samples,
                              std::span<const core::DeviceTime> instants) {
  std::vector<core::Fix> fixes;
  fixes.reserve(instants.size());
  std::size_t next = 0;
  if (method.whole_track()) {
    for (; next < samples.size(); ++next) session.push(samples[next]);
  }
  for (const core::DeviceTime instant : instants) {
    while (next < samples.size() && sample::time_of(samples[next]) <= instant + method.lag) {
      session.push(samples[next++]);
    }
    fixes.push_back(session.fix_at(instant));
  }
  return fixes;
}

}  // namespace waylode::pipeline

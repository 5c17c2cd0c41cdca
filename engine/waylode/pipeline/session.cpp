// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/pipeline/session.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "waylode/magnetic/features.hpp"
#include "waylode/magnetic/step_field.hpp"
#include "waylode/pdr/dead_reckoning.hpp"
#include "waylode/pdr/pressure_climb.hpp"
#include "waylode/pipeline/estimator.hpp"
#include "waylode/pipeline/field_matching.hpp"
#include "waylode/pipeline/stride_learning.hpp"
#include "waylode/radio/alternatives.hpp"
#include "waylode/radio/scan_assembler.hpp"
#include "waylode/radio/wknn.hpp"

namespace waylode::pipeline {
namespace {

pdr::DeadReckoning::Options with_parts(pdr::DeadReckoning::Options options, const Recipe& recipe) {
  options.detector = recipe.steps;
  options.validity = recipe.validity;
  options.stride.model = recipe.stride;
  options.heading_source = recipe.heading;
  return options;
}

/// The scan just heard and those of the seconds before it.
class HeardScans final : public HeardAgain {
 public:
  explicit HeardScans(const Model& model) : model_(model) {}

  void add(const radio::Query& query) {
    constexpr double kKept_s = 4.0;
    while (!queries_.empty() &&
           core::to_seconds(query.delivered - queries_.front().delivered) > kKept_s) {
      queries_.pop_front();
    }
    queries_.push_back(query);
  }
  std::optional<observation::RadioObservation> near(const core::Belief& around) const override {
    const auto positioner = model_.near_positioner();
    if (!positioner) return std::nullopt;
    auto placed = (*positioner)->estimate(queries_.back(), around.floor, around);
    return placed ? std::optional(std::move(placed->observation)) : std::nullopt;
  }
  std::vector<core::Vector2> alternatives(core::FloorId floor, std::size_t count,
                                          double apart_m) const override {
    const auto map = model_.reference_map();
    if (!map) return {};
    std::vector<radio::QueryReading> readings;
    for (const radio::Query& query : queries_) {
      readings.insert(readings.end(), query.readings.begin(), query.readings.end());
    }
    return radio::alternatives(**map, readings, floor, count, apart_m);
  }

 private:
  const Model& model_;
  std::deque<radio::Query> queries_;
};

}  // namespace

struct Session::Pipeline {
  std::shared_ptr<const Model> model;
  Method method;
  SessionOptions options;
  pdr::DeadReckoning reckoning;
  pdr::PressureClimb pressure;
  radio::ScanAssembler assembler;
  HeardScans heard;
  radio::WknnEstimator foreign;                         ///< Tells scans of elsewhere.
  std::shared_ptr<const radio::Positioner> positioner;  ///< None: the method has no radio.
  const radio::PlaceLikelihood* places;                 ///< Null: the method has no use for it.
  radio::DeviceResponse response;                       ///< With `places`.
  std::optional<StrideLearning> learning;               ///< None: the stride has no gains to learn.
  std::unique_ptr<FieldMatching> field;  ///< None: the method does not match the field.
  magnetic::StepField step_field;
  std::unique_ptr<Estimator> estimator;
  std::optional<core::DeviceTime> last_scan;
  std::optional<core::DeviceTime> quiet_since;  ///< No scan, and no try with Bluetooth alone.

  void hear(const radio::Query& heard_query) {
    if (!positioner) return;
    const radio::Query query = places != nullptr ? response.applied(heard_query) : heard_query;
    auto placed = positioner->estimate(query, options.known_floor, std::nullopt);
    if (!placed) {
      if (foreign.is_foreign(query)) estimator->hear_unknown(query.delivered);
      return;
    }
    heard.add(query);
    if (places != nullptr) {
      places->add_rasters(query, placed->observation);
      learn_response(heard_query, placed->observation.floors.front());
    }
    if (learning) learning->add(placed->observation);
    estimator->add(placed->observation, heard);
    last_scan = query.delivered;
  }

  /// How much louder this phone hears than the survey's, by what it should hear where it is.
  void learn_response(const radio::Query& query, const observation::FloorHypothesis& likeliest) {
    response.update(places->residuals(query, likeliest.floor, likeliest.position_m));
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

  void feel(const sample::Sample& sample) {
    const auto* field_sample = std::get_if<sample::MagnetometerSample>(&sample);
    if (field_sample == nullptr || !reckoning.up_in_device()) return;
    const auto level = magnetic::level_field(field_sample->field_ut, *reckoning.up_in_device());
    if (level) step_field.add(field_sample->time, *level);
  }

  void move(const sample::Sample& sample) {
    feel(sample);
    auto motion = reckoning.add(sample);
    if (motion) {
      motion->level_field_ut = step_field.mean_ut(motion->begin, motion->end);
      estimator->add(*motion);
    }
    if (motion && learning) {
      if (const auto gains = learning->add(*motion)) reckoning.set_stride_gains(*gains);
    }
    if (!field) return;
    const auto observation = field->add(sample, motion, reckoning.up_in_device(), *estimator);
    if (observation) estimator->add(*observation);
  }
};

Session::Session(std::unique_ptr<Pipeline> pipeline) : pipeline_(std::move(pipeline)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

core::Result<Session> Session::create(std::shared_ptr<const Model> model, const Method& method,
                                      const SessionOptions& options) {
  if (method.needs_start() && !options.start) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "this method needs a known start (floor, x, y)", method.name);
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
  const Recipe& recipe = method.recipe;
  std::shared_ptr<const radio::Positioner> positioner;
  if (recipe.radio != RadioPart::kNone) {
    auto made = model->positioner(recipe.radio);
    if (!made) return tl::unexpected(made.error());
    positioner = *std::move(made);
  }
  const radio::PlaceLikelihood* places = nullptr;
  if (recipe.weighs_places()) {
    const auto made = model->places();
    if (!made) return tl::unexpected(made.error());
    places = *made;
  }
  std::unique_ptr<FieldMatching> field;
  if (recipe.magnetic == MagneticPart::kSequence) {
    auto fields = model->fields();
    if (!fields) return tl::unexpected(fields.error());
    field = std::make_unique<FieldMatching>(model->site(), *std::move(fields), tunables.field);
  }
  std::optional<StrideLearning> learning;
  if (recipe.learns_stride && positioner) {
    pdr::StrideCalibrator::Options calibrator;
    calibrator.prior = tunables.pdr.stride.gains;
    learning.emplace(*model->site(), calibrator);
  }
  // [Wu2019] 1.1 keeps phones' hotspots out of every distance; our own matching bears them.
  const bool drops_hotspots = positioner && recipe.radio != RadioPart::kWknn;
  auto pipeline = std::unique_ptr<Pipeline>(new Pipeline{
      model,
      method,
      options,
      pdr::DeadReckoning(with_parts(tunables.pdr, recipe)),
      pdr::PressureClimb(tunables.pressure),
      radio::ScanAssembler(tunables.scan, drops_hotspots ? &model->hotspots() : nullptr),
      HeardScans(*model),
      radio::WknnEstimator(model->matcher(), tunables.wknn),
      std::move(positioner),
      places,
      radio::DeviceResponse(tunables.response),
      std::move(learning),
      std::move(field),
      {},
      make_estimator(*model, method, options),
      std::nullopt,
      std::nullopt});
  return Session(std::move(pipeline));
}

void Session::push(const sample::Sample& sample) {
  if (const auto* scan = std::get_if<sample::WifiScan>(&sample)) {
    pipeline_->hear(pipeline_->assembler.assemble(*scan));
  } else if (const auto* advertisement = std::get_if<sample::BleReading>(&sample)) {
    pipeline_->hear(*advertisement);
  } else if (const auto* pressure = std::get_if<sample::BarometerSample>(&sample)) {
    const auto climb = pipeline_->pressure.add(*pressure);
    if (climb) pipeline_->estimator->add(*climb);
  } else {
    pipeline_->move(sample);
  }
}

core::Fix Session::fix_at(core::DeviceTime time) const {
  core::Fix fix;
  fix.time = time;
  fix.belief = pipeline_->estimator->belief_at(time);
  if (fix.belief) fix.state = pipeline_->estimator->state_at(time, *fix.belief);
  fix.provenance = {pipeline_->method.name, pipeline_->model->site()->version(),
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

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/survey/moving_transmitters.hpp"

#include <limits>

namespace waylode::survey {
namespace {

using radio::HotspotClassifier;

radio::HotspotEvidence::Options evidence_options(const MovingTransmitterFilter::Options& options,
                                                 MovingTransmitterFilter::Evidence evidence) {
  radio::HotspotEvidence::Options result;
  result.loud_dbm = options.loud_dbm;
  result.farthest_m = options.farthest_m;
  if (evidence == MovingTransmitterFilter::Evidence::kLoudPlaces) {
    result.min_visit_ratio = 0.0;
    result.max_residual_db = std::numeric_limits<double>::infinity();
  }
  return result;
}

/// A phone's name alone leaves the classifier unsure; a map can spare the few that only look so.
bool is_hotspot(const HotspotClassifier::Classification& classification) {
  return classification.verdict == HotspotClassifier::Verdict::kMobile ||
         classification.reason == HotspotClassifier::Reason::kNameAlone;
}

}  // namespace

core::Result<void> MovingTransmitterFilter::Options::validate() const {
  if (!(loud_dbm < 0.0F && farthest_m > 0.0)) {
    return core::fail(core::ErrorCode::kInvalidOptions,
                      "loud_dbm must be negative and farthest_m positive", "moving_transmitters");
  }
  return {};
}

MovingTransmitterFilter::MovingTransmitterFilter(const Options& options, Evidence evidence)
    : evidence_(evidence_options(options, evidence)) {}

void MovingTransmitterFilter::hear(core::TransmitterId transmitter, std::string_view ssid,
                                   float rssi_dbm, core::FloorId floor,
                                   const core::Vector2& position_m) {
  if (is_hotspot(classifier_.classify(transmitter, ssid))) hotspots_.insert(transmitter);
  evidence_.hear(transmitter, rssi_dbm, floor, position_m);
}

bool MovingTransmitterFilter::is_moving(core::TransmitterId transmitter) const {
  return hotspots_.contains(transmitter) || evidence_.finding(transmitter).moves();
}

bool asks_not_to_be_mapped(std::string_view ssid) { return ssid.ends_with("_nomap"); }

}  // namespace waylode::survey

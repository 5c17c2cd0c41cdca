// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "fix_format.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "waylode/core/covariance.hpp"

namespace waylode::cli {
namespace {

using Json = nlohmann::ordered_json;

/// What may be shown of a fix.
const core::Belief* shown_belief(const core::Fix& fix) {
  const bool shown =
      fix.state == core::FixState::kOk || fix.state == core::FixState::kLowConfidence;
  if (!shown || !fix.belief || !fix.belief->position_m.allFinite()) return nullptr;
  return &*fix.belief;
}

double time_s(const core::Fix& fix) { return core::to_seconds(fix.time.time_since_epoch()); }

std::string version_text(const core::Fix& fix) {
  return fmt::format("{:016x}", fix.provenance.map_version);
}

Json position_json(const site::Site& site, const core::Belief& belief) {
  const core::Matrix2& covariance_m2 = belief.covariance_m2;
  const core::Ellipse ellipse = core::confidence_ellipse(covariance_m2, 0.95);
  const auto geo = site.geo_from_floor(belief.floor, belief.position_m);
  return {
      {"floor", site.floor(belief.floor).name},
      {"floor_probability", belief.floor_probability},
      {"x_m", belief.position_m.x()},
      {"y_m", belief.position_m.y()},
      {"latitude_deg", geo ? Json(geo->latitude_deg) : Json(nullptr)},
      {"longitude_deg", geo ? Json(geo->longitude_deg) : Json(nullptr)},
      {"covariance_m2",
       {{covariance_m2(0, 0), covariance_m2(0, 1)}, {covariance_m2(1, 0), covariance_m2(1, 1)}}},
      {"ellipse_95",
       {{"semi_major_m", ellipse.semi_major_m},
        {"semi_minor_m", ellipse.semi_minor_m},
        {"major_axis_rad", ellipse.major_axis_rad}}}};
}

Json fix_json(const site::Site& site, const core::Fix& fix) {
  const core::Belief* belief = shown_belief(fix);
  return {{"time_s", time_s(fix)},
          {"state", core::to_string(fix.state)},
          {"position", belief == nullptr ? Json(nullptr) : position_json(site, *belief)},
          {"method", fix.provenance.method},
          {"map_version", version_text(fix)}};
}

Json feature_json(const site::Site& site, const core::Fix& fix) {
  Json geometry = nullptr;
  if (const core::Belief* belief = shown_belief(fix)) {
    const auto geo = site.geo_from_floor(belief->floor, belief->position_m);
    const Json coordinates = geo ? Json{geo->longitude_deg, geo->latitude_deg}
                                 : Json{belief->position_m.x(), belief->position_m.y()};
    geometry = {{"type", "Point"}, {"coordinates", coordinates}};
  }
  return {{"type", "Feature"}, {"geometry", geometry}, {"properties", fix_json(site, fix)}};
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"') quoted += '"';
    quoted += character;
  }
  return quoted + '"';
}

std::string position_cells(const site::Site& site, const core::Fix& fix) {
  constexpr const char* kNoPosition = ",,,,,,,,,,,";
  const core::Belief* belief = shown_belief(fix);
  if (belief == nullptr) return kNoPosition;
  const core::Matrix2& covariance_m2 = belief->covariance_m2;
  const core::Ellipse ellipse = core::confidence_ellipse(covariance_m2, 0.95);
  const auto geo = site.geo_from_floor(belief->floor, belief->position_m);
  std::string cells = csv_cell(site.floor(belief->floor).name);
  cells += fmt::format(",{:.4f},{:.3f},{:.3f}", belief->floor_probability, belief->position_m.x(),
                       belief->position_m.y());
  cells += geo ? fmt::format(",{:.8f},{:.8f}", geo->latitude_deg, geo->longitude_deg) : ",,";
  cells += fmt::format(",{:.4f},{:.4f},{:.4f}", covariance_m2(0, 0), covariance_m2(0, 1),
                       covariance_m2(1, 1));
  return cells + fmt::format(",{:.3f},{:.3f},{:.4f}", ellipse.semi_major_m, ellipse.semi_minor_m,
                             ellipse.major_axis_rad);
}

}  // namespace

std::string fixes_to_json(const site::Site& site, std::span<const core::Fix> fixes) {
  Json list = Json::array();
  for (const core::Fix& fix : fixes) list.push_back(fix_json(site, fix));
  return Json{{"site", site.name()}, {"fixes", list}}.dump(1) + "\n";
}

std::string fixes_to_geojson(const site::Site& site, std::span<const core::Fix> fixes) {
  Json features = Json::array();
  for (const core::Fix& fix : fixes) features.push_back(feature_json(site, fix));
  return Json{{"type", "FeatureCollection"},
              {"site", site.name()},
              {"coordinates", site.origin() ? "wgs84" : "floor_m"},
              {"features", features}}
             .dump(1) +
         "\n";
}

std::string fixes_to_csv(const site::Site& site, std::span<const core::Fix> fixes) {
  std::string text =
      "time_s,state,floor,floor_probability,x_m,y_m,latitude_deg,longitude_deg,xx_m2,xy_m2,yy_m2,"
      "semi_major_95_m,semi_minor_95_m,major_axis_rad,method,map_version\n";
  for (const core::Fix& fix : fixes) {
    text += fmt::format("{:.3f},{},{},{},{}\n", time_s(fix), core::to_string(fix.state),
                        position_cells(site, fix), fix.provenance.method, version_text(fix));
  }
  return text;
}

}  // namespace waylode::cli

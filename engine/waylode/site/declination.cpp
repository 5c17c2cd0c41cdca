// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/declination.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "waylode/core/angle.hpp"
#include "waylode/site/detail/wmm2025.hpp"
#include "waylode/site/tangent_plane.hpp"

namespace waylode::site {
namespace {

using detail::kWmmDegree;
using Triangle = std::array<std::array<double, kWmmDegree + 1>, kWmmDegree + 1>;

/// Associated Legendre functions of the cosine of the colatitude, Schmidt semi-normalised, and
/// their derivatives by the colatitude.
struct Legendre {
  Triangle value{};
  Triangle slope{};
};

Legendre legendre(double colatitude_rad) {
  const double cosine = std::cos(colatitude_rad);
  const double sine = std::sin(colatitude_rad);
  Legendre gauss;
  gauss.value[0][0] = 1.0;
  Triangle schmidt{};
  schmidt[0][0] = 1.0;
  for (int n = 1; n <= kWmmDegree; ++n) {
    const auto i = static_cast<std::size_t>(n);
    gauss.value[i][i] = sine * gauss.value[i - 1][i - 1];
    gauss.slope[i][i] = sine * gauss.slope[i - 1][i - 1] + cosine * gauss.value[i - 1][i - 1];
    schmidt[i][0] = schmidt[i - 1][0] * (2.0 * n - 1.0) / n;
    for (int m = 0; m <= n; ++m) {
      const auto k = static_cast<std::size_t>(m);
      if (m > 0) {
        schmidt[i][k] =
            schmidt[i][k - 1] * std::sqrt((n - m + 1.0) * (m == 1 ? 2.0 : 1.0) / (n + m));
      }
      if (m == n) continue;
      const double older =
          n == 1 ? 0.0 : ((n - 1.0) * (n - 1.0) - m * m) / ((2.0 * n - 1.0) * (2.0 * n - 3.0));
      const double before_value = n == 1 ? 0.0 : gauss.value[i - 2][k];
      const double before_slope = n == 1 ? 0.0 : gauss.slope[i - 2][k];
      gauss.value[i][k] = cosine * gauss.value[i - 1][k] - older * before_value;
      gauss.slope[i][k] =
          cosine * gauss.slope[i - 1][k] - sine * gauss.value[i - 1][k] - older * before_slope;
    }
  }
  for (std::size_t i = 0; i <= kWmmDegree; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      gauss.value[i][k] *= schmidt[i][k];
      gauss.slope[i][k] *= schmidt[i][k];
    }
  }
  return gauss;
}

/// North, east and down as the centre of the earth sees them.
core::Vector3 geocentric_field_nt(double colatitude_rad, double longitude_rad, double radius_m,
                                  double years) {
  constexpr double kReferenceRadius_m = 6'371'200.0;
  const Legendre functions = legendre(colatitude_rad);
  core::Vector3 field_nt = core::Vector3::Zero();
  std::size_t index = 0;
  double shrink = std::pow(kReferenceRadius_m / radius_m, 2);
  for (int n = 1; n <= kWmmDegree; ++n) {
    shrink *= kReferenceRadius_m / radius_m;
    for (int m = 0; m <= n; ++m) {
      const detail::Harmonic& harmonic = detail::kWmm2025[index++];
      const double g_nt = harmonic.g_nt + years * harmonic.g_rate_nt;
      const double h_nt = harmonic.h_nt + years * harmonic.h_rate_nt;
      const double cosine = std::cos(m * longitude_rad);
      const double sine = std::sin(m * longitude_rad);
      const auto i = static_cast<std::size_t>(n);
      const auto k = static_cast<std::size_t>(m);
      const double along_nt = g_nt * cosine + h_nt * sine;
      // [WMM2025] X', Y' and Z'.
      field_nt.x() += shrink * along_nt * functions.slope[i][k];
      field_nt.y() += shrink * m * (g_nt * sine - h_nt * cosine) * functions.value[i][k] /
                      std::sin(colatitude_rad);
      field_nt.z() -= shrink * (n + 1) * along_nt * functions.value[i][k];
    }
  }
  return field_nt;
}

struct Geocentric {
  double latitude_rad = 0.0;
  double radius_m = 0.0;
};

/// Of a place on the WGS-84 ellipsoid.
Geocentric geocentric(double latitude_rad) {
  constexpr double kEquator_m = 6'378'137.0;
  constexpr double kFlattening = 1.0 / 298.257223563;
  constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
  const double normal_m =
      kEquator_m / std::sqrt(1.0 - kEccentricity2 * std::pow(std::sin(latitude_rad), 2));
  const double out_m = normal_m * std::cos(latitude_rad);
  const double up_m = normal_m * (1.0 - kEccentricity2) * std::sin(latitude_rad);
  return {std::atan2(up_m, out_m), std::hypot(out_m, up_m)};
}

}  // namespace

core::Result<EarthField> earth_field(const core::GeoPoint& place, double year) {
  if (!is_valid_geo_point(place)) {
    return core::fail(core::ErrorCode::kInvalidArgument, "latitude or longitude is out of range",
                      "earth_field");
  }
  if (!(year >= detail::kWmmEpoch_year && year <= detail::kWmmEpoch_year + 5.0)) {
    return core::fail(core::ErrorCode::kInvalidArgument,
                      "the magnetic model holds from 2025 to 2030; set the declination by hand",
                      "earth_field");
  }
  // At a pole every direction is south; a hand's breadth beside it there is a declination.
  constexpr double kHighest_deg = 89.999999;
  const double latitude_rad =
      core::radians_from_degrees(std::clamp(place.latitude_deg, -kHighest_deg, kHighest_deg));
  const Geocentric centred = geocentric(latitude_rad);
  const core::Vector3 centred_nt = geocentric_field_nt(
      core::kPi / 2.0 - centred.latitude_rad, core::radians_from_degrees(place.longitude_deg),
      centred.radius_m, year - detail::kWmmEpoch_year);
  const double tilt_rad = centred.latitude_rad - latitude_rad;
  const double north_nt = centred_nt.x() * std::cos(tilt_rad) - centred_nt.z() * std::sin(tilt_rad);
  const double down_nt = centred_nt.x() * std::sin(tilt_rad) + centred_nt.z() * std::cos(tilt_rad);
  const double horizontal_nt = std::hypot(north_nt, centred_nt.y());
  constexpr double kNanoPerMicro = 1000.0;
  return EarthField{.declination_rad = std::atan2(centred_nt.y(), north_nt),
                    .dip_rad = std::atan2(down_nt, horizontal_nt),
                    .strength_ut = std::hypot(horizontal_nt, down_nt) / kNanoPerMicro};
}

core::Result<double> magnetic_declination_rad(const core::GeoPoint& place, double year) {
  return earth_field(place, year).map([](const EarthField& field) {
    return field.declination_rad;
  });
}

}  // namespace waylode::site

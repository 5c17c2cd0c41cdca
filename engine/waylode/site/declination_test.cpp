// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/declination.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "waylode/core/angle.hpp"

namespace waylode::site {
namespace {

struct Known {
  core::GeoPoint place;
  double year;
  double declination_deg;
  double dip_deg;
  double strength_nt;
};

// From an independent implementation of the model (pygeomag 1.1.0, height 0).
constexpr Known kKnown[] = {
    {{80.0, 0.0}, 2025.0, 1.28148, 83.21058, 55178.45},
    {{0.0, 120.0}, 2025.0, -0.15827, -14.93060, 41064.29},
    {{-80.0, -120.0}, 2025.0, 68.77539, -72.00499, 54698.17},
    {{80.0, 0.0}, 2027.5, 2.59413, 83.23633, 55253.90},
    {{0.0, 120.0}, 2027.5, -0.24154, -14.65431, 41036.91},
    {{-80.0, -120.0}, 2027.5, 68.48612, -71.91719, 54474.19},
    {{30.25, 120.17}, 2026.3, -6.07161, 46.21423, 48922.92},
    {{39.9, 116.4}, 2025.8, -7.51989, 59.33070, 54915.62},
    {{48.137, 11.575}, 2026.9, 4.37558, 64.42458, 48836.52},
    {{-33.86, 151.2}, 2028.1, 12.84813, -64.39075, 56950.19},
    {{37.77, -122.42}, 2025.4, 12.95437, 61.07340, 47468.53},
    {{64.1, -21.9}, 2029.9, -10.08750, 75.36002, 52619.66},
};

TEST(EarthField, AgreesWithTheWorldMagneticModel) {
  for (const Known& known : kKnown) {
    const auto field = earth_field(known.place, known.year);
    ASSERT_TRUE(field);
    EXPECT_NEAR(core::degrees_from_radians(field->declination_rad), known.declination_deg, 2e-5);
    EXPECT_NEAR(core::degrees_from_radians(field->dip_rad), known.dip_deg, 2e-5);
    EXPECT_NEAR(field->strength_ut, known.strength_nt / 1000.0, 2e-5);
    EXPECT_EQ(*magnetic_declination_rad(known.place, known.year), field->declination_rad);
  }
}

TEST(EarthField, IsSmoothAcrossTheDateLineAndFiniteAtThePoles) {
  const auto west = earth_field({12.0, 180.0}, 2026.0);
  const auto east = earth_field({12.0, -180.0}, 2026.0);
  ASSERT_TRUE(west && east);
  EXPECT_NEAR(west->declination_rad, east->declination_rad, 1e-12);
  for (const double latitude_deg : {-90.0, 90.0}) {
    const auto field = earth_field({latitude_deg, 35.0}, 2026.0);
    ASSERT_TRUE(field);
    EXPECT_TRUE(std::isfinite(field->declination_rad));
    EXPECT_NEAR(field->strength_ut, 56.0, 5.0);
  }
}

TEST(EarthField, RefusesPlacesAndYearsOutOfRange) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(earth_field({91.0, 0.0}, 2026.0));
  EXPECT_FALSE(earth_field({kNan, 0.0}, 2026.0));
  EXPECT_FALSE(earth_field({0.0, kNan}, 2026.0));
  EXPECT_FALSE(earth_field({50.0, 8.0}, 2024.9));
  EXPECT_FALSE(earth_field({50.0, 8.0}, 2030.1));
  EXPECT_FALSE(magnetic_declination_rad({50.0, 8.0}, kNan));
}

}  // namespace
}  // namespace waylode::site

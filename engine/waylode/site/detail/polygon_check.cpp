// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "waylode/site/detail/polygon_check.hpp"

#include <algorithm>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/algorithms/unique.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

namespace waylode::site::detail {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
// Counter-clockwise, open rings: the conventions of site::Polygon.
using BoostPolygon = bg::model::polygon<BoostPoint, false, false>;

BoostPolygon::ring_type to_boost(const Ring& ring) {
  BoostPolygon::ring_type converted;
  converted.reserve(ring.size());
  for (const core::Vector2& vertex : ring) converted.emplace_back(vertex.x(), vertex.y());
  return converted;
}

BoostPolygon to_boost(const Polygon& polygon) {
  BoostPolygon converted;
  converted.outer() = to_boost(polygon.outer);
  for (const Ring& hole : polygon.holes) converted.inners().push_back(to_boost(hole));
  return converted;
}

Ring from_boost(const BoostPolygon::ring_type& ring) {
  Ring converted;
  converted.reserve(ring.size());
  for (const BoostPoint& point : ring) converted.emplace_back(point.x(), point.y());
  return converted;
}

}  // namespace

void tidy(Polygon& polygon) {
  BoostPolygon converted = to_boost(polygon);
  bg::unique(converted);
  bg::correct(converted);
  polygon.outer = from_boost(converted.outer());
  polygon.holes.clear();
  for (const auto& hole : converted.inners()) polygon.holes.push_back(from_boost(hole));
}

std::string defect_of(const Polygon& polygon) {
  bg::validity_failure_type failure = bg::no_failure;
  if (bg::is_valid(to_boost(polygon), failure)) return {};
  switch (failure) {
    case bg::failure_few_points:
    case bg::failure_wrong_topological_dimension:
    case bg::failure_wrong_orientation:  // after tidy: area zero
      return "encloses no area";
    case bg::failure_spikes:
      return "has a spike";
    case bg::failure_self_intersections:
      return "crosses itself";
    case bg::failure_interior_rings_outside:
    case bg::failure_nested_interior_rings:
      return "has a hole outside itself or inside another hole";
    default:
      return "is no simple area";
  }
}

}  // namespace waylode::site::detail

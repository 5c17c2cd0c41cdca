// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "waylode/core/geometry.hpp"
#include "waylode/core/id.hpp"
#include "waylode/core/result.hpp"
#include "waylode/magnetic/features.hpp"
#include "waylode/site/magnetic_map.hpp"

namespace waylode::magnetic {

/// One floor's surveyed field, drawn on a raster once so that looking it up is cheap. Immutable:
/// shared by sessions.
class FieldGrid {
 public:
  struct Options {
    double node_m = 0.25;   ///< Between raster nodes. At least 0.05; more on very large floors.
    double reach_m = 0.8;   ///< A node farther than this from all surveyed points knows nothing.
    double kernel_m = 0.5;  ///< Sigma of the weight of a point by its distance. Wider: smoother.

    core::Result<void> validate() const;
    bool operator==(const Options&) const = default;
  };

  FieldGrid() = default;  ///< Knows nothing anywhere.
  /// `points`: of one floor, as MagneticMap::on_floor() gives them. `options` must be valid.
  FieldGrid(std::span<const site::MagneticPoint> points, const Options& options);

  bool empty() const { return nodes_.empty(); }
  double node_m() const { return node_m_; }
  /// How far readings at one place differ, per part: root mean square over the places that average
  /// several; 0 where none does. Walks, phones and labels that disagree make it large.
  double scatter_ut() const { return scatter_ut_; }

  /// Between the nodes, bilinear; nullopt away from surveyed ground and for no finite position.
  std::optional<LevelField> at(const core::Vector2& position_m) const;

  /// How fast the field changes there, both parts together: root of the summed squares of their
  /// derivatives, uT/m. Zero where the field is flat and says nothing; nullopt where not known.
  std::optional<double> gradient_utpm(const core::Vector2& position_m) const;

 private:
  struct Node {
    float horizontal_ut = 0.0F;
    float vertical_ut = 0.0F;
    bool known = false;
  };

  void lay_out(std::span<const site::MagneticPoint> points, const Options& options);
  void draw(std::span<const site::MagneticPoint> points, const Options& options);
  core::Vector2 node_at(std::size_t row, std::size_t column) const;

  double node_m_ = 0.0;
  double scatter_ut_ = 0.0;
  core::Vector2 min_m_ = core::Vector2::Zero();
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<Node> nodes_;  ///< Row by row.
};

/// One grid per floor of a site, by FloorId; empty grids where no field was surveyed.
std::vector<FieldGrid> field_grids(const site::MagneticMap& map, std::size_t floor_count,
                                   const FieldGrid::Options& options);

}  // namespace waylode::magnetic

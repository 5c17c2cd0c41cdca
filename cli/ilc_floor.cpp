// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include "ilc_floor.hpp"

#include <string>
#include <system_error>

#include "waylode/core/file.hpp"

namespace waylode::cli {
namespace {

namespace fs = std::filesystem;

/// The last part of the path, whether it ends in a slash, in "." or in a name.
std::string folder_name(const fs::path& folder) {
  std::error_code ignored;
  const fs::path whole = fs::absolute(folder, ignored).lexically_normal();
  return (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
}

}  // namespace

core::Result<site::FloorDraft> read_ilc_floor(const fs::path& folder) {
  const fs::path drawing_path = folder / "geojson_map.json";
  const fs::path info_path = folder / "floor_info.json";
  const auto info = core::read_file(info_path);
  if (!info) return tl::unexpected(info.error());
  const auto drawing = core::read_file(drawing_path);
  if (drawing) {
    return site::parse_ilc_floor(*drawing, *info, folder_name(folder), drawing_path.string());
  }
  if (drawing.error().code != core::ErrorCode::kFileNotFound) {
    return tl::unexpected(drawing.error());
  }
  const auto bounds = site::parse_ilc_floor_size(*info, info_path.string());
  if (!bounds) return tl::unexpected(bounds.error());
  return site::bare_floor(folder_name(folder), *bounds);
}

}  // namespace waylode::cli

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "waylode/core/result.hpp"
#include "waylode/site/site.hpp"

namespace waylode::site {

/// A site bundle is one file: plans and built maps, a format version, a checksum over all of it.
/// docs/site-bundle.md has the layout.
inline constexpr const char* kBundleSuffix = ".wlsite";

/// Writes atomically. The version recorded is the content's checksum: equal input, equal version.
core::Result<std::uint64_t> write_bundle(const SiteParts& parts, const std::filesystem::path& path);

/// Maps the file; the radio map is used in place. kBundleCorrupt for anything that is not a whole,
/// unharmed bundle of a version this program knows.
core::Result<std::shared_ptr<const Site>> load_bundle(const std::filesystem::path& path);

}  // namespace waylode::site

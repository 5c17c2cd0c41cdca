// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "waylode/core/result.hpp"
#include "waylode/site/site.hpp"

namespace waylode::site {

/// A site bundle is one file: plans and built maps, a format version, a checksum over all of it.
/// docs/site-bundle.md has the layout.
inline constexpr const char* kBundleSuffix = ".wlsite";

/// The newest layout this program writes and reads; it reads every older one. A bundle states the
/// oldest that holds what is in it: 2 with doors or connectors, else 1.
inline constexpr std::uint32_t kBundleFormatVersion = 2;

/// A bundle's bytes. Equal input, equal bytes. kInvalidArgument for parts that could not be loaded
/// again: numbers that are not finite, names that are not UTF-8 or not unique, maps that
/// name floors the site does not have.
core::Result<std::string> format_bundle(const SiteParts& parts);

/// Reads a bundle in memory; the maps are used in place. `bytes` start at a multiple of 8 and
/// live as long as `keep_alive`. `place` names the source in errors; kBundleCorrupt as below.
core::Result<std::shared_ptr<const Site>> parse_bundle(std::span<const std::byte> bytes,
                                                       std::shared_ptr<const void> keep_alive,
                                                       std::string_view place);

/// Writes atomically and gives the version recorded: a 64-bit hash of the content, so equal input,
/// equal version. Errors of format_bundle, or kFileUnwritable.
core::Result<std::uint64_t> write_bundle(const SiteParts& parts, const std::filesystem::path& path);

/// Maps the file; the maps are used in place. Replace a bundle by write_bundle only: a mapped
/// file must not be shortened. kFileNotFound, kFileUnreadable, or kBundleCorrupt for anything that
/// is not a whole, unharmed bundle of a version this program knows.
core::Result<std::shared_ptr<const Site>> load_bundle(const std::filesystem::path& path);

}  // namespace waylode::site

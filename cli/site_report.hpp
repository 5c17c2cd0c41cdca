// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "waylode/site/site.hpp"
#include "waylode/survey/map_builder.hpp"

namespace waylode::cli {

/// What a build found, for people and for programs.
std::string quality_to_text(const survey::QualityReport& report);
std::string quality_to_json(const std::string& site, const std::string& version,
                            const survey::QualityReport& report);

/// What a site holds.
std::string site_to_text(const site::Site& site);
std::string site_to_json(const site::Site& site);

/// A bundle's version as it is shown everywhere.
std::string version_text(std::uint64_t version);

}  // namespace waylode::cli

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "waylode/core/result.hpp"
#include "waylode/site/site.hpp"
#include "waylode/survey/surveyed_recording.hpp"

namespace waylode::survey {

/// Floors without plans, from the marks of surveyed walks: one floor per floor name, by rising
/// level (site::level_of_floor_name), as large as the box of its marks and 10 m around.
///
/// Georeferenced marks: the first one is the site's origin, and floor metres are metres east and
/// north of it (site_from_floor is the identity). Marks in floor metres: those metres are kept,
/// the site has no origin. Marks that name no floor are passed over.
/// kSurveyInsufficient when no mark names a floor, or when some marks are georeferenced and others
/// are not: only a plan can tell how their frames lie to each other.
core::Result<site::SiteParts> floors_from_marks(std::string name,
                                                std::span<const SurveyedRecording> recordings);

}  // namespace waylode::survey

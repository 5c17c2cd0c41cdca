// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "waylode/eval/findings.hpp"

namespace waylode::eval::detail {

/// Sections of the page for whatever was found beside the table; empty without findings.
std::string findings_html(const Findings& findings);

}  // namespace waylode::eval::detail

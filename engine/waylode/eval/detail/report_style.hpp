// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace waylode::eval::detail {

/// The page's whole style sheet: light and dark, screen and paper.
std::string_view report_style();

/// The page's whole script: methods on and off, and a readout under the pointer on charts. The page
/// says everything without it.
std::string_view report_script();

}  // namespace waylode::eval::detail

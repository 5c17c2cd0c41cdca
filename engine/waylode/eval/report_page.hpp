// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace waylode::eval {

/// A self-contained page around `body` (HTML), with the reports' style and script: no file or
/// network is needed to read it. `title` is plain text.
std::string report_page(std::string_view title, std::string_view body);

}  // namespace waylode::eval

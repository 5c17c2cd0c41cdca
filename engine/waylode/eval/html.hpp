// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace waylode::eval {

/// Text that is safe between tags and inside quoted attributes. Control characters become spaces.
std::string escape_html(std::string_view text);

/// `digits` after the point; an en dash entity for what is not finite.
std::string html_number(double value, int digits);

/// Like html_number with trailing zeros dropped and no negative zero: coordinates of a drawing.
std::string coordinate(double value);

}  // namespace waylode::eval

// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace waylode::core {

/// CRC-32 as in zip, PNG and MCAP (reflected, polynomial 0xEDB88320). Pass the previous value as
/// `crc` to go on with a following block.
std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t crc = 0);

}  // namespace waylode::core

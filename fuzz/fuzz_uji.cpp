// SPDX-FileCopyrightText: The Waylode authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "decoder_check.hpp"
#include "waylode/log/fingerprint_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace waylode;
  const std::string_view text = fuzz::text_of(data, size);
  const auto rows = log::read_uji_table_bytes(text, "fuzz");
  if (!rows) {
    fuzz::require(rows.error().code == core::ErrorCode::kTableInvalid);
    fuzz::require(rows.error().place.starts_with("fuzz:") && !rows.error().message.empty());
    return 0;
  }
  for (const auto& row : *rows) {
    fuzz::require(row.position_m.allFinite() && !row.floor.empty() && !row.building.empty());
    for (const auto& reading : row.readings) {
      fuzz::require(std::isfinite(reading.rssi_dbm));
      fuzz::require(reading.transmitter.kind() == core::TransmitterId::Kind::kColumn);
    }
  }
  return 0;
}
